# process.sh: is a run still going? Read by the package's other shell programs: . .../process.sh
# Needs: Linux's /proc, or ps.
# Gives: started PID: when that process began, in the system's own words; nothing if it has ended. A later process with the same
#        number, after a reboot for one, began at another time. One that has ended but was not waited for has ended.
LC_ALL=C
export LC_ALL

started()
{
    if test -e /proc/self/stat; then sed -n 's/.*) [^ZX] //p' "/proc/$1/stat" 2> /dev/null | cut -d ' ' -f 19
    else ps -o state= -o lstart= -p "$1" 2> /dev/null | sed -n 's/^ *[^ZX ][^ ]* *//p'
    fi
}
