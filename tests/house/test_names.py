"""Names that gave way to the field's terms do not come back: tests/data/retired-names.txt has them, a line each."""

import re

from freefem import ROOT, data

RETIRED = set(data("retired-names.txt").split())


def test_retired_names():
    """No identifier and no comment of the scripts shall use a retired name."""
    wrong = []
    for path in sorted(path for kind in ("idp", "edp", "awk", "sh") for path in (ROOT / "edp").rglob(f"*.{kind}")):
        found = RETIRED & set(re.findall(r"[A-Za-z][A-Za-z0-9]*", path.read_text()))
        wrong += [f"{path.relative_to(ROOT)}: {name}" for name in sorted(found)]
    assert len(RETIRED) > 2000 and not wrong, "\n".join(wrong)
