"""Writes what the pages say of the programs: `make pages`.

The lines between `<!-- NAME: make pages -->` and `<!-- end -->` are tables: of the sources' first lines, of what -help
prints, of what a few short runs leave in their files, of a case file's grammar. What keys, columns and statements mean
is kept, and what they are is written anew; one that is in no row gets one without meaning.
"""

import html
import json
import os
import re
import subprocess
import sys
import tempfile
from collections import Counter
from concurrent.futures import ThreadPoolExecutor
from functools import cache
from pathlib import Path

from house import test_contracts

ROOT = Path(__file__).resolve().parent.parent
EDP = ROOT / "edp"
FOLDERS = re.findall(r"^\| `(\w+)/` \|", (EDP / "README.md").read_text(), re.M)  # as data goes
OPTION_FILES = dict(
    re.findall(r'^macro (\w+)File\(\) include "([\w/-]+\.idp)"', (EDP / "input/hooks.idp").read_text(), re.M)
)
EXAMPLES = ["scenes/slurm.sh"]
EVERYWHERE = "input/flags", "input/texts", "input/hooks", "input/scene", "contact/points/points", "fem/elasticity"
FLOW = EDP / "docs/flow.svg"  # where data goes
PAGES = [EDP / "docs/modules.md", EDP / "input/README.md"]
PAGES += [EDP / f"docs/reference/{name}.md" for name in ("flags", "flags-of-scenes", "output-files")]
BLOCK = re.compile(r"(<!-- (\w+): make pages -->\n).*?(<!-- end -->)", re.S)


def sources(suffix):
    """The sources in the order of the folders, those of a folder before those of its folders."""
    names = [str(path.relative_to(EDP)) for path in EDP.rglob(f"*{suffix}")]
    order = {folder: number for number, folder in enumerate(FOLDERS)}
    return sorted(
        set(names) - set(EXAMPLES), key=lambda name: (order.get(name.split("/")[0], -1), name.count("/"), name)
    )


def option_of(name):
    """The option whose folder holds a file of edp/, of two the inner one; "" for the core."""
    holders = {file.rsplit("/", 1)[0] + "/": option for option, file in OPTION_FILES.items()}
    inside = [folder for folder in holders if name.startswith(folder)]
    return holders[max(inside, key=len)] if inside else ""


def table(kind, names):
    """A row a source: its name and what its first line says."""
    rows = [f"| {kind} | what it does |", "|---|---|"]
    for name in names:
        first = (EDP / name).read_text().split("\n")[0]
        rows.append(f"| `{name}` | {re.sub(r': sh .*', '', first.split(': ', 1)[1])} |")
    return "\n".join(rows) + "\n"


def modules():
    """A row a module: its name, its first line, and the modules that it uses, but those that nearly all use."""
    taken = test_contracts.taken()
    rows = table("module", sources(".idp")).splitlines()
    for number, row in enumerate(rows[2:], 2):
        used = sorted(path[:-4] for path in taken[row.split("`")[1]] if path.endswith(".idp"))
        rows[number] = f"{row} {', '.join(path for path in used if path not in EVERYWHERE)} |"
    return "\n".join([f"{rows[0]} uses |", "|---|---|---|", *rows[2:]]) + "\n"


def relations(name):
    """The names that a module uses of which others, and which others use of it, a line each."""
    taken = test_contracts.taken()
    uses = [f"uses {other}: {', '.join(sorted(words))}" for other, words in sorted(taken[name].items())]
    return uses + [
        f"used by {other}: {', '.join(sorted(of[name]))}" for other, of in sorted(taken.items()) if name in of
    ]


EACH = re.compile(r"^macro (?:eachOption|moreOptions|inSpace)\(do, what\) (.*?)//", re.M | re.S)


