# folder.sh: a run's result folder: sh folder.sh RUN check|open|publish FOLDER [KEPT...]
# Needs: RUN, the number of the run's process; FOLDER, any name without control characters.
# Gives: check: can it be written? Tried out, and left as it was.
#        open: FOLDER is there and this run's alone, without the files of an earlier run, but for those named KEPT.
#        publish: the files in FOLDER/.run, if each was written to its end, go into FOLDER, summary.json last; if not, none. With
#        the word finite, null takes the place of what is no finite number in summary.json.
# Exit codes: 0 done, 1 files not whole, 3 a control character in the name, 4 cannot be made or written, 5 another run is using
#        it, 6 one on another computer has not finished there and cannot be looked after, 7 no room for even a line, 8 under a
#        name that a run would write stands what none has written, or a link, or the script's modules are not the package's
#        (input/own.sh): said in a line, nothing touched.
# FOLDER/.run holds what is being written, the list .ends of files and their lengths, the list .written of what a run has put into
# FOLDER, and the lock .lock-N. The lock with the highest N counts, until it says "done" or the process that it names has ended:
# nothing needs to take it away after a kill. The next run adds .lock-<N + 1>, which only one can make, and removes the older ones
# after that.
. "${programs:-${0%/*}/..}/input/process.sh"
run=$1
task=$2
folder=$3
shift 3
case $folder in *[[:cntrl:]]*) exit 3;; -*) folder=./$folder;; esac

# the number of the newest lock in a folder, in n
newest()
{
    n=0
    for lock in "$1"/.lock-*; do
        k=${lock##*/.lock-}
        case $k in '' | *[!0-9]*) ;; *) test "$k" -le "$n" || n=$k;; esac
    done
}

owner()
{
    echo "$1 $(started "$1") $computer"
}

# whose is the folder $1 by its lock $2? Returns 0 if nobody's (or this run's)
free()
{
    test "$2" -gt 0 || return 0
    read -r line 2> /dev/null < "$1/.lock-$2"
    if test -z "$line"; then        # its run is just writing it, or was killed there
        sleep 1
        read -r line 2> /dev/null < "$1/.lock-$2"
    fi
    case $line in '' | done | "$run "*) return 0;; esac
    test "${line##* }" = "$computer" || return 6
    test "$line" != "$(owner "${line%% *}")" || return 5
}

foreign()
{
    printf '%s\n' "-out ${folder%/}: $1 there is not from a run of this package; allowed: a folder without it"
    exit 8
}

# of the files with these names, those there are must be a run's: in the list, and no links
known()
{
    list=$newline
    while IFS= read -r name; do list=$list$name$newline; done 2> /dev/null < "$at/.run/.written"
    for name; do
        test -e "$at/$name" || test -h "$at/$name" || continue
        test ! -h "$at/$name" || foreign "$name"
        case $list in *"$newline$name$newline"*) ;; *) foreign "$name";; esac
    done
}
newline='
'

# is the folder free, and what is in it of runs alone? .run has a lock or a list, or is empty, and has no links
look()
{
    at=$folder
    own=$folder/.run
    if test -h "$own" || test -e "$own"; then
        test ! -h "$own" && test -d "$own" || foreign .run
        any=
        mark=
        for file in "$own"/* "$own"/.[!.]* "$own"/..?*; do
            test ! -h "$file" || foreign .run
            test ! -d "$file" || test -z "$(find "$file" -type l)" || foreign .run
            test ! -e "$file" || any=1
            case $file in "$own/.written" | "$own"/.lock-*) test ! -e "$file" || mark=1;; esac
        done
        test "$any" = "$mark" || foreign .run
        test -x "$own" || exit 4
        newest "$own"
        free "$own" "$n" || exit
    fi
    known summary.json contact.csv history.csv adaptations.csv "$@"
}

case $task in
check)
    . "${programs:=${0%/*}/..}/input/own.sh"
    look
    there=$folder
    while ! test -e "$there"; do there=$(dirname "$there"); done
    test -d "$there" || exit 4
    if test "$there" = "$folder"; then
        test -w "$folder" && test -x "$folder" || exit 4
        exit 0
    fi
    new=${folder#"$there"}
    case /$new/ in */../*) new=;; esac
    try=$there/.try-$computer-$run
    rm -rf "$try" 2> /dev/null
    mkdir "$try" 2> /dev/null || exit 4
    mkdir -p "$try/$new" 2> /dev/null
    code=$?
    rm -rf "$try"
    test $code = 0 || exit 4;;
open)
    look "$@"
    { test -d "$folder/.run" || mkdir -p "$folder/.run" 2> /dev/null; } && cd "$folder/.run" || exit 4
    while :; do
        newest .
        last=$n
        free . "$last" || exit
        mine=$((last + 1))
        if (set -C; : > ".lock-$mine") 2> /dev/null; then
            owner "$run" > ".lock-$mine"
            test -s ".lock-$mine" || { rm -f ".lock-$mine"; exit 7; }
            newest .
            test "$n" != $mine || break
            rm -f ".lock-$mine"     # there is a higher one, of a run that removed the ones seen here
        else test -e ".lock-$mine" || exit 4
        fi
    done 2> /dev/null
    trap '' HUP INT TERM            # a removal that is begun goes on to its end; the summary, which stands for the whole, goes first
    kept=" $* "
    set -- ../summary.json ./* .ends
    while test "$last" -gt 0 && test -e ".lock-$last"; do
        set -- "$@" ".lock-$last"
        last=$((last - 1))
    done
    if test -e .written; then
        while read -r name; do
            case $kept in *" $name "*) continue;; esac
            case $name in '' | */*) ;; *) set -- "$@" "../$name";; esac
        done < .written
    fi
    rm -rf "$@"
    for name in $kept; do
        test ! -e "../$name" || echo "$name"
    done > .written || exit 7;;
publish)
    finite=${1-}
    cd "$folder/.run" 2> /dev/null || exit 4
    newest .
    mine=$n
    read -r whose rest < ".lock-$mine"
    test "$whose" = "$run" || exit 1
    held()                          # a run killed meanwhile has lost the folder to the next one: hands off
    {
        test -e ".lock-$mine" || exit 1
    }
    fail()
    {
        held
        rm -rf ./* .ends
        exit 1
    }
    # a full disk cuts a file off silently: .ends has how long each was for its writer
    ends=$newline
    while read -r name size; do ends=$ends$size" "$name$newline; done 2> /dev/null < .ends || fail
    wc -c -- * 2> /dev/null | (
        while read -r size name; do
            case $ends in
            *"$newline$size $name$newline"*) ends=${ends%%"$newline$size $name$newline"*}$newline${ends#*"$newline$size $name$newline"};;
            *) test "$name" = total || exit 1;;
            esac
        done
        test "$ends" = "$newline"
    ) || fail
    test -z "$finite" || { sed -E 's/([ [])-?(nan|inf)([],}]|$)/\1null\3/g' summary.json > .finite && mv -f .finite summary.json; } || fail
    at=..
    (known *) || {
        held
        rm -rf ./* .ends
        exit 8
    }
    set --
    for file in *; do
        echo "$file" >> .written || fail
        test "$file" = summary.json || set -- "$@" "$file"
    done 2> /dev/null
    held
    test $# = 0 || mv -f "$@" .. || fail
    : > .ends
    held
    test -e summary.json || exit 0
    mv -f summary.json .. || fail
    echo done > ".lock-$mine";;
esac
