# cache.sh: where meshes, the plugin and Python's packages are kept: sh cache.sh RUN ROOT
# Needs: RUN, any word; ROOT, the repository, with a trailing slash or empty; the environment's CONTACT_CACHE, XDG_CACHE_HOME,
#        HOME, TMPDIR.
# Gives: on standard output nothing if that is ROOT itself; else the folder: CONTACT_CACHE if it is set; where ROOT cannot be
#        written, or is an installed package, stiff-contact in the first of XDG_CACHE_HOME, HOME's .cache, TMPDIR and /tmp where
#        this user may keep it.
# Exit codes: 0 ROOT, 1 CONTACT_CACHE, 2 XDG_CACHE_HOME, 3 HOME's, 4 TMPDIR, 5 /tmp.
# Its meshes may be of several copies of the package: .shared there tells input/make-mesh.sh to compare what they are made of.
meshes=${2:-.}/meshes
code=1
cache=$CONTACT_CACHE
if test -z "$cache"; then
    test -e "$meshes/generated" && meshes=$meshes/generated
    test -e "${2:-.}/.installed" || test ! -w "$meshes" || exit 0
    for place in "$XDG_CACHE_HOME" "${HOME:+$HOME/.cache}" "$TMPDIR" /tmp; do
        code=$((code + 1))
        test -z "$place" || (umask 077 && mkdir -p "$place/stiff-contact") 2> /dev/null || continue
        # in /tmp it might be somebody else's
        test -O "$place/stiff-contact" && test -w "$place/stiff-contact" && cache=$place/stiff-contact && break
    done
    test -n "$cache" || exit 0
fi
# a folder of that name that was there before is not ours to be cleaned
mkdir -p "$cache" 2> /dev/null
mkdir "$cache/meshes" 2> /dev/null && (: > "$cache/meshes/.shared") 2> /dev/null
printf '%s\n' "$cache"
exit $code
