# print.awk: the end of a run with rows on screen, from its rows.csv: the number of rows by exit code, failed rows, files
# In the environment: FOLDER: of the results.
function cells(line, cell,   n, text, more) {  # the cells of a line of the table
  n = 0
  do {
    if (line ~ /^"/) {
      match(line, /^"([^"]|"")*"/)
      text = substr(line, 2, RLENGTH - 2)
      gsub(/""/, "\"", text)
      line = substr(line, RLENGTH + 1)
      more = line ~ /^,/
      line = substr(line, 2)
    } else {
      more = match(line, /,/)
      text = more ? substr(line, 1, RSTART - 1) : line
      line = more ? substr(line, RSTART + 1) : ""
    }
    cell[++n] = text
  } while (more)
  return n
}
{ n = cells($0, cell) }
NR == 1 { for (k = 1; k <= n; k++) at[cell[k]] = k; next }
{
  code = cell[at["code"]] + 0
  number[code]++
  if (code > worst) worst = code
  if (code != 0 && failed++ < 10) lines = lines sprintf("  row %-6d%s\n", cell[1], cell[at["message"]])
  warned += cell[at["warnings"]] != ""
  seconds += cell[n]
}
END {
  text = number[0] + 0 " of " NR - 1 " solved"
  if (number[10]) text = text ", " number[10] " refused (code 10)"
  if (number[20]) text = text ", " number[20] " not converged (code 20)"
  for (code in number) if (code != 0 && code != 10 && code != 20) text = text ", " number[code] " ended with code " code
  printf "  %-10s%s, %.2f CPU s\n", "rows", text, seconds
  printf "%s", lines
  if (failed > 10) printf "  and %d more, in the column message\n", failed - 10
  if (warned) printf "  %-10s%s\n", "warnings", "in " warned " rows: column warnings"
  printf "  %-10s%s\n", "files", ENVIRON["FOLDER"] "rows.csv, rows.json"
  exit worst
}
