"""Notebooks for Jupyter, one a lab, made of the lab's own page.

Texts become cells of text, each command becomes a cell that runs it, each question gets a cell for its answer. A lab
may have further cells of Python in `cells.py`: `# %% Theory` stands before the cell that follows the section Theory,
`# %% 3` before the one that follows question 3. The last cell checks a table of answers as `make check-lab` does.
"""

import json
import os
import re
from pathlib import Path

from postprocess import teaching_kit

FENCE = re.compile(r"^```sh\n(.*?)^```\n?", re.M | re.S)
QUESTION = re.compile(r"^(?=\d+\. )", re.M)
LINK = re.compile(r"(?<=\]\()(?!https?:|#)([^)\s#]+)")
ANSWER = "*Your answer:*"
KERNEL = {"display_name": "Python 3", "language": "python", "name": "python3"}


def made(lab: Path, place: Path) -> bytes:
    """The notebook of a lab, for a file in the folder `place`."""
    cells = [*of_page(lab, place), *of_answers(lab)]
    for number, cell in enumerate(cells):
        cell["id"] = f"cell-{number}"
    whole = {"cells": cells, "metadata": {"kernelspec": KERNEL, "language_info": {"name": "python"}}}
    return (json.dumps(whole | {"nbformat": 4, "nbformat_minor": 5}, indent=1, ensure_ascii=False) + "\n").encode()


def text(source: str) -> dict:
    return {"cell_type": "markdown", "metadata": {}, "source": source.strip()}


def code(source: str) -> dict:
    return {"cell_type": "code", "execution_count": None, "metadata": {}, "outputs": [], "source": source.strip()}


def own_cells(lab: Path) -> dict[str, list[str]]:
    """The further cells of a lab by the section or the question that they follow."""
    path = lab / "cells.py"
    found: dict[str, list[str]] = {}
    for part in re.split(r"^# %% ", teaching_kit.read_page(path), flags=re.M)[1:] if path.exists() else ():
        after, _, source = part.partition("\n")
        found.setdefault(after.strip(), []).append(source)
    return found


def of_page(lab: Path, place: Path) -> list[dict]:
    """The cells of the lab's page, its links leading from `place`."""
    page = teaching_kit.without_answers(
        re.sub(r"<!--.*?-->\n?", "", teaching_kit.read_page(lab / "README.md"), flags=re.S)
    )
    page = LINK.sub(lambda found: Path(os.path.relpath(lab / found[1], place)).as_posix(), page)
    own = own_cells(lab)
    (script,) = lab.glob("*.edp")
    head, *sections = re.split(r"^## ", page, flags=re.M)
    names = f'lab = "{lab.name}"\nscript = "edp/labs/{lab.name}/{script.name}"\n'
    cells = [text(head), code(names + teaching_kit.template_file("notebook.py"))]
    for section in sections:
        name, body = section.partition("\n")[0], f"## {section}"
        if name == "Questions":
            intro, *questions = QUESTION.split(body)
            cells.append(text(intro))
            for question in questions:
                cells += [text(question), *map(code, own.pop(question.partition(".")[0], [])), text(ANSWER)]
        else:
            cells += of_section(body)
        cells += map(code, own.pop(name, []))
    if own:
        raise ValueError(f"{lab.name}/cells.py: no section or question {', '.join(own)}")
    return cells


def of_section(body: str) -> list[dict]:
    """Texts as they are, and a cell for each command; a comment above a command stays with it."""
    cells, at = [], 0
    for fence in FENCE.finditer(body):
        cells.append(text(body[at : fence.start()]))
        at = fence.end()
        above = ""
        for line in fence[1].splitlines():
            if line.startswith("#"):
                above += line + "\n"
            elif line:
                cells.append(code(f"{above}shell(r'''{line}''')"))
                above = ""
    return [cell for cell in [*cells, text(body[at:])] if cell["source"]]


def of_answers(lab: Path) -> list[dict]:
    """A table to fill in, and the command that checks it."""
    file = f"results/labs/notebook/answers-{lab.name}.csv"
    table = teaching_kit.template(teaching_kit.read_page(lab / "ANSWERS.md"))
    check = f".venv/bin/python -m postprocess check_lab {lab.name.split('-')[0]} {file}"
    lines = [f"answers = r'''{table}'''", f'file = Path("{file}")', "file.parent.mkdir(parents=True, exist_ok=True)"]
    lines += ["file.write_text(answers)", f'shell("{check}", codes=(0, 1, 2))']
    words = "## Check\n\nWrite your numbers behind the last commas, and run the cell: it says which are right."
    return [text(words), code("\n".join(lines))]
