# parts.awk: a mesh of any bodies as FreeFEM can read it: CASE=TABLE SPACE=0|1 MESH=FILE REGIONS=FILE MIDDLES=FILE CURVES=FILE
#        RISES=FILE SURFACE=FILE NOTES=FILE
#        LC_ALL=C awk -f msh.awk -f parts.awk -f cuts.awk -f same.awk -f planes.awk < FILE.msh
# Needs: msh.awk, cuts.awk, same.awk, planes.awk; TABLE, the groups that are used (edp/case/reader/rows.py); elements of first or second order. What no group of the
#        table names is left out, but every triangle (in space tetrahedron) must be in a body of the table.
# Gives: MESH, first order, lengths a million times as large (FreeFEM takes elements below 1e-8 for degenerate), nodes numbered from 1
#        in the file's order, each element once and turned the right way, boundaries numbered as in the table, regions as in REGIONS:
#        "named" and, as FieldData of VTK's XML, the units and the names by labels; then "regions", how many, then of each the number
#        of its body in the table and of its part: a part is what hangs together, also several bodies that share nodes;  MIDDLES, of a mesh of second order: a line for each element of the boundary in MESH's
#        order, the place of its middle node, in space of three, each opposite a corner. In the plane the boundary is all of it:
#        what no group of the table names is numbered one more than the groups, and CURVES has for each element of the boundary
#        the number of the geometry's curve that it lies on, 0: the file has none; with STRAIGHT no middles where all sides are
#        straight. RISES, in space: how many, then a line for each edge of all bodies' boundary whose middle is known: its ends,
#        nodes of MESH from 0 on, and the way from its middle to the surface's: by a mesh of second order, or by SURFACE, if there
#        is one: gmsh's mesh of the same surfaces, of second order. Exit code 0. Or one line that says what is wrong, and exit
#        code 1.
function measure(a, b, c, d) {
  # twice the area, six times the volume; reach: the square of its longest side from a
  bx = x[b] - x[a]; by = y[b] - y[a]; bz = z[b] - z[a]
  cx = x[c] - x[a]; cy = y[c] - y[a]; cz = z[c] - z[a]
  reach = bx * bx + by * by + bz * bz
  if (cx * cx + cy * cy + cz * cz > reach) reach = cx * cx + cy * cy + cz * cz
  if (!space) return bx * cy - by * cx
  dx = x[d] - x[a]; dy = y[d] - y[a]; dz = z[d] - z[a]
  if (dx * dx + dy * dy + dz * dz > reach) reach = dx * dx + dy * dy + dz * dz
  return bx * (cy * dz - cz * dy) - by * (cx * dz - cz * dx) + bz * (cx * dy - cy * dx)
}
# of a side, whatever the order of its nodes
function edgeKey(p, q) { return p < q ? p " " q : q " " p }
function faceKey(p, q, r) {
  if (p < q) return q < r ? p " " q " " r : (p < r ? p " " r " " q : r " " p " " q)
  return p < r ? q " " p " " r : (q < r ? q " " r " " p : r " " q " " p)
}
function group(dimension, tag) {
  tag = tag < 0 ? -tag : tag + 0
  return (dimension SUBSEP tag) in groupOf ? groupOf[dimension, tag] : 0
}

# an array of texts as VTK's XML has it: the numbers of their letters; texts end with a tab
function arrayOfTexts(called, texts,   n, w, k, i, line) {
  n = split(texts, w, "\t") - 1
  if (!letter[" "]) for (k = 1; k < 256; k++) letter[sprintf("%c", k)] = k
  for (k = 1; k <= n; k++) { for (i = 1; i <= length(w[k]); i++) line = line letter[substr(w[k], i, 1)] " "; line = line "0 " }
  return n < 1 ? "" : "<Array type=\"String\" Name=\"" called "\" NumberOfTuples=\"" n "\" format=\"ascii\">" line "</Array>"
}
function namesForParaview(   k, w, inside, outside, units_) {
  for (k = 1; k <= regions; k++) { split(region[k], w, " "); inside = inside k " " name[w[1]] "\t" }
  for (k = 1; k <= groups; k++) if (dimOf[k] < dim) outside = outside k " " name[k] "\t"
  if (units != "") { units_ = units "\t"; sub(/ /, "\t", units_) }
  return "<FieldData>" arrayOfTexts("units", units_) arrayOfTexts("bodies", inside) arrayOfTexts("groups", outside) "</FieldData>"
}

