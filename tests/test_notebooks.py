"""The labs' notebooks run from their first cell to their last, and their answers are those of the labs."""

import json
import shutil

import pytest
from freefem import ROOT, short_of, tree

from postprocess.__main__ import main

BOOKS = sorted(path.parent.name for path in (ROOT / "edp/labs").glob("*/lab.ipynb"))


def test_books():
    """Three labs have a notebook, without outputs, with cells to answer in."""
    assert len(BOOKS) == 3
    for lab in BOOKS:
        cells = json.loads((ROOT / "edp/labs" / lab / "lab.ipynb").read_text())["cells"]
        assert not any(cell.get("outputs") or cell.get("execution_count") for cell in cells)
        texts = ["".join(cell["source"]) for cell in cells]
        assert any("*Your answer:*" in text for text in texts) and any("answers = [" in text for text in texts)


@pytest.mark.parametrize("lab", short_of(["2-newton"], BOOKS))
@pytest.mark.long
def test_runs(lab, tmp_path):
    """A notebook shall run in its own folder, and the answer that it begins with be well."""
    nbformat, nbclient = (pytest.importorskip(name) for name in ("nbformat", "nbclient"))
    pytest.importorskip("ipykernel")
    package = tree(tmp_path / "package")
    folder = package / "edp/labs" / lab
    shutil.copy(ROOT / "edp/labs" / lab / "lab.ipynb", folder)
    book = nbformat.read(folder / "lab.ipynb", as_version=4)
    resources = {"metadata": {"path": str(folder)}}
    nbclient.NotebookClient(book, timeout=120, kernel_name="python3", resources=resources).execute()
    drawn = [out for cell in book.cells for out in cell.get("outputs", []) if "image/png" in out.get("data", {})]
    assert drawn
    answers = package / f"results/labs/notebook/answers-{lab[0]}.csv"
    assert main(["check_lab", lab[0], str(answers)]) == 0
