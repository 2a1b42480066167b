"""Cost of a carpet against twenty lines that share nothing with the code, and the least cost against all looms."""

import contextlib
import itertools
from dataclasses import replace
from functools import lru_cache

import pytest

from ilmek.errors import LoomError, ParameterError
from ilmek.machines import BEATS, WEFT_CARRIERS
from ilmek.machines.automated_loom import design
from ilmek.machines.automated_loom.cost import CarpetCost, annuity_factor, costs_by_beats
from ilmek.machines.automated_loom.cost_rates import CostRates
from ilmek.machines.automated_loom.offers import CYCLES, value_of
from ilmek.machines.automated_loom.params import AutomatedLoomParams
from ilmek.machines.automated_loom.report import LoomAnalysis, all_checks, analyse

NARROW = AutomatedLoomParams(aim="price", width=0.45, length=0.6)
RATES = CostRates(wage=14 / 3600, persons=0.5, life=9.0, interest=0.08, margin=0.2, changeover=5 * 3600.0)


@lru_cache
def loom(beat: str, heads: int, rates: CostRates = RATES) -> LoomAnalysis:
    return analyse(design(AutomatedLoomParams(aim="price", width=0.45, length=0.6, beat=beat, heads=heads, cost=rates)))


def by_hand(time: float, energy: float, price: float, work: float, floor: float) -> dict[str, float]:
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
    carpets = 4000 * 0.85 / (time / 3600 + 5)
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
    lines = found.listed.parts
    screws = sum(line.number for line in lines if line.kind == "fastener")
    axes = sum(line.number for line in lines if line.drives)
    price, cost = found.listed.price, found.cost
    shares = by_hand(found.weaving_time, found.energy.total, price, screws * 1.5 / 60 + axes * 6 + 80, cost.floor)
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
    assert search.designed < len(good)
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


def test_payment_pays_off_the_loan() -> None:
    for interest, years in ((0.05, 7), (0.12, 3), (0.0, 4)):
        loan = 1.0
        for _ in range(years):
            loan = loan * (1 + interest) - annuity_factor(interest, years)
        assert loan == pytest.approx(0.0, abs=1e-12)


def test_carpets_tied_by_hand_for_less_have_no_payback() -> None:
    cheap = CarpetCost(CostRates(weaver_knots=1e6), 10_000, 1.0, 3600.0, 0.0, 10.0, 1e4, 1e4, 2e4)
    assert cheap.payback_time is None


@pytest.mark.parametrize("setting", [{"wage": -1.0}, {"life": 0.0}, {"availability": 1.2}, {"interest": float("nan")}])
def test_absurd_rates_are_refused(setting: dict[str, float]) -> None:
    with pytest.raises(ParameterError, match=next(iter(setting))):
        CostRates(**setting)
