"""Cost of a carpet against twenty lines that share nothing with the code, and the least cost against all looms."""

import contextlib
import itertools
import math
import re
from collections import Counter
from dataclasses import replace
from functools import lru_cache

import numpy as np
import pytest

from ilmek.cli.loom_summary import FEWER, fewer_in_words
from ilmek.errors import LoomError, ParameterError
from ilmek.machines import BEATS, WEFT_CARRIERS
from ilmek.machines.automated_loom import design
from ilmek.machines.automated_loom.carpet_cost import CarpetCost, annuity_factor
from ilmek.machines.automated_loom.choice import weavers_needed
from ilmek.machines.automated_loom.cost import costs_by_beats
from ilmek.machines.automated_loom.cost_figures import cost_over_carpets, cost_over_heads
from ilmek.machines.automated_loom.cost_rates import CostRates
from ilmek.machines.automated_loom.estimate import time_for_knots
from ilmek.machines.automated_loom.in_space.scene import loom_tree
from ilmek.machines.automated_loom.machine_cost import MachineCost
from ilmek.machines.automated_loom.offers import CYCLES, value_of
from ilmek.machines.automated_loom.params import AutomatedLoomParams
from ilmek.machines.automated_loom.rate_limits import rate_limits
from ilmek.machines.automated_loom.report import LoomAnalysis, all_checks, analyse
from ilmek.params import declared

NARROW = AutomatedLoomParams(aim="price", width=0.45, length=0.6)
RATES = CostRates(wage=14 / 3600, persons=0.5, life=9.0, interest=0.08, margin=0.2, changeover=5 * 3600.0)


@lru_cache
def loom(beat: str, heads: int, rates: CostRates = RATES) -> LoomAnalysis:
    return analyse(design(AutomatedLoomParams(aim="price", width=0.45, length=0.6, beat=beat, heads=heads, cost=rates)))


def standstill(found: LoomAnalysis) -> float:
    """Time that the causes of the twin stop the loom for a carpet [s]: calls by knots, yarn and passes, times waits."""
    rows, columns, loops = found.loom.rows, found.loom.columns, found.loom.params.billed
    of_knot = loops * (0.02e-3 * (60 + 60) + 0.1e-3 * (60 + 45)) + 5e-4 * 0.1**2 * (60 + 45)
    of_row = 2 * (15e-5 * (60 + 18) + 2e-5 * (60 + 90) + 2 * columns * 1e-7 * (60 + 172))
    return float(rows * (columns * of_knot + of_row if found.heads else of_row))


def fitted(found: LoomAnalysis) -> float:
    """Hours of the fitter: pieces, screws and joints counted in the loom's tree; axes, sensors, cabinet."""
    tree, lines = loom_tree(found.loom), found.listed.parts
    counts = tree.counts()
    joints = Counter[str]()
    for kind, body in (*((b.joint.kind, b.id) for b in tree.bodies), *((c.kind, c.bodies[0]) for c in tree.closures)):
        joints[kind.value] += counts[body]
    pieces = sum(number for _, number in tree.occurrences())
    screws = sum(number for part, number in tree.occurrences() if part.process == "fastener")
    sensors = [line for line in lines if "sensor" in line.kind or line.name.startswith("index")]
    wired = ("load cell", "light barrier", "light grid", "interlock", "button", "emergency stop")
    wired += ("enabling device", "mode selector", "holding brake")
    sensors += [line for line in lines if line.kind in wired and line not in sensors]
    contacts = joints["transmission"] + joints["cam and follower"] + joints["screw"] + joints["rolling"]
    minutes = pieces * 40 / 60 + 1.5 * screws + 5 * joints["pin"] + 10 * joints["slide"] + 5 * contacts
    axes = sum(line.number for line in lines if line.drives)
    return minutes / 60 + 6 * axes + sum(line.number for line in sensors) / 4 + 24 + 80


