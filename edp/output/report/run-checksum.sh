# run-checksum.sh: the checksum of everything that decides on a run's results beside its flags: sh run-checksum.sh RUN ROOT FILE...
# Needs: ROOT, the repository, with a trailing slash or empty; FILEs: the scene's script, and what the run reads.
# Gives: one line on standard output; the same after a change of dates or places, another after one of contents, be it in a file
#        that one of these reads (input/included-files.sh). Where that cannot be known, another one each time.
# The package's scripts are not followed: all of edp/ is in the sum.
# Exit code: 0.
LC_ALL=C
export LC_ALL
root=${2:-.}
own=$2
shift 2
case $1 in "$own"edp/*.edp) shift ;; esac
sh "$root/edp/input/included-files.sh" 0 "$@" | while IFS= read -r file; do
    if test "$file" = '?'; then echo "unknown $(date +%s) $$"
    else cksum < "$file"
    fi
done | tr '\n' ' '
cd "$root" && find edp/ meshes/*.geo -type f ! -name '*.md' ! -name '*.pyc' | sort | xargs cat | cksum
