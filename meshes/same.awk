# same.awk: groups of a case that share sides, as one surface in several contacts: awk -f msh.awk -f parts.awk -f same.awk < FILE.msh
# Needs: parts.awk's sides and groups, the statements of its TABLE.
# Gives: usesGroups(w): one statement;  overlaps(s, g, h): side s is in both groups;  mergeGroups(): such groups become one, sameAs[g],
#        if contacts alone use them and nothing else changes: all have the same sides, or all are masters only. A master of more sides
#        than one contact needs is no other contact: each point meets what is opposite. Otherwise a refusal.
function usesGroups(w) {
  if (w[1] == "contact" || w[1] == "obstacle") {
    slaveIn[w[3]] = 1
    if (w[1] == "contact") { pairs++; pairOf[pairs] = w[3] " " w[4]; pairLine[pairs] = w[2] }
  } else { if (w[3]) otherIn[w[3]] = 1; if (w[4]) otherIn[w[4]] = 1 }
}
function overlaps(s, g, h,   key) {
  key = g < h ? g SUBSEP h : h SUBSEP g
  if (!(key in common)) { commonSide[key] = s; shares[++sharing] = key }
  common[key]++
}
# a corner of a side, in the user's lengths
function corner(s) { return sprintf(space ? "%.4g, %.4g, %.4g" : "%.4g, %.4g", x[side[s, 1]], y[side[s, 1]], z[side[s, 1]]) }
function one(g) { while (g in sameAs) g = sameAs[g]; return g }
function mergeGroups(   k, p, g, h, w, v, same) {
  for (k = 1; k <= sharing; k++) {
    split(shares[k], p, SUBSEP)
    g = p[1]; h = p[2]
    same = common[shares[k]] == sidesIn[g] && common[shares[k]] == sidesIn[h]
    if ((g in otherIn) || (h in otherIn) || !same && ((g in slaveIn) || (h in slaveIn)))
      fail("element " sideNumber[commonSide[shares[k]]] ": " sideKind " in two physical groups of the case, \"" name[g] "\" and \"" name[h] "\", which share " common[shares[k]] " of their " sidesIn[g] " and " sidesIn[h] ", this one at (" corner(commonSide[shares[k]]) "); allowed: one of them, or two that only contacts use, with the same sides or as masters; group ... plane and box take the sides of all bodies there, near, between and numbers those of one")
    g = one(g); h = one(h)
    if (g != h) sameAs[g > h ? g : h] = g > h ? h : g
  }
  for (g in sameAs) merged++
  if (!merged) return
  for (k = 1; k <= pairs; k++) {
    split(pairOf[k], w, " ")
    g = one(w[1]); h = one(w[2])
    if (g == h) fail("contact of \"" name[w[1]] "\" and \"" name[w[2]] "\" (line " pairLine[k] " of the case file): both are the same surface; allowed: two surfaces")
    v = g < h ? g " " h : h " " g
    if (v in pairSeen) fail("contact of \"" name[w[1]] "\" and \"" name[w[2]] "\" (line " pairLine[k] " of the case file): the same surfaces as in line " pairSeen[v] "; allowed: once")
    pairSeen[v] = pairLine[k]
  }
  for (k = 1; k <= keptSides; k++) sideGroup[kept[k]] = one(sideGroup[kept[k]])
}
function writeMerged(   g) {
  print "same " merged + 0 > ENVIRON["REGIONS"]
  for (g = 1; g <= groups; g++) if (g in sameAs) print g, one(g) > ENVIRON["REGIONS"]
}
