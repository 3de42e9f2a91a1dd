# case-groups.awk: the groups of a case: those of the mesh, those that the case picks on a geometry, and the elements' sizes
# Read by awk before case-file.awk. A group is known by its dimension and name; it gets its number where a statement first uses it.
# known(dimension), group(dimension): the next word as a group's name, its number; readGroup(), readSize(): two statements; readAhead(file):
# the names that the file gives, before the rest is read; pick(line): a line for meshes/pick.awk.
# the next word, which must be a group of that dimension
function known(dimension,   name, key, k, other) {
  if (at >= words) no("a name is missing after " word[words] "; " usageOf(word[1]))
  name = word[++at]
  key = dimension SUBSEP name
  if (!(key in there)) {
    if (dimension == dim && ENVIRON["BODIES"] != "")
      no(name ": no body of the geometry has this name; allowed: a line group " name " " manyOf[dim] " N ..., of " ENVIRON["BODIES"])
    if (ENVIRON["BODIES"] != "" && listed(dimension, " ") == " none")
      no(name ": no group; allowed: a line group " name " " manyOf[dim - 1] " N ... (-check 1 without -case draws their numbers)")
    for (k = 0; k <= 3; k++) if (k != dimension && (k SUBSEP name) in there) other = k
    if (other != "") no(name ": a " kind[other] " of the mesh; allowed for " word[1] ": its " kind[dimension] "s:" listed(dimension, " "))
    no(name ": no physical " kind[dimension] " of the mesh; " meant(name, listed(dimension, "|")) "allowed:" listed(dimension, " "))
  }
  return name
}
# its number
function group(dimension,   name, key) {
  name = known(dimension)
  key = dimension SUBSEP name
  if (!(key in place)) { place[key] = ++groups; groupLine[groups] = dimension " " name; nameOf[groups] = name }
  return place[key]
}
function listed(dimension, between,   k, all) {
  for (k = 1; k <= names; k++) if (dimOf[k] == dimension) all = all between nameIn[k]
  return all == "" ? " none" : (between == "|" ? substr(all, 2) : all)
}
# group: what it is picked by, for meshes/pick.awk; names are known since readAhead()
function readGroup(   name, how, k, text) {
  name = word[++at]
  once("group" SUBSEP name, "group " name)
  if ((dim SUBSEP name) in inFile || (dim - 1 SUBSEP name) in inFile)
    no(name ": the mesh or geometry has a group of this name; allowed: another name")
  if (at >= words) no("what it is picked by is missing after " name "; " usageOf("group"))
  how = word[++at]
  if (index(" " pickWords " ", " " how " ") == 0) no(how ": unknown; " (!space && how ~ /^(faces|volumes)$/ ? "a case in space is run by edp/parts-3d.edp; " : meant(how, pickList)) usageOf("group"))
  text = how
  if (how == manyOf[dim] || how == manyOf[dim - 1]) {
    if (at >= words) no("numbers are missing after " how "; " usageOf("group"))
    while (at < words) {
      if (word[++at] !~ /^[0-9]+$/) no(word[at] ": not the number of one of the " how "; allowed: those that -check 1 draws")
      text = text " " word[at] + 0
    }
  } else if (how == "between") {
    for (k = 0; k < 2; k++) text = text "\t" known(dim)
    if (word[at] == word[at - 1]) no(word[at] ": twice the same body; allowed: two bodies")
  } else {
    vector("the place", 0, taken_, 0)
    if (how == "box") vector("the other corner", 0, taken_, 3)
    if (how == "plane") { vector("the normal", 0, taken_, 3); nonzero("the normal", taken_, 3) }
    for (k = 0; k < (how == "near" ? 3 : 6); k++) text = text " " sprintf("%.17g", taken_[k])
  }
  pickedBy[name] = FNR
  if (name in ofCad) no(name ": a cut or a join has a group of this name; allowed: another name")
  pick("group\t" FNR "\t" dimOfGroup[name] "\t" name "\t" text)
}
function pick(line) { if (ENVIRON["PICKS"] != "") print line > ENVIRON["PICKS"] }
function readSize(   name, h) {
  if (words < 2) no("a name is missing; " usageOf("size"))
  name = word[++at]
  if (name != "contact" || (dim SUBSEP name) in there || (dim - 1 SUBSEP name) in there) {
    at--
    known((dim SUBSEP name) in there ? dim : dim - 1)
  }
  once("size" SUBSEP name, "size of " name)
  h = number("the size", 0, 1e300)
  pick("size\t" FNR "\t" name "\t" sprintf("%.17g", h))
}
# before the rest: the names of groups; what is said to be made of something is a body
function readAhead(file,   n, kept, own, list, k) {
  if (ENVIRON["AGAIN"] == "") for (key in there) inFile[key] = 1
  kept = $0
  while ((getline < file) > 0) {
    if (++ahead == 1) sub(/^\357\273\277/, "")
    splitLine()
    if (word[1] ~ /^(body|weight)$/ && words > 1) isBody[word[2]] = 1
    if (word[1] == "group" && words > 2) how_[word[2]] = word[3]
    aheadOfCad()
    if (word[1] == "body" && words > 1 && !((dim SUBSEP word[2]) in there)) { own++; only = word[2] }
  }
  close(file)
  $0 = kept
  ahead = 0
  for (n in how_) named(how_[n] == manyOf[dim] || how_[n] ~ /^(box|near)$/ && (n in isBody) ? dim : dim - 1, n)
  for (n in ofCad) named(dim - 1, n)
  # one body alone needs no group: it is all there is
  for (n in dimOfGroup) if (dimOfGroup[n] == dim) own = 0
  if (ENVIRON["BODIES"] != "" && own == 1) {
    named(dim, only)
    pick("group\t0\t" dim "\t" only "\t" manyOf[dim] " " ENVIRON["BODIES"])
  }
}
function named(dimension, name) {
  dimOfGroup[name] = dimension
  if ((dimension SUBSEP name) in there) return
  there[dimension, name] = 1
  dimOf[++names] = dimension
  nameIn[names] = name
}
