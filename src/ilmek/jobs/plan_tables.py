"""The tables of a plan, for the terminal and for its page."""

from datetime import datetime

from ilmek.factory.model import MONEY
from ilmek.jobs.plan import PlanResult
from ilmek.jobs.plan_results import plan_results
from ilmek.records import JsonObject
from ilmek.units import hour
from ilmek.viz.plan_page import PlanTable


def order_table(found: JsonObject) -> PlanTable:
    """The carpets of the results of a plan, in the order of the file."""
    rows = []
    for order in found["orders"]:
        due = day_text(order["due"])
        for one in order["carpets"]:
            cost, late = f"{one['cost']:,.2f}", _late(one["late"])
            rows.append((order["name"], one["loom"], day_text(one["start"]), day_text(one["end"]), due, cost, late))
        if not order["woven"]:
            rows.append((order["name"], "none", "", "", due, "", "not woven"))
    headings = ("order", "loom", "start", "end", "due", f"cost [{found['currency']}]", "late")
    return PlanTable("Orders", headings, tuple(rows), (5, 6))


def begun_table(found: JsonObject) -> PlanTable:
    """What is on the looms when the plan begins: pace 1.10 is 10 % slower than planned."""
    rows = tuple(
        (
            one["loom"],
            one["order"],
            f"{one['rows']} of {one['of']}",
            f"{one['pace']:.2f}",
            day_text(one["woven"]),
            day_text(one["end"]),
            _late(one["late"]),
        )
        for one in found["begun"]
    )
    headings = ("loom", "order", "rows", "pace", "woven", "off the loom", "late")
    return PlanTable("On the looms", headings, rows, (2, 3, 6))


def moved_table(found: JsonObject) -> PlanTable:
    """The orders that end at another time than in the earlier plan."""
    rows = tuple(
        (order["name"], day_text(order["end"]), f"{order['moved'] / hour:+.1f} h")
        for order in found["orders"]
        if order["moved"]
    )
    return PlanTable("Against the earlier plan", ("order", "end", "moved"), rows, (2,))


def measure_table(found: JsonObject) -> PlanTable:
    """What would save the late orders: each measure with the cost of its plan."""
    rows = tuple(
        (order["name"], one["text"], f"{one['cost']:,.2f}")
        for order in found["late_orders"]
        for one in order["measures"]
    )
    headings = ("late order", "any of these saves it", f"cost of the plan then [{found['currency']}]")
    return PlanTable("What would save late orders", headings, rows, (2,))


def yarn_table(found: JsonObject) -> PlanTable:
    """The yarn to buy for all orders together."""
    rows = tuple(
        (
            one["name"],
            *(f"{one[key]:.2f}" for key in ("needed", "stock", "to_buy")),
            "–" if one["price"] is None else f"{one['price']:,.2f}",
            day_text(one["needed_by"]),
            day_text(one["order_by"]),
        )
        for one in found["yarn"]
    )
    price = f"price [{found['currency']}]"
    headings = ("yarn", "needed [kg]", "stock [kg]", "to buy [kg]", price, "needed by", "order by")
    return PlanTable("Yarn to buy", headings, rows, (1, 2, 3, 4))


def loom_table(found: JsonObject) -> PlanTable:
    """The work of each loom."""
    rows = tuple(
        (
            one["name"],
            str(one["carpets"]),
            f"{one['busy'] / hour:.1f}",
            f"{one['utilisation']:.0%}",
            day_text(one["end"]) if one["end"] else "–",
        )
        for one in found["looms"]
    )
    headings = ("loom", "carpets", "work [h]", "share of its shifts", "end")
    return PlanTable("Looms", headings, rows, (1, 2, 3))


def cost_lines(done: PlanResult) -> list[tuple[str, str]]:
    """The cost of the plan, and its bound."""
    found = plan_results(done)
    money = found["currency"]
    parts = f"looms {found['loom_cost']:,.2f}, delays {found['late_cost']:,.2f}"
    lines = [("cost", f"{found['cost']:,.2f} {money}: {parts}")]
    if found["bound"] is not None:
        lines.append(("bound", f"no plan costs less than {found['bound']:,.2f} {money} (gap {found['gap']:.1%})"))
    if done.solved is not None and done.solved.fine:
        below = f"no plan below {done.solved.fine / MONEY:,.2f} {money} has fewer than {found['least_late']}"
        lines.append(("late", f"{found['late_carpets']} carpets; {below}"))
    return lines


def day_text(text: str) -> str:
    """An ISO time as it is printed.

    >>> day_text("2026-12-01T06:00")
    'Tue 2026-12-01 06:00'
    """
    return f"{datetime.fromisoformat(text):%a %Y-%m-%d %H:%M}"


def _late(seconds: float) -> str:
    return f"{seconds / hour:.1f} h" if seconds else "–"
