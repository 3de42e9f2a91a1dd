# labs.sh: runs every command of the labs, line by line as their pages have them: sh tests/campaigns/labs.sh
# Needs: the package's folder as the present one; RESULTS, VENV. Code 20 of a command: it stops a run early, as its page says.
for page in edp/labs/*/README.md; do
    sed -n '/^```sh/,/^```/p' "$page" | grep -v '^[`#]' | while read -r command; do
        echo "$command"
        sh -c "$(echo "$command" | sed "s, results/, $RESULTS/,g;s,^.venv/,$VENV/,")" </dev/null
        code=$?
        case $code in 0 | 20) ;; *) exit $code;; esac
    done || exit $?
done
