# faces.sh: the faces of a geometry with their numbers, for a picture: sh faces.sh RUN FILE FOLDER SPACE SETS PICTURE
# Needs: RUN, FILE, SPACE, SETS: as input/read-case.sh; FOLDER, of results; PICTURE, the command that draws. Or FILE, a folder of
#        input/read-case.sh's, FOLDER, where a run's files are before they are published, and the word keep.
# Gives: FOLDER/check-faces.csv, check-bodies.csv with the names of bodies, said on standard output; with keep that file is told to input/folder.sh, and FILE removed.
# Exit codes: 0 done, 10 refused in one line, 30 no room, as a run's.
keep() {
    test ! -s "$1/table" || cat "$1/table"
    for kind in faces bodies; do
        test ! -s "$1/$kind" || { cp "$1/$kind" "$2/check-$kind.csv" && echo "check-$kind.csv $(wc -c < "$1/$kind")" >> "$2/.ends"; }
    done
    rm -rf "$1"
}
here=${0%/*}
if test "$4" = keep; then
    keep "$2" "$3"
    exit
fi
read=${TMPDIR:-/tmp}/faces-$1-$(date +%s)
sh "$here/read-case.sh" "$1" "$2" "$read" none "$4" check "$5"
code=$?
if test $code = 5; then
    echo "out of disk: ${read%/*} is full, or ulimit -f too small; allowed: room there, or another folder, named by the variable TMPDIR"
    rm -rf "$read"
    exit 30
fi
test $code != 12 || exit 10
if test $code != 4; then
    echo "-mesh $2: $(cat "$read/why" 2> /dev/null || echo "cannot be read")$(grep -q '; allowed: ' "$read/why" 2> /dev/null \
        || echo "; allowed: a geometry (.geo, .step, .iges, .brep), or a mesh of gmsh's with numbers of faces")"
    rm -rf "$read"
    exit 10
fi
if test ! -s "$read/faces"; then
    cat "$read/table"
    rm -rf "$read"
    echo "checked: the mesh alone; no case file was given"
    exit
fi
if ! sh "$here/folder.sh" "$1" open "$3"; then
    echo "-out ${3%/check}: not writable, or in use; allowed: a folder that can be written"
    rm -rf "$read"
    exit 10
fi
keep "$read" "$3/.run"
sh "$here/folder.sh" "$1" publish "$3" || exit 30
echo "checked: the geometry alone; no case file was given"
echo "  plot      $6"
