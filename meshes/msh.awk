# msh.awk: gmsh's version 2 text format, read for parts.awk, which comes after it: awk -f msh.awk -f parts.awk < FILE.msh
# Needs: nothing.
# Gives: x, y, z of each node, its numbers in the file's order: inOrder (1 ... nodes);  rows[section]: how many lines it says it has;
#        section, count: where the present line is;  fail(what), element(what): one line that says what is wrong, exit code 1;
#        number(t), node(t): is it one;  root(i): of a union of parent[];  complete(): at the end, unless something was wrong.
function fail(what) {
  # `exit` leads to END, and out of it
  if (finishing) print what
  reason = what
  exit 1
}
function element(what) { fail("element " $1 " (line " NR "): " what) }
function number(t) { return t ~ /^[+-]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][+-]?[0-9]+)?$/ && t + 0 < 1e150 && t + 0 > -1e150 }
function root(i) { while (parent[i] != i) i = parent[i] = parent[parent[i]]; return i }
function node(t) {
  if (t !~ /^[0-9]+$/ || !((t + 0) in x)) element("a node that is missing: " t)
  return t + 0
}
function complete() {
  if (reason == "") {
    if (NR == 0) reason = "an empty file, not gmsh's version 2 text format"
    else if (!("MeshFormat" in rows)) reason = "not gmsh's version 2 text format"
    else if (section != "" || !("Nodes" in rows) || !("Elements" in rows)) reason = "cut off" (section ? " in $" section : "")
    else if (!("PhysicalNames" in rows)) reason = "no physical groups"
  }
  if (reason != "") { print reason; exit 1 }
  finishing = 1
}

BEGIN { section = "" }
{ sub(/\r$/, "") }
NR == 1 && substr($1, 1, 1) != "$" { fail("not gmsh's version 2 text format") }
section != "" && $1 == "$End" section {
  if (section in rows && rows[section] != count) fail("$" section " has " count " lines, and says " rows[section] ": cut off?")
  section = ""
  next
}
section == "" {
  if (substr($1, 1, 1) != "$") next
  section = substr($1, 2)
  count = -1
  if (section ~ /^(MeshFormat|PhysicalNames|Nodes|Elements)$/) {
    if (section in rows) fail("a second $" section " (line " NR ")")
    rows[section] = 1
    if (section == "MeshFormat") count = 0
  }
  next
}
!(section in rows) || NF == 0 { next }
count < 0 {
  if ($0 !~ /^[ \t]*[0-9]+[ \t]*$/) fail("line " NR ": the number of lines of $" section " is no number")
  rows[section] = $1 + 0
  count = 0
  next
}
{ count++ }
section == "MeshFormat" && ($1 + 0 < 2 || $1 + 0 >= 3 || $2 != "0") { fail("not gmsh's version 2 text format: version " $1 ", binary " $2) }
section == "Nodes" {
  if ($1 !~ /^[0-9]+$/ || $1 + 0 < 1) fail("line " NR ": the node " $1 "; node numbers start at 1")
  if (NF != 4) fail("node " $1 " (line " NR "): " NF - 1 " coordinates for 3")
  for (k = 2; k <= 4; k++) if (!number($k)) fail("node " $1 " (line " NR "): the coordinate " $k " is no number")
  i = $1 + 0
  if (i in x) fail("node " i " (line " NR ") is there twice")
  x[i] = $2 + 0; y[i] = $3 + 0; z[i] = $4 + 0
  inOrder[++nodes] = i
}
