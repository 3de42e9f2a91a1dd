import sys
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

sys.path[:0] = [str(path) for path in [Path.cwd(), *Path.cwd().parents] if (path / "edp/main.edp").exists()][:1]
from postprocess.lab_session import columns, enter_package, explore, freefem, gmsh, postprocess, run_of
from postprocess.results import read_run

enter_package()


def run(name, *flags):
    """Results of the lab's program with these flags: `.summary`, and the tables `.contact`, `.history` …"""
    return run_of(program, *flags, out=f"results/labs/notebook/{name}")
