# made.sh: when a run was made and by what: sh made.sh RUN VERSION
# Needs: RUN, the number of the run's process; VERSION, the file with the package's version.
# Gives: three lines on standard output: the date, UTC (SOURCE_DATE_EPOCH if that is a number of seconds); the package's version;
#        FreeFEM's as Debian's package has it, if FreeFem++ is that one: what it says itself may be another.
# Exit code: 0.
form=+%Y-%m-%dT%H:%M:%SZ
{ test -n "$SOURCE_DATE_EPOCH" && date -u -d "@$SOURCE_DATE_EPOCH" "$form" 2> /dev/null; } || date -u "$form"
read -r version < "$2"
echo "$version"
if test "/proc/$1/exe" -ef /usr/bin/FreeFem++ || test "/proc/$1/exe" -ef /usr/bin/FreeFem++-mpi; then
    sed -n '/^Package: freefem++$/,/^$/{s/^Version: //p;/^$/q;}' /var/lib/dpkg/status 2> /dev/null
fi
exit 0
