"""What a mechanism of a file sends to the workshop and to a controller: its links as plates, its laws as cam tables."""

from collections.abc import Iterator

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.dynamics.own_machine import FlatMember, GivenMotion, OwnMachine
from ilmek.elements.plates import PIN_SHARE, link_plate
from ilmek.errors import ParameterError
from ilmek.linkage.model import Body, Rotation
from ilmek.report import CamTable, Plate
from ilmek.units import turn

SAME = 1e-9
"""Distance [m] below which two points of a body are one: several links on one pin."""


def plates(machine: OwnMachine) -> tuple[tuple[Plate, ...], tuple[str, ...]]:
    """The links with a section as plates, bored at their points, and a note for each moving body without one.

    A hole has its pin's diameter, or a third of the link's width. A link that is too slender for its holes has a note.
    """
    made: list[Plate] = []
    notes: list[str] = []
    for body in machine.mechanism.bodies:
        member = machine.members.get(body.name)
        if member is None or len(_points(body)) < 2:
            continue
        try:
            made.append(_plate(machine, body, member))
        except ParameterError as error:
            notes.append(f"{body.name} has no plate: {error}")
    without = [name for name in machine.mechanism.moving if name not in machine.members]
    if without:
        notes.append(f"no section, no plate: {', '.join(without)}; give width, thickness and material")
    return tuple(made), tuple(notes)


def _plate(machine: OwnMachine, body: Body, member: FlatMember) -> Plate:
    pins = [(name, point - next(iter(_points(body).values()))) for name, point in _points(body).items()]
    radii = {
        name: machine.pins[name].diameter / 2 if name in machine.pins else PIN_SHARE * member.width / 2
        for name, _ in pins
    }
    return link_plate(
        body.name,
        body.name.replace("_", " ").capitalize(),
        pins,
        hole_radius=radii,
        width=member.width,
        thickness=member.thickness,
        material=member.material,
    )


def _points(body: Body) -> dict[str, complex]:
    """The points of a body, of several at one position the first."""
    apart: dict[str, complex] = {}
    for name, point in body.points.items():
        if all(abs(point - other) > SAME for other in apart.values()):
            apart[name] = point
    return apart


def cam_tables(machine: OwnMachine) -> tuple[CamTable, ...]:
    """The laws that inputs follow periodically, over one turn of a master; a constant speed is no cam."""
    return tuple(_tables(machine))


def _tables(machine: OwnMachine) -> Iterator[CamTable]:
    turning = {entry.name for entry in machine.mechanism.inputs if isinstance(entry, Rotation)}
    for name, given in machine.motions.items():
        if given.period is None or given.speed is not None:
            continue
        yield _table(name, given, given.period, "deg" if name in turning else "mm")


def _table(name: str, given: GivenMotion, period: float, unit: str) -> CamTable:
    per_angle = period / turn

    def motion(angle: FloatArray) -> FloatArray:
        value, speed, acceleration = given.law(np.asarray(angle) * per_angle)
        return np.stack([value, speed * per_angle, acceleration * per_angle**2])

    knots = np.unique(np.concatenate([[0.0], np.array(given.breaks) / per_angle, [turn]]))
    start, end = given.law(np.array([0.0, period]))[0]
    return CamTable(
        name, f"Input {name}", motion, knots[(knots >= 0) & (knots <= turn)], unit, period, float(end - start)
    )
