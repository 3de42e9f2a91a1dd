# case-cad.awk: cuts through bodies, and bodies of a geometry that touch: one part, a tie or a contact
# Read by awk before case-file.awk, whose functions it uses. A cut becomes the statement "cut" of the table: the group of the cut, the
# body, a point of the plane (3) and its normal (3); meshes/cuts.awk finds its sides in the mesh. A join that is a tie or a contact
# becomes that statement, between the faces of each body that lie on the other. The groups of these faces are called A-B and B-A.
# PICKS, for meshes/pick.awk: cut, line, name, body, point and normal; join, line, both bodies, part, tie or contact.

# cut NAME BODY plane x y [z] nx ny [nz]
function readCut(   name, g, b, v, k, text) {
  name = words > 1 ? word[2] : ""
  g = group(dim - 1)
  once("cut" SUBSEP g, "cut " name)
  if ((dim - 1 SUBSEP name) in inFile) no(name ": the mesh or geometry has a group of this name; allowed: another name")
  if (name in pickedBy) no(name ": a group of this name in line " pickedBy[name] "; allowed: another name")
  b = group(dim)
  keyword("plane")
  vector("the point of the plane", 0, v, 0)
  vector("the normal", 0, v, 3)
  nonzero("the normal", v, 3)
  if (axial && v[3] != 0) no("cut " name ": a plane that is not across the axis cuts no ring flat; allowed with state axisymmetric: a normal 0 1")
  cutIn[g] = FNR
  for (k = 0; k < 6; k++) text = text "\t" sprintf("%.17g", v[k])
  pick("cut\t" FNR "\t" name "\t" word[3] text)
  row("cut " FNR " " g " " b " none none none", v)
}
# join A B part, tie or contact: the groups of their faces are known since readAhead()
function readJoin(   a, b, how) {
  a = known(dim)
  b = known(dim)
  if (a == b) no(a ": twice the same body; allowed: two bodies")
  how = at < words ? word[++at] : ""
  if (how !~ /^(part|tie|contact)$/) no((how == "" ? "how they are joined is missing after " b : how ": unknown; " meant(how, "part|tie|contact")) (how == "" ? "; " : "") usageOf("join"))
  once("join" SUBSEP (a < b ? a SUBSEP b : b SUBSEP a), "join of " a " and " b)
  pick("join\t" FNR "\t" a "\t" b "\t" how)
  if (how == "part") return
  pick("group\t" FNR "\t" dim - 1 "\t" a "-" b "\tbetween\t" a "\t" b)
  pick("group\t" FNR "\t" dim - 1 "\t" b "-" a "\tbetween\t" b "\t" a)
  # as a statement of its own, with the groups in place of the bodies
  word[2] = a "-" b
  word[3] = b "-" a
  for (k = 4; k < words; k++) word[k] = word[k + 1]
  words--
  at = 1
  word[1] = how
  if (how == "tie") readTie()
  else readContact()
}
# before the rest: the names of cuts and of the groups that joins make
function aheadOfCad() {
  if (word[1] == "cut" && words > 1) ofCad[word[2]] = 1
  if (word[1] == "join" && words > 3 && word[4] ~ /^(tie|contact)$/ && word[2] != word[3]) ofCad[word[2] "-" word[3]] = ofCad[word[3] "-" word[2]] = 1
}
