# check.awk: whether a mesh file can be read: awk -f check.awk FILE.msh; exit code 0 yes, otherwise the reason:
# 2 not gmsh's version 2 text format, 3 cut off, 4 no physical groups, 5 elements that are no triangles, lines or points,
# 6 a triangle without area, 7 a triangle whose corners run clockwise, 8 a number that is none
function fail(why) { code = why; exit }
BEGIN { section = "" ; code = 0 }
NR == 1 { if ($1 != "$MeshFormat") fail(2) }
NR == 2 { if ($1 + 0 < 2 || $1 + 0 >= 3 || $2 != "0") fail(2) }
/^\$End/ { done[section] = (count == rows); section = ""; next }
/^\$/ { section = substr($1, 2); rows = -1; count = 0; next }
section == "" { next }
rows < 0 { rows = $1 + 0; next }
{ count++ }
section == "Nodes" {
  if (NF < 4 || $2 $3 $4 ~ /[^0-9eE.+-]/) fail(8)
  x[$1] = $2; y[$1] = $3
}
section == "Elements" {
  if ($2 != 1 && $2 != 2 && $2 != 15) fail(5)
  if ($3 + 0 != $3 || NF != 3 + $3 + ($2 == 2 ? 3 : ($2 == 1 ? 2 : 1))) fail(3)
  if ($2 == 2) {
    a = $(NF - 2); b = $(NF - 1); c = $NF
    if (!(a in x && b in x && c in x)) fail(8)
    twice = (x[b] - x[a]) * (y[c] - y[a]) - (x[c] - x[a]) * (y[b] - y[a])
    sides = (x[b] - x[a])^2 + (y[b] - y[a])^2 + (x[c] - x[a])^2 + (y[c] - y[a])^2
    if (twice <= 1e-10 * sides && twice >= -1e-10 * sides) fail(6)
    if (twice < 0) fail(7)
  }
}
END {
  if (code) exit code
  if (NR == 0) exit 2
  if (!done["Nodes"] || !done["Elements"] || section != "") exit 3
  if (!done["PhysicalNames"]) exit 4
}
