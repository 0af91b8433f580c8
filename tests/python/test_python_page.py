"""Every example of docs/python.md is run as it is printed, and draws its picture.

    NLMECH_PICTURES=docs/python pytest-3 tests/python/test_python_page.py     draws the pictures of the page anew"""
import os
import pathlib
import re
import shutil
import sys

import pytest

from nlmech_tree import SOURCE, text_of

sys.path.insert(0, str(SOURCE / "tests/pages"))
from package import nlmech  # noqa: E402, F401
from printed import blocks_of, differs_from  # noqa: E402

matplotlib = pytest.importorskip("matplotlib", reason="Matplotlib is not installed")
PAGE = text_of("docs/python.md")
EXAMPLES = [block for block in blocks_of(PAGE) if block.language == "python"]


@pytest.mark.parametrize("block", EXAMPLES, ids=lambda block: f"line{block.line}")
def test_examples_run_and_draw(block, folder, capsys, monkeypatch):
    code = "\n".join(block.lines)
    matplotlib.use("Agg")
    matplotlib.rcParams.update({"svg.fonttype": "none", "svg.hashsalt": "nlmech", "savefig.bbox": "tight"})
    (folder / "chapters").symlink_to(SOURCE / "chapters")
    monkeypatch.chdir(folder)
    exec(compile(code, f"docs/python.md:{block.line}", "exec"), {})
    matplotlib.pyplot.close("all")
    pictures = re.findall(r'savefig\("(\w+\.svg)"\)', code)
    for name in pictures:
        assert f"](python/{name})" in PAGE and (folder / name).stat().st_size > 2000
        if "NLMECH_PICTURES" in os.environ:
            shutil.copy(folder / name, SOURCE / os.environ["NLMECH_PICTURES"] / name)
    printed = [other for other in blocks_of(PAGE) if other.language == "text" and other.line == block.end + 2]
    assert differs_from(capsys.readouterr().out, printed[0].lines if printed else []) == ""


def test_pictures_are_those_of_the_examples():
    drawn = re.findall(r'savefig\("(\w+\.svg)"\)', PAGE)
    assert len(EXAMPLES) >= 6 and sorted(drawn) == sorted(file.name for file in pathlib.Path(SOURCE / "docs/python").iterdir())
    assert [name for name in drawn if (SOURCE / "docs/python" / name).stat().st_size > 120_000] == []
