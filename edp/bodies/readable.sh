# readable.sh: a mesh file of the user's, checked and made readable for FreeFEM: sh readable.sh RUN FILE FOLDER CASE SPACE
# Needs: RUN, the number of the run's process; awk; gmsh for a .geo file, and for what is not version 2 text; CASE, a case file;
#        SPACE, 1 for bodies in space, 0 for the plane.
# Gives: FOLDER/mesh.msh, see meshes/parts.awk, and FOLDER/case, see case/case-file.awk, with the regions of meshes/parts.awk
#        behind it, and FOLDER/middles, FOLDER/curves; FOLDER/gmsh: gmsh's version, if it meshed FILE. FOLDER is new, and goes when the run has
#        ended, however it ended: the run takes it away itself if it can.
# Exit codes: 0 done, 1 refused: FOLDER/why has one line, 2 FOLDER cannot be made, 3 the case file is refused.
. "${0%/*}/../case/process.sh"
run=$1
file=$2
case $file in -*) file=./$file ;; esac
folder=$3
case $folder in /*) ;; *) folder=./$folder ;; esac
case_=$4
space=$5
meshes=${0%/*}/../../meshes
(umask 077 && mkdir "$folder") || exit 2
(
    trap '' HUP INT TERM
    while test -n "$(started "$run")" && test -e "$folder"; do sleep 1; done
    rm -rf "$folder"
) < /dev/null > /dev/null 2>&1 &

no() {
    echo "$1" > "$folder/why"
    exit "${2:-1}"
}

test -d "$file" && no "a folder, no mesh"
test -r "$file" || no "may not be read"
how=
: > "$folder/gmsh"
order=
every=
case $file in *.geo)
    how=-$((2 + space))
    # in the plane the elements on all curves, with their numbers: gmsh would leave out those that have no name; and their middles
    test "$space" != 0 || every=${0%/*}/every-curve.geo
    order=${every:+-order 2}
    # kept as the package's own meshes are, if it stands for itself: what it includes may change unseen
    generated=$(sh "${0%/*}/../case/cache.sh" "$run" "${0%/*}/../..")
    generated=${generated:+$generated/meshes}
    generated=${generated:-$meshes/generated}
    kept=$generated/own-$(cksum < "$file" | tr ' ' -)$how${every:+-curves}.msh
    if ! grep -qiE 'merge|include|shapefromfile' "$file" && mkdir -p "$generated" 2> /dev/null \
        && AFTER=$every sh "${0%/*}/mesh.sh" "$run" "$kept" "$file" "$how" $order -format msh22; then
        file=$kept
        sed -n '/^\$Comments/{n;s/^Gmsh //p;q;}' "$kept" > "$folder/gmsh"
        how=
    fi ;;
esac
# the second line of gmsh's format: version, 0 for text or 1 for binary, size of a real
case $(head -c 200 "$file" | tr -d '\r\000' | sed -n '1{/^\$MeshFormat/!q};2{p;q}') in 4* | 2*" 1 "*) how=-save ;; esac
if test -n "$how"; then
    command -v gmsh > /dev/null || no "not gmsh's version 2 text format, and gmsh, which would convert it, is not on the PATH"
    gmsh "$how" $order -v 4 -format msh22 "$file" ${every:+"$every"} -o "$folder/converted.msh" > "$folder/log" 2>&1 < /dev/null
    grep -q '^Error' "$folder/log" && no "gmsh cannot read it: $(sed -n 's/^Error *: *//p' "$folder/log" | head -n 1)"
    test -s "$folder/converted.msh" || no "gmsh makes no mesh of it"
    test "$how" = -save || sed -n '1s/.*\[Gmsh \([^],]*\).*/\1/p' "$folder/log" > "$folder/gmsh"
    file=$folder/converted.msh
fi
tr -d '\r' < "$file" | sed -n '/^\$PhysicalNames/,/^\$EndPhysicalNames/{/every curve of the geometry/d;/^[0-9] /p;}' > "$folder/names"
test -s "$folder/names" || no "no physical groups: bodies and boundaries have no names"
# a name with = would be an assignment to awk
case $case_ in /*) path=$case_ ;; *) path=./$case_ ;; esac
CASE=$case_ SPACE=$space awk -f "${0%/*}/../case/case-file.awk" "$folder/names" "$path" > "$folder/case" 2> "$folder/log"
code=$?
test $code -ne 1 || no "$(tail -n 1 "$folder/case")" 3
test $code -eq 0 || no "-case $case_: cannot be checked: $(head -n 1 "$folder/log")" 3
CASE=$folder/case SPACE=$space MESH=$folder/mesh.msh REGIONS=$folder/regions MIDDLES=$folder/middles CURVES=$folder/curves \
    STRAIGHT=$every awk -f "$meshes/msh.awk" -f "$meshes/parts.awk" < "$file" > "$folder/why" 2> /dev/null
code=$?
cat "$folder/regions" >> "$folder/case" 2> /dev/null
test $code -le 1 || no "cannot be checked: is awk there, and room in ${folder%/*}?"
test $code -eq 1 || test "$(tail -n 1 "$folder/mesh.msh")" = '$EndElements' || no "its larger copy cannot be written in ${folder%/*}"
exit $code
