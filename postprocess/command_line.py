"""The command line of `python -m postprocess SUBCOMMAND ...`: one subcommand per file of the folder commands/.

Exit code 0 on success, 2 when an argument or a result file is refused; the reason is one line on stderr.
"""

import argparse
import os
import sys

from postprocess import commands
from postprocess.formatting import first_line
from postprocess.results import ResultsError, one_line


def parser() -> argparse.ArgumentParser:
    """The command line of the package, assembled from the modules in commands/."""
    top = argparse.ArgumentParser(
        prog="python -m postprocess",
        description="Figures and tables from the result folders of contact runs.",
        epilog="`python -m postprocess SUBCOMMAND --help` describes the arguments of a subcommand.",
    )
    subparsers = top.add_subparsers(title="subcommands", metavar="SUBCOMMAND", required=True)
    for name, module in commands.modules().items():
        summary = first_line(module)
        sub = subparsers.add_parser(
            name,
            help=summary,
            description=module.__doc__,
            formatter_class=argparse.RawDescriptionHelpFormatter,
        )
        module.add_arguments(sub)
        sub.set_defaults(run=module.run)
    return top


def main(argv: list[str] | None = None) -> int:
    """Runs one subcommand and returns the exit code of the process."""
    arguments = parser().parse_args(argv)
    try:
        arguments.run(arguments)
        sys.stdout.flush()
    except ResultsError as error:
        print(f"postprocess: {one_line(str(error), 2000)}", file=sys.stderr)
        return 2
    except BrokenPipeError:  # the reader of the output has had enough: `show RUN | head`
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 141
    except KeyboardInterrupt:
        return 130
    return 0
