# ruff: noqa: PLR0917 - compiled functions take their arguments by position
"""Equations of a four-bar at positions of its coupler: poses, and points at which the coupler's angle is free.

    (d_j + T_j x - A) (d'_j + x' / T_j - A') = (x - A) (x' - A')

for each of the two links and each position j but the first, the reference. A is the ground pivot and x the moving pin
at the reference, relative to the tracer there; d_j is the tracer's displacement and T_j = exp(i theta_j) the coupler's
rotation: the link has its length at every position. Primed quantities are the complex conjugates for a real four-bar;
the equations treat them as independent numbers, so that they are polynomials (isotropic coordinates). Without products
of large numbers that cancel where a pivot or a pin is far away:

    p e' + p' e + d (x' - A') + d' (x - A) + d d' = 0,    p = (T - 1) x,  p' = (1/T - 1) x',  e = d - A,  e' = d' - A'

A pose gives T_j: two equations. At a point T_j is unknown: the two equations are joined to one. Eight equations
determine the eight unknowns u = A, A', x, x' of both links.
[Wampler, Morgan and Sommese, Complete solution of the nine-point path synthesis problem for four-bar linkages, 1992;
 Brake, Hauenstein, Murray, Myszka and Wampler, The complete solution of Alt-Burmester synthesis problems, 2016]
"""

from typing import TypeAlias

import numpy as np

from ilmek.arrays import Bool, Complex, Float, Int
from ilmek.num.compiled import compiled

UNKNOWNS = 8
"""Number of unknowns u, and of equations after the rotations are eliminated."""

Unknowns: TypeAlias = Complex[np.ndarray, "8"]
Positions: TypeAlias = Complex[np.ndarray, " positions"]
Poses: TypeAlias = Bool[np.ndarray, " positions"]
"""Whether the coupler's angle is given, of each position."""

LinkValues: TypeAlias = Complex[np.ndarray, "positions 2"]
PinVectors: TypeAlias = Complex[np.ndarray, "2 positions 2"]
Square: TypeAlias = Complex[np.ndarray, "8 8"]
Order: TypeAlias = Int[np.ndarray, "8"]


@compiled
def abs2(z: complex) -> float:
    """Squared magnitude."""
    return z.real * z.real + z.imag * z.imag


@compiled
def reciprocal(z: complex) -> complex:
    """1/z; not finite for 0, where the division of complex numbers would raise."""
    scale = 1.0 / abs2(z)
    return complex(z.real * scale, -z.imag * scale)


@compiled
def products(u: Unknowns, T: Positions, d: Positions, primed: Positions, p: PinVectors, e: PinVectors) -> None:
    """Vectors p[0], p[1] = p' and e[0], e[1] = e' of both links at each position."""
    for link in range(2):
        at = 4 * link
        for j in range(T.size):
            p[0, j, link] = (T[j] - 1.0) * u[at + 2]
            p[1, j, link] = (reciprocal(T[j]) - 1.0) * u[at + 3]
            e[0, j, link] = d[j] - u[at]
            e[1, j, link] = primed[j] - u[at + 1]


@compiled
def linearised(
    u: Unknowns,
    T: Positions,
    pose: Poses,
    d: Positions,
    primed: Positions,
    p: PinVectors,
    e: PinVectors,
    matrix: Square,
    weights: LinkValues,
) -> None:
    """Matrix of the eight equations for changes of u, and weights: the derivatives of both links' equations by log T.

    A point's row is that of the first link times the second link's weight minus that of the second times the first's.
    """
    row = 0
    for j in range(T.size):
        inverse = reciprocal(T[j])
        for link in range(2):
            at = 4 * link
            weights[j, link] = T[j] * u[at + 2] * e[1, j, link] - inverse * u[at + 3] * e[0, j, link]
        for link in range(2):
            at = 4 * link
            to = row + link if pose[j] else row
            factor = 1.0 + 0.0j
            if not pose[j]:
                factor = weights[j, 1] if link == 0 else -weights[j, 0]
            else:
                for column in range(UNKNOWNS):
                    matrix[to, column] = 0.0
            matrix[to, at] = factor * (-p[1, j, link] - primed[j])
            matrix[to, at + 1] = factor * (-p[0, j, link] - d[j])
            matrix[to, at + 2] = factor * ((T[j] - 1.0) * e[1, j, link] + primed[j])
            matrix[to, at + 3] = factor * ((inverse - 1.0) * e[0, j, link] + d[j])
        row += 2 if pose[j] else 1


