"""draw a run's bodies under their load, with the pressure along the contact

RUN is a result folder of any run made with -vtu 1, the default. Written are RUN/state.pdf and RUN/state.png, or what
--out names. In the plane: each contact from near, the bodies, and the pressure over the arc length; in space: for each
contact the pressure on its surface, seen along its normal, and the bodies from outside. Of many contacts those that
carry most are drawn from near. With friction the shear stands beside the pressure, and what sticks and slips is
coloured.
"""

import argparse

import numpy as np
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from postprocess import bodies as drawn
from postprocess import bodies_3d, style
from postprocess.bodies import Bodies, write_picture
from postprocess.results import ResultsError

MOST = 6  # contacts that are drawn from near; half as many where their shears are drawn too; on a slide two


def add_arguments(parser: argparse.ArgumentParser) -> None:
    style.add_picture(parser, "state")


def run(arguments: argparse.Namespace) -> None:
    """Reads the run, draws it, writes both files and prints their paths."""
    write_picture(arguments, "state", draw)


def draw(bodies: Bodies, units: style.Units, view: tuple | None = None, slide: bool = False) -> Figure:
    """The figure, one column of a page wide, or a slide."""
    return in_space(bodies, units, view, slide) if bodies.grid.space else in_plane(bodies, units, slide=slide)


