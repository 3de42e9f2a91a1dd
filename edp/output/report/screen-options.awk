# output/report/screen-options.awk: the rows of options among the results of a case
# Deflections, heat, plastic strains. They use the functions and texts of output/report/screen.awk, which calls them.
function printDeflections(   k, p, e) {  # greatest displacement of each body along its weight
  for (k = 0; k < count[".deflections"]; k++) {
    p = ".deflections." k
    e = errorOf(p)
    if (k == 0) print "  greatest displacement along gravity"
    ownerText = ": greatest displacement along gravity"
    printResult("  " v[p ".body"], v[p ".value"], e, v[".units.0"], joinNotes(unknownErrorNote(e), "at " vectorText(p ".at", dimension, 0)))
  }
  ownerText = ""
}
function printHeat(   k, p, greatest) {  # temperatures and heat flows
  print "  heat" (known(".time") ? " at the time " v[".time"] : "") ", errors not known"
  for (k = 0; k < count[".heat.bodies"]; k++) {
    p = ".heat.bodies." k
    printTrimmed(sprintf("    %-24s %14s", v[p ".name"] " is at", roundDigits(v[p ".least"], 6) " to " roundDigits(v[p ".greatest"], 6)))
  }
  greatest = v[".heat.in"] > v[".heat.out"] ? v[".heat.in"] : v[".heat.out"]
  for (k = 0; k < count[".heat.contacts"]; k++) {
    p = ".heat.contacts." k
    printResult("  " v[p ".name"] " conducts", zeroIfRounding(v[p ".heat"], greatest), 0, "", known(p ".jump") ? "over a jump of " roundDigits(v[p ".jump"], 6) ", mean conductance " roundDigits(v[p ".conductance"], 6) : "")
  }
  for (k = 0; k < count[".heat.groups"]; k++)
    printResult("  " v[".heat.groups." k ".name"] " gives", zeroIfRounding(v[".heat.groups." k ".heat"], greatest), 0, "", "")
  if (known(".heat.stored")) printResult("  the bodies store", zeroIfRounding(v[".heat.stored"], greatest), 0, "", "")
  if (greatest > 0) print "    heat in = heat out" (known(".heat.stored") ? " + heat stored" : "") " (to " \
    roundDigits(absolute(v[".heat.in"] - v[".heat.out"] - v[".heat.stored"]) / greatest, 1) ")"
}
function zeroIfRounding(x, greatest) { return absolute(x) < 1e-9 * greatest ? 0 : x + 0 }  # x, or 0 if it is below rounding of the greatest number
function printPlastic(   k, p, c, s, unit, size) {  # plastic strains and energies of bodies that yield; the error of the mesh is not known
  if (v[".plastic.yielded"] != "true") { print "  no body yields: the results are elastic ones"; return }
  size = v[".state"] == "axisymmetric" || count[".plastic.bodies.0.at"] == 3 ? "volume" : "area"
  unit = v[".units.0"] (known(".units.0") ? (size == "volume" ? "^3" : "^2") : "")
  print "  plastic strains, in " v[".plastic.steps"] " load steps and " v[".plastic.iterations"] " iterations: the error of the mesh is not known"
  for (k = 0; k < count[".plastic.bodies"]; k++) {
    p = ".plastic.bodies." k
    printTwoErrors("greatest of " v[p ".body"], v[p ".strainMax"], -1, known(p ".strainMaxError") ? v[p ".strainMaxError"] : -1, "", "at " vectorText(p ".at", count[p ".at"], 0))
    printTwoErrors("yielded " size, v[p ".volume"], -1, known(p ".volumeError") ? v[p ".volumeError"] : -1, unit, \
      "(" roundDigits(100 * v[p ".share"], 3) " % of " v[p ".body"] ")")
  }
  for (c = 0; c < count[".contacts"]; c++) {
    p = ".plastic.contacts." c
    if (!known(p ".normalForceError") || v[".contacts." c ".contactPoints"] == 0) continue
    printTwoErrors("force of " v[".contacts." c ".name"], v[".contacts." c ".normalForce"], -1, v[p ".normalForceError"], contactForceUnit, "")
    printTwoErrors("greatest pressure", v[".contacts." c ".pressureMax"], -1, v[p ".pressureMaxError"], v[".units.1"], "")
  }
  printTwoErrors("dissipated", v[".plastic.dissipated"], -1, known(".plastic.dissipatedError") ? v[".plastic.dissipatedError"] : -1, "", "", 1e-3 * v[".plastic.work"])
  s = v[".plastic.storedElastic"] + v[".plastic.storedByHardening"]
  print "  work on the bodies " roundDigits(v[".plastic.work"], 6) ", stored " roundDigits(s, 6) ", dissipated " roundDigits(v[".plastic.dissipated"], 6) \
    ", left over " roundDigits(v[".plastic.work"] - s - v[".plastic.dissipated"], 2)
  if (v[".friction"] > 0) print "  dissipated by friction " roundDigits(v[".dissipated"], 6)
  if (v[".plastic.loadStepsError"] != "measured") print "  error of the load steps " v[".plastic.loadStepsError"]
}
