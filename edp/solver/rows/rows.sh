# rows.sh: a run with rows, started again after a row that ended its process: sh rows.sh SCRIPT FreeFem++ OPTIONS /dev/fd/3 FLAGS
# Needs: programs: the folder edp; CONTACT_REQUEST and the arguments: those of input/on-request.sh, which calls this once.
# Gives: the run. CONTACT_ROWS names a file for its rows, here in TMPDIR: a line that begins with {"row": N for row N, whose last line has its
#        exit code. A process that ends with 77 has completed a row; one that FreeFEM or the system ends has not: its row gets the
#        code 8. Another one then solves the next rows.
# Exit code: the greatest of the rows, or that of a process that could not write them. Prints the end of the run, after the last process:
#        FreeFEM leaves the offset of a file, as the screen of a script is one, where it has written itself.
programs=${programs:-${0%/*}/../..}
export CONTACT_ROWS="${TMPDIR:-/tmp}/rows-$$-$(date +%s)"
trap 'rm -f "$CONTACT_ROWS" "$CONTACT_ROWS.screen"' EXIT
trap 'exit 130' INT
trap 'exit 143' HUP TERM
(: > "$CONTACT_ROWS") 2> /dev/null || {
    echo "${TMPDIR:-/tmp}: no file can be written there, for the rows of -rows or -vary; allowed: a folder with room in TMPDIR"
    exit 30
}
request=$CONTACT_REQUEST
begun=0
while :; do
    (
        CONTACT_REQUEST=$request
        run() { . "$programs/input/on-request.sh"; }
        run "$@"
    )
    code=$?
    if test $code = 0 && test -e "$CONTACT_ROWS.screen"; then
        sed 1d "$CONTACT_ROWS.screen"
        exit "$(sed -n 1p "$CONTACT_ROWS.screen")"
    fi
    case $code in 0 | 10 | 20 | 30 | 130 | 143) exit $code;; esac
    last=$(grep -c '^{"row": ' "$CONTACT_ROWS")
    test $last -gt $begun || exit $code             # it has ended before its first row
    begun=$last
    test $code = 77 || printf 'null\n, "code": 8, "message": "the row has ended the solver with code %s", "seconds": 0}\n' $code >> "$CONTACT_ROWS"
done