def reads(script, space=False):
    """The options that a script of edp/ reads: by its own line, or by that of a script that it includes."""
    text = (EDP / script).read_text()
    space = space or "macro threeDimensional" in text
    without = "!" if space else ""
    text = re.sub(rf"^IFMACRO\({without}threeDimensional\)\n.*?^ENDIFMACRO\n", "", text, flags=re.M | re.S)
    own = re.findall(r"(?:do\(|ifRequested\()(\w+), (?:do, )?what\)", "".join(EACH.findall(text)))
    inner = re.findall(r'^include "((?:scenes/)?[\w-]+\.edp)"', text, flags=re.M)
    return set(own).union(*(reads(name, space) for name in inner))


def scripts():
    """{scene: its script}."""
    found = {path.stem: str(path.relative_to(EDP)) for path in sorted(EDP.glob("scenes/*.edp"))}
    del found["two-bodies"]  # a script that says what became of it
    found["disc-on-block-ipopt"] = "scenes/ipopt/disc-on-block.edp"
    return {"disc-on-block": "main.edp", **found, "parts": "parts.edp", "parts-3d": "parts-3d.edp"}


def options():
    """A row an option: what the first line of its first file says, and who reads it."""
    rows = ["| option | file | what it does | read by |", "|---|---|---|---|"]
    every = {scene: reads(script) for scene, script in scripts().items()}
    for name, file in sorted(OPTION_FILES.items()):
        first = (EDP / file).read_text().split("\n")[0].split(": ", 1)[1]
        by = [f"`{scene}`" for scene in every if name in every[scene]]
        rows.append(f"| `{name}` | `{file}` | {first} | {', '.join(by) if len(by) < len(every) else 'all'} |")
    return "\n".join(rows) + "\n"


# ---------------------------------------------------------------- flags

BODIES, SCHEME = "bodies and load", "method, discretisation, results"
SECTIONS = {
    "scenes": BODIES,
    "contact/laws": "law",
    "contact": BODIES,
    "fem": BODIES,
    "input": SCHEME,
    "solver": SCHEME,
}
TOPICS = {  # headings of the page
    BODIES: "Bodies, mesh and load of the scenes",
    "law": "Contact law",
    SCHEME: "Method, elements and results",
    "option `adhesion`": "Adhesion",
    "option `estimates`": "Error estimates",
    "option `friction`": "Friction of the scenes",
    "option `meshes`": "New meshes",
    "option `parts`": "Your own model",
    "option `pictures`": "Pictures and files for ParaView",
}
FLAG = re.compile(r'(?:number|count|word|text)Flag\("(-[\w-]+)"')


def freefem(script, *flags):
    """What a script of edp/ prints."""
    command = ["FreeFem++", "-nw", "-v", "0", f"edp/{script}", *flags]
    environment = {**os.environ, "OPENBLAS_NUM_THREADS": "1"}
    done = subprocess.run(command, cwd=ROOT, env=environment, stdin=subprocess.DEVNULL, capture_output=True, text=True)
    if done.returncode:
        raise RuntimeError(f"{' '.join(command)}: {done.stdout}")
    return done.stdout


def told(script, *flags):
    """{flag: (default, unit, meaning, allowed)} as -help prints them beside other flags."""
    found = {}
    lines = freefem(script, *flags, "-help", "all").splitlines()
    head = next(line for line in lines if line.startswith("flag "))
    of_default, of_unit, of_meaning = (head.index(word) for word in ("default", "unit", "meaning"))
    for line in lines:
        if line.startswith("-"):
            name, default = line.split()[:2]
            late = max(len(default) + 1 - of_unit + of_default, 0)
            meaning = line[of_meaning + late :]
            depth, opens = 0, len(meaning)  # what is allowed stands in the last parentheses, with others in them
            while depth or opens == len(meaning):
                opens -= 1
                depth += (meaning[opens] == ")") - (meaning[opens] == "(")
            default = "results/SCENE/METHOD" if name == "-out" else default
            found[name] = (
                default,
                line[of_unit + late : of_meaning + late].strip(),
                meaning[:opens].strip(),
                meaning[opens + 1 : -1],
            )
    return found


