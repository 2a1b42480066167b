"""The plate that carries a crank-rocker, its pins, and the slide or the beam that it is bolted to.

Axes of the linkage, as in `tree`. The plate stands beside the crank, in the last of the planes along the pins: it
carries the crank's pin D, the longer one of the rocker, A, and reaches over beam and slide in front of A. The drive of
the crank is flanged to its other side.
"""

import cmath
import math
from collections.abc import Iterator, Sequence
from functools import lru_cache
from itertools import pairwise

import numpy as np

from ilmek.arrays import ComplexArray
from ilmek.elements.belts import BELTS, belt_length
from ilmek.elements.columns import STEEL
from ilmek.elements.pin_joints import PIN_DIAMETERS
from ilmek.elements.shoulders import LEAST_SAFETY, Shoulder
from ilmek.machines.bearing_seats import CLEAR
from ilmek.machines.beat_up.beam import BEFORE_PIVOT
from ilmek.machines.beat_up.design import BeatUp
from ilmek.machines.beat_up.links import PART_IDS, layer
from ilmek.machines.beat_up.parts import pin_part
from ilmek.machines.link_tree import PIN_STEEL
from ilmek.part import catalogue
from ilmek.part.part import Bought, Part, bought_part
from ilmek.part.placement import placement
from ilmek.part.profile import Profile, drilled
from ilmek.part.shapes import Prism, bar, box, stepped
from ilmek.part.tree import Occurrence, in_line
from ilmek.plane.contours import circle, polygon, rounded_hull
from ilmek.plane.curves import hull
from ilmek.report import Check, Hole, at_least, at_most
from ilmek.units import in_mm, mm

AXIS_SIDE = 80 * mm
"""Side of the section of the belt axis [m]; assumed by this project."""

BLOCK_HEIGHT, BLOCK_LENGTH, BLOCK_MASS = 20 * mm, 120 * mm, 1.5
"""Carriage of the belt axis: height, length [m], mass [kg]; usual of axes of 80 mm, makers' data."""

PLATE = "beat-up/carriage-plate"
"""Id of the plate of crank and rocker."""

SHAFTS = (*PIN_DIAMETERS[4:], 125 * mm, 160 * mm)
"""Diameters of that shaft and its journal to choose from [m]."""

SHARED_SHAFT = "beat-up/shared-shaft"
"""Id of the shaft that drives the cranks of a comb."""

BELT, BELT_BODY, BELT_WIDTH = BELTS["HTD 8M"], 2.5 * mm, 30 * mm
"""The belt from it to a crank, its thickness without teeth, and room for its pulleys along the pins [m]: assumed by
this project."""

DRIVE_PLATE, DRIVE_GAP, _DRIVE_BORE = "beat-up/drive-plate", 5 * mm, 0.3
"""Id of the plate of the drive of a comb, its distance from the flywheel [m], radius of its bore over the face of what
it carries; assumed by this project.
"""

NECK = 20 * mm
"""Length of the journal of that shaft before its drive [m]: assumed by this project."""

_AROUND = 10 * mm
"""Of the plate about the crank's pin, beyond the width of a link [m]: assumed by this project."""


def in_links_axes(linkage: BeatUp, points: ComplexArray) -> ComplexArray:
    """Points of the side view, the fell at 0, in the axes of the linkage [m]: z -> e^(i g) conj(z - D), g = pi + r0."""
    turned = cmath.exp(1j * (math.pi + linkage.rocker_angles[0]))
    return np.asarray(turned * np.conj(points - shaft(linkage)))


def shaft(linkage: BeatUp) -> complex:
    """The crank's axis in the side view, the fell at 0 [m]."""
    return linkage.lengths["beater"] + linkage.lengths["ground"] * cmath.exp(1j * linkage.rocker_angles[0])


def beam_corner(linkage: BeatUp) -> complex:
    """Lower corner of the beam towards the warps, in the side view [m]."""
    eye = linkage.params.width / 2
    return complex(linkage.lengths["beater"] + eye + BEFORE_PIVOT, -eye)


def plate_part(linkage: BeatUp, wide: float, top: float, high: float, shared: float = 0.0) -> Part:
    """The plate over a beam, or over the slide on it.

    wide    of what it is bolted to [m]      top, high  of that, over the lower side of the beam: from, by [m]
    shared  diameter of the shaft that drives the cranks of a comb [m]; 0: none
    """
    eye, centre, arm = linkage.params.width / 2, shaft(linkage), linkage.lengths["beater"]
    corner, about, driving = beam_corner(linkage), max(eye, shared / 2) + _AROUND, shared_axis(linkage, shared)
    low, end = corner.imag + top, corner.real + wide
    corners = np.array(
        [
            complex(arm - eye, -eye),
            complex(arm + eye, -eye),
            complex(arm + eye, low),
            complex(end, low),
            complex(end, low + high),
            *((driving + about * (1 - 1j), driving + about * (1 + 1j)) if shared else ()),
            *((driving + about * (-1 + 1j),) if shared else (centre + about * (1 + 1j),)),
            centre + about * (-1 + 1j),
            centre - about * (1 + 1j),
        ]
    )
    radius = linkage.pin / 2
    holes = [Hole(0j, radius), Hole(complex(linkage.lengths["ground"]), radius)]
    if shared:
        holes.append(Hole(complex(in_links_axes(linkage, np.array([driving]))[0]), shared / 2))
    thickness = linkage.params.thickness
    shape = Prism(drilled(polygon(in_links_axes(linkage, corners)[::-1]), holes), thickness)
    return Part(PLATE, "plate of crank and rocker", "laser-cut part", shape, STEEL, machined=True)


