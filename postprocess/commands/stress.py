"""draw von Mises' stress in a run's bodies, with the contact pressure

RUN is a result folder of any run made with -vtu 1, the default. Written are RUN/stress.pdf and RUN/stress.png, or what
--out names. In the plane: the deformed bodies coloured by the stress, each contact from near and the whole, and the
pressure over the arc length; in space: for each contact the section through its middle and the pressure on its surface,
and the bodies' surface from outside. Colours end at the greatest stress outside singular places, which a circle marks.
"""

import argparse

from matplotlib.figure import Figure

from postprocess import bodies as drawn
from postprocess import bodies_3d, style
from postprocess.bodies import Bodies, write_picture
from postprocess.commands import state


def add_arguments(parser: argparse.ArgumentParser) -> None:
    style.add_picture(parser, "stress")


def run(arguments: argparse.Namespace) -> None:
    """Reads the run, draws it, writes both files and prints their paths."""
    write_picture(arguments, "stress", draw)


def draw(bodies: Bodies, units: style.Units, view: tuple | None = None, slide: bool = False) -> Figure:
    """The figure, one column of a page wide, or a slide."""
    return in_space(bodies, units, view, slide) if bodies.grid.space else state.in_plane(bodies, units, True, slide)


def in_space(bodies: Bodies, units: style.Units, view: tuple | None, slide: bool = False) -> Figure:
    """Of each contact the section through its middle and the pressure on its surface; the bodies from outside."""
    contacts, more = state.strongest_contacts(bodies, 1 if slide else 4)
    true = drawn.at_true_scale(bodies)
    count = len(contacts)
    letters = "abcdefghi"[: 2 * count + 1]
    sections, maps, body = letters[0:-1:2], letters[1:-1:2], letters[-1]
    if count == 1:
        page = [(sections, 0.8), (maps, 0.94), (body, 0.9)]
    else:
        page = [(a + b, 0.55) for a, b in zip(sections, maps, strict=True)] + [(body, 0.9)]
    columns = [a + b + 2 * body for a, b in zip(sections, maps, strict=True)]
    figure, panels = style.figure_with_panels(
        page, f"{sections}{body} {maps}{body}" if count == 1 else " ".join(columns), slide
    )
    width = 56 if count == 1 and not slide else (44 if count == 1 else 26)
    for index, contact in enumerate(contacts):
        name = style.without_mathtext(bodies.names[contact])
        colours = bodies_3d.draw_section(panels[sections[index]], true, contact, units)
        drawn.set_panel_title(
            panels[sections[index]],
            2 * index,
            f"{name}: section{bodies_3d.section_caption(true, contact, units)}",
            width,
        )
        pressed = bodies_3d.draw_pressure_map(panels[maps[index]], true, contact, units)
        drawn.set_panel_title(
            panels[maps[index]], 2 * index + 1, f"{name}: pressure{bodies_3d.map_caption(true, contact)}", width
        )
    whole = bodies_3d.draw_bodies(panels[body], bodies, state.view_of_contact(bodies, contacts[0], view), True)
    drawn.set_panel_title(
        panels[body], 2 * count, drawn.displacement_caption(bodies, units) + more, 44 if slide else 56
    )
    of_stress, of_pressure = [panels[each] for each in sections], [panels[each] for each in maps]
    drawn.colour_bar(figure, colours, of_stress, bodies, units)
    drawn.colour_bar(figure, whole, [panels[body]], bodies, units)
    drawn.colour_bar(figure, pressed, of_pressure, bodies, units, "pressure")
    return style.finish_layout(figure)
