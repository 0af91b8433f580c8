"""Numbers of the sources are those that the programs of tools/oracles print, and `scripts/oracles`, which compares them, finds each kind of
difference. Printed numbers are in `tables/published` alone: code refers to them by name."""
import csv
import re
import shutil

import pytest

from nlmech_tree import SOURCE, run, sources_under, text_of, write

TAG = "// oracle: roots two, small\n"


class Roots:
    """A small tree with one program of two rows, both of which a source uses."""

    def __init__(self, folder):
        self.folder = folder
        (folder / "scripts").mkdir()
        shutil.copy(SOURCE / "scripts/oracles", folder / "scripts")
        write(folder / "tables/reference/oracles/roots.csv", "name,value,digits\ntwo,1.4142,5\nsmall,-2.50e-3,3\n")
        self.program("1.4142", "-2.50e-3")
        self.source(TAG + "double a[] = {1.4142, -0.0025};\n")

    def program(self, two, small):
        write(self.folder / "tools/oracles/roots.py", f"print('name,value,digits\\ntwo,{two},5\\nsmall,{small},3')\n")

    def source(self, text):
        write(self.folder / "tests/a_test.cpp", text)

    def says(self, command, code):
        return run(self.folder / "scripts/oracles", command, code=code).stdout


@pytest.fixture
def roots(folder):
    return Roots(folder)


def test_sources_agree_with_the_rows_that_are_kept():
    run(SOURCE / "scripts/oracles", "uses")


@pytest.mark.parametrize("command", ["uses", "run"])
def test_agreement_is_silent(roots, command):
    assert roots.says(command, 0) == ""


def test_a_unit_of_the_last_digit_is_allowed(roots):
    roots.program("1.4143", "-2.51e-3")
    roots.says("run", 0)


def test_another_number_of_a_program_is_named(roots):
    roots.program("1.4144", "-2.50e-3")
    assert "roots two: 1.4144, not 1.4142" in roots.says("run", 1)


# The empty line ends the paragraph that a tag refers to.
@pytest.mark.parametrize("source, words", [
    (TAG + "double a[] = {1.4152, -0.0025};\n", "tests/a_test.cpp:1: 1.4142 of roots two does not stand here"),
    (TAG + "double a = 1.4142;\n\ndouble b = -0.0025;\n", "-2.50e-3 of roots small does not stand here"),
    ("// oracle: roots two\ndouble a = 1.4142;\n", "roots small: no source names this row"),
    ("// oracle: roots t*, small\n// oracle: roots three\ndouble a[] = {1.4142, -0.0025};\n",
     "tests/a_test.cpp:2: roots has no row three")])
def test_a_source_that_disagrees_is_named(roots, source, words):
    roots.source(source)
    assert words in roots.says("uses", 1)


def significant_digits(number):
    """Of a number as printed, without zeros at its ends: "4.2894" has five, "1000" one."""
    return len(re.sub(r"[eE].*|[^0-9]", "", number).strip("0"))


def test_printed_numbers_are_no_literals():
    """Parameters are used as printed, but a result of a source must not be. Four digits and more do not agree by chance."""
    printed = {}
    for file in sorted((SOURCE / "tables/published").glob("*.csv")):
        for row in csv.DictReader(text_of(file).splitlines()):
            if row["expected"] != "input" and row["kind"] != "time" and significant_digits(row["value"]) >= 4:
                printed.setdefault(row["value"], f"{file.stem}/{row['place']}/{row['row']}/{row['quantity']}")
    assert len(printed) > 10
    found = []
    for file in sources_under("chapters", ends=(".cpp", ".hpp")):
        for at, line in enumerate(text_of(file).splitlines(), 1):
            code = re.sub(r'"(\\.|[^"\\])*"', "", line).partition("//")[0]
            found += [f"{file}:{at}: {number} is {printed[number]}"
                      for number in re.findall(r"[0-9][0-9.]*(?:[eE][-+]?[0-9]+)?", code) if number in printed]
    assert not found, "\n".join(found)
