"""Annealed plans: the best of all plans in small factories, valid by the independent check, the same again."""

import pytest
from tests.support.small_factory import every_plan, small_factory

from ilmek.factory.annealing import annealed_plan
from ilmek.factory.heuristic import first_plan
from ilmek.factory.model import Factory, FactoryPlan, left_shifted
from ilmek.factory.verification import plan_faults


def worst_plan(factory: Factory) -> FactoryPlan:
    """All carpets on the last loom that can weave each, in the order of their index, all waiting for the yarn."""
    sequences: list[list[int]] = [[] for _ in factory.looms]
    for job, what in enumerate(factory.jobs):
        sequences[max(what.weaving)].append(job)
    return left_shifted(factory, sequences, dict.fromkeys(range(len(factory.jobs)), factory.yarns[0].arrives))


@pytest.mark.parametrize("seed", range(4))
def test_no_plan_of_a_small_factory_costs_less(seed: int) -> None:
    factory = small_factory(4, 2, seed=seed, tight=0.2)
    by_cost = sorted(every_plan(factory), key=lambda plan: plan.cost)
    least = next(plan.cost for plan in by_cost if not plan_faults(plan, plan.cost))
    for begin, moves in ((worst_plan(factory), 80_000), (first_plan(factory), 10_000)):
        found, whole = annealed_plan(begin, moves)
        assert whole
        assert plan_faults(found, found.cost) == ()
        assert found.cost == least


def test_a_large_plan_is_better_valid_and_the_same_again() -> None:
    factory = small_factory(40, 4, seed=5, tight=0.3)
    first = first_plan(factory)
    found, _ = annealed_plan(first, 20_000)
    assert plan_faults(found, found.cost) == ()
    assert found.cost < first.cost
    assert annealed_plan(first, 20_000)[0] == found


def test_a_clock_ends_the_search_and_keeps_the_best() -> None:
    first = first_plan(small_factory(12, 3, seed=2))
    answers = iter((False, True))
    found, whole = annealed_plan(first, 20_000, ended=lambda: next(answers))
    assert not whole
    assert found.merit <= first.merit
    assert plan_faults(found, found.cost) == ()
