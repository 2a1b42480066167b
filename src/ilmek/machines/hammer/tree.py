"""The hammer as a tree of bodies: the comb, on vertical axes or on crank-rockers, with its ballast.

Axes: on vertical axes those of the side view, x from the fell to the front, y up, z across; on crank-rockers those of
the linkage (`beat_up.tree`). The middle of the width is at z = 0; bodies lie at rest as at the beat.
"""

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from functools import lru_cache

import numpy as np

from ilmek.arrays import ComplexArray
from ilmek.machines.beat_up.beam import BeatBeam, beam_for
from ilmek.machines.beat_up.beater import across, rectangle
from ilmek.machines.beat_up.carriage import beam_corner
from ilmek.machines.beat_up.links import PART_IDS, layer
from ilmek.machines.beat_up.tree import CARRIAGE, crank_frame, crank_rockers, loops, on_rocker, rocker_position
from ilmek.machines.hammer.axis import CARRIAGE_MASS
from ilmek.machines.hammer.comb import BAR_ID, BEHIND, LEAF_ID, bar_low, slot_of
from ilmek.machines.hammer.design import Hammer
from ilmek.machines.hammer.linkage import bracket
from ilmek.machines.hammer.params import STEEL, HammerParams
from ilmek.machines.link_tree import GAP
from ilmek.machines.linkage_strength import FLAT_BARS
from ilmek.part import catalogue
from ilmek.part.part import WELDED, Bought, Part, bought_part
from ilmek.part.placement import Placement, placement
from ilmek.part.profile import Profile
from ilmek.part.shapes import Placed, Prism, Sum, box
from ilmek.part.tree import Closure, Joint, JointKind, Occurrence, RigidBody, Tree, depth_of
from ilmek.plane.contours import polygon
from ilmek.report.scene import SceneMotion
from ilmek.sentences import Sentence
from ilmek.units import in_mm, mm, um

COMB = "hammer/comb"
"""Body of the comb."""

MOTOR, BRAKE, AXIS = "hammer/motor", "hammer/motor-brake", "hammer/axis"

BONDED = "bonded in its slot"
"""How a leaf is held."""

AXIS_SIDE = 80 * mm
"""Side of the section of a vertical axis [m]; assumed by this project."""


BLOCK_HEIGHT, BLOCK_DEPTH = 20 * mm, 20 * mm
"""Carriage of a vertical axis: height and least depth [m]; assumed by this project."""

ABOVE_HEADS = 90 * mm
"""Lower end of the axes over the fell [m], where it is not given: above heads that knot; assumed by this project."""


def tree(hammer: Hammer, motions: Mapping[str, SceneMotion] | None = None) -> Tree:
    """The bodies of a hammer; motions  of them by their ids."""
    bodies = _on_crank_rockers(hammer) if hammer.linkage is not None else _on_axes(hammer)
    return bodies.moving(motions or {})


def outline(params: HammerParams) -> tuple[ComplexArray, ...]:
    """The comb in the side view [m]: its leaves through the warps, the bar in front of their roots, ballast before it.

    On crank-rockers the bar is above the pile, so that it may stand nearer to the warps, clear of the coupler.
    """
    front, deep, low = params.reach, params.comb_thickness, bar_low(params)
    bar = rectangle(front, front + deep, low, low + params.depth)
    comb = rectangle(-BEHIND, front, 0.0, params.leaf_height), bar
    ballast = params.ballast or 0.0
    if params.drive != "linkage" or not ballast:
        return comb
    side = math.sqrt(ballast / (STEEL.density * math.fsum(high - first for first, high in _between(params))))
    return (*comb, rectangle(front + deep, front + deep + side, low, low + side))


def rocker_stations(params: HammerParams) -> tuple[float, ...]:
    """Middles of the rockers across the width, 0 in its middle [m]."""
    return tuple(params.cloth.width * ((k + 0.5) / params.rockers - 0.5) for k in range(params.rockers))


def _between(params: HammerParams) -> Iterator[tuple[float, float]]:
    """Spans of the width between the planes of the links, where the bar is free [m]; all of it where none is."""
    thickness = params.link_thickness or FLAT_BARS[0][1]
    ends = [-params.cloth.width / 2]
    for station in rocker_stations(params):
        first = station - (1 + GAP) * thickness
        ends += [max(first, ends[-1]), station + layer("plate", thickness) + thickness]
    ends.append(params.cloth.width / 2)
    free = [(low, high) for low, high in zip(ends[::2], ends[1::2], strict=True) if high > low]
    return iter(free or [(-params.cloth.width / 2, params.cloth.width / 2)])


