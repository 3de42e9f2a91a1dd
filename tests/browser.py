"""A headless Chromium, told what to do through its DevTools pipe: no driver and no further Python package.

`with Browser(folder) as browser: page = browser.open(path)`: then `page.evaluate(expression)`,
`page.messages` (what it complained about) and `page.requests` (what it asked the network for).
"""

import contextlib
import fcntl
import json
import os
import select
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

CHROMIUM = next((path for path in map(shutil.which, ("chromium", "chromium-browser", "google-chrome")) if path), None)
FLAGS = (
    "--headless --no-sandbox --disable-gpu --disable-dev-shm-usage --no-first-run --disable-background-networking"
).split()
SECONDS = 60


class Browser:
    """The browser's process; `folder` is where it may keep its profile."""

    def __init__(self, folder):
        near, self.write = os.pipe()
        self.read, far = os.pipe()
        to_child, from_child = (fcntl.fcntl(end, fcntl.F_DUPFD, 10) for end in (near, far))
        command = [CHROMIUM, *FLAGS, "--remote-debugging-pipe", f"--user-data-dir={folder}"]
        # Chromium takes commands on file descriptor 3 and answers on 4.
        place = f"import os, sys; os.dup2({to_child}, 3); os.dup2({from_child}, 4); os.execv(sys.argv[1], sys.argv[1:])"
        words = [sys.executable, "-c", place, *command]
        quiet = {"stdin": subprocess.DEVNULL, "stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
        self.process = subprocess.Popen(words, pass_fds=(to_child, from_child), start_new_session=True, **quiet)
        for end in (near, far, to_child, from_child):
            os.close(end)
        self.buffer = b""
        self.number = 0
        self.events = []

    def __enter__(self):
        return self

    def __exit__(self, *_):
        with contextlib.suppress(ProcessLookupError):
            os.killpg(self.process.pid, signal.SIGKILL)
        self.process.wait()
        os.close(self.write)
        os.close(self.read)

    def call(self, method, session=None, **parameters):
        """One command and its answer; events that come before it are kept."""
        self.number += 1
        message = {"id": self.number, "method": method, "params": parameters}
        if session:
            message["sessionId"] = session
        data = json.dumps(message).encode() + b"\0"
        while data:
            data = data[os.write(self.write, data) :]
        while True:
            answer = self.next()
            if answer.get("id") == self.number:
                assert "error" not in answer, f"{method}: {answer['error']}"
                return answer["result"]
            self.events.append(answer)

    def next(self):
        """The next message."""
        deadline = time.monotonic() + SECONDS
        while b"\0" not in self.buffer:
            ready, _, _ = select.select([self.read], [], [], max(0, deadline - time.monotonic()))
            data = os.read(self.read, 1 << 20) if ready else b""
            if not data:
                raise RuntimeError("Chromium does not answer")
            self.buffer += data
        message, _, self.buffer = self.buffer.partition(b"\0")
        return json.loads(message)

    def open(self, path, width=1200, height=900, scheme="light"):
        """A page of its own for a file, loaded to the end, in a window of that size, light or dark."""
        target = self.call("Target.createTarget", url="about:blank")["targetId"]
        session = self.call("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Log", "Network"):
            self.call(f"{domain}.enable", session)
        page = Page(self, session)
        page.resize(width, height)
        page.call("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": scheme}])
        self.call("Page.navigate", session, url=Path(path).resolve().as_uri())
        page.wait("document.readyState == 'complete'")
        return page


class Page:
    """One page of a browser."""

    def __init__(self, browser, session):
        self.browser, self.session = browser, session

    def call(self, method, **parameters):
        return self.browser.call(method, self.session, **parameters)

    def resize(self, width, height):
        mobile = width < 600
        self.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=mobile)

    def evaluate(self, expression):
        """The value of a JavaScript expression."""
        answer = self.call("Runtime.evaluate", expression=expression, returnByValue=True, awaitPromise=True)
        assert "exceptionDetails" not in answer, answer["exceptionDetails"]
        return answer["result"].get("value")

    def wait(self, expression):
        """Until an expression is true."""
        deadline = time.monotonic() + SECONDS
        while not self.holds(expression):
            assert time.monotonic() < deadline, f"never true: {expression}"
            time.sleep(0.05)

    def holds(self, expression):
        """Whether an expression is true; in a page that is left for the next one it is not."""
        try:
            return self.evaluate(expression)
        except AssertionError as error:
            if "navigated" in str(error) or "context" in str(error):
                return False
            raise

    def occurred(self, *methods):
        self.evaluate("1")  # what has happened so far has been told by the time this is answered
        return [
            event["params"]
            for event in self.browser.events
            if event.get("sessionId") == self.session and event.get("method") in methods
        ]

    @property
    def messages(self):
        """Errors and warnings of the console and of scripts."""
        return self.occurred("Runtime.consoleAPICalled", "Runtime.exceptionThrown", "Log.entryAdded")

    @property
    def requests(self):
        """The addresses that were asked for, pictures within the page aside."""
        found = [event["request"]["url"] for event in self.occurred("Network.requestWillBeSent")]
        return [url for url in found if not url.startswith("data:")]
