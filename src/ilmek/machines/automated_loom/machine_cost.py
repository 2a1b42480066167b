"""What a loom costs its maker: made and bought parts, the work of its assembly and electrics, commissioning, margin.

    made = parts + fitter's wage * (sum of numbers * times + cabinet + commissioning),    sold = made * (1 + margin)

The numbers are those of pieces, screws, joints by kind, axes and sensors; a loom without axes has no cabinet. Set-ups
of the workshop are paid once for all pieces of a part, so that twice the heads cost less than twice.
"""

from collections.abc import Iterable, Mapping
from dataclasses import replace
from typing import NamedTuple

from ilmek.elements.prices import PriceRates, batch_price, piece_price
from ilmek.machines.automated_loom.cost_rates import CostRates
from ilmek.records import record
from ilmek.report import BillLine

_SCREWS = "fastener"

_WIRED = frozenset(
    (
        "sensor",
        "yarn sensor",
        "light barrier",
        "light grid",
        "load cell",
        "interlock",
        "button",
        "emergency stop",
        "enabling device",
        "mode selector",
        "holding brake",
    )
)
"""Kinds of parts that are wired to the control, beside its axes."""


class Fitting(NamedTuple):
    """Numbers of what is fitted, by which assembly and electrics are paid."""

    pieces: float = 0.0
    screws: float = 0.0
    pins: float = 0.0
    slides: float = 0.0
    contacts: float = 0.0
    axes: float = 0.0
    sensors: float = 0.0

    def assembly(self, rates: CostRates) -> float:
        """Time of the assembly [s]."""
        times = rates.piece_time, rates.screw_time, rates.pin_time, rates.slide_time, rates.contact_time
        return sum(number * time for number, time in zip(self, times, strict=False))

    def electrics(self, rates: CostRates) -> float:
        """Time of cabinet and wiring [s]."""
        cabinet = rates.cabinet_time if self.axes else 0.0
        return cabinet + self.axes * rates.axis_time + self.sensors * rates.sensor_time


@record
class MachineCost:
    """What a loom, or a share of it, costs its maker: prices of its pieces, of the set-ups for them, what is fitted."""

    pieces: float
    batches: float = 0.0
    fitting: Fitting = Fitting()

    @property
    def parts(self) -> float:
        """Price of all parts."""
        return self.pieces + self.batches

    @property
    def axes(self) -> float:
        """Axes of the control."""
        return self.fitting.axes

    def work(self, rates: CostRates) -> dict[str, float]:
        """Price of assembly, electrics and commissioning."""
        fitted, wage = self.fitting, rates.fitter_wage
        return {
            "assembly": wage * fitted.assembly(rates),
            "electrics": wage * fitted.electrics(rates),
            "commissioning": wage * rates.commissioning,
        }

    def made(self, rates: CostRates) -> float:
        """Price of the loom with assembly and setting to work."""
        return self.parts + sum(self.work(rates).values())

    def plus(self, other: "MachineCost") -> "MachineCost":
        """With another."""
        fitting = (own + more for own, more in zip(self.fitting, other.fitting, strict=True))
        return MachineCost(self.pieces + other.pieces, self.batches + other.batches, Fitting(*fitting))

    def times(self, number: float) -> "MachineCost":
        """A number of times, all in the same batches: their set-ups are paid once."""
        return MachineCost(number * self.pieces, self.batches, Fitting(*(number * own for own in self.fitting)))

    def share(self, share: float) -> "MachineCost":
        """A share of all, set-ups included."""
        return replace(self.times(share), batches=share * self.batches)


def machine_cost(lines: Iterable[BillLine], prices: Mapping[str, PriceRates]) -> MachineCost:
    """The cost of the lines of a parts list."""
    lines = tuple(lines)
    pins, slides, contacts = (sum(line.number * line.joints[kind] for line in lines) for kind in range(3))
    fitting = Fitting(
        pieces=sum(line.number for line in lines),
        screws=sum(line.number for line in lines if line.kind == _SCREWS),
        pins=pins,
        slides=slides,
        contacts=contacts,
        axes=sum(line.number for line in lines if line.drives),
        sensors=sum(line.number for line in lines if line.kind in _WIRED),
    )
    pieces = sum(line.number * piece_price(line, prices) for line in lines)
    return MachineCost(pieces, sum(batch_price(line, prices) for line in lines), fitting)


def with_control(cost: MachineCost, prices: Mapping[str, PriceRates]) -> MachineCost:
    """A cost without the amplifiers of the control, with those of its axes."""
    axes, fitting = cost.axes, cost.fitting
    price = axes * prices["axis of the control"].each
    return replace(cost, pieces=cost.pieces + price, fitting=fitting._replace(pieces=fitting.pieces + axes))


def price_shares(
    lines: Iterable[BillLine], prices: Mapping[str, PriceRates], rates: CostRates, cost: MachineCost
) -> dict[str, float]:
    """The price of a loom as sold, by cause: material and processes of its made parts, bought parts, work, margin."""
    shares = {"material": 0.0, "bought parts": 0.0}
    for line in lines:
        if not line.steps:
            shares["bought parts"] += line.number * piece_price(line, prices)
        for step in line.steps:
            kind = prices[step.kind]
            cause = step.kind if kind.per_h or kind.per_m2 else "material"
            shares[cause] = shares.get(cause, 0.0) + line.number * kind.of_step(step) + kind.batch
    shares |= cost.work(rates)
    return {**shares, "margin": rates.margin * sum(shares.values())}
