"""Least distances of what moves in a row from the warps and the carpet, in the side view.

Parts are compared with parts in space [`assembly`]; warps and carpet are no parts. A sheet of warps runs straight from
the fell over its point of lift at each cam shaft to the back rest, as thick as a warp; the carpet hangs down from the
fell, as thick as warp and cut pile, and the whole of it is a roll about the lower cylinder. What moves is convex
polygons and discs. Distances are those of polygons at angles at most `STEP` apart, and at every joint of a track.

What touches the cloth to work with it is left out: guide cams and leaves of a comb between the warps, the sley at the
fell, tools of the head while it knots.
"""

import math
from collections.abc import Iterator, Mapping
from functools import lru_cache
from itertools import pairwise

import numpy as np

from ilmek.arrays import BoolArray, ComplexArray, FloatArray
from ilmek.carpet.pile import leg_length
from ilmek.machines.arrangement.side_view import RETREAT, HeadsView, SideBox, SideView, rectangle
from ilmek.machines.automated_loom.beat_motion import beat_displacement, beat_joints, beat_tip
from ilmek.machines.automated_loom.cyclogram import EVEN, HEADS, ODD, weft_windows
from ilmek.machines.automated_loom.design import LoomDesign
from ilmek.machines.automated_loom.frame import part_id
from ilmek.machines.automated_loom.parts import built_side, parts_of_loom
from ilmek.machines.beat import GUIDED
from ilmek.machines.shedding.stack import part_id as shedding_part
from ilmek.machines.weaver.head_shape import SLEY_TOOL
from ilmek.machines.weaver.parts import case_plates
from ilmek.machines.weft import Shuttle
from ilmek.machines.weft.carriers import RAPIER_TUBE, SHUTTLE_WOOD
from ilmek.plane.outlines import between
from ilmek.records import record
from ilmek.report import Check, Table, at_least, columns
from ilmek.timing.track import joints, sample
from ilmek.units import deg, mm, turn

STEP = 0.5 * deg
"""Largest step of the angles of a row [rad]."""

CARRIER, HEAD, SLEY, RAIL, BAR, CAMS = (
    "weft's carrier",
    "heads",
    "sley of the heads",
    "heads' rail",
    "bar of what beats",
    "guide cams",
)
WARPS, CARPET, ROLL = "warps", "carpet", "whole carpet on the lower cylinder"

HORIZON = 50 * mm
"""Bodies that are always farther from the cloth are not reported [m]."""

WORKING = frozenset(((CAMS, WARPS), (SLEY, CARPET)))
"""What touches the cloth to work with it."""

CURES: Mapping[str, str] = {
    CARRIER: "set a larger lift, or a smaller weft.bobbin_diameter",
    CAMS: "leave the spans of the shed open, or set a smaller lift",
    HEAD: "set a larger clearance",
}


@record
class MovedOutline:
    """A convex polygon of a body at angles of the row: corners (angles or 1, corners) and the radius about them [m]."""

    body: str
    corners: ComplexArray
    radius: float = 0.0

    def at(self, some: BoolArray) -> ComplexArray:
        """Its corners at some of the angles."""
        return self.corners[some] if len(self.corners) > 1 else self.corners


def _box_gap(first: MovedOutline, other: MovedOutline) -> FloatArray:
    """Distance of the boxes about two outlines [m], which are nowhere nearer."""
    gaps = []
    for along in (np.real, np.imag):
        own, its = along(first.corners), along(other.corners)
        gaps.append(np.maximum(its.min(-1) - own.max(-1), own.min(-1) - its.max(-1)))
    return np.asarray(np.hypot(*np.maximum(gaps, 0.0)) - first.radius - other.radius)


@record
class ClothDistance:
    """The least distance of a body from a part of the cloth [m], and the angle of the row at which it is [rad]."""

    body: str
    cloth: str
    value: float
    angle: float


@lru_cache(maxsize=4)
def cloth_clearances(loom: LoomDesign) -> tuple[ClothDistance, ...]:
    """The least distance of each body from warps, carpet and roll, of those that come near; the nearest first."""
    angle, side = _angles(loom), built_side(loom)
    laid = _within(weft_windows(loom.row_cyclogram), angle)
    least: dict[tuple[str, str], tuple[float, float]] = {}
    cloths = tuple(_cloth(loom, side, angle))
    for moved in _bodies(loom, side, angle):
        for cloth in cloths:
            if (moved.body, cloth.body) in WORKING:
                continue
            near = np.broadcast_to(_box_gap(moved, cloth) <= HORIZON, angle.shape)
            near = near & laid if moved.body == CARRIER else near
            if not near.any():
                continue
            apart = between(moved.at(near), cloth.at(near)) - moved.radius - cloth.radius
            nearest = int(np.argmin(apart))
            value, where = float(apart[nearest]), float(angle[near][nearest])
            if value < least.get((moved.body, cloth.body), (math.inf, 0.0))[0]:
                least[moved.body, cloth.body] = value, where
    kept = (ClothDistance(*pair, *distance) for pair, distance in least.items() if distance[0] <= HORIZON)
    return tuple(sorted(kept, key=lambda distance: distance.value))


