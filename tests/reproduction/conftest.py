"""What the tests of scripts/tables share: its modules, and a folder with lists and results of made-up chapters."""
import os
import pathlib
import sys

import pytest

SOURCE = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(SOURCE / "scripts/tables"))

PLACES = "source,place,chapter,kind,subject,scenes\n"
PUBLISHED = ("place,row,quantity,value,unit,kind,nominal,inferred,expected,tolerance,because,tried,explains,erratum,reading\n")
CHECKED = "name,nominal,inferred,verdict,passes,setting\n"


class Folder:
    """A source tree that holds its results too."""

    def __init__(self, path):
        self.path = path

    def put(self, name, text):
        file = self.path / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text, encoding="utf-8")
        return file

    def values(self, *chapters):
        """The printed numbers with the verdicts of these chapters' checks."""
        import lists
        found = lists.read_values(self.path, self.places())
        lists.add_verdicts(found, self.path, chapters)
        return found

    def places(self):
        import lists
        return lists.read_places(self.path)


@pytest.fixture
def folder(tmp_path):
    made = Folder(tmp_path)
    made.put("docs/chapters.txt", "# names\nsun: The Sun\n")
    return made


@pytest.fixture
def build():
    """The build whose programs are tested: build/, or the one that ctest says."""
    return pathlib.Path(os.environ.get("NLMECH_BUILD", SOURCE / "build"))
