# check.awk: a mesh of two bodies as FreeFEM can read it: LC_ALL=C awk -f msh.awk -f check.awk < FILE.msh > COPY.msh
# Needs: msh.awk; the physical curves contact, clamped (on the lower body), master, pushed (on the upper one),
#        the physical surfaces lower, upper. Other groups, sections, nodes of no triangle and edges of no triangle are left out.
# Gives: the mesh with lengths a million times as large (FreeFEM takes elements below 1e-8 for degenerate), its nodes numbered from
#        1 in the file's order, each edge and triangle once, the groups numbered as in the table below; exit code 0. Or one
#        line that says which node, element or group is wrong, and exit code 1: FreeFEM itself would end without a word, run out
#        of memory or solve another problem.
BEGIN {
  split("clamped contact master pushed", curve, " ")
  split("lower upper", surface, " ")
  for (k in curve) curveNumber["\"" curve[k] "\""] = k
  for (k in surface) surfaceNumber["\"" surface[k] "\""] = k
  bodyOf[1] = bodyOf[2] = 1
  bodyOf[3] = bodyOf[4] = 2
}
section == "PhysicalNames" {
  name = $0
  sub(/^[^"]*/, "", name)
  if ($1 == 1 && name in curveNumber) { curveOf[$2] = curveNumber[name]; found[name] = 1 }
  if ($1 == 2 && name in surfaceNumber) { surfaceOf[$2] = surfaceNumber[name]; found[name] = 1 }
  has = has " " name ($1 == 1 ? "" : ($1 == 2 ? " (surface)" : " (of dimension " $1 ")"))
}
section == "Elements" {
  if ($2 == 3 || $2 == 10 || $2 == 16) element("a quadrangle; only triangles, they are elements that are no triangles of first order")
  if ($2 == 8 || $2 == 9) element("elements of second order, no triangles of first order: use gmsh without -order")
  if ($2 != 1 && $2 != 2 && $2 != 15) element("of type " $2 ": elements that are no triangles of first order, lines or points")
  corners = $2 == 2 ? 3 : ($2 == 1 ? 2 : 1)
  if ($3 !~ /^[0-9]+$/ || NF != 3 + $3 + corners) element(NF " numbers; cut off, or more than it should have?")
  if ($2 == 15) next
  tag = $3 + 0 == 0 ? 0 : $4 + 0
  if (tag < 0) tag = -tag
  c = node($NF)
  b = node($(NF - 1))
  if ($2 == 1) {
    if (!(tag in curveOf)) next
    from[++lines] = b; to[lines] = c; lineCurve[lines] = curveOf[tag]; lineNumber[lines] = $1
    next
  }
  a = node($(NF - 2))
  if (a == b || b == c || c == a) element("a triangle without area: node " (a == c ? a : b) " twice")
  body = tag in surfaceOf ? surfaceOf[tag] : 0
  least = a < b ? (a < c ? a : c) : (b < c ? b : c)
  most = a > b ? (a > c ? a : c) : (b > c ? b : c)
  key = least " " a + b + c - least - most " " most
  if (key in seen) {
    # gmsh writes a triangle once for each of its groups
    i = seen[key]
    if (body && bodyIs[i] == body) element("a triangle that is there twice, as element " triNumber[i] " too")
    if (body && bodyIs[i]) element("a triangle of both bodies, as element " triNumber[i] " too: the bodies share a node")
    if (body) bodyIs[i] = body
    next
  }
  twice = (x[b] - x[a]) * (y[c] - y[a]) - (x[c] - x[a]) * (y[b] - y[a])
  sides = (x[b] - x[a])^2 + (y[b] - y[a])^2 + (x[c] - x[a])^2 + (y[c] - y[a])^2
  if (twice <= 1e-10 * sides && twice >= -1e-10 * sides) element("a triangle without area")
  if (twice < 0) element("a triangle turned over: its corners run clockwise")
  if (0.5e12 * twice < 1e-7) element("a triangle too small: another unit of length helps")
  seen[key] = ++triangles
  t1[triangles] = a; t2[triangles] = b; t3[triangles] = c
  bodyIs[triangles] = body; triNumber[triangles] = $1; parent[triangles] = triangles
}

function side(i, p, q) {
  # the edge p-q of triangle i, counterclockwise
  if ((p, q) in owner) fail("elements " triNumber[owner[p, q]] " and " triNumber[i] " lie on the same side of the edge " p "-" q ": they overlap")
  owner[p, q] = i
  if ((q, p) in owner) parent[root(i)] = root(owner[q, p])
}
function touch(i, p) {
  if (p in belongs && belongs[p] != bodyIs[i])
    fail("node " p " (element " triNumber[i] "): the bodies share a node: each needs its own points where they touch")
  belongs[p] = bodyIs[i]
  if (z[p] > 1e-9 * size || z[p] < -1e-9 * size) fail("node " p ": z = " z[p] "; a plane mesh has z = 0 everywhere")
}
function rim(p, q,   place) {
  if ((q, p) in owner) return
  # two nodes of a body's boundary in one place: what is meant as one body would open there
  place = belongs[p] sprintf(" %.9f %.9f", (x[p] - low) / size, (y[p] - bottom) / size)
  if (place in nodeAt && nodeAt[place] != p) fail("nodes " nodeAt[place] " and " p " of one body lie in the same place: a crack, or parts not joined")
  nodeAt[place] = p
}
function checkGroups(   k, name, missing) {
  for (k = 1; k <= 4; k++) if (!(("\"" curve[k] "\"") in found)) missing = missing " \"" curve[k] "\""
  for (k = 1; k <= 2; k++) if (!(("\"" surface[k] "\"") in found)) missing = missing " \"" surface[k] "\" (surface)"
  if (missing) fail("the mesh has no physical group" missing ", it has" (has ? has : " none"))
}
function widen(p) {
  if (x[p] < low) low = x[p]
  if (x[p] > right) right = x[p]
  if (y[p] < bottom) bottom = y[p]
  if (y[p] > top) top = y[p]
}
function checkTriangles(   i) {
  if (!triangles) fail("no triangles")
  low = right = x[t1[1]]; bottom = top = y[t1[1]]
  for (i = 1; i <= triangles; i++) {
    if (!bodyIs[i]) fail("element " triNumber[i] ": a triangle in neither \"lower\" nor \"upper\"")
    widen(t1[i]); widen(t2[i]); widen(t3[i])
  }
  size = right - low + top - bottom
  if (low < -1e9 * size || right > 1e9 * size || bottom < -1e9 * size || top > 1e9 * size)
    fail("the bodies are too far from the origin for their size: their coordinates have no digits left")
  for (i = 1; i <= triangles; i++) { touch(i, t1[i]); touch(i, t2[i]); touch(i, t3[i]) }
  for (i = 1; i <= triangles; i++) { side(i, t1[i], t2[i]); side(i, t2[i], t3[i]); side(i, t3[i], t1[i]) }
  for (i = 1; i <= triangles; i++) { rim(t1[i], t2[i]); rim(t2[i], t3[i]); rim(t3[i], t1[i]) }
}
function checkLines(   j, p, q, i, name, dx, dy) {
  for (j = 1; j <= lines; j++) {
    p = from[j]; q = to[j]; name = "\"" curve[lineCurve[j]] "\""
    if (!((p, q) in owner) && !((q, p) in owner)) fail("element " lineNumber[j] ": an edge of " name " that no triangle has")
    if ((p, q) in owner && (q, p) in owner) fail("element " lineNumber[j] ": an edge of " name " inside a body")
    if (!((p, q) in owner)) { p = to[j]; q = from[j] }
    if ((p, q) in isCurve && isCurve[p, q] != lineCurve[j])
      fail("element " lineNumber[j] ": an edge in two physical curves, \"" curve[isCurve[p, q]] "\" and " name)
    i = owner[p, q]
    if (bodyOf[lineCurve[j]] != bodyIs[i]) { strays[lineCurve[j]] = lineNumber[j]; continue }
    if ((p, q) in isCurve) { lineCurve[j] = 0; continue }
    isCurve[p, q] = lineCurve[j]
    edges[lineCurve[j]]++
    if (name == "\"clamped\"" || name == "\"pushed\"") { held[root(i)] = 1; continue }
    # counterclockwise, a body's top runs to the left and its bottom to the right
    dx = name == "\"contact\"" ? x[p] - x[q] : x[q] - x[p]
    dy = y[q] - y[p]
    if (dx < 1e-6 * sqrt(dx * dx + dy * dy) && dx > -1e-6 * sqrt(dx * dx + dy * dy))
      fail("element " lineNumber[j] ": a vertical edge of " name "; it must be a graph over x")
    if (dx < 0) fail("element " lineNumber[j] ": an edge of " name " faces " (name == "\"contact\"" ? "down; it must be the lower body's top" : "up; it must be the upper body's bottom"))
    begins[p] = lineCurve[j]
    ends[q] = lineCurve[j]
  }
  for (p in begins) if (ends[p] != begins[p]) pieces[begins[p]]++
  for (j = 1; j <= 4; j++) {
    name = bodyOf[j] == 1 ? "lower" : "upper"
    if (!edges[j]) fail("no edge of \"" curve[j] "\" on the " name " body; allowed: contact and clamped on the lower one, master and pushed on the upper one")
    if (j in strays) fail("element " strays[j] ": an edge of \"" curve[j] "\" that is not on the " name " body")
    if ((j == 2 || j == 3) && pieces[j] != 1) fail("\"" curve[j] "\" is in " pieces[j] " pieces: its edges must follow each other")
  }
  for (i = 1; i <= triangles; i++)
    if (!(root(i) in held)) fail("element " triNumber[i] ": a part of a body that no edge of clamped or pushed holds; a single node joins nothing")
}
function write(   i, j, k, n, m) {
  for (k = 1; k <= nodes; k++) if (inOrder[k] in belongs) now[inOrder[k]] = ++n
  print "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n6"
  for (k = 1; k <= 4; k++) print 1, k, "\"" curve[k] "\""
  for (k = 1; k <= 2; k++) print 2, k, "\"" surface[k] "\""
  print "$EndPhysicalNames\n$Nodes\n" n
  for (k = 1; k <= nodes; k++) {
    i = inOrder[k]
    if (i in now) printf "%d %.17g %.17g 0\n", now[i], x[i] * 1000000, y[i] * 1000000
  }
  print "$EndNodes\n$Elements\n" edges[1] + edges[2] + edges[3] + edges[4] + triangles
  for (j = 1; j <= lines; j++) if (lineCurve[j]) print ++m, 1, 2, lineCurve[j], lineCurve[j], now[from[j]], now[to[j]]
  for (i = 1; i <= triangles; i++) print ++m, 2, 2, bodyIs[i], bodyIs[i], now[t1[i]], now[t2[i]], now[t3[i]]
  print "$EndElements"
}
END {
  complete()
  checkGroups()
  checkTriangles()
  checkLines()
  write()
}
