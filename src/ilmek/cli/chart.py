"""`ilmek chart`: the knot chart and the yarn bill alone."""

from pathlib import Path
from typing import Any

import click

from ilmek.carpet.bill import YarnBill
from ilmek.carpet.chart import Chart
from ilmek.cli.call_outputs import call_outputs
from ilmek.cli.carpet_options import carpet_inputs, carpet_options, recipe_folder
from ilmek.cli.options import force_option, json_option
from ilmek.cli.proposed import show_proposed
from ilmek.cli.terminal import note, say, show_pairs, show_table
from ilmek.cli.verdict import exit_code, note_verdict, show_verdict
from ilmek.jobs.chart import ChartResult, chart_json, chart_order
from ilmek.jobs.order import read_order
from ilmek.jobs.output_folder import free_folder
from ilmek.jobs.recipe import saved_recipe
from ilmek.units import format_number, format_quantity, g

EXAMPLES = """\b
Examples:
  ilmek chart photo.jpg --size 120x180cm --quality 40x40/dm --out photo-chart
  ilmek chart photo.jpg --size kelle --colours 8 --yarns wool.toml
  ilmek chart photo.jpg --json -
  ilmek chart photo.jpg --size kelle --colours 8 --save-recipe carpet.toml
  ilmek chart carpet.toml

Limits: picture file 500 MB, 150,000,000 pixels; 255 yarns; 200,000,000 knots.
"""


@click.command(epilog=EXAMPLES)
@carpet_options
@force_option
@json_option
def command(out: Path | None, force: bool, json_to: str | None, save_recipe: str | None, **carpet: Any) -> int:
    """Make the knot chart of PICTURE and the yarn bill; a RECIPE, .toml, stands for picture and options.

    The output folder contains chart.png (one pixel per knot), chart.pdf (printed chart; see --pdf), yarn.csv and
    chart.json. With --json and without --out no folder is made. Ends with 3 where a check fails: the pile does not fit
    the ground.
    """
    order = read_order(**carpet)
    folder = out or (None if json_to else free_folder(order.picture, "chart"))
    to = {"--json": json_to, "--save-recipe": save_recipe}
    with call_outputs(to, force=force, inputs=carpet_inputs(order)) as call:
        charted, files = chart_order(order, folder, outputs=call.outputs, progress=call.progress)
        call.give_json(lambda: chart_json(charted, files))
        folder_of_recipe = recipe_folder(save_recipe)
        call.give("--save-recipe", lambda: saved_recipe(charted.order, charted.chart, folder_of_recipe))
    if not call.quiet:
        show_chart(charted)
        if folder is not None:
            say(f"files in {folder}: {', '.join(Path(file).name for file in files)}")
    else:
        note_verdict(charted.checks)
    for remark in (*charted.notes, *charted.warnings):
        note(remark)
    return exit_code(charted.checks)


def show_chart(charted: ChartResult) -> None:
    """Print a summary of a chart and its yarn bill."""
    chart, made = charted.chart, charted.chart.reading
    show_verdict(charted.checks)
    show_pairs(
        [
            ("carpet", f"{chart.size}, {chart.quality}, {chart.knot} knot"),
            ("knots", f"{chart.rows * chart.columns:,} ({chart.rows} rows of {chart.columns})"),
            ("colours", f"{chart.colours} of {len(charted.order.yarns)} yarns"),
            ("colour difference", f"{made.mean_delta_e:.2f} mean CIEDE2000 (lower bound {made.least_delta_e:.2f})"),
            ("fit", made.fit.words),
            ("reading", f"{made.kind}: {made.reason}"),
            *([("farthest colours", far)] if (far := _farthest(chart)) else []),
            ("changed knots", f"{made.changed:,}"),
            *([("edited knots", f"{made.edited:,}")] if charted.order.order.recipe is not None else []),
            *([("overlay", overlay_in_words(chart))] if len(chart.overlay) else []),
            ("lone knots", f"{chart.lone_fraction:.2%}"),
            ("colour changes", f"{chart.changes_per_knot:.3f} per knot"),
            ("pile", pile_in_words(charted)),
            ("carpet mass", mass_in_words(charted.bill)),
            ("yarn to buy", to_buy_in_words(charted)),
        ]
    )
    show_yarn(charted.bill)
    show_proposed(chart)


def overlay_in_words(chart: Chart) -> str:
    """The half knots and jufti knots of a chart."""
    return f"{sum(chart.tied.half):,} half knots, {sum(chart.tied.jufti):,} jufti knots"


def _farthest(chart: Chart) -> str:
    """The colours of a drawing that are farthest from their yarns; "" where each has its own."""
    far = [match for match in chart.reading.matches if match.delta_e >= 0.05]
    worst = sorted(far, key=lambda match: -match.delta_e)[:3]
    return ", ".join(f"{match.hex} {match.delta_e:.1f} from {chart.yarns[match.yarn].name}" for match in worst)


def pile_in_words(charted: ChartResult) -> str:
    """The pile's height and counts, given or by the quality, and the share of the ground filled."""
    plan, fill = charted.order.order.plan, charted.checks[0]
    height = format_quantity(charted.pile.pile_height, "mm", 3)
    counts = ", ".join(dict.fromkeys(need.count for need in charted.bill.pile))
    filled = f"{format_quantity(fill.value, fill.unit, 3)} of the ground filled"
    by_quality = " (by the quality)"
    return (
        f"{height} high{'' if plan.pile_height is not None else by_quality}, "
        f"Nm {counts}{by_quality if charted.usual_counts else ''}, {filled}"
    )


def mass_in_words(bill: YarnBill) -> str:
    """The mass of the finished carpet over its area, beside the published one."""
    mass = format_quantity(bill.mass_per_area, "kg/m^2", 3)
    if bill.band is None:
        return f"{mass} (none is published for this density)"
    return f"{mass} (published: {format_number(bill.band.least, 3)} to {format_number(bill.band.most, 3)})"


def to_buy_in_words(charted: ChartResult) -> str:
    """Mass to buy with its reserve, its price, and the dye lots of the yarn of most knots."""
    bill, plan = charted.bill, charted.order.order.plan
    to_buy = format_quantity(sum(need.to_buy for need in bill.needs), "kg", 3)
    price = "" if bill.price is None else f", {bill.price:,.2f} {bill.currency}"
    lots = f"{bill.field.lots} dye lots" if bill.field.lots > 1 else "one dye lot"
    reserve = format_quantity(plan.reserve, "%", 3)
    return f"{to_buy} with a reserve of {reserve}{price}; {bill.field.name}: {lots}"


def show_yarn(bill: YarnBill) -> None:
    """Print the yarn bill as a table."""
    rows = [
        (need.name, need.use, f"{need.knots:,}" if need.knots else "", _amount(need.length), _amount(need.mass / g),
         _amount(need.to_buy / g), str(need.hanks), "" if need.price is None else f"{need.price:,.2f}")
        for need in bill.needs
    ]  # fmt: skip
    names = ("yarn", "use", "knots", "metres", "grams", "to buy", "hanks", bill.currency)
    show_table(names, rows, right=(2, 3, 4, 5, 6, 7))


def _amount(value: float) -> str:
    """A whole number, or one decimal below 10."""
    return f"{value:,.{0 if value >= 10 else 1}f}"
