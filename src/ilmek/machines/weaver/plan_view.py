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
    start, end = (
        [_bent(by, np.array([at]), hand)[0] for hand in (-1, 1)] for at in (by.opening, by.opening + by.crossing)
    )
    crossing = np.linspace(by.opening, by.opening + by.crossing, EACH)
    grip = np.array([1j * 2 * ROD, -1j * by.depth])
    strokes = (
        *(Stroke(warp + by.warp / 2 * _RING, "outline", closed=True, filled=True) for warp in by.warps),
        *(Stroke(bent, "construction") for bent in start),
        *(Stroke(by.tip(crossing, hand), "path") for hand in (-1, 1)),
        *(Stroke(bent, "link", f"{side} side gripper") for side, bent in zip(("left", "right"), end, strict=True)),
        Stroke(grip, "outline", "centre gripper"),
        Stroke(_yarn(weaver), "yarn", "yarn"),
    )
    dots = tuple(Dot(complex(bent[-1]), "", "point") for bent in end)
    note = f"{weaver.knot_why}; the pile is upwards, seen along the warps; dashed: before the grippers turn"
    return Drawing("weaver-plan", "The ends of the pile round the pair of warps", strokes, dots, note=note)


def animation(weaver: Weaver) -> Animation:
    """The grippers over a turn of the cams, the warps parted by the opener, and the yarn where its ends went."""
    by, angle = weaver.grippers, np.arange(FRAMES) * (turn / FRAMES)
    side = sample(weaver.cyclogram.track(SIDE_MOTION), angle).position
    centre = sample(weaver.cyclogram.track(CENTRE_MOTION), angle).position
    bars, tip = [_bent(by, side, hand) for hand in (-1, 1)], by.centre(centre)
    yarn = yarn_over_time([_led(weaver, hand) for hand in (-1, 1)], angle, ALONG)
    strokes = (
        *_warps(weaver, side),
        MovingStroke(yarn, "outline", "yarn"),
        *(MovingStroke(bent, "link", f"{side} gripper") for side, bent in zip(("left", "right"), bars, strict=True)),
        MovingStroke(np.stack([tip, tip + 1j * 2 * ROD], -1), "outline", "centre gripper"),
    )
    dots = tuple(MovingDot(bent[:, -1], "", "point") for bent in bars)
    note = "The yarn lies where its ends went, not yet tightened; the pile is upwards."
    still = Drawing("weaver-moving", "A knot in plan view", (), note=note)
    readings = (Reading("screw", by.turned(side), "deg"), Reading("side grippers", side, "mm"))
    return Animation(still, Axis("cam angle", "deg"), angle, strokes, dots, period=weaver.cycle, readings=readings)


def _bent(by: Grippers, position: FloatArray, hand: int) -> Complex[np.ndarray, "n 3"]:
    """Rod and arm of the left gripper (hand -1) or the right one: far end of the rod, its elbow, the tip."""
    tip = by.tip(position, hand)
    elbow = hand * by.axis + 1j * tip.imag
    return np.stack([elbow + 1j * ROD, elbow, tip], -1)


def _yarn(weaver: Weaver) -> ComplexArray:
    """The whole path of both ends, the left one backwards: the knot as it lies."""
    left, right = (led(weaver.cyclogram, weaver.grippers, EACH, hand=hand).points for hand in (-1, 1))
    return np.concatenate([left[::-1], right])


def _led(weaver: Weaver, hand: int) -> tuple[FloatArray, ComplexArray]:
    """Cam angles at which the left end (hand -1) or the right one is led [rad], and its positions then [m]."""
    by, tracks = weaver.grippers, weaver.cyclogram
    grasped, taken, released = led_between(tracks)
    by_side, by_centre = np.linspace(grasped, taken, 6 * EACH), np.linspace(taken, released, 2 * EACH)
    side = by.tip(sample(tracks.track(SIDE_MOTION), by_side).position, hand)
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
