# process.sh: is a run still going? Read by the package's other shell programs: . .../process.sh
# Needs: Linux's /proc, or ps.
# Gives: started PID: when that process began, in the system's own words; nothing if it has ended. A later process with the same
#        number, after a reboot for one, began at another time. One that has ended but was not waited for has ended.
#        computer: this one's name.
# What a run calls at every start is done by the shell itself: another program costs a millisecond.
LC_ALL=C
export LC_ALL

started()
{
    if test -e /proc/self/stat; then
        while read -r line; do
            case $line in
            *") "[ZX]*) ;;
            *") "*)
                set -- ${line##*) }          # behind the program's name, which may have blanks: the state is the first of them
                shift 19
                echo "$1";;
            esac
        done 2> /dev/null < "/proc/$1/stat"
    else ps -o state= -o lstart= -p "$1" 2> /dev/null | sed -n 's/^ *[^ZX ][^ ]* *//p'
    fi
}

read -r computer 2> /dev/null < /proc/sys/kernel/hostname || computer=$(uname -n)
