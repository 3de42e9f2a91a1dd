"""Which tests `make test` and `.ci/run` run: `choose.py measure` finds what each costs and reaches, `choose.py` takes.

Measuring runs every test once in a copy of the package with a mark before each statement of the scripts (executed.py);
lines of Python are recorded by the package coverage (pip install coverage). It takes an hour on two cores. Results are
in results/choice/. Words behind `measure` go to pytest: a few test files, to try it.

Choosing takes, per CPU second, the tests that reach most, until the budget is used. A line of a script or of Python
counts again, for less, when further tests reach it: an error that one test does not see may change a number that
another checks. Tests that see no number of a run count for Python alone. What tests share is paid for once. The others
are named in tests/long.txt, one a line: a test, or a function with all its cases. The same choice, with a larger budget
and other weights, leaves the dearest of these to `make test-all`: tests/nightly.txt names them.
"""

import heapq
import json
import os
import re
import shutil
import subprocess
import sys
from collections import defaultdict
from pathlib import Path
from typing import NamedTuple

from executed import copy_tree, instrument, programs, take_marks

ROOT = Path(__file__).resolve().parents[2]
FOLDER = Path(os.environ.get("CONTACT_RESULTS") or ROOT / "results").absolute() / "choice"
PYTHON = 0.5  # a line of Python, over a statement of the scripts


class Choice(NamedTuple):
    budget: int  # default runs of the tests' own; collecting and starting the workers come on top
    worth: tuple  # of a line that is reached for the first time, the second, ...
    function: float  # a test function of which no case has been taken
    test: float  # a test that reaches nothing new


QUICK = Choice(520, (1.0, 0.4, 0.2, 0.1), 3.0, 0.0)
GATE = Choice(9_800, (30.0, 0.4, 0.2, 0.1), 30.0, 1.0)  # of .ci/run, the quick tests among them: no line is lost
SEE_NO_NUMBER = re.compile(  # of a run: tests of files, pages, pictures and words
    "campaign|contracts|foreign|hertz_figures|hostile_meshes|house|interface|kit|lint_edp|makefile|meaning|movie_report|"
    "notebooks|options|paraview|pictures|places|play|postprocess|readme|refusals|scene_docs|scene_figures|site|surroundings"
)
COVERAGE = """[run]
source = postprocess
data_file = {folder}/python
parallel = true
context = ${{READS_FOR-none}}
"""


# ---------------------------------------------------------------- measuring


def pytest_configure(config):
    """As a plugin of the tests in the copy: lines of Python are recorded for the test that reaches them."""
    import accounts
    import coverage

    plain = accounts.Frame.tell

    def tell(frame):
        plain(frame)
        recorder = coverage.Coverage.current()
        if recorder:
            recorder.switch_context(frame.label)

    accounts.Frame.tell = tell


def measure(chosen: list[str]) -> None:
    shutil.rmtree(FOLDER, ignore_errors=True)
    tree = copy_tree(FOLDER / "tree")
    shutil.copytree(ROOT / ".git", tree / ".git", dirs_exist_ok=True)
    statements = instrument(tree)
    (FOLDER / "statements.json").write_text(json.dumps(statements))
    (FOLDER / "coveragerc").write_text(COVERAGE.format(folder=FOLDER))
    env = programs(tree) | {"ACCOUNTS": str(FOLDER / "accounts"), "COVERAGE_PROCESS_START": str(FOLDER / "coveragerc")}
    env |= {"PYTHONPATH": f"{tree / 'tests/campaigns'}:{tree / 'tests'}"}
    words = ["long or not long", "-p", "choose", "-p", "no:cacheprovider", "--basetemp", str(FOLDER / "base")]
    subprocess.run([sys.executable, "tests/run.py", *words, *chosen], cwd=tree, env=env)
    reached = defaultdict(set)
    for label, numbers in take_marks(tree):
        reached[label] |= numbers
    (FOLDER / "reached.json").write_text(json.dumps({label: sorted(numbers) for label, numbers in reached.items()}))


def reached_python() -> dict[str, set]:
    """By label: the lines of Python that it reaches."""
    import coverage

    data = coverage.Coverage(config_file=str(FOLDER / "coveragerc"))
    data.combine(keep=True)
    found = defaultdict(set)
    for file in data.get_data().measured_files():
        for line, contexts in data.get_data().contexts_by_lineno(file).items():
            for context in contexts:
                found[context.split("|")[-1]].add((file, line))
    return found


# ---------------------------------------------------------------- choosing


class Test:
    """What a test costs and reaches, itself and by what it shares with others."""

    def __init__(self, name, every, scripts, python):
        row = every[name]
        self.name, self.cpu, self.outcome, self.uses = name, row["cpu"], row["outcome"], closure(row["uses"], every)
        self.whole = self.cpu + sum(every[label]["cpu"] for label in self.uses)
        labels = {name, *self.uses}
        blind = SEE_NO_NUMBER.search(name.split("::")[0].split("/")[-1].removeprefix("test_"))
        self.statements = set() if blind else {k for label in labels for k in scripts.get(label, ())}
        self.reaches = {("s", k) for k in self.statements}
        self.reaches |= {("p", *line) for label in labels for line in python.get(label, ())}
        self.function = name.split("[")[0]


