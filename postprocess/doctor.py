"""What this package needs, what of it is here, and how to get the rest: `make doctor`.

Runs with any Python 3.8 or newer and nothing else: it must work where nothing is set up. Exit code 0 when everything
that `make run` needs is there, otherwise 1. With `--can own` or `--can venv` it answers the Makefile by its exit code.
"""

from __future__ import annotations

import importlib.metadata
import importlib.util
import os
import platform
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).resolve().parent.parent
FREEFEM = ["FreeFem++", "-nw", "-v", "0"]
SECONDS = 60  # for a program to answer
CACHE = os.environ.get("CONTACT_CACHE")  # where the Makefile keeps what it makes, if not here
VENV = Path(CACHE, "venv") if CACHE else ROOT / ".venv"
BUILD = Path(CACHE, "build") if CACHE else ROOT / "build"
PLUGINS = {
    "gmsh": "meshes",
    "lapack": "dense matrices",
    "bfstream": "files for ParaView",
    "qf11to25": "nodal stresses",
    "Element_P3": "P3",
    "Element_P4": "P4",
    "Element_P3dc": "P4",
}
PACKAGED = Path("/usr/lib/freefem++")  # where the package libfreefem++ puts them
FURTHER_PLUGINS = {"msh3": "meshes in space", "ff-Ipopt": "the scene disc-on-block-ipopt"}
MODULES = ("numpy", "matplotlib")
DEVELOPERS = ("pytest", "pytest-xdist", "ruff")

RELEASES = "https://github.com/FreeFem/FreeFem-sources/releases"
GMSH = "https://gmsh.info"
PACKAGES = {
    "FreeFem++": "freefem++ libfreefem++ libfreefem++-dev libopenblas0-pthread",
    "gmsh": "gmsh",
    "python": "python3 python3-venv",
    "gmsh's module": "python3-gmsh python3-numpy",
    "make": "make",
    "chromium": "chromium",
    "mpi": "openmpi-bin libopenmpi-dev",
    "petsc": "libpetsc-real-dev, or `make mpi`, which installs it too",
}
# How to get a program where there is no apt-get: {system: {program: words}}.
ELSEWHERE = {
    "Darwin": {
        "FreeFem++": f"the official .dmg from {RELEASES}, in /Applications; its Contents/ff-VERSION/bin on the PATH",
        "gmsh": f"brew install gmsh, or {GMSH}",
        "gmsh's module": "pip install gmsh numpy",
        "python": "brew install python, or https://www.python.org",
        "make": "xcode-select --install",
        "chromium": "brew install --cask chromium",
        "mpi": "brew install open-mpi",
        "petsc": "brew install petsc, then `make mpi PETSC=/its/folder` (not tried)",
    },
    "Windows": {
        "FreeFem++": f"Debian or Ubuntu in WSL, then as there; the .exe of {RELEASES} has no POSIX shell",
        "gmsh": f"{GMSH}; its folder must be on the PATH",
        "gmsh's module": "pip install gmsh numpy",
        "python": "https://www.python.org",
        "make": "the MSYS2 package make; simplest: WSL",
        "chromium": "any Chromium on the PATH",
        "mpi": "simplest: WSL",
        "petsc": "simplest: WSL",
    },
    "": {
        "FreeFem++": f"your system's packages, or {RELEASES}",
        "gmsh": f"your system's packages, or {GMSH}",
        "gmsh's module": "your system's packages, or pip install gmsh numpy",
        "python": "your system's packages: Python 3.11 or newer with its venv module",
        "make": "your system's packages",
        "chromium": "your system's packages",
        "mpi": "your system's packages: Open MPI or MPICH with its compilers",
        "petsc": "your system's packages, then `make mpi PETSC=/its/folder`",
    },
}


class Finding(NamedTuple):
    """What was looked for, whether it is there, what was found, whether `make run` needs it, how to get it."""

    name: str
    there: bool
    found: str
    needed: bool = True
    hint: str = ""


# ---------------------------------------------------------------- what others use too


def program_output(command: list, cwd: Path | str = ROOT) -> tuple[int, str]:
    """(exit code, output) of a program; (-1, reason) where it cannot be started or does not answer."""
    try:
        done = subprocess.run(
            [str(word) for word in command],
            cwd=str(cwd),
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            timeout=SECONDS,
        )
    except subprocess.TimeoutExpired:
        return -1, f"no answer within {SECONDS} s"
    except OSError as error:
        return -1, error.strerror or str(error)
    return done.returncode, done.stdout.decode(errors="replace")


