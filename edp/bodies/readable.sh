# readable.sh: a mesh file of the user's, checked and made readable for FreeFEM: sh readable.sh RUN FILE FOLDER CASE SPACE AS SETS [SURFACE]
# Needs: RUN, the number of the run's process; awk; gmsh for a geometry (.geo, .step, .stp, .iges, .igs, .brep), and for what is not
#        version 2 text; CASE, a case file, or none: only FOLDER/faces is wanted; SPACE, 1 for bodies in space, 0 for the
#        plane; AS: solve, check: FOLDER/faces is wanted, again: FILE is a mesh that has the case file's groups; SETS, options of
#        gmsh that set numbers of a .geo file; SURFACE: gmsh's mesh of the same surfaces, of second order; of a geometry in space
#        it is made here.
# Gives: FOLDER/mesh.msh, see meshes/parts.awk, and FOLDER/case, see case/case-file.awk, with the regions of meshes/parts.awk
#        behind it, and FOLDER/middles, FOLDER/curves, in space FOLDER/rises; FOLDER/told, a line each: gmsh's version, if it meshed
#        FILE; the file that gmsh read after the geometry; what makes smaller elements, in words; bodies that are left out; FOLDER/faces:
#        the geometry's faces with their numbers (meshes/pick.awk). FOLDER is new, and goes when the run has ended, however it ended: the run takes it away itself if it can.
# Exit codes: 0 done, 1 refused: FOLDER/why has one line, 2 FOLDER cannot be made, 3 the case file is refused, 4 only FOLDER/faces,
#        5 no room for FOLDER.
. "${0%/*}/../case/process.sh"
. "${0%/*}/watched.sh"
run=$1
file=$2
case $file in -*) file=./$file ;; esac
folder=$3
case $folder in /*) ;; *) folder=./$folder ;; esac
case_=$4
space=$5
as=$6
SETS=${7-}
surface=${8-}
flat="-2 -order 2 -setnumber everything_ 1"
meshes=${0%/*}/../../meshes
gmsh=
trap 'test -z "$gmsh" || kill "$gmsh" 2> /dev/null; exit 130' HUP INT TERM
(umask 077 && mkdir "$folder") 2> /dev/null || { test -d "${folder%/*}" && test -w "${folder%/*}" && exit 5; exit 2; }
(
    trap '' HUP INT TERM
    while test -n "$(started "$run")"; do
        test -e "$folder" || exit 0      # gone already; what has its name now is another run's
        sleep 1
    done
    rm -rf "$folder"
) < /dev/null > /dev/null 2>&1 &

# a full disk says nothing, or anything: what fails where there is no room for a megabyte has failed for that
room() {
    dd if=/dev/zero of="$folder/room" bs=1024 count="$1" 2> /dev/null || exit 5
    rm -f "$folder/room"
}
no() {
    room 1024
    printf '%s\n' "$1" > "$folder/why"
    exit "${2:-1}"
}

noGmsh="; allowed: gmsh there (Debian: apt install gmsh), or a mesh in gmsh's version 2 text format"
plane="the mesh is plane, it has no volumes: use edp/parts.edp"
test -d "$file" && no "a folder, no mesh"
test -f "$file" || no "no file: a pipe or a device"
test "$case_" = none || test -f "$case_" || no "-case $case_: a folder, a pipe or a device; allowed: a case file" 3
test -r "$file" || no "may not be read"
kind=$(printf %s "${file##*.}" | tr A-Z a-z)
# what was read of a geometry is kept beside its mesh, with the checksums of all that it comes of: the next run takes it
memory=
generated=$(sh "${0%/*}/../case/cache.sh" "$run" "${0%/*}/../..")
generated=${generated:+$generated/meshes}
generated=${generated:-$meshes/generated}
case $as$kind in solvegeo | solvestep | solvestp | solvebrep | solveiges | solveigs)
    sources=$(sh "${0%/*}/reads.sh" "$run" "$file" "$case_")
    if test "$(printf '%s\n' "$sources" | wc -l)" = 2 && mkdir -p "$generated" 2> /dev/null; then
        memory=$generated/own-$(printf '%s\n' "$sources" "$SETS" "$space" | cksum | tr ' ' -).tar
        from=$(cksum < "$file"; cksum < "$case_"; cat "${0%/*}"/*.sh "${0%/*}"/*.geo "${0%/*}"/../case/*.awk "$meshes"/*.awk | cksum)
        if tar -xof "$memory" -C "$folder" 2> /dev/null && test "$from" = "$(cat "$folder/from" 2> /dev/null)"; then
            after=$(sed -n 2p "$folder/told")
            if test -z "$after" || test -f "$after"; then exit 0; fi
        fi
        rm -f "$folder"/*
    fi ;;
esac
how=
order=
for name in gmsh left touch; do : > "$folder/$name"; done
after=
finer="mesh with smaller elements"
# in the plane the elements on all curves, with their numbers: gmsh would leave out those that have no name; and their middles
every=${0%/*}/every-curve.geo
format=${0%/*}/format.geo
# a name with = would be an assignment to awk
case $case_ in none) path=/dev/null ;; /*) path=$case_ ;; *) path=./$case_ ;; esac
import=
overlap=
again=
test "$as" != again || again=1
cad=0
case $kind in
    step | stp | brep | iges | igs) cad=1 ;;
    inp)
        overlap=1
        if test "$case_" = none; then
            LISTED=1 SPACE=$space awk -f "$meshes/inp.awk" "$path" "$file" > "$folder/table" 2> "$folder/log" || no "$(tail -n 1 "$folder/table")"
            room 1
            exit 4
        fi
        SPACE=$space awk -f "$meshes/inp.awk" "$path" "$file" > "$folder/inp.msh" 2> "$folder/log" || no "$(tail -n 1 "$folder/inp.msh")"
        file=$folder/inp.msh ;;
    geo)
        finer=$(sed -n 's/^ *DefineConstant *\[ *\([A-Za-z_0-9]*\) *=.*size of the.*/-set \1/p' "$file" | head -n 1)
        finer="lower sizes (${finer:+$finer, or }size contact in the case file)" ;;
