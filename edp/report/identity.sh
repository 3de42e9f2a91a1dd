# identity.sh: the checksum of everything that decides on a run's results beside its flags: sh identity.sh RUN ROOT FILE...
# Needs: ROOT, the repository, with a trailing slash or empty; FILEs: the scene's script, and what the run reads.
# Gives: one line on standard output; the same after a change of dates or places, another after one of contents.
# Exit code: 0.
LC_ALL=C
export LC_ALL
root=${2:-.}
shift 2
for file; do
    test ! -f "$file" || cksum < "$file"
done | tr '\n' ' '
cd "$root" && find edp meshes/*.geo meshes/*.awk -type f ! -name '*.md' | sort | xargs cat | cksum
