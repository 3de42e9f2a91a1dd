"""The page "One Newton step, file by file" is that of the code."""

import newton_step


def test_page():
    """The page's tables shall be those of a run: functions in their order, files, first sentences, how many."""
    assert newton_step.written(newton_step.PAGE.read_text()) == newton_step.PAGE.read_text()


def test_description():
    """The first sentence shall be read from below a function's lines, or from behind it."""
    text = "func real a(real x)\n// How far it is; more.\n// And more.\n{ return x; }\n"
    text += "func int b(int k, int l,\n    int m)\n"
    text += "// The second. Then.\n{ ; }\nfunc int c() { ; }    // Behind it.\nfunc int d()\n{ ; }\n"
    found = [newton_step.description(text, name) for name in "abcd"]
    assert found == ["How far it is", "The second.", "Behind it.", ""]


def test_one_step():
    """The last whole step, from the linear solve to the question whether another one is needed."""
    names = "solveLinearised a needsNewtonStep updateThreshold solveLinearised b c needsNewtonStep publish".split()
    assert [name for _, name in newton_step.one_step([("f", name) for name in names])] == names[4:8]
