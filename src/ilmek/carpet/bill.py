"""Yarn bill: the yarn to buy for a chart.

    metres = knots × length per knot,   kilograms = metres × linear density,   linear density = ply / (1000 Nm)

for each colour of the pile, whole, half and jufti knots with their own lengths; the ground needs warp, two wefts, ends,
and the overcasting of the selvedges, or of the cut edge of a shape. The need is what is drawn from the hanks, waste
included; a reserve is bought beyond it.
"""

import math
from dataclasses import dataclass, fields, replace
from operator import attrgetter
from typing import TYPE_CHECKING, Any

from ilmek.carpet.carving import carved_masses
from ilmek.carpet.cut_edge import cut_share, edge_length, finished_area
from ilmek.carpet.dye_lots import rows_of_new_lots, whole
from ilmek.carpet.ground import GroundParams, GroundYarn, binding_tape, binding_yarn, ground_yarns, selvedge_yarn
from ilmek.carpet.pile import PileParams, knot_length, of_kind, of_yarn
from ilmek.carpet.usual_pile import MassBand, published_band
from ilmek.carpet.yarn import Yarn
from ilmek.carpet.yarn_plan import OVERCAST, TAPE, YarnPlanParams, parse_hank, write_count
from ilmek.elements.knot_kinds import FORMS
from ilmek.errors import CarpetError, did_you_mean
from ilmek.report.framed import RecordTable

if TYPE_CHECKING:
    from ilmek.carpet.chart import Chart


@dataclass(frozen=True, slots=True)
class YarnNeed:
    """A line of the bill: yarn and use (pile, warp, weft, end, selvedge, binding), knots (0 but for the pile).

    material      of the yarn, of MATERIALS
    bought        name under which it is bought; a yarn on several positions of the creel has one, as in its list
    length, mass  needed, waste included [m], [kg]
    price         of what is to buy, reserve included; None where no price per kg is known
    count         metric count and ply, like 5/2; "" for the ground
    kept          mass that stays in the carpet [kg]
    to_buy        mass with the reserve [kg]           hanks     to buy, whole ones
    carved        of the mass, what is cut away along carved lines [kg]
    lots          dye lots for the mass to buy         lot_rows  rows, from 1 at the lower edge, where a new lot begins
    """

    name: str
    use: str
    knots: int
    length: float
    mass: float
    price: float | None = None
    count: str = ""
    kept: float = 0.0
    to_buy: float = 0.0
    hanks: int = 0
    lots: int = 1
    lot_rows: tuple[int, ...] = ()
    bought: str = ""
    material: str = ""
    carved: float = 0.0


@dataclass(frozen=True, slots=True)
class YarnBill:
    """The bill: pile yarns in the order of the list (those with knots), then warp, wefts, ends and selvedges.

    area      of the finished carpet [m²]    edge  of it that is cut and bound [m]; 0: a rectangle
    currency  of all prices
    band      published mass of carpets of this density [kg/m²]; None: none is published
    """

    pile: tuple[YarnNeed, ...]
    ground: tuple[YarnNeed, ...]
    area: float
    currency: str
    band: MassBand | None = None
    edge: float = 0.0

    @property
    def needs(self) -> tuple[YarnNeed, ...]:
        """All lines, pile first."""
        return self.pile + self.ground

    def frame(self) -> Any:
        """The lines as a DataFrame, SI. Raises ParameterError without pandas and polars."""
        return RecordTable(self.needs, tuple(field.name for field in fields(YarnNeed))).frame()

    @property
    def knots(self) -> int:
        """Number of knots."""
        return sum(need.knots for need in self.pile)

    @property
    def pile_mass(self) -> float:
        """Mass of the pile yarns needed [kg]."""
        return sum(need.mass for need in self.pile)

    @property
    def mass(self) -> float:
        """Mass of all yarns needed [kg]."""
        return sum(need.mass for need in self.needs)

    @property
    def mass_per_area(self) -> float:
        """Mass of the finished carpet over its area [kg/m²], without waste and reserve."""
        return sum(need.kept for need in self.needs) / self.area

    @property
    def price(self) -> float | None:
        """Price of all yarns to buy; None unless every one has a price."""
        prices = [need.price for need in self.needs if need.price is not None]
        return sum(prices) if len(prices) == len(self.needs) else None

    @property
    def field(self) -> YarnNeed:
        """The pile yarn with the most knots."""
        return max(self.pile, key=lambda need: need.knots)


def yarn_bill(chart: "Chart", plan: YarnPlanParams | None = None, ground: GroundParams | None = None) -> YarnBill:
    """The yarn bill of a chart.

    plan    default: that of the class
    ground  of the loom, whose ends are the plan's; default: that of the class
    """
    plan = plan or YarnPlanParams()
    ground = plan.ground(ground)
    most = chart.yarns[max(chart.used, key=chart.tied.of)]
    threads: tuple[GroundYarn, ...] = ground_yarns(chart.size, chart.quality, chart.rows, chart.columns, ground)
    edge = edge_length(chart)
    if not edge:
        threads = (*threads, selvedge_yarn(chart.size, chart.quality, most.linear_density, ground))
    else:
        threads = tuple(_cut(thread, chart, ground) for thread in threads)
        if plan.binding == OVERCAST:
            most = _binding_yarn(chart, plan.binding_yarn, most)
            hem = (edge, plan.binding_width, chart.quality, most.linear_density, ground)
            threads = (*threads, binding_yarn(*hem))
        elif plan.binding == TAPE:
            threads = (*threads, binding_tape(edge, plan.binding_width))
    names, carved = names_to_buy(chart), carved_masses(chart)
    needs = tuple(
        replace(_pile_need(chart, index, plan, ground.yarns.pile, carved[index]), bought=names[index])
        for index in chart.used
    )
    lines = tuple(_ground_need(thread, most, plan) for thread in threads if thread.length > 0)
    return YarnBill(needs, lines, finished_area(chart), plan.currency, published_band(chart.quality), edge)


