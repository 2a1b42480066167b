"""The planner against every plan of small factories, and against its own bounds."""

from dataclasses import replace

import pytest
from small_factory import every_plan, small_factory

from ilmek.factory.annealing import annealed_plan
from ilmek.factory.bound import capacity_bound
from ilmek.factory.heuristic import first_plan
from ilmek.factory.model import FactoryPlan, SolveLimits, in_turn, left_shifted, lone_cost, sequences_of
from ilmek.factory.solver import horizon_of, solve, without_fine
from ilmek.factory.verification import plan_faults
from ilmek.factory.yarn_stock import waiting_in

LIMITS = SolveLimits(3.0, 60.0)


@pytest.mark.matrix(light=3)
@pytest.mark.parametrize("seed", range(6))
def test_no_plan_costs_less_than_the_solvers(seed: int) -> None:
    factory = small_factory(2 + seed % 2, 2, seed=seed, tight=0.2)
    least = min(plan.merit for plan in every_plan(factory))
    solved = solve(factory, first_plan(factory), LIMITS)
    assert solved.status == "optimal"
    assert solved.plan.cost == solved.bound == least[0]
    assert plan_faults(solved.plan, solved.plan.cost) == ()


@pytest.mark.parametrize("seed", [102, 134, 149, 155])
def test_no_plan_has_fewer_late_carpets_where_that_is_the_aim(seed: int) -> None:
    """In each of these factories the cheapest plan has more late carpets than another one."""
    factory = small_factory(3, 2, seed=seed, tight=0.02)
    plans = list(every_plan(factory))
    fewest = min(plans, key=lambda plan: (len(plan.late), plan.merit))
    assert len(fewest.late) < len(min(plans, key=lambda plan: plan.merit).late)
    first = first_plan(factory)
    fine = 2 * first.cost
    fined = FactoryPlan(factory.with_fine(fine), first.carpets)
    annealed, _ = annealed_plan(fined, 2_000)
    solved = without_fine(solve(fined.factory, fined, LIMITS), factory, fine)
    assert annealed.cost - annealed.fines == solved.plan.cost == fewest.cost
    assert len(annealed.late) == len(solved.plan.late) == solved.least_late == len(fewest.late)
    assert solved.bound <= min(plan.cost for plan in plans)
    assert plan_faults(solved.plan, solved.plan.cost) == plan_faults(annealed, annealed.cost) == ()


@pytest.mark.parametrize("seed", [20, 23])
def test_a_solved_plan_is_valid_repeatable_and_not_below_its_bound(seed: int) -> None:
    factory = small_factory(6, 2, seed=seed)
    first = first_plan(factory)
    runs = [solve(factory, first, SolveLimits(0.05, 60.0)) for _ in range(2)]
    assert runs[0].plan == runs[1].plan
    assert runs[0].bound == runs[1].bound
    solved = runs[0]
    assert plan_faults(first, first.cost) == plan_faults(solved.plan, solved.plan.cost) == ()
    assert solved.bound <= solved.plan.cost <= first.cost


@pytest.mark.parametrize("carpets", [2, 3])
def test_like_carpets_on_one_loom_are_planned_where_every_plan_costs_the_same(carpets: int) -> None:
    """OR-tools 9.15 aborted the process: the model is settled while it is loaded."""
    factory = small_factory(carpets, 1, seed=1)
    job = replace(factory.jobs[0], due=60 * 1440, earliest=0, yarns={}, weaving={0: 1200})
    factory = replace(factory, jobs=(job,) * carpets, yarns=())
    solved = solve(factory, first_plan(factory), LIMITS, in_time=frozenset(range(carpets)))
    assert {plan.cost for plan in every_plan(factory)} == {solved.plan.cost}
    assert plan_faults(solved.plan, solved.plan.cost) == ()


@pytest.mark.parametrize("seed", range(40, 46))
def test_bounds_are_below_every_plan(seed: int) -> None:
    factory = small_factory(3, 2, seed=seed, tight=0.1)
    plans = list(every_plan(factory))
    best = min(plans, key=lambda plan: plan.cost)
    horizon = horizon_of(max(plans, key=lambda plan: plan.end))
    assert sum(lone_cost(factory, job) for job in range(3)) <= best.cost
    assert 0 < capacity_bound(factory, horizon) <= best.cost


@pytest.mark.matrix(light=3)
@pytest.mark.parametrize("seed", range(60, 66))
def test_a_plan_is_made_again_from_its_sequences(seed: int) -> None:
    plan = first_plan(small_factory(20, 3, seed=seed))
    assert left_shifted(plan.factory, sequences_of(plan), waiting_in(plan)).merit <= plan.merit
    turned = in_turn(plan)
    assert turned.merit == plan.merit
    assert plan_faults(turned, plan.cost) == ()
