"""The lists of misprints: each entry's test is there, evaluates the printed and the corrected form beside an oracle, passes, and says the
numbers that the list gives, in a line `erratum ID misses X within Y` (tests/errata/erratum.hpp)."""
import collections
import math
import re
import subprocess

import pytest
from conftest import SOURCE

import claims
import errata
import lists

PROOF = re.compile(r'expect_erratum\(\s*"([^"]+)"')
SAID = re.compile(r"erratum (\S+) misses (\S+) within (\S+)")


@pytest.fixture
def built(build):
    return (build / "chapters.txt").read_text(encoding="utf-8").split()


def number(text):
    """A printed form that gives no number misses by "inf" or "nan"."""
    return float(text) if math.isfinite(float(text)) else math.inf


def agrees(said, listed):
    """The list has two digits; a misprint's size may change in its second one."""
    return math.isinf(said) if math.isinf(number(listed)) else abs(said - float(listed)) <= 0.1 * float(listed)


def run_tests(program, names):
    """What each of these tests of a program prints. All of them must pass."""
    done = subprocess.run([program, f"--gtest_filter={':'.join(sorted(names))}"], capture_output=True, encoding="utf-8")
    printed = dict(re.findall(r"^\[ RUN      \] (\S+)\n(.*?)^\[       OK \] \1 ", done.stdout, re.MULTILINE | re.DOTALL))
    assert done.returncode == 0 and set(printed) == set(names), f"{program}: not all of {names} pass\n{done.stdout}"
    return printed


def test_of_chapters_built_are_proved(build, built):
    entries = {entry.id: entry for entry in errata.read_errata(SOURCE) if entry.chapter in built}
    programs = collections.defaultdict(set)
    for test in (test for entry in entries.values() for test in entry.tests):
        program, _, name = test.partition(":")
        programs[program].add(name)
    said = collections.defaultdict(list)  # of each entry: test, distances
    for program, names in programs.items():
        for name, text in run_tests(build / "test-bin" / program, names).items():
            for entry, misses, within in SAID.findall(text):
                said[entry].append((f"{program}:{name}", number(misses), number(within)))
    assert set(said) == {entry.id for entry in entries.values() if entry.tests}, "entries that are proved, and that are listed"
    for name, evidence in said.items():
        tests, misses, within = zip(*evidence)  # several pieces of evidence: the largest counts
        entry = entries[name]
        assert set(entry.tests) <= set(tests), f"{name}: the tests that say something about it"
        assert agrees(max(misses), entry.misses), f"{name}: its tests miss by {max(misses)}, the list says {entry.misses}"
        assert agrees(max(within), entry.within), f"{name}: its tests hold {max(within)}, the list says {entry.within}"


def test_every_proof_is_of_an_entry_that_a_list_has():
    ids = {entry.id for entry in errata.read_errata(SOURCE)}
    proved = {name: file for file in (SOURCE / "tests").rglob("*.cpp") for name in PROOF.findall(file.read_text(encoding="utf-8"))}
    assert len(proved) > 100 and not [f"{file}: {name}" for name, file in proved.items() if name not in ids]


def test_of_printed_numbers_are_those_that_the_files_name():
    """A printed number that is a misprint names an entry, and is not said to be reproduced (which its file refuses). An entry that
    names the digits of a table stands beside a number that differs."""
    sources = {entry.id: entry.source for entry in errata.read_errata(SOURCE)}
    misprints = [value for value in lists.read_values(SOURCE, lists.read_places(SOURCE)) if value.erratum]
    assert misprints
    for value in misprints:
        assert (value.expected, sources.get(value.erratum)) == ("differs", value.source), value.name


def test_one_place_has_one_verdict():
    """A printed number that is a misprint is judged as one, a refuted claim is listed and does not hold, and a claim that rests on a
    printed number is not judged against its row."""
    places = lists.read_places(SOURCE)
    values = {value.name: value for value in lists.read_values(SOURCE, places)}
    listed = claims.read_claims(SOURCE / "tables/claims.csv")
    verdicts = {(claim.source, claim.text): claim.expected for claim in listed}
    assert len(verdicts) == len(listed), "two claims with the same words"
    named = {value.erratum for value in values.values()}
    for entry in errata.read_errata(SOURCE):
        assert entry.kind != "number" or entry.id in named, f"{entry.id}: no row of tables/published names it"
        if entry.kind == "refuted":
            assert verdicts.get((entry.source, entry.printed)) == claims.FAILS, f"{entry.id}: no such claim, or it is not refuted"
    opposite = {claims.HOLDS: ["does not hold"], claims.FAILS: ["holds", "reproduced", "reproduced, inferred reading"]}
    for claim in listed:
        if claim.scene == claims.PRINTED:
            value = values[f"{claim.source}/{claim.quantity}"]
            assert value.expected not in opposite.get(claim.expected, []), f"{claim.text}: {claim.expected}; {value.expected}"


def test_every_chapter_has_a_list(built):
    """But one that reproduces no source."""
    owners = {place.chapter for place in lists.read_places(SOURCE)}
    listed = {entry.chapter for entry in errata.read_errata(SOURCE)}
    assert listed & set(built) == owners & set(built)
