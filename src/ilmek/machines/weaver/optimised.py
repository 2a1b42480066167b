"""The head's motions stretched and overlapped within their order: the quickest cycle, or the least accelerations.

Both are what `timing.solver` finds: the shortest cycle that the tools' limits allow; where that is shorter than the one
asked for, the cyclogram of the asked one whose largest acceleration, over its limit, is least. The cutter's angle goes
with the cycle: it is put in anew until the cycle stays.
"""

from collections.abc import Mapping
from dataclasses import replace

from ilmek.machines.weaver.cyclogram import relations
from ilmek.timing.cyclogram import Cyclogram
from ilmek.timing.solver import least_acceleration, least_period
from ilmek.timing.track import ActuatorLimits
from ilmek.units import turn

_TURNS, _SAME = 20, 1e-9


def optimised(cyclogram: Cyclogram, limits: Mapping[str, ActuatorLimits], gap: float, cutting: float) -> Cyclogram:
    """The cyclogram with the same motions at better cam angles, at its period, or at the shortest that is possible.

    limits  of each track      gap  of motions in sequence [rad]      cutting  time that the cutter needs [s]
    """
    tracks = tuple(replace(track, limits=limits[track.name]) for track in cyclogram.tracks)
    limited = replace(cyclogram, tracks=tracks)
    shortest = _quickest(limited, gap, cutting)
    if shortest.period >= cyclogram.period:
        return replace(shortest, period=shortest.period * (1 + _SAME))
    return least_acceleration(_ordered(limited, gap, cutting, cyclogram.period)).cyclogram


def _quickest(limited: Cyclogram, gap: float, cutting: float) -> Cyclogram:
    """The shortest cycle in which the cutter has its time."""
    found = least_period(_ordered(limited, gap, 0.0, 1.0)).cyclogram
    for _ in range(_TURNS):
        then = least_period(_ordered(limited, gap, cutting, found.period)).cyclogram
        if abs(then.period - found.period) <= _SAME * found.period:
            break
        found = then
    return then


def _ordered(limited: Cyclogram, gap: float, cutting: float, period: float) -> Cyclogram:
    return replace(limited, relations=relations(gap, cutting / period * turn))
