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
from ilmek.report.results import Result, result_text
from ilmek.sentences import Sentence
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
    values = _texts(made.results)
    plan = made.tufted.plan
    size, spacing = _size(plan.width, plan.length), format_quantity(plan.spacing, "mm")
    return [
        ("carpet", Sentence("tufted.gun-carpet", size=size, spacing=spacing, colours=len(plan.colours))),
        ("rows", Sentence("tufted.gun-rows", **values)),
        ("travel", Sentence("tufted.gun-travel", **values)),
        ("covered", Sentence("tufted.gun-covered", **values)),
        ("yarn", Sentence("tufted.gun-yarn", **values)),
        ("time", values["tufting_time"]),
        ("cost", _price(made.tufted.gun_cost["sum"])),
    ]


def tufting_pairs(made: TuftingResult) -> list[tuple[str, str]]:
    """The carpet, machine, yarn, time, and the cost beside that of the knotted carpet, one line each."""
    values, tufted = _texts(made.results), made.tufted
    programme, grid, cost = tufted.programme, tufted.programme.grid, tufted.tufting_cost
    size = _size(programme.columns * grid.gauge, programme.rows * grid.stitch)
    cells, pattern = f"{programme.columns} x {programme.rows}", tufted.machine.params.pattern
    fed = {"needles": programme.threads.size, "attachment": pattern.attachment, "selection": pattern.selection}
    knotted = Sentence("tufted.cost", cost=_price(cost["sum"]), knotted=_price(cost["knotted"]))
    return [
        ("carpet", Sentence("tufted.carpet", size=size, cells=cells, colours=len(tufted.cones))),
        ("machine", Sentence("tufted.machine", **fed)),
        ("strokes", Sentence("tufted.strokes", **values)),
        ("yarn", Sentence("tufted.yarn", **values)),
        ("time", Sentence("tufted.time", **values)),
        ("cost", knotted),
    ]


def _texts(results: Sequence[Result]) -> dict[str, str]:
    return {result.name: result_text(result.value, result.unit) for result in results}


def _size(*sides: float) -> str:
    return " x ".join(format_quantity(side, "cm") for side in sides)


def _price(cost: float | None) -> str:
    return Sentence("tufted.no-price") if cost is None else f"{cost:,.2f} EUR"


def kilim_pairs(made: KilimResult) -> list[tuple[str, str]]:
    """The carpet, its slits and bobbins, weft, time and cost, one line each."""
    values, cloth = _texts(made.results), made.cloth
    grid = {"rows": cloth.chart.rows, "columns": cloth.chart.columns}
    return [
        ("carpet", Sentence("tufted.kilim-carpet", size=cloth.in_words, **grid)),
        ("slits", Sentence("tufted.kilim-slits", **values)),
        ("bobbins", Sentence("tufted.kilim-bobbins", **values)),
        ("weft", Sentence("tufted.kilim-weft", **values)),
        ("time", values["kilim_time"]),
        ("cost", _price(cloth.kilim_cost["sum"])),
    ]


TUFTED = {
    GUN: TuftingTechnique(read_gun_order, weave_by_gun, gun_json, gun_pairs),
    TUFTING: TuftingTechnique(read_tufting_order, weave_by_tufting, tufting_json, tufting_pairs),
    KILIM: TuftingTechnique(read_kilim_order, weave_kilim, kilim_json, kilim_pairs),
}
