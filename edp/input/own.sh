# own.sh: are a script's modules the package's own? Read by input/folder.sh, and before another script of edp/ takes a run over
# Needs: programs: the package's folder edp; CONTACT_FOLDER, if the starter has begun in edp/: FreeFEM then reads nothing else first.
#        refused: a code, or nothing: 8.
# Gives: nothing, or a line and that exit code: FreeFEM reads includes of the present folder before the package's, and one stands there;
#        or the package that the present folder has is another copy. A folder that has the package by links may have its own (make new).
notOwn()
{
    printf '%s\n' "$1; allowed: the starter, sh PATH/edp/freefem.sh, which reads the package first, or another folder"
    exit ${refused:-8}
}

if test -z "$CONTACT_FOLDER" && ! test -h edp; then
    test ! -e edp/input/flags.idp || test edp/input/flags.idp -ef "$programs/input/flags.idp" \
        || notOwn "edp: another copy of the package than the script's, and FreeFEM would read both"
    for module in "$programs"/*.edp "$programs"/*/.; do
        module=${module%/.}
        module=./${module##*/}
        test -e "$module" && ! test "$module" -ef "$programs/$module" || continue
        for file in $(find "$module" \( -name '*.idp' -o -name '*.edp' \) -print 2> /dev/null); do
            name=${file#./}
            while :; do
                test ! -e "$programs/$name" || notOwn "${file#./}: FreeFEM would read it in place of the package's $name"
                case $name in */*) name=${name#*/};; *) break;; esac
            done
        done
    done
fi
