"""The package in bare systems, each in a tree of its own that debootstrap makes: `make test-systems`, before a release.

In each tree: the README's commands, `make test`, and runs on the .msh files of this
machine, whose counts must be the same everywhere, but for one back-substitution that rounding decides, and whose forces
must agree to 1e-9. Needs root, debootstrap, the
distributions' mirrors and keys; what could not be tried is named. The trees stay in the folder CONTACT_SYSTEMS, if that
is set, and are gone on with. Words on the command line choose systems: trixie noble. Logs and the table of results are
in results/systems/. Exit code 0: all were tried, and all is as it should be.
"""

import contextlib
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).resolve().parent.parent
RESULTS = ROOT / "results" / "systems"
CERTIFICATES = Path("etc/ssl/certs/ca-certificates.crt")
BARE = {"PATH": "/usr/sbin:/usr/bin:/sbin:/bin", "HOME": "/root", "OPENBLAS_NUM_THREADS": "1"}


class System(NamedTuple):
    """A distribution's release: its name, debootstrap's words."""

    name: str
    mirror: str
    components: str
    keys: str
    like: str  # a release that any debootstrap knows, of the same kind


DEBIAN = ("http://deb.debian.org/debian", "main", "debian-archive-keyring.gpg", "sid")
UBUNTU = ("http://archive.ubuntu.com/ubuntu", "main,universe", "ubuntu-archive-keyring.gpg", "gutsy")
SYSTEMS = {
    "bookworm": System("Debian 12", *DEBIAN),
    "trixie": System("Debian 13", *DEBIAN),
    "noble": System("Ubuntu 24.04", *UBUNTU),
}

# ---------------------------------------------------------------- trees


class NotTried(Exception):
    """What was not there."""


def bootstrap(release, tree):
    """A bare system of this release in the folder `tree`, unless one is there."""
    system = SYSTEMS[release]
    made = tree / "etc/systems-made"
    if made.exists():
        return
    if os.geteuid() != 0 or not shutil.which("debootstrap"):
        raise NotTried("needs root and debootstrap")
    keys = Path("/usr/share/keyrings") / system.keys
    words = [f"--keyring={keys}"] if keys.exists() else ["--no-check-gpg"]
    if not keys.exists():
        print(f"{system.name}: no {keys} here: its packages are taken unchecked")
    shutil.rmtree(tree, ignore_errors=True)
    known = Path("/usr/share/debootstrap/scripts", release).exists()
    words += ["--variant=minbase", f"--components={system.components}", release, tree, system.mirror]
    done = subprocess.run(["debootstrap", *words, *([] if known else [system.like])], capture_output=True, text=True)
    if done.returncode:
        raise NotTried(f"debootstrap: {(done.stdout + done.stderr).strip().splitlines()[-1]}")
    made.touch()


@contextlib.contextmanager
def mounted(tree):
    """The tree with this machine's names of hosts, and processes to see."""
    shutil.copy("/etc/resolv.conf", tree / "etc/resolv.conf")
    subprocess.run(["mount", "-t", "proc", "proc", tree / "proc"], check=True)
    try:
        yield tree
    finally:
        subprocess.run(["umount", tree / "proc"], check=True)


def inside(tree, command, folder="/contact"):
    """(exit code, output) of a shell's line in the tree, which then has the certificates of this machine's network."""
    line = f"cd {folder or '/'} && {command}"
    # not into pipes, which a program that stays behind would keep open
    with tempfile.TemporaryFile() as said:
        done = subprocess.run(
            ["chroot", tree, "sh", "-c", line], env=BARE, stdin=subprocess.DEVNULL, stdout=said, stderr=said
        )
        said.seek(0)
        output = said.read().decode(errors="replace")
    if (tree / CERTIFICATES).exists():
        shutil.copy("/" / CERTIFICATES, tree / CERTIFICATES)
    return done.returncode, output


def tracked(folder):
    """The package's files in a folder, as `git clone` and Docker's COPY give them."""
    names = subprocess.run(["git", "-C", ROOT, "ls-files", "-z"], capture_output=True, text=True, check=True).stdout
    for name in names.split("\0")[:-1]:
        if (ROOT / name).exists():
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(ROOT / name, folder / name)


