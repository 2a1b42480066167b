"""The sensors of a loom, each on the part that it watches or on the frame beside it.

    encoders       on the rear flanges of the motors of head, beat and shedding: grippers open, beater back, shed closed
    axis sensor    in the slot of an axis of the rail's retreat, at its lower end: heads clear
    strain         under the middle of the back rest's beam: the warps' pull bends it
    light barrier  below the level warps behind the back rest: a broken warp falls into it
    weft sensor    on the front of a column, at the height of the laid weft

The warps pull down on the beam with P, and to the back with as much, which bends the fibre under its middle not at
all: it is strained by P l c / (8 E I).                                           [beam theory; Timoshenko and Gere]
"""

from collections.abc import Iterator, Sequence

import numpy as np

from ilmek.elements.beam import uniform
from ilmek.elements.columns import STEEL
from ilmek.elements.field_devices import AXIS_SENSOR, BARRIER, ENCODER, STRAIN, YARN_SENSOR
from ilmek.errors import LoomError
from ilmek.machines.automated_loom.brackets import brackets_of
from ilmek.machines.automated_loom.design import LoomDesign
from ilmek.machines.automated_loom.equipment import signals
from ilmek.machines.automated_loom.equipment.devices import TO_THE_LEFT, TO_THE_RIGHT, device, placed
from ilmek.machines.automated_loom.equipment.surroundings import Surroundings, surroundings
from ilmek.machines.automated_loom.frame import part_id
from ilmek.machines.automated_loom.in_space.maker import MachineTree
from ilmek.machines.shedding.stack import part_id as shedding_part
from ilmek.machines.weaver.parts import MOTOR as HEAD_MOTOR
from ilmek.part.extents import shape_box
from ilmek.part.part import Part
from ilmek.part.placement import Placement, placement
from ilmek.part.tree import Occurrence, RigidBody, Tree
from ilmek.report import Check, at_least
from ilmek.units import mm

_BEAT_MOTORS = ("beat-up/motor", "hammer/motor")
_STEP = 10 * mm
"""Between places that are tried [m]."""

LEAST_STRAIN = 20e-6
"""Strain by the warps at rest that a transducer tells well: 4 % of its range; assumed by this project."""


def sensors(loom: LoomDesign) -> Iterator[MachineTree]:
    """The sensors, each as a body on the body that carries it."""
    near = surroundings(loom)
    yield _encoder(near, signals.HEAD_ANGLE, "encoder of a head", (HEAD_MOTOR,))
    yield _encoder(near, signals.BEAT_ANGLE, "encoder of the beat", _BEAT_MOTORS)
    yield _encoder(near, signals.SHED_ANGLE, "encoder of the shedding cams", (shedding_part("motor"),))
    yield _on_the_axis(near)
    still = (_strain(near), _barriers(loom, near), _weft_sensor(loom, near))
    bodies = (RigidBody(own.part.id, (own,)) for own in still)
    yield MachineTree("automated-loom", Tree(tuple(bodies)))


def _encoder(near: Surroundings, name: str, title: str, motors: Sequence[str]) -> MachineTree:
    """An encoder behind a motor, whose flange is at z = 0 and whose body lies behind it."""
    body, motor, position = near.occurrence(motors)
    assert motor.shape is not None
    rear, part = float(shape_box(motor.shape)[0][2]), device(name, title, ENCODER)
    return _alone(part, position.after(placement(z=rear - ENCODER.size[2])), body.id)


def _alone(part: Part, position: Placement, carrier: str) -> MachineTree:
    body = RigidBody(part.id, (Occurrence(part),), positions=(position,))
    return MachineTree("automated-loom", Tree((body,)), parent=carrier)


