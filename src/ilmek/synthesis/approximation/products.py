"""Equations that are linear except for one or two products of unknowns: all real solutions and stationary points.

    sum_k P_k f_k + sum_j lam_j g_j = F,    lam_j = P_a P_b for each product (a, b)

**As many equations as unknowns.** By superposition, P = l + lam m; in homogeneous form (P : lam : 1) = N s, with N the
null space of the linear equations, so that no system has to be regular. The conditions lam_j = P_a P_b are forms of
degree 2 in s: one product gives a binary quadratic, two products two conics. A solution with the last number 0 is at
infinity.

**More equations, least squares.** If one factor t is common to all products, the problem is linear for given
t = sin : cos. With q the right side and M(t) the other columns, S = min |q - M y|^2 is a quotient of forms, and
dS/dt = 0 is a form of degree 5 for one product and 9 for two: its real roots are all stationary points. Two products
without a common factor are solved by Newton's method from many starts.
[superposition: Alizade, and thesis 2.38-2.46; the forms are derived here]
"""

import itertools
from collections.abc import Callable
from typing import NamedTuple, TypeAlias

import numpy as np

from ilmek.arrays import Complex, Float, FloatArray
from ilmek.errors import ParameterError
from ilmek.num.conics import meet
from ilmek.num.newton import newton

Products: TypeAlias = tuple[tuple[int, int], ...]
"""Indices of the two parameters of each product."""

REAL = 1e-6
"""Imaginary part below which a root counts as real: rounding splits double roots."""

FAR = 1e-6
"""Last homogeneous number of a solution below which it is at infinity: the accuracy of a double root."""

FAMILY = 1e-12
"""Relative singular value below which the equations have a family of solutions."""

STARTS = 14
"""Starting values of each of two factors, for products without a common factor."""


class EquationRows(NamedTuple):
    """Columns of equations: `terms` f, shape (rows, n); `products` g, shape (rows, p); `target` F, shape (rows,)."""

    terms: Float[np.ndarray, "rows n"]
    products: Float[np.ndarray, "rows p"]
    target: Float[np.ndarray, " rows"]


class Solutions(NamedTuple):
    """Parameters of each solution, and descriptions of what was left out."""

    parameters: tuple[Float[np.ndarray, " n"], ...]
    left_out: tuple[str, ...]


def scales(rows: EquationRows, products: Products) -> Float[np.ndarray, " n"]:
    """Scales of the parameters that equilibrate their columns; a parameter only in products is scaled by these.

    Returns shape (n,), positive [unit of the parameter]; 1 where all columns of a parameter are zero.
    """
    sizes = np.linalg.norm(rows.terms, axis=0)
    known = np.where(sizes > 0, sizes, 1.0)
    for k in np.flatnonzero(sizes == 0):
        by = [
            float(np.linalg.norm(rows.products[:, j])) / known[b if a == k else a]
            for j, (a, b) in enumerate(products)
            if k in (a, b)
        ]
        known[k] = max([size for size in by if size > 0], default=1.0)
    return np.asarray(1 / known)


def scaled(rows: EquationRows, products: Products, sizes: Float[np.ndarray, " n"]) -> EquationRows:
    """The equations for parameters divided by `sizes`."""
    both = np.array([sizes[a] * sizes[b] for a, b in products])
    return EquationRows(rows.terms * sizes, rows.products * both, rows.target)


def binary_roots(form: Callable[[float, float], float], degree: int) -> FloatArray:
    """Angles theta in [0, pi) at which a binary form of (cos theta, sin theta) is zero: its real roots.

    form    a homogeneous polynomial of (cos theta, sin theta)      degree  of the form

    On the circle w = e^{2 i theta} the form is a polynomial in w, computed from its values at evenly spaced angles.

    >>> np.tan(binary_roots(lambda c, s: (s - 2 * c) * (s + c) * (s * s + c * c), 4)).round(9)
    array([ 2., -1.])
    """
    turns = np.pi * np.arange(degree + 1) / (degree + 1)
    values = np.array([form(float(np.cos(turn)), float(np.sin(turn))) for turn in turns])
    if not np.max(np.abs(values)) > 0:
        return np.empty(0)
    powers = np.fft.fft(values * np.exp(1j * degree * turns)) / (degree + 1)
    found: Complex[np.ndarray, " roots"] = np.roots(powers[::-1])
    on_circle = found[np.abs(np.abs(found) - 1) <= REAL]
    return np.sort(np.mod(np.angle(on_circle) / 2, np.pi))


