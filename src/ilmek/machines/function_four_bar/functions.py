"""The functions that are known by name."""

import difflib
import re
from collections.abc import Callable
from functools import partial
from typing import TypeAlias

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.errors import ParameterError

F: TypeAlias = Callable[[FloatArray], FloatArray]

NAMED: dict[str, F] = {
    "log10": np.log10,
    "ln": np.log,
    "log2": np.log2,
    "exp": np.exp,
    "sqrt": np.sqrt,
    "1/x": np.reciprocal,
    "sin": np.sin,
    "cos": np.cos,
    "tan": np.tan,
    "sinh": np.sinh,
    "tanh": np.tanh,
}
"""Functions of a plain number x; those of angles take it in radians."""

_POWER = re.compile(r"x\s*(?:\^|\*\*)\s*\(?\s*([+-]?(?:\d+\.?\d*|\.\d+))(?:\s*/\s*(\d+\.?\d*))?\s*\)?")
ALLOWED = f"{', '.join(NAMED)}, or a power like x^1.5"


def named(text: str) -> F:
    """The function of a name. Raises ParameterError for one that is not known, naming the nearest.

    >>> named("x^1.5")(np.array([4.0])).tolist(), named("x^(1/2)")(np.array([9.0])).tolist()
    ([8.0], [3.0])
    """
    name = text.strip().lower().removesuffix("(x)").replace(" ", "")
    power = _POWER.fullmatch(name)
    if name in NAMED:
        return partial(_quietly, NAMED[name])
    if power and float(power[2] or 1):
        return partial(_quietly, partial(_power, float(power[1]) / float(power[2] or 1)))
    near = difflib.get_close_matches({"log": "log10", "lg": "log10", "x": "x^1.5"}.get(name, name), NAMED, n=1)
    hint = f"did you mean {near[0]}?" if near else "for any other give samples"
    raise ParameterError(f"function={text!r} is unknown", allowed=ALLOWED, do=hint)


def _power(exponent: float, x: FloatArray) -> FloatArray:
    return np.asarray(np.power(x, exponent))


def _quietly(f: F, x: FloatArray) -> FloatArray:
    """Values without warnings: outside of its range a function is NaN or infinite."""
    with np.errstate(all="ignore"):
        return np.asarray(f(x))
