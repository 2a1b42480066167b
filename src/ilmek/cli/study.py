"""`ilmek study`: sweeps, sensitivities, tolerances and optima of a machine or a mechanism."""

from collections.abc import Mapping
from pathlib import Path

import click

from ilmek.cli.call_outputs import call_outputs
from ilmek.cli.options import file_option, force_option, json_option, text_option
from ilmek.cli.report import show_report
from ilmek.cli.settings import read_settings
from ilmek.cli.terminal import note, say
from ilmek.cli.verdict import exit_code, note_verdict
from ilmek.errors import OutputError, ParameterError
from ilmek.io.table_csv import csv_text
from ilmek.io.table_parquet import parquet_bytes
from ilmek.jobs.study.order import METHODS, StudyOrder, read_costs, read_yield, study_file
from ilmek.jobs.study.report import study_report
from ilmek.jobs.study.run import study
from ilmek.studies.samples import SAMPLINGS
from ilmek.units import parse_quantity

EXAMPLES = """\b
Examples:
  ilmek study beat-up --vary swing=20deg..40deg --vary speed=10..20rad/s --goal drive_torque_max
  ilmek study beat-up --vary swing=20deg..40deg --vary beta=30deg..70deg --method sobol --record drive_torque_max
  ilmek study beat-up --vary swing=30deg+-0.2deg --method tolerance --record drive_torque_max
  ilmek study press.toml --vary "r=30mm+-0.1mm" --vary "l=140mm+-0.2mm" --method tolerance --yield 99% --cost r=2 \\
      --hold "drive_torque_rms <= 8.2N*m"
  ilmek study crane.toml --vary l2=80mm..120mm --goal drive_torque_rms --hold "transmission_angle_min >= 40deg"
  ilmek study beat-up --vary swing=20deg..40deg --vary beta=30deg..70deg --method optimum \\
      --goal drive_torque_max --goal "most beater_stroke" --out front.sqlite --report front.html
  ilmek study front.toml --out front.sqlite --resume --workers 2

What varies: NAME=FROM..TO, NAME=A,B,C, a tolerance NAME=80mm+-0.05mm, or a class NAME=20mm H7 (a distribution may
follow: uniform, normal, triangular).
"""


