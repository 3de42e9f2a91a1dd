"""What runs the package without an installation: the Dockerfile, Binder, a development container, hosted tests."""

import json
import re
import shlex

import pytest
from freefem import ROOT, execute

DOCKERFILE = ROOT / ".binder/Dockerfile"
KNOWN = "FROM RUN COPY WORKDIR CMD ARG ENV USER".split()


def instructions(text):
    """(word, rest) of a Dockerfile's instructions; lines that a backslash joins are one."""
    lines = re.sub(r"\\\n", "", re.sub(r"^#.*\n", "", text, flags=re.M)).splitlines()
    return [tuple(line.split(maxsplit=1)) for line in lines if line.strip()]


def stages(text):
    """{name: its instructions} in their order."""
    found = {}
    for word, rest in instructions(text):
        if word == "FROM":
            image, _, name = rest.partition(" AS ")
            found[name] = [("FROM", image)]
        else:
            found[list(found)[-1]].append((word, rest))
    return found


def test_dockerfile():
    """Known instructions, lists in JSON, shell that can be read, folders that exist, targets that make has."""
    text = DOCKERFILE.read_text()
    for word, rest in instructions(text):
        assert word in KNOWN, word
        if rest.startswith("["):
            assert all(isinstance(one, str) for one in json.loads(rest))
        elif word == "RUN":
            assert execute(["sh", "-n", "-c", rest])[0] == 0, rest
            shlex.split(rest)
    targets = re.findall(r"^([a-z-]+):.*## ", (ROOT / "Makefile").read_text(), re.M)
    asked = re.findall(r"(?:RUN|&&) make ([a-z]+)", text)
    assert set(asked) == {"setup", "notebooks"} <= set(targets)


def test_binder():
    """Binder's image: the last one, of the package's, with Jupyter on the path, run by the user that Binder names."""
    parts = stages(DOCKERFILE.read_text())
    assert list(parts) == ["package", "notebooks"] and parts["notebooks"][0] == ("FROM", "package")
    words = parts["notebooks"]
    given = dict(rest.split("=") for word, rest in words if word == "ARG")
    assert set(given) == {"NB_USER", "NB_UID"} and given["NB_UID"] == "1000"
    (user,) = (rest for word, rest in words if word == "USER")
    assert user == "${NB_USER}" and words.index(("USER", user)) > max(
        place for place, (word, _) in enumerate(words) if word == "RUN"
    )
    environment = " ".join(rest for word, rest in words if word == "ENV")
    assert "PATH=/contact/.venv/bin:$PATH" in environment and "HOME=/home/${NB_USER}" in environment
    installed = " ".join(rest for word, rest in words if word == "RUN" and "pip install" in rest)
    assert all(f"'{name}>=" in installed for name in ("jupyterlab", "notebook"))
    # Binder looks at one of its folders only, and a Dockerfile in the root would be a second one
    assert not (ROOT / "binder").exists() and not (ROOT / "Dockerfile").exists()


def test_devcontainer():
    """The development container shall be the package's image of the same Dockerfile."""
    told = json.loads((ROOT / ".devcontainer/devcontainer.json").read_text())
    built = told["build"]
    assert (ROOT / ".devcontainer" / built["dockerfile"]).resolve() == DOCKERFILE.resolve()
    assert (ROOT / ".devcontainer" / built["context"]).resolve() == ROOT.resolve()
    assert built["target"] in stages(DOCKERFILE.read_text())
    assert told["postCreateCommand"].split()[0] == "make"


def test_workflow():
    """The hosted tests shall run .ci/run, and every night all tests, in the Debian of the Dockerfile."""
    yaml = pytest.importorskip("yaml")
    folder = ROOT / ".github/workflows"
    told = yaml.safe_load((folder / "tests.yml").read_text())
    assert set(told[True]) == {"push", "pull_request", "schedule"}  # YAML reads the word `on` so
    (job,) = told["jobs"].values()
    steps = [step.get("run") or step["uses"] for step in job["steps"]]
    assert any(step.startswith("actions/checkout@v") for step in steps)
    asked = {step["run"]: step["if"] for step in job["steps"] if "if" in step}
    night = "github.event_name == 'schedule'"
    everything = "make tools && make test-all PYTEST_ARGS=--no-skips"
    assert asked == {"bash .ci/run": night.replace("==", "!="), everything: night}
    assert (ROOT / ".ci/run").exists() and job["timeout-minutes"] >= 120
    assert job["container"] == stages(DOCKERFILE.read_text())["package"][0][1]
    installed = set(re.search(r"install -y --no-install-recommends (.*)", steps[0])[1].split())
    assert installed >= {"git", "make", "ca-certificates"}


def test_workflow_of_the_site():
    """The site that a forge publishes shall be that of `make site`, with the notebooks, on the same Debian."""
    yaml = pytest.importorskip("yaml")
    told = yaml.safe_load((ROOT / ".github/workflows/pages.yml").read_text())
    (job,) = told["jobs"].values()
    asked = [step["run"] for step in job["steps"] if "run" in step]
    made = re.search(r"^site: .*\n\t.*--out \$\(RESULTS\)/(\S+)", (ROOT / "Makefile").read_text(), re.M)
    (uploaded,) = [step["with"]["path"] for step in job["steps"] if "upload-pages-artifact" in step.get("uses", "")]
    assert asked[-1] == "make setup && make notebooks && make site" and uploaded == f"results/{made[1]}"
    assert job["container"] == stages(DOCKERFILE.read_text())["package"][0][1]
    assert told["permissions"] == {"contents": "read", "pages": "write", "id-token": "write"}


def test_page_of_containers():
    """The page's commands shall build what there is."""
    page = (ROOT / "edp/docs/howto/install.md").read_text()
    (command,) = re.findall(r"^docker build (.*)$", page, re.M)
    words = shlex.split(command)
    assert words[words.index("-f") + 1] == ".binder/Dockerfile" and words[-1] == "."
    assert words[words.index("--target") + 1] in stages(DOCKERFILE.read_text())
