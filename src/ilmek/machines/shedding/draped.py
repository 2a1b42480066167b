"""The warp as the taut yarn that it is: draped over the turning cam, over its hollows, from hold to hold.

The knife edge of the thesis rides on the follower's line alone. A yarn lies on the cam's convex hull: it bridges what
is hollow, and where the nose stands before or behind the follower's line it is lifted there already. Between the holds
A and B, at (Rp, a) and (Rp, -b) of the follower's line, it is as long as

    l = |A P| + arc of the hull from P to Q + |Q B|,     P, Q where the tangents from A and B touch

Without friction its pull on the cam is T along both tangents: torque T (P x (A-P)/|A-P| + Q x (B-Q)/|B-Q|), which is
T dl/dtheta. The cam is taken as a polygon of points half a degree apart.                      [derived; virtual work]
"""

import math
from dataclasses import dataclass

import numpy as np

from ilmek.arrays import ComplexArray, FloatArray, IntArray
from ilmek.cams.limits import PlateCam
from ilmek.cams.programme import TURN
from ilmek.machines.shedding.params import SheddingParams
from ilmek.machines.shedding.phases import Shed
from ilmek.machines.shedding.warp import taut

POINTS = 720
SHOWN = 1e-6
"""Lift by which bridging must exceed the cam's to be said [m]."""


@dataclass(frozen=True, slots=True)
class Bridged:
    """Cam angles [rad] where the hull leaves the cam, and the most that it lifts a warp above the law's [m]."""

    arcs: tuple[tuple[float, float], ...]
    excess: float
    at: float


@dataclass(frozen=True, slots=True)
class Draped:
    """A warp draped over its cam, at shaft angles `angle` of one turn [rad].

    longer  than from hold to hold [m]      torque  of one warp on the shaft [N m]      wrap  angle on the cam [rad]
    pressure_max  of the yarn on the nose [N/m]      lifted  part of the turn for which it leaves its line [rad]
    """

    angle: FloatArray
    longer: FloatArray
    torque: FloatArray
    wrap: FloatArray
    tension: FloatArray
    lifted: float


def hull(points: ComplexArray) -> IntArray:
    """Places of the points on the convex hull, counter-clockwise from the leftmost [Andrew's monotone chain]."""
    order = np.lexsort((points.imag, points.real)).tolist()
    plane = points.tolist()
    lower, upper = _chain(plane, order), _chain(plane, order[::-1])
    return np.array(lower[:-1] + upper[:-1])


def _chain(plane: list[complex], order: list[int]) -> list[int]:
    kept: list[int] = []
    for place in order:
        while len(kept) > 1 and _turn(plane[kept[-2]], plane[kept[-1]], plane[place]) <= 0:
            kept.pop()
        kept.append(place)
    return kept


def _turn(a: complex, b: complex, c: complex) -> float:
    return ((b - a).conjugate() * (c - b)).imag


def bridged(cam: PlateCam) -> Bridged | None:
    """What a yarn bridges of the cam; None where the cam is convex all round."""
    angle = np.arange(POINTS) * (TURN / POINTS)
    surface = cam.surface(angle)
    kept = np.sort(hull(surface))
    gaps = np.flatnonzero(np.diff(np.append(kept, kept[0] + POINTS)) > 1)
    arcs, excess, at = [], 0.0, 0.0
    for gap in gaps.tolist():
        first, last = int(kept[gap]), int(kept[(gap + 1) % kept.size])
        last += POINTS if last < first else 0
        inside = np.arange(first + 1, last) % POINTS
        over = _above(surface[inside], surface[first % POINTS], surface[last % POINTS])
        most = int(np.argmax(over))
        if over[most] > SHOWN:
            arcs.append((float(angle[first]), float(angle[last % POINTS])))
            excess, at = max((excess, at), (float(over[most]), float(angle[inside[most]])))
    return Bridged(tuple(arcs), excess, at) if arcs else None


