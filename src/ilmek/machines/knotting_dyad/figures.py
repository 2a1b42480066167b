"""The knotting dyad's figures: arms through the points, the head and its workspace, curves over path and time."""

from collections.abc import Mapping

import numpy as np

from ilmek.arrays import ComplexArray, FloatArray
from ilmek.machines.knotting_dyad.animation import animation
from ilmek.machines.knotting_dyad.clearance import arm_bars, mirrored_bars, to_warps
from ilmek.machines.knotting_dyad.design import SHARES, KnottingDyad
from ilmek.machines.knotting_dyad.drives import HeadMotion
from ilmek.machines.knotting_dyad.head import Head
from ilmek.machines.knotting_dyad.motion import KnotCycle
from ilmek.machines.knotting_dyad.section import WarpSection
from ilmek.machines.knotting_dyad.sequence import CENTRE, LEFT, RIGHT
from ilmek.machines.knotting_dyad.yarn import carried
from ilmek.plane.round_bars import RoundBars
from ilmek.report import Axis, Dot, Drawing, Figure, Lane, Mark, Plot, Series, Stroke, Timing
from ilmek.synthesis.dyad import TwoLinkArm
from ilmek.units import format_quantity, turn

PATH = Axis("s, from rest to the hand-over")


ARMS = {LEFT: "left arm", RIGHT: "right arm"}


def design_figures(design: KnottingDyad) -> tuple[Figure, ...]:
    """All arms in one drawing, and the arm to build in four positions."""
    return (drawing(design),) if design.built is None else (drawing(design), poses(design))


def head_figures(head: Head, cycle: KnotCycle) -> tuple[Figure, ...]:
    """The head at its four points, its needle, its motion and workspace, and curves over the path."""
    plots = (joints(head), bent(head), clear(head))
    return head_drawing(head), passing(head), animation(head, cycle), workspace(head), *plots


def motion_figures(motion: HeadMotion) -> tuple[Figure, ...]:
    """Cyclogram, and angles, speeds, the use of the limits and torques over time."""
    arms = motion.cycle.arms
    angles = _links({name: arm.angle - arm.angle[0] for name, arm in arms.items()})
    used = dict(zip(("speed", "acceleration", "jerk"), motion.cycle.used, strict=True))
    torques = _links({name: arm.torque for name, arm in motion.arms.items()})
    speeds = _links({name: arm.speed for name, arm in arms.items()})
    return (
        cyclogram(motion.cycle),
        _over_time(motion, "angles", "Rotation of the links from rest", Axis("angle", "deg"), angles),
        _over_time(motion, "speeds", "Speeds of the links", Axis("speed", "rad/s"), speeds),
        _over_time(motion, "limits", "Use of the joints' limits", Axis("greatest over its limit"), used),
        _over_time(motion, "torques", "Torques at the joints", Axis("torque", "mN*m"), torques),
    )


def cyclogram(cycle: KnotCycle) -> Timing:
    """The cycle's phases: arms, centre gripper, and which gripper closes or opens when."""
    time, first = np.unique(cycle.time, return_index=True)
    positions = {LEFT: cycle.arms[LEFT].s, RIGHT: cycle.arms[RIGHT].s, CENTRE: -cycle.centre[0]}
    lanes = []
    for name, position in positions.items():
        share = (position - position.min()) / np.ptp(position)
        grips = tuple(
            Mark(part.start / cycle.period * turn, part.name) for part in cycle.parts if name in part.grippers
        )
        actuator = "two servos" if name in ARMS else "centre drive"
        angle = np.minimum(time / cycle.period * turn, turn)
        lanes.append(Lane(ARMS.get(name, "centre gripper"), actuator, angle, share[first], grips))
    note = "0: in front of the warps, 1: at the hand-over behind them."
    return Timing("knotting-dyad-cycle", "Cycle of a knot", cycle.period, tuple(lanes), note)


