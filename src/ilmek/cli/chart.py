"""`ilmek chart`: the knot chart and the yarn bill alone."""

from pathlib import Path
from typing import Any

import click

from ilmek.cli.call_outputs import call_outputs
from ilmek.cli.carpet_options import carpet_inputs, carpet_options, recipe_folder
from ilmek.cli.carpet_summary import carpet_pairs, pile_in_words, show_yarn
from ilmek.cli.options import force_option, json_option
from ilmek.cli.proposed import show_proposed
from ilmek.cli.terminal import note, say, show_pairs
from ilmek.cli.verdict import exit_code, note_verdict, show_verdict
from ilmek.jobs.chart import ChartResult, chart_json, chart_order
from ilmek.jobs.order import read_order
from ilmek.jobs.output_folder import free_folder
from ilmek.jobs.recipe import saved_recipe

EXAMPLES = """\b
Examples:
  ilmek chart photo.jpg --size 120x180cm --quality 40x40/dm --out photo-chart
  ilmek chart photo.jpg --size kelle --colours 8 --yarns wool.toml
  ilmek chart design.bmp --quality 40x40/dm
  ilmek chart chart.png --yarns wool.toml --oxs --bmp
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

    The output folder contains report.html, chart.png (one pixel per knot), chart.pdf (printed chart; see --pdf),
    carpet.png (the simulated carpet), rows.txt and rows.pdf, yarn.csv and chart.json. With --json and without --out no
    folder is made. Ends with 3 where a check fails: the pile does not fit the ground.
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
    """Print the verdict, a summary of a chart, and its yarn bill."""
    chart = charted.chart
    show_verdict(charted.checks)
    show_pairs(
        [
            *carpet_pairs(charted),
            ("pile", pile_in_words(charted)),
            ("colour changes", f"{chart.changes_per_knot:.3f} per knot, {chart.lone_fraction:.2%} of the knots lone"),
        ]
    )
    show_yarn(charted.bill)
    show_proposed(chart)
