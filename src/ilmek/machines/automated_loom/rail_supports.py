"""What carries the heads' rail: axes of its retreat on arms and posts at its ends, and on posts of their own between.

At an end the axis lies beside the rail, on an arm of a post that stands on a front foot. Between the ends the heads
pass behind the rail: there an arm of the rail reaches to an axis before it [`frame.rail_ahead`], beside which its post
stands on a beam across.

The carriages of the axes belong to the rail: each is screwed, from behind its flange beside the axis, to a plate that
is welded to the end of the rail, or to its arm.

A support bears half of the rail's spans beside it and all heads that find room on these, R, and what accelerates them
to the front, F. Its post is free at its end, R at the lever e beside it:

    sigma = R / A + (R e + F h) c / I,    sway = (R e / 2 + F h / 3) h² / (E I)            [cantilevers]

and an arm of the length l has sigma = R l c / I and sinks by R l³ / (3 E I).
"""

import cmath
import math
from collections.abc import Callable, Iterator
from functools import lru_cache

import numpy as np

from ilmek.arrays import ComplexArray
from ilmek.elements.columns import STEEL, HollowSquare, ascending
from ilmek.elements.materials import GRAVITY, MATERIALS
from ilmek.machines.arrangement.side_view import RETREAT
from ilmek.machines.automated_loom.brackets import brackets_of
from ilmek.machines.automated_loom.cyclogram import HEADS
from ilmek.machines.automated_loom.design import LoomDesign
from ilmek.machines.automated_loom.frame import (
    BEYOND,
    CARRIAGE,
    CARRIED,
    EAR,
    END_PLATE,
    RAIL_POST,
    LoomFrame,
    end_plate,
    member,
    part_id,
    rail_ahead,
    rail_support_load,
)
from ilmek.machines.automated_loom.shaking import least_frequency, stiff_post
from ilmek.machines.automated_loom.supports import base_section, floor_top, post_depth, rail_middle
from ilmek.machines.weaver.head_shape import RAIL_AXIS
from ilmek.part.part import LASER_CUT, Bought, HolePattern, Part, bought_part
from ilmek.part.placement import ALONG_WIDTH, UPRIGHT, Placement, placement
from ilmek.part.profile import Profile
from ilmek.part.shapes import Prism, box, rectangle
from ilmek.part.tree import Occurrence
from ilmek.plane.contours import polygon
from ilmek.plane.curves import hull
from ilmek.records import record
from ilmek.report import Check, at_most
from ilmek.timing.track import peak_acceleration
from ilmek.units import in_mm, mm, turn

SAFETY = 2.0
"""Of posts and arms against yielding; assumed by this project."""

SWAY = 1 / 1000
"""Allowed deflection of a post or an arm over its length; assumed by this project."""

_HOLES = HolePattern(40 * mm, 54 * mm, "M6")
"""Holes of a carriage of the retreat, along and across its axis: makers' usual sizes."""

_FILLED = 0.5
"""Share of a carriage's room that is aluminium; assumed by this project."""

_FOR_WELDS = 30 * mm
"""Least distance of two beams beside each other, for the welds at their ends [m]; assumed by this project."""

LEAST_ARM = 2 * END_PLATE
"""Least length of an arm with the plate at its end [m]: in a narrow loom its post stands that far aside."""

ARM_WALLS = (3 * mm, 4 * mm, 5 * mm)
"""Walls of the arms, as wide as their axes [m]: of EN 10219-2."""

_CURE = "set a lower retreat_acceleration, or fewer heads"


