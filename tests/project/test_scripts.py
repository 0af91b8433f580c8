"""What CI uses beside the build: the folders that a change affects, and the check that figures keep their labels."""
import os
import shutil

import pytest

from nlmech_tree import SOURCE, run, write

EVERY = ["geodesy", "orbit", "orbit_long", "series", "support"]
# Without what git tells the programs of a hook: it would be another repository.
ENVIRONMENT = {name: value for name, value in os.environ.items() if name not in ("GIT_DIR", "GIT_WORK_TREE", "GIT_INDEX_FILE")}


class Repository:
    """The script in a small repository with the components support, series on it, orbit on both, and geodesy."""

    def __init__(self, folder):
        self.folder = folder
        (folder / "scripts").mkdir()
        shutil.copy(SOURCE / "scripts/affected-tests", folder / "scripts")
        write(folder / "components.txt", "support: \nseries: support\norbit: support series\ngeodesy: \n")
        for name in (*EVERY, "chapters", "pages"):
            write(folder / "tests" / name / "a_test.cpp", "")
        self.git("init", "--quiet")
        self.commit()

    def git(self, *words):
        run("git", "-c", "commit.gpgsign=false", "-c", "user.name=t", "-c", "user.email=t@t", *words, cwd=self.folder, env=ENVIRONMENT)

    def commit(self):
        self.git("add", ".")
        self.git("commit", "--quiet", "--message", "t")

    def folders(self, base):
        done = run("scripts/affected-tests", base, "components.txt", cwd=self.folder, env=ENVIRONMENT)
        return [line.removeprefix("tests/") for line in done.stdout.split()]

    def after(self, *files):
        """The folders for a change of these files."""
        for file in files:
            write(self.folder / file, "changed")
        self.commit()
        return self.folders("HEAD~1")


@pytest.fixture
def repository(folder):
    return Repository(folder)


# Folders that belong to no component come before and after those that do.
@pytest.mark.parametrize("files, folders", [
    (["common/nlmech/series/a.hpp"], ["orbit", "orbit_long", "series"]),
    (["common/nlmech/geodesy/a.cpp"], ["geodesy"]),
    (["tests/series/a_test.cpp"], ["series"]),
    (["tests/orbit_long/a_test.cpp"], ["orbit", "orbit_long"]),
    (["tests/chapters/a_test.cpp", "tests/pages/a_test.cpp", "README.md"], []),
    (["tests/chapters/a_test.cpp.orig", "tests/support/a_test.cpp", "tests/pages/b_test.cpp"], ["support"]),
    (["cmake/a.cmake"], EVERY),
    (["packages.txt"], EVERY)])
def test_affected_tests(repository, files, folders):
    assert repository.after(*files) == folders


def test_affected_tests_are_all_where_nothing_is_known(repository):
    assert repository.folders("") == EVERY


def lost_labels(folder, code):
    return run(SOURCE / "scripts/lost-labels", folder, cwd=folder, code=code)


@pytest.mark.parametrize("offset, code", [(0, 0), (-4, 1)])
def test_lost_labels_are_named_with_the_figure(folder, offset, code):
    script = "results/chapter/scene.gp"
    write(folder / script, "width = '400'\nheight = '300'\nset terminal svg size width + 0, height + 0\nset lmargin screen 0.2\n"
                           f"set ylabel 'miss (m)' offset {offset},0\nplot [0:1] 1e4*x notitle\n")
    write(folder / "figures/chapter/scene.svg", run("gnuplot", script, cwd=folder).stdout)
    output = lost_labels(folder, code).stdout
    assert ("miss (m)" in output and "scene.gp" in output) if code else output == ""


def test_lost_labels_need_figures(folder):
    lost_labels(folder, 2)
    write(folder / "results/chapter/scene.gp", "plot [0:1] x\n")
    assert "scene.svg" in lost_labels(folder, 2).stderr
