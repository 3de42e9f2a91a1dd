# screen.sh: the results of a run on screen: sh screen.sh RUN FOLDER ROWS PLOT
# Needs: FOLDER, the folder of the results with its summary.json, with a trailing slash; ROWS, further rows, each after a line break;
#        PLOT, the command that draws the results, or nothing. RUN, the number of the run's process, is not used.
# Gives: the lines of output/report/screen.awk on standard output.
# Exit code: 1 if awk fails.
report=${programs:-${0%/*}/../..}/output/report
FOLDER=$2 ROWS=$3 PLOT=$4 LC_ALL=C awk -f "$report/json.awk" -f "$report/numbers.awk" -f "$report/screen.awk" -f "$report/screen-options.awk" \
    < "$2summary.json" || {
  echo "The results are in $2summary.json: this awk cannot print them; allowed: mawk, gawk, original-awk"
  exit 1
}
