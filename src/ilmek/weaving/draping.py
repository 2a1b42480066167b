"""A warp as a taut yarn draped over a rotating cam, between two fixed points.

A knife-edge follower touches the cam on its line only. A yarn lies on the convex hull of the cam: it bridges concave
parts, and the nose lifts it already in front of and behind the follower's line. Between the fixed points A and B, at
R + i a and R - i b with the follower's line along the real axis, the length of the yarn is

    l = |A - P| + arc of the hull from P to Q + |Q - B|,     P, Q where the tangents from A and B touch

Without friction it pulls on the cam with T along both tangents. Its torque T (P x (A-P)/|A-P| + Q x (B-Q)/|B-Q|) is
T dl/dtheta. The cam is approximated by the polygon of its points.                              [derived; virtual work]
"""

from dataclasses import dataclass

import numpy as np

from ilmek.arrays import Complex, ComplexArray, Float, FloatArray
from ilmek.plane.curves import hull_indices
from ilmek.units import turn
from ilmek.weaving.shed import ShedWarp

LEAST_BRIDGE = 1e-6
"""Least height of a reported bridge above the cam [m]."""

LEAST_LENGTHENING = 1e-6
"""Least lengthening of a lifted warp [m]."""


@dataclass(frozen=True, slots=True)
class Bridges:
    """Bridges of a yarn over a cam.

    arcs    cam angles [rad] between which the hull leaves the cam, start and end of each
    excess  largest height of a bridge above the cam [m]       at  its cam angle [rad]
    """

    arcs: tuple[tuple[float, float], ...]
    excess: float
    at: float


@dataclass(frozen=True, slots=True, eq=False)
class DrapedWarp:
    """A warp draped over its cam, over one turn; all arrays have the shape of `angle`.

    angle         of the cam [rad]                  wrap    angle of wrap on the cam [rad]
    lengthening   of the warp between its fixed points [m]      tension of the warp [N]
    torque        of the warp on the shaft [N m]    lifted  angle of the turn over which the warp is lifted [rad]
    """

    angle: FloatArray
    lengthening: FloatArray
    torque: FloatArray
    wrap: FloatArray
    tension: FloatArray
    lifted: float


def bridges(surface: Complex[np.ndarray, " points"]) -> Bridges | None:
    """Bridges of a yarn over a cam; None where the cam is convex all round.

    surface  points of the cam [m] about its axis, at cam angles evenly over a turn from 0
    """
    count = len(surface)
    angle = np.arange(count) * (turn / count)
    kept = np.sort(hull_indices(surface))
    gaps = np.flatnonzero(np.diff(np.append(kept, kept[0] + count)) > 1)
    arcs, excess, at = [], 0.0, 0.0
    for gap in gaps.tolist():
        first, last = int(kept[gap]), int(kept[(gap + 1) % kept.size])
        last += count if last < first else 0
        inside = np.arange(first + 1, last) % count
        over = _above(surface[inside], surface[first % count], surface[last % count])
        most = int(np.argmax(over))
        if over[most] > LEAST_BRIDGE:
            arcs.append((float(angle[first]), float(angle[last % count])))
            excess, at = max((excess, at), (float(over[most]), float(angle[inside[most]])))
    return Bridges(tuple(arcs), excess, at) if arcs else None


def _above(points: ComplexArray, first: complex, last: complex) -> FloatArray:
    """Height of the chord above points, along the rays through them [m]."""
    along = last - first
    rays = points / np.abs(points)
    # The ray t u meets the chord where t u - first is along the chord.
    reach = (first.conjugate() * along).imag / (np.conj(rays) * along).imag
    return np.asarray(reach - np.abs(points))


def draped_warp(
    surface: Complex[np.ndarray, " points"], warp: ShedWarp, radius: float, angle: Float[np.ndarray, " angles"]
) -> DrapedWarp | None:
    """A warp draped over a cam; None where a fixed point of the warp is within the reach of the nose.

    surface  points of the cam [m] about its axis at cam angle 0      warp   with its fixed points and tension
    radius   R of the cam's base circle, on which the warp rests [m]  angle  of the cam, even over a turn [rad]
    """
    front, back = complex(radius, warp.front), complex(radius, -warp.back)
    if min(abs(front), abs(back)) <= float(np.max(np.abs(surface))):
        return None
    ring = surface[hull_indices(surface)]
    along = np.concatenate([[0.0], np.cumsum(np.abs(np.diff(ring)))])
    circumference = float(along[-1] + abs(ring[0] - ring[-1]))
    turned = ring * np.exp(1j * angle)[:, None]
    from_front, from_back = turned - front, turned - back
    leans = np.arctan2(from_front.real, -from_front.imag), np.arctan2(from_back.real, from_back.imag)
    touch = np.argmax(leans[0], axis=1), np.argmax(leans[1], axis=1)
    row = np.arange(angle.size)
    steep = leans[0][row, touch[0]], leans[1][row, touch[1]]
    # The ring runs counter-clockwise, from the contact of the rear side of the yarn to that of the front side.
    arc = np.mod(along[touch[0]] - along[touch[1]], circumference)
    longer = np.abs(from_front[row, touch[0]]) + arc + np.abs(from_back[row, touch[1]]) - (warp.front + warp.back)
    off = (steep[0] > 0) & (steep[1] > 0) & (longer > 0)
    longer = np.where(off, longer, 0.0)
    tension = warp.tension + warp.rate * longer
    lever = sum(_moment(turned[row, at], hold) for at, hold in zip(touch, (front, back), strict=True))
    return DrapedWarp(
        angle=angle,
        lengthening=longer,
        torque=np.where(off, -tension * lever, 0.0),
        wrap=np.where(off, steep[0] + steep[1], 0.0),
        tension=tension,
        lifted=float(np.mean(longer > LEAST_LENGTHENING)) * turn,
    )


def _moment(at: ComplexArray, hold: complex) -> FloatArray:
    """Moment arm about the cam's axis of a pull at points towards a fixed point [m]."""
    pull = (hold - at) / np.abs(hold - at)
    return np.asarray((np.conj(at) * pull).imag)
