"""The heads of the modules, and the comments at the names that other files use of them.

Who uses what, which is read here, `make pages` writes into edp/docs/modules.md, and `make uses MODULE=...` prints.
"""

import re
from collections import Counter
from functools import cache

from freefem import ROOT

EDP = ROOT / "edp"
MODULES = sorted(str(path.relative_to(EDP)) for path in EDP.rglob("*.idp"))
ALONE = EDP / "labs/0-algorithm/algorithm1.edp"  # plain FreeFEM: it shares nothing with the modules
SCRIPTS = sorted(str(path.relative_to(EDP)) for path in EDP.rglob("*.edp") if path != ALONE)
TYPES = set("int real string bool complex matrix mesh mesh3 varf fespace func ifstream ofstream ostream".split())
EVERYWHERE = {
    "moduleLoaded",
    "pluginLoaded",
    "readForDimension",
    "readUnless",
}  # every module says that it is there; includes

# a macro ends at //, on whatever line; elsewhere // begins a comment
TEXT = re.compile(r'"(?:\\.|[^"\\])*"|\bmacro\s+(\w+)\s*\(([^)]*)\)(.*?)//|//[^\n]*', re.DOTALL)
# words, but members (a.n), halves of a pasted name (u#Y), units of numbers (1e6); the signs that declarations hang on
TOKEN = re.compile(r"(?<![\w.#])[A-Za-z]\w*|[=<>!]=|[-+*/]=|[][(){}<>,;=&.]")
CLOSING = {"(": ")", "[": "]", "<": ">"}


def plain(text):
    """Code without comments and texts in quotes, macros as `macro name (parameters) { text }`."""

    def replaced(match):
        if match.group(1):
            return f"macro {match.group(1)} ({match.group(2)}) {{ {plain(match.group(3))} }}"
        return '""' if match.group().startswith('"') else ""

    return TEXT.sub(replaced, text)


@cache
def source(name):
    """The comment block that opens a source, and its code."""
    text = (EDP / name).read_text()
    no_names = r"Stringification\([^)]*\)|(?<!macro )readReplacement\(\w+\)|IFMACRO\(!?read[A-Z]\w*\)"
    return re.match(r"(?://[^\n]*\n)*", text).group(), plain(re.sub(no_names, "", text))


@cache
def spaces():
    """The finite element spaces, and macros that stand for one: they are types."""
    codes = [source(name)[1] for name in MODULES + SCRIPTS]
    found = {space for code in codes for space in re.findall(r"\bfespace\s+(\w+)", code)}
    macros = {pair for code in codes for pair in re.findall(r"\bmacro (\w+) \(\) \{ *(\w+) *\}", code)}
    return found | {name for name, meaning in macros if meaning in found}


class Reader:
    """Goes through code: `outside` is what it declares outside braces, `used` what it uses that others declare."""

    def __init__(self, code, spaces=()):
        self.tokens, self.at, self.types = TOKEN.findall(code), 0, TYPES | set(spaces)
        self.outside, self.used = set(), set()
        self.scopes, self.parameters = [set()], set()  # parameters: of the function or macro whose brace comes next
        while self.at < len(self.tokens):
            self.step()
        self.used -= self.outside

    def token(self, ahead=0):
        """A token from the present one on; "" beyond the end."""
        return self.tokens[self.at + ahead] if 0 <= self.at + ahead < len(self.tokens) else ""

    def step(self):
        """One token, or the beginning of a declaration."""
        before, token = self.token(-1), self.token()
        self.at += 1
        if token == "{":
            self.scopes.append(self.parameters)
            self.parameters = set()
        elif token == "}":
            self.scopes.pop()
        elif token == "macro":
            self.declaration(token, local=False)
        elif token in self.types and (self.token()[:1].isalpha() or self.token() in ("[", "<", "&")):
            self.declaration(token, local=before == "(")
        elif token[0].isalpha():
            self.use(token, named_argument=before in ("(", ",") and self.token() == "=")

    def use(self, word, named_argument=False):
        """A word that is no declaration: used, unless it is local."""
        if not named_argument and word not in TYPES and not any(word in scope for scope in self.scopes):
            self.used.add(word)

    def bracket(self):
        """The tokens within a bracket that opens here; goes behind it."""
        opening, start, depth = self.token(), self.at + 1, 0
        while self.token():
            depth += (self.token() == opening) - (self.token() == CLOSING[opening])
            self.at += 1
            if depth == 0:
                break
        return self.tokens[start : self.at - 1]

    def declaration(self, kind, local):
        """What follows a type: `real[int] & a = f(x), b(3);`, `func real f(int i)`, `Vh def(u)`, `varf a(def(u))`."""
        if kind not in TYPES | {"macro"}:
            self.use(kind)
        if kind == "func" and self.token() in TYPES:
            self.at += 1
        while kind in TYPES and self.token() in ("[", "<"):
            self.bracket()
        self.at += self.token() == "&"
        if kind != "macro" and self.token() == "def" and self.token(1) == "(":
            self.use("def")
            self.at += 1
        if self.token() in CLOSING:
            names = [word for word in self.bracket() if word != ","]
        else:
            names = [self.token()]
            self.at += 1
        (self.scopes[-1] if local or len(self.scopes) > 1 else self.outside).update(names)
        if kind in ("func", "varf", "macro") and self.token() == "(":
            inner = self.bracket()
            behind = [*inner[1:], ","]
            names = {word for word, sign in zip(inner, behind, strict=False) if word[0].isalpha() and sign in ",)]"}
            if kind == "varf":
                self.scopes[-1].update(names)
                self.used.update({"def"} & set(inner))
            else:
                self.parameters = names
        else:
            self.others(kind, local)

    def others(self, kind, local):
        """The value of a declared name, and the names behind its comma."""
        depth = 0
        while self.token() not in ("", "{", "}", ";") and not (depth == 0 and self.token() in (",", ")")):
            depth += (self.token() in ("(", "[")) - (self.token() in (")", "]"))
            self.step()
        if self.token() == "," and self.token(1) not in self.types:
            self.at += 1
            self.declaration(kind, local)


