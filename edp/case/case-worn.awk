# case-worn.awk: wear behind a contact or an obstacle, and the cycles of a case
# Read by awk before case-file.awk, whose functions it uses. Wear becomes the statement "wear" of the table, behind that of its contact:
# wear coefficient, sliding distance of a cycle (0: the slip of load phases), and the file of a worn profile. "cycles" has their number,
# and that of the wear steps.

# wear K [slide S] [from FILE]
function readWear(f,   path) {
  if (ENVIRON["WEARS"] == "") no("wear: read by parts.edp and parts-3d.edp alone; allowed here: contacts without it")
  f[0] = number("the wear coefficient", 0, 1e300)
  f[1] = 0
  if (at < words && word[at + 1] == "slide") { at++; f[1] = number("the sliding distance of a cycle", 0, 1e300) }
  wornFile = ""
  if (at >= words || word[at + 1] != "from") return
  at++
  if (at >= words) no("the file of a worn profile is missing; " usageOf(word[1]))
  wornFile = path = word[++at]
  gsub(/\047/, "\047\\\047\047", path)
  if (system("test -f \047" path "\047 && test -r \047" path "\047") != 0)
    no(wornFile ": no such file; allowed: the worn.csv of a run")
}
function putWear(f, law, g, mu) {
  if (law !~ /^(none|signorini)$/) no("wear: with the law " law "; allowed: hard contact, no law or signorini")
  if (mu > 0 && f[1]) no("wear: slide with friction, whose slip is computed; allowed: wear K")
  if (!(mu > 0) && !f[1]) no("wear: no sliding distance and no friction; allowed: wear K slide S, or friction MU and legs")
  if (mu > 0) slips = FNR
  else glides = FNR
  row("wear " FNR " " g " 0 none none none", f)
  wearLine = FNR
  if (wornFile != "") { files++; fileLine[files] = statements - 1 " " wornFile }
}
# cycles N [steps M]
function readCycles(   v) {
  once("cycles", "cycles")
  v[0] = number("the number of cycles", 0, 1e300)
  v[1] = 20
  if (at < words) {
    keyword("steps")
    v[1] = number("the number of wear steps", 0, 10001)
    if (v[1] != int(v[1])) no(word[at] ": no whole number of wear steps; " usageOf("cycles"))
  }
  row("cycles " FNR " 0 0 none none none", v)
}
# at the end of the case
function checkWear() {
  if (wearLine && !("cycles" in seen)) no("line " wearLine ": wear without cycles; allowed: a line cycles N")
  if (slips && glides) no("line " glides ": wear with slide, in line " slips " wear by friction; allowed: one kind for all contacts")
  if (slips && legs < 2) no("line " slips ": wear by friction without a cycle; allowed: a first leg that loads, and further legs that are one cycle")
  if (!wearLine && ("cycles" in seen)) no("line " seen["cycles"] ": cycles without wear; allowed: wear K slide S behind a contact or an obstacle")
}
