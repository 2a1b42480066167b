"""Clearances of everything that moves from the warps, the other arm and the centre gripper, over the whole cycle.

Links and needles are bars with round ends, warps are discs, all exact. A least distance over the path is found by
bisection: no point of an arm moves faster than V by s (`Arm.speed_bound`), so over an interval of half length e the
distance is no less than f - V e, f that at its middle. Intervals that cannot go below the least distance found so far
by more than the tolerance are dropped; the others are halved. The result is a distance that occurs, and none is less
by more than the tolerance.

For both arms the interval is a rectangle: s_left = u (1 - v) and s_right = u v, 0 <= u, v <= 1, are all their positions
with s_left + s_right <= 1, however they are timed, and the distance changes by V at most by u, by 2 V at most by v.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ilmek.arrays import Complex, Float, FloatArray
from ilmek.machines.knotting_dyad.arm_path import Arm
from ilmek.machines.knotting_dyad.section import WarpSection
from ilmek.plane.outlines import between, to_segments
from ilmek.records import record

TOLERANCE, RELATIVE = 1e-6, 5e-3
"""Absolute [m] and relative tolerance of a least distance."""

PIECES, MOST = 16, 60_000
"""Intervals at first in each direction; intervals at most, after which the tolerance is not met."""


@dataclass(frozen=True, slots=True)
class LeastDistance:
    """A least distance.

    name   of what, from what        value  [m], below 0 where they overlap
    at     s there, one for each arm that matters
    sure   tolerance: how much less it might be at most [m]
    """

    name: str
    value: float
    at: tuple[float, ...]
    sure: float


@record
class RoundBars:
    """Bars with round ends: (positions, bars) ends [m], and the radii of each [m]."""

    starts: Complex[np.ndarray, "n bars"]
    ends: Complex[np.ndarray, "n bars"]
    radii: Float[np.ndarray, " bars"]


def arm_bars(section: WarpSection, arm: Arm, s: Float[np.ndarray, " n"]) -> RoundBars:
    """The left arm: first link, wide part of the second, needle."""
    elbow, tip = arm.elbow(s), arm.tip(s)
    wide = tip + section.needle_length * (elbow - tip) / arm.second
    pivot = np.full(len(s), arm.pivot)
    radii = np.array([section.width, section.width, section.needle]) / 2
    return RoundBars(np.stack([pivot, elbow, wide], -1), np.stack([elbow, wide, tip], -1), radii)


def centre_bars(section: WarpSection, tip: Float[np.ndarray, " n"], top: float) -> RoundBars:
    """The centre gripper with its tip at these heights [m]: needle and wide part, up to a height."""
    low = section.middle + 1j * tip
    wide = low + 1j * section.needle_length
    high = np.full(len(tip), complex(section.middle, top))
    return RoundBars(
        np.stack([low, wide], -1), np.stack([wide, high], -1), np.array([section.needle, section.width]) / 2
    )


def mirrored_bars(section: WarpSection, bars: RoundBars) -> RoundBars:
    """The same of the right arm."""
    twice = 2 * section.middle
    return RoundBars(twice - np.conj(bars.starts), twice - np.conj(bars.ends), bars.radii)


def to_warps(section: WarpSection, bars: RoundBars) -> Float[np.ndarray, " n"]:
    """Least distance of the bars from any warp [m], at each position."""
    apart = to_segments(section.warps, bars.starts[..., None], bars.ends[..., None])
    least: Float[np.ndarray, " n"] = np.min(apart - bars.radii[:, None], axis=(-2, -1)) - section.warp / 2
    return least


def apart(one: RoundBars, other: RoundBars, but: tuple[int, int] | None = None) -> Float[np.ndarray, " n"]:
    """Least distance of two sets of bars [m], at each position; `but` a pair of them that meets on purpose."""
    pairs = [
        between(np.stack([one.starts[:, i], one.ends[:, i]], -1), np.stack([other.starts[:, j], other.ends[:, j]], -1))
        - one.radii[i]
        - other.radii[j]
        for i in range(len(one.radii))
        for j in range(len(other.radii))
        if (i, j) != but
    ]
    least: Float[np.ndarray, " n"] = np.min(np.stack(pairs), axis=0)
    return least


def clearances(section: WarpSection, arm: Arm) -> tuple[LeastDistance, ...]:
    """All least distances of a cycle; the right arm's are the left arm's, mirrored with the warps."""
    speed = arm.speed_bound

    def warps(at: FloatArray) -> FloatArray:
        return to_warps(section, arm_bars(section, arm, at[:, 0]))

    def arms(at: FloatArray) -> FloatArray:
        left, right = at[:, 0] * (1 - at[:, 1] / 2), at[:, 0] * at[:, 1] / 2  # by symmetry v <= 1/2
        return apart(arm_bars(section, arm, left), mirrored_bars(section, arm_bars(section, arm, right)))

    found = least("arms to warps", warps, (speed,))
    both = least("arm to arm", arms, (speed, speed))
    u, v = both.at
    centre = float(section.pitch / 2 - (section.warp + section.needle) / 2)
    return (
        found,
        LeastDistance(both.name, both.value, (u * (1 - v / 2), u * v / 2), both.sure),
        LeastDistance("centre gripper to warps", centre, (), 0.0),
        *_centre(section, arm),
    )


def _centre(section: WarpSection, arm: Arm) -> tuple[LeastDistance, ...]:
    """The centre gripper and an arm: at rest while the arm moves, moving while it is at the hand-over or at rest."""
    top = max(arm.pivot.imag, float(np.max(arm.elbow(np.linspace(0, 1, 33)).imag))) + 2 * arm.first
    high = max(top, section.front + 2 * section.needle_length)
    stroke = section.front + section.depth

    def waiting(at: FloatArray) -> FloatArray:
        rest = centre_bars(section, np.full(len(at), section.front), high)
        return apart(arm_bars(section, arm, at[:, 0]), rest)

    def coming(s: float, but: tuple[int, int] | None) -> Callable[[FloatArray], FloatArray]:
        def at_height(at: FloatArray) -> FloatArray:
            moving = centre_bars(section, section.front - at[:, 0] * stroke, high)
            return apart(arm_bars(section, arm, np.full(len(at), s)), moving, but)

        return at_height

    # At the hand-over the needles meet; their wide parts must not.
    return (
        least("centre gripper at rest to an arm", waiting, (arm.speed_bound,)),
        least("centre gripper to an arm at the hand-over, but for the tips", coming(1.0, (2, 0)), (stroke,)),
        least("centre gripper to an arm at rest", coming(0.0, None), (stroke,)),
    )


def least(name: str, f: Callable[[FloatArray], FloatArray], speeds: tuple[float, ...]) -> LeastDistance:
    """The least value of f over the unit cube, whose points are its rows; f changes by speeds at most [m].

    >>> found = least("x", lambda at: np.abs(at[:, 0] - 0.3), (1.0,))
    >>> round(found.value, 5), round(found.at[0], 5), found.sure < 2e-6
    (0.0, 0.3, True)
    """
    bound, size = np.array(speeds), len(speeds)
    grid = np.meshgrid(*[(np.arange(PIECES) + 0.5) / PIECES] * size, indexing="ij")
    middles, half = np.stack([axis.ravel() for axis in grid], axis=-1), 0.5 / PIECES
    corners = np.stack([axis.ravel() for axis in np.meshgrid(*[np.array([0.0, 1.0])] * size, indexing="ij")], axis=-1)
    value, at, spent = np.inf, middles[0], 0
    for points in (corners, middles):
        values = f(points)
        if np.min(values) < value:
            value, at = float(np.min(values)), points[np.argmin(values)]
    while True:
        lows = values - half * float(np.sum(bound))
        tolerance = TOLERANCE + RELATIVE * abs(value)
        kept = lows < value - tolerance
        spent += len(middles)
        if not kept.any() or spent > MOST:
            sure = max(value - float(np.min(lows)), tolerance)
            return LeastDistance(name, value, tuple(float(one) for one in at), sure)
        half /= 2
        middles = (middles[kept][:, None, :] + half * (2 * corners - 1)).reshape(-1, size)
        values = f(middles)
        if np.min(values) < value:
            value, at = float(np.min(values)), middles[np.argmin(values)]