def _above(points: ComplexArray, first: complex, last: complex) -> FloatArray:
    """How much farther out than the points the chord is, along the rays through them [m]."""
    along = last - first
    rays = points / np.abs(points)
    # The ray t u meets the chord where t u - first is along the chord.
    reach = (first.conjugate() * along).imag / (np.conj(rays) * along).imag
    return np.asarray(reach - np.abs(points))


def draped(params: SheddingParams, cam: PlateCam) -> Draped | None:
    """The warp draped over the cam; None where its holds are not known, or stand within the reach of the nose."""
    warp = taut(params)
    if warp is None:
        return None
    angle = np.arange(0, POINTS, 2) * (TURN / POINTS)
    surface = cam.surface(np.arange(POINTS) * (TURN / POINTS))
    line = cam.prime_radius - cam.roller_radius
    front, back = complex(line, warp.front), complex(line, -warp.back)
    if min(abs(front), abs(back)) <= float(np.max(np.abs(surface))):
        return None
    ring = surface[hull(surface)]
    along = np.concatenate([[0.0], np.cumsum(np.abs(np.diff(ring)))])
    round_it = float(along[-1] + abs(ring[0] - ring[-1]))
    turned = ring * np.exp(1j * angle)[:, None]
    from_front, from_back = turned - front, turned - back
    leans = np.arctan2(from_front.real, -from_front.imag), np.arctan2(from_back.real, from_back.imag)
    touch = np.argmax(leans[0], axis=1), np.argmax(leans[1], axis=1)
    row = np.arange(angle.size)
    steep = leans[0][row, touch[0]], leans[1][row, touch[1]]
    # The ring runs counter-clockwise: from where the yarn from behind touches to where the one from in front does.
    arc = np.mod(along[touch[0]] - along[touch[1]], round_it)
    longer = np.abs(from_front[row, touch[0]]) + arc + np.abs(from_back[row, touch[1]]) - (warp.front + warp.back)
    off = (steep[0] > 0) & (steep[1] > 0) & (longer > 0)
    longer = np.where(off, longer, 0.0)
    tension = warp.tension + warp.rate * longer
    lever = sum(_moment(turned[row, at], hold) for at, hold in zip(touch, (front, back), strict=True))
    return Draped(
        angle=angle,
        longer=longer,
        torque=np.where(off, -tension * lever, 0.0),
        wrap=np.where(off, steep[0] + steep[1], 0.0),
        tension=tension,
        lifted=float(np.mean(longer > LEAST_LENGTHENING)) * TURN,
    )


LEAST_LENGTHENING = 1e-6
"""Lengthening from which a draped warp counts as lifted [m]."""


def _moment(at: ComplexArray, hold: complex) -> FloatArray:
    """Moment about the cam's axis of a unit pull at points towards a hold [m]."""
    pull = (hold - at) / np.abs(hold - at)
    return np.asarray((np.conj(at) * pull).imag)


def stack_torque(shed: Shed, one: Draped) -> FloatArray:
    """Torque of all draped warps [N m] at `one.angle`."""
    total = np.zeros_like(one.angle)
    for parity, later in ((shed.even, 0.0), (shed.odd, TURN / 2)):
        for number, offset in zip(parity.numbers, shed.offsets, strict=True):
            total += number * np.interp(one.angle - later - offset, one.angle, one.torque, period=TURN)
    return total


def nose_radius(cam: PlateCam) -> float:
    """Radius of curvature of the cam's surface where it stands out farthest [m]."""
    angle = np.linspace(0.0, TURN, POINTS, endpoint=False)
    at = angle[int(np.argmax(np.abs(cam.surface(angle))))]
    return 1 / float(cam.curvature(np.array(at))) - cam.roller_radius


def capstan(friction: float, wrap: float) -> float:
    """Ratio of the tensions before and behind the cam at which the warp slips on it: e^(f wrap).   [Euler, Eytelwein]

    >>> capstan(0.0, 1.0)
    1.0
    """
    return math.exp(friction * wrap)
