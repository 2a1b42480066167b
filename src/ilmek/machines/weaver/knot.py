"""Which knot the head ties: the paths of the yarn's two ends over one turn of the cyclogram, and the proof.

Each end is held by its side gripper from the moment its jaws are closed until they open, then by the centre gripper
from closed jaws to open ones. The positions of the tips follow from the cams' positions at every cam angle. Between two
angles at which a motion begins or ends, a tip follows one curve, by the position of its cam, whatever the law; so the
length of the curve over a part of a stroke is at most that part times sqrt(1 + (rho turn / crossing)²). The knot is
proved with the warps as they stand in the opener [`ilmek.weaving.knots`]. A yarn that is released, missed, or led while
the warps close, ties none, and the words state why.
"""

from itertools import pairwise

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.machines.weaver.grippers import Grippers, crossing_point
from ilmek.machines.weaver.motions import CENTRE_GRASP, CENTRE_MOTION, SIDE_GRASP, SIDE_MOTION
from ilmek.timing.cyclogram import Cyclogram
from ilmek.timing.track import Track, sample
from ilmek.units import format_quantity
from ilmek.weaving.knots.led_yarn import SampledPath, end_path, knot_of_ends
from ilmek.weaving.knots.proof import TiedKnot, no_knot
from ilmek.weaving.knots.word import Word, knot

ROUNDING = 1e-9
"""Length below which an overlap is rounding [m]."""

PAIR: Word = (2, 3)
"""The pair among the warps of the plan view; on either side of it one more."""


def tied_by(cyclogram: Cyclogram, grippers: Grippers, jaw: float) -> TiedKnot:
    """The knot that a turn of the cyclogram ties with these grippers; none where order or hand-over are wrong."""
    wrong = _order(cyclogram, grippers) or _hand_over(grippers, jaw)
    if wrong:
        return no_knot(wrong)

    def ends(samples: int) -> tuple[SampledPath, SampledPath]:
        return led(cyclogram, grippers, samples, hand=-1), led(cyclogram, grippers, samples, hand=1)

    return knot_of_ends(ends, grippers.warps, keep_out=grippers.warp / 2)


def on_the_pair(tied: TiedKnot) -> str | None:
    """The kind of the knot that is tied on the pair; None: none, or on other warps."""
    return tied.knot.kind if tied.knot is not None and tied.knot.warps == PAIR else None


def proof_text(tied: TiedKnot) -> str:
    """The conclusion of the proof, the pair's warps called 1 and 2."""
    kind = on_the_pair(tied)
    return tied.words if kind is None else knot(kind).name


def led(cyclogram: Cyclogram, grippers: Grippers, samples: int, *, hand: int) -> SampledPath:
    """Path of the left end (hand -1) or the right one, from its gripper's grasp to the centre gripper's release."""
    grasped, taken, released = led_between(cyclogram)
    side = _positions(cyclogram.track(SIDE_MOTION), grasped, taken, samples)
    centre = _positions(cyclogram.track(CENTRE_MOTION), taken, released, samples)
    by_side = (grippers.tip(side, hand), np.abs(np.diff(side)) * grippers.reach_bound)
    return end_path([by_side, (grippers.centre(centre), np.abs(np.diff(centre)))])


def led_between(cyclogram: Cyclogram) -> tuple[float, float, float]:
    """Cam angles [rad] at which the side grippers have grasped the ends, the centre gripper takes and releases them."""
    grasped = cyclogram.track(SIDE_GRASP).segment("close").end
    centre = cyclogram.track(CENTRE_GRASP)
    return grasped, centre.segment("close").end, centre.segment("open").start


def _order(cyclogram: Cyclogram, grippers: Grippers) -> str:
    """Error in the order of grasp, release and warps; "" where there is none."""
    taken, released = led_between(cyclogram)[1], cyclogram.track(SIDE_GRASP).segment("open").start
    if released < taken:
        shown = [format_quantity(angle, "deg") for angle in (released, taken)]
        return f"the side grippers release the pile at {shown[0]}, before the centre gripper holds it at {shown[1]}"
    angle = np.linspace(0.0, 2 * np.pi, 1441)
    side = sample(cyclogram.track(SIDE_MOTION), angle).position
    centre = grippers.centre(sample(cyclogram.track(CENTRE_MOTION), angle).position)
    among = np.minimum(centre.imag, grippers.tip(side).imag) < grippers.warp / 2
    closing = among & (side < grippers.opening * (1 - 1e-9))
    if closing.any():
        at = format_quantity(float(angle[np.argmax(closing)]), "deg")
        return f"at {at} the warps are not held open, with a gripper between them"
    return ""


def _hand_over(grippers: Grippers, jaw: float) -> str:
    """Whether the centre gripper's jaws, one above and one below the arms, find both ends; "" where they do.

    The ends cross the middle at -+h/2 about the gripper's height, less the nearer they are to the warps.
    """
    tip = grippers.end
    if tip.real <= 0:
        return f"the ends do not cross: each stops {format_quantity(-tip.real, 'mm')} before the middle"
    share = (grippers.pair / 2) / (grippers.pair / 2 + tip.real)
    needed = share * grippers.lift + grippers.yarn
    if needed > jaw:
        shown = format_quantity(needed, "mm"), format_quantity(jaw, "mm")
        return f"the ends cross {shown[0]} high, the centre gripper's jaws open {shown[1]}"
    room = -tip.imag - grippers.stagger - grippers.finger / 2 - grippers.depth
    if room < -ROUNDING:
        return f"the centre gripper's tip runs {format_quantity(-room, 'mm')} into the side grippers' arms"
    return "" if crossing_point(grippers).imag < -grippers.warp / 2 else "the ends cross before the warps"


def _positions(track: Track, begin: float, end: float, samples: int) -> FloatArray:
    """Positions of a track [m] from one master angle to another [rad], evenly apart in each motion."""
    joints = [edge for part in track.segments for edge in (part.start, part.end) if begin < edge < end]
    at = sample(track, np.unique(np.array([begin, *joints, end]))).position
    strokes = [np.linspace(one, then, samples) for one, then in pairwise(at) if one != then]
    return np.concatenate([at[:1], *strokes])