@compiled
def joined(pose: Poses, values: LinkValues, weights: LinkValues, right: Unknowns) -> None:
    """Right-hand side of the eight equations from the values (positions, 2) of both links' equations, negated."""
    row = 0
    for j in range(pose.size):
        if pose[j]:
            right[row] = -values[j, 0]
            right[row + 1] = -values[j, 1]
            row += 2
        else:
            right[row] = weights[j, 0] * values[j, 1] - weights[j, 1] * values[j, 0]
            row += 1


@compiled
def rotation_step(
    change: Unknowns,
    T: Positions,
    d: Positions,
    primed: Positions,
    p: PinVectors,
    e: PinVectors,
    values: LinkValues,
    weights: LinkValues,
    j: int,
) -> complex:
    """Change of log T of a point from the changes of u, by the equation with the greater weight."""
    link = 0
    if abs2(weights[j, 1]) > abs2(weights[j, 0]):
        link = 1
    at = 4 * link
    total = values[j, link]
    total -= (p[1, j, link] + primed[j]) * change[at] + (p[0, j, link] + d[j]) * change[at + 1]
    total += ((T[j] - 1.0) * e[1, j, link] + primed[j]) * change[at + 2]
    total += ((reciprocal(T[j]) - 1.0) * e[0, j, link] + d[j]) * change[at + 3]
    change_of_log: complex = -total * reciprocal(weights[j, link])
    return change_of_log


@compiled
def row_scales(matrix: Square, scale: Float[np.ndarray, "8"]) -> bool:
    """Reciprocals of the greatest squared magnitude of each row; whether all are finite and above 0."""
    regular = True
    for i in range(scale.size):
        most = 0.0
        for k in range(scale.size):
            most = max(most, abs2(matrix[i, k]))
        regular = regular and 0.0 < most < np.inf
        scale[i] = 1.0 / most
    return regular


@compiled
def factorise(matrix: Square, order: Order, scale: Float[np.ndarray, "8"]) -> bool:
    """LU factors of a square matrix in place, with pivoting of scaled rows; whether it is regular."""
    size = order.size
    if not row_scales(matrix, scale):
        return False
    for k in range(size):
        best, pivot = 0.0, k
        for i in range(k, size):
            here = abs2(matrix[i, k]) * scale[i]
            if here > best:
                best, pivot = here, i
        if best == 0.0:
            return False
        order[k] = pivot
        scale[pivot] = scale[k]
        for column in range(size):
            matrix[k, column], matrix[pivot, column] = matrix[pivot, column], matrix[k, column]
        matrix[k, k] = reciprocal(matrix[k, k])
        for i in range(k + 1, size):
            factor = matrix[i, k] * matrix[k, k]
            matrix[i, k] = factor
            for column in range(k + 1, size):
                matrix[i, column] -= factor * matrix[k, column]
    return True


@compiled
def substitute(matrix: Square, order: Order, right: Unknowns) -> None:
    """Solution of the factorised system, in place of the right-hand side."""
    size = order.size
    for k in range(size):
        pivot = order[k]
        if pivot != k:
            right[k], right[pivot] = right[pivot], right[k]
    for i in range(1, size):
        total = right[i]
        for k in range(i):
            total -= matrix[i, k] * right[k]
        right[i] = total
    for i in range(size - 1, -1, -1):
        total = right[i]
        for k in range(i + 1, size):
            total -= matrix[i, k] * right[k]
        right[i] = total * matrix[i, i]
