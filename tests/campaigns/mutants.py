"""Small errors in the scripts, and whether a default test sees them: mutants.py [COUNT] [again] [FOLDER/].

Statements that the short runs of SCENES and PARTS execute are drawn by a seed, and one thing in each is changed: a
sign, a factor, a term left out, an index, a comparison, an earlier stop. It is no mutant if FreeFEM does not read it,
or if no result of these runs differs by more than TOLERANCE of its scale; what moves only counts or words is kept
apart. On the others the tests run that execute the statement, until one fails: those of `make test`, quick ones first,
then the others. Which those are `choose.py measure` has found for these sources.
A row each in results/mutants/, in a file for these sources, where the campaign goes on; `again` repeats those that
survived; FOLDER/: only statements below edp/FOLDER/, in a file of its own. Not drawn: programs in sh and awk, labs,
plugins. JOBS: how many at a time, 2. SEED: of the draw.
"""

import csv
import json
import os
import random
import re
import shutil
import subprocess
import sys
import time
from collections import Counter, defaultdict
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import choose
import same
from campaign import FREEFEM, RESULTS_FOLDER, ROOT, script_of, sources_digest
from executed import STRING, copy_tree, instrument, programs, take_marks

FOLDER = RESULTS_FOLDER / "mutants"
COLUMNS = "number file line kind old new state by seconds".split()
JOBS = int(os.environ.get("JOBS", "2"))
SEED = os.environ.get("SEED", "53")
TOLERANCE = 1e-7
NO_RESULT = re.compile(  # counts, and words
    r"\.(adaptations|newton\w*|factorisations|backsolves|iterations|kernelNewton|estimates\.backsolves|used|rounds|"
    r"warnings|message|notEstimated|estimates\.(refine|wasted|worst))\b"
)
TEST_SECONDS = 1500  # of a mutant's tests: what takes longer stays open
SCENES = """disc-on-block -h 1
disc-on-block -h 1 -order 1 -method paper
disc-on-block -h 1 -geometry axisymmetric -force 80
disc-on-block -h 1 -geometry stress -law exponential
disc-on-block -h 1 -order 1 -method linesearch -kappa 1e6 -estimate 0
disc-on-block -h 1 -law barrier -order 4
disc-on-block -h 1 -distance exact
disc-on-block -h 1 -accuracy 3e-2
disc-on-block -h 1 -history 1 -steps 3 -force 80
disc-on-block -h 1 -bodyForce 0.1 -traction 0.2 -maxNewton 2
disc-on-block -h 1 -law table -table pairs.csv
two-cylinders -order 3 -axis 1
meshed-disc -h 1 -distance exact
wavy
sphere-on-block -h 2
two-spheres -h 0.7
two-spheres -h 0.7 -order 1 -distance exact
adhesive-cylinder
adhesive-cylinder -u0 -0.0005 -estimate 0
fretting
wedge""".split("\n")
# an example, its mesh's coarsening, flags, further statements
PARTS = [
    ("pin-in-hole", 3, "", "line a 0 0 0 -20\nline b 0 0 15 3"),
    ("pin-in-hole", 4, "-distance exact -estimate 0", ""),
    ("press-fit", 3, "-order 1", ""),
    ("roller", 4, "-history 1 -steps 2", ""),
    ("shrink-fit", 3, "", ""),
    ("bolted-sleeve", 2, "-history 1 -steps 2", "stresses"),
    ("taper", 3, "", ""),
    ("hip-joint", 3, "", ""),
    ("snap-hook", 4, "-distance exact", ""),
    ("punch", 2, "", ""),
    ("crossed-cylinders", 3, "-order 1", "line a 0 0 0 0 0 -6\nexpand upper 1e-5 20\nstresses"),
]


