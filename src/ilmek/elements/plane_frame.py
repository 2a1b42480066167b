"""Natural frequencies of a plane frame of beams, rigidly joined, with masses at its nodes.

    K u = w² M u,    w² lowest eigenvalues

Each member is a Euler-Bernoulli beam with its consistent mass, stiff along itself too, in elements of cubic deflection:
their error falls with the fourth power of their length.         [Przemieniecki, Matrix Structural Analysis, 11]
Positions are complex [m]; a node moves along x and y and turns.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from scipy.sparse import csc_array
from scipy.sparse.linalg import splu

from ilmek.arrays import ComplexArray, Float, FloatArray
from ilmek.errors import ParameterError

ELEMENTS = 2
"""Elements of a member: the first mode of a member by itself is then exact to 0.4 %."""

_NOTHING = 1e-12
"""Share of a stiffness that counts as rounding."""

_BESIDE, _MOST = 4, 100
"""Vectors of the iteration beside those that are asked for, and its steps at most."""

_SETTLED = 1e-14
"""Change of the eigenvalues in a step that counts as rounding, of their size."""

_DEPENDENT = 1e-12
"""Size of a vector's own share of the subspace, of the greatest, that counts as rounding."""

_BENT = np.array([[12.0, 6, -12, 6], [6, 4, -6, 2], [-12, -6, 12, -6], [6, 2, -6, 4]])
_SHAKEN = np.array([[156.0, 22, 54, -13], [22, 4, 13, -3], [54, 13, 156, -22], [-13, -3, -22, 4]])
_ALONG, _ACROSS = np.array([0, 3]), np.array([1, 2, 4, 5])


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
    slowness = _greatest(*_supported(nodes, members, supports, masses, modulus), count)
    # Eigenvalues differ in their last digits from machine to machine: ten digits are the same on every one.
    return np.array([float(f"{frequency:.10g}") for frequency in 1 / np.sqrt(slowness) / (2 * math.pi)])


def vibrates_above(
    nodes: Sequence[complex],
    members: Sequence[FrameMember],
    supports: Mapping[int, tuple[bool, bool, bool]],
    masses: Mapping[int, float],
    modulus: float,
    *,
    frequency: float,
) -> bool:
    """Whether all natural frequencies of the frame are above one [Hz]: K - w² M is positive definite. Arguments as of
    `frame_frequencies`, of which one takes about ten times as long.

    >>> steel = FrameMember(0, 1, 1e-3, 1e-6, 7.85)
    >>> clamped = {0: (True, True, True)}
    >>> [vibrates_above([0j, 1j], [steel], clamped, {}, 210e9, frequency=hz) for hz in (91.56, 91.58)]
    [True, False]
    """
    stiffness, inertia = _supported(nodes, members, supports, masses, modulus)
    try:
        np.linalg.cholesky(stiffness - (2 * math.pi * frequency) ** 2 * inertia)
    except np.linalg.LinAlgError:
        return False
    return True


def _supported(
    nodes: Sequence[complex],
    members: Sequence[FrameMember],
    supports: Mapping[int, tuple[bool, bool, bool]],
    masses: Mapping[int, float],
    modulus: float,
) -> tuple[FloatArray, FloatArray]:
    """Stiffness and mass of the frame with its masses, in the directions in which it is free."""
    stiffness, bare = _assembled(tuple(nodes), tuple(members), modulus)
    inertia = bare.copy()
    for node, mass in masses.items():
        inertia[3 * node, 3 * node] += mass
        inertia[3 * node + 1, 3 * node + 1] += mass
    fixed = [3 * node + direction for node, held in supports.items() for direction in range(3) if held[direction]]
    free = np.delete(np.arange(len(stiffness)), fixed)
    return stiffness[np.ix_(free, free)], inertia[np.ix_(free, free)]


