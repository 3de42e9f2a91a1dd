# table.awk: a table of problems as one value a line, from a CSV file (-rows) or from lists of values (-vary)
# In the environment: VARY: the lists, "kappa 1e0:1e12:13 log, m 2 3"; without it the table is on standard input.
# Gives: a refusal, or an empty line; the numbers of columns and rows; the names; the values, row by row. A cell may stand in quotes. Lines
# that are empty or begin with # do not count.
function refuse(text) { print text; refused = 1; exit }
function cells(line, cell,   n, text) {  # the cells of a line, without blanks and quotes around them; returns their number
  n = 0
  do {
    text = line
    sub(/^[ \t]*/, "", text)
    if (text ~ /^"/) {
      if (!match(text, /^"([^"]|"")*"[ \t]*(,|$)/)) refuse("line " NR ": a quote is not closed; allowed: \"...\" around a whole cell")
      line = substr(text, RLENGTH + 1)
      more = substr(text, RLENGTH, 1) == ","
      text = substr(text, 1, RLENGTH)
      sub(/[ \t]*,?$/, "", text)
      text = substr(text, 2, length(text) - 2)
      gsub(/""/, "\"", text)
    } else {
      more = match(line, /,/)
      text = more ? substr(line, 1, RSTART - 1) : line
      line = more ? substr(line, RSTART + 1) : ""
      gsub(/^[ \t]+|[ \t]+$/, "", text)
    }
    cell[++n] = text
  } while (more)
  return n
}
function addColumn(text) {
  sub(/^-/, "", text)
  if (text == "") refuse("column " columns + 1 " has no name; allowed: names of flags, as kappa")
  if (text in known) refuse("column " text " stands twice; allowed: once")
  known[text] = 1
  name[++columns] = text
}
function isNumber(text) { return text ~ /^[-+]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][-+]?[0-9]+)?$/ }
function range(text, log10,   part, k, from, to) {  # appends FROM:TO:COUNT to the values of the last column
  if (split(text, part, ":") != 3 || !isNumber(part[1]) || !isNumber(part[2]) || part[3] !~ /^[0-9]+$/ || part[3] < 2 || part[3] > 100000)
    refuse(name[columns] " " text ": no range; allowed: FROM:TO:COUNT with a COUNT of at least 2, as 1:10:4")
  from = part[1] + 0
  to = part[2] + 0
  if (log10 && (from <= 0 || to <= 0)) refuse(name[columns] " " text " log: a logarithm needs positive ends; allowed: above 0")
  for (k = 0; k < part[3]; k++)
    value[columns, ++count[columns]] = sprintf("%.12g", log10 ? exp(log(from) + (log(to) - log(from)) * k / (part[3] - 1)) : from + (to - from) * k / (part[3] - 1))
}
function product(   item, items, word, words, i, k) {  # all combinations of the lists, the last one running fastest
  items = split(ENVIRON["VARY"], item, ",")
  for (i = 1; i <= items; i++) {
    words = split(item[i], word, /[ \t]+/)
    for (k = 1; word[k] == "" && k <= words; k++);
    if (k > words) refuse("list " i " is empty; allowed: a flag and its values, as kappa 1 10 100")
    while (words > 0 && word[words] == "") words--
    addColumn(word[k])
    for (k++; k <= words; k++) {
      if (word[k] ~ /:/) {
        range(word[k], word[k + 1] == "log")
        if (word[k + 1] == "log") k++
      } else value[columns, ++count[columns]] = word[k]
    }
    if (count[columns] == 0) refuse(name[columns] ": no values; allowed: " name[columns] " and values")
  }
  rows = 1
  for (i = 1; i <= columns; i++) rows *= count[i]
  if (rows > 1000000) refuse(rows " rows; allowed: at most 1000000")
  for (k = 0; k < rows; k++) {
    words = k
    for (i = columns; i > 0; i--) {
      table[k + 1, i] = value[i, words % count[i] + 1]
      words = int(words / count[i])
    }
  }
}
BEGIN {
  if (ENVIRON["VARY"] != "") product()
  if (ENVIRON["VARY"] != "") exit
}
{ sub(/\r$/, "") }
NR == 1 { sub(/^\357\273\277/, "") }
/^[ \t]*(#|$)/ { next }
columns == 0 {
  n = cells($0, cell)
  for (i = 1; i <= n; i++) addColumn(cell[i])
  next
}
{
  n = cells($0, cell)
  if (n != columns) refuse("line " NR " has " n " cells, the head " columns "; allowed: as many")
  rows++
  for (i = 1; i <= n; i++) table[rows, i] = cell[i]
}
END {
  if (refused) exit
  if (rows == 0) refuse("no rows; allowed: a head with names of flags, then a row for each problem")
  print ""
  print columns "\n" rows
  for (i = 1; i <= columns; i++) print name[i]
  for (k = 1; k <= rows; k++) for (i = 1; i <= columns; i++) print table[k, i]
}
