"""Mass, mass centre and moment of inertia of flat uniform shapes in the plane of motion.

Lengths in m, density in kg/m³, results in kg, m, kg m². Several shapes form one link by `inertia.combined`.
[Meriam and Kraige, Engineering Mechanics: Dynamics, appendix B for disc, ring and bar; the others are derived here]
"""

import math
from collections.abc import Sequence

from ilmek.dynamics.inertia import Inertia
from ilmek.errors import MechanismError
from ilmek.part.flat_link import flat_link_moments
from ilmek.plane.vectors import cross, dot
from ilmek.units import counted


def disc(radius: float, thickness: float, density: float, *, at: complex = 0j) -> Inertia:
    """A round disc with its centre `at` [m]: m = rho t pi r², J = m r² / 2; r, t [m], rho [kg/m³].

    >>> crank = disc(0.1, 0.01, 7800.0)
    >>> round(crank.mass, 4), round(crank.moment, 6)
    (2.4504, 0.012252)
    """
    return ring(radius, 0.0, thickness, density, at=at)


def ring(outer: float, inner: float, thickness: float, density: float, *, at: complex = 0j) -> Inertia:
    """A disc with a concentric hole: m = rho t pi (R² - r²), J = m (R² + r²) / 2.

    outer, inner        radii R, r [m]      at  its centre [m]
    thickness, density  t [m], rho [kg/m³]

    Raises MechanismError unless 0 <= inner < outer and thickness and density are above 0.
    """
    _require(radius=outer, thickness=thickness, density=density)
    if not 0 <= inner < outer:
        raise MechanismError(f"a ring's hole has the radius {inner:g} m", allowed=f"from 0 to below {outer:g} m")
    mass = density * thickness * math.pi * (outer**2 - inner**2)
    return Inertia(mass, complex(at), mass * (outer**2 + inner**2) / 2)


def link(start: complex, end: complex, width: float, thickness: float, density: float) -> Inertia:
    """A bar with round ends about its two pins [`part.flat_link`]; of length 0: a disc.

    start, end  the pins [m]      width, thickness  w, t [m]      density  rho [kg/m³]

    Raises MechanismError for a width, thickness or density that is not above 0.
    >>> round(link(0, 0, 0.2, 0.01, 7800.0).moment / disc(0.1, 0.01, 7800.0).moment, 12)
    1.0
    """
    _require(width=width, thickness=thickness, density=density)
    made = flat_link_moments(abs(end - start), width, thickness).of_density(density)
    return Inertia(float(made.zeroth), (complex(start) + end) / 2, float(made.about_centre))


def plate(corners: Sequence[complex], thickness: float, density: float) -> Inertia:
    """A plate with straight edges.

        A = Σ p x q / 2,   c = Σ (p + q) (p x q) / (6 A),   J_0 = rho t Σ (p² + p·q + q²) (p x q) / 12

    p, q are neighbouring corners relative to the first one [Green's theorem].

    corners  [m], in order, clockwise or counter-clockwise      thickness  t [m]      density  rho [kg/m³]

    Raises MechanismError for fewer than three corners, an area of 0, and a thickness or density that is not above 0.
    >>> plate([0, 0.5, 0.5 + 0.25j, 0.25j], 0.01, 7800.0).centre
    (0.25+0.125j)
    """
    _require(thickness=thickness, density=density)
    from_first = [complex(corner) - corners[0] for corner in corners]
    edges = list(zip(from_first, [*from_first[1:], *from_first[:1]], strict=True))
    area = math.fsum(float(cross(p, q)) for p, q in edges) / 2
    if len(corners) < 3 or not abs(area) > 0:
        raise MechanismError(
            f"a plate of {counted(len(corners), 'corner')} has no area", allowed="three corners or more, in order"
        )
    centre = sum(((p + q) * float(cross(p, q)) for p, q in edges), 0j) / (6 * area)
    about_first = math.fsum(float((dot(p, p) + dot(p, q) + dot(q, q)) * cross(p, q)) for p, q in edges) / (12 * area)
    mass = density * thickness * abs(area)
    return Inertia(mass, corners[0] + centre, mass * (about_first - abs(centre) ** 2))


def _require(**sizes: float) -> None:
    for name, size in sizes.items():
        if not (math.isfinite(size) and size > 0):
            raise MechanismError(f"{name} of a shape is {size:g}", allowed="finite and above 0")
