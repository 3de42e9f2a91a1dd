"""Options: what a scene reads on request, what the others say of it, and that the core names none of it."""

import re
from functools import cache

import pages
from freefem import ROOT, run, run_in, snippet

from house.test_contracts import EDP, MODULES, owners, uses

OFFERED = (EDP / "input/hooks.idp").read_text()
OFFERS = re.findall(r'^requireOption\("(\w+)", "([^"]*)",\s*"([^"]*)"\);', OFFERED, flags=re.M)
ROW = r"^\| `([A-Z]\w*)(?:\(([\w, ]+)\))?` \| (`[^|]*`) \|"  # an event, the names of its host, its files
EVENTS = re.findall(ROW, (EDP / "docs/WRITING.md").read_text().split("\n## Events\n")[1].split("\n## ")[0], flags=re.M)
OPTIONS = sorted(pages.OPTION_FILES)
SCRIPTS = pages.scripts()


option_of = pages.option_of


def flags_of(name):
    """The flags that a source declares."""
    return set(re.findall(r'\b(?:number|count|word|text)Flag\("(-[\w-]+)"', (EDP / name).read_text()))


def beside(option):
    """The options whose names an option uses, unless the core or itself has them too."""
    users = [name for name in MODULES if option_of(name) == option]
    found = [set(map(option_of, owners()[word])) for name in users for word in uses(name)]
    return set().union(*(of for of in found if not of & {"", option}))


def test_list():
    """The list shall have each option that has flags, and the scenes that read it if not all do."""
    entries = {name: scenes for name, _, scenes in OFFERS}
    assert entries.keys() <= set(OPTIONS)
    for name, scenes in entries.items():
        found = {scene for scene, path in SCRIPTS.items() if name in pages.reads(path)}
        if name == "symmetry":  # main.edp reads it for scenes with friction too, which refuse it
            found = {scene for scene in found if "friction" not in pages.reads(SCRIPTS[scene])}
        assert set(scenes.split(", ")) == found or scenes == f"scenes that read the option {name}"
    elsewhere = {
        flag for name in [*MODULES, *SCRIPTS.values(), "parts.edp"] for flag in flags_of(name) if not option_of(name)
    }
    for name in filter(option_of, MODULES):
        offered = {word for option, words, _ in OFFERS if option == option_of(name) for word in words.split(", ")}
        assert flags_of(name) <= offered | elsewhere, name


def test_core_names_no_option():
    """What options declare, and their files, shall be named by what reads them alone, and over defaults: // Without."""
    wrong = []
    for name in [*MODULES, *SCRIPTS.values()]:
        own = pages.reads(name) if name.endswith(".edp") else {option_of(name)}
        own |= {other for option in own if option for other in beside(option)} | {""}
        for word in uses(name):
            if not own & set(map(option_of, owners()[word])):
                wrong.append(f"{name}: {word} of {', '.join(owners()[word])}")
        texts = (
            re.findall(
                r"\b[\w-]+(?:/[\w-]+)+(?:\.idp)?", re.sub(r"^// Without.*", "", (EDP / name).read_text(), flags=re.M)
            )
            if name != "input/hooks.idp"
            else []
        )
        wrong += [f"{name}: {text}" for text in texts if option_of(text) not in own | {option_of(name)}]
    assert not wrong, "\n".join(wrong)


def test_no_option_needs_itself():
    """Options that use each other's names shall do so in one direction."""
    reached = {option: beside(option) for option in OPTIONS}
    for _ in OPTIONS:
        reached = {option: near.union(*(reached[other] for other in near)) for option, near in reached.items()}
    assert not [option for option in OPTIONS if option in reached[option]]


def test_hooks():
    """The macros of options shall be hooks that there are; the list of events has each with its files."""
    found = {}
    for name in MODULES:
        for hook in re.findall(r"\boptionHook\(([A-Z]\w*)\)", (EDP / name).read_text()):
            found.setdefault(hook, set()).add(f"`{name}`")
    assert {hook: set(files.split(", ")) for hook, _, files in EVENTS} == found | {"Laws": {"`contact/laws/all.idp`"}}
    wrong = []
    for option in OPTIONS:
        text = (EDP / pages.OPTION_FILES[option]).read_text()
        own = set(re.findall(rf"^macro {option}([A-Z]\w*)\(", text, flags=re.M))
        wrong += [f"{option}{hook}: there is no such hook" for hook in sorted(own - set(found) - {"Laws"})]
    assert not wrong, "\n".join(wrong)


