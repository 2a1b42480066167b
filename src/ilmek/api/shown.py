"""Pictures, pages and files of the records that `import ilmek` gives; `report.shown` looks this module up."""

import base64
import io
from collections.abc import Callable, Iterator, Mapping
from functools import singledispatch
from html import escape
from pathlib import Path
from typing import TypeAlias

import numpy as np

from ilmek.api.machine_runs import MachineRun
from ilmek.arguments import Arguments
from ilmek.cams.figures import cam_strokes, motion_plots
from ilmek.cams.plate import PlateCam
from ilmek.cams.programme import CamProgramme
from ilmek.carpet.chart import Chart
from ilmek.dynamics.animation import FRAMES, animated
from ilmek.dynamics.forward_run import ForwardRun
from ilmek.dynamics.inverse import Forces
from ilmek.errors import IlmekError, ParameterError
from ilmek.io.csv_cells import csv_rows
from ilmek.io.json_file import json_text
from ilmek.io.output.outputs import Outputs
from ilmek.io.table_csv import csv_text
from ilmek.jobs.weave import WeaveResult
from ilmek.linkage.fourbar import link_lengths
from ilmek.linkage.initial_pose import inputs_in_pose
from ilmek.linkage.judged import JudgedMechanism
from ilmek.linkage.model import Mechanism, Rotation
from ilmek.linkage.motion import Motion, free_points, moving_points
from ilmek.linkage.one_input import one_input
from ilmek.linkage.solve import solve
from ilmek.linkage.structure import plan
from ilmek.report import (
    Animation,
    Axis,
    Check,
    DesignCloud,
    Dot,
    Drawing,
    Figure,
    Gantt,
    Plot,
    Report,
    StackedBars,
    Timing,
)
from ilmek.report.framed import Framed, RecordTable
from ilmek.units import format_quantity
from ilmek.viz.carpet_picture import draw_carpet
from ilmek.viz.page import machine_page
from ilmek.viz.svg import svg

FIGURES = (Plot, Drawing, Animation, Timing, Gantt, StackedBars, DesignCloud)
"""Records that are figures themselves."""

FIRST = 12
"""Number of results that a notebook shows of a report."""

SHOWN_FIGURES = 2
"""Number of figures that a notebook shows of a report."""

Facts: TypeAlias = Mapping[str, str]
"""What stands beside a picture: word -> value."""


@singledispatch
def figure(record: object) -> Figure | None:
    """The picture of a record; None for one that has none."""
    return record if isinstance(record, FIGURES) else None


@figure.register
def _(mechanism: Mechanism) -> Figure | None:
    if len(mechanism.inputs) == 1:
        return figure(JudgedMechanism(one_input(plan(mechanism))))
    return figure(solve(plan(mechanism), inputs_in_pose(mechanism)))


@figure.register
def _(judged: JudgedMechanism) -> Figure:
    values = np.linspace(*judged.inside, FRAMES, endpoint=not judged.turns)
    return _moving(judged.moved.motion(values), values, judged.turns)


@figure.register
def _(motion: Motion) -> Figure | None:
    solved = np.flatnonzero(motion.status == 0)
    if not len(solved):
        return None
    picked = solved[np.linspace(0, len(solved) - 1, max(2, min(FRAMES, len(solved)))).round().astype(int)]
    drives = {name: np.broadcast_to(drive.value, motion.status.shape)[picked] for name, drive in motion.drives.items()}
    return _moving(solve(motion.plan, drives), np.linspace(0.0, 1.0, len(picked)), closes=False)


def _moving(motion: Motion, values: np.ndarray, closes: bool) -> Animation:
    """The mechanism with the paths of its free points, or of all where each is a joint."""
    mechanism = motion.plan.mechanism
    traces = free_points(mechanism) or moving_points(mechanism)
    drawing = Drawing("mechanism", mechanism.name, ())
    turning = isinstance(mechanism.inputs[0], Rotation) if mechanism.inputs else True
    drive = Axis(mechanism.inputs[0].name if mechanism.inputs else "", "deg" if turning else "mm")
    return animated(motion, values, drawing, traces=traces, drive=drive, closes=closes)


@figure.register
def _(forces: Forces) -> Figure:
    efforts = [heading for heading in forces.table() if " drive " in heading]
    return forces.plot(efforts[0])


@figure.register
def _(run: ForwardRun) -> Figure:
    return run.plot("speed")


@figure.register
def _(programme: CamProgramme) -> Figure:
    return motion_plots({"follower": programme}, 1.0)[0]


@figure.register
def _(cam: PlateCam) -> Figure:
    return Drawing("cam", "Plate cam, cam angle 0 to the right", cam_strokes(cam), (Dot(0j, "", "point"),))


