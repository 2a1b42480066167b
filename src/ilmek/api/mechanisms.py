"""Mechanisms: built from lengths or read from a file, moved, and their forces."""

from __future__ import annotations  # so that `help` shows the aliases

from collections.abc import Mapping, Sequence
from pathlib import Path
from types import MappingProxyType
from typing import Any

import numpy as np

from ilmek.arguments import Arguments, Point, Quantities, Quantity
from ilmek.arrays import RealField
from ilmek.dynamics import inverse
from ilmek.dynamics.inertia import Inertia
from ilmek.dynamics.inverse import Forces
from ilmek.dynamics.joint_friction import JointFriction, PinFriction, SlideFriction
from ilmek.dynamics.loads import Load
from ilmek.dynamics.own_machine import OwnMachine
from ilmek.errors import MechanismError
from ilmek.io import mechanism_file
from ilmek.io.mechanism_file import MechanismFile
from ilmek.linkage import fourbar
from ilmek.linkage import solve as linkage
from ilmek.linkage.drawing import as_drawn
from ilmek.linkage.joints import GROUND, body_point
from ilmek.linkage.model import Body, Displacement, Input, Mechanism, Pin, Rotation, Slide
from ilmek.linkage.motion import Motion
from ilmek.linkage.structure import Plan, plan
from ilmek.synthesis.result import FourBarSolution

Values = Quantities | Mapping[str, Quantities]
"""Values of the only input, or of several by name."""

BodyPoints = Mapping[str, Point] | Mapping[str, Mapping[str, Point]]
"""Further points: "body.point" -> position in the body's frame [m]; or body -> points by name."""

Solvable = Mechanism | MechanismFile | Plan | FourBarSolution[Any]
"""What can be moved. A plan saves its own search where the same mechanism is solved many times."""

ANY_ANGLE = "`ilmek.linkage.solve.solve`"
"""What takes angles of any number of turns, for messages."""


def four_bar(
    ground: Quantity,
    crank: Quantity,
    coupler: Quantity,
    rocker: Quantity,
    *,
    branch: int = +1,
    points: BodyPoints | None = None,
    name: str = "four-bar",
) -> Mechanism:
    """A four-bar driven by its crank, from link lengths [m]; pins A0, A, B, B0 with A0 at the origin, B0 on x.

    branch  +1: pin B on the left of A -> B0 (default), -1: on the right
    points  further points of ground, crank, coupler, rocker [m], in the frame at the body's first pin with x to the
            second: `{"rocker.E": 0.3}`

    Raises MechanismError for a length that is not above zero or was probably meant in millimetres, and for points of
    an unknown body.

    >>> beat_up = four_bar(0.300, 0.060, 0.200, "230mm", points={"coupler.P": (0.1, 0.05)})
    >>> beat_up.point("coupler.P")
    (0.1+0.05j)
    """
    given = Arguments("a four-bar", MechanismError)
    links = {"ground": ground, "crank": crank, "coupler": coupler, "rocker": rocker}
    lengths = {link: given.length(link, length) for link, length in links.items()}
    return fourbar.four_bar(
        **lengths,
        branch=given.whole("branch", branch, least=-1, most=1),
        points=_further_points(given, points, tuple(links)),
        name=given.text("name", name),
    )


def slider_crank(
    crank: Quantity,
    rod: Quantity,
    *,
    offset: Quantity = 0.0,
    branch: int = +1,
    points: BodyPoints | None = None,
    name: str = "slider-crank",
) -> Mechanism:
    """A slider-crank driven by its crank, from lengths [m]; crank A0-A, rod A-B, slider at B on the line y = offset.

    branch  +1: the slider on the side of +x (default), -1: on the other
    points  further points of ground, crank, rod, slider [m], as of `four_bar`

    Raises MechanismError as `four_bar`.

    >>> slider_crank(0.040, "140mm", offset=0.010).moving
    ('crank', 'rod', 'slider')
    """
    given = Arguments("a slider-crank", MechanismError)
    return fourbar.slider_crank(
        given.length("crank", crank),
        given.length("rod", rod),
        offset=given.length("offset", offset),
        branch=given.whole("branch", branch, least=-1, most=1),
        points=_further_points(given, points, ("ground", "crank", "rod", "slider")),
        name=given.text("name", name),
    )