@cache
def read(name):
    """What a source declares outside braces, and what else it uses."""
    reader = Reader(source(name)[1], spaces())
    return reader.outside, reader.used


@cache
def owners():
    """identifier: the sources that declare it outside braces."""
    found = {}
    for name in MODULES + SCRIPTS:
        for word in read(name)[0]:
            found.setdefault(word, set()).add(name)
    return found


@cache
def uses(name):
    """The identifiers of other files that a source uses."""
    return {word for word in read(name)[1] if word in owners()} - EVERYWHERE


@cache
def taken():
    """{source: {other source: the identifiers that it uses of that}}; of what twins share the one of the same kind."""
    found = {}
    for name in MODULES + SCRIPTS:
        found[name] = {}
        for word in uses(name):
            kin = [
                path for path in owners()[word] if path[-9:] == name[-9:] and name[-9:] in ("plane.idp", "space.idp")
            ]
            for path in kin or owners()[word] - {name}:
                found[name].setdefault(path, set()).add(word)
    return found


def paths(text):
    """The files and folders that a text names: `input/flags.idp`, `meshes/check.awk`, `kernel/`."""
    return re.findall(r"(?<![\w/<>.-])(?:[a-z][\w-]{2,}/)+(?:[\w-]+\.\w+|(?![\w<*]))", text)


def checked(sources):
    """The sources whose heads are checked: the labs are lessons."""
    return [name for name in sources if not name.startswith("labs/")]


def test_the_code_is_read():
    """What this test takes for declarations and uses shall be what is meant."""
    assert {"sUndeformed", "approach", "setUpProblem"} <= read("solver/problem/problem.idp")[0]
    assert "applyLoad" in read("solver/problem/problem-of-bodies.idp")[0]
    assert "forceControl" in uses("solver/problem/problem.idp")
    assert {"computeGraphPoint", "condensed"} <= uses("solver/problem/problem.idp")
    assert len(owners()) > 300


@cache
def described(name):
    """The names whose definitions have a comment: a function's below its head, a variable's behind it or above, a
    macro's in the line above it, or behind a macro of one line."""
    text = (EDP / name).read_text()
    functions = re.findall(r"^func [^\n(]*?(\w+)\s*\([^{]*?\)(?:\n| \{[^\n]*\} +)//", text, flags=re.M)
    kinds = r"^(?:int|real|bool|string|matrix|mesh3?|meshS|meshL|fespace|varf)(?:\[[a-z,]*\])*"
    lines = re.findall(rf"{kinds} (\w[^\n]*?);[^\n]*// \S", text, flags=re.M)
    behind = [word for line in lines for word in re.findall(r"(?:^|, )(\w+)(?=\(|,| =|$)", line)]
    behind += re.findall(rf"^(?:{'|'.join(spaces())}) \[?(\w+)[^\n]*;[^\n]*// \S", text, flags=re.M)
    above = re.findall(rf"^// [^\n]*\n(?:{kinds[1:]} |(?:New)?[mM]acro )(\w+)", text, flags=re.M)
    return {*functions, *behind, *above}


