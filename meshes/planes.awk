# planes.awk: symmetries of several planes: awk -f msh.awk -f parts.awk -f planes.awk < FILE.msh
# Needs: parts.awk's sides and groups, the statements of its TABLE.
# Gives: readMirror(w, line): one statement;  splitMirrors(): what such a group has in each plane becomes a group of its own, "NAME 1",
#        "NAME 2" and so on by its outward normal, and TABLE has the statement once for each; NOTES, a file, has a line for each such
#        group;  checkBulges(): the sides of these groups are flat themselves. Planes that meet turn by 45 degrees or more: less is a
#        curved surface, which is refused. So is such a group that another statement uses.
function readMirror(w, line) {
  if (w[1] == "symmetry") { mirrorRow[w[3]] = line; mirrorLine[w[3]] = w[2]; calledBefore[w[3]] = name[w[3]] }
  else { usedIn[w[3]] = w[2]; usedIn[w[4]] = w[2] }
}
function mirror(g, why) { fail("symmetry \"" calledBefore[g] "\" of the case file, line " mirrorLine[g] ": " why) }
function bent(g, s, how) {
  mirror(g, "curved" how " at (" corner(s) "); allowed: a flat group, or one in several planes that meet at 45 degrees or more")
}
# n1, n2, n3: the unit normal of side s, out of its body
function outward(s,   p, q, r, l) {
  p = side[s, 1]; q = side[s, 2]; r = side[s, 3]
  n1 = y[q] - y[p]; n2 = x[p] - x[q]; n3 = 0
  if (space) {
    beside(p, q, r, p)
    n1 = by * cz - bz * cy; n2 = bz * cx - bx * cz; n3 = bx * cy - by * cx
  }
  l = sqrt(n1 * n1 + n2 * n2 + n3 * n3)
  if (off(tip[space ? faceKey(p, q, r) : edgeKey(p, q)], p) > 0) l = -l
  n1 /= l; n2 /= l; n3 /= l
}
# how far node p is off the plane through node q with this normal
function off(p, q) { return (x[p] - x[q]) * n1 + (y[p] - y[q]) * n2 + (space ? (z[p] - z[q]) * n3 : 0) }
function cosine(g, k) { return n1 * facing[g, k, 1] + n2 * facing[g, k, 2] + n3 * facing[g, k, 3] }
# the plane of group g that side s lies in, to 1e-4
function planeOf(s, g,   k, h) {
  outward(s)
  for (k = 1; k <= many[g]; k++) {
    h = off(side[s, 1], aPlace[g, k]) / size
    if (cosine(g, k) ^ 2 > 1 - 1e-8 && h * h < 1e-8) return k
  }
  many[g] = k
  aPlace[g, k] = side[s, 1]
  facing[g, k, 1] = n1; facing[g, k, 2] = n2; facing[g, k, 3] = n3
  return k
}
# side s of plane k has the corner or edge `at`: no other plane meets it there at a small angle
function meet(at, s, g, k,   j, c) {
  for (j = 1; j <= many[g]; j++)
    if (j != k && (g, at, j) in meets && (c = cosine(g, j)) > 0.7072)
      bent(g, s, ", by " sprintf("%.3g", atan2(sqrt(1 - c * c), c) * 57.29578) " degrees")
  meets[g, at, k] = 1
}
# does plane k of group g stand before plane l: by the normal's x, then y, z
function before(g, k, l,   c, d) {
  for (c = 1; c <= 3; c++) {
    d = facing[g, k, c] - facing[g, l, c]
    if (d > 1e-6 || d < -1e-6) return d > 0
  }
  return k < l
}
function short(t) { return sprintf("%.4g", t * t < 1e-12 ? 0 : t) }
function splitGroup(g,   j, k, l, note) {
  if (g in usedIn) mirror(g, "in " many[g] " planes, and line " usedIn[g] " uses this group too; allowed: a group for each plane")
  for (k = 1; k <= many[g]; k++) {
    for (j = l = 1; l <= many[g]; l++) if (l != k && before(g, l, k)) j++
    inPlace[j] = k
  }
  for (j = 1; j <= many[g]; j++) {
    k = inPlace[j]
    l = splitTo[g, k] = j == 1 ? g : groups + j - 1
    name[l] = calledBefore[g] " " j
    dimOf[l] = dim - 1; has[l] = 1
    if (j > 1) moreRows[++more] = l " " mirrorRow[g]
    note = note (j == 1 ? " " : (j < many[g] ? ", " : " and ")) name[l] " with the normal (" short(facing[g, k, 1]) ", " short(facing[g, k, 2]) (space ? ", " short(facing[g, k, 3]) : "") ")"
  }
  groups += many[g] - 1
  notes = notes "\nsymmetry " calledBefore[g] " of line " mirrorLine[g] " is in " many[g] " planes:" note
}
function splitMirrors(   j, s, g, k, l, own) {
  for (j = 1; j <= keptSides; j++) {
    s = kept[j]
    if (sideGroup[s] in mirrorRow) planeOfSide[s] = planeOf(s, sideGroup[s])
  }
  for (j = 1; j <= keptSides; j++) {
    s = kept[j]
    g = sideGroup[s]
    if (many[g] < 2) continue
    outward(s)
    for (l = 1; l <= dim; l++) meet(space ? edgeKey(side[s, l], side[s, l % 3 + 1]) : side[s, l], s, g, planeOfSide[s])
  }
  own = groups
  for (g = 1; g <= own; g++) if (many[g] > 1) splitGroup(g)
  for (j = 1; j <= keptSides; j++) {
    s = kept[j]
    g = sideGroup[s]
    if (many[g] < 2) continue
    splitOf[s] = g
    sideGroup[s] = splitTo[g, planeOfSide[s]]
  }
  print gsub(/\n/, "&", notes) notes > ENVIRON["NOTES"]
  if (more) writeTable()
}
function writeTable(   n, k, l, w, line, rows) {
  close(ENVIRON["CASE"])
  while ((getline line < ENVIRON["CASE"]) > 0) rows[++n] = line
  close(ENVIRON["CASE"])
  for (k = 1; k <= n; k++) {
    if (rows[k] ~ /^files /) for (l = 1; l <= more; l++) {
      split(moreRows[l], w, " ")
      sub(/^[0-9]+ /, "", moreRows[l])
      sub(/^symmetry [0-9]+ [0-9]+/, "symmetry " w[3] " " w[1], moreRows[l])
      print moreRows[l] > ENVIRON["CASE"]
    }
    if (rows[k] ~ /^groups /) {
      print "groups " groups > ENVIRON["CASE"]
      for (l = 1; l <= groups; l++) print dimOf[l] " " name[l] > ENVIRON["CASE"]
      k += groups - more
    } else print (rows[k] ~ /^statements / ? "statements " substr(rows[k], 12) + more : rows[k]) > ENVIRON["CASE"]
  }
  close(ENVIRON["CASE"])
}
# no middle of an edge is off the plane
function checkBulges(   j, s, l, p, q, e, w, h) {
  for (j = 1; j <= keptSides; j++) {
    s = kept[j]
    if (!(s in splitOf)) continue
    outward(s)
    for (l = 1; l < dim * 2 - 2; l++) {
      p = side[s, l]; q = side[s, l % 3 + 1]
      h = 0
      if (space && (edgeKey(p, q) in rises)) { split(rises[edgeKey(p, q)], w, " "); h = (w[3] * n1 + w[4] * n2 + w[5] * n3) / 1000000 }
      if (!space && ((s, 1) in middle)) h = off(middle[s, 1], p)
      if (h * h > 1e-6 * ((x[p] - x[q]) ^ 2 + (y[p] - y[q]) ^ 2 + (space ? (z[p] - z[q]) ^ 2 : 0))) bent(splitOf[s], s, "")
    }
  }
}
