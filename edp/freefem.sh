# freefem.sh: FreeFem++ from any folder: sh PATH/edp/freefem.sh SCRIPT FLAGS..., or the Python commands: ... postprocess WORDS...
# Needs: FreeFem++; SCRIPT: a path from the present folder, or from edp/ (scenes/wavy.edp), or a scene's name (wavy); for the
#        Python commands numpy and matplotlib. The environment's CONTACT_STARTER, if any: how this program was called.
# Gives: what the script gives; names among the flags are taken from the present folder. Where the package cannot be written, or
#        is an installed one, results go to results/ in the present folder; see input/cache.sh for what is made and kept.
# CONTACT_REQUEST: what the script reads beside (input/on-request.sh). Without it the script finds out and starts again.
# Exit code: FreeFem++'s or Python's; 10 without a script, without Python's packages, and below a folder with ; in its name.
# FreeFEM looks for modules and plugins where the file freefem++.pref of the present folder says: elsewhere the environment says it.
# It begins in edp/, for it reads includes of its folder first; CONTACT_FOLDER tells input/flags.idp where to go back to.
edp=$(cd "${0%/*}" && pwd)
root=${edp%/edp}
cache=$(sh "$edp/input/cache.sh" 0 "$root")
test -z "$cache" || export CONTACT_CACHE="$cache"

quoted()
{
    case $1 in
    *[!A-Za-z0-9_./+:,@%-]*) printf "'%s'" "$(printf '%s\n' "$1" | sed "s/'/'\\\\''/g")" ;;
    *) printf '%s' "$1" ;;
    esac
}

if test "$1" = postprocess; then
    shift
    # numpy.py in the present folder is not numpy
    for python in "$cache/venv/bin/python" "$root/.venv/bin/python" python3 /usr/bin/python3; do
        "$python" -c 'import sys; sys.path = [p for p in sys.path if p]; from importlib.util import find_spec as f; exit(not (f("numpy") and f("matplotlib")))' 2> /dev/null && break
        python=
    done
    test -n "$python" || { echo "postprocess: no Python with numpy and matplotlib; allowed: one of the system's, or \
python3 -m venv VENV and VENV/bin/pip install -r $root/requirements.txt, with VENV/bin first on the PATH"; exit 10; }
    PYTHONSAFEPATH=1 PYTHONPATH=$root${PYTHONPATH:+:$PYTHONPATH} exec "$python" -m postprocess "$@"
fi

for script in "$1" "$edp/$1" "$edp/$1.edp" "$edp/scenes/$1.edp" none; do test ! -f "$script" || break; done
test "$1" != disc-on-block || test -f "$1" || script=$edp/main.edp
test "$script" != none || {
    starter=${CONTACT_STARTER:-sh freefem.sh}
    echo "${1:-no script}: no such script here or in $edp; allowed: $starter SCRIPT FLAGS..., SCRIPT a path or one of:" \
        disc-on-block parts parts-3d $(cd "$edp/scenes" && for f in *.edp; do echo "${f%.edp}"; done)
    exit 10
}
shift
space=1                            # for input/on-request.sh
for plane in main parts; do test ! "$script" -ef "$edp/$plane.edp" || space=; done
test -n "$space$OPENBLAS_NUM_THREADS$GOTO_NUM_THREADS$OMP_NUM_THREADS" || export OPENBLAS_NUM_THREADS=1
case $edp in *\;*)
    echo "$edp: FreeFEM's lists of folders have ; between them; allowed: a path without ;"
    exit 10 ;;
esac
FF_INCLUDEPATH="$root/build;$edp/input/without;$edp;/usr/include/freefem++/idp${FF_INCLUDEPATH:+;$FF_INCLUDEPATH}"
export FF_INCLUDEPATH
test ! -d /usr/lib/freefem++ || FF_LOADPATH="/usr/lib/freefem++${FF_LOADPATH:+;$FF_LOADPATH}"
export FF_LOADPATH="$root/build${FF_LOADPATH:+;$FF_LOADPATH}"
test -w "$root" && test ! -e "$root/.installed" || export CONTACT_RESULTS="${CONTACT_RESULTS:-results}"
starter="sh $(quoted "$edp/freefem.sh")"
test -z "$CONTACT_STARTER" || starter=$(quoted "$CONTACT_STARTER")
test -e "$root/.venv/bin/python" || export CONTACT_POSTPROCESS="${CONTACT_POSTPROCESS:-$starter postprocess}"
test ! -e "$cache/build/.freefem++.pref" || export HOME="$cache/build"      # names the plugin there: see the Makefile
here=$PWD
uses='^[^/]*include *"((input|scenes|labs)/|(main|parts|parts-3d)\.edp)'
unset CONTACT_FOLDER
if ! test "$root" -ef . && grep -qE "$uses" "$script"; then
    case $script in /*) ;; *) script=$here/$script;; esac
    case $here in *\;*) ;; *) FF_INCLUDEPATH="$FF_INCLUDEPATH;$here" FF_LOADPATH="$FF_LOADPATH;$here";; esac
    export CONTACT_FOLDER="$here"
    cd "$edp" || exit
fi
case " $* " in *' -plot 1 '*) window=;; *) window=-nw;; esac
program=FreeFem++
# MPI's program cannot start anew: another one finds out what it needs
test -z "$OMPI_COMM_WORLD_SIZE$PMI_SIZE" || {
    program=FreeFem++-mpi
    asking='env -u OMPI_COMM_WORLD_SIZE -u PMI_SIZE CONTACT_ASK=1 FreeFem++ -nw -v 0'
    test -n "$CONTACT_REQUEST" || CONTACT_REQUEST=$($asking "$script" "$@" < /dev/null | sed -n 's/^CONTACT_REQUEST *//p')
}
test -n "$CONTACT_REQUEST" || exec $program $window -v 0 "$script" "$@"
set -- "$script" $program $window -v 0 /dev/fd/3 "$@"
. "$edp/input/on-request.sh"
