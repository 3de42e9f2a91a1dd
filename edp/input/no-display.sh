# no-display.sh: keeps a run without a display alive: sh no-display.sh PROCESS
# Needs: PROCESS: the number of the run's process. Without /proc nothing is done.
# Gives: a process that reads the run's pipe to FreeFEM's window program in that program's place, until the run ends. Without a display the
#        window program ends at once, and FreeFEM's last word to it would end the run with code 141 and without its last lines.
# The pipe is one from 3 to 9 that neither the run's parent has nor the run's own input and output are.
parent=$(sed -n 's/^PPid:[^0-9]*//p' "/proc/$1/status" 2> /dev/null)
test -r "/proc/$parent/fd" || exit 0
for pipe in /proc/"$1"/fd/[3-9]; do
    test -p "$pipe" || continue
    for other in /proc/"$parent"/fd/* /proc/"$1"/fd/[0-2]; do ! test "$pipe" -ef "$other" || continue 2; done
    eval "cat < $pipe > /dev/null 2>&1 ${pipe##*/}>&- &"
done
