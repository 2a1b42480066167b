"""`ilmek weave --technique gun|tufting|kilim`: the carpet by a tufting gun or a tufting machine, or as a kilim."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ilmek.cli.call_outputs import call_outputs
from ilmek.cli.carpet_options import carpet_inputs
from ilmek.cli.settings import read_settings, setting_files
from ilmek.cli.terminal import note, show_pairs
from ilmek.cli.verdict import exit_code, note_verdict, show_verdict
from ilmek.errors import ParameterError
from ilmek.jobs.gun import GunResult, gun_json, read_gun_order, weave_by_gun
from ilmek.jobs.kilim import KilimResult, kilim_json, read_kilim_order, weave_kilim
from ilmek.jobs.order import CarpetOrder
from ilmek.jobs.output_folder import free_folder
from ilmek.jobs.tufting import TuftingResult, read_tufting_order, tufting_json, weave_by_tufting
from ilmek.report.results import result_text
from ilmek.units import format_quantity

KNOTTED, GUN, TUFTING, KILIM = TECHNIQUES = ("knotted", "gun", "tufting", "kilim")

_OF_A_LOOM = {
    KILIM: "a kilim is woven by hand: a loom would need a bobbin for each run of a row, and a shed for each of them",
}
"""Why a technique has no options of a loom, where that is said."""


@dataclass(frozen=True, slots=True, eq=False)
class TuftingTechnique:
    """A technique: its order from texts, its job, and what is printed of the result."""

    read: Callable[..., Any]
    weave: Callable[..., Any]
    as_json: Callable[[Any], Any]
    pairs: Callable[[Any], list[tuple[str, str]]]


def require_technique(technique: str, settings: Mapping[str, Sequence[str]], of_the_loom: Mapping[str, object]) -> None:
    """Raise ParameterError for settings of another technique, and beside a tufted carpet for options of the loom."""
    for name, given in settings.items():
        if given and name != technique:
            do = f"add --technique {name}, or leave --{name} out"
            raise ParameterError(f"--{name} without --technique {name}", do=do)
    names = ", ".join(name for name, value in of_the_loom.items() if value)
    if names and technique != KNOTTED:
        allowed = _OF_A_LOOM.get(technique, "options of a loom are for knotted carpets")
        raise ParameterError(f"{names} with --technique {technique}", allowed=allowed, do="leave it out")


def weave_tufted(
    technique: str,
    order: CarpetOrder,
    settings: Sequence[str],
    deadline: str | None,
    out: Path | None,
    *,
    force: bool,
    json_to: str | None,
) -> int:
    """Plan the carpet, write its files and print the summary; returns the exit code."""
    by = TUFTED[technique]
    machine = by.read(order, read_settings(settings), deadline)
    folder = out or free_folder(order.picture, technique)
    files = {**carpet_inputs(order), **setting_files(settings)}
    with call_outputs({"--json": json_to}, force=force, inputs=files) as call:
        made = by.weave(order, machine, folder, outputs=call.outputs, force=force, progress=call.progress)
        call.give_json(lambda: by.as_json(made))
    if call.quiet:
        note_verdict(made.checks)
    else:
        show_verdict(made.checks)
        show_pairs([*by.pairs(made), ("report", made.files[0])])
    for remark in made.notes:
        note(remark)
    return exit_code(made.checks)


def gun_pairs(made: GunResult) -> list[tuple[str, str]]:
    """The carpet, its rows and travel beside their bounds, yarn, time and cost, one line each."""
    values = {result.name: result_text(result.value, result.unit) for result in made.results}
    plan = made.tufted.plan
    size = " x ".join(format_quantity(side, "cm") for side in (plan.width, plan.length))
    return [
        ("carpet", f"{size}, rows of {format_quantity(plan.spacing, 'mm')}, {len(plan.colours)} colours"),
        ("rows", f"{values['row_length']} (at least {values['row_bound']}), {values['strokes']} strokes"),
        ("travel", f"{values['travel']} (at least {values['travel_bound']})"),
        ("covered", f"{values['covered']} of the carpet, at least {values['coverage']} of each region"),
        ("yarn", f"{values['gun_yarn']}, {values['gun_yarn_mass']}"),
        ("time", values["tufting_time"]),
        ("cost", _price(made.tufted.gun_cost["sum"])),
    ]


def tufting_pairs(made: TuftingResult) -> list[tuple[str, str]]:
    """The carpet, machine, yarn, time, and the cost beside that of the knotted carpet, one line each."""
    values = {result.name: result_text(result.value, result.unit) for result in made.results}
    tufted = made.tufted
    programme, grid, cost = tufted.programme, tufted.programme.grid, tufted.tufting_cost
    size = " x ".join(
        format_quantity(side, "cm") for side in (programme.columns * grid.gauge, programme.rows * grid.stitch)
    )
    pattern = tufted.machine.params.pattern
    return [
        ("carpet", f"{size}, {programme.columns} x {programme.rows} tufts, {len(tufted.cones)} colours"),
        ("machine", f"{programme.threads.size} needles, {pattern.attachment}, selected by {pattern.selection}"),
        ("strokes", f"{values['needle_strokes']}, {values['loops']} loops, {values['misplaced']} tufts off colour"),
        ("yarn", f"{values['tufted_yarn']}, {values['tufted_yarn_mass']}, {values['tufted_mass_per_area']}"),
        ("time", f"{values['tufting_time']}, {values['tufting_production']}"),
        ("cost", f"{_price(cost['sum'])}; knotted on a loom {_price(cost['knotted'])}"),
    ]


def _price(cost: float | None) -> str:
    return "not known" if cost is None else f"{cost:,.2f} EUR"


def kilim_pairs(made: KilimResult) -> list[tuple[str, str]]:
    """The carpet, its slits and bobbins, weft, time and cost, one line each."""
    values = {result.name: result_text(result.value, result.unit) for result in made.results}
    cloth = made.cloth
    return [
        ("carpet", f"{cloth.in_words}; {cloth.chart.rows} rows of {cloth.chart.columns} cells"),
        ("slits", f"longest {values['slit_length']}, {values['slits_joined']} too long, {values['joins_woven']} joins"),
        ("bobbins", f"{values['mean_bobbins']} a row, at most {values['bobbins_per_row']}"),
        ("weft", f"{values['weft_length']}, {values['weft_mass']}; warp {values['warp_mass']}; {values['cloth_mass']}"),
        ("time", values["kilim_time"]),
        ("cost", _price(cloth.kilim_cost["sum"])),
    ]


TUFTED = {
    GUN: TuftingTechnique(read_gun_order, weave_by_gun, gun_json, gun_pairs),
    TUFTING: TuftingTechnique(read_tufting_order, weave_by_tufting, tufting_json, tufting_pairs),
    KILIM: TuftingTechnique(read_kilim_order, weave_kilim, kilim_json, kilim_pairs),
}
