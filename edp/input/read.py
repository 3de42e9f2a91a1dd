"""The reader's program: read.py COMMAND NAME=VALUE... (reader/command.py). Exit code 12: this Python cannot run it."""

import os
import sys
from importlib.machinery import PathFinder
from pathlib import Path

sys.path.append(str(Path(__file__).parent))


class OfDebian:
    """Finds gmsh's module where Debian's package has it: a single file, which any Python can load."""

    @staticmethod
    def find_spec(name, path=None, target=None):
        return PathFinder.find_spec(name, ["/usr/lib/python3/dist-packages"]) if name == "gmsh" else None


sys.meta_path.append(OfDebian)
known = os.environ.get("CONTACT_READER") == sys.executable  # as fit
if not known and (sys.version_info < (3, 11) or not PathFinder.find_spec("numpy")):
    sys.exit(12)
if not known and not any(finder.find_spec("gmsh") for finder in (PathFinder, OfDebian)):
    sys.exit(12)

from reader.command import main  # noqa: E402

sys.exit(main(sys.argv[1:]))
