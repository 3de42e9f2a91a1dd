# results.awk: the table rows.csv from rows.json: a line a row, a column for each number of the summaries
# Read by awk after output/report/json.awk. The columns are those of all rows, in the order of the first row that has them; lists count from
# 1. estimates.NAME.error stands as NAME.error, without the value; true and false are 1 and 0. What is no finite number is empty.
# In the environment: FOLDER: of the results; SCREEN: a file for the end on screen: the greatest exit code, then the number of rows by exit
# code, failed rows, and the files; CASES: not empty if input/case/rows/cases.awk puts its table before them.
function csv(text) {
  if (text !~ /[",\n]/ && text !~ /^ | $/) return text
  gsub(/"/, "\"\"", text)
  return "\"" text "\""
}
function store(row, name, text) {
  if (text == "true") text = 1
  else if (text == "false") text = 0
  else if (text !~ /^-?[0-9]/) return
  if (!(name in place)) {
    place[name] = ++columns
    column[columns] = name
  }
  cell[row, name] = text
}
function collect(row, path, name,   k, n, entry) {  # stores all numbers below the path, under names that begin with `name`
  if (path in names) {
    n = split(names[path], entry, SUBSEP)
    for (k = 2; k <= n; k++)
      if (name != "" || !(entry[k] in omitted)) collect(row, path "." entry[k], (name == "" ? "" : name ".") entry[k])
  } else if (path in count) {
    for (k = 0; k < count[path]; k++) collect(row, path "." k, name "." k + 1)
  } else if (path in v) {
    if (name ~ /^estimates\..*\.value$/) return
    if (name ~ /\.error$/) sub(/^estimates\./, "", name)
    store(row, name, v[path])
  }
}
BEGIN { CONVFMT = OFMT = "%.17g" }
END {
  parse("")
  split("package freefem gmsh date parameters given modules plugins warnings seconds", list, " ")
  for (k in list) omitted[list[k]] = 1
  rows = count[".rows"]
  n = split(names[".rows.0.inputs"], input, SUBSEP)
  line = "row"
  for (k = 2; k <= n; k++) line = line "," csv(input[k])
  for (r = 0; r < rows; r++) if ((".rows." r ".summary") in names) collect(r, ".rows." r ".summary", "")
  line = line ",code,message,warnings"
  for (k = 1; k <= columns; k++) line = line "," csv(column[k])
  print line ",seconds"
  for (r = 0; r < rows; r++) {
    line = r + 1
    for (k = 2; k <= n; k++) line = line "," csv(v[".rows." r ".inputs." input[k]])
    warnings = ""
    for (k = 0; k < count[".rows." r ".summary.warnings"]; k++) warnings = warnings (k ? "; " : "") v[".rows." r ".summary.warnings." k]
    line = line "," v[".rows." r ".code"] "," csv(v[".rows." r ".message"]) "," csv(warnings)
    for (k = 1; k <= columns; k++) line = line "," cell[r, column[k]]
    print line "," v[".rows." r ".seconds"]
    code = v[".rows." r ".code"] + 0
    number[code]++
    if (code > worst) worst = code
    if (code != 0 && failed++ < 10) lost = lost sprintf("  row %-6d%s\n", r + 1, v[".rows." r ".message"])
    warned += warnings != ""
    seconds += v[".rows." r ".seconds"]
  }
  text = number[0] + 0 " of " rows " solved"
  if (number[10]) text = text ", " number[10] " refused (code 10)"
  if (number[20]) text = text ", " number[20] " not converged (code 20)"
  for (code in number) if (code != 0 && code != 10 && code != 20) text = text ", " number[code] " ended with code " code
  screen = ENVIRON["SCREEN"]
  files = "rows.csv, rows.json"
  said = sprintf("  %-10s%s, %.2f CPU s\n%s", "rows", text, seconds, lost)
  if (failed > 10) said = said sprintf("  and %d more, in the column message\n", failed - 10)
  if (warned) said = said sprintf("  %-10s%s\n", "warnings", "in " warned " rows: column warnings")
  if (ENVIRON["CASES"] == "") printf "%d\n%s  %-10s%s\n", worst, said, "files", ENVIRON["FOLDER"] files > screen
}
