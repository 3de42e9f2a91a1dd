"""The page "One Newton step, file by file": `python tests/campaigns/newton_step.py` writes edp/docs/newton-step.md.

A copy of the scripts in which each function writes down its name solves the paper's test; a Newton step's calls and
the path of one contact pressure, from the mesh to its ±, are read off and put into the page's tables.
"""

import re
import subprocess
import sys
import tempfile
from pathlib import Path

import executed

ROOT = executed.ROOT
PAGE = ROOT / "edp/docs/newton-step.md"
RUN = ["edp/main.edp", "-h", "1"]
HEAD = """IFMACRO(!callsWritten)
macro callsWritten() 1 //
ofstream callFile("/dev/fd/9", append);
func int called(int k) { callFile << "call " << k << endl; return 0; }
ENDIFMACRO
"""
FUNCTION = re.compile(r"^func [^\n(]*?(\w+)\(.*\)", re.M)
BLOCK = re.compile(r"(<!-- (\w+): make numbers -->\n).*?(<!-- end -->)", re.S)
Function = tuple[str, str]  # file below edp/, name
# what the path of a pressure is made of: what each of these functions gives, in the order of a run
PATH = {
    "gmshMesh": "the mesh of the body",
    "discretise": "stiffness K, loads, contact points with weights and initial overlaps",
    "createContactPoints": "positions, normals and weights of the contact points",
    "setInitialThresholds": "the first threshold τ of each point",
    "startOnSurrogate": "the first contact forces, on a half-plane in place of the bodies",
    "computeForceOverlap": "C q: the overlaps that the contact forces take up in the bodies",
    "solveCondensed": "the contact forces q of the linearised problem",
    "computeMultiplier": "pressures, multipliers λ at the wall, status of each point",
    "linearise": "s, p, p′ and the status for the next linear problem",
    "updateThreshold": "the next thresholds τ, eq. (6), and the model error, eq. (7)",
    "computeDisplacement": "the displacement of the bodies under loads and contact forces",
    "measureContactSizes": "forces, contact lengths, greatest pressure",
    "solveAdjoint": "the adjoint solution for a result",
    "estimateErrors": "± of each result",
}


def description(text: str, name: str) -> str:
    """The first sentence that describes a function, below its first line or behind it."""
    lines = iter(text[re.search(rf"^func [^\n(]*\b{name}\(", text, re.M).start() :].split("\n"))
    line = next(lines)
    while not re.search(r"\)\s*(\{.*)?(//.*)?$", line):
        line = next(lines)
    words = re.findall(r"\}\s*//\s*(.*)", line)
    for line in lines:
        if not line.startswith("//"):
            break
        words.append(line.removeprefix("//").strip())
    return re.split(r"(?<=[.;]) ", " ".join(words))[0].rstrip(":;")


def instrument(tree: Path) -> list[Function]:
    """Marks each function of a copy's edp/; their files and names by number."""
    found: list[Function] = []

    def marked(path: Path, text: str) -> str:
        def one(match: re.Match) -> str:
            found.append((path.relative_to(tree / "edp").as_posix(), match[1]))
            return f"{match[2]}{{ called({len(found) - 1});"

        return re.sub(r"^(?=func )(?=func [^\n(]*?(\w+)\()(.*(?:\n[ ]+[^\n{]*|\n//.*)*?\s*)\{", one, text, flags=re.M)

    for path in sorted((tree / "edp").rglob("*.idp")):
        if "labs" not in path.parts and "without" not in path.parts:
            path.write_text(HEAD + marked(path, path.read_text()))
    return found


def calls() -> list[Function]:
    """The functions in the order in which a run of the paper's test calls them."""
    with tempfile.TemporaryDirectory() as folder:
        tree = executed.copy_tree(Path(folder).resolve() / "tree")
        functions, environment = instrument(tree), executed.programs(tree)
        command = ["FreeFem++", "-nw", "-v", "0", *RUN, "-vtu", "0", "-out", str(tree / "out")]
        done = subprocess.run(command, cwd=tree, env=environment, stdout=subprocess.PIPE, text=True, check=False)
        if done.returncode:
            raise SystemExit(f"the run ends with code {done.returncode}: {done.stdout[-500:]}")
        lines = [line for log in sorted((tree / ".executed").iterdir()) for line in log.read_text().splitlines()]
    return [functions[int(line.split()[1])] for line in lines if line.startswith("call ")]


def one_step(every: list[Function]) -> list[Function]:
    """The calls of the last whole Newton step: from solveLinearised() to the question whether another one is needed."""
    names = [name for _, name in every]
    end = len(names) - 1 - names[::-1].index("needsNewtonStep")
    begin = end - 1 - names[:end][::-1].index("solveLinearised")
    return every[begin : end + 1]


def row(function: Function, gives: str = "") -> str:
    file, name = function
    words = gives or description((ROOT / "edp" / file).read_text(), name)
    return f"| `{name}` | `{file}` | {words.replace('|', chr(92) + '|')} |"


def tables() -> dict[str, str]:
    """The tables of the page by name."""
    every = calls()
    step = list(dict.fromkeys(one_step(every)))
    path = [(function, PATH[function[1]]) for function in dict.fromkeys(every) if function[1] in PATH]
    files = len({file for file, _ in step}), len({file for (file, _), _ in path})
    head = "| function | file | {} |\n|---|---|---|\n"
    return {
        "step": f"{len(step)} functions in {files[0]} files, in the order of their first calls:\n\n"
        + head.format("what it does") + "\n".join(map(row, step)) + "\n",
        "path": f"{len(path)} functions in {files[1]} files:\n\n"
        + head.format("what it gives") + "\n".join(row(*one) for one in path) + "\n",
    }  # fmt: skip


def written(text: str) -> str:
    made = tables()
    return BLOCK.sub(lambda found: f"{found[1]}\n{made[found[2]]}\n{found[3]}", text)


def main() -> int:
    text = PAGE.read_text()
    if (new := written(text)) != text:
        PAGE.write_text(new)
        print(PAGE.relative_to(ROOT))
    return 0


if __name__ == "__main__":
    sys.exit(main())
