"""The results of a plan by their JSON names."""

import math
from collections.abc import Sequence

from ilmek.factory.model import HOUR, MONEY, PlannedCarpet
from ilmek.factory.rescue import Rescue
from ilmek.factory.yarn_stock import Purchase
from ilmek.jobs.chart import job_json
from ilmek.jobs.plan import PlanResult, rescue_text
from ilmek.jobs.plan_begun import BegunCarpet
from ilmek.machines.automated_loom.making import ON_LOOM
from ilmek.records import JsonObject
from ilmek.report import Json
from ilmek.units import g, minute


def plan_results(done: PlanResult) -> JsonObject:
    """The results by their JSON names, SI; money in the currency, times as local dates."""
    solved, plan = done.solved, done.plan
    return {
        "orders": [_order_json(done, index) for index in range(len(done.inputs.orders))],
        "bound": None if solved is None else solved.bound / MONEY,
        "cost": plan.cost / MONEY,
        "loom_cost": plan.loom_costs / MONEY,
        "late_cost": plan.late_costs / MONEY,
        "gap": done.gap,
        "late_carpets": len(plan.late),
        "least_late": None if solved is None or not solved.fine else solved.least_late,
        "currency": done.inputs.orders_file.currency,
        "status": "none" if solved is None else solved.status,
        "repeatable": solved is None or (solved.repeatable and not done.ended),
        "horizon": None if solved is None else _iso(done, solved.horizon),
        "begun": [_begun_json(done, carpet) for carpet in done.inputs.begun],
        "looms": [_loom_json(done, index) for index in range(len(done.inputs.factory.looms))],
        "late_orders": [
            {
                "name": done.inputs.orders[one.order].entry.name,
                "measures": [_rescue_json(done, rescue) for rescue in one.rescues],
            }
            for one in done.late
        ],
        "yarn": [purchase_json(done, purchase) for purchase in done.purchases],
        "yarn_price": _yarn_price(done),
    }


def _iso(done: PlanResult, minutes: int) -> str:
    return done.inputs.time(minutes).isoformat(timespec="minutes")


def _order_json(done: PlanResult, index: int) -> dict[str, Json]:
    entry, carpets, end = done.inputs.orders[index].entry, done.carpets(index), done.end(index)
    before = done.before.get(entry.name)
    looms = done.inputs.factory.looms
    return {
        "name": entry.name,
        "loom": ", ".join(dict.fromkeys(looms[carpet.loom].name for carpet in carpets)) or None,
        "start": _iso(done, carpets[0].start) if carpets else None,
        "end": None if end is None else _iso(done, end),
        "moved": None if end is None or before is None else (done.inputs.time(end) - before).total_seconds(),
        "cost": sum(map(done.cost, carpets)) / MONEY if carpets else None,
        "late": None if end is None else minute * done.overdue(index),
        "due": entry.due.isoformat(timespec="minutes"),
        "woven": end is not None,
        "quantity": entry.quantity,
        "carpets": [_carpet_json(done, carpet) for carpet in carpets],
    }


def _begun_json(done: PlanResult, carpet: BegunCarpet) -> JsonObject:
    return {
        "order": done.inputs.orders[carpet.order].entry.name,
        "loom": done.inputs.factory.looms[carpet.loom].name,
        "rows": carpet.rows,
        "of": carpet.of,
        "pace": carpet.pace,
        "woven": _iso(done, carpet.woven),
        "end": _iso(done, carpet.end),
        "late": minute * carpet.late,
    }


def _carpet_json(done: PlanResult, one: PlannedCarpet) -> dict[str, Json]:
    factory, steps = done.inputs.factory, done.steps(one)
    finishing = sum(step.time or 0.0 for step in steps[len(ON_LOOM) :])
    return {
        "loom": factory.looms[one.loom].name,
        "start": _iso(done, one.start),
        "dressed": _iso(done, one.dressed),
        "woven": _iso(done, one.woven),
        "end": _iso(done, one.end),
        "finished": _iso(done, one.end + math.ceil(finishing / minute)),
        "making_steps": [step.as_json() for step in steps],
        "weaving_time": minute * factory.jobs[one.job].weaving[one.loom],
        "same_setup": one.same,
        "cost": done.cost(one) / MONEY,
        "late": minute * max(one.end - factory.jobs[one.job].due, 0),
    }


def _loom_json(done: PlanResult, index: int) -> dict[str, Json]:
    factory, carpets = done.inputs.factory, done.plan.on_loom(index)
    loom = factory.looms[index]
    busy = sum(
        loom.dressing_time(same=carpet.same) + factory.jobs[carpet.job].weaving[index] + loom.doffing
        for carpet in carpets
    )
    open_time = loom.weaving.work(done.plan.end) - loom.weaving.work(loom.available)
    return {
        "name": loom.name,
        "carpets": len(carpets),
        "busy": minute * busy,
        "utilisation": busy / open_time if open_time > 0 else 0.0,
        "end": _iso(done, carpets[-1].end) if carpets else None,
    }


def _rescue_json(done: PlanResult, rescue: Rescue) -> dict[str, Json]:
    return {
        "measure": rescue.kind,
        "loom": done.inputs.looms_file.looms[rescue.loom].name if rescue.loom >= 0 else None,
        "time": minute * HOUR * rescue.hours or None,
        "text": rescue_text(done, rescue),
        "cost": rescue.plan.cost / MONEY,
    }


def purchase_json(done: PlanResult, one: Purchase) -> JsonObject:
    """A yarn to buy: masses [kg], price, when it is needed, and when to order it."""
    factory = done.inputs.factory
    yarn = factory.yarns[one.yarn]
    begin = done.inputs.orders_file.start
    needed = max(done.inputs.time(one.by), begin)
    lead = next((stock.lead for stock in done.inputs.looms_file.yarns if stock.name == yarn.name), 0.0)
    order = max(done.inputs.time(one.by - round(lead / minute)), begin)
    rate = _rate(done, yarn.name)
    return {
        "name": yarn.name,
        "needed": g * one.needed,
        "stock": g * yarn.stock,
        "to_buy": g * one.grams,
        "price": None if rate is None else rate * g * one.grams,
        "needed_by": needed.isoformat(timespec="minutes"),
        "order_by": order.isoformat(timespec="minutes"),
    }


def _rate(done: PlanResult, name: str) -> float | None:
    """Price of a yarn per kilogram: of the stock, else of the first bill that has one in the plan's currency."""
    for stock in done.inputs.looms_file.yarns:
        if stock.name == name and stock.price is not None:
            return stock.price
    for order in done.inputs.orders:
        for need in order.bill.needs if order.bill.currency == done.inputs.orders_file.currency else ():
            if need.bought == name and need.price is not None and need.to_buy > 0:
                return need.price / need.to_buy
    return None


def _yarn_price(done: PlanResult) -> float | None:
    prices: Sequence[float | None] = [purchase_json(done, purchase)["price"] for purchase in done.purchases]
    known = [price for price in prices if price is not None]
    return sum(known) if len(known) == len(prices) else None


def plan_json(done: PlanResult, files: Sequence[str] = ()) -> JsonObject:
    """The JSON of the job."""
    parameters = {
        "orders": str(done.inputs.orders_file.path),
        "looms": str(done.inputs.looms_file.path),
        "start": done.inputs.orders_file.start.isoformat(timespec="minutes"),
        "time_limit": done.time_limit,
        "aim": done.aim,
    }
    results = plan_results(done)
    return job_json("plan", parameters, results, checks=done.checks, warnings=list(done.warnings), files=list(files))
