"""The tests of the published values, on the chapter tests/scene/fixture with its made-up values: each must fail for the reason it exists."""
import os
import re
import shutil
import subprocess
import sys

import pytest
from conftest import SOURCE

FIXTURE = SOURCE / "tests/scene/fixture"
TABLES = [sys.executable, "-B", SOURCE / "scripts/tables"]
NOMINAL, INPUT, INFERRED = (f"made-up/table-1/{name}" for name in ("nominal/reproduced", "load/input", "inferred/reproduced (inferred)"))
FOREIGN = "made-up/table-2/foreign/reproduced"


class Machinery:
    """What CMakeLists.txt of this folder does for a chapter, done for the fixture."""

    def __init__(self, folder, program):
        self.data, self.build, self.program = folder.path, folder.path / "build", program
        shutil.copytree(FIXTURE / "data", self.data, dirs_exist_ok=True)
        self.build.mkdir()

    def run(self, *command, fault=""):
        environment = {**os.environ, "NLMECH_DATA": str(self.data), "FIXTURE_FAULT": fault}
        return subprocess.run(command, cwd=self.build, env=environment, capture_output=True, encoding="utf-8")

    def tables(self, command, *arguments):
        return self.run(*TABLES, command, self.data, *arguments)

    def list_tests(self):
        listed = self.tables("tests", self.build, "fixture")
        assert listed.returncode == 0, listed.stderr
        steps = "".join(f'add_test({name} cmake -D STEP={step} -D "PROGRAM={self.program}" -D CHAPTER=fixture -D "OUT={self.build}" '
                        f'-P "{SOURCE}/tests/reproduction/check.cmake")\n'
                        for name, step in (("check/fixture", "measure"), ("check/fixture/quantities", "quantities")))
        (self.build / "CTestTestfile.cmake").write_text(
            listed.stdout + steps + "set_tests_properties(check/fixture PROPERTIES FIXTURES_SETUP check_fixture)\n"
            "set_tests_properties(check/fixture/quantities PROPERTIES FIXTURES_REQUIRED check_fixture)\n", encoding="utf-8")

    def outcomes(self, *arguments, fault=""):
        """How each test ended, in the words of ctest: "Passed", "***Failed", "***Skipped", "***Not Run"."""
        report = self.run("ctest", *arguments, fault=fault).stdout
        return dict(re.findall(r"Test +#\d+: (.*?) \.*\s*(Passed|\*\*\*(?:Failed|Skipped|Not Run))", report))

    def miss(self):
        shutil.copyfile(FIXTURE / "missed.csv", self.data / "tables/published/made-up.csv")


@pytest.fixture
def machinery(folder, build):
    made = Machinery(folder, build / "test-bin/fixture")
    made.list_tests()
    return made


def test_passes_values_that_are_kept_and_skips_what_is_not_built(machinery):
    outcomes = machinery.outcomes()
    assert outcomes.pop(FOREIGN) == "***Skipped"
    assert 'made-up/table-1/start; guess, "seed" #1/not stated' in outcomes
    assert set(outcomes.values()) == {"Passed"} and len(outcomes) == 9


def test_fails_each_value_that_is_missed_and_no_other(machinery):
    machinery.miss()
    failed = {name for name, outcome in machinery.outcomes().items() if outcome == "***Failed"}
    assert failed == {NOMINAL, INPUT, INFERRED, "made-up/table-1/smaller/better", "made-up/table-1/other/differs"}


def test_fails_the_quantities_and_lets_the_values_stand(machinery):
    outcomes = machinery.outcomes(fault="quantity")
    assert [outcomes[name] for name in ("check/fixture", "check/fixture/quantities", NOMINAL)] == ["Passed", "***Failed", "Passed"]


def test_does_not_take_the_values_of_an_earlier_check(machinery):
    assert machinery.outcomes()[NOMINAL] == "Passed"
    (machinery.data / "tables/published/made-up.csv").write_text("place,row\nnot,a row\n", encoding="utf-8")
    outcomes = machinery.outcomes()
    assert (outcomes["check/fixture"], outcomes[NOMINAL]) == ("***Failed", "***Not Run")


def test_fails_a_value_of_which_the_check_says_nothing(machinery):
    machinery.outcomes()
    said = machinery.build / "fixture.values"
    said.write_text("".join(line for line in said.read_text(encoding="utf-8").splitlines(True) if NOMINAL not in line), encoding="utf-8")
    outcomes = machinery.outcomes("-FA", ".*", "-R", "made-up/table-1")
    assert (outcomes[NOMINAL], outcomes[INPUT]) == ("***Failed", "Passed")


def test_computes_only_what_is_asked_for(machinery):
    assert machinery.outcomes("-R", "made-up/table-2") == {FOREIGN: "***Skipped"}
    assert machinery.outcomes("-R", "made-up/table-1/load")["check/fixture"] == "Passed"


def test_copes_with_every_character(machinery):
    with open(machinery.data / "tables/published/made-up.csv", "a", encoding="utf-8") as published:
        published.write('table-1,"a;b [c] ]] (d) #e $f ${g} \\h \'i\' ""j"" k","l, m %n &o *p |q ~r",1,1,value,,,context,,,,,,\n')
    machinery.list_tests()
    assert machinery.outcomes()["made-up/table-1/a;b [c] ]] (d) #e $f ${g} \\h 'i' \"j\" k/l, m %n &o *p |q ~r"] == "Passed"


def test_the_pages_are_of_all_chapters(machinery):
    machinery.data.joinpath("tables/claims.csv").write_text("source,place,chapter,claim,scene,quantity,means,verdict,reading\n")
    machinery.data.joinpath("tables/future_work.csv").write_text("source,place,item,chapter,scene,state,reason\n")
    machinery.outcomes()
    done = machinery.tables("check", machinery.build, "fixture")
    assert "8 published values, 0 fail\n" in done.stdout
    assert "## fixture\n\nmade-up. " in (machinery.data / "tables/REPRODUCTION.md").read_text(encoding="utf-8")
    machinery.miss()
    machinery.outcomes()
    done = machinery.tables("check", machinery.build, "fixture")
    assert (done.returncode, "8 published values, 5 fail\n" in done.stdout) == (1, True)
    assert f"FAILS {NOMINAL}: published 20, nominal 2: differs (FAILS: expected reproduced)\n" in done.stderr


@pytest.mark.parametrize("arguments, wanted", [
    (["check", "none", "."], "none/tables/places.csv: No such file or directory"),
    (["check", "..", ".", "fixture"], "results/fixture/check.csv: No such file or directory"),
    (["check", ".."], "python3 scripts/tables check SOURCE OUT"), (["verdict"], "python3 scripts/tables check SOURCE OUT"),
    ([], "python3 scripts/tables check SOURCE OUT")])
def test_refuses_what_it_does_not_know(machinery, arguments, wanted):
    done = machinery.run(*TABLES, *arguments)
    assert (done.returncode, done.stdout) == (2, "")
    assert wanted in done.stderr
