"""`ilmek weave`: from a picture to chart, yarn, loom and programme."""

from pathlib import Path
from typing import Any

import click

from ilmek.cli.call_outputs import call_outputs
from ilmek.cli.carpet_options import carpet_inputs, carpet_options, recipe_folder
from ilmek.cli.carpet_summary import carpet_pairs
from ilmek.cli.loom_summary import loom_pairs
from ilmek.cli.options import force_option, json_option, rates_option, text_option
from ilmek.cli.proposed import show_proposed
from ilmek.cli.settings import loom_settings, read_settings, setting_files
from ilmek.cli.terminal import note, show_pairs
from ilmek.cli.tufted_summary import GUN, KILIM, KNOTTED, TECHNIQUES, TUFTING, require_technique, weave_tufted
from ilmek.cli.verdict import WEAVES, exit_code, note_verdict, show_verdict
from ilmek.io.rates_file import read_rates
from ilmek.jobs.loom import read_loom_order
from ilmek.jobs.order import read_order
from ilmek.jobs.output_folder import free_folder
from ilmek.jobs.recipe import saved_recipe
from ilmek.jobs.weave import WeaveResult, weave, weave_json
from ilmek.machines.automated_loom.params import AIMS

EXAMPLES = """\b
Examples:
  ilmek weave photo.jpg
  ilmek weave photo-chart/chart.png
  ilmek weave photo.jpg --size 120x180cm --quality 40x40/dm --yarns wool.toml --knot symmetric --deadline 72h
  ilmek weave photo.jpg --size kelle --colours 8 --heads 6 --out carpet --force
  ilmek weave photo.jpg --loom beat=comb --loom shedding.law=modified-sine --loom prices=@prices.txt
  ilmek weave photo.jpg --loom knotting=hand
  ilmek weave photo.jpg --colours 24 --heads 4 --loom tubes=12 --loom package_mass=1kg
  ilmek weave carpet.toml --deadline 72h
  ilmek weave other.jpg --size 80x120cm --loom carpet/machine.json
  ilmek weave photo.jpg --size 100x150cm --colours 8 --technique gun --gun row_spacing=4mm
  ilmek weave photo.jpg --size 200x300cm --colours 5 --technique tufting --tufting pile_height=8mm

Limits: picture file 500 MB, 150,000,000 pixels; 255 yarns; 200,000,000 knots; 1,000 heads.
"""


