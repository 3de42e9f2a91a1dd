"""Do the errors that a run says hold on parts that no constant was fitted on? Part of `make coverage`.

The parts are those of foreign_parts.py, each run a few times as an engineer would: a mesh of first or second order, as
.geo or bare .msh, P2 or P4, linear or true distance, one mesh or `-accuracy`. The truth is a closed form, otherwise a
finer run of the true geometry: P4 (in space P2) on smooth curves of second order, all named, with the true distance,
and bodies that a case rotates drawn turned. What is uncertain about a truth, its difference from a run 1.6 times as
coarse, is its doubt; a number whose verdict depends on it is not judged.

Every number with a ± in summary.json is one of the table's. It is covered where the truth is within. It is warned of
where a warning that does not name another contact or load has one of CAUSES in it, and says, as "about 0.001 of ..." or
"... 0.1 %", what is within ten times of the true error, relative to the number. A pressure that grows without bound has
no true error: a word of SINGULAR is enough.

results/coverage/foreign.json keeps the runs of these sources, truths.json the truths of any: interrupted and started
again, it goes on where it was. `--anew` forgets truths: where the meaning of a number has changed.
"""

import argparse
import hashlib
import json
import re
import subprocess
import sys
import tempfile
import threading
from dataclasses import dataclass, replace
from pathlib import Path

import campaign
import numpy as np
from foreign_parts import Draw, Part, parts

from postprocess.progress import Progress

FOLDER = campaign.RESULTS_FOLDER / "coverage"
CAUSES = re.compile(
    r"polygon|shape|curve|gap|distance|turn|rotat|slide|master|mesh|edge|corner|tip|singular|bound", re.I
)
SINGULAR = re.compile(r"singular|without bound|unbounded|sharp|\bedge\b|\bcorner", re.I)
SIZE = re.compile(r"about ([\d.]+(?:e[+-]?\d+)?) of|([\d.]+(?:e[+-]?\d+)?) ?%", re.I)
OF_PRESSURES = re.compile(r"pressures? (jumps|grows|are not resolved)")  # and of where they end
OTHER_SIZE = re.compile(r"with [\d.]+ % of the force")  # not of an error
COARSER = 1.6  # of the run that tells the truth's doubt
TRIVIAL = 1e-6  # relative: what is prescribed, or told by the balance, has no error
TIMEOUT = 300
LIMITED = ("sh", "-c", 'ulimit -v 6000000; exec "$@"', "sh")  # a run shall not take the machine's memory


@dataclass(frozen=True)
class Job:
    """A run of a part."""

    part: Part
    draw: Draw
    flags: tuple[str, ...] = ()
    bare: str = ""  # gmsh's format of a bare mesh; "": a .geo file
    turned: bool = False  # the truth's case file

    @property
    def case(self) -> str:
        text = self.part.truth_case if self.turned and self.part.truth_case else self.part.case
        return text + ("pressure rest 0\n" if self.draw.named and '("rest")' in self.geo else "")

    @property
    def geo(self) -> str:
        return self.part.geo(self.draw)

    def key(self, sources: str = "") -> str:
        return hashlib.sha256("\0".join([self.geo, self.case, self.bare, *self.flags, sources]).encode()).hexdigest()[
            :16
        ]


def jobs_of(part: Part, seed: int) -> list[Job]:
    """The runs of an engineer: the plain one first, then random ones."""
    random = np.random.default_rng([seed, 77, *part.name.encode()])
    found = [Job(part, Draw())]
    for _ in range(1 if part.space else 3):
        order = 1 if random.random() < 0.6 else 2
        draw = Draw(10 ** random.uniform(-0.2, 0.2), order, not part.space and random.random() < 0.3)
        bare, flags = str(random.choice(["", "", "msh22", "msh4"])), []
        pick = random.random()
        if pick < 0.15 and not part.space:
            flags = ["-accuracy", str(random.choice(["1e-2", "1e-3"])), "-unknowns", "60000"]
        else:
            flags += ["-order", "4"] if random.random() < 0.35 and not part.space else []
            flags += ["-distance", "exact"] if pick > 0.7 else []
        found.append(Job(part, draw, tuple(flags), bare))
    return found


def truths_of(part: Part) -> dict[str, Job]:
    """fine and middle; linear: as middle with the gaps and the rotation of the engineer's run; smooth: as that itself.

    The last two say what a false number is false by.
    """
    found = {} if part.space else {"smooth": Job(part, Draw(order=2, named=True, smooth=True))}
    if not part.fine:
        return found
    degree = ("-order", "2" if part.space else "4", "-tol", "1e-8")
    draw = Draw(part.fine, 2, not part.space, smooth=True, turned=True)
    middle = replace(draw, factor=part.fine * COARSER)
    exact = (*degree, "-distance", "exact")
    found |= {"fine": Job(part, draw, exact, turned=True), "middle": Job(part, middle, exact, turned=True)}
    if {"gap", "rotation"} & set(part.causes):
        found["linear"] = Job(part, replace(middle, turned=False), degree)
    return found


