"""What a carpet costs, as curves: over the heads for each kind of beat, and over the carpets that are woven a year."""

import numpy as np

from ilmek.carpet.yarn_plan import EURO
from ilmek.machines.automated_loom.carpet_cost import CarpetCost
from ilmek.machines.automated_loom.design import LoomDesign
from ilmek.machines.automated_loom.report import analyse, beat_costs
from ilmek.report import Axis, Mark, Plot, Series

BY_HAND = "weaver by hand"

_FEWEST = 0.7
"""Carpets a year at the left of the curves, over those for which loom and weavers cost the same."""


def cost_over_heads(loom: LoomDesign) -> Plot:
    """The cost over the number of heads or weavers, a curve for each kind of beat; and by hand, where it is no dearer
    than all.
    """
    found, of = analyse(loom), "heads" if loom.heads else "weavers"
    heads, own, hand = np.arange(1.0, loom.knotters_max + 1), loom.params.beat, float(found.cost.hand_cost)
    series = tuple(
        Series(beat, heads, np.array([float(cost.cost_per_carpet) for cost in costs]), dashed=beat != own)
        for beat, costs in beat_costs(found).items()
    )
    if hand <= max(float(curve.y.max()) for curve in series):
        series = (*series, Series(BY_HAND, heads, np.full(len(heads), hand), dashed=True))
    marks = (Mark(float(loom.knotters), f"this loom: {own}, {found.cost.cost_per_carpet:.4g}"),)
    note = f"estimated: knot and frame as of this loom; beats whose drive keeps its limits. {BY_HAND}: {hand:.4g}"
    title = f"What a carpet costs over the {of}"
    return Plot("loom-cost-heads", title, Axis(of), _cost(loom), series, marks, note)


def cost_over_carpets(loom: LoomDesign) -> Plot:
    """The cost over the carpets that are woven a year, of the loom, the runner-up and the weaver by hand."""
    own, search = analyse(loom).cost, loom.search
    looms = {"this loom": own}
    if search and search.others:
        looms |= {f"runner-up: {search.unlike(offer)}": cost for offer, cost in search.others[:1]}
    even, most = own.even_with_hand, max(float(cost.carpets_per_year) for cost in looms.values())
    ends = np.array([_FEWEST * min(even, most), most])
    by_hand = Series(BY_HAND, ends, np.full(2, float(own.hand_cost)), dashed=True)
    series = (*(_curve(name, cost, ends[0], dashed=cost is not own) for name, cost in looms.items()), by_hand)
    marks = (Mark(even, f"as by hand: {even:.3g} a year"),) if even < most else ()
    note = "fewer carpets than the loom can weave pay for it; each curve ends where its loom weaves in all its hours"
    title = "What a carpet costs over the carpets a year"
    return Plot("loom-cost-carpets", title, Axis("carpets a year"), _cost(loom), series, marks, note)


def _cost(loom: LoomDesign) -> Axis:
    return Axis("cost of a carpet without yarn" + (f" [{EURO}]" if loom.params.prices is None else ""))


def _curve(name: str, cost: CarpetCost, fewest: float, *, dashed: bool) -> Series:
    carpets = np.geomspace(fewest, float(cost.carpets_per_year), 65)
    return Series(name, carpets, np.array([cost.of_fewer(number) for number in carpets.tolist()]), dashed)
