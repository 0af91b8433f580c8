"""The exception of failed computations."""
from __future__ import annotations

import re
from typing import Any

# Arguments that are not named as the options are.
RENAMED = {"from": "start", "event": "events", "set-at": "changes", "no-verify": "verify=False", "plane": "normal",
           "final-angle": "angle"}


def in_python(message: str) -> str:
    """A message of the library with arguments in place of options: "--largest-step 1" becomes "largest_step 1"."""
    return re.sub("--([a-z][a-z-]*)", lambda option: RENAMED.get(option[1], option[1]).replace("-", "_"), message)


class Failure(RuntimeError):
    """A computation failed. Its text names the method, the place and what to change.

    status: the outcome, such as "step_limit" or "not_converged".
    partial: what was computed up to there (a Solution, arrays), or None.
    """

    def __init__(self, sentence: str, status: str = "not_converged", partial: Any = None):
        sentence = in_python(sentence)
        super().__init__(f"{status}: {sentence}")
        self.sentence, self.status, self.partial = sentence, status, partial

    def __reduce__(self):
        return type(self), (self.sentence, self.status, self.partial)
