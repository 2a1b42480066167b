"""Assignment: the colours of a drawing get their yarns together.

The nearest yarn of each colour alone can be the same for two colours that touch, and what they draw is gone. So the
yarns y of all groups of colours [`colour_groups`] are those of the least

    E(y) = Σi ni (ΔE(i, yi) + g(i, yi)) + Σi<j (S wij max(0, min(cij, APART) - dij) + R kij rij)

    ΔE, c, d  CIEDE2000 of a colour and its yarn, of two colours, and of their two yarns          n  knots
    w         what is drawn where i and j touch: their contact times the knots by contact of the lesser of the two, so
              that it is n of an area that lies in another, and at least half of a contact, for lines (k); and ANYWHERE
              of the knots of the lesser, whether they touch or not: faces with a line between them are two as well
    r         by how much two that touch lack the order of their colours, in lightness, and in chroma and hue where most
              of the colours' difference lies there: half of it, at most half of APART, along its direction
    g         HUE times the difference of hue, 2 sqrt(C1 C2) sin(Δh/2): green stays green before it is near; and what
              turns neutral: the chroma that a neutral colour gets beyond NEUTRAL_CHROMA, and that a strong one loses
              beyond PALE of it

Few choices are all tried. Else one colour, then two, are changed while E falls, from the nearest yarns and from an
order by knots; the best is taken. Ties are for the yarn that is first in the list.
"""

import itertools
from collections.abc import Mapping

import numpy as np

from ilmek.arrays import Float, FloatArray, IntArray, UInt8
from ilmek.carpet.colour_difference import delta_e_2000
from ilmek.carpet.colour_groups import ColourGroups
from ilmek.num.compiled import compiled
from ilmek.records import record

APART = 12.0
"""CIEDE2000 of two yarns that are clearly apart: more is not asked for."""

SHORTFALL, ORDER = 2.0, 0.4
"""Weights of a lacking contrast and of a lacking order against the difference of a colour to its yarn."""

ANYWHERE = 0.2
"""Weight of two colours that do not touch, of the knots of the lesser."""

HUE = 0.15
"""Weight of a difference in hue, beyond its part in CIEDE2000."""

NEUTRAL = 5.0
"""Chroma in CIELAB below which a colour is neutral."""

NEUTRAL_CHROMA = 12.5
"""Chroma up to which a yarn is neutral: undyed wool, ivory to black."""

PALE = 0.4
"""Share of its chroma that a colour keeps at least."""

_TINTED, _GREYED = 3.0, 0.4
"""Weights of chroma that a neutral colour gets, and that another loses."""

_CANDIDATES = 16
"""Yarns among which the yarn of a colour is: the nearest."""

_MOST_TRIALS = 20_000
_ROUNDS = 50
_LESS = 1e-9
"""Least fall of the cost, in CIEDE2000 × knots."""


@record
class _Problem:
    """Costs of the assignment: `single` of each group and candidate, `pairs` of each two groups.

    yarns     index of each group's candidates, ascending      first, second  groups of each pair
    """

    yarns: IntArray
    single: FloatArray
    first: IntArray
    second: IntArray
    pairs: Float[np.ndarray, "pairs candidates candidates"]


def assign_yarns(
    groups: ColourGroups,
    yarn_labs: Float[np.ndarray, "yarns 3"],
    fixed: Mapping[int, int] | None = None,
    *,
    neutral: bool = True,
) -> UInt8[np.ndarray, " groups"]:
    """The index of the yarn of each group.

    fixed    yarns that are given, by group      neutral  keep neutral colours neutral

    >>> green_white_red = np.array([[88.0, -86, 83], [100, 0, 0], [53, 80, 67]])
    >>> touching = 10.0 * (1 - np.eye(3))
    >>> groups = ColourGroups(np.arange(3, dtype=np.uint8), green_white_red, np.full(3, 100.0), touching)
    >>> assign_yarns(groups, np.array([[91.5, -0.6, 11.8], [55.8, -12.8, 24.3], [36.2, 46.8, 31.7]])).tolist()
    [1, 0, 2]
    """
    problem = _problem(groups, yarn_labs, fixed or {}, neutral=neutral)
    count, candidates = problem.single.shape
    if candidates**count <= _MOST_TRIALS:
        choice = _all_tried(problem)
    else:
        near, heavy = problem.single.argmin(axis=1), _in_order(problem)
        found = [_improved(problem, begun) for begun in (near, heavy)]
        choice = min(found, key=lambda one: _energy(problem, one))
    return np.asarray(problem.yarns[np.arange(count), choice], dtype=np.uint8)


