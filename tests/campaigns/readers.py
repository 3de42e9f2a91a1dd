"""Whether the two readers of case files agree: `python tests/campaigns/readers.py [MUTATED] [SEED]`.

The awk programs are started as edp/bodies/readable.sh and options/parts/case-flags.idp start them, the Python package
edp/case/reader is called. Both read all cases in the package, those that stand in tests, and so many mutated ones
(3000 unless given): words dropped, doubled and exchanged, numbers spoilt, control characters, quotes, letters that are
no ASCII, very long lines, ends of lines of other systems, blank files, two statements on a line.
Compared are the rows, what is picked on a geometry, the modules, and the refusals, letter by letter. EXPECTED explains
the differences that are wanted. Exit code 1: one that it does not explain, printed with its case.
"""

import ast
import os
import random
import re
import subprocess
import sys
import tempfile
from collections import Counter
from dataclasses import dataclass, replace
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "edp/case"))

from reader import Group, Refusal, Where, read_case  # noqa: E402
from reader.fields import STATEMENTS, shown, usage  # noqa: E402
from reader.grammar import lead_to  # noqa: E402
from reader.modules import needs  # noqa: E402
from reader.rows import picks, rows  # noqa: E402

PARTS = ["words", "grammar", "groups", "pushed", "worn", "heat", "cad", "file"]
PROGRAM = [word for part in PARTS for word in ("-f", ROOT / f"edp/case/case-{part}.awk")]
ASKS = ROOT / "edp/options/parts/case-asks.awk"
OF_BODIES = {"body", "weight", "expand", "plastic", "conduct", "spin"}
BITS = "friction strains rotations stresses laws symmetries loads rotates".split()
MORE_BITS = "forces moments wear heat plastic".split()


@dataclass
class Given:
    """A case and where it is read."""

    name: str
    text: bytes
    where: Where
    mesh: list


def awk(given, folder):
    """(rows or the refusal's text, picks, needs) of the awk programs."""
    where = given.where
    (folder / "a.case").write_bytes(given.text)
    (folder / "names").write_text("".join(f'{g.dimension} {k + 1} "{g.name}"\n' for k, g in enumerate(given.mesh)))
    (folder / "picks").write_text("")
    switches = {"WEARS": where.wear, "FLOWS": where.plastic, "SETS_OVERLAP": where.overlap, "AGAIN": where.again}
    environment = {
        **os.environ,
        "LC_ALL": "C",
        "CASE": "a.case",
        "SPACE": str(int(where.space)),
        "RUBS": where.friction,
    }
    environment |= {name: "1" if on else "" for name, on in switches.items()}
    environment |= {"PICKS": "picks", "BODIES": where.bodies}
    how = {"cwd": folder, "env": environment, "capture_output": True}
    done = subprocess.run(["awk", *PROGRAM, "names", "./a.case"], **how)
    text = done.stdout.decode(errors="replace")
    text = text.rstrip("\n").split("\n")[-1] if done.returncode == 1 else text
    codes = [
        subprocess.run(["awk", *more, "-f", ASKS, "./a.case"], **how).returncode for more in ([], ["-v", "more=1"])
    ]
    asked = [
        name
        for code, names in zip(codes, (BITS, MORE_BITS), strict=True)
        for k, name in enumerate(names)
        if code >> k & 1
    ]
    return done.returncode, text, (folder / "picks").read_text(errors="replace"), set(asked)


def python(given):
    """The same of the Python reader."""
    try:
        case = read_case(given.text.decode(errors="surrogateescape"), replace(given.where), given.mesh)
    except Refusal as refusal:
        return 1, printed(refusal.text("a.case")), "", set()
    asked = {name for name, on in vars(needs(case)).items() if on}
    return 0, printed(rows(case)), printed("".join(line + "\n" for line in picks(case))), asked


def printed(text):
    return text.encode(errors="surrogateescape").decode(errors="replace")


def mesh_of(text, space):
    """The groups that a case's text needs of its mesh."""
    dimension, found, own = 2 + space, {}, set()
    for line in text.splitlines():
        words = [a or b for a, b in re.findall(r'"([^"]*)"|([^\s"#]+)', line.split("#")[0])]
        if len(words) < 2:
            continue
        if words[0] in ("group", "cut"):
            own.add(words[1])
        if words[0] == "cut" and len(words) > 2:
            found[Group(dimension, words[2])] = 1
        if words[0] == "join":
            found |= {Group(dimension, word): 1 for word in words[1:3]}
        elif words[0] in STATEMENTS and words[0] not in (
            "units",
            "state",
            "thickness",
            "line",
            "about",
            "gravity",
            "group",
            "cut",
            "leg",
            "cycles",
        ):
            size = dimension if words[0] in OF_BODIES else dimension - 1
            for word in words[1 : 3 if words[0] in ("contact", "tie") else 2]:
                if words[0] != "size" or not {Group(d, word) for d in (dimension, dimension - 1)} & found.keys():
                    found[Group(size, word)] = 1
    return [group for group in found if group.name not in own and group.name not in ("", "contact")]