@cache
def helps():
    """{scene: what -help prints}, {method: the same of the paper's test}; IPOPT's scene wants a plugin."""
    scenes = {scene: script for scene, script in scripts().items() if "ipopt" not in scene}
    methods = told("main.edp")["-method"][3].removeprefix("one of: ").split()
    with ThreadPoolExecutor(2) as pool:
        of_scenes = pool.map(told, scenes.values())
        of_methods = pool.map(lambda method: told("main.edp", "-method", method), methods)
        return dict(zip(scenes, of_scenes, strict=True)), dict(zip(methods, of_methods, strict=True))


@cache
def groups():
    """{words: scenes that have them in common}."""
    texts = {scene: includes(script) for scene, script in scripts().items() if "ipopt" not in scene}
    marks = {"in space": "macro threeDimensional()", "two bodies": "macro deformableMaster()"}
    marks |= {"block": "scenes/blocks/block-flags.idp", "attracting": "do(adhesion, what)"}
    found = {words: {scene for scene in texts if mark in texts[scene]} for words, mark in marks.items()}
    found["case"] = {"parts", "parts-3d"}
    found["in the plane"] = set(texts) - found["in space"]
    found["all"], found["all scenes"] = set(texts), set(texts) - found["case"]
    return {words: scenes for words, scenes in found.items() if scenes}


def includes(script):
    """The text of a script and of those that it includes."""
    text = (EDP / script).read_text()
    inner = re.findall(r'^include "((?:scenes/)?[\w-]+\.edp)"', text, flags=re.M)
    return text + "".join(map(includes, inner))


def covered(scenes):
    """The scenes in words: groups, also without some of theirs, that lie among them, then those that are left."""
    left, said = set(scenes), []

    def gain(group):
        return len(groups()[group] & left) - len(groups()[group] - scenes)

    while gain(best := max(groups(), key=gain)) > 1:
        out = groups()[best] - scenes
        rest = next((f"*{group}*" for group in groups() if groups()[group] == out), named(out))
        said.append(f"*{best}*" + (f" (except {rest})" if out else ""))
        left -= groups()[best]
    return ", ".join([*said, named(left)] if left else said)


def named(scenes):
    return ", ".join(f"`{scene}`" for scene in helps()[0] if scene in scenes)


def usual(values):
    """What the paper's test has, or most scenes."""
    return values.get("disc-on-block", Counter(values.values()).most_common(1)[0][0])


@cache
def declared():
    """{flag: the folders of the files that declare it}."""
    found = {}
    for path in sorted(path for kind in ("idp", "edp") for path in EDP.rglob(f"*.{kind}") if "labs" not in path.parts):
        for flag in FLAG.findall(path.read_text()):
            found.setdefault(flag, []).append(path.relative_to(EDP).as_posix())
    return found


def section_of(flag):
    """Where the flag is declared, in words."""
    places = declared()[flag]
    core = [place for place in places if not option_of(place)]
    found = [
        next((SECTIONS[folder] for folder in SECTIONS if place.startswith(folder + "/")), BODIES) for place in core
    ]
    return BODIES if BODIES in found else found[0] if found else f"option `{option_of(places[0])}`"


def owners():
    """{flag: the methods that have it}, of flags that not all methods have."""
    methods = helps()[1]
    flags = dict.fromkeys(flag for method in methods for flag in methods[method])
    found = {flag: [method for method in methods if flag in methods[method]] for flag in flags}
    return {flag: having for flag, having in found.items() if len(having) < len(methods)}


COLUMNS = range(4)  # default, unit, meaning, allowed


def of_flags():
    """{flag: {scene: its columns}}, of a flag that no scene has by default those of a method, in scenes that rise."""
    scenes, methods = helps()
    every = dict.fromkeys(flag for told in (*scenes.values(), *methods.values()) for flag in told)
    found = {flag: {scene: told[flag] for scene, told in scenes.items() if flag in told} for flag in every}
    of_methods = {flag: told for each in methods.values() for flag, told in each.items()}
    rising = groups()["all scenes"] - groups()["attracting"]
    return {flag: having or dict.fromkeys(rising, of_methods[flag]) for flag, having in found.items()}