def _comb(hammer: Hammer) -> tuple[Occurrence, ...]:
    """Bar and leaves, the bar's ballast before it; the axes of the side view, 0 where the leaves strike."""
    params, steel = hammer.params, replace(STEEL, density=hammer.params.density)
    leaf, bar, *ballast = outline(params)
    number, pitch, (deep, tall) = params.cloth.warps - 1, params.cloth.warp_pitch, slot_of(params)
    middle, stations = placement(z=-params.cloth.width / 2), _leaves(number, pitch, params.leaf)
    if deep:  # a tang in its slot
        corner = complex(params.reach, bar_low(params))
        leaf = np.array([*leaf[:2], *(corner + np.array([0.0, deep, deep + 1j * tall, 1j * tall])), *leaf[2:]])
        leaf = leaf[abs(leaf - np.roll(leaf, 1)) > um]
    process = WELDED if params.drive == "linkage" else "machined link"
    sizes = {"width": in_mm(params.leaf), "deep": in_mm(deep), "pitch": in_mm(pitch)}
    slots = Sentence("sheet.leaf-slots", number=str(number), **sizes)
    shape, title = _slotted(params, bar, stations), "comb of the hammer"
    leaves = across(LEAF_ID, "leaf of the comb", "laser-cut part", leaf, params.leaf, steel)
    comb = (
        Occurrence(
            Part(BAR_ID, title, process, shape, steel, machined=True, notes=(slots,) if deep else ()), (middle,)
        ),
        Occurrence(replace(leaves, yarns=True, fixing=BONDED), stations),
    )
    return (*comb, *(Occurrence(_ballast(params, section)) for section in ballast))


def _slotted(params: HammerParams, bar: ComplexArray, stations: Sequence[Placement]) -> Sum:
    """The bar along the width from z = 0: with a slot for each leaf at its face to the warps, above them whole."""
    (low, high), wide, (deep, tall) = _corners(bar), params.cloth.width, slot_of(params)
    begins = np.array([place.origin[2] for place in stations]) + wide / 2
    notch = np.array([0.0, deep, deep, 0.0]) - 1j * np.array([0.0, 0.0, params.leaf, params.leaf])
    edge = (notch - 1j * begins[:, None]).ravel()
    back = high.real - low.real
    section = low.real + np.array([0.0, *edge, -1j * wide, back - 1j * wide, back])
    upright = placement(0.0, low.imag, 0.0, about=(1.0, 0.0, 0.0), angle=-math.pi / 2)
    above = rectangle(low.real, high.real, low.imag + tall, high.imag)
    slots = (Placed(Prism(Profile(polygon(section)), tall), (upright,)),) if deep else ()
    whole = (Placed(Prism(Profile(polygon(above)), wide)),) if high.imag - low.imag > tall else ()
    return Sum((*slots, *whole))


def _corners(points: ComplexArray) -> tuple[complex, complex]:
    """Lower and upper corner of a rectangle [m]."""
    return complex(points.real.min(), points.imag.min()), complex(points.real.max(), points.imag.max())


@lru_cache(maxsize=16)
def _leaves(number: int, pitch: float, thickness: float) -> tuple[Placement, ...]:
    """Leaves of a thickness between warps of a pitch [m], in the axes of the side view."""
    stations = (np.arange(number) - (number - 1) / 2) * pitch - thickness / 2
    return tuple(placement(z=z) for z in stations.tolist())


def _ballast(params: HammerParams, section: ComplexArray) -> Part:
    """Bars between the links; z is turned where the comb is on its rockers, so that they lie mirrored here."""
    bars = (
        Placed(Prism(Profile(polygon(section)), high - low), (placement(z=-high),)) for low, high in _between(params)
    )
    return Part("hammer/ballast", "ballast of the comb", "steel bar", Sum(tuple(bars)), STEEL)


def _brackets(hammer: Hammer, stations: Sequence[float]) -> Occurrence:
    """Plates beside the rockers, in the axes of the side view: each joins the comb's bar to its rocker."""
    assert hammer.linkage is not None
    one = hammer.linkage.one
    plate = bracket(one.params, hammer.params)
    beside = 0.5 * one.params.thickness
    return Occurrence(plate, tuple(placement(z=beside - z) for z in stations))


@lru_cache(maxsize=4)
def _on_crank_rockers(hammer: Hammer) -> Tree:
    linkage = hammer.linkage
    assert linkage is not None
    one = linkage.one
    stations = rocker_stations(hammer.params)
    parts = (*_comb(hammer), _brackets(hammer, stations))
    joint, positions = Joint(JointKind.PIN), (rocker_position(one),)
    comb = RigidBody(
        COMB, tuple(on_rocker(occurrence, one.lengths["beater"]) for occurrence in parts), CARRIAGE, joint, positions
    )
    return Tree(
        (crank_frame(one, linkage.beam, linkage.start, stations), *crank_rockers(one, CARRIAGE, stations), comb),
        (
            *loops(one),
            Closure(JointKind.FIXED, (COMB, PART_IDS["rocker"])),
            *([Closure(JointKind.ROLLING, (PART_IDS["crank"],) * 2)] if len(stations) > 1 else []),
        ),
    )


def beam_of(hammer: Hammer) -> tuple[BeatBeam, complex]:
    """The beam that carries the crank-rockers, or the vertical axes, and its lower corner towards the warps [m]."""
    if hammer.linkage is not None:
        return hammer.linkage.beam, beam_corner(hammer.linkage.one)
    drive, params = hammer.axis, hammer.params
    assert drive is not None
    # Spread over the beam, as if half of it were in the middle.
    force = float(np.max(np.abs(drive.force)))
    corner = complex(_before_axes(hammer) + AXIS_SIDE, _low(params))
    return beam_for(params.beam_reach, drive.mass / 2, force / 2), corner