@record
class RailSupport:
    """A post of the rail, and the arm by which it carries, or is reached by, the axis of the retreat.

    name     of the post's part, its arm's         height   of the post [m]     lever   of the load beside its axis [m]
    reach    free length of the arm [m]            load, push   on it, down and to the front [N]
    post, arm   sections                           depth    of the post's axis in the side view [m]
    axis     where the axis of the retreat begins while the heads knot, in the side view [m]
    stations of the axes of the retreat across the width [m]
    """

    name: str
    arm_name: str
    height: float
    lever: float
    reach: float
    load: float
    push: float
    post: HollowSquare
    arm: HollowSquare
    depth: float
    axis: complex
    stations: tuple[float, ...]

    @property
    def checks(self) -> tuple[Check, ...]:
        """Strength and stiffness of post and arm."""
        return (*_post_checks(self), *_arm_checks(self))

    @property
    def stress(self) -> float:
        """Greatest stress of the post [Pa]."""
        moment = self.load * self.lever + self.push * self.height
        return self.load / self.post.area + moment * self.post.side / 2 / self.post.inertia

    @property
    def sway(self) -> float:
        """Deflection of the post's end [m]."""
        moment = self.load * self.lever / 2 + self.push * self.height / 3
        return moment * self.height**2 / (STEEL.modulus * self.post.inertia)


@lru_cache(maxsize=8)
def rail_supports(loom: LoomDesign, frame: LoomFrame) -> tuple[RailSupport, ...]:
    """The supports at the ends, and those between where the rail has several spans; none without heads."""
    if frame.task.rail is None:
        return ()
    return (_at_ends(loom, frame), *(() if frame.task.rail.spans == 1 else (_between(loom, frame),)))


def _at_ends(loom: LoomDesign, frame: LoomFrame) -> RailSupport:
    rail, task = frame.guide
    axis, bottom = rail_middle(loom), floor_top(loom, frame)
    near = task.width / 2 + CARRIED + RAIL_AXIS
    beside = frame.beside(brackets_of(loom).face)[0]
    load = rail_support_load(task, rail, spans=1)
    # To the front, away from the motors on the upper ends of the axes; to the back where a post of the beat is there.
    away = -1 if 0 < post_depth(loom, frame) - axis.real < RAIL_POST else 1

    push = _push(loom, load)

    def chosen(post: HollowSquare, arm: HollowSquare) -> RailSupport:
        return RailSupport(
            name="rail-post",
            arm_name="rail-arm",
            height=axis.imag - bottom,
            lever=max(beside, near + LEAST_ARM + post.side / 2) - task.width / 2,
            reach=max(beside - post.side / 2 - near, LEAST_ARM),
            load=load + push * -RETREAT.imag,
            push=push * RETREAT.real,
            post=post,
            arm=arm,
            depth=axis.real + away * (post.side - RAIL_AXIS) / 2,
            axis=axis,
            stations=(near - RAIL_AXIS / 2, RAIL_AXIS / 2 - near),
        )

    height, least = axis.imag - bottom, least_frequency(loom)
    return _lightest(chosen, math.inf, lambda strong: stiff_post(strong, height, load / GRAVITY, least))


def _between(loom: LoomDesign, frame: LoomFrame) -> RailSupport:
    (rail, task), ahead = frame.guide, _ahead(loom, frame)
    spans, wide = task.spans, task.width
    axis = rail_middle(loom) + ahead - 1j * task.drop
    end = axis + loom.side.of_heads.retreated
    load = rail_support_load(task, rail, spans=2)
    push = _push(loom, load)

    def chosen(post: HollowSquare, arm: HollowSquare) -> RailSupport:
        return RailSupport(
            name="post",
            arm_name="rail-bracket",
            height=end.imag - floor_top(loom, frame),
            lever=(post.side + arm.side) / 2 + RAIL_AXIS + CARRIED - BEYOND,
            reach=ahead - rail.side / 2,
            load=load + push * -RETREAT.imag,
            push=push * RETREAT.real,
            post=post,
            arm=arm,
            depth=end.real,
            axis=axis,
            stations=tuple((k / spans - 0.5) * wide + RAIL_AXIS + CARRIED for k in range(1, spans)),
        )

    return _lightest(chosen, RAIL_POST, lambda strong: next(strong, None))


