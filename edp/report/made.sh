# made.sh: when a run was made and by what: sh made.sh RUN VERSION
# Needs: RUN, the number of the run's process; VERSION, the file with the package's version.
# Gives: three lines on standard output: the date, UTC (SOURCE_DATE_EPOCH if that is a number of seconds); the package's version;
#        FreeFEM's as Debian's package has it, if FreeFem++ is that one: what it says itself may be another.
# Exit code: 0.
form=+%Y-%m-%dT%H:%M:%SZ
read -r version < "$2"
status=/dev/null
if test "/proc/$1/exe" -ef /usr/bin/FreeFem++ || test "/proc/$1/exe" -ef /usr/bin/FreeFem++-mpi; then status=/var/lib/dpkg/status; fi
# one program where awk knows the time; else three
test -z "$SOURCE_DATE_EPOCH" && awk -v form="${form#+}" -v version="$version" '
    BEGIN { print strftime(form, systime(), 1) "\n" version }
    /^Package: freefem\+\+$/ { own = 1 }
    own && sub(/^Version: /, "") { print; exit }' "$status" 2> /dev/null && exit
{ test -n "$SOURCE_DATE_EPOCH" && date -u -d "@$SOURCE_DATE_EPOCH" "$form" 2> /dev/null; } || date -u "$form"
echo "$version"
sed -n '/^Package: freefem++$/,/^$/{s/^Version: //p;/^$/q;}' "$status" 2> /dev/null
exit 0
