"""Roberts-Chebyshev cognates: the three four-bars with the same coupler curve.

    z = (P - A) / (B - A)        C0 = A0 + z (B0 - A0)        the third ground pivot

    on C0 and B0    crank C0-C = (1 - z)(A - A0),   rocker B0-B' = P - B       rotate as crank, coupler of the original
    on A0 and C0    crank A0-A' = P - A,            rocker C0-C' = z (B - B0)  rotate as coupler, rocker

Proof: all vectors are constant multiples of the original's links, so that the sums A0 + ... = P close in every
position. The links of the first cognate are |1 - z| times those of the original, those of the second |z| times, in
another order. With a tracer on the line A-B (z real) the three ground pivots are in line.
[Roberts, On three-bar motion in plane space, 1875; Hartenberg and Denavit, Kinematic Synthesis of Linkages, chapter 6.]
"""

from typing import NamedTuple

from ilmek.errors import MechanismError
from ilmek.synthesis.four_bar import FourBar

SAME = 1e-12
"""Distance of the tracer from a moving pin, relative to the coupler, below which they coincide."""


class Cognates(NamedTuple):
    """Four-bars with one coupler curve, drawn at one position.

    original  as given
    timed     crank on the third pivot; it rotates as the original's crank, so the timing of the path is the same
    other     crank on A0; it rotates as the original's coupler
    third     ground pivot C0 [m]

    `timed` is None where the tracer is the pin B, `other` where it is the pin A: the curve is then a circle about a
    pivot and the cognate degenerates to a point.
    """

    original: FourBar
    timed: FourBar | None
    other: FourBar | None
    third: complex


def cognates(four_bar: FourBar) -> Cognates:
    """The cognates of a four-bar with a tracer, drawn at the same position [m].

    Raises MechanismError for a four-bar without tracer.

    >>> drawn = cognates(FourBar(0j, 4 + 0j, 1j, 3 + 3j, tracer=2 + 3j))
    >>> [kind.grashof.kind for kind in (drawn.original, drawn.timed, drawn.other)]
    ['crank-rocker', 'crank-rocker', 'double-rocker']
    """
    a0, b0, a, b, tracer = four_bar.a0, four_bar.b0, four_bar.a, four_bar.b, four_bar.tracer
    if tracer is None:
        raise MechanismError("the four-bar has no tracer", do="give the tracer, a point of the coupler")
    z = (tracer - a) / (b - a)
    third = a0 + z * (b0 - a0)
    timed = FourBar(third, b0, third + (1 - z) * (a - a0), b0 + (tracer - b), tracer) if abs(1 - z) > SAME else None
    other = FourBar(a0, third, a0 + (tracer - a), third + z * (b - b0), tracer) if abs(z) > SAME else None
    return Cognates(four_bar, timed, other, third)
