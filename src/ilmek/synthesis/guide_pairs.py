"""Of many links that guide one body the pairs that are worth judging as four-bars: all pairs at once, by their poses.

A four-bar of crank A0-A and rocker B0-B passes a dead centre of its crank between two poses where the coupler changes
its side of the rocker: where sin mu, (B - A) against (B - B0), changes its sign. Its crank keeps the order of the poses
only where its turns from pose to pose, all counted one way, are less than once round. Both are necessary, not enough:
`candidate.judge` has the last word.           [Waldron on order and branch; Filemon, Useful ranges of Burmester curves]
"""

from collections.abc import Sequence

import numpy as np

from ilmek.arrays import Bool, Complex, Float
from ilmek.plane.vectors import cross
from ilmek.synthesis.burmester.links import Guide, GuideKind

ROUND = 2 * np.pi

APART = 0.2
"""Differences of two pairs, in their links' sizes, below which they are neighbours: one of them will do."""


def promising(
    found: Sequence[Guide],
    points: Complex[np.ndarray, " poses"],
    angles: Float[np.ndarray, " poses"],
    *,
    most: int,
    link_ratio: float = np.inf,
    full_turn: bool = False,
) -> tuple[tuple[Guide, Guide], ...]:
    """At most `most` pairs of guides, crank first, the greatest least |sin mu| at the poses first.

    points [m]  of one point of the body      angles [rad]  of the body
    link_ratio  longest link by shortest, at most          full_turn   only cranks that turn fully (Grashof)
    Left out: what is no crank, pairs that pass a dead centre or lose the order of the poses, and neighbours of a better
    pair.

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
    worth = _worth(pivots, pins, link_ratio, full_turn)
    chosen: list[tuple[int, int]] = []
    for place in np.argsort(-worth, axis=None, kind="stable"):
        i, j = divmod(int(place), len(cranks))
        if len(chosen) == most or worth[i, j] <= 0:
            break
        if not any(_near(pivots, pins, (i, j), other) for other in chosen):
            chosen.append((i, j))
    return tuple((cranks[i], cranks[j]) for i, j in chosen)


def _worth(
    pivots: Complex[np.ndarray, " n"], pins: Complex[np.ndarray, "n poses"], link_ratio: float, full_turn: bool
) -> Float[np.ndarray, "n n"]:
    """Least |sin mu| over the poses of crank i and rocker j; 0 where they are not worth judging."""
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
    fit = one_side & _fit(lengths, link_ratio, full_turn) & _in_order(pivots, pins)[:, None]
    return np.asarray(np.where(fit, least, 0.0))


def _fit(lengths: Float[np.ndarray, "4 n n"], link_ratio: float, full_turn: bool) -> Bool[np.ndarray, "n n"]:
    """Whether ground, crank, coupler and rocker are even enough, and the crank turns fully where it must."""
    shortest, longest = np.min(lengths, axis=0), np.max(lengths, axis=0)
    there = shortest > 0
    even = np.asarray(there & (longest / np.where(there, shortest, 1.0) <= link_ratio))
    if not full_turn:
        return even
    turns = 2 * (shortest + longest) <= np.sum(lengths, axis=0)
    return np.asarray(even & turns & (np.minimum(lengths[0], lengths[1]) <= shortest))


def _in_order(pivots: Complex[np.ndarray, " n"], pins: Complex[np.ndarray, "n poses"]) -> Bool[np.ndarray, " n"]:
    """Whether a crank meets its poses within one turn, one way or the other."""
    arms = pins - pivots[:, None]
    steps = np.angle(arms[:, 1:] * np.conj(arms[:, :-1]))
    return np.asarray((np.mod(steps, ROUND).sum(axis=-1) < ROUND) | (np.mod(-steps, ROUND).sum(axis=-1) < ROUND))


def _near(
    pivots: Complex[np.ndarray, " n"],
    pins: Complex[np.ndarray, "n poses"],
    one: tuple[int, int],
    other: tuple[int, int],
) -> bool:
    """Whether two pairs are neighbours: both of their links have pivot and pin nearly in one place."""
    for mine, its in zip(one, other, strict=True):
        size = abs(pins[mine, 0] - pivots[mine])
        if abs(pivots[mine] - pivots[its]) + abs(pins[mine, 0] - pins[its, 0]) > APART * size:
            return False
    return True