def _greatest(stiffness: FloatArray, inertia: FloatArray, count: int) -> FloatArray:
    """The greatest eigenvalues 1 / w², descending: by iteration of a subspace with K^-1 M.

    [Bathe, Finite Element Procedures, 11.6]
    """
    try:
        factors = splu(csc_array(stiffness), "MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options={"SymmetricMode": True})
    except RuntimeError:  # exactly singular
        raise _loose() from None
    if np.min(factors.U.diagonal() / np.diag(stiffness)[np.argsort(factors.perm_c)]) < _NOTHING:
        raise _loose()
    slowness = np.zeros(count)
    vectors = np.random.default_rng(0).standard_normal((len(inertia), min(count + _BESIDE, len(inertia))))
    for _ in range(_MOST):
        shaken = inertia @ vectors
        bent = factors.solve(shaken)
        size, along = np.linalg.eigh(bent.T @ shaken)
        some = size > _DEPENDENT * size[-1]  # fewer where few nodes have mass
        bent = bent @ (along[:, some] / np.sqrt(size[some]))
        values, turned = np.linalg.eigh(bent.T @ (inertia @ bent))
        vectors = bent @ (turned / np.sqrt(values))
        before, slowness = slowness, values[::-1][:count]
        if np.all(np.abs(slowness - before) <= _SETTLED * slowness):
            break
    return slowness


def _loose() -> ParameterError:
    return ParameterError("a frame that moves as a mechanism", do="hold its feet, or join its members")


@lru_cache(maxsize=64)
def _assembled(
    nodes: tuple[complex, ...], members: tuple[FrameMember, ...], modulus: float
) -> tuple[FloatArray, FloatArray]:
    """Stiffness and mass of all members; nodes between the elements of a member follow those of the frame."""
    size = 3 * (len(nodes) + (ELEMENTS - 1) * len(members))
    own = np.array([(member.start, member.end, member.area, member.inertia, member.line_mass) for member in members])
    ends = own[:, :2].astype(int)
    inner = len(nodes) + np.arange((ELEMENTS - 1) * len(members)).reshape(len(members), -1)
    at = np.array(nodes)
    h = (at[ends[:, 1]] - at[ends[:, 0]]) / ELEMENTS
    k, m = _elements(h, own[:, 2], own[:, 3], own[:, 4], modulus)
    stiffness, inertia = np.zeros((size, size)), np.zeros((size, size))
    chain = np.column_stack([ends[:, 0], inner, ends[:, 1]])
    for both in (chain[:, number : number + 2] for number in range(ELEMENTS)):
        ways = (3 * both[:, :, None] + np.arange(3)).reshape(-1, 6)
        here = ways[:, :, None], ways[:, None, :]
        np.add.at(stiffness, here, k)
        np.add.at(inertia, here, m)
    for kept in (stiffness, inertia):
        kept.setflags(write=False)
    return stiffness, inertia


def _elements(
    line: ComplexArray, area: FloatArray, inertia: FloatArray, line_mass: FloatArray, modulus: float
) -> tuple[Float[np.ndarray, "n 6 6"], Float[np.ndarray, "n 6 6"]]:
    """Stiffness and mass of elements along lines [m] in the axes of the frame."""
    h, one = np.abs(line), np.ones(len(line))
    scale = np.stack([one, h, one, h], axis=1)
    across = scale[:, :, None] * scale[:, None, :]
    k, m, turned = (np.zeros((len(line), 6, 6)) for _ in range(3))
    k[:, _ALONG[:, None], _ALONG] = (modulus * area / h)[:, None, None] * np.array([[1.0, -1], [-1, 1]])
    m[:, _ALONG[:, None], _ALONG] = (line_mass * h / 6)[:, None, None] * np.array([[2.0, 1], [1, 2]])
    k[:, _ACROSS[:, None], _ACROSS] = (modulus * inertia / h**3)[:, None, None] * _BENT * across
    m[:, _ACROSS[:, None], _ACROSS] = (line_mass * h / 420)[:, None, None] * _SHAKEN * across
    c, s = line.real / h, line.imag / h
    for first in (0, 3):
        turned[:, first, first] = turned[:, first + 1, first + 1] = c
        turned[:, first, first + 1], turned[:, first + 1, first] = s, -s
        turned[:, first + 2, first + 2] = 1.0
    back = turned.swapaxes(1, 2)
    return back @ k @ turned, back @ m @ turned
