"""The Python package of the build; files of tests without it, or without NumPy, are skipped."""
import sys

import pytest

from nlmech_tree import BUILD

sys.path.insert(0, str(BUILD / "python"))
np = pytest.importorskip("numpy", reason="NumPy is not installed")
if not list((BUILD / "python/nlmech").glob("_core.*")):
    pytest.skip("the Python package is not built: pybind11 is missing", allow_module_level=True)
import nlmech  # noqa: E402, F401
