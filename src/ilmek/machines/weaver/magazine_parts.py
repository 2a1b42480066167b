"""The magazine of a head: the yarn tubes on their carrier, a drum or a slide, on an axle over the colours' motor.

A flag under the carrier passes over a sensor, from which the motor's steps count; of several tiers, at the lowest.
"""

import cmath
from collections.abc import Iterator
from dataclasses import replace

from ilmek.cams.loaded_plate_cam import STEEL
from ilmek.elements.field_devices import INDUCTIVE
from ilmek.machines.weaver.carriage_drive import PLATE_BEGIN
from ilmek.machines.weaver.case import BRACKET_ENDS
from ilmek.machines.weaver.design import Weaver
from ilmek.machines.weaver.head_shape import AXLE, RAIL_AXIS
from ilmek.machines.weaver.magazine import ALUMINIUM, CARRIER, DRUM, TUBE_BORE, TUBE_OUTER, tubes_radius
from ilmek.machines.weaver.outlines import bored
from ilmek.machines.weaver.parts import TUBE
from ilmek.machines.weaver.selector import selector_of
from ilmek.machines.weaver.tool_parts import part_id
from ilmek.part import catalogue
from ilmek.part.part import Bought, Part, bought_part
from ilmek.part.placement import UPRIGHT, placement
from ilmek.part.profile import Profile
from ilmek.part.shapes import Prism, bar, box, rectangle, shape_box, stepped, tube
from ilmek.part.tree import Occurrence
from ilmek.plane.contours import circle
from ilmek.sentences import Sentence
from ilmek.units import mm, turn

TUBE_CARRIER, TUBE_AXLE, TUBE_FLAG = part_id("tube-carrier"), part_id("tube-axle"), part_id("tube-flag")
INDEX_SENSOR, INDEX_STAND = part_id("index-sensor"), part_id("index-stand")
"""Ids of the parts."""

FLAG, SENSING = (4 * mm, 2 * mm), 1 * mm
"""Width and thickness of the flag, and from it to the sensor [m]; assumed by this project."""

BESIDE_INDEX = 2.5 * mm
"""Between the index sensor and a motor [m]; assumed by this project."""

CLAMPED, ASIDE_INDEX, STAND_ROOM = 5 * mm, 10 * mm, 0.5 * mm
"""Length of the index sensor in its stand, half the width of that, and room to the motor [m]; assumed by this project.
"""

AXLE_WALL, SPIGOT_WALL, OVER_MOTOR = 4.5 * mm, 1 * mm, 0.5 * mm
"""Wall of the axle under the carrier about the motor's shaft, least wall of its spigot and of the drum about
that, and from it to the motor [m]; assumed by this project."""


def magazine_parts(weaver: Weaver) -> Iterator[Occurrence]:
    """Tubes in tiers, one on the other, the carrier below them, its axle; upright, about the axis of the magazine."""
    magazine, shape = weaver.magazine, weaver.shape
    pitch, flat = magazine.pitch, magazine.tubes_at
    depth = (shape.magazine + shape.magazine_size / 2).real
    low = (shape.magazine + shape.magazine_size / 2).imag - magazine.tiers * pitch / 2
    part = bought_part(
        TUBE,
        "yarn tube",
        "yarn tube",
        tube(TUBE_OUTER * pitch, (TUBE_OUTER - TUBE_BORE) / 2 * pitch, pitch),
        Bought("yarn tube", weaver.params.tube_mass),
        size="one for each colour, with its share of the slide",
    )
    cells = (divmod(cell, magazine.per_tier) for cell in range(magazine.tubes))
    positions = tuple(
        placement(float(flat[column].real), low + tier * pitch, depth + float(flat[column].imag)).after(UPRIGHT)
        for tier, column in cells
    )
    yield Occurrence(part, positions)
    kind = "drum" if magazine.kind == DRUM else "slide"
    plate = magazine.carrier
    flange = shape.magazine.imag - CARRIER - AXLE
    axle, spigot = _axle(weaver, kind, low - CARRIER - flange - OVER_MOTOR)
    begin, end = shape_box(axle.shape)[1][0] if axle.shape else 0.0, _index_at(weaver)
    if spigot > 0:  # pressed into the drum
        section = plate.section
        plate = replace(plate, section=Profile(section.outline, (*section.holes, circle(0j, spigot / 2))))
    carrier = Part(TUBE_CARRIER, f"{kind} of the yarn tubes", "machined link", plate, ALUMINIUM)
    lying = UPRIGHT.after(placement(about=(0.0, 0.0, 1.0), angle=turn / 4))
    yield Occurrence(carrier, (placement(0.0, low - CARRIER, depth).after(lying),))
    yield Occurrence(axle, (placement(0.0, flange + OVER_MOTOR, depth).after(UPRIGHT),))
    strip = box(FLAG[0], FLAG[1], abs(end) + INDUCTIVE.size[0] / 2 - begin)
    flag = Part(TUBE_FLAG, f"flag of the {kind}", "laser-cut part", strip, STEEL, joins=(TUBE_AXLE,))
    under = placement(0.0, low - CARRIER - FLAG[1] / 2, depth, about=(0.0, 1.0, 0.0), angle=turn / 4 - cmath.phase(end))
    yield Occurrence(flag, (under.after(placement(z=begin)),))


