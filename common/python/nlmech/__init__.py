"""Nonlinear mechanics: initial and boundary values, orbits, geodesy, frames, spacecraft.

NumPy in, NumPy out, with the bits that the commands print. Wrong arguments raise ValueError, failed computations
nlmech.Failure, which carries what was computed. Long calls release Python's lock.
"""
from . import frames, geodesy, orbit, spacecraft
from ._bvp import BoundarySolution, bvp
from ._failure import Failure
from ._ivp import Choice, Event, Run, Solution, choose, compare, integrate

__all__ = ["BoundarySolution", "Choice", "Event", "Failure", "Run", "Solution", "bvp", "choose", "compare", "frames", "geodesy",
           "integrate", "orbit", "spacecraft"]