def test_described():
    """What other files use of a module shall be described where it is defined: what it is, of which shape and unit."""
    wrong = []
    for word, paths_of in owners().items():
        users = {user for user in MODULES + SCRIPTS if word in uses(user)} - paths_of
        of_modules = checked(path for path in paths_of if path.endswith(".idp"))
        if users and of_modules and not any(word in described(path) for path in of_modules):
            wrong.append(f"{', '.join(of_modules)}: {word} is not described, {min(users)} uses it")
    assert not wrong, f"{len(wrong)}\n" + "\n".join(sorted(wrong))


# hard contact and ties, called as any law; functions whose parameters a macro of another file reads
UNREAD = """signoriniPressure signoriniInverse signoriniPotential tiedPressure tiedInverse tiedPotential
solveLawWithSpring elasticSolveTo solveForceOverlap advanceStoredDisplacement computeForceSolution""".split()


def test_parameters_are_read():
    """A function shall read all its parameters, but one that is written twice: both are called alike."""
    times, unread = Counter(), []
    for name in checked(MODULES):
        code = source(name)[1]
        for match in re.finditer(r"^func\s[^\n(]*?(?<![\w#])(\w+)\s*\(([^()]*)\)\s*(?=\{)", code, flags=re.M):
            depth, end = 1, match.end() + 1
            while depth > 0:
                depth += (code[end] == "{") - (code[end] == "}")
                end += 1
            times[match[1]] += 1
            named = {parameter.split()[-1] for parameter in match[2].split(",") if " " in parameter.strip()}
            found = sorted(named - set(re.findall(r"\w+", code[match.end() : end])))
            unread += [(match[1], f"{name}: {parameter} of {match[1]}") for parameter in found]
    wrong = [text for function, text in unread if function not in UNREAD and times[function] == 1]
    assert times.total() > 2000 and not wrong, "\n".join(wrong)


def prose(name):
    """The sentences of a module's head behind its first line, but what the scene must define."""
    head = re.sub(r"^// From the scene: .*\n(?://   .*\n)*", "", source(name)[0], flags=re.M)
    text = " ".join(line.removeprefix("//").strip() for line in head.splitlines()[1:])
    return [sentence for sentence in re.split(r"(?<=[.:?]) (?=[A-Z`(\d])", text.strip()) if sentence]


def test_heads():
    """A module of 20 lines or more shall open with at most six plain sentences, and no list of names."""
    wrong = []
    for name in checked(MODULES):
        sentences, lines = prose(name), (EDP / name).read_text().count("\n")
        if "// Gives:" in source(name)[0] or "// Needs:" in source(name)[0]:
            wrong.append(f"{name}: a list of names")
        if len(sentences) > 6 or (lines >= 20 and not sentences):
            wrong.append(f"{name}: {len(sentences)} sentences")
        wrong += [
            f"{name}: {len(sentence.split())} words: {sentence}" for sentence in sentences if len(sentence.split()) > 40
        ]
    assert not wrong, f"{len(wrong)}\n" + "\n".join(wrong)


def test_paths():
    """Files and folders that a comment names shall exist; a run makes its results, `make mpi` what is in build."""
    wrong = []
    for name in checked(MODULES + SCRIPTS):
        comments = "\n".join(re.findall(r"//(.*)", (EDP / name).read_text()))
        named_paths = [path for path in paths(comments) if not path.startswith(("results/", "build/"))]
        wrong += [f"{name}: {path}" for path in named_paths if not (EDP / path).exists() and not (ROOT / path).exists()]
    assert not wrong, "\n".join(wrong)


def test_glossary():
    """Names of the code in the glossary shall be there, and each term shall stand in it once."""
    rows = [row.split(" | ") for row in (EDP / "docs/GLOSSARY.md").read_text().splitlines() if row.startswith("| ")]
    terms = [row[0].removeprefix("| ") for row in rows if row[0] != "| term"]
    assert len(set(terms)) == len(terms) > 50
    names = {name for row in rows for name in re.findall(r"`([a-zA-Z]\w*)`", row[1])}
    summary, laws_and_words = {"backsolves", "estimates"}, {"signorini", "leg", "tie"}
    hooks = (EDP / "input/hooks.idp").read_text()
    options = set(re.findall(r"^macro (\w+)File\(\)", hooks, re.M))
    assert names - set(owners()) - summary - laws_and_words - options == set()