def solve_products(rows: EquationRows, products: Products) -> Solutions:
    """All real P that solve as many equations as there are parameters.

    Raises ParameterError where the equations have a family of solutions.
    """
    count, many = rows.terms.shape[1], len(products)
    sizes = scales(rows, products)
    even = scaled(rows, products, sizes)
    unit = float(np.linalg.norm(even.target)) or 1.0
    table = np.column_stack([even.terms, even.products, -even.target / unit])
    _, singular, right = np.linalg.svd(table)
    if singular[-1] <= FAMILY * singular[0]:
        raise _family()
    free = right[count:].T
    forms = [
        _form(free[count + j] * unit, free[-1]) - _form(free[a] * unit, free[b] * unit)
        for j, (a, b) in enumerate(products)
    ]
    ratios, complex_ones = _common_roots(forms, many)
    found: list[FloatArray] = []
    far = 0
    for ratio in ratios:
        whole = free @ ratio
        if abs(whole[-1]) <= FAR * float(np.linalg.norm(whole)):
            far += 1
            continue
        parameters = _refined(even, products, unit * whole[:count] / whole[-1])
        if all(np.max(np.abs(parameters - other)) > REAL * np.max(np.abs(other)) for other in found):
            found.append(parameters)
    # Spurious roots at infinity: the common factor 0 with 1 = 0, and a factor that occurs only in products.
    always = int(many == 2 and common_factor(products) is not None) + int(np.sum(~np.any(even.terms, axis=0)))
    far = max(0, far - always)
    words = [f"{far} infinitely far"] if far else []
    words += [f"{complex_ones} complex"] if complex_ones else []
    return Solutions(tuple(sizes * one for one in found), tuple(words))


def _form(u: FloatArray, v: FloatArray) -> FloatArray:
    """The symmetric matrix of the form (u s)(v s)."""
    return np.asarray(0.5 * (np.outer(u, v) + np.outer(v, u)))


def _common_roots(forms: list[FloatArray], many: int) -> tuple[list[FloatArray], int]:
    """Real s at which all forms are zero, and the number of complex ones."""
    if many == 0:
        return [np.ones(1)], 0
    largest = [float(np.max(np.abs(form))) for form in forms]
    if min(largest) <= FAMILY:
        raise _family()
    if many == 1:
        (a, b), (_, c) = forms[0] / largest[0]
        angles = binary_roots(lambda x, y: float(a * x * x + 2 * b * x * y + c * y * y), 2)
        return [np.array([np.cos(angle), np.sin(angle)]) for angle in angles], 2 - len(angles)
    met = meet(forms[0], forms[1])
    if met.share:
        raise _family()
    complex_ones = int(np.sum(np.max(np.abs(met.points.imag), axis=-1) > REAL))
    return [point.real for point, real in zip(met.points, met.real, strict=True) if real], complex_ones


def _refined(rows: EquationRows, products: Products, parameters: FloatArray) -> FloatArray:
    """Newton's method on the equations; steps that do not reduce the error are rejected."""
    found, slopes = errors_of(rows, products, parameters)
    for _ in range(4):
        after = parameters - np.linalg.lstsq(slopes, found, rcond=None)[0]
        trial, trial_slopes = errors_of(rows, products, after)
        if not np.max(np.abs(trial)) < np.max(np.abs(found)):
            break
        parameters, found, slopes = after, trial, trial_slopes
    return parameters


