"""The hand shed as bodies: side plates on beams, shed rod, heddle bar on its levers, pins that lock these.

Axes of the scene: x along the width, y up from the fell, z to the front. At the start the rod is down, the strings are
slack. From the cloth outwards follow arm, lever, gap and side plate; the side plates have the bearings and the guides.
"""

import cmath
import math
from collections.abc import Iterator
from dataclasses import replace
from itertools import pairwise

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.elements.columns import STEEL, HollowSquare
from ilmek.elements.materials import MATERIALS, Material
from ilmek.elements.tubes import turned_bore
from ilmek.machines.hand_shed.design import BESIDE, GAP, LOCK_ARM, LOCK_PIN, PLATE, SHAFT, SIDE_PLATE, HandShed
from ilmek.part.part import Bought, Part
from ilmek.part.placement import ALONG_WIDTH, IN_SIDE_VIEW, Placement, placement
from ilmek.part.profile import Profile
from ilmek.part.shapes import Prism, Shape, bar, bored_ends, square_tube, stepped, tube
from ilmek.part.tree import Joint, JointKind, Occurrence, RigidBody, Tree
from ilmek.plane.contours import circle, polygon, rounded_hull
from ilmek.records import record
from ilmek.report.scene import SceneMotion, ScenePhase
from ilmek.units import format_quantity, mm, turn

SHED = "shed"
"""The drive of the picture in motion: a change of the shed and back."""

BEAM = HollowSquare(50 * mm, 3 * mm)
"""Section of the beams that carry the side plates; assumed by this project."""

PIVOT = 20 * mm
"""Diameter of the journals of the heddle bar's shaft [m]; assumed by this project."""

ROD_END, ROD_PLAY = 16 * mm, 0.5 * mm
"""Diameter of the rod's ends in their guides, and play there [m]; assumed by this project."""

RIM = 20 * mm
"""Least metal of a side plate about its openings [m]; assumed by this project."""

INSIDE = 30 * mm
"""Journals of shaft and rod inside of their tubes [m]; assumed by this project."""

HANDLE = 120 * mm, 30 * mm
"""Length and diameter of a lever's handle [m]; assumed by this project."""

STRING = 1 * mm
"""Diameter of a heddle's twine [m]."""

BEHIND = 60 * mm
"""Axes of the beams behind the warps, where no loom sets them [m]."""

_SHAFT = MATERIALS["heat-treatable steel"]


def part_id(name: str) -> str:
    """Id of a part or body of the hand shed."""
    return f"hand-shed/{name}"


@record
class ShedLayout:
    """Where the parts are in the side view, z + i y [m].

    pivot    of the heddle bar's shaft        down  of the bar from the pivot, in the middle of its swing
    hub      radius of arms and levers about the pivot       journal  diameter of the shaft there
    bar_room  from the heddle bar to the front warps, the strings slack
    """

    shed: HandShed
    pivot: complex
    hub: float
    journal: float
    bar_room: float

    def bar(self, swing: float) -> complex:
        """Axis of the bar at an angle from the middle of its swing, to the front above 0 [rad]."""
        return self.pivot - 1j * self.shed.arm * cmath.exp(1j * swing)

    def end(self, swing: float) -> complex:
        """End of a lever."""
        return self.pivot - 1j * self.shed.lever * cmath.exp(1j * (swing + self.shed.params.lever_tilt))

    def lock(self, swing: float) -> complex:
        """Hole of a lever for its lock."""
        return self.pivot - 1j * LOCK_ARM * cmath.exp(1j * (swing + self.shed.params.lever_tilt))


def layout(shed: HandShed) -> ShedLayout:
    """The layout: bar and string before the pulled warps, the pivot over the middle of the bar's stroke."""
    params, radius = shed.params, shed.bar.outer_radius
    front = shed.pulled + shed.string + radius
    middle = front - shed.stroke / 2
    height = params.heddle_height + shed.arm * math.cos(shed.lift_angle / 2)
    warps = shed.rod.outer / 2 * params.heddle_height / params.rod_low
    return ShedLayout(shed, complex(middle, height), PIVOT / 2 + 10 * mm, PIVOT, front - shed.stroke - radius - warps)


def half_width(shed: HandShed) -> float:
    """Inner face of the side plates from the middle [m]."""
    return shed.width / 2 + BESIDE + 2 * PLATE + GAP


