"""Four-bar linkage as the result of synthesis: four pins and a tracer, drawn at the first position.

    ground A0-B0, crank A0-A, coupler A-B with the tracer P, rocker B0-B

In the literature O2, A, B, O4 are also used for A0, A, B, B0. Lengths, angles and branch follow from the positions of
the pins.
"""

import cmath
import dataclasses
import math
from dataclasses import dataclass
from typing import NamedTuple

from ilmek.errors import MechanismError
from ilmek.linkage.fourbar import four_bar, lengths
from ilmek.linkage.model import GROUND, Body, Mechanism
from ilmek.linkage.quality import Grashof, grashof
from ilmek.plane.vectors import cross

TRACER = "P"
"""Name of the tracer among the coupler's points in `FourBar.mechanism`."""


class LinkLengths(NamedTuple):
    """Link lengths of a four-bar [m], in the order of `linkage.fourbar`."""

    ground: float
    crank: float
    coupler: float
    rocker: float


@dataclass(frozen=True, slots=True)
class FourBar:
    """A four-bar as drawn at its first position; all positions in the plane [m], complex.

    a0, b0  ground pivots of crank and rocker
    a, b    moving pins of crank and rocker
    tracer  point P of the coupler; None where only angles are required

    Raises MechanismError for a position that is not finite, and for a link of length 0.

    >>> drawn = FourBar(0j, 4 + 0j, 1j, 3 + 3j, tracer=2 + 3j)
    >>> drawn.branch, drawn.grashof.kind
    (1, 'crank-rocker')
    """

    a0: complex
    b0: complex
    a: complex
    b: complex
    tracer: complex | None = None

    def __post_init__(self) -> None:
        for name in ("a0", "b0", "a", "b", "tracer"):
            position = getattr(self, name)
            if position is None and name == "tracer":
                continue
            if not cmath.isfinite(position):
                raise MechanismError(f"{name} of the four-bar is {position}", allowed="finite positions in the plane")
            object.__setattr__(self, name, complex(position))
        lengths("the four-bar", **self.lengths._asdict())

    @property
    def lengths(self) -> LinkLengths:
        """Ground, crank, coupler, rocker [m]."""
        return LinkLengths(abs(self.b0 - self.a0), abs(self.a - self.a0), abs(self.b - self.a), abs(self.b - self.b0))

    @property
    def grashof(self) -> Grashof:
        """Grashof type, with A0-A as crank."""
        return grashof(*self.lengths)

    @property
    def branch(self) -> int:
        """+1 where B is on the left of A -> B0, -1 on the right; +1 at a dead centre (in line)."""
        return +1 if cross(self.b0 - self.a, self.b - self.a) >= 0 else -1

    @property
    def crank_angle(self) -> float:
        """Angle of A0 -> A as drawn [rad], in (-pi, pi]."""
        return cmath.phase(self.a - self.a0)

    @property
    def coupler_angle(self) -> float:
        """Angle of A -> B as drawn [rad], in (-pi, pi]."""
        return cmath.phase(self.b - self.a)

    @property
    def rocker_angle(self) -> float:
        """Angle of B0 -> B as drawn [rad], in (-pi, pi]."""
        return cmath.phase(self.b - self.b0)

    @property
    def tracer_on_coupler(self) -> complex | None:
        """Position of the tracer in the coupler's frame [m], origin A, x axis to B; None without a tracer."""
        return None if self.tracer is None else (self.tracer - self.a) * cmath.exp(-1j * self.coupler_angle)

    def mechanism(self, branch: int | None = None) -> Mechanism:
        """The linkage at its drawn position, driven by the crank: pins A0, A, B, B0, coupler point P.

        The input is the crank angle in the ground frame. The frames of crank, coupler and rocker have their origins at
        A0, A and B0 and their x axes towards the other pin.

        branch  +1 or -1; default: as drawn
        """
        tracer = self.tracer_on_coupler
        points = {} if tracer is None else {"coupler": {TRACER: tracer}}
        linkage = four_bar(*self.lengths, branch=self.branch if branch is None else branch, points=points)
        bodies = (Body(GROUND, {"A0": self.a0, "B0": self.b0}), *linkage.bodies[1:])
        return dataclasses.replace(linkage, bodies=bodies)

    def moved(self, by: complex) -> "FourBar":
        """Shifted by a vector [m]."""
        return self._each(1, by)

    def scaled(self, factor: float) -> "FourBar":
        """Scaled by a factor above 0 about the origin."""
        return self._each(factor, 0)

    def turned(self, angle: float) -> "FourBar":
        """Rotated about the origin by an angle [rad]."""
        return self._each(cmath.exp(1j * angle), 0)

    def mirrored(self) -> "FourBar":
        """Mirrored in the x axis: branch and angles change their sign."""
        a0, b0, a, b = (position.conjugate() for position in (self.a0, self.b0, self.a, self.b))
        return FourBar(a0, b0, a, b, None if self.tracer is None else self.tracer.conjugate())

    def reversed(self) -> "FourBar":
        """Crank and rocker exchanged."""
        return FourBar(self.b0, self.a0, self.b, self.a, self.tracer)

    def _each(self, factor: complex, by: complex) -> "FourBar":
        a0, b0, a, b = (factor * position + by for position in (self.a0, self.b0, self.a, self.b))
        return FourBar(a0, b0, a, b, None if self.tracer is None else factor * self.tracer + by)


def from_lengths(
    links: LinkLengths, crank_angle: float, *, branch: int, tracer: complex | None = None, name: str = "four-bar"
) -> FourBar:
    """The four-bar with A0 = 0 and B0 on the x axis, drawn at a crank angle.

    links        lengths [m]
    crank_angle  [rad]
    branch       +1 or -1
    tracer       in the coupler's frame [m], origin A, x axis to B; default: none
    name         for messages

    Raises MechanismError for a length that is not above 0, a branch other than +1 or -1, and where the links do not
    close.
    """
    lengths(name, **links._asdict())
    if branch not in (+1, -1):
        raise MechanismError(f"branch of {name} is {branch!r}", allowed="+1 or -1")
    a, b0 = links.crank * cmath.exp(1j * crank_angle), complex(links.ground)
    reach, least, most = abs(b0 - a), abs(links.coupler - links.rocker), links.coupler + links.rocker
    if not (least <= reach <= most) or reach == 0:
        raise MechanismError(
            f"{name} does not close at crank angle {math.degrees(crank_angle):.6g} deg: |A-B0| is {reach:.6g} m",
            allowed=f"{least:.6g} to {most:.6g} m for this coupler and rocker",
        )
    along = 0.5 + 0.5 * (links.coupler**2 - links.rocker**2) / reach**2
    # Rounding can make the argument negative where coupler and rocker are in line.
    across = branch * math.sqrt(max((links.coupler / reach) ** 2 - along**2, 0.0))
    b = a + complex(along, across) * (b0 - a)
    return FourBar(0j, b0, a, b, None if tracer is None else a + tracer * (b - a) / links.coupler)
