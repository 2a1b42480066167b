"""Declarations of parameters by kind: `kind.length(60 * mm, above=0.0, doc="lift of the warps")`.

A kind fixes the dimension and the unit that a value is shown in; `unit` chooses another of the same dimension.
"""

from collections.abc import Callable
from dataclasses import field
from typing import Any, Protocol, TypedDict, Unpack

from ilmek.params.parameter import Value
from ilmek.units import parse_unit


class Declared(TypedDict, total=False):
    """What a declaration may state of a parameter beside its default and its meaning."""

    unit: str
    above: float | None
    at_least: float | None
    below: float | None
    at_most: float | None
    choices: tuple[str, ...]
    symbol: str
    alias: str


def param(default: Value, *, doc: str, **more: Unpack[Declared]) -> Any:
    """Declare a parameter of any kind as the default of a field of `Params`.

    default              SI value; None: optional, `doc` then states what holds instead
    doc                  meaning, a phrase without full stop
    unit                 in which it is shown
    above, below         bounds that are excluded [SI]     at_least, at_most  bounds that are included [SI]
    choices              allowed texts                     symbol   of the literature
    alias                second name under which it can be set
    """
    return field(default=default, metadata=dict(doc=doc, **more))


class Kind(Protocol):
    """Declares a parameter of one dimension; arguments as of `param`."""

    def __call__(self, default: float | None, *, doc: str, **more: Unpack[Declared]) -> Any: ...  # noqa: D102


def _kind(usual: str) -> Kind:
    dimension = parse_unit(usual).dimension

    def declare(default: float | None, *, doc: str, **more: Unpack[Declared]) -> Any:
        if parse_unit(unit := more.setdefault("unit", usual)).dimension != dimension:
            raise TypeError(f"{unit} is not a unit of the same dimension as {usual}")
        return param(default, doc=doc, **more)

    return declare


length = _kind("mm")
angle = _kind("deg")
mass = _kind("kg")
force = _kind("N")
torque = _kind("N*m")
time = _kind("s")
speed = _kind("m/s")
acceleration = _kind("m/s^2")
jerk = _kind("m/s^3")
angular_speed = _kind("rpm")
angular_acceleration = _kind("rad/s^2")
angular_jerk = _kind("rad/s^3")
inertia = _kind("kg*m^2")
stiffness = _kind("N/mm")
line_load = _kind("N/m")
line_density = _kind("g/m")
density = _kind("kg/m^3")
pressure = _kind("MPa")
power = _kind("W")
knot_density = _kind("1/dm")
ratio = _kind("")


def count(
    default: int | None, *, at_least: int | None = None, at_most: int | None = None, doc: str, symbol: str = ""
) -> Any:
    """Declare a whole number."""
    return param(default, at_least=at_least, at_most=at_most, doc=doc, symbol=symbol)


def flag(default: bool, *, doc: str) -> Any:
    """Declare a yes or no."""
    return param(default, doc=doc)


def choice(default: str | None, choices: tuple[str, ...], *, doc: str) -> Any:
    """Declare a text out of a few."""
    return param(default, choices=choices, doc=doc)


def text(default: str | None, *, doc: str, symbol: str = "") -> Any:
    """Declare a free text."""
    return param(default, doc=doc, symbol=symbol)


def nested(cls: Callable[[], Any], *, doc: str, default: object = None) -> Any:
    """Declare a field that holds other `Params`; its parameters are set by dotted names, `pile_handler.rise`.

    default  the record whose values are the defaults here; without one those of the class
    """
    return field(default_factory=cls if default is None else lambda: default, metadata=dict(nested=cls, doc=doc))
