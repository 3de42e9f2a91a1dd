"""Pieces of a self-contained HTML page: no network, no script; for a screen, a phone, paper and a screen reader."""

import base64
import html
import string
from collections.abc import Iterable, Sequence
from pathlib import Path

WIDE = 1.3  # ratio of width to height above which a picture keeps its size on a phone and scrolls sideways,
BROAD = 1400  # and pixels across: a picture of several panels, however high
MANY = 4  # columns above which a table is wider than a phone
TEMPLATES = Path(__file__).parent / "templates"


class Markup(str):
    """Text that is HTML already; every other text is escaped when it gets into the page."""


def text(value: object) -> Markup:
    """Any value as HTML."""
    return value if isinstance(value, Markup) else Markup(html.escape(str(value)))


def element(name: str, content: object, **attributes: object) -> Markup:
    """<name attribute="...">content</name>; attributes: class_ for class, aria_label for aria-label."""
    return Markup(f"<{name}{attributes_text(attributes)}>{text(content)}</{name}>")


def attributes_text(attributes: dict) -> str:
    names = {name: name.rstrip("_").replace("_", "-") for name in attributes}
    return "".join(f' {names[name]}="{html.escape(str(value))}"' for name, value in attributes.items())


def joined(pieces: Iterable[object], between: str = "\n") -> Markup:
    return Markup(between.join(map(text, pieces)))


def document(title: str, body: Markup) -> str:
    """The whole page."""
    template = string.Template((TEMPLATES / "page.html").read_text(encoding="utf-8"))
    css = (TEMPLATES / "page.css").read_text(encoding="utf-8")
    return template.substitute(title=text(title), style=css.strip(), body=body)


def table(caption: str, columns: Sequence[str], rows: Iterable[Sequence], numbers: Iterable[int] = ()) -> Markup:
    """A table with a caption, column headers, and the first cell of each row as its header.

    numbers: the columns set flush right. It scrolls sideways by itself where the screen is narrower; a wide one
    says so on a phone, which shows no scroll bar.
    """
    right = set(numbers)

    def look(column: int) -> dict:
        return {"class_": "number"} if column in right else {}

    head = joined((element("th", name, scope="col", **look(k)) for k, name in enumerate(columns)), "")
    body = []
    for first, *others in rows:
        cells = [element("th", first, scope="row", **look(0))]
        cells += [element("td", cell, **look(k)) for k, cell in enumerate(others, 1)]
        body.append(element("tr", joined(cells, "")))
    inner = joined(
        [
            element("caption", caption),
            element("thead", element("tr", head)),
            element("tbody", joined(body)),
        ]
    )
    scrolling = "scroll sideways" if len(columns) > MANY else "scroll"
    return element("div", element("table", inner), class_=scrolling, role="region", tabindex=0, aria_label=caption)


def picture(png: bytes, alt: str, caption: Markup) -> Markup:
    """A figure with its picture in it. alt: what the picture shows."""
    width, height = (int.from_bytes(png[start : start + 4], "big") for start in (16, 20))
    source = "data:image/png;base64," + base64.b64encode(png).decode()
    image = Markup(f"<img{attributes_text({'src': source, 'alt': alt, 'width': width // 2, 'height': height // 2})}>")
    broad = width > WIDE * height or width > BROAD
    if broad:
        image = element("div", image, class_="scroll wide", role="region", tabindex=0, aria_label="Picture")
    return element("figure", joined([image, element("figcaption", caption)]), class_="broad" if broad else "narrow")


def folded(summary: str, content: Markup) -> Markup:
    """Content that is opened by a click on its summary, and on paper."""
    return element("details", joined([element("summary", summary), content]))


def section(name: str, heading: str, *content: Markup) -> Markup:
    """A part of the page with its heading, which can be linked to by name."""
    head = element("h2", heading, id=f"{name}-heading")
    return element("section", joined([head, *content]), id=name, aria_labelledby=f"{name}-heading")