def numbers_of(summary: dict) -> dict[str, list]:
    """Every number that has a place for its ±: name to [value, error or None]; a preload has none: 1 % of it."""
    told = summary.get("estimates") or {}
    found = {}
    for word, entry in told.items():
        for k, each in enumerate(entry if isinstance(entry, list) else []):
            for name, number in each.items():
                if isinstance(number, dict) and "error" in number:
                    found[f"{word}.{k}.{name}"] = [number["value"], number["error"]]
    if isinstance(told.get("energy"), dict):
        found["energy"] = [told["energy"]["value"], told["energy"]["error"]]
    for k, contact in enumerate(summary.get("contacts", [])):
        for name in ("pressureMax", "contactLength"):
            if isinstance(contact.get(name), float | int):
                found.setdefault(f"contacts.{k}.{name}", [contact[name], None])
        if "mesh" in contact:
            error = (contact["mesh"]["shearForce"] or {}).get("error")
            found[f"contacts.{k}.shearForce"] = [float(np.linalg.norm(contact["shearForce"])), error]
    for k, needs in enumerate(summary.get("prescribed", [])):
        if "error" in needs:
            found[f"prescribed.{k}.needs"] = [needs.get("force", needs.get("moment")), needs["error"]]
    for k, bolt in enumerate(summary.get("preloads", [])):
        found[f"preloads.{k}.tension"] = [bolt["force"], 0.01 * abs(bolt["force"])]
    return found


def record_of(summary: dict) -> dict:
    """Numbers, warnings, and the names of contacts, then loads, that warnings may speak of."""
    names = [contact["name"] for contact in summary.get("contacts", [])]
    names += [load["name"] for load in (summary.get("estimates") or {}).get("loads", [])]
    return {
        "numbers": numbers_of(summary) if summary.get("converged") else {},
        "warnings": summary.get("warnings", []),
        "names": names,
        "contacts": len(summary.get("contacts", [])),
        "dofs": summary.get("ndof"),
    }


def solve(job: Job, sources: Path, processes: campaign.Processes) -> dict:
    """What a run said."""
    with tempfile.TemporaryDirectory(prefix="foreign-") as name:
        folder = Path(name)
        mesh, case = folder / "part.geo", folder / "part.case"
        mesh.write_text(job.geo)
        case.write_text(job.case)
        if job.bare:
            target = mesh.with_suffix(".msh")
            command = ["gmsh", "-3" if job.part.space else "-2", "-v", "1", "-format", job.bare, mesh, "-o", target]
            subprocess.run(command, check=True, timeout=TIMEOUT, capture_output=True)
            mesh = target
        script = campaign.script_of("parts-3d" if job.part.space else "parts")
        flags = ["-mesh", str(mesh), "-case", str(case), *job.flags, "-vtu", "0", "-out", str(folder / "out")]
        done = processes.execute([*LIMITED, *campaign.FREEFEM, script, *flags], sources, folder / "out", TIMEOUT)
    return record_of(done.summary) | {
        "part": job.part.name,
        "flags": " ".join(job.flags),
        "mesh": f"{job.bare or 'geo'} order {job.draw.order} x {job.draw.factor:.2g}" + " named" * job.draw.named,
        "code": done.code,
        "seconds": done.wall,
        "said": "" if done.code == 0 else " | ".join(done.output.strip().splitlines()[-3:])[:300],
    }


class Store:
    """Records by key, in a file: those of other sources are forgotten."""

    def __init__(self, path: Path, sources: str = ""):
        self.path, self.lock, self.sources = path, threading.Lock(), sources
        old = json.loads(path.read_text()) if path.exists() else {}
        self.records = {key: record for key, record in old.items() if record.get("sources", "") == sources}

    def keep(self, key: str, record: dict) -> None:
        with self.lock:
            self.records[key] = record | {"sources": self.sources}
            self.path.parent.mkdir(parents=True, exist_ok=True)
            part = self.path.with_suffix(".part")
            part.write_text(json.dumps(self.records, indent=0))
            part.replace(self.path)


def work(todo: list[tuple[str, Job, Store]], sources: Path, jobs: int, title: str) -> None:
    todo = [(key, job, store) for key, job, store in todo if key not in store.records]
    if not todo:
        return
    processes, progress = campaign.Processes(), Progress(title, len(todo), len(todo))

    def one(key: str, job: Job, store: Store) -> None:
        record = solve(job, sources, processes)
        store.keep(key, record)
        progress.step(1, record["code"] == 0)

    with campaign.working(jobs, processes, progress) as pool:
        for future in [pool.submit(one, *each) for each in todo]:
            future.result()


