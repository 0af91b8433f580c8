"""A headless Chromium that is controlled through its DevTools protocol."""
import json
import os
import shutil
import signal
import socket
import tempfile
import time

OPTIONS = ("--headless --hide-scrollbars --no-sandbox --disable-gpu --disable-dev-shm-usage --remote-debugging-pipe --no-first-run "
           "--disable-extensions --disable-sync --disable-component-update --disable-background-networking --no-proxy-server").split()
NO_CHROMIUM = "no Chromium is installed (Debian package chromium)"


class BrowserLost(Exception):
    """The browser did not answer in time, or has ended; it cannot be used any more."""


def find_chromium():
    """The program of an installed Chromium, or None."""
    names = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable")
    return next(filter(None, map(shutil.which, names)), None)


class Browser:
    """A running browser with one empty page, with a folder of its own for its data and temporary files. Nothing that it does reaches the
    network; it is gone, with all its processes, when it is closed, as at the end of a `with` block.

    Its process reads commands from descriptor 3 and writes answers and events to descriptor 4, as JSON that ends with a zero byte."""

    def __init__(self, program):
        self.received, self.events, self.calls = b"", [], 0
        self.folder = tempfile.mkdtemp(prefix="nlmech-browser-")
        # A socket instead of pipes: it serves both directions and has a time-out.
        self.channel, theirs = socket.socketpair()
        files = [(os.POSIX_SPAWN_OPEN, n, os.devnull, os.O_RDWR, 0) for n in (0, 1, 2)]
        files += [(os.POSIX_SPAWN_DUP2, theirs.fileno(), 3), (os.POSIX_SPAWN_DUP2, 3, 4)]
        # Without a sandbox, so that it runs as root too, as it does in containers: it shows only pages of this project.
        words = [program, *OPTIONS, f"--user-data-dir={self.folder}", "--host-resolver-rules=MAP * ~NOTFOUND", "about:blank"]
        # A process group of its own, to be ended as one.
        self.process = os.posix_spawnp(program, words, os.environ | {"TMPDIR": self.folder}, file_actions=files, setpgroup=0)
        theirs.close()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def close(self):
        self.channel.close()
        os.killpg(self.process, signal.SIGKILL)
        os.waitpid(self.process, 0)
        # The browser's other processes are not our children: one that is still ending may write a last file.
        deadline = in_seconds(10)
        while os.path.exists(self.folder) and time.monotonic() < deadline:
            shutil.rmtree(self.folder, ignore_errors=True)
            time.sleep(0.02)

    def message(self, deadline):
        """The next answer or event."""
        while b"\0" not in self.received:
            self.channel.settimeout(max(deadline - time.monotonic(), 1e-3))
            try:
                piece = self.channel.recv(1 << 20)
            except TimeoutError:
                raise BrowserLost("the browser does not answer") from None
            except ConnectionError:
                piece = b""
            if not piece:
                raise BrowserLost("the browser has ended")
            self.received += piece
        text, _, self.received = self.received.partition(b"\0")
        return json.loads(text)

    def call(self, method, parameters=None, session=None, deadline=None):
        """The result of one command, of a page's session or of the browser. Events that come meanwhile are kept."""
        self.calls += 1
        command = {"id": self.calls, "method": method, "params": parameters or {}} | ({"sessionId": session} if session else {})
        deadline = deadline or in_seconds(60)
        self.channel.settimeout(max(deadline - time.monotonic(), 1e-3))
        try:
            self.channel.sendall(json.dumps(command).encode() + b"\0")
        except TimeoutError:
            raise BrowserLost("the browser does not answer") from None
        except ConnectionError:
            raise BrowserLost("the browser takes no commands: it has ended") from None
        while True:
            message = self.message(deadline)
            if "id" not in message:
                self.events.append(message)
            elif message["id"] == self.calls:
                if "error" in message:
                    raise RuntimeError(f"{method}: {message['error'].get('message', 'refused')}")
                return message["result"]

    def take_events(self):
        """All events that came and were not taken before."""
        events, self.events = self.events, []
        return events


class Tab:
    """An empty page in a browser, which shows one file after another."""

    def __init__(self, browser, domains=("Page",)):
        self.browser = browser
        self.deadline = in_seconds(120)  # a cold start on a busy machine
        target = browser.call("Target.createTarget", {"url": "about:blank"}, deadline=self.deadline)
        attached = browser.call("Target.attachToTarget", {"targetId": target["targetId"], "flatten": True}, deadline=self.deadline)
        self.session = attached["sessionId"]
        for domain in domains:
            self.call(f"{domain}.enable")

    def call(self, method, parameters=None):
        return self.browser.call(method, parameters, self.session, self.deadline)

    def open(self, address):
        """Loads what is at the address. Returns the events until then."""
        self.call("Page.navigate", {"url": address})
        events = self.browser.take_events()
        while not any(event["method"] == "Page.loadEventFired" for event in events):
            message = self.browser.message(self.deadline)
            events += [] if "id" in message else [message]
        return events

    def evaluate(self, script):
        """The value of a script, and what went wrong (None if nothing did)."""
        answer = self.call("Runtime.evaluate", {"expression": script, "awaitPromise": True, "returnByValue": True})
        return answer["result"].get("value"), answer.get("exceptionDetails")


def in_seconds(seconds):
    """A deadline so many seconds from now."""
    return time.monotonic() + seconds