def _beam_before_axes(hammer: Hammer) -> tuple[Occurrence, ...]:
    beam, corner = beam_of(hammer)
    middle = corner + beam.section.side / 2 * (1 + 1j)
    return (Occurrence(beam.part, (placement(middle.real, middle.imag, -beam.length / 2),)),)


def _low(params: HammerParams) -> float:
    """Lower end of the vertical axes over the fell [m]."""
    return max(params.depth - BLOCK_HEIGHT, params.axes_height or ABOVE_HEADS)


def _before_axes(hammer: Hammer) -> float:
    """From the fell to the vertical axes [m]: their carriages lead past the reducers."""
    params = hammer.params
    wide = max(catalogue.face_of(part) for part in _driving(hammer))
    deep = max(BLOCK_DEPTH, (wide - AXIS_SIDE) / 2 + BLOCK_DEPTH / 2)
    return params.reach + params.comb_thickness + deep


@lru_cache(maxsize=4)
def _driving(hammer: Hammer) -> tuple[Part, ...]:
    """Reducer, motor and brake of a vertical axis."""
    found = hammer.axis
    assert found is not None
    drive, load = found.drive, found.cycle
    torque, speed = float(np.max(np.abs(load.torque))), float(np.max(np.abs(load.speed)))
    row = drive.motor if drive else None
    motor = catalogue.motor(MOTOR, "motor of a vertical axis", row, torque, speed, hammer.params.axis_count, rear=True)
    ratio = drive.reducer.ratio if drive else 1.0
    brake = catalogue.holding_brake(BRAKE, "brake of a vertical axis", motor, found.brake / ratio)
    if drive is None or ratio == 1:
        return motor, brake
    return catalogue.reducer("hammer/reducer", "reducer of a vertical axis", drive.reducer, row), motor, brake


def _axis_data(params: HammerParams) -> str:
    """What the order of a vertical axis states."""
    drive = f"pulley {in_mm(2 * params.pulley_radius)}"
    if params.axis == "screw":
        drive = f"lead {in_mm(params.screw_lead)}"
        drive = f"screw {in_mm(params.screw_diameter)}, {drive}" if params.screw_diameter else drive
    return f"linear axis {in_mm(AXIS_SIDE)} wide, {params.axis} drive, {drive}, {catalogue.stroke_of(params.stroke)}"


@lru_cache(maxsize=4)
def _on_axes(hammer: Hammer) -> Tree:
    params, (*geared, motor, brake) = hammer.params, _driving(hammer)
    number, low, before = params.axis_count, _low(params), params.reach + params.comb_thickness
    shape = box(AXIS_SIDE, AXIS_SIDE, params.stroke + BLOCK_HEIGHT)
    bought = Bought(params.axis, length=params.stroke, data=_axis_data(params))
    axis = bought_part(AXIS, "vertical axis", "linear axis", shape, bought, size=params.axis)
    edge = params.cloth.width / 2 - params.inset
    stations = np.linspace(-edge, edge, number) if number > 1 else np.zeros(1)
    upright = placement(about=(1.0, 0.0, 0.0), angle=-math.pi / 2)
    deep = _before_axes(hammer) - before
    front, end = before + deep + AXIS_SIDE / 2, low + params.stroke + BLOCK_HEIGHT
    flipped = placement(about=(1.0, 0.0, 0.0), angle=math.pi / 2)
    ends = tuple(placement(front, end, float(z)).after(flipped) for z in stations)
    adapters, upside = catalogue.adapted(
        "hammer/adapter", "adapter of a vertical axis", (*geared, motor)[0], AXIS_SIDE, ends
    )
    upside = tuple(own.after(placement(z=-sum(map(depth_of, geared)))) for own in upside)
    block = bought_part(
        "hammer/carriage",
        "carriage of a vertical axis",
        "guide carriage",
        box(deep, low + BLOCK_HEIGHT - (params.depth - BLOCK_HEIGHT), AXIS_SIDE),
        Bought("carriage of the vertical axis", CARRIAGE_MASS),
    )
    middle = (low + params.depth) / 2
    blocks = tuple(placement(before + deep / 2, middle, float(z) - AXIS_SIDE / 2) for z in stations)

    def standing(height: float) -> tuple[Placement, ...]:
        return tuple(placement(front, height, float(z)).after(upright) for z in stations)

    parts = (
        *_beam_before_axes(hammer),
        Occurrence(axis, standing(low)),
        *adapters,
        *(Occurrence(part, upside) for part in (*geared, motor, brake)),
    )
    axes = RigidBody("hammer/axes", parts)
    comb = (*_comb(hammer), Occurrence(block, blocks))
    return Tree((axes, RigidBody(COMB, comb, axes.id, Joint(JointKind.SLIDE, (0.0, 1.0, 0.0), motor=MOTOR))))