# ---------------------------------------------------------------- verdicts


def truth_of(part: Part, known: dict[str, dict]) -> dict[str, tuple[float, float]]:
    """Value and doubt of each number: closed forms, then the fine run."""
    found = {}
    fine, middle = (known.get(which, {}).get("numbers", {}) for which in ("fine", "middle"))
    for name in fine.keys() & middle.keys():
        value = fine[name][0]
        found[name] = (value, abs(value - middle[name][0]))
    return found | part.known


def warned(name: str, value: float, error: float, record: dict) -> tuple[bool, list[str]]:
    """Whether a warning says this error's size; and all the warnings that are of this number."""
    word, _, rest = name.partition(".")
    own = None
    if word in ("contacts", "loads"):
        index = int(rest.partition(".")[0]) + (0 if word == "contacts" else record["contacts"])
        own = record["names"][index] if index < len(record["names"]) else None
    others = [each for each in record["names"] if each != own]
    mine = [w for w in record["warnings"] if (own and own in w) or not any(each in w for each in others)]
    if np.isfinite(error) and not name.endswith(("pressureMax", "contactLength")):
        mine = [w for w in mine if not OF_PRESSURES.search(w)]
    if np.isinf(error):
        return any(SINGULAR.search(w) for w in mine), mine
    share = error / abs(value) if value else np.inf
    said = [w for w in mine if CAUSES.search(w) and ("pressure jumps" not in w or name.endswith("pressureMax"))]
    sizes = [float(a) if a else float(b) / 100 for w in said for a, b in SIZE.findall(OTHER_SIZE.sub("", w))]
    return any(size / 10 <= share <= 10 * size for size in sizes), mine


def judged(part: Part, record: dict, known: dict[str, dict]) -> list[dict]:
    """A row a number that has a ± and a truth."""
    found = []
    truth = truth_of(part, known)
    for name, (value, said) in record["numbers"].items():
        if said is None or name not in truth:
            continue
        exact, doubt = truth[name]
        error = abs(value - exact)
        if said <= 1e-9 * abs(value) and error <= TRIVIAL * abs(value):
            continue
        has_size, warnings = warned(name, value, error, record)
        row = {"part": part.name, "number": name, "mesh": record["mesh"], "flags": record["flags"], "value": value}
        row |= {"said": said, "truth": exact, "doubt": doubt, "error": error, "warned": has_size, "warnings": warnings}
        sure = np.isinf(error) or error - doubt > said or error + doubt <= said
        row["covered"] = bool(error <= said) if sure else None
        row["cause"] = ""
        if row["covered"] is False:
            other = [known.get(which, {}).get("numbers", {}).get(name) for which in ("middle", "linear", "smooth")]
            middle, linear, smooth = (each[0] if each else np.nan for each in other)
            row["cause"] = cause(part, row, abs(middle - linear), abs(value - smooth))
        found.append(row)
    return found


def cause(part: Part, row: dict, model: float, shape: float) -> str:
    """What a false number is false by: where that is measured by half of it at least, else what the part shall show."""
    most = 0.5 * row["error"]
    if np.isinf(row["error"]) or "tip" in part.causes:
        return "singular"
    if "rotation" in part.causes and ("exact" in row["flags"] or np.isnan(model) or model > most):
        return "rotation"
    if "exact" not in row["flags"] and model > most:
        return "gap"
    if "shape" in part.causes and (np.isnan(shape) or shape > most):
        return "shape"
    local = row["number"].endswith(("pressureMax", "contactLength"))
    if local and "singular" in part.causes:
        return "singular"
    if local and "axis" in part.causes:
        return "node on the axis"
    return "master's mesh" if local and "master" in part.causes else "other"


def statistics(rows: list[dict]) -> list[str]:
    """Cells of the table."""
    covered = [row for row in rows if row["covered"]]
    either = [row for row in rows if row["covered"] or row["warned"]]
    silent = [row for row in rows if not row["covered"] and not row["warnings"]]
    finite = [row for row in rows if np.isfinite(row["error"])]
    apart = [(row["said"], max(row["error"], row["doubt"]), abs(row["value"])) for row in finite]
    ratio = [said / error for said, error, value in apart if error > 1e-12 * value]
    marked = [row for row in covered if row["warnings"]]

    def share(part, whole):
        return f"{100 * len(part) / len(whole):.1f} %" if whole else ""

    quantiles = [f"{np.quantile(ratio, q):.2g}" for q in (0.5, 0.9)] if ratio else ["", ""]
    return [
        str(len(rows)),
        share(covered, rows),
        share(either, rows),
        str(len(silent)),
        share(marked, covered),
        *quantiles,
    ]


