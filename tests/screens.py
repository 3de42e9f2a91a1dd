"""Commands of the tutorials and what they print: `make numbers` runs them anew and writes what has changed.

A fenced `sh` block of a page is a script; `# exit code N` in it announces a code other than 0. The fenced `text` block
after it shows its output, whole, or with `...` for what is left out. Scripts of a page run one after the other, in a
copy of the package.
"""

import difflib
import re
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

from freefem import ROOT, TIMEOUT, environment, tree

EDP = ROOT / "edp"
TUTORIALS = sorted((EDP / "docs/tutorial").glob("*.md"))
PROGRAMS = [EDP / f"labs/0-algorithm/{name}.md" for name in ("algorithm1", "xnewton")]
PAGES = [*TUTORIALS, *PROGRAMS, *(EDP / f"docs/{name}.md" for name in ("HOW-IT-WORKS", "CHOOSING", "LIMITS", "ERRORS"))]
DONE = 'make() { command make -o .venv/run.stamp -o .venv/dev.stamp -o system -o python "$@"; }\n'
FENCE = re.compile(r"^```(sh|text)\n(.*?)^```$", re.M | re.S)
NUMBER = re.compile(r"[-+]?\d+(?:\.\d+)?(?:e[-+]?\d+)?")
ROUNDING = 1e-6  # numbers below it, and whether there are any, are of this machine


@dataclass
class Script:
    """A block of commands, and where the page shows what they print."""

    text: str
    shown: str | None = None
    place: tuple[int, int] = (0, 0)

    @property
    def code(self):
        return int((re.findall(r"^# exit code (\d+)", self.text, re.M) or ["0"])[0])


def scripts(text):
    """The scripts of a page."""
    found = []
    for fence in FENCE.finditer(text):
        if fence[1] == "sh":
            found.append(Script(fence[2]))
        elif found and found[-1].shown is None:
            found[-1].shown, found[-1].place = fence[2], fence.span(2)
    return found


def package(folder):
    """A copy of the package with its drawing commands."""
    made = tree(folder)
    for name in ("postprocess", ".venv"):
        (made / name).symlink_to(ROOT / name)
    return made


def execute(script, folder):
    """(exit code, output) of a script."""
    done = subprocess.run(
        ["sh", "-e", "-c", DONE + script.text],
        cwd=folder,
        env=environment(),
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        timeout=TIMEOUT,
    )
    # the window program's word where there is no display
    return done.returncode, re.sub(r"^freeglut .*\n", "", done.stdout, flags=re.M)


def words(line):
    """A line without its numbers and gaps."""
    return " ".join(NUMBER.sub("#", line).split())


def close(shown, printed):
    """Whether a printed number is the shown one: to two in a hundred, or a count to two."""
    away = abs(float(shown) - float(printed))
    return away <= max(0.02 * abs(float(shown)), ROUNDING, 2 * shown.isdigit())


def same(shown, line):
    """Whether a line has the words of the shown one, and its numbers, except times and rounding, to 2 %."""
    if words(shown) != words(line):
        return False
    pairs = zip(NUMBER.findall(shown), NUMBER.findall(line), strict=True)
    timed = "seconds" in line or line.endswith(" s")
    return timed or all(close(*pair) for pair in pairs)


def alike(line, other):
    """How alike the words of two lines are, 0 to 1; 1 if the other one begins with them."""
    return 1 if line and other.startswith(line) else difflib.SequenceMatcher(None, line, other).ratio()


def anew(shown, output):
    """What a page should show: the output's lines, or those nearest to the lines that it shows between its `...`."""
    lines = output.rstrip("\n").split("\n")
    if "...\n" not in shown:
        return "\n".join(lines) + "\n"
    made, at = [], 0
    for line in shown.splitlines():
        if line == "...":
            made.append(line)
            continue
        likeness = [alike(words(line), words(other)) for other in lines[at:]]
        if not likeness or max(likeness) < 0.6:
            raise SystemExit(f"nothing like this line is printed any more: {line}")
        at += likeness.index(max(likeness)) + 1
        made.append(lines[at - 1])
    return "\n".join(made) + "\n"


def differing(shown, new):
    """Whether two texts differ in more than times and rounding."""
    old, lines = shown.splitlines(), new.splitlines()
    return len(old) != len(lines) or not all(same(*pair) for pair in zip(old, lines, strict=True))


def outputs(page, folder):
    """(script, what its page should show) of each script; a wrong exit code ends it."""
    for script in scripts(page.read_text()):
        code, output = execute(script, folder)
        assert code == script.code, f"{page.name}: {script.text}exit code {code}\n{output[-3000:]}"
        yield script, None if script.shown is None else anew(script.shown, output)


def write(page):
    """Writes the screens of a page that have changed."""
    with tempfile.TemporaryDirectory() as folder:
        found = list(outputs(page, package(Path(folder, "package"))))
    text = page.read_text()
    for script, new in reversed(found):
        if new is not None and differing(script.shown, new):
            start, end = script.place
            text = text[:start] + new + text[end:]
            print(f"{page.relative_to(ROOT)}: {script.text.splitlines()[0]}", file=sys.stderr)
    page.write_text(text)


if __name__ == "__main__":
    for path in [Path(name).resolve() for name in sys.argv[1:]] or PAGES:
        write(path)
