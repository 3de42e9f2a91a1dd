# read-case.sh: a mesh or geometry and a case, read into a folder of the run: sh read-case.sh RUN FILE FOLDER CASE SPACE AS SETS OPTIONS UNLIKE [SURFACE [ROWS]]
# Needs: RUN, the number of the run's process; FILE; CASE, a case file, or none: only what FILE has is wanted; SPACE, 1 for bodies in
#        space, 0 for the plane; AS: solve, check: a picture of the geometry is wanted, again: FILE is a mesh that has the case's groups;
#        SETS: -setnumber NAME VALUE as often as one likes; OPTIONS that the script has read; UNLIKE: flags that ties exclude; SURFACE:
#        gmsh's mesh of the same surfaces, of second order; ROWS: a table of problems.
# Gives: FOLDER with the files of input/reader/problem.py. FOLDER is new, and goes when the run has ended, however it ended: the run takes
#        it away itself if it can. gmsh ends with the run too.
# Exit codes: 0 done, 1 refused: FOLDER/why has one line, 2 FOLDER cannot be made, 3 the case file is refused, 4 only what FILE has, 5 no
#        room for FOLDER, 12 no Python that reads cases, which standard output says.
. "${0%/*}/process.sh"
run=$1
folder=$3
case $folder in /*) ;; *) folder=./$folder ;; esac
case $2 in /*) file=$2 ;; *) file=./$2 ;; esac
(umask 077 && mkdir "$folder") 2> /dev/null || { test -d "${folder%/*}" && test -w "${folder%/*}" && exit 5; exit 2; }
(
    trap '' HUP INT TERM
    while test -n "$(started "$run")"; do
        test -e "$folder" || exit 0      # gone already; what has its name now is another run's
        sleep 1
    done
    rm -rf "$folder"
) < /dev/null > /dev/null 2>&1 &
exec sh "${0%/*}/read.sh" "$run" problem "file=$file" "case=$4" "folder=$folder" "space=$5" "as=${6-solve}" "sets=${7-}" \
    "options=${8-}" "unlike=${9-}" "surface=${10-}" "rows=${11-}"