def flags():
    """A table a topic, a row a flag: default, unit, meaning, what is allowed, the scenes that read it."""
    topics = {}
    for flag in of_flags():
        topics.setdefault(section_of(flag), []).append(flag)
    order = [BODIES, "law", SCHEME]
    lines = []
    for topic in [*order, *sorted(topics.keys() - set(order), key=TOPICS.get)]:
        lines += [
            "",
            f"## {TOPICS[topic]}",
            "",
            "| flag | default | unit | meaning | allowed | read by |",
            "|---|---|---|---|---|---|",
        ]
        for flag in topics[topic]:
            having = of_flags()[flag]
            cells = [usual({scene: told[column] for scene, told in having.items()}) for column in COLUMNS]
            own = [
                f"; `-method {name}`: {told[flag][0]}"
                for name, told in helps()[1].items()
                if flag in told and told[flag][0] != having.get("disc-on-block", [""])[0]
            ]
            cells[0] += "".join(own) if "disc-on-block" in having else ""
            by = covered(set(having)) + (f"; `-method {', '.join(owners()[flag])}`" if flag in owners() else "")
            lines.append(f"| `{flag}` | " + " | ".join(cell.replace("|", "\\|") for cell in [*cells, by]) + " |")
    words = [f"- *{group}*: {named(inside)}" for group, inside in groups().items() if not group.startswith("all")]
    return "\n".join([*lines[1:], "", "## Groups of scenes", "", *words]) + "\n"


def defaults():
    """A row a scene: the defaults that are not those of the table of flags."""
    rows = ["| scene | defaults of its own |", "|---|---|"]
    for scene in helps()[0]:
        found = []
        for flag, having in of_flags().items():
            values = {each: told[0] for each, told in having.items()}
            if scene in values and values[scene] != usual(values):
                found.append(f"`{flag} {values[scene] or 'none'}`")
        if found:
            rows.append(f"| `{scene}` | {', '.join(found)} |")
    return "\n".join(rows) + "\n"


def meanings():
    """A row a flag with another meaning, unit or range in some scenes: which, and what it is there."""
    rows = ["| flag | scenes | unit | meaning | allowed |", "|---|---|---|---|---|"]
    for flag, having in of_flags().items():
        most = [usual({scene: told[column] for scene, told in having.items()}) for column in COLUMNS]
        others = {}
        for scene, told in having.items():
            if told[1:] != tuple(most[1:]):
                others.setdefault(told[1:], set()).add(scene)
        for told, inside in others.items():
            cells = [
                cell.replace("|", "\\|") if cell != same else "" for cell, same in zip(told, most[1:], strict=True)
            ]
            rows.append(f"| `{flag}` | {covered(inside)} | {' | '.join(cells)} |")
    return "\n".join(rows) + "\n"


# ---------------------------------------------------------------- files

CASE = "-mesh edp/examples/{0}/{0}.geo -case edp/examples/{0}/{0}.case -set size {1}"
RUNS = {  # a run of each kind
    "plane": "scenes/hertz-line.edp -law power -d0 -0.25 -force 0 -u0 1 -method paper -order 1 -h 2 -steps 2 -states 1"
    " -axis 1 -history 1",
    "space": "scenes/sphere-on-block.edp -order 1 -h 2 -states 1",
    "two": "scenes/patch-test.edp",
    "two in space": "scenes/patch-test-3d.edp -lower 2 -upper 3",
    "case": f"parts.edp -order 1 {CASE}".format("pin-in-hole", 1.5),
    "case in space": f"parts-3d.edp -order 1 {CASE}".format("crossed-cylinders", 0.5),
}
KINDS = {  # in words
    "plane, two, case": "in the plane",
    "space, two in space, case in space": "in space",
    "plane, space, two, two in space": "of a scene",
    "two, two in space, case, case in space": "with two bodies",
    "two, case": "with two bodies in the plane",
    "two in space, case in space": "with two bodies in space",
    "case, case in space": "of a case",
    "case": "of a case in the plane",
}


