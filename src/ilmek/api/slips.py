"""Values that were probably meant in another unit, and arguments in the wrong order.

Lengths are metres and angles radians. A value far outside the range of machines raises, with the value as given and the
conversion that was probably meant.
"""

import math
import numbers
from collections.abc import Mapping

import numpy as np

from ilmek.arrays import RealField
from ilmek.cams.laws import Law
from ilmek.errors import IlmekError, MechanismError, ParameterError

LONGEST = 10.0
"""Length [m] above which millimetres were meant; assumed by this project: no link or lift of a loom is that long."""

TURNS = 4 * math.pi
"""Angle [rad] above which degrees are suspected: two turns."""

COARSE = 0.5
"""Step between two samples [rad] (29 deg) at which a motion of several turns was meant in degrees."""


def check_lengths(error: type[IlmekError], of: str, **lengths: float) -> None:
    """Raise an error unless every value is a number, at most LONGEST [m] in magnitude."""
    for name, value in lengths.items():
        check_number(error, f"{name} of {of}", value, "a length in metres")
    name, longest = max(lengths.items(), key=lambda item: abs(item[1]))
    if abs(longest) > LONGEST:
        do = f"if millimetres were meant, write {longest:g} * mm for {longest:g}, and so for all lengths"
        raise error(f"{name} of {of} is {longest:g} m", allowed=f"lengths are in metres, up to {LONGEST:g} m", do=do)


def check_angle(error: type[IlmekError], of: str, angle: float, most: float = 2 * math.pi) -> None:
    """Raise an error unless an angle is a number, at most `most` [rad] in magnitude."""
    check_number(error, of, angle, "an angle in radians")
    if abs(angle) > most * (1 + 1e-9):
        allowed = f"angles are in radians, up to {most:.4g} rad here"
        raise error(f"{of} is {angle:g} rad", allowed=allowed, do=f"if degrees were meant, write {angle:g} * deg")


def check_number(error: type[IlmekError], of: str, value: object, meant: str) -> None:
    """Raise an error unless a value is a real, finite number."""
    if isinstance(value, Law):
        raise error(
            f"{of} is the law {value.name!r}", allowed=meant, do="give the arguments in the order of the function"
        )
    if isinstance(value, str):
        do = "multiply a number by a unit, like 40 * mm or 100 * deg"
        raise error(f"{of} is the text {value!r}", allowed=meant, do=do)
    if not isinstance(value, numbers.Real) or not math.isfinite(value):
        raise error(f"{of} is {value!r}", allowed=meant)


def check_law(of: str, law: object) -> None:
    """Raise ParameterError unless a law is a Law or a name."""
    if not isinstance(law, Law | str):
        given = f"the law of a {of} is {law!r}"
        do = "give the span, the lift and then the law"
        raise ParameterError(given, allowed='a name like "modified-sine", or a Law', do=do)


def check_turning(of: str, angles: RealField) -> None:
    """Raise MechanismError where the values of a rotating input [rad] look like degrees.

    They do where they exceed two turns, and either end on a whole number, or end one step before it, or go by steps of
    more than COARSE. Values in radians hardly ever do.
    """
    values = np.ravel(np.asarray(angles, dtype=float))
    if values.size == 0 or not np.isfinite(values).all() or np.max(np.abs(values)) <= TURNS:
        return
    greatest = float(values[np.argmax(np.abs(values))])
    ends = [greatest, *((float(2 * values[-1] - values[-2]),) if values.size > 1 else ())]
    whole = any(abs(end - round(end)) <= 1e-9 * abs(end) for end in ends)
    coarse = values.size > 1 and float(np.median(np.abs(np.diff(values)))) > COARSE
    if whole or coarse:
        raise MechanismError(
            f"input {of!r} turns to {greatest:g} rad ({greatest / (2 * math.pi):.1f} turns)",
            allowed="angles are in radians",
            do="if degrees were meant, multiply by deg; `ilmek.linkage.solve.solve` takes any angle",
        )


def by_input(values: object, inputs: Mapping[str, bool]) -> dict[str, RealField]:
    """The values of the inputs that rotate, by name; `inputs` tells of each whether it does."""
    if isinstance(values, Mapping):
        return {name: one for name, one in values.items() if inputs.get(name, False)}
    return {name: values for name, rotates in inputs.items() if rotates}  # type: ignore[misc]