@click.command(epilog=EXAMPLES)
@carpet_options
@click.option(
    "--heads", type=int, metavar="N", help="Number of knotting heads; default: chosen by --aim and --deadline."
)
@click.option("--deadline", metavar="TIME", help="Weave the carpet in this time, like 72h, with the fewest heads.")
@click.option(
    "--aim",
    type=click.Choice(AIMS),
    help="Choose what is left open for least cost of a carpet, price of the loom, or weaving time; default: cost.",
)
@text_option("--warp-pitch", "LENGTH", "Distance between the warps of your loom; default: that of the quality.")
@click.option(
    "--loom",
    "settings",
    multiple=True,
    metavar="NAME=VALUE|FILE",
    help="Set a parameter of the loom or its machines: beat=comb, shedding.law=modified-sine; @FILE reads a file. "
    "FILE alone: weave on that loom, written by design automated-loom --json or by weave as machine.json.",
)
@click.option(
    "--technique",
    type=click.Choice(TECHNIQUES),
    default=KNOTTED,
    help="knotted on a loom, tufted by a gun on a gantry or by a tufting machine, or a kilim woven by hand; "
    "default: knotted.",
)
@click.option(
    "--gun",
    "gun_settings",
    multiple=True,
    metavar="NAME=VALUE",
    help="Set a parameter of the tufting gun or its gantry: row_spacing=4mm, cones=8, room_width=3m.",
)
@click.option(
    "--tufting",
    "tufting_settings",
    multiple=True,
    metavar="NAME=VALUE",
    help="Set a parameter of the tufting machine: gauge=4mm, stitch_rate=30/dm, pattern.selection=needles.",
)
@click.option(
    "--kilim",
    "kilim_settings",
    multiple=True,
    metavar="NAME=VALUE",
    help="Set a parameter of the kilim: warps=50/dm, picks=200/dm, join=slit|dovetail|interlock, longest_slit=15mm.",
)
@rates_option
@force_option
@json_option
def command(
    *,
    out: Path | None,
    heads: int | None,
    deadline: str | None,
    aim: str | None,
    warp_pitch: str | None,
    settings: tuple[str, ...],
    technique: str,
    gun_settings: tuple[str, ...],
    tufting_settings: tuple[str, ...],
    kilim_settings: tuple[str, ...],
    rates: Path | None,
    force: bool,
    json_to: str | None,
    save_recipe: str | None,
    **carpet: Any,
) -> int:
    """Turn PICTURE into all that is needed to weave it: knot chart, yarn bill, loom, programme, report.

    A RECIPE, .toml, stands for picture and options; options given beside it override its keys.

    The output folder contains report.html (the carpet), loom.html, report.json, carpet.png, chart.png, chart.pdf (see
    --pdf), rows.txt, rows.pdf, yarn.csv, programme.ilmek and machine.json. Where the loom cannot weave the carpet, the
    report has the reasons and what would cure them, there is no programme, and the command ends with 3. A loom for
    weavers, --loom knotting=hand, has no programme: its weavers tie by the chart and its rows.

    --technique gun tufts the carpet instead: the folder contains report.html with the path in motion, report.json, and
    gun.ngc, the G-code of the gun, where every check holds. --technique tufting designs a tufting machine for it:
    report.html with the cost beside the knotted carpet, report.json, carpet.png as the twin tufts it, and tufting.txt,
    the yarn of each needle stroke by stroke, where every check holds. --technique kilim weaves it by hand of wefts that
    turn back at their colours: report.html, report.json, carpet.png, chart.png, chart.pdf with slits and joins, and
    rows.txt.
    """
    order = read_order(**carpet)
    of_tufts = {GUN: gun_settings, TUFTING: tufting_settings, KILIM: kilim_settings}
    beside = {"--heads": heads, "--aim": aim, "--warp-pitch": warp_pitch, "--loom": settings, "--rates": rates}
    require_technique(technique, of_tufts, {**beside, "--save-recipe": save_recipe})
    if technique != KNOTTED:
        return weave_tufted(technique, order, of_tufts[technique], deadline, out, force=force, json_to=json_to)
    loom_file, settings = loom_settings(settings)
    loom_order = read_loom_order(
        order,
        heads=heads,
        deadline=deadline,
        aim=aim,
        warp_pitch=warp_pitch,
        loom={**read_rates(rates), **read_settings(settings)},
        loom_file=loom_file,
    )
    folder = out or free_folder(order.picture, "carpet")
    inputs = {**carpet_inputs(order), "--loom": loom_order.given.loom_file, "--rates": rates, **setting_files(settings)}
    with call_outputs({"--json": json_to, "--save-recipe": save_recipe}, force=force, inputs=inputs) as call:
        woven = weave(order, loom_order, folder, outputs=call.outputs, progress=call.progress)
        call.give_json(lambda: weave_json(woven))
        made, base = woven.charted, recipe_folder(save_recipe)
        call.give("--save-recipe", lambda: saved_recipe(made.order, made.chart, base, loom_order.given))
    if not call.quiet:
        show_woven(woven)
    else:
        note_verdict(woven.checks, WEAVES)
    for remark in (*woven.charted.notes, *woven.warnings):
        note(remark)
    return exit_code(woven.checks)


def show_woven(woven: WeaveResult) -> None:
    """Print the verdict with its reasons, a summary of the job, the loom's choices, and the path of the report."""
    checks = woven.checks
    failed = sum(not check.ok for check in checks)
    show_verdict(checks, WEAVES, woven.loom.nearest)
    show_pairs(
        [
            *carpet_pairs(woven.charted),
            *loom_pairs(woven),
            ("checks", f"{len(checks) - failed} passed, {failed} failed"),
            ("report", woven.files[0]),
        ]
    )
    show_proposed(woven.charted.chart)