@cache
def results():
    """{kind: (keys of summary.json, flags, {file: its first line})} of a run of each kind."""

    def made(words):
        with tempfile.TemporaryDirectory() as out:
            freefem(*words.split(), "-out", out)
            summary = json.loads(Path(out, "summary.json").read_text())
            heads = {path.name: path.read_text().split("\n")[0] for path in Path(out).glob("*.csv")}
        return keys(summary), summary["parameters"].keys(), heads

    with ThreadPoolExecutor(2) as pool:
        return dict(zip(RUNS, pool.map(made, RUNS.values()), strict=True))


def keys(entry):
    """The keys of an entry, nested ones as "seconds.mesh", of entries of lists "contacts[].name"; values are none."""
    found = []
    for key, value in entry.items():
        inner = [value] if isinstance(value, dict) else value
        nested = isinstance(inner, list) and inner and isinstance(inner[0], dict) and inner[0]
        if not nested or key == "parameters" or nested.keys() == {"value", "error"} or all(map(str.isdigit, nested)):
            found.append(key)
        else:
            found += [key + ("[]." if isinstance(value, list) else ".") + each for part in inner for each in keys(part)]
    return list(dict.fromkeys(found))


def where(key):
    """In which runs the key is, in words."""
    kinds = [kind for kind, (having, *_) in results().items() if key in having]
    if kinds == list(RUNS):
        return ""
    if ", ".join(kinds) in KINDS:
        return KINDS[", ".join(kinds)]
    given = {kind: flags for kind, (_, flags, _) in results().items()}
    with_flag = [flag for flag in given[kinds[0]] if [kind for kind in RUNS if flag in given[kind]] == kinds]
    return f"with the flag `-{with_flag[0]}`" if with_flag else "in some scenes"


def of_table(name):
    """The rows of a table as it is: lists of cells."""
    (text,) = [block[0] for page in PAGES for block in BLOCK.finditer(page.read_text()) if block[2] == name]
    lines = [line for line in text.splitlines() if line.startswith("| ")]
    return [[cell.strip() for cell in line[1:-1].split("|")] for line in lines[1:]]


def keys_of_summary():
    """A row some keys of one meaning, and the runs that have them; unit and meaning stay as they are."""
    every = dict.fromkeys(key for having, *_ in results().values() for key in having)
    rows, listed = ["| key | unit | meaning |", "|---|---|---|"], set()
    table = of_table("summary")
    known = [[key for key in re.findall(r"`([^`]+)`", row[0]) if key in every] for row in table]
    fresh = [[key] for key in every if not any(key in row for row in known)]
    words = [row[1:] for row in table] + [["", ""]] * len(fresh)
    for group, cells in zip([*known, *fresh], words, strict=True):
        places = {}
        for key in group:
            if key not in listed:
                places.setdefault(where(key), []).append(f"`{key}`")
        listed.update(group)
        said = "; ".join((f"{place} " if place else "") + ", ".join(names) for place, names in places.items())
        if said:
            rows.append(f"| {said} | {' | '.join(cells)} |")
    return "\n".join(rows) + "\n"


def columns():
    """A row a table of results: its columns, and those that it has in space; what a row is stays as it is."""
    rows = ["| file | a row is | columns |", "|---|---|---|"]
    heads = {kind: heads for kind, (*_, heads) in results().items()}
    known = {re.findall(r"`([^`]+)`", row[0])[0]: row for row in of_table("columns")}
    for name in [*(name for name in known if name in heads["plane"]), *(heads["plane"].keys() - known.keys())]:
        cells = known.get(name, [f"`{name}`", "", ""])
        in_space = heads["space"].get(name, heads["plane"][name])
        more = [column for column in in_space.split(",") if column not in heads["plane"][name].split(",")]
        said = f"`{heads['plane'][name]}`" + (
            f"; in space also {', '.join(f'`{column}`' for column in more)}" if more else ""
        )
        note = re.search(r" \(.*\)$", cells[2])
        rows.append(f"| {cells[0]} | {cells[1]} | {said}{note[0] if note else ''} |")
    return "\n".join(rows) + "\n"