def closure(uses, every) -> set:
    found = set()
    for label in uses:
        if label not in found and label in every:
            found |= {label} | closure(every[label]["uses"], every)
    return found


def read_tests() -> tuple[dict, list]:
    """Rows of all labels, those of several workers added up; the tests."""
    every = {}
    for line in (FOLDER / "accounts").read_text().splitlines():
        row = json.loads(line)
        if row["label"].startswith("module "):
            continue
        known = every.setdefault(row["label"], row)
        if known is not row:
            known["uses"] = sorted({*known["uses"], *row["uses"]})
            known["cpu"] = max(known["cpu"], row["cpu"])
    scripts = {label: set(numbers) for label, numbers in json.loads((FOLDER / "reached.json").read_text()).items()}
    python = reached_python()
    names = [name for name in every if "::" in name and not name.startswith(("fixture ", "run ", "call "))]
    return every, [Test(name, every, scripts, python) for name in names]


def choose(every: dict, tests: list, choice: Choice, unit: float, first=frozenset()) -> set[str]:
    """Names of the tests to take, those of `first` among them; `unit`: CPU seconds of a default run."""
    count, taken, paid, functions = defaultdict(int), set(), set(), set()
    spent = 0.0

    def gain(test) -> float:
        found = choice.test + choice.function * (test.function not in functions)
        for line in test.reaches:
            if count[line] < len(choice.worth):
                found += choice.worth[count[line]] * (PYTHON if line[0] == "p" else 1.0)
        return found

    def cost(test) -> float:
        return max(test.cpu + sum(every[label]["cpu"] for label in test.uses - paid), 1e-3)

    def take(test) -> None:
        nonlocal spent, paid
        spent += cost(test)
        paid |= test.uses
        taken.add(test.name)
        functions.add(test.function)
        for line in test.reaches:
            count[line] += 1

    for test in tests:
        if test.name in first:
            take(test)
    others = [k for k, test in enumerate(tests) if test.outcome == "passed" and test.name not in first]
    heap = [(-gain(tests[k]) / cost(tests[k]), k) for k in others]
    heapq.heapify(heap)
    while heap:
        _, k = heapq.heappop(heap)
        test = tests[k]
        price, worth = cost(test), gain(test)
        if worth == 0 or spent + price > choice.budget * unit:
            continue
        if heap and worth / price < -heap[0][0]:  # others have taken what it reaches
            heapq.heappush(heap, (-worth / price, k))
            continue
        take(test)
    lines = {line for test in tests for line in test.reaches}
    for kind, word in (("s", "statements of the scripts"), ("p", "lines of Python")):
        some = [line for line in lines if line[0] == kind]
        print(f"{sum(count[line] > 0 for line in some)} of {len(some)} {word}")
    print(f"{len(taken)} of {len(tests)} tests, {spent:.0f} CPU s")
    return taken


def statements() -> list:
    """As executed.py numbers them."""
    return json.loads((FOLDER / "statements.json").read_text())


def marked(names, kind: str) -> set[str]:
    """Those of these tests that tests/KIND.txt names."""
    named = set((ROOT / f"tests/{kind}.txt").read_text().splitlines())
    return {name for name in names if name in named or name.split("[")[0] in named}


def write(tests: list, taken: set[str], kind: str) -> None:
    """The tests that are not taken; what has not been measured, or failed in the copy, stays where it is."""
    cases, before = defaultdict(list), set((ROOT / f"tests/{kind}.txt").read_text().splitlines())
    measured = {test.name for test in tests}
    left = {test.name for test in tests if test.outcome == "passed"} - taken
    left |= marked((test.name for test in tests if test.outcome != "passed"), kind)
    for test in tests:
        cases[test.function].append(test.name)
    lines = {name for name in before - measured if name not in cases}
    for function, names in cases.items():
        lines |= {function} if left.issuperset(names) else left.intersection(names)
    (ROOT / f"tests/{kind}.txt").write_text("".join(f"{line}\n" for line in sorted(lines)))


def main(words: list[str]) -> int:
    if words[:1] == ["measure"]:
        measure(words[1:])
        return 0
    if not (FOLDER / "reached.json").exists():
        print("first: python tests/campaigns/choose.py measure", file=sys.stderr)
        return 10
    every, tests = read_tests()
    unit = float(next((word for word in words if word[0].isdigit()), 0.25))
    quick = choose(every, tests, QUICK, unit)
    write(tests, quick, "long")
    write(tests, choose(every, tests, GATE, unit, quick), "nightly")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
