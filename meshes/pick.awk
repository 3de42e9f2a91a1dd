# pick.awk: the groups and sizes that a case file picks of a geometry, as gmsh is told them:
#        PICKS=FILE SPACE=0|1 CASE=NAME CAD=0|1 MESHED=0|1 APART=FILE KEPT=FILE PARENTS=FILE LEFT=FILE FACES=FILE LC_ALL=C
#        TABLE=FILE TOUCH=FILE CLOSER=FILE WHOLE=FILE awk -f pick.awk -f near.awk -f cad.awk -f kinds.awk -f touch.awk < OUTLINE.msh
# Needs: OUTLINE.msh, a coarse mesh of all faces (in the plane curves), of second order, in gmsh's text format 4.1, its entities in
#        it; PICKS, of case/reader/rows.py, may be missing; CASE, the case file as the user named it; CAD: 1 of a geometry without
#        names, whose bodies are left out where no group has them; MESHED: 1 of a mesh, which has its sizes.
# Gives: on standard output a .geo file to be read after the geometry: its groups and sizes, exit code 0;  APART, if bodies that
#        "between" names share faces: a .geo file that gives each its own; if bodies are cut or joined, one that does this, and
#        KEPT, what was picked before (cad.awk); exit code 4: the outline is to be made again with it;  CLOSER, and exit code 5:
#        the outline is to be made again, closer to the curves (near.awk);  LEFT: the bodies that are left out;  FACES: triangles (in the plane segments) of the outline with the numbers of
#        their faces and bodies, for a picture;  or one line that says what is wrong, exit code 1.
# What is decided here is which numbers are meant; shapes are gmsh's: its outline is as near to them as quadratic elements are.
# "near" and "between" compare places of these, "box" and "plane" all nodes of a face.
function no(line, what) {
  print "-case " ENVIRON["CASE"] ", line " line ": " what
  failed = 1
  exit 1
}
BEGIN {
  space = ENVIRON["SPACE"] + 0
  dim = 2 + space
  many[1] = "curves"; many[2] = space ? "faces" : "surfaces"; many[3] = "volumes"
}
/^\$/ { section = $1; row = block = 0; next }
section == "$PhysicalNames" && ++row > 1 {
  name = $0
  sub(/^[^"]*"/, "", name)
  sub(/"[^"]*$/, "", name)
  named[$1, $2] = name
}
section == "$Entities" {
  if (++row == 1) { ends[0] = 1; for (k = 1; k <= 4; k++) ends[k] = ends[k - 1] + $k; next }
  for (d = 0; row > ends[d + 1]; d++);
  if (d < dim - 1 || d > dim) next
  entities[d] = entities[d] " " $1
  isThere[d, $1] = 1
  if (d == dim && $1 > greatest) greatest = $1
  at = 8
  n = $at
  for (k = 1; k <= n; k++) { t = $(at + k); if ((d SUBSEP t) in named) add(named[d, t], d, $1) }
  at += n + 1
  n = $at
  for (k = 1; k <= n && d == dim; k++) {
    t = $(at + k)
    if (t < 0) t = -t
    around[$1] = around[$1] " " t
    sidesOf[t] = sidesOf[t] " " $1
    if (!(t in bodyOf)) bodyOf[t] = $1
    else if (bodyOf[t] != $1) { shared++; sharedBy[shared] = bodyOf[t] " " $1 }
  }
}
# rows of a block: its nodes' numbers, then their places
section == "$Nodes" {
  if (++row == 1) next
  if (block == 0) { block = 2 * $4; half = $4; next }
  if (block > half) tag[2 * half - block] = $1
  else { k = tag[half - block]; x[k] = $1; y[k] = $2; z[k] = $3; widen(0, $1); widen(1, $2); widen(2, $3) }
  block--
}
section == "$Elements" {
  if (++row == 1) next
  if (block == 0) { block = $4; onDim = $1; entity = $2; type = $3; next }
  block--
  if (onDim != dim - 1) next
  if (type ~ /^(3|10|16)$/) { quadrangles = 1; next }
  if (type !~ (space ? "^(2|9)$" : "^(1|8)$")) next
  e = ++elements
  face[e] = entity
  last[entity] = e
  if (!(entity in first)) first[entity] = e
  place(e, 0, $2)
  place(e, 1, $3)
  if (space) place(e, 2, $4)
  n = space ? 4 : 3
  if (type ~ /^[12]$/) straight[e] = 1
  if (type == 9) { place(e, 3, $5); place(e, 4, $6); place(e, 5, $7) }
  else if (type == 8) place(e, 2, $4)
  else if (space) { middle(e, 3, 0, 1); middle(e, 4, 1, 2); middle(e, 5, 2, 0) }
  else middle(e, 2, 0, 1)
}
function widen(k, v) {
  if (!(k in low) || v < low[k]) low[k] = v + 0
  if (!(k in high) || v > high[k]) high[k] = v + 0
}
function add(name, d, number) {
  if (index(members[d, name] " ", " " number " ")) return
  members[d, name] = members[d, name] " " number
}
# pieces of faces: corners, then middles of sides (01, 12, 20; of a curve 01)
function place(e, k, node) { X[e, k] = x[node]; Y[e, k] = y[node]; Z[e, k] = z[node] }
function middle(e, k, a, b) { X[e, k] = (X[e, a] + X[e, b]) / 2; Y[e, k] = (Y[e, a] + Y[e, b]) / 2; Z[e, k] = (Z[e, a] + Z[e, b]) / 2 }
# a place of quadratic element p as a mixture of its nodes: weights w[0 ... ]
function mix(p, q, k, a, b, c, d, f, g) {
  X[q, k] = a * X[p, 0] + b * X[p, 1] + (space ? c * X[p, 2] + d * X[p, 3] + f * X[p, 4] + g * X[p, 5] : c * X[p, 2])
  Y[q, k] = a * Y[p, 0] + b * Y[p, 1] + (space ? c * Y[p, 2] + d * Y[p, 3] + f * Y[p, 4] + g * Y[p, 5] : c * Y[p, 2])
  Z[q, k] = a * Z[p, 0] + b * Z[p, 1] + (space ? c * Z[p, 2] + d * Z[p, 3] + f * Z[p, 4] + g * Z[p, 5] : c * Z[p, 2])
}
# its four (of a curve two) parts, again quadratic: children[1 ... ]
function split_(p,   q) {
  if (p in parts) return parts[p]
  parts[p] = pieces + 1
  pieces += space ? 4 : 2
  q = parts[p]
  if (!space) {
    mix(p, q, 0, 1, 0, 0); mix(p, q, 1, 0, 0, 1); mix(p, q, 2, 0.375, -0.125, 0.75)
    mix(p, q + 1, 0, 0, 0, 1); mix(p, q + 1, 1, 0, 1, 0); mix(p, q + 1, 2, -0.125, 0.375, 0.75)
    face[q] = face[q + 1] = face[p]
    return q
  }
  # the corners' ones: with corners a, middles of the sides beside it
  mix(p, q, 0, 1, 0, 0, 0, 0, 0); mix(p, q, 1, 0, 0, 0, 1, 0, 0); mix(p, q, 2, 0, 0, 0, 0, 0, 1)
  mix(p, q, 3, 0.375, -0.125, 0, 0.75, 0, 0); mix(p, q, 4, 0, -0.125, -0.125, 0.5, 0.25, 0.5); mix(p, q, 5, 0.375, 0, -0.125, 0, 0, 0.75)
  mix(p, q + 1, 0, 0, 0, 0, 1, 0, 0); mix(p, q + 1, 1, 0, 1, 0, 0, 0, 0); mix(p, q + 1, 2, 0, 0, 0, 0, 1, 0)
  mix(p, q + 1, 3, -0.125, 0.375, 0, 0.75, 0, 0); mix(p, q + 1, 4, 0, 0.375, -0.125, 0, 0.75, 0); mix(p, q + 1, 5, -0.125, 0, -0.125, 0.5, 0.5, 0.25)
  mix(p, q + 2, 0, 0, 0, 0, 0, 0, 1); mix(p, q + 2, 1, 0, 0, 0, 0, 1, 0); mix(p, q + 2, 2, 0, 0, 1, 0, 0, 0)
  mix(p, q + 2, 3, -0.125, -0.125, 0, 0.25, 0.5, 0.5); mix(p, q + 2, 4, 0, -0.125, 0.375, 0, 0.75, 0); mix(p, q + 2, 5, -0.125, 0, 0.375, 0, 0, 0.75)
  mix(p, q + 3, 0, 0, 0, 0, 1, 0, 0); mix(p, q + 3, 1, 0, 0, 0, 0, 1, 0); mix(p, q + 3, 2, 0, 0, 0, 0, 0, 1)
  mix(p, q + 3, 3, -0.125, 0, -0.125, 0.5, 0.5, 0.25); mix(p, q + 3, 4, -0.125, -0.125, 0, 0.25, 0.5, 0.5); mix(p, q + 3, 5, 0, -0.125, -0.125, 0.5, 0.25, 0.5)
  face[q] = face[q + 1] = face[q + 2] = face[q + 3] = face[p]
  return q
}
# a ball around a piece: centre, its middle on the surface; radius
function ball(p,   k, r) {
  if (p in reach) return
  middleOf(X, CX, p); middleOf(Y, CY, p); middleOf(Z, CZ, p)
  for (k = 0; k < (space ? 6 : 3); k++) {
    r = sqrt((X[p, k] - CX[p]) ^ 2 + (Y[p, k] - CY[p]) ^ 2 + (Z[p, k] - CZ[p]) ^ 2)
    if (r > reach[p]) reach[p] = r
  }
}
function middleOf(V, C, p) {
  C[p] = space ? (4 * (V[p, 3] + V[p, 4] + V[p, 5]) - V[p, 0] - V[p, 1] - V[p, 2]) / 9 : V[p, 2]
}
# from a place to the flat piece between the corners of p
function away(px, py, pz, p,   ax, ay, az, bx, by, bz, qx, qy, qz, aa, ab, bb, qa, qb, det, u, v, t, best, d, k) {
  ax = X[p, 1] - X[p, 0]; ay = Y[p, 1] - Y[p, 0]; az = Z[p, 1] - Z[p, 0]
  qx = px - X[p, 0]; qy = py - Y[p, 0]; qz = pz - Z[p, 0]
  aa = ax * ax + ay * ay + az * az
  qa = qx * ax + qy * ay + qz * az
  if (!space) return toSegment(qx, qy, qz, ax, ay, az)
  bx = X[p, 2] - X[p, 0]; by = Y[p, 2] - Y[p, 0]; bz = Z[p, 2] - Z[p, 0]
  ab = ax * bx + ay * by + az * bz; bb = bx * bx + by * by + bz * bz
  qb = qx * bx + qy * by + qz * bz
  det = aa * bb - ab * ab
  u = det > 0 ? (qa * bb - qb * ab) / det : -1
  v = det > 0 ? (qb * aa - qa * ab) / det : -1
  if (u >= 0 && v >= 0 && u + v <= 1) {
    qx -= u * ax + v * bx; qy -= u * ay + v * by; qz -= u * az + v * bz
    return sqrt(qx * qx + qy * qy + qz * qz)
  }
  best = toSegment(qx, qy, qz, ax, ay, az)
  d = toSegment(qx, qy, qz, bx, by, bz)
  if (d < best) best = d
  d = toSegment(qx - ax, qy - ay, qz - az, bx - ax, by - ay, bz - az)
  return d < best ? d : best
}
function toSegment(qx, qy, qz, ax, ay, az,   t) {
  t = (qx * ax + qy * ay + qz * az) / (ax * ax + ay * ay + az * az + 1e-300)
  t = t < 0 ? 0 : (t > 1 ? 1 : t)
  qx -= t * ax; qy -= t * ay; qz -= t * az
  return sqrt(qx * qx + qy * qy + qz * qz)
}
# the pieces of some faces into list[1 ...]: how many
function piecesOf(numbers, list,   n, w, k, e, count) {
  n = split(numbers, w, " ")
  for (k = 1; k <= n; k++)
    for (e = first[w[k]]; e != "" && e <= last[w[k]]; e++) if (face[e] == w[k]) list[++count] = e
  return count + 0
}
# distance to an obstacle's rigid shape, from outside or inside
function toShape(s, px, py, pz,   qx, qy, qz, n, t) {
  qx = px - s[2]; qy = py - s[3]; qz = pz - s[4]
  n = sqrt(s[5] * s[5] + s[6] * s[6] + s[7] * s[7])
  if (s[1] == "plane" || s[1] == "cylinder") t = (qx * s[5] + qy * s[6] + qz * s[7]) / n
  if (s[1] == "plane") return t < 0 ? -t : t
  if (s[1] == "cylinder") { qx -= t * s[5] / n; qy -= t * s[6] / n; qz -= t * s[7] / n }
  t = sqrt(qx * qx + qy * qy + qz * qz) - s[8]
  return t < 0 ? -t : t
}
function ofBodies(numbers,   n, w, k, all) {
  n = split(numbers, w, " ")
  for (k = 1; k <= n; k++) all = all around[w[k]]
  return all
}
# do all corners and middles of a face, or of a body's faces, lie there?
function within(numbers, how, v,   list, n, i, k, e, t, size, inside) {
  n = piecesOf(numbers, list)
  if (!n) return 0
  size = 1e-6 * diagonal
  for (i = 1; i <= n; i++)
    for (k = 0; k < (space ? 6 : 3); k++) {
      e = list[i]
      if (how == "plane") {
        t = (X[e, k] - v[1]) * v[4] + (Y[e, k] - v[2]) * v[5] + (Z[e, k] - v[3]) * v[6]
        t /= sqrt(v[4] * v[4] + v[5] * v[5] + v[6] * v[6])
        inside = t < size && t > -size
      } else inside = isBetween(X[e, k], v[1], v[4], size) && isBetween(Y[e, k], v[2], v[5], size) && (!space || isBetween(Z[e, k], v[3], v[6], size))
      if (!inside) return 0
    }
  return 1
}
function isBetween(t, a, b, size) { return a < b ? t > a - size && t < b + size : t > b - size && t < a + size }
# how far the middles of a piece's sides are off their chords
function bow(p,   k, a, b, t, most) {
  for (k = 0; k < (space ? 3 : 1); k++) {
    a = space ? 3 + k : 2
    b = (k + 1) % 3
    t = (X[p, a] - (X[p, k] + X[p, b]) / 2) ^ 2 + (Y[p, a] - (Y[p, k] + Y[p, b]) / 2) ^ 2 + (Z[p, a] - (Z[p, k] + Z[p, b]) / 2) ^ 2
    if (t > most) most = t
  }
  return sqrt(most)
}
# the distance of a place from piece p, to what pieces that are `flat` lack, if it is less than `best`, else that
function closest(p, v, best,   r, n, t) {
  ball(p)
  if (sqrt((CX[p] - v[1]) ^ 2 + (CY[p] - v[2]) ^ 2 + (CZ[p] - v[3]) ^ 2) - reach[p] > best) return best
  if (bow(p) < flat) { t = away(v[1], v[2], v[3], p); return t < best ? t : best }
  n = split_(p) + (space ? 3 : 1)
  for (r = parts[p]; r <= n; r++) best = closest(r, v, best)
  return best
}
function ofBody(d, number) { return d < dim && (number in bodyOf) ? number " of body " parent(bodyOf[number]) : number }
function shortly(t) { return sprintf("%.6g", t) }
# what is nearest to a place; refused if another is as near, to what quadratic pieces leave of a curved surface
function nearestTo(d, v, line,   n, w, k, list, m, i, t, best, found, own, slack, other) {
  n = split(entities[d], w, " ")
  best = 1e300
  flat = 1e-6 * diagonal
  pieces = pieces < elements ? elements : pieces
  for (k = 1; k <= n; k++) {
    split("", list)
    m = piecesOf(d == dim ? ofBodies(w[k]) : w[k], list)
    own[w[k]] = best + 1e-3 * diagonal
    for (i = 1; i <= m; i++) {
      t = closest(list[i], v, own[w[k]])
      if (t < own[w[k]]) { own[w[k]] = t; slack[w[k]] = 1e-6 * diagonal + (bow(list[i]) > 0 ? 1e-4 * reach[list[i]] : 0) }
    }
    if (own[w[k]] < best) { best = own[w[k]]; found = w[k] }
  }
  for (k = 1; k <= n; k++)
    if (w[k] != found && own[w[k]] < best + slack[found] + slack[w[k]]) other = other " and " ofBody(d, w[k])
  if (other != "") no(line, "near " shortly(v[1]) " " shortly(v[2]) (space ? " " shortly(v[3]) : "") ": the " many[d] " " ofBody(d, found) other " are equally near; allowed: a place nearer to one of them, " many[d] " and its number" (d < dim ? ", between BODY BODY" : ""))
  return found
}
# the faces of some bodies that lie on others; where none does, the nearest: by the middles of their pieces
function between(a, b,   list, B, n, nb, i, j, e, r, d, best, least, found, meets, off, play) {
  n = piecesOf(ofBodies(a), list)
  nb = piecesOf(ofBodies(b), B)
  for (j = 1; j <= nb; j++) ball(B[j])
  least = 1e300
  for (i = 1; i <= n; i++) {
    e = list[i]
    ball(e)
    best = 1e300
    for (j = 1; j <= nb; j++) {
      r = B[j]
      d = best + reach[r]
      if ((CX[e] - CX[r]) ^ 2 + (CY[e] - CY[r]) ^ 2 + (CZ[e] - CZ[r]) ^ 2 > d * d) continue
      d = away(CX[e], CY[e], CZ[e], r)
      if (d < best) { best = d; next_ = r }
    }
    off[i] = along(e, next_) ? best : 1e300
    play[i] = 1e-4 * diagonal + 1.2 * (bow(e) + bow(next_))
    if (off[i] < play[i]) meets = 1
    if (off[i] < least) least = off[i]
  }
  lie_ = meets
  for (i = 1; i <= n; i++)
    if (off[i] < (meets ? 0 : least + 1e-3 * diagonal) + play[i] && index(found " ", " " face[list[i]] " ") == 0) found = found " " face[list[i]]
  return found
}
# do two pieces face each other, within 45 degrees?
function along(e, f,   n, m, k) {
  normal(e, ne); normal(f, nf)
  k = ne[0] * nf[0] + ne[1] * nf[1] + ne[2] * nf[2]
  return k * k > 0.5
}
function normal(e, n,   ax, ay, az, bx, by, bz, l) {
  ax = X[e, 1] - X[e, 0]; ay = Y[e, 1] - Y[e, 0]; az = Z[e, 1] - Z[e, 0]
  if (space) { bx = X[e, 2] - X[e, 0]; by = Y[e, 2] - Y[e, 0]; bz = Z[e, 2] - Z[e, 0] } else { bx = by = 0; bz = 1 }
  n[0] = ay * bz - az * by; n[1] = az * bx - ax * bz; n[2] = ax * by - ay * bx
  l = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]) + 1e-300
  n[0] /= l; n[1] /= l; n[2] /= l
}
function numbersOf(line, d, how, text,   n, w, k, v, found, all) {
  all = entities[d]
  n = split(text, w, " ")
  if (how == "near") {
    for (k = 1; k <= 3; k++) v[k] = w[k + 1] + 0
    found = nearestTo(d, v, line)
    return found == "" ? "" : " " found
  }
  if (how == "box" || how == "plane") {
    for (k = 1; k <= 6; k++) v[k] = w[k + 1] + 0
    n = split(all, w, " ")
    for (k = 1; k <= n; k++) if (within(d == dim ? ofBodies(w[k]) : w[k], how, v)) found = found " " w[k]
    return found
  }
  for (k = 2; k <= n; k++) {
    if (d == dim && (w[k] in nowCalled)) w[k] = nowCalled[w[k]]
    if (!((d SUBSEP w[k]) in isThere)) no(line, w[k] ": no such number of " many[d] "; allowed:" listed(all))
    found = found " " w[k]
  }
  return found
}
function listed(numbers,   n, w) {
  n = split(numbers, w, " ")
  return n == 0 ? " none" : (n <= 20 ? numbers : " " w[1] " ... " w[n])
}
# of bodies that "between" names: who shares faces?
function apart(a, b, line,   k, n, w, m, v, i, j, p, other) {
  n = split(a, w, " "); m = split(b, v, " ")
  for (k = 1; k <= shared; k++) {
    split(sharedBy[k], p, " ")
    if (index(a " ", " " p[1] " ") && index(b " ", " " p[2] " ") || index(a " ", " " p[2] " ") && index(b " ", " " p[1] " ")) {
      other = index(b " ", " " p[2] " ") ? p[2] : p[1]
      if ((p[1] in taken) || (p[2] in taken)) continue
      taken[other] = 1
      toPart = toPart (toPart == "" ? "" : ", ") other
      renamed = renamed "// " other " " greatest + ++copies "\n"
    }
  }
}
function joined(numbers) { sub(/^ /, "", numbers); gsub(/ /, ", ", numbers); return numbers }
# a field of sizes, with a number that is free: field_
function field(text) { field_ = "picked" ++fields "_"; print field_ " = newf;\nField[" field_ "] = " text ";" }
function choose() { chosen = chosen (chosen == "" ? "" : ", ") field_ }
# h, and `slope` more a length, beyond `from`, away from what the last field, a distance, has
function growing(h, slope, from,   distance) {
  distance = field_
  field("MathEval"); print "Field[" field_ "].F = Sprintf(\"" sprintf("%.9g+%g*Max(0,F%%.0f-%.9g)", h, slope, from) "\", " distance ");"
}
function restricted(   inside) { inside = field_; field("Restrict"); print "Field[" field_ "].IField = " inside ";" }
# the geometry's points keep their sizes, except smaller ones of the group that is named
function atPoints(numbers, d, h,   word) {
  if (!ownSizes || ownSizes >= h) return
  word = d == 3 ? "Volume" : (d == 2 ? "Surface" : "Curve")
  print "MeshSize{ PointsOf{ " word "{" joined(numbers) "}; } } = " h ";"
}
function sizeOf(numbers, d, h,   to) {
  atPoints(numbers, d, h)
  if (d == 1 && !space) { sizeOfCurves(numbers, h); return }
  field("MathEval"); print "Field[" field_ "].F = \"" h "\";"
  restricted()
  to = d == 3 ? "RegionsList" : (d == 2 ? "FacesList" : "EdgesList")
  print "Field[" field_ "]." to " = {" joined(numbers) "};"
  # with a body its boundary, with a face its edges
  if (d == 3) print "Field[" field_ "].FacesList = {" joined(ofBodies(numbers)) "};"
  if (d == 2 && !space) print "Field[" field_ "].EdgesList = {" joined(ofBodies(numbers)) "};"
  if (d == 2 && space) print "edges_() = Abs(Boundary{ Surface{" joined(numbers) "}; });\nField[" field_ "].EdgesList = {edges_()};"
  if (d == 3) print "edges_() = Abs(Boundary{ Surface{" joined(ofBodies(numbers)) "}; });\nField[" field_ "].EdgesList = {edges_()};"
  choose()
}
# in the plane sizes grow away from a curve, in its bodies: beside a size of the curve alone gmsh leaves slivers, too stiff for a contact
function sizeOfCurves(numbers, h,   n, w, k, e, m, list, long, most, bodies) {
  n = split(numbers, w, " ")
  for (k = 1; k <= n; k++) {
    m = piecesOf(w[k], list)
    long = 0
    for (e = 1; e <= m; e++) long += sqrt((X[list[e], 1] - X[list[e], 0]) ^ 2 + (Y[list[e], 1] - Y[list[e], 0]) ^ 2)
    if (long > most) most = long
    bodies = bodies sidesOf[w[k]]
  }
  field("Distance"); print "Field[" field_ "].CurvesList = {" joined(numbers) "};"
  print "Field[" field_ "].NumPointsPerCurve = " (most > 4000 * h ? 2000 : int(most / h / 2) + 20) ";"
  growing(h, 0.5, h)
  restricted()
  if (bodies != "") print "Field[" field_ "].FacesList = {" joined(bodies) "};"
  print "Field[" field_ "].EdgesList = {" joined(numbers ofBodies(bodies)) "};"
  choose()
}
# ties have no size of contact beside contacts: their surfaces touch all over
function contactSize(h,   k, n, i, w, p, points, wide, key) {
  for (k = 1; k <= contacts; k++) {
    if (k in tied && ties < contacts) continue
    split(contact[k], w, "\t")
    i = members[dim - 1, w[1]]; p = members[dim - 1, w[2]]; key = k in obstacle ? w[2] : ""
    n = nearest(i, p, h, 0.05 * h, key)
    for (i = 1; i <= n; i++) {
      p = zone[i]
      if (widest > wide) wide = widest
      key = cellAt(p, h)
      if (key in used_) continue
      used_[key] = 1
      points++
      print "Point(zone_ + " points ") = {" sprintf("%.9g, %.9g, %.9g", CX[p], CY[p], CZ[p]) "};"
    }
  }
  if (askCloser()) exit 5
  if (!points) return
  field("Distance"); print "Field[" field_ "].PointsList = {zone_ + 1 : zone_ + " points "};"
  growing(h, 0.25, 4 * h + (wide > 4 * h ? wide : 0))
  choose()
}
function writeFaces(   e, k, n) {
  print (space ? "face,body,x0,y0,z0,x1,y1,z1,x2,y2,z2" : "face,body,x0,y0,z0,x1,y1,z1") > ENVIRON["FACES"]
  for (e = 1; e <= elements; e++) {
    line = (face[e] in wasFace ? wasFace[face[e]] : face[e]) "," parent(bodyOf[face[e]]) + 0
    for (k = 0; k < (space ? 3 : 2); k++) line = line sprintf(",%.9g,%.9g,%.9g", X[e, k], Y[e, k], Z[e, k])
    print line > ENVIRON["FACES"]
  }
}
END {
  if (failed) exit 1
  diagonal = sqrt((high[0] - low[0]) ^ 2 + (high[1] - low[1]) ^ 2 + (high[2] - low[2]) ^ 2)
  pieces = elements
  # bodies that were given faces of their own have new numbers
  while (ENVIRON["APART"] != "" && (getline line < ENVIRON["APART"]) > 0) if (split(line, f, " ") == 3 && f[1] == "//") nowCalled[f[2]] = f[3]
  close(ENVIRON["APART"])
  while (ENVIRON["PICKS"] != "" && (getline line < ENVIRON["PICKS"]) > 0) {
    split(line, f, "\t")
    if (f[1] == "group") groupLine[++groups] = line
    if (f[1] == "size") sizeLine[++sizes] = line
    if (f[1] == "cut") cutLine[++cuts] = line
    if (f[1] == "join") joinLine[++joins] = line
    if (f[1] == "contact" || f[1] == "obstacle") contact[++contacts] = f[3] "\t" f[4]
    if (f[1] == "obstacle") obstacle[contacts] = 1
    if (f[1] == "contact" && f[5] == "tie") { tied[contacts] = 1; ties++ }
  }
  if (groups && !elements) {
    split(groupLine[1], f, "\t")
    no(f[2], "the mesh has no " many[dim - 1] " with numbers; allowed: groups of the file's own, or a geometry")
  }
  if (sizes && ENVIRON["MESHED"]) {
    split(sizeLine[1], f, "\t")
    no(f[2], "sizes need a geometry; allowed: with a .geo, .step, .iges or .brep file")
  }
  # the geometry as gmsh has read it: the least size of its points, and the number of its own field of sizes
  while (ENVIRON["WHOLE"] != "" && (getline line < ENVIRON["WHOLE"]) > 0) {
    if (line ~ /^cl__[0-9]+ = /) { sub(/.*= /, "", line); if (line + 0 < 1e22 && (!ownSizes || line + 0 < ownSizes)) ownSizes = line + 0 }
    if (sub(/^Background Field = /, "", line)) { sub(/;.*/, "", line); background = ", " line }
  }
  checkCad()
  again = recall()
  if (ENVIRON["FACES"] != "") writeFaces()
  # bodies first: "between" asks for them
  for (turn = 0; turn < 2 && !again; turn++)
    for (g = 1; g <= groups; g++) {
      n = split(groupLine[g], f, "\t")
      split(f[5], w, " ")
      how = w[1]
      if ((how == "between") != turn) continue
      if (how == "between") {
        a = members[dim, f[6]]; b = members[dim, f[7]]
        if (ofBodies(a) == "" || ofBodies(b) == "") no(f[2], f[4] ": between: the file does not say which faces are a body's; allowed: with a geometry")
        apart(a, b, f[2])
        found = toPart == "" ? between(a, b) : ""
        if (toPart != "") continue
        lies[f[6], f[7]] = lie_
      } else found = numbersOf(f[2], f[3], how, f[5])
      if (found == "") no(f[2], f[4] ": " how ": no " (f[3] == dim ? "body" : (space ? "face" : "curve")) " lies there; allowed: one or more, of" listed(entities[f[3]]))
      members[f[3], f[4]] = found
    }
  if (toPart != "") {
    printf "%s", renamed > ENVIRON["APART"]
    print "SetFactory(\"OpenCASCADE\");\nold_() = {" toPart "};\nFor k_ In {0 : #old_() - 1}" > ENVIRON["APART"]
    word = space ? "Volume" : "Surface"
    print "  new_() = Translate{0, 0, 0}{ Duplicata{ " word "{old_(k_)}; } };\n  Recursive Delete{ " word "{old_(k_)}; }\nEndFor" > ENVIRON["APART"]
    exit 4
  }
  if (!again) checkTies()
  if (!again && (ENVIRON["TABLE"] != "" || ENVIRON["CAD"])) touching()
  if (!again && ENVIRON["TABLE"] != "") tell()
  if (!again && groups) warnOfTouch()
  if (!again && operate()) exit 4
  if (again) { checkJoins(); findSections(); named_() }
  kind[1] = "Curve"; kind[2] = "Surface"; kind[3] = "Volume"
  for (g = 1; g <= groups; g++) {
    split(groupLine[g], f, "\t")
    print "Physical " kind[f[3]] "(\"" f[4] "\") = {" joined(members[f[3], f[4]]) "};"
    if (f[3] == dim) { n = split(members[dim, f[4]], w, " "); for (k = 1; k <= n; k++) inGroup[w[k]] = 1 }
  }
  if (ENVIRON["CAD"]) {
    n = split(entities[dim], w, " ")
    for (k = 1; k <= n; k++) if (!(w[k] in inGroup) && !index(left " ", " " parent(w[k]) " ")) left = left " " parent(w[k])
    if (left != "") print many[dim] left > ENVIRON["LEFT"]
  }
  if (ENVIRON["CAD"]) print "Mesh.MeshSizeFromCurvature = 12;"
  print "zone_ = newp;"
  for (g = 1; g <= sizes; g++) {
    split(sizeLine[g], f, "\t")
    if (f[3] == "contact" && members[dim, "contact"] members[dim - 1, "contact"] == "") contactSize(f[4] + 0)
    else if (members[dim, f[3]] != "") sizeOf(members[dim, f[3]], dim, f[4])
    else if (members[dim - 1, f[3]] != "") sizeOf(members[dim - 1, f[3]], dim - 1, f[4])
    else no(f[2], "size " f[3] ": the geometry has nothing in the group " f[3] "; allowed: a group with a body, or with a " (space ? "face" : "curve") " of one")
  }
  if (chosen != "") {
    field("Min"); print "Field[" field_ "].FieldsList = {" chosen background "};\nBackground Field = " field_ ";"
    if (!ownSizes) print "Mesh.MeshSizeFromPoints = 0;"
  }
}
