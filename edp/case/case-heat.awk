# case-heat.awk: heat in a case file: conducting bodies, temperatures, fluxes, films, and the conductance of a contact
# Read by awk before case-file.awk, whose functions it uses. A conductance becomes the statement "conductance" of its own behind its contact.
# Numbers: conduct: conductivity, expansion, temperature without stress;  temperature: it;  flux: it;  film: coefficient, temperature around;
# conductance: h0, exponent, hardness (0: the same at each pressure).

# conduct, temperature, flux, film
function readHeat(   g, v, what) {
  what = word[1]
  g = group(what == "conduct" ? dim : dim - 1)
  once(what SUBSEP g, what " of " nameOf[g])
  v[0] = v[1] = v[2] = 0
  if (what == "conduct") {
    v[0] = number("the conductivity", 0, 1e300)
    if (at < words && word[at + 1] == "expand") {
      at++
      v[1] = any("the coefficient of expansion")
      if (at < words && word[at + 1] == "from") { at++; v[2] = any("the temperature without stress") }
    }
  }
  else heatLine[g] = heatLine[g] == "" ? FNR : heatLine[g]
  if (what == "temperature") { v[0] = any("the temperature"); heats++ }
  if (what == "flux") v[0] = any("the flux")
  if (what == "film") { v[0] = number("the film coefficient", 0, 1e300); v[1] = any("the temperature around"); heats++ }
  if (what != "temperature" && what != "conduct") warmed[g] = FNR
  row(what " " FNR " " g " 0 none none none", v)
}
# conductance h0 [hardness H [exponent m]]
function readConductance(v,   k) {
  v[0] = number("the conductance", 0, 1e300)
  v[1] = v[2] = 0
  if (at < words && word[at + 1] == "hardness") {
    at++
    v[2] = number("the hardness", 0, 1e300)
    v[1] = 0.95
    if (at < words && word[at + 1] == "exponent") { at++; v[1] = number("the exponent", 0, 3) }
  }
  conductances++
  conductanceLine = FNR
}
function putConductance(v) { row("conductance " FNR " 0 0 none none none", v) }
# once all is read
function checkHeat(   some, g) {
  for (g = 1; g <= groups; g++) if (("conduct" SUBSEP g) in seen) some = 1
  for (g = 1; g <= groups; g++) if (!some && g in heatLine) no("line " heatLine[g] ": a temperature, flux or film, and no body conducts; allowed: with a line conduct BODY k for each body")
  if (conductances && !some) no("line " conductanceLine ": a conductance, and no body conducts; allowed: with a line conduct BODY k for each body")
  if (!some) return
  if (wearLine) no("line " wearLine ": wear with conduct; allowed: one of them")
  for (g = 1; g <= groups; g++)
    if (("body" SUBSEP g) in seen && !(("conduct" SUBSEP g) in seen))
      no("line " seen["body", g] ": " nameOf[g] ": nothing says how it conducts, as others do; allowed: a line conduct " nameOf[g] " k")
  for (g = 1; g <= groups; g++) {
    if (("expand" SUBSEP g) in seen) no("line " seen["expand", g] ": expand with conduct; allowed: conduct " nameOf[g] " k expand alpha from T")
    if (("preload" SUBSEP g) in seen) no("line " seen["preload", g] ": preload with conduct; allowed: one of them")
    key_ = "temperature" SUBSEP g
    if (g in warmed && key_ in seen)
      no("line " warmed[g] ": " nameOf[g] ": a flux or film where line " seen[key_] " gives the temperature does nothing; allowed: one of them")
  }
  if (!heats) no("conduct, and no temperature anywhere; allowed: at least one line temperature or film")
}
