"""`ilmek order`: quotation, approval sheet and workshop folders of a customer's order."""

from pathlib import Path
from typing import TYPE_CHECKING

import click

from ilmek.cli.call_outputs import call_outputs
from ilmek.cli.options import file_option, force_option, json_option, text_option
from ilmek.cli.terminal import note, say, show_pairs, show_table
from ilmek.cli.verdict import exit_code, note_verdict, show_verdict
from ilmek.errors import ParameterError

if TYPE_CHECKING:
    from ilmek.jobs.ordering.work import OrderResult

EXAMPLES = """\b
Examples:
  ilmek order examples/order.toml --out order
  ilmek order order.toml --looms looms.toml --key workshop.key --out order
  ilmek order order.toml --out order --force --run "Kazak, madder=run"

Limits: file 2 MB; 3000 carpets, 20 colourways and 20 sizes of a design.
"""


@click.command(epilog=EXAMPLES)
@click.argument("order", type=click.Path(path_type=Path), metavar="ORDER.toml")
@file_option("--out", "DIR", "Folder of the papers; default: the name of the order's file.")
@file_option("--looms", "LOOMS.toml", "Looms, shifts, yarn in stock; default: those of the order, else two frames.")
@file_option("--key", "FILE", "Sign the records with the key of this file, which is made where it is missing.")
@click.option(
    "--run", "runs", multiple=True, metavar="NAME=DIR", help="The carpet NAME is woven by the run with this journal."
)
@text_option("--time-limit", "TIME", "Time to plan in, like 30s; default: about a second.")
@force_option
@json_option
def command(
    order: Path,
    *,
    out: Path | None,
    looms: Path | None,
    key: Path | None,
    runs: tuple[str, ...],
    time_limit: str | None,
    force: bool,
    json_to: str | None,
) -> int:
    """Work a customer's ORDER: plan it, price it, and write its papers.

    DIR/offer has quotation.pdf, approval.pdf and order.json. Each size in each colourway has a folder beside it for the
    workshop: chart, rows, yarn, mounting sheet, wages, strike-off, and of each carpet its record and its label. The
    file is that of `ilmek plan`, with the terms of the sale. Needs the extras orders and planning.

    Rows that are woven are read from `ilmek call`, or from the journal of --run; write the folder again with --force.

    Ends with 3 where a carpet is late or cannot be woven, with what would save it.
    """
    from ilmek.jobs.ordering.work import order_json, work_order
    from ilmek.jobs.plan import read_time_limit

    limit = None if time_limit is None else read_time_limit(time_limit)
    inputs = {"ORDER": order, "--looms": looms, "--key": key}
    with call_outputs({"--json": json_to}, force=force, inputs=inputs) as call:
        done = work_order(
            order,
            out or Path(order.stem),
            looms=looms,
            runs=dict(_run(text) for text in runs),
            key=key,
            time_limit=limit,
            outputs=call.outputs,
            progress=call.progress,
        )
        call.give_json(lambda: order_json(done))
    if call.quiet:
        note_verdict(done.checks)
    else:
        show_verdict(done.checks)
        _show(done)
    for warning in done.warnings:
        note(warning)
    return exit_code(done.checks)


def _run(text: str) -> tuple[str, Path]:
    name, equals, folder = text.rpartition("=")
    if not equals or not name or not folder:
        raise ParameterError(f"--run {text!r}", allowed="NAME=DIR", do='write it like "Kazak, madder=run"')
    return name, Path(folder)


def _show(done: "OrderResult") -> None:
    """Print each carpet with its price and delivery, what would save late ones, and the sums."""
    from ilmek.jobs.ordering.work import order_results
    from ilmek.jobs.plan_results import plan_results
    from ilmek.jobs.plan_tables import measure_table

    found = order_results(done)
    rows = [
        (one["name"], str(one["quantity"]), f"{one['unit_price']:,.2f}", f"{one['net']:,.2f}", one["delivery"])
        for one in found["carpets"]
    ]
    money = found["currency"]
    show_table(("carpet", "pieces", f"unit price [{money}]", f"net [{money}]", "delivery"), rows, right=(1, 2, 3))
    measures = measure_table(plan_results(done.plan))
    if measures.rows:
        show_table(measures.headings, measures.rows, right=measures.numbers)
    show_pairs([("net", f"{found['net']:,.2f} {money}"), ("with tax", f"{found['total']:,.2f} {money}")])
    say(f"papers: {done.files[0]}")
