# read.sh: the reader of cases and meshes, input/reader/, in the first Python that can run it: sh read.sh RUN COMMAND NAME=VALUE...
# Needs: RUN, the number of the run's process; COMMAND NAME=VALUE...: those of input/reader/command.py; Python 3.11 or later with numpy and
#        gmsh's module: that of the environment's CONTACT_PYTHON, of the package's .venv, of the PATH, of the system; CONTACT_READER: one that
#        is known to be fit, or nothing.
# Gives: what the command gives. If there is no such Python, one line on standard output that says how to get it.
# Exit codes: those of the command, 12 no Python.
here=${0%/*}
export CONTACT_RUN="$1"
# numpy and gmsh calculate little: threads of OpenBLAS would wait, by spinning
test -n "$OPENBLAS_NUM_THREADS$GOTO_NUM_THREADS$OMP_NUM_THREADS" || export OPENBLAS_NUM_THREADS=1
shift
cache=$(sh "$here/cache.sh" "$CONTACT_RUN" "$here/../..")
set -- "$@" "cache=${cache:-$here/../..}/meshes$(test -n "$cache" || echo /generated)"
# -I: no module of the present folder takes the place of numpy
test ! -x "$CONTACT_READER" || exec "$CONTACT_READER" -I "$here/read.py" "$@"
for python in "$CONTACT_PYTHON" "${CONTACT_CACHE:+$CONTACT_CACHE/venv/bin/python}" "$here/../../.venv/bin/python" python3 /usr/bin/python3; do
    case $python in '') continue ;; */*) test -x "$python" || continue ;; esac
    "$python" -I "$here/read.py" "$@"
    code=$?
    case $code in 12 | 126 | 127) ;; *) exit $code ;; esac
done
printf '%s\n' "case files are read by Python 3.11 or later with numpy and gmsh's module, and no Python here has both; allowed: Debian's \
packages python3-numpy and python3-gmsh (make setup, or apt install python3-numpy python3-gmsh), or pip install numpy gmsh"
exit 12
