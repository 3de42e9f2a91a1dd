# page_pictures.sh: draws the small pictures of the pages anew: sh tests/campaigns/page_pictures.sh
# Needs: the package's folder as the present one; PYTHON, RESULTS, MAKE; the runs of figure1 and sphere (make pictures), make labs.
# The pictures of campaigns are of the tables in tests/RESULTS.md and tests/COST.md; the cut through the sphere needs PyVista.
set -eu
small() { $PYTHON -m postprocess small "$@"; }
commands() { sed -n '/^```sh/,/^```$/{/^[^`]/p;}' "$1"; }

small "$RESULTS/figures/figure1.png" --width 600 --out postprocess/readme-figure.png
$MAKE movie ARGS='-method paper -order 1 -h 0.5'
small "$RESULTS/movies/disc-on-block/movie.gif" --width 540 --out postprocess/readme-movie.gif
$PYTHON -m postprocess cut "$RESULTS/figures/sphere" --units mm MPa --out postprocess/readme-sphere.png
for name in peers stability; do
    PYTHONPATH=.:tests $PYTHON tests/campaigns/pictures.py --out postprocess/readme-$name.png
done

for page in edp/examples/*/README.md; do
    folder=${page%/README.md}
    picture=$(sed -n 's/^!\[.*](\(.*\.png\))/\1/p' "$page")
    commands "$page" | sh -e
    small "$RESULTS"/parts*/"${folder##*/}/$picture" --width 560 --out "$folder/$picture"
done

for page in edp/docs/tutorial/*.md; do commands "$page" | sh; done
small "$RESULTS/disc-on-block/xnewton/state.png" --width 720 --out edp/docs/tutorial/disc-on-block.png
small "$RESULTS/parts/foot/state.png" --width 720 --out edp/docs/tutorial/foot.png
small "$RESULTS/fretting/xnewton/hysteresis.png" --width 720 --out edp/docs/tutorial/hysteresis.png
small "$RESULTS/parts-3d/wheel-on-rail/check/faces.png" --width 640 --out edp/docs/tutorial/faces.png

for lab in edp/labs/*/; do
    name=$(sed -n 's/^\*`\([a-z]*\.png\)` of these commands.*/\1/p' "$lab/README.md")
    case $name in stress*) width=560;; *) width=700;; esac
    small "$(find "$RESULTS/labs/$(basename "$lab")" -name "$name")" --width $width --out "$lab/figure.png"
done
for sketch in 0-algorithm/models 3-threshold/cut 3-threshold/four_five 3-threshold/bridge; do
    small "$RESULTS/labs/$sketch.png" --width 700 --out "edp/labs/$sketch.png"
done
