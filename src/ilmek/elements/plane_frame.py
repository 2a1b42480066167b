"""Natural frequencies of a plane frame of beams, rigidly joined, with masses at its nodes.

    K u = w² M u,    w² lowest eigenvalues

Each member is a Euler-Bernoulli beam with its consistent mass, stiff along itself too, in elements of cubic deflection:
their error falls with the fourth power of their length.         [Przemieniecki, Matrix Structural Analysis, 11]
Positions are complex [m]; a node moves along x and y and turns.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.errors import ParameterError

ELEMENTS = 2
"""Elements of a member: the first mode of a member by itself is then exact to 0.4 %."""

_NOTHING = 1e-12
"""Share of a stiffness that counts as rounding."""

_BENT = np.array([[12.0, 6, -12, 6], [6, 4, -6, 2], [-12, -6, 12, -6], [6, 2, -6, 4]])
_SHAKEN = np.array([[156.0, 22, 54, -13], [22, 4, 13, -3], [54, 13, 156, -22], [-13, -3, -22, 4]])
_ALONG, _ACROSS = [0, 3], [1, 2, 4, 5]


@dataclass(frozen=True, slots=True)
class FrameMember:
    """A beam from a node to another: area [m²], second moment of area [m⁴], mass per length [kg/m]."""

    start: int
    end: int
    area: float
    inertia: float
    line_mass: float


def frame_frequencies(
    nodes: Sequence[complex],
    members: Sequence[FrameMember],
    supports: Mapping[int, tuple[bool, bool, bool]],
    masses: Mapping[int, float],
    modulus: float,
    *,
    count: int = 1,
) -> FloatArray:
    """The lowest natural frequencies [Hz], ascending, (count,).

    supports  by node: whether it is held along x, along y, and against turning      masses  by node [kg]
    modulus   Young's [Pa]
    Raises ParameterError for a frame that its supports do not hold.

    >>> steel = FrameMember(0, 1, 1e-3, 1e-6, 7.85)
    >>> clamped = {0: (True, True, True)}
    >>> round(float(frame_frequencies([0j, 1j], [steel], clamped, {}, 210e9)[0]), 2)  # 3.516 sqrt(E I / m) / (2 pi l²)
    91.57
    """
    stiffness, inertia = _assembled(nodes, members, modulus)
    for node, mass in masses.items():
        inertia[3 * node, 3 * node] += mass
        inertia[3 * node + 1, 3 * node + 1] += mass
    fixed = [3 * node + direction for node, held in supports.items() for direction in range(3) if held[direction]]
    free = np.setdiff1d(np.arange(len(stiffness)), fixed)
    held = stiffness[np.ix_(free, free)]
    try:
        lower = np.linalg.cholesky(held)
    except np.linalg.LinAlgError:
        lower = np.zeros_like(held)
    if np.min(np.diag(lower) ** 2 / np.diag(held)) < _NOTHING:
        raise ParameterError("a frame that moves as a mechanism", do="hold its feet, or join its members")
    half = np.linalg.solve(lower, inertia[np.ix_(free, free)])
    slowness = np.linalg.eigvalsh(np.linalg.solve(lower, half.T))[::-1][:count]
    # Eigenvalues differ in their last digits by the number of threads: ten digits are the same on every machine.
    return np.array([float(f"{one:.10g}") for one in 1 / np.sqrt(slowness) / (2 * math.pi)])


def _assembled(
    nodes: Sequence[complex], members: Sequence[FrameMember], modulus: float
) -> tuple[FloatArray, FloatArray]:
    """Stiffness and mass of all members; nodes between the elements of a member follow those of the frame."""
    size = 3 * (len(nodes) + (ELEMENTS - 1) * len(members))
    stiffness, inertia, after = np.zeros((size, size)), np.zeros((size, size)), len(nodes)
    for own in members:
        line = nodes[own.end] - nodes[own.start]
        inner = list(range(after, after + ELEMENTS - 1))
        after += ELEMENTS - 1
        k, m = _element(own, line / ELEMENTS, modulus)
        chain = [own.start, *inner, own.end]
        for first, last in pairwise(chain):
            ways = np.ix_(*2 * [[*range(3 * first, 3 * first + 3), *range(3 * last, 3 * last + 3)]])
            stiffness[ways] += k
            inertia[ways] += m
    return stiffness, inertia


def _element(own: FrameMember, line: complex, modulus: float) -> tuple[FloatArray, FloatArray]:
    """Stiffness and mass of an element in the axes of the frame, (6, 6)."""
    h = abs(line)
    scale = np.array([1.0, h, 1.0, h])
    k, m = np.zeros((6, 6)), np.zeros((6, 6))
    k[np.ix_(_ALONG, _ALONG)] = modulus * own.area / h * np.array([[1.0, -1], [-1, 1]])
    m[np.ix_(_ALONG, _ALONG)] = own.line_mass * h / 6 * np.array([[2.0, 1], [1, 2]])
    k[np.ix_(_ACROSS, _ACROSS)] = modulus * own.inertia / h**3 * _BENT * np.outer(scale, scale)
    m[np.ix_(_ACROSS, _ACROSS)] = own.line_mass * h / 420 * _SHAKEN * np.outer(scale, scale)
    c, s = line.real / h, line.imag / h
    turned = np.kron(np.eye(2), np.array([[c, s, 0.0], [-s, c, 0.0], [0.0, 0.0, 1.0]]))
    return turned.T @ k @ turned, turned.T @ m @ turned