def _ahead(loom: LoomDesign, frame: LoomFrame) -> float:
    """From the back of the rail to the axes between its ends [m]: their posts stand on a beam of their own, clear of
    that of the beat's posts, or on that.
    """
    rail, task = frame.guide
    least = rail_ahead(rail, task.drop)
    depth, beam = (rail_middle(loom) + least + loom.side.of_heads.retreated).real, base_section(loom, frame).side
    apart = post_depth(loom, frame) - depth
    if abs(apart) >= beam + _FOR_WELDS:
        return least
    return least + (apart if apart >= 0 else beam + _FOR_WELDS + apart)


def _push(loom: LoomDesign, load: float) -> float:
    """Force of the retreat's greatest acceleration on what weighs a load [N]."""
    row = loom.row_cyclogram
    return load / GRAVITY * peak_acceleration(row.track(HEADS), row.period)


def _lightest(
    chosen: Callable[[HollowSquare, HollowSquare], RailSupport],
    most: float,
    stiff: Callable[[Iterator[HollowSquare]], HollowSquare | None],
) -> RailSupport:
    """The support of the lightest sections that keep its checks, of stiff posts that leave room for an arm; of the
    largest of these where none does.
    """
    arms = [HollowSquare(RAIL_AXIS, wall) for wall in ARM_WALLS]
    posts = [square for square in ascending() if RAIL_AXIS <= square.side <= most]
    posts = [square for square in posts if chosen(square, arms[0]).reach > LEAST_ARM] or posts[:1]
    post = stiff(one for one in posts if all(c.ok for c in _post_checks(chosen(one, arms[0])))) or posts[-1]
    arm = next((one for one in arms if all(c.ok for c in _arm_checks(chosen(post, one)))), arms[-1])
    return chosen(post, arm)


def _post_checks(own: RailSupport) -> tuple[Check, Check]:
    where, parts = "" if own.name == "rail-post" else " between its ends", (part_id(own.name),)
    limit, sway = STEEL.strength / SAFETY, SWAY * own.height
    return (
        at_most(f"stress of a post of the rail{where}", own.stress, limit, "MPa", _YIELD).with_cure(_CURE, *parts),
        at_most(f"deflection of a post of the rail{where}", own.sway, sway, "mm", _HEIGHT).with_cure(_CURE, *parts),
    )


def _arm_checks(own: RailSupport) -> tuple[Check, Check]:
    where, parts = "" if own.name == "rail-post" else " between its ends", (part_id(own.arm_name),)
    bent = own.load * own.reach * own.arm.side / 2 / own.arm.inertia
    sag = own.load * own.reach**3 / (3 * STEEL.modulus * own.arm.inertia)
    limit, most = STEEL.strength / SAFETY, SWAY * own.reach
    return (
        at_most(f"stress of an arm of the rail{where}", bent, limit, "MPa", _YIELD).with_cure(_CURE, *parts),
        at_most(f"deflection of an arm of the rail{where}", sag, most, "mm", _HEIGHT).with_cure(_CURE, *parts),
    )


_YIELD = "yield of S235 over 2, assumed by this project"
_HEIGHT = "length over 1000, assumed by this project"


def support_parts(loom: LoomDesign, frame: LoomFrame) -> Iterator[Occurrence]:
    """Posts of both kinds, and the arms at the ends; they belong to the frame's body."""
    bottom = floor_top(loom, frame)
    for own in rail_supports(loom, frame):
        ends, title = own.name == "rail-post", "post of the rail's axes"
        long = own.height + (own.arm.side / 2 if ends else 0.0)  # all round the end of its arm
        post = member(own.name, title if ends else f"{title} between its ends", own.post, long)
        aside = (
            own.stations[0] + own.reach + (RAIL_AXIS + own.post.side) / 2 if ends else (RAIL_AXIS + own.post.side) / 2
        )
        places = (-aside, aside) if ends else [x + aside for x in own.stations]
        yield Occurrence(post, tuple(placement(x, bottom, own.depth).after(UPRIGHT) for x in places))
        if ends:
            first, long = own.stations[0] + RAIL_AXIS / 2, own.reach - END_PLATE
            at = placement(0.0, own.axis.imag, own.axis.real).after(ALONG_WIDTH)
            arm = member(own.arm_name, "arm of the rail's axes", own.arm, long)
            yield Occurrence(arm, tuple(placement(x).after(at) for x in (first + END_PLATE, -first - own.reach)))
            plate = end_plate("rail-arm-plate", "plate of an arm for its axis", own.arm, EAR)
            lies = placement(0.0, own.axis.imag, own.axis.real).after(_ALONG_RETREAT)
            yield Occurrence(plate, tuple(placement(x).after(lies) for x in (first, -first - END_PLATE)))