def cloth_checks(loom: LoomDesign) -> tuple[Check, ...]:
    """The distances against the least that is allowed."""
    parts, source = _parts(loom), "parameter clearance, assumed by this project; least at {:.1f} deg of a row"
    return tuple(
        at_least(
            f"clearance: {near.body} and {near.cloth}",
            near.value,
            loom.params.clearance,
            "mm",
            source.format(near.angle / deg),
        ).with_cure(CURES.get(near.body, "leave the spans of the shed open"), *parts[near.body])
        for near in cloth_clearances(loom)
    )


def cloth_table(loom: LoomDesign) -> Table:
    """The least distances from the cloth."""
    rows = tuple((near.body, near.cloth, near.value, near.angle) for near in cloth_clearances(loom))
    heads = columns("body", "and", "least [mm]", "at [deg]")
    return Table("loom-cloth-clearances", "Least distances from warps and carpet", heads, rows)


def _angles(loom: LoomDesign) -> FloatArray:
    """Angles of the row [rad], the joints of the tracks and of the path of what beats among them."""
    row = loom.row_cyclogram
    even = np.linspace(0.0, turn, round(turn / STEP) + 1)
    windows = np.asarray(weft_windows(row)).ravel()
    every = [even, beat_joints(loom.beat.path, row), windows, *(joints(track) for track in row.tracks)]
    return np.unique(np.clip(np.concatenate(every), 0.0, turn))


def _within(windows: tuple[tuple[float, float], ...], angles: FloatArray) -> BoolArray:
    """Whether angles lie in one of some windows, of which the last may reach into the next row."""
    inside = np.zeros(len(angles), bool)
    for start, end in windows:
        inside |= (angles >= start) & (angles <= end) | (angles + turn <= end)
    return inside


def _bodies(loom: LoomDesign, side: SideView, angle: FloatArray) -> Iterator[MovedOutline]:
    """What moves: the carrier where it is in the loom, heads and rail in their retreat, what beats, the guide cams."""
    row, beat = loom.row_cyclogram, loom.beat.path
    yield MovedOutline(CARRIER, rectangle(side.carrier)[None, :])
    if side.heads is not None:
        away = RETREAT * sample(row.track(HEADS), np.mod(angle, turn)).position[:, None]
        yield from _heads(side.heads, away)
    tip = beat_tip(beat, row, angle)
    for polygon in beat.outline[1:]:
        yield MovedOutline(BAR, beat.carried(polygon, tip))
    sunk = beat_displacement(beat, row, angle) if loom.params.beat == GUIDED else np.zeros(1, complex)
    for cam in side.cams:
        yield MovedOutline(CAMS, (cam.at + sunk)[:, None], cam.guide_radius)


def _heads(heads: HeadsView, away: ComplexArray) -> Iterator[MovedOutline]:
    """Body, magazine and tools of a head, and the rail, with their retreat [m]."""
    head = heads.shape
    for box in (SideBox(head.body, head.size), SideBox(head.magazine, head.magazine_size)):
        yield MovedOutline(HEAD, rectangle(box) + away)
    for tool in head.tools:
        name = SLEY if tool.name == SLEY_TOOL else HEAD
        yield MovedOutline(name, rectangle(SideBox(tool.corner, tool.size)) + away)
    yield MovedOutline(RAIL, rectangle(heads.rail) + away)


def _cloth(loom: LoomDesign, side: SideView, angle: FloatArray) -> Iterator[MovedOutline]:
    """Both sheets of warps, the carpet in front of the cylinders, the whole carpet on the lower one."""
    row, radius = loom.row_cyclogram, side.room.warp / 2
    for name in (EVEN, ODD):
        lifted = sample(row.track(name), np.mod(angle, turn)).position / side.cams[0].lift
        still = np.zeros_like(lifted, complex)
        run = (still, *(cam.lift * lifted + 1j * cam.at.imag for cam in side.cams), still + 1j * side.spans.back_rest)
        for first, last in pairwise(run):
            yield MovedOutline(WARPS, np.stack([first, last], axis=1), radius)
    yarns = loom.task.yarns
    tip = leg_length(yarns.warp.diameter, yarns.pile.diameter, loom.params.pile)  # each knot is cut in the head
    deep = complex(tip + side.room.warp, -side.lower.at.imag)
    yield MovedOutline(CARPET, rectangle(SideBox(complex(-side.room.warp, side.lower.at.imag), deep))[None, :])
    yield MovedOutline(ROLL, np.array([[side.lower.at]]), side.roll)


def _parts(loom: LoomDesign) -> Mapping[str, tuple[str, ...]]:
    """Ids of the parts of the bodies, of those that the loom has."""
    carrier = SHUTTLE_WOOD if isinstance(loom.weft.carried, Shuttle) else RAPIER_TUBE
    listed, head = {line.part for line in parts_of_loom(loom).parts}, case_plates(loom.weaver) if loom.heads else ()
    every = {
        CARRIER: (carrier,),
        HEAD: head,
        SLEY: head,
        RAIL: (part_id("rail"),),
        BAR: loom.beat.striking[1:],
        CAMS: tuple(shedding_part(name) for name in ("guide-cam", "reed-dent")),
    }
    return {body: tuple(part for part in parts if part in listed) for body, parts in every.items()}
