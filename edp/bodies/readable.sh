# readable.sh: a mesh file of the user's, checked and made readable for FreeFEM: sh readable.sh RUN FILE FOLDER
# Needs: RUN, the number of the run's process; awk; gmsh for a .geo file, and for what is not version 2 text.
# Gives: FOLDER/mesh.msh, see meshes/check.awk. FOLDER is new, and goes when the run has ended, however it ended: the run takes it
#        away itself if it can.
# Exit codes: 0 done, 1 refused: FOLDER/mesh.msh has one line that says why, 2 FOLDER cannot be made.
. "${0%/*}/../case/process.sh"
run=$1
file=$2
folder=$3
check=${0%/*}/../../meshes/check.awk
(umask 077 && mkdir "$folder") || exit 2
(
    trap '' HUP INT TERM
    while test -n "$(started "$run")" && test -e "$folder"; do sleep 1; done
    rm -rf "$folder"
) < /dev/null > /dev/null 2>&1 &

no() {
    echo "$1" > "$folder/mesh.msh"
    exit 1
}

test -d "$file" && no "a folder, no mesh"
test -r "$file" || no "may not be read"
how=
case $file in *.geo) how=-2 ;; esac
# the second line of gmsh's format: version, 0 for text or 1 for binary, size of a real
case $(head -c 200 "$file" | tr -d '\r\000' | sed -n '1{/^\$MeshFormat/!q};2{p;q}') in 4* | 2*" 1 "*) how=-save ;; esac
if test -n "$how"; then
    command -v gmsh > /dev/null || no "not gmsh's version 2 text format, and gmsh, which would convert it, is not on the PATH"
    gmsh "$how" -v 1 -format msh22 "$file" -o "$folder/converted.msh" > "$folder/log" 2>&1 < /dev/null
    grep -q '^Error' "$folder/log" && no "gmsh cannot read it: $(sed -n 's/^Error *: *//p' "$folder/log" | head -n 1)"
    test -s "$folder/converted.msh" || no "gmsh makes no mesh of it"
    file=$folder/converted.msh
fi
awk -f "$check" < "$file" > "$folder/mesh.msh" 2> /dev/null
code=$?
test $code -le 1 || no "cannot be checked: is awk there, and room in /tmp?"
test $code -eq 1 || test "$(tail -n 1 "$folder/mesh.msh")" = '$EndElements' || no "its larger copy cannot be written in /tmp"
exit $code
