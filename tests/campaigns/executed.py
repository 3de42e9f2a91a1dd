"""Which statements of the scripts a FreeFEM run executes: `python tests/campaigns/executed.py SCRIPT [FLAGS]`.

`instrument(tree)` puts a mark before each statement that begins a line of a copy's edp/; `programs(tree)` writes the
FreeFem++ that such a copy wants first on PATH: it opens the file that a run's marks go to. `take_marks(tree)` reads
and removes them.
A statement within a line, behind `if (...)` say, counts with its line; macros of one line are not marked.
"""

import os
import re
import shutil
import subprocess
import sys
import tempfile
from collections import Counter
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
LEFT_OUT = {".git", "results", "generated", ".pytest_cache", ".ruff_cache", "__pycache__"}
LINKED = (".venv", ".venv-peers", "build")
HEAD = """IFMACRO(!executedHere)
macro executedHere() 1 //
int[int] executedMark({count});
executedMark = 0;
ofstream executedFile("/dev/fd/9", append);
func int executed(int k)
{{
    executedMark[k] = 1;
    executedFile << "mark " << k << endl;
    return 0;
}}
ENDIFMACRO
"""
PROGRAM = """#!/bin/sh
log={logs}/$$
printf '# %s\\n' "${{READS_FOR:-$PYTEST_CURRENT_TEST}}" > "$log"
exec 9>> "$log"
exec {program} "$@"
"""
STRING = re.compile(r'"(?:\\.|[^"\\])*"')
# What begins a line and is no statement, or one that a mark cannot stand before.
CONTINUED = r"else\b|catch\b|[-+*/?:&|<>=.)\x22{}]|IFMACRO|ENDIFMACRO|include|load|func"
READERS = "readForDimension|readUnless|optionHook|forEachOption|eachOption|withOptions|optionLaws"
NONE = re.compile(rf"({CONTINUED}|{READERS}|macro|\w+#)")
NONE_IN_MACRO = re.compile(rf"({CONTINUED}|varf)")
CALLED_MACRO = re.compile(r"\w+(\([^;]*\))?\s*$")

Statement = tuple[str, int, int]  # file below edp/, first and last line, from 1


def bare(line: str) -> str:
    """A line of code without its comment, strings as long as they were."""
    masked = STRING.sub(lambda match: '"' * len(match[0]), line)
    return masked.split("//")[0]


def mark_statements(text: str, file: str, found: list[Statement]) -> str:
    """The text with marks; appends to `found`."""
    written = []
    in_macro, depth, before = False, 0, ";"
    for number, line in enumerate(text.split("\n"), start=1):
        code = bare(line).strip()
        ends = "//" in STRING.sub("", line)
        opens = line.strip().startswith("macro ") and not in_macro
        begins = bool(code) and depth == 0 and before in ";{}" and not opens
        if in_macro:
            begins = begins and code.endswith(";") and "#" not in code and not NONE_IN_MACRO.match(code)
        else:
            begins = begins and not NONE.match(code) and not CALLED_MACRO.match(code)
        if begins:
            space = len(line) - len(line.lstrip())
            mark = len(found)
            found.append((file, number, number))
            line = f"{line[:space]}if (executedMark[{mark}] == 0) executed({mark}); {line[space:]}"
        elif found and found[-1][0] == file and code:
            found[-1] = (file, found[-1][1], number)
        written.append(line)
        if opens:
            rest = re.sub(r"macro \w+(\([^)]*\))?|IFMACRO.*", "", code).strip()
            in_macro, before = not ends, ";" if ends else (rest or "(")[-1]  # its first may follow a for
            continue
        if in_macro and ends:
            in_macro, depth, before = False, 0, ";"
            continue
        if code and not re.match("IFMACRO|ENDIFMACRO", code):
            depth += sum(code.count(c) for c in "([") - sum(code.count(c) for c in ")]")
            alone = re.match(r"\w+(\([^;=?]*\))?\s*$", code) and depth == 0
            if re.match(r"include\b|load\b|readForDimension", code) or (
                alone and not re.match(r"(else|if|for|while)\b", code)
            ):
                before = ";"
            else:
                before = code[-1]
    return "\n".join(written)


def copy_tree(to: Path) -> Path:
    """The package's files in a folder of their own, its environment and plugins linked."""
    to.mkdir(parents=True)
    for path in ROOT.iterdir():
        if path.name in LINKED:
            (to / path.name).symlink_to(path.resolve())
        elif path.is_dir() and path.name not in LEFT_OUT:
            shutil.copytree(path, to / path.name, ignore=shutil.ignore_patterns(*LEFT_OUT))
        elif path.is_file() and path.name not in LEFT_OUT:
            shutil.copy2(path, to)
    return to


def instrument(tree: Path) -> list[Statement]:
    found: list[Statement] = []
    files = sorted(path for kind in ("idp", "edp") for path in (tree / "edp").rglob(f"*.{kind}"))
    files = [path for path in files if "labs" not in path.parts]
    texts = [mark_statements(path.read_text(), str(path.relative_to(tree / "edp")), found) for path in files]
    for path, text in zip(files, texts, strict=True):
        path.write_text(HEAD.format(count=len(found)) + text)
    return found


def programs(tree: Path) -> dict[str, str]:
    """The environment in which FreeFEM writes down its marks."""
    folder, logs = tree / ".programs", tree / ".executed"
    folder.mkdir()
    logs.mkdir()
    for name in ("FreeFem++", "FreeFem++-mpi"):
        if shutil.which(name):
            (folder / name).write_text(PROGRAM.format(logs=logs, program=shutil.which(name)))
            (folder / name).chmod(0o755)
    return marking(tree)


def marking(tree: Path) -> dict[str, str]:
    return {**os.environ, "PATH": f"{tree / '.programs'}:{os.environ['PATH']}", "OPENBLAS_NUM_THREADS": "1"}


def take_marks(tree: Path) -> list[tuple[str, set[int]]]:
    """Of each run the test that started it and its statements' numbers."""
    runs = []
    for log in sorted((tree / ".executed").iterdir()):
        head, *lines = log.read_text().splitlines()
        # programs that a run calls may write to the same number of a file
        numbers = (re.fullmatch(r"mark (\d+)", line) for line in lines)
        runs.append((head[2:], {int(number[1]) for number in numbers if number}))
        log.unlink()
    return runs


def main(words: list[str]) -> int:
    with tempfile.TemporaryDirectory() as folder:
        tree = copy_tree(Path(folder).resolve() / "tree")
        statements, environment = instrument(tree), programs(tree)
        command = ["FreeFem++", "-nw", "-v", "0", *words, "-out", str(tree / "out")]
        code = subprocess.run(command, cwd=tree, env=environment, stdout=subprocess.DEVNULL).returncode
        hit = set().union(*(marks for _, marks in take_marks(tree)))
    every = Counter(file for file, _, _ in statements)
    done = Counter(statements[mark][0] for mark in hit)
    for file in sorted(done):
        print(f"{done[file]:5} of {every[file]:5}  {file}")
    print(f"exit code {code}; {len(hit)} statements of {sum(every[file] for file in done)} in {len(done)} files")
    return code


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
