# help.awk: the answer to -help: the flags of a scene by topics, in aligned columns
# In the environment: CONTACT_HELP: a sentence on the scene, then a line for each flag: name, default, unit, meaning and allowed values,
# a tab between them. A flag that no topic lists is one of the scene.
function pad(text, n) { while (length(text) < n) text = text " "; return text }
BEGIN {
  topics = split("Model and load|Contact law|Friction|Adhesion|Mesh and elements|Accuracy|Solution method|Load series|Results and files", topic, "|")
  flags["Model and load"] = "mesh set case check width depth E nu E1 E2 nu1 nu2 R R1 R2 a bodyForce traction gap u0 geometry force reach offset roll"
  flags["Contact law"] = "law d0 p0 kappa m k beta table w eps0 rho"
  flags["Friction"] = "friction compliance shearLimit drag shear legs stepErrors"
  flags["Adhesion"] = "path branch control force-coarse"
  flags["Mesh and elements"] = "h order grading ends corners edges aspect fine layers refine patch symmetry half ratio points surface distance"
  flags["Accuracy"] = "estimate accuracy goal unknowns sensitivity"
  flags["Solution method"] = "method model T0 threshold inner start forcing preconditioner solver eps tol maxNewton maxAdaptations maxPlastic damping"
  flags["Load series"] = "history steps rows vary rows-start"
  flags["Results and files"] = "states vtu plot axis out verbose"
  for (t = 1; t <= topics; t++) {
    n = split(flags[topic[t]], name, " ")
    for (k = 1; k <= n; k++) of["-" name[k]] = t
  }
  lines = split(ENVIRON["CONTACT_HELP"], line, "\n")
  print line[1]
  wide[1] = 6; wide[2] = 9; wide[3] = 6
  for (k = 2; k <= lines; k++) {
    split(line[k], cell, "\t")
    for (c = 1; c <= 3; c++) if (length(cell[c]) + 2 > wide[c] && (c != 2 || length(cell[c]) < 16)) wide[c] = length(cell[c]) + 2
  }
  print ""
  print pad("flag", wide[1]) pad("default", wide[2]) pad("unit", wide[3]) "meaning (allowed)"
  for (t = 0; t <= topics; t++) {
    first = 1
    for (k = 2; k <= lines; k++) {
      split(line[k], cell, "\t")
      if (of[cell[1]] + 0 != t) continue
      if (first) print "\n" (t ? topic[t] : "This scene")
      first = 0
      print pad(cell[1], wide[1] - 1) " " pad(cell[2], wide[2] - 1) " " pad(cell[3], wide[3]) cell[4] " (" cell[5] ")"
    }
  }
  print "\nUnits are yours, consistent: lengths in one unit, forces in one unit, pressures force/length^2; in the plane forces per unit of thickness."
  print "Exit code: 0 converged, 20 not converged (files written, converged false), 21 -accuracy not reached (files written), " \
    "10 refused, 30 out of memory or disk (nothing written)."
}