def _links(arms: Mapping[str, FloatArray]) -> dict[str, FloatArray]:
    return {f"{label}, link {at + 1}": arms[arm][:, at] for arm, label in ARMS.items() for at in (0, 1)}


def _over_time(motion: HeadMotion, name: str, title: str, y: Axis, curves: Mapping[str, FloatArray]) -> Plot:
    series = tuple(
        Series(label, motion.cycle.time, values, dashed=label.endswith("2")) for label, values in curves.items()
    )
    phases = [part for part in motion.cycle.parts if not part.grippers]
    marks = tuple(Mark(part.start, str(at)) for at, part in enumerate(phases, 1))
    note = f"1 to {len(phases)}: the phases begin."
    return Plot(f"knotting-dyad-{name}", title, Axis("time", "ms"), y, series, marks, note=note)


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
    note = "Left arm at its last point, right arm at its first, the others dashed. Yarn: the paths of its two ends."
    return Drawing(
        "knotting-dyad-head", "Both arms of the head at their four points", strokes, (*dots, *elbows), note=note
    )


def passing(head: Head) -> Drawing:
    """The needle among the warps, to scale, on its path and at the hand-over."""
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
    path = head.arm.tip(np.linspace(max(0.0, 1 - 2.2 * section.reach / head.arm.stroke), 1.0, 61))
    strokes.append(Stroke(path, "yarn"))
    dots = (Dot(section.gap, "G", "point"), Dot(section.handover, "H", "point"))
    note = "G: middle of the gap, through which the needle always goes. H: hand-over. Yarn: the path of the tip."
    return Drawing("knotting-dyad-passing", "The needle between the warps", tuple(strokes), dots, note=note)


def workspace(head: Head) -> Drawing:
    """Workspace of the left arm: between two circles, on which its links are in one line."""
    arm = head.arm
    ring = np.exp(1j * turn * np.arange(96) / 96)
    inner = abs(arm.first - arm.second)
    circles = [Stroke(arm.pivot + radius * ring, "outline", closed=True) for radius in (arm.first + arm.second, inner)]
    least, most = (abs(head.arm.tip(np.array([at]))[0] - arm.pivot) for at in (1.0, 0.0))
    used = [Stroke(arm.pivot + radius * ring, "construction", closed=True) for radius in (least, most)]
    path = Stroke(arm.tip(np.linspace(0, 1, 121)), "yarn")
    bars = arm_bars(head.section, arm, np.array([1.0]))
    strokes = (*warps(head.section), *circles, *used, *_strong(bars, 0, "left arm at the hand-over"), path)
    note = (
        "Thick circles: stretched and folded, the singular positions that bound the workspace. Dashed: its used part."
    )
    dots = (Dot(arm.pivot, "O", "pivot"), Dot(complex(bars.ends[0, 0]), "E"))
    return Drawing("knotting-dyad-workspace", "Workspace of the left arm", strokes, dots, note=note)


def joints(head: Head) -> Plot:
    """Angles of both servos along the path."""
    theta = np.asarray(head.path.theta)
    curves = (
        ("first link", theta[:, 0]),
        ("second link", theta[:, 1]),
        ("elbow, second to first", theta[:, 1] - theta[:, 0]),
    )
    series = tuple(Series(name, head.path.s, _near(values), dashed=at == 2) for at, (name, values) in enumerate(curves))
    marks = tuple(Mark(float(at), f"P{number}") for number, at in enumerate(SHARES, 1))
    return Plot("knotting-dyad-servos", "Servo angles of the left arm", PATH, Axis("angle", "deg"), series, marks)


def bent(head: Head) -> Plot:
    """Angle of the links off one line, and of the needle off upright."""
    theta = head.path.theta
    off = np.arcsin(np.abs(np.sin(theta[:, 1] - theta[:, 0])))
    series = (
        Series("links off one line", head.path.s, off),
        Series("needle off upright", head.path.s, _tilt(head), dashed=True),
    )
    return Plot("knotting-dyad-bend", "Distance from the singular poses, and tilt", PATH, Axis("angle", "deg"), series)