def tree(shed: HandShed, behind: float = -BEHIND, face: float | None = None) -> Tree:
    """The bodies of the hand shed.

    behind  axis of the beams, z [m]      face  of the columns that hold the beams, from the middle [m]; default: the
    beams end at the side plates
    """
    made = layout(shed)
    long = half_width(shed) + SIDE_PLATE if face is None else face
    return Tree((_stand(shed, made, behind, long), _rod(shed), _heddles(shed, made), *_locks(shed, made)))


def beam_heights(shed: HandShed) -> tuple[float, float]:
    """Axes of the two beams above the fell [m]: at the lower and the upper end of the side plates."""
    made, edge = layout(shed), RIM + BEAM.side / 2
    low = min(made.lock(shed.lift_angle / 2).imag, made.pivot.imag, shed.params.rod_low)
    return low, shed.params.rod_high + ROD_END / 2 + edge


def _stand(shed: HandShed, made: ShedLayout, behind: float, long: float) -> RigidBody:
    """Two beams, and the side plates on them."""
    shape = square_tube(BEAM.side, BEAM.wall, 2 * long)
    beam = _part("beam", "beam of the hand shed", "welded frame", shape)
    plate = _part("side-plate", "side plate of the hand shed", "laser-cut part", _plate(shed, made, behind))
    inner = half_width(shed)
    return RigidBody(
        part_id("stand"),
        (
            Occurrence(beam, tuple(placement(-long, y, behind).after(ALONG_WIDTH) for y in beam_heights(shed))),
            Occurrence(plate, tuple(placement(x).after(IN_SIDE_VIEW) for x in (-inner, inner + SIDE_PLATE))),
        ),
    )


def _plate(shed: HandShed, made: ShedLayout, behind: float) -> Prism:
    """A side plate: seats of the beams, guide of the rod, bores of shaft and lock, a window between."""
    params, (low, high) = shed.params, beam_heights(shed)
    slot = ROD_END / 2 + ROD_PLAY / 2
    guide = np.array([1j * (params.rod_low + ROD_PLAY / 2), 1j * (params.rod_high + ROD_PLAY / 2)])
    lock = made.lock(shed.lift_angle / 2)
    nodes = np.array([complex(behind, low), complex(behind, high), *guide, made.pivot, lock])
    seats = [
        polygon(complex(behind, y) + BEAM.side / 2 * np.array([-1 - 1j, 1 - 1j, 1 + 1j, -1 + 1j])) for y in (low, high)
    ]
    around = max(BEAM.side / 2 * math.sqrt(2), PIVOT) + RIM / 2
    holes = [rounded_hull(guide, slot), circle(made.pivot, PIVOT / 2), circle(lock, LOCK_PIN / 2)]
    back, front = behind + BEAM.side / 2 + RIM, -slot - RIM
    window = [low + BEAM.side / 2 + RIM, high - BEAM.side / 2 - RIM]
    if front - back > RIM and window[1] - window[0] > RIM:
        corners = np.array(
            [complex(back, window[0]), complex(front, window[0]), complex(front, window[1]), complex(back, window[1])]
        )
        holes.append(polygon(corners))
    return Prism(Profile(rounded_hull(nodes, around), (*seats, *holes)), SIDE_PLATE)


def _rod(shed: HandShed) -> RigidBody:
    """The shed rod with its ends in the guides."""
    inner = half_width(shed)
    half, radius, deep = inner - GAP, shed.rod.outer_radius, INSIDE
    plug = 2 * turned_bore(shed.rod.inner_radius)
    shape = bored_ends(tube(shed.rod.outer, shed.rod.wall, 2 * half), plug / 2, deep)
    shell = replace(_part("rod", "shed rod", "steel tube", shape), machined=True)
    steps = (
        ((plug, deep), (ROD_END, GAP + SIDE_PLATE + 5 * mm))
        if plug > ROD_END
        else ((plug, deep), (2 * radius, GAP / 2), (ROD_END, GAP / 2 + SIDE_PLATE + 5 * mm))
    )
    end = _part("rod-end", "end of the shed rod", "turned part", stepped(*steps), _SHAFT)
    motion = SceneMotion(
        SHED, ANGLES, np.outer(RISE, [0.0, shed.params.rod_high - shed.params.rod_low, 0.0]), 0 * ANGLES
    )
    joint = Joint(
        JointKind.SLIDE,
        axis=(0.0, 1.0, 0.0),
        motion=motion,
        seats=(f"{end.id}:journal", part_id("side-plate:guide")),
        hand=shell.id,
    )
    height = placement(0.0, shed.params.rod_low)
    at = half - deep
    return RigidBody(
        part_id("shed rod"),
        (Occurrence(shell, (placement(-half).after(ALONG_WIDTH),)), Occurrence(end, _both_ends(at))),
        joint=joint,
        positions=(height,),
    )


