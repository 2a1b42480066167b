"""The judgement of a mechanism: what it can do, before any force is computed."""

from __future__ import annotations  # so that `help` shows the aliases

from collections.abc import Mapping
from types import MappingProxyType

from ilmek.api.mechanisms import Solvable, planned_of
from ilmek.arguments import Arguments, Quantity
from ilmek.errors import MechanismError
from ilmek.linkage.judged import JudgedMechanism
from ilmek.linkage.model import Rotation
from ilmek.linkage.one_input import one_input


def judged(
    mechanism: Solvable, *, by: str | None = None, locked: Mapping[str, Quantity] = MappingProxyType({})
) -> JudgedMechanism:
    """Grashof's class, circuits, dead centres, transmission angle, coupler curves, tolerances of a mechanism.

    by      the input that moves; default: the only one       locked  values of the others [rad; m], or texts
    Nothing is computed before it is read. An output is named as in the results: "rocker" the angle of a body,
    "coupler.P x" a coordinate of a point, "line" the travel of a slide.

    Raises MechanismError for an unknown input, and where other inputs have no value.

    >>> from ilmek import four_bar
    >>> beat_up = judged(four_bar(0.300, 0.0597, 0.2007, 0.2308, points={"coupler": {"P": 0.2 - 0.1j}}))
    >>> beat_up.grashof.kind, beat_up.turns, len(beat_up.circuits)
    ('crank-rocker', True, 2)
    >>> back, front = beat_up.limits("rocker")
    >>> round(back.value - front.value, 4), round(beat_up.coupler_curve("coupler.P").length(), 5)
    (0.5233, 0.27659)
    """
    given = Arguments("a judgement", MechanismError)
    planned = planned_of(mechanism)
    turning = {entry.name: isinstance(entry, Rotation) for entry in planned.mechanism.inputs}

    def value(name: str, quantity: object) -> float:
        given.one_of("an input", name, turning)
        return given.number(name, quantity, "rad" if turning[name] else "m")

    moving = "" if by is None else given.one_of("an input", by, turning)
    return JudgedMechanism(one_input(planned, moving, given.mapping("locked", locked, value)))
