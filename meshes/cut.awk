# cut.awk: a mesh in gmsh's version 2 text format whose quadrangles, bricks, prisms and pyramids of first order are cut into
#        triangles and tetrahedra: LC_ALL=C awk -f cut.awk FILE.msh FILE.msh
# Needs: FILE.msh, twice: its elements are counted first.
# Gives: on standard output the mesh. Every quadrangle is cut from its lowest node, whatever it is a side of, so neighbours fit; a
#        solid is the cone from its lowest node over the sides that do not have it.
BEGIN {
  sides[5] = "1 2 3 4/5 6 7 8/1 2 6 5/2 3 7 6/3 4 8 7/4 1 5 8"
  sides[6] = "1 2 3/4 5 6/1 2 5 4/2 3 6 5/3 1 4 6"
  sides[7] = "1 2 3 4/1 2 5/2 3 5/3 4 5/4 1 5"
}
function out(type, head, nodes) {
  many++
  if (pass == 2) print many, type, head nodes
}
# a side's triangles into piece[1 ...]
function triangles(v, n,   k, low) {
  low = 1
  for (k = 2; k <= n; k++) if (v[k] < v[low]) low = k
  count = 0
  if (n == 3) { piece[++count] = " " v[1] " " v[2] " " v[3]; return }
  piece[++count] = " " v[low] " " v[low % 4 + 1] " " v[(low + 1) % 4 + 1]
  piece[++count] = " " v[low] " " v[(low + 1) % 4 + 1] " " v[(low + 2) % 4 + 1]
}
FNR == 1 { pass++; if (pass == 2) { total = many; many = 0 } }
/^\$/ { section = $1; row = 0; if (pass == 2) print; next }
section != "$Elements" { if (pass == 2) print; next }
++row == 1 { if (pass == 2) print total; next }
{
  head = $3
  for (k = 4; k <= 3 + $3; k++) head = head " " $k
  n = NF - 3 - $3
  for (k = 1; k <= n; k++) v[k] = $(3 + $3 + k) + 0
  if ($2 == 3) { triangles(v, 4); for (k = 1; k <= count; k++) out(2, head, piece[k]) }
  else if ($2 in sides) {
    low = 1
    for (k = 2; k <= n; k++) if (v[k] < v[low]) low = k
    many_ = split(sides[$2], side, "/")
    for (s = 1; s <= many_; s++) {
      m = split(side[s], w, " ")
      has = 0
      for (k = 1; k <= m; k++) { c[k] = v[w[k]]; has = has || w[k] == low }
      if (has) continue
      triangles(c, m)
      for (k = 1; k <= count; k++) out(4, head, " " v[low] piece[k])
    }
  } else { rest = ""; for (k = 1; k <= n; k++) rest = rest " " v[k]; out($2, head, rest) }
}
