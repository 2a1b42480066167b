"""A two-link arm whose second link always passes through one fixed point, and its joint angles along that path.

The line of link 2 goes through the point G everywhere on the path, as if it slid in a swivel there: the arm moves like
an oscillating block, and G, the pivot O and the elbow E are a triangle with two fixed sides,

    b = |O - G|,     a1 = |E - O|,     r = |E - G| = a2 - rho,     rho = rho0 + s (rho1 - rho0),     0 <= s <= 1

rho is how far the tip is beyond G, below 0 on the elbow's side; it grows evenly with the parameter s. So with the
angles psi of the triangle at G and chi at O,

    cos psi = (r + (b² - a1²)/r) / 2b           E - G = r exp(i (arg(O - G) + side psi)),    th2 = arg(G - E)
    cos chi = (a1² + b² - r²) / 2 a1 b          E - O = a1 exp(i (arg(G - O) - side chi)),   th1 = arg(E - O)

and the tip P = G + (r - a2) (E - G)/r. All functions are analytic in s for a triangle that is not flat: links 1 and
2 in one line are the dead centres of the arm and of the triangle. With
c = cos psi, S = sin psi the derivatives by s follow from c' = -S psi' and so on:

    psi' = -c'/S      psi'' = -(c'' + c psi'²)/S      psi''' = -(c''' + 3 c psi' psi'' - S psi'³)/S

[the swivel's loop closure; e.g. Hain, Applied Kinematics, 1967, oscillating block]
"""

import math
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from ilmek.arrays import ComplexArray, Float, FloatArray
from ilmek.plane.vectors import unit
from ilmek.records import record

Jet: TypeAlias = tuple[FloatArray, FloatArray, FloatArray, FloatArray]
"""A function's values and its first to third derivatives by s."""


@record
class ArmPath:
    """Joint angles along an arm's path, and their derivatives by the path's parameter s.

    s      0 at the start of the path, 1 at its end
    theta  angles of the first and second link, absolute [rad], without jumps; the elbow's angle is their difference
    first, second, third  derivatives of theta by s [rad]
    """

    s: Float[np.ndarray, " n"]
    theta: Float[np.ndarray, "n 2"]
    first: Float[np.ndarray, "n 2"]
    second: Float[np.ndarray, "n 2"]
    third: Float[np.ndarray, "n 2"]