def by_hand(  # noqa: PLR0917
    time: float, energy: float, price: float, work: float, floor: float, stops: float
) -> dict[str, float]:
    """The cost with the rates of `RATES` and the usual ones, in hours and years; work: hours of the fitter."""
    sold = (price + 35 * work) * 1.2
    loan, year = sold, 0.0
    low, high = 0.0, sold
    for _ in range(200):  # the yearly payment that leaves nothing of the loan after nine years
        year = (low + high) / 2
        loan = sold
        for _ in range(9):
            loan = loan * 1.08 - year
        low, high = (year, high) if loan > 0 else (low, year)
    carpets = 4000 * 0.9 / ((time + stops) / 3600 + 5)
    return {
        "capital": year / carpets,
        "operators": 14 * 0.5 * 4000 / carpets,
        "upkeep": 0.03 * sold / carpets,
        "floor": 40 * floor / carpets,
        "energy": 0.15 * energy / 3.6e6,
        "finishing": 12 * 0.45 * 0.6,
    }


@pytest.mark.parametrize(("beat", "heads"), [("travelling", 1), ("comb", 2), ("linkage", 2)])
def test_shares_of_the_cost_are_those_of_a_computation_by_hand(beat: str, heads: int) -> None:
    found = loom(beat, heads)
    price, cost = found.listed.price, found.cost
    work, stops = fitted(found), standstill(found)
    shares = by_hand(found.weaving_time, found.energy.total, price, work, cost.floor, stops)
    assert sum(found.price_shares.values()) == pytest.approx(cost.sold)
    assert cost.availability == pytest.approx(0.9 * (1 - stops / (cost.time + stops + 5 * 3600)))
    assert cost.cost_shares == pytest.approx(shares, rel=1e-9)
    assert cost.cost_per_carpet == pytest.approx(sum(shares.values()))
    assert cost.cost_per_area == pytest.approx(sum(shares.values()) / 0.27)
    assert cost.floor > 0.45 * 0.5
    hand = found.knots / 8000 * 8 * 14 + shares["finishing"]
    saved = (hand - sum(shares.values()) + shares["capital"]) * cost.carpets_per_year
    assert cost.hand_cost == pytest.approx(hand)
    assert (cost.payback_time is None) == (saved <= 0)
    if saved > 0:
        assert cost.payback_time == pytest.approx(cost.sold / saved * 365.25 * 86400)


