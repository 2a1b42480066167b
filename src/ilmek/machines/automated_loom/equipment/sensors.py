"""The sensors of a loom, each on the part that it watches or on the frame beside it.

    encoders       on the rear flanges of the motors of head, beat and shedding: grippers open, beater back, shed closed
    axis sensor    in the slot of an axis of the rail's retreat, at its lower end: heads clear
    strain         under the middle of the back rest's beam: the warps' pull bends it
    light barrier  below the level warps behind the back rest: a broken warp falls into it
    weft sensor    on the front of a column, at the height of the laid weft

The warps pull down on the beam with P, and to the back with as much, which bends the fibre under its middle not at
all: it is strained by P l c / (8 E I).                                           [beam theory; Timoshenko and Gere]
"""

from collections.abc import Iterable, Iterator
from functools import lru_cache
from itertools import product

import numpy as np

from ilmek.elements.beam import uniform
from ilmek.elements.columns import STEEL
from ilmek.elements.field_devices import AXIS_SENSOR, BARRIER, ENCODER, STRAIN, YARN_SENSOR
from ilmek.machines.automated_loom.brackets import brackets_of
from ilmek.machines.automated_loom.design import LoomDesign
from ilmek.machines.automated_loom.equipment import signals
from ilmek.machines.automated_loom.equipment.devices import TO_THE_LEFT, TO_THE_RIGHT, device, placed
from ilmek.machines.automated_loom.equipment.surroundings import Surroundings, surroundings
from ilmek.machines.automated_loom.frame import part_id
from ilmek.machines.automated_loom.in_space.maker import MachineTree
from ilmek.part.catalogue import brakes_of
from ilmek.part.part import Part
from ilmek.part.placement import Placement, placement
from ilmek.part.shapes import Corner, shape_box
from ilmek.part.tree import GROUND, Occurrence, RigidBody, Tree
from ilmek.records import record
from ilmek.report import Check, at_least, at_most
from ilmek.units import mm

ROW_MOTORS = (*signals.ENCODED[signals.BEAT_ANGLE], *signals.ENCODED[signals.SHED_ANGLE])
"""Motors of beat and shedding, each with an encoder behind it."""

_STEP = 10 * mm
"""Between places that are tried [m]."""

LEAST_STRAIN = 20e-6
"""Strain by the warps at rest that a transducer tells well: 4 % of its range; assumed by this project."""


@record
class MountedSensor:
    """Where pieces of a sensor are on the body that carries it, and whether they have room there."""

    part: Part
    carrier: str
    positions: tuple[Placement, ...]
    free: bool = True


@lru_cache(maxsize=4)
def mounted_sensors(loom: LoomDesign) -> tuple[MountedSensor, ...]:
    """The sensors of a loom."""
    near = surroundings(loom)
    of_heads: tuple[MountedSensor, ...] = ()
    if loom.heads:
        of_heads = encoder(near, signals.HEAD_ANGLE, "encoder of a head"), _on_the_axis(near)
    return (
        *of_heads,
        encoder(near, signals.BEAT_ANGLE, "encoder of the beat"),
        encoder(near, signals.SHED_ANGLE, "encoder of the shedding cams"),
        _strain(near),
        _barriers(loom, near),
        _weft_sensor(loom, near),
    )


def sensors(loom: LoomDesign) -> Iterator[MachineTree]:
    """The sensors, each as a body on the body that carries it."""
    return (sensor_tree(place, "automated-loom") for place in mounted_sensors(loom))


def sensor_tree(mounted: MountedSensor, machine: str) -> MachineTree:
    """A sensor as a body on the body that carries it."""
    body = RigidBody(mounted.part.id, (Occurrence(mounted.part, mounted.positions),))
    return MachineTree(machine, Tree((body,)), parent=mounted.carrier)


def encoder(near: Surroundings, name: str, title: str) -> MountedSensor:
    """An encoder behind its motor, or behind the brake of that: the flange is at z = 0 and all lies behind it."""
    body, motor, position = near.occurrence(signals.ENCODED[name])
    last = brakes_of(body).get(motor.id, motor)
    assert last.shape is not None
    rear = float(shape_box(last.shape)[0][2])
    return MountedSensor(device(name, title, ENCODER), body.id, (position.after(placement(z=rear - ENCODER.size[2])),))


def _first_free(
    near: Surroundings, part: Part, carrier: str, offered: Iterable[tuple[Placement, ...]], on: str
) -> MountedSensor:
    """The first of the places that are offered in which all pieces have room beside the part on which they are; where
    none has, the first.
    """
    first: tuple[Placement, ...] = ()
    for positions in offered:
        if all(near.free(*_boxed(part, own), but=on) for own in positions):
            return MountedSensor(part, carrier, positions)
        first = first or positions
    return MountedSensor(part, carrier, first, free=False)


