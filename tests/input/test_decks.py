"""Decks of CalculiX and Abaqus with elements of each kind, whose groups the case picks by place."""

import numpy as np
import pytest
from freefem import cases_of, part

EDGES = {
    "brick": [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)],
    "wedge": [(0, 1), (1, 2), (2, 0), (3, 4), (4, 5), (5, 3), (0, 3), (1, 4), (2, 5)],
    "tetrahedron": [(0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)],
}
CUTS = {  # of a brick into its parts
    "brick": [(0, 1, 2, 3, 4, 5, 6, 7)],
    "wedge": [(0, 1, 2, 4, 5, 6), (0, 2, 3, 4, 6, 7)],
    "tetrahedron": [(0, 1, 2, 6), (0, 2, 3, 6), (0, 3, 7, 6), (0, 7, 4, 6), (0, 4, 5, 6), (0, 5, 1, 6)],
}
DECKS = {
    "C3D8": ("brick", False), "C3D8R": ("brick", False), "C3D20": ("brick", True), "C3D20R": ("brick", True),
    "C3D6": ("wedge", False), "C3D15": ("wedge", True), "C3D4": ("tetrahedron", False), "C3D10": ("tetrahedron", True),
}  # fmt: skip


def deck(kind, cells=(2, 2, 3)):
    """A quarter of a pipe, radii 1 and 2, height 3: bricks, or their parts, in one ELSET; no other sets."""
    shape, second = DECKS[kind]
    nodes, elements = {}, []

    def node(place):
        return nodes.setdefault(tuple(np.round(place, 9)), len(nodes) + 1)

    def bend(place):
        angle, radius = place[1] * np.pi / 2, 1 + place[0]
        return radius * np.cos(angle), radius * np.sin(angle), 3 * place[2]

    for cell in np.ndindex(*cells):
        corners = [np.add(cell, step) / cells for step in ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0))]
        corners += [corner + np.array([0, 0, 1 / cells[2]]) for corner in corners]
        for piece in CUTS[shape]:
            own = [corners[k] for k in piece]
            own += [(own[a] + own[b]) / 2 for a, b in EDGES[shape]] if second else []
            elements.append([node(bend(place)) for place in own])
    lines = ["*NODE", *(f"{n}, {x:.9g}, {y:.9g}, {z:.9g}" for (x, y, z), n in nodes.items())]
    lines.append(f"*ELEMENT, TYPE={kind}, ELSET=PIPE")
    for number, own in enumerate(elements, 1):
        lines.append(f"{number}, " + ", ".join(map(str, own[:10])) + ("," if len(own) > 10 else ""))
        lines += [", ".join(map(str, own[10:]))] if len(own) > 10 else []
    return "\n".join(lines) + "\n"


@pytest.mark.parametrize("kind", cases_of(["C3D8", "C3D20R", "C3D15"], DECKS))
def test_decks(kind, tmp_path):
    """A quarter of a pipe pressed flat by a rigid plane, its groups picked by place: force and outward motion."""
    case = (
        "body PIPE E 1000 nu 0.25\ngroup foot plane 0 0 0 0 0 1\ngroup head plane 0 0 3 0 0 1\n"
        "group side plane 0 0 0 1 0 0\ngroup front plane 0 0 0 0 1 0\ngroup bore cylinder 0 0 0 0 0 1 R 1\n"
        "symmetry foot\nsymmetry side\nsymmetry front\nobstacle head plane 0 0 3 0 0 -1 move 0 0 -0.003\n"
        "pressure bore 0\n"
    )
    (tmp_path / "a.inp").write_text(deck(kind))
    run = part(tmp_path, tmp_path / "a.inp", case, space=True)
    second = DECKS[kind][1]
    area = 3 * np.pi / 4 if second else 3 * 4 * np.sin(np.pi / 8) * np.cos(np.pi / 8) / 2
    assert run.summary["force"] == pytest.approx(1000 * 0.001 * area, rel=2e-3 if second else 1e-6)