def test_time_and_wage_of_weavers_are_those_of_a_computation_by_hand() -> None:
    """Two weavers, 9,000 knots a day of 7.5 h: 3 s a knot, 75 of each row; a loom pays both for all of its hours."""
    rates = replace(RATES, weaver_knots=9000.0, weaver_day=7.5 * 3600)
    params = AutomatedLoomParams(width=1.2, length=0.6, knots_across=125.0, knotting="hand", beat="comb", cost=rates)
    found = analyse(design(params))
    stops = sum((75 - 1) // bobbin.rows * bobbin.time for bobbin in found.loom.bobbins)
    time = 75 * (75 * 3.0 + found.cycle_time_row) + stops
    assert (found.loom.weavers, found.loom.heads, found.knots) == (2, 0, 75 * 150)
    assert found.weaving_time == pytest.approx(time)
    assert found.loom.knot_cyclogram.period == pytest.approx(75 * 3.0 + found.cycle_time_row)
    carpets = 4000 * 0.9 / ((time + standstill(found)) / 3600 + 5)
    assert found.cost.cost_shares["operators"] == pytest.approx(14 * 2 * 4000 / carpets)
    for deadline in (time - 1, 0.7 * time, 0.3 * time):
        times = {n: 75 * (math.ceil(150 / n) * 3.0 + found.cycle_time_row) + stops for n in range(1, 151)}
        enough = next((n for n, needed in times.items() if needed <= deadline), None)
        assert weavers_needed(time_for_knots(found.loom, deadline), 3.0, 150) == enough
    assert weavers_needed(time_for_knots(found.loom, 75 * found.cycle_time_row), 3.0, 150) is None


TABLE = list(itertools.product(("cams", "arms"), (1.8, 1.25), WEFT_CARRIERS, BEATS, (1, 2)))


@lru_cache
def tried(key: tuple[str, float, str, str, int], aim: str) -> LoomAnalysis | None:
    """The loom of these choices; None where it cannot be designed."""
    knotting, cycle, weft, beat, heads = key
    kinds = AutomatedLoomParams(width=0.45, length=0.6, aim=aim, cost=RATES, knotting=knotting, weft=weft, beat=beat)
    with contextlib.suppress(LoomError):
        return analyse(design(replace(kinds, knot_cycle=cycle, heads=heads)))
    return None


@pytest.mark.matrix(light=1)
@pytest.mark.parametrize(("aim", "cycle"), [("cost", 1.25), ("time", 1.8), ("cost", 1.8), ("time", 1.25)])
def test_the_chosen_loom_is_the_best_of_all_in_the_table(aim: str, cycle: float) -> None:
    chosen = design(AutomatedLoomParams(width=0.45, length=0.6, aim=aim, cost=RATES, knot_cycle=cycle))
    search = chosen.search
    assert search is not None
    whole = {key: found for key in TABLE if key[1] == cycle for found in [tried(key, aim)] if found}
    good = {key: value_of(found, aim) for key, found in whole.items() if not failing(found)}
    assert len(good) >= 8
    assert search.value == pytest.approx(min(good.values()), rel=1e-12)
    assert len(search.costs) < len(good)
    assert search.rival_value >= search.value
    # No bound is above what its loom has.
    for offer in search.offers:
        if offer.key in whole:
            assert offer.value <= value_of(whole[offer.key], aim) * (1 + 1e-9), offer
            assert offer.price <= whole[offer.key].listed.price
    limit = sorted(found.listed.price for key, found in whole.items() if key in good)[len(good) // 2]
    cheaper = design(replace(chosen.params, price_limit=limit, knotting="auto", weft="auto", beat="auto", heads=None))
    least = min(value for key, value in good.items() if whole[key].listed.price <= limit)
    assert cheaper.search is not None
    assert cheaper.search.value == pytest.approx(least, rel=1e-12)


def failing(found: LoomAnalysis) -> list[str]:
    return [check.name for check in all_checks(found.loom) if not check.ok]


def test_no_time_of_a_knot_that_is_given_beats_the_quickest_loom() -> None:
    """The knot is as quick as its cams allow; a quicker one fails the check of its cycle."""
    sizes = AutomatedLoomParams(width=0.45, length=0.6, aim="time", knotting="cams", weft="shuttle")
    quickest = design(sizes)
    cycle = quickest.params.knot_cycle
    assert cycle is not None
    assert cycle < 1.3
    assert failing(analyse(quickest)) == []
    given = [analyse(design(replace(sizes, knot_cycle=one))) for one in (2.0, 1.4, cycle)]
    assert all(one.time >= analyse(quickest).time * (1 - 1e-12) for one in given)
    quicker = CYCLES[CYCLES.index(cycle) + 1]
    assert "knot cycle, as required" in failing(analyse(design(replace(sizes, knot_cycle=quicker))))


def test_estimate_over_heads_and_beats_is_near_these_looms() -> None:
    found = loom("comb", 1)
    estimated = costs_by_beats(found.loom, found.listed, found.energy.total)
    assert estimated["comb"][0].cost_per_carpet == pytest.approx(found.cost.cost_per_carpet, rel=1e-9)
    for beat, number in (("comb", 2), ("linkage", 1), ("travelling", 2)):
        exact = loom(beat, number).cost
        assert estimated[beat][number - 1].cost_per_carpet == pytest.approx(exact.cost_per_carpet, rel=0.02)
        assert estimated[beat][number - 1].time == pytest.approx(exact.time, rel=1e-3)


def test_fewer_carpets_pay_for_the_loom_and_for_as_many_hours_as_they_take() -> None:
    cost = loom("comb", 2).cost
    shares, most = cost.cost_shares, float(cost.carpets_per_year)
    assert cost.of_fewer(most) == pytest.approx(cost.cost_per_carpet)
    yearly = most * (shares["capital"] + shares["upkeep"] + shares["floor"])
    each = 14 * 0.5 * (cost.time / 3600 + 5) / cost.availability + shares["energy"] + shares["finishing"]
    assert cost.of_fewer(most / 3) == pytest.approx(yearly / (most / 3) + each)
    assert cost.of_fewer(cost.even_with_hand) == pytest.approx(cost.hand_cost)
    assert replace(cost, knots=1).even_with_hand == math.inf


def test_the_loom_for_fewer_carpets_is_the_least_of_those_that_weave_so_many() -> None:
    """The line of the terminal, with a loan of nine years at 8 % and 5 h between two carpets, as of `RATES`."""
    chosen = design(AutomatedLoomParams(width=0.45, length=0.6, cost=RATES))
    found, (_, *texts) = analyse(chosen), re.split(r"estimated, |; ", fewer_in_words(chosen))
    rows = costs_by_beats(chosen, found.listed, found.energy.total)
    own = f"beat={chosen.params.beat}, heads={chosen.heads}"
    assert len(texts) == len(FEWER)
    for share, text in zip(FEWER, texts, strict=True):
        wanted = round(share * 4000 * 0.9 / ((found.time + standstill(found)) / 3600 + 5))
        each = {"by hand": found.knots / 8000 * 8 * 14 + 12 * 0.27}
        for beat, number, cost in ((beat, n, cost) for beat, row in rows.items() for n, cost in enumerate(row, 1)):
            hours = ((cost.time + cost.stops) / 3600 + 5) / 0.9
            if wanted * hours <= 4000:
                pieces, screws, pins, slides, contacts, axes, sensors = cost.machine.fitting
                minutes = pieces * 40 / 60 + 1.5 * screws + 5 * pins + 10 * slides + 5 * contacts + 15 * sensors
                sold = 1.2 * (cost.machine.parts + 35 * (minutes / 60 + 6 * axes + 24 + 80))
                yearly = sold * (0.08 / (1 - 1.08**-9) + 0.03) + 40 * cost.floor
                running = 14 * 0.5 * hours + 0.15 * cost.energy / 3.6e6 + 12 * 0.27
                each[f"beat={beat}, heads={number}"] = yearly / wanted + running
        best = min(each, key=each.__getitem__)
        assert text == f"for {wanted:,} a year {best}: {each[best]:,.0f}, with this loom {each[own]:,.0f}"


def test_a_rate_moves_as_far_as_two_looms_cost_the_same() -> None:
    chosen, *others = sorted(
        (loom(beat, heads).cost for beat in ("travelling", "comb", "linkage") for heads in (1, 2)),
        key=lambda cost: float(cost.cost_per_carpet),
    )
    found = {limits.rate.name: limits for limits in rate_limits(chosen, others)}
    assert {"changeover", "axis_time", "fitter_wage"} <= set(found)
    assert "availability" not in found

    def margin(name: str, value: float) -> tuple[float, int]:
        """By how much the cheapest other loom is dearer than the chosen one, and its number."""
        rates = replace(RATES, **{name: value})
        costs = [float(replace(cost, rates=rates).cost_per_carpet) for cost in others]
        return min(costs) - float(replace(chosen, rates=rates).cost_per_carpet), costs.index(min(costs))

    for rate in declared(CostRates):
        given, limits = getattr(RATES, rate.name), found.get(rate.name)
        if given is None:
            continue
        now = float(given)
        least = now / 1000 if rate.at_least is None else rate.at_least
        for end, limit in ((least, limits and limits.below), (rate.at_most or now, limits and limits.above)):
            until = limit[0] if limit else end
            for share in (0.0, 0.01, 0.1, 0.5, 0.999):
                assert margin(rate.name, now + share * (until - now))[0] >= -1e-6
            if limit:
                assert margin(rate.name, until)[0] == pytest.approx(0.0, abs=1e-6)
                assert margin(rate.name, until + 1e-3 * (end - until))[0] < 0


def test_curves_of_the_cost_are_those_of_the_looms() -> None:
    found = loom("comb", 2)
    heads, carpets = cost_over_heads(found.loom), cost_over_carpets(found.loom)
    own = next(series for series in heads.series if series.label == "comb")
    assert [mark.x for mark in heads.marks] == [2]
    assert own.y[own.x == 2] == pytest.approx(found.cost.cost_per_carpet)
    assert {series.label for series in heads.series} >= {"travelling", "linkage", "comb"}
    assert carpets.series[0].y[-1] == pytest.approx(found.cost.cost_per_carpet)
    assert carpets.series[-1].y == pytest.approx(found.cost.hand_cost)
    even = carpets.marks[0].x
    assert np.interp(even, carpets.series[0].x, carpets.series[0].y) == pytest.approx(found.cost.hand_cost, rel=0.01)


def test_time_between_two_carpets_follows_the_dressing_of_the_loom() -> None:
    found = loom("comb", 1, replace(RATES, changeover=None))
    winding = (0.6 / 0.99 * 1.03 + 2 * 0.1 + 0.4) / 1.0
    dressing = 1800 + found.warps * (12 + winding) + 2 * math.ceil(found.warps / 20) * 30
    hours = 4000 * 3600 * 0.9 / float(found.cost.carpets_per_year)
    assert hours - found.time - standstill(found) == pytest.approx(dressing + 4.5 * 3600)
    assert loom("comb", 1).cost.changeover == 5 * 3600


@pytest.mark.parametrize("changeover", [None, 2 * 3600.0])
def test_the_steps_of_making_cost_what_the_carpet_costs(changeover: float | None) -> None:
    """By hand: the loom's hour over the hours that the carpet holds it; 1.5, 3.5 and 7 a square metre off the loom."""
    found = loom("comb", 1, replace(RATES, changeover=changeover, shearing_time=600.0))
    cost, area = found.cost, 0.45 * 0.6
    steps = {one["name"]: (one["time"], one["cost"]) for one in cost.making_steps}
    assert list(steps) == ["warping", "weaving", "taking down", "inspection", "shearing", "washing"]
    off = cost.cost_shares["energy"] + 12 * area
    between = cost.dressing + 4.5 * 3600 if changeover is None else changeover
    dressing = min(cost.dressing, between)
    hour = (cost.cost_per_carpet - off) / (between + found.weaving_time)
    assert steps["warping"] == pytest.approx((dressing, hour * dressing))
    assert steps["weaving"] == pytest.approx((found.weaving_time, hour * found.weaving_time + off - 12 * area))
    assert steps["taking down"] == pytest.approx((between - dressing, hour * (between - dressing)))
    assert steps["inspection"] == pytest.approx((900 * area, 1.5 * area))
    assert steps["shearing"] == pytest.approx((600 * area, 3.5 * area))
    assert steps["washing"] == pytest.approx((48 * 3600, 7 * area))
    assert sum(part for _, part in steps.values()) == pytest.approx(cost.cost_per_carpet)


def test_payment_pays_off_the_loan() -> None:
    for interest, years in ((0.05, 7), (0.12, 3), (0.0, 4)):
        loan = 1.0
        for _ in range(years):
            loan = loan * (1 + interest) - annuity_factor(interest, years)
        assert loan == pytest.approx(0.0, abs=1e-12)


def test_carpets_tied_by_hand_for_less_have_no_payback() -> None:
    cheap = CarpetCost(CostRates(weaver_knots=1e6), 10_000, 1.0, 3600.0, 0.0, 0.0, 10.0, MachineCost(1e4))
    assert cheap.payback_time is None


@pytest.mark.parametrize("setting", [{"wage": -1.0}, {"life": 0.0}, {"availability": 1.2}, {"interest": float("nan")}])
def test_absurd_rates_are_refused(setting: dict[str, float]) -> None:
    with pytest.raises(ParameterError, match=next(iter(setting))):
        CostRates(**setting)