def test_not_read(tmp_path):
    """A scene without an option shall load nothing of it, and refuse its words, naming the scenes that read it."""
    assert not any(module.startswith("contact/adhesion") for module in run("disc-on-block").modules)
    table = tmp_path / "falls.csv"
    table.write_text("0,0\n1,-2\n2,1\n3,4\n")
    scenes = dict((name, scenes) for name, _, scenes in OFFERS)["adhesion"]
    for flags, said in (
        (["-path", "0 1"], "-path 0 1"),
        (["-law", "lennard-jones"], "-law lennard-jones"),
        (["-law", "table", "-table", table], f"-table {table}, whose pressures fall"),
    ):
        done = run_in(ROOT, "edp/main.edp", *flags, out=tmp_path / "out", expect=10)
        assert done.stdout == f"{said}: not read by this scene; allowed in: {scenes}\n"
    assert not (tmp_path / "out").exists()


def test_meshes_want_estimates(tmp_path):
    """A scene that reads new meshes without estimates before them shall be refused in one line."""
    text = pages.EACH.sub("macro eachOption(do, what) do(meshes, what) //", (EDP / "main.edp").read_text())
    said = snippet(tmp_path, text, expect=10)
    assert said.startswith("eachOption: meshes: ") and len(said.splitlines()) == 1


NAMED = {"Loads"}  # hooks that list an option's modules in the host's own form
MOST = 39  # to be lowered with the code


@cache
def code():
    """The modules' texts without comments."""
    return [re.sub(r"//.*", "", (EDP / name).read_text()) for name in MODULES]


def hosts(hook):
    """The blocks of code, a function or braces at top level, in which a hook stands."""
    found = []
    for text in filter(re.compile(rf"\boptionHook\({hook}\)").search, code()):
        for place in re.finditer(rf"\boptionHook\({hook}\)", text):
            begins = max(text.rfind("\nfunc ", 0, place.start()), text.rfind("\n{", 0, place.start()))
            inside = begins >= 0 and "\n}\n" not in text[begins : place.start()]
            found += [text[begins : (text + "\n}\n").index("\n}\n", begins)]] if inside else []
    return found


def test_hooks_only_listen():
    """No option's statements at a hook shall end the host's function or use its own names: who changes what a module
    does replaces the module (readUnless)."""
    every = {hook for name in MODULES for hook in re.findall(r"\boptionHook\(([A-Z]\w*)\)", (EDP / name).read_text())}
    wrong = [f"{len(every)} hooks, at most {MOST}"] if len(every) > MOST else []
    files = {option: [n for n in MODULES if option_of(n) == option] for option in OPTIONS}
    texts = {option: "\n".join((EDP / name).read_text() for name in files[option]) for option in OPTIONS}
    for hook in sorted(every - NAMED):
        declared = r"\b(?:int|real|bool|string|matrix|ofstream|ifstream)(?:\[[\w,]+\])?\s*&?\s*(\w+)"
        own = {word for host in hosts(hook) for word in re.findall(declared, host.replace("func", "", 1))}
        own -= {word for host in hosts(hook) for word in re.findall(r"^\nfunc \S+ (\w+)", host)}
        own -= {word for event, given, _ in EVENTS if event == hook for word in given.split(", ")}
        for option in OPTIONS:
            for body in re.findall(rf"^macro {option}{hook}\(\)(.*?)//", texts[option], flags=re.M | re.S):
                words = set(re.findall(r"\w+", re.sub(r'"(\\.|[^"\\])*"', "", body)))
                mine = set(re.findall(declared, body))
                if "return" in words:
                    wrong.append(f"{option}{hook} returns")
                if own & words - mine:
                    wrong.append(f"{option}{hook} uses its host's {', '.join(sorted(own & words - mine))}")
    assert not wrong, "\n".join(wrong)