def run_freefem_lines(text: str, verbosity: int = 0) -> tuple[int, str]:
    """A few lines run by FreeFEM in the repository's root, as the scenes are."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "doctor.edp"
        path.write_text(text)
        return program_output(["FreeFem++", "-nw", "-v", str(verbosity), path])


def freefem_version() -> str:
    """What FreeFEM calls itself, and what Debian calls it; empty when it does not run."""
    _, output = run_freefem_lines("exit(0);\n", 1)
    found = re.search(r"FreeFem\+\+ +v?(\d[\w.]*)", output)
    if not found:
        return ""
    code, package = (
        program_output(["dpkg-query", "-W", "-f", "${Version}", "freefem++"]) if shutil.which("dpkg-query") else (1, "")
    )
    return found.group(1) + (f" (Debian's package {package.strip()})" if code == 0 and package.strip() else "")


def gmsh_version() -> str:
    code, output = program_output(["gmsh", "--version"])
    words = output.split()
    return words[-1] if code == 0 and words else ""


def blas() -> str:
    """Which BLAS the system's alternatives point to; empty where that is not known."""
    if not shutil.which("update-alternatives"):
        return ""
    _, names = program_output(["update-alternatives", "--get-selections"])
    for line in names.splitlines():
        words = line.split()
        if words and words[0].startswith("libblas.so.3"):
            return words[-1]
    return ""


def versions() -> dict:
    """Programs other than Python and its modules, by name."""
    found = {"FreeFEM": freefem_version(), "gmsh": gmsh_version(), "BLAS": blas()}
    return {name: version or "not found" for name, version in found.items()}


def processor() -> str:
    """The processor's name."""
    try:
        found = re.search(r"^model name\s*:\s*(.*)$", Path("/proc/cpuinfo").read_text(), re.M)
    except OSError:
        found = None
    return found.group(1).strip() if found else (platform.processor() or "unknown processor")


def cores() -> int:
    return os.cpu_count() or 1


def distribution() -> dict:
    """The keys of /etc/os-release; none where there is no such file."""
    try:
        text = Path("/etc/os-release").read_text()
    except OSError:
        return {}
    return {name: value.strip('"') for name, value in re.findall(r"^(\w+)=(.*)$", text, re.M)}


def system_name() -> str:
    return distribution().get("PRETTY_NAME") or f"{platform.system()} {platform.release()}"


# ---------------------------------------------------------------- the findings


def hint(program: str) -> str:
    """How to get a program on this system."""
    if shutil.which("apt-get"):
        return f"apt-get install {PACKAGES[program]}"
    return ELSEWHERE.get(platform.system(), ELSEWHERE[""])[program]


def find_freefem() -> list:
    """FreeFEM itself, then its plugins, each loaded by a script."""
    if not shutil.which("FreeFem++"):
        return [Finding("FreeFem++", False, "not on the PATH", True, hint("FreeFem++"))]
    version = freefem_version()
    if not version:
        return [Finding("FreeFem++", False, "is there, but does not run", True, hint("FreeFem++"))]
    findings = [Finding("FreeFem++", True, f"{version}, {shutil.which('FreeFem++')}", True)]
    for plugins, needed in ((PLUGINS, True), (FURTHER_PLUGINS, False)):
        for name, use in plugins.items():
            code, _ = run_freefem_lines(f'load "{name}"\n')
            words = use if code == 0 else f"cannot be loaded ({use})"
            findings.append(Finding(f"  plugin {name}", code == 0, words, needed, plugin_hint(name)))
    return [*findings, *plugin_path(all(finding.there for finding in findings if finding.needed))]


def plugin_hint(name: str = "") -> str:
    """How to get a plugin: from Debian's package where FreeFEM is Debian's, otherwise by naming its folder."""
    if name and (PACKAGED / "gmsh.so").exists() and not (PACKAGED / f"{name}.so").exists():
        return "this system's package libfreefem++ is without it: what needs it says so"
    if shutil.which("apt-get") and os.path.realpath(shutil.which("FreeFem++") or "/usr/bin/").startswith("/usr/bin/"):
        return "apt-get install libfreefem++; run FreeFem++ in the repository's root, where freefem++.pref is"
    return 'add the plugins\' folder to ~/.freefem++.pref: loadpath += "/path/to/lib/ff++/.../lib"'


