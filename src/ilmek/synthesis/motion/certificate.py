"""Proof that a four-bar takes its poses: beside the computed pivot and pin of each link there is an exact one.

A link takes poses 2 to n where f_k(z) = |w_k - m|² - |w_1 - m|² = 0, with z = (m, w) four real numbers. The rows of the
Jacobian are completed by an orthonormal basis of its null space to a square matrix J, A is its inverse nearly, and on
the box z + [-r, r]⁴ the operator of Krawczyk

    K = z - A F(z) + (1 - A J(box)) [-r, r]⁴

lies inside the box if |A F(z)| + |1 - A J(box)| r < r in the maximum norm: then the box contains a solution. F is
quadratic, so every number of J(box) is within 16 r of J(z); rounding errors are bounded by the magnitudes of the terms.
[Krawczyk 1969; Neumaier, Interval Methods for Systems of Equations, 5.1; the bounds of rounding: Higham, chapter 3]
"""

import numpy as np

from ilmek.arrays import Complex, ComplexArray, FloatArray
from ilmek.params.text_lists import BodyPoses
from ilmek.plane.vectors import unit
from ilmek.report.check import ROUNDING

RADIUS = 1e-9
"""Greatest distance of the exact link from the computed one, in sizes of the task."""

ROUNDED = 128 * np.finfo(float).eps
"""Bound on the relative rounding error of a sum of products of at most twenty factors, sine and cosine included."""


def certified(pins: Complex[np.ndarray, "4"], poses: BodyPoses) -> bool:
    """Whether both links are proven to be within 1e-9 of the task's size of links that take all poses exactly.

    pins  pivots A0, B0 and pins A, B at the first pose [m]      poses  [m, rad]

    >>> poses = BodyPoses(np.array([1j, 0.6 + 0.8j, 0.8 + 0.6j]), np.zeros(3))  # on a unit circle, without rotation
    >>> certified(np.array([0j, 2 + 0j, 1j, 2 + 1j]), poses), certified(np.array([0j, 2 + 0j, 1.1j, 2 + 1j]), poses)
    (True, False)
    """
    points, angles = poses
    size = float(np.max(np.abs(points - points[0]))) or float(np.max(np.abs(pins - pins[0])))
    turned = np.asarray(unit(angles - angles[0]))
    shifts = (points - points[0]) / size
    far = 1 + float(np.max(np.abs(points))) / size
    ends = (pins - points[0]) / size
    return all(_proven(complex(ends[at]), complex(ends[at + 2]), shifts, turned, far) for at in range(2))


def _proven(m: complex, w: complex, shifts: ComplexArray, turned: ComplexArray, far: float) -> bool:
    """Whether an exact link is within `RADIUS` of pivot m and pin w; far  magnitude of the given positions."""
    away = shifts + w * turned - m
    values = np.abs(away[1:]) ** 2 - abs(away[0]) ** 2
    to_pivot = -2 * (away[1:] - away[0])
    to_pin = 2 * (away[1:] * np.conj(turned[1:]) - away[0])
    slopes = np.stack([to_pivot.real, to_pivot.imag, to_pin.real, to_pin.imag], axis=-1)
    matrix = _completed(slopes)
    inverse = np.linalg.pinv(matrix)
    reach = far + abs(m) + abs(w)
    errors = np.zeros(4)
    errors[: len(values)] = ROUNDED * reach**2
    residual = np.zeros(4)
    residual[: len(values)] = values
    size = np.abs(inverse)
    newton = float(np.max(np.abs(inverse @ residual) + size @ errors))
    # Over the box a slope changes by 2 |1 - turned| r and less than 16 r altogether; its rounding adds to it.
    spread = np.zeros((4, 4))
    spread[: len(values)] = 16 * RADIUS + ROUNDED * reach
    apart = np.abs(np.eye(4) - inverse @ matrix) + size @ (spread + ROUNDED * np.abs(matrix))
    shrink = float(np.max(np.sum(apart, axis=1)))
    return (newton + shrink * RADIUS) * (1 + ROUNDING) < RADIUS


def _completed(slopes: FloatArray) -> FloatArray:
    """The Jacobian with an orthonormal basis of its null space as further rows: a square matrix."""
    _, _, basis = np.linalg.svd(slopes)
    return np.concatenate([slopes, basis[len(slopes) :]])