def errors_of(rows: EquationRows, products: Products, parameters: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Errors F - sum P f - sum lam g of the equations, and their derivatives by the parameters.

    parameters  shape (..., n)

    Returns errors, shape (..., rows), and derivatives, shape (..., rows, n).
    """
    found = rows.target - parameters @ rows.terms.T
    slopes = np.broadcast_to(-rows.terms, (*parameters.shape[:-1], *rows.terms.shape)).copy()
    for j, (a, b) in enumerate(products):
        found = found - (parameters[..., a] * parameters[..., b])[..., None] * rows.products[:, j]
        slopes[..., a] -= parameters[..., b, None] * rows.products[:, j]
        slopes[..., b] -= parameters[..., a, None] * rows.products[:, j]
    return found, slopes


def common_factor(products: Products) -> int | None:
    """Index of a parameter that occurs once in every product; None where there is none."""
    if any(a == b for a, b in products):
        return None
    common = set.intersection(*(set(pair) for pair in products)) if products else set()
    return min(common, default=None)


def stationary(rows: EquationRows, products: Products) -> Solutions:
    """All real P at which the sum of squares of more equations than parameters is stationary, the least sum first.

    Raises ParameterError for linearly dependent columns.
    """
    sizes = scales(rows, products)
    even = _shortened(scaled(rows, products, sizes))
    linear = even.terms[:, np.any(even.terms, axis=0)]
    if np.linalg.matrix_rank(linear, tol=1e-11) < linear.shape[1]:
        raise _family()
    words: list[str] = []
    common = common_factor(products)
    if not products:
        starts = np.linalg.lstsq(even.terms, even.target, rcond=None)[0][None, :]
    elif common is not None:
        starts, words = _from_form(even, products, common)
    else:
        starts, words = _from_grid(even, products), [f"searched from {STARTS**2} starts: there may be more solutions"]
    unit = max(1.0, float(np.max(np.abs(starts), initial=1.0)))
    ends = newton(lambda p: gradient(even, products, p), starts, tolerance=1e-11 * unit, steps=60)
    found: list[FloatArray] = []
    for end in ends:
        if np.isfinite(end).all() and all(np.max(np.abs(end - one)) > REAL * np.max(np.abs(one)) for one in found):
            found.append(end)
    found.sort(key=lambda one: float(np.sum(errors_of(even, products, one)[0] ** 2)))
    return Solutions(tuple(sizes * one for one in found), tuple(words))


def gradient(rows: EquationRows, products: Products, parameters: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Gradient, shape (..., n), and Hessian, shape (..., n, n), of half the sum of squares; parameters (..., n)."""
    found, slopes = errors_of(rows, products, parameters)
    curvature = np.swapaxes(slopes, -1, -2) @ slopes
    for j, (a, b) in enumerate(products):
        pull = -found @ rows.products[:, j]
        curvature[..., a, b] += pull
        curvature[..., b, a] += pull
    return (found[..., None, :] @ slopes)[..., 0, :], curvature


def _shortened(rows: EquationRows) -> EquationRows:
    """As many equations as columns, with the same sum of squares."""
    count, many = rows.terms.shape[1], rows.products.shape[1]
    table = np.linalg.qr(np.column_stack([rows.terms, rows.products, rows.target])).R
    return EquationRows(table[:, :count], table[:, count : count + many], table[:, -1])


def _from_form(rows: EquationRows, products: Products, common: int) -> tuple[FloatArray, list[str]]:
    """Stationary parameters from the roots of the form dS/dt = 0, and descriptions of what was left out."""
    partners = [b if a == common else a for a, b in products]
    others = [k for k in range(rows.terms.shape[1]) if k != common and k not in partners]

    def solved(c: float, s: float) -> tuple[FloatArray, FloatArray, float]:
        """Parameters except the factor, errors and determinant of the columns, with t = s / c."""
        columns = np.column_stack([rows.terms[:, others], c * rows.terms[:, partners] + s * rows.products])
        right = c * rows.target - s * rows.terms[:, common]
        volume = float(np.prod(np.diag(np.linalg.qr(columns).R)[len(others) :] ** 2))
        found = np.linalg.lstsq(columns, right, rcond=None)[0]
        return found, right - columns @ found, volume

    def slope(c: float, s: float) -> float:
        found, errors, volume = solved(c, s)
        return float(-errors @ (rows.terms[:, common] + rows.products @ found[len(others) :])) * volume**2

    turns = binary_roots(slope, 4 * len(products) + 1)
    starts, far = [], 0
    for turn in turns:
        c, s = float(np.cos(turn)), float(np.sin(turn))
        if abs(c) <= FAR:
            far += 1
            continue
        found = solved(c, s)[0]
        whole = np.empty(rows.terms.shape[1])
        whole[common], whole[others], whole[partners] = s / c, found[: len(others)] / c, found[len(others) :]
        starts.append(whole)
    words = [f"{far} infinitely far"] if far else []
    return np.array(starts).reshape(-1, rows.terms.shape[1]), words


def _from_grid(rows: EquationRows, products: Products) -> FloatArray:
    """Starts: least squares with one factor of each product given, on a grid of its values."""
    firsts = [a for a, _ in products]
    turns = np.tan(np.pi * (np.arange(STARTS) + 0.5) / STARTS - np.pi / 2)
    starts = []
    for values in itertools.product(turns, repeat=len(firsts)):
        columns, right = rows.terms.copy(), rows.target.copy()
        for j, (a, b) in enumerate(products):
            columns[:, b] += values[j] * rows.products[:, j]
            right = right - values[j] * rows.terms[:, a]
        columns[:, firsts] = 0
        found = np.linalg.lstsq(columns, right, rcond=None)[0]
        found[firsts] = values
        starts.append(found)
    return np.array(starts)


def _family() -> ParameterError:
    return ParameterError(
        "the equations of the approximation have a family of solutions, or are dependent",
        do="move a node, or remove a term that depends on the others",
    )