def commands(folder: Path) -> dict[str, list[str]]:
    """Of every run what follows FreeFEM's own words; its files in `folder`."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "pairs.csv").write_text("".join(f"{s / 20},{1e3 * (s / 20) ** 3!r}\n" for s in range(11)))
    found = {}
    for words in SCENES:
        scene, *flags = words.replace("pairs.csv", str(folder / "pairs.csv")).split()
        found[re.sub(r"\W+", "-", words)] = [script_of(scene), *flags, "-vtu", "0"]
    for example, coarser, flags, added in PARTS:
        name = re.sub(r"\W+", "-", f"{example} {flags}".strip())
        geo, case = ((ROOT / f"edp/examples/{example}/{example}.{kind}").read_text() for kind in ("geo", "case"))
        (folder / f"{name}.geo").write_text(f"{geo}\nMesh.MeshSizeFactor = {coarser};\n")
        (folder / f"{name}.case").write_text(f"{case}\n{added}\n".replace("size     ramp 0.01", "size ramp 0.1"))
        script = script_of("parts-3d" if "crossed" in example else "parts")
        files = ["-mesh", str(folder / f"{name}.geo"), "-case", str(folder / f"{name}.case")]
        found[name] = [script, *files, *flags.split(), "-vtu", "0"]
    return found


# ---------------------------------------------------------------- changes

WORD = r"[\w.]+(?:\([^()]*\)|\[[^\[\]]*\])*"
COMPARED = {"<": ">=", ">": "<=", "<=": "<", ">=": ">", "==": "!=", "!=": "==", "&&": "||", "||": "&&"}
MINUS = {"+": "-", "-": "+"}
CHANGES = [  # kind, pattern, what stands in its place
    ("sign", r" ([+-]) ", lambda m: f" {MINUS[m[1]]} "),
    ("sign", r" ([+-])= ", lambda m: f" {MINUS[m[1]]}= "),
    ("sign", r"(?<=[=,?:] )-(?=\w)|(?<=[(\[])-(?=\w)|(?<=return )-", lambda m: ""),
    ("factor", r" ([*/]) (?=[\w(])", lambda m: f" {m[1]} 2 {m[1]} "),
    ("factor", r"(?<![=!<>]) ([+-]?=) (?!0\b)([^=;{}]+);", lambda m: f" {m[1]} 2 * ({m[2]});"),
    ("factor", r"\breturn (?!0;)([^;?{}]+);", lambda m: f"return 2 * ({m[1]});"),
    ("term", rf" [+-] {WORD}(?:(?: [*/] |\^){WORD})*", lambda m: ""),
    ("term", rf" \* {WORD}", lambda m: ""),
    ("term", rf"(?:^|(?<=\) ))[ ]*{WORD} [+*-]= [^;=]+;", lambda m: ";"),
    ("index", r"(?<=[\[ ])(\d)(?=[\])])", lambda m: str(int(m[1]) + (1 if m[1] == "0" else -1))),
    ("index", r"\[([a-z])\]", lambda m: f"[{m[1]} - ({m[1]} > 0)]"),
    ("comparison", r" (<|>|<=|>=|==|!=|&&|\|\|) ", lambda m: f" {COMPARED[m[1]]} "),
    ("stop", r"(?<=; )(\w+) < ([^;]+);", lambda m: f"{m[1]} < {m[2]} - 1;"),
    ("stop", r"\b1e-(\d+)\b", lambda m: f"1e-{int(m[1]) // 2}"),
]


def in_loop_head(code: str, place: int) -> bool:
    """A change here makes a loop without an end."""
    head = code.rfind("for (", 0, place)
    return head >= 0 and code.count("(", head, place) > code.count(")", head, place)


def draw(number: int, statements: list) -> tuple[str, int, str, str, str]:
    """File, line, kind, the line as it was and as it is."""
    chance = random.Random(f"{SEED} {number}")
    while True:
        file, first, last = chance.choice(statements)
        lines = (ROOT / "edp" / file).read_text().split("\n")
        found = defaultdict(list)
        for line in range(first - 1, last):
            code = STRING.sub(lambda match: '"' * len(match[0]), lines[line]).split("//")[0]
            for kind, pattern, by in CHANGES:
                for match in re.finditer(pattern, code):
                    if '"' not in match[0] and (kind == "stop" or not in_loop_head(code, match.start())):
                        new = lines[line][: match.start()] + by(match) + lines[line][match.end() :]
                        found[kind].append((line, new))
        if found:
            kind = chance.choice(sorted(found))
            line, new = chance.choice(found[kind])
            return file, line + 1, kind, lines[line], new


# ---------------------------------------------------------------- copies of the package


class Tree:
    """One in which lines are changed."""

    def __init__(self, folder: Path, anew: bool = True):
        self.folder = folder
        if anew:
            shutil.rmtree(folder, ignore_errors=True)
            copy_tree(folder)

    def start(self, command: list, log: Path, env: dict) -> int:
        with log.open("w") as output:
            done = subprocess.run(
                ["timeout", *map(str, command)],
                cwd=self.folder,
                env={**os.environ, "OPENBLAS_NUM_THREADS": "1", **env},
                stdin=subprocess.DEVNULL,
                stdout=output,
                stderr=subprocess.STDOUT,
            )
        return done.returncode

    def run(self, name: str, words: list[str], env: dict | None = None) -> tuple[int, str]:
        out = self.folder / "results/same" / name
        shutil.rmtree(out, ignore_errors=True)
        out.mkdir(parents=True)
        log = self.folder / ".run.log"
        code = self.start([120, *FREEFEM, *words, "-out", f"results/same/{name}"], log, env or {})
        text = log.read_text(errors="replace")
        said = text.splitlines()[:1] if code == 10 else []
        (out / "end.json").write_text(json.dumps({"code": code, "said": said, "last": []}))
        return code, text

    def test(self, tests: list[str]) -> list:
        """[test, outcome, seconds] of these tests in this order until one fails."""
        (self.folder / ".tests.json").write_text(json.dumps(tests))
        outcomes = self.folder / ".outcomes"
        outcomes.write_text("")
        env = {"PYTHONPATH": str(self.folder / "tests/campaigns"), "MUTANTS": str(self.folder)}
        files = sorted({test.split("::")[0] for test in tests})
        command = [sys.executable, "-m", "pytest", "-q", "-x", "-p", "mutants", "-p", "no:cacheprovider", "-m", ""]
        base = self.folder / ".base"
        self.start([TEST_SECONDS, *command, "--basetemp", base, *files], base.with_suffix(".log"), env)
        shutil.rmtree(base, ignore_errors=True)
        return [json.loads(line) for line in outcomes.read_text().splitlines()]


def pytest_configure(config):
    """As a plugin of the tests in a copy: a run that goes on for a minute has failed."""
    import freefem

    freefem.TIMEOUT = 60


def pytest_collection_modifyitems(config, items):
    names = json.loads(Path(os.environ["MUTANTS"], ".tests.json").read_text())
    if names:
        place = {name: at for at, name in enumerate(names)}
        items[:] = sorted((item for item in items if item.nodeid in place), key=lambda item: place[item.nodeid])


def pytest_runtest_logreport(report):
    if report.when == "call" or report.outcome != "passed":
        with Path(os.environ["MUTANTS"], ".outcomes").open("a") as file:
            file.write(json.dumps([report.nodeid, report.outcome, report.duration]) + "\n")


def executed(runs: dict[str, list[str]]) -> tuple[list, dict[str, list], dict[str, set]]:
    """Statements, those of each run, and those of each test in the order in which tests are tried."""
    kept, digest = FOLDER / "executed.json", sources_digest(ROOT)
    found = json.loads(kept.read_text()) if kept.exists() else {}
    if found.get("sources") != digest:
        tree, plain = Tree(FOLDER / "marked"), Tree(FOLDER / "plain")
        found = {"sources": digest, "statements": list(map(list, instrument(tree.folder))), "runs": {}}
        env = programs(tree.folder)
        for name, words in runs.items():
            codes = plain.run(name, words)[0], tree.run(name, words, env)[0]
            print(f"{name}: code {codes[0]}, with marks {codes[1]}", flush=True)
            assert codes[0] == codes[1]
            found["runs"][name] = sorted(set().union(*(numbers for _, numbers in take_marks(tree.folder))))
        kept.write_text(json.dumps(found))
    assert choose.statements() == found["statements"], "the sources have changed since choose.py measure"
    tests = [test for test in choose.read_tests()[1] if test.outcome == "passed" and test.statements]
    long = choose.marked((test.name for test in tests), "long")
    tests.sort(key=lambda test: (test.name in long, test.whole))
    return found["statements"], found["runs"], {test.name: test.statements for test in tests}


# ---------------------------------------------------------------- a mutant


def differences(tree: Tree, name: str) -> list[str]:
    mine, other = (folder / "results/same" / name for folder in (tree.folder, FOLDER / "plain"))
    try:
        found = list(same.differences(mine, other))
    except json.JSONDecodeError:  # not a number
        return ["summary.json"]
    for path in sorted(other.glob("*.csv")):
        if path.name not in ("contact.csv", "history.csv", "adaptations.csv"):
            try:
                found += same.column_differences(mine / path.name, path)
            except ValueError:  # words
                found += ["words"] * ((mine / path.name).read_text() != path.read_text())
    return found


def judge(tree: Tree, number: int, pool: list, runs: dict[str, list[str]], known: tuple) -> dict:
    """The row of the mutant of this number."""
    statements, of_runs, of_tests = known
    began = time.time()
    file, line, kind, old, new = draw(number, pool)
    marks = {k for k, (where, first, last) in enumerate(statements) if where == file and first <= line <= last}
    path = tree.folder / "edp" / file
    lines = (ROOT / "edp" / file).read_text().split("\n")
    path.write_text("\n".join([*lines[: line - 1], new, *lines[line:]]))
    meshes = tree.folder / "meshes/generated"  # a mutant's own: it may make wrong ones
    shutil.rmtree(meshes, ignore_errors=True)
    shutil.copytree(FOLDER / "plain/meshes/generated", meshes, copy_function=os.link)
    state = by = "equivalent"
    for name in runs:
        if not marks & set(of_runs[name]):
            continue
        _, text = tree.run(name, runs[name])
        moved = differences(tree, name)
        if re.search("Compile error|Error line number", text):
            state, by = "unread", ""
            break
        if any(not NO_RESULT.match(one) for one in moved):
            state, by = "survived", name
            break
        state = "no result" if moved else state
    if state == "survived":
        tests = [test for test, numbers in of_tests.items() if marks & numbers]
        outcomes = tree.test(tests) if tests else []
        failed = [test for test, outcome, _ in outcomes if outcome == "failed"]
        state = "killed" if failed else "open" if len({row[0] for row in outcomes}) < len(tests) else state
        by = failed[0] if failed else by
    path.write_text("\n".join(lines))
    row = {"number": number, "file": file, "line": line, "kind": kind, "old": old.strip(), "new": new.strip()}
    return row | {"state": state, "by": by, "seconds": round(time.time() - began)}


def main(words: list[str]) -> int:
    same.TOLERANCE = TOLERANCE
    if not (choose.FOLDER / "reached.json").exists():
        print("first, for an hour: python tests/campaigns/choose.py measure", file=sys.stderr)
        return 10
    wanted = next((int(word) for word in words if word.isdigit()), 200)
    below = tuple(word for word in words if word.endswith("/")) or ("",)
    runs = commands(FOLDER / "inputs")
    known = executed(runs)
    pool = [known[0][k] for k in sorted(set().union(*known[1].values()))]
    pool = [one for one in pool if one[0].startswith(below)]
    path = FOLDER / f"{'-'.join([sources_digest(ROOT), *below]).replace('/', '-').strip('-')}.csv"
    rows = list(csv.DictReader(path.open())) if path.exists() else []
    rows = [row for row in rows if "again" not in words or row["state"] not in ("survived", "open")]
    taken = {int(row["number"]) for row in rows}
    trees = [Tree(FOLDER / f"tree-{k}") for k in range(JOBS)]
    number = 0
    with ThreadPoolExecutor(JOBS) as executor:
        while sum(row["state"] in ("killed", "survived") for row in rows) < wanted:
            batch = []
            while len(batch) < JOBS:
                batch += [number] * (number not in taken)
                number += 1
            jobs = [executor.submit(judge, tree, k, pool, runs, known) for tree, k in zip(trees, batch, strict=True)]
            for row in (job.result() for job in jobs):
                rows.append(row)
                print("{number} {state} {file}:{line} {kind}: {new}  [{by}]".format(**row), flush=True)
            with path.open("w", newline="") as file:
                writer = csv.DictWriter(file, COLUMNS)
                writer.writeheader()
                writer.writerows(rows)
    print(
        f"{path}:",
        ", ".join(f"{count} {state}" for state, count in sorted(Counter(row["state"] for row in rows).items())),
    )
    for row in rows:
        if row["state"] in ("survived", "open"):
            print("{state}: edp/{file}:{line} ({kind})\n  - {old}\n  + {new}".format(**row))
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