def mechanism(
    bodies: Mapping[str, Mapping[str, Point]],
    inputs: str | Input | Sequence[str | Input],
    *,
    slides: Sequence[Slide] = (),
    branches: Mapping[str, int] = MappingProxyType({}),
    name: str = "mechanism",
) -> Mechanism:
    """A mechanism from the points of its bodies [m]: a point that two bodies name is their pin, or the slide so named.

    bodies    body -> points by name, in the body's frame [m]; one body is "ground"
    inputs    a body that turns about its only pin on the ground, or a slide; else `Rotation`, `Displacement`
    slides    `Slide` records      branches  as of `Mechanism`

    Raises MechanismError for a point of three bodies, a body without one pin on the ground, and as `Mechanism`.

    >>> bodies = {"ground": {"O": 0, "C": -0.2j}, "crank": {"O": 0, "A": 0.1}, "block": {"A": 0, "slot": 0}}
    >>> bodies["lever"] = {"C": 0, "slot": 0}
    >>> shaper = mechanism(bodies, "crank", slides=[Slide("slot", "block", "lever")], branches={"slot": +1})
    >>> [joint.name for joint in shaper.joints], shaper.inputs
    (['O', 'C', 'A', 'slot'], (Rotation(body='crank', about='O'),))
    """
    given = Arguments("a mechanism", MechanismError)
    tables = given.mapping("bodies", bodies, lambda body, points: given.mapping(body, points, given.near_point))
    sliding = given.sequence("slides", slides, Slide)
    holders: dict[str, list[str]] = {}
    for body, points in tables.items():
        for point in points:
            holders.setdefault(point, []).append(body)
    pins = []
    for point in [point for point in holders if point not in {slide.name for slide in sliding}]:
        if len(holders[point]) > 2:
            raise given.error(f"point {point!r} is of {', '.join(holders[point])}", allowed="two bodies at a joint")
        if len(holders[point]) == 2:
            pins.append(Pin(point, *holders[point]))

    def driven(entry: str | Input) -> Input:
        if not isinstance(entry, str):
            return entry
        if entry in {slide.name for slide in sliding}:
            return Displacement(entry)
        about = [pin.name for pin in pins if set(pin.bodies) == {GROUND, entry}]
        if len(about) != 1:
            raise given.error(f"{len(about)} pins join {entry!r} and the ground", do="give a Rotation, a Displacement")
        return Rotation(entry, about[0])

    named = [inputs] if isinstance(inputs, str | Rotation | Displacement) else inputs
    drives = tuple(driven(entry) for entry in given.sequence("inputs", named, (str, Rotation, Displacement)))
    return Mechanism(tuple(Body(*entry) for entry in tables.items()), (*pins, *sliding), drives, branches, name)


def _further_points(given: Arguments, points: object, bodies: Sequence[str]) -> dict[str, dict[str, complex]]:
    """Points by body and name [m], of the bodies of a mechanism alone."""
    tables: dict[str, dict[str, complex]] = {}
    for name, value in given.mapping("points", {} if points is None else points, lambda _, value: value).items():
        by_body = isinstance(value, Mapping)
        body, point = (name, "") if by_body else body_point(given, "a key of points", name)
        table = given.mapping(name, value if by_body else {str(point): value}, given.near_point)
        tables.setdefault(given.one_of("a body in points", body, bodies), {}).update(table)
    return tables


def read_mechanism(path: str | Path, *, values: Mapping[str, str] = MappingProxyType({})) -> MechanismFile:
    """The `mechanism` and the `inertias` of a .toml or .json file; `solve` takes the result as it is.

    values  take the place of entries of the file's table `values`, as texts with units
    Raises MechanismError with file, line and key, and for a value that the file does not have.

    >>> read_mechanism("examples/jansen_leg.toml").mechanism.name
    'Jansen leg'
    >>> press = read_mechanism("examples/slider_crank_press.toml", values={"stroke": "80mm"})
    >>> round(press.mechanism.point("crank.A").real, 3)
    0.04
    """
    given = Arguments("a mechanism", MechanismError)
    entries = given.mapping("values", values, given.text)
    return mechanism_file.read_mechanism(given.path("path", path), entries)


def write_mechanism(
    path: str | Path, mechanism: Mechanism | OwnMachine, inertias: Mapping[str, Inertia] | None = None
) -> None:
    """Write a mechanism and its inertias, or a machine with its loads and task, to a .toml or .json file.

    Raises MechanismError for another ending; OutputError where the file cannot be written.

    >>> import pathlib, tempfile
    >>> path = pathlib.Path(tempfile.mkdtemp()) / "four_bar.toml"
    >>> write_mechanism(path, four_bar(0.300, 0.060, 0.200, 0.230), {"rocker": Inertia(0.4, 0.115, 0.002)})
    >>> read_mechanism(path).inertias["rocker"].mass
    0.4
    """
    given = Arguments("a mechanism file", MechanismError)
    file = given.path("path", path)
    given.record("mechanism", mechanism, (Mechanism, OwnMachine))
    if isinstance(mechanism, OwnMachine) and inertias:
        raise MechanismError("inertias are given beside a machine", do="put them into the machine")
    machine = mechanism if isinstance(mechanism, OwnMachine) else OwnMachine(mechanism, as_inertias(inertias or {}))
    mechanism_file.write_mechanism(file, machine)


