"""`python -m postprocess SUBCOMMAND ...`: starts command_line.main in Python's safe-path mode.

Python puts the present folder first on its path of modules. A user's numpy.py or csv.py there would take the place of
the real one, so Python starts again with -P, which leaves that folder out; PYTHONPATH names the package's folder.
"""

import os
import sys


def restart_in_safe_path_mode() -> None:
    """Replaces this process by the same command with -P."""
    package = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
    folders = [package, *filter(None, [os.environ.get("PYTHONPATH")])]
    environment = os.environ | {"PYTHONPATH": os.pathsep.join(folders)}
    os.execve(sys.executable, [sys.executable, "-P", *sys.orig_argv[1:]], environment)


if __name__ == "__main__":
    if not sys.flags.safe_path:
        restart_in_safe_path_mode()
    from postprocess.command_line import main

    sys.exit(main())