def single_costs(groups: ColourGroups, yarn_labs: FloatArray, *, neutral: bool) -> FloatArray:
    """Cost of a knot of each group with each yarn, (groups, yarns): CIEDE2000 and g."""
    colours, yarns = groups.labs[:, 1] + 1j * groups.labs[:, 2], yarn_labs[:, 1] + 1j * yarn_labs[:, 2]
    chroma, of_yarns = np.abs(colours), np.abs(yarns)
    # |u - v|² of the two vectors is that of the chromas and (2 sqrt(C1 C2) sin(Δh/2))².
    hue = np.abs(colours[:, None] - yarns) ** 2 - (chroma[:, None] - of_yarns) ** 2
    cost = delta_e_2000(groups.labs[:, None], yarn_labs[None]) + HUE * np.sqrt(np.maximum(hue, 0.0))
    if not neutral:
        return np.asarray(cost)
    beyond = np.maximum(of_yarns - max(NEUTRAL_CHROMA, float(of_yarns.min())), 0.0)
    lost = np.maximum(PALE * chroma[:, None] - of_yarns, 0.0)
    return np.asarray(cost + np.where((chroma < NEUTRAL)[:, None], _TINTED * beyond, _GREYED * lost))


def touching(groups: ColourGroups) -> FloatArray:
    """What is drawn where two groups touch [knots], (groups, groups)."""
    border = np.maximum(groups.contact.sum(axis=1), 1.0)
    depth = np.maximum(groups.knots / border, 0.5)
    return np.asarray(groups.contact * np.minimum(depth[:, None], depth))


def _problem(groups: ColourGroups, labs: FloatArray, fixed: Mapping[int, int], *, neutral: bool) -> _Problem:
    cost = single_costs(groups, labs, neutral=neutral)
    for group, yarn in fixed.items():
        cost[group, np.arange(len(labs)) != yarn] = np.inf
    most = 1 if len(fixed) == len(groups) else min(_CANDIDATES, len(labs))
    yarns = np.sort(np.argsort(cost, axis=1, kind="stable")[:, :most], axis=1)
    single = np.take_along_axis(cost, yarns, axis=1) * groups.knots[:, None]
    first, second = np.triu_indices(len(groups), 1)
    return _Problem(yarns, single, first, second, _pair_costs(groups, labs, yarns, first, second))


def _pair_costs(
    groups: ColourGroups, labs: FloatArray, yarns: IntArray, first: IntArray, second: IntArray
) -> FloatArray:
    colours, touch = groups.labs, touching(groups)[first, second]
    weights = touch + ANYWHERE * np.minimum(groups.knots[first], groups.knots[second])
    apart = delta_e_2000(labs[:, None], labs[None])
    contrast = np.minimum(delta_e_2000(colours[first], colours[second]), APART)
    one, other = yarns[first][:, :, None], yarns[second][:, None, :]
    lacking = np.maximum(contrast[:, None, None] - apart[one, other], 0.0)
    turn, of_yarns = colours[first] - colours[second], labs[one] - labs[other]
    disorder = np.zeros(lacking.shape)
    for part in (slice(0, 1), slice(1, 3)):
        size = np.linalg.norm(turn[:, part], axis=1)
        along = np.einsum("pc,pabc->pab", turn[:, part], of_yarns[..., part]) / np.maximum(size, 1e-9)[:, None, None]
        rules = size >= np.maximum(0.5 * np.linalg.norm(turn, axis=1), NEUTRAL)
        wanted = np.where(rules, 0.5 * np.minimum(size, APART), -np.inf)
        disorder += np.maximum(wanted[:, None, None] - along, 0.0)
    return np.asarray(SHORTFALL * weights[:, None, None] * lacking + ORDER * touch[:, None, None] * disorder)


