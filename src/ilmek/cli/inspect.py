"""`ilmek inspect`: show a loom programme, or the draft of a weaving program."""

from pathlib import Path

import click

from ilmek.cli.call_outputs import call_outputs
from ilmek.cli.options import force_option, json_option
from ilmek.cli.terminal import say, show_pairs, show_table
from ilmek.errors import ParameterError
from ilmek.io.draft_file import is_draft, read_draft
from ilmek.jobs.inspect import InspectionResult, inspect_programme, runs
from ilmek.loom.account import stop_duration
from ilmek.loom.operations import LoomSetup, Stop
from ilmek.units import format_quantity
from ilmek.weaving.draft import Draft

MOST_RUNS = 4000
"""Largest number of runs of a row that are printed; a table of more takes seconds, and nobody reads it."""

MOST_STOPS = 20
"""Largest number of stops that are printed."""

EXAMPLES = """\b
Examples:
  ilmek inspect carpet/programme.ilmek
  ilmek inspect carpet/programme.ilmek --row 1
  ilmek inspect carpet/programme.ilmek --row 1 --json -
  ilmek inspect carpet/chart.wif

Limits: file 1,000 MB; WIF: 10 MB, 5,000 warps or picks, 1,000 shafts or treadles.
"""


@click.command(epilog=EXAMPLES)
@click.argument("file", type=click.Path(path_type=Path), metavar="FILE")
@click.option(
    "--row",
    "number",
    type=int,
    metavar="N",
    help="Row to show, counted from 1 at the bottom edge; default: a random row.",
)
@force_option
@json_option
def command(file: Path, number: int | None, force: bool, json_to: str | None) -> None:
    """Show the carpet, colours and statistics of a loom programme, FILE.ilmek, and one row as the heads tie it.

    Rows are counted from 1 at the bottom, knots from 1 at the left, as on the printed chart. Of FILE.wif, the draft of
    a weaving program, threads, shafts, weave, floats and colours are shown.
    """
    with call_outputs({"--json": json_to}, force=force, inputs={"FILE": file}) as call:
        if is_draft(file):
            if number is not None:
                raise ParameterError("--row of a WIF file", allowed="a programme", do="leave it out")
            draft = read_draft(file)
            call.give_json(draft.as_json)
            if not call.quiet:
                show_draft(draft)
            return
        inspection_result = inspect_programme(file, number, progress=call.progress)
        call.give_json(inspection_result.as_json)
    if not call.quiet:
        show_programme(inspection_result)
        show_row(inspection_result)


def show_draft(draft: Draft) -> None:
    """Print threads, shafts, spacing, weave and colours of a draft."""
    picks, warps = draft.up.shape
    floats = f"longest float {draft.warp_float} picks in the warp, {draft.weft_float} warps in the weft"
    by = f"{draft.treadles} treadles" if draft.treadles else "a lift plan"
    pitches = {"warp pitch": draft.warp_pitch, "weft pitch": draft.weft_pitch}
    show_pairs(
        [
            ("threads", f"{warps:,} warps, {picks:,} picks"),
            ("loom", f"{draft.shafts} shafts, {by}"),
            *((name, format_quantity(pitch, "mm")) for name, pitch in pitches.items() if pitch is not None),
            ("weave", "plain weave" if draft.is_plain else floats),
        ]
    )
    lines = [(name, f"{of_warp:,}", f"{of_weft:,}") for name, of_warp, of_weft in draft.colours]
    show_table(("colour", "warps", "picks"), lines, right=(1, 2))


