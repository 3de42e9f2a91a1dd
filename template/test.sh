#!/bin/sh
# test.sh: is what you wrote right? sh test.sh; exit code 0: all holds
# Needs: the links to the package that make new has put beside it.
# Your law's functions fit each other; all methods come to one force; the forces balance; a finer mesh changes little.
cd "$(dirname "$0")" || exit 1
failed=0
run()
{
    FreeFem++ -nw -v 0 my-scene.edp -vtu 0 "$@" -out "results/test/$name" >"results/test/$name.txt" && return
    echo "OFF $name: the run ends with code $?:"
    tail -n 3 "results/test/$name.txt"
    exit 1
}
value() { sed -n "s/^  \"$2\": \([^,]*\),*$/\1/p" "results/test/$1/summary.json"; }
near() # words, one, other, share
{
    if LC_ALL=C awk "BEGIN { away = $2 / ($3) - 1; exit !(away <= $4 && away >= -$4) }"; then echo "ok  $1: $2, $3"
    else echo "OFF $1: $2, $3"; failed=1; fi
}
mkdir -p results/test
.venv/bin/python -m postprocess check_lab 4 mylaw.idp || exit 1
for name in xnewton newton mymethod; do run -h 0.5 -method $name -tol 1e-8; done
name=finer; run -h 0.25 -method xnewton
near 'newton finds the force of xnewton' "$(value newton force)" "$(value xnewton force)" 1e-6
near 'so does your method' "$(value mymethod force)" "$(value xnewton force)" 1e-6
near 'the support carries the force' "$(value xnewton reactionY)" "$(value xnewton force)" 1e-8
near 'a finer mesh changes little' "$(value finer force)" "$(value xnewton force)" 0.02
exit $failed
