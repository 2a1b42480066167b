"""The files of a plan: page, plan.csv, purchase.csv, plan.json."""

from pathlib import Path

from ilmek.io.csv_cells import csv_rows
from ilmek.io.json_file import write_json
from ilmek.io.output import Outputs
from ilmek.jobs.plan import PlanResult, plan_json, plan_results

PLAN_COLUMNS = ("order", "loom", "start", "dressed", "woven", "end", "cost", "late [h]")
PURCHASE_COLUMNS = ("yarn", "needed [kg]", "stock [kg]", "to buy [kg]", "price", "needed by", "order by")


def write_plan(done: PlanResult, folder: Path, outputs: Outputs) -> list[str]:
    """Write the files of a plan into a folder; returns their paths."""
    with outputs.folder(folder) as work:
        names = ["plan.csv", "purchase.csv", "plan.json"]
        (work / "plan.csv").write_text(plan_csv(done), encoding="utf-8")
        (work / "purchase.csv").write_text(purchase_csv(done), encoding="utf-8")
        files = [str(folder / name) for name in names]
        write_json(work / "plan.json", plan_json(done, files))
    return files


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
    for one in plan_results(done)["yarn"]:
        masses = (f"{one[key]:.3f}" for key in ("needed", "stock", "to_buy"))
        price = "" if one["price"] is None else f"{one['price']:.2f}"
        rows.append((one["name"], *masses, price, one["needed_by"], one["order_by"]))
    return csv_rows(rows)


def _currency(done: PlanResult) -> str:
    return done.inputs.orders_file.currency
