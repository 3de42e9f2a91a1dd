# campaign.sh: one campaign of many runs, and its figures: sh tests/campaigns/campaign.sh NAME [WORDS...]
# Needs: the package's folder as the present one; PYTHON, RESULTS, and for several processes MPI (the Makefile gives them). A row of
# a table is written after each run: begun again, a campaign goes on where it was. Code 1: a run failed or a check did not pass.
name=$1
shift
export PYTHONPATH=.:tests:tests/campaigns
campaign() { $PYTHON "tests/campaigns/$@"; }
draw()
{
    for module in postprocess/figures/"$name"_*.py; do
        figure=$(basename "$module" .py)
        case $figure in *_peers) continue;; esac
        $PYTHON -m postprocess figure "$figure" --out "$RESULTS/$name/$figure.pdf" "$RESULTS/$name" || exit 1
    done
}
calculix() { command -v ccx >/dev/null || { echo "$1: no ccx here (Debian: calculix-ccx)"; return 1; }; }

case $name in
bench) campaign bench.py && draw;;
bench-large) env $MPI $PYTHON tests/campaigns/bench.py large;;
bench-ranks) env $MPI $PYTHON tests/campaigns/bench.py ranks;;
bench-peers)
    campaign peers.py && campaign peers_condensed.py && campaign peers_whole.py &&
        $PYTHON -m postprocess figure bench_peers --out "$RESULTS/bench/bench_peers.pdf" "$RESULTS/bench" || exit
    calculix 'parts beside CalculiX' || exit 0
    campaign calculix.py --space && campaign calculix_parts.py;;
stability)
    campaign stability.py
    code=$?
    test $code -le 1 || exit $code
    draw
    campaign friction.py || code=$?
    exit $code;;
coverage) campaign covered.py && campaign foreign.py;;
plasticity)
    campaign plasticity.py || exit
    calculix 'the comparison with CalculiX' || exit 0
    campaign plasticity.py --calculix;;
conditioning | models) campaign $name.py && draw;;
choice) campaign choose.py measure && campaign choose.py;;
*) campaign $name.py "$@";;                                    # friction, mutants, verification, tables
esac
