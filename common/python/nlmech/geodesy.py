"""Cartesian and geodetic coordinates."""
from __future__ import annotations

import numpy as np

from . import _core
from ._failure import Failure
from ._text import rows_of


def _ellipsoid(ellipsoid: str | tuple[float, float]) -> _core.Ellipsoid:
    if not isinstance(ellipsoid, str):
        return _core.Ellipsoid(*map(float, ellipsoid))
    name = ellipsoid.lower().translate({ord(c): None for c in " -_"})
    if name not in _core.ellipsoids:
        raise ValueError(f"ellipsoid {ellipsoid}: no such name; give one of {', '.join(_core.ellipsoids)}, or (a, f)")
    return _core.ellipsoids[name]


def _points(name: str, transformed: tuple[np.ndarray, int], single: bool) -> np.ndarray:
    result, lost = transformed
    if lost:
        first = np.flatnonzero(~np.isfinite(result).all(axis=1))[0]
        raise Failure(f"{name}: {lost} of {len(result)} points have no finite result, the first at index {first}: a number is NaN or "
                      "infinite, or the distance from the centre overflows", "non_finite", result)
    return result[0] if single else result


def reverse(xyz, ellipsoid: str | tuple[float, float] = "wgs84", *, threads: int = 0) -> np.ndarray:
    """Latitude and longitude in degrees and height in metres of positions x, y, z in metres.

    xyz: shape (3,) or (n, 3). ellipsoid: a name (wgs84, grs80, ...), or equatorial radius and flattening (a, f), in the unit of
    the coordinates. Latitudes and heights are those of the nearest point of the ellipsoid; errors below 1e-15 rad and 3e-9 m
    up to 100 km. Same bits as `geodesy reverse`. threads: 0: one for each processor, for many points.
    Returns an array of the shape of xyz, by columns: `latitude, longitude, height = reverse(xyz).T`.
    Raises Failure if points have no finite result; `partial` is the array.
    """
    points, single = rows_of("xyz", xyz, 3)
    return _points("geodesy.reverse", _core.reverse(points, _ellipsoid(ellipsoid), threads), single)


def forward(geodetic, ellipsoid: str | tuple[float, float] = "wgs84", *, threads: int = 0) -> np.ndarray:
    """Positions x, y, z in metres of latitude and longitude in degrees and height in metres.

    geodetic: shape (3,) or (n, 3); latitudes from -90 to 90. ellipsoid, threads: as for reverse(). Same bits as `geodesy forward`.
    """
    points, single = rows_of("geodetic", geodetic, 3)
    return _points("geodesy.forward", _core.forward(points, _ellipsoid(ellipsoid), threads), single)
