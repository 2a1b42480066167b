"""The head in motion: both arms, the centre gripper, and the yarn as it lies where its ends went."""

import numpy as np

from ilmek.arrays import ComplexArray, Float, FloatArray
from ilmek.machines.knotting_dyad.clearance import arm_bars, mirrored_bars
from ilmek.machines.knotting_dyad.head import Head
from ilmek.machines.knotting_dyad.motion import CyclePart, KnotCycle
from ilmek.machines.knotting_dyad.sequence import CENTRE, LEFT, RIGHT, Phase
from ilmek.plane.round_bars import RoundBars
from ilmek.report import Animation, Axis, Dot, Drawing, MovingDot, MovingStroke, Reading, Stroke
from ilmek.units import turn
from ilmek.weaving.knots.led_yarn import yarn_over_time

FRAMES = 66
ALONG, EACH = 80, 41
"""Points of the yarn that are drawn, and of an end's path in a phase."""


def animation(head: Head, cycle: KnotCycle) -> Animation:
    """A cycle, as quick as the drives allow."""
    section, time = head.section, np.arange(FRAMES) * (cycle.period / FRAMES)
    left, right, centre = _at(cycle, time)
    bars = arm_bars(section, head.arm, left), mirrored_bars(section, arm_bars(section, head.arm, right))
    arms = [_links(one, name) for one, name in zip(bars, ("left arm", "right arm"), strict=True)]
    tip = section.middle + 1j * centre
    gripper = MovingStroke(np.stack([tip, tip + 1j * section.needle_length], -1), "outline")
    ends = [_led(head, cycle, end) for end in (0, 1)]
    yarn = MovingStroke(yarn_over_time(ends, time, ALONG), "outline")
    elbows = tuple(MovingDot(one.starts[:, 1], name) for one, name in zip(bars, ("E", "E'"), strict=True))
    pivot = head.arm.pivot
    dots = (Dot(pivot, "O", "pivot"), Dot(complex(2 * section.middle - pivot.conjugate()), "O'", "pivot"))
    ring = section.warp / 2 * np.exp(1j * turn * np.arange(24) / 24)
    still = Drawing(
        "knotting-dyad-moving",
        "The head ties a knot",
        tuple(Stroke(warp + ring, "outline", closed=True, filled=True) for warp in section.warps),
        dots,
        note="The yarn lies where its ends went, not yet tightened.",
    )
    readings = (Reading("left arm s", left), Reading("right arm s", right), Reading("centre gripper", centre, "mm"))
    strokes = (yarn, *arms[0], *arms[1], gripper)
    return Animation(still, Axis("time", "ms"), time, strokes, elbows, period=cycle.period, readings=readings)


def _at(cycle: KnotCycle, time: Float[np.ndarray, " n"]) -> tuple[FloatArray, FloatArray, FloatArray]:
    """S of both arms, and the height of the centre gripper's tip at times [s]."""
    positions = cycle.arms[LEFT].s, cycle.arms[RIGHT].s, cycle.centre[0]
    left, right, centre = (np.interp(time, cycle.time, position) for position in positions)
    return left, right, centre


def _links(bars: RoundBars, name: str) -> tuple[MovingStroke, ...]:
    """First link, wide part of the second, needle."""
    wide = [MovingStroke(np.stack([bars.starts[:, k], bars.ends[:, k]], -1), "link", name) for k in (0, 1)]
    return (*wide, MovingStroke(np.stack([bars.starts[:, 2], bars.ends[:, 2]], -1), "outline"))


def _led(head: Head, cycle: KnotCycle, end: int) -> tuple[FloatArray, ComplexArray]:
    """Times at which an end is led, and its positions then."""
    parts = [part for part in cycle.parts if not part.grippers]
    led = [
        _carried(head, cycle, part, phase, end)
        for part, phase in zip(parts, head.sequence, strict=True)
        if phase.carries[end]
    ]
    times, points = zip(*led, strict=True)
    return np.concatenate(times), np.concatenate(points)


def _carried(head: Head, cycle: KnotCycle, part: CyclePart, phase: Phase, end: int) -> tuple[FloatArray, ComplexArray]:
    time = np.linspace(part.start, part.end, EACH)
    left, right, centre = _at(cycle, time)
    carrier = phase.carries[end]
    if carrier == CENTRE:
        return time, np.asarray(head.section.middle + 1j * centre)
    tip = head.arm.tip(left if carrier == LEFT else right)
    return time, tip if carrier == LEFT else np.asarray(2 * head.section.middle - np.conj(tip))
