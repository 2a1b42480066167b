"""Clearances of everything that moves from the warps, the other arm and the centre gripper, over the whole cycle.

Links and needles are bars with round ends, warps are discs, all exact. Least distances over the path:
`plane.round_bars`, by the bound V of the speed of every point of an arm by s, `SwivelledArm.speed_bound`.

For both arms the interval is a rectangle: s_left = u (1 - v) and s_right = u v, 0 <= u, v <= 1, are all their positions
with s_left + s_right <= 1, however they are timed, and the distance changes by V at most by u, by 2 V at most by v.
"""

from collections.abc import Callable

import numpy as np

from ilmek.arrays import Float, FloatArray
from ilmek.linkage.swivelled_arm import SwivelledArm
from ilmek.machines.knotting_dyad.section import WarpSection
from ilmek.plane.outlines import to_segments
from ilmek.plane.round_bars import LeastDistance, RoundBars, apart, least


def arm_bars(section: WarpSection, arm: SwivelledArm, s: Float[np.ndarray, " n"]) -> RoundBars:
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


def clearances(section: WarpSection, arm: SwivelledArm) -> tuple[LeastDistance, ...]:
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
    centre = float(section.pair / 2 - (section.warp + section.needle) / 2)
    return (
        found,
        LeastDistance(both.name, both.value, (u * (1 - v / 2), u * v / 2), both.sure),
        LeastDistance("centre gripper to warps", centre, (), 0.0),
        *_centre(section, arm),
    )


def _centre(section: WarpSection, arm: SwivelledArm) -> tuple[LeastDistance, ...]:
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
