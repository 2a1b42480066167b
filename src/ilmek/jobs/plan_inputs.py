"""From the files of a factory to its model: carpets to weave, yarn in stock, looms and what is on them."""

import math
from collections.abc import Sequence
from dataclasses import replace
from datetime import datetime, timedelta

from ilmek.carpet.price_rules import WageRules
from ilmek.errors import ParameterError
from ilmek.factory.calendar import Calendar, Shift, calendar, without
from ilmek.factory.model import HOUR, MONEY, CarpetJob, Factory, Loom, StoredYarn
from ilmek.io.looms_file import FactoryLooms, LoomEntry
from ilmek.io.orders_file import FactoryOrders
from ilmek.jobs.plan_begun import BegunCarpet, begun_carpet, require_counts
from ilmek.jobs.plan_fits import PlannedOrder, planned_orders, ready_looms
from ilmek.progress import SILENT, Progress
from ilmek.records import record
from ilmek.units import g, hour, minute


@record
class FactoryInputs:
    """The files, and the model that is made of them.

    orders   all orders; `jobs`: the indices of the jobs of each order, none for an order that no loom weaves
    origin   the midnight from which minutes count
    begun    the carpets that are on looms when the plan begins; they are no jobs
    """

    orders_file: FactoryOrders
    looms_file: FactoryLooms
    orders: tuple[PlannedOrder, ...]
    jobs: tuple[tuple[int, ...], ...]
    factory: Factory
    origin: datetime
    begun: tuple[BegunCarpet, ...] = ()

    @property
    def wage(self) -> WageRules | None:
        """The wage of weavers: that of the orders, else of the looms' file."""
        return self.orders_file.wage or self.looms_file.wage

    def time(self, minutes: int) -> datetime:
        """The instant of a minute of the plan."""
        return self.origin + timedelta(minutes=minutes)


def read_inputs(orders: FactoryOrders, looms: FactoryLooms, progress: Progress = SILENT) -> FactoryInputs:
    """The model of a factory. Raises an IlmekError, with file and line, for what cannot be read or designed."""
    if orders.currency != looms.currency:
        given = f"{orders.path} is in {orders.currency}, {looms.path} in {looms.currency}"
        raise ParameterError(given, allowed="one currency", do="set currency in both files")
    ready = ready_looms(looms, progress.part(0.0, 0.4, "looms"))
    planned = planned_orders(orders, ready, progress.part(0.4, 1.0, "carpets"))
    origin = orders.start.replace(hour=0, minute=0)
    setups: dict[tuple[object, ...], int] = {}
    own = [setups.setdefault(order.setup, len(setups)) for order in planned]
    empty = _looms(looms, orders.start, origin)
    begun = _begun(looms, empty, planned, orders.start, origin)
    jobs: list[CarpetJob] = []
    indices: list[tuple[int, ...]] = []
    names = _yarn_names(planned)
    for number, order in enumerate(planned):
        job = replace(_job(order, looms, origin, names), order=number, setup=own[number])
        woven = sum(carpet is not None and carpet.order == number for carpet in begun)
        count = order.entry.quantity - woven if order.possible else 0
        indices.append(tuple(range(len(jobs), len(jobs) + count)))
        jobs += [job] * count
    free = tuple(
        loom if carpet is None else replace(loom, available=carpet.end, setup=own[carpet.order])
        for loom, carpet in zip(empty, begun, strict=True)
    )
    factory = Factory(free, tuple(jobs), _stock(looms, names, _minutes(orders.start, origin)))
    on_looms = tuple(carpet for carpet in begun if carpet is not None)
    return FactoryInputs(orders, looms, planned, tuple(indices), factory, origin, on_looms)


def _stock(looms: FactoryLooms, names: Sequence[str], begin: int) -> tuple[StoredYarn, ...]:
    """The yarns by name, as they are in stock at the begin of the plan [min]."""
    stock = {yarn.name: yarn for yarn in looms.yarns}
    return tuple(
        StoredYarn(
            name,
            math.floor(stock[name].stock / g + 1e-6) if name in stock else 0,
            begin + round(stock[name].lead / minute) if name in stock and stock[name].lead else 0,
        )
        for name in names
    )


