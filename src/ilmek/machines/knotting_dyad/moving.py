"""The head in motion: both arms, the centre gripper, and the yarn as it lies where its ends went."""

from typing import TypeAlias

import numpy as np
from jaxtyping import Complex, Float

from ilmek.arrays import ComplexArray, FloatArray
from ilmek.machines.knotting_dyad.clear import Bars, arm_bars, mirrored_bars
from ilmek.machines.knotting_dyad.head import Head
from ilmek.machines.knotting_dyad.yarn import carried
from ilmek.report import Animation, Axis, Dot, Drawing, MovingDot, MovingStroke, Reading, Stroke
from ilmek.units import turn

EACH = 14
"""Frames of a phase."""

ALONG = 160
"""Places that the yarn is drawn through."""

_Ways: TypeAlias = list[ComplexArray]


def moving(head: Head) -> Animation:
    """A cycle, every phase as long as the others: the order of the motions, not their times."""
    left, right, centre = (np.concatenate([_moved(span) for span in spans]) for spans in _spans(head))
    frames = len(left)
    section = head.section
    bars = arm_bars(section, head.arm, left), mirrored_bars(section, arm_bars(section, head.arm, right))
    arms = [_links(one, name) for one, name in zip(bars, ("left arm", "right arm"), strict=True)]
    tip = section.middle + 1j * centre
    gripper = MovingStroke(np.stack([tip, tip + 1j * section.needle_length], -1), "outline")
    ways = _ways(head, 0), _ways(head, 1)
    yarn = MovingStroke(np.stack([_yarn(ways, frame) for frame in range(frames)]), "outline")
    strokes = (yarn, *arms[0], *arms[1], gripper)
    elbows = tuple(MovingDot(one.starts[:, 1], name) for one, name in zip(bars, ("E", "E'"), strict=True))
    pivot = head.arm.pivot
    dots = (Dot(pivot, "O", "pivot"), Dot(complex(2 * section.middle - pivot.conjugate()), "O'", "pivot"))
    ring = section.warp / 2 * np.exp(1j * turn * np.arange(24) / 24)
    still = Drawing(
        "knotting-dyad-moving",
        "The head ties a knot",
        tuple(Stroke(place + ring, "outline", closed=True, filled=True) for place in section.warps),
        dots,
        note="Every phase is drawn as long as the others. The yarn lies where its ends went, not yet tightened.",
    )
    at = np.linspace(0.0, float(len(head.phases)), frames)
    readings = (Reading("left arm s", left), Reading("right arm s", right), Reading("centre gripper", centre, "mm"))
    return Animation(still, Axis("phases done"), at, strokes, elbows, closes=False, readings=readings)


def _spans(head: Head) -> tuple[list[tuple[float, float]], ...]:
    phases = head.phases
    return [phase.left for phase in phases], [phase.right for phase in phases], [phase.centre for phase in phases]


def _moved(span: tuple[float, float]) -> Float[np.ndarray, " frames"]:
    """From begin to end with a soft start and stop."""
    return np.asarray(span[0] + (span[1] - span[0]) * _soft(np.arange(EACH) / (EACH - 1)))


def _soft(x: FloatArray) -> FloatArray:
    return np.asarray(x**2 * (3 - 2 * x))


def _links(bars: Bars, name: str) -> tuple[MovingStroke, ...]:
    """First link, wide part of the second, needle."""
    wide = [MovingStroke(np.stack([bars.starts[:, k], bars.ends[:, k]], -1), "link", name) for k in (0, 1)]
    return (*wide, MovingStroke(np.stack([bars.starts[:, 2], bars.ends[:, 2]], -1), "outline"))


def _yarn(ways: tuple[_Ways, _Ways], frame: int) -> Complex[np.ndarray, " along"]:
    """The yarn at a frame: the first end's way until then backwards, then the second's, in even steps."""
    phase, at = divmod(frame, EACH)
    first, second = (np.concatenate([*way[:phase], way[phase][: at + 1]]) for way in ways)
    whole = np.concatenate([first[::-1], second])
    length = np.append(0.0, np.cumsum(np.abs(np.diff(whole))))
    even = np.linspace(0.0, length[-1], ALONG)
    return np.asarray(np.interp(even, length, whole.real) + 1j * np.interp(even, length, whole.imag))


def _ways(head: Head, end: int) -> _Ways:
    """Where an end is at the frames of each phase; nothing where nobody carries it."""
    shares, none = _soft(np.arange(EACH) / (EACH - 1)), np.empty(0, complex)
    return [
        carried(head.section, head.arm, phase.carries[end], phase, shares) if phase.carries[end] else none
        for phase in head.phases
    ]