def statements():
    """A row a statement of a case file, as its reader says them in the plane and in space; what they mean stays."""
    from reader import Where, fields
    from reader import grammar as _grammar  # noqa: F401 (declares the statements)

    places = Where(), Where(space=True)
    plane, space = ({word: fields.usage(word, where) for word in fields.STATEMENTS} for where in places)
    examples = {word: fields.shown(cls.example, Where()) for word, cls in fields.STATEMENTS.items() if cls.example}

    def lines(usage):
        """A long usage: a line for each of its options."""
        if len(usage) < 150:
            return f"`{usage}`"
        depth, text = 0, ""
        for sign in usage:
            text += "\n" if sign == "[" and depth == 0 else ""
            depth += (sign == "[") - (sign == "]")
            text += sign
        text = re.sub(r"\], (?=\w)", "]\n", text)
        return "<br>".join(f"`{line.strip()}`" for line in text.split("\n"))

    meanings = {re.findall(r"\w+", row[0])[0]: row[-1] for row in of_table("statements")}
    rows = ["| statement | example | meaning |", "|---|---|---|"]
    for word in [*(word for word in meanings if word in plane), *sorted(plane.keys() - meanings.keys())]:
        other = f"; in space {lines(space[word])}" if space[word] != plane[word] else ""
        example = f"`{examples[word]}`" if word in examples else ""
        rows.append(f"| {lines(plane[word])}{other} | {example} | {meanings.get(word, '')} |")
    return "\n".join(rows) + "\n"


TABLES = {
    "modules": modules,
    "options": options,
    "programs": lambda: table("program", sources(".sh")),
    "flags": flags,
    "defaults": defaults,
    "meanings": meanings,
    "summary": keys_of_summary,
    "columns": columns,
    "statements": statements,
}


def written(text):
    """A page with its tables made anew."""
    return BLOCK.sub(lambda found: found[1] + "\n" + TABLES[found[2]]() + "\n" + found[3], text)


# where, size, folder, what it makes, the name in its code; a name that is not there is an error
BOXES = {
    "mesh": (10, 10, 150, "fem/mesh, fem", "mesh, materials, loads", "Th, setMaterial"),
    "K": (220, 10, 190, "solver", "stiffness K, load f", "discretise"),
    "B": (220, 92, 190, "contact/pairing, contact/points", "overlaps B u, weights w", "computeOverlap, weight"),
    "C": (480, 92, 190, "solver/compliance", "C q = B K⁻¹ Bᵀ q", "computeForceOverlap"),
    "G": (480, 10, 190, "solver/surrogate", "C of a half-plane", "applySurrogate"),
    "law": (10, 214, 150, "contact/laws", "p(s), p′(s), wall at τ", "computeGraphPoint"),
    "tangent": (220, 214, 190, "solver/problem", "s, p, p′, status", "linearise"),
    "linear": (480, 214, 190, "solver/newton", "contact forces q, overlaps", "solveLinearised"),
    "tau": (220, 306, 190, "solver/newton", "next thresholds τ, eq. (6)", "updateThreshold"),
    "error": (480, 412, 190, "error/estimates", "± of each number", "estimateErrors"),
    "files": (220, 412, 190, "output/report", "summary.json, tables", "measureContactSizes"),
}
ARROWS = [
    ("mesh", "K", ""),
    ("mesh", "B", ""),
    ("K", "C", "K"),
    ("B", "C", "B"),
    ("G", "linear", "start, preconditioner"),
]
ARROWS += [("C", "linear", "C q"), ("law", "tangent", ""), ("tangent", "linear", ""), ("linear", "tangent", "")]
ARROWS += [("tangent", "tau", "converged"), ("tau", "tangent", ""), ("tau", "files", "model error < -eps")]
ARROWS += [("files", "error", ""), ("error", "files", "")]


