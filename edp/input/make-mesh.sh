# make-mesh.sh: a mesh made by gmsh, unless it is there already: sh make-mesh.sh RUN MESH GEO EXPECTED OPTIONS-OF-GMSH...
# Needs: RUN, the number of the run's process; GEO, the geometry, with all others in its folder; MESH, a file to be in a folder
#        that is made if it is missing, beside GEO; EXPECTED, how many elements, in words, for the line that says after five seconds
#        that gmsh is at work; AFTER, a variable: a file that gmsh reads after GEO, or nothing.
# Gives: MESH, whole and not older than any geometry, whoever else makes it meanwhile; in its $Comments "Gmsh" and gmsh's version; in a
#        folder with a file .shared also MESH.of, the geometries' checksum, for there they may be another copy's of the package.
# Exit codes: 0 done, 3 no gmsh, 4 no place to write, 5 gmsh failed, 6 no room, 130 interrupted.
# gmsh's own exit code means little: what it wrote is looked at, then moved into place.
. "${programs:-${0%/*}/..}/input/process.sh"
. "${programs:-${0%/*}/..}/input/watch-gmsh.sh"
run=$1
mesh=$2
geo=$3
expected=$4
shift 4
meshes=${geo%/*}
generated=${mesh%/*}

shared=
test ! -e "$generated/.shared" || shared=$(cat "$meshes"/*.geo | cksum)
newer=
for file in "$meshes"/*.geo; do test ! "$file" -nt "$mesh" || newer=$file; done
test -s "$mesh" && test -z "$newer" \
    && { test -z "$shared" || test "$(cat "$mesh.of" 2> /dev/null)" = "$shared"; } && exit 0
command -v gmsh > /dev/null || exit 3
place=$meshes
test ! -e "$generated" || place=$generated
work=$place/.making-$computer
for left in "$work"-*; do                   # of a run that was killed
    test ! -e "$left" || test -n "$(started "${left##*-}")" || rm -rf "$left"
done
work=$work-$run
gmsh=
trap 'test -z "$gmsh" || kill "$gmsh" 2> /dev/null; exit 130' HUP INT TERM
mkdir "$work" 2> /dev/null || exit 4
trap 'rm -rf "$work"' EXIT
# gmsh moves points by a part of the whole for its first triangles: on a fine curve it may leave one between three points of the curve
for part in "" 1e-11; do
    what="${geo##*/}${expected:+: about $expected elements expected}"
    test -z "$part" && test "$expected" != - || what=-
    watched "$work/log" "$what" "$@" ${part:+-setnumber Mesh.RandomFactor $part} -v 4 \
        "$geo" ${AFTER:+"$AFTER"} "${programs:-${0%/*}/..}/input/format.geo" -o "$work/gmsh.msh"
    awk 'sub(/.*worst gamma = /, "") { flat = $1 < 1e-8 } END { exit !flat }' "$work/log" || break
done
if grep -q '^2.2 0 8' "$work/gmsh.msh" 2> /dev/null && grep -q PhysicalNames "$work/gmsh.msh" && ! grep -q ^Error "$work/log" \
    && {
        head -n 3 "$work/gmsh.msh"
        sed -n '1s/.*\[\(Gmsh [^],]*\).*/$Comments\n\1\n$EndComments/p' "$work/log"
        tail -n +4 "$work/gmsh.msh"
    } > "$work/new.msh" 2> /dev/null \
    && tail -n 1 "$work/new.msh" | grep -q EndElements; then
    rm -f "$mesh.of"
    mkdir -p "$generated" 2> /dev/null && mv -f "$work/new.msh" "$mesh" 2> /dev/null
    code=$?
    test -z "$shared" || echo "$shared" > "$mesh.of"
    test $code = 0 || code=4
else
    code=5
    dd if=/dev/zero of="$work/room" bs=1024 count=1024 2> /dev/null || code=6
fi
exit $code
