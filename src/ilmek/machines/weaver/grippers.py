"""The side grippers and the centre gripper in plan view: positions of their tips, their clearances, the yarn they need.

The section across the warps: x along the row, 0 in the middle of the pair, y towards the pile and the weaver. The pair
stands g apart in the opener's slots, which push all other warps aside. A side gripper is a rod along y with an arm
across it, of length rho, at whose end the yarn is held. The rods stand at -+a, beside the pair,

    a = g/2 + D/2 + t/2 + e             D warp's diameter, t thickness of rod and arm, e clearance

and the cam's travel p beyond the opened warps moves a screw guide: linear and turning, tau = turn p / crossing.
The left tip is at

    x = -(a + rho cos tau),     y = y0 - p,     z = -+h/2 + rho sin tau,     y0 = D/2 + t/2 + e

so it goes round its warp from outside; the right one is its mirror image, s before it. Both arms turn upwards, so that
the knot forms at the height of the centre gripper, and cross each other: s = t + e keeps one before the other, and h of
the same size one end above the other. At the beginning the yarn lies straight between the tips,
sqrt(4 (a + rho)² + h² + s²): the yarn drawn less its two tails, which gives rho. At the end the tips are c past the
middle: cos turn = -(a + c)/rho. There each end of the yarn comes from behind its warp, from -g/2 - i r, r = (D + d)/2,
d the yarn's diameter, and the left one crosses the middle at the depth r + k (Y - r), k = g / (g + 2 c), Y = -y, the
deeper of the two. The centre gripper reaches d/2 beyond that, and keeps e from the right arm, if

    Y = r + (s + t/2 + e + d/2) / (1 - k),     crossing = y0 + Y

Meanwhile the taut yarn about both warps needs, from each tip P at the distance q of its warp's axis,

    l = sqrt(q² - r²),   alpha = arg P - atan(l/r) - 90°,      in all g + r (alpha + alpha') + l + l'

[thesis 2.2.3, Figures 2.13 to 2.15: the arrangement; the formulas are this project's]
"""

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from ilmek.arrays import ComplexArray, FloatArray, RealField
from ilmek.machines.weaver.params import WeaverParams
from ilmek.records import computed, record, result
from ilmek.units import turn, um

SAMPLES = 401

YARN_TOLERANCE = 1 * um
"""Tolerance of lengths of yarn."""


