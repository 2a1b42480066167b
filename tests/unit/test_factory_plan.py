"""Plans: their arithmetic, the check that catches every wrong one, yarn to buy, measures for late orders."""

from dataclasses import replace
from typing import Any

import pytest
from small_factory import DAY_SHIFT, LATE_SHIFT, calendars, small_factory

from ilmek.factory.calendar import DAY
from ilmek.factory.heuristic import first_plan
from ilmek.factory.model import (
    MONEY,
    CarpetJob,
    Factory,
    FactoryPlan,
    Loom,
    PlannedCarpet,
    StoredYarn,
    carpet_on,
    left_shifted,
)
from ilmek.factory.rescue import rescues
from ilmek.factory.verification import plan_faults
from ilmek.factory.yarn_stock import purchases, waiting_times


def loom(*, doffing: int = 60, available: int = 0) -> Loom:
    return Loom("A", *calendars(DAY_SHIFT, LATE_SHIFT), 12 * MONEY, 480, 120, doffing, available)


def job(order: int, *, weaving: int = 600, due: int = 2 * DAY, setup: int = 0, grams: int = 0) -> CarpetJob:
    return CarpetJob(order, setup, {0: weaving}, 0, due, MONEY, {0: grams} if grams else {})


def test_dressing_is_by_day_and_weaving_goes_on_after_it() -> None:
    factory = Factory((loom(),), (job(0),))
    one = carpet_on(factory, 0, 0, 0)
    # 450 attended minutes on Monday, 30 on Tuesday; weaving into the late shift; doffing on Wednesday.
    assert (one.start, one.dressed, one.woven, one.end) == (360, DAY + 390, DAY + 1020, 2 * DAY + 420)
    assert factory.loom_cost(0, 0, same=False) == round((480 + 600 + 60) / 60 * 12 * MONEY)


def test_a_carpet_of_the_same_setup_is_dressed_in_less_time() -> None:
    factory = Factory((loom(),), (job(0), job(1), job(2, setup=1)))
    plan = left_shifted(factory, [[0, 1, 2]], {})
    assert [one.same for one in plan.carpets] == [False, True, False]
    assert plan.loom_costs == sum(factory.loom_cost(k, 0, same=k == 1) for k in range(3))
    assert plan_faults(plan, plan.cost) == ()


def test_delay_is_charged_by_the_started_hour() -> None:
    factory = Factory((loom(),), (job(0, due=2 * DAY + 299),))
    plan = left_shifted(factory, [[0]], {})
    assert plan.carpets[0].end - factory.jobs[0].due == 121
    assert plan.late_costs == 3 * MONEY
    assert plan.late == {0}


def mutants(plan: FactoryPlan) -> dict[str, FactoryPlan]:
    """Wrong plans, by what is wrong."""
    first, factory = plan.carpets[0], plan.factory
    other = next(one for one in plan.carpets if one.loom == first.loom and one.job != first.job)

    def changed(**what: Any) -> FactoryPlan:
        carpets = tuple(replace(one, **what) if one is first else one for one in plan.carpets)
        return FactoryPlan(factory, carpets)

    poor = replace(factory, yarns=tuple(replace(yarn, stock=0, arrives=10**6) for yarn in factory.yarns))
    return {
        "carpet missing": FactoryPlan(factory, plan.carpets[1:]),
        "carpet twice": FactoryPlan(factory, (*plan.carpets, first)),
        "another loom": changed(loom=len(factory.looms)),
        "negative loom": changed(loom=-1),
        "starts earlier": changed(start=first.start - 1),
        "dressed too soon": changed(dressed=first.dressed - 1),
        "woven too soon": changed(woven=first.woven - 1),
        "off too late": changed(end=first.end + 5),
        "times in disorder": changed(dressed=first.woven, woven=first.dressed),
        "at the same time": FactoryPlan(
            factory, tuple(PlannedCarpet(other.job, *_times(first)) if one is other else one for one in plan.carpets)
        ),
        "setup claimed": changed(same=not first.same),
        "no yarn": FactoryPlan(poor, plan.carpets),
    }


def _times(one: PlannedCarpet) -> tuple[int, int, int, int, int]:
    return one.loom, one.start, one.dressed, one.woven, one.end


@pytest.mark.parametrize("seed", range(5))
@pytest.mark.one_in(2)
def test_a_wrong_plan_is_caught(seed: int) -> None:
    plan = first_plan(small_factory(6, 2, seed=seed))
    assert plan_faults(plan, plan.cost) == ()
    assert plan_faults(plan, plan.cost - 1)
    caught = {name: bool(plan_faults(wrong, plan.cost)) for name, wrong in mutants(plan).items()}
    assert all(caught.values()), caught


def test_a_carpet_waits_for_its_yarn() -> None:
    yarns = (StoredYarn("ivory", 1500, 3 * DAY),)
    jobs = tuple(replace(job(k, grams=1000), weaving={0: 600, 1: 600}) for k in range(2))
    factory = Factory((loom(), loom()), jobs, yarns)
    assert waiting_times(factory, [0, 1]) == {1: 3 * DAY}
    plan = left_shifted(factory, [[0, 1], []], {1: 3 * DAY})
    assert plan.carpets[1].start >= 3 * DAY
    (bought,) = purchases(plan)
    assert (bought.needed, bought.grams, bought.by) == (2000, 500, plan.carpets[1].start)
    assert plan_faults(left_shifted(factory, [[0], [1]], {}), 0)


def test_yarn_in_stock_is_not_bought() -> None:
    factory = Factory((loom(),), (job(0, grams=1000),), (StoredYarn("ivory", 1000, 5 * DAY),))
    assert purchases(left_shifted(factory, [[0]], {})) == ()


def test_measures_save_a_late_order_by_a_valid_plan() -> None:
    factory = Factory((loom(),), (job(0, weaving=900, due=2 * DAY + 360), job(1, due=30 * DAY)))
    plan = first_plan(factory)
    assert plan.late == {0}
    found = rescues(plan, plan.late)
    assert {one.kind for one in found} >= {"overtime", "later due date"}
    for one in found:
        assert plan_faults(one.plan, one.plan.cost) == ()
        assert not one.plan.late
    overtime = next(one for one in found if one.kind == "overtime")
    assert overtime.hours == 1
    assert overtime.plan.cost < plan.cost


def test_a_measure_makes_no_other_order_late() -> None:
    plan = first_plan(small_factory(7, 2, seed=3, tight=0.3))
    assert plan.late
    target = frozenset({max(plan.late)})
    for one in rescues(plan, target):
        assert one.plan.late <= plan.late - target


def test_a_rule_sends_a_carpet_to_a_loom_that_is_free(monkeypatch: pytest.MonkeyPatch) -> None:
    """Equal carpets, each of a setup of its own, that are due at once on equal looms: each loom has as many."""
    monkeypatch.setattr("ilmek.factory.heuristic.MOST_TRIES", 0)  # the rules alone
    jobs = tuple(replace(job(k, setup=k), weaving=dict.fromkeys(range(4), 600)) for k in range(8))
    plan = first_plan(Factory((loom(),) * 4, jobs))
    assert [len(plan.on_loom(k)) for k in range(4)] == [2] * 4
