"""How the fell resists the beat, and where that leaves the row.

A row laid at the distance P from the fell is driven up to p. Greenwood and Cowhig found the weaving resistance to grow
as k / (p - D) towards the jammed distance D; so that a row which is only laid resists with nothing, here it is

    R(p) = K T (1 / (p - D) - 1 / (P - D)),      p(F) = D + 1 / (F / (K T) + 1 / (P - D))        force of one warp

which falls from endless at D to 0 at P, and tends to theirs for a large P. It comes from the friction of warps on
wefts and so goes with the warp's tension T; the length K tells how hard the fabric packs, and is to be measured: one
beat of a known force and the row it leaves give it. While the beat lasts the fell gives way by x: warps tauten, cloth
slackens,

    R = (kw + kc) x   up to the cloth's slackness, x = T / kc;      R = T + kw x   beyond: the fell "bumps"

with kw = EA / lw, kc = EA / lc, the stiffness of a warp and of its part of the cloth. Once the comb is back, so is x;
what stays is p. Work of a beat: K T (ln((P - D) / (p - D)) - (P - p) / (P - D)) into the row for good, and what
stretches warps and cloth, which they give back.
[Greenwood and Cowhig, The position of the cloth fell in power looms, Journal of the Textile Institute 47, 1956, T241;
Vatankhah, Importance of the cloth fell position and its specification methods, 2010; the term 1 / (P - D) is ours]
"""

import math
from dataclasses import dataclass

import numpy as np

from ilmek.arrays import FloatArray, RealField


@dataclass(frozen=True, slots=True)
class Fabric:
    """The fell, for one warp.

    tension  of a warp [N]      laid, jammed  distances P and D of a row [m]      packing  the length K [m]
    warp_rate, cloth_rate       stiffness of the warp and of its part of the cloth [N/m]
    """

    tension: float
    laid: float
    jammed: float
    packing: float
    warp_rate: float
    cloth_rate: float

    def resistance(self, spacing: RealField) -> RealField:
        """R [N] at a distance of rows [m] between jammed and laid."""
        return self.packing * self.tension * (1 / (spacing - self.jammed) - 1 / (self.laid - self.jammed))

    def spacing(self, force: RealField) -> RealField:
        """Distance of rows [m] that a force [N] leaves."""
        return self.jammed + 1 / (force / (self.packing * self.tension) + 1 / (self.laid - self.jammed))

    def rate(self, spacing: float) -> float:
        """Stiffness of the fell [N/m] at a distance of rows: of packing, and of warps and cloth, one behind the other.

        Beyond the bump only the warps bear.
        """
        packing = self.packing * self.tension / (spacing - self.jammed) ** 2
        slack = float(self.resistance(spacing)) > self.bump
        elastic = self.warp_rate + (0.0 if slack else self.cloth_rate)
        return 1 / (1 / packing + 1 / elastic)

    @property
    def bump(self) -> float:
        """Force [N] from which the cloth hangs slack: T (1 + kw / kc)."""
        return self.tension * (1 + self.warp_rate / self.cloth_rate)

    def fell(self, force: RealField) -> FloatArray:
        """How far the fell gives way [m] under a force [N]."""
        taut = np.divide(force, self.warp_rate + self.cloth_rate)
        slack = np.divide(np.subtract(force, self.tension), self.warp_rate)
        return np.asarray(np.where(np.less_equal(force, self.bump), taut, slack))

    def travel(self, force: RealField) -> FloatArray:
        """How far the comb goes from where it meets the laid row [m]: packing, and the fell's giving way."""
        return np.asarray(self.laid - self.spacing(force) + self.fell(force))

    def packing_work(self, spacing: float) -> float:
        """Work [J] that drives a row to a distance [m]; it is not given back."""
        laid, left = self.laid - self.jammed, spacing - self.jammed
        return self.packing * self.tension * (math.log(laid / left) - (laid - left) / laid)

    def stretching_work(self, force: float) -> float:
        """Work [J] that a force [N] puts into warps and cloth; the area under R over x."""
        x = float(self.fell(force))
        taut = min(x, self.tension / self.cloth_rate)
        beyond = x - taut
        first = 0.5 * (self.warp_rate + self.cloth_rate) * taut**2
        return first + beyond * (self.tension + self.warp_rate * (taut + 0.5 * beyond))

    def energy(self, force: float) -> float:
        """Work [J] of a beat up to a force [N]."""
        return self.packing_work(float(self.spacing(force))) + self.stretching_work(force)

    def struck(self, energy: float) -> float:
        """Force [N] up to which a blow of an energy [J] goes, where all of it goes into the fell."""
        high = self.tension
        while self.energy(high) < energy:
            high *= 2
        low = 0.0
        for _ in range(_HALVINGS):
            middle = 0.5 * (low + high)
            low, high = (middle, high) if self.energy(middle) < energy else (low, middle)
        return 0.5 * (low + high)


_HALVINGS = 60
