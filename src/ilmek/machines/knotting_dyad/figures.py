"""The knotting dyad's figures: every arm through the points, the head at its four points, its room, and curves."""

import numpy as np

from ilmek.arrays import ComplexArray, FloatArray
from ilmek.machines.knotting_dyad.animation import moving
from ilmek.machines.knotting_dyad.clearance import RoundBars, arm_bars, mirrored_bars, to_warps
from ilmek.machines.knotting_dyad.design import KnottingDyad
from ilmek.machines.knotting_dyad.head import Head
from ilmek.machines.knotting_dyad.motion import KnotCycle
from ilmek.machines.knotting_dyad.section import WarpSection
from ilmek.machines.knotting_dyad.task import SHARES
from ilmek.machines.knotting_dyad.yarn import carried
from ilmek.report import Axis, Dot, Drawing, Figure, Mark, Plot, Series, Stroke
from ilmek.synthesis.dyad import TwoLinkArm
from ilmek.units import format_quantity, turn

WAY = Axis("s, from rest to the hand-over")


def figures(design: KnottingDyad, cycle: KnotCycle | None) -> tuple[Figure, ...]:
    """The head and its motion, where a knot is tied; all arms in one drawing, and the arm to build in four poses."""
    arms = (drawing(design),) if design.chosen is None else (drawing(design), poses(design))
    if design.head is None or cycle is None:
        return arms
    head = design.head
    plots = (joints(head), bent(head), clear(head))
    return head_drawing(head), passing(head), moving(head, cycle), workspace(head), *plots, *arms


def head_drawing(head: Head) -> Drawing:
    """Both arms at the four points, the left one strong at the last, the right one at the first; the centre gripper."""
    bars = arm_bars(head.section, head.arm, SHARES)
    other = mirrored_bars(head.section, bars)
    poses = [(bars, at) for at in range(3)] + [(other, at) for at in range(1, 4)]
    dashed = [_chain(one, at, "construction") for one, at in poses]
    strong = [*_strong(bars, 3, "left arm"), *_strong(other, 0, "right arm")]
    pivot = head.arm.pivot
    dots = (Dot(pivot, "O", "pivot"), Dot(complex(2 * head.section.middle - pivot.conjugate()), "O'", "pivot"))
    elbows = (Dot(complex(bars.starts[3, 1]), "E"), Dot(complex(other.starts[0, 1]), "E'"))
    centre = Stroke(
        np.array([head.section.handover, head.section.middle + 1.6j * head.section.front]), "path", "centre"
    )
    strokes = (*warps(head.section), *dashed, *strong, centre, Stroke(_knot(head), "yarn"))
    note = "Left arm at its last point, right arm at its first, the others dashed. Yarn: the ways of its two ends."
    return Drawing(
        "knotting-dyad-head", "Both arms of the head at their four points", strokes, (*dots, *elbows), note=note
    )


def passing(head: Head) -> Drawing:
    """The needle among the warps, to scale, at places of its way, and at the hand-over."""
    section = head.section
    room = 1.6 * section.reach
    strokes = [
        *warps(section, 2),
        Stroke(section.middle + 1j * np.array([room, -section.depth]), "path", "centre gripper"),
    ]
    for at in (0.8, 0.9, 1.0):
        tip = complex(head.arm.tip(np.array([at]))[0])
        back = complex(head.arm.elbow(np.array([at]))[0]) - tip
        length = (room - tip.imag) / (back.imag / abs(back))
        outline = _bar(tip, tip + back / abs(back) * length, section.needle / 2)
        strokes.append(Stroke(outline, "outline" if at == 1.0 else "construction", closed=True))
    way = head.arm.tip(np.linspace(max(0.0, 1 - 2.2 * section.reach / head.arm.stroke), 1.0, 61))
    strokes.append(Stroke(way, "yarn"))
    dots = (Dot(section.gap, "G", "point"), Dot(section.handover, "H", "point"))
    note = "G: middle of the gap, through which the needle always goes. H: hand-over. Yarn: the way of the tip."
    return Drawing("knotting-dyad-passing", "The needle between the warps", tuple(strokes), dots, note=note)


def workspace(head: Head) -> Drawing:
    """What the left arm reaches: between two circles, on which its links are in one line."""
    arm = head.arm
    ring = np.exp(1j * turn * np.arange(96) / 96)
    inner = abs(arm.first - arm.second)
    circles = [Stroke(arm.pivot + radius * ring, "outline", closed=True) for radius in (arm.first + arm.second, inner)]
    least, most = (abs(head.arm.tip(np.array([at]))[0] - arm.pivot) for at in (1.0, 0.0))
    used = [Stroke(arm.pivot + radius * ring, "construction", closed=True) for radius in (least, most)]
    way = Stroke(arm.tip(np.linspace(0, 1, 121)), "yarn")
    bars = arm_bars(head.section, arm, np.array([1.0]))
    strokes = (*warps(head.section), *circles, *used, *_strong(bars, 0, "left arm at the hand-over"), way)
    note = "Thick circles: outstretched and folded, the singular places and the bounds of the room. Dashed: used of it."
    dots = (Dot(arm.pivot, "O", "pivot"), Dot(complex(bars.ends[0, 0]), "E"))
    return Drawing("knotting-dyad-workspace", "What the left arm reaches", strokes, dots, note=note)


