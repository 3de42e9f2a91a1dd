# unknown-flag.awk: the refusal of a word that is no flag of a scene, with the flag that was meant, if that can be guessed
# Read by awk after case-words.awk. In the environment: CONTACT_WORD: the word; CONTACT_FLAGS: the scene's flags, each after a blank.
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