esac
test $cad = 0 || finer="lower sizes (size contact, size NAME in the case file)"
# what sets a number must name one
if test -n "$SETS" && test -z "$again"; then
    test "$kind" = geo || no "-set: it has no numbers to be set; allowed: with a .geo file"
    # several names in one DefineConstant, over lines, with {value, Name "..."}
    constants=$(awk '
        { gsub(/"[^"]*"/, ""); sub(/\/\/.*/, ""); text = text " " $0 }
        END {
            while (gsub(/\{[^{}]*\}/, "", text)) ;
            while (match(text, /DefineConstant[ \t]*\[[^]]*\]/)) {
                n = split(substr(text, RSTART, RLENGTH - 1), part, /[[,]/)
                text = substr(text, RSTART + RLENGTH)
                for (k = 2; k <= n; k++) {
                    sub(/=.*/, "", part[k])
                    gsub(/[ \t\r]/, "", part[k])
                    if (part[k] != "") printf "%s", (many++ ? " " : "") part[k]
                }
            }
        }' "$file")
    next=
    for word in $SETS; do
        test "$next" != name || case " $constants " in *" $word "*) ;; *)
            grep -qiE 'merge|include' "$file" || no "-set $word: no number of it that can be set; allowed: ${constants:-none}" ;;
        esac
        next=
        test "$word" != -setnumber || next=name
    done
