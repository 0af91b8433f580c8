"""Plane frames with large displacements."""
from __future__ import annotations

import os
from typing import NamedTuple

import numpy as np

from . import _core
from ._failure import Failure
from ._text import file_of


class Path(NamedTuple):
    """Equilibrium path of a frame from rest, and branches; m points."""

    load_factor: np.ndarray  # (m,)
    displacement: dict[str, np.ndarray]  # of the free motions of named nodes, "B.y" and "B.rotation" (rad): (m,) each
    force: dict[str, np.ndarray]  # at prescribed displacements: (m,) each
    mesh_error: np.ndarray  # estimated relative error of the discretisation; nan where unknown, (m,)
    branch: np.ndarray  # 0: the path from rest, (m,)
    negative_eigenvalues: np.ndarray  # of the tangent stiffness; 0: stable, (m,)
    kind: list[str]  # step, maximum, minimum, bifurcation


def path(file: str | os.PathLike, *, load_case: str | None = None, elements: int = 4, steps: int = 200, until: float | None = None,
         branches: int = 0, turn: float = 0.15, limit: float = 60) -> Path:
    """Follows the equilibrium path of a frame from a TOML file, in its units, through limit and bifurcation points.

    load_case: name, for a file with several. elements: beam-columns a member. steps: largest number of steps of each branch.
    until: load factor at which branches end (default: twice the largest critical one). branches: number of branches to follow
    besides. turn: rotation of the tangent in a step, rad. limit: wall time, s; Ctrl-C takes effect at the end.
    Raises Failure if a path does not reach its end, with its points as `partial`; ValueError for a wrong file.
    """
    for name, value, low, high in (("elements", elements, 1, 100_000), ("steps", steps, 1, 100_000), ("branches", branches, 0, 1000),
                                   ("turn", turn, 1e-3, 1)):
        if not low <= value <= high:
            raise ValueError(f"{name} {value}: must be from {low} to {high}")
    (status, sentence), names, displacements, forces, is_held, load, mesh_error, branch, negative, kind = _core.path(
        file_of(file), load_case, elements, steps, until, branches, turn, float(limit))
    force = {name: row for name, row, held in zip(names, forces, is_held) if held}
    found = Path(np.array(load), dict(zip(names, displacements)), force, np.array(mesh_error, dtype=float),
                 np.array(branch, dtype=np.int32), np.array(negative, dtype=np.int32), kind)
    if status != "success":
        raise Failure(sentence, status, found)
    return found