BEGIN {
  space = ENVIRON["SPACE"] + 0
  dim = 2 + space
  while ((getline line < ENVIRON["CASE"]) > 0 && line !~ /^groups /) if (line ~ /^units / && line !~ / none$/) units = substr(line, 7)
  groups = substr(line, 8) + 0
  for (k = 1; k <= groups; k++) {
    getline line < ENVIRON["CASE"]
    numberOf[substr(line, 1, 1), substr(line, 3)] = k
    name[k] = substr(line, 3)
    dimOf[k] = substr(line, 1, 1)
  }
  getline line < ENVIRON["CASE"]
  while ((getline line < ENVIRON["CASE"]) > 0) {
    fields = split(line, w, " ")
    if (w[1] == "contact" || w[1] == "obstacle") touched[w[3]] = touched[w[4]] = 1
    if (w[1] == "preload") cut[w[3]] = 1
    if (w[1] == "cut") readCut(w)
    else if (fields == 23 && w[1] != "to") { usesGroups(w); readMirror(w, line) }
  }
  bodyKind = space ? "tetrahedron" : "triangle"
  sideKind = space ? "triangle" : "edge"
  # type of element: dimension, corners
  split("1 8 2 9 4 11 15", types, " ")
  split("1 1 2 2 3 3 0", dims, " ")
  split("2 2 3 3 4 4 1", cornersOf, " ")
  split("2 3 3 6 4 10 1", nodesOf, " ")
  for (k = 1; k <= 7; k++) { typeAt[types[k]] = k; order[types[k]] = 1 + (types[k] ~ /^(8|9|11)$/) }
}
section == "PhysicalNames" {
  word = $0
  sub(/^[^"]*"/, "", word)
  sub(/"[^"]*$/, "", word)
  if (($1 SUBSEP word) in numberOf) groupOf[$1, $2] = numberOf[$1, word]
}
section == "Elements" {
  if (!($2 in typeAt)) element("of gmsh's type " $2 ": allowed: triangles, in space tetrahedra, of first or second order (quadrangles, bricks, prisms and pyramids of first order are cut)")
  type = typeAt[$2]
  if ($3 !~ /^[0-9]+$/ || NF != 3 + $3 + nodesOf[type]) element(NF " numbers; cut off, or more than it should have?")
  if (dims[type] > dim) element("a tetrahedron: allowed in the plane: triangles; edp/parts-3d.edp is for bodies in space")
  if (dims[type] < dim - 1) next
  g = $3 + 0 == 0 ? 0 : group(dims[type], $4)
  first = 3 + $3
  if (dims[type] == dim) {
    if (!g) element("a " bodyKind " in no body: allowed: every one in a physical " (space ? "volume" : "surface"))
    i = ++elements
    a = node($(first + 1)); b = node($(first + 2)); c = node($(first + 3)); d = space ? node($(first + 4)) : 0
    elementNumber[i] = $1
    bodyOf[i] = g
    parent[i] = i
    size_ = measure(a, b, c, d)
    small = size_ < 0 ? -size_ : size_
    if (small <= 1e-10 * reach * (space ? sqrt(reach) : 1)) element("a " bodyKind " without " (space ? "volume" : "area"))
    if (small * (space ? 1e18 / 6 : 0.5e12) < 1e-7) element("a " bodyKind " too small: another unit of length helps")
    c1[i] = a; c2[i] = size_ < 0 ? c : b; c3[i] = size_ < 0 ? b : c; c4[i] = d
    # gmsh: the middles of sides 1-2, 2-3, 3-1
    if ($2 == 9) for (k = 1; k <= 3; k++) between[edgeKey($(first + k) + 0, $(first + k % 3 + 1) + 0)] = node($(first + 3 + k))
    if (space && order[$2] == 2) nodesOfElement[i] = $0
    next
  }
  if (!space && $3 > 1) curveOf[edgeKey(node($(first + 1)), node($(first + 2)))] = $5
  if (!g) next
  s = ++sides
  for (k = 1; k <= dim; k++) side[s, k] = node($(first + k))
  sideGroup[s] = g
  sideNumber[s] = $1
  if (order[$2] == 2) {
    curved++
    # gmsh: the middles of sides 1-2, 2-3, 3-1; here each opposite a corner
    if (!space) middle[s, 1] = node($(first + 3))
    else { middle[s, 1] = node($(first + 5)); middle[s, 2] = node($(first + 6)); middle[s, 3] = node($(first + 4)) }
  }
}
function widen(p) {
  if (x[p] < lowX) lowX = x[p]
  if (x[p] > highX) highX = x[p]
  if (y[p] < lowY) lowY = y[p]
  if (y[p] > highY) highY = y[p]
  if (z[p] < lowZ) lowZ = z[p]
  if (z[p] > highZ) highZ = z[p]
}
function beside(p, q, r, v) {
  # on which side of it the corner v lies
  if (!space) return (x[q] - x[p]) * (y[v] - y[p]) - (y[q] - y[p]) * (x[v] - x[p])
  bx = x[q] - x[p]; by = y[q] - y[p]; bz = z[q] - z[p]
  cx = x[r] - x[p]; cy = y[r] - y[p]; cz = z[r] - z[p]
  return (x[v] - x[p]) * (by * cz - bz * cy) + (y[v] - y[p]) * (bz * cx - bx * cz) + (z[v] - z[p]) * (bx * cy - by * cx)
}
# element i has the side s, of nodes p, q, r, opposite its corner v: owner[s] is the one that has it too, inner[s] if there are two
function join(s, i, p, q, r, v,   j) {
  if (!(s in owner)) { owner[s] = i; tip[s] = v; return }
  j = owner[s]
  if (tip[s] == 0) fail("element " elementNumber[i] " is the third that has a side of element " elementNumber[j] ": they overlap")
  if ((beside(p, q, r, tip[s]) > 0) == (beside(p, q, r, v) > 0))
    fail("elements " elementNumber[j] " and " elementNumber[i] " lie on the same side of a common " sideKind ": they overlap")
  tip[s] = 0
  i = root(i); j = root(j)
  if (i != j) parent[i] = j
}
function joinAll(   i, a, b, c, d) {
  for (i = 1; i <= elements; i++) {
    a = c1[i]; b = c2[i]; c = c3[i]; d = c4[i]
    if (space) {
      join(faceKey(b, c, d), i, b, c, d, a)
      join(faceKey(a, c, d), i, a, c, d, b)
      join(faceKey(a, b, d), i, a, b, d, c)
      join(faceKey(a, b, c), i, a, b, c, d)
    } else {
      join(edgeKey(b, c), i, b, c, 0, a)
      join(edgeKey(a, c), i, a, c, 0, b)
      join(edgeKey(a, b), i, a, b, 0, c)
    }
  }
}
function claim(p, part) {
  if (p in partOf && partOf[p] != part)
    fail("node " p ": two pieces hang together by it alone, which is a hinge; allowed: a common " sideKind ", or nodes of their own")
  partOf[p] = part
}
function checkElements(   i, p) {
  if (!elements) fail("no " bodyKind "s")
  p = c1[1]
  lowX = highX = x[p]; lowY = highY = y[p]; lowZ = highZ = z[p]
  for (i = 1; i <= elements; i++) {
    widen(c1[i]); widen(c2[i]); widen(c3[i])
    if (space) widen(c4[i])
  }
  size = highX - lowX + highY - lowY + highZ - lowZ
  if (lowX < -1e9 * size || highX > 1e9 * size || lowY < -1e9 * size || highY > 1e9 * size || lowZ < -1e9 * size || highZ > 1e9 * size)
    fail("the bodies are too far from the origin for their size: their coordinates have no digits left")
  if (!space && (highZ > 1e-9 * size || lowZ < -1e-9 * size)) fail("z goes from " lowZ " to " highZ "; a plane mesh has z = 0 everywhere")
  joinAll()
  for (i = 1; i <= elements; i++) {
    p = root(i)
    if (!(p in partNumber)) partNumber[p] = ++parts
    part = partNumber[p]
    if (!((part, bodyOf[i]) in regionAt)) { regionAt[part, bodyOf[i]] = ++regions; region[regions] = bodyOf[i] " " part }
    inRegion[i] = regionAt[part, bodyOf[i]]
    has[bodyOf[i]] = 1
    claim(c1[i], part); claim(c2[i], part); claim(c3[i], part)
    if (space) claim(c4[i], part)
  }
}
function checkSides(   s, k, where, g) {
  checkCuts()
  for (s = 1; s <= sides; s++) {
    g = sideGroup[s]
    where = space ? faceKey(side[s, 1], side[s, 2], side[s, 3]) : edgeKey(side[s, 1], side[s, 2])
    if (!(where in owner)) fail("element " sideNumber[s] ": " sideKind " of \"" name[g] "\" that no " bodyKind " has")
    if (g in cut) {
      if (tip[where] != 0) fail("element " sideNumber[s] ": " sideKind " of the preload \"" name[g] "\" on the boundary; allowed: a cut through a body, whose elements on both sides share its nodes")
      for (k = 1; k <= dim; k++) if (!((g, side[s, k]) in onCut)) { onCut[g, side[s, k]] = 1; cutAt[++cutNodes] = g " " side[s, k] }
      has[g] = 1
      sideGroup[s] = 0
      continue
    }
    if (tip[where] == 0)
      fail("element " sideNumber[s] ": " sideKind " of \"" name[g] "\" inside the bodies, which share its nodes; allowed: each body's own nodes where they touch (no Coherence, BooleanFragments there)")
    if (!((g, where) in counted)) { counted[g, where] = 1; sidesIn[g]++ }
    has[g] = 1
    if (where in isIn) {
      if (isIn[where] != g) overlaps(s, isIn[where], g)
      sideGroup[s] = 0
      continue
    }
    isIn[where] = g
    has[g] = 1
    kept[++keptSides] = s
  }
  mergeGroups()
  splitMirrors()
  for (g = 1; g <= groups; g++) if (!(g in has)) fail("the physical group \"" name[g] "\" has no " (dimOf[g] == dim ? bodyKind : sideKind) " of a body")
}
# in the plane: the rest of the boundary, which no group of the table names
function addSide(p, q) {
  where = edgeKey(p, q)
  if (tip[where] == 0 || where in isIn) return
  s = kept[++keptSides] = ++sides
  side[s, 1] = p; side[s, 2] = q
  sideGroup[s] = groups + 1
}
function addSides(   i) {
  for (i = 1; i <= elements; i++) { addSide(c1[i], c2[i]); addSide(c2[i], c3[i]); addSide(c3[i], c1[i]) }
}
function bulges(p, q, m,   ax, ay, mx, my) {
  ax = x[q] - x[p]; ay = y[q] - y[p]
  mx = x[m] - (x[p] + x[q]) / 2; my = y[m] - (y[p] + y[q]) / 2
  return mx * mx + my * my > 1e-16 * (ax * ax + ay * ay)
}
# of all of the boundary, in the plane the triangles' own; STRAIGHT: not of straight bodies
function knowMiddles(   j, where, bent) {
  if (space) return curved == sides ? keptSides : 0
  for (j = 1; j <= keptSides; j++) {
    where = edgeKey(side[kept[j], 1], side[kept[j], 2])
    if (where in between) middle[kept[j], 1] = between[where]
    else if (!((kept[j], 1) in middle)) return 0
    if (bulges(side[kept[j], 1], side[kept[j], 2], middle[kept[j], 1])) bent = 1
  }
  return bent || !ENVIRON["STRAIGHT"] ? keptSides : 0
}
# two sides of one body in the same place, and no contact there: what is meant as one body would open
function checkCracks(   s, n, w, where) {
  for (s in owner) {
    if (tip[s] == 0 || s in isIn && isIn[s] in touched) continue
    n = split(s, w, " ")
    where = bodyOf[owner[s]] " " sprintf("%.9f %.9f %.9f", ((x[w[1]] + x[w[2]] + (space ? x[w[3]] : 0)) / n - lowX) / size,
      ((y[w[1]] + y[w[2]] + (space ? y[w[3]] : 0)) / n - lowY) / size, ((z[w[1]] + z[w[2]] + (space ? z[w[3]] : 0)) / n - lowZ) / size)
    if (where in sideAt)
      fail("elements " elementNumber[sideAt[where]] " and " elementNumber[owner[s]] " of \"" name[bodyOf[owner[s]]] \
        "\" touch, but share no nodes: a crack, or pieces not joined (in gmsh: Coherence, BooleanFragments); allowed: a contact there")
    sideAt[where] = owner[s]
  }
}
# in space: the way from the middle of an edge of the boundary to the surface's own, once each
function rise(p, q, mx, my, mz,   where) {
  where = edgeKey(p, q)
  if (where in rises) return
  rises[where] = sprintf("%d %d %.17g %.17g %.17g", now[p] - 1, now[q] - 1, (mx - (x[p] + x[q]) / 2) * 1000000,
    (my - (y[p] + y[q]) / 2) * 1000000, (mz - (z[p] + z[q]) / 2) * 1000000)
  riseAt[++risen] = rises[where]
}
function place(px, py, pz) { return sprintf("%.17g %.17g %.17g", px, py, pz) }
function bends(p, q, m,   ax, ay, az, mx, my, mz) {
  ax = x[q] - x[p]; ay = y[q] - y[p]; az = z[q] - z[p]
  mx = x[m] - (x[p] + x[q]) / 2; my = y[m] - (y[p] + y[q]) / 2; mz = z[m] - (z[p] + z[q]) / 2
  return mx * mx + my * my + mz * mz > 1e-16 * (ax * ax + ay * ay + az * az)
}
function risesOfElements(   s, w, v, i, k, n, on, ends) {
  # gmsh: its nodes behind the corners, between which corners
  split("1 2 2 3 3 1 4 1 3 4 2 4", ends, " ")
  for (s in owner) {
    if (tip[s] == 0 || !(owner[s] in nodesOfElement)) continue
    n = split(nodesOfElement[owner[s]], v, " ") - 10
    split(s, w, " ")
    split("", on)
    for (k = 1; k <= 3; k++) on[w[k]] = 1
    for (k = 1; k <= 6; k++)
      if ((v[n + ends[2 * k - 1]] in on) && (v[n + ends[2 * k]] in on)) {
        i = v[n + 4 + k]
        rise(v[n + ends[2 * k - 1]] + 0, v[n + ends[2 * k]] + 0, x[i], y[i], z[i])
      }
  }
  # inside bodies those that are curved: between materials, or moved to keep elements from folding
  for (s in nodesOfElement) {
    n = split(nodesOfElement[s], v, " ") - 10
    for (k = 1; k <= 6; k++)
      if (bends(v[n + ends[2 * k - 1]] + 0, v[n + ends[2 * k]] + 0, v[n + 4 + k] + 0)) {
        i = v[n + 4 + k] + 0
        rise(v[n + ends[2 * k - 1]] + 0, v[n + ends[2 * k]] + 0, x[i], y[i], z[i])
      }
  }
}
function edgeThere(a, b) { return a < b ? a " " b : b " " a }
# gmsh may cut extruded quadrangles along the other diagonal: its middle is that of the one that is there
function risesOfSurface(   line, v, n, part, here, at, facing, across, px, py, pz, s, w, k, e, i) {
  while ((getline line < ENVIRON["SURFACE"]) > 0) {
    n = split(line, v, " ")
    if (substr(line, 1, 1) == "$") part = v[1]
    else if (part == "$Nodes" && n == 4) { here[v[1]] = place(v[2] + 0, v[3] + 0, v[4] + 0); px[v[1]] = v[2]; py[v[1]] = v[3]; pz[v[1]] = v[4] }
    else if (part == "$Elements" && v[2] == 9)
      for (k = 1; k <= 3; k++) {
        e = edgeThere(here[v[n - 6 + k]], here[v[n - 6 + k % 3 + 1]])
        i = here[v[n - 6 + (k + 1) % 3 + 1]]
        at[e] = v[n - 3 + k]
        # of one surface of the geometry
        if ((v[5] " " e) in facing) across[edgeThere(facing[v[5] " " e], i)] = at[e]
        facing[v[5] " " e] = i
      }
  }
  for (s in owner) {
    if (tip[s] == 0) continue
    split(s, w, " ")
    for (k = 1; k <= 3; k++) {
      e = edgeThere(place(x[w[k]], y[w[k]], z[w[k]]), place(x[w[k % 3 + 1]], y[w[k % 3 + 1]], z[w[k % 3 + 1]]))
      if (e in at) i = at[e]
      else if (e in across) i = across[e]
      else continue
      rise(w[k] + 0, w[k % 3 + 1] + 0, px[i], py[i], pz[i])
    }
  }
}
function spot(p) { return sprintf("%.17g %.17g %.17g", x[p] * 1000000, y[p] * 1000000, (space ? z[p] : 0) * 1000000) }
function write(   i, j, k, n, m, w, line, mesh, middles, known) {
  mesh = ENVIRON["MESH"]
  middles = ENVIRON["MIDDLES"]
  known = knowMiddles()
  for (k = 1; k <= nodes; k++) if (inOrder[k] in partOf) now[inOrder[k]] = ++n
  print "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n" n > mesh
  for (k = 1; k <= nodes; k++) if (inOrder[k] in now) print now[inOrder[k]], spot(inOrder[k]) > mesh
  print "$EndNodes\n$Elements\n" keptSides + elements > mesh
  for (j = 1; j <= keptSides; j++) {
    i = kept[j]
    line = ++m " " (space ? 2 : 1) " 2 " sideGroup[i] " " sideGroup[i]
    for (k = 1; k <= dim; k++) line = line " " now[side[i, k]]
    print line > mesh
    if (!space) print curveOf[edgeKey(side[i, 1], side[i, 2])] + 0 > ENVIRON["CURVES"]
    if (known) {
      line = spot(middle[i, 1])
      if (space) line = line " " spot(middle[i, 2]) " " spot(middle[i, 3])
      print line > middles
    }
  }
  for (i = 1; i <= elements; i++) {
    line = ++m " " (space ? 4 : 2) " 2 " inRegion[i] " " inRegion[i]
    print line " " now[c1[i]] " " now[c2[i]] " " now[c3[i]] (space ? " " now[c4[i]] : "") > mesh
  }
  print "$EndElements" > mesh
  print "named " namesForParaview() "\nregions " regions > ENVIRON["REGIONS"]
  for (k = 1; k <= regions; k++) print region[k] > ENVIRON["REGIONS"]
  if (space) risesOfElements()
  if (ENVIRON["SURFACE"] != "") risesOfSurface()
  if (space) print risen + 0 > ENVIRON["RISES"]
  for (k = 1; k <= risen; k++) print riseAt[k] > ENVIRON["RISES"]
  checkBulges()
  print "parts " parts "\nmiddles " known > ENVIRON["REGIONS"]
  writeMerged()
  print "cuts " cutNodes + 0 > ENVIRON["REGIONS"]
  for (k = 1; k <= cutNodes; k++) { split(cutAt[k], w, " "); print w[1], now[w[2]] - 1 > ENVIRON["REGIONS"] }
}
END {
  complete()
  checkElements()
  checkSides()
  checkCracks()
  if (!space) addSides()
  write()
}
