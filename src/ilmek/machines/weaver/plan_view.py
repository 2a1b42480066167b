"""The grippers in plan view: as they begin to turn, as the ends cross, and in motion over a turn."""

import numpy as np

from ilmek.arrays import Complex, ComplexArray, Float, FloatArray
from ilmek.machines.weaver.design import Weaver
from ilmek.machines.weaver.grippers import Grippers
from ilmek.machines.weaver.knot import led, led_between
from ilmek.machines.weaver.motions import CENTRE_MOTION, SIDE_MOTION
from ilmek.report import Animation, Axis, Dot, Drawing, MovingDot, MovingStroke, Reading, Stroke
from ilmek.timing.track import sample
from ilmek.units import mm, turn
from ilmek.weaving.knots.led_yarn import yarn_over_time

FRAMES = 90
ALONG, EACH = 90, 41
ROD = 14 * mm
"""Length of a rod that is drawn [m]."""

_RING = np.exp(1j * turn * np.arange(24) / 24)


def plan_view(weaver: Weaver) -> Drawing:
    """Side grippers before they turn, dashed, and where their ends cross; the paths of the ends; the centre gripper."""
    by = weaver.grippers
    start, end = (_bent(by, np.array([at])) for at in (by.opening, by.opening + by.crossing))
    path = by.tip(np.linspace(by.opening, by.opening + by.crossing, EACH))
    grip = np.array([1j * 2 * ROD, -1j * by.depth])
    strokes = (
        *(Stroke(warp + by.warp / 2 * _RING, "outline", closed=True, filled=True) for warp in by.warps),
        *(Stroke(one[0], "construction") for one in (start, _mirrored(start))),
        *(Stroke(one, "path") for one in (path, _mirrored(path))),
        Stroke(end[0], "link", "left side gripper"),
        Stroke(_mirrored(end)[0], "link", "right side gripper"),
        Stroke(grip, "outline", "centre gripper"),
        Stroke(_yarn(weaver), "yarn", "yarn"),
    )
    dots = tuple(Dot(complex(tip), "", "point") for tip in (by.end, -by.end.conjugate()))
    note = f"{weaver.knot_why}; the pile is upwards, seen along the warps; dashed: before the grippers turn"
    return Drawing("weaver-plan", "The ends of the pile round the pair of warps", strokes, dots, note=note)


def animation(weaver: Weaver) -> Animation:
    """The grippers over a turn of the cams, the warps parted by the opener, and the yarn where its ends went."""
    by, angle = weaver.grippers, np.arange(FRAMES) * (turn / FRAMES)
    side = sample(weaver.cyclogram.track(SIDE_MOTION), angle).position
    centre = sample(weaver.cyclogram.track(CENTRE_MOTION), angle).position
    bars, tip = _bent(by, side), by.centre(centre)
    at, points = _led(weaver)
    yarn = yarn_over_time(((at, points), (at, _mirrored(points))), angle, ALONG)
    strokes = (
        *_warps(weaver, side),
        MovingStroke(yarn, "outline", "yarn"),
        MovingStroke(bars, "link", "left gripper"),
        MovingStroke(_mirrored(bars), "link", "right gripper"),
        MovingStroke(np.stack([tip, tip + 1j * 2 * ROD], -1), "outline", "centre gripper"),
    )
    dots = tuple(MovingDot(ends, "", "point") for ends in (bars[:, -1], _mirrored(bars)[:, -1]))
    note = "The yarn lies where its ends went, not yet tightened; the pile is upwards."
    still = Drawing("weaver-moving", "A knot in plan view", (), note=note)
    readings = (Reading("screw", by.turned(side), "deg"), Reading("side grippers", side, "mm"))
    return Animation(still, Axis("cam angle", "deg"), angle, strokes, dots, period=weaver.cycle, readings=readings)


def _bent(by: Grippers, position: FloatArray) -> Complex[np.ndarray, "n 3"]:
    """Rod and arm of the left gripper: far end of the rod, its elbow, the tip."""
    tip = by.tip(position)
    elbow = -by.axis + 1j * tip.imag
    return np.stack([elbow + 1j * ROD, elbow, tip], -1)


def _mirrored(points: ComplexArray) -> ComplexArray:
    return np.asarray(-np.conj(points))


def _yarn(weaver: Weaver) -> ComplexArray:
    """The whole path of both ends, the left one backwards: the knot as it lies."""
    left = led(weaver.cyclogram, weaver.grippers, EACH).points
    return np.concatenate([left[::-1], _mirrored(left)])


def _led(weaver: Weaver) -> tuple[FloatArray, ComplexArray]:
    """Cam angles at which the left end is led [rad], and its positions then [m]."""
    by, tracks = weaver.grippers, weaver.cyclogram
    grasped, taken, released = led_between(tracks)
    by_side, by_centre = np.linspace(grasped, taken, 6 * EACH), np.linspace(taken, released, 2 * EACH)
    side = by.tip(sample(tracks.track(SIDE_MOTION), by_side).position)
    centre = by.centre(sample(tracks.track(CENTRE_MOTION), by_centre).position)
    return np.concatenate([by_side, by_centre]), np.concatenate([side, centre])


def _warps(weaver: Weaver, side: Float[np.ndarray, " n"]) -> tuple[MovingStroke, ...]:
    """The pair, which the opener parts, and their neighbours, which it pushes aside."""
    by, pitch = weaver.grippers, weaver.params.cloth.warp_pitch
    share = np.clip(side / by.opening, 0.0, 1.0)
    closed = pitch * np.array([-1.5, -0.5, 0.5, 1.5])
    axes = closed + share[:, None] * (by.warps.real - closed)
    rings = axes[:, :, None] + by.warp / 2 * _RING
    return tuple(MovingStroke(rings[:, k], "outline", closed=True) for k in range(len(closed)))
