"""A warp over its cam: how far it lengthens, its tension, its force across the cam, the work in it.

Held a in front of the cam and b behind it, lifted by s between:

    dL = (sqrt(a^2 + s^2) - a) + (sqrt(b^2 + s^2) - b),      d(dL)/ds = s / sqrt(a^2 + s^2) + s / sqrt(b^2 + s^2)
    T  = T0 + (1 - c) (EA / l) dL,      F = T d(dL)/ds,      W = T0 dL + (1 - c) (EA / l) dL^2 / 2

c the share that the warp cylinder gives way by, l the length that stretches. c = 1, or no stiffness given, is a tension
that does not change. Without friction on the cam F is exact for both sides, whatever their lengths.

Cotton yarn breaks at 17 cN/tex and 7 to 8 % (ring-spun, carded, Ne 6 to 20 [Elmogahzy and Chewning 2001, in Handbook of
Properties of Textile and Technical Fibres, table 7.3]): EA is about 2.1 N/tex, 1.8 kN for the 857 tex of a 2 mm pitch.
"""

from dataclasses import dataclass

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.machines.shedding.params import WarpParams


@dataclass(frozen=True, slots=True)
class Taut:
    """A warp with a tension: at rest [N], spans in front and behind [m], what tension gains by length [N/m]."""

    tension: float
    front: float
    back: float
    rate: float

    def lengthening(self, s: FloatArray) -> FloatArray:
        """Lengthening dL [m] at lifts [m]; s^2 / (hypot + a) for the difference, which would lose small lifts."""
        return np.asarray(sum(s**2 / (np.hypot(s, span) + span) for span in (self.front, self.back)))

    def lever(self, s: FloatArray) -> FloatArray:
        """d(dL)/ds: sines of the warp's slopes in front and behind, added."""
        return np.asarray(s / np.hypot(s, self.front) + s / np.hypot(s, self.back))

    def tension_at(self, s: FloatArray) -> FloatArray:
        """T [N] at lifts [m]."""
        return np.asarray(self.tension + self.rate * self.lengthening(s))


def taut(params: WarpParams) -> Taut | None:
    """The warp with its tension; None where only its force across the cam is given."""
    spans = params.spans_of_warp
    if params.tension is None or spans is None:
        return None
    length = params.warp_length or sum(spans)
    rate = (1 - params.compensation) * (params.warp_stiffness or 0.0) / length
    return Taut(params.tension, spans[0], spans[1], rate)


def warp_force(params: WarpParams, s: FloatArray) -> FloatArray:
    """Force [N] of a warp across the cam at a lift [m]: as given, or from its tension."""
    warp = taut(params)
    if warp is None:
        return np.full_like(s, params.warp_force)
    return np.asarray(warp.tension_at(s) * warp.lever(s))


def lifting_work(params: WarpParams) -> float:
    """Work [J] of lifting one warp: F L, or what stretches it."""
    warp = taut(params)
    if warp is None:
        return params.warp_force * params.lift
    longer = float(warp.lengthening(np.array(params.lift)))
    return warp.tension * longer + warp.rate * longer**2 / 2


LIFTED = 1e-12
"""Share of the lift up to which a warp lies on its line; below it the cam's rounding."""
