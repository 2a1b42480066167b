"""Price of a tufting machine, by its parts list and the rates of the workshop, as a loom's is."""

import math
from dataclasses import replace
from functools import lru_cache

from ilmek.elements.prices import price_of, read_prices
from ilmek.machines.automated_loom.machine_cost import MachineCost, machine_cost, price_shares
from ilmek.machines.tufting_machine.design import TuftingMachine
from ilmek.machines.tufting_machine.params import SCROLLS
from ilmek.machines.tufting_machine.tree import tree
from ilmek.part.bill import bill
from ilmek.records import computed, record
from ilmek.report import BillLine, Table, columns


@record
class TuftingPrice:
    """The parts of a machine, and its price by cause; control, cabinet and guards are not designed."""

    lines: tuple[BillLine, ...]
    prices: dict[str, float]
    shares: dict[str, float]
    cost: MachineCost

    mass = computed("kg", "mass of all parts but the reducers", lambda it: sum(line.mass_all for line in it.lines))
    parts_number = computed("1", "pieces in the parts list", lambda it: sum(line.number for line in it.lines))
    price = computed("", "price of the machine as sold, without control", lambda it: sum(it.shares.values()))
    price_shares = computed("", "the same by cause", lambda it: it.shares)

    @property
    def table(self) -> Table:
        """The parts list with masses and prices."""
        rows = tuple(
            (line.name, line.number, line.description, line.mass, line.mass_all, self.prices[line.part])
            for line in self.lines
        )
        heads = columns("part | number | description | mass of one [kg] 3 | mass of all [kg] | price of all")
        return Table("tufting-machine-parts", "Parts of the machine", heads, rows)


def _wired(cost: MachineCost, machine: TuftingMachine) -> MachineCost:
    """The cost with scrolls and latches wired by modules."""
    pattern = machine.params.pattern
    scrolls = machine.feed.yarn_shafts if pattern.attachment == SCROLLS else 0
    latches = machine.carpet.needles if machine.latches else 0
    axes = cost.axes - sum(one - math.ceil(one / pattern.module) for one in (scrolls, latches))
    return replace(cost, fitting=cost.fitting._replace(axes=axes))


@lru_cache(maxsize=8)
def tufting_price(machine: TuftingMachine) -> TuftingPrice:
    """The price of a machine. Raises ParameterError for unreadable prices."""
    lines, prices = bill(tree(machine)), read_prices(machine.params.prices)
    cost = _wired(machine_cost(lines, prices), machine)
    shares = price_shares(lines, prices, machine.params.cost, cost)
    return TuftingPrice(lines, {line.part: price_of(line, prices) for line in lines}, shares, cost)
