# check.awk: whether a mesh file of two bodies can be read: awk -f check.awk FILE.msh; exit code 0 yes, otherwise the reason:
# 2 not gmsh's version 2 text format, 3 cut off, 4 no physical groups, 5 elements that are no triangles, lines or points,
# 6 a triangle without area, 7 a triangle whose corners run clockwise, 8 a number that is none, 9 a node of both bodies,
# 10 an edge in two groups, 11 a blank in a group's name, 12 a part of a body that no edge of clamped or pushed holds,
# 13 triangles too small for FreeFEM, once lengths are a million times as large (scale.awk)
function fail(why) { code = why; exit }
function root(k) { while (parent[k] != k) k = parent[k] = parent[parent[k]]; return k }
BEGIN { section = "" ; code = 0 }
{ sub(/\r$/, "") }
NR == 1 { if ($1 != "$MeshFormat") fail(2) }
NR == 2 { if ($1 + 0 < 2 || $1 + 0 >= 3 || $2 != "0") fail(2) }
/^\$End/ { done[section] = (count == rows); section = ""; next }
/^\$/ { section = substr($1, 2); rows = -1; count = 0; next }
section == "" { next }
rows < 0 { rows = $1 + 0; next }
{ count++ }
section == "PhysicalNames" {
  if (NF != 3) fail(11)
  if ($3 == "\"clamped\"" || $3 == "\"pushed\"") holds[$2] = 1
}
section == "Nodes" {
  if (NF < 4 || $2 $3 $4 ~ /[^0-9eE.+-]/) fail(8)
  x[$1] = $2; y[$1] = $3; parent[$1] = $1
}
section == "Elements" {
  if ($2 != 1 && $2 != 2 && $2 != 15) fail(5)
  if ($3 + 0 != $3 || NF != 3 + $3 + ($2 == 2 ? 3 : ($2 == 1 ? 2 : 1))) fail(3)
  b = $(NF - 1); c = $NF
  if (!(c in x) || $2 != 15 && !(b in x)) fail(8)
  if ($2 == 1) {
    key = b < c ? b " " c : c " " b
    if (key in edge && edge[key] != $4) fail(10)
    edge[key] = $4
    if ($4 in holds) held[b] = held[c] = 1
  }
  if ($2 == 2) {
    a = $(NF - 2)
    if (!(a in x)) fail(8)
    twice = (x[b] - x[a]) * (y[c] - y[a]) - (x[c] - x[a]) * (y[b] - y[a])
    sides = (x[b] - x[a])^2 + (y[b] - y[a])^2 + (x[c] - x[a])^2 + (y[c] - y[a])^2
    if (twice <= 1e-10 * sides && twice >= -1e-10 * sides) fail(6)
    if (twice < 0) fail(7)
    if (0.5e12 * twice < 1e-7) fail(13)
    for (k = 0; k < 3; k++) {
      node = $(NF - k)
      if (node in body && body[node] != $4) fail(9)
      body[node] = $4
      parent[root(node)] = root(a)
    }
  }
}
END {
  if (code) exit code
  if (NR == 0) exit 2
  if (!done["Nodes"] || !done["Elements"] || section != "") exit 3
  if (!done["PhysicalNames"]) exit 4
  for (node in held) fixed[root(node)] = 1
  for (node in body) if (!(root(node) in fixed)) exit 12
}
