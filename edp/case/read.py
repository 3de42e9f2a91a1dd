"""The reader's program: read.py COMMAND NAME=VALUE... (reader/command.py). Exit code 12: this Python cannot run it."""

import sys
from importlib.util import find_spec, spec_from_file_location
from pathlib import Path

sys.path.append(str(Path(__file__).parent))
DEBIAN = Path("/usr/lib/python3/dist-packages/gmsh.py")  # a single file, which any Python can load


class OfDebian:
    """Finds gmsh's module where Debian's package has it."""

    @staticmethod
    def find_spec(name, path=None, target=None):
        return spec_from_file_location(name, DEBIAN) if name == "gmsh" and DEBIAN.is_file() else None


sys.meta_path.append(OfDebian)
if sys.version_info < (3, 11) or not find_spec("numpy") or not find_spec("gmsh"):
    sys.exit(12)

from reader.command import main  # noqa: E402

sys.exit(main(sys.argv[1:]))
