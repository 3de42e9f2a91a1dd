"""postprocess/figures: hertz and series, drawn from real runs."""

import numpy as np
import pytest
from freefem import run
from text_boxes import faults

from postprocess.command_line import main
from postprocess.reference_values import hertz
from postprocess.results import read_run
from scenes.test_scene_figures import draw

HERTZ = [
    ("hertz-line", ["-width", 80, "-depth", 40, "-grading", 80, "-h", 0.1]),
    ("two-cylinders", ["-h", 0.1]),
    ("hertz-line", ["-geometry", "axisymmetric", "-force", 10, "-h", 0.1]),
]


@pytest.mark.parametrize("scene, flags", HERTZ)
def test_hertz(scene, flags):
    """The figure of a contact under a force shall be drawn; the stress below peaks near where Hertz's does."""
    done = run(scene, "-method", "xnewton", "-order", 2, "-axis", 1, *flags)
    assert faults(draw("hertz", done)) == []
    round_contact = "axisymmetric" in flags
    a, greatest = hertz(read_run(done.folder), done.parameters["force"])
    rows = np.genfromtxt(done.folder / "axis.csv", delimiter=",", names=True)
    shear = np.abs(rows["s11"] - rows["s22"]) / 2
    peak = shear.argmax()
    expected = (0.48, 0.310) if round_contact else (0.786, 0.300)
    assert rows["depth"][peak] / a == pytest.approx(expected[0], rel=0.15)
    assert shear[peak] / greatest == pytest.approx(expected[1], rel=0.1)


def test_hertz_needs_a_force(tmp_path, capsys):
    """A run whose displacement is prescribed shall be refused in one line."""
    done = run("hertz-line", "-method", "xnewton", "-force", 0, "-u0", 0.01, "-h", 0.5, "-axis", 1)
    assert main(["figure", "hertz", "--out", str(tmp_path / "x.pdf"), str(done.folder)]) == 2
    assert "without -force" in capsys.readouterr().err


def test_series(tmp_path):
    """Force against approach of a load series shall be drawn."""
    done = run("rough", "-method", "xnewton", "-h", 0.5, "-modes", 20, "-history", 1, "-steps", 2)
    out = tmp_path / "series.pdf"
    assert main(["figure", "series", "--out", str(out), str(done.folder)]) == 0
    assert out.stat().st_size > 5_000