def joints(head: Head) -> Plot:
    """Angles of both servos along the way."""
    theta = np.asarray(head.way.theta)
    curves = (
        ("first link", theta[:, 0]),
        ("second link", theta[:, 1]),
        ("elbow, second to first", theta[:, 1] - theta[:, 0]),
    )
    series = tuple(Series(name, head.way.s, _near(values), dashed=at == 2) for at, (name, values) in enumerate(curves))
    marks = tuple(Mark(float(at), f"P{number}") for number, at in enumerate(SHARES, 1))
    return Plot("knotting-dyad-servos", "Servo angles of the left arm", WAY, Axis("angle", "deg"), series, marks)


def bent(head: Head) -> Plot:
    """How far the links are from one line, and how far the needle is from upright."""
    theta = head.way.theta
    off = np.arcsin(np.abs(np.sin(theta[:, 1] - theta[:, 0])))
    series = (
        Series("links off one line", head.way.s, off),
        Series("needle off upright", head.way.s, _tilt(head), dashed=True),
    )
    return Plot("knotting-dyad-bend", "Distance from the singular poses, and tilt", WAY, Axis("angle", "deg"), series)


def clear(head: Head) -> Plot:
    """Distance of needle and wide links from the nearest warp along the way."""
    bars = arm_bars(head.section, head.arm, head.way.s)
    near = [
        to_warps(head.section, RoundBars(bars.starts[:, k], bars.ends[:, k], bars.radii[k]))
        for k in (slice(2, 3), slice(0, 2))
    ]
    series = tuple(
        Series(name, head.way.s, values) for name, values in zip(("needle", "wide links"), near, strict=True)
    )
    return Plot("knotting-dyad-clearance", "Clearance to the nearest warp", WAY, Axis("distance", "mm"), series)


def _near(angles: FloatArray) -> FloatArray:
    """The same angles, begun within half a turn."""
    return np.asarray(angles - turn * np.round(angles[0] / turn))


def _tilt(head: Head) -> FloatArray:
    return head.arm.tilt(head.way.s)


def _knot(head: Head) -> ComplexArray:
    """The ways of both ends in one line: the first backwards, then the second."""
    shares = np.linspace(0.0, 1.0, 41)
    first, second = (
        np.concatenate(
            [carried(head.section, head.arm, one.carries[end], one, shares) for one in head.phases if one.carries[end]]
        )
        for end in (0, 1)
    )
    return np.concatenate([first[::-1], second])


def _chain(bars: RoundBars, at: int, role: str) -> Stroke:
    return Stroke(np.append(bars.starts[at, [0, 1]], bars.ends[at, -1]), role)


def _strong(bars: RoundBars, at: int, label: str) -> tuple[Stroke, Stroke]:
    """An arm: its wide parts, and the needle."""
    wide = Stroke(bars.starts[at], "link", label)
    return wide, Stroke(np.array([bars.starts[at, 2], bars.ends[at, 2]]), "outline")


def _bar(start: complex, end: complex, radius: float) -> ComplexArray:
    """Outline of a bar with round ends."""
    along = (end - start) / abs(end - start)
    half = radius * along * np.exp(1j * np.linspace(-np.pi / 2, np.pi / 2, 13))
    return np.concatenate([end + half, start - half])


def warps(section: WarpSection, neighbours: int = 6) -> tuple[Stroke, ...]:
    """The pair and so many neighbours on each side, in section."""
    ring = section.warp / 2 * np.exp(1j * turn * np.arange(36) / 36)
    middle = len(section.warps) // 2
    return tuple(
        Stroke(place + ring, "outline", closed=True, filled=True)
        for place in section.warps[middle - 1 - neighbours : middle + 1 + neighbours]
    )


def drawing(design: KnottingDyad) -> Drawing:
    """Every arm at the first point; a link without length is left out."""
    links = [one for at, dyad in enumerate(design.dyads) for one in _arm(design, dyad, 0, f"{at + 1}: ")]
    pivots = [Dot(dyad.pivot, f"O{at + 1}", "pivot") for at, dyad in enumerate(design.dyads)]
    note = "All at the first point P1. O: pivots."
    title = "Every arm through the four timed points"
    return Drawing("knotting-dyad", title, (*_course(design), *links), (*pivots, *_points(design)), note=note)


def poses(design: KnottingDyad) -> Drawing:
    """The arm to build at the first point, the others dashed."""
    dyad = design.dyads[design.chosen or 0]
    elbows = design.joints(dyad)
    others = [Stroke(np.array([dyad.pivot, elbows[at], design.task.points[at]]), "construction") for at in range(1, 4)]
    dots = (Dot(dyad.pivot, "O", "pivot"), Dot(complex(elbows[0]), "A"), *_points(design))
    strokes = (*_course(design), *others, *_arm(design, dyad, 0, ""))
    note = "At the first point P1, the other poses dashed."
    return Drawing("knotting-dyad-poses", f"Arm {(design.chosen or 0) + 1}, the one to build", strokes, dots, note=note)


def _arm(design: KnottingDyad, dyad: TwoLinkArm, at: int, said: str) -> tuple[Stroke, ...]:
    elbow, point = complex(design.joints(dyad)[at]), complex(design.task.points[at])
    second = Stroke(np.array([elbow, point]), "link", f"{said}{format_quantity(dyad.second, 'mm')}")
    if not dyad.first:
        return (second,)
    return Stroke(np.array([dyad.pivot, elbow]), "link", f"{said}{format_quantity(abs(dyad.first), 'mm')}"), second


def _points(design: KnottingDyad) -> tuple[Dot, ...]:
    return tuple(Dot(complex(point), f"P{at + 1}", "point") for at, point in enumerate(design.task.points))


def _course(design: KnottingDyad) -> tuple[Stroke, ...]:
    """The way that the points were chosen on, and its warps."""
    if design.head is None:
        return ()
    return (*warps(design.head.section, 2), Stroke(design.task.course, "yarn"))
