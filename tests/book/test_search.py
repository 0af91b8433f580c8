"""The search of the book, as a reader uses it: typed into the box of a page that is opened from the file system."""
import json

import pytest

from browser import NO_CHROMIUM, Browser, Tab, find_chromium
from nlmech_tree import BUILD

BOOK = BUILD / "book/html"
PAGE = BOOK / "glossary.html"
SCRIPT = """(async () => {
  const field = document.querySelector('#book-search input'), list = document.querySelector('#book-search ol');
  list.replaceChildren();
  field.value = %s;
  field.dispatchEvent(new Event('input'));
  while (!list.children.length) await new Promise((done) => setTimeout(done, 20));
  return [...list.querySelectorAll('a')].map((a) => a.getAttribute('href'));
})()"""
pytestmark = [pytest.mark.skipif(not PAGE.exists(), reason=f"there is no book in {BOOK}: make book"),
              pytest.mark.skipif(not find_chromium(), reason=NO_CHROMIUM)]


@pytest.fixture(scope="module")
def tab():
    with Browser(find_chromium()) as browser:
        tab = Tab(browser)
        tab.open(f"file://{PAGE}")
        yield tab


def found(tab, typed):
    """The files, without places on them, that are offered for what is typed, best first."""
    addresses, failure = tab.evaluate(SCRIPT % json.dumps(typed))
    assert failure is None
    files = [address.partition("#")[0] for address in addresses]
    assert [file for file in files if not (BOOK / file).exists()] == []
    return files


@pytest.mark.parametrize("typed, page", [
    ("limit point", "homotopy"), ("Kepler", "two_body_series"), ("pork-chop", "rbf_inverse"), ("flexible spacecraft", "gss_control"),
    ("geodetic", "geodesy")])
def test_a_term_of_the_field_leads_where_a_reader_expects(tab, typed, page):
    files = found(tab, typed)
    assert len(files) >= 3 and f"chapter_{page}.html" in files[:3]


@pytest.mark.parametrize("typed", ["misprint", "boundary value", "step control", "tolerance", "rounding level"])
def test_terms_in_the_text_of_pages_are_found(tab, typed):
    assert found(tab, typed)


def test_names_of_the_library_are_found(tab):
    assert any(file.startswith("namespacenlmech") for file in found(tab, "solve_lambert"))


def test_nothing_is_found_where_nothing_is(tab):
    assert found(tab, "xyzzy plugh") == []
