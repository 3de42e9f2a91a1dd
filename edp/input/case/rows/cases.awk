# cases.awk: the results of load cases: a table for the screen, and envelope.csv with the least and the greatest of each result
# Read by awk after json.awk, results.awk and numbers.awk, whose arrays it uses. Rows that have failed do not count.
# In the environment: FOLDER, SCREEN: as in results.awk.
function listName(column,   part, path, k, n) {  # the name of the entry of a list that a column of rows.csv belongs to
  n = split(column, part, ".")
  path = ".rows." any ".summary"
  for (k = 1; k <= n; k++) {
    path = path "." (part[k] ~ /^[0-9]+$/ ? part[k] - 1 : part[k])
    if ((path ".name") in v) return v[path ".name"]
    if ((path ".body") in v) return v[path ".body"]
  }
  return ""
}
function label(r,   k, n, text) {  # the inputs of row r, with the load case first
  text = v[".rows." r ".inputs.case"]
  n = split(names[".rows." r ".inputs"], input, SUBSEP)
  for (k = 2; k <= n; k++) if (input[k] != "case") text = text ", " input[k] " " v[".rows." r ".inputs." input[k]]
  return text
}
function findEnds(name,   r, x) {  # sets least and greatest: the rows of the least and of the greatest result; 0 if no row has it
  least = -1
  for (r = 0; r < rows; r++) {
    if (v[".rows." r ".code"] + 0 != 0 || cell[r, name] == "") continue
    x = cell[r, name] + 0
    if (least < 0) least = greatest = r
    if (x < cell[least, name] + 0) least = r
    if (x > cell[greatest, name] + 0) greatest = r
  }
  return least >= 0
}
function resultText(r, name, unit,   x, e) {  # a result with its error
  if (cell[r, name] == "") return "not known"
  x = cell[r, name] + 0
  e = cell[r, name ".error"]
  if (e == "") return roundDigits(x, 6) (estimated ? " (error not known)" : "")
  e = atLeastRounding(x, e + 0)
  if (errorExceedsValue(x, e)) return roundDigits(x, 2) " (error not known)"
  return valueText(x, e) (e > 0 ? " ± " errorText(x, e) : "")
}
function pad(text, width,   n) {  # text with blanks behind it; ± has two bytes
  n = width - length(text)
  if (index(text, "±") && length("±") > 1) n += length("±") - 1
  return sprintf("%s%" (n > 0 ? n : 1) "s", text, "")
}
function addTable(title, columns,   r, k, line, part) {  # a table of results: columns, "name|head" separated by ;
  n = split(columns, part, ";")
  addLine("  " title)
  line = pad("    case", width)
  for (k = 1; k <= n; k++) line = line pad(substr(part[k], index(part[k], "|") + 1), 28)
  addLine(line)
  for (r = 0; r < rows; r++) {
    line = pad("    " label(r), width)
    if (v[".rows." r ".code"] + 0 != 0) line = line "no result: " v[".rows." r ".message"]
    else for (k = 1; k <= n; k++) line = line pad(resultText(r, substr(part[k], 1, index(part[k], "|") - 1)), 28)
    addLine(line)
  }
  for (r = 0; r < 2; r++) {
    line = pad("    " (r ? "greatest in" : "least in"), width)
    for (k = 1; k <= n; k++) line = line pad(findEnds(substr(part[k], 1, index(part[k], "|") - 1)) ? label(r ? greatest : least) : "", 28)
    addLine(line)
  }
}
function addLine(text) { sub(/ +$/, "", text); shown = shown text "\n" }
END {
  any = -1
  width = 16
  for (r = 0; r < rows; r++) {
    if (any < 0 && v[".rows." r ".code"] + 0 == 0) any = r
    if (length(label(r)) + 6 > width) width = length(label(r)) + 6
  }
  at = ENVIRON["FOLDER"] ".run/envelope.csv"
  print "result,name,least,leastPlusMinus,leastCase,greatest,greatestPlusMinus,greatestCase" > at
  for (k = 1; k <= columns; k++) {
    name = column[k]
    if (name !~ /^(force|approach|pressureMax|overlapMax|energy|contact|reaction|master|bodies|prescribed|ways|supports|stresses|preloads|deflections)/ \
      || name ~ /(error|points|Points|times|arcs\..*|closed.*|shared.*|obstacle|refine)$/ || !findEnds(name)) continue
    print name "," csv(listName(name)) "," cell[least, name] "," cell[least, name ".error"] "," csv(label(least)) \
      "," cell[greatest, name] "," cell[greatest, name ".error"] "," csv(label(greatest)) > at
  }
  CONVFMT = "%.6g"
  if (any >= 0) {
    p = ".rows." any ".summary"
    space = (p ".reactionZ") in v
    length1 = known(p ".units.0") ? ", " v[p ".units.0"] (space ? "^2" : "") : ""
    pressure = known(p ".units.1") ? ", " v[p ".units.1"] : ""
    force = v[p ".units.0"] " " v[p ".units.1"] ~ /^(mm MPa|m Pa)$/ ? ", N" (space || v[p ".state"] == "axisymmetric" ? "" : "/" v[p ".units.0"]) : ""
    estimated = (p ".estimates.parts.inside") in v
    addLine("Load cases (" (estimated ? "± estimated error" : "without error estimates") ")")
    for (c = 1; c <= count[p ".contacts"]; c++)
      addTable("contact " v[p ".contacts." c - 1 ".name"], "contacts." c ".normalForce|normal force" force ";contacts." c ".pressureMax|greatest pressure" \
        pressure ";contacts." c (space ? ".area|contact area" : ".contactLength|contact length") length1)
    for (c = 1; c <= count[p ".stresses"]; c++) addTable(v[p ".stresses." c - 1 ".body"], "stresses." c ".vonMises|greatest von Mises stress" pressure)
  }
  printf "%d\n%s\n%s  %-10s%s\n", worst, shown, said, "files", ENVIRON["FOLDER"] files ", envelope.csv" ((getline line < (ENVIRON["FOLDER"] ".run/envelope-contact.csv")) > 0 ? ", envelope-contact.csv" : "") > screen
}
