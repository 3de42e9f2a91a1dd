"""A small style checker for FreeFEM sources (.edp, .idp).

Reports `file:line: message` for tabs, trailing space, CRLF, a missing final newline, long lines, a missing module
header and integers where a named label belongs. Exit code: 0 clean, 1 findings, 2 nothing to check.
"""

import argparse
import re
import sys
from pathlib import Path

MAX_LINE = 140

HEADER = re.compile(r"// [^\s:]+: \S")
COMMENT_OR_STRING = re.compile(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\])*"', re.DOTALL)
LABEL_VALUE = re.compile(r"\b(?:label|region)\s*(?:==?|!=)\s*\[?\s*[-+]?\d+")
LABEL_CALL = re.compile(r"\b(?:on|int[123]d|intalledges|intallfaces)\s*\(")
INTEGER = r"[-+]?\d+"
INTEGERS = re.compile(rf"\[?\s*{INTEGER}(?:\s*,\s*{INTEGER})*\s*\]?")


def blank_comments_and_strings(text):
    """The text with comments and strings turned into spaces; all else keeps its place."""
    return COMMENT_OR_STRING.sub(lambda match: re.sub(r"[^\n]", " ", match.group()), text)


def arguments(code, start):
    """The arguments of a call as (position, text), without blanks; `start` follows its opening parenthesis.

    Commas within brackets do not separate arguments. A call that is never closed yields all but its last argument.
    """
    found, depth, first = [], 0, start
    for position in range(start, len(code)):
        char = code[position]
        if depth == 0 and char in ",)":
            text = code[first:position].lstrip()
            found.append((position - len(text), text.rstrip()))
            first = position + 1
            if char == ")":
                break
        depth += (char in "([{") - (char in ")]}")
    return found


def bare_labels(text):
    """(line, words) wherever an integer stands for a label or a region."""
    code = blank_comments_and_strings(text)
    found = [(match.start(), match.group()) for match in LABEL_VALUE.finditer(code)]
    for call in LABEL_CALL.finditer(code):
        for position, argument in arguments(code, call.end()):
            if INTEGERS.fullmatch(argument):
                found.append((position, f"{call.group()}... {argument}"))
    return [(code.count("\n", 0, position) + 1, words) for position, words in found]


def header_problems(lines):
    """What is wrong with the line that opens a file."""
    return [] if HEADER.match(lines[0]) else ["the first line must be '// name: what it does'"]


def check(text):
    """All findings in one source as a sorted list of (line, message)."""
    found = []
    if "\r" in text:
        found.append((text.count("\n", 0, text.index("\r")) + 1, "carriage return: end lines with LF alone"))
        text = text.replace("\r", "")
    if not text.endswith("\n"):
        found.append((text.count("\n") + 1, "no newline at the end of the file"))
    lines = text.split("\n")
    found += [(1, message) for message in header_problems(lines)]
    found += [(line, f"bare integer label '{words}': name it") for line, words in bare_labels(text)]
    for number, line in enumerate(lines, 1):
        if "\t" in line:
            found.append((number, "tab"))
        if line != line.rstrip():
            found.append((number, "trailing space"))
        if len(line) > MAX_LINE:
            found.append((number, f"line of {len(line)} characters, at most {MAX_LINE}"))
    return sorted(found)


def sources(path):
    """The FreeFEM sources under a folder, or the file itself."""
    if path.is_dir():
        return sorted(file for file in path.rglob("*") if file.suffix in (".edp", ".idp"))
    return [path] if path.is_file() else []


def main(argv=None):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("paths", nargs="+", type=Path, metavar="PATH", help="a folder, searched in depth, or a file")
    files = []
    for path in parser.parse_args(argv).paths:
        if not path.exists():
            parser.error(f"no such file or folder: {path}")
        under = sources(path)
        if not under:
            parser.error(f"no .edp or .idp file under {path}")
        files += under

    count = 0
    for file in files:
        try:
            found = check(file.read_bytes().decode())
        except UnicodeDecodeError:
            found = [(1, "not UTF-8 text")]
        for line, message in found:
            print(f"{file}:{line}: {message}")
        count += len(found)
    print(f"lint_edp: {len(files)} files, {count} findings")
    return 1 if count else 0


if __name__ == "__main__":
    sys.exit(main())
