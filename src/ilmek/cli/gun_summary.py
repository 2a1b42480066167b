"""`ilmek weave --technique gun`: the carpet by a tufting gun."""

from collections.abc import Mapping
from pathlib import Path

from ilmek.cli.call_outputs import call_outputs
from ilmek.cli.terminal import note, show_pairs
from ilmek.cli.verdict import exit_code, note_verdict, show_verdict
from ilmek.errors import ParameterError
from ilmek.jobs.gun import GunOrder, GunResult, gun_json, weave_by_gun
from ilmek.jobs.order import CarpetOrder
from ilmek.jobs.output_folder import free_folder
from ilmek.report.results import result_text
from ilmek.units import format_quantity

TECHNIQUES = ("knotted", "gun")
GUN = "gun"

TUFTS = "tufts"
"""The headline of a carpet by the gun."""


def require_no_loom(given: Mapping[str, object]) -> None:
    """Raise ParameterError for an option of the loom beside the gun."""
    names = ", ".join(name for name, value in given.items() if value)
    if names:
        raise ParameterError(
            f"{names} with --technique gun", allowed="options of a loom are for knotted carpets", do="leave it out"
        )


def weave_with_gun(
    order: CarpetOrder,
    gun: GunOrder,
    out: Path | None,
    files: Mapping[str, Path | None],
    *,
    force: bool,
    json_to: str | None,
) -> int:
    """Plan the carpet, write its files and print the summary; returns the exit code."""
    folder = out or free_folder(order.picture, "gun")
    with call_outputs({"--json": json_to}, force=force, inputs=files) as call:
        gun_result = weave_by_gun(order, gun, folder, outputs=call.outputs, force=force, progress=call.progress)
        call.give_json(lambda: gun_json(gun_result))
    if call.quiet:
        note_verdict(gun_result.checks)
    else:
        show_verdict(gun_result.checks)
        show_pairs(gun_pairs(gun_result))
    for remark in gun_result.charted.notes:
        note(remark)
    return exit_code(gun_result.checks)


def gun_pairs(made: GunResult) -> list[tuple[str, str]]:
    """The carpet, its rows and travel beside their bounds, yarn, time, cost and the page, one line each."""
    values = {result.name: result_text(result.value, result.unit) for result in made.results}
    plan, cost = made.tufted.plan, made.tufted.gun_cost["sum"]
    size = " x ".join(format_quantity(side, "cm") for side in (plan.width, plan.length))
    total = "not known" if cost is None else f"{cost:,.2f} EUR"
    return [
        ("carpet", f"{size}, rows of {format_quantity(plan.spacing, 'mm')}, {len(plan.colours)} colours"),
        ("rows", f"{values['row_length']} (at least {values['row_bound']}), {values['strokes']} strokes"),
        ("travel", f"{values['travel']} (at least {values['travel_bound']})"),
        ("covered", f"{values['covered']} of the carpet, at least {values['coverage']} of each region"),
        ("yarn", f"{values['gun_yarn']}, {values['gun_yarn_mass']}"),
        ("time", values["tufting_time"]),
        ("cost", total),
        ("report", made.files[0]),
    ]
