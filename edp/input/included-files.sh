# included-files.sh: a geometry, a case file or a script, and all files that it reads: sh included-files.sh RUN FILE...
# Needs: RUN, any word; FILEs: paths; what is no file is passed over.
# Gives: their paths, a line each, and those of the files that they name, and so on: what a .geo includes or merges, with gmsh's
#        options FILE.opt; the tables of a case file's laws; what a script of FreeFEM includes from its folder or the present one.
#        A line ? stands for files that only gmsh knows, when it runs: a name that a .geo puts together, a program that it starts.
# Exit code: 0.
LC_ALL=C
export LC_ALL
newline='
'
shift
known=$newline

while test $# -gt 0; do
    file=$1
    shift
    case $file in /*) ;; *) file=./$file;; esac
    test -f "$file" || continue
    folder=$(cd "${file%/*}" && pwd -P)
    file=$folder/${file##*/}
    case $known in *"$newline$file$newline"*) continue;; esac
    known=$known$file$newline
    printf '%s\n' "$file"
    kind=${file##*.}
    case $kind in *[A-Z]*) kind=$(printf %s "$kind" | tr A-Z a-z) ;; esac
    case $kind in
    geo | opt) words='merge|include|shapefromfile|filename|systemcall|getenv|onelab';;
    edp | idp) words=include;;
    msh | inp | step | stp | iges | igs | brep) words=;;
    *) words=table;;
    esac
    unknown=
    while IFS= read -r name; do
        case $name in
        '') continue;;
        '?')
            test -z "$unknown" || echo '?'
            unknown=1
            continue;;
        esac
        case $name in /*) ;; *) set -- "$@" "$folder/$name";; esac
        set -- "$@" "$name"
        test ! -f "$folder/$name" && test ! -f "$name" || unknown=
    done << EOF
$(test ! -f "$file.opt" || printf '%s\n' "${file##*/}.opt"
test -z "$words" || awk -v words="$words" '
    words == "table" {
        gsub(/\r/, "")
        while (match($0, /(^|[ \t"])law"?[ \t]+"?table"?[ \t]+/)) {
            $0 = substr($0, RSTART + RLENGTH)
            name = $0
            if (sub(/^"/, "", name)) sub(/".*/, "", name)
            else sub(/[ \t#].*/, "", name)
            print name
        }
        next
    }
    {
        names = ""
        while (match($0, /"[^"]*"/)) {
            names = names "\n" substr($0, RSTART + 1, RLENGTH - 2)
            $0 = substr($0, 1, RSTART - 1) " " substr($0, RSTART + RLENGTH)
        }
        sub(/\/\/.*/, "")
        if (tolower($0) ~ words) print (words == "include" ? "" : "?") names
    }' < "$file")
EOF
    test -z "$unknown" || echo '?'
done
exit 0
