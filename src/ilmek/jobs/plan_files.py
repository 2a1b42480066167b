"""The files of a plan: page, picture, plan.csv, purchase.csv, plan.json."""

from datetime import timedelta
from pathlib import Path

from ilmek.factory.calendar import DAY
from ilmek.io.csv_cells import csv_rows
from ilmek.io.json_file import write_json
from ilmek.io.output import Outputs
from ilmek.jobs.plan import PlanResult
from ilmek.jobs.plan_results import plan_json, plan_results
from ilmek.jobs.plan_tables import (
    begun_table,
    day_text,
    loom_table,
    measure_table,
    moved_table,
    order_table,
    yarn_table,
)
from ilmek.viz.page_parts import Fact, FileNote
from ilmek.viz.plan_page import PlanPage, plan_page, plan_svg
from ilmek.viz.plan_picture import PlanBar, PlanChart, PlanLane

PLAN_COLUMNS = ("order", "loom", "start", "dressed", "woven", "end", "cost", "late [h]")
PURCHASE_COLUMNS = ("yarn", "needed [kg]", "stock [kg]", "to buy [kg]", "price", "needed by", "order by")


NOTES = (
    FileNote("plan.html", "this page"),
    FileNote("plan.svg", "the picture of the plan"),
    FileNote("plan.csv", "carpets: loom, times and cost, one a line"),
    FileNote("purchase.csv", "yarn to buy, one a line"),
    FileNote("plan.json", "all results"),
)


def write_plan(done: PlanResult, folder: Path, outputs: Outputs) -> list[str]:
    """Write the files of a plan into a folder; returns their paths, the page first."""
    chart = plan_chart(done)
    notes = tuple(note for note in NOTES if chart is not None or note.name != "plan.svg")
    files = [str(folder / note.name) for note in notes]
    with outputs.folder(folder) as work:
        if chart is not None:
            (work / "plan.svg").write_text(plan_svg(chart), encoding="utf-8")
        (work / "plan.csv").write_text(plan_csv(done), encoding="utf-8")
        (work / "purchase.csv").write_text(purchase_csv(done), encoding="utf-8")
        (work / "plan.html").write_text(plan_page(_page(done, chart, notes)), encoding="utf-8")
        write_json(work / "plan.json", plan_json(done, files))
    return files


def plan_chart(done: PlanResult) -> PlanChart | None:
    """The picture of a plan; None without carpets. Each order has a colour."""
    plan, factory, inputs = done.plan, done.inputs.factory, done.inputs
    if not plan.carpets and not inputs.begun:
        return None
    origin = inputs.origin
    start = (inputs.orders_file.start - origin) // timedelta(minutes=1)
    lanes = []
    for index, loom in enumerate(factory.looms):
        on_loom = (
            PlanBar(
                inputs.orders[carpet.order].entry.name,
                carpet.order,
                (start, start, carpet.woven, carpet.end),
                (inputs.orders[carpet.order].entry.due - origin) // timedelta(minutes=1),
            )
            for carpet in inputs.begun
            if carpet.loom == index
        )
        planned = (
            PlanBar(
                inputs.orders[factory.jobs[carpet.job].order].entry.name,
                factory.jobs[carpet.job].order,
                (carpet.start, carpet.dressed, carpet.woven, carpet.end),
                factory.jobs[carpet.job].due,
            )
            for carpet in plan.on_loom(index)
        )
        lanes.append(PlanLane(loom.name, loom.weaving.windows, (*on_loom, *planned)))
    bars = [bar for lane in lanes for bar in lane.bars]
    begin, last = min(bar.phases[0] for bar in bars), max(bar.phases[-1] for bar in bars)
    # A due date far behind the last carpet would make the bars short.
    end = max(last, *(bar.due for bar in bars if bar.due <= last + (last - begin) // 4), begin + 1)
    return PlanChart("Plan of the factory", origin, begin // DAY * DAY, -(-(end + 1) // DAY) * DAY, tuple(lanes))


def _page(done: PlanResult, chart: PlanChart | None, notes: tuple[FileNote, ...]) -> PlanPage:
    found = plan_results(done)
    late = sum(bool(order["late"]) for order in found["orders"])
    lost = sum(not order["woven"] for order in found["orders"])
    money = found["currency"]
    bound = "" if found["bound"] is None else f"bound {found['bound']:,.2f} {money}, gap {found['gap']:.1%}"
    facts = (
        Fact("Cost", f"{found['cost']:,.2f} {money}", bound),
        Fact("Cost of delays", f"{found['late_cost']:,.2f} {money}", "", "bad" if found["late_cost"] else "good"),
        Fact("Late orders", str(late), f"of {len(found['orders'])}", "bad" if late else "good"),
        *((Fact("Not woven", str(lost), "no loom can weave them", "bad"),) if lost else ()),
        Fact(
            "Yarn to buy", _price(found["yarn_price"], money), f"{sum(one['to_buy'] for one in found['yarn']):.2f} kg"
        ),
        Fact("End", day_text(done.inputs.time(done.plan.end).isoformat()) if done.plan.carpets else "–"),
    )
    tables = (
        begun_table(found),
        order_table(found),
        moved_table(found),
        measure_table(found),
        loom_table(found),
        yarn_table(found),
    )
    files = done.inputs.orders_file.path.name, done.inputs.looms_file.path.name
    return PlanPage(
        f"{files[0]} on {files[1]}, from {day_text(done.inputs.orders_file.start.isoformat())}",
        facts,
        chart,
        done.checks,
        tuple(table for table in tables if table.rows),
        done.warnings,
        notes,
    )


def _price(price: float | None, money: str) -> str:
    return "no price given" if price is None else f"{price:,.2f} {money}"


def plan_csv(done: PlanResult) -> str:
    """The carpets as CSV, one line each, in the order of the file; costs in the currency."""
    rows: list[tuple[object, ...]] = [(*PLAN_COLUMNS[:-2], f"cost [{_currency(done)}]", PLAN_COLUMNS[-1])]
    for order in plan_results(done)["orders"]:
        for one in order["carpets"]:
            times = (one[key] for key in ("loom", "start", "dressed", "woven", "end"))
            rows.append((order["name"], *times, f"{one['cost']:.2f}", f"{one['late'] / 3600:.2f}"))
        if not order["woven"]:
            rows.append((order["name"], "none", "", "", "", "", "", ""))
    return csv_rows(rows)


def purchase_csv(done: PlanResult) -> str:
    """The yarn to buy as CSV, one line per yarn; masses to 1 g."""
    rows: list[tuple[object, ...]] = [(*PURCHASE_COLUMNS[:4], f"price [{_currency(done)}]", *PURCHASE_COLUMNS[5:])]
    for result in plan_results(done)["yarn"]:
        masses = (f"{result[key]:.3f}" for key in ("needed", "stock", "to_buy"))
        price = "" if result["price"] is None else f"{result['price']:.2f}"
        rows.append((result["name"], *masses, price, result["needed_by"], result["order_by"]))
    return csv_rows(rows)


def _currency(done: PlanResult) -> str:
    return done.inputs.orders_file.currency