HEADER = "numbers|covered|covered or warned of|false without a word|covered with a warning".split("|")
HEADER += ["median ratio", "90 % below"]


def kind_of(part: Part) -> str:
    return "space" if part.space else "about an axis" if "axisymmetric" in part.case else "plane"


def table(rows: list[dict], kinds: dict[str, str]) -> str:
    rows = [row for row in rows if row["covered"] is not None]
    groups = [("all", rows)]
    for kind in dict.fromkeys(kinds.values()):
        groups.append((kind, [row for row in rows if kinds[row["part"]] == kind]))
    for word in ("force", "pressureMax", "contactLength", "way", "energy", "needs", "shearForce"):
        groups.append((word, [row for row in rows if row["number"].endswith(word)]))
    for family in dict.fromkeys(row["part"].rpartition(" ")[0] for row in rows):
        groups.append((family, [row for row in rows if row["part"].startswith(f"{family} ")]))
    return campaign.markdown(["", *HEADER], [[name, *statistics(some)] for name, some in groups if some])


def causes(rows: list[dict]) -> str:
    """False numbers by cause: all, without a warning of their size, without a word."""
    false = [row for row in rows if row["covered"] is False]
    lines = []
    for name in sorted({row["cause"] for row in false}):
        some = [row for row in false if row["cause"] == name]
        parts_of = sorted({row["part"].rpartition(" ")[0] for row in some if not row["warned"]})
        unsaid = [sum(not row[word] for row in some) for word in ("warned", "warnings")]
        lines.append([name, len(some), *unsaid, ", ".join(parts_of)])
    return campaign.markdown(["cause", "false", "without their size said", "without a word", "parts"], lines)


def listing(rows: list[dict]) -> str:
    """The false numbers whose size no warning says, one a line."""
    lines = [
        f"{row['cause']:14} {row['part']:20} {row['number']:26} {row['value']:.6g} ± {row['said']:.2g}, "
        f"truth {row['truth']:.6g} ({row['mesh']}{' ' * bool(row['flags'])}{row['flags']})"
        + (" w" if row["warnings"] else "")
        for row in rows
        if row["covered"] is False and not row["warned"]
    ]
    return "\n".join(sorted(lines))


def measured(chosen: list[Part], seed: int, jobs: int = 1, folder: Path = FOLDER, anew: bool = False):
    """Rows of all numbers, and the records of all runs."""
    with campaign.frozen_sources(campaign.ROOT) as sources:
        digest = campaign.sources_digest(sources)
        runs, truths = Store(folder / "foreign.json", digest), Store(folder / "truths.json")
        wanted = {part.name: [(job.key(digest), job) for job in jobs_of(part, seed)] for part in chosen}
        exact = {part.name: {which: (job.key(), job) for which, job in truths_of(part).items()} for part in chosen}
        if anew:
            truths.records = {}
        work([(*pair, truths) for each in exact.values() for pair in each.values()], sources, jobs, "truths")
        work([(*pair, runs) for each in wanted.values() for pair in each], sources, jobs, "foreign parts")
    rows, records = [], []
    for part in chosen:
        known = {which: truths.records[key] for which, (key, _) in exact[part.name].items()}
        for key, _ in wanted[part.name]:
            records.append(runs.records[key])
            rows += judged(part, runs.records[key], known)
    return rows, records, [truths.records[key] for each in exact.values() for key, _ in each.values()]


def main(argv: list[str] | None = None) -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("part", nargs="?", default="", help="only parts whose name has this text")
    parser.add_argument("--seed", type=int, default=1, help="other numbers draw other parts")
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--anew", action="store_true", help="solve the truths again")
    parser.add_argument("--list", action="store_true", help="every false number whose size no warning says")
    arguments = parser.parse_args(argv)
    chosen = [part for part in parts(arguments.seed) if arguments.part in part.name]
    rows, records, truths = measured(chosen, arguments.seed, arguments.jobs, anew=arguments.anew)
    (FOLDER / "foreign-numbers.json").write_text(json.dumps(rows, indent=0, default=float))
    print(table(rows, {part.name: kind_of(part) for part in chosen}), causes(rows), sep="\n\n")
    unsaid = sum(said is None for record in records for _, said in record["numbers"].values())
    print(
        f"\n{len(chosen)} parts, {len(records)} runs; numbers without ±: {unsaid}; "
        f"not judged, the truth being in doubt: {sum(row['covered'] is None for row in rows)}"
    )
    for record in [*records, *truths]:
        if record["code"] != 0:
            print(f"exit {record['code']}: {record['part']}, {record['mesh']} {record['flags']}: {record['said']}")
    if arguments.list:
        print(f"\n{listing(rows)}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
