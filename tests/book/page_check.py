"""Loads all pages of a book in headless browsers and reports their errors.

A finding is a tuple of page (relative to the book's folder), kind and text. Kinds: a link to a file that does not exist, that lies outside
the folder, or to a place that its page does not have ("link"); an image that cannot be shown ("image"); a formula left as TeX or refused by
MathJax ("formula"); an error on the console, a script or style that cannot be loaded, or an exception that nobody caught ("error"); a
request that would leave the machine ("network"); a page that scrolls sideways ("width") or is not done in time ("time"); a list that begins
with another number than 1, or a blank before a full stop, where a number was lost ("number"); a brief description that ends within a bracket
("summary"). Of pages with figures or tables, at both widths: a picture for which fewer than eight words stand, or its caption
("alternative"); a table of at most eleven columns that is wider than its own column on a desk, or one whose verdict or effect is out of sight
("table"); a chapter of more than 40 screens ("length"). Of a picture that is opened by itself: words that its frame cuts off ("picture")."""
import concurrent.futures
import json
import os
import pathlib
import re
import time
import urllib.parse

from browser import Browser, BrowserLost, Tab, in_seconds

HERE = pathlib.Path(__file__).parent
PROBE, LAYOUT, PICTURE = ((HERE / f"{name}.js").read_text(encoding="utf-8") for name in ("probe", "layout", "picture"))
PHONE, DESK = (390, 844), (1400, 900)  # size of the window, px: a phone in portrait format, and a desktop for figures and tables
PREPARED = ("mathjax/MathJax.js", "<figure", 'class="markdownTable"')


def frame_of(page):
    """What comes before a page's contents, without its title and its place in the tree. Pages with the same frame differ in their contents
    alone, and those of such pages need no script of their own. None for pages without a frame, with formulas, or with figures or tables,
    which scripts prepare."""
    frame, contents, _ = page.partition('<div id="doc-content">')
    if not contents or any(mark in page for mark in PREPARED):
        return None
    return re.sub(r"<title>.*?</title>|initNavTree\('[^']*'", "", frame, flags=re.DOTALL)


def leaves_the_machine(address):
    """By anything but files and what a page contains itself."""
    return address != "" and address.partition(":")[0] not in ("file", "data", "blob", "about")


def in_events(events):
    """Kind and text of the findings among a browser's events."""
    for event in events:
        method, values = event.get("method"), event.get("params", {})
        if method == "Runtime.exceptionThrown":
            details = values["exceptionDetails"]
            yield "error", details.get("exception", {}).get("description", details.get("text", "")).partition("\n")[0]
        elif method == "Runtime.consoleAPICalled" and values["type"] in ("error", "assert"):
            words = [each.get("description", json.dumps(each["value"]) if "value" in each else "") for each in values["args"]]
            yield "error", " ".join(["console:", *words])
        elif method == "Log.entryAdded" and values["entry"]["level"] == "error":
            # A request that leaves the machine is a finding by itself; its failure may come after the page is done.
            if not leaves_the_machine(values["entry"].get("url", "")):
                yield "error", f"{values['entry'].get('text', '')} {values['entry'].get('url', '')}"
        elif method == "Network.requestWillBeSent" and leaves_the_machine(values["request"].get("url", "")):
            yield "network", values["request"]["url"]


