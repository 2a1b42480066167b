"""A knot in motion: the head from the side and from the front, over the angle of its cam shaft."""

import numpy as np

from ilmek.arrays import Complex, Float, FloatArray
from ilmek.machines.automated_loom.design import LoomDesign
from ilmek.machines.automated_loom.in_space.heads import head_alone
from ilmek.machines.automated_loom.in_space.maker import KNOT
from ilmek.machines.part_views import named_strokes
from ilmek.machines.weaver.design import Weaver
from ilmek.machines.weaver.grippers import Grippers
from ilmek.machines.weaver.knot import led_between
from ilmek.machines.weaver.motions import CENTRE_MOTION, SIDE_MOTION, SLEY
from ilmek.machines.weaver.parts import case_plates
from ilmek.machines.weaver.transmissions import CAM_SHAFT
from ilmek.machines.weaver.tree import HEAD
from ilmek.part.projection import PieceOutline, View, moving_outlines, outlines
from ilmek.report import Animation, Axis, Dot, Drawing, MovingStroke, Reading, Stroke
from ilmek.timing.track import Track, sample
from ilmek.units import mm, turn
from ilmek.weaving.knots.led_yarn import evenly

FRAMES = 90
DRIVE = Axis("cam angle", "deg")

_ALONG, _EACH = 60, 41
_ABOVE = 1.6
"""How far the warps are drawn above the opener, in its heights."""


def knot_from_the_side(loom: LoomDesign) -> Animation:
    """The tools of a head in the side view: grippers, opener and sley at the warps, the head's case behind them."""
    side, warp = loom.side, loom.task.yarns.warp.diameter / 2
    high = 1j * side.of_heads.shape.top
    case = max((curve for outline in _case(loom, View.SIDE) for curve in outline.curves), key=len)
    still = Drawing(
        "loom-knot-side",
        "A knot from the side",
        (
            Stroke(np.array([-1j * 20 * mm, high]) - warp, "yarn", "warps"),
            Stroke(np.array([0j, high]) + warp, "yarn"),
            Stroke(case, "construction", "head", closed=True),
        ),
        (Dot(0j, "fell", "point"),),
        note="to scale; the fell is at 0",
    )
    strokes = _tools(loom, View.SIDE)
    tracks = {tool.track: loom.knot_cyclogram.track(tool.track) for tool in side.of_heads.shape.tools}
    return Animation(
        still, DRIVE, _angles(), strokes, (), period=loom.times.knot, readings=_readings(tracks, _angles())
    )


def _case(loom: LoomDesign, view: View) -> list[PieceOutline]:
    plates = case_plates(loom.weaver)
    return [outline for outline in outlines(head_alone(loom), view) if outline.part.id in plates]


def _tools(loom: LoomDesign, view: View) -> tuple[MovingStroke, ...]:
    """The parts that cams and servos move; the first of each body has the body's name."""
    tree = head_alone(loom)
    moved = [body.id for body in tree.bodies if body.joint.motion is not None and body.id not in {HEAD, CAM_SHAFT}]
    return named_strokes(moving_outlines(tree, view, KNOT, _angles(), moved))


def ties_by_grippers(loom: LoomDesign) -> bool:
    """Whether side grippers tie a knot; a head with arms has its own figures."""
    return not loom.weaver.params.with_arms and loom.weaver.tied.knot is not None


def knot_from_the_front(loom: LoomDesign) -> Animation:
    """Grippers, opener, sley and yarn before the warps, as the weaver sees them, of a head that ties by grippers."""
    weaver = loom.weaver
    angle, by = _angles(), weaver.grippers
    tracks = {name: weaver.cyclogram.track(name) for name in (SIDE_MOTION, CENTRE_MOTION, SLEY)}
    side = sample(tracks[SIDE_MOTION], angle).position
    low = weaver.params.opener.front_span + weaver.params.clearance
    tied = low + (by.lift + by.finger) / 2
    top = (weaver.params.opener.front_span + weaver.params.opener.height) * _ABOVE
    strokes = (
        *_warps(weaver, side, top),
        MovingStroke(_yarn(weaver, tied, angle), "outline", "yarn"),
        *_tools(loom, View.FRONT),
    )
    still = Drawing(
        "loom-knot-front",
        "A knot from the front",
        (Stroke(np.array([-3, 3]) * by.axis + 0j, "construction", "fell"),),
        note="as the weaver sees it; each side gripper's rod is seen end on, its arm turns about it; "
        "the yarn lies where its ends went, not yet tightened",
    )
    return Animation(still, DRIVE, angle, strokes, (), period=loom.times.knot, readings=_readings(tracks, angle))


def _angles() -> FloatArray:
    return np.arange(FRAMES) * (turn / FRAMES)


def _readings(tracks: dict[str, Track], angle: FloatArray) -> tuple[Reading, ...]:
    return tuple(Reading(name, sample(track, angle).position, track.unit) for name, track in tracks.items())


def _arm(by: Grippers, side: FloatArray, tied: float, hand: int) -> Complex[np.ndarray, "frames 2"]:
    """Rod and tip of a side gripper from the front [m]; hand: -1 the left, +1 the right one."""
    turned = by.turned(side)
    rod = np.full(len(side), hand * by.axis + 1j * (tied + hand * by.lift / 2))
    return np.stack([rod, rod + by.arm * (hand * np.cos(turned) + 1j * np.sin(turned))], -1)


def _warps(weaver: Weaver, side: Float[np.ndarray, " n"], top: float) -> tuple[MovingStroke, ...]:
    """The pair and its neighbours: closed at the fell, parted between the plates of the opener."""
    by, own, pitch = weaver.grippers, weaver.params.opener, weaver.params.quality.warp_pitch
    share = np.clip(side / by.opening, 0.0, 1.0)
    closed = pitch * np.array([-1.5, -0.5, 0.5, 1.5])
    opened = closed + share[:, None] * (by.warps.real - closed)
    heights = np.array([0.0, own.front_span, own.front_span + own.height, top])
    mixed = closed + (opened - closed) * own.front_span / (own.front_span + top)
    lines = np.stack([np.broadcast_to(closed, opened.shape), opened, opened, mixed], -1) + 1j * heights
    return tuple(MovingStroke(lines[:, k], "yarn", "warps" if k == 0 else "") for k in range(len(closed)))


def _yarn(weaver: Weaver, tied: float, angle: FloatArray) -> Complex[np.ndarray, "frames points"]:
    """The yarn from the front at cam angles [rad]: where its ends went so far."""
    by, cyclogram = weaver.grippers, weaver.cyclogram
    grasped, taken, released = led_between(cyclogram)
    at = np.concatenate([np.linspace(grasped, taken, 6 * _EACH), np.linspace(taken, released, 2 * _EACH)])
    side = sample(cyclogram.track(SIDE_MOTION), at).position
    by_centre = 1j * (tied + by.height)
    ends = [np.where(at <= taken, _arm(by, side, tied, hand)[:, 1], by_centre) for hand in (-1, 1)]
    known = np.maximum(np.searchsorted(at, angle, side="right"), 2)
    return np.stack([evenly(np.concatenate([ends[0][:k][::-1], ends[1][:k]]), _ALONG) for k in known])