def _axle(weaver: Weaver, kind: str, length: float) -> tuple[Part, float]:
    """The axle of a length [m] on its motor's shaft; of several tiers without a bore, as that is beside it.

    Its spigot in the drum, of the diameter that is returned [m], keeps off the tubes; 0: there is no room for one.
    """
    magazine, beside = weaver.magazine, weaver.magazine.tiers > 1
    bore = catalogue.motor_shaft(selector_of(weaver.params, magazine).stepper)
    outer = bore + 2 * AXLE_WALL
    spigot = min(outer, 2 * (tubes_radius(magazine) - SPIGOT_WALL) - TUBE_BORE * magazine.pitch)
    if spigot < bore + 2 * SPIGOT_WALL:
        spigot = 0.0
    steps = (outer, length), *(((spigot, CARRIER),) if spigot > 0 else ())
    shape, notes = (stepped(*steps), ()) if beside else (bored(bore, *steps), (Sentence("sheet.bonded"),))
    return Part(TUBE_AXLE, f"axle of the {kind}", "turned part", shape, STEEL, notes=notes), spigot


def index_sensor(weaver: Weaver) -> Iterator[Occurrence]:
    """The sensor under the magazine's flag, on a stand on the bracket beside the motor."""
    shape, at, (side, _, long) = weaver.shape, _index_at(weaver), INDUCTIVE.size
    depth, foot = (shape.magazine + shape.magazine_size / 2).real + at.imag, shape.rail + RAIL_AXIS / 2
    begin = shape.magazine.imag - CARRIER - FLAG[1] - SENSING - long
    bought = Bought(INDUCTIVE.name, INDUCTIVE.mass)
    sensor = bought_part(INDEX_SENSOR, "index of the yarn tubes", INDUCTIVE.kind, bar(side, long), bought)
    yield Occurrence(sensor, (placement(at.real, begin, depth).after(UPRIGHT),))
    deep, wide = _stand_sides(weaver, at)
    block = Profile(rectangle(deep, wide), (circle(0j, side / 2),))
    high = begin + CLAMPED - foot
    title = "stand of the tubes' index"
    stand = Part(INDEX_STAND, title, "machined link", Prism(block, high), ALUMINIUM)
    yield Occurrence(stand, (placement(at.real, foot, depth).after(UPRIGHT),))


def _stand_sides(weaver: Weaver, at: complex) -> tuple[float, float]:
    """Sides of the sensor's stand along the depth and across [m]: the long one lies along the motor's face."""
    short, clear = 2 * (BESIDE_INDEX - STAND_ROOM) + INDUCTIVE.size[0], _beside_motors(weaver)
    across = abs(at.imag) * clear.real >= abs(at.real) * clear.imag * (1 - 1e-9)
    return (short, 2 * ASIDE_INDEX) if across else (2 * ASIDE_INDEX, short)


def _beside_motors(weaver: Weaver) -> complex:
    """Least distance of the sensor from the magazine's axis, across or along the depth, which clears the motors [m]."""
    face = selector_of(weaver.params, weaver.magazine).face / 2
    motors = complex(face if weaver.magazine.tiers == 1 else 2 * face, face)
    return motors + (INDUCTIVE.size[0] / 2 + BESIDE_INDEX) * (1 + 1j)


def _index_at(weaver: Weaver) -> complex:
    """The sensor in plan about the magazine's axis, x + i z [m]: as near to the motors as it clears them, before the
    plate of the carriage's motor; of a drum between two tubes.
    """
    magazine, shape, beside = weaver.magazine, weaver.shape, _beside_motors(weaver)
    room = shape.front + PLATE_BEGIN - INDUCTIVE.size[0] / 2 - (shape.magazine + shape.magazine_size / 2).real
    if magazine.kind != DRUM:
        return beside.imag * 1j
    number, first = magazine.per_tier, magazine.per_tier // 4
    gaps = [cmath.rect(1.0, turn * (k + 0.5) / number) for k in (*range(first, -1, -1), *range(first + 1, number))]
    radii = (1 / max(abs(gap.real) / beside.real, abs(gap.imag) / beside.imag) for gap in gaps)
    offered = sorted((radius * gap for radius, gap in zip(radii, gaps, strict=True)), key=lambda at: round(abs(at), 9))
    behind = (shape.body + shape.size - shape.magazine - shape.magazine_size / 2).real + BRACKET_ENDS[1]
    free = (at for at in offered if behind + _stand_sides(weaver, at)[0] / 2 <= at.imag <= room)
    return next(free, offered[0])