class Reader:
    """A browser that looks at one page after another. Pages that differ in nothing but plain contents, as most of the API reference, are
    shown in the frame of the first of them: loading the same scripts a thousand times takes minutes."""

    def __init__(self, program, seconds):
        self.browser, self.seconds = Browser(program), seconds
        self.frame = None  # of the page that is loaded, if other pages can be shown in it
        self.tab = Tab(self.browser, ("Page", "Runtime", "Log", "Network"))
        self.resize(PHONE)

    def resize(self, size):
        self.tab.call("Emulation.setDeviceMetricsOverride", {"width": size[0], "height": size[1], "deviceScaleFactor": 1, "mobile": False})

    def run(self, script):
        """The value of a script, and its failure as a list of findings."""
        value, failure = self.tab.evaluate(script)
        return value, [("error", f"the probe failed: {json.dumps(failure)[:300]}")] if failure else []

    def look(self, file):
        """Shows a page. Returns its links, anchors and friends, and the findings (kind, text)."""
        self.tab.deadline = in_seconds(self.seconds)
        self.browser.take_events()
        text, address = file.read_text(encoding="utf-8", errors="replace"), "file://" + urllib.parse.quote(str(file))
        frame = frame_of(text)
        framed = frame is not None and frame == self.frame
        events = [] if framed else self.tab.open(address)
        self.frame = frame
        page, findings = self.run(f"{PROBE}({json.dumps(text if framed else None)},{json.dumps(address)})")
        if page and page["explains"]:
            for next_size in (DESK, PHONE):
                found, failures = self.run(LAYOUT)
                findings += [*map(tuple, found or []), *failures]
                self.resize(next_size)
        findings += [*in_events(events + self.browser.take_events()), *map(tuple, page["findings"] if page else [])]
        return page or {"links": [], "anchors": [], "friends": []}, findings

    def look_at_picture(self, file):
        """Opens a picture by itself. Returns the findings."""
        self.tab.deadline = in_seconds(self.seconds)
        self.frame = None
        self.tab.open("file://" + urllib.parse.quote(str(file)))
        found, failures = self.run(PICTURE)
        return [*map(tuple, found or []), *failures]


def broken(name, address, folder, pages, friends):
    """What is wrong with a link of a page, if anything."""
    if not address.startswith("file://"):  # out of the book, or a script's
        return None
    path, _, place = address.removeprefix("file://").partition("#")
    file, place = os.path.normpath(urllib.parse.unquote(path.partition("?")[0])), urllib.parse.unquote(place)
    target = os.path.relpath(file, folder)
    if target.startswith(".."):
        return f"leads out of the book: {file}"
    if not os.path.exists(file):
        return f"leads to no file: {target}"
    if os.path.isdir(file):
        return f"leads to a folder: {target}"
    if place in ("", "top") or target not in pages or place in pages[target]["anchors"]:
        return None
    # Doxygen 1.9.4 gives friends of a class, and nested classes that are private, no place on the page that it links to. The lists of
    # members name the friends; a summary of nested classes is linked from its own page.
    if address in friends or (place == "nested-classes" and name == target):
        return None
    return f"leads to no place on its page: {target}#{place}"


def check_pages(program, folder, seconds=60, browsers=2):
    """Loads all .html files under a folder, and opens the pictures of its figures/; what belongs to MathJax or is loaded by the search box
    inside other pages is no page. After so many seconds for one page the browser is started anew. Returns the pages, sorted; the set of
    findings; and the page that took longest with its seconds."""
    folder = pathlib.Path(folder).resolve()
    names = [file.relative_to(folder).as_posix() for file in folder.rglob("*.html")]
    names = sorted(name for name in names if not name.startswith(("mathjax/", "search/")))
    pictures = sorted(file.relative_to(folder).as_posix() for file in (folder / "figures").rglob("*.svg"))
    left, pages, findings, slowest = iter([*names, *pictures]), {}, set(), ("", 0.0)

    def look_at_pages():
        nonlocal slowest
        reader = None
        for name in left:  # shared by the threads: each takes the next
            start = time.monotonic()
            reader = reader or Reader(program, seconds)
            try:
                if name.endswith(".svg"):
                    found = reader.look_at_picture(folder / name)
                else:
                    pages[name], found = reader.look(folder / name)
            except BrowserLost as lost:
                found = [("time", str(lost))]
                reader.browser.close()
                reader = None
            findings.update((name, kind, text) for kind, text in found)
            slowest = max(slowest, (name, time.monotonic() - start), key=lambda each: each[1])
        if reader:
            reader.browser.close()

    with concurrent.futures.ThreadPoolExecutor(browsers) as pool:
        for thread in [pool.submit(look_at_pages) for _ in range(browsers)]:
            thread.result()
    for page in pages.values():
        page["anchors"] = set(page["anchors"])
    friends = {address for page in pages.values() for address in page["friends"]}
    findings |= {(name, "link", what) for name, page in pages.items() for address in page["links"]
                 if (what := broken(name, address, folder, pages, friends))}
    return names, findings, slowest


def summary(findings):
    """One line for each kind and text: where first, and on how many pages."""
    pages = {}
    for page, kind, text in sorted(findings):
        pages.setdefault((kind, text), []).append(page)
    return "".join(f"{found[0]}: {kind}: {text}{f' (on {len(found)} pages)' if len(found) > 1 else ''}\n"
                   for (kind, text), found in sorted(pages.items()))
