"""Function generation: all four-bars whose crank and rocker take 3, 4 or 5 given pairs of angles.

    K + Re(Z e^{i psi_j}) - Re(W e^{i phi_j}) - Re(Q e^{i (psi_j - phi_j)}) = 0,      Q = Z conj(W)

Ground 1, crank W and rocker Z at rotation 0, phi_j and psi_j their rotations, 2 K = 1 + |Z|^2 + |W|^2 - coupler^2. With
given start angles, W and Z have one unknown each, and this is Freudenstein's equation R1 cos th4 - R2 cos th2 + R3 =
cos(th2 - th4), linear in three ratios. The equations of all pairs are linear in K, Z, W, Q:

    3 pairs, both start angles given    one four-bar
    4 pairs, one start angle given      a quadratic: none, 1 or 2
    5 pairs                             a cubic: 1, 2 or 3

With 4 and 5 pairs the solutions of the linear equations are p v + q w, and Q = Z conj(W) requires Im(Q conj(Z) W) = 0:
a binary form in p and q, so that roots at infinity are included. The scale is the factor Q / (Z conj(W)).
[Freudenstein, Approximate synthesis of four-bar linkages, Trans. ASME 77, 1955, for the equation and the numbers of
solutions; the solution by one linear system and one binary form is derived here.]
"""

import math
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from ilmek.arrays import Complex, Float, FloatArray
from ilmek.errors import ParameterError
from ilmek.synthesis.four_bar import FourBar
from ilmek.synthesis.function import Function
from ilmek.synthesis.task import require_angles
from ilmek.units import deg

FAMILY = 1e-12
"""Relative singular value of the linear equations below which they have a family of solutions."""

REAL = 1e-6
"""Imaginary part of a root, relative to its magnitude or 1, below which it is real: rounding splits double roots."""

ZERO_LENGTH = 1e-9
"""Relative length of a link below which it degenerates to a point."""

POINTS = {3: "both start angles given", 4: "one start angle given", 5: "no start angle given"}
"""Number of pairs of angles -> start angles to be given with them."""


class Generators(NamedTuple):
    """Four-bars drawn at the first pair of angles, the smallest link ratio first; and degenerate solutions, named."""

    four_bars: tuple[FourBar, ...]
    left_out: tuple[str, ...]


class _Forms(NamedTuple):
    """Solutions of the linear equations: W, Z and Q, each p times its first number plus q times its second."""

    crank: Complex[np.ndarray, "2"]
    rocker: Complex[np.ndarray, "2"]
    both: Complex[np.ndarray, "2"]


def function_generators(
    crank: FloatArray,
    rocker: FloatArray,
    *,
    crank_start: float | None = None,
    rocker_start: float | None = None,
    ground: float = 1.0,
) -> Generators:
    """All four-bars whose crank and rocker take given pairs of angles, start + rotation, relative to the ground link.

    crank, rocker              rotations of 3, 4 or 5 pairs [rad], shape (pairs,)
    crank_start, rocker_start  angles at rotation 0 [rad]: both for 3 pairs, one for 4, none for 5
    ground                     A0-B0 [m], along x from the origin

    Each four-bar is drawn at the first pair. A crank or rocker may point opposite to its start angle; its rotations are
    the same. Raises ParameterError for other numbers of pairs or start angles, equal pairs, angles in degrees, and
    where a family of four-bars takes the pairs.

    >>> found = function_generators(np.radians([0, 40, 80]), np.radians([0, 45, 70]), crank_start=0.6, rocker_start=1.2)
    >>> [round(length, 4) for length in found.four_bars[0].lengths]
    [1.0, 2.9173, 0.9356, 2.6485]
    """
    crank, rocker = np.asarray(crank, dtype=float), np.asarray(rocker, dtype=float)
    _check(crank, rocker, (crank_start, rocker_start), ground)
    axes = _axes(crank_start), _axes(rocker_start)
    forms = _forms(crank, rocker, *axes)
    bars: list[FourBar] = []
    left_out = []
    for root in _roots(forms, *axes):
        W, Z, Q = (complex(np.dot(form, root)) for form in forms)
        smallest = ZERO_LENGTH * max(abs(W), abs(Z), abs(Q))
        if min(abs(W), abs(Z), abs(Q)) <= smallest:
            left_out.append(_vanished(ground=abs(Q) > smallest))
            continue
        stretch = (Q / (Z * W.conjugate())).real
        a, b = stretch * W * np.exp(1j * crank[0]), 1 + stretch * Z * np.exp(1j * rocker[0])
        if abs(b - a) <= ZERO_LENGTH:
            left_out.append("the coupler degenerates to a point: crank and rocker meet in one pin")
        elif all(abs(a * ground - other.a) + abs(b * ground - other.b) > REAL * ground for other in bars):
            bars.append(FourBar(0j, complex(ground), complex(a * ground), complex(b * ground)))
    return Generators(tuple(sorted(bars, key=_evenness, reverse=True)), tuple(left_out))


def generators_of(
    function: Function,
    points: int,
    *,
    crank_start: float | None = None,
    rocker_start: float | None = None,
    ground: float = 1.0,
) -> Generators:
    """All four-bars that generate a function exactly at precision points with Chebyshev spacing.

    points                     number of precision points, 3, 4 or 5
    crank_start, rocker_start  angles at the start of the function [rad]; see `function_generators`
    ground                     A0-B0 [m]
    """
    task = function.task(function.nodes(points))
    starts = {"crank_start": crank_start, "rocker_start": rocker_start}
    crank, rocker = np.asarray(task.crank, dtype=float), np.asarray(task.rocker, dtype=float)
    return function_generators(crank, rocker, ground=ground, **starts)


