# case-file.awk: a case file, checked against the mesh's groups: CASE=FILE SPACE=0|1 LC_ALL=C awk -f case-file.awk NAMES FILE
# Needs: NAMES, the lines of gmsh's $PhysicalNames: dimension, number, "name"; CASE, the file as the user named it, for messages;
#        BODIES, of a geometry whose bodies have no names: their numbers; PICKS, a file to be written, or nothing; SETS_OVERLAP, not
#        empty: an element may be in several groups, of which the case needs one.
# Gives: a plain table for bodies/parts.idp: "units" and its text, "state" and its word, "thickness" and its number; "groups", how
#        many, then dimension and name of each group that is used, a line each: its number is its place; "statements", how many,
#        then a line each: word, line of the file, its groups' numbers (two, 0: none), shape or a contact's gap, what moves an obstacle, law (none:
#        without) and 16 numbers (see put()). Or one line that says what is wrong where, and exit code 1. PICKS, for
#        meshes/pick.awk, a line each, its words between tabs: group, line, dimension, name, and how it is picked; size, line, name,
#        number; contact, obstacle: line, groups' names, shape and numbers.
# The grammar is the table of usages below; words that stand for a number are looked at in number().
function no(what) {
  if (!finishing) what = "line " (ahead ? ahead : FNR) ": " what
  gsub(/[[:cntrl:]]/, " ", what)
  if (length(what) > 3000) what = substr(what, 1, 100) " ... " substr(what, length(what) - 2800)
  print "-case " ENVIRON["CASE"] ", " what
  failed = 1
  exit 1
}
function usageOf(word) { return "allowed: " usage[word] }

# how many letters must be put in, left out or exchanged to make one word of the other
function distance(a, b,   i, j, d, cost) {
  for (i = 0; i <= length(a); i++) d[i, 0] = i
  for (j = 0; j <= length(b); j++) d[0, j] = j
  for (i = 1; i <= length(a); i++)
    for (j = 1; j <= length(b); j++) {
      d[i, j] = d[i - 1, j] < d[i, j - 1] ? d[i - 1, j] + 1 : d[i, j - 1] + 1
      cost = d[i - 1, j - 1] + (substr(a, i, 1) != substr(b, j, 1))
      if (cost < d[i, j]) d[i, j] = cost
      if (i > 1 && j > 1 && substr(a, i, 1) == substr(b, j - 1, 1) && substr(a, i - 1, 1) == substr(b, j, 1) && d[i - 2, j - 2] + 1 < d[i, j])
        d[i, j] = d[i - 2, j - 2] + 1
    }
  return d[length(a), length(b)]
}
# of the words between "|", the one that was meant, if that can be guessed
function meant(word, words,   list, n, k, off, least, found) {
  if (length(word) > 40) return ""
  n = split(words, list, "|")
  least = 2 + int(length(word) / 4)
  for (k = 1; k <= n; k++) {
    off = distance(tolower(word), tolower(list[k]))
    if (off < least) { least = off; found = list[k] }
  }
  return found == "" ? "" : "did you mean " found "? "
}

# of an unknown statement the one that does what it is likely to ask for, and what that does
function leadTo(t,   k, n, list, near) {
  t = tolower(t)
  sub(/s$/, "", t)
  if (t in instead) return instead[t] "; "
  n = split(t in leads ? leads[t] : "", list, " ")
  for (k = 1; k <= n && !(list[k] in usage); k++);
  if (k <= n) near = "did you mean " list[k] "? "
  else near = meant(word[1], statementWords)
  k = near
  sub(/^did you mean /, "", k)
  sub(/\? $/, "", k)
  return k in does ? "did you mean " k " (" does[k] ")? " : near
}

