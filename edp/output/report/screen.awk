# screen.awk: the results of a run on screen, from its summary.json: numbers with errors, warnings, files; with -verbose 1 details
# Read by awk after json.awk. In the environment: FOLDER: of the results; ROWS: further rows; PLOT: the command that draws.
# An error has two digits, its value as many decimals; an error that exceeds its value is not known. A number that is rounding compared with
# others is shown as 0. Every number that is printed with an error is judged by doubt(): what is in doubt stands in a warning.
function floor(x,   i) { i = int(x); return i > x ? i - 1 : i }
function size(x) { return x < 0 ? -x : x }
function digits(x, n) { return sprintf("%." n "g", x) + 0 "" }
function exponent(x) { return floor(log(x) / log(10) + 1e-9) }
function decimals(x, error,   d) {          # of a value with this error; -1: significant digits instead
  if (error <= 0 || size(x) >= 1e9 || (x != 0 && size(x) < 1e-4)) return -1
  d = 1 - exponent(error)
  if (d > 0 && size(x) * 10 ^ d >= 1e15) return -1
  return d < 0 ? 0 : d
}
function significant(x, error,   n) {       # digits of x down to the second one of its error; without an error six
  n = error > 0 && x != 0 ? exponent(size(x)) - exponent(error) + 2 : 6
  return n < 1 ? 1 : (n > 15 ? 15 : n)
}
function shown(x, error,   d, unit) {
  if (error >= 100) { unit = 10 ^ (exponent(error) - 1); return sprintf("%.0f", sprintf("%.0f", x / unit) * unit) }
  d = decimals(x, error)
  return d < 0 ? sprintf("%." significant(x, error) "g", x) : sprintf("%." d "f", x)
}
function off(x, error,   d) {
  d = decimals(x, error)
  return d < 0 || error >= 100 || error < 1e-4 ? digits(error, 2) : sprintf("%." d "f", error)
}
function share(part, whole,   p) { p = size(100 * part / whole); return (p >= 1000 ? "more than 1000" : digits(p, 2)) " %" }
function percent(part, whole) { return whole == 0 ? "" : "(" share(part, whole) ")" }
function bounded(x, error) { return error > 0 && error < 1e-8 * size(x) ? 1e-8 * size(x) : error }  # no nearer than solutions are
function exceeds(x, error) { return error > size(x) && x != 0 }
function doubted(x, error) { return "error not known (estimate " share(error, x) ")" }
function leading(x) { return shown(x, 10 ^ (exponent(size(x)) - 1)) }  # three digits of x
function warn(text) { print "warning: " text }
function put(text) { sub(/ +$/, "", text); print text }
function row(name, text) { put(sprintf("  %-10s%s", name, text)) }
function result(name, x, error, unit, note) {  # error: 0 or less: none to show
  if (!minor) doubt(name, x, error)
  if (exceeds(x, error)) put(sprintf("  %-26s %14s%s %s", name, leading(x), unit == "" ? "" : " " unit, also(doubted(x, error), note)))
  else vanishing(name, x, error, unit, note)
}
# a number whose error exceeds doubtful of it; scale: what its error is to be compared with, if that is not the number itself
function doubt(name, x, error, scale,   k) {
  sub(/^ +/, "", name)
  sub(/^contact force$/, "force", name)
  name = name owner
  if (scale == "") scale = x
  if (scale == 0 || error <= doubtful * size(scale)) return
  for (k = 0; k < count[".warnings"]; k++) if (index(v[".warnings." k], "the error of the " name " ")) return
  doubts = also(doubts, name " " share(error, scale))
}
function vanishing(name, x, error, unit, note) {  # x may be 0, and its error exceed it
  error = bounded(x, error)
  if (unit != "") unit = " " unit
  if (error > 0) put(sprintf("  %-26s %14s ± %-8s%-" wide "s %-10s %s", name, shown(x, error), off(x, error), unit, percent(error, x), note))
  else put(sprintf("  %-26s %14s%s %s", name, sprintf("%.6g", x), unit, note))
}
function error(path) { return known(path ".error") ? v[path ".error"] + 0 : -1 }
function unknown(e) { return estimated && e < 0 ? "error not known" : "" }
function also(a, b) { return a != "" && b != "" ? a ", " b : a b }
function vector(path, n, from,   k, most, text, unit) {  # entries from ... from + n - 1, all with the last digit of the greatest one
  most = 0
  for (k = from; k < from + n; k++) if (size(v[path "." k]) > most) most = size(v[path "." k])
  unit = most > 0 ? 10 ^ (exponent(most) - 5) : 1
  for (k = from; k < from + n; k++) text = text (k > from ? ", " : "(") digits(unit * floor(v[path "." k] / unit + 0.5), 6)
  return text ")"
}
function worse(e, x, name, cure) {          # notes the greatest relative error; cure: what lowers it, if that is not the run's advice
  if (e > 0 && x != 0 && e / size(x) > worst) { worst = e / size(x); worstName = name; worstCure = cure }
}
function peaks(   c, i, n, head, field, column, least, most) {  # peak[c]: the place of the greatest pressure of contact c
  FS = ","
  if ((getline < (folder "contact.csv")) <= 0) return
  n = split($0, head, ",")
  for (i = 1; i <= n; i++) column[head[i]] = i
  while ((getline < (folder "contact.csv")) > 0) {
    c = $column["contact"]
    for (i = 1; i <= dimension; i++) {
      if (!((c, i) in least) || $i < least[c, i]) least[c, i] = $i + 0
      if (!((c, i) in most) || $i > most[c, i]) most[c, i] = $i + 0
      if (!(c in top) || $column["pressure"] > top[c]) place[c, i] = $i + 0
      if (size($i) > size(extent[c])) extent[c] = $i + 0
    }
    if (!(c in top) || $column["pressure"] > top[c]) top[c] = $column["pressure"] + 0
  }
  for (c in top) {
    n = 0
    for (i = 1; i <= dimension; i++) n += (most[c, i] - least[c, i]) ^ 2
    n = n > 0 ? 10 ^ floor(log(1e-3 * sqrt(n)) / log(10)) : 1e-300
    for (i = 1; i <= dimension; i++) peak[c] = peak[c] (i > 1 ? ", " : "at (") digits(n * floor(place[c, i] / n + 0.5), 6)
    peak[c] = peak[c] ")"
  }
}
function scene(   e, R) {
  e = error(".estimates.force")
  if (v[".parameters.force"] > 0) {
    result("approach", v[".approach"], error(".estimates.approach"), "", "")
    result("contact force", v[".force"], 0, "", "prescribed")
    worse(error(".estimates.approach"), v[".approach"], "approach")
  } else {
    if (error(".estimates.approach") > 0) result("approach", v[".approach"], error(".estimates.approach"), "", "")
    result("contact force", v[".force"], e, "", unknown(e))
    worse(e, v[".force"], "force")
  }
  if (v[".pressureMax"] == 0) return
  e = error(".estimates.pressureMax")
  result("greatest pressure", known(".estimates.pressureMax.value") ? v[".estimates.pressureMax.value"] : v[".pressureMax"], e, "", unknown(e))
  worse(e, v[".pressureMax"], "greatest pressure", pointwise() ? "use -points segment" : higher("refine at the contact (-h)"))
  if (known(".halfWidth")) result(v[".parameters.geometry"] == "axisymmetric" ? "contact radius" : "contact half-width", v[".halfWidth"], error(".estimates.halfWidth"), "", "")
  else if (dimension == 3) result("contact radius", v[".halfWidthMoment"], 0, "", also(unknown(-1), "by the second moment of the pressure"))
  if (v[".contacts.0.law"] != "signorini") result("greatest overlap", v[".overlapMax"], 0, "", unknown(-1))
  result("points in contact", v[".contactPoints"], 0, "", "of " v[".points"])
  R = dimension == 3 ? v[".reactionZ"] : v[".reactionY"]
  if (v[".force"] != 0 && size(R - v[".force"]) < 1e-4 * size(v[".force"]))
    print "  balance: contact force + support reaction = 0 (to " digits(size(R / v[".force"] - 1), 1) ")"
}
function higher(finer) { return (v[".order"] < (dimension == 3 ? 3 : 4) ? "raise -order, or " : "") finer }   # what the run does not have yet
function linear() { return v[".linearised.trusted"] == "true" && v[".parameters.distance"] != "exact" }
function pointwise() { return v[".parameters.points"] == "nodal" }   # between meshes that do not match averages are better
function friction(c,   p, k, x, m, s) {
  p = ".contacts." c
  if (!known(p ".stickShare") || v[".friction"] == 0 && !known(p ".tied")) return
  m = error(p ".mesh.shearForce")
  s = error(p ".loadSteps.shearForce")
  x = 0
  for (k = 0; k < count[p ".shearForce"]; k++) x += v[p ".shearForce." k] ^ 2
  if (v[p ".tied"] == "false" && x == 0 && v[p ".stickShare"] == 0) return   # no friction, beside a tie
  if (!owned) print "  friction"
  twofold("shear force", sqrt(x), m, s, force, "on the slave " vector(p ".shearForce", count[p ".shearForce"], 0), 0.01 * v[p ".normalForce"])
  twofold("sticking part", 100 * v[p ".stickShare"], percents(p ".mesh.stickShare"), percents(p ".loadSteps.stickShare"), "%", "of the contact")
  twofold("dissipated", v[p ".dissipated"], -1, error(p ".loadSteps.dissipated"), "", "", 1e-3 * v[".work"])
  if (known(p ".mesh.dissipatedLastStep.value"))
    twofold("dissipated, last step", v[p ".mesh.dissipatedLastStep.value"], error(p ".mesh.dissipatedLastStep"), -1, "", \
      v[p ".mesh.dissipatedLastStep.value"] > 0 ? unknown(error(p ".mesh.dissipatedLastStep")) : "", 1e-3 * v[".work"])
}
# three digits of x, or fewer by its error: of the mesh, which may have a greater one, none is known
function few(x, e) { return x != 0 && e < 10 ^ (exponent(size(x)) - 1) ? leading(x) : shown(x, e) }
function percents(path,   e) {
  e = error(path)
  return e < 0 ? e : 100 * e
}
# two errors, of the mesh and of the load steps; whole: up to which the number is small, and its error is compared with that
function twofold(name, x, mesh, steps, unit, note, whole,   e) {
  e = bounded(x, mesh > steps ? mesh : steps)
  if (!minor) doubt(name, x, e, unit == "%" ? 100 : size(x) > whole ? x : whole)
  put(sprintf("    %-24s %14s%s%s %s %s", name, exceeds(x, e) ? digits(x, 2) : (mesh < 0 && steps >= 0 ? few(x, e) : shown(x, e)), mesh >= 0 ? " ± " digits(mesh, 2) " (mesh)" : "", \
    steps >= 0 ? " ± " digits(steps, 2) " (load steps)" : "", unit, note))
}
function contact(c,   p, q, k, F, e, x, note, across, unit, balanced, little) {
  p = ".contacts." c
  q = ".estimates.contacts." c
  F = 0
  for (k = 0; k < count[p ".force"]; k++) F += v[p ".force." k] ^ 2
  F = sqrt(F)
  note = v[p ".contactPoints"] == 0 ? " touches nowhere" : (v[p ".normalForce"] <= 1e-12 * mostForce && F <= 1e-12 * mostForce ? " touches, but carries nothing" : "")
  print "  contact " v[p ".name"] note
  if (note != "") return
  owner = " of " v[p ".name"]
  balanced = F < 1e-3 * v[p ".normalForce"]   # pressures all round, as of a press fit: the resultant is 0 but for errors
  e = ofWear(c, error(q ".force"), "normalForce")
  across = ""
  for (k = 0; k < count[p ".across"]; k++) across = across (k ? ", " : "without its part across ") "symmetry " v[p ".across." k]
  note = e >= 0 && e <= 1e-8 * F && !driven ? "exact by equilibrium" : (e >= 0 ? (exceeds(F, e) && !balanced ? doubted(F, e) : "± " digits(e, 2) (balanced ? "" : " " percent(e, F))) : unknown(e))
  put(sprintf("    %-24s %14s %s  %s", "resultant force", vector(p ".force", count[p ".force"], 0), force, also(also(note, turned(c, e)), across)))
  minor = little = v[p ".normalForce"] < 1e-3 * mostForce
  if (!balanced && !little) doubt("resultant force", F, e)
  if (!balanced && !little) worse(e, F, "force of " v[p ".name"], bySteps == "" ? "" : "raise the steps after cycles")
  e = ofWear(c, error(q ".normalForce"), "normalForce")
  result("  normal force", (size(v[p ".normalForce"]) < 1e-12 * F ? 0 : v[p ".normalForce"]), e, force, also(unknown(e), bySteps))
  if (!little) worse(e, v[p ".normalForce"], "normal force of " v[p ".name"], bySteps == "" ? "" : "raise the steps after cycles")
  e = ofWear(c, error(q ".pressureMax"), "pressureMax")
  result("  greatest pressure", known(q ".pressureMax.value") ? v[q ".pressureMax.value"] : v[p ".pressureMax"], e, v[".units.1"], also(also(unknown(e), bySteps), peak[c]))
  if (!little) worse(e, v[p ".pressureMax"], "greatest pressure of " v[p ".name"], linear() && \
    4 * size(v[".linearised.pressureMax." c]) > e ? "use -distance exact" : bySteps != "" ? "raise the steps after cycles" : known(p ".refine") ? v[p ".refine"] : \
    pointwise() && known(p ".master") ? "use -points segment" : higher("refine at the contact (size contact)"))
  e = error(q ".contactLength")
  x = dimension == 3 ? v[p ".area"] : v[p ".contactLength"]
  unit = v[".units.0"] (dimension == 3 && known(".units.0") ? "^2" : "")
  result(dimension == 3 ? "  contact area" : "  contact length", x, e, unit, also(unknown(e), v[p ".contactPoints"] " of " v[p ".points"] " points"))
  friction(c)
  owner = minor = ""
}
# whether the error e of a resultant is mostly that of its direction, which the true distance changes, in words
function turned(c, e,   k, p) {
  for (k = 0; k < count[".linearised.changes"]; k++) {
    p = ".linearised.changes." k
    if (linear() && v[p ".name"] == v[".contacts." c ".name"] && v[p ".kind"] == "force" && 2 * (sqrt(v[p ".change"] ^ 2 + v[p ".aside"] ^ 2) - size(v[p ".change"])) > 0.5 * e && e > 0)
      return "mostly of its direction: -distance exact computes it"
  }
  return ""
}
function ofWear(c, e, key) {                  # the error e, or where wear is followed that of its steps
  bySteps = ""
  if (e >= 0 || !(v[".wear.contacts." c ".coefficient"] > 0)) return e
  e = error(".wear.contacts." c "." key)
  bySteps = e >= 0 ? "by the wear steps" : "error not known"
  return e
}
function worn(c,   p, unit, left) {
  p = ".wear.contacts." c
  if (!(v[p ".coefficient"] > 0)) return
  owner = " of " v[".contacts." c ".name"]
  unit = v[".units.0"]
  left = known(p ".slide") ? "error of the mesh not known" : "errors of mesh and load steps not known"
  wornRow("worn depth", p ".depth", unit, left)
  wornRow("worn volume", p ".volume", unit == "" ? "" : unit (dimension == 3 || v[".state"] == "axisymmetric" ? "^3" : "^2"), left)
  owner = ""
}
function wornRow(name, path, unit, left,   e) {
  e = error(path)
  doubt(name, v[path ".value"], e)
  put(sprintf("    %-24s %14s%s %s  %s", name, e >= 0 ? few(v[path ".value"], e) : shown(v[path ".value"], e), e >= 0 ? " ± " off(v[path ".value"], e) " (wear steps)" : "", unit, \
    e >= 0 ? left : "error not known"))
}
function stresses(   k, p, e, unit) {
  unit = v[".units.1"]
  for (k = 0; k < count[".stresses"]; k++) {
    p = ".stresses." k
    e = error(p)
    if (k == 0) print "  greatest von Mises stress"
    owner = ": greatest von Mises stress"
    result("  " v[p ".body"], v[p ".vonMises"], e, unit, also(unknown(e), "at " vector(p ".at", dimension, 0)))
    if (count[p ".singular"] > 0) print "      singular at " vector(p ".singular", dimension, 0) ": no bound there"
    if (known(p ".yield"))
      print "      " (v[p ".above"] == 0 ? "nowhere above the yield stress " v[p ".yield"] : "above the yield stress " v[p ".yield"] " in " \
        digits(100 * v[p ".above"], 3) " % of its volume: it would yield there")
  }
  owner = ""
}
function turns(p) { return v[p ".name"] ~ /^moment / }
function moves(p) { return v[p ".name"] (turns(p) ? " turns" : (v[p ".name"] == "all loads" ? " move" : " moves")) }
function moments(   k, p, i, e, m, unit, note, some) {
  unit = turning
  for (k = 0; k < count[".moments"]; k++) {
    p = ".moments." k
    if (v[p ".printed"] != "true") continue
    if (!some++) print "  moments" (v[p ".point"] == "" ? "" : " about " v[p ".point"] " " vector(p ".about", dimension, 0))
    note = also("on " v[p ".body"], v[p ".point"] == "" ? "about " vector(p ".about", dimension, 0) : "")
    e = error(p)
    if (dimension == 2) { vanishing("  " v[p ".name"], v[p ".moment.0"], e, unit, note); continue }
    m = 0
    for (i = 0; i < 3; i++) m += v[p ".moment." i] ^ 2
    put(sprintf("    %-24s %14s %s  %s", v[p ".name"], vector(p ".moment", 3, 0), unit, also(note, e > 0 ? "size " shown(m ^ 0.5, e) " ± " off(m ^ 0.5, e) " " percent(e, m ^ 0.5) : "")))
  }
}
function heat(   k, p, most) {
  print "  heat, errors not known"
  for (k = 0; k < count[".heat.bodies"]; k++) {
    p = ".heat.bodies." k
    put(sprintf("    %-24s %14s", v[p ".name"] " is at", digits(v[p ".least"], 6) " to " digits(v[p ".greatest"], 6)))
  }
  most = v[".heat.in"] > v[".heat.out"] ? v[".heat.in"] : v[".heat.out"]
  for (k = 0; k < count[".heat.contacts"]; k++) {
    p = ".heat.contacts." k
    result("  " v[p ".name"] " conducts", rounded(v[p ".heat"], most), 0, "", known(p ".jump") ? "over a jump of " digits(v[p ".jump"], 6) ", mean conductance " digits(v[p ".conductance"], 6) : "")
  }
  for (k = 0; k < count[".heat.groups"]; k++)
    result("  " v[".heat.groups." k ".name"] " gives", rounded(v[".heat.groups." k ".heat"], most), 0, "", "")
  if (most > 0) print "    heat in = heat out (to " digits(size(v[".heat.in"] - v[".heat.out"]) / most, 1) ")"
}
function rounded(x, most) { return size(x) < 1e-9 * most ? 0 : x + 0 }
# of a force or moment of a unit of thickness, that of the whole thickness
function thick(x, word,   unit) {
  if (dimension == 3 || v[".state"] == "axisymmetric" || v[".thickness"] == 1) return ""
  unit = whole == "" ? "" : " " whole (word == "moment" ? " " v[".units.0"] : "")
  return digits(x * v[".thickness"], 6) unit " for the thickness " v[".thickness"]
}
function own(   k, p, e, word, times, j, with) {
  for (k = 0; k < count[".prescribed"]; k++)
    if (v[".prescribed." k ".name"] ~ /^(move|rotate) / || (v[".prescribed." k ".name"] ~ /^obstacle/ && movedObstacle)) driven = 1
  if (thick(1) != "") print "  forces, moments, work and heat are those of a unit of thickness; all " v[".thickness"] " carry " v[".thickness"] " times as much"
  for (k = 0; k < count[".contacts"]; k++) if (v[".contacts." k ".normalForce"] > mostForce) mostForce = v[".contacts." k ".normalForce"]
  for (k = 0; k < count[".contacts"]; k++) { contact(k); worn(k) }
  if (v[".wear.stepsError"] ~ /^not known/) print "  error of the wear steps " v[".wear.stepsError"]
  for (k = 0; k < count[".prescribed"]; k++) {
    p = ".prescribed." k
    word = (p ".moment") in v ? "moment" : "force"
    e = error(p)
    times = thick(v[p "." word], word)
    if (v[p ".cancelled"] > 0) times = also(times, "its mirror images cancel " (v[p ".cancelled"] > 1 - 1e-6 ? "it" : "a part of it"))
    else if (v[p ".times"] == "null") times = also(times, "of the whole not known: its symmetries do not meet at 90, 60, 45 or another 180/n degrees")
    else if (v[p ".times"] > 1) {
      with = "of the whole "
      for (j = 0; j < count[p ".images"]; j++) with = (j ? with " and " : "with its image in symmetry ") v[p ".images." j] " "
      times = also(times, with v[p ".times"] " times as much: " also(digits(v[p ".times"] * v[p "." word], 6), thick(v[p ".times"] * v[p "." word], word)))
    }
    if (known(p ".arm")) times = also(times, "to within " digits(v[p ".arm"], 2) ": few points carry, the place of the force is not known better")
    if (v[p ".name"] ~ /^(move|rotate|obstacle) /) {
      vanishing(v[p ".name"] ": " word, v[p "." word], e, word == "force" ? force : turning, also(unknown(e), times))
      worse(e, v[p "." word], word " of " v[p ".name"])
      if (word == "force" && size(v[p ".force"]) > 1e-3 * mostForce) doubt("force of " v[p ".name"], v[p ".force"], e)
    } else if (times != "") result(v[p ".name"], v[p "." word], 0, word == "force" ? force : turning, times)
  }
  for (k = 0; k < count[".ways"]; k++) {
    p = ".ways." k
    e = error(".estimates.loads." k ".way")
    result(moves(p), v[p ".way"], e, turns(p) ? "rad" : v[".units.0"], unknown(e))
    worse(e, v[p ".way"], "displacement of " v[p ".name"])
  }
  for (k = 0; k < count[".supports"]; k++)
    put(sprintf("  %-26s %14s %s", v[".supports." k ".name"] " carries", vector(".supports." k ".force", count[".supports." k ".force"], 0), force))
  for (k = 0; k < count[".guides"]; k++)
    if (v[".guides." k ".carries"] == "true")
      put(sprintf("  %-26s %14s %s", "guide of " v[".guides." k ".name"] " carries", vector(".guides." k ".force", count[".guides." k ".force"], 0), force))
  moments()
  for (k = 0; k < count[".preloads"]; k++) {
    p = ".preloads." k
    e = known(p ".error") ? v[p ".error"] : -1
    result("preload " v[p ".name"], v[p ".force"], e, force, "under the loads; tightened to " also(digits(v[p ".preload"], 6), thick(v[p ".preload"], "force")) ", shortened by " \
      (e < 0 ? digits(v[p ".shortened"], 6) ", errors not known" : shown(v[p ".shortened"], v[p ".shortenedError"]) " ± " off(v[p ".shortened"], v[p ".shortenedError"])))
  }
  stresses()
  if (known(".heat.rounds")) heat()
}
function plastic(   k, p, c, s, unit) {     # bodies that yield: of the mesh no error is known
  if (v[".plastic.yielded"] != "true") { print "  no body yields: the results are elastic ones"; return }
  unit = v[".units.0"] (known(".units.0") ? (v[".state"] == "axisymmetric" ? "^3" : "^2") : "")
  print "  plastic strains, in " v[".plastic.steps"] " load steps and " v[".plastic.iterations"] " iterations: the error of the mesh is not known"
  for (k = 0; k < count[".plastic.bodies"]; k++) {
    p = ".plastic.bodies." k
    twofold("greatest of " v[p ".body"], v[p ".strainMax"], -1, known(p ".strainMaxError") ? v[p ".strainMaxError"] : -1, "", "at " vector(p ".at", 2, 0))
    twofold("yielded " (v[".state"] == "axisymmetric" ? "volume" : "area"), v[p ".volume"], -1, known(p ".volumeError") ? v[p ".volumeError"] : -1, unit, \
      "(" digits(100 * v[p ".share"], 3) " % of " v[p ".body"] ")")
  }
  for (c = 0; c < count[".contacts"]; c++) {
    p = ".plastic.contacts." c
    if (!known(p ".normalForceError") || v[".contacts." c ".contactPoints"] == 0) continue
    twofold("force of " v[".contacts." c ".name"], v[".contacts." c ".normalForce"], -1, v[p ".normalForceError"], force, "")
    twofold("greatest pressure", v[".contacts." c ".pressureMax"], -1, v[p ".pressureMaxError"], v[".units.1"], "")
  }
  twofold("dissipated", v[".plastic.dissipated"], -1, known(".plastic.dissipatedError") ? v[".plastic.dissipatedError"] : -1, "", "", 1e-3 * v[".plastic.work"])
  s = v[".plastic.storedElastic"] + v[".plastic.storedByHardening"]
  print "  work on the bodies " digits(v[".plastic.work"], 6) ", stored " digits(s, 6) ", dissipated " digits(v[".plastic.dissipated"], 6) \
    ", left over " digits(v[".plastic.work"] - s - v[".plastic.dissipated"], 2)
  if (v[".plastic.loadStepsError"] != "measured") print "  error of the load steps " v[".plastic.loadStepsError"]
}
function path(   e) {
  e = known(".pathErrors.pullOff") ? v[".pathErrors.pullOff"] : -1
  result("least force", v[".pullOff"], e, "", "at the approach " digits(v[".pullOffApproach"], 6))
  result("jumps", count[".jumps"], 0, "", "")
  result("dissipated in jumps", v[".dissipated"], known(".pathErrors.dissipated") ? v[".pathErrors.dissipated"] : -1, "", "")
  result("work along the path", v[".loopWork"], known(".pathErrors.loopWork") ? v[".pathErrors.loopWork"] : -1, "", "")
  result("work by the forces", v[".workByForces"], 0, "", "")
  if (v[".pathErrors.notKnown"] != "") print "  not known of the path: " v[".pathErrors.notKnown"]
}
function details(   k, n, p, list, text, width) {
  print "\nDetails"
  row("solver", "models " v[".adaptations"] ", Newton steps " v[".newton"] ", residual " digits(v[".residual"], 3) ", model error " digits(v[".modelError"], 3))
  row("", "unknowns " v[".ndof"] ", factorisations " v[".factorisations"] ", back-substitutions " v[".backsolves"] \
    (v[".iterations"] > 0 ? ", their iterations " v[".iterations"] : "") ", cost ratio " digits(v[".costRatio"], 3))
  row("points", "in contact " v[".contactPoints"] " of " v[".points"] ", at the wall " v[".wallPoints"] ", greatest overlap " digits(v[".overlapMax"], 6))
  if (estimated) {
    p = ".estimates.parts."
    row("errors", (known(".estimates.worst") ? v[".estimates.worst"] : "as force") ": inside the bodies " digits(v[p "inside"], 2) \
      ", on the contact line " digits(v[p "line"], 2) ", model " digits(v[p "model"], 2) ", shape " digits(v[p "geometry"], 2) \
      ", algebra " digits(v[p "algebra"], 2))
    if (v[".estimates.refine"] != "") row("", "to lower the greatest, " v[".estimates.refine"])
  }
  if (v[".linearised.trusted"] == "true") {
    for (k = 0; k < count[".linearised.changes"]; k++) {
      p = ".linearised.changes." k
      text = also(text, v[p ".name"] " " (v[p ".kind"] == "way" ? "displacement" : v[p ".kind"]) " " digits(v[p ".change"], 2))
    }
    for (k = 0; k < count[".linearised.pressureMax"]; k++) text = also(text, v[".contacts." k ".name"] " greatest pressure " digits(v[".linearised.pressureMax." k], 2))
    row("linear", "change by the true distance and finite rotations, twice in the errors: " text)
  }
  for (k = 0; k < count[".bodies"]; k++) {
    p = ".bodies." k
    n = count[p ".motion"]
    row("body", v[p ".name"] " moved " vector(p ".motion", dimension, 0) (n == 2 ? "" : ", turned " \
      (dimension == 3 ? vector(p ".motion", 3, 3) : digits(v[p ".motion.2"], 6))) ", its supports carry " vector(p ".reaction", dimension, 0))
  }
  if (known(".geometryCorrection")) row("surfaces", "smooth ones differ from those of the mesh by " digits(v[".geometryCorrection"], 3) " at most")
  print "\nFlags"
  n = split(substr(names[".parameters"], 2), list, SUBSEP)
  for (k = 1; k <= n; k++) {
    p = "-" list[k] " " v[".parameters." list[k]]
    if (width > 0 && width + length(p) > 110) { printf "\n"; width = 0 }
    printf "  %-22s", p
    width += length(p) > 22 ? length(p) + 2 : 24
  }
  printf "\n"
}
END {
  parse("")
  folder = ENVIRON["FOLDER"]
  dimension = (".reactionZ" in v) ? 3 : 2
  estimated = ".estimates.parts.inside" in v
  owned = ".bodies.0.name" in v
  worst = wide = 0
  doubtful = 0.3
  if (v[".units.0"] " " v[".units.1"] ~ /^(mm MPa|m Pa)$/) {
    whole = "N"
    force = dimension == 3 || v[".state"] == "axisymmetric" ? whole : whole "/" v[".units.0"]
    turning = force == whole ? "N " v[".units.0"] : whole
  }
  if (known(".units.0")) wide = 1 + (length(force) > 4 ? length(force) : 4)
  cost = v[".newton"] (v[".newton"] == 1 ? " iteration" : " iterations") (v[".adaptations"] > 1 ? ", " v[".adaptations"] " models" : "") ", " digits(v[".seconds.total"], 2) " s"
  if (v[".converged"] != "true") {
    print "NOT CONVERGED: " v[".message"]
    print "  residual " digits(v[".residual"], 2) " (tolerance " v[".parameters.tol"] + 0 ") after " cost "; there are no results"
  } else {
    if (v[".accuracy.met"] == "false") {
      print "ACCURACY NOT REACHED: " (known(".accuracy.reached") ? "estimated relative error of the " v[".accuracy.goal"] " " digits(v[".accuracy.reached"], 2) ", " : "") \
        "wanted " v[".accuracy.asked"] + 0 ": " v[".accuracy.why"]
      print "  solved in " cost
    } else print "converged in " cost
    print "\nResults (" (estimated ? "± estimated error" : (v[".notEstimated"] == "" ? "without error estimates" : "no error estimate: " v[".notEstimated"])) ")"
    if (owned) {
      peaks()
      own()
    } else {
      scene()
      friction(0)
    }
    if (known(".dragged.value")) twofold("dragged by", v[".dragged.value"], error(".dragged"), -1, "", "")
    if (known(".creepage")) result("creepage", v[".creepage"], 0, "", "of the length rolled")
    if (v[".friction"] > 0) {
      print "  work of the loads " digits(v[".work"], 6) ", stored " digits(v[".stored"], 6) ", dissipated " digits(v[".dissipated"], 6) \
        ", left over " digits(v[".work"] - v[".stored"] - v[".dissipated"], 2)
      if (v[".loadStepsError"] ~ /^not known/) print "  error of the load steps " v[".loadStepsError"]
      if (estimated) print "  the errors of the mesh are those of the last load step"
      if (estimated && owned && v[".parameters.distance"] == "linear" && !(".linearised.trusted" in v)) print "  the change by -distance exact is not in the errors"
    }
    if (".plastic.steps" in v) plastic()
    if (".pullOff" in v) path()
    if (known(".stability")) print "  the state is " (v[".stability"] > 0 ? "stable" : "NOT STABLE") " (lowest eigenvalue of its tangent " digits(v[".stability"], 3) ")"
    if (ENVIRON["ROWS"] != "") print substr(ENVIRON["ROWS"], 2)
  }
  for (k = 0; k < count[".warnings"]; k++) warn(v[".warnings." k])
  if (doubts != "") warn("estimated error above " 100 * doubtful " %: " doubts ". Do not use these numbers before a finer run confirms them.")
  if (v[".converged"] == "true" && count[".warnings"] == 0 && doubts == "") print "  no warnings"
  print ""
  if (worstCure == "") worstCure = v[".estimates.refine"]
  if (v[".converged"] == "true" && worst > 0.01 && worstCure != "") row("finer", worstCure ": the error of the " worstName " is " share(worst, 1))
  row("files", folder (v[".converged"] == "true" ? "" : " (the last state, for diagnosis)"))
  if (v[".converged"] == "true" && ENVIRON["PLOT"] != "") row("plot", ENVIRON["PLOT"])
  if (v[".parameters.verbose"] == 1) details()
  else row("more", "-verbose 1: error contributions, solver statistics, all flags")
}
