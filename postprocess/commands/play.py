"""write the page that needs nothing installed: Algorithm 1 step by step in a browser

FILE.html is one page without network: the confined block, and the paper's test condensed to its contact points by
FreeFEM, lab 0's page with the elastic block's influence matrix written out.
"""

import argparse
import json
import string
import subprocess
import tempfile
from pathlib import Path

from postprocess import teaching_kit
from postprocess.output import write_files
from postprocess.results import ResultsError

MESHES = {"disc41": 0.5, "disc81": 0.25}  # element sizes where the disc can touch
METHODS = {"paper": "Paper's scheme", "newton": "Plain Newton", "proximal": "Proximal Newton"}
WRITES = """
set(K, solver = sparsesolver);
ofstream out("influence.txt");
out.precision(12);
for (int i = 0; i < n; i++) out << abscissa[dof[i]] << " " << w[i] << endl;
for (int i = 0; i < n; i++)
{
    real[int] unit(Vh.ndof);
    unit = 0;
    unit[dof[i]] = 1;
    real[int] moved = K^-1 * unit;
    for (int j = 0; j < n; j++) out << moved[dof[j]] << " ";
    out << endl;
}
"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--out", required=True, metavar="FILE.html", help="where to write; folders are created")


def run(arguments: argparse.Namespace) -> None:
    """Writes the page and prints its path."""
    data = {name: influence(h) for name, h in MESHES.items()}
    columns = []
    for name, words in METHODS.items():
        pictures = [
            f'<svg id="{name}Law" viewBox="0 0 300 190" role="img" aria-label="{words}: points and law"></svg>',
            f'<svg id="{name}Line" viewBox="0 0 300 170" role="img" aria-label="{words}: overlap along x"></svg>',
        ]
        texts = [f'<p><strong id="{name}End"></strong></p>', f'<p id="{name}Said"></p>']
        columns.append("\n".join([f'<section class="{name}"><h3>{words}</h3>', *texts, *pictures, "</section>"]))
    text = string.Template(teaching_kit.template_file("play.html")).substitute(
        style=teaching_kit.template_file("page.css"),
        methods="\n".join(columns),
        data=json.dumps(data, separators=(",", ":")),
        script=teaching_kit.template_file("play.js"),
    )
    for path in write_files({Path(arguments.out): text.encode()}):
        print(path)


def influence(h: float) -> dict[str, list[float]]:
    """Points x, weights w, and row by row up to the diagonal the displacement c that a unit force leaves, at this h."""
    text = teaching_kit.read_page(teaching_kit.LABS / teaching_kit.PAGE)
    meshes = teaching_kit.LABS.parent.parent / "meshes"
    text = text[: text.index("int newton = 0")] + WRITES
    text = text.replace('labFolder + "/../../../meshes/"', json.dumps(f"{meshes}/"))
    text = text.replace("-setnumber corners 0.000125", f"-setnumber h {h / 40!r} -setnumber corners {h / 4000!r}")
    text = text.replace('cache + "/algorithm1.msh"', '"algorithm1.msh"')
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "influence.edp").write_text(text, encoding="utf-8")
        command = ["sh", str(teaching_kit.LABS.parent / "freefem.sh"), "influence.edp"]
        done = subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=300)
        if done.returncode != 0:
            raise ResultsError("FreeFem++", f"ended with code {done.returncode}: {done.stdout.strip()[-300:]}")
        rows = [list(map(float, line.split())) for line in (folder / "influence.txt").read_text().splitlines()]
    points = [row for row in rows if len(row) == 2]
    matrix = rows[len(points) :]
    order = sorted(range(len(points)), key=lambda i: points[i][0])
    c = [
        float(f"{0.5 * (matrix[i][j] + matrix[j][i]):.10g}")
        for place, i in enumerate(order)
        for j in order[: place + 1]
    ]
    x = [float(f"{points[i][0]:.12g}") for i in order]
    return {"x": x, "w": [float(f"{points[i][1]:.12g}") for i in order], "c": c}