def drive_plate(linkage: BeatUp, beam: float, driven: Part, shared: float) -> Part:
    """The plate on a beam of a side [m] that carries reducer and motor of the shared shaft, of a diameter [m]."""
    corner, axis, face = beam_corner(linkage), shared_axis(linkage, shared), catalogue.face_of(driven)
    foot, about = corner + 1j * beam, max(face / 2, catalogue.screwed_radius(driven)) + _AROUND
    square = axis + about * np.array([1 + 1j, 1 - 1j, -1 + 1j, -1 - 1j])
    outline = polygon(hull(in_links_axes(linkage, np.array([foot, foot + beam, *square]))))
    hole = Hole(complex(in_links_axes(linkage, np.array([axis]))[0]), _DRIVE_BORE * face)
    thickness = linkage.params.thickness
    shape = Prism(drilled(outline, [hole]), thickness)
    return Part(DRIVE_PLATE, "plate of the drive", "laser-cut part", shape, STEEL, machined=True)


def drive_shaft(linkage: BeatUp, driven: Part) -> Part:
    """The shaft from the flywheel through the plate of the drive to the reducer or motor, clear of the plate's bore."""
    diameter = 2 * (_DRIVE_BORE * catalogue.face_of(driven) - CLEAR)
    shape, held = bar(diameter, DRIVE_GAP + linkage.params.thickness), "locking assemblies in flywheel and reducer"
    return Part(
        *("beat-up/drive-shaft", "shaft of the drive", "turned part", shape, PIN_STEEL),
        fixing=held,
    )


def _teeth(linkage: BeatUp, shared: float) -> int:
    """Teeth of the pulleys on a shaft of a diameter [m] and on the cranks."""
    radius = max(linkage.params.width / 2, shared / 2 + _AROUND)
    return max(BELT.least_teeth, math.ceil(2 * math.pi * radius / BELT.pitch))


def shared_axis(linkage: BeatUp, shared: float) -> complex:
    """Axis of the shaft, of a diameter [m], that drives the cranks of a comb, in the side view, beyond their circles;
    the pulleys have room beside each other [m].
    """
    pulleys = 2 * BELT.tip_radius(_teeth(linkage, shared)) + 3 * catalogue.RIM_HEIGHT
    away = max(linkage.lengths["crank"] + linkage.params.width + 2 * _AROUND, pulleys)
    return shaft(linkage) + away * cmath.exp(0.25j * math.pi)


def shared_end(linkage: BeatUp, torque: float, number: int) -> Shoulder:
    """The end of the shaft of a number of cranks at its drive: the thinnest stock that bears a torque [N m] at its
    shoulder, and the last belt's pull beside it; the thickest where none does.

        M = T / (n r) b / 2            r radius and b width of a belt; the torque changes its sign with each beat
    """
    moment = 2 * torque / (number * linkage.params.width) * BELT_WIDTH / 2
    offered = [Shoulder(whole, journal, PIN_STEEL.tensile, moment, torque) for journal, whole in pairwise(SHAFTS)]
    return next((own for own in offered if _bears(own)), offered[-1])


def _bears(end: Shoulder) -> bool:
    return all(check.ok for check in _shoulder_checks(end))


def shared_checks(linkage: BeatUp, torque: float, number: int) -> tuple[Check, ...]:
    """Stress and fatigue of that shaft at its shoulder; torque [N m] of a number of cranks."""
    return _shoulder_checks(shared_end(linkage, torque, number))


def _shoulder_checks(end: Shoulder) -> tuple[Check, ...]:
    cure, parts = "set a lower speed of the crank", (SHARED_SHAFT,)
    yielding, source = f"{PIN_STEEL.name}, yield over {LEAST_SAFETY:g}: DIN 743-1", "Goodman, DIN 743-2"
    return (
        at_most(
            "stress of the cranks' shaft at its drive", end.stress, PIN_STEEL.strength / LEAST_SAFETY, "MPa", yielding
        ).with_cure(cure, *parts),
        at_least(
            "fatigue of the cranks' shaft at its shoulder",
            end.safety,
            LEAST_SAFETY,
            "1",
            f"{source}, fillet of {in_mm(end.fillet)}",
        ).with_cure(cure, *parts),
    )


