"""The exception of failed computations."""
from __future__ import annotations

from typing import Any


class Failure(RuntimeError):
    """A computation failed. Its text names the method, the place and what to change.

    status: the outcome, such as "step_limit" or "not_converged".
    partial: what was computed up to there (a Solution, arrays), or None.
    """

    def __init__(self, sentence: str, status: str = "not_converged", partial: Any = None):
        super().__init__(f"{status}: {sentence}")
        self.sentence, self.status, self.partial = sentence, status, partial

    def __reduce__(self):
        return type(self), (self.sentence, self.status, self.partial)
