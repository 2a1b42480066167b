"""The loom of a job in lines of text: its time, its heads or weavers, what it and its carpet cost, and its rivals."""

from ilmek.jobs.weave import WeaveResult, days_in_words, order_in_words, time_in_words, wage
from ilmek.machines.automated_loom.carpet_cost import YEAR, CarpetCost
from ilmek.machines.automated_loom.design import LoomDesign
from ilmek.machines.automated_loom.report import analyse, beat_costs
from ilmek.machines.automated_loom.search import LoomSearch
from ilmek.units import format_number

FEWER = 1 / 2, 1 / 10
"""Shares of the carpets that a loom can weave, for which the cheapest loom is named."""


def cost_in_words(cost: CarpetCost, yarn: float | None, *, driven: bool) -> str:
    """What a carpet costs, on the loom and, where this is driven, by hand; yarn: price of the yarn to buy."""
    of_yarn = "without yarn" if yarn is None else f"and {yarn:,.2f} of yarn"
    by_hand = f"; tied by hand {cost.hand_cost:,.2f}" if driven else ""
    steps = ", ".join(f"{step.name} {step.cost:,.2f}" for step in cost.steps)
    return f"{cost.cost_per_carpet:,.2f} a carpet {of_yarn}{by_hand}; {steps}"


def price_in_words(cost: CarpetCost, *, driven: bool) -> str:
    """What the loom costs, how much it weaves, and, where it is driven, when it has earned its price."""
    woven = f"{cost.machine_price['sold']:,.0f}; {cost.carpets_per_year:,.0f} carpets a year"
    if not driven:
        return woven
    paid = cost.payback_time
    earned = "never paid back" if paid is None else f"paid back in {format_number(paid / YEAR, 2)} years"
    return f"{woven}; {earned} against weavers by hand"


def rival_in_words(search: LoomSearch) -> str:
    """The next best loom, why it lost, and how many were looked at."""
    rival = f"{search.label(search.rival)}: {search.why}; " if search.rival else ""
    return f"{rival}the best of {len(search.offers)} looms"


def fewer_in_words(loom: LoomDesign) -> str:
    """Which loom makes the carpet at the least cost where fewer are wanted a year, estimated."""
    analysis = analyse(loom)
    own, costs = analysis.cost, beat_costs(analysis)
    looms = [
        (cost, f"beat={beat}, heads={number}") for beat, row in costs.items() for number, cost in enumerate(row, 1)
    ]
    texts = []
    for share in FEWER:
        wanted = max(1.0, round(share * own.carpets_per_year))
        able = [(cost.of_fewer(wanted), name) for cost, name in looms if cost.carpets_per_year >= wanted]
        least, name = min([*able, (float(own.hand_cost), "by hand")])
        texts.append(f"for {wanted:,.0f} a year {name}: {least:,.0f}, with this loom {own.of_fewer(wanted):,.0f}")
    return f"estimated, {'; '.join(texts)}"


def loom_pairs(woven: WeaveResult) -> list[tuple[str, str]]:
    """Weaving time, heads or weavers and choices of the loom; none where it cannot be designed."""
    made, programme, deadline = woven.loomed.made, woven.loomed.programme, woven.loom_order.deadline
    time, cost, hand = woven.loomed.weaving_time, woven.making.cost, woven.loomed.hand
    driven = hand is None or hand.drive is not None
    if made is None or time is None or cost is None:
        return []
    within = "" if deadline is None else f", the deadline is {time_in_words(deadline)}"
    if programme is None:
        how = days_in_words(made, time)
        of_knots = ("weavers", f"{made.weavers} (of {made.knotters_max} that fit), wage {wage(made, time):,.0f}")
    else:
        how = order_in_words(programme)
        of_knots = ("heads", f"{programme.heads} (of {made.heads_max} that fit)")
    design = woven.loomed.design
    search = design and design.search
    chosen = [f"{choice.name} {choice.chosen}" for choice in woven.loom.choices]
    return [
        ("weaving time", f"{time_in_words(time)}{within}; {how}; {woven.making.size_in_words}"),
        of_knots,
        ("cost", cost_in_words(cost, woven.charted.bill.price, driven=driven)),
        ("loom", price_in_words(cost, driven=driven)),
        *([("chosen", "; ".join(chosen))] if chosen else []),
        *([("next best", rival_in_words(search))] if search else []),
        *([("fewer", fewer_in_words(design))] if design and design.heads and search else []),
    ]