def plugin_path(works: bool) -> list:
    """The folders in which plugins are looked for: those of freefem++.pref, and the environment's."""
    try:
        text = (ROOT / "freefem++.pref").read_text()
    except OSError:
        return [
            Finding(
                "  plugin path",
                works,
                "no freefem++.pref in the repository's root",
                True,
                "git checkout freefem++.pref",
            )
        ]
    folders = re.findall(r'^loadpath \+= "(.*)"', text, re.M)
    words = [f"{folder}{'' if Path(folder).is_dir() else ' (not here)'}" for folder in folders]
    if os.environ.get("FF_LOADPATH"):
        words.append(f"FF_LOADPATH={os.environ['FF_LOADPATH']}")
    return [Finding("  plugin path", works, ", ".join(words), True, plugin_hint())]


def find_gmsh() -> list:
    version = gmsh_version() if shutil.which("gmsh") else ""
    found = f"{version}, {shutil.which('gmsh')}" if version else "not on the PATH, or does not run"
    code, _ = program_output(["sh", str(ROOT / "edp/input/read.sh"), "0", "ready"])
    module = Finding("  its module", code == 0, "for Python, with numpy: reads cases", False, hint("gmsh's module"))
    return [Finding("gmsh", bool(version), found, True, hint("gmsh")), module]


def numbers(version: str) -> tuple:
    return tuple(map(int, re.findall(r"\d+", version)[:3]))


def within_bounds() -> bool:
    """Are there, in this Python itself, the packages that requirements.txt asks for?"""
    for line in (ROOT / "requirements.txt").read_text().split():
        stated = re.fullmatch(r"(\w+)>=([\d.]+),<([\d.]+)", line)
        if not stated:
            return False
        name, least, below = stated.groups()
        try:
            version = numbers(importlib.metadata.version(name))
        except importlib.metadata.PackageNotFoundError:
            return False
        if not numbers(least) <= version < numbers(below):
            return False
    return True


def python_is_able(what: str) -> bool:
    """Is this Python new enough, and can it draw by its own packages, or make a virtual environment with pip in it?"""
    modules = {"own": ("venv",), "venv": ("venv", "ensurepip")}.get(what)
    if sys.version_info < (3, 11) or not modules or not all(map(importlib.util.find_spec, modules)):
        return False
    # a virtual environment's packages are not those that another one made by it would see
    return what != "own" or (sys.prefix == sys.base_prefix and within_bounds())


def find_python() -> list:
    """A Python for the virtual environment, and what is in it."""
    able = [
        name
        for what in ("own", "venv")
        for name in ("python3", "/usr/bin/python3")
        if program_output([name, __file__, "--can", what])[0] == 0
    ]
    version = program_output([able[0], "--version"])[1].strip() if able else platform.python_version()
    words = (
        f"{version}, {shutil.which(able[0])}" if able else f"{version}; needed: 3.11 or newer, with venv and ensurepip"
    )
    findings = [Finding("Python", bool(able), words, True, hint("python"))]
    own = next((path for path in (VENV / "bin/python", VENV / "Scripts/python.exe") if path.exists()), None)
    for names, needed in ((MODULES, True), (DEVELOPERS, False)):
        for name in names:
            version = module_version(own, name)
            found = version or f"{'not in' if own else 'no'} {VENV.name}"
            findings.append(Finding(f"  {name}", bool(version), found, needed, "make setup"))
    return findings


def module_version(python: Path | None, name: str) -> str:
    """The version of a package of the virtual environment; empty where there is none."""
    if python is None:
        return ""
    code, output = program_output([python, "-c", f"import importlib.metadata as m; print(m.version({name!r}))"])
    return output.strip() if code == 0 else ""