def strings(path):
    """The texts in a test that look like cases; what is put into them when the test runs is a 1."""
    known = {}

    def value(node):
        match node:
            case ast.Constant(value=str(text)):
                return text
            case ast.Name(id=name):
                return known.get(name)
            case ast.JoinedStr(values=values):
                return "".join(value(v) or "1" for v in values)
            case ast.FormattedValue(value=inner):
                return value(inner) or "1"
            case ast.BinOp(left=left, op=ast.Add(), right=right):
                sides = value(left), value(right)
                return "".join(side or "" for side in sides) if any(sides) else None
            case ast.Call(func=ast.Attribute(value=inner, attr="format" | "replace")):
                return value(inner) and re.sub(r"\{[^{}]*\}", "1", value(inner))
        return None

    tree = ast.parse(path.read_text())
    for node in tree.body:
        if isinstance(node, ast.Assign) and isinstance(node.targets[0], ast.Name) and (text := value(node.value)):
            known[node.targets[0].id] = text
    inside = {
        child
        for node in ast.walk(tree)
        if isinstance(node, ast.BinOp | ast.JoinedStr)
        for child in ast.iter_child_nodes(node)
    }
    for node in ast.walk(tree):
        text = (
            value(node)
            if isinstance(node, ast.Constant | ast.JoinedStr | ast.BinOp | ast.Call) and node not in inside
            else None
        )
        words = [line.split()[0] for line in (text or "").splitlines() if line.split()]
        if sum(word in STATEMENTS for word in words) >= 2 and len(text) < 5000:
            yield f"{path.name}:{node.lineno}", text


def collected():
    """All cases in the package and in tests, by name."""
    files = [
        path for folder in ("edp/examples", "edp/labs", "tests") for path in sorted((ROOT / folder).rglob("*.case"))
    ]
    found = {str(path.relative_to(ROOT)): path.read_bytes() for path in files}
    for path in sorted({*(ROOT / "tests").glob("test_*.py")} - {ROOT / "tests/test_reader.py"}):
        for name, text in strings(path):
            found.setdefault(name, text.encode())
    good = "body block E 100 nu 0.3\nclamp bottom\nobstacle top circle 1.5 5 R 3 move 0 -0.1\n"
    for k, line in enumerate((ROOT / "tests/data/parts/refused.txt").read_text().strip().splitlines()):
        change, _ = line.split(" | ")
        old, _, new = change.partition(" => ")
        more = change[2:].replace(" / ", "\n")
        text = {"+ ": good + more, "- ": f"{more}\n{good}"}.get(change[:2], good.replace(old, new))
        found[f"refused.txt:{k + 1}"] = text.encode()
    return found


BLOCK = [Group(2, "block"), *(Group(1, name) for name in ("bottom", "right", "top", "left"))]


def given_cases():
    """Each case in the plane or in space: where it is no refusal if there is one; both if both are refused."""
    for name, text in collected().items():
        for space in (False, True):
            of_tests = name.startswith("refused.txt")
            mesh = BLOCK if of_tests and not space else mesh_of(text.decode(errors="replace"), space)
            yield Given(f"{name} in {'space' if space else 'the plane'}", text, Where(space=space), mesh)


WORDS = [
    *STATEMENTS,
    *"E nu yield density law power kappa m d0 friction compliance limit free rigid at about axis".split(),
]
WORDS += "interference gap vertical conductance hardness exponent wear slide from expand inside move force".split()
WORDS += "plane circle sphere R box near between part contact tie steps alpha table signorini barrier p0".split()
NUMBERS = "0 -1 1e5x 0x10 1e50 1e-400 nan inf 1e 1.5.2 --3 +2 .5 5. 1,5 1e999 007 -0 0.5 100001 1e400 1_000 ١".split()
LETTERS = [
    "\x00",
    "\x01",
    "\x1b[31m",
    "\x7f",
    '"',
    '""',
    "'",
    "#",
    "é",
    "\u200b",
    "\ufeff",
    "\u2028",
    "\t",
    "\v",
    "\f",
    "\r",
    "`id`",
    "$(id)",
    "\\",
    "\udcff",
]


