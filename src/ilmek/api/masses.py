"""Masses of links: bars and point masses, and bodies that consist of several."""

from __future__ import annotations  # so that `help` shows the aliases

from ilmek.arguments import Arguments, Point, Quantities, Quantity
from ilmek.arrays import RealField
from ilmek.dynamics import inertia
from ilmek.dynamics.inertia import Inertia
from ilmek.errors import MechanismError

_BAR, _MASS = Arguments("a bar", MechanismError), Arguments("a point mass", MechanismError)


def bar_mass(length: Quantities, width: Quantities, thickness: Quantities, density: Quantities) -> RealField:
    """Mass of a rectangular bar [kg]: m = density length width thickness; lengths [m], density [kg/m³], any shape.

    Raises MechanismError for lengths that were probably meant in millimetres.

    >>> round(bar_mass(0.3, "30mm", 0.01, 7210), 6)
    0.6489
    """
    sides = [_BAR.lengths(name, side) for name, side in (("length", length), ("width", width))]
    values = (*sides, _BAR.lengths("thickness", thickness), _BAR.values("density", density, "kg/m^3"))
    return inertia.bar_mass(*_BAR.together(*values))


def bar(start: Point, end: Point, *, mass: Quantity, width: Quantity = 0.0) -> Inertia:
    """A uniform straight bar: mass [kg], mass centre [m] and J = m (L² + w²) / 12 [kg m²] about it.

    start, end  its ends in the body's frame [m], complex or (x, y)
    mass        [kg]
    width       in the plane of motion [m]; default: 0, a slender rod

    Raises MechanismError for lengths that were probably meant in millimetres.

    >>> bar(0, (0.3, 0), mass=1.2).moment
    0.009
    """
    ends = _BAR.near_point("start", start), _BAR.near_point("end", end)
    weighed = _BAR.not_negative("mass", mass, "kg")
    return inertia.bar(*ends, mass=weighed, width=_BAR.length("width", width, least=0.0))


def point_mass(mass: Quantity, at: Point) -> Inertia:
    """A point mass [kg] at a point of the body's frame [m], complex or (x, y); its moment of inertia is 0.

    >>> point_mass(2.5, at=(0.5, 0)).about(0)
    0.625
    """
    return inertia.point_mass(_MASS.not_negative("mass", mass, "kg"), _MASS.near_point("point", at))


def combined(*parts: Inertia) -> Inertia:
    """Inertia [kg, m, kg m²] of rigidly connected parts, all given in the same frame.

        m = Σ m_k,   c = Σ m_k c_k / m,   J = Σ (J_k + m_k |c_k - c|²)     [parallel-axis theorem]

    Massless parts give a massless body with its centre at the origin.

    >>> combined(point_mass(1, 0), point_mass(1, 0.5))
    Inertia(mass=2.0, centre=(0.25+0j), moment=0.125)
    """
    return inertia.combined(*Arguments("a body", MechanismError).sequence("parts", parts, Inertia))