def solve(
    mechanism: Solvable, values: Values, *, speed: Values = 0.0, acceleration: Values = 0.0, jerk: Values = 0.0
) -> Motion:
    """Motion of a mechanism for a batch of input values.

    values        of the input [rad; m for a displacement], a number or one value per sample; of several inputs by name
    speed, acceleration, jerk  rates of the input [rad/s, rad/s^2, rad/s^3; m/s, ...], a number or one value per sample

    A sample that cannot be solved does not raise: see `Motion.status`, `Motion.require`. Raises MechanismError for a
    mechanism without a plan, unknown or missing inputs, and angles that were probably meant in degrees.

    >>> beat_up = four_bar(0.300, 0.060, 0.200, 0.230)
    >>> motion = solve(beat_up, np.linspace(0, 2 * np.pi, 73), speed="150rpm")
    >>> motion.ok, len(motion)
    (True, 73)
    >>> bool(motion.angle("rocker")[6] == solve(beat_up, "30deg").angle("rocker")[0])
    True
    """
    planned = planned_of(mechanism)
    inputs = planned.mechanism.inputs
    fields = (("value", "", values), ("speed", "/s", speed), ("acceleration", "/s^2", acceleration))
    read = [_by_input(inputs, name, per, field) for name, per, field in (*fields, ("jerk", "/s^3", jerk))]
    return linkage.solve(planned, *read)


def _by_input(inputs: Sequence[Input], quantity: str, per: str, values: Values) -> linkage.InputValues:
    """Values or rates of the inputs by name [SI]; one value of several inputs is left to `linkage.solve`."""
    given = Arguments("", MechanismError)
    turning = {entry.name: isinstance(entry, Rotation) for entry in inputs}

    def read(name: str, value: object, rotates: bool) -> RealField:
        if rotates and not per:
            return given.turning(name, value, ANY_ANGLE)
        return given.values(name, value, f"{'rad' if rotates else 'm'}{per}")

    if not isinstance(values, Mapping):
        return read(f"{quantity} of {next(iter(turning), 'an input')!r}", values, next(iter(turning.values()), True))
    names = given.mapping(f"{quantity} by input", values, lambda _, value: value)
    return {
        given.one_of("an input", name, turning): read(f"{quantity} of {name!r}", value, turning.get(name, True))
        for name, value in names.items()
    }


def inverse_dynamics(
    motion: Motion,
    inertias: Mapping[str, Inertia],
    loads: Sequence[Load] = (),
    joint_frictions: Sequence[JointFriction] = (),
) -> Forces:
    """Joint forces and drive efforts that a motion requires.

    motion           with speeds and accelerations: from `solve(..., speed=...)`
    inertias         body -> inertia; a body that is not listed is massless
    loads            loads such as `Gravity`, `PointForce`, `Torque`, `Spring`; default: none
    joint_frictions  friction of joints: `PinFriction`, `SlideFriction` of `ilmek.dynamics`; default: none

    `forces.pin("B")` is the force in a pin [N], `forces.effort("crank")` the torque of the drive [N m].
    Raises MechanismError for an unknown body or joint, and for a motion at rest without loads, of which all forces are
    0. A sample that cannot be solved does not raise.

    >>> from ilmek import Gravity, bar
    >>> beat_up = four_bar(0.300, 0.060, 0.200, 0.230)
    >>> motion = solve(beat_up, np.linspace(0, 2 * np.pi, 73), speed=15.5)
    >>> forces = inverse_dynamics(motion, {"rocker": bar(0, 0.230, mass=0.4)}, [Gravity(-9.81j)])
    >>> forces.pin("B0").shape, bool(forces.power_error < 1e-9)
    ((73,), True)
    """
    given = Arguments("inverse dynamics", MechanismError)
    moved = given.record("motion", motion, Motion)
    acting = as_loads(given, loads)
    rubbing = as_frictions(given, joint_frictions)
    if not acting and not any(np.any(drive.speed) or np.any(drive.acceleration) for drive in moved.drives.values()):
        raise MechanismError(
            "the motion is at rest and no load acts: all forces are 0", do="give solve a speed, or give loads"
        )
    return inverse.inverse(moved, as_inertias(inertias), acting, rubbing)


def as_loads(given: Arguments, loads: object) -> tuple[Load, ...]:
    """Loads of a call. Raises MechanismError for another object."""
    return given.sequence("loads", loads, Load)


def as_frictions(given: Arguments, frictions: object) -> tuple[JointFriction, ...]:
    """Frictions of joints of a call. Raises MechanismError for another object."""
    return given.sequence("joint_frictions", frictions, (PinFriction, SlideFriction))


def as_inertias(inertias: object) -> dict[str, Inertia]:
    """Inertias of a call by body. Raises MechanismError for another object."""
    given = Arguments("", MechanismError)
    return given.mapping("inertias", inertias, lambda name, value: given.record(name, value, Inertia))


def planned_of(mechanism: Solvable) -> Plan:
    """The plan of a mechanism.

    Raises MechanismError where it has none, for another object, and for points so far out that millimetres were meant:
    a file states its units, a mechanism built in Python does not.
    """
    if isinstance(mechanism, Plan):
        return mechanism
    if isinstance(mechanism, MechanismFile):
        return mechanism.plan()
    if isinstance(mechanism, FourBarSolution):
        mechanism = mechanism.mechanism
    if not isinstance(mechanism, Mechanism):
        raise MechanismError(
            f"{type(mechanism).__name__} given for a mechanism",
            allowed="a Mechanism, the result of `read_mechanism`, or a plan",
        )
    for body in mechanism.bodies:
        given = Arguments(f"body {body.name!r}", MechanismError)
        for point, position in body.points.items():
            given.near_point(f"point {point!r}", position)
    return plan(as_drawn(mechanism))
