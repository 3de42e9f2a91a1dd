# larger.sh: a copy of a mesh file in millionths of its unit: sh larger.sh RUN FILE COPY
# Needs: RUN, the number of the run's process; FILE, gmsh's version 2 text format; COPY, a name freefem-mesh-*.msh in a folder for
#        passing files; awk, meshes/scale.awk.
# Gives: COPY, whole, RUN in its last section: copies of runs that were killed are removed by that.
# Exit codes: 0 done, 4 the copy cannot be written.
. "${0%/*}/../case/process.sh"
run=$1
file=$2
copy=$3
for left in "${copy%/*}"/freefem-mesh-*; do
    case $left in
    *.msh) whose=$(tail -n 2 "$left" 2> /dev/null | sed 1q);;
    *) whose=${left##*.};;
    esac
    case $whose in '' | *[!0-9]*) ;; *) test -n "$(started "$whose")" || rm -f "$left";; esac
done 2> /dev/null
trap 'rm -f "$copy.$run" "$copy"; exit 130' HUP INT TERM
{
    { awk -f "${0%/*}/../../meshes/scale.awk" "$file" && printf '$Run\n%s\n$EndRun\n' "$run"; } > "$copy.$run"
} 2> /dev/null
if test "$(tail -n 1 "$copy.$run" 2> /dev/null)" = '$EndRun' && mv -f "$copy.$run" "$copy" 2> /dev/null; then
    # a run that is killed while it reads leaves no copy
    while sleep 1 && test -e "$copy"; do
        test -n "$(started "$run")" || rm -f "$copy"
    done > /dev/null 2>&1 &
    exit 0
fi
rm -f "$copy.$run"
exit 4
