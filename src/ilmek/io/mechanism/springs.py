"""Springs and dampers of a mechanism file, between points of two bodies or torsional."""

from dataclasses import replace

from ilmek.dynamics.springs import Spring, TorsionSpring
from ilmek.errors import MechanismError
from ilmek.io.declared import keys, quantity, variant
from ilmek.io.mechanism.names import spot_of, two_names, two_spots
from ilmek.io.schema import Table
from ilmek.linkage.model import Mechanism
from ilmek.records import JsonObject

_ENDS = {"between": two_spots("its two ends, each a body and its point; the ground is a body")}
_BODIES = {"torsion": two_names("the two bodies", "body")}
_DAMPING = quantity("N*s/m", "default: 0")
_TORSIONAL_DAMPING = quantity("N*m*s/rad", "default: 0")

SPRING = variant(
    keys({**_ENDS, "stiffness": quantity("N/m"), "length": quantity("m", "unloaded")}, {"damping": _DAMPING}),
    keys(
        {**_BODIES, "stiffness": quantity("N*m/rad")},
        {
            "angle": quantity("rad", "of the second against the first, unloaded; default: 0"),
            "damping": _TORSIONAL_DAMPING,
        },
    ),
    name="spring",
)

DAMPER = variant(
    keys({**_ENDS, "damping": replace(_DAMPING, doc="")}),
    keys({**_BODIES, "damping": replace(_TORSIONAL_DAMPING, doc="")}),
    name="damper",
)


def spring_of(table: Table, mechanism: Mechanism) -> Spring | TorsionSpring:
    """A spring or damper. Raises MechanismError for unknown bodies and points, and for ends on one body."""
    stiffness, damping = table.get("stiffness", 0.0), table.get("damping", 0.0)
    if "torsion" in table:
        first, second = table["torsion"]
        for body in (first, second):
            mechanism.body(body)
        _check_apart(first, second)
        return TorsionSpring(first, second, stiffness, table.get("angle", 0.0), damping)
    first, second = (spot_of(end, mechanism) for end in table["between"])
    _check_apart(first[0], second[0])
    return Spring(first, second, stiffness, table.get("length", 0.0), damping)


def _check_apart(first: str, second: str) -> None:
    if first == second:
        raise MechanismError(f"both ends are on {first!r}", allowed="two bodies")


def spring_data(spring: Spring | TorsionSpring) -> JsonObject:
    """The table of a spring or damper."""
    ends: JsonObject
    if isinstance(spring, Spring):
        ends = {"between": [list(end) for end in spring.ends]}
    else:
        ends = {"torsion": [spring.first, spring.second]}
    return {**ends, **SPRING.table(ends).given(spring)}
