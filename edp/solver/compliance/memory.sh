# memory.sh: the bytes that a process may still take: sh memory.sh PROCESS [ROOT]
# Gives: two numbers: the memory that the machine and the process's control groups leave, the addresses that its limit leaves;
#        1e300 for what the system does not say, or does not limit. ROOT: a folder in place of /, for tests.
# Files that were read stay in memory as long as nobody else wants it: a group's use of that kind counts as free. A group's limits are
# those of the groups above it too, up to the root, which is a container's own. Both versions of control groups are read.

# behind FILE WORD: the number behind a word
behind()
{
    while read -r name number _; do
        test "$name" != "$2" || echo "$number"
    done 2> /dev/null < "$1"
}

most=9000000000000000000                 # above a thousandth of it there is no limit
free=$most
take()
{
    test "$1" -ge "$free" || free=$1
}

# group FOLDER LIMIT USED CACHE: takes what the group of a folder leaves; the names are those of its files
group()
{
    limit=
    read -r limit 2> /dev/null < "$1/$2" || return 0
    case $limit in '' | *[!0-9]*) return 0;; esac
    test "${#limit}" -lt 19 || return 0
    used=0
    read -r used 2> /dev/null < "$1/$3"
    cache=$(behind "$1/memory.stat" "$4")
    cache=${cache:-$limit}
    test "$cache" -le "$limit" || cache=$limit
    take $((limit - used + cache))
}

machine=$(behind "$2/proc/meminfo" MemAvailable:)
test -z "$machine" || take $((machine * 1024))
while IFS=: read -r number kinds path; do
    case $number:$kinds in
    *:memory) set -- "$1" "$2" /memory memory.limit_in_bytes memory.usage_in_bytes total_inactive_file;;
    0:) set -- "$1" "$2" '' memory.max memory.current inactive_file;;
    *) continue;;
    esac
    path=${path%/}
    while group "$2/sys/fs/cgroup$3$path" "$4" "$5" "$6"; test -n "$path"; do path=${path%/*}; done
done 2> /dev/null < "$2/proc/self/cgroup"
test "$free" -lt "$most" || free=1e300

addresses=1e300
while read -r _ first second soft _; do
    case $first:$second:$soft in
    address:space:*[!0-9]*) ;;
    address:space:*)
        size=$(sed 's/.*) //' "$2/proc/$1/stat" | cut -d ' ' -f 21)
        addresses=$((soft - size));;
    esac
done 2> /dev/null < "$2/proc/self/limits"
echo "$free $addresses"
