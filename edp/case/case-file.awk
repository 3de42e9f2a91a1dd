# case-file.awk: a case file, checked against the mesh's groups: CASE=FILE SPACE=0|1 LC_ALL=C awk (-f FILE ...) NAMES FILE
# Read by awk after case-words.awk, case-grammar.awk, case-groups.awk, case-pushed.awk, case-worn.awk, case-heat.awk and case-cad.awk, which have what it is made of.
# Needs: NAMES, the lines of gmsh's $PhysicalNames: dimension, number, "name"; CASE, the file as the user named it, for messages;
#        BODIES, of a geometry whose bodies have no names: their numbers; PICKS, a file to be written, or nothing; SETS_OVERLAP, not
#        empty: an element may be in several groups, of which the case needs one.
# Gives: a plain table for options/parts/case-file.idp: "units" and its text, "state" and its word, "thickness" and its number;
#        "groups", how many, then dimension and name of each group that is used, a line each: its number is its place; "statements",
#        how many, then a line each: word, line of the file, its groups' numbers (two, 0: none), shape or a contact's gap, what moves
#        an obstacle, law (none: without) and 16 numbers (see row()). Or one line that says what is wrong where, and exit code 1.
#        PICKS, for meshes/pick.awk, a line each, its words between tabs: group, line, dimension, name, and how it is picked; size,
#        line, name, number; contact, obstacle: line, groups' names, shape and numbers.
function once(key, what) {
  if (legs == 1 && (key in seen) && seen[key] < legLine && word[1] ~ /^(pressure|traction|weight|force|moment)$/) twice(what, seen[key])
  if (key in seen) no(what ": stated before, in line " seen[key] "; allowed: once")
  seen[key] = FNR
}
function twice(what, line) {
  no(what " in line " line ", before the first leg, and again in it; allowed: without line " line ": the first leg begins with no load and no motion")
}
# a boundary is held in one way
function holds(g) {
  if (legs == 1 && (g in heldBy) && heldBy[g] == word[1] && heldIn[g] < legLine) twice(word[1] " " nameOf[g], heldIn[g])
  if (g in heldBy) no(nameOf[g] ": " word[1] " after " heldBy[g] " in line " heldIn[g] "; allowed: only one of clamp, symmetry, move, rotate, force and a moment that is rigid or about a point for a group")
  heldBy[g] = word[1]
  heldIn[g] = FNR
}
# law NAME and its parameters: kappa m p0 beta d0, all of those that it takes
function readLaw(v,   name, list, n, k, given, taken) {
  if (at >= words) no("a law's name is missing; allowed: " lawNames ", as " example["law"])
  name = word[++at]
  if (!(name in takes)) no(name ": unknown law; " meant(name, lawWords) "allowed: " lawNames ", as " example["law"])
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
# the line's statement before anything of it is there
function withZeros(   k, line, from) {
  line = word[1]
  for (k = 2; k <= words; k++) {
    from = from || word[1] != "obstacle" || word[k] == "move"
    line = line " " (from && k > 2 && spells(word[k]) && (word[1] != "rotate" || k == words) ? 0 : (word[k] ~ / / ? "\"" word[k] "\"" : word[k]))
  }
  return line
}
# in later legs: what was stated before, as a total reached in this leg; the statement that it changes
function changed(key,   k) {
  if (legs < 2) return 0
  if (!(key in base)) no(word[1] " " word[2] ": first stated in leg " legs "; allowed: also behind the first leg in line " legLine ": " withZeros())
  once(key SUBSEP legs, word[1] " of " word[2] " in leg " legs)
  return base[key] + 0
}
# a row of the table: seven words, then 16 numbers, 0 where there is none: kappa m p0 beta d0, point (3), direction (3), radius, inside, the
# obstacle's move or force (3);  of others, in this order: body: E nu, yield stress;  move, force, traction, weight: a vector;  rotate:
# centre, axis, angle;  pressure: the pressure;  line: both ends;  expand: alpha, dT;  preload: the force;  plastic: yield stress, hardening
function row(said, v,   k) {
  for (k = 0; k < 16; k++) said = said " " sprintf("%.17g", v[k])
  table[++statements] = said
  if (statements > 1000) no("more than 1000 statements; allowed: fewer")
}
function putChange(of, v) { row("to " FNR " 0 " of " none none none", v) }
function readLeg(   v) {
  if (!rubs) no("leg: read by parts.edp and parts-3d.edp alone; allowed here: one load, -history 1 in steps")
  v[0] = number("the number of steps", 0, 100001)
  if (v[0] != int(v[0])) no(word[at] ": no whole number of steps; " usageOf("leg"))
  if (!legs++) legLine = FNR
  put(0, 0, "none", "none", "none", v)
}
function put(a, b, shape, load, law, v) {
  row(word[1] " " FNR " " a " " b " " shape " " load " " law, v)
  if (law == "table") { files++; fileLine[files] = statements - 1 " " lawFile }
}
function readShape(v,   shape) {
  if (at >= words) no("a shape is missing after " word[words] "; " usageOf("obstacle"))
  shape = word[++at]
  if (!(shape in isShape)) no(shape ": unknown shape; " meant(shape, shapeWords) "allowed: " shapeNames ", as " example["obstacle"])
  vector("the obstacle's place", 0, v, 5)
  if (shape == "plane" || shape == "cylinder") {
    vector("the obstacle's direction", 0, v, 8)
    nonzero("the obstacle's direction", v, 8)
  }
  if (shape != "plane") {
    if (at < words && word[at + 1] == "R") at++
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
function putFriction(f) { row("friction " FNR " 0 0 none none none", f) }
# obstacle SLAVE move x y [z], in a later leg: of the one obstacle of this slave
function moveObstacle(g,   v, k) {
  if (obstacles[g] != 1) no("obstacle " word[2] ": " obstacles[g] + 0 " obstacles of it; allowed in a later leg: its shape before move")
  if (loadOf[obstacleKey[g]] != "move")
    no("obstacle " word[2] ": no move here or in line " seen[obstacleKey[g]] "; allowed in several legs: a move in each, be it 0")
  at++
  changed(obstacleKey[g])
  for (k = 5; k < 13; k++) v[k] = obstacleShape[g, k]
  counted("move")
  vector("the obstacle\047s move", 0, v, 13)
  putChange(base[obstacleKey[g]] - 1, v)
}
function readObstacle(   g, k, v, f, wear, shape, load, law, next_, over, rest) {
  over = 0
  g = group(dim - 1)
  if (legs > 1 && at < words && word[at + 1] == "move") { moveObstacle(g); return }
  if (at < words && word[at + 1] ~ /^(move|force|law|friction|wear)$/)
    no("obstacle " word[2] ": " word[at + 1] " without a shape; allowed: " (obstacles[g] ? word[at + 1] " behind the shape in line " \
      seen[obstacleKey[g]] (word[at + 1] == "move" ? ", where that of the first leg stands" : "") : "a shape before it, as " example["obstacle"]))
  shape = readShape(v)
  load = law = "none"
  while (at < words) {
    next_ = word[++at]
    if (next_ == "law" && law == "none") law = readLaw(v)
    else if (next_ == "friction" && !(0 in f)) readFriction(f)
    else if (next_ == "wear" && !(0 in wear)) readWear(wear)
    else if ((next_ == "move" || next_ == "force") && load == "none") {
      load = next_
      counted(load)
      vector("the obstacle's " load, 0, v, 13)
      if (load == "force") nonzero("the obstacle's force", v, 13)
    } else if (next_ == "interference" && !over) over = number("the interference", 0, 1e300)
    else no(next_ ": not allowed here; " usageOf("obstacle"))
  }
  shape_ = shape
  for (k = 5; k < 13; k++) shape_ = shape_ " " v[k] + 0
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
  obstacles[g]++
  obstacleKey[g] = key_
  for (k = 5; k < 13; k++) obstacleShape[g, k] = v[k]
  restOf[key_] = rest
  loadOf[key_] = load
  if (axial && (v[13] != 0)) no(word[1] ": a " load " off the axis; allowed with state axisymmetric: along y")
  v[4] -= over
  touches[g] = FNR; slaves[g] = FNR
  pick("obstacle\t" FNR "\t" nameOf[g] "\t" shape_)
  measured(g, "none")
  put(g, 0, shape, load, law, v)
  if (0 in f) putFriction(f)
  if (0 in wear) putWear(wear, law, g, (0 in f) ? f[0] : 0)
}
# gaps of one slave, in space of all contacts, are measured in one way
function measured(g, gap,   all) {
  all = space ? 0 : g
  if (all in gapOf && gapOf[all] != gap)
    no(nameOf[g] ": gap " (gap == "none" ? "along its normals" : gap) ", in line " gapLine[all] " it is not; allowed: one way for " (space ? "all contacts" : "one slave"))
  gapOf[all] = gap
  gapLine[all] = FNR
}
# slave and master: side[0], side[1]
function readPair(side,   a, b) {
  side[0] = a = group(dim - 1)
  side[1] = b = group(dim - 1)
  if (a == b) no(nameOf[a] ": slave and master are the same; allowed: two groups")
  once("contact" SUBSEP (a < b ? a SUBSEP b : b SUBSEP a), "contact of " nameOf[a] " and " nameOf[b])
  slaves[a] = touches[a] = touches[b] = FNR
  pick("contact\t" FNR "\t" nameOf[a] "\t" nameOf[b] "\t" word[1])
}
function readContact(   side, v, f, wear, heat, law, gap, next_, over) {
  over = 0
  readPair(side)
  law = gap = "none"
  while (at < words) {
    next_ = word[++at]
    if (next_ == "law" && law == "none") law = readLaw(v)
    else if (next_ == "friction" && !(0 in f)) readFriction(f)
    else if (next_ == "conductance" && !(0 in heat)) readConductance(heat)
    else if (next_ == "wear" && !(0 in wear)) readWear(wear)
    else if (next_ == "gap" && gap == "none") { keyword("vertical"); gap = "vertical" }
    else if (next_ == "interference" && !over) over = number("the interference", 0, 1e300)
    else no(next_ ": not allowed here; " usageOf("contact"))
  }
  if (gap == "vertical" && (0 in heat)) no(nameOf[side[0]] ": gap vertical with conductance: heat crosses the true area, this gap weighs the one seen along the vertical; allowed: conductance without gap vertical")
  if (gap == "vertical" && (0 in wear)) no(nameOf[side[0]] ": gap vertical with wear: depth and pressure of wear are those along the normal; allowed: wear without gap vertical")
  measured(side[0], gap)
  v[4] -= over
  put(side[0], side[1], gap, "none", law, v)
  if (0 in f) putFriction(f)
  if (0 in heat) putConductance(heat)
  if (0 in wear) putWear(wear, law, side[0], (0 in f) ? f[0] : 0)
}
# a contact whose surfaces neither part nor slide: a statement "tied" of its own behind it
function readTie(   side, v) {
  if (!rubs) no("tie: read by parts.edp and parts-3d.edp alone; allowed here: bodies that share nodes")
  if (ENVIRON["RUBS"] ~ / /) no("tie: not with " ENVIRON["RUBS"] "; allowed: -distance linear, -points segment")
  readPair(side)
  measured(side[0], "none")
  row("contact " FNR " " side[0] " " side[1] " none none tied", v)
  row("tied " FNR " 0 0 none none none", v)
}
function readBody(   g, v) {
  g = group(dim)
  once("body" SUBSEP g, "body " nameOf[g])
  keyword("E")
  v[0] = number("Young's modulus", 0, 1e300)
  keyword("nu")
  v[1] = number("Poisson's ratio", -1, 0.5)
  while (at < words && word[at + 1] ~ /^(yield|density)$/)
    if (word[++at] == "yield") v[2] = number("the yield stress", 0, 1e300)
    else density[g] = number("the density", 0, 1e300)
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
# stresses, line, expand, preload, plastic: read by options on request
function readAsked(   g, v, name) {
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
  if (word[1] == "plastic") {
    if (space || state == "stress") no("plastic: in plane strain and about an axis only; allowed: state strain or axisymmetric, in parts.edp")
    if (ENVIRON["FLOWS"] == "") no("plastic: read by parts.edp alone; allowed here: elastic bodies")
    g = group(dim)
    once("plastic" SUBSEP g, "plastic " nameOf[g])
    v[0] = number("the yield stress", 0, 1e300)
    v[1] = number("the hardening modulus", -1e-300, 1e300)
  }
  put(g + 0, 0, name, "none", "none", v)
}
function single() {
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
  if (legs > 1 && word[1] !~ /^(leg|obstacle|move|rotate|force|moment|pressure|traction|weight)$/)
    no(word[1] ": in leg " legs ", but it holds in every leg; allowed there: move, rotate, pressure, traction, weight, a free force or moment, an obstacle\047s move")
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
    else if (word[1] == "cut") readCut()
    else if (word[1] == "join") readJoin()
    else if (word[1] ~ /^(stresses|line|expand|preload|plastic)$/) readAsked()
    else if (word[1] ~ /^(conduct|temperature|flux|film)$/) readHeat()
    else if (word[1] == "force" && pushedFreely()) readPushed()
    else if (word[1] == "moment") readMoment()
    else if (word[1] == "about") readAbout()
    else if (word[1] == "spring") readSpring()
    else if (word[1] == "spin") readSpin()
    else if (word[1] == "gravity") readGravity()
    else if (word[1] == "cycles") readCycles()
    else readOther()
  }
  if (at < words) no(word[at + 1] ": more than the statement takes; " usageOf(word[1]))
}
END {
  if (failed) exit 1
  finishing = 1
  putBodyLoads()
  checkHeat()
  checkWear()
  if (!statements) no("it has no statement; allowed: at least body and contact or obstacle")
  for (k = 1; k <= names; k++)
    if (dimOf[k] == dim && ENVIRON["SETS_OVERLAP"] == "" && !(("body" SUBSEP place[dim, nameIn[k]]) in seen))
      no("nothing says what the " kind[dim] " " nameIn[k] " is made of; allowed: a line body " nameIn[k] " E number nu number")
  for (g in slaves)
    if (g in heldBy) no("line " slaves[g] ": " nameOf[g] ": a slave that line " heldIn[g] " holds (" heldBy[g] "); allowed: the other surface as slave")
  for (g in loadLine)
    if (g in heldBy && heldBy[g] != "force")
      no("line " loadLine[g] ": " nameOf[g] ": a " loadWord[g] " on what line " heldIn[g] " holds (" heldBy[g] ") does nothing; allowed: on another group")
  for (g in cutIn) if (!(("preload" SUBSEP g) in seen)) no("line " cutIn[g] ": cut " nameOf[g] ": nothing tightens it; allowed: a line preload " nameOf[g] " force")
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
