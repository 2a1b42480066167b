"""Tools for agents: twelve of the verbs, with arguments and answers in JSON.

Each answer has its verdict, its checks with values, limits and units, and its results with units (SI). A file is named
relative to one folder, and none outside it is read.
"""

from collections.abc import Callable, Mapping, Sequence
from functools import singledispatch
from pathlib import Path
from typing import Any

import numpy as np

from ilmek.api.carpets import weave
from ilmek.api.designs import design, list_machines, parameters
from ilmek.api.judgements import judged
from ilmek.api.knots import cyclogram, knot
from ilmek.api.machine_runs import MachineRun, run_machine
from ilmek.api.mechanisms import read_mechanism
from ilmek.api.programmes import check, inspect
from ilmek.api.shown import facts
from ilmek.api.studies import study
from ilmek.api.tufted import tuft
from ilmek.errors import ParameterError
from ilmek.io.mechanism_file import MechanismFile, parse_mechanism
from ilmek.jobs.check import CheckResult
from ilmek.jobs.gun import GunResult
from ilmek.jobs.inspect import InspectionResult
from ilmek.jobs.study.report import study_report
from ilmek.jobs.tufting import TuftingResult
from ilmek.jobs.weave import WeaveResult
from ilmek.linkage.judged import JudgedMechanism
from ilmek.records import JsonObject, record
from ilmek.report import Check, Report, Result
from ilmek.report.framed import RecordTable
from ilmek.report.json import plain
from ilmek.report.verdict import verdict_json
from ilmek.units import si_unit

FILE = "path of a file in the folder"
MECHANISM = "path of a mechanism file in the folder, or its text (TOML)"
VALUES = "entries of the file's table `values`, as texts with units"
TEXTS = "values by name, as texts with units"


@record
class Tool:
    """A verb as a tool.

    verb  the function      doc  what it does      arguments  name -> (JSON type, meaning); the first ones are required
    required  how many of them must be given       files  the arguments that are files, in words
    """

    verb: Callable[..., Any]
    doc: str
    arguments: Mapping[str, tuple[str, str]]
    required: int = 0
    files: str = ""

    def schema(self) -> JsonObject:
        """JSON Schema of the arguments."""
        properties = {name: {"type": kind, "description": doc} for name, (kind, doc) in self.arguments.items()}
        required = list(self.arguments)[: self.required]
        return {"type": "object", "properties": properties, "required": required, "additionalProperties": False}


_POINTS = ("array", "points [x, y] in metres")
_CARPET = {
    "picture": ("string", FILE),
    "out": ("string", "path of a folder in the folder"),
    "size": ("string", '"1.2x1.8m"'),
    "deadline": ("string", '"72h"'),
    "settings": ("object", "further options: colours, pile_height, read, ..."),
}

TOOLS: Mapping[str, Tool] = {
    "machines": Tool(list_machines, "Machines of the catalogue, with what each is.", {}),
    "parameters": Tool(
        parameters, "Parameters of a machine: unit, default, bounds.", {"name": ("string", "of the machine")}, 1
    ),
    "design": Tool(
        lambda name, settings=None: design(name, settings or {}),
        "Design a machine of the catalogue and check it.",
        {"name": ("string", "of the machine"), "settings": ("object", TEXTS)},
        1,
        "name",
    ),
    "study": Tool(
        lambda target, vary, **wishes: study_report(study(target, vary, **wishes)),
        "Vary parameters of a machine, or values of a mechanism file: sweep, optimum, sensitivities, tolerances.",
        {
            "target": ("string", "machine, or a file"),
            "vary": ("object", 'name -> range "20deg..40deg", values "5mm, 6mm", tolerance "80mm+-0.05mm"'),
            "goals": ("array", 'results to make least, or "most NAME"'),
            "hold": ("array", 'limits, "transmission_angle_min >= 40deg"'),
            "record": ("array", "further results"),
            "fixed": ("object", TEXTS),
            "method": ("string", "sweep, local, morris, sobol, tolerance, optimum"),
            "samples": ("integer", "number of designs"),
        },
        2,
        "target",
    ),
    "judge": Tool(
        lambda mechanism, values=None: judged(_mechanism(mechanism, values)),
        "Degrees of freedom, Grashof's class, circuits and range of a mechanism.",
        {"mechanism": ("string", MECHANISM), "values": ("object", VALUES)},
        1,
        "mechanism",
    ),
    "run": Tool(
        lambda mechanism, values=None, **motion: run_machine(_mechanism(mechanism, values), **motion),
        "Motion, forces and strength of a mechanism, checked.",
        {
            "mechanism": ("string", MECHANISM),
            "values": ("object", VALUES),
            "over": ("string", 'range, "0deg..360deg"'),
            "speed": ("string", '"150rpm"'),
        },
        1,
        "mechanism",
    ),
    "weave": Tool(
        lambda picture, out, settings=None, **wishes: weave(picture, out, **wishes, **(settings or {})),
        "Picture to chart, yarn, loom and its programme in a new folder.",
        {
            **_CARPET,
            "quality": ("string", '"25x25/dm"'),
            "knot": ("string", "symmetric, asymmetric"),
            "heads": ("integer", "knotting heads"),
            "aim": ("string", "cost, price, time"),
            "loom": ("object", TEXTS),
        },
        2,
        "picture out",
    ),
    "tuft": Tool(
        lambda picture, out, settings=None, **wishes: tuft(picture, out, **wishes, **(settings or {})),
        "Picture to a tufting machine with its programme, or to the path of a tufting gun, in a new folder.",
        {**_CARPET, "technique": ("string", "tufting, gun"), "machine": ("object", TEXTS)},
        2,
        "picture out",
    ),
    "knot": Tool(
        lambda points, pitch="2mm": knot([complex(x, y) for x, y in points], pitch=pitch),
        "The knot that a path through a row of warps ties, proved.",
        {"points": _POINTS, "pitch": ("string", "of the warps")},
        1,
    ),
    "cyclogram": Tool(
        lambda name, settings=None, goal=None: cyclogram(name, settings=settings or {}, goal=goal),
        "The cyclogram of a machine or of a file, checked; with a goal retimed.",
        {
            "name": ("string", "MACHINE, or a file"),
            "settings": ("object", TEXTS),
            "goal": ("string", "period: the least one; acceleration: the least ones"),
        },
        1,
        "name",
    ),
    "check": Tool(check, "Prove the programme of a loom in a file.", {"path": ("string", FILE)}, 1, "path"),
    "inspect": Tool(inspect, "Statistics and stops of a programme.", {"path": ("string", FILE)}, 1, "path"),
}
"""Tools by name; at most twelve, so that an agent sees them all."""