def show_programme(found: InspectionResult) -> None:
    """Print size, weaving time, yarns and heads of the whole carpet."""
    setup, totals, work = found.programme.setup, found.programme.totals, found.programme.work
    with_heads = "1 head" if setup.heads == 1 else f"{setup.heads} heads"
    show_pairs(
        [
            ("carpet", f"{setup.size}, {setup.quality}, {setup.knot} knot"),
            ("rows", f"{setup.rows:,} of {setup.columns:,} knots, {totals.knots:,} in all"),
            ("loom", f"{with_heads} of {setup.tubes} tubes, warp pitch {format_quantity(setup.warp_pitch, 'mm')}"),
            ("weaving time", f"{format_quantity(totals.duration, 'h')}"),
            ("colour changes", f"{totals.changes:,}, {totals.changes_per_knot:.3f} per knot"),
            ("stops", stops_in_words(found)),
        ]
    )
    bobbins = [
        (weft.yarn, f"{weft.rows:,}", f"{weft.changes(setup.rows):,}", format_quantity(weft.time, "s"))
        for weft in setup.wefts
    ]
    if bobbins:
        show_table(("bobbin", "rows", "changes", "time of one"), bobbins, right=(1, 2, 3))
    counted = [
        (yarn.name, yarn.hex, f"{count:,}", f"{count / totals.knots:.1%}")
        for yarn, count in zip(setup.yarns, totals.counts, strict=True)
        if count
    ]
    show_table(("yarn", "colour", "knots", "share"), counted, right=(2, 3))
    heads = [
        (str(head + 1), f"{knots:,}", f"{changes:,}", format_quantity(busy, "h"))
        for head, (knots, changes, busy) in enumerate(zip(work.knots, work.changes, work.busy, strict=True))
    ]
    show_table(("head", "knots", "colour changes", "busy"), heads, right=(0, 1, 2, 3))


def stops_in_words(found: InspectionResult) -> str:
    """What is changed in stops of the loom, and the rows before or in which, from 1 at the bottom, up to MOST_STOPS."""
    stops, setup = found.stops, found.programme.setup
    if not stops:
        return "none: no bobbin of weft and no package of pile yarn is changed"
    rows = ", ".join(str(row + 1) for row in dict.fromkeys(stop.row for stop in stops[:MOST_STOPS]))
    more = f", … {len(stops) - MOST_STOPS:,} more: see --json" if len(stops) > MOST_STOPS else ""
    spent = sum(stop_duration(stop, setup.wefts, setup.times.tube_change) for stop in stops)
    wefts, tubes = sum(len(stop.wefts) for stop in stops), sum(len(stop.tubes) for stop in stops)
    named = ((wefts, "bobbin", "of weft"), (tubes, "package", "of pile yarn"))
    changed = " and ".join(f"{many:,} {one}{'' if many == 1 else 's'} {of}" for many, one, of in named if many)
    return f"{len(stops):,}, {format_quantity(spent, 'min', 3)} in all, to change {changed}; rows {rows}{more}"


def show_row(found: InspectionResult) -> None:
    """Print one row: for each head its runs of knots in the order of tying, up to MOST_RUNS of all heads."""
    setup = found.programme.setup
    names = [yarn.name for yarn in setup.yarns]
    say(
        f"row {found.row.number + 1} of {setup.rows}, from the bottom: {format_quantity(found.time, 's')}, "
        f"woven to the {'right' if found.forward else 'left'}; knots from the left, in the order of tying"
    )
    for stop in found.row.stops:
        say(f"before its phase {stop.phase + 1} of {found.row.phases}: {_changed(stop, setup)}")
    lines, most = [], max(1, MOST_RUNS // setup.heads)
    for head, ties in enumerate(found.ties, 1):
        tied = runs(ties)
        shown = [f"{a}–{b} {names[y]}" if a != b else f"{a} {names[y]}" for a, b, y in tied[:most]]
        if len(tied) > most:
            shown.append(f"… {len(tied) - most:,} more: see --json")
        lines.append((str(head), "  ".join(shown)))
    show_table(("head", "ties"), lines, right=(0,))


def _changed(stop: Stop, setup: LoomSetup) -> str:
    """The changes of a stop, up to MOST_STOPS."""
    wefts = [f"a new bobbin of {setup.wefts[index].yarn}" for index in stop.wefts]
    tubes = [f"{setup.yarns[tube.yarn].name} on tube {tube.tube + 1} of head {tube.head + 1}" for tube in stop.tubes]
    changes = [*wefts, *tubes]
    more = [f"… {len(changes) - MOST_STOPS:,} more: see --json"] if len(changes) > MOST_STOPS else []
    return ", ".join([*changes[:MOST_STOPS], *more])
