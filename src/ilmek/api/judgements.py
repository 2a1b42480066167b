"""The judgement of a mechanism: what it can do, and what its masses, loads and friction need."""

from __future__ import annotations  # so that `help` shows the aliases

from collections.abc import Mapping, Sequence
from dataclasses import replace
from types import MappingProxyType

from ilmek.api.mechanisms import Solvable, as_frictions, as_inertias, as_loads, planned_of
from ilmek.arguments import Arguments, Quantity
from ilmek.dynamics.inertia import Inertia
from ilmek.dynamics.joint_friction import JointFriction
from ilmek.dynamics.judged import JudgedMachine
from ilmek.dynamics.loads import Load
from ilmek.dynamics.own_machine import NamedLoad, OwnMachine
from ilmek.errors import MechanismError
from ilmek.io.mechanism_file import MechanismFile
from ilmek.linkage.model import Rotation
from ilmek.linkage.one_input import one_input


def judged(
    mechanism: Solvable | OwnMachine,
    *,
    by: str | None = None,
    locked: Mapping[str, Quantity] = MappingProxyType({}),
    inertias: Mapping[str, Inertia] = MappingProxyType({}),
    loads: Sequence[Load] = (),
    joint_frictions: Sequence[JointFriction] = (),
    speed: Quantity = 1.0,
) -> JudgedMachine:
    """Grashof's class, circuits, dead centres, transmission angle, coupler curves, tolerances of a mechanism.

    by      the input that moves; default: the only one       locked  values of the others [rad; m], or texts
    inertias, loads, joint_frictions  besides those of a file or machine; see `inverse_dynamics`
    speed   of the input for forces [rad/s; m/s], or a text
    Nothing is computed before it is read. An output is named as in the results: "rocker" the angle of a body,
    "coupler.P x" a coordinate of a point, "line" the travel of a slide. With masses, loads or friction it has `forces`,
    `shaking`, `balance` and `flywheel`.

    Raises MechanismError for an unknown input, and where other inputs have no value.

    >>> from ilmek import four_bar
    >>> beat_up = judged(four_bar(0.300, 0.0597, 0.2007, 0.2308, points={"coupler.P": 0.2 - 0.1j}))
    >>> beat_up.grashof.kind, beat_up.turns, len(beat_up.circuits)
    ('crank-rocker', True, 2)
    >>> back, front = beat_up.limits("rocker")
    >>> round(back.value - front.value, 4), round(beat_up.coupler_curve("coupler.P").length(), 5)
    (0.5233, 0.27659)
    """
    given = Arguments("a judgement", MechanismError)
    machine = mechanism.machine if isinstance(mechanism, MechanismFile) else mechanism
    planned = planned_of(machine.mechanism if isinstance(machine, OwnMachine) else machine)
    turning = {entry.name: isinstance(entry, Rotation) for entry in planned.mechanism.inputs}

    def value(name: str, quantity: object) -> float:
        given.one_of("an input", name, turning)
        return given.number(name, quantity, "rad" if turning[name] else "m")

    moving = "" if by is None else given.one_of("an input", by, turning)
    moved = one_input(planned, moving, given.mapping("locked", locked, value))
    whole = machine if isinstance(machine, OwnMachine) else OwnMachine(planned.mechanism)
    further = tuple(NamedLoad(f"load {number}", load) for number, load in enumerate(as_loads(given, loads), 1))
    whole = replace(
        whole,
        inertias={**whole.inertias, **as_inertias(inertias)},
        loads=whole.loads + further,
        frictions=whole.frictions + as_frictions(given, joint_frictions),
    )
    return JudgedMachine(moved, whole, given.number("speed", speed, "rad/s" if turning[moved.name] else "m/s"))
