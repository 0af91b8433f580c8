"""A hub with two flexible appendages: exact response. Units as the parameters; by default slug, ft, lb, s."""
from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from typing import Union

import numpy as np

from . import _core
from ._text import file_of

Spacecraft = Union[str, os.PathLike, Mapping[str, float], None]


def _craft(spacecraft: Spacecraft) -> tuple[str, str]:
    if isinstance(spacecraft, Mapping):
        return "", "\n".join(f"{key} = {float(value)!r}" for key, value in spacecraft.items()) + "\n"
    return file_of(spacecraft), ""


def response(omega, *, spacecraft: Spacecraft = None, gains: Sequence[float] | None = None,
             at: Sequence[float] = ()) -> tuple[np.ndarray, np.ndarray]:
    """Transfer functions at s = j omega: theta/u and y/u, or with gains theta/theta_f and y/theta_f.

    omega: frequencies, rad/s, not 0. spacecraft: TOML file or dictionary of hub_inertia, mass_per_length, youngs_modulus, length,
    hub_radius, second_moment, tip_mass, tip_inertia; missing ones have the values of Table 3.1. gains: k1, k2, k3.
    at: places on the appendage, their distances from the rim. Same bits as `gss_control response`.
    Returns complex arrays of shapes (m,) and (m, places). Raises Failure at a pole.
    """
    if np.any(np.asarray(omega) == 0):
        raise ValueError("omega 0: is the double pole of a free body")
    if gains is not None and len(gains) != 3:
        raise ValueError(f"gains: {len(gains)} numbers; needs three, k1, k2, k3")
    return _core.response(*_craft(spacecraft), *(np.ravel(np.asarray(values, dtype=float)) for values in (omega, at)), gains)
