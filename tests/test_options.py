"""edp/options/: what a scene reads on request, what the others say of it, and that the core names none of it."""

import json
import re

import pytest
from freefem import ROOT, run, run_in, script, snippet
from test_contracts import EDP, MODULES, owners, uses
from test_readme import SCENES

LIST = (EDP / "options/options.idp").read_text()
OFFERS = re.findall(r'^optionOffers\("(\w+)", "([^"]*)",\s*"([^"]*)"\);', LIST, flags=re.M)
OPTIONS = sorted(path.name for path in (EDP / "options").iterdir() if path.is_dir())


def reads(name):
    """The options that a script of edp/ reads: by its own line, or by that of a script that it includes."""
    text = (EDP / name).read_text()
    line = re.search(r"^macro eachOption\(do, what\) (.*?)//", text, flags=re.M)
    own = re.findall(r"do\((\w+), what\)", line[1]) if line else []
    return set(own).union(*map(reads, re.findall(r'^include "((?:scenes/)?[\w-]+\.edp)"', text, flags=re.M)))


def test_list():
    """The list of options shall have each with the scenes that read it."""
    assert sorted(name for name, *_ in OFFERS) == OPTIONS
    for name, _, scenes in OFFERS:
        scripts = {scene: script(scene) for scene in SCENES} | {name: name + ".edp" for name in ("parts", "parts-3d")}
        assert sorted(scenes.split(", ")) == sorted(
            s for s in scripts if name in reads(scripts[s].removeprefix("edp/"))
        )


def test_core_names_no_option():
    """No module outside an option shall use what options alone declare, nor a scene that does not read it."""
    for name in [*MODULES, *(script(scene).removeprefix("edp/") for scene in SCENES)]:
        own = reads(name) if name.endswith(".edp") else {name.split("/")[1]} if name.startswith("options/") else set()
        for word in uses(name):
            homes = {owner.split("/")[1] if owner.startswith("options/") else "" for owner in owners()[word]}
            assert homes & {"", "options.idp", *own}, (name, word)


def test_not_read(tmp_path):
    """A scene without an option shall load nothing of it, and refuse its words, naming the scenes that read it."""
    assert not any(module.startswith("options/attraction") for module in run("disc-on-block").modules)
    table = tmp_path / "falls.csv"
    table.write_text("0,0\n1,-2\n2,1\n3,4\n")
    scenes = dict((name, scenes) for name, _, scenes in OFFERS)["attraction"]
    for flags, said in (
        (["-path", "0 1"], "-path 0 1"),
        (["-law", "lennard-jones"], "-law lennard-jones"),
        (["-law", "table", "-table", table], f"-table {table}, whose pressures fall"),
    ):
        done = run_in(ROOT, "edp/main.edp", *flags, out=tmp_path / "out", expect=10)
        assert done.stdout == f"{said}: not read by this scene; allowed in: {scenes}\n"
    assert not (tmp_path / "out").exists()


SECOND = """
macro secondLaws(do) do(springs) //
macro secondLawFiles() include "options/second/springs.idp" //
macro secondSolver() real second = numberFlag("-second", 2, "", "of the second option", 0, 9); //
macro secondBeforeSolving() second *= 10; //
macro secondSummary() put("second", second) //
"""
SPRINGS = """
func int springsPressure(real[int] & s, real[int] & p, real[int] & slope)
{
    for (int i = 0; i < s.n; i++) p[i] = max(100 * s[i], 0.);
    for (int i = 0; i < s.n; i++) slope[i] = s[i] > 0 ? 100. : 0.;
    return 0;
}
func int springsInverse(real[int] & p, real[int] & s)
{
    for (int i = 0; i < s.n; i++) s[i] = 0.01 * p[i];
    return 0;
}
func int springsPotential(real[int] & s, real[int] & W)
{
    for (int i = 0; i < s.n; i++) W[i] = 50 * max(s[i], 0.)^2;
    return 0;
}
"""


@pytest.mark.parametrize("options", ["do(second, what)", "do(attraction, what) do(second, what)"])
def test_side_by_side(tmp_path, options):
    """An option shall need no more than its folder and the scene's line, alone and beside another one."""
    folder = tmp_path / "options/second"
    folder.mkdir(parents=True)
    (folder / "second.idp").write_text(SECOND)
    (folder / "springs.idp").write_text(SPRINGS)
    text = f'macro eachOption(do, what) {options} //\ninclude "main.edp"\n'
    words = ["-h", 5, "-second", 3, "-law", "springs", "-vtu", 0, "-estimate", 0, "-out", tmp_path / "out"]
    path = ["-path", "1 2", "-steps", 1] if "attraction" in options else []
    snippet(tmp_path, text, *words, *path)
    summary = json.loads((tmp_path / "out/summary.json").read_text())
    assert summary["second"] == 30 and summary["parameters"]["law"] == "springs"
    assert ("pullOff" in summary) == bool(path)
