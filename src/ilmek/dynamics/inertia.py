"""Mass, mass centre and moment of inertia of links: bars and point masses, combined by the parallel-axis theorem.

[Meriam and Kraige, Engineering Mechanics: Dynamics, appendix B]

>>> rocker = combined(bar(0, 0.3, mass=0.649, width=0.03), point_mass(2.5, at=0.3))
>>> round(rocker.centre.real, 4), round(rocker.mass, 3)
(0.2691, 3.149)
"""

import math
from dataclasses import dataclass

from ilmek.arguments import Arguments
from ilmek.arrays import ComplexField, RealField
from ilmek.errors import MechanismError
from ilmek.plane.vectors import dot

_BODY = Arguments("a body", MechanismError)


@dataclass(frozen=True, slots=True)
class Inertia:
    """Mass properties of a rigid body.

    mass     [kg], not negative
    centre   mass centre in the body's frame [m], complex or (x, y)
    moment   moment of inertia about the mass centre [kg m²], not negative

    Raises MechanismError for values outside these ranges or not finite.

    >>> Inertia("400g", (0.1, 0.02), 1e-3)
    Inertia(mass=0.4, centre=(0.1+0.02j), moment=0.001)
    """

    mass: float
    centre: complex
    moment: float

    def __post_init__(self) -> None:
        object.__setattr__(self, "mass", _BODY.not_negative("mass", self.mass, "kg"))
        object.__setattr__(self, "centre", _BODY.point("mass centre", self.centre))
        object.__setattr__(self, "moment", _BODY.not_negative("moment", self.moment, "kg*m^2"))

    def about(self, point: complex) -> float:
        """Moment of inertia about a point [m] of the body's frame: J + m r² [kg m²] [parallel-axis theorem].

        >>> round(bar(0, 0.3, mass=0.649).about(0), 9)  # m L² / 3
        0.01947
        """
        arm = self.centre - point
        return self.moment + self.mass * float(dot(arm, arm))


def bar_mass(length: RealField, width: RealField, thickness: RealField, density: RealField) -> RealField:
    """Mass of a rectangular bar [kg]: m = density length width thickness; lengths [m], density [kg/m³], any shape.

    >>> round(bar_mass(0.3, 0.03, 0.01, 7210), 6)
    0.6489
    """
    return density * length * width * thickness


def bar_moment(mass: RealField, length: RealField, width: RealField) -> RealField:
    """Moment of inertia of a rectangular bar about its centre, for rotation in its plane [kg m²].

        J = m (L² + w²) / 12,    mass m [kg], length L and width w [m], any shape

    Topalbekiroglu and Celik print 4.073e-5 kg m² for their crank of 0.129131 kg, 59.7375 mm by 30 mm: that is
    m (L² + (w/2)²) / 12; this formula gives 4.804e-5.
    """
    return mass * (length**2 + width**2) / 12


def bar(start: complex, end: complex, *, mass: float, width: float = 0.0) -> Inertia:
    """A uniform straight bar: mass [kg], mass centre [m] and J = m (L² + w²) / 12 [kg m²] about it.

    start, end  its ends in the body's frame [m], complex
    mass        [kg]
    width       in the plane of motion [m]; default: 0, a slender rod
    """
    return Inertia(mass, complex(start + end) / 2, float(bar_moment(mass, abs(end - start), width)))


def point_mass(mass: float, at: complex) -> Inertia:
    """A point mass [kg] at a point of the body's frame [m], complex; its moment of inertia is 0."""
    return Inertia(mass, complex(at), 0.0)


def combined(*parts: Inertia) -> Inertia:
    """Inertia [kg, m, kg m²] of rigidly connected parts, all given in the same frame.

        m = Σ m_k,   c = Σ m_k c_k / m,   J = Σ (J_k + m_k |c_k - c|²)     [parallel-axis theorem]

    Massless parts give a massless body with its centre at the origin.
    """
    mass = math.fsum(part.mass for part in parts)
    centre: ComplexField = sum(part.mass * part.centre for part in parts) / mass if mass else 0j
    return Inertia(mass, complex(centre), math.fsum(part.about(complex(centre)) for part in parts))
