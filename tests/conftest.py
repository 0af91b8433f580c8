import pathlib
import tempfile

import pytest


@pytest.fixture
def folder():
    """An empty folder that is removed after the test."""
    with tempfile.TemporaryDirectory(prefix="nlmech-test-") as name:
        yield pathlib.Path(name).resolve()
