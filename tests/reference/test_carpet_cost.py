"""Cost of a carpet against twenty lines that share nothing with the code, and the least cost against all looms."""

import itertools
from functools import lru_cache

import pytest

from ilmek.errors import ParameterError
from ilmek.machines import BEATS
from ilmek.machines.automated_loom import design
from ilmek.machines.automated_loom.cost import CarpetCost, annuity_factor, costs_by_heads
from ilmek.machines.automated_loom.cost_rates import CostRates
from ilmek.machines.automated_loom.params import AutomatedLoomParams
from ilmek.machines.automated_loom.report import LoomAnalysis, analyse, checks

NARROW = AutomatedLoomParams(width=0.45, length=0.6)
RATES = CostRates(wage=14 / 3600, persons=0.5, life=9.0, interest=0.08, margin=0.2, changeover=5 * 3600.0)


@lru_cache
def loom(beat: str, heads: int, rates: CostRates = RATES) -> LoomAnalysis:
    return analyse(design(AutomatedLoomParams(width=0.45, length=0.6, beat=beat, heads=heads, cost=rates)))


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


def test_least_cost_is_that_of_all_beats_and_heads() -> None:
    chosen = analyse(design(AutomatedLoomParams(width=0.45, length=0.6, aim="cost", cost=RATES)))
    most = chosen.loom.heads_max
    whole = {
        (beat, heads): found.cost.cost_per_carpet
        for beat, heads in itertools.product(BEATS, range(1, most + 1))
        for found in [loom(beat, heads)]
        if all(check.ok for check in checks(found))
    }
    assert len(whole) >= 2
    least = min(whole, key=lambda key: whole[key])
    assert (chosen.loom.params.beat, chosen.heads) == least
    assert chosen.cost.cost_per_carpet == pytest.approx(whole[least])


def test_estimate_over_heads_is_near_the_looms_of_these_heads() -> None:
    found = loom("comb", 1)
    estimated = costs_by_heads(found.loom, found.listed, found.energy.total)
    for number, cost in enumerate(estimated[:2], 1):
        assert cost.cost_per_carpet == pytest.approx(loom("comb", number).cost.cost_per_carpet, rel=0.03)


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
