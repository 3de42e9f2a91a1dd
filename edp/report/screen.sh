# screen.sh: the results of a run on screen: sh screen.sh RUN FOLDER ROWS PLOT
# Needs: FOLDER, the folder of the results with its summary.json, with a trailing slash; ROWS, further rows, each after a line break;
#        PLOT, the command that draws the results, or nothing. RUN, the number of the run's process, is not used.
# Gives: the lines of report/screen.awk on standard output.
# Exit code: that of awk.
FOLDER=$2 ROWS=$3 PLOT=$4 LC_ALL=C awk -f "${programs:-${0%/*}/..}/report/json.awk" -f "${programs:-${0%/*}/..}/report/screen.awk" < "$2summary.json"
