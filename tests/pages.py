"""Writes what the pages say of the sources: `make pages`.

The lines between `<!-- NAME: make pages -->` and `<!-- end -->` are tables made from the first lines of the sources.
"""

import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
EDP = ROOT / "edp"
FOLDERS = re.findall(r"^\| `(\w+)/` \|", (EDP / "README.md").read_text(), re.M)  # as data goes
EXAMPLES = ["scenes/slurm.sh"]
BLOCK = re.compile(r"(<!-- (\w+): make pages -->\n).*?(<!-- end -->)", re.S)


def sources(suffix):
    """The sources in the order of the folders, those of a folder before those of its folders."""
    names = [str(path.relative_to(EDP)) for path in EDP.rglob(f"*{suffix}")]
    order = {folder: number for number, folder in enumerate(FOLDERS)}
    return sorted(
        set(names) - set(EXAMPLES), key=lambda name: (order.get(name.split("/")[0], -1), name.count("/"), name)
    )


def table(kind, names):
    """A row a source: its name and what its first line says."""
    rows = [f"| {kind} | what it does |", "|---|---|"]
    for name in names:
        first = (EDP / name).read_text().split("\n")[0]
        rows.append(f"| `{name}` | {re.sub(r': sh .*', '', first.split(': ', 1)[1])} |")
    return "\n".join(rows) + "\n"


EACH = re.compile(r"^macro (?:each|more)Option\(do, what\) (.*?)//", re.M | re.S)


def reads(script):
    """The options that a script of edp/ reads: by its own line, or by that of a script that it includes."""
    text = (EDP / script).read_text()
    own = re.findall(r"do\((\w+), what\)", "".join(EACH.findall(text)))
    inner = re.findall(r'^include "((?:scenes/)?[\w-]+\.edp)"', text, flags=re.M)
    return set(own).union(*map(reads, inner))


def scripts():
    """{scene: its script}."""
    found = {path.stem: str(path.relative_to(EDP)) for path in sorted(EDP.glob("scenes/*.edp"))}
    found["disc-on-block-ipopt"] = "scenes/ipopt/disc-on-block.edp"
    return {"disc-on-block": "main.edp", **found, "parts": "parts.edp", "parts-3d": "parts-3d.edp"}


def options():
    """A row an option: what the first line of its first file says, and who reads it."""
    rows = ["| option | what it does | read by |", "|---|---|---|"]
    every = {scene: reads(script) for scene, script in scripts().items()}
    for folder in sorted(path for path in (EDP / "options").iterdir() if path.is_dir()):
        name = folder.name
        first = (folder / f"{name}.idp").read_text().split("\n")[0].split(": ", 1)[1]
        by = [f"`{scene}`" for scene in every if name in every[scene]]
        rows.append(f"| `{name}` | {first} | {', '.join(by) if len(by) < len(every) else 'all'} |")
    return "\n".join(rows) + "\n"


TABLES = {
    "modules": lambda: table("module", sources(".idp")),
    "options": options,
    "programs": lambda: table("program", sources(".sh")),
}


def written(text):
    """A page with its tables made anew."""
    return BLOCK.sub(lambda found: found[1] + "\n" + TABLES[found[2]]() + "\n" + found[3], text)


def stale():
    """The pages whose tables are not those of the sources: their new texts."""
    texts = {page: page.read_text() for page in EDP.glob("*.md")}
    return {page: new for page, text in texts.items() if (new := written(text)) != text}


if __name__ == "__main__":
    for page, text in stale().items():
        page.write_text(text)
        print(page.relative_to(ROOT), file=sys.stderr)