def _begun(
    looms: FactoryLooms, empty: Sequence[Loom], orders: Sequence[PlannedOrder], start: datetime, origin: datetime
) -> tuple[BegunCarpet | None, ...]:
    """What is on each loom at the begin of the plan."""
    due = [_minutes(order.entry.due, origin) for order in orders]
    begun = []
    for index, (entry, loom) in enumerate(zip(looms.looms, empty, strict=True)):

        def worked(since: datetime, entry: LoomEntry = entry) -> float:
            midnight = since.replace(hour=0, minute=0)
            weaving, _ = _calendars(looms, entry, midnight)
            return minute * (weaving.work(_minutes(start, midnight)) - weaving.work(_minutes(since, midnight)))

        begun.append(begun_carpet(index, entry, loom, orders, worked=worked, due=due))
    require_counts([carpet for carpet in begun if carpet is not None], orders, looms.looms)
    return tuple(begun)


def _minutes(time: datetime, origin: datetime) -> int:
    return (time - origin) // timedelta(minutes=1)


def _yarn_names(orders: Sequence[PlannedOrder]) -> list[str]:
    """The yarns of all orders that are woven, in the order of their first use."""
    return list(dict.fromkeys(need.bought for order in orders if order.possible for need in order.bill.needs))


def _job(order: PlannedOrder, looms: FactoryLooms, origin: datetime, names: Sequence[str]) -> CarpetJob:
    """A carpet of an order; the indices of order and setup are 0."""
    entry, index = order.entry, {name: at for at, name in enumerate(names)}
    weaving = {
        at: math.ceil(fit.time / (1 - loom.stops) / minute - 1e-9)
        for at, (fit, loom) in enumerate(zip(order.fits, looms.looms, strict=True))
        if fit.time is not None
    }
    yarns: dict[int, int] = {}
    for need in order.bill.needs if order.possible else ():
        yarns[index[need.bought]] = yarns.get(index[need.bought], 0) + math.ceil(need.to_buy / g - 1e-6)
    late = round(MONEY * entry.late * hour) * entry.priority
    earliest = _minutes(entry.earliest, origin)
    return CarpetJob(0, 0, weaving, earliest, _minutes(entry.due, origin), late, yarns)


def _looms(looms: FactoryLooms, start: datetime, origin: datetime) -> tuple[Loom, ...]:
    """The looms with their calendars, empty; equal calendars are made once."""
    made: dict[object, tuple[Calendar, Calendar]] = {}
    found = []
    for entry in looms.looms:
        key = entry.shifts, entry.downtime
        if key not in made:
            made[key] = _calendars(looms, entry, origin)
        available = max(_minutes(entry.available, origin) if entry.available else 0, _minutes(start, origin))
        minutes = (round(time / minute) for time in (entry.dressing, entry.dressing_same, entry.doffing))
        dressing, same, doffing = minutes
        cost = round(MONEY * entry.cost * 60 * HOUR)
        found.append(Loom(entry.name, *made[key], cost, dressing, same, doffing, available))
    return tuple(found)


def _calendars(looms: FactoryLooms, entry: LoomEntry, origin: datetime) -> tuple[Calendar, Calendar]:
    """When a loom weaves and when it is attended, from a midnight on: its shifts less holidays and downtime."""
    shifts = [
        Shift(shift.name, shift.days, shift.start, shift.end, shift.breaks, shift.attended)
        for name in entry.shifts
        for shift in looms.shifts
        if shift.name == name
    ]
    holidays = frozenset((day - origin.date()).days for day in looms.holidays)
    down = [(_minutes(begin, origin), _minutes(end, origin)) for begin, end in entry.downtime]
    plain = (calendar(shifts, origin.weekday(), holidays, attended=only) for only in (False, True))
    weaving, attended = (Calendar(without(one.windows, down)) for one in plain)
    return weaving, attended
