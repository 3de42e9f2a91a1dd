"""Notebooks for Jupyter, one a lab, made of the lab's own page, and executed.

Texts become cells of text, each command becomes a call of Python (`lab_session`), each question gets a cell for its
answer. A lab may have further cells of Python in `cells.py`: `# %% Theory` stands before the cell that follows the
section Theory, `# %% 3` before the one that follows question 3. The last cell checks a table of answers as `make
check-lab` does.
"""

import base64
import json
import os
import re
import shlex
from pathlib import Path
from typing import Any

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
    script = min(lab.glob("*.edp"))
    head, *sections = re.split(r"^## ", page, flags=re.M)
    program = f'\nprogram = "edp/labs/{lab.name}/{script.name}"\n'
    cells = [text(head), code(teaching_kit.template_file("notebook.py") + program)]
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
                cells.append(code(above + call(line, above)))
                above = ""
    return [cell for cell in [*cells, text(body[at:])] if cell["source"]]


def call(line: str, above: str = "") -> str:
    """A command of a page, or a loop of one, as a call of `lab_session`; `above` may announce another exit code."""
    if loop := re.fullmatch(r"for (\w+) in (.*?); do (.*); done", line):
        values = ", ".join(json.dumps(value) for value in loop[2].split())
        return f"for {loop[1]} in ({values}):\n    {call(loop[3])}"
    name, *words = shlex.split(line)
    if [name, *words[:2]] == [".venv/bin/python", "-m", "postprocess"]:
        name, words = "postprocess", words[2:]
    elif name in ("FreeFem++", "gmsh"):
        name, words = name.lower().strip("+"), [word for word in words if word != "-nw"]
    else:
        raise ValueError(f"a notebook has no call for the command {line}")
    codes = [f"codes=({code},)" for code in re.findall(r"exit code (\d+)", above)]
    return f"{name}({', '.join([*map(literal, words), *codes])})"


def literal(word: str) -> str:
    """A word of the shell as Python has it: `$k` is the variable k, also within a text."""
    if re.fullmatch(r"\$\w+", word):
        return word[1:]
    within = re.sub(r"\$(\w+)", r"{\1}", word)
    return ("f" if within != word else "") + json.dumps(within, ensure_ascii=False)


def of_answers(lab: Path) -> list[dict]:
    """A table to fill in, and the command that checks it."""
    file = f"results/labs/notebook/answers-{lab.name}.csv"
    table = teaching_kit.template(teaching_kit.read_page(lab / "ANSWERS.md"))
    lines = [f"answers = r'''{table}'''", f'file = Path("{file}")', "file.parent.mkdir(parents=True, exist_ok=True)"]
    lines += ["file.write_text(answers)", f'postprocess("check_lab", {lab.name.split("-")[0]}, file, codes=(0, 1, 2))']
    words = "## Check\n\nWrite your numbers behind the last commas, and run the cell: it says which are right."
    return [text(words), code("\n".join(lines))]


def executed(book: bytes, folder: Path) -> bytes:
    """The notebook run from first to last cell in `folder`, with outputs and figures. Raises for a cell that fails."""
    import nbclient  # development dependencies: only an executed notebook needs them
    import nbformat

    cells = nbformat.reads(book.decode(), as_version=4)
    folder.mkdir(parents=True, exist_ok=True)
    place = {"metadata": {"path": str(folder)}}
    kernel: dict[str, Any] = {
        "kernel_name": "python3",
        "startup_timeout": 300,
        "extra_arguments": ["--log-level=ERROR"],
    }
    nbclient.NotebookClient(cells, timeout=600, resources=place, **kernel).execute()
    for cell in cells.cells:
        cell.metadata.pop("execution", None)  # the time of day
    return (nbformat.writes(cells) + "\n").encode()


def page_of(book: bytes, name: str) -> dict[str, bytes]:
    """An executed notebook as a page for a folder below the notebook's: `name`.md, `name`-N.png for each figure."""
    files: dict[str, bytes] = {}
    parts = []
    for cell in json.loads(book)["cells"]:
        source = "".join(cell["source"])
        if cell["cell_type"] == "markdown":
            if source != ANSWER:
                parts.append(LINK.sub(r"../\1", source))
            continue
        parts.append(f"```python\n{source}\n```")
        for output in cell["outputs"]:
            data = output.get("data", {})
            if "image/png" in data:
                picture = f"{name}-{len(files) + 1}.png"
                files[picture] = base64.b64decode(data["image/png"])
                parts.append(f"![output of this cell]({picture})")
            elif printed := "".join(output.get("text", data.get("text/plain", ""))).strip("\n"):
                parts.append(f"```text\n{printed}\n```")
    return {f"{name}.md": ("\n\n".join(parts) + "\n").encode(), **files}