def slide_layout(letters: str, rest: str, columns: bool = False) -> str:
    """A slide: the first letters in one column or two, those of `rest` below each other beside them, or in columns."""
    count = 1 if len(letters) < 3 else 2
    rows = [letters[k : k + count] for k in range(0, len(letters), count)] or [""]
    rows[-1] += rows[-1][-1:] * (count - len(rows[-1]))
    if columns:
        return " ".join(row + rest for row in rows)
    height = int(np.lcm(len(rows), len(rest)))
    left = [row for row in rows for _ in range(height // len(rows))]
    right = [letter for letter in rest for _ in range(height // len(rest))]
    return " ".join(a + count * b for a, b in zip(left, right, strict=True))


def strongest_contacts(bodies: Bodies, amount: int = MOST) -> tuple[list[int], str]:
    """The contacts that are drawn from near, the strongest first, and what is said where there are more."""
    found = drawn.contacts_by_force(bodies)
    if not found:
        raise ResultsError(bodies.run.path / "contact.csv", "no point is in contact")
    return found[:amount], f"; from near {amount} of {len(found)} contacts" if len(found) > amount else ""


def in_plane(bodies: Bodies, units: style.Units, stress: bool = False, slide: bool = False) -> Figure:
    """Each contact that is small from near, at true scale, the bodies, the pressure over the arc length.

    With `stress` the bodies are coloured by von Mises' stress.
    """
    contacts, more = strongest_contacts(bodies, 2 if slide else MOST)
    true = drawn.at_true_scale(bodies)
    whole = drawn.whole_window(bodies)
    zones = [(contact, drawn.contact_window(true, contact)) for contact in contacts]
    zones = [(contact, box) for contact, box in zones if np.ptp(box[:, 0]) < 0.5 * np.ptp(whole[:, 0])]
    letters = "abcdefghi"[: len(zones) + 2]
    near, body, curve = letters[:-2], letters[-2], letters[-1]
    wide = 0.62 if stress or len(near) == 2 else 0.84
    shape = min(1.2, max(0.25, np.ptp(whole[:, 1]) / np.ptp(whole[:, 0])))
    each = 1 if len(near) < 3 else 2
    rows = [(near[k : k + each], 0.75 * wide / each + 0.2) for k in range(0, len(near), each)]
    page = [*rows, (body, shape * wide + 0.2), (curve, 0.6)]
    tall = shape > 0.8
    figure, panels = style.figure_with_panels(page, slide_layout(near, body + curve, tall or not near), slide)
    width = (28 if tall or each == 2 else 44) if slide else 56 // each - 2
    boxes = [*zones, (None, whole)]
    for index, (letter, (contact, box)) in enumerate(zip(near + body, boxes, strict=True)):
        axes, shown = panels[letter], bodies if contact is None else true
        ends = drawn.whole_stress_range(bodies), drawn.stress_range(bodies, [zone for _, zone in zones])
        top = ends[contact is not None] if stress else None
        colours = drawn.fill_plane(axes, shown, top)
        drawn.draw_mesh(axes, shown, box, stress)
        if contact is not None or not zones:
            drawn.draw_pressure_diagram(axes, shown, box, contact, units)
        axes.set_xlim(*box[:, 0])
        axes.set_ylim(*box[:, 1])
        axes.set_aspect("equal")
        axes.locator_params(nbins=5 if contact is None else 4)
        axes.ticklabel_format(useOffset=False)
        axes.set_xlabel(f"$x$ [{units.length}]")
        axes.set_ylabel(f"$y$ [{units.length}]")
        if colours is not None and (contact is None or each == 1):
            drawn.colour_bar(figure, colours, [axes], bodies, units)
        words = drawn.displacement_caption(bodies, units) + more
        if contact is not None:
            words = style.without_mathtext(bodies.names[contact]) or "contact"
            words += drawn.force_caption(true, contact, units) + drawn.origin_caption(true, contact)
        axes.set_anchor("W")
        drawn.set_panel_title(axes, index, words, width if contact is not None or slide else 54)
    if stress and each == 2:
        drawn.colour_bar(figure, panels[near[0]].collections[0], [panels[letter] for letter in near], bodies, units)
    for letter, (contact, _) in zip(near, zones, strict=True):
        box = drawn.contact_window(bodies, contact)
        size = np.ptp(box, axis=0)
        panels[body].add_patch(Rectangle(box[0], *size, fill=False, linewidth=0.6, zorder=6))
        look: style.Look = {"textcoords": "offset points", "fontsize": 7, "zorder": 7, "bbox": style.HALO}
        under = box[1, 1] > whole[1, 1] - 0.1 * np.ptp(whole[:, 1])  # the panel's title is close
        panels[body].annotate(f"({letter})", np.minimum(box[1], whole[1]), (3, -6 if under else 3), **look)
    drawn.plot_pressure(panels[curve], bodies, units, slide and tall)
    drawn.set_panel_title(panels[curve], len(boxes))
    return style.finish_layout(figure)


def view_of_contact(bodies: Bodies, contact: int, view: tuple | None) -> np.ndarray:
    return bodies_3d.view_matrix(*(view or bodies_3d.view_angles(bodies_3d.contact_forces(bodies, contact)[1])))


def in_space(bodies: Bodies, units: style.Units, view: tuple | None, slide: bool = False) -> Figure:
    """The pressure on each contact's surface, with friction its shear; then the bodies with these from outside."""
    rubs = "slide" in bodies.table
    contacts, more = strongest_contacts(bodies, 2 if slide else MOST // 2 if rubs else MOST)
    shown = [(contact, sheared) for contact in contacts for sheared in ((False, True) if rubs else (False,))]
    letters = "abcdefghi"[: len(shown) + 1]
    maps, body = letters[:-1], letters[-1]
    each = 1 if len(maps) == 1 else 2
    rows = [(maps[k : k + each], 0.84 / each + (0.17 if rubs else 0.1)) for k in range(0, len(maps), each)]
    figure, panels = style.figure_with_panels([*rows, (body, 0.9)], slide_layout(maps, body), slide)
    for index, (letter, (contact, sheared)) in enumerate(zip(maps, shown, strict=True)):
        words = style.without_mathtext(bodies.names[contact])
        if sheared:
            greatest = bodies_3d.draw_shear_map(panels[letter], bodies, contact, panels[maps[index - 1]])
            unit = "" if units.stress == style.Units.stress else f" {units.stress}"
            words = f"{words} shear, up to ${style.number(float(f'{greatest:.3g}'))}${unit}".lstrip()
        else:
            words += bodies_3d.map_caption(bodies, contact)
            colours = bodies_3d.draw_pressure_map(panels[letter], bodies, contact, units)
        if rubs:
            panels[letter].locator_params(nbins=4)
        panels[letter].set_anchor("W")
        drawn.set_panel_title(panels[letter], index, words, 56 if each == 1 and not slide else 28)
    if rubs:
        below: style.Look = {"loc": "upper center", "bbox_to_anchor": (0.5, 0), "borderaxespad": 4}
        last = panels[maps[-1]]
        handles, names = drawn.zone_legend(last)
        last.legend(handles, names, fontsize=7, ncols=2, handlelength=1.2, **below)
    bodies_3d.draw_bodies(panels[body], bodies, view_of_contact(bodies, contacts[0], view), False)
    drawn.set_panel_title(
        panels[body], len(maps), drawn.displacement_caption(bodies, units) + more, 44 if slide else 56
    )
    drawn.colour_bar(figure, colours, [panels[letter] for letter in maps], bodies, units, "pressure")
    return style.finish_layout(figure)
