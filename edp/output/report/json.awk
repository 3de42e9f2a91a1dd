# json.awk: reads a JSON file into the arrays v and count
# Read by awk before a program that uses them. v[path]: a number, or the text of a string, true, false or null; count[path]: the entries
# of a list; names[path]: the names of an object, each after SUBSEP. A path is .name of an entry, .0 .1 ... of a list's.
{
  line = $0
  while (match(line, /"([^"\\]|\\.)*"|[][{}:,]|[^][{}:, \t"]+/)) {
    token[++tokens] = substr(line, RSTART, RLENGTH)
    line = substr(line, RSTART + RLENGTH)
  }
}
function plain(text) {
  text = substr(text, 2, length(text) - 2)
  gsub(/\\[ntrf]/, " ", text)
  gsub(/\\"/, "\"", text)
  gsub(/\\\\/, "\\", text)
  return text
}
function parse(path,   t, name, i) {
  t = token[++at]
  if (t == "{") {
    if (token[at + 1] == "}") { at++; return }
    do {
      name = plain(token[++at])
      at++
      names[path] = names[path] SUBSEP name
      parse(path "." name)
      t = token[++at]
    } while (t == ",")
  } else if (t == "[") {
    count[path] = 0
    if (token[at + 1] == "]") { at++; return }
    i = 0
    do {
      parse(path "." i++)
      t = token[++at]
    } while (t == ",")
    count[path] = i
  } else v[path] = t ~ /^"/ ? plain(t) : (t ~ /^-?[0-9]/ ? t + 0 : t)
}
function known(path) { return (path in v) && v[path] != "null" && v[path] != "" }
