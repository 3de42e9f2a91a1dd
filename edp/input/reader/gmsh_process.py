"""gmsh in a process of its own, which can be ended, and ends with its parent.

A geometry is a program: it may loop for ever, crash gmsh, or say `Exit;`, which ends the process with code 0.
`in_child` forks, so that none of this reaches the reader, and returns what a function makes of gmsh's module there.
"""

from __future__ import annotations

import ctypes
import faulthandler
import os
import pickle
import select
import signal
import sys
import time
from collections.abc import Callable, Sequence
from typing import Any, TypeVar

from .words import Refusal

T = TypeVar("T")
DEATH_OF_PARENT = 1  # prctl's PR_SET_PDEATHSIG
FIRST, NEXT = 5.0, 60.0  # seconds after which a line says that gmsh is at work; then at each doubling


class GmshError(Exception):
    """gmsh cannot do it, in its own words or in ours; no sentence: the reader adds the file and what is allowed."""


def start(module: Any, options: Sequence[str] = ()) -> Any:
    """Starts gmsh's module: no files of options, no text on the terminal, the first error ends what is asked."""
    module.initialize(["gmsh", *options], readConfigFiles=False)
    module.option.setNumber("General.Terminal", 0)
    module.option.setNumber("General.AbortOnError", 2)
    module.option.setNumber("General.NumThreads", 1)
    return module


def version(module: Any) -> str:
    """The version of gmsh's library: the module's own number may be that of another one."""
    return str(module.option.getString("General.Version"))


def in_child(
    task: Callable[[Any], T],
    what: str = "",
    limit: float = float("inf"),
    say: Callable[[str], None] = lambda text: print(text, flush=True),
) -> T:
    """What task(gmsh) returns, in a process of its own; `what`: its name in the lines that say that gmsh is at work.

    Raises GmshError if gmsh refuses, crashes, ends by itself, or takes longer than `limit` seconds; a Refusal or an
    OSError of the task comes back as it is.
    """
    parent = os.getpid()
    inlet, outlet = os.pipe()
    sys.stdout.flush()
    child = os.fork()
    if child == 0:
        os.close(inlet)
        work(task, outlet, parent)
    os.close(outlet)
    ended = False
    try:
        answer = listen(inlet, what, limit, say)
        _, status = os.waitpid(child, 0)
        ended = True
    finally:
        os.close(inlet)
        if not ended:
            os.kill(child, signal.SIGKILL)
            os.waitpid(child, 0)
    if not answer:
        code = os.waitstatus_to_exitcode(status)
        why = f"gmsh crashed ({signal.Signals(-code).name})" if code < 0 else "it ends gmsh (Exit)"
        raise GmshError(f"gmsh makes no mesh of it: {why}")
    done, value = pickle.loads(answer)
    if not done:
        raise value
    return value


def end_with(parent: int) -> None:
    """This process, a child, ends when its parent does."""
    ctypes.CDLL(None).prctl(DEATH_OF_PARENT, signal.SIGKILL)
    if os.getppid() != parent:
        os._exit(0)


def work(task: Callable[[Any], Any], outlet: int, parent: int) -> None:
    """The child: it says nothing, answers through the pipe, and never returns."""
    try:
        faulthandler.disable()
        signal.signal(signal.SIGINT, signal.SIG_IGN)
        end_with(parent)
        nothing = os.open(os.devnull, os.O_RDWR)
        for stream in (0, 1, 2):
            os.dup2(nothing, stream)
        try:
            import gmsh  # type: ignore[import-not-found, unused-ignore]

            signal.signal(signal.SIGINT, signal.SIG_IGN)  # the module sets its own
            answer = True, task(start(gmsh))
        except (GmshError, Refusal, OSError) as error:
            answer = False, error
        except Exception as error:
            answer = False, GmshError(str(error) or type(error).__name__)
        with os.fdopen(outlet, "wb") as pipe:
            pickle.dump(answer, pipe, protocol=pickle.HIGHEST_PROTOCOL)
    finally:
        os._exit(0)


def goes_on() -> bool:
    """Whether the run that asks is still there: its number is in the environment's CONTACT_RUN."""
    run = os.environ.get("CONTACT_RUN", "0")
    try:
        with open(f"/proc/{run}/stat", encoding="utf-8", errors="replace") as file:
            return run == "0" or file.read().rpartition(")")[2].split()[0] not in "ZX"
    except OSError:
        return run == "0" or not os.path.exists("/proc/self/stat")


def listen(inlet: int, what: str, limit: float, say: Callable[[str], None]) -> bytes:
    """All that the child writes until it ends; lines say meanwhile that gmsh is at work."""
    begun, told = time.monotonic(), FIRST
    parts: list[bytes] = []
    while True:
        passed = time.monotonic() - begun
        ready, _, _ = select.select([inlet], [], [], max(0.0, min(told - passed, limit - passed, 1.0)))
        if ready:
            part = os.read(inlet, 1 << 20)
            if not part:
                return b"".join(parts)
            parts.append(part)
        elif time.monotonic() - begun >= limit:
            raise GmshError(f"gmsh takes longer than {limit:g} s")
        elif not goes_on():
            raise KeyboardInterrupt
        elif time.monotonic() - begun < told:
            continue
        elif what:
            first = told == FIRST
            say(
                f"gmsh meshes {what} ..."
                if first
                else f"gmsh has been at work on {what} for {told:g} s; Ctrl-C ends the run"
            )
            told = NEXT if first else 2 * told
        else:
            told = float("inf")