def _heddles(shed: HandShed, made: ShedLayout) -> RigidBody:
    """Shaft, arms, heddle bar, levers, handles and strings: they turn about the shaft."""
    motion = SceneMotion(SHED, ANGLES, np.zeros((len(ANGLES), 3)), -shed.lift_angle * SWING)
    seats = (part_id("shaft-end:journal"), part_id("side-plate:pivot"))
    joint = Joint(JointKind.PIN, axis=(1.0, 0.0, 0.0), motion=motion, seats=seats, hand=part_id("lever"))
    position = placement(0.0, made.pivot.imag, made.pivot.real)
    return RigidBody(
        part_id("heddles"), (*_across(shed, made), *_levers(shed, made)), joint=joint, positions=(position,)
    )


def _across(shed: HandShed, made: ShedLayout) -> Iterator[Occurrence]:
    """Heddle bar, its shaft with journals at both ends, and a string for every other warp."""
    cloth, down = shed.length / 2, made.bar(-shed.lift_angle / 2) - made.pivot
    for name, title, own, at in (
        ("heddle-bar", "heddle bar", shed.bar, down),
        ("heddle-shaft", "shaft of the heddle bar", SHAFT, 0j),
    ):
        shell = tube(own.outer, own.wall, 2 * cloth)
        turns = own is SHAFT
        shell = bored_ends(shell, turned_bore(own.inner_radius), INSIDE) if turns else shell
        joins = () if turns else (part_id("arm"),)
        part = replace(_part(name, title, "steel tube", shell), machined=turns, joins=joins)
        yield Occurrence(part, (placement(-cloth, at.imag, at.real).after(ALONG_WIDTH),))
    spigot = 2 * turned_bore(SHAFT.inner_radius), INSIDE
    journal = stepped(spigot, (PIVOT, half_width(shed) - cloth + SIDE_PLATE))
    end = _part("shaft-end", "end of the heddle bar's shaft", "turned part", journal, _SHAFT)
    yield Occurrence(end, _both_ends(cloth - INSIDE))
    yield _strings(shed, down)


def warps_across(shed: HandShed) -> FloatArray:
    """All warps from left to right, x [m]; the first and every other one have strings and run behind the rod."""
    cloth = shed.params.cloth
    return np.asarray((np.arange(cloth.warps) - (cloth.warps - 1) / 2) * cloth.warp_pitch)


def _strings(shed: HandShed, down: complex) -> Occurrence:
    """A string for every other warp, stretched as when it pulls its warp level to the front; down: to the bar [m]."""
    twine, long = Bought("cotton twine 1 mm", 0.2e-3), format_quantity(shed.string, "mm")
    loop = bar(STRING, shed.string)
    size, fixing = f"loop of {long}", "its loop lies round the bar"
    string = Part(
        part_id("string-heddle"), "string heddle", "string heddle", loop, purchase=twine, fixing=fixing, size=size
    )
    begin = down - shed.bar.outer_radius * cmath.exp(-1j * shed.lift_angle)
    along = warps_across(shed)[::2][: shed.pulled_warps]
    tilt = turn / 2 + float(shed.lift_angle)
    return Occurrence(
        string, tuple(placement(float(x), begin.imag, begin.real, about=(1.0, 0.0, 0.0), angle=tilt) for x in along)
    )


