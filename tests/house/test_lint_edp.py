"""The checker for FreeFEM sources: for each rule a text that passes and one that fails."""

import pytest
from lint_edp import MAX_LINE, check, main

SCRIPT = "// main.edp: the paper's test.\n"
MODULE = "// contact/points/points.idp: collocation points.\n"


def script(body):
    return check(SCRIPT + body)


@pytest.mark.parametrize("text", [SCRIPT, MODULE, MODULE + "\nreal a = 1;\n"])
def test_clean(text):
    assert check(text) == []


@pytest.mark.parametrize(
    "body, line, message",
    [
        ("\treal a;\n", 2, "tab"),
        ("real a;\n\n \n", 4, "trailing space"),
        ("real a;\r\nreal b;\r\n", 2, "carriage return"),
        ("real a;\nreal b;", 3, "no newline"),
        ("//" + "x" * (MAX_LINE - 1) + "\n", 2, f"line of {MAX_LINE + 1} characters"),
    ],
)
def test_layout(body, line, message):
    ((found_line, found),) = script(body)
    assert found_line == line
    assert found.startswith(message)


@pytest.mark.parametrize("text", ["", "\n", "real a;\n", "// a comment\n", "//main.edp: no space\n", "// main.edp:\n"])
def test_missing_header(text):
    assert [line for line, message in check(text) if "first line" in message] == [1]


BARE_LABEL = "int1d(Th, 3)(v)|int2d(Th,3)(v)|int3d(Th, qforder=3, 2)(v)|int1d(Th, [1, 2])(v)|intalledges(Th, 4)(v)"
BARE_LABEL += "|on(3, u=0)|on(bottom, 3, u=0, v=0)|on( -1, u=0)|label=3|label = [3, 4]"
BARE_LABEL += "|if (Th.be(i).label == 2) n++|if (Th[k].region != 1) n++"


def test_bare_label():
    """Each shall have one finding, in its line."""
    wrong = []
    for body in BARE_LABEL.split("|"):
        found = script(f"real a;\n{body};\n")
        if len(found) != 1 or found[0][0] != 3 or "bare integer label" not in found[0][1]:
            wrong.append(f"{body}: {found}")
    assert not wrong, "\n".join(wrong)


NAMED_LABEL = "int1d(Th, contactLine)(v)|int1d(Th, contactLine, qforder=3)(2 * v)|int2d(Th, qforder=3)(f(1, 2) * v)"
NAMED_LABEL += "|int2d(Th)(3 * v)|on(bottom, u1=0, u2=-1)|function(3, 4)|label=contactLine|int bottomLabel = 3"
NAMED_LABEL += "|if (Th.be(i).label == contactLine) n++|// on(3, u=0) and label=3|/* int1d(Th, 3)\n on(3, u=0) */"
NAMED_LABEL += '|cout << "on(3, u=0) label=3 \\" label=3" << endl'


def test_named_label():
    """None shall have a finding."""
    wrong = [f"{body}: {found}" for body in NAMED_LABEL.split("|") if (found := script(f"{body};\n"))]
    assert not wrong, "\n".join(wrong)


def test_command_line(tmp_path, capsys):
    good = tmp_path / "deep" / "good.idp"
    good.parent.mkdir()
    good.write_text(MODULE)
    assert main([str(tmp_path)]) == 0
    bad = tmp_path / "bad.edp"
    bad.write_text(SCRIPT + "real a; \n")
    (tmp_path / "ignored.txt").write_text("\t")
    assert main([str(tmp_path)]) == 1
    assert f"{bad}:2: trailing space" in capsys.readouterr().out
    assert main([str(good)]) == 0