def _on_the_axis(near: Surroundings) -> MachineTree:
    """In the slot of an axis of the retreat: the first free place on its sides, from its lower end upwards."""
    body, axis, position = near.occurrence((part_id("retreat-axis"),))
    assert axis.shape is not None
    low, high = shape_box(axis.shape)
    part = device(signals.RETREATED, "sensor of the retreated heads", AXIS_SENSOR)
    _, thick, long = AXIS_SENSOR.size
    sides = [placement(y=float(high[1]) + thick / 2), placement(y=float(low[1]) - thick / 2)]
    for z in np.arange(float(high[2]) - long - _STEP, float(low[2]), -_STEP).tolist():
        for side in sides:
            own = position.after(placement(z=z)).after(side)
            if near.free(*_boxed(part, own), but=axis.id):
                return _alone(part, own, body.id)
    raise _no_room(part)


def _boxed(part: Part, position: Placement) -> tuple[np.ndarray, np.ndarray]:
    assert part.shape is not None
    low, high = shape_box(part.shape)
    corners = np.array([[x, y, z] for x in (low[0], high[0]) for y in (low[1], high[1]) for z in (low[2], high[2])])
    points = position.points(corners)
    return points.min(0), points.max(0)


def _no_room(part: Part) -> LoomError:
    return LoomError(f"no room for the {part.title}", do="set a larger clearance or margin")


def _strain(near: Surroundings) -> Occurrence:
    """Under the back rest's beam, along it."""
    (beam,) = near.of(part_id("back-rest-beam"))
    part = device(signals.TENSION, "strain transducer of the warps' tension", STRAIN)
    _, high, long = STRAIN.size
    y, z = float(beam.low[1]) - high / 2, float(beam.low[2] + beam.high[2]) / 2
    return Occurrence(part, (placed(-long / 2, y, z, TO_THE_RIGHT),))


def _barriers(loom: LoomDesign, near: Surroundings) -> Occurrence:
    """Sender and receiver on the inner faces of the upper brackets, at the first free place below the level warps."""
    part = device(signals.WARP_STOP, "light barrier for broken warps", BARRIER)
    inner, bracket = brackets_of(loom).upper.inner, part_id("upper-bracket")
    begin, end = loom.side.upper.at, loom.side.back_rest.at
    for share in np.linspace(0.2, 0.9, 15).tolist():
        at = begin + share * (end - begin)
        both = (placed(-inner, at.imag, at.real, TO_THE_RIGHT), placed(inner, at.imag, at.real, TO_THE_LEFT))
        if all(near.free(*_boxed(part, own), but=bracket) for own in both):
            return Occurrence(part, both)
    raise _no_room(part)


def _weft_sensor(loom: LoomDesign, near: Surroundings) -> Occurrence:
    """On the front of the left column, looking at the weft between cloth and box; below or above its height."""
    part, column = device(signals.WEFT_STOP, "sensor of the weft", YARN_SENSOR), near.of(part_id("column"))[0]
    wide = YARN_SENSOR.size[0]
    xs = np.arange(float(column.low[0]) + wide, float(column.high[0]) - wide, wide).tolist()
    for offset in _STEP * np.arange(40):
        for y in (loom.side.weft_height - offset, loom.side.weft_height + offset):
            for x in xs:
                own = placement(x, float(y), float(column.high[2]))
                if near.free(*_boxed(part, own), but=column.part):
                    return Occurrence(part, (own,))
    raise _no_room(part)


def sensor_checks(loom: LoomDesign) -> tuple[Check, ...]:
    """Whether the warps' tension at rest bends the back rest's beam enough to be told."""
    made, long = brackets_of(loom), loom.task.width
    moment = uniform.moment_max(loom.task.cloth.pull / long, long)
    strain = float(uniform.bending_stress(moment, made.beam.side / 2, made.beam.inertia)) / STEEL.modulus
    return (
        at_least(
            "warp tension: strain of the back rest's beam",
            strain,
            LEAST_STRAIN,
            "1",
            "what the transducer tells well, assumed by this project",
            cure="set a higher tension",
            parts=(signals.TENSION, part_id("back-rest-beam")),
        ),
    )
