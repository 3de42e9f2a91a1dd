# case-pushed.awk: forces that hold nothing or a rigid group, moments, the point of moments, spin, gravity, springs
# Read by awk before case-file.awk, whose functions it uses. A force that is `free` and a moment become the statement "spread" of the
# table: nodal loads on a group that stays elastic. One that is `rigid`, and a moment `about` a point, become the statement "force",
# with the word in place of a shape: the group is held rigid, and moves as the word says.
# Numbers of both: the force or moment (3), the point of a force `at` it or of a moment `about` it (3), 1 if there is one.

# [at x y z], or about: the point, behind the numbers of the load
function readPoint(word_, v) {
  if (at >= words || word[at + 1] != word_) return 0
  at++
  vector("the point of " word_, 0, v, 3)
  v[6] = 1
  return 1
}
# of a force: whether one of these words stands behind its numbers
function pushedFreely(   k) {
  for (k = 3; k <= words; k++) if (word[k] ~ /^(free|rigid|at)$/) return 1
  return 0
}
function putPushed(g, how, kind, v,   word_) {
  word_ = how == "free" ? "spread" : "force"
  key_ = word_ SUBSEP kind SUBSEP g
  if (word_ == "force") {
    if (v[0] == 0 && v[1] == 0 && v[2] == 0) no(kind " " word[2] ": 0 of a rigid group; allowed: another number")
    if (legs > 1) no(nameOf[g] ": a rigid group\047s " kind " in two legs; allowed there: a " kind " that is free")
    holds(g)
  } else if (changed(key_)) { putChange(base[key_] - 1, v); return }
  else if (legs < 2) once(key_, "free " kind " on " nameOf[g])
  base[key_] = statements + 1
  if (word_ == "spread") { loadLine[g] = FNR; loadWord[g] = "free " kind }
  row(word_ " " FNR " " g " 0 " (how == "free" ? "none" : how) " " kind " none", v)
}
# force NAME x y [z] free or rigid [at x y z]
function readPushed(   g, v, how) {
  g = group(dim - 1)
  vector("the force", 0, v, 0)
  if (!legs) nonzero("the force", v, 0)
  if (axial && v[0] != 0) no(word[2] ": a force off the axis; allowed with state axisymmetric: along y")
  how = at < words ? word[++at] : ""
  if (how !~ /^(free|rigid)$/) no(how ": free or rigid must stand before it; " usageOf("force"))
  if (axial && how == "rigid") no("rigid: a ring moves along its axis alone, as the force without the word lets it; allowed: no word, or free")
  if (axial && at < words && word[at + 1] == "at") no("at: a ring has its force on the axis; allowed with state axisymmetric: no point")
  readPoint("at", v)
  putPushed(g, how, "force", v)
}
# moment NAME m [axis x y z] [free, rigid or about x y z]
function readMoment(   g, v, m, k, size, how) {
  g = group(dim - 1)
  if (axial) no("moment: a ring does not turn; allowed with state axisymmetric: none, in space a moment")
  m = any("the moment")
  if (m == 0 && !legs) no("moment " word[2] ": 0; allowed: another number")
  v[0] = v[1] = 0; v[2] = 1
  if (space) {
    keyword("axis")
    vector("the axis", 0, v, 0)
    nonzero("the axis", v, 0)
  }
  size = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2])
  for (k = 0; k < 3; k++) v[k] *= m / size
  how = "free"
  if (at < words && word[at + 1] ~ /^(free|rigid)$/) how = word[++at]
  else if (readPoint("about", v)) how = "about"
  putPushed(g, how, "moment", v)
}
# about NAME x y [z]: the point that moments are told about
function readAbout(   v, name) {
  once("about", "about")
  if (axial) no("about: a ring has no moments; allowed with state axisymmetric: none")
  if (at >= words) no("a name is missing after about; " usageOf("about"))
  name = word[++at]
  if (name !~ /^[A-Za-z0-9_-]+$/) no(name ": a name; allowed: letters, digits, - and _")
  vector("the point", 0, v, 0)
  row("about " FNR " 0 0 " name " none none", v)
}
# spring NAME kx ky [kz]: of the whole group, to the ground
function readSpring(   g, v, k) {
  g = group(dim - 1)
  once("spring" SUBSEP g, "spring of " nameOf[g])
  for (k = 0; k < 2 + space; k++) v[k] = number("the stiffness", -1e-300, 1e300)
  if (!v[0] && !v[1] && !v[2]) no("spring " word[2] ": no stiffness; allowed: one above 0")
  loadLine[g] = FNR; loadWord[g] = "spring"
  row("spring " FNR " " g " 0 none none none", v)
}
# spin BODY omega [about x y z] [axis x y z]: kept until the densities of all bodies are known
function readSpin(   g, v) {
  g = group(dim)
  once("spin" SUBSEP g, "spin of " nameOf[g])
  v[0] = any("the angular velocity")
  v[1] = v[2] = v[3] = v[4] = v[5] = 0; v[6] = 1
  if (axial) { v[5] = 1; v[6] = 0 }
  if (!axial && at < words && word[at + 1] == "about") { at++; vector("the point", 0, v, 1) }
  else if (space) keyword("about")
  if (space) { keyword("axis"); vector("the axis", 0, v, 4); nonzero("the axis", v, 4) }
  spins++
  spinLine[spins] = FNR; spinGroup[spins] = g
  for (k = 0; k < 7; k++) spinValue[spins, k] = v[k]
}
# gravity x y [z]: an acceleration, of all bodies with a density
function readGravity(   v) {
  once("gravity", "gravity")
  counted("the gravity")
  vector("the gravity", 0, v, 0)
  nonzero("the gravity", v, 0)
  if (axial && v[0] != 0) no("gravity off the axis; allowed with state axisymmetric: along y")
  for (k = 0; k < 3; k++) gravity[k] = v[k]
  gravityLine = FNR
}
# once all bodies are known: spins with their densities, and gravity as a weight of each body
function putBodyLoads(   k, n, g, v, some) {
  for (n = 1; n <= spins; n++) {
    g = spinGroup[n]
    if (!(g in density)) no("line " spinLine[n] ": spin " nameOf[g] ": the body has no density; allowed: body " nameOf[g] " E number nu number density number")
    for (k = 0; k < 7; k++) v[k] = spinValue[n, k]
    v[7] = density[g]
    row("spin " spinLine[n] " " g " 0 none none none", v)
  }
  if (!gravityLine) return
  for (g in density) {
    some = 1
    if (("weight" SUBSEP g) in seen) no("line " gravityLine ": gravity, and a weight of " nameOf[g] " in line " seen["weight", g] "; allowed: one of them")
  }
  if (!some) no("line " gravityLine ": gravity: no body has a density; allowed: body NAME E number nu number density number")
  for (g = 1; g <= groups; g++) if (g in density) {
    split("", v)
    for (k = 0; k < 3; k++) v[k] = gravity[k] * density[g]
    row("weight " gravityLine " " g " 0 none none none", v)
  }
}
