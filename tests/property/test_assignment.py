"""The assignment of colours to yarns against a search of all of them that is written from its equation alone."""

import itertools
import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ilmek.carpet.assignment import (
    _GREYED,
    _TINTED,
    ANYWHERE,
    APART,
    HUE,
    NEUTRAL,
    NEUTRAL_CHROMA,
    ORDER,
    PALE,
    SHORTFALL,
    assign_yarns,
)
from ilmek.carpet.colour_difference import delta_e_2000
from ilmek.carpet.colour_groups import ColourGroups, colour_groups, contacts
from ilmek.carpet.palette import distinct_colours


def lab_colours(count: int, seed: int) -> np.ndarray:
    random = np.random.default_rng(seed)
    return np.stack(
        [random.uniform(5, 95, count), random.uniform(-60, 60, count), random.uniform(-60, 60, count)], axis=-1
    )


def groups_of(count: int, seed: int) -> ColourGroups:
    random = np.random.default_rng(seed + 1000)
    touch = np.triu(random.integers(0, 60, (count, count)), 1) * (random.random((count, count)) < 0.6)
    knots = np.sort(random.integers(30, 900, count))[::-1].astype(float)
    return ColourGroups(
        np.arange(count, dtype=np.uint8), lab_colours(count, seed), knots, (touch + touch.T).astype(float)
    )


def plain_cost(groups: ColourGroups, yarns: np.ndarray, choice: tuple[int, ...]) -> float:
    """E by loops, as its equation is written."""
    total, palest = 0.0, min(math.hypot(*yarn[1:]) for yarn in yarns)
    labs, knots, contact = groups.labs, groups.knots, groups.contact
    border = [max(1.0, row.sum()) for row in contact]
    for i, yarn in enumerate(choice):
        chroma, of_yarn = math.hypot(*labs[i, 1:]), math.hypot(*yarns[yarn, 1:])
        turned = math.dist(labs[i, 1:], yarns[yarn, 1:]) ** 2 - (chroma - of_yarn) ** 2
        cost = float(delta_e_2000(labs[i], yarns[yarn])) + HUE * math.sqrt(max(turned, 0.0))
        if chroma < NEUTRAL:
            cost += _TINTED * max(of_yarn - max(NEUTRAL_CHROMA, palest), 0.0)
        else:
            cost += _GREYED * max(PALE * chroma - of_yarn, 0.0)
        total += knots[i] * cost
    for i, j in itertools.combinations(range(len(choice)), 2):
        one, other = yarns[choice[i]], yarns[choice[j]]
        drawn = contact[i, j] * min(max(knots[i] / border[i], 0.5), max(knots[j] / border[j], 0.5))
        lacking = min(float(delta_e_2000(labs[i], labs[j])), APART) - float(delta_e_2000(one, other))
        total += SHORTFALL * (drawn + ANYWHERE * min(knots[i], knots[j])) * max(lacking, 0.0)
        turn = labs[i] - labs[j]
        for part in (slice(0, 1), slice(1, 3)):
            size = math.hypot(*turn[part])
            if size >= max(0.5 * math.hypot(*turn), NEUTRAL):
                along = float(turn[part] @ (one - other)[part]) / size
                total += ORDER * drawn * max(0.5 * min(size, APART) - along, 0.0)
    return total


@given(st.integers(1, 4), st.integers(2, 5), st.integers(0, 10_000))
def test_no_other_assignment_costs_less(count: int, yarns: int, seed: int) -> None:
    groups, labs = groups_of(count, seed), lab_colours(yarns, seed + 7)
    found = tuple(assign_yarns(groups, labs).tolist())
    costs = {choice: plain_cost(groups, labs, choice) for choice in itertools.product(range(yarns), repeat=count)}
    assert costs[found] == pytest.approx(min(costs.values()), rel=1e-9)


@given(st.integers(0, 10_000))
def test_given_pairs_hold_and_the_rest_is_the_best_beside_them(seed: int) -> None:
    groups, labs = groups_of(4, seed), lab_colours(4, seed + 7)
    given_yarn = seed % 4
    found = tuple(assign_yarns(groups, labs, {1: given_yarn}).tolist())
    assert found[1] == given_yarn
    allowed = [one for one in itertools.product(range(4), repeat=4) if one[1] == given_yarn]
    assert plain_cost(groups, labs, found) == pytest.approx(min(plain_cost(groups, labs, one) for one in allowed))


@pytest.mark.parametrize("seed", range(6))
def test_no_single_change_betters_the_search_of_many_colours(seed: int) -> None:
    # 7 colours and 5 yarns: 78,125 choices are more than the function tries one by one.
    groups, labs = groups_of(7, seed), lab_colours(5, seed + 7)
    found = plain_cost(groups, labs, tuple(assign_yarns(groups, labs).tolist()))
    random = np.random.default_rng(seed)
    tried = [tuple(random.integers(0, 5, 7).tolist()) for _ in range(150)]
    near = tuple(int(delta_e_2000(lab, labs).argmin()) for lab in groups.labs)
    assert found <= min(plain_cost(groups, labs, one) for one in (*tried, near)) * (1 + 1e-9)
    begun = assign_yarns(groups, labs).tolist()
    for group, yarn in itertools.product(range(7), range(5)):
        changed = (*begun[:group], yarn, *begun[group + 1 :])
        assert found <= plain_cost(groups, labs, changed) * (1 + 1e-9)


@given(st.integers(2, 9), st.integers(2, 9), st.integers(0, 10_000))
def test_contacts_are_the_pairs_of_neighbours(rows: int, columns: int, seed: int) -> None:
    picture = np.random.default_rng(seed).integers(0, 4, (rows, columns)).astype(np.uint8)
    expected = np.zeros((4, 4))
    for i, j in itertools.product(range(rows), range(columns)):
        for y, x in ((i + 1, j), (i, j + 1)):
            if y < rows and x < columns and picture[i, j] != picture[y, x]:
                expected[picture[i, j], picture[y, x]] += 1
                expected[picture[y, x], picture[i, j]] += 1
    assert np.array_equal(contacts(picture, 4), expected)


def test_twins_are_one_group_and_others_are_not() -> None:
    design = np.array([[[200, 40, 40]] * 5, [[201, 40, 41]] * 5, [[40, 40, 200]] * 5], dtype=np.uint8)
    groups = colour_groups(design, distinct_colours(design))
    assert groups.knots.tolist() == [10.0, 5.0]
    assert groups.contact.tolist() == [[0.0, 5.0], [5.0, 0.0]]
