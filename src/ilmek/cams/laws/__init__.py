"""Motion laws by name; a new one is a file here and a line below."""

import difflib
import math
from collections.abc import Mapping, Sequence
from functools import lru_cache
from types import MappingProxyType

import numpy as np

from ilmek.cams.laws import (
    cubic,
    cycloidal,
    harmonic,
    modified_sine,
    modified_trapezoid,
    modified_uniform,
    parabolic,
    polynomial,
    polynomial_345,
    polynomial_4567,
    s_curve,
    scca,
    spline,
    uniform,
)
from ilmek.cams.laws.law import NONE, REST, Law, LawFamily, Parameters, fixed
from ilmek.errors import ParameterError
from ilmek.plugins import Registry
from ilmek.records import shown_value

__all__ = ["FAMILIES", "LAWS", "REST", "SMOOTH_LAWS", "Law", "Parameters", "law_of"]

FAMILIES = Registry(
    "ilmek.motion_laws",
    {
        "uniform": fixed(uniform.LAW),
        "modified-uniform": modified_uniform.FAMILY,
        "parabolic": fixed(parabolic.LAW),
        "cubic": fixed(cubic.LAW),
        "harmonic": fixed(harmonic.LAW),
        "cycloidal": fixed(cycloidal.LAW),
        "3-4-5": fixed(polynomial_345.LAW),
        "4-5-6-7": fixed(polynomial_4567.LAW),
        "modified-sine": modified_sine.FAMILY,
        "modified-trapezoid": fixed(modified_trapezoid.LAW),
        "scca": scca.FAMILY,
        "spline": spline.FAMILY,
        "polynomial": polynomial.FAMILY,
        "s-curve": s_curve.FAMILY,
    },
    LawFamily,
)
"""The families of laws by name: how a law is built and which parameters it takes."""


def law_of(name: str, parameters: Mapping[str, object] = NONE) -> Law:
    """A motion law by name, with parameters.

    name        a key of `FAMILIES`
    parameters  numbers [-] and rows of numbers, by name; a row of one entry may be given as a number; default: those
                of the family

    The same name and values give the same object.
    Raises ParameterError for an unknown name or parameter (the message offers the nearest one), for a value that is
    not a finite number, for values outside the range of the law, and for values that overflow it.

    >>> law_of("modified-sine", {"constant_velocity": 0.5}).parameters
    {'constant_velocity': 0.5}
    """
    if name not in FAMILIES:
        raise ParameterError(f"there is no law {name!r}", allowed=", ".join(FAMILIES), do=_perhaps(name, FAMILIES))
    defaults = FAMILIES[name].defaults
    for given in parameters:
        if given not in defaults:
            allowed = ", ".join(defaults) or "none"
            raise ParameterError(f"law {name} has no {given!r}", allowed=allowed, do=_perhaps(given, defaults))
    values = {key: _value(name, key, parameters.get(key, default), default) for key, default in defaults.items()}
    return _built(name, tuple(values.items()))


@lru_cache(maxsize=512)
def _built(name: str, values: tuple[tuple[str, float | tuple[float, ...]], ...]) -> Law:
    try:
        with np.errstate(all="ignore"):
            return FAMILIES[name].make(**dict(values))
    except (ArithmeticError, np.linalg.LinAlgError):
        raise ParameterError(
            f"law {name} cannot be computed with these parameters", allowed="values of ordinary magnitude, well apart"
        ) from None


def _value(law: str, key: str, given: object, like: object) -> float | tuple[float, ...]:
    """The given value as a number, or as a row of numbers where the default is one."""
    if isinstance(like, tuple) and isinstance(given, Sequence) and not isinstance(given, str):
        return tuple(_number(law, key, item) for item in given)
    number = _number(law, key, given)
    if isinstance(like, tuple):
        return (number,)
    if not math.isfinite(number):
        raise ParameterError(f"law {law}: {key}={given!r}", allowed="a finite number")
    return number


def _number(law: str, key: str, given: object) -> float:
    try:
        return float(given)  # type: ignore[arg-type]
    except OverflowError:
        raise ParameterError(f"law {law}: {key} has too many digits", allowed="a number up to 1e308") from None
    except (TypeError, ValueError) as error:
        raise ParameterError(f"law {law}: {key} is {shown_value(given)}", allowed="a number") from error


def _perhaps(name: str, known: Mapping[str, object]) -> str:
    near = difflib.get_close_matches(name, known, n=1)
    return f"perhaps {near[0]!r}?" if near else ""


LAWS: Mapping[str, Law] = MappingProxyType({name: law_of(name) for name in FAMILIES.own})
"""Each own law with its default parameters."""

SMOOTH_LAWS: tuple[str, ...] = tuple(name for name, law in LAWS.items() if math.isfinite(law.acceleration_peak))
"""Names of the laws of finite acceleration: those that a follower with a mass can follow."""
