# again.sh: bodies/mesh.sh with a file that gmsh reads after the geometry: sh again.sh RUN AFTER MESH GEO EXPECTED OPTIONS-OF-GMSH...
# Needs: as bodies/mesh.sh; AFTER, a file or nothing.
# Gives: as bodies/mesh.sh.
# Exit codes: those of bodies/mesh.sh.
run=$1
AFTER=$2
export AFTER
shift 2
exec sh "${0%/*}/mesh.sh" "$run" "$@"