fi
# a terminal obeys what is printed
named() { ! grep -q '[[:cntrl:]]' "$folder/names" || no "a control character in a group's name; allowed: other names"; }
# gmsh's own way to name what it cannot read
complaint() { sed -n 's/^Error *: *//p' "$1" | head -n 1; }
# an error of gmsh's: in reading the file, or, once it has begun a mesh, in meshing it
stopped() {
    grep -q '^Error' "$1" || return 0
    sed '/^Error/q' "$1" | grep -q '^Info *: Meshing [123]D' || {
        cure="a file that gmsh opens without this error"
        test "$kind" != geo || cure="a geometry without this error. Correct it there; \`gmsh -parse_and_exit $file\` repeats what gmsh says"
        no "gmsh cannot read it: $(complaint "$1"); allowed: $cure"
    }
    no "gmsh reads it, but cannot mesh it: $(complaint "$1"); allowed: another size of elements, another algorithm of gmsh's (Mesh.Algorithm), or closed surfaces, as a torus, split in the geometry"
}
reader=${0%/*}/../case/case
readCase() {
    CASE=$case_ SPACE=$space SETS_OVERLAP=$overlap PICKS=${1-} AGAIN=$again BODIES=${bodies-} \
        awk -f "$reader-words.awk" -f "$reader-grammar.awk" -f "$reader-groups.awk" -f "$reader-pushed.awk" -f "$reader-worn.awk" -f "$reader-heat.awk" -f "$reader-cad.awk" -f "$reader-file.awk" "$folder/names" "$path" > "$folder/case" 2> "$folder/log"
    code=$?
    test $code -ne 1 || no "$(tail -n 1 "$folder/case")" 3
    test $code -eq 0 || no "-case $case_: cannot be checked: $(head -n 1 "$folder/log")" 3
}

# what a case file picks of a geometry, in a file that gmsh reads after it
picked=
if test -z "$again" && { test $cad = 1 || { test "$as" = check && command -v gmsh > /dev/null; } \
    || grep -qE "^[[:blank:]]*(group|size|join$(test "$kind" != geo || echo "|cut"))[[:blank:]]" "$path" 2> /dev/null; }; then
    picked=$folder/picked.geo
    : > "$folder/apart.geo"
    closer=$folder/closer.geo
    : > "$closer"
    asks=$closer
    way="-$((1 + space)) -order 2"        # in the plane curves are enough
    meshed=0
    # of gmsh's own curves its curvature ends in an endless loop (4.8)
    case $kind in geo) ;; *) if test $cad = 1; then way="$way -setnumber Mesh.MeshSizeFromCurvature 24"; else way=-save meshed=1; fi ;; esac
    unrolled=$folder/unrolled.geo
    # shapes that this format lacks are left out with an error, which says nothing about the geometry
    test $meshed = 1 && : > "$unrolled" || cat > "$unrolled" << 'EOF'
General.Verbosity = 0;
Mesh.Format = 10;
Save "whole.geo_unrolled";
General.Verbosity = 4;
Mesh.Format = 1;
Mesh.MshFileVersion = 4.1;
Mesh.SaveAll = 1;
Mesh.Binary = 0;
EOF
    anew=$folder/anew.geo
    : > "$anew"
    outline() {
        rm -f "$folder/outline.msh"
        watched "$folder/log" "an outline of ${file##*/}" $way -v 4 -format msh41 -setnumber Mesh.SaveAll 1 $SETS $import \
            "$file" "$folder/apart.geo" "$unrolled" "${0%/*}/outline.geo" "$closer" "$anew" -o "$folder/outline.msh"
        # a geometry that meshes itself while it is read
        if test $meshed = 0 && ! test -s "$anew" && sed "/^Info *: Reading .*unrolled.geo'/q" "$folder/log" | grep -q '^Info *: Meshing [123]D'; then
            echo 'Mesh 1;' > "$anew"
            outline
            return
        fi
        ! test -s "$folder/apart.geo" || ! grep -q '^Error' "$folder/log" || no "-case $case_: bodies of it cannot be cut, joined or taken apart: $(complaint "$folder/log"); allowed: a STEP or BREP file, or a .geo file with SetFactory(\"OpenCASCADE\")" 3
        stopped "$folder/log"
        grep '^piece ' "$folder/log" > "$folder/pieces"
        test -s "$folder/outline.msh" || no "gmsh makes no mesh of it"
        test "$space" = 0 || test $cad = 1 || awk '/^\$Entities/ { getline; exit !($4 > 0) }' "$folder/outline.msh" || no "$plane"
        sed -n '/^\$PhysicalNames/,/^\$EndPhysicalNames/{/^[0-9] /p;}' "$folder/outline.msh" > "$folder/names"
        named
    }
    table=
    test "$as" != check || table=$folder/table
    pick() {
        PICKS=${1-} SPACE=$space CASE=$case_ CAD=$cad MESHED=$meshed APART=$folder/apart.geo KEPT=$folder/kept PARENTS=$folder/pieces \
            LEFT=$folder/left FACES=$folder/faces TABLE=$table TOUCH=$folder/touch CLOSER=$asks WHOLE=$folder/whole.geo_unrolled \
            awk -f "$meshes/pick.awk" -f "$meshes/near.awk" -f "$meshes/cad.awk" -f "$meshes/kinds.awk" -f "$meshes/touch.awk" < "$folder/outline.msh" > "$picked" 2> "$folder/log"
    }
    command -v gmsh > /dev/null || no "gmsh, which reads it, is not on the PATH$noGmsh"
    listBodies() {
        bodies=$(awk -v d=$((2 + space)) '/^\$/ { s = $1; row = 0; next }
            s == "$Entities" { if (++row == 1) { for (k = 1; k <= d; k++) from += $k; to = from + $(d + 1) }
                else if (row > from + 1 && row <= to + 1) all = all " " $1 } END { print substr(all, 2) }' "$folder/outline.msh")
    }
    outline
    bodies=
    if test $cad = 1; then
        listBodies
        if test -z "$bodies$import" && test "$space" = 1; then      # faces that nothing joins, as IGES has them
            import="-setnumber Geometry.OCCSewFaces 1 -setnumber Geometry.OCCMakeSolids 1"
            outline
            listBodies
        fi
        test -n "$bodies" || no "no $(test "$space" = 1 && echo solid || echo surface) in it"
    fi
    if test "$case_" = none; then
        pick || no "its faces cannot be listed"
        ! grep -q '1e+300' "$table" || no "gmsh reads no bodies with faces out of it"
        room 1
        exit 4
    fi
    : > "$folder/picks"
    readCase "$folder/picks"
    pick "$folder/picks"
    code=$?
    for turn in 1 2; do
        test $code = 4 || break
        outline
        pick "$folder/picks"
        code=$?
    done
    for turn in 1 2 3 4 5 6; do
        test $code = 5 || break
        test $turn != 6 || asks=
        outline
        pick "$folder/picks"
        code=$?
    done
    test $code != 4 || no "-case $case_: bodies that share a face with two others cannot be taken apart; allowed: apart in the geometry" 3
    test $code != 1 || no "$(tail -n 1 "$picked")" 3
    test $code = 0 || no "-case $case_: its groups cannot be picked: $(head -n 1 "$folder/log")" 3
    { cat "$folder/apart.geo" "$picked"; ! grep -qE '^(size|cut|join)' "$folder/picks" || cat "$anew"; test "$space" = 1 || cat "$every"; } > "$folder/after.geo"
    picked=$folder/after.geo
    # what picks nothing is taken as it is
    test $cad = 1 || grep -qE '^(group|size|cut|join)' "$folder/picks" || picked=
fi

case $kind in geo | step | stp | brep | iges | igs)
    how=-$((2 + space))
    test "$space" = 1 || order="-order 2"
    # kept as the package's own meshes are, if it stands for itself: what it includes may change unseen
    after=$picked
    test -n "$after" || test "$space" = 1 || after=$every
    if test -n "$picked" && mkdir -p "$generated" 2> /dev/null; then
        after=$generated/own-$(cksum < "$picked" | tr ' ' -).geo
        test -s "$after" || { cp "$picked" "$after.$run" && mv "$after.$run" "$after"; } 2> /dev/null || after=$picked
    fi
    kept=$generated/own-$(cat "$file" ${after:+"$after"} | cksum | tr ' ' -)$(echo "$SETS" | cksum | tr ' ' -)$how.msh
    if test "$(sh "${0%/*}/reads.sh" "$run" "$file" | wc -l)" = 1 && mkdir -p "$generated" 2> /dev/null \
        && AFTER=$after sh "${0%/*}/mesh.sh" "$run" "$kept" "$file" "" "$how" $order -format msh22 $SETS $import; then
        test "$space" = 0 || ! AFTER=$after sh "${0%/*}/mesh.sh" "$run" "${kept%.msh}-surface.msh" "$file" - $flat -format msh22 $SETS $import \
            || surface=${kept%.msh}-surface.msh
        file=$kept
        sed -n '/^\$Comments/{n;s/^Gmsh //p;q;}' "$kept" > "$folder/gmsh"
        how=
    fi ;;
*)  after=$picked
    test -z "$picked" || how=-save ;;
esac
# the second line of gmsh's format: version, 0 for text or 1 for binary, size of a real
case $(head -c 200 "$file" | tr -d '\r\000' | sed -n '1{/^\$MeshFormat/!q};2{p;q}') in 4* | 2*" 1 "*) how=-save ;; esac
# formats of others, which gmsh knows by their names
case $kind in msh | inp | geo) ;; *) test "$file" != "$2" || how=${how:--save} ;; esac
if test -n "$how"; then
    command -v gmsh > /dev/null || no "gmsh, which would read it, is not on the PATH$noGmsh"
    watched "$folder/log" "${file##*/}" "$how" $order -v 4 -format msh22 $SETS $import "$file" ${after:+"$after"} "$format" -o "$folder/converted.msh"
    stopped "$folder/log"
    test -s "$folder/converted.msh" || no "gmsh makes no mesh of it"
    test "$how" != -3 || watched "$folder/log2" - $flat -v 1 -format msh22 $SETS $import "$file" ${after:+"$after"} "$format" -o "$folder/surface.msh"
    test ! -s "$folder/surface.msh" || surface=$folder/surface.msh
    test "$how" = -save || sed -n '1s/.*\[Gmsh \([^],]*\).*/\1/p' "$folder/log" > "$folder/gmsh"
    file=$folder/converted.msh