def _axes(start: float | None) -> Complex[np.ndarray, " axes"]:
    """Unit vectors that span a link at rotation 0: its direction, or both axes where the direction is free."""
    return np.array([1, 1j] if start is None else [np.exp(1j * start)], dtype=complex)


def _forms(
    crank: FloatArray,
    rocker: FloatArray,
    crank_axes: Complex[np.ndarray, " crank_axes"],
    rocker_axes: Complex[np.ndarray, " rocker_axes"],
) -> _Forms:
    """Solutions of the linear equations of all pairs."""
    free = len(crank_axes) + len(rocker_axes) > 2
    both_axes = _axes(None) if free else rocker_axes * crank_axes.conjugate()
    columns = [
        *(-(axis * np.exp(1j * crank)).real for axis in crank_axes),
        *((axis * np.exp(1j * rocker)).real for axis in rocker_axes),
        *(-(axis * np.exp(1j * (rocker - crank))).real for axis in both_axes),
        np.ones(len(crank)),
    ]
    _, singular, right = np.linalg.svd(np.stack(columns, axis=-1))
    if singular[-1] <= FAMILY * singular[0]:
        raise _family()
    null = np.zeros((len(columns), 2))
    null[:, : len(columns) - len(crank)] = right[len(crank) :].T
    ends = np.cumsum([0, len(crank_axes), len(rocker_axes), len(both_axes)])
    parts = [null[start:stop] for start, stop in pairwise(ends)]
    axes = (crank_axes, rocker_axes, both_axes)
    return _Forms(*(np.asarray(axis @ part) for axis, part in zip(axes, parts, strict=True)))


def _roots(
    forms: _Forms, crank_axes: Complex[np.ndarray, " crank_axes"], rocker_axes: Complex[np.ndarray, " rocker_axes"]
) -> list[Float[np.ndarray, "2"]]:
    """All (p, q), up to a factor, with Im(Q conj(Z) W) = 0; a link with given direction counts as its direction."""
    if len(crank_axes) + len(rocker_axes) == 2:
        return [np.array([1.0, 0.0])]
    factors = [forms.both]
    factors += [forms.rocker.conj()] if len(rocker_axes) == 2 else []
    factors += [forms.crank] if len(crank_axes) == 2 else []
    known = np.prod([one[0] for one in (crank_axes, rocker_axes.conj()) if len(one) == 1])
    # With the direction of the greatest value as infinity, no root is at infinity.
    turns = np.linspace(0, np.pi, 8, endpoint=False)
    directions = np.stack([np.cos(turns), np.sin(turns)])
    values = np.abs(np.imag(known * np.prod([factor @ directions for factor in factors], axis=0)))
    if np.max(values) <= FAMILY * math.prod(float(np.linalg.norm(factor)) for factor in factors):
        raise _family()
    far = directions[:, np.argmax(values)]
    near = np.array([-far[1], far[0]])
    form = np.array([known])
    for factor in factors:
        form = np.convolve(form, [factor @ near, factor @ far])
    roots = np.polynomial.polynomial.polyroots(form.imag)
    return [near + root.real * far for root in roots if abs(root.imag) <= REAL * max(1.0, abs(root))]


def _vanished(*, ground: bool) -> str:
    if ground:
        return "the ground degenerates to a point: crank and rocker on one pivot, infinitely long"
    return "crank or rocker degenerates to a point"


def _evenness(one: FourBar) -> float:
    return min(one.lengths) / max(one.lengths)


def _family() -> ParameterError:
    return ParameterError(
        "a family of four-bars takes these pairs of angles",
        allowed="independent pairs",
        do="change a pair: with equal rotations of crank and rocker, or one of them at rest, a length is free",
    )


def _check(crank: FloatArray, rocker: FloatArray, starts: tuple[float | None, float | None], ground: float) -> None:
    if crank.shape != rocker.shape or crank.ndim != 1:
        given = f"rotations of crank and rocker of shapes {crank.shape} and {rocker.shape}"
        raise ParameterError(given, allowed="two lists of one length")
    _check_count(len(crank), sum(start is not None for start in starts))
    for name, rotations in (("crank rotation", crank), ("rocker rotation", rocker)):
        require_angles(name, rotations)
    for name, start in zip(("crank_start", "rocker_start"), starts, strict=True):
        if start is not None and not abs(start) <= 2 * math.pi:
            guess = f"{start:g} deg is {start * deg:.6g} rad" if math.isfinite(start) else ""
            raise ParameterError(f"{name} {start:g} rad", allowed="within a turn, 6.283 rad", do=guess)
    if not (math.isfinite(ground) and ground > 0):
        raise ParameterError(f"ground {ground:g} m", allowed="finite and above 0")
    pairs = np.stack([np.exp(1j * crank), np.exp(1j * rocker)])
    for one in range(len(crank)):
        for other in range(one):
            if np.max(np.abs(pairs[:, one] - pairs[:, other])) < ZERO_LENGTH:
                raise ParameterError(f"pairs {other + 1} and {one + 1} are the same", do="give different pairs")


def _check_count(pairs: int, starts: int) -> None:
    if pairs not in POINTS:
        whole = "`function_approximations` fits the whole range by least squares or minimax"
        more = whole if pairs > 5 else "give at least three"
        allowed = ", ".join(f"{count} with {what}" for count, what in POINTS.items())
        raise ParameterError(f"function generation through {pairs} pairs of angles", allowed=allowed, do=more)
    if starts != 5 - pairs:
        fits = POINTS.get(5 - starts, "")
        given = f"{pairs} pairs of angles and {starts} start angle{'' if starts == 1 else 's'}"
        raise ParameterError(given, allowed=f"{pairs} pairs go with {POINTS[pairs]}", do=f"{fits}: {5 - starts} pairs")