def clear(head: Head) -> Plot:
    """Distance of needle and wide links from the nearest warp along the path."""
    bars = arm_bars(head.section, head.arm, head.path.s)
    near = [
        to_warps(head.section, RoundBars(bars.starts[:, k], bars.ends[:, k], bars.radii[k]))
        for k in (slice(2, 3), slice(0, 2))
    ]
    series = tuple(
        Series(name, head.path.s, values) for name, values in zip(("needle", "wide links"), near, strict=True)
    )
    return Plot("knotting-dyad-clearance", "Clearance to the nearest warp", PATH, Axis("distance", "mm"), series)


def _near(angles: FloatArray) -> FloatArray:
    """The same angles, begun within half a turn."""
    return np.asarray(angles - turn * np.round(angles[0] / turn))


def _tilt(head: Head) -> FloatArray:
    return head.arm.tilt(head.path.s)


def _knot(head: Head) -> ComplexArray:
    """The paths of both ends in one line: the first backwards, then the second."""
    shares = np.linspace(0.0, 1.0, 41)
    first, second = (
        np.concatenate(
            [
                carried(head.section, head.arm, one.carries[end], one, shares)
                for one in head.sequence
                if one.carries[end]
            ]
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
    """The pair and its nearest neighbours on each side, in section."""
    ring = section.warp / 2 * np.exp(1j * turn * np.arange(36) / 36)
    middle = len(section.warps) // 2
    return tuple(
        Stroke(warp + ring, "outline", closed=True, filled=True)
        for warp in section.warps[middle - 1 - neighbours : middle + 1 + neighbours]
    )


def drawing(design: KnottingDyad) -> Drawing:
    """Every arm at the first point; a link without length is left out."""
    links = [one for at, dyad in enumerate(design.dyads) for one in _arm(design, dyad, 0, f"{at + 1}: ")]
    pivots = [Dot(dyad.pivot, f"O{at + 1}", "pivot") for at, dyad in enumerate(design.dyads)]
    note = "All at the first point P1. O: pivots."
    title = "Every arm through the four timed points"
    return Drawing("knotting-dyad-solutions", title, (*_path(design), *links), (*pivots, *_points(design)), note=note)


def poses(design: KnottingDyad) -> Drawing:
    """The arm to build at the first point, the others dashed."""
    dyad = design.dyads[design.built or 0]
    elbows = design.elbows(dyad)
    others = [Stroke(np.array([dyad.pivot, elbows[at], design.task.points[at]]), "construction") for at in range(1, 4)]
    dots = (Dot(dyad.pivot, "O", "pivot"), Dot(complex(elbows[0]), "A"), *_points(design))
    strokes = (*_path(design), *others, *_arm(design, dyad, 0, ""))
    note = "At the first point P1, the other poses dashed."
    return Drawing("knotting-dyad-poses", f"Arm {(design.built or 0) + 1}, the one to build", strokes, dots, note=note)


def _arm(design: KnottingDyad, dyad: TwoLinkArm, at: int, label: str) -> tuple[Stroke, ...]:
    elbow, point = complex(design.elbows(dyad)[at]), complex(design.task.points[at])
    second = Stroke(np.array([elbow, point]), "link", f"{label}{format_quantity(dyad.second, 'mm')}")
    if not dyad.first:
        return (second,)
    return Stroke(np.array([dyad.pivot, elbow]), "link", f"{label}{format_quantity(abs(dyad.first), 'mm')}"), second


def _points(design: KnottingDyad) -> tuple[Dot, ...]:
    return tuple(Dot(complex(point), f"P{at + 1}", "point") for at, point in enumerate(design.task.points))


def _path(design: KnottingDyad) -> tuple[Stroke, ...]:
    """The path on which the points were chosen, and its warps."""
    if design.head is None:
        return ()
    return (*warps(design.head.section, 2), Stroke(design.task.path, "yarn"))