def mutated(text, chance):
    """A text with one to three changes."""
    lines = text.split("\n")
    for _ in range(chance.choice([1, 1, 1, 2, 3])):
        full = [k for k, line in enumerate(lines) if line.strip()] or [0]
        k = chance.choice(full)
        words = re.findall(r'"[^"]*"|\S+', lines[k]) or [""]
        j = chance.randrange(len(words))
        other = chance.choice(full)
        match chance.randrange(20):
            case 0 | 1:
                del words[j]
            case 2:
                words.insert(j, words[j])
            case 3 | 4:
                i = chance.randrange(len(words))
                words[i], words[j] = words[j], words[i]
            case 5 | 6 | 7:
                numbers = [i for i, word in enumerate(words) if re.match(r"[-+.\d]", word)]
                words[chance.choice(numbers) if numbers else j] = chance.choice(NUMBERS)
            case 8:
                at = chance.randrange(len(words[j]) + 1)
                words[j] = words[j][:at] + chance.choice(LETTERS) + words[j][at:]
            case 9:
                at = chance.randrange(len(words[j]) + 1)
                words[j] = words[j][:at] + words[j][at + 1 :]
            case 10:
                words = words + lines[other].split()
            case 11:
                lines[k], lines[other] = lines[other], lines[k]
                continue
            case 12:
                words = [*words, chance.choice(WORDS), *chance.sample([*WORDS, *NUMBERS], chance.randrange(3))]
            case 13:
                words.insert(j, chance.choice(WORDS))
            case 14:
                words[j] = words[j] * chance.choice([50, 4000])
            case 15:
                lines.insert(other, lines[k])
                continue
            case 16:
                from_other = re.findall(r'"[^"]*"|\S+', lines[other])
                words[j] = chance.choice(from_other or [""])
            case 17:
                lines = "\r\n".join(lines).split("\n")
                continue
            case 18:
                lines = chance.choice(
                    [[""], ["# only"], ["\ufeff"], [], lines[: k + 1], lines[:k], ["\ufeff" + lines[0], *lines[1:]]]
                )
                lines = lines or [""]
                continue
            case 19:
                lines[k] = re.sub(
                    r"\S+", lambda found: f'"{found[0]}"' if chance.random() < 0.5 else found[0], lines[k], count=3
                )
                continue
        lines[k] = " ".join(words)
    return "\n".join(lines)


def mutants(count, seed):
    """So many of the cases that are taken, changed."""
    chance = random.Random(seed)
    pool = [given for given in given_cases() if python(given)[0] == 0]
    for k in range(count):
        given = chance.choice(pool)
        text = mutated(given.text.decode(), chance).encode(errors="surrogateescape")
        where = replace(given.where)
        match chance.randrange(12):
            case 0:
                where.friction = chance.choice(["", "-distance exact"])
            case 1:
                where.wear = where.plastic = False
            case 2 | 3:
                where.bodies = "1 2"
            case 4:
                where.again = True
            case 5:
                where.overlap = True
        mesh = [g for g in given.mesh if not where.bodies or g.dimension < where.dimension or chance.random() < 0.5]
        yield Given(f"mutant {k} of {given.name}", text, where, mesh)


RULES = re.compile(
    r"line (\d+): .*(stated before, in line|slave and master are the same|twice the same body|state: after line|"
    r": \w+ after \w+ in line|first stated in leg|before the first leg)"
)
GUESS = re.compile(r"did you mean [^?]*\? ")


def same_words(given, kind, a, b):
    cut = " ... " in a and " ... " in b and len(a) == len(b)
    return kind == "refusal" and (cut or sorted(GUESS.sub("", a).split()) == sorted(GUESS.sub("", b).split()))


def not_ascii(given, kind, a, b):
    """awk counts bytes where Python counts letters: guesses, and where long refusals are cut."""
    same = GUESS.sub("", a) == GUESS.sub("", b) or (" ... " in a and " ... " in b)
    return kind == "refusal" and not given.text.isascii() and same


def only_named(given, kind, a, b):
    """awk's regular expressions look at comments and names too."""
    if kind != "modules":
        return False
    more, less = ast.literal_eval(a), ast.literal_eval(b)
    return not less and set(more) <= {"loads", "symmetries", "rotations"}


def missed(given, kind, a, b):
    """awk's regular expressions do not see a statement between quotes, behind a mark or a carriage return."""
    text = given.text.decode(errors="replace")
    return (
        kind == "modules" and (text.startswith("\ufeff") or '"' in text or "\r" in text) and ast.literal_eval(a) == []
    )


