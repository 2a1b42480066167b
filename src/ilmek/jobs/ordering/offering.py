"""The offer of a planned order: pictures, costs and price of each carpet, and when it is delivered."""

from datetime import datetime, timedelta
from decimal import Decimal

from ilmek.carpet.carving import carved_length
from ilmek.carpet.chart import Chart
from ilmek.carpet.price_rules import cents
from ilmek.carpet.strike_off import part_of, strike_off_window
from ilmek.errors import ParameterError
from ilmek.io.selling.offer import Offer, OfferedCarpet, ShownCarpet
from ilmek.jobs.chart import ChartResult
from ilmek.jobs.plan import PlanResult
from ilmek.jobs.plan_fits import PlannedOrder
from ilmek.machines.automated_loom.making import CARVING, ON_LOOM, MakingStep
from ilmek.records import record
from ilmek.sentences import Name, Sentence
from ilmek.viz.carpet_picture import draw_carpet, shown_size
from ilmek.viz.room import draw_room

_DETAIL = (0.16, 0.11)
"""Width and length of the part that is shown at true size [m]."""

_LONGEST, _FINE = 1100, 1500
"""Pixels along the longer side of the picture of a carpet, and of its part at true size."""


@record
class OrderLine:
    """An order of the file that a loom weaves: its plan, its chart, how it is offered.

    wage  of the weavers of one carpet, None for a loom that ties itself      energy  of its weaving [J]
    """

    planned: PlannedOrder
    charted: ChartResult
    offered: OfferedCarpet
    wage: Decimal | None
    energy: float

    @property
    def name(self) -> str:
        """As in the file, with size and colourway."""
        return Name(self.planned.entry.name)


def order_lines(plan: PlanResult) -> tuple[OrderLine, ...]:
    """The orders that a loom weaves. Raises ParameterError for one without a picture, and for a missing price."""
    pictures: dict[int, ShownCarpet] = {}
    lines = []
    for index, planned in enumerate(plan.inputs.orders):
        if planned.charted is None:
            given = f"{planned.entry.where}: {planned.entry.name!r} has a programme and no picture"
            raise ParameterError(given, do="give its picture: papers show the carpet")
        if planned.possible:
            shown = pictures.setdefault(id(planned.charted), shown_carpet(planned.charted.chart))
            lines.append(_line(plan, index, planned.charted, shown))
    return tuple(lines)


def offer_of(plan: PlanResult, lines: tuple[OrderLine, ...]) -> Offer:
    """The offer of all lines; its date is the begin of the plan."""
    orders = plan.inputs.orders_file
    until = orders.start + timedelta(days=orders.price.valid)
    date, last = (f"{day:%Y-%m-%d}" for day in (orders.start, until))
    return Offer(
        Name(orders.customer), date, last, orders.currency, orders.price, tuple(line.offered for line in lines)
    )


def shown_carpet(chart: Chart) -> ShownCarpet:
    """The pictures of a carpet."""
    drawn = draw_carpet(chart, longest=_LONGEST)
    sample = strike_off_window(chart)
    part = part_of(chart, strike_off_window(chart, *_DETAIL))
    detail = draw_carpet(part, longest=_FINE).of_pile.image
    pile = (drawn.pile.left, drawn.pile.top, drawn.pile.width, drawn.pile.height)
    room = draw_room(drawn.image, *shown_size(chart.size))
    return ShownCarpet(drawn.image, pile, room, detail, (part.size.width, part.size.length), sample)


def _line(plan: PlanResult, index: int, charted: ChartResult, shown: ShownCarpet) -> OrderLine:
    planned, orders = plan.inputs.orders[index], plan.inputs.orders_file
    by_hand = all(plan.inputs.looms_file.looms[carpet.loom].hand is not None for carpet in plan.carpets(index))
    rules = plan.inputs.wage
    wage = rules.of(charted.chart) if rules is not None and by_hand else None
    costs = _costs(plan, index, charted, wage)
    cost = float(sum((amount for _, amount in costs), Decimal(0)))
    carpets = sum(order.entry.quantity for order in plan.inputs.orders)
    price = orders.price.quoted(cost, planned.entry.quantity, carpets)
    delivery = max(finished(plan, index))
    offered = OfferedCarpet(
        Name(planned.entry.name),
        Name(planned.entry.design),
        charted.chart,
        charted.bill,
        charted.construction,
        costs,
        price,
        f"{delivery:%Y-%m-%d}",
        shown,
    )
    energy = max(planned.fits[carpet.loom].energy for carpet in plan.carpets(index))
    return OrderLine(planned, charted, offered, wage, energy)


def finished(plan: PlanResult, index: int) -> list[datetime]:
    """When each carpet of an order is finished: washed and dried."""
    found = []
    for carpet in plan.carpets(index):
        steps = plan.inputs.orders[index].fits[carpet.loom].finishing
        found.append(plan.inputs.time(carpet.end) + timedelta(seconds=sum(step.time or 0.0 for step in steps)))
    return found


def _costs(
    plan: PlanResult, index: int, charted: ChartResult, wage: Decimal | None
) -> tuple[tuple[Sentence, Decimal], ...]:
    """The cost of one carpet by cause: the mean of the carpets of the order, which may stand on different looms."""
    orders, carpets = plan.inputs.orders_file, plan.carpets(index)
    steps = [step for carpet in carpets for step in plan.steps(carpet)]
    on_loom = sum(step.cost or 0.0 for step in steps if step.name in ON_LOOM) / len(carpets)
    rules = orders.price
    after = [step for step in steps if step.name not in ON_LOOM]
    by_rates = [step for step in after if (rules.carving if step.name == CARVING else rules.finishing) is None]
    off_loom = sum(_known(step, plan) for step in by_rates) / len(carpets)
    off_loom += (rules.finishing or 0.0) * charted.bill.area + (rules.carving or 0.0) * carved_length(charted.chart)
    yarn = charted.bill.price if charted.bill.currency == orders.currency else None
    if yarn is None:
        given = f"{orders.path}: no price of the yarn of {orders.orders[index].name!r} in {orders.currency}"
        do = "give the order's currency, pile_price, warp_price and weft_price, or prices in its yarn list"
        raise ParameterError(given, do=do)
    labour = () if wage is None else ((Sentence("order.cost-wage"), wage),)
    return (
        (Sentence("order.cost-yarn"), cents(yarn)),
        *labour,
        (Sentence("order.cost-loom"), cents(on_loom)),
        (Sentence("order.cost-finishing"), cents(off_loom)),
    )


def _known(step: MakingStep, plan: PlanResult) -> float:
    if step.cost is None:
        orders = plan.inputs.orders_file
        given = f"{orders.path}: no price of {step.name} in {orders.currency}"
        key, of = ("carving", "metre") if step.name == CARVING else ("finishing", "square metre")
        raise ParameterError(given, do=f'write {key} = "12 {orders.currency}" under [price]: of a {of}')
    return step.cost
