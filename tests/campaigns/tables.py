"""The documentation's tables of the campaigns, written from their CSV files: `make tables`.

A table stands in tests/RESULTS.md or tests/COST.md between `<!-- table: NAME -->` and `<!-- end -->`, NAME one of
TABLES; nothing else is touched. One whose CSV is not there, or has not been run whole, is left as it is, and said so:
`--partial` writes it all the same.
"""

import argparse
import re
import sys
from collections.abc import Callable
from pathlib import Path

import bench
import calculix_parts
import campaign
import conditioning
import covered
import models
import peers
import peers_condensed
import peers_whole
import stability

DOCUMENTS = [campaign.ROOT / "tests" / name for name in ("RESULTS.md", "COST.md")]
MARKED = re.compile(r"(<!-- table: (\S+) -->\n)(.*?)(<!-- end -->)", re.S)

Rows = list[dict[str, str]]

# The list of cases of each CSV below results/ that tables are made of: its number of rows when it has been run whole
LISTS: dict[str, Callable[[Path], list[campaign.Case]]] = {
    f"bench/{name}": part[0] for name, part in bench.PARTS.items()
}
LISTS |= {"bench/peers": peers.cases, "stability/stability": stability.cases, "coverage/coverage": covered.cases}
LISTS |= {"coverage/space": covered.cases_in_space, "conditioning/conditioning": conditioning.cases}
LISTS |= {"models/models": models.cases, "bench/condensed": peers_condensed.cases}
LISTS |= {"bench/whole": peers_whole.cases}
LISTS |= {"bench/calculix-parts": calculix_parts.cases}
# name: (CSV below results/, its rows to the table)
TABLES: dict[str, tuple[str, Callable[[Rows], str]]] = {
    "work-precision": ("bench/work_precision", bench.report_work_precision),
    "meshes": ("bench/meshes", bench.meshes_table),
    "accuracy": ("bench/meshes", bench.accuracy_table),
    "orders": ("bench/meshes", bench.orders_table),
    "growth": ("bench/growth", bench.growth_table),
    "exponents": ("bench/growth", bench.exponents_table),
    "cost": ("bench/growth", bench.cost_table),
    "cost-map": ("bench/growth", bench.cost_map),
    "ingredients": ("bench/ingredients", bench.report_ingredients),
    "hertz": ("bench/hertz", bench.hertz_table),
    "large": ("bench/large", bench.large_table),
    "large-laws": ("bench/large", bench.large_laws_table),
    "ranks": ("bench/ranks", bench.ranks_table),
    "asked": ("bench/accuracy", bench.accuracy_runs),
    "peers": ("bench/peers", peers.table),
    "peers-others": ("bench/peers", peers.other_tables),
    "peers-failed": ("bench/peers", peers.failed_table),
    "peers-condensed": ("bench/condensed", peers_condensed.table),
    "peers-whole": ("bench/whole", peers_whole.table),
    "parts": ("bench/calculix-parts", calculix_parts.table),
    "parts-cost": ("bench/calculix-parts", calculix_parts.cost_table),
    "counts": ("stability/stability", stability.parts_table),
    "checks": ("stability/stability", lambda rows: stability.checks_table(stability.checks(rows))),
    "methods": ("stability/stability", stability.methods_table),
    "coverage": ("coverage/coverage", lambda rows: covered.table(covered.judged(rows))),
    "coverage-space": ("coverage/space", lambda rows: covered.table(covered.judged(rows))),
    "conditioning": ("conditioning/conditioning", conditioning.results_table),
    "models": ("models/models", models.table),
    "laws": ("stability/stability", stability.laws_table),
    "paper": ("stability/stability", stability.paper_table),
    "same-answer": ("stability/stability", stability.same_table),
    "counts-map": ("stability/stability", stability.counts_table),
    "newton-map": ("stability/stability", stability.newton_table),
    "other-laws": ("stability/stability", stability.others_table),
    "counts-space": ("stability/stability", stability.space_table),
    "stiffer-disc": ("stability/stability", stability.stiffer_table),
}


def written(text: str, tables: dict[str, str]) -> str:
    """The text with these tables, name to markdown, between their markers; the other markers keep what they have."""

    def replaced(found: re.Match) -> str:
        begin, name, old, end = found.groups()
        if name not in TABLES:
            raise ValueError(f"no such table: {name}; there are: {', '.join(TABLES)}")
        return begin + (tables[name].rstrip("\n") + "\n" if name in tables else old) + end

    return MARKED.sub(replaced, text)


def told(rows: Rows, whole: int) -> str:
    """One line below a table: how many runs, of how many, each how often, of which sources, when, and on what."""
    repeats = sorted({int(row["repeats"]) for row in rows})
    often = " or ".join(map(str, repeats)) + (" repeat" if repeats == [1] else " repeats")
    count = f"{len(rows)} runs" if len(rows) >= whole else f"{len(rows)} of {whole} runs"
    last = rows[-1]
    commits, days = (sorted({row[name] for row in rows}) for name in ("commit", "day"))
    when = f"commit {', '.join(commits)}, {' to '.join(dict.fromkeys((days[0], days[-1])))}"
    return f"*{count}, {often}; {when}; {last['machine']}, {last['cores']} cores, {last['threads']} BLAS thread*."


def main(argv: list[str] | None = None) -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--partial", action="store_true", help="also from a CSV that has not been run whole")
    parser.add_argument("--results", type=Path, default=campaign.RESULTS_FOLDER, help="folder of the CSV files")
    parser.add_argument("--document", type=Path, nargs="+", default=DOCUMENTS, help="the texts that have the markers")
    arguments = parser.parse_args(argv)
    return max([write(document, arguments.results, arguments.partial) for document in arguments.document])


def write(document: Path, results: Path, partial: bool) -> int:
    """The tables of one document; 1 if it names one that is not known."""
    text = document.read_text(encoding="utf-8")
    tables: dict[str, str] = {}
    wanted = [found.group(2) for found in MARKED.finditer(text)]
    for csv in dict.fromkeys(TABLES[name][0] for name in wanted if name in TABLES):
        order = {item.key: place for place, item in enumerate(LISTS[csv](campaign.ROOT))}
        rows = campaign.read_rows(results / f"{csv}.csv")
        rows = sorted(
            (row for row in rows if campaign.key_of(row) in order), key=lambda row: order[campaign.key_of(row)]
        )
        whole = len(order)
        if not rows or (len(rows) < whole and not partial):
            print(f"{csv}.csv: {len(rows)} of {whole} runs: its tables are left as they are", file=sys.stderr)
            continue
        for name in wanted:
            if name in TABLES and TABLES[name][0] == csv:
                tables[name] = f"{TABLES[name][1](rows)}\n\n{told(rows, whole)}"
    try:
        new = written(text, tables)
    except ValueError as error:
        print(f"{document.name}: {error}", file=sys.stderr)
        return 1
    if new != text:
        document.write_text(new, encoding="utf-8")
    print(f"{document.name}: {len(tables)} of {len(wanted)} tables written")
    return 0


if __name__ == "__main__":
    sys.exit(main())
