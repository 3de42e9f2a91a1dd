"""The Markdown of the package's pages as HTML: headings, paragraphs, lists, tables, pictures, code, equations; no more.

What a page writes in another way comes out as plain text, which a test looks for.
"""

import html
import re
from collections.abc import Callable

from postprocess import equations
from postprocess.html_page import Markup

INLINE = re.compile(
    r"(?P<code>`[^`]+`)|!\[(?P<alt>[^]]*)\]\((?P<source>[^)]+)\)|\[(?P<words>[^]]+)\]\((?P<target>[^)]+)\)"
    r"|\*\*(?P<strong>.+?)\*\*|(?<![\w*])\*(?P<em>[^*\s][^*]*)\*(?!\w)"
)
Place = Callable[[str], str]  # a link's target, or a picture's source, to what stands in the page; "": no link


def plain(text: str) -> str:
    """Words; <br>, which breaks a cell of a table, stays."""
    return html.escape(text).replace("&lt;br&gt;", "<br>")


def inline(text: str, link: Place, image: Place) -> str:
    """Code, pictures, links, bold and slanted words of a line."""
    pieces, at = [], 0
    for found in INLINE.finditer(text):
        pieces.append(plain(text[at : found.start()]))
        at = found.end()
        if found["code"]:
            pieces.append(f"<code>{html.escape(found['code'][1:-1])}</code>")
        elif found["source"]:
            alt = html.escape(found["alt"], quote=True)
            pieces.append(f'<img src="{image(found["source"])}" alt="{alt}">')
        elif found["target"]:
            words, target = inline(found["words"], link, image), link(found["target"])
            pieces.append(f'<a href="{html.escape(target, quote=True)}">{words}</a>' if target else words)
        elif found["em"] and (formula := equations.inline(found["em"])):
            pieces.append(formula)
        else:
            name = "strong" if found["strong"] else "em"
            pieces.append(f"<{name}>{inline(found['strong'] or found['em'], link, image)}</{name}>")
    return "".join([*pieces, plain(text[at:])])


def markup(text: str, link: Place = lambda target: target, image: Place = lambda source: source) -> Markup:
    """A page's Markdown as HTML."""
    lines, pieces = text.splitlines(), []

    def words(content: str) -> str:
        return inline(content, link, image)

    def take(wanted: Callable[[str], bool]) -> list[str]:
        taken = []
        while lines and wanted(lines[0]):
            taken.append(lines.pop(0))
        return taken

    while lines:
        line = lines[0]
        heading, item = re.match(r"(#+) (.*)", line), re.match(r"(-|\d+\.) ", line)
        if not line.strip() or line.startswith("<!--"):
            lines.pop(0)
        elif line.startswith("```"):
            lines.pop(0)
            code = take(lambda each: not each.startswith("```"))
            lines[:1] = []
            pieces.append(f"<pre>{html.escape(chr(10).join(code))}</pre>")
        elif line.startswith("    "):
            code = [each[4:] for each in take(lambda each: each.startswith("    "))]
            made = equations.display(code)
            pieces.append(
                f'<div class="equations">{made}</div>' if made else f"<pre>{html.escape(chr(10).join(code))}</pre>"
            )
        elif heading:
            lines.pop(0)
            level = len(heading[1])
            pieces.append(f"<h{level}>{words(heading[2])}</h{level}>")
        elif line.startswith("|"):
            pieces.append(table(take(lambda each: each.startswith("|")), words))
        elif item:
            ordered = item[1] != "-"
            items: list[list[str]] = []
            for each in take(lambda each: bool(re.match(r"(-|\d+\.) |  +\S", each))):
                begins = re.match(r"(?:-|\d+\.) (.*)", each)
                items.append([begins[1]]) if begins else items[-1].append(each.strip())
            start = f' start="{item[1][:-1]}"' if ordered else ""
            inner = "".join(f"<li>{words(' '.join(parts))}</li>" for parts in items)
            pieces.append(f"<ol{start}>{inner}</ol>" if ordered else f"<ul>{inner}</ul>")
        else:
            paragraph = take(lambda each: bool(each.strip()) and not re.match(r"```|\||#+ |- |\d+\. |<!--", each))
            pieces.append(f"<p>{words(' '.join(paragraph or [lines.pop(0)]))}</p>")
    return Markup("\n".join(pieces))


def cells(line: str) -> list[str]:
    """The cells of a table's line, without blanks around them."""
    return [cell.strip().replace(r"\|", "|") for cell in re.split(r"(?<!\\)\|", line.strip())[1:-1]]


def tables(text: str) -> list[tuple[list[str], list[list[str]]]]:
    """(head, rows) of each table of a page."""
    blocks = re.findall(r"(?:^\|.*\n?)+", text, re.M)
    split = [[cells(line) for line in block.splitlines()] for block in blocks]
    return [(lines[0], lines[2:]) for lines in split]


def table(lines: list[str], words: Callable[[str], str]) -> str:
    """A table's lines, its head first, then a rule."""
    (head, rows) = tables("\n".join(lines))[0]
    top = "".join(f'<th scope="col">{words(cell)}</th>' if cell else "<td></td>" for cell in head)
    body = "".join(
        f'<tr><th scope="row">{words(first)}</th>{"".join(f"<td>{words(cell)}</td>" for cell in others)}</tr>'
        for first, *others in rows
    )
    name = html.escape(", ".join(cell for cell in head if cell), quote=True)
    scroll = f'<div class="scroll" role="region" tabindex="0" aria-label="Table: {name}">'
    return f"{scroll}<table><thead><tr>{top}</tr></thead><tbody>{body}</tbody></table></div>"
