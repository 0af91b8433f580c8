"""State shared by all parts of the page maker: paths, files read, errors."""
import dataclasses
import pathlib
import re
import shutil
import sys


class Complaint(Exception):
    """An error message. The caller that knows the page and its line adds them."""


@dataclasses.dataclass
class Book:
    source: pathlib.Path  # top of the source tree
    build: pathlib.Path  # with the lists that the configuration wrote
    out: pathlib.Path  # with the generated figures/, tables/, results/
    folder: pathlib.Path  # where the book is made
    chapters: list  # in reading order
    complaints: list = dataclasses.field(default_factory=list)
    files_read: dict = dataclasses.field(default_factory=dict)  # the keys; a set would lose the order
    works: dict = dataclasses.field(default_factory=dict)  # of the bibliography, by key
    scenes: dict = dataclasses.field(default_factory=dict)  # quantities that were read, by scene
    labels: dict = dataclasses.field(default_factory=dict)  # of the pages, by source
    summaries: dict = dataclasses.field(default_factory=dict)  # first paragraphs of finished pages, by source
    shown: set = dataclasses.field(default_factory=set)  # figures and tables that a page contains

    def choosing(self):
        """The page on choosing a method, if this build has all chapters that it refers to; else nothing."""
        page = self.source / "docs/choosing.md"
        if not page.exists() or not set(re.findall(r"/figures/(\w+)/", page.read_text(encoding="utf-8"))) <= set(self.chapters):
            return []
        return ["docs/choosing.md"]

    def complain(self, file, line, text):
        self.complaints.append(f"{file}:{line}: error: {text}")
        print(self.complaints[-1], file=sys.stderr)

    def reads(self, file):
        """The file; it becomes a dependency of the book."""
        self.files_read[file] = None
        return file

    def text(self, file):
        return self.reads(file).read_text(encoding="utf-8")

    def entries(self, file):
        """The lines "name: rest" of a list, in its order."""
        return re.findall(r"^(\w+): *(.*)$", self.text(file), re.MULTILINE)

    def write(self, name, text):
        file = self.folder / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text, encoding="utf-8")

    def copy(self, file, name):
        """A file of the project that is copied into the book, under this name."""
        copied = self.folder / "html" / name
        copied.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(self.reads(file), copied)