def names_to_buy(chart: "Chart") -> tuple[str, ...]:
    """The name under which each yarn of a chart is bought: that in its list, which it has on its first position.

    >>> from ilmek import Chart, read_yarns
    >>> rose, ivory = read_yarns()[:2]
    >>> twice = replace(rose, name=f"{rose.name} (creel 2)")
    >>> names_to_buy(Chart([[0, 1, 2]] * 2, (rose, ivory, twice), "6x4cm", "5x5/dm", "symmetric")) == (
    ...     rose.name, ivory.name, rose.name)
    True
    """
    yarns = chart.yarns
    places = sorted(range(len(yarns)), key=lambda place: chart.positions[place])
    firsts = (next(yarns[one] for one in places if _is_same(yarns[one], yarn)) for yarn in yarns)
    return tuple(first.name for first in firsts)


_BESIDES_NAME = attrgetter(*(part.name for part in fields(Yarn) if part.name != "name"))


def _is_same(one: Yarn, other: Yarn) -> bool:
    """Whether two yarns of a chart are one yarn of the list."""
    return one == other or (one.number is not None and _BESIDES_NAME(one) == _BESIDES_NAME(other))


def _cut(thread: GroundYarn, chart: "Chart", ground: GroundParams) -> GroundYarn:
    """A yarn of the ground of which the part outside of the shape is cut away, both ends and fringes with it."""
    share = {"end": 0.0, "warp": 1 - (ground.loom_waste + 2 * ground.fringe) / ground.warp_length(chart.size.length)}
    return replace(thread, kept=share.get(thread.use, thread.kept) * (1 - cut_share(chart)))


def _binding_yarn(chart: "Chart", name: str | None, most: Yarn) -> Yarn:
    """The yarn of the binding. Raises CarpetError for an unknown one."""
    if name is None:
        return most
    names = [yarn.name for yarn in chart.yarns]
    found = next((yarn for yarn in chart.yarns if yarn.name.casefold() == name.casefold()), None)
    if found is None:
        hint = did_you_mean(name, names)
        raise CarpetError(f"--binding-yarn {name!r}: no yarn has this name", allowed=", ".join(names), do=hint)
    return found


def pile_length(chart: "Chart", yarn: int, pile: PileParams | None = None) -> float:
    """Length of a yarn in all knots of a chart [m]: whole, half and jufti ones, by the height of their pile."""
    density, length = chart.yarns[yarn].linear_density, 0.0
    usual = of_yarn(pile or PileParams(), chart.yarns[yarn])
    for kind, tied in chart.tied_by_kind:
        own = of_kind(usual, kind)
        for form, knots in zip(FORMS, (of[yarn] for of in tied), strict=True):
            length += knots * knot_length(chart.knot, chart.quality, density, own, form) if knots else 0.0
    return length


def _pile_need(chart: "Chart", index: int, plan: YarnPlanParams, material: str, carved: float) -> YarnNeed:
    """The line of a pile yarn; of its knots both ends are cut, but those of a loop."""
    yarn, knots, pile = chart.yarns[index], chart.tied.of(index), plan.pile(chart.quality)
    length = pile_length(chart, index, pile)
    cut = sum(tied.of(index) for kind, tied in chart.tied_by_kind if not kind.loop)
    material = yarn.material or material
    waste = 2 * pile.calibration * pile.cut_waste * cut + carved / yarn.linear_density
    thread = GroundYarn(yarn.name, "pile", material, length, length * yarn.linear_density, max(0.0, 1 - waste / length))
    rate = plan.price("pile", material) if yarn.price is None else yarn.price
    need = _need(thread, plan, rate, yarn, knots)
    rows = rows_of_new_lots(chart.knots, index, chart.counts[index] * plan.lot / need.to_buy, need.lots)
    return replace(need, lot_rows=rows, carved=carved)


def _ground_need(thread: GroundYarn, most: Yarn, plan: YarnPlanParams) -> YarnNeed:
    """The line of a ground yarn; selvedges and binding are of a pile yarn, `most`; a tape is bought by its length."""
    if thread.use == "tape":
        rate = plan.price_of_tape
        return replace(_need(thread, plan, None if rate is None else rate * thread.length / thread.mass), hanks=0)
    if thread.use in ("selvedge", "binding"):
        return _need(thread, plan, plan.price("pile", thread.material) if most.price is None else most.price, most)
    return _need(thread, plan, plan.price("warp" if thread.use == "warp" else "weft", thread.material))


def _need(
    thread: GroundYarn, plan: YarnPlanParams, rate: float | None, yarn: Yarn | None = None, knots: int = 0
) -> YarnNeed:
    """The line of a yarn of a price per kg."""
    to_buy, hank = thread.mass * (1 + plan.reserve), parse_hank(plan.hank)
    share = thread.length * (1 + plan.reserve) / hank.length if hank.length else to_buy / (hank.mass or math.inf)
    return YarnNeed(
        thread.name,
        thread.use,
        knots,
        thread.length,
        thread.mass,
        None if rate is None else to_buy * rate,
        write_count(yarn) if yarn else "",
        thread.kept * thread.mass,
        to_buy,
        whole(share),
        max(1, whole(to_buy / plan.lot)),
        bought=thread.name,
        material=thread.material,
    )