def two_faults(given, kind, a, b):
    """A line that is wrong in itself, and wrong behind others: the first is said first."""
    found = RULES.search(a)
    return kind == "refusal" and found is not None and f"line {found[1]}: " in b and not RULES.search(b)


EXPECTED = {
    "a list of names in the order of the file, no longer in that of a hash": same_words,
    "letters are counted, no longer bytes": not_ascii,
    "modules: words in comments and in names no longer count": only_named,
    "modules: a statement between quotes, behind a mark or a carriage return counts": missed,
    "two faults in one line: what is wrong with it alone is said first": two_faults,
    "units: the one that is missing or too much is named": lambda given, kind, a, b: (
        " words after it; allowed: units" in a
    ),
    "cycles: as other statements say it": lambda given, kind, a, b: ": not allowed here; allowed: cycles" in a,
    "an empty name at the beginning: statements are listed": lambda given, kind, a, b: a.endswith("name; allowed: "),
    "size alone: as other statements say it": lambda given, kind, a, b: "a name is missing after size; " in b,
    "state alone: as other statements say it": lambda given, kind, a, b: (
        ": state: a word is missing" in a and "a word is missing after state" in b
    ),
}


def differences(given, old, new):
    """(kind, old, new) of what differs."""
    if (old[0], new[0]) == (1, 1):
        if old[1] != new[1]:
            yield "refusal", old[1], new[1]
        return
    if old[0] != new[0]:
        yield "refused by one", old[1], new[1]
        return
    for kind, a, b in (("rows", old[1], new[1]), ("picks", old[2], new[2])):
        if a != b:
            lines = [(x, y) for x, y in zip(a.splitlines(), b.splitlines(), strict=False) if x != y]
            yield kind, *(lines[0] if lines else (f"{len(a.splitlines())} lines", f"{len(b.splitlines())} lines"))
    asked = old[3] | {"rotations"} if "rotates" in old[3] else old[3]
    asked = asked | {"moments"} if "friction" in asked else asked
    if asked - {"rotates"} != new[3]:
        yield "modules", f"{sorted(asked - {'rotates'} - new[3])}", f"{sorted(new[3] - asked)}"


def told(text, other):
    """A text, short, from where it differs from another."""
    at = next((k for k, (x, y) in enumerate(zip(text, other, strict=False)) if x != y), 0)
    return text[max(0, at - 60) : at + 160]


def tables(space):
    """What the grammars say of each statement and of words that are none, where they differ."""
    program = (ROOT / "edp/case/case-grammar.awk").read_text() + (ROOT / "edp/case/case-words.awk").read_text()
    program += """BEGIN { for (k in usage) print k "\\t" usage[k] "\\t" example[k] "\\t" does[k]
        for (k in leads) print k "\\t" leadTo(k); for (k in instead) print k "\\t" leadTo(k) }"""
    environment = {**os.environ, "SPACE": str(int(space)), "RUBS": "1"}
    done = subprocess.run(["awk", program], env=environment, capture_output=True, text=True, stdin=subprocess.DEVNULL)
    where = Where(space=space)
    for line in done.stdout.splitlines():
        word, *more = line.split("\t")
        if len(more) == 3:
            facts = STATEMENTS[word]
            new = [usage(word, where), shown(facts.example, where), facts.does]
        else:
            new = [lead_to(word)]
        if new != more:
            yield word, str(more), str(new)


def main(count=3000, seed=1):
    found, seen = Counter(), Counter()
    for word, a, b in [*tables(False), *tables(True)]:
        found["unexplained"] += 1
        print(f"grammar, {word}\n  awk:    {a}\n  Python: {b}")
    with tempfile.TemporaryDirectory() as temporary:
        for given in [*(given_cases() if int(count) >= 0 else []), *mutants(abs(int(count)), int(seed))]:
            old, new = awk(given, Path(temporary)), python(given)
            seen["taken" if old[0] == 0 else "refused"] += 1
            for kind, a, b in differences(given, old, new):
                why = next((name for name, same in EXPECTED.items() if same(given, kind, a, b)), None)
                found[why or "unexplained"] += 1
                if not why:
                    print(f"{given.name}: {kind}\n  awk:    {told(a, b)}\n  Python: {told(b, a)}", flush=True)
    print(f"{sum(seen.values())} cases, {seen['taken']} taken and {seen['refused']} refused by awk")
    for why, times in found.most_common():
        print(f"  {times:5d} {why}")
    return found["unexplained"] > 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
