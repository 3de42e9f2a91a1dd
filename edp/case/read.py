"""The reader's program: read.py COMMAND NAME=VALUE... (reader/command.py). Exit code 12: this Python cannot run it."""

import sys
from importlib.util import find_spec
from pathlib import Path

sys.path.append(str(Path(__file__).parent))
DEBIAN = "/usr/lib/python3/dist-packages/gmsh.py"  # a single file, which any Python can load

if sys.version_info < (3, 11) or not find_spec("numpy") or not (find_spec("gmsh") or Path(DEBIAN).is_file()):
    sys.exit(12)

from reader.command import main  # noqa: E402

sys.exit(main(sys.argv[1:]))