def find_others() -> list:
    """What speeds up or what only some targets need."""
    findings = []
    make = shutil.which("make")
    findings.append(Finding("make", bool(make), make or "not on the PATH", True, hint("make")))
    library = blas()
    if library:
        slow = "openblas" not in library and "mkl" not in library and "blis" not in library
        words = f"{library}{' (slow)' if slow else ''}"
        findings.append(Finding("BLAS", not slow, words, False, "apt-get install libopenblas0-pthread"))
    browser = next(
        (path for path in map(shutil.which, ("chromium", "chromium-browser", "google-chrome")) if path), None
    )
    words = browser or "not on the PATH; the tests of the report's page are skipped"
    findings.append(Finding("Chromium", bool(browser), words, False, hint("chromium")))
    return findings


def find_multigrid() -> list:
    """What -solver multigrid wants: MPI, FreeFem++-mpi, PETSc, and the plugin that `make mpi` builds."""
    launcher, compiler = shutil.which("mpiexec"), shutil.which("mpicxx")
    there = " and ".join(path for path in (launcher, compiler) if path)
    findings = [Finding("MPI", bool(launcher and compiler), there or "not on the PATH", False, hint("mpi"))]
    for name in ("FreeFem++-mpi", "ff-c++"):
        path = shutil.which(name)
        findings.append(Finding(f"  {name}", bool(path), path or "not on the PATH", False, hint("FreeFem++")))
    own = os.environ.get("PETSC_DIR")
    folders = [Path(own) / os.environ.get("PETSC_ARCH", "")] if own else []
    folders += sorted(Path("/usr/lib/petscdir").glob("petsc*/*-linux-gnu-real"))
    petsc = next((folder for folder in folders if (folder / "include/petsc.h").exists()), None)
    words = str(petsc or "not found; needed for -solver multigrid only")
    findings.append(Finding("PETSc", bool(petsc), words, False, hint("petsc")))
    return [*findings, find_built_plugin("multigrid", "make mpi")]


def find_built_plugin(name: str, how: str) -> Finding:
    """A plugin that `make` builds: under the name that the scripts ask for, from the present source."""
    asked = next((ROOT / "edp/input/without").glob(f"{name}-plugin-*.idp"), Path("none"))
    plugin, source, log = BUILD / asked.name, ROOT / f"edp/solver/plugins/{name}.cpp", BUILD / f"{name}.log"
    compiler = os.environ.get("CXX", "g++")
    if not plugin.exists():
        words = "not built; runs go on without it"
        if list(BUILD.glob(f"{name}-plugin*.idp")):
            words = "of another version of the package: it stands aside"
        elif not (shutil.which("ff-c++") and shutil.which(compiler)):
            words += f"; no ff-c++ or no {compiler} on the PATH"
        elif log.exists():
            words = f"could not be built: {log} says why; runs go on without it"
        return Finding(f"  plugin {name}", False, words, False, how)
    if run_freefem_lines(f'load "{plugin.stem}"\n')[0] != 0:
        return Finding(f"  plugin {name}", False, "built, but cannot be loaded", False, f"rm {plugin}; {how}")
    old = source.exists() and source.stat().st_mtime > plugin.stat().st_mtime
    return Finding(f"  plugin {name}", not old, "built, older than its source" if old else "built", False, how)


# ---------------------------------------------------------------- the lines


def lines(findings: list) -> list:
    """The findings as an aligned table; below each that is missing, how to get it."""
    width = max(len(finding.name) for finding in findings) + 2
    printed = []
    for finding in findings:
        mark = "ok     " if finding.there else ("MISSING" if finding.needed else "absent ")
        printed.append(f"{mark}  {finding.name:<{width}}{finding.found}")
        if not finding.there and finding.hint:
            printed.append(f"{'':<{9 + width}}-> {finding.hint}")
    return printed


def main() -> int:
    if sys.argv[1:2] == ["--can"]:
        return 0 if python_is_able(sys.argv[2]) else 1
    print(f"{system_name()}, {processor()}, {cores()} cores")
    findings = [
        *find_freefem(),
        *find_gmsh(),
        *find_python(),
        *find_others(),
        find_built_plugin("fast", "make fast"),
        *find_multigrid(),
    ]
    print("\n".join(lines(findings)))
    missing = [finding.name.strip() for finding in findings if finding.needed and not finding.there]
    if not missing:
        print("Everything that `make run` needs is there.")
        return 0
    print(f"Missing for `make run`: {', '.join(missing)}.")
    if shutil.which("apt-get"):
        print("`make setup` installs all of it, as root or where sudo asks for no password.")
    return 1


if __name__ == "__main__":
    sys.exit(main())