def _boxed(part: Part, position: Placement) -> tuple[Corner, Corner]:
    assert part.shape is not None
    low, high = shape_box(part.shape)
    points = position.points(np.array(list(product(*zip(low.tolist(), high.tolist(), strict=True)))))
    return points.min(0), points.max(0)


def _on_the_axis(near: Surroundings) -> MountedSensor:
    """In the slot of an axis of the retreat, on one of its sides, as near to its lower end as there is room."""
    body, axis, position = near.occurrence((part_id("retreat-axis"),))
    assert axis.shape is not None
    low, high = shape_box(axis.shape)
    part = device(signals.RETREATED, "sensor of the retreated heads", AXIS_SENSOR)
    _, thick, long = AXIS_SENSOR.size
    sides = placement(y=float(high[1]) + thick / 2), placement(y=float(low[1]) - thick / 2)
    along = np.arange(float(high[2]) - long - _STEP, float(low[2]), -_STEP).tolist()
    offered = ((position.after(placement(z=z)).after(side),) for z in along for side in sides)
    return _first_free(near, part, body.id, offered, axis.id)


def _strain(near: Surroundings) -> MountedSensor:
    """Under the back rest's beam, along it."""
    beam, part = near.of(part_id("back-rest-beam"))[0], device(signals.TENSION, "sensor of the warps' tension", STRAIN)
    _, high, long = STRAIN.size
    y, z = float(beam.low[1]) - high / 2, float(beam.low[2] + beam.high[2]) / 2
    return _first_free(near, part, GROUND, ((placed(-long / 2, y, z, TO_THE_RIGHT),),), beam.part)


def _barriers(loom: LoomDesign, near: Surroundings) -> MountedSensor:
    """Sender and receiver on the inner faces of the upper brackets, below the level warps."""
    part, upper = device(signals.WARP_STOP, "light barrier for broken warps", BARRIER), brackets_of(loom).upper
    begin, end = loom.side.upper.at, loom.side.back_rest.at
    lower = np.arange(0.0, upper.radius - BARRIER.size[1] / 2, _STEP).tolist()
    places = (begin + share * (end - begin) - 1j * y for y in lower for share in np.linspace(0.2, 0.9, 71).tolist())
    offered = (
        (placed(-upper.inner, at.imag, at.real, TO_THE_RIGHT), placed(upper.inner, at.imag, at.real, TO_THE_LEFT))
        for at in places
    )
    return _first_free(near, part, GROUND, offered, part_id("upper-bracket"))


def _weft_sensor(loom: LoomDesign, near: Surroundings) -> MountedSensor:
    """On the front of the left column, looking at the weft between cloth and box, as near to its height as it can."""
    part, column = device(signals.WEFT_STOP, "sensor of the weft", YARN_SENSOR), near.of(part_id("column"))[0]
    wide, z, middle = YARN_SENSOR.size[0], float(column.high[2]), loom.side.weft_height
    xs = np.arange(float(column.low[0]) + wide, float(column.high[0]) - wide, wide).tolist()
    heights = (middle + sign * offset for offset in (_STEP * np.arange(40)).tolist() for sign in (-1, 1))
    return _first_free(near, part, GROUND, ((placement(x, y, z),) for y in heights for x in xs), column.part)


def beam_strain(loom: LoomDesign) -> float:
    """Greatest strain of the back rest's beam under the warps' tension at rest."""
    beam, long = brackets_of(loom).beam, loom.task.width
    moment = uniform.moment_max(loom.task.cloth.pull / long, long)
    return float(uniform.bending_stress(moment, beam.side / 2, beam.inertia)) / STEEL.modulus


def sensor_checks(loom: LoomDesign) -> tuple[Check, ...]:
    """Room of the sensors; whether the warps' tension at rest bends the back rest's beam enough to be told."""
    tight = tuple(place.part for place in mounted_sensors(loom) if not place.free)
    return (
        at_most(
            "sensors without room",
            len(tight),
            0,
            "1",
            "; ".join(part.title for part in tight) or "beside all parts of the loom, over all motions",
        ).with_cure("set a larger clearance", *tuple(part.id for part in tight)),
        at_least(
            "warp tension: strain of the back rest's beam",
            beam_strain(loom),
            LEAST_STRAIN,
            "1",
            "what the transducer tells well, assumed by this project",
        ).with_cure("set a higher tension", signals.TENSION, part_id("back-rest-beam")),
    )
