# scale.awk: a mesh file with lengths a million times as large: awk -f scale.awk FILE.msh
BEGIN { OFMT = CONVFMT = "%.17g" }
{ sub(/\r$/, "") }
/^\$/ { section = $1; rows = -1; print; next }
section == "$Nodes" && rows < 0 { rows = $1; print; next }
section == "$Nodes" { print $1, $2 * 1000000, $3 * 1000000, $4 * 1000000; next }
{ print }
