"""Warps that an opener pushes aside: how far each goes, the force on the opener, and their tension.

Warps of the diameter D stand at the pitch p, each a string of the tension T between two holds, a in front of the opener
and b behind it. The wall pushes the nearest warp aside by e. A warp that touches the next one pushes it on, so that the
k-th from the wall goes

    d_k = max(e - k (p - D), 0),     k = 0, 1, 2 ...

and the first that does not move stands between ceil(e / (p - D)) warps pushed together and all others. A displaced warp
of the stiffness EA and the length L from cylinder to cylinder is longer by u, tighter by EA u / L, and pushes back

    u = sqrt(a² + d²) - a + sqrt(b² + d²) - b,     t = T + EA u / L,     f = t (d / sqrt(a² + d²) + d / sqrt(b² + d²))

All displaced warps grow by the same step, so the force on the wall is the sum of f, the derivative of the energy
T u + EA u² / 2 L of all of them by e.                            [derived: string with tension, contact of round warps]
"""

import math

import numpy as np

from ilmek.arrays import Float, FloatArray
from ilmek.records import record

MOST = 4000
"""Most warps on one side that are looked at: more than any loom has in the width of a head."""


@record
class WarpSpans:
    """A warp as a string: tension [N], stiffness EA [N], length from cylinder to cylinder, and from the opener to the
    holds in front of it and behind it [m].
    """

    tension: float
    stiffness: float
    length: float
    front: float
    back: float


def shifts(aside: float, pitch: float, diameter: float) -> Float[np.ndarray, " warps"]:
    """How far each warp beside the opener's wall goes [m], the nearest first; empty where the wall pushes none.

    aside  by which the wall displaces the nearest warp [m]      pitch, diameter  of the warps [m]
    Warps as thick as their pitch have no gaps to give: they count as MOST, all displaced alike.

    >>> shifts(2.5e-3, 2e-3, 1e-3).round(6).tolist()
    [0.0025, 0.0015, 0.0005]
    """
    if aside <= 0:
        return np.empty(0)
    gap = pitch - diameter
    number = min(math.ceil(aside / gap - 1e-9), MOST) if gap > 0 else MOST
    return np.asarray(aside - max(gap, 0.0) * np.arange(number))


def tension_of(shift: FloatArray, warp: WarpSpans) -> FloatArray:
    """Tension of displaced warps [N], any shape."""
    longer = np.hypot(warp.front, shift) - warp.front + np.hypot(warp.back, shift) - warp.back
    return np.asarray(warp.tension + warp.stiffness * longer / warp.length)


def force_of(shift: FloatArray, warp: WarpSpans) -> FloatArray:
    """Force of displaced warps against their displacement [N], any shape."""
    slopes = shift / np.hypot(warp.front, shift) + shift / np.hypot(warp.back, shift)
    return np.asarray(tension_of(shift, warp) * slopes)


def wall_force(aside: float, pitch: float, diameter: float, warp: WarpSpans) -> float:
    """Force of all warps on one side against the opener's wall [N].

    >>> one = WarpSpans(10.0, 0.0, 1.0, 0.1, 0.1)
    >>> round(wall_force(1e-3, 2e-3, 1e-3, one), 4)  # a single warp: 2 T d / a
    0.2
    """
    return float(np.sum(force_of(shifts(aside, pitch, diameter), warp)))