@record
class Grippers:
    """The grippers' dimensions [m, rad].

    warp, yarn  diameters       finger  t, of rods and arms      clearance  e      opening  travel that opens the warps
    stroke      of the centre gripper
    """

    pair: float = result("mm", "distance of the pair of warps in the opener's slots", name="pair_opened")
    warp: float
    yarn: float
    finger: float
    clearance: float
    axis: float = result("mm", "a side gripper's rod from the middle of the pair", name="gripper_axis")
    arm: float = result("mm", "a side gripper's arm, from its rod to the yarn", name="gripper_arm")
    opening: float
    crossing: float = result("mm", "travel of the side grippers along the screw")
    turn: float = result("deg", "rotation of the side grippers by the screw", name="crossing_turn")
    depth: float = result("mm", "centre gripper's tip behind the warps", name="centre_depth")
    stroke: float

    yarn_held = computed("mm", "yarn between the side grippers", lambda it: it.apart)
    screw_lead = computed(
        "mm", "advance of the side grippers' screw for a turn", lambda it: it.crossing * turn / it.turn
    )
    opener_width = computed(
        "mm", "width within which the opener holds all other warps away", lambda it: 2 * abs(it.warps[-1].real)
    )

    @computed("mm", "most yarn needed between the side grippers on their path")
    def yarn_taut_max(self) -> float:
        return taut_max(self)

    @computed("mm", "least clearance of a side gripper and its warp; below 0 they overlap")
    def gripper_clearance(self) -> float:
        return clearance_min(self)

    @computed("mm", "centre gripper above the side grippers' rods, along the warps", name="centre_height")
    def height(self) -> float:
        return self.arm * math.sin(self.turn)

    @property
    def front(self) -> float:
        """Height y0 of the tips before the warps' axes, at which they begin to turn [m]."""
        return self.warp / 2 + self.finger / 2 + self.clearance

    @property
    def apart(self) -> float:
        """Distance of the tips before they turn, and length of the yarn straight between them [m]."""
        return math.hypot(2 * (self.axis + self.arm), self.lift, self.stagger)

    @property
    def lift(self) -> float:
        """Distance h of the two rods along the warps [m]."""
        return self.finger + self.clearance

    @property
    def stagger(self) -> float:
        """Distance s of the right arm before the left one, along the screw [m]."""
        return self.lift

    @property
    def wrap_radius(self) -> float:
        """Distance of the yarn's axis from that of a warp on which it lies [m]."""
        return (self.warp + self.yarn) / 2

    @property
    def warps(self) -> ComplexArray:
        """The pair in the opener's slots, and the nearest warps that it pushes aside [m]."""
        aside = self.axis + self.arm + self.finger / 2 + self.clearance + self.warp / 2
        return np.array([-aside, -self.pair / 2, self.pair / 2, aside]) + 0j

    @property
    def end(self) -> complex:
        """The left tip at the end of its path [m]."""
        return complex(self.tip(np.array(self.opening + self.crossing)))

    def turned(self, position: RealField) -> FloatArray:
        """Rotation of the side grippers by the screw [rad] at positions of their cam [m]."""
        return np.asarray(self.turn * np.clip((position - self.opening) / self.crossing, 0.0, 1.0))

    def tip(self, position: RealField, hand: int = -1) -> ComplexArray:
        """The left tip (hand -1) or the right one (+1) in plan view [m] at positions of the side grippers' cam [m]."""
        across = self.axis + self.arm * np.cos(self.turned(position))
        before = self.stagger if hand > 0 else 0.0
        return np.asarray(hand * across + 1j * (self.front + before + self.opening - position))

    def centre(self, position: RealField) -> ComplexArray:
        """The centre gripper's tip in plan view [m] at positions of its cam [m]."""
        return np.asarray(1j * (self.stroke - self.depth - position) + 0.0)

    @property
    def reach_bound(self) -> float:
        """Upper bound of the length of the left tip's path in plan view, for each metre of its cam's travel."""
        return math.hypot(1.0, self.arm * self.turn / self.crossing)


def grippers_for(params: WeaverParams, drawn: float) -> Grippers:
    """The grippers for a length of yarn drawn [m]; where it is too short for the ends to cross, they turn by pi."""
    axis, apart = axis_of(params), params.finger + params.clearance
    arm = max(math.sqrt(max((drawn - 2 * params.tail) ** 2 - 2 * apart**2, 0.0)) / 2 - axis, 0.0)
    loose = Grippers(
        pair=params.pair,
        warp=params.warp,
        yarn=params.yarn,
        finger=params.finger,
        clearance=params.clearance,
        axis=axis,
        arm=arm,
        opening=params.opening,
        crossing=params.crossing or crossing_of(params),
        turn=params.crossing_turn or _turn(arm, axis + params.overlap),
        depth=0.0,
        stroke=params.centre_stroke,
    )
    return replace(loose, depth=-crossing_point(loose).imag + params.yarn / 2)


def crossing_of(params: WeaverParams) -> float:
    """Travel along the screw that leaves the centre gripper room before the arms [m]."""
    share = params.pair / (params.pair + 2 * params.overlap)
    stagger = params.finger + params.clearance
    deep = (stagger + params.finger / 2 + params.clearance + params.yarn / 2) / (1 - share)
    front = (params.warp + params.finger) / 2 + params.clearance
    return front + (params.warp + params.yarn) / 2 + deep


def axis_of(params: WeaverParams) -> float:
    """Distance a of a side gripper's rod from the middle of the pair [m]."""
    return params.pair / 2 + params.warp / 2 + params.finger / 2 + params.clearance


def yarn_needed(params: WeaverParams) -> float:
    """The least yarn [m] with which the ends cross, and the yarn held is nowhere shorter than the taut yarn.

    A longer yarn has longer arms, whose ends need no more at the crossing: so bisection finds it. Where `crossing_turn`
    is given, the arms' ends may be anywhere, and no length may be enough: then only that they reach their warps.
    """
    axis = axis_of(params)
    reach = axis + (axis + params.overlap if params.crossing_turn is None else 0.0)
    low = math.hypot(2 * reach, math.sqrt(2) * (params.finger + params.clearance)) + 2 * params.tail
    if params.crossing_turn is not None or _reaches(params, low):
        return low
    high = 2 * low
    while not _reaches(params, high):
        low, high = high, 2 * high
    while high - low > YARN_TOLERANCE:
        middle = (low + high) / 2
        low, high = (low, middle) if _reaches(params, middle) else (middle, high)
    return high


