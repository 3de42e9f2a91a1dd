# freefem.sh: FreeFem++ from any folder: sh PATH/edp/freefem.sh SCRIPT FLAGS...
# Needs: FreeFem++; SCRIPT: a path from the present folder, or from edp/: scenes/wavy.edp.
# Gives: what the script gives; names among the flags are taken from the present folder.
# Exit code: FreeFem++'s; 10 without a script, and below a folder with ; in its name.
# FreeFEM looks for modules and plugins where the file freefem++.pref of the present folder says: elsewhere the environment says it.
edp=$(cd "${0%/*}" && pwd)
script=$1
test -e "$script" || script=$edp/$1
test -f "$script" || { echo "${1:-no script}: no such script here or in $edp; allowed: sh freefem.sh SCRIPT FLAGS..."; exit 10; }
shift
case $edp in *\;*) echo "$edp: FreeFEM's lists of folders have ; between them; allowed: a path without ;"; exit 10 ;; esac
export FF_INCLUDEPATH="$edp/../build;$edp/operator/without;$edp;/usr/include/freefem++/idp${FF_INCLUDEPATH:+;$FF_INCLUDEPATH}"
test ! -d /usr/lib/freefem++ || FF_LOADPATH="/usr/lib/freefem++${FF_LOADPATH:+;$FF_LOADPATH}"
export FF_LOADPATH="$edp/../build${FF_LOADPATH:+;$FF_LOADPATH}"
case " $* " in *' -plot 1 '*) window=;; *) window=-nw;; esac
exec FreeFem++ $window -v 0 "$script" "$@"
