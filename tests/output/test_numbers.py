"""The pages' numbers: a fresh run gives what stands there, to its digits; of campaigns a sample of rows."""

import dataclasses
import random

import bench
import campaign
import pytest
import stability
import tables
from freefem import cases_of, data
from page_numbers import PAGES, ROOT, differing, like, renewed, run, units

TEXTS = {path: path.read_text() for path in PAGES}
OF_ALL = [(path, unit) for path, text in TEXTS.items() for unit in units(text)]
NAMES = [f"{path.relative_to(ROOT)} {unit.command.split(' ', 1)[-1]}" for path, unit in OF_ALL]


@pytest.mark.parametrize("path, unit", OF_ALL, ids=NAMES)
def test_page(path, unit):
    """`make numbers` would change nothing."""
    assert [f"{old} is now {new}" for _, _, old, new in differing(TEXTS[path], unit)] == []


@pytest.mark.parametrize(
    "old, value, new",
    [
        ("2.42e-4", 1.2345e-5, "1.23e-5"),
        ("28 565", 1234567.8, "1 234 568"),
        ("+0.19 %", -0.0023, "−0.23 %"),
        ("−1.669", 1.669, "1.669"),
        ("−0.01 %", 1e-9, "0.00 %"),
        ("+1 %", 0.02, "+2 %"),
        ("0.000630", 0.00063456, "0.000635"),
    ],
)
def test_written_alike(old, value, new):
    assert like(old, value) == new


PAGE = data("numbers/page.txt")


def test_a_page():
    """Every kind of number is found, and those that are stale alone are written anew; a bound so that it holds."""
    given = run("edp/scenes/confined-block.edp -h 10 -tol 1e-12")["newton"]
    page = PAGE.replace(" 5 | 7 ", " | 7 ")
    found = [(old, new) for unit in units(page) for *_, old, new in differing(page, unit)]
    assert found == [("540.0", "541.6"), ("0.1 %", "0.2 %"), ("2e-4", "3e-4"), ("7", str(given)), ("14.1", "13.5")]
    new = renewed(page)
    assert new == page.replace("540.0", "541.6").replace("0.1 %", "0.2 %").replace("2e-4", "3e-4").replace(
        "14.1", "13.5"
    ).replace("| 7 |", f"| {given} |")


# ---------------------------------------------------------------- campaigns

SAMPLED = ["paper", "newton-map", "counts-map", "other-laws", "same-answer", "laws", "counts-space"]
SAMPLED += ["accuracy", "hertz", "asked"]
SECONDS = ("CPU s", "cost ratio")


def cells(text):
    """The rows of a table without seconds, its head first."""
    rows = [[cell.strip() for cell in line.strip("|").split("|")] for line in text.splitlines() if line[:1] == "|"]
    kept = [place for place, word in enumerate(rows[0]) if word not in SECONDS]
    return [[row[place] for place in kept] for row in rows]


def as_if(item, further):
    """The row of a case that has not been run: sevens."""
    summary = dict.fromkeys([*campaign.COUNTS, *campaign.RESULTS, "costRatio"], 7)
    seconds = dict.fromkeys("total mesh assembly factorisation contact".split(), 7)
    row = campaign.row_of(item, [campaign.Outcome(0, 7, 7, 7, "", {**summary, "seconds": seconds})])
    return {name: "" if value is None else str(value) for name, value in {**row, **dict.fromkeys(further, 7)}.items()}


@pytest.mark.parametrize("name", cases_of(["paper", "newton-map"], SAMPLED))
def test_sample_of_a_campaign(name, tmp_path):
    """Six of the runs that a table is made of, three of a short test, shall give the cells that stand there."""
    file, made = tables.TABLES[name]

    def filled(rows):
        return [row for row in cells(made(rows))[2:] if any(row[1:])]

    part = bench.PARTS.get(file.removeprefix("bench/"), (0, stability.COLUMNS, stability.measure))
    items = [item for item in tables.LISTS[file](ROOT) if filled([as_if(item, part[1])])]
    items = sorted(items, key=lambda item: item.weight)[: max(3, len(items) // 2)]
    drawn = random.Random(name).sample(items, min(len(items), 6 if name in SAMPLED[3:] else 3))
    drawn = [dataclasses.replace(item, repeats=1) for item in drawn]
    more = {"table.csv": stability.law_table()} if "stability" in file else bench.FILES.get(name, lambda _: None)(ROOT)
    fresh = filled(campaign.run(drawn, tmp_path / "rows.csv", 2, part[1], part[2], files=more))
    (written,) = [cells(m[3]) for page in tables.DOCUMENTS for m in tables.MARKED.finditer(TEXTS[page]) if m[2] == name]
    assert fresh
    for row in fresh:
        same = [all(new in ("", old) for new, old in zip(row, old, strict=True)) for old in written[2:]]
        assert any(same), row