# ---------------------------------------------------------------- the same numbers on the same meshes

EXAMPLES = {"pin-in-hole": 2, "press-fit": 2, "roller": 2, "crossed-cylinders": 3}
FLAGS = {
    "paper": "edp/main.edp -method paper -order 1 -h 0.5",
    "disc": "edp/main.edp -h 1",
    "axisymmetric": "edp/main.edp -geometry axisymmetric -h 1",
    "confined": "edp/scenes/confined-block.edp",
    "meshed-disc": "edp/scenes/meshed-disc.edp -h 1",
    "exact": "edp/scenes/two-cylinders.edp -h 0.4 -distance exact",
    "signorini": "edp/scenes/patch-test.edp -method signorini",
    "adhesive": "edp/scenes/adhesive-sphere.edp -h 0.06",
    "sphere": "edp/scenes/sphere-on-block.edp -h 0.8 -layers 2",
    "two-spheres": "edp/scenes/two-spheres.edp -h 0.5 -layers 1",
}
COUNTS = "adaptations newton newtonPerAdaptation factorisations wallPoints contactPoints ndof points".split()
NUMBERS = "force pressureMax overlapMax approach".split()


def runs():
    """{name: flags of FreeFem++}; the examples on meshes/generated/systems/*.msh."""
    found = dict(FLAGS)
    for name, dimension in EXAMPLES.items():
        script = "edp/parts.edp" if dimension == 2 else "edp/parts-3d.edp"
        mesh = f"meshes/generated/systems/{name}.msh"
        found[name] = f"{script} -mesh {mesh} -case edp/examples/{name}/{name}.case"
    return found


def own_meshes():
    """The examples' meshes, made by this machine's gmsh."""
    folder = ROOT / "meshes/generated/systems"
    folder.mkdir(parents=True, exist_ok=True)
    for name, dimension in EXAMPLES.items():
        geo, mesh = ROOT / f"edp/examples/{name}/{name}.geo", folder / f"{name}.msh"
        command = ["gmsh", f"-{dimension}", "-v", "0", "-format", "msh22", geo, "-o", mesh]
        subprocess.run(command, check=True, stdin=subprocess.DEVNULL)


def numbers(root, execute):
    """{run: its summary, or what it said}; execute(line) runs a line of the shell in `root`."""
    found = {}
    for name, flags in runs().items():
        out = f"results/systems/{name}"
        code, said = execute(f"FreeFem++ -nw -v 0 {flags} -vtu 0 -estimate 0 -out {out}")
        path = root / out / "summary.json"
        found[name] = json.loads(path.read_text()) if code == 0 else f"code {code}: {said.strip()[-200:]}"
    return found


def here(line):
    done = subprocess.run(
        line,
        shell=True,
        cwd=ROOT,
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
        env={**os.environ, "OPENBLAS_NUM_THREADS": "1"},
    )
    return done.returncode, done.stdout + done.stderr


def differences(found, reference):
    """(lines on what differs, greatest relative difference of a number)."""
    lines, greatest = [], 0.0
    for name, expected in reference.items():
        if isinstance(found[name], str) or isinstance(expected, str):
            lines += [f"{name}: {found[name]}"] if isinstance(found[name], str) else [f"{name}, here: {expected}"]
            continue
        differing = [key for key in COUNTS if found[name].get(key) != expected.get(key)]
        if abs(found[name]["backsolves"] - expected["backsolves"]) > 1:
            differing.append("backsolves")
        lines += [f"{name}: {key} {found[name].get(key)}, here {expected.get(key)}" for key in differing]
        # the forces of a press fit add up to zero
        least = expected["pressureMax"] * sum(
            contact.get("contactLength", 0) for contact in expected.get("contacts", [])
        )
        for key in NUMBERS:
            here, there = (run.get(key) or 0 for run in (expected, found[name]))  # null: not known
            size = max(abs(here), least if key == "force" else 0)
            off = abs(there - here) / size if size else 0.0
            if key == "overlapMax" and expected["wallPoints"]:  # at the wall it is rounding
                continue
            greatest = max(greatest, off)
            if off > 1e-9:
                lines.append(f"{name}: {key} off by {off:.1e}")
    return lines, greatest


