"""`ilmek plan`: several carpets on looms that exist."""

from datetime import datetime
from pathlib import Path

import click

from ilmek.cli.call_outputs import call_outputs
from ilmek.cli.options import force_option, json_option
from ilmek.cli.terminal import note, say, show_pairs, show_table
from ilmek.cli.verdict import exit_code, note_verdict, show_verdict

EXAMPLES = """\b
Examples:
  ilmek plan examples/orders.toml --looms examples/looms.toml
  ilmek plan examples/orders.toml --looms examples/looms.toml --out plan --force
  ilmek plan orders.toml --looms looms.toml --time-limit 30s --json -

Limits: file 250 kB; 500 carpets, 50 looms, 50 shifts.
"""


@click.command(epilog=EXAMPLES)
@click.argument("orders", type=click.Path(path_type=Path), metavar="ORDERS.toml")
@click.option(
    "--looms",
    required=True,
    type=click.Path(path_type=Path),
    metavar="LOOMS.toml",
    help="Looms, shifts, yarn in stock.",
)
@click.option(
    "--out",
    type=click.Path(path_type=Path),
    metavar="DIR",
    help="Write page, picture, plan and purchase into a folder.",
)
@click.option(
    "--time-limit", metavar="TIME", help="Time to plan in, like 30s; default: 10s for ten carpets, 60s for a hundred."
)
@force_option
@json_option
def command(
    orders: Path, *, looms: Path, out: Path | None, time_limit: str | None, force: bool, json_to: str | None
) -> int:
    """Plan which loom weaves which carpet of ORDERS when, at the least cost of looms and delays.

    Needs the extra planning. Each plan is verified before it is reported, with a bound that no plan costs less than.
    Late orders are named with what would save them, and the yarn to buy for all of them together.

    Ends with 3 where an order is late or cannot be woven.
    """
    from ilmek.jobs.plan import plan_factory, plan_json, read_time_limit
    from ilmek.jobs.plan_files import write_plan

    limit = None if time_limit is None else read_time_limit(time_limit)
    inputs = {"ORDERS": orders, "--looms": looms}
    with call_outputs({"--json": json_to}, force=force, inputs=inputs) as call:
        if out is not None:
            call.outputs.expect_folder(out, "--out")
        done = plan_factory(orders, looms, time_limit=limit, progress=call.progress)
        files = [] if out is None else write_plan(done, out, call.outputs)
        call.give_json(lambda: plan_json(done, files))
    if call.quiet:
        note_verdict(done.checks)
    else:
        show_verdict(done.checks)
        _show(plan_json(done, files))
    for warning in done.warnings:
        note(warning)
    return exit_code(done.checks)


def _show(found: dict) -> None:  # type: ignore[type-arg]
    """Print the orders, what would save late ones, the yarn to buy, and the cost beside its bound."""
    currency = found["currency"]
    rows = [
        (order["name"], one["loom"], _day(one["start"]), _day(one["end"]), f"{one['cost']:,.2f}", _hours(one["late"]))
        for order in found["orders"]
        for one in order["carpets"]
    ]
    rows += [(order["name"], "none", "", "", "", "not woven") for order in found["orders"] if not order["woven"]]
    show_table(("order", "loom", "start", "end", f"cost [{currency}]", "late"), rows, right=(4, 5), wide=(2, 3))
    for late in found["late_orders"]:
        if late["measures"]:
            say(f"{late['name']} is late; any of these saves it, with the cost of the plan then:")
            for one in late["measures"]:
                say(f"  {one['text']}: {one['cost']:,.2f} {currency}")
    if found["yarn"]:
        bought = [
            (
                one["name"],
                f"{one['needed']:.2f}",
                f"{one['stock']:.2f}",
                f"{one['to_buy']:.2f}",
                "" if one["price"] is None else f"{one['price']:,.2f}",
                _day(one["needed_by"]),
                _day(one["order_by"]),
            )
            for one in found["yarn"]
        ]
        headings = ("yarn", "needed [kg]", "stock [kg]", "to buy [kg]", f"price [{currency}]", "needed by", "order by")
        show_table(headings, bought, right=(1, 2, 3, 4), wide=(5, 6))
    pairs = [
        ("cost", f"{found['cost']:,.2f} {currency}: looms {found['loom_cost']:,.2f}, delays {found['late_cost']:,.2f}")
    ]
    if found["bound"] is not None:
        pairs.append(("bound", f"no plan costs less than {found['bound']:,.2f} {currency} (gap {found['gap']:.1%})"))
    pairs += [("report", found["files"][0])] if found["files"] else []
    show_pairs(pairs)


def _day(text: str) -> str:
    return f"{datetime.fromisoformat(text):%a %Y-%m-%d %H:%M}"


def _hours(seconds: float) -> str:
    return f"{seconds / 3600:.1f} h" if seconds else "–"
