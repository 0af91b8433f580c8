"""The check of the book's pages finds every kind of error: each page of the folder fixture/ has one."""
import pathlib
import shutil
import tempfile
import time

import pytest

from browser import NO_CHROMIUM, Browser, BrowserLost, find_chromium, in_seconds
from nlmech_tree import SOURCE
from page_check import check_pages, summary

FIXTURE = SOURCE / "tests/book/fixture"
CHROMIUM = find_chromium()
needs_chromium = pytest.mark.skipif(not CHROMIUM, reason=NO_CHROMIUM)


@pytest.fixture
def pages(folder):
    """A folder with a good page and its picture, and a function that copies further ones into it."""
    def copy(*names):
        for name in names:
            shutil.copy(FIXTURE / name, folder)
        return folder

    copy("good.html", "a picture.svg")
    return copy


@needs_chromium
def test_a_good_page_has_no_findings(pages):
    names, findings, _ = check_pages(CHROMIUM, pages())
    assert names == ["good.html"]
    assert findings == set()


@needs_chromium
def test_each_kind_of_failure_is_found_and_no_other(pages):
    folder = pages()
    address = f"file://{folder}/"
    nowhere, missing = "leads to no place on its page: good.html#", f"Failed to load resource: net::ERR_FILE_NOT_FOUND {address}"
    broken = {
        "link.html": [("link", f"leads out of the book: {folder.parent}/outside.html"), ("link", "leads to no file: no-such-page.html"),
                      ("link", f"{nowhere}no-such-place")],
        # Friends and nested classes that Doxygen gives no place are no findings, all others are.
        "friends.html": [("link", f"{nowhere}affffffffffffffffffffffffffffffff"), ("link", f"{nowhere}nested-classes")],
        "formula.html": [("formula", "As \\(x^2\\) shows."), ("formula", "\\[ y \\]"), ("formula", "\\f$z\\f$")],
        "refused.html": [("formula", "Undefined control sequence")],
        "exception.html": [("error", "Error: thrown on purpose")],
        "network.html": [("network", "https://example.org/data")],
        "width.html": [("width", "608 px in 390 (div.: wide)")],
        "number.html": [("number", "a list begins with 300"), ("number", "It converges to .")],
        "summary.html": [("summary", "Newmark's method (N.")],
        "alternative.html": [("alternative", 'a%20picture.svg: "Too few words"'),
                             ("alternative", 'a%20picture.svg: "A caption that says with nine words nothing new"')],
        "chapter_long.html": [("length", "41 screens of 900 px")],
        "console.html": [("error", 'console: "said on purpose"')],
        "table.html": [("table", "900 px in 600: row | effect"), ("table", "effect is out of sight at 390 px: row | effect"),
                       ("table", "effect is out of sight at 1400 px: row | effect")],
        "image.html": [("image", "no-such-picture.svg"), ("error", f"{missing}no-such-picture.svg")],
        "script.html": [("error", f"{missing}no-such-script.js")]}
    pages(*broken)
    assert check_pages(CHROMIUM, folder, 30)[1] == {(page, *finding) for page, found in broken.items() for finding in found}


@needs_chromium
def test_labels_that_a_picture_cuts_off_are_found(pages):
    folder = pages()
    (folder / "figures").mkdir()
    for name in ("cut.svg", "a picture.svg"):
        shutil.copy(FIXTURE / name, folder / "figures")
    (page, kind, text), = check_pages(CHROMIUM, folder, 30)[1]
    assert (page, kind) == ("figures/cut.svg", "picture") and text.startswith("below:")


@needs_chromium
def test_pages_in_the_frame_of_another_are_judged_as_if_loaded(pages):
    """The second page is shown in the frame of the first."""
    assert check_pages(CHROMIUM, pages("frame 1.html", "frame 2.html"), browsers=1)[1] == {
        ("frame 2.html", "link", "leads to no place on its page: frame 1.html#second"),
        ("frame 2.html", "width", "708 px in 390 (div.: wide)")}


@needs_chromium
def test_a_page_that_hangs_is_given_up_and_the_next_is_checked(pages):
    hangs, wide = sorted(check_pages(CHROMIUM, pages("hang.html", "width.html"), 25)[1])
    assert hangs == ("hang.html", "time", "the browser does not answer")
    assert wide[0] == "width.html"


def commands_with(text):
    """Command lines of running processes that contain a text. One that has ended has none."""
    found = []
    for file in pathlib.Path("/proc").glob("[0-9]*/cmdline"):
        try:
            command = file.read_bytes().decode(errors="replace")
        except OSError:
            continue
        found += [command] if text in command else []
    return found


@needs_chromium
def test_no_browser_is_left_behind(pages, folder, monkeypatch):
    with tempfile.TemporaryDirectory(prefix="nlmech-test-") as own:
        monkeypatch.setattr(tempfile, "tempdir", own)  # what tests beside this one start is elsewhere
        with Browser(CHROMIUM) as browser:
            browser.call("Browser.getVersion")
            assert list(pathlib.Path(own).iterdir()) and commands_with(own)
        assert list(pathlib.Path(own).iterdir()) == []
        check_pages(CHROMIUM, folder, 30)
        assert list(pathlib.Path(own).iterdir()) == []
        # The processes of the killed group have no parent that waits for them; they need a moment to end.
        deadline = in_seconds(20)
        while commands_with(own) and time.monotonic() < deadline:
            time.sleep(0.02)
        assert commands_with(own) == []


def test_a_browser_whose_program_ends_is_lost():
    with Browser("true") as browser, pytest.raises(BrowserLost):
        browser.call("Browser.getVersion", deadline=in_seconds(20))


def test_a_browser_that_does_not_answer_is_lost(folder):
    mute = folder / "mute"
    mute.write_text("#!/bin/sh\nexec sleep 60\n", encoding="utf-8")
    mute.chmod(0o700)
    with Browser(str(mute)) as browser, pytest.raises(BrowserLost):
        browser.call("Browser.getVersion", deadline=in_seconds(0.5))


def test_summary_says_on_how_many_pages():
    assert summary({("a.html", "link", "x"), ("b.html", "link", "x"), ("b.html", "width", "y")}) == \
        "a.html: link: x (on 2 pages)\nb.html: width: y\n"
