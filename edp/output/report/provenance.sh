# provenance.sh: when a run was made and by what: sh provenance.sh RUN VERSION
# Needs: RUN, the number of the run's process; VERSION, the file with the package's version.
# Gives: four lines on standard output: the date, UTC (SOURCE_DATE_EPOCH if that is a number of seconds); the package's version;
#        hundredths of seconds since the run began, nothing without /proc; FreeFEM's version as
#        Debian's package has it, if FreeFem++ is that one: what it says itself may be another.
# Exit code: 0.
form=+%Y-%m-%dT%H:%M:%SZ
read -r version < "$2"
status=/dev/null
if test "/proc/$1/exe" -ef /usr/bin/FreeFem++ || test "/proc/$1/exe" -ef /usr/bin/FreeFem++-mpi; then status=/var/lib/dpkg/status; fi
. "$programs/input/process.sh"

# since the process $1 began, or its parent, if that is the run which has asked for further modules
since()
{
    read -r line < "/proc/$1/stat" && set -- "$1" ${line##*) }       # then $3 is the parent
    test ! "/proc/$3/exe" -ef "/proc/$1/exe" || set -- "$3"
    read -r now line < /proc/uptime && echo $((${now%.*}${now#*.} - $(started "$1")))
}
waited=$(since "$1" 2> /dev/null)

# one program where awk knows the time; else three
test -z "$SOURCE_DATE_EPOCH" && awk -v form="${form#+}" -v version="$version" -v waited="$waited" '
    BEGIN { print strftime(form, systime(), 1) "\n" version "\n" waited }
    /^Package: freefem\+\+$/ { own = 1 }
    own && sub(/^Version: /, "") { print; exit }' "$status" 2> /dev/null && exit
{ test -n "$SOURCE_DATE_EPOCH" && date -u -d "@$SOURCE_DATE_EPOCH" "$form" 2> /dev/null; } || date -u "$form"
echo "$version"
echo "$waited"
sed -n '/^Package: freefem++$/,/^$/{s/^Version: //p;/^$/q;}' "$status" 2> /dev/null
exit 0
