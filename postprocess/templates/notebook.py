import csv
import json
import os
import shlex
import subprocess
import sys
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from IPython.display import Image, display

root = next(path for path in [Path.cwd(), *Path.cwd().parents] if (path / "edp/main.edp").exists())
os.chdir(root)


def pictures():
    """The pictures of all results, with the time at which each was drawn."""
    return {(path, path.stat().st_mtime_ns) for path in Path("results").rglob("*.png")}


def shell(command, codes=(0, 20)):
    """Runs a command in the root of the package, prints its output, and shows the pictures that it draws.

    Other exit codes are errors; code 20: not converged, which some questions are about."""
    before = pictures()
    command = command.replace(".venv/bin/python", shlex.quote(sys.executable))
    process = subprocess.Popen(command, shell=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    for line in process.stdout:
        print(line, end="")
    if process.wait() not in codes:
        raise RuntimeError(f"the command ended with code {process.returncode}")
    for path, _ in sorted(pictures() - before):
        print(path)
        display(Image(path, width=760))


def run(name, *flags):
    """A run of the lab's script into the folder results/labs/notebook/name: its screen, its summary, its folder."""
    folder = Path("results/labs/notebook") / name
    words = ["FreeFem++", "-nw", "-v", "0", script, *map(str, flags), "-out", str(folder)]
    done = subprocess.run(words, capture_output=True, text=True)
    if done.returncode not in (0, 20):
        raise RuntimeError(done.stdout[-1000:])
    return done.stdout, json.loads((folder / "summary.json").read_text()), folder


def read(path):
    """A CSV file as columns."""
    with path.open() as lines:
        rows = list(csv.DictReader(lines))
    return {name: np.array([float(row[name]) for row in rows]) for name in rows[0]}