fi
# elements with a volume, of gmsh's types
solid() { tr -d '\r' < "$1" | awk '/^\$Elements/ { on = 1 } on && NF > 5 && $2 ~ /^([4-7]|1[1-4]|1[7-9]|29|30|31)$/ { found = 1; exit } END { exit !found }'; }
test "$space" = 0 || solid "$file" || no "$plane"
tr -d '\r' < "$file" | sed -n '/^\$PhysicalNames/,/^\$EndPhysicalNames/{/every curve of the geometry/d;/^[0-9] /p;}' > "$folder/names"
test -s "$folder/names" || no "no physical groups: bodies and boundaries have no names"
named
test -n "$picked" || readCase
straight=
test "$space" = 1 || case $kind in geo | step | stp | brep | iges | igs) straight=1 ;; esac
{ cat "$folder/gmsh"; test -s "$folder/gmsh" || echo; echo "$after"; echo "$finer"; cat "$folder/left"; test -s "$folder/left" || echo; wc -l < "$folder/touch"; cat "$folder/touch"; } > "$folder/told"
check() {
    CASE=$folder/case SPACE=$space MESH=$folder/mesh.msh REGIONS=$folder/regions MIDDLES=$folder/middles CURVES=$folder/curves \
        RISES=$folder/rises SURFACE=$surface NOTES=$folder/notes \
        STRAIGHT=$straight awk -f "$meshes/msh.awk" -f "$meshes/parts.awk" -f "$meshes/cuts.awk" -f "$meshes/same.awk" -f "$meshes/planes.awk" < "$file" > "$folder/why" 2> /dev/null
    code=$?
}
check
if grep -q "of gmsh's type [3567]: " "$folder/why"; then
    awk -f "$meshes/cut.awk" "$file" "$file" > "$folder/cut.msh" 2> "$folder/log"
    file=$folder/cut.msh
    check
fi
cat "$folder/regions" >> "$folder/case" 2> /dev/null
test $code = 0 || room 1024
room 1
test $code -le 1 || no "cannot be checked: is awk there, and room in ${folder%/*}?"
test $code -eq 1 || test "$(tail -n 1 "$folder/mesh.msh")" = '$EndElements' || no "its larger copy cannot be written in ${folder%/*}"
case $after in "$folder"/*) memory= ;; esac
if test $code = 0 && test -n "$memory"; then
    printf '%s\n' "$from" > "$folder/from"
    { tar -cf "$memory.$run" -C "$folder" . && mv -f "$memory.$run" "$memory" || rm -f "$memory.$run"; } 2> /dev/null
fi
exit $code
