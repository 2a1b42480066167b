"""`ilmek plan`: several carpets on looms that exist."""

from pathlib import Path
from typing import TYPE_CHECKING

import click

from ilmek.cli.call_outputs import call_outputs
from ilmek.cli.options import file_option, force_option, json_option, text_option
from ilmek.cli.terminal import note, say, show_pairs, show_table
from ilmek.cli.verdict import exit_code, note_verdict, show_verdict

if TYPE_CHECKING:
    from ilmek.jobs.plan import PlanResult

EXAMPLES = """\b
Examples:
  ilmek plan examples/orders.toml --looms examples/looms.toml
  ilmek plan examples/orders.toml --looms examples/looms.toml --out plan --force
  ilmek plan orders.toml --looms looms.toml --time-limit 30s --json -

Limits: file 2 MB; 3000 carpets, 1000 looms, 50 shifts.
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
@file_option("--out", "DIR", "Write page, picture, plan and purchase into a folder.")
@text_option("--now", "TIME", "Begin of the plan, like 2026-12-03T10:00, for --looms with what they weave.")
@file_option("--against", "PLAN.json", "An earlier plan, to compare the ends of the orders with.")
@click.option(
    "--aim",
    type=click.Choice(("cost", "late")),
    default="cost",
    show_default=True,
    help="Least cost, or first the fewest late carpets.",
)
@text_option("--time-limit", "TIME", "Time to plan in, like 30s; default: 10s for ten carpets, 60s for a hundred.")
@force_option
@json_option
def command(
    orders: Path,
    *,
    looms: Path,
    out: Path | None,
    now: str | None,
    against: Path | None,
    aim: str,
    time_limit: str | None,
    force: bool,
    json_to: str | None,
) -> int:
    """Plan which loom weaves which carpet of ORDERS when, at the least cost of looms and delays.

    Needs the extra planning. Each plan is verified before it is reported, with a bound that no plan costs less than.
    Late orders are named with what would save them, and the yarn to buy for all of them together. A carpet that the
    file of the looms has on a loom stays there, at the pace of its journal.

    Ends with 3 where an order is late or cannot be woven.
    """
    from ilmek.io.plan_file import read_instant
    from ilmek.jobs.plan import plan_factory, read_time_limit
    from ilmek.jobs.plan_files import write_plan
    from ilmek.jobs.plan_results import plan_json

    limit = None if time_limit is None else read_time_limit(time_limit)
    begin = None if now is None else read_instant("--now", now)
    inputs = {"ORDERS": orders, "--looms": looms, **({} if against is None else {"--against": against})}
    with call_outputs({"--json": json_to}, force=force, inputs=inputs) as call:
        if out is not None:
            call.outputs.expect_folder(out, "--out")
        done = plan_factory(
            orders,
            looms,
            time_limit=limit,
            now=begin,
            against=against,
            aim=aim,
            progress=call.progress,
        )
        files = [] if out is None else write_plan(done, out, call.outputs)
        call.give_json(lambda: plan_json(done, files))
    if call.quiet:
        note_verdict(done.checks)
    else:
        show_verdict(done.checks)
        _show(done)
        if files:
            say(f"report: {files[0]}")
    for warning in done.warnings:
        note(warning)
    return exit_code(done.checks)


def _show(done: "PlanResult") -> None:
    """Print the orders, what would save late ones, the yarn to buy, and the cost beside its bound."""
    from ilmek.jobs.plan_results import plan_results
    from ilmek.jobs.plan_tables import begun_table, cost_lines, measure_table, moved_table, order_table, yarn_table

    found = plan_results(done)
    for make in (begun_table, order_table, moved_table, measure_table, yarn_table):
        table = make(found)
        if table.rows:
            show_table(table.headings, table.rows, right=table.numbers)
    show_pairs(cost_lines(done))
