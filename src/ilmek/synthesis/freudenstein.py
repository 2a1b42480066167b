"""Function generation: four-bars whose rocker and crank take 3, 4 or 5 pairs of angles, all of them.

    K + Re(Z e^{i psi_j}) - Re(W e^{i phi_j}) - Re(Q e^{i (psi_j - phi_j)}) = 0,      Q = Z conj(W)

Ground 1, crank W and rocker Z at turn zero, phi_j and psi_j their turns, 2 K = 1 + |Z|^2 + |W|^2 - coupler^2. With the
start angles said, W and Z have one unknown each, and this is Freudenstein's equation R1 cos th4 - R2 cos th2 + R3 =
cos(th2 - th4), linear in three ratios. The equations of all pairs are linear in K, Z, W, Q together:

    3 pairs, both start angles given    one four-bar
    4 pairs, one start angle given      a quadratic: none, 1 or 2
    5 pairs                             a cubic: 1, 2 or 3

With 4 and 5 pairs what solves the linear equations is p v + q w, and Q = Z conj(W) asks that Im(Q conj(Z) W) = 0: a
binary form in p and q, so that no root is lost at infinity. Its scale follows: the factor Q / (Z conj(W)).
[Freudenstein, Approximate synthesis of four-bar linkages, Trans. ASME 77, 1955, for the equation and the counts; the
solution by one linear system and one binary form is derived here.]
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
"""Singular value of the linear equations, of the greatest, below which they leave a whole family of four-bars."""

REAL = 1e-6
"""Imaginary part of a root, of its size or 1, below which it is real: rounding splits a double root so far."""

NOTHING = 1e-9
"""A link of this length against the others has shrunk to a point."""

POINTS = {3: "both start angles given", 4: "one start angle given", 5: "no start angle given"}
"""Pairs of angles, and what has to be said with them."""


class Generators(NamedTuple):
    """Four-bars drawn at the first pair of angles, the least unequal links first, and in words what is no four-bar."""

    four_bars: tuple[FourBar, ...]
    left_out: tuple[str, ...]


class _Forms(NamedTuple):
    """What solves the linear equations: W, Z and Q, each p times its first number and q times its second."""

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
    """All four-bars whose crank and rocker take pairs of angles: start + turn for each [rad], against the ground link.

    crank, rocker  turns of 3, 4 or 5 pairs      ground  A0-B0 [m], along x from the origin
    crank_start, rocker_start  angles at turn zero: both for 3 pairs, one for 4, none for 5

    Each four-bar is drawn at the first pair. A crank or rocker that comes out negative points away from its start
    angle; its turns are the same. Raises ParameterError for too few or too many pairs or start angles, pairs given
    twice, degrees, and where a whole family of four-bars does it.

    >>> found = function_generators(np.radians([0, 40, 80]), np.radians([0, 45, 70]), crank_start=0.6, rocker_start=1.2)
    >>> [round(length, 4) for length in found.four_bars[0].lengths]
    [1.0, 2.9173, 0.9356, 2.6485]
    """
    crank, rocker = np.asarray(crank, dtype=float), np.asarray(rocker, dtype=float)
    _check(crank, rocker, (crank_start, rocker_start), ground)
    arrows = _arrows(crank_start), _arrows(rocker_start)
    forms = _forms(crank, rocker, *arrows)
    found: list[FourBar] = []
    left_out = []
    for root in _roots(forms, *arrows):
        W, Z, Q = (complex(np.dot(form, root)) for form in forms)
        least = NOTHING * max(abs(W), abs(Z), abs(Q))
        if min(abs(W), abs(Z), abs(Q)) <= least:
            left_out.append(_vanished(ground=abs(Q) > least))
            continue
        stretch = (Q / (Z * W.conjugate())).real
        a, b = stretch * W * np.exp(1j * crank[0]), 1 + stretch * Z * np.exp(1j * rocker[0])
        if abs(b - a) <= NOTHING:
            left_out.append("the coupler shrinks to a point: crank and rocker meet in one pin")
        elif all(abs(a * ground - other.a) + abs(b * ground - other.b) > REAL * ground for other in found):
            found.append(FourBar(0j, complex(ground), complex(a * ground), complex(b * ground)))
    return Generators(tuple(sorted(found, key=_evenness, reverse=True)), tuple(left_out))


def generators_of(
    function: Function,
    points: int,
    *,
    crank_start: float | None = None,
    rocker_start: float | None = None,
    ground: float = 1.0,
) -> Generators:
    """All four-bars that generate a function exactly at Chebyshev's places; start angles are those at its start.

    points  3, 4 or 5, with the start angles that go with them: see `function_generators`
    """
    task = function.task(function.nodes(points))
    starts = {"crank_start": crank_start, "rocker_start": rocker_start}
    crank, rocker = np.asarray(task.crank, dtype=float), np.asarray(task.rocker, dtype=float)
    return function_generators(crank, rocker, ground=ground, **starts)


def _arrows(start: float | None) -> Complex[np.ndarray, " arrows"]:
    """Unit vectors that span a link at turn zero: its direction, or both axes where that is free."""
    return np.array([1, 1j] if start is None else [np.exp(1j * start)], dtype=complex)


def _forms(
    crank: FloatArray,
    rocker: FloatArray,
    crank_arrows: Complex[np.ndarray, " crank_arrows"],
    rocker_arrows: Complex[np.ndarray, " rocker_arrows"],
) -> _Forms:
    """What solves the linear equations of all pairs."""
    free = len(crank_arrows) + len(rocker_arrows) > 2
    both_arrows = _arrows(None) if free else rocker_arrows * crank_arrows.conjugate()
    columns = [
        *(-(arrow * np.exp(1j * crank)).real for arrow in crank_arrows),
        *((arrow * np.exp(1j * rocker)).real for arrow in rocker_arrows),
        *(-(arrow * np.exp(1j * (rocker - crank))).real for arrow in both_arrows),
        np.ones(len(crank)),
    ]
    _, singular, right = np.linalg.svd(np.stack(columns, axis=-1))
    if singular[-1] <= FAMILY * singular[0]:
        raise _family()
    null = np.zeros((len(columns), 2))
    null[:, : len(columns) - len(crank)] = right[len(crank) :].T
    ends = np.cumsum([0, len(crank_arrows), len(rocker_arrows), len(both_arrows)])
    parts = [null[start:stop] for start, stop in pairwise(ends)]
    arrows = (crank_arrows, rocker_arrows, both_arrows)
    return _Forms(*(np.asarray(arrow @ part) for arrow, part in zip(arrows, parts, strict=True)))


def _roots(
    forms: _Forms,
    crank_arrows: Complex[np.ndarray, " crank_arrows"],
    rocker_arrows: Complex[np.ndarray, " rocker_arrows"],
) -> list[Float[np.ndarray, "2"]]:
    """All (p, q), up to a factor, with Im(Q conj(Z) W) = 0; a link whose direction is known counts as its direction."""
    if len(crank_arrows) + len(rocker_arrows) == 2:
        return [np.array([1.0, 0.0])]
    factors = [forms.both]
    factors += [forms.rocker.conj()] if len(rocker_arrows) == 2 else []
    factors += [forms.crank] if len(crank_arrows) == 2 else []
    known = np.prod([one[0] for one in (crank_arrows, rocker_arrows.conj()) if len(one) == 1])
    # Seen from where the form is greatest, no root is at infinity.
    turns = np.linspace(0, np.pi, 8, endpoint=False)
    ways = np.stack([np.cos(turns), np.sin(turns)])
    values = np.abs(np.imag(known * np.prod([factor @ ways for factor in factors], axis=0)))
    if np.max(values) <= FAMILY * math.prod(float(np.linalg.norm(factor)) for factor in factors):
        raise _family()
    far = ways[:, np.argmax(values)]
    near = np.array([-far[1], far[0]])
    form = np.array([known])
    for factor in factors:
        form = np.convolve(form, [factor @ near, factor @ far])
    roots = np.polynomial.polynomial.polyroots(form.imag)
    return [near + root.real * far for root in roots if abs(root.imag) <= REAL * max(1.0, abs(root))]


def _vanished(*, ground: bool) -> str:
    if ground:
        return "the ground shrinks to a point beside the other links: crank and rocker on one pivot, infinitely long"
    return "crank or rocker shrinks to a point beside the ground"


def _evenness(one: FourBar) -> float:
    return min(one.lengths) / max(one.lengths)


def _family() -> ParameterError:
    return ParameterError(
        "a whole family of four-bars takes these pairs of angles",
        allowed="pairs that say different things",
        do="move a pair: rocker and crank that turn alike, or one of them at rest, leave a length free",
    )


def _check(crank: FloatArray, rocker: FloatArray, starts: tuple[float | None, float | None], ground: float) -> None:
    if crank.shape != rocker.shape or crank.ndim != 1:
        given = f"turns of crank and rocker of shapes {crank.shape} and {rocker.shape}"
        raise ParameterError(given, allowed="two lists of one length")
    _check_count(len(crank), sum(start is not None for start in starts))
    for name, turns in (("crank turn", crank), ("rocker turn", rocker)):
        require_angles(name, turns)
    for name, start in zip(("crank_start", "rocker_start"), starts, strict=True):
        if start is not None and not abs(start) <= 2 * math.pi:
            guess = f"{start:g} deg is {start * deg:.6g} rad" if math.isfinite(start) else ""
            raise ParameterError(f"{name} {start:g} rad", allowed="within a turn, 6.283 rad", do=guess)
    if not (math.isfinite(ground) and ground > 0):
        raise ParameterError(f"ground {ground:g} m", allowed="finite and above 0")
    pairs = np.stack([np.exp(1j * crank), np.exp(1j * rocker)])
    for one in range(len(crank)):
        for other in range(one):
            if np.max(np.abs(pairs[:, one] - pairs[:, other])) < NOTHING:
                raise ParameterError(f"pairs {other + 1} and {one + 1} are the same", do="give pairs that differ")


def _check_count(pairs: int, starts: int) -> None:
    if pairs not in POINTS:
        whole = "`function_approximations` fits the whole range, by least squares or minimax"
        more = whole if pairs > 5 else "give three at least"
        allowed = ", ".join(f"{count} with {what}" for count, what in POINTS.items())
        raise ParameterError(f"function generation through {pairs} pairs of angles", allowed=allowed, do=more)
    if starts != 5 - pairs:
        fits = POINTS.get(5 - starts, "")
        given = f"{pairs} pairs of angles and {starts} start angle{'' if starts == 1 else 's'}"
        raise ParameterError(given, allowed=f"{pairs} pairs go with {POINTS[pairs]}", do=f"{fits}: {5 - starts} pairs")