def _energy(problem: _Problem, choice: IntArray) -> float:
    pairs = np.arange(len(problem.first))
    drawn = problem.pairs[pairs, choice[problem.first], choice[problem.second]]
    return float(problem.single[np.arange(len(choice)), choice].sum() + drawn.sum())


def _all_tried(problem: _Problem) -> IntArray:
    """The best of all choices; of equal ones the first in the order of the list."""
    count, candidates = problem.single.shape
    choices = np.array(list(itertools.product(range(candidates), repeat=count)), dtype=np.int64).reshape(-1, count)
    total = np.zeros(len(choices))
    for group in range(count):
        total += problem.single[group, choices[:, group]]
    for pair, (one, other) in enumerate(zip(problem.first.tolist(), problem.second.tolist(), strict=True)):
        total += problem.pairs[pair, choices[:, one], choices[:, other]]
    return np.asarray(choices[int(total.argmin())])


def _in_order(problem: _Problem) -> IntArray:
    """Each group, from the first, gets the yarn that is best beside those before it."""
    count = len(problem.single)
    choice = np.zeros(count, dtype=np.int64)
    cost = problem.single.copy()
    for group in range(count):
        choice[group] = int(cost[group].argmin())
        for pair in np.flatnonzero(problem.first == group).tolist():
            cost[problem.second[pair]] += problem.pairs[pair, choice[group]]
    return choice


def _improved(problem: _Problem, begun: IntArray) -> IntArray:
    """The choice with one group, or two, changed while the cost falls."""
    choice = begun.copy()
    _descend(problem.single, problem.first, problem.second, problem.pairs, choice, _ROUNDS)
    return choice


@compiled
def _costs(  # noqa: PLR0917
    single: FloatArray, first: IntArray, second: IntArray, pairs: FloatArray, choice: IntArray, cost: FloatArray
) -> None:
    """Write the cost of each group and candidate beside the choice of all others."""
    cost[:] = single
    for pair in range(len(first)):
        for k in range(single.shape[1]):
            cost[first[pair], k] += pairs[pair, k, choice[second[pair]]]
            cost[second[pair], k] += pairs[pair, choice[first[pair]], k]


@compiled
def _change_one(  # noqa: PLR0917
    cost: FloatArray, first: IntArray, second: IntArray, pairs: FloatArray, choice: IntArray, group: int
) -> bool:
    """Give a group its best candidate, and tell the others."""
    old, best = choice[group], choice[group]
    for k in range(cost.shape[1]):
        if cost[group, k] < cost[group, best] - _LESS:
            best = k
    if best == old:
        return False
    choice[group] = best
    for pair in range(len(first)):
        for k in range(cost.shape[1]):
            if first[pair] == group:
                cost[second[pair], k] += pairs[pair, best, k] - pairs[pair, old, k]
            elif second[pair] == group:
                cost[first[pair], k] += pairs[pair, k, best] - pairs[pair, k, old]
    return True


@compiled
def _change_two(
    cost: FloatArray, one: int, other: int, own: Float[np.ndarray, "candidates candidates"], choice: IntArray
) -> bool:
    """Give two groups the best candidates together; own: the costs of the two."""
    a0, b0 = choice[one], choice[other]
    a1, b1, least = a0, b0, cost[one, a0] + cost[other, b0] - own[a0, b0]
    for a in range(cost.shape[1]):
        for b in range(cost.shape[1]):
            both = cost[one, a] - own[a, b0] + cost[other, b] - own[a0, b] + own[a, b]
            if both < least - _LESS:
                a1, b1, least = a, b, both
    choice[one], choice[other] = a1, b1
    return bool(a1 != a0 or b1 != b0)


@compiled
def _descend(  # noqa: PLR0917
    single: FloatArray, first: IntArray, second: IntArray, pairs: FloatArray, choice: IntArray, rounds: int
) -> None:
    cost = np.empty_like(single)
    for _ in range(rounds):
        _costs(single, first, second, pairs, choice, cost)
        changed = False
        for group in range(len(single)):
            changed = _change_one(cost, first, second, pairs, choice, group) or changed
        pair = 0
        while not changed and pair < len(first):
            changed = _change_two(cost, first[pair], second[pair], pairs[pair], choice)
            pair += 1
        if not changed:
            return
