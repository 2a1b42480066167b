"""Critical speeds of a shaft: natural frequencies of bending, with masses, on any supports.

    uniform, alone:   w = (βl)² sqrt(E I / m') / l²,   βl = n π (hinged), cos βl cosh βl = -1 (cantilever), +1 (clamped)

`frequencies` is the finite element solution: cubic beams with their consistent mass. Its error falls with the fourth
power of their length, (π / n)⁴ / 1440 for n elements in a half wave: 2e-7 for the first mode of one span. Gyroscopic
moments are neglected: they raise the critical speed of a forward whirl.
                                              [Rao, Mechanical Vibrations, 8.5; Shigley, 7-6; Przemieniecki, 11.3]
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.elements.beam.model import Beam
from ilmek.errors import ParameterError
from ilmek.units import format_quantity

_ELEMENTS = 24


@dataclass(frozen=True, slots=True)
class Mass:
    """A mass [kg] on the shaft at a position [m]."""

    at: float
    mass: float


def uniform_root(mode: int, ends: str) -> float:
    """Root βl [1] of a uniform beam's mode, from 1 on.

    ends  "hinged", "cantilever", "clamped" or "propped" (clamped, hinged). Raises ParameterError for another name.

    >>> [round(uniform_root(mode, "cantilever") ** 2, 3) for mode in (1, 2, 3)]
    [3.516, 22.034, 61.697]
    """
    if ends == "hinged":
        return mode * math.pi
    if ends == "propped":
        root = (mode + 0.25) * math.pi
        for _ in range(8):
            root = mode * math.pi + math.atan(math.tanh(root))
        return root
    if ends not in ("cantilever", "clamped"):
        raise ParameterError(f"ends {ends!r}", allowed="hinged, cantilever, clamped or propped")
    turn = -1.0 if ends == "cantilever" else 1.0
    root = (mode + turn / 2) * math.pi
    for _ in range(12):
        value = math.cos(root) - turn / math.cosh(root)
        root -= value / (turn * math.tanh(root) / math.cosh(root) - math.sin(root))
    return root


def uniform_speed(mode: int, ends: str, length: float, rigidity: float, linear_density: float) -> float:
    """Critical speed [rad/s] of a uniform shaft without masses: (βl)² sqrt(E I / m') / l².

    mode, ends  as for `uniform_root`      length  [m]      rigidity  E I [N m²]      linear_density  m' [kg/m]
    """
    return (uniform_root(mode, ends) / length) ** 2 * math.sqrt(rigidity / linear_density)


def frequencies(
    beam: Beam, rigidity: float, linear_density: float, masses: Sequence[Mass] = (), *, count: int = 3
) -> FloatArray:
    """The lowest natural frequencies [rad/s], equal to the critical speeds, ascending, (count,) or fewer.

    beam            its supports and clamped ends; loads do not matter      rigidity  E I [N m²]
    linear_density  [kg/m]; 0 for a shaft without mass, which then needs masses
    """
    _check(beam, linear_density, masses)
    nodes = _nodes(beam, masses)
    index = {float(at): number for number, at in enumerate(nodes)}
    stiffness, inertia = _assembled(nodes, rigidity, linear_density)
    for mass in masses:
        inertia[2 * index[mass.at], 2 * index[mass.at]] += mass.mass
    fixed = [2 * index[at] for at in beam.supports] + [2 * index[at] + 1 for at in beam.clamped]
    free = np.setdiff1d(np.arange(2 * len(nodes)), fixed)
    lower = np.linalg.cholesky(stiffness[np.ix_(free, free)])
    reduced = np.linalg.solve(lower, np.linalg.solve(lower, inertia[np.ix_(free, free)]).T)
    slowness = np.linalg.eigvalsh((reduced + reduced.T) / 2)[::-1][:count]
    return np.asarray(1 / np.sqrt(slowness[slowness > slowness[0] * 1e-12]))


def _check(beam: Beam, linear_density: float, masses: Sequence[Mass]) -> None:
    off = [mass.at for mass in masses if not 0 <= mass.at <= beam.length]
    if off:
        raise ParameterError(
            f"a mass at {format_quantity(off[0], 'mm')}",
            allowed=f"0 to {format_quantity(beam.length, 'mm')}, the shaft's length",
        )
    if not (linear_density > 0 or any(mass.mass > 0 and mass.at not in beam.supports for mass in masses)):
        raise ParameterError("a shaft without mass and nothing on it", do="give it a mass along it, or masses on it")


def _nodes(beam: Beam, masses: Sequence[Mass]) -> FloatArray:
    """Ends, supports and masses, with nodes between them: spacing length / 24 or less, six or more elements per gap."""
    fixed = sorted({0.0, beam.length, *beam.supports, *(mass.at for mass in masses)})
    parts = [max(6, math.ceil(_ELEMENTS * (right - left) / beam.length)) for left, right in pairwise(fixed)]
    made = [np.linspace(left, right, n + 1)[:-1] for (left, right), n in zip(pairwise(fixed), parts, strict=True)]
    return np.array([*np.concatenate(made), beam.length])


def _assembled(nodes: FloatArray, rigidity: float, linear_density: float) -> tuple[FloatArray, FloatArray]:
    """Stiffness and mass by deflection and slope of each node."""
    size = 2 * len(nodes)
    stiffness, inertia = np.zeros((size, size)), np.zeros((size, size))
    h = np.diff(nodes)[:, None, None]
    scale = np.where(np.arange(4) % 2 == 1, h[:, 0], 1.0)
    across = scale[:, :, None] * scale[:, None, :]
    part = 2 * np.arange(len(h))[:, None] + np.arange(4)
    at = part[:, :, None], part[:, None, :]
    np.add.at(stiffness, at, rigidity / h**3 * _STIFFNESS * across)
    np.add.at(inertia, at, linear_density * h / 420 * _INERTIA * across)
    return stiffness, inertia


_STIFFNESS = np.array([[12.0, 6, -12, 6], [6, 4, -6, 2], [-12, -6, 12, -6], [6, 2, -6, 4]])
_INERTIA = np.array([[156.0, 22, 54, -13], [22, 4, 13, -3], [54, 13, 156, -22], [-13, -3, -22, 4]])