def _levers(shed: HandShed, made: ShedLayout) -> Iterator[Occurrence]:
    """Arms, and beside them levers with handles, on both sides."""
    swing, cloth, pivot = -shed.lift_angle / 2, shed.length / 2, circle(0j, PIVOT / 2)
    down, lever, lock = (point(swing) - made.pivot for point in (made.bar, made.end, made.lock))
    around = rounded_hull(np.array([0j, down]), max(made.hub, shed.bar.outer_radius))
    arm = Prism(Profile(around, (pivot,)), PLATE)
    yield Occurrence(_part("arm", "arm of the heddle bar", "laser-cut part", arm), _plates_at(cloth, cloth + PLATE))
    bores = (pivot, circle(lock, LOCK_PIN / 2))
    plate = Prism(Profile(rounded_hull(np.array([0j, lever]), made.hub), bores), PLATE)
    own = _part("lever", "hand lever of the heddles", "laser-cut part", plate)
    yield Occurrence(own, _plates_at(cloth + PLATE, cloth + 2 * PLATE))
    long, thick = HANDLE
    handle = _part("handle", "handle of a lever", "turned part", bar(thick, long))
    yield Occurrence(handle, tuple(_handles(cloth + PLATE, lever)))


def _handles(inner: float, lever: complex) -> Iterator[Placement]:
    """Handles on the inner faces of both levers, towards the weaver [m]."""
    yield placement(inner - HANDLE[0], lever.imag, lever.real).after(ALONG_WIDTH)
    yield placement(-inner, lever.imag, lever.real).after(ALONG_WIDTH)


def _locks(shed: HandShed, made: ShedLayout) -> Iterator[RigidBody]:
    """The pins that lock the levers, withdrawn: each is pushed inwards through its side plate into its lever."""
    lock, inner = made.lock(shed.lift_angle / 2), half_width(shed)
    reach = PLATE + GAP
    shape = stepped((LOCK_PIN, SIDE_PLATE + reach + 5 * mm), (2 * LOCK_PIN, 20 * mm))
    pin = _part("lock", "pin that locks a lever", "pin or bush", shape, _SHAFT)
    motion = SceneMotion(SHED, ANGLES, np.outer(LOCKED, [0.0, 0.0, -reach]), 0 * ANGLES)
    seats = (f"{pin.id}:shank", part_id("side-plate:lock"))
    joint = Joint(JointKind.SLIDE, motion=motion, seats=seats, hand=pin.id)
    for name, position in zip(("left", "right"), _both_ends(inner, lock), strict=True):
        yield RigidBody(part_id(f"{name} lock"), (Occurrence(pin),), joint=joint, positions=(position,))


ANGLES: FloatArray = np.linspace(0.0, turn, 9)
"""Eighths of the change: rod up, strings pulled, locked; and back."""

RISE, SWING, LOCKED = (
    np.array(shares)
    for shares in (
        (0.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 0.0),
        (0.0, 0.0, 1.0, 1.0, 1.0, 1.0, 1.0, 0.0, 0.0),
        (0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 0.0, 0.0, 0.0),
    )
)
"""Shares of the rod's stroke, of the levers' swing and of the locks' at these angles."""

_ACTS = (
    ("shed rod", RISE, ("pushed up", "pulled down")),
    ("levers", SWING, ("pull the strings", "slacken the strings")),
    ("locks", LOCKED, ("pushed in", "pulled out")),
)
"""What moves, by which shares, and what it does there and back."""


def phases() -> tuple[ScenePhase, ...]:
    """What moves when in the change of the shed and back."""
    return tuple(
        ScenePhase(SHED, name, there if last > first else back, start, end)
        for name, shares, (there, back) in _ACTS
        for (first, last), (start, end) in zip(pairwise(shares), pairwise(ANGLES), strict=True)
        if first != last
    )


_TO_THE_LEFT = placement(about=(0.0, 0.0, 1.0), angle=math.pi).after(ALONG_WIDTH)
"""A part whose z points to the weaver's left."""


def _both_ends(far: float, at: complex = 0j) -> tuple[Placement, Placement]:
    """Of a turned part at both ends of a shaft, its z to the outside, about an axis in the side view [m]."""
    return (
        placement(-far, at.imag, at.real).after(_TO_THE_LEFT),
        placement(far, at.imag, at.real).after(ALONG_WIDTH),
    )


def _plates_at(inner: float, outer: float) -> tuple[Placement, Placement]:
    """Of a plate in the side view on both sides, between two distances from the middle [m]."""
    return placement(-inner).after(IN_SIDE_VIEW), placement(outer).after(IN_SIDE_VIEW)


def _part(name: str, title: str, process: str, shape: Shape, material: Material = STEEL) -> Part:
    bored = process == "laser-cut part"
    return Part(part_id(name), title, process, shape, material, machined=bored)