def taut_max(grippers: Grippers) -> float:
    """The most yarn that is needed between the tips on their path [m]."""
    position = np.linspace(grippers.opening, grippers.opening + grippers.crossing, SAMPLES)
    return float(np.max(taut(grippers, position)))


def _reaches(params: WeaverParams, drawn: float) -> bool:
    grippers = grippers_for(params, drawn)
    return taut_max(grippers) <= grippers.apart + YARN_TOLERANCE


def taut(grippers: Grippers, position: FloatArray) -> FloatArray:
    """Length of the taut yarn between the tips [m] at positions of the side grippers' cam [m], going forward."""
    tips = [grippers.tip(position) + 1j * before for before in (0.0, grippers.stagger)]
    ends = [wrapped(grippers, tip) for tip in tips]
    front = front_of(grippers, tips, [wrap for _, wrap in ends])
    across = np.zeros(np.shape(position))
    for tip, (straight, wrap) in zip(tips, ends, strict=True):
        around = grippers.pair / 2 + grippers.wrap_radius * wrap + straight
        across += np.where(wrap <= 0, np.hypot(tip.real, tip.imag - front), around)
    return np.asarray(np.hypot(across, grippers.lift))


def front_of(grippers: Grippers, tips: Sequence[ComplexArray], wraps: Sequence[FloatArray]) -> FloatArray:
    """Where the taut yarn to both tips, the right one mirrored, passes the middle before the warps' axes [m]."""
    free = (wraps[0] <= 0) & (wraps[1] <= 0)
    return np.where(free, (tips[0].imag + tips[1].imag) / 2, grippers.wrap_radius)


def wrapped(grippers: Grippers, tip: ComplexArray, *, out: bool = False) -> tuple[FloatArray, FloatArray]:
    """The taut yarn from a warp to the left end at a tip [m]: its straight length [m], and the angle on the warp [rad].

    The angle counts from the warp's front by its outside; below 0 the yarn does not touch the warp.

    out  the end has come out between the warps again, or comes out
    """
    from_warp, first = tip + grippers.pair / 2, np.pi / 2 if out else 0.0
    straight = np.sqrt(np.maximum(np.abs(from_warp) ** 2 - grippers.wrap_radius**2, 0.0))
    heading = np.mod(np.angle(from_warp) - first, 2 * np.pi) + first  # from the row's direction on, by the front
    return straight, heading - np.arctan2(straight, grippers.wrap_radius) - np.pi / 2


def crossing_point(grippers: Grippers) -> complex:
    """The point at which the left end of the yarn, from its warp to its gripper at the end, crosses the middle [m].

    The yarn leaves its warp near the point behind it, -g/2 - i r; of a tip that is not past the middle, the tip itself.
    """
    tip, leaves = grippers.end, complex(-grippers.pair / 2, -grippers.wrap_radius)
    if tip.real <= 0:
        return tip
    share = -leaves.real / (tip.real - leaves.real)
    return complex(0.0, leaves.imag + share * (tip.imag - leaves.imag))


def clearance_min(grippers: Grippers) -> float:
    """Least clearance of a side gripper and its warp [m] along the screw; below 0 they overlap."""
    position = np.linspace(0.0, grippers.opening + grippers.crossing, SAMPLES)
    tip = np.concatenate([grippers.tip(position), grippers.tip(position) + 1j * grippers.stagger])
    inner = np.maximum(tip.real, -grippers.axis)  # the arm reaches from the rod to the tip, across
    outer = np.minimum(tip.real, -grippers.axis)
    nearest = np.clip(-grippers.pair / 2, outer, inner)
    arm = float(np.min(np.hypot(nearest + grippers.pair / 2, tip.imag)))
    rod = grippers.axis - grippers.pair / 2
    return min(arm, rod) - (grippers.warp + grippers.finger) / 2


def _turn(arm: float, beyond: float) -> float:
    """The rotation [rad] that brings the end of an arm beyond its rod's axis by a distance [m]; at most pi."""
    return math.acos(max(-beyond / arm, -1.0)) if arm > 0 else math.pi
