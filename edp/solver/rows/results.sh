# results.sh: the table of a run's rows, and its end on screen: sh results.sh RUN FOLDER [print]
# Needs: FOLDER, the folder of the results, with a trailing slash; in FOLDER/.run rows.json, of solver/rows/results.idp.
# Gives: FOLDER/.run/rows.csv, by output/report/json.awk and solver/rows/results.awk, and its length in .ends. With print: the number of
#        rows by exit code, the messages of the first rows that failed, and the files, on standard output.
# Exit code: 1 if awk fails.
programs=${programs:-${0%/*}/../..}
if test "$3" = print; then
    LC_ALL=C FOLDER=$2 awk -f "$programs/solver/rows/print.awk" "$2rows.csv"
else
    at=$2.run
    LC_ALL=C awk -f "$programs/output/report/json.awk" -f "$programs/solver/rows/results.awk" "$at/rows.json" > "$at/rows.csv" || exit 1
    echo "rows.csv $(wc -c < "$at/rows.csv")" >> "$at/.ends"
fi