def shared_drive(linkage: BeatUp, torque: float, stations: Sequence[float], neck: float) -> Iterator[Occurrence]:
    """The shaft along z from the first station's plate to the last one's belt, with a neck of a length [m] beyond, and
    a belt from it to each crank.
    """
    end, thickness = shared_end(linkage, torque, len(stations)), linkage.params.thickness
    begin, belt_begin = min(stations) + plate_begin(linkage), plate_begin(linkage) + thickness
    axis = complex(in_links_axes(linkage, np.array([shared_axis(linkage, end.shaft)]))[0])
    length = max(stations) + belt_begin + BELT_WIDTH - begin
    shape = stepped((end.shaft, length), (end.journal, neck))
    shared = Part(SHARED_SHAFT, "shaft of all cranks", "turned part", shape, PIN_STEEL)
    teeth = _teeth(linkage, end.shaft)
    tips = BELT.tip_radius(teeth) + 0.05 * mm
    outer, inner = (rounded_hull(np.array([0, axis]), radius) for radius in (tips + BELT_BODY, tips))
    length = belt_length(BELT, teeth, teeth, abs(axis))
    size = f"belt {BELT.name}, {in_mm(BELT.widths[0])} wide, {round(length / BELT.pitch)} teeth"
    bought = Bought(size, BELT.mass * BELT.widths[0] * length, length=length)
    band = Prism(Profile(outer, (inner,)), BELT.widths[0])
    belt = bought_part("beat-up/shared-belt", "belt of a crank", "belt", band, bought)
    yield Occurrence(shared, (placement(axis.real, axis.imag, begin),))
    low = belt_begin + catalogue.RIM
    yield Occurrence(belt, tuple(placement(z=z + low + catalogue.BESIDE) for z in stations))
    for name, at, bore in (("shaft", axis, end.shaft), ("crank", 0j, linkage.pin)):
        title, edge = f"pulley of the {name}'s belt", circle(0j, bore / 2)
        part = catalogue.toothed_pulley(
            f"beat-up/{name}-pulley", title, BELT, teeth, BELT.widths[0], edge, clamped=True
        )
        yield Occurrence(part, tuple(placement(at.real, at.imag, z + low) for z in stations))


def plate_begin(linkage: BeatUp) -> float:
    """Where the plate begins along the pins [m]."""
    thickness = linkage.params.thickness
    return layer("plate", thickness) - thickness / 2


def pivot_pin(linkage: BeatUp) -> Part:
    """The pin A, from the rocker through the planes of coupler and crank to the plate."""
    return _pivot_pin(linkage.pin, linkage.params.thickness)


@lru_cache(maxsize=16)
def _pivot_pin(diameter: float, thickness: float) -> Part:
    shape = bar(diameter, layer("plate", thickness) + thickness)
    return Part(PART_IDS["A"], "pin of the rocker's pivot", "pin or bush", shape, PIN_STEEL)


@lru_cache(maxsize=16)
def _belted_pin(diameter: float, length: float) -> Part:
    """The crank's pin where a belt drives it: it reaches through the plate and the pulley."""
    title, shape = "pin of the crank, with its pulley", bar(diameter, length)
    return Part("beat-up/crank-pin", title, "pin or bush", shape, PIN_STEEL)


def carried(linkage: BeatUp, plate: Part, station: float = 0.0, *, belted: bool = False) -> tuple[Occurrence, ...]:
    """The plate of a crank-rocker at a station along z [m], and both pins in it, that of the crank through a pulley."""
    thickness, begin = linkage.params.thickness, plate_begin(linkage)
    crank = layer("crank", thickness) - thickness / 2
    beyond = begin + thickness + BELT_WIDTH - crank
    return (
        Occurrence(plate, (placement(z=station + begin),)),
        Occurrence(_belted_pin(linkage.pin, beyond) if belted else pin_part(linkage), (placement(z=station + crank),)),
        Occurrence(pivot_pin(linkage), (placement(linkage.lengths["ground"], z=station - thickness / 2),)),
    )


def driving(drive: Sequence[Part], z: float, axis: complex = 0j) -> tuple[Occurrence, ...]:
    """A drive behind one another from z [m] on, in line with an axis [m]."""
    behind = placement(axis.real, axis.imag, z, about=(1.0, 0.0, 0.0), angle=math.pi)
    parts = in_line(drive, 0.0)
    return tuple(Occurrence(own.part, tuple(behind.after(at) for at in own.positions)) for own in parts)


def on_slide(linkage: BeatUp, high: float, drive: Sequence[Part]) -> tuple[Occurrence, ...]:
    """The plate over the slide on a beam of a height [m], its pins, and the drive of the crank on it."""
    plate = plate_part(linkage, AXIS_SIDE, high + AXIS_SIDE, BLOCK_HEIGHT)
    return (*carried(linkage, plate), *driving(drive, plate_begin(linkage) + linkage.params.thickness))


def slide_block() -> Part:
    """The carriage of the belt axis, along z from z = 0, its base on y = 0."""
    return _BLOCK


_BLOCK = bought_part(
    "beat-up/slide-carriage",
    "carriage of the slide",
    "guide carriage",
    box(AXIS_SIDE, BLOCK_HEIGHT, BLOCK_LENGTH),
    Bought("carriage of the belt axis", BLOCK_MASS),
)
