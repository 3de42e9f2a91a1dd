# on-request.sh: starts a script with what a run needs beside: . on-request.sh, with SCRIPT FreeFem++ OPTIONS /dev/fd/3 FLAGS as arguments
# Needs: CONTACT_REQUEST: macros, one for each thing (input/output.idp); SCRIPT: a path from the present folder, or a whole one; space: 1
#        in space, or nothing.
# Gives: the run, in this process, of these macros and then the script; its name in CONTACT_SCRIPT, for input/flags.idp. In the plane it
#        has one thread of OpenBLAS, unless the user says how many: others would wait, by spinning.
test -n "$space$OPENBLAS_NUM_THREADS$GOTO_NUM_THREADS$OMP_NUM_THREADS" || export OPENBLAS_NUM_THREADS=1
case " $CONTACT_REQUEST ${CONTACT_ROWS:+solved}" in
*" rowsOnRequest "*solved) ;;
*" rowsOnRequest "*) export CONTACT_REQUEST && exec $with sh "${programs:-$edp}/solver/rows/rows.sh" "$@" ;;
esac
export CONTACT_SCRIPT="$1"
shift
exec 3<<END
$(printf 'macro %s() 1 //\n' $CONTACT_REQUEST)
$(test -z "$CONTACT_ROWS" || echo 'include "input/refused-rows.idp"')
include "$CONTACT_SCRIPT"
${CONTACT_ROWS:+rowLoopEnd}
END
export CONTACT_REQUESTED=" $CONTACT_REQUEST "
unset CONTACT_REQUEST
exec "$@"
