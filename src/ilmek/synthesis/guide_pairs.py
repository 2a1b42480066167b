"""Selection of promising pairs among many links that guide one body: all pairs at once, by their poses.

A four-bar with crank A0-A and rocker B0-B passes a dead centre of its crank between two poses if sin mu, with mu the
angle between (B - A) and (B - B0), changes its sign. The crank keeps the order of the poses only if its rotations from
pose to pose, all counted in one direction, sum to less than one turn. Both conditions are necessary, not sufficient:
the final check is `candidate.judge`.          [Waldron on order and branch; Filemon, Useful ranges of Burmester curves]
"""

from collections.abc import Sequence

import numpy as np

from ilmek.arrays import Bool, Complex, Float
from ilmek.plane.vectors import cross
from ilmek.synthesis.burmester.links import Guide, GuideKind

FULL_TURN = 2 * np.pi

NEIGHBOURS = 0.2
"""Difference of two pairs, relative to their links, below which they are neighbours; only the better one is kept."""


def promising(
    found: Sequence[Guide],
    points: Complex[np.ndarray, " poses"],
    angles: Float[np.ndarray, " poses"],
    *,
    most: int,
    link_ratio: float = np.inf,
    full_turn: bool = False,
) -> tuple[tuple[Guide, Guide], ...]:
    """At most `most` pairs of guides (crank, rocker), sorted by their least |sin mu| at the poses, greatest first.

    found       guides of the body
    points      positions of one point of the body at the poses [m], complex, shape (poses,)
    angles      angles of the body at the poses [rad], shape (poses,)
    link_ratio  greatest ratio of the longest to the shortest link; default: no limit
    full_turn   whether only cranks that rotate fully (Grashof) are allowed

    Left out: guides that are no cranks, pairs that pass a dead centre or do not keep the order of the poses, and
    neighbours of a better pair.

    >>> square = [Guide(GuideKind.CRANK, 0j, 1j), Guide(GuideKind.CRANK, 2 + 0j, 2 + 1j)]
    >>> moved, still = np.array([1j, 0.3 + 0.9j]), np.zeros(2)
    >>> [one.pivot for one, _ in promising(square, moved, still, most=5)]
    [0j, (2+0j)]
    """
    cranks = [one for one in found if one.kind is GuideKind.CRANK]
    if len(cranks) < 2:
        return ()
    pivots = np.array([one.pivot for one in cranks])
    pins = np.array([one.pins(points, angles) for one in cranks])
    sines = _least_sines(pivots, pins, link_ratio, full_turn)
    chosen: list[tuple[int, int]] = []
    for index in np.argsort(-sines, axis=None, kind="stable"):
        i, j = divmod(int(index), len(cranks))
        if len(chosen) == most or sines[i, j] <= 0:
            break
        if not any(_neighbours(pivots, pins, (i, j), other) for other in chosen):
            chosen.append((i, j))
    return tuple((cranks[i], cranks[j]) for i, j in chosen)


def _least_sines(
    pivots: Complex[np.ndarray, " n"], pins: Complex[np.ndarray, "n poses"], link_ratio: float, full_turn: bool
) -> Float[np.ndarray, "n n"]:
    """Least |sin mu| over the poses for crank i and rocker j; 0 for pairs that are left out."""
    coupler = pins[None, :] - pins[:, None]
    rocker = (pins - pivots[:, None])[None]
    sizes = np.abs(coupler) * np.abs(rocker)
    sines = np.asarray(cross(coupler, rocker)) / np.where(sizes > 0, sizes, np.inf)
    least = np.min(np.abs(sines), axis=-1)
    one_side = np.abs(np.sum(np.sign(sines), axis=-1)) == pins.shape[1]
    arms = np.abs(pins[:, 0] - pivots)
    lengths = np.stack(
        np.broadcast_arrays(np.abs(pivots[None] - pivots[:, None]), arms[:, None], np.abs(coupler[..., 0]), arms)
    )
    allowed = one_side & _lengths_allowed(lengths, link_ratio, full_turn) & _in_order(pivots, pins)[:, None]
    return np.asarray(np.where(allowed, least, 0.0))


def _lengths_allowed(
    lengths: Float[np.ndarray, "4 n n"], link_ratio: float, full_turn: bool
) -> Bool[np.ndarray, "n n"]:
    """Whether the link ratio is allowed and, with `full_turn`, the crank rotates fully."""
    shortest, longest = np.min(lengths, axis=0), np.max(lengths, axis=0)
    positive = shortest > 0
    even = np.asarray(positive & (longest / np.where(positive, shortest, 1.0) <= link_ratio))
    if not full_turn:
        return even
    turns = 2 * (shortest + longest) <= np.sum(lengths, axis=0)
    return np.asarray(even & turns & (np.minimum(lengths[0], lengths[1]) <= shortest))


def _in_order(pivots: Complex[np.ndarray, " n"], pins: Complex[np.ndarray, "n poses"]) -> Bool[np.ndarray, " n"]:
    """Whether a crank meets its poses in order within one turn, in either direction."""
    arms = pins - pivots[:, None]
    steps = np.angle(arms[:, 1:] * np.conj(arms[:, :-1]))
    return np.asarray(
        (np.mod(steps, FULL_TURN).sum(axis=-1) < FULL_TURN) | (np.mod(-steps, FULL_TURN).sum(axis=-1) < FULL_TURN)
    )


def _neighbours(
    pivots: Complex[np.ndarray, " n"],
    pins: Complex[np.ndarray, "n poses"],
    one: tuple[int, int],
    other: tuple[int, int],
) -> bool:
    """Whether two pairs are neighbours: the pivots and pins of both links nearly coincide."""
    for mine, its in zip(one, other, strict=True):
        size = abs(pins[mine, 0] - pivots[mine])
        if abs(pivots[mine] - pivots[its]) + abs(pins[mine, 0] - pins[its, 0]) > NEIGHBOURS * size:
            return False
    return True
