# page_pictures.sh: draws the small pictures of the pages anew: sh tests/campaigns/page_pictures.sh
# Needs: the package's folder as the present one; PYTHON, RESULTS, MAKE; the runs of figure1 and sphere (make pictures), make labs.
# The pictures of campaigns are of the tables in tests/RESULTS.md and tests/COST.md; the cut through the sphere needs PyVista.
set -eu
# small PICTURE PAGE OPTIONS: the picture of a page, whose commands have drawn it
small() { from=$1 of=$2; shift 2; $PYTHON -m postprocess small "$from" --page "$of" "$@"; }
commands() { sed -n '/^```sh/,/^```$/{/^[^`]/p;}' "$1"; }

commands README.md | grep -m 2 meshed-disc | sh -e
small "$RESULTS/meshed-disc/xnewton/stress.png" README.md --width 820 --out postprocess/readme-first.png
small "$RESULTS/figures/figure1.png" edp/docs/HOW-IT-WORKS.md --width 600 --out postprocess/readme-figure.png
$MAKE movie ARGS='-method paper -order 1 -h 0.5'
small "$RESULTS/movies/disc-on-block/movie.gif" edp/docs/HOW-IT-WORKS.md --width 540 --out postprocess/readme-movie.gif
# kept as it is where there is no PyVista
! $PYTHON -c "import pyvista" 2>/dev/null ||
    $PYTHON -m postprocess cut "$RESULTS/figures/sphere" --units mm MPa --out postprocess/readme-sphere.png
small postprocess/readme-sphere.png edp/docs/howto/paraview.md --width 860 --out postprocess/readme-sphere.png
for name in peers stability; do
    PYTHONPATH=.:tests $PYTHON tests/campaigns/pictures.py --out postprocess/readme-$name.png
    small postprocess/readme-$name.png edp/docs/CHOOSING.md --width 860 --out postprocess/readme-$name.png
done

for page in edp/examples/*/README.md; do
    folder=${page%/README.md}
    picture=$(sed -n 's/^!\[.*](\(.*\.png\))/\1/p' "$page")
    commands "$page" | sh -e
    small "$RESULTS"/parts*/"${folder##*/}/$picture" "$page" --width 410 --out "$folder/$picture"
done

for page in edp/docs/tutorial/*.md; do commands "$page" | sh; done
small "$RESULTS/disc-on-block/xnewton/stress.png" edp/docs/tutorial/1-first-run.md --width 720 --out edp/docs/tutorial/disc-on-block.png
small "$RESULTS/parts/foot/stress.png" edp/docs/tutorial/2-own-part.md --width 720 --out edp/docs/tutorial/foot.png
small "$RESULTS/fretting/xnewton/hysteresis.png" edp/docs/tutorial/4-friction.md --width 720 --out edp/docs/tutorial/hysteresis.png
small "$RESULTS/parts-3d/wheel-on-rail/check/faces.png" edp/docs/tutorial/3-from-cad.md --width 640 --out edp/docs/tutorial/faces.png

for lab in edp/labs/*/; do
    name=$(sed -n 's/^\*`\([a-z]*\.png\)` of these commands.*/\1/p' "$lab/README.md")
    case $name in stress*) width=560;; *) width=700;; esac
    small "$(find "$RESULTS/labs/$(basename "$lab")" -name "$name")" "${lab}README.md" --width $width --out "${lab}figure.png"
done
for sketch in 0-algorithm/models 3-threshold/cut 3-threshold/four_five 3-threshold/bridge; do
    small "$RESULTS/labs/$sketch.png" "edp/labs/${sketch%/*}/README.md" --width 700 --out "edp/labs/$sketch.png"
done