@click.command(epilog=EXAMPLES)
@click.argument("target", metavar="MACHINE|FILE.toml")
@click.option(
    "--vary", multiple=True, metavar="NAME=RANGE", help="Vary a parameter, or an entry of [values] of a file."
)
@text_option("--designs", "FILE.csv", "Take the designs of a table instead of ranges: a column a parameter.")
@click.option("--set", "settings", multiple=True, metavar="NAME=VALUE", help="Set a parameter that does not vary.")
@click.option("--goal", "goals", multiple=True, metavar="[most] RESULT", help="A result to make least, or most.")
@click.option("--hold", "holds", multiple=True, metavar="'RESULT >= VALUE'", help="A limit, beside the checks.")
@click.option("--record", "recorded", multiple=True, metavar="RESULT", help="A further result to keep of each design.")
@click.option("--method", type=click.Choice(METHODS), default="sweep", show_default=True, help="What is done.")
@click.option(
    "--sampling", type=click.Choice(SAMPLINGS), default="sobol", show_default=True, help="Designs of a sweep."
)
@click.option("--samples", type=click.IntRange(1), metavar="N", help="Number of designs; default: by the method.")
@click.option("--seed", type=click.IntRange(0), default=0, show_default=True, help="Seed of all random numbers.")
@click.option("--over", default="", metavar="FROM..TO", help="Range of a mechanism's driving input.")
@click.option("--speed", default="", metavar="SPEED", help="Its speed.")
@click.option("--correlate", multiple=True, metavar="'A, B = R'", help="Correlation of two tolerances.")
@click.option(
    "--yield", "yield_target", default="", metavar="SHARE", help="Find the tolerances of least cost for a yield."
)
@click.option("--cost", "costs", multiple=True, metavar="NAME=COST", help="Cost of a present tolerance; default 1.")
@click.option("--workers", type=click.IntRange(1), default=1, show_default=True, help="Processes.")
@text_option("--cluster", "ADDRESS", "Evaluate on a Dask cluster (extra cluster), like tcp://host:8786.")
@text_option("--time-limit", "TIME", "Longest time of a design, like 30s; a longer one is a row with that reason.")
@file_option(
    "--out", "FILE.sqlite", "Keep all designs in a results file (SQLite), also of a study that is interrupted."
)
@click.option("--resume", is_flag=True, help="Go on with the results file of --out.")
@file_option("--csv", "FILE.csv", "Write the designs as a table, SI and radians.", "csv_to")
@click.option("--parquet", type=click.Path(path_type=Path), metavar="FILE", help="The same as Parquet (extra parquet).")
@click.option("--report", "page_to", type=click.Path(path_type=Path), metavar="FILE.html", help="Write a report page.")
@force_option
@json_option
def command(
    *,
    target: str,
    vary: tuple[str, ...],
    settings: tuple[str, ...],
    time_limit: str | None,
    workers: int,
    cluster: str | None,
    out: Path | None,
    resume: bool,
    csv_to: Path | None,
    parquet: Path | None,
    page_to: Path | None,
    force: bool,
    json_to: str | None,
    **words: object,
) -> int:
    """Study TARGET: a machine, a machine file, a mechanism file, or a study file with the same words as these options.

    Every check of a design is a constraint. Ends with 3 where no design holds.
    """
    order = _order(target, read_settings(vary), read_settings(settings), time_limit, words)
    _require_file(out, resume, force)
    with call_outputs(
        {"--json": json_to, "--report": page_to, "--csv": csv_to, "--parquet": parquet}, force=force
    ) as call:
        found = study(order, out, replace=not resume, workers=workers, cluster=cluster, progress=call.progress)
        report = study_report(found)
        call.give_page("--report", report)
        call.give("--csv", lambda: csv_text(found.table(), call.progress.part(0.0, 1.0, "table")))
        call.give("--parquet", lambda: parquet_bytes(found.table()))
        call.give_json(report.as_json)
    if call.quiet:
        note_verdict(report.all_checks)
    else:
        show_report(report)
        call.show_files({"--report": "report", "--csv": "table", "--parquet": "table"})
        if out is not None:
            say(f"results: {out}")
    for warning in report.warnings:
        note(warning)
    return exit_code(report.all_checks)


def _order(
    target: str, vary: Mapping[str, str], settings: Mapping[str, str], limit: str | None, words: Mapping[str, object]
) -> StudyOrder:
    """The order of options, over that of a study file."""
    file = study_file(Path(target)) if Path(target).suffix.lower() in (".toml", ".json") else None
    data = {} if file is None else file
    context = click.get_current_context()
    given = {
        name: value
        for name, value in words.items()
        if context.get_parameter_source(name) is not click.core.ParameterSource.DEFAULT
    }
    named = {"goals": "goals", "holds": "hold", "recorded": "record", "yield_target": "yield", "costs": "cost"}
    usual = {name: data[key] for name, key in named.items() if key in data}
    stated = {**words, **usual, **{key: data[key] for key in words.keys() & data.keys()}, **given}
    return StudyOrder(
        data.get("target", target),
        {**data.get("set", {}), **settings},
        {**data.get("vary", {}), **vary},
        tuple(stated["goals"]),
        tuple(stated["holds"]),
        tuple(stated["recorded"]),
        method=stated["method"],
        sampling=stated["sampling"],
        samples=stated["samples"],
        seed=stated["seed"],
        time_limit=0.0 if limit is None else parse_quantity(limit, "s"),
        over=stated["over"],
        speed=stated["speed"],
        correlate=tuple(stated["correlate"]),
        yield_target=read_yield(stated["yield_target"]) if stated["yield_target"] else 0.0,
        costs=read_costs(stated["costs"]),
        designs=stated["designs"] or "",
    )


def _require_file(out: Path | None, resume: bool, force: bool) -> None:
    """Raise an error where a results file stands in the way, or there is none to go on with."""
    if resume and out is None:
        raise ParameterError("--resume without a results file", do="name it with --out FILE.sqlite")
    if out is None:
        return
    if resume and not out.is_file():
        raise ParameterError(f"--resume: there is no results file {out}", do="leave out --resume to begin one")
    if out.exists() and not resume and not force:
        raise OutputError(f"results file {out} exists", do="go on with --resume, or replace it with --force")
    if not out.parent.is_dir():
        raise OutputError(f"--out {out}: there is no folder {out.parent}", do="make it first")
