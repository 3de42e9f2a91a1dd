# case-words.awk: the words of a case file's line: quotes, numbers, vectors, and what is said of a word that is not allowed
# Read by awk before case-file.awk. A message names the file and the line, says what is wrong, and ends the program with exit code 1.
# no(what): the message; distance(a, b): of two words, in letters; meant(word, words): the one that was meant; splitLine(): word[1] ...
# word[words]; the next word of the line, at `at`: number(what, low, high), any(what), vector(what, k, into, from), keyword(name).
function no(what) {
  if (!finishing) what = "line " (ahead ? ahead : FNR) ": " what
  gsub(/[[:cntrl:]]/, " ", what)
  if (length(what) > 3000) what = substr(what, 1, 100) " ... " substr(what, length(what) - 2800)
  print "-case " ENVIRON["CASE"] ", " what
  failed = 1
  exit 1
}
function usageOf(word) { return "allowed: " usage[word] (word in example ? ", as " example[word] : "") }

# how many letters must be put in, left out or exchanged to make one word of the other
function distance(a, b,   i, j, d, cost) {
  for (i = 0; i <= length(a); i++) d[i, 0] = i
  for (j = 0; j <= length(b); j++) d[0, j] = j
  for (i = 1; i <= length(a); i++)
    for (j = 1; j <= length(b); j++) {
      d[i, j] = d[i - 1, j] < d[i, j - 1] ? d[i - 1, j] + 1 : d[i, j - 1] + 1
      cost = d[i - 1, j - 1] + (substr(a, i, 1) != substr(b, j, 1))
      if (cost < d[i, j]) d[i, j] = cost
      if (i > 1 && j > 1 && substr(a, i, 1) == substr(b, j - 1, 1) && substr(a, i - 1, 1) == substr(b, j, 1) && d[i - 2, j - 2] + 1 < d[i, j])
        d[i, j] = d[i - 2, j - 2] + 1
    }
  return d[length(a), length(b)]
}
# of the words between "|", the one that was meant, if that can be guessed
function meant(word, words,   list, n, k, off, least, found) {
  if (length(word) > 40) return ""
  n = split(words, list, "|")
  least = 2 + int(length(word) / 4)
  for (k = 1; k <= n; k++) {
    off = distance(tolower(word), tolower(list[k]))
    if (off < least) { least = off; found = list[k] }
  }
  return found == "" ? "" : "did you mean " found "? "
}

# of an unknown statement the one that does what it is likely to ask for, and what that does
function leadTo(t,   k, n, list, near) {
  t = tolower(t)
  sub(/s$/, "", t)
  if (t in instead) return instead[t] "; "
  n = split(t in leads ? leads[t] : "", list, " ")
  for (k = 1; k <= n && !(list[k] in usage); k++);
  if (k <= n) near = "did you mean " list[k] "? "
  else near = meant(word[1], statementWords)
  k = near
  sub(/^did you mean /, "", k)
  sub(/\? $/, "", k)
  return k in does ? "did you mean " k " (" does[k] ")? " : near
}

# the line's words: word[1] ... word[words], blanks kept between quotes, # begins a comment
function splitLine(   rest, at) {
  words = 0
  rest = $0
  while (1) {
    sub(/^[ \t\r]+/, "", rest)
    if (rest == "" || substr(rest, 1, 1) == "#") return
    words++
    if (substr(rest, 1, 1) == "\"") {
      at = index(substr(rest, 2), "\"")
      if (!at) no(rest ": a quote that does not end; allowed: \"name\"")
      word[words] = substr(rest, 2, at - 1)
      rest = substr(rest, at + 2)
      if (rest ~ /^[^ \t\r#]/) no("\"" word[words] "\"" rest ": no blank after the quote; allowed: a blank between two words")
      if (word[words] == "") no("\"\": an empty name; " usageOf(word[1]))
    } else {
      match(rest, /^[^ \t\r#"]+/)
      word[words] = substr(rest, 1, RLENGTH)
      rest = substr(rest, RLENGTH + 1)
      if (substr(rest, 1, 1) == "\"") no(word[words] rest ": a quote inside a word; allowed: a blank between two words")
    }
    if (word[words] ~ /[[:cntrl:]]/) no(word[words] ": a control character; allowed: letters, digits and signs")
  }
}
function spells(t) { return t ~ /^[+-]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][+-]?[0-9]+)?$/ }
# the next word of the line, as a number above `low`, below `high`
function number(what, low, high,   t, v, mantissa) {
  if (at >= words) no(what " is missing after " word[words] "; " usageOf(word[1]))
  t = word[++at]
  if (!spells(t)) no(t ": " what " is no number; " usageOf(word[1]))
  v = t + 0
  mantissa = t
  sub(/[eE].*/, "", mantissa)
  if (mantissa ~ /[1-9]/ && (v < 1e-40 && v > -1e-40 || v > 1e40 || v < -1e40))
    no(t ": " what " cannot be computed with; allowed: 0, and magnitudes from 1e-40 to 1e40")
  if (v <= low || v >= high) no(t ": " what " is out of range; allowed: " (low == -1e-300 ? "at least 0" : low > -1e300 ? "above " low : "") (low > -1e300 && high < 1e300 ? " and " : "") (high < 1e300 ? "below " high : ""))
  return v
}
function any(what) { return number(what, -1e300, 1e300) }
# refused before what they say: as many numbers to come as a vector has
function counted(what,   n) {
  while (at + n < words && spells(word[at + n + 1])) n++
  if (n > 2 + space) no(word[at + 3 + space] ": " what " has " n " numbers, more than the " 2 + space " components there are; " usageOf(word[1]))
}
function vector(what, k, into, from) {
  for (k = 0; k < 3; k++) into[from + k] = k < 2 + space ? any(what) : 0
}
function nonzero(what, into, from) {
  if (into[from] == 0 && into[from + 1] == 0 && into[from + 2] == 0) no(what " is 0 in every direction; " usageOf(word[1]))
}
# the next word, which must be this one
function keyword(name) {
  if (at >= words) no(name " is missing after " word[words] "; " usageOf(word[1]))
  if (word[++at] != name) no(word[at] ": not allowed here; " usageOf(word[1]))
}
