"""How long many runs take: said before they begin, and now and then while they go on.

A run has its seconds of last time, or else its usual length in default runs. How long a default run takes here is found
by a start of FreeFEM that prints the help.
"""

import subprocess
import sys
import time
from collections.abc import Sequence
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
HELP = 0.57  # of a default run's time: a start with -help


def default_run(freefem: Sequence[str]) -> float:
    """Seconds that a default run takes here and now, by one start; 0.2 if FreeFEM does not start."""
    begin = time.monotonic()
    try:
        command = [*freefem, "edp/main.edp", "-help"]
        subprocess.run(command, cwd=ROOT, check=True, capture_output=True, stdin=subprocess.DEVNULL)
    except (OSError, subprocess.CalledProcessError):
        return 0.2
    return (time.monotonic() - begin) / HELP


def expect(
    title: str,
    last: Sequence[float | None],
    usual: Sequence[float],
    jobs: int,
    freefem: Sequence[str],
    after: Sequence[float] = (),
) -> list[float]:
    """Says how many pieces there are and how long they will take, `jobs` at once; the seconds of each.

    last: seconds of last time, None where there was none; usual: default runs. after: default runs of the pictures that
    follow one by one, whose seconds end the result.
    """
    unknown = sum(seconds is None for seconds in last)
    unit = default_run(freefem) if unknown or after else 0.0
    found = [unit * runs if seconds is None else seconds for seconds, runs in zip(last, usual, strict=True)]
    pictures = [unit * runs for runs in after]
    if found or pictures:
        count = f"{len(found)} run{'s' * (len(found) != 1)}"
        count += f" and {len(pictures)} picture{'s' * (len(pictures) != 1)}" * bool(pictures)
        at_once = min(jobs, max(len(found), 1))
        basis = f" ({unknown} of them guessed from a start here)" if unknown else ""
        total = clock(sum(found) / at_once + sum(pictures))
        print(f"{title}: {count}, about {total}{basis}", file=sys.stderr, flush=True)
    return found + pictures


class Progress:
    """Now and then a line with the time left."""

    def __init__(self, title: str, total: float, count: int, pause: float = 20.0):
        self.title, self.total, self.count, self.pause = title, max(total, 1e-9), count, pause
        self.begin = self.last = time.monotonic()
        self.spent, self.runs, self.failures = 0.0, 0, 0

    def step(self, weight: float, good: bool = True) -> None:
        """A piece of this weight has ended; a line, unless the last one was less than `pause` seconds ago."""
        self.spent += weight
        self.runs += 1
        self.failures += not good
        now = time.monotonic()
        if now - self.last > self.pause or self.runs == self.count:
            share = min(self.spent / self.total, 1.0)
            left = clock((now - self.begin) * (1 - share) / max(share, 1e-9))
            lost = f", {self.failures} not converged" if self.failures else ""
            print(f"{self.title} {self.runs}/{self.count}, {left} left{lost}", file=sys.stderr, flush=True)
            self.last = now


def clock(seconds: float) -> str:
    """Seconds as 1:05, or 1:00:05."""
    minutes, seconds = divmod(round(seconds), 60)
    hours, minutes = divmod(minutes, 60)
    return f"{hours}:{minutes:02d}:{seconds:02d}" if hours else f"{minutes}:{seconds:02d}"
