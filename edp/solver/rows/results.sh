# results.sh: the table of a run's rows, and its end for the screen: sh results.sh RUN FOLDER STORE ROWS [CASES]
# Needs: FOLDER, the folder of the results, with a trailing slash; STORE, the rows of solver/rows/results.idp, each over several lines;
#        ROWS, their number; CASES: a program that makes more tables of them, or nothing.
# Gives: FOLDER/.run/rows.json, a list of them after the common parameters, and rows.csv, by output/report/json.awk and
#        solver/rows/results.awk, envelope.csv by CASES, with their lengths in .ends; STORE.screen, the greatest exit code of the rows and the last lines.
# Exit code: 1 if rows are missing, which a line says.
programs=${programs:-${0%/*}/../..}
at=$2.run
LC_ALL=C sed -E -e '4,$s/^[{]"row": /,&/' -e '$s/$/]}/' -e 's/([ [])-?(nan|inf)([],}]|$)/\1null\3/g' "$3" > "$at/rows.json"
LC_ALL=C FOLDER=$2 SCREEN=$3.screen CASES=$5 awk -f "$programs/output/report/json.awk" -f "$programs/solver/rows/results.awk" \
    ${5:+-f "$programs/output/report/numbers.awk" -f "$programs/$5"} "$at/rows.json" > "$at/rows.csv"
test "$(wc -l < "$at/rows.csv")" = $(($4 + 1)) || {
    echo "results could not be written whole into $2 (disk full, or another awk than mawk, gawk, original-awk?): nothing was kept"
    exit 1
}
for file in rows.json rows.csv ${5:+envelope.csv}; do echo "$file $(wc -c < "$at/$file")" >> "$at/.ends"; done