def rail_brackets(loom: LoomDesign, frame: LoomFrame) -> Iterator[Occurrence]:
    """The arms of the rail between its ends, its plates, and the carriages of its axes on these, in its own axes."""
    side, drop = frame.guide[0].side, frame.guide[1].drop
    for own in rail_supports(loom, frame):
        axis, ends = own.axis - rail_middle(loom), own.name == "rail-post"
        if not ends:
            arm = member(own.arm_name, "arm of the rail", own.arm, axis.real + RAIL_AXIS / 2 - side)
            aside = (RAIL_AXIS + own.post.side) / 2 - own.lever
            yield Occurrence(arm, tuple(placement(x + aside, -drop, side) for x in own.stations))
        name = "rail-plate" if ends else "rail-bracket-plate"
        section = Prism(Profile(polygon(_plate_outline(side if ends else 0.0))), END_PLATE)
        plate = Part(part_id(name), "plate of the rail for a carriage", LASER_CUT, section, STEEL)
        carriages, plates = list[Placement](), list[Placement]()
        for x in own.stations:
            out = -1 if x < 0 and ends else 1
            onto, behind = placement(about=(1.0, 0.0, 0.0), angle=(1 + out) * turn / 4), CARRIAGE[2] + END_PLATE
            carriages.append(placement(x - out * RAIL_AXIS / 2, axis.imag, axis.real).after(_ALONG_RETREAT).after(onto))
            begin = x - out * (RAIL_AXIS / 2 + behind) - (END_PLATE if out < 0 else 0.0)
            plates.append(placement(begin, axis.imag, axis.real).after(ALONG_WIDTH))
        yield Occurrence(_carriage(), tuple(carriages))
        yield Occurrence(plate, tuple(plates))


def _plate_outline(side: float) -> ComplexArray:
    """Corners of a plate of the rail about the axis of the retreat, up and to the front: about its carriage, and the
    end of a rail of a side [m], if any.
    """
    carriage = rectangle(*CARRIAGE[:2]).points * _UP_AND_FRONT
    return hull(np.concatenate([carriage, rectangle(side, side).points + 0.5j * side] if side else [carriage]))


@lru_cache(maxsize=1)
def _carriage() -> Part:
    """The carriage of an axis along x, on it at z = 0."""
    bought = Bought(
        f"axis carriage {in_mm(RAIL_AXIS)} wide",
        _FILLED * math.prod(CARRIAGE) * MATERIALS["aluminium alloy"].density,
        data=f"{_HOLES.number} holes for {_HOLES.thread}, {in_mm(_HOLES.across)} x {in_mm(_HOLES.along)}",
        holes=(_HOLES,),
    )
    title = "carriage of an axis of the rail's retreat"
    return bought_part(part_id("retreat-carriage"), title, "guide carriage", box(*CARRIAGE), bought)


_UP_AND_FRONT = complex(RETREAT.imag, RETREAT.real)
"""Direction of the retreat, its real part up, its imaginary one to the front."""

_ALONG_RETREAT = ALONG_WIDTH.after(placement(about=(0.0, 0.0, 1.0), angle=cmath.phase(_UP_AND_FRONT)))
"""A part whose z points along the width, and its x along the retreat."""
