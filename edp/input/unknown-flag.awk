# unknown-flag.awk: the refusal of a word that is no flag of a scene, with the flag that was meant, if that can be guessed
# In the environment: CONTACT_WORD: the word; CONTACT_FLAGS: the scene's flags, each after a blank.
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
BEGIN {
  given = ENVIRON["CONTACT_WORD"]
  all = ENVIRON["CONTACT_FLAGS"]
  equals = index(given, "=")
  name = equals > 1 ? substr(given, 1, equals - 1) : given
  least = 1 + (length(name) > 6 ? int((length(name) - 1) / 3) : 1)
  n = length(name) > 40 ? 0 : split(all, flag, " ")
  for (k = 1; k <= n; k++) {
    off = distance(name, flag[k])
    if (off < least && (!off || (length(name) > 2 && length(flag[k]) > 2))) { least = off; near = flag[k] }
  }
  if (equals > 1 && near != "" && !least)
    text = ": not a flag; allowed: a blank between flag and value: write " near (equals < length(given) ? " " substr(given, equals + 1) : " and its value")
  else if (near != "") text = ": unknown flag: did you mean " near "? allowed: " near " and what else -help lists"
  else if (index(given, "-") != 1) text = ": stands alone; allowed: a flag with one value after it, as -help lists them"
  else text = ": unknown flag in this scene; allowed:" all " -help"
  text = given text
  gsub(/[[:cntrl:]]/, " ", text)
  print text
}