def call_tool(folder: Path, name: str, arguments: Mapping[str, object]) -> JsonObject:
    """The answer of a tool: verdict, checks, results.

    folder  in which files are      Raises ParameterError for an unknown tool or argument, a missing one, and a file
    outside the folder; errors of the verb.
    """
    if name not in TOOLS:
        raise ParameterError(f"there is no tool {name!r}", allowed=", ".join(TOOLS))
    tool = TOOLS[name]
    missing = [known for known in list(tool.arguments)[: tool.required] if known not in arguments]
    unknown = [given for given in arguments if given not in tool.arguments]
    if missing or unknown:
        given = f"{name} without {missing[0]}" if missing else f"{name} with {unknown[0]!r}"
        raise ParameterError(given, allowed=", ".join(tool.arguments) or "no argument")
    values = dict(arguments)
    values |= {file: _inside(folder, values[file]) for file in tool.files.split()}
    positional = [values.pop(known) for known in list(tool.arguments)[: tool.required]]
    return answer(tool.verb(*positional, **values))


def _mechanism(text: str, values: Mapping[str, str] | None) -> MechanismFile:
    """The mechanism of a text, or of the file at a path."""
    return parse_mechanism(text) if "\n" in text else read_mechanism(text, values=values or {})


def _inside(folder: Path, name: object) -> str:
    """The path of a file in the folder; the name of a machine, and a text of many lines, as it is."""
    if str(name).partition(":")[0] in list_machines() or "\n" in str(name):
        return str(name)
    path = (folder / str(name)).resolve()
    if not path.is_relative_to(folder.resolve()):
        raise ParameterError(f"{str(name)!r} is outside the folder", allowed="a file in it")
    return str(path)


@singledispatch
def answer(found: object) -> JsonObject:
    """What a tool answers of a result of a verb."""
    return {"results": found}


@answer.register
def _(report: Report) -> JsonObject:
    return _checked(report.all_checks, report.results_as_json(), report.results)


@answer.register
def _(run: MachineRun) -> JsonObject:
    return answer(run.report)


@answer.register
def _(woven: WeaveResult) -> JsonObject:
    loom = woven.loom
    return _checked(woven.checks, loom.results_as_json(), loom.results) | {"files": list(woven.written)}


@answer.register(TuftingResult)
@answer.register(GunResult)
def _(tufted: TuftingResult | GunResult) -> JsonObject:
    found = {result.name: plain(result.value) for result in tufted.results}
    return _checked(tufted.checks, found, tufted.results) | {"files": list(tufted.written)}


def _checked(checks: Sequence[Check], found: JsonObject, results: Sequence[Result]) -> JsonObject:
    """Verdict, checks, results and their units."""
    units = {result.name: si_unit(result.unit) for result in results}
    return {
        **verdict_json(checks), "checks": [check.as_json() for check in checks], "results": found, "units": units,
    }  # fmt: skip


@answer.register
def _(mechanism: JudgedMechanism) -> JsonObject:
    return {"results": dict(facts(mechanism))}


@answer.register
def _(rows: RecordTable) -> JsonObject:  # type: ignore[type-arg]
    return {"results": [{field: _shown(getattr(row, field)) for field in rows.fields} for row in rows]}


@answer.register(CheckResult)
@answer.register(InspectionResult)
def _(found: CheckResult | InspectionResult) -> JsonObject:
    return {"holds": getattr(found, "ok", True), "results": found.as_json()}


def _plain(value: object) -> bool:
    return isinstance(value, bool | int | float | str | np.floating | np.integer)


def _shown(value: object) -> object:
    return value if value is None or _plain(value) else str(value)
