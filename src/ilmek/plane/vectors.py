"""Vectors of the plane as complex numbers: x + i y, any batch shape and unit; products have the units' product."""

import numpy as np

from ilmek.arrays import ComplexField, NumberArray, RealField


def dot(u: ComplexField, v: ComplexField) -> RealField:
    """Scalar product u · v = Re(conj(u) v).

    >>> float(dot(3 + 4j, 1 + 1j))
    7.0
    """
    return u.real * v.real + u.imag * v.imag


def cross(u: ComplexField, v: ComplexField) -> RealField:
    """Vector product u x v = Im(conj(u) v): positive for v on the left of u.

    >>> float(cross(1 + 0j, 2j))
    2.0
    """
    return u.real * v.imag - u.imag * v.real


def following(points: NumberArray) -> NumberArray:
    """The next point for each of a closed line, (n): `np.roll(points, -1)` in a tenth of its time for short ones.

    >>> following(np.array([1, 2, 3])).tolist()
    [2, 3, 1]
    """
    return np.concatenate((points[1:], points[:1]))


def oblique(v: ComplexField, e: ComplexField, f: ComplexField) -> RealField:
    """Component x of v along e in oblique axes, v = x e + y f: (v x f) / (e x f); along f it is `oblique(v, f, e)`.

    Infinite or NaN where e and f are parallel.    [derived: Cramer's rule]
    >>> float(oblique(3 + 4j, 1 + 0j, 1 + 1j)), float(oblique(3 + 4j, 1 + 1j, 1 + 0j))
    (-1.0, 4.0)
    """
    share: RealField = np.divide(v.real * f.imag - v.imag * f.real, e.real * f.imag - e.imag * f.real)
    return share


def unit(angle: RealField) -> ComplexField:
    """Unit vector e^{i angle} from an angle [rad]; twice as fast as `np.exp(1j * angle)`.

    >>> complex(np.round(unit(np.pi / 2), 12))
    1j
    """
    if np.ndim(angle) == 0:
        return complex(np.cos(angle), np.sin(angle))
    direction = np.empty(np.shape(angle), dtype=np.complex128)
    np.cos(angle, out=direction.real)
    np.sin(angle, out=direction.imag)
    return direction