def flow():
    """A picture of where data goes: the core's folders, what each makes, the function that makes it."""
    drawn, boxes, high = [], [], 56
    for folder, names in ((box[3], box[5]) for box in BOXES.values()):
        for name in names.split(", "):
            at = {path.rsplit("/", 1)[0] for path in test_contracts.owners().get(name, ())}
            if not at & set(folder.split(", ")) and name != "Th":
                raise SystemExit(f"{name} is not declared in {folder}/, but in {', '.join(sorted(at)) or 'no module'}")
    for start, end, words in ARROWS:
        (x, y, wide), (toX, toY, toWide) = BOXES[start][:3], BOXES[end][:3]
        aside = 9 if (end, start) in [arrow[:2] for arrow in ARROWS] else 0  # there and back
        down, right = toY > y, toX > x
        if start == "G":  # round the operator's box
            line, label = (
                [(x + wide, y + 28), (x + wide + 24, y + 28), (x + wide + 24, toY + 28), (toX + toWide, toY + 28)],
                (0, 0),
            )
        elif x == toX:
            at = x + wide / 2 + (-aside if down else aside)
            line, label = [(at, y + high * down), (at, toY + high * (not down))], (6 + 2 * aside, 4)
        else:
            shift = -aside if right else aside
            line = [(x + wide * right, y + high / 2 + shift), (toX + toWide * (not right), toY + high / 2 + shift)]
            label = (-4, -6)
        drawn.append(f'<path d="M{"L".join(f"{u:g} {v:g}" for u, v in line)}" marker-end="url(#tip)"/>')
        at = [(line[0][k] + line[-1][k]) / 2 + label[k] for k in (0, 1)] if start != "G" else [x + wide + 4, y + 12]
        drawn += [f'<text x="{at[0]:g}" y="{at[1]:g}" class="n">{html.escape(words)}</text>'] if words else []
    for x, y, wide, folder, text, names in BOXES.values():
        boxes.append(f'<rect x="{x}" y="{y}" width="{wide}" height="{high}" rx="4"/>')
        for row, (kind, line) in enumerate((("f", folder + "/"), ("", text), ("g", names))):
            boxes.append(f'<text x="{x + 8}" y="{y + 17 + 16 * row}" class="{kind}">{html.escape(line)}</text>')
    style = "text{font:12px sans-serif;fill:#222}.f{font-weight:bold}.g{font:11px monospace;fill:#1b5e8c}"
    style += ".n{fill:#555;font-size:11px}rect{fill:#f4f6f8;stroke:#9aa5b1}.loop{fill:none;stroke-dasharray:5 4}"
    style += "path{fill:none;stroke:#1b5e8c;stroke-width:1.4}"
    tip = '<marker id="tip" orient="auto" markerWidth="8" markerHeight="8" refX="7" refY="4">'
    tip += '<path d="M0 0L8 4L0 8z" style="fill:#1b5e8c;stroke:none"/></marker>'
    loop = '<rect x="205" y="192" width="480" height="182" rx="8" class="loop"/>'
    loop += '<text x="420" y="352" class="n">threshold loop: solver/newton/extended-newton.idp</text>'
    head = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 800 480" width="800">'
    white = '<rect width="800" height="480" style="fill:#fff;stroke:none"/>'
    return (
        "\n".join([head, f"<style>{style}</style>", f"<defs>{tip}</defs>", white, loop, *boxes, *drawn, "</svg>"])
        + "\n"
    )


def stale():
    """The pages whose tables are not those of the sources, and the picture: what they should be."""
    texts = {page: page.read_text() for page in PAGES}
    found = {page: new for page, text in texts.items() if (new := written(text)) != text}
    return found | ({FLOW: flow()} if not FLOW.exists() or FLOW.read_text() != flow() else {})


if __name__ == "__main__":
    if len(sys.argv) > 1:
        print("\n".join(relations(sys.argv[1])))
        sys.exit()
    for page, text in stale().items():
        page.write_text(text)
        print(page.relative_to(ROOT), file=sys.stderr)
