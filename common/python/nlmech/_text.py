"""Numbers and settings as the text that the library reads; Python writes doubles with as many digits as they need."""
from __future__ import annotations

import os
from collections.abc import Iterable, Mapping
from typing import Union

import numpy as np

Number = Union[float, str]  # an expression such as "2 pi/w" is text


def text_of(value: Number | None) -> str:
    """A number as text; "" for None."""
    if value is None or isinstance(value, str):
        return value or ""
    return repr(float(value))


def lines_of(value: str | Iterable[str] | None) -> list[str]:
    """A list of texts from one text or several."""
    return [] if value is None else [value] if isinstance(value, str) else list(value)


def assignments_of(values: Mapping[str, float] | None) -> list[str]:
    """{"a": 3} as "a=3.0"."""
    return [f"{name}={float(value)!r}" for name, value in (values or {}).items()]


def file_of(path: str | os.PathLike | None) -> str:
    """The path of a file as text."""
    return "" if path is None else os.fspath(path)


def rows_of(name: str, values, columns: int) -> tuple[np.ndarray, bool]:
    """An array of rows with this number of columns, and whether it was given as a single row."""
    array = np.asarray(values, dtype=float)
    if array.ndim not in (1, 2) or array.shape[-1] != columns:
        raise ValueError(f"{name}: an array of shape {array.shape}; needs ({columns},) or (n, {columns})")
    return np.atleast_2d(array), array.ndim == 1


def each(name: str, value, count: int) -> np.ndarray:
    """One number for each of @p count rows, from one or as many."""
    array = np.asarray(value, dtype=float)
    if array.shape not in ((), (count,)):
        raise ValueError(f"{name}: an array of shape {array.shape}; needs one number, or one for each of {count} rows")
    return np.broadcast_to(array, (count,))
