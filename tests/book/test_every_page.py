"""Every page of the book in a headless browser."""
import time

import pytest

from browser import NO_CHROMIUM, find_chromium
from nlmech_tree import BUILD
from page_check import check_pages, summary

BOOK = BUILD / "book/html"


@pytest.mark.skipif(not (BOOK / "index.html").exists(), reason=f"there is no book in {BOOK}: make book")
@pytest.mark.skipif(not find_chromium(), reason=NO_CHROMIUM)
def test_pages_have_no_findings(capsys):
    start = time.monotonic()
    pages, findings, (slowest, seconds) = check_pages(find_chromium(), BOOK)
    with capsys.disabled():
        print(f"{len(pages)} pages, {len(findings)} findings, {time.monotonic() - start:.0f} s, {seconds:.1f} s of them for {slowest}")
    assert not findings, summary(findings)