# ---------------------------------------------------------------- a system


def doors():
    """The README's commands."""
    text = (ROOT / "README.md").read_text()
    return [line for block in re.findall(r"^```sh\n(.*?)^```", text, re.M | re.S) for line in block.splitlines()]


def attempt(release, tree, reference):
    """(what goes into the table, what failed) of one system."""
    bootstrap(release, tree)
    failed, log = [], RESULTS / f"{release}.log"
    log.write_text("")

    def execute(line, folder="/contact"):
        code, said = inside(tree, line, folder)
        with open(log, "a") as file:
            print(f"$ {line}\n{said}\ncode {code}", file=file)
        return code, said

    with mounted(tree):
        install = "apt-get -q update && DEBIAN_FRONTEND=noninteractive apt-get -q -y --no-install-recommends install"
        if execute(f"{install} make ca-certificates", "/")[0]:
            raise NotTried("apt-get reaches no mirror")
        for name in ("edp", "meshes", "tests", "postprocess"):
            shutil.rmtree(tree / "contact" / name, ignore_errors=True)
        tracked(tree / "contact")
        commands = doors()
        failed += [f"{line}: code {code}" for line in commands if (code := execute(line)[0])]
        words = "dpkg-query -W -f '${Version}' freefem++; echo; gmsh --version; .venv/bin/python -V; "
        words += ".venv/bin/python -c 'import numpy, matplotlib as m; print(numpy.__version__, m.__version__)'"
        versions = execute(words)[1].replace("Python ", "").split("\n")
        pytest = f"PYTEST_ARGS='{os.environ.get('PYTEST_ARGS', '')}' TESTS='{os.environ.get('TESTS', 'tests')}'"
        _, said = execute(f"make test {pytest}")
        counted = re.findall(r"^(.*\b(?:passed|failed|error)\b.*) in [\d.]+s", said, re.M)
        counts = " and ".join(counted) or "did not run"
        if "failed" in counts or "error" in counts or "passed" not in counts:
            failed.append(f"make test: {counts}")
        # this machine's meshes: newer than any geometry, so that they are taken
        meshes = "meshes/generated"
        shutil.copytree(ROOT / meshes, tree / "contact" / meshes, copy_function=shutil.copy, dirs_exist_ok=True)
        lines, greatest = differences(numbers(tree / "contact", execute), reference)
        failed += lines
    same = "all" if not lines else f"all but {len({line.split(':')[0] for line in lines})}"
    return [SYSTEMS[release].name, *versions[:4], f"{same} of {len(reference)}, {greatest:.0e}", counts], failed


HEAD = ["system", "FreeFEM's package", "gmsh", "Python", "numpy, matplotlib", "the same numbers", "`make test`"]


def main(chosen):
    unknown = set(chosen) - SYSTEMS.keys()
    if unknown:
        print(f"{' '.join(sorted(unknown))}: no such system; allowed: {' '.join(SYSTEMS)}")
        return 10
    RESULTS.mkdir(parents=True, exist_ok=True)
    kept = os.environ.get("CONTACT_SYSTEMS")
    rows, all_well = [HEAD, ["---"] * len(HEAD)], True
    with contextlib.ExitStack() as stack:
        trees = Path(kept or stack.enter_context(tempfile.TemporaryDirectory()))
        own_meshes()
        reference = numbers(ROOT, here)
        for release in chosen or SYSTEMS:
            try:
                row, failed = attempt(release, trees / release, reference)
                rows.append(row)
            except NotTried as reason:
                failed = [f"not tried: {reason}"]
            all_well = all_well and not failed
            print(
                "\n".join(f"{SYSTEMS[release].name}: {line}" for line in failed or ["all is as it should be"]),
                flush=True,
            )
    table = "\n".join(f"| {' | '.join(row)} |" for row in rows)
    (RESULTS / "systems.md").write_text(table + "\n")
    print(table)
    return 0 if all_well else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
