# inp.awk: a mesh of CalculiX's or Abaqus' in gmsh's version 2 text format, its sets as groups:
#        SPACE=0|1 LC_ALL=C awk -f inp.awk CASE FILE.inp > FILE.msh
# LISTED=1: a table of all sets in place of the mesh.
# Needs: FILE.inp with *NODE, *ELEMENT, *NSET, *ELSET, *SURFACE of one part, other keywords are left out; CASE, the case file: of
#        the sets those are meant that stand in it.
# Gives: elements of ELSETs as bodies; plane elements in space, lines in the plane, as gmsh writes them: sides of bodies; sides of bodies as groups: of a SURFACE its sides, of an NSET all sides of the boundary whose
#        corners are in it. Quadrangles and bricks are cut later (meshes/cut.awk). Exit code 0. Or one line that says what is
#        wrong, exit code 1.
function no(what) { print "line " FNR ": " what; failed = 1; exit 1 }
function trim(t) { gsub(/^[ \t"]+|[ \t"\r]+$/, "", t); return t }
# of a keyword's line: what stands behind name=
function option(name,   k, w) {
  for (k = 2; k <= NF; k++) { split($k, w, "="); if (toupper(trim(w[1])) == name) return w[2] == "" ? "yes" : trim(w[2]) }
  return ""
}
function newSet(kind, name) {
  if (name == "") no("*" kind ": no name; allowed: " kind "=NAME")
  if (!((kind, name) in known)) { known[kind, name] = 1; sets[kind] = sets[kind] "\n" name }
  return name
}
BEGIN {
  FS = ","
  space = ENVIRON["SPACE"] + 0
  # kind of element: gmsh's type, nodes, in its order; sides of corners, then middles; corners
  solid("C3D4", 4, "1 2 3 4", "1 2 3/1 4 2/2 4 3/3 4 1", 4)
  solid("C3D10", 11, "1 2 3 4 5 6 7 8 10 9", "1 2 3 5 6 7/1 4 2 8 9 5/2 4 3 9 10 6/3 4 1 10 8 7", 4)
  solid("C3D8", 5, "1 2 3 4 5 6 7 8", "1 2 3 4/5 8 7 6/1 5 6 2/2 6 7 3/3 7 8 4/4 8 5 1", 8)
  solid("C3D6", 6, "1 2 3 4 5 6", "1 2 3/4 6 5/1 4 5 2/2 5 6 3/3 6 4 1", 6)
  solid("P3", 2, "1 2 3", "1 2/2 3/3 1", 3)
  solid("P6", 9, "1 2 3 4 5 6", "1 2 4/2 3 5/3 1 6", 3)
  solid("P4", 3, "1 2 3 4", "1 2/2 3/3 4/4 1", 4)
  solid("L2", 1, "1 2", "1 2", 2)
  solid("L3", 8, "1 3 2", "1 3 2", 2)
  allowed = space ? "C3D4, C3D10, C3D6, C3D8" : "CPE, CPS or CAX 3, 4, 6"
}
function solid(name, type, nodes, sides, corners) { gmsh[name] = type; order[name] = nodes; sidesOf[name] = sides; cornersOf[name] = corners }
function kindOf(t) {
  t = toupper(t)
  if (space && t ~ /^C3D(4|6|10|10M|10T|8|8R|8I|8H|8RH)$/) { sub(/[A-Z]*$/, "", t); return t }
  if (!space && t ~ /^(CPE|CPS|CAX)(3|4|6|4R|4I|4H|6M)$/) { gsub(/[^0-9]/, "", t); return "P" t }
  # gmsh's way to write sides of bodies, which its groups name, and the geometry's edges
  if (space && t ~ /^(CPE|CPS|CAX)(3|4|6)$/) { gsub(/[^0-9]/, "", t); return "P" t }
  if (t ~ /^T[23]D[23]$/) return "L" substr(t, 4)
  no("*ELEMENT, TYPE=" t ": not read; allowed: " allowed)
}
# CASE, if any: all words of the statements
FILENAME == ARGV[1] {
  sub(/#.*/, "")
  n = split($0, q, "\"")
  for (k = 1; k <= n; k++)
    if (k % 2 == 0) wanted[q[k]] = 1
    else { m = split(q[k], w, /[ \t\r]+/); for (j = 1; j <= m; j++) wanted[w[j]] = 1 }
  next
}
{ sub(/\r$/, "") }
/^\*\*/ || /^[ \t]*$/ { next }
/^\*/ {
  section = toupper(trim(substr($1, 2)))
  into = ""
  open_ = 0
  if (section == "NODE") { if (option("NSET") != "") into = newSet("NSET", option("NSET")) }
  else if (section == "ELEMENT") {
    kind = kindOf(option("TYPE"))
    isSideKind = kind ~ (space ? "^[PL]" : "^L")
    if (option("ELSET") != "") into = newSet("ELSET", option("ELSET"))
  } else if (section == "NSET" || section == "ELSET") { into = newSet(section, option(section)); generate = option("GENERATE") != "" }
  else if (section == "SURFACE") {
    surfaceKind = toupper(option("TYPE"))
    into = surfaceKind == "NODE" ? newSet("NSET", option("NAME")) : newSet("SURFACE", option("NAME"))
  } else if (section == "PART" && ++parts_ > 1) no("*PART: a second one; allowed: one part, or a mesh of all without parts")
  else if (section == "INCLUDE") no("*INCLUDE: not read; allowed: one file")
  else if (section == "STEP") exit
  next
}
section == "INSTANCE" { no("an instance that is moved; allowed: places in the nodes themselves") }
section == "NODE" {
  i = $1 + 0
  if (NF < 3 || i < 1) no("no node: number and places; allowed: number, x, y, z")
  if (i in x) no("the node " i " is there twice; allowed: one mesh of all parts")
  x[i] = $2 + 0; y[i] = $3 + 0; z[i] = $4 + 0
  inOrder[++nodes] = i
  if (into != "") inSet["NSET", into, i] = 1
}
# over as many lines as there are commas at their ends
section == "ELEMENT" {
  start = 1
  if (!open_) {
    e = $1 + 0
    if (e in typeOf) no("the element " e " is there twice; allowed: once")
    typeOf[e] = kind
    if (isSideKind) flat[++flats] = e
    else elementAt[++elements] = e
    given[e] = 0
    start = 2
    if (into != "") inSet["ELSET", into, e] = 1
  }
  need = split(order[kind], w, " ")
  for (k = start; k <= NF; k++) if (trim($k) != "") {
    i = $k + 0
    if (!(i in x)) no("element " e ": a node that is missing: " trim($k) "; allowed: nodes above")
    corner[e, ++given[e]] = i
  }
  open_ = given[e] < need
  if (given[e] > need) no("element " e " has " given[e] " nodes, of the " need " that " kind " has")
}
section == "NSET" || section == "ELSET" {
  if (generate) { for (i = $1 + 0; i <= $2 + 0; i += ($3 + 0 > 0 ? $3 + 0 : 1)) inSet[section, into, i] = 1; next }
  for (k = 1; k <= NF; k++) {
    t = trim($k)
    if (t ~ /^[0-9]+$/) inSet[section, into, t + 0] = 1
    else if (t != "") others[++nested] = section SUBSEP into SUBSEP t
  }
}
section == "SURFACE" {
  t = trim($1)
  if (surfaceKind == "NODE") { if (t ~ /^[0-9]+$/) inSet["NSET", into, t + 0] = 1; else others[++nested] = "NSET" SUBSEP into SUBSEP t; next }
  s = toupper(trim($2))
  if (s !~ /^S[1-6]$/) no("*SURFACE: " s ": no side of an element; allowed: S1 ... S6")
  surfaceOf[++surfaces] = into SUBSEP t SUBSEP substr(s, 2)
}
function group(dimension, name) {
  if ((dimension, name) in number) return number[dimension, name]
  number[dimension, name] = ++groups
  names[groups] = dimension " " groups " \"" name "\""
  return groups
}
# the nodes of a side, and a name for it whatever their order
function side(e, s,   list, w, n, k, j, key, c, t) {
  split(sidesOf[typeOf[e]], list, "/")
  if (list[s] == "") return ""
  n = split(list[s], w, " ")
  nodes_ = ""
  c = gmsh[typeOf[e]] ~ /^(9|11)$/ ? (space ? n / 2 : n - 1) : n
  for (k = 1; k <= n; k++) nodes_ = nodes_ " " corner[e, w[k]]
  for (k = 1; k <= c; k++) t[k] = corner[e, w[k]]
  for (k = 2; k <= c; k++) for (j = k; j > 1 && t[j] < t[j - 1]; j--) { key = t[j]; t[j] = t[j - 1]; t[j - 1] = key }
  key = ""
  for (k = 1; k <= c; k++) key = key " " t[k]
  sideCorners = c
  sideType = space ? (n == 6 ? 9 : (c == 4 ? 3 : 2)) : (n == 3 ? 8 : 1)
  return key
}
function holds(set, list, n,   k) {
  for (k = 1; k <= n; k++) if (("ELSET", set, list[k]) in inSet) return 1
  return 0
}
function write(e, s, name,   key) {
  key = side(e, s)
  if (key == "") { print "*SURFACE " name ": element " e " has no side S" s; failed = 1; exit 1 }
  if ((name, key) in written) return
  written[name, key] = 1
  line[++lines] = sideType " 2 " group(1 + space, name) " " group(1 + space, name) nodes_
}
# the places between which a set lies
function widen(i) {
  if (!members++) { for (j = 1; j <= 3; j++) low[j] = high[j] = j == 1 ? x[i] : (j == 2 ? y[i] : z[i]); return }
  for (j = 1; j <= 3; j++) {
    t = j == 1 ? x[i] : (j == 2 ? y[i] : z[i])
    if (t < low[j]) low[j] = t
    if (t > high[j]) high[j] = t
  }
}
function row(kind, name, count) {
  text = sprintf("%-8s %-24s %8d", kind, name, count)
  if (members) text = text sprintf("   (%.4g, %.4g%s) to (%.4g, %.4g%s)", low[1], low[2], space ? sprintf(", %.4g", low[3]) : "", high[1], high[2], space ? sprintf(", %.4g", high[3]) : "")
  print text
  members = 0
}
# a table of all sets: of elements with a body first, then those that may be boundaries
function tell(   k, n, list, key, v, e, i, w, some) {
  for (key in inSet) { split(key, v, SUBSEP); held[v[1], v[2]] = held[v[1], v[2]] " " v[3] }
  print "kind     name                        count   from ... to"
  n = split(substr(sets["ELSET"], 2), list, "\n")
  for (some = 1; some >= 0; some--)
    for (k = 1; k <= n; k++) {
      if (holds(list[k], elementAt, elements) != some) continue
      m = split(held["ELSET", list[k]], w, " ")
      for (e = 1; e <= m; e++) for (i = 1; i <= given[w[e]]; i++) widen(corner[w[e], i])
      row(some ? "body" : "sides", list[k], m)
    }
  if (n == 0) { for (i = 1; i <= nodes; i++) widen(inOrder[i]); row("body", "(no *ELSET)", elements) }
  n = split(substr(sets["NSET"], 2), list, "\n")
  for (k = 1; k <= n; k++) {
    m = split(held["NSET", list[k]], w, " ")
    for (e = 1; e <= m; e++) if (w[e] in x) widen(w[e])
    row("nodes", list[k], m)
  }
  n = split(substr(sets["SURFACE"], 2), list, "\n")
  for (k = 1; k <= n; k++) {
    m = 0
    for (e = 1; e <= surfaces; e++) {
      split(surfaceOf[e], v, SUBSEP)
      if (v[1] != list[k]) continue
      some = v[2] ~ /^[0-9]+$/ ? split(v[2], w, " ") : split(held["ELSET", v[2]], w, " ")
      for (i = 1; i <= some; i++) if (w[i] in typeOf && side(w[i], v[3]) != "") { m++; count_ = split(nodes_, ends, " "); for (c = 1; c <= count_; c++) widen(ends[c]) }
    }
    row("surface", list[k], m)
  }
}
END {
  if (failed) exit 1
  if (!elements) { print "no *ELEMENT of a body; allowed: " allowed; exit 1 }
  for (e in given) { n = split(order[typeOf[e]], w, " "); if (given[e] < n) { print "element " e ": cut off"; exit 1 } }
  # sets of sets
  for (k = 1; k <= nested; k++) {
    split(others[k], w, SUBSEP)
    some = 0
    for (key in inSet) { split(key, v, SUBSEP); if (v[1] == w[1] && v[2] == w[3]) more[w[1], w[2], v[3]] = some = 1 }
    for (key in more) inSet[key] = 1
    split("", more)
  }
  if (ENVIRON["LISTED"]) { tell(); exit 0 }
  n = split(substr(sets["SURFACE"], 2), list, "\n")
  for (k = 1; k <= n; k++) group(1 + space, list[k])
  n = split(substr(sets["NSET"], 2), list, "\n")
  for (k = 1; k <= n; k++) group(1 + space, list[k])
  bodies = split(substr(sets["ELSET"], 2), body, "\n")
  for (k = 1; k <= bodies; k++) if (holds(body[k], elementAt, elements)) group(2 + space, body[k])
  # an ELSET of sides is a group of them
  for (k = 1; k <= bodies; k++)
    if (!((2 + space, body[k]) in number)) {
      group(1 + space, body[k])
      for (i = 1; i <= flats && (body[k] in wanted); i++)
        if ((("ELSET", body[k], flat[i]) in inSet) && (gmsh[typeOf[flat[i]]] ~ (space ? "^(2|3|9)$" : "^(1|8)$"))) {
          t = ""
          m = split(order[typeOf[flat[i]]], w, " ")
          for (j = 1; j <= m; j++) t = t " " corner[flat[i], space ? w[j] : (j == 3 ? 2 : (m == 3 && j == 2 ? 3 : j))]
          line[++lines] = gmsh[typeOf[flat[i]]] " 2 " group(1 + space, body[k]) " " group(1 + space, body[k]) t
        }
    }
  # how many elements have a side; whose boundary it is
  for (i = 1; i <= elements; i++)
    for (s = 1; s <= 6; s++) if ((key = side(elementAt[i], s)) != "") times[key]++
  for (k = 1; k <= surfaces; k++) {
    split(surfaceOf[k], w, SUBSEP)
    if (!(w[1] in wanted)) continue
    if (w[2] ~ /^[0-9]+$/) { write(w[2] + 0, w[3], w[1]); continue }
    if (!(("ELSET", w[2]) in known)) { print "*SURFACE " w[1] ": no *ELSET " w[2]; exit 1 }
    for (i = 1; i <= elements; i++) if (("ELSET", w[2], elementAt[i]) in inSet) write(elementAt[i], w[3], w[1])
  }
  n = split(substr(sets["NSET"], 2), list, "\n")
  for (k = 1; k <= n; k++) {
    if (!(list[k] in wanted) || ("SURFACE", list[k]) in known) continue
    for (i = 1; i <= elements; i++)
      for (s = 1; s <= 6; s++) {
        key = side(elementAt[i], s)
        if (key == "" || times[key] > 1) continue
        m = split(key, w, " ")
        for (j = 1; j <= m && (("NSET", list[k], w[j]) in inSet); j++);
        if (j > m) write(elementAt[i], s, list[k])
      }
  }
  for (i = 1; i <= elements; i++) {
    e = elementAt[i]
    g = 0
    for (k = 1; k <= bodies; k++)
      if ((body[k] in wanted) && (("ELSET", body[k], e) in inSet)) {
        if (g) { print "element " e " is in two bodies of the case, " was " and " body[k] "; allowed: one"; exit 1 }
        g = group(2 + space, body[k])
        was = body[k]
      }
    t = gmsh[typeOf[e]] " 2 " g " " g
    m = split(order[typeOf[e]], w, " ")
    for (k = 1; k <= m; k++) t = t " " corner[e, w[k]]
    line[++lines] = t
  }
  print "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n" groups
  for (k = 1; k <= groups; k++) print names[k]
  print "$EndPhysicalNames\n$Nodes\n" nodes
  for (k = 1; k <= nodes; k++) printf "%d %.17g %.17g %.17g\n", inOrder[k], x[inOrder[k]], y[inOrder[k]], z[inOrder[k]]
  print "$EndNodes\n$Elements\n" lines
  for (k = 1; k <= lines; k++) print k " " line[k]
  print "$EndElements"
}
