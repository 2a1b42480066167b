"""Jerk-limited moves of the head beside its cams, from rest to rest: of the carriage along the row, of the tubes."""

import math

from ilmek.machines.weaver.params import WeaverParams
from ilmek.timing.s_curve import AxisLimits, move_time


def carriage(params: WeaverParams) -> AxisLimits:
    """Limits of the carriage."""
    return AxisLimits(params.carriage_speed, params.carriage_acceleration, params.carriage_jerk)


def selector(params: WeaverParams) -> AxisLimits:
    """Limits of the colour selector."""
    return AxisLimits(params.selector_speed, params.selector_acceleration, params.selector_jerk)


def step_time(params: WeaverParams) -> float:
    """Time of the carriage's step to the next knot [s]."""
    return move_time(params.knot_pitch, carriage(params))


def travel_time(params: WeaverParams, window: float) -> float:
    """Time t of each further pitch of a longer move [s], such that no move of d pitches p takes longer than this:

        move_time(d p) <= W + (d - 1) t   for every d,   W = max(window, move_time(p))

    Where the window [s] is long enough for start and stop, t is p / v; a shorter one lengthens t. move_time is concave
    in the distance, so that the t required for d pitches, (move_time(d p) - W)/(d - 1), rises to one maximum and then
    falls, and bisection finds it; beyond the distance at which the speed is reached it only tends to p / v.
    """
    limits, pitch = carriage(params), params.knot_pitch
    room = max(window, step_time(params))

    def required(pitches: int) -> float:
        return (move_time(pitches * pitch, limits) - room) / (pitches - 1)

    low, high = 2, 2 + math.ceil(_reach(limits) / pitch)
    while low < high:
        middle = (low + high) // 2
        low, high = (middle + 1, high) if required(middle + 1) > required(middle) else (low, middle)
    return max(pitch / limits.speed, required(low))


def _reach(limits: AxisLimits) -> float:
    """A distance from which on a move reaches its speed [m]."""
    ramp, hold = math.sqrt(limits.speed / limits.jerk), limits.speed / limits.acceleration
    return limits.speed * max(2 * ramp, hold + limits.acceleration / limits.jerk)


def colour_change_time(params: WeaverParams) -> float:
    """Mean time to bring another tube in line [s]; none for a single tube.

    Of the n (n - 1) / 2 pairs of tubes in a line, n - d are d pitches apart.
    """
    n, limits = params.tubes, selector(params)
    total = sum((n - d) * move_time(d * params.tube_pitch, limits) for d in range(1, n))
    return total / max(n * (n - 1) / 2, 1)


def colour_change_longest(params: WeaverParams) -> float:
    """Time to bring the last tube in line after the first [s]; none for a single tube."""
    return move_time((params.tubes - 1) * params.tube_pitch, selector(params))
