# watch-gmsh.sh: gmsh, watched while it works. Read by the package's other shell programs, after input/process.sh: . .../watch-gmsh.sh
# Needs: run, the number of the run's process.
# Gives: watched LOG WHAT OPTIONS-OF-GMSH...: gmsh's messages in LOG, when it has ended. It is ended by its first error, after which it
#        may go on for ever, and by the end of its run, however that ends: then the shell that asked ends with code 130 as well. After
#        five seconds, and after each doubling from a minute on, a line says that gmsh is at work on WHAT; - stands for no lines.
# gmsh: the number of its process while it works, for a trap.
watched()
{
    log=$1
    what=$2
    shift 2
    gmsh "$@" > "$log" 2>&1 < /dev/null &
    gmsh=$!
    (
        exec 3>&1 > /dev/null 2>&1
        seconds=0
        next=60
        while sleep 1 3>&-; do
            test -n "$(started "$run")" && ! grep -q ^Error "$log" || break
            seconds=$((seconds + 1))
            test "$what" != - || continue
            test $seconds != 5 || echo "gmsh meshes $what ..." >&3
            test $seconds != $next || { echo "gmsh has been at work on ${what%%:*} for $next s; Ctrl-C ends the run" >&3; next=$((2 * next)); }
        done
        kill "$gmsh"
    ) &
    watch=$!
    wait "$gmsh" 2> /dev/null
    kill "$watch" 2> /dev/null
    gmsh=
    test -n "$(started "$run")" || exit 130
}
