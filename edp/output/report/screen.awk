# screen.awk: the results of a run on screen, from its summary.json: numbers with errors, warnings, files; with -verbose 1 details
# Read by awk after json.awk and numbers.awk. In the environment: FOLDER: of the results; ROWS: further rows; PLOT: the command that draws.
# An error that exceeds its value is printed as not known. A number below rounding of others is printed as 0. Each result goes through
# noteLargeError(): one warning lists all with an error above largeErrorLimit.
# Globals, set at END: v, count: of json.awk; estimated: the run has error estimates; isCase: it is a case, not a scene; forceUnit, momentUnit,
# contactForceUnit (in the plane per length): texts of units; ownerText: " of NAME" behind names of results; worst...: greatest relative error.
function printWarning(text) { print "warning: " text }
function printTrimmed(text) { sub(/ +$/, "", text); print text }  # prints without trailing blanks
function printRow(name, text) { printTrimmed(sprintf("  %-10s%s", name, text)) }  # a row of the details: name and text
function printResult(name, x, error, unit, note) {  # a row: name, x ± error with unit and note; no error is shown if it is 0 or less
  if (!isMinor) noteLargeError(name, x, error)
  if (errorExceedsValue(x, error)) printTrimmed(sprintf("  %-26s %14s%s %s", name, threeDigits(x), unit == "" ? "" : " " unit, joinNotes(unknownErrorText(x, error), note)))
  else printResultNearZero(name, x, error, unit, note)
}
# adds the result to the warning largeErrors if its error exceeds largeErrorLimit times its size, or `scale` if given
function noteLargeError(name, x, error, scale,   k) {
  sub(/^ +/, "", name)
  sub(/^contact force$/, "force", name)
  name = name ownerText
  if (scale == "") scale = x
  if (scale == 0 || error <= largeErrorLimit * absolute(scale)) return
  for (k = 0; k < count[".warnings"]; k++) if (index(v[".warnings." k], "the error of the " name " ")) return
  largeErrors = joinNotes(largeErrors, name " " percentText(error, scale))
}
function printResultNearZero(name, x, error, unit, note) {  # the same for an x that may be 0, so that its error may exceed it
  error = atLeastRounding(x, error)
  if (unit != "") unit = " " unit
  if (error > 0) printTrimmed(sprintf("  %-26s %14s ± %-8s%-" unitWidth "s %-10s %s", name, valueText(x, error), errorText(x, error), unit, bracketedPercent(error, x), note))
  else printTrimmed(sprintf("  %-26s %14s%s %s", name, sprintf("%.6g", x), unit, note))
}
function errorOf(path) { return known(path ".error") ? v[path ".error"] + 0 : -1 }  # the error in summary.json of the result at this path, -1: none
function unknownErrorNote(e) { return estimated && e < 0 ? "error not known" : "" }  # text for an estimate without an error (e < 0)
function joinNotes(a, b) { return a != "" && b != "" ? a ", " b : a b }  # both texts, with a comma between them if neither is empty
function vectorText(path, n, from,   k, greatest, text, unit) {  # v[path.from] ... (n entries) as (x, y, z), all down to the sixth digit of the greatest
  greatest = 0
  for (k = from; k < from + n; k++) if (absolute(v[path "." k]) > greatest) greatest = absolute(v[path "." k])
  unit = greatest > 0 ? 10 ^ (decimalExponent(greatest) - 5) : 1
  for (k = from; k < from + n; k++) text = text (k > from ? ", " : "(") roundDigits(unit * floor(v[path "." k] / unit + 0.5), 6)
  return text ")"
}
function noteWorstError(e, x, name, advice) {  # keeps the greatest relative error e/x, with its name and the advice that lowers it
  if (e > 0 && x != 0 && e / absolute(x) > worst) { worst = e / absolute(x); worstName = name; worstAdvice = advice }
}
function findPressurePeaks(   c, i, n, head, field, column, smallest, greatest) {  # peak[c]: text with the position of the greatest pressure of contact c, from contact.csv
  FS = ","
  if ((getline < (folder "contact.csv")) <= 0) return
  n = split($0, head, ",")
  for (i = 1; i <= n; i++) column[head[i]] = i
  while ((getline < (folder "contact.csv")) > 0) {
    c = $column["contact"]
    for (i = 1; i <= dimension; i++) {
      if (!((c, i) in smallest) || $i < smallest[c, i]) smallest[c, i] = $i + 0
      if (!((c, i) in greatest) || $i > greatest[c, i]) greatest[c, i] = $i + 0
      if (!(c in top) || $column["pressure"] > top[c]) place[c, i] = $i + 0
      if (absolute($i) > absolute(extent[c])) extent[c] = $i + 0
    }
    if (!(c in top) || $column["pressure"] > top[c]) top[c] = $column["pressure"] + 0
  }
  for (c in top) {
    n = 0
    for (i = 1; i <= dimension; i++) n += (greatest[c, i] - smallest[c, i]) ^ 2
    n = n > 0 ? 10 ^ floor(log(1e-3 * sqrt(n)) / log(10)) : 1e-300
    for (i = 1; i <= dimension; i++) peak[c] = peak[c] (i > 1 ? ", " : "at (") roundDigits(n * floor(place[c, i] / n + 0.5), 6)
    peak[c] = peak[c] ")"
  }
}
function printScene(   e, R) {  # results of a built-in scene
  e = errorOf(".estimates.force")
  if (v[".parameters.force"] > 0) {
    printResult("approach", v[".approach"], errorOf(".estimates.approach"), "", "")
    printResult("contact force", v[".force"], 0, "", "prescribed")
    noteWorstError(errorOf(".estimates.approach"), v[".approach"], "approach")
  } else {
    if (errorOf(".estimates.approach") > 0) printResult("approach", v[".approach"], errorOf(".estimates.approach"), "", "")
    printResult("contact force", v[".force"], e, "", unknownErrorNote(e))
    noteWorstError(e, v[".force"], "force")
  }
  if (v[".pressureMax"] == 0) return
  e = errorOf(".estimates.pressureMax")
  printResult("greatest pressure", known(".estimates.pressureMax.value") ? v[".estimates.pressureMax.value"] : v[".pressureMax"], e, "", unknownErrorNote(e))
  noteWorstError(e, v[".pressureMax"], "greatest pressure", hasNodalPoints() ? "use -points segment" : orderAdvice("refine at the contact (-h)"))
  if (known(".halfWidth")) printResult(v[".parameters.geometry"] == "axisymmetric" ? "contact radius" : "contact half-width", v[".halfWidth"], errorOf(".estimates.halfWidth"), "", "")
  else if (dimension == 3) printResult("contact radius", v[".halfWidthMoment"], 0, "", joinNotes(unknownErrorNote(-1), "by the second moment of the pressure"))
  if (v[".contacts.0.law"] != "signorini") printResult("greatest overlap", v[".overlapMax"], 0, "", unknownErrorNote(-1))
  printResult("points in contact", v[".contactPoints"], 0, "", "of " v[".points"])
  R = dimension == 3 ? v[".reactionZ"] : v[".reactionY"]
  if (v[".force"] != 0 && absolute(R - v[".force"]) < 1e-4 * absolute(v[".force"]))
    print "  balance: contact force + support reaction = 0 (to " roundDigits(absolute(R / v[".force"] - 1), 1) ")"
}
function orderAdvice(finer) { return (v[".order"] < (dimension == 3 ? 3 : 4) ? "raise -order, or " : "") finer }  # advice to refine; with a higher -order where the run can have one
function isLinearised() { return v[".linearised.trusted"] == "true" && v[".parameters.distance"] != "exact" }  # the run estimated the change by exact distance, and did not use it
function hasNodalPoints() { return v[".parameters.points"] == "nodal" }  # overlaps of nodes; segment averages are more accurate on meshes that do not match
function printFriction(c,   p, k, x, m, s) {  # results of friction in contact c
  p = ".contacts." c
  if (!known(p ".stickShare") || v[".friction"] == 0 && !known(p ".tied")) return
  m = errorOf(p ".mesh.shearForce")
  s = errorOf(p ".loadSteps.shearForce")
  x = 0
  for (k = 0; k < count[p ".shearForce"]; k++) x += v[p ".shearForce." k] ^ 2
  if (v[p ".tied"] == "false" && x == 0 && v[p ".stickShare"] == 0) return   # a contact without friction in a case with a tie
  if (!isCase) print "  friction"
  printTwoErrors("shear force", sqrt(x), m, s, contactForceUnit, "on the slave " vectorText(p ".shearForce", count[p ".shearForce"], 0), 0.01 * v[p ".normalForce"])
  printTwoErrors("sticking part", 100 * v[p ".stickShare"], percentError(p ".mesh.stickShare"), percentError(p ".loadSteps.stickShare"), "%", "of the contact")
  printTwoErrors("dissipated", v[p ".dissipated"], -1, errorOf(p ".loadSteps.dissipated"), "", "", 1e-3 * v[".work"])
  if (known(p ".mesh.dissipatedLastStep.value"))
    printTwoErrors("dissipated, last step", v[p ".mesh.dissipatedLastStep.value"], errorOf(p ".mesh.dissipatedLastStep"), -1, "", \
      v[p ".mesh.dissipatedLastStep.value"] > 0 ? unknownErrorNote(errorOf(p ".mesh.dissipatedLastStep")) : "", 1e-3 * v[".work"])
}
function fewDigits(x, e) { return x != 0 && e < 10 ^ (decimalExponent(absolute(x)) - 1) ? threeDigits(x) : valueText(x, e) }  # x with at most three digits, because the error e is only a part of its error
function percentError(path,   e) {  # errorOf in percent; -1: none
  e = errorOf(path)
  return e < 0 ? e : 100 * e
}
# a row with two errors, of the mesh and of the load steps (-1: none); errors of an x below `scale` are compared with `scale`
function printTwoErrors(name, x, mesh, steps, unit, note, scale,   e) {
  e = atLeastRounding(x, mesh > steps ? mesh : steps)
  if (!isMinor) noteLargeError(name, x, e, unit == "%" ? 100 : absolute(x) > scale ? x : scale)
  printTrimmed(sprintf("    %-24s %14s%s%s %s %s", name, errorExceedsValue(x, e) ? roundDigits(x, 2) : (mesh < 0 && steps >= 0 ? fewDigits(x, e) : valueText(x, e)), mesh >= 0 ? " ± " roundDigits(mesh, 2) " (mesh)" : "", \
    steps >= 0 ? " ± " roundDigits(steps, 2) " (load steps)" : "", unit, note))
}
function printContact(c,   p, q, k, F, e, x, note, across, unit, balanced, isSmall) {  # results of contact c of a case
  p = ".contacts." c
  q = ".estimates.contacts." c
  F = 0
  for (k = 0; k < count[p ".force"]; k++) F += v[p ".force." k] ^ 2
  F = sqrt(F)
  note = v[p ".contactPoints"] == 0 ? " touches nowhere" : (v[p ".normalForce"] <= 1e-12 * maxContactForce && F <= 1e-12 * maxContactForce ? " touches, but carries nothing" : "")
  print "  contact " v[p ".name"] note
  if (note != "") return
  ownerText = " of " v[p ".name"]
  balanced = F < 1e-3 * v[p ".normalForce"]   # pressures all round, as in a press fit: the resultant is 0 except for errors
  e = contactError(c, errorOf(q ".force"), "normalForce")
  across = ""
  for (k = 0; k < count[p ".across"]; k++) across = across (k ? ", " : "without its part across ") "symmetry " v[p ".across." k]
  note = e >= 0 && e <= 1e-8 * F && !drivenByMotion ? "exact by equilibrium" : (e >= 0 ? (errorExceedsValue(F, e) && !balanced ? unknownErrorText(F, e) : "± " roundDigits(e, 2) (balanced ? "" : " " bracketedPercent(e, F))) : unknownErrorNote(e))
  printTrimmed(sprintf("    %-24s %14s %s  %s", "resultant force", vectorText(p ".force", count[p ".force"], 0), contactForceUnit, joinNotes(joinNotes(note, directionNote(c, e)), across)))
  isMinor = isSmall = v[p ".normalForce"] < 1e-3 * maxContactForce
  if (!balanced && !isSmall) noteLargeError("resultant force", F, e)
  if (!balanced && !isSmall) noteWorstError(e, F, "force of " v[p ".name"], wearErrorNote == "" ? "" : "raise the steps after cycles")
  e = contactError(c, errorOf(q ".normalForce"), "normalForce")
  printResult("  normal force", (absolute(v[p ".normalForce"]) < 1e-12 * F ? 0 : v[p ".normalForce"]), e, contactForceUnit, joinNotes(unknownErrorNote(e), wearErrorNote))
  if (!isSmall) noteWorstError(e, v[p ".normalForce"], "normal force of " v[p ".name"], wearErrorNote == "" ? "" : "raise the steps after cycles")
  e = contactError(c, errorOf(q ".pressureMax"), "pressureMax")
  printResult("  greatest pressure", known(q ".pressureMax.value") ? v[q ".pressureMax.value"] : v[p ".pressureMax"], e, v[".units.1"], joinNotes(joinNotes(unknownErrorNote(e), wearErrorNote), peak[c]))
  if (!isSmall) noteWorstError(e, v[p ".pressureMax"], "greatest pressure of " v[p ".name"], isLinearised() && \
    4 * absolute(v[".linearised.pressureMax." c]) > e ? "use -distance exact" : wearErrorNote != "" ? "raise the steps after cycles" : known(p ".refine") ? v[p ".refine"] : \
    hasNodalPoints() && known(p ".master") ? "use -points segment" : orderAdvice("refine at the contact (size contact)"))
  e = errorOf(q (dimension == 3 ? ".area" : ".contactLength"))
  x = dimension == 3 ? v[p ".area"] : v[p ".contactLength"]
  unit = v[".units.0"] (dimension == 3 && known(".units.0") ? "^2" : "")
  printResult(dimension == 3 ? "  contact area" : "  contact length", x, e, unit, joinNotes(unknownErrorNote(e), v[p ".contactPoints"] " of " v[p ".points"] " points"))
  printFriction(c)
  ownerText = isMinor = ""
}
# text if the error e of the force of contact c is mostly that of its direction, which -distance exact would compute
function directionNote(c, e,   k, p) {
  for (k = 0; k < count[".linearised.changes"]; k++) {
    p = ".linearised.changes." k
    if (isLinearised() && v[p ".name"] == v[".contacts." c ".name"] && v[p ".kind"] == "force" && 2 * (sqrt(v[p ".change"] ^ 2 + v[p ".aside"] ^ 2) - absolute(v[p ".change"])) > 0.5 * e && e > 0)
      return "mostly of its direction: -distance exact computes it"
  }
  return ""
}
function contactError(c, e, key) {  # the error e of a result of contact c; if it is not known, that of the wear steps. Sets wearErrorNote
  wearErrorNote = ""
  if (e >= 0 || !(v[".wear.contacts." c ".coefficient"] > 0)) return e
  e = errorOf(".wear.contacts." c "." key)
  wearErrorNote = e >= 0 ? "by the wear steps" : "error not known"
  return e
}
function printWear(c,   p, unit, left) {  # worn depth and volume of contact c
  p = ".wear.contacts." c
  if (!(v[p ".coefficient"] > 0)) return
  ownerText = " of " v[".contacts." c ".name"]
  unit = v[".units.0"]
  left = known(p ".slide") ? "error of the mesh not known" : "errors of mesh and load steps not known"
  printWearRow("worn depth", p ".depth", unit, left)
  printWearRow("worn volume", p ".volume", unit == "" ? "" : unit (dimension == 3 || v[".state"] == "axisymmetric" ? "^3" : "^2"), left)
  ownerText = ""
}
function printWearRow(name, path, unit, left,   e) {  # a row of a worn depth or volume; left: text on the errors that are not known
  e = errorOf(path)
  noteLargeError(name, v[path ".value"], e)
  printTrimmed(sprintf("    %-24s %14s%s %s  %s", name, e >= 0 ? fewDigits(v[path ".value"], e) : valueText(v[path ".value"], e), e >= 0 ? " ± " errorText(v[path ".value"], e) " (wear steps)" : "", unit, \
    e >= 0 ? left : "error not known"))
}
function printStresses(   k, p, e, unit) {  # greatest von Mises stress of each body
  unit = v[".units.1"]
  for (k = 0; k < count[".stresses"]; k++) {
    p = ".stresses." k
    e = errorOf(p)
    if (k == 0) print "  greatest von Mises stress"
    ownerText = ": greatest von Mises stress"
    printResult("  " v[p ".body"], v[p ".vonMises"], e, unit, joinNotes(unknownErrorNote(e), "at " vectorText(p ".at", dimension, 0)))
    if (count[p ".singular"] > 0) print "      singular at " vectorText(p ".singular", dimension, 0) ": no bound there"
    if (known(p ".yield"))
      print "      " (v[p ".above"] == 0 ? "nowhere above the yield stress " v[p ".yield"] : "above the yield stress " v[p ".yield"] " in " \
        roundDigits(100 * v[p ".above"], 3) " % of its volume: it would yield there")
  }
  ownerText = ""
}
function isMoment(p) { return v[p ".name"] ~ /^moment / }  # whether the load at this path is a moment
function displacementName(p) { return v[p ".name"] (isMoment(p) ? " turns" : (v[p ".name"] == "all loads" ? " move" : " moves")) }  # name of the displacement of a load
function printMoments(   k, p, i, e, m, unit, note, some) {  # requested moments of bodies
  unit = momentUnit
  for (k = 0; k < count[".moments"]; k++) {
    p = ".moments." k
    if (v[p ".printed"] != "true") continue
    if (!some++) print "  moments" (v[p ".point"] == "" ? "" : " about " v[p ".point"] " " vectorText(p ".about", dimension, 0))
    note = joinNotes("on " v[p ".body"], v[p ".point"] == "" ? "about " vectorText(p ".about", dimension, 0) : "")
    e = errorOf(p)
    if (dimension == 2) { printResultNearZero("  " v[p ".name"], v[p ".moment.0"], e, unit, note); continue }
    m = 0
    for (i = 0; i < 3; i++) m += v[p ".moment." i] ^ 2
    printTrimmed(sprintf("    %-24s %14s %s  %s", v[p ".name"], vectorText(p ".moment", 3, 0), unit, joinNotes(note, e > 0 ? "size " valueText(m ^ 0.5, e) " ± " errorText(m ^ 0.5, e) " " bracketedPercent(e, m ^ 0.5) : "")))
  }
}
# text with the force or moment x (per unit of thickness) for the whole thickness of a plane case
function thicknessNote(x, word,   unit) {
  if (dimension == 3 || v[".state"] == "axisymmetric" || v[".thickness"] == 1) return ""
  unit = forceUnit == "" ? "" : " " forceUnit (word == "moment" ? " " v[".units.0"] : "")
  return roundDigits(x * v[".thickness"], 6) unit " for the thickness " v[".thickness"]
}
function printCase(   k, p, e, word, times, j, with, forced) {  # results of a case: contacts, prescribed motions and loads, supports, moments, preloads, stresses, heat
  for (k = 0; k < count[".ways"]; k++) forced[v[".ways." k ".name"]]++   # a force on an obstacle has the displacement as a result, a motion has none
  for (k = 0; k < count[".prescribed"]; k++) {
    p = v[".prescribed." k ".name"]
    if (p ~ /^(move|rotate) / || (p ~ /^obstacle / && forced[p]-- <= 0)) drivenByMotion = 1
  }
  if (thicknessNote(1) != "") print "  forces, moments, work and heat are those of a unit of thickness; all " v[".thickness"] " carry " v[".thickness"] " times as much"
  for (k = 0; k < count[".contacts"]; k++) if (v[".contacts." k ".normalForce"] > maxContactForce) maxContactForce = v[".contacts." k ".normalForce"]
  for (k = 0; k < count[".contacts"]; k++) { printContact(k); printWear(k) }
  if (v[".wear.stepsError"] ~ /^not known/) print "  error of the wear steps " v[".wear.stepsError"]
  for (k = 0; k < count[".prescribed"]; k++) {
    p = ".prescribed." k
    word = (p ".moment") in v ? "moment" : "force"
    e = errorOf(p)
    times = thicknessNote(v[p "." word], word)
    if (v[p ".cancelled"] > 0) times = joinNotes(times, "its mirror images cancel " (v[p ".cancelled"] > 1 - 1e-6 ? "it" : "a part of it"))
    else if (v[p ".times"] == "null") times = joinNotes(times, "of the whole not known: its symmetries do not meet at 90, 60, 45 or another 180/n degrees")
    else if (v[p ".times"] > 1) {
      with = "of the whole "
      for (j = 0; j < count[p ".images"]; j++) with = (j ? with " and " : "with its image in symmetry ") v[p ".images." j] " "
      times = joinNotes(times, with v[p ".times"] " times as much: " joinNotes(roundDigits(v[p ".times"] * v[p "." word], 6), thicknessNote(v[p ".times"] * v[p "." word], word)))
    }
    if (known(p ".arm")) times = joinNotes(times, "to within " roundDigits(v[p ".arm"], 2) ": few points carry, the place of the force is not known better")
    if (v[p ".name"] ~ /^(move|rotate|obstacle) /) {
      printResultNearZero(v[p ".name"] ": " word, v[p "." word], e, word == "force" ? contactForceUnit : momentUnit, joinNotes(unknownErrorNote(e), times))
      noteWorstError(e, v[p "." word], word " of " v[p ".name"])
      if (word == "force" && absolute(v[p ".force"]) > 1e-3 * maxContactForce) noteLargeError("force of " v[p ".name"], v[p ".force"], e)
    } else if (times != "") printResult(v[p ".name"], v[p "." word], 0, word == "force" ? contactForceUnit : momentUnit, times)
  }
  for (k = 0; k < count[".ways"]; k++) {
    p = ".ways." k
    e = errorOf(".estimates.loads." k ".way")
    printResult(displacementName(p), v[p ".way"], e, isMoment(p) ? "rad" : v[".units.0"], unknownErrorNote(e))
    noteWorstError(e, v[p ".way"], "displacement of " v[p ".name"])
  }
  for (k = 0; k < count[".supports"]; k++)
    printTrimmed(sprintf("  %-26s %14s %s", v[".supports." k ".name"] " carries", vectorText(".supports." k ".force", count[".supports." k ".force"], 0), contactForceUnit))
  for (k = 0; k < count[".guides"]; k++)
    if (v[".guides." k ".carries"] == "true")
      printTrimmed(sprintf("  %-26s %14s %s", "guide of " v[".guides." k ".name"] " carries", vectorText(".guides." k ".force", count[".guides." k ".force"], 0), contactForceUnit))
  printMoments()
  for (k = 0; k < count[".preloads"]; k++) {
    p = ".preloads." k
    e = known(p ".error") ? v[p ".error"] : -1
    printResult("preload " v[p ".name"], v[p ".force"], e, contactForceUnit, "under the loads; " (count[".tightening"] ? "" : "tightened to " joinNotes(roundDigits(v[p ".preload"], 6), thicknessNote(v[p ".preload"], "force")) ", ") "shortened by " \
      (e < 0 ? roundDigits(v[p ".shortened"], 6) ", errors not known" : valueText(v[p ".shortened"], v[p ".shortenedError"]) " ± " errorText(v[p ".shortened"], v[p ".shortenedError"])))
  }
  printDeflections()
  printStresses()
  if (known(".heat.rounds")) printHeat()
}
function printPath(   e) {  # results of a path of an adhesive law
  e = known(".pathErrors.pullOff") ? v[".pathErrors.pullOff"] : -1
  printResult("least force", v[".pullOff"], e, "", "at the approach " roundDigits(v[".pullOffApproach"], 6))
  printResult("jumps", count[".jumps"], 0, "", "")
  printResult("dissipated in jumps", v[".dissipated"], known(".pathErrors.dissipated") ? v[".pathErrors.dissipated"] : -1, "", "")
  printResult("work along the path", v[".loopWork"], known(".pathErrors.loopWork") ? v[".pathErrors.loopWork"] : -1, "", "")
  printResult("work by the forces", v[".workByForces"], 0, "", "")
  if (v[".pathErrors.notKnown"] != "") print "  not known of the path: " v[".pathErrors.notKnown"]
}
function printDetails(   k, n, p, list, text, width) {  # with -verbose 1: solver statistics, parts of the errors, all flags
  print "\nDetails"
  printRow("solver", "models " v[".adaptations"] ", Newton steps " v[".newton"] ", residual " roundDigits(v[".residual"], 3) ", model error " roundDigits(v[".modelError"], 3))
  printRow("", "unknowns " v[".ndof"] ", factorisations " v[".factorisations"] ", back-substitutions " v[".backsolves"] \
    (v[".iterations"] > 0 ? ", their iterations " v[".iterations"] : "") ", cost ratio " roundDigits(v[".costRatio"], 3))
  printRow("points", "in contact " v[".contactPoints"] " of " v[".points"] ", at the wall " v[".wallPoints"] ", greatest overlap " roundDigits(v[".overlapMax"], 6))
  if (estimated) {
    p = ".estimates.parts."
    printRow("errors", (known(".estimates.worst") ? v[".estimates.worst"] : "as force") ": inside the bodies " roundDigits(v[p "inside"], 2) \
      ", on the contact line " roundDigits(v[p "line"], 2) ", model " roundDigits(v[p "model"], 2) ", shape " roundDigits(v[p "geometry"], 2) \
      ", algebra " roundDigits(v[p "algebra"], 2))
    if (v[".estimates.refine"] != "") printRow("", "to lower the greatest, " v[".estimates.refine"])
  }
  if (v[".linearised.trusted"] == "true") {
    for (k = 0; k < count[".linearised.changes"]; k++) {
      p = ".linearised.changes." k
      text = joinNotes(text, v[p ".name"] " " (v[p ".kind"] == "way" ? "displacement" : v[p ".kind"]) " " roundDigits(v[p ".change"], 2))
    }
    for (k = 0; k < count[".linearised.pressureMax"]; k++) text = joinNotes(text, v[".contacts." k ".name"] " greatest pressure " roundDigits(v[".linearised.pressureMax." k], 2))
    printRow("linear", "change by the true distance and finite rotations, twice in the errors: " text)
  }
  for (k = 0; k < count[".bodies"]; k++) {
    p = ".bodies." k
    n = count[p ".motion"]
    printRow("body", v[p ".name"] " moved " vectorText(p ".motion", dimension, 0) (n == 2 ? "" : ", turned " \
      (dimension == 3 ? vectorText(p ".motion", 3, 3) : roundDigits(v[p ".motion.2"], 6))) ", its supports carry " vectorText(p ".reaction", dimension, 0))
  }
  if (known(".geometryCorrection")) printRow("surfaces", "smooth ones differ from those of the mesh by " roundDigits(v[".geometryCorrection"], 3) " at most")
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
  isCase = ".bodies.0.name" in v
  worst = unitWidth = 0
  largeErrorLimit = 0.3
  if (v[".units.0"] " " v[".units.1"] ~ /^(mm MPa|m Pa)$/) {
    forceUnit = "N"
    contactForceUnit = dimension == 3 || v[".state"] == "axisymmetric" ? forceUnit : forceUnit "/" v[".units.0"]
    momentUnit = contactForceUnit == forceUnit ? "N " v[".units.0"] : forceUnit
  }
  if (known(".units.0")) unitWidth = 1 + (length(contactForceUnit) > 4 ? length(contactForceUnit) : 4)
  costText = v[".newton"] (v[".newton"] == 1 ? " iteration" : " iterations") (v[".adaptations"] > 1 ? ", " v[".adaptations"] " models" : "") ", " roundDigits(v[".seconds.total"], 2) " s"
  if (v[".converged"] != "true") {
    print "NOT CONVERGED: " v[".message"]
    print "  residual " roundDigits(v[".residual"], 2) " (tolerance " v[".parameters.tol"] + 0 ") after " costText "; there are no results"
  } else {
    if (v[".accuracy.met"] == "false") {
      print "ACCURACY NOT REACHED: " (known(".accuracy.reached") ? "estimated relative error of the " v[".accuracy.goal"] " " roundDigits(v[".accuracy.reached"], 2) ", " : "") \
        "wanted " v[".accuracy.asked"] + 0 ": " v[".accuracy.why"]
      print "  solved in " costText
    } else print "converged in " costText
    print "\nResults (" (estimated ? "± estimated error" : (v[".notEstimated"] == "" ? "without error estimates" : "no error estimate: " v[".notEstimated"])) ")"
    if (isCase) {
      findPressurePeaks()
      printCase()
    } else {
      printScene()
      printFriction(0)
    }
    if (known(".dragged.value")) printTwoErrors("dragged by", v[".dragged.value"], errorOf(".dragged"), -1, "", "")
    if (known(".creepage")) printResult("creepage", v[".creepage"], 0, "", "of the length rolled")
    if (v[".friction"] > 0 && !(".plastic.steps" in v)) {
      print "  work of the loads " roundDigits(v[".work"], 6) ", stored " roundDigits(v[".stored"], 6) ", dissipated " roundDigits(v[".dissipated"], 6) \
        ", left over " roundDigits(v[".work"] - v[".stored"] - v[".dissipated"], 2)
      if (v[".loadStepsError"] ~ /^not known/) print "  error of the load steps " v[".loadStepsError"]
      if (estimated) print "  the errors of the mesh are those of the last load step"
      if (estimated && isCase && v[".parameters.distance"] == "linear" && !(".linearised.trusted" in v)) print "  the change by -distance exact is not in the errors"
    }
    if (".plastic.steps" in v) printPlastic()
    if (".pullOff" in v) printPath()
    if (known(".stability")) print "  the state is " (v[".stability"] > 0 ? "stable" : "NOT STABLE") " (lowest eigenvalue of its tangent " roundDigits(v[".stability"], 3) ")"
    if (ENVIRON["ROWS"] != "") print substr(ENVIRON["ROWS"], 2)
  }
  for (k = 0; k < count[".warnings"]; k++) printWarning(v[".warnings." k])
  if (largeErrors != "") printWarning("estimated error above " 100 * largeErrorLimit " %: " largeErrors ". Do not use these numbers before a finer run confirms them.")
  if (v[".converged"] == "true" && count[".warnings"] == 0 && largeErrors == "") print "  no warnings"
  print ""
  if (worstAdvice == "") worstAdvice = v[".estimates.refine"]
  if (v[".converged"] == "true" && worst > 0.01 && worstAdvice != "") printRow("finer", worstAdvice ": the error of the " worstName " is " percentText(worst, 1))
  printRow("files", folder (v[".converged"] == "true" ? "" : " (the last state, for diagnosis)"))
  if (v[".converged"] == "true" && ENVIRON["PLOT"] != "") printRow("plot", ENVIRON["PLOT"])
  if (v[".parameters.verbose"] == 1) printDetails()
  else printRow("more", "-verbose 1: error contributions, solver statistics, all flags")
}