@dataclass(frozen=True, slots=True)
class SwivelledArm:
    """An arm and its path; that of its mirror image: `mirrored_path`.

    pivot   O [m]             first, second  links a1, a2 [m], both above 0
    swivel  G [m]             side           of the elbow: +1 left of the line from G to the pivot, -1 right
    begin   rho0 [m], below 0           end  rho1 [m]
    """

    pivot: complex
    first: float
    second: float
    swivel: complex
    side: int
    begin: float
    end: float

    @property
    def base(self) -> float:
        """Distance b of the pivot from G [m]."""
        return abs(self.pivot - self.swivel)

    @property
    def stroke(self) -> float:
        """Length of the path along link 2 [m]."""
        return self.end - self.begin

    def beyond(self, s: FloatArray) -> FloatArray:
        """Distance rho of the tip beyond G [m]."""
        return np.asarray(self.begin + s * self.stroke)

    def elbow(self, s: FloatArray) -> ComplexArray:
        """Positions of the elbow [m]; NaN where the arm cannot close."""
        return np.asarray(self.pivot + self.first * unit(self._angle(self._first_cosine(s), -self.side)))

    def tip(self, s: FloatArray) -> ComplexArray:
        """Positions of the tip P [m]; NaN where the arm cannot close."""
        return np.asarray(self.swivel + self.beyond(s) * unit(self._angle(self._second_cosine(s), self.side)))

    def tilt(self, s: FloatArray) -> FloatArray:
        """Angle of link 2 from upright [rad], positive for a tip on the right of the elbow."""
        return np.asarray((self._second(s)[0] + 3 * np.pi / 2) % (2 * np.pi) - np.pi)

    @property
    def bend(self) -> float:
        """Least |sin| of the angle between the links on the path, -1 where the arm cannot close everywhere on it.

        cos = (r + (a1² - b²)/r) / 2 a1 grows with r, or is positive with one minimum: the greatest |cos| is at an end.
        """
        r = self.second - np.array([self.begin, self.end])
        if np.min(r) <= 0:
            return -1.0
        cosine = float(np.max(np.abs(r + (self.first**2 - self.base**2) / r))) / (2 * self.first)
        return math.sqrt(1 - cosine**2) if cosine <= 1 else -1.0

    @property
    def turn_bound(self) -> float:
        """Bound of |d th2 / ds| on the path [rad]: |b c'| / (a1 sin bend), c' greatest at an end."""
        r = self.second - np.array([self.begin, self.end])
        slope = float(np.max(np.abs(1 - (self.base**2 - self.first**2) / r**2))) / 2
        return self.stroke * slope / (self.first * self.bend)

    @property
    def speed_bound(self) -> float:
        """Bound of |dz/ds| of every point of both links [m]: along link 2, and about G."""
        far = max(self.second - self.begin, self.end)
        return math.hypot(self.stroke, far * self.turn_bound)

    def path(self, s: Float[np.ndarray, " n"]) -> ArmPath:
        """Joint angles and their derivatives at values of s."""
        both = zip(self._first(s), self._second(s), strict=True)
        return ArmPath(s, *(np.stack(np.broadcast_arrays(*pair), axis=-1) for pair in both))

    def _angle(self, cosine: FloatArray, side: int) -> FloatArray:
        """th1 or th2 by its cosine to G."""
        with np.errstate(invalid="ignore"):
            return np.asarray(float(np.angle(self.swivel - self.pivot)) + side * np.arccos(cosine))

    def _first_cosine(self, s: FloatArray) -> FloatArray:
        r = self.second - self.beyond(s)
        return np.asarray((self.first**2 + self.base**2 - r**2) / (2 * self.first * self.base))

    def _second_cosine(self, s: FloatArray) -> FloatArray:
        r = self.second - self.beyond(s)
        return np.asarray((r + (self.base**2 - self.first**2) / r) / (2 * self.base))

    def _first(self, s: FloatArray) -> Jet:
        """th1 and its derivatives."""
        r, fall, double = self.second - self.beyond(s), -self.stroke, 2 * self.first * self.base
        cosine = self._first_cosine(s), -2 * r * fall / double
        jet = _arccosine((*cosine, np.full_like(r, -2 * fall**2 / double), np.zeros_like(r)))
        return _turned(jet, float(np.angle(self.swivel - self.pivot)), -self.side)

    def _second(self, s: FloatArray) -> Jet:
        """th2 and its derivatives."""
        r, fall, excess = self.second - self.beyond(s), -self.stroke, self.base**2 - self.first**2
        cosine = (
            self._second_cosine(s),
            fall * (1 - excess / r**2) / (2 * self.base),
            fall**2 * excess / (self.base * r**3),
            -3 * fall**3 * excess / (self.base * r**4),
        )
        return _turned(_arccosine(cosine), float(np.angle(self.swivel - self.pivot)), self.side)


def _arccosine(cosine: Jet) -> Jet:
    """The arc cosine of a jet; NaN beyond ±1."""
    c, c1, c2, c3 = cosine
    with np.errstate(invalid="ignore", divide="ignore"):
        S = np.sqrt(1 - c**2)
        one = -c1 / S
        two = -(c2 + c * one**2) / S
        return np.arccos(c), one, two, -(c3 + 3 * c * one * two - S * one**3) / S


def _turned(jet: Jet, angle: float, side: int) -> Jet:
    value, one, two, three = (side * part for part in jet)
    return angle + value, one, two, three
