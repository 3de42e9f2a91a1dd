# python.sh: the Python that reads cases: sh python.sh ROOT
# Needs: ROOT, the package's folder.
# Gives: on standard output the first Python that has numpy and gmsh's module: that of the environment's CONTACT_PYTHON, of the
#        package's .venv, of the PATH, of the system. The modules are looked for, not imported, which would take a quarter of a second.
#        If there is none, one line that says how to get it.
# Exit codes: 0 found, 10 none.
for python in "${CONTACT_PYTHON:-}" "$1/.venv/bin/python" python3 /usr/bin/python3; do
    test -n "$python" || continue
    # numpy.py in the present folder is not numpy
    "$python" -c 'import sys; sys.path = [p for p in sys.path if p]; from importlib.util import find_spec as f
sys.exit(not (sys.version_info >= (3, 11) and f("numpy") and f("gmsh")))' 2> /dev/null || continue
    printf '%s\n' "$python"
    exit 0
done
echo "case files are read by Python 3.11 or later with numpy and the module of gmsh, which no Python here has; allowed: Debian's packages \
python3-numpy and python3-gmsh (apt install python3-numpy python3-gmsh), or $1/.venv/bin/pip install gmsh"
exit 10