@figure.register
def _(run: MachineRun) -> Figure | None:
    return next(iter(run.report.figures), None)


@singledispatch
def facts(_record: object) -> Facts:
    """What a notebook writes beside the picture of a record."""
    return {}


@facts.register
def _(mechanism: Mechanism) -> Facts:
    return facts(JudgedMechanism(one_input(plan(mechanism)))) if len(mechanism.inputs) == 1 else {}


@facts.register
def _(judged: JudgedMechanism) -> Facts:
    unit = "deg" if judged.moved.turns else "mm"
    ranges = "; ".join(" to ".join(format_quantity(end, unit) for end in ends) for ends in judged.ranges)
    shown = {"degrees of freedom": str(judged.degrees_of_freedom)}
    if link_lengths(judged.mechanism) is not None:
        shown["Grashof"] = judged.grashof.kind
    shown["circuits"] = str(len(judged.circuits))
    shown[judged.moved.name] = "a full turn" if judged.turns else ranges
    return shown


@facts.register
def _(report: Report) -> Facts:
    return {
        result.name: format_quantity(result.value, result.unit)
        for result in report.results
        if isinstance(result.value, int | float) and not isinstance(result.value, bool)
    }


@facts.register
def _(run: MachineRun) -> Facts:
    return facts(run.report)


@facts.register
def _(weave: WeaveResult) -> Facts:
    return {"folder": str(weave.folder), **facts(weave.loom)}


def _checks(record: object) -> tuple[Check, ...] | None:
    """The checks that a notebook counts; None of a record without."""
    if isinstance(record, Report):
        return record.all_checks
    return record.report.all_checks if isinstance(record, MachineRun) else getattr(record, "checks", None)


def html(record: object) -> str | None:
    """What a notebook shows of a record; None where there is nothing to show, as of a mechanism that closes nowhere."""
    try:
        picture, words = _picture(record), _words(record)
    except IlmekError:
        return None
    if not words:
        return picture or None
    return f"<figure>{picture}<figcaption>{words}</figcaption></figure>"


def _words(record: object) -> str:
    rows = list(facts(record).items())
    checks = _checks(record)
    verdict = ""
    if checks is not None:
        failed = [check.name for check in checks if not check.ok]
        verdict = f"<p>{len(checks) - len(failed)} of {len(checks)} checks hold{escape(_named(failed))}</p>"
    cells = "".join(f"<tr><td>{escape(word)}</td><td>{escape(value)}</td></tr>" for word, value in rows[:FIRST])
    more = f"<p>and {len(rows) - FIRST} further results: names()</p>" if len(rows) > FIRST else ""
    return verdict + (f"<table>{cells}</table>{more}" if cells else "")


def _named(failed: list[str]) -> str:
    return f"; failed: {', '.join(failed)}" if failed else ""


def _picture(record: object) -> str:
    chart = record.making.chart if isinstance(record, WeaveResult) else record
    if isinstance(chart, Chart):
        carpet = base64.b64encode(_carpet_png(chart)).decode("ascii")
        return f'<img alt="carpet" src="data:image/png;base64,{carpet}">'
    if isinstance(record, Report):
        return "".join(svg(drawn) for drawn in record.figures[:SHOWN_FIGURES])
    drawn = figure(record)
    return svg(drawn) if drawn is not None else ""


def _carpet_png(chart: Chart) -> bytes:
    """The simulated carpet, 480 pixels wide."""
    stream = io.BytesIO()
    draw_carpet(chart, width=480).image.save(stream, format="PNG")
    return stream.getvalue()


def _forms(record: object) -> Iterator[tuple[str, Callable[[], str]]]:
    """Endings of the files that a record can be written to, each with what makes its text."""
    if isinstance(record, Report):
        yield ".html", lambda: machine_page(record)
        yield ".json", lambda: json_text(record.as_json())
    if isinstance(record, MachineRun):
        yield from _forms(record.report)
    if isinstance(record, Framed):
        yield ".csv", lambda: csv_text(dict(record.table()))
    if isinstance(record, RecordTable):
        yield ".csv", lambda: csv_rows([record.fields, *zip(*record.table().values(), strict=True)])
    drawn = None if isinstance(record, Report | MachineRun) else figure(record)
    if drawn is not None:
        yield ".svg", lambda: svg(drawn)


def save(record: object, path: str | Path) -> None:
    """Write a record to a file, in the form of its ending. Raises ParameterError for another; OutputError."""
    target = Arguments("a file").path("path", path)
    forms = dict(_forms(record))
    if target.suffix.lower() not in forms:
        given = f"{target.suffix or 'no ending'} for a {type(record).__name__}"
        raise ParameterError(given, allowed=" or ".join(forms) or "no file")
    with Outputs(force=True) as outputs:
        outputs.write(target, forms[target.suffix.lower()]())
