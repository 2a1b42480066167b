"""Resistance of the fell to the beat-up, and the distance of rows after a force.

A row laid at the distance P from the fell is driven up to p. Greenwood and Cowhig found the weaving resistance to grow
as k / (p - D) towards the jammed distance D. A row that is only laid has no resistance, so here

    R(p) = K T (1 / (p - D) - 1 / (P - D)),      p(F) = D + 1 / (F / (K T) + 1 / (P - D))        force of one warp

R falls from infinity at D to 0 at P, and tends to their law for a large P. The resistance comes from the friction of
warps on wefts and so is proportional to the tension T of the warp. The length K is a property of the fabric. One beat
of a known force and the resulting row distance determine it. During the beat the fell yields by x: warps tighten, cloth
slackens,

    R = (kw + kc) x   until the cloth is slack, x = T / kc;      R = T + kw x   beyond: bumping

with kw = EA / lw, kc = EA / lc, the stiffness of a warp and of its part of the cloth. When the comb is back, x is 0
and the row stays at p. The work K T (ln((P - D) / (p - D)) - (P - p) / (P - D)) of a beat packs the row; the work that
stretches warps and cloth is returned.
[Greenwood and Cowhig, The position of the cloth fell in power looms, Journal of the Textile Institute 47, 1956, T241;
Vatankhah, Importance of the cloth fell position and its specification methods, 2010; the term 1 / (P - D) is derived
here]
"""

import math
from dataclasses import dataclass

import numpy as np

from ilmek.arrays import BoolArray, FloatArray, RealField
from ilmek.num.brackets import bracketed_roots


@dataclass(frozen=True, slots=True)
class Fabric:
    """The fabric at the fell, for one warp.

    tension  T of the warp [N]      laid, jammed  distances P and D of a row [m], 0 < D < P   packing  length K [m]
    warp_rate, cloth_rate           kw and kc, stiffness of the warp and of its part of the cloth [N/m]
    """

    tension: float
    laid: float
    jammed: float
    packing: float
    warp_rate: float
    cloth_rate: float

    def resistance(self, spacing: RealField) -> RealField:
        """Resistance R [N] at distances of rows [m] of any shape, from `jammed` (infinite) to `laid`."""
        return self.packing * self.tension * (1 / (spacing - self.jammed) - 1 / (self.laid - self.jammed))

    def spacing(self, force: RealField) -> RealField:
        """Distance of rows p [m] after forces [N] of any shape; `laid` at 0, `jammed` at infinity."""
        return self.jammed + 1 / (force / (self.packing * self.tension) + 1 / (self.laid - self.jammed))

    def rate(self, spacing: float) -> float:
        """Stiffness of the fell [N/m] at a distance of rows [m]: packing in series with warp and cloth.

        Beyond bumping only the warp carries the force.
        """
        packing = self.packing * self.tension / (spacing - self.jammed) ** 2
        slack = float(self.resistance(spacing)) > self.bump
        elastic = self.warp_rate + (0.0 if slack else self.cloth_rate)
        return 1 / (1 / packing + 1 / elastic)

    @property
    def bump(self) -> float:
        """Force [N] from which the cloth is slack: T (1 + kw / kc)."""
        return self.tension * (1 + self.warp_rate / self.cloth_rate)

    def fell(self, force: RealField) -> FloatArray:
        """Displacement x of the fell [m] under forces [N] of any shape."""
        taut = np.divide(force, self.warp_rate + self.cloth_rate)
        slack = np.divide(np.subtract(force, self.tension), self.warp_rate)
        return np.asarray(np.where(np.less_equal(force, self.bump), taut, slack))

    def travel(self, force: RealField) -> FloatArray:
        """Travel of the comb [m] from its contact with the laid row, under forces [N] of any shape."""
        return np.asarray(self.laid - self.spacing(force) + self.fell(force))

    def over_stroke(self, force: float, left: FloatArray, returns: BoolArray) -> FloatArray:
        """Force of the fell on a comb [N], whose stroke ends where the force [N] is reached.

        left  of the stroke [m]       returns  whether the comb goes back: the packed row stays, the fell follows it
        """
        forces = np.concatenate([[0.0], np.geomspace(force * 1e-4, force, _TABLE)])
        going = np.interp(float(self.travel(force)) - left, self.travel(forces), forces, left=0.0)
        back = np.interp(float(self.fell(force)) - left, self.fell(forces), forces, left=0.0)
        return np.asarray(np.where(returns, back, going))

    def packing_work(self, spacing: float) -> float:
        """Work [J] of packing a row to a distance [m]; it is not returned."""
        laid, left = self.laid - self.jammed, spacing - self.jammed
        return self.packing * self.tension * (math.log(laid / left) - (laid - left) / laid)

    def stretching_work(self, force: float) -> float:
        """Work [J] of a force [N] in warp and cloth: the area under R over x."""
        x = float(self.fell(force))
        taut = min(x, self.tension / self.cloth_rate)
        beyond = x - taut
        first = 0.5 * (self.warp_rate + self.cloth_rate) * taut**2
        return first + beyond * (self.tension + self.warp_rate * (taut + 0.5 * beyond))

    def energy(self, force: float) -> float:
        """Work [J] of a beat up to a force [N]."""
        return self.packing_work(float(self.spacing(force))) + self.stretching_work(force)

    def struck(self, energy: float) -> float:
        """Largest force [N] of a blow whose energy [J] is fully absorbed by the fell; inverse of `energy`."""
        high = self.tension
        while self.energy(high) < energy:
            high *= 2

        def excess(force: FloatArray) -> FloatArray:
            return np.array([self.energy(one) - energy for one in force.tolist()])

        return float(bracketed_roots(excess, np.zeros(1), np.array([high]))[0])


_TABLE = 200
"""Forces at which the fell is tabulated over a stroke."""

LAID, JAMMED, PACKING = 1.5, 0.75, 0.25
"""A row before the beat, a jammed row, and the packing length K, over the required row pitch: assumed by this project.
A row then requires 10 N at 15 N of tension; K is to be measured."""

CLOTH_LENGTH = 0.5
"""Cloth from the fell to its beam [m]: assumed by this project."""


def assumed_fabric(row_pitch: float, tension: float, stiffness: float, warp_length: float) -> Fabric:
    """The fabric at the fell for a required row pitch, with assumed packing properties.

    row_pitch  required [m]   tension, stiffness  of a warp [N], force over strain [N]   warp_length  to its beam [m]

    >>> round(float(assumed_fabric(4e-3, 15.0, 1800.0, 1.5).resistance(4e-3)), 9)
    10.0
    """
    return Fabric(
        tension=tension,
        laid=LAID * row_pitch,
        jammed=JAMMED * row_pitch,
        packing=PACKING * row_pitch,
        warp_rate=stiffness / warp_length,
        cloth_rate=stiffness / CLOTH_LENGTH,
    )
