import os
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

above = [Path.cwd(), *Path.cwd().parents]
os.chdir(next(path for path in above if (path / "edp/main.edp").exists()))  # all paths are relative to the package
from postprocess.lab_session import columns, explore, freefem, gmsh, postprocess, run_of
from postprocess.results import read_run


def run(name, *flags):
    """Results of the lab's program with these flags: `.summary`, and the tables `.contact`, `.history` …"""
    return run_of(program, *flags, out=f"results/labs/notebook/{name}")