# the line's words: word[1] ... word[words], blanks kept between quotes, # begins a comment
function splitLine(   rest, at) {
  words = 0
  rest = $0
  while (1) {
    sub(/^[ \t\r]+/, "", rest)
    if (rest == "" || substr(rest, 1, 1) == "#") return
    words++
    if (substr(rest, 1, 1) == "\"") {
      at = index(substr(rest, 2), "\"")
      if (!at) no(rest ": a quote that does not end; allowed: \"name\"")
      word[words] = substr(rest, 2, at - 1)
      rest = substr(rest, at + 2)
      if (rest ~ /^[^ \t\r#]/) no("\"" word[words] "\"" rest ": no blank after the quote; allowed: a blank between two words")
      if (word[words] == "") no("\"\": an empty name; " usageOf(word[1]))
    } else {
      match(rest, /^[^ \t\r#"]+/)
      word[words] = substr(rest, 1, RLENGTH)
      rest = substr(rest, RLENGTH + 1)
      if (substr(rest, 1, 1) == "\"") no(word[words] rest ": a quote inside a word; allowed: a blank between two words")
    }
    if (word[words] ~ /[[:cntrl:]]/) no(word[words] ": a control character; allowed: letters, digits and signs")
  }
}
function spells(t) { return t ~ /^[+-]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][+-]?[0-9]+)?$/ }
# the next word of the line, as a number above `low`, below `high`
function number(what, low, high,   t, v, mantissa) {
  if (at >= words) no(what " is missing after " word[words] "; " usageOf(word[1]))
  t = word[++at]
  if (!spells(t)) no(t ": " what " is no number; " usageOf(word[1]))
  v = t + 0
  mantissa = t
  sub(/[eE].*/, "", mantissa)
  if (mantissa ~ /[1-9]/ && (v < 1e-40 && v > -1e-40 || v > 1e40 || v < -1e40))
    no(t ": " what " cannot be computed with; allowed: 0, and magnitudes from 1e-40 to 1e40")
  if (v <= low || v >= high) no(t ": " what " is out of range; allowed: " (low == -1e-300 ? "at least 0" : low > -1e300 ? "above " low : "") (low > -1e300 && high < 1e300 ? " and " : "") (high < 1e300 ? "below " high : ""))
  return v
}
function any(what) { return number(what, -1e300, 1e300) }
# refused before what they say: as many numbers to come as a vector has
function counted(what,   n) {
  while (at + n < words && spells(word[at + n + 1])) n++
  if (n > 2 + space) no(word[at + 3 + space] ": " what " has " n " numbers, more than the " 2 + space " components there are; " usageOf(word[1]))
}
function vector(what, k, into, from) {
  for (k = 0; k < 3; k++) into[from + k] = k < 2 + space ? any(what) : 0
}
function nonzero(what, into, from) {
  if (into[from] == 0 && into[from + 1] == 0 && into[from + 2] == 0) no(what " is 0 in every direction; " usageOf(word[1]))
}
# the next word, which must be this one
function keyword(name) {
  if (at >= words) no(name " is missing after " word[words] "; " usageOf(word[1]))
  if (word[++at] != name) no(word[at] ": not allowed here; " usageOf(word[1]))
}

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
  if (index(" " pickWords " ", " " how " ") == 0) no(how ": unknown; " meant(how, pickList) usageOf("group"))
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
  sized = 1
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
    if (word[1] == "body" && words > 1 && !((dim SUBSEP word[2]) in there)) { own++; only = word[2] }
  }
  close(file)
  $0 = kept
  ahead = 0
  for (n in how_) named(how_[n] == manyOf[dim] || how_[n] ~ /^(box|near)$/ && (n in isBody) ? dim : dim - 1, n)
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
function once(key, what) {
  if (key in seen) no(what ": stated before, in line " seen[key] "; allowed: once")
  seen[key] = FNR
}
# a boundary is held in one way
function holds(g) {
  if (g in heldBy) no(nameOf[g] ": " word[1] " after " heldBy[g] " in line " heldIn[g] "; allowed: one of clamp, symmetry, move, rotate, force")
  heldBy[g] = word[1]
  heldIn[g] = FNR
}
# law NAME and its parameters: kappa m p0 beta d0, all of those that it takes
function readLaw(v,   name, list, n, k, given, taken) {
  if (at >= words) no("a law's name is missing; allowed: " lawNames)
  name = word[++at]
  if (!(name in takes)) no(name ": unknown law; " meant(name, lawWords) "allowed: " lawNames)
  if (name == "table") {
    if (at >= words) no("the file of the law table is missing; allowed: " lawNames)
    lawFile = line_ = word[++at]
    gsub(/\047/, "\047\\\047\047", line_)
    if (system("test -f \047" line_ "\047") || (getline line_ < lawFile) <= 0)
      no(lawFile ": no such file, or empty, a folder, a pipe or a device; allowed: a file of overlap,pressure pairs")
    close(lawFile)
  }
  while (at < words && word[at + 1] in parameter) {
    k = word[++at]
    if (index(" " takes[name] " ", " " k " ") == 0)
      no(k ": not a parameter of the law " name "; allowed: " (takes[name] == "" ? "none" : takes[name]))
    if (k in given) no(k ": given twice; allowed: once")
    given[k] = 1
    v[parameter[k]] = number(k, low[k], high[k])
  }
  n = split(takes[name], list, " ")
  for (k = 1; k <= n; k++) if (!(list[k] in given)) no("law " name ": " list[k] " is missing; allowed: law " name " with " takes[name])
  return name
}
# kappa m p0 beta d0, point (3), direction (3), radius, inside, the obstacle's move or force (3);  of others, in this order:
# body: E nu, yield stress or 0;  move, force, traction, weight: a vector;  rotate: centre, axis, angle;  pressure: the pressure;
# line: both ends;  expand: alpha, dT;  preload: the force
# behind the second leg on: what was stated before, as a total reached in this leg; the statement that it changes
function changed(key,   k) {
  if (legs < 2) return 0
  if (!(key in base)) no(word[1] " " word[2] ": first stated in a leg behind the first; allowed: stated there, be it as 0")
  once(key SUBSEP legs, word[1] " of " word[2] " in leg " legs)
  return base[key] + 0
}
function putChange(of, v,   k, line) {
  line = "to " FNR " 0 " of " none none none"
  for (k = 0; k < 16; k++) line = line " " sprintf("%.17g", v[k])
  table[++statements] = line
}
function readLeg(   v, k) {
  if (!rubs) no("leg: read by parts.edp and parts-3d.edp alone; allowed here: one load, -history 1 in steps")
  for (k = 0; k < 16; k++) v[k] = 0
  v[0] = number("the number of steps", 0, 100001)
  if (v[0] != int(v[0])) no(word[at] ": no whole number of steps; " usageOf("leg"))
  legs++
  put(0, 0, "none", "none", "none", v)
}
function put(a, b, shape, load, law, v,   k, line) {
  line = word[1] " " FNR " " a " " b " " shape " " load " " law
  for (k = 0; k < 16; k++) line = line " " sprintf("%.17g", v[k])
  table[++statements] = line
  if (law == "table") { files++; fileLine[files] = statements - 1 " " lawFile }
  if (statements > 1000) no("more than 1000 statements; allowed: fewer")
}
function readShape(v,   shape) {
  if (at >= words) no("a shape is missing after " word[words] "; " usageOf("obstacle"))
  shape = word[++at]
  if (!(shape in isShape)) no(shape ": unknown shape; " meant(shape, shapeWords) "allowed: " shapeNames)
  vector("the obstacle's place", 0, v, 5)
  if (shape == "plane" || shape == "cylinder") {
    vector("the obstacle's direction", 0, v, 8)
    nonzero("the obstacle's direction", v, 8)
  }
  if (shape != "plane") {
    keyword("R")
    v[11] = number("the radius", 0, 1e300)
  }
  if (shape != "plane" && at < words && word[at + 1] == "inside") { at++; v[12] = 1 }
  return shape
}
# friction MU [compliance c] [limit t]: a statement "friction" of its own behind the contact's or obstacle's
function readFriction(f) {
  if (!rubs) no("friction: read by parts.edp and parts-3d.edp alone; allowed here: contacts without it")
  f[0] = number("the coefficient of friction", -1e-300, 1e6)
  f[1] = f[2] = 0
  while (at < words && word[at + 1] ~ /^(compliance|limit)$/)
    if (word[++at] == "compliance") f[1] = number("the compliance", -1e-300, 1e300)
    else f[2] = number("the limit", 0, 1e300)
}
function putFriction(f,   k, v) {
  for (k = 0; k < 16; k++) v[k] = k < 3 ? f[k] : 0
  table[++statements] = "friction " FNR " 0 0 none none none"
  for (k = 0; k < 16; k++) table[statements] = table[statements] " " sprintf("%.17g", v[k])
}
function readObstacle(   g, v, f, shape, load, law, next_, over, rest) {
  over = 0
  g = group(dim - 1)
  for (k = 0; k < 16; k++) v[k] = 0
  shape = readShape(v)
  load = law = "none"
  while (at < words) {
    next_ = word[++at]
    if (next_ == "law" && law == "none") law = readLaw(v)
    else if (next_ == "friction" && !(0 in f)) readFriction(f)
    else if ((next_ == "move" || next_ == "force") && load == "none") {
      load = next_
      counted(load)
      vector("the obstacle's " load, 0, v, 13)
      if (load == "force") nonzero("the obstacle's force", v, 13)
    } else if (next_ == "interference" && !over) over = number("the interference", 0, 1e300)
    else no(next_ ": not allowed here; " usageOf("obstacle"))
  }
  shape_ = shape
  for (k = 5; k < 13; k++) shape_ = shape_ " " v[k]
  key_ = "obstacle" SUBSEP g SUBSEP shape_
  rest = law
  for (k = 0; k < 5; k++) rest = rest " " v[k]
  rest = law == "none" && !over && !(0 in f) ? "" : rest " " over " " ((0 in f) ? f[0] " " f[1] " " f[2] : "none")
  if (changed(key_) && load != "force") {
    if (rest != "" && rest != restOf[key_])
      no("obstacle " word[2] ": law, friction or interference unlike line " seen[key_] "; allowed in a later leg: another move alone")
    if (load != "move" || loadOf[key_] != "move")
      no("obstacle " word[2] ": no move here or in line " seen[key_] "; allowed in several legs: a move in each, be it 0")
    putChange(base[key_] - 1, v)
    return
  }
  base[key_] = statements + 1
  once(key_, "this obstacle of " nameOf[g])
  restOf[key_] = rest
  loadOf[key_] = load
  if (axial && (v[13] != 0)) no(word[1] ": a " load " off the axis; allowed with state axisymmetric: along y")
  v[4] -= over
  touches[g] = FNR; slaves[g] = FNR
  pick("obstacle\t" FNR "\t" nameOf[g] "\t" shape_)
  measured(g, "none")
  put(g, 0, shape, load, law, v)
  if (0 in f) putFriction(f)
}
# gaps of one slave, in space of all contacts, are measured in one way
function measured(g, gap,   all) {
  all = space ? 0 : g
  if (all in gapOf && gapOf[all] != gap)
    no(nameOf[g] ": gap " (gap == "none" ? "along its normals" : gap) ", in line " gapLine[all] " it is not; allowed: one way for " (space ? "all contacts" : "one slave"))
  gapOf[all] = gap
  gapLine[all] = FNR
}
function readContact(   a, b, v, f, law, gap, next_, over) {
  over = 0
  a = group(dim - 1)
  b = group(dim - 1)
  if (a == b) no(nameOf[a] ": slave and master are the same; allowed: two groups")
  once("contact" SUBSEP (a < b ? a SUBSEP b : b SUBSEP a), "contact of " nameOf[a] " and " nameOf[b])
  for (k = 0; k < 16; k++) v[k] = 0
  law = gap = "none"
  while (at < words) {
    next_ = word[++at]
    if (next_ == "law" && law == "none") law = readLaw(v)
    else if (next_ == "friction" && !(0 in f)) readFriction(f)
    else if (next_ == "gap" && gap == "none") { keyword("vertical"); gap = "vertical" }
    else if (next_ == "interference" && !over) over = number("the interference", 0, 1e300)
    else no(next_ ": not allowed here; " usageOf("contact"))
  }
  slaves[a] = FNR
  touches[a] = touches[b] = FNR
  pick("contact\t" FNR "\t" nameOf[a] "\t" nameOf[b])
  measured(a, gap)
  v[4] -= over
  put(a, b, gap, "none", law, v)
  if (0 in f) putFriction(f)
}
# a contact whose surfaces neither part nor slide: a statement "tied" of its own behind it
function readTie(   a, b, v, k) {
  if (!rubs) no("tie: read by parts.edp and parts-3d.edp alone; allowed here: bodies that share nodes")
  if (ENVIRON["RUBS"] ~ / /) no("tie: not with " ENVIRON["RUBS"] "; allowed: -distance linear, -points segment")
  a = group(dim - 1)
  b = group(dim - 1)
  if (a == b) no(nameOf[a] ": slave and master are the same; allowed: two groups")
  once("contact" SUBSEP (a < b ? a SUBSEP b : b SUBSEP a), "contact of " nameOf[a] " and " nameOf[b])
  slaves[a] = FNR
  touches[a] = touches[b] = FNR
  pick("contact\t" FNR "\t" nameOf[a] "\t" nameOf[b])
  measured(a, "none")
  for (k = 0; k < 16; k++) v[k] = 0
  word[1] = "contact"
  put(a, b, "none", "none", "tied", v)
  word[1] = "tied"
  put(0, 0, "none", "none", "none", v)
  word[1] = "tie"
}
function readBody(   g, v) {
  g = group(dim)
  once("body" SUBSEP g, "body " nameOf[g])
  keyword("E")
  v[0] = number("Young's modulus", 0, 1e300)
  keyword("nu")
  v[1] = number("Poisson's ratio", -1, 0.5)
  v[2] = 0
  if (at < words && word[at + 1] == "yield") { at++; v[2] = number("the yield stress", 0, 1e300) }
  put(g, 0, "none", "none", "none", v)
}
# clamp, symmetry, move, rotate, force, pressure, traction, weight: a group and a few numbers
function readOther(   g, v, what) {
  what = word[1]
  g = group(what == "weight" ? dim : dim - 1)
  key_ = what SUBSEP g
  if (what !~ /^(clamp|symmetry)$/ && changed(key_)) {
    if (what == "force") no(nameOf[g] ": a force in two legs; allowed there: move, rotate, pressure, traction, weight")
  } else if (what ~ /^(clamp|symmetry|move|rotate|force)$/) holds(g)
  else once(what SUBSEP g, what " of " nameOf[g])
  if (what ~ /^(move|force|traction|weight)$/) { counted(what); vector("the " what, 0, v, 0) }
  if (what == "force") nonzero("the force", v, 0)
  if (what == "rotate") {
    if (axial) no("rotate: a ring cannot turn; allowed with state axisymmetric: clamp, symmetry, move, force")
    vector("the centre", 0, v, 0)
    v[3] = v[4] = 0; v[5] = 1
    if (space) { vector("the axis", 0, v, 3); nonzero("the axis", v, 3) }
    v[6] = number("the angle", -1e6, 1e6)
  }
  if (what == "pressure") { v[0] = any("the pressure"); loadLine[g] = FNR; loadWord[g] = what }
  if (what == "traction") { loadLine[g] = FNR; loadWord[g] = what }
  if (axial && what ~ /^(force|weight)$/ && v[0] != 0) no(word[2] ": a " what " off the axis; allowed with state axisymmetric: along y")
  if (legs > 1 && what !~ /^(clamp|symmetry)$/) { putChange(base[key_] - 1, v); return }
  base[key_] = statements + 1
  put(g, 0, "none", "none", "none", v)
}
# stresses, line, expand, preload: read by the scripts of scenes/asked/
function readAsked(   g, v, k, name) {
  for (k = 0; k < 16; k++) v[k] = 0
  name = "none"
  if (word[1] == "stresses") once("stresses", "stresses")
  if (word[1] == "line") {
    if (at >= words) no("a name is missing after line; " usageOf("line"))
    name = word[++at]
    if (name !~ /^[A-Za-z0-9_-]+$/) no(name ": a name for files; allowed: letters, digits, - and _")
    once("line" SUBSEP name, "line " name)
    vector("the line's beginning", 0, v, 0)
    vector("the line's end", 0, v, 3)
    if (v[0] == v[3] && v[1] == v[4] && v[2] == v[5]) no("line " name ": begins where it ends; " usageOf("line"))
  }
  if (word[1] == "expand") {
    g = group(dim)
    once("expand" SUBSEP g, "expand " nameOf[g])
    v[0] = any("the coefficient of expansion")
    v[1] = any("the change of temperature")
  }
  if (word[1] == "preload") {
    g = group(dim - 1)
    once("preload" SUBSEP g, "preload " nameOf[g])
    v[0] = number("the preload", 0, 1e300)
  }
  put(g + 0, 0, name, "none", "none", v)
}
function single(   text, k) {
  once(word[1], word[1])
  if (word[1] == "units") {
    if (words != 3) no("units: " words - 1 " words after it; " usageOf("units"))
    units = word[2] " " word[3]
    at = words
    return
  }
  if (space) no(word[1] ": only in the plane; allowed in space: nothing of the kind")
  if (word[1] == "thickness") { thickness = number("the thickness", 0, 1e300); return }
  if (statements) no(word[1] ": after line " firstLine "; allowed: before all statements but units and thickness")
  if (words < 2) no("state: a word is missing; " usageOf("state"))
  state = word[++at]
  if (state !~ /^(strain|stress|axisymmetric)$/) no(state ": unknown; " meant(state, "strain|stress|axisymmetric") usageOf("state"))
  axial = state == "axisymmetric"
}

BEGIN {
  space = ENVIRON["SPACE"] + 0
  dim = 2 + space
  rubs = ENVIRON["RUBS"] != ""
  split("curve surface volume", kind, " ")
  kind[0] = "point"
  at3 = space ? " z" : ""
  usage["units"] = "units LENGTH PRESSURE, as units mm MPa"
  usage["state"] = "state strain, stress or axisymmetric"
  usage["thickness"] = "thickness NUMBER"
  usage["body"] = "body NAME E number nu number [yield number]"
  usage["stresses"] = "stresses"
  usage["line"] = "line NAME x y" at3 " x y" at3
  usage["expand"] = "expand NAME alpha dT, two numbers"
  usage["preload"] = "preload NAME force"
  lawWords = "power|exponential|barrier|table|signorini"
  lawNames = "power kappa m d0, exponential p0 beta d0, barrier p0 d0, table FILE d0, signorini"
  rubbing = "[friction MU [compliance c] [limit t]]"
  usage["contact"] = "contact SLAVE MASTER [gap vertical] [interference number] [law NAME ...] " rubbing ", with its parameters: " lawNames
  shapeNames = space ? "plane x y z nx ny nz, sphere x y z R r, cylinder x y z dx dy dz R r" : "plane x y nx ny, circle x y R r"
  shapeWords = space ? "plane|sphere|cylinder" : "plane|circle"
  usage["obstacle"] = "obstacle SLAVE SHAPE [inside] [move or force x y" at3 "] [interference number] [law NAME ...] " rubbing ", SHAPE one of: " shapeNames
  usage["clamp"] = "clamp NAME"
  usage["symmetry"] = "symmetry NAME"
  usage["move"] = "move NAME x y" at3
  usage["rotate"] = space ? "rotate NAME, centre x y z, axis x y z, angle in radians" : "rotate NAME, centre x y, angle in radians"
  usage["force"] = "force NAME x y" at3
  usage["pressure"] = "pressure NAME number"
  usage["traction"] = "traction NAME x y" at3
  usage["leg"] = "leg STEPS"
  usage["tie"] = "tie SLAVE MASTER"
  usage["weight"] = "weight NAME x y" at3
  manyOf[1] = "curves"; manyOf[2] = space ? "faces" : "surfaces"; manyOf[3] = "volumes"
  pickWords = manyOf[dim - 1] " " manyOf[dim] " box plane near between"
  pickList = pickWords
  gsub(/ /, "|", pickList)
  usage["group"] = "group NAME " manyOf[dim - 1] " N ..., " manyOf[dim] " N ..., box x y" at3 " x y" at3 ", plane x y" at3 " nx ny" \
    (space ? " nz" : "") ", near x y" at3 " or between BODY BODY"
  usage["size"] = "size NAME number or size contact number"
  for (k in usage) statementWords = statementWords "|" k
  statementWords = substr(statementWords, 2)
  statementNames = "units, state, thickness, group, size, body, contact, obstacle, tie, clamp, symmetry, move, rotate, force, pressure, traction, weight, expand, preload, stresses, line, leg"
  split("clamp no displacement|symmetry no displacement across a flat group|move a displacement that is given|rotate a small rotation" \
    "|force a resultant on a group|pressure along the normal, on a boundary|traction a force per area, on a boundary" \
    "|weight a force per volume on a body: density times gravity|body Young\047s modulus and Poisson\047s ratio" \
    "|contact two surfaces that may touch|obstacle a rigid shape that may touch|group faces or bodies of a geometry" \
    "|size of the elements|preload a shank pulled together|expand thermal strain|units of lengths and pressures" \
    "|state strain, stress or about an axis|thickness in the plane|stresses tensor, principal and von Mises|line results along it" \
    "|leg loads and motions reached in steps|tie two surfaces glued: no gap, no slip", list, "|")
  for (k in list) { line = list[k]; sub(/ .*/, "", line); does[line] = substr(list[k], length(line) + 2) }
  split("fix fixed fixity encastre support anchor hold ground bc boundary:clamp|roller slider:symmetry|gravity acceleration density dload:weight" \
    "|bolt pretension tension:preload force|displacement disp displace:move|turn rotation:rotate|load cload:force" \
    "|material elastic steel:body|temperature thermal heat shrink:expand|rigid wall ground:obstacle|set nset elset surface face select:group" \
    "|mesh h elementsize refine:size|unit:units|interface pair touch:contact|interference overlap:contact|tied bond bonded glue glued mortar:tie", list, "|")
  for (k in list) {
    n = split(substr(list[k], 1, index(list[k], ":") - 1), own, " ")
    for (j = 1; j <= n; j++) leads[own[j]] = substr(list[k], index(list[k], ":") + 1)
  }
  instead["friction"] = instead["mu"] = instead["coulomb"] = "it stands behind a contact or an obstacle: contact SLAVE MASTER friction 0.3"
  instead["weld"] = instead["join"] = "tie SLAVE MASTER glues two surfaces; bodies that share nodes are one part and need no statement (in gmsh: BooleanFragments, Coherence)"
  instead["torque"] = instead["moment"] = "a couple is not offered: rotate NAME gives an angle, and its moment is said"
  instead["spring"] = "springs are not offered: a body of their stiffness"
  takes["power"] = "kappa m d0"; takes["exponential"] = "p0 beta d0"; takes["barrier"] = "p0 d0"; takes["signorini"] = ""; takes["table"] = "d0"
  parameter["kappa"] = 0; parameter["m"] = 1; parameter["p0"] = 2; parameter["beta"] = 3; parameter["d0"] = 4
  low["kappa"] = low["p0"] = low["beta"] = 0; low["m"] = 1; low["d0"] = -1e300
  high["kappa"] = high["p0"] = high["beta"] = 1e300; high["m"] = 1000; high["d0"] = 0
  split(shapeWords, list, "|")
  for (k in list) isShape[list[k]] = 1
  units = "none"
  state = space ? "none" : "strain"
  thickness = 1
}
FILENAME == ARGV[1] {
  name = $0
  sub(/^[^"]*"/, "", name)
  sub(/"[^"]*$/, "", name)
  there[$1, name] = 1
  dimOf[++names] = $1
  nameIn[names] = name
  next
}
{
  if (FNR == 1) readAhead(FILENAME)
  if (FNR == 1) sub(/^\357\273\277/, "")
  splitLine()
  if (!words) next
  at = 1
  if (!(word[1] in usage)) no(word[1] ": unknown statement; " leadTo(word[1]) "allowed: " statementNames)
  if (legs > 1 && word[1] !~ /^(leg|obstacle|move|rotate|force|pressure|traction|weight)$/)
    no(word[1] ": in leg " legs ", but it holds in every leg; allowed there: move, rotate, pressure, traction, weight, an obstacle\047s move")
  if (word[1] ~ /^(units|state|thickness)$/) single()
  else if (word[1] == "group") readGroup()
  else if (word[1] == "size") readSize()
  else {
    if (!firstLine) firstLine = FNR
    if (word[1] == "body") readBody()
    else if (word[1] == "leg") readLeg()
    else if (word[1] == "contact") readContact()
    else if (word[1] == "obstacle") readObstacle()
    else if (word[1] == "tie") readTie()
    else if (word[1] ~ /^(stresses|line|expand|preload)$/) readAsked()
    else readOther()
  }
  if (at < words) no(word[at + 1] ": more than the statement takes; " usageOf(word[1]))
}
END {
  if (failed) exit 1
  finishing = 1
  if (!statements) no("it has no statement; allowed: at least body and contact or obstacle")
  for (k = 1; k <= names; k++)
    if (dimOf[k] == dim && ENVIRON["SETS_OVERLAP"] == "" && !(("body" SUBSEP place[dim, nameIn[k]]) in seen))
      no("nothing says what the " kind[dim] " " nameIn[k] " is made of; allowed: a line body " nameIn[k] " E number nu number")
  for (g in slaves)
    if (g in heldBy) no("line " slaves[g] ": " nameOf[g] ": a slave that line " heldIn[g] " holds (" heldBy[g] "); allowed: the other surface as slave")
  for (g in loadLine)
    if (g in heldBy && heldBy[g] != "force")
      no("line " loadLine[g] ": " nameOf[g] ": a " loadWord[g] " on what line " heldIn[g] " holds (" heldBy[g] ") does nothing; allowed: on another group")
  for (g in touches) any_ = 1
  if (!any_) no("no contact; allowed: at least one line contact or obstacle")
  if (axial && thickness != 1) no("line " seen["thickness"] ": thickness with state axisymmetric; allowed: with strain and stress")
  print "units " units "\nstate " state "\nthickness " sprintf("%.17g", thickness)
  print "groups " groups
  for (k = 1; k <= groups; k++) print groupLine[k]
  print "statements " statements
  for (k = 1; k <= statements; k++) print table[k]
  print "files " files + 0
  for (k = 1; k <= files; k++) print fileLine[k]
}
