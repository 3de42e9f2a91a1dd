"""The rules for figures (edp/docs/reference/figures.md): each breach is seen on a small figure."""

from itertools import combinations

import numpy as np
import pytest
from matplotlib.figure import Figure
from text_boxes import BLIND, breaches, faults, lab

from postprocess import style


def fair():
    """A figure that keeps the rules, and its axes."""
    figure = Figure(figsize=(style.COLUMN, 0.7 * style.COLUMN), layout="constrained")
    axes = figure.subplots()
    axes.plot([0, 1, 2], [3, 2, 1], label="run", **style.curve(0))
    axes.plot([0, 1, 2], [1, 2, 4], label="Hertz", **style.curve(1))
    axes.set(xlabel="$x/a$ [–]", ylabel="pressure [MPa]")
    style.legend_outside(figure, "upper center")
    return figure, axes


def logarithmic(axes):
    """Labels from 1 on, and data up to 8."""
    axes.set_yscale("log")
    axes.set_ylim(1e-6, 20)
    axes.set_yticks([1e-6, 1e-3, 1])


BREACHES = {
    "no label with a unit": lambda axes: axes.set_ylabel("pressure"),
    "no label with a unit: ''": lambda axes: axes.set_xlabel(""),
    "no label with a unit: 'height'": lambda axes: axes.set(ylabel="height", yticks=[2], yticklabels=["2"]),
    "hyphen for a minus": lambda axes: axes.set_title("at -3.5"),
    "of 6 points": lambda axes: axes.set_title("small", fontsize=6),
    "an internal name: 'xnewton'": lambda axes: axes.plot([0, 1], [1, 1.5], "--", label="xnewton") and axes.legend(),
    "an internal name: 'two-cylinders P1'": lambda axes: (
        axes.plot([0, 1], [1, 1.5], ":", label="two-cylinders P1") and axes.legend()
    ),
    "'run' twice": lambda axes: axes.plot([0, 1], [1, 1.5], "--", label="run") and axes.legend(),
    "a number twice": lambda axes: axes.set_yticks([1, 2, 3], ["1", "2", "2"]),
    "lies on the curve 'Hertz'": lambda axes: axes.text(1, 2, "a word on both curves", ha="center", va="center"),
    "'the legend of run, Hertz' lies on the curve": lambda axes: axes.legend(loc="center"),
    "lie beyond the frame": lambda axes: axes.set_ylim(0, 3.5),
    "y axis with the labels": logarithmic,
    "lies on another one": lambda axes: style.legend_outside(axes.figure, "upper center"),
    "looks like 'run'": lambda axes: axes.plot([0, 2], [1, 3], marker="o", color="#0074B0", label="other"),
}


def test_a_figure_that_keeps_the_rules():
    """No breach shall be named where there is none."""
    with style.look():
        assert faults(fair()[0]) == []


def test_a_sketch():
    """An axis with no number but 0 needs no unit, but the name of its quantity."""
    with style.look():
        figure, axes = fair()
        axes.set(ylabel="pressure", ylim=(0, 5), yticks=[0, 2], yticklabels=["0", "$p_0$"])
        assert faults(figure) == []
        axes.set_ylabel("")
        assert any("no label" in fault for fault in faults(figure))


@pytest.mark.parametrize("words", BREACHES)
def test_breaches_are_seen(words):
    """Each breach shall be named."""
    with style.look():
        figure, axes = fair()
        BREACHES[words](axes)
        found = faults(figure)
        swapped = words.replace("looks like 'run'", "'run' looks like")
    assert any(words in fault or swapped in fault for fault in found), found


def test_a_curve_for_all_eyes():
    """Neighbours of the palette shall differ for each kind of colour blindness, or in their markers."""
    for one, other in combinations(range(len(style.CURVES)), 2):
        looks = style.curve(one), style.curve(other)
        apart = [np.linalg.norm(lab(looks[0]["color"], eye) - lab(looks[1]["color"], eye)) for eye in BLIND]
        assert looks[0]["marker"] != looks[1]["marker"] and (abs(one - other) > 1 or min(apart) > 15)


@pytest.mark.parametrize(
    "low, factor, most", [(3e-7, 1e8, 5), (0.05, 4, 4), (0.31, 1.7, 6), (1e-12, 7.7e12, 8), (2, 900, 5)]
)
def test_logarithmic_axes_can_be_read(low, factor, most):
    """Labels shall be near both ends of the data, not more than asked for, none of them twice."""
    with style.look():
        figure = Figure(figsize=(style.COLUMN, style.COLUMN), layout="constrained")
        axes = figure.subplots()
        values = np.geomspace(low, low * factor, 5)
        axes.plot(values, values)
        axes.set(xlabel="$x$ [mm]", ylabel="$y$ [mm]")
        style.set_log(axes, "xy", most)
        figure.draw_without_rendering()
        assert list(breaches(figure)) == []
        assert 2 <= len([tick for tick in axes.get_xticklabels() if tick.get_text()]) <= most
