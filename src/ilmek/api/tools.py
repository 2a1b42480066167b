"""Tools for agents: twelve of the verbs, with arguments and answers in JSON.

Each answer has its verdict, its checks with values, limits and units, and its results with units (SI). A file is named
relative to one folder, and none outside it is read.
"""

from collections.abc import Callable, Mapping
from functools import singledispatch
from pathlib import Path
from typing import Any

import numpy as np

from ilmek.api.designs import design, list_machines, parameters
from ilmek.api.four_bars import crank_rocker, motion_four_bars, path_four_bars
from ilmek.api.judgements import judged
from ilmek.api.knots import cyclogram, knot
from ilmek.api.machine_runs import MachineRun, run_machine
from ilmek.api.mechanisms import read_mechanism
from ilmek.api.programmes import check, inspect
from ilmek.api.shown import facts
from ilmek.errors import ParameterError
from ilmek.jobs.check import CheckResult
from ilmek.jobs.inspect import InspectionResult
from ilmek.linkage.judged import JudgedMechanism
from ilmek.records import JsonObject, record
from ilmek.report import Report
from ilmek.report.framed import RecordTable
from ilmek.synthesis.result import Synthesis
from ilmek.units import si_unit

FILE = "path of a file in the folder"
TEXTS = "values by name, as texts with units"


@record
class Tool:
    """A verb as a tool.

    verb  the function      doc  what it does      arguments  name -> (JSON type, meaning); the first ones are required
    required  how many of them must be given       file  the argument that is a file; "": none
    """

    verb: Callable[..., Any]
    doc: str
    arguments: Mapping[str, tuple[str, str]]
    required: int = 0
    file: str = ""

    def schema(self) -> JsonObject:
        """JSON Schema of the arguments."""
        properties = {name: {"type": kind, "description": doc} for name, (kind, doc) in self.arguments.items()}
        required = list(self.arguments)[: self.required]
        return {"type": "object", "properties": properties, "required": required, "additionalProperties": False}


_POINTS = ("array", "points [x, y] in metres")

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
    "judge": Tool(
        lambda path: judged(read_mechanism(path)),
        "Degrees of freedom, Grashof's class, circuits and range of the mechanism of a file.",
        {"path": ("string", FILE)},
        1,
        "path",
    ),
    "run": Tool(
        run_machine,
        "Motion, forces and strength of the mechanism of a file, checked.",
        {"machine": ("string", FILE), "over": ("string", 'range, "0deg..360deg"'), "speed": ("string", '"150rpm"')},
        1,
        "machine",
    ),
    "crank_rocker": Tool(
        crank_rocker,
        "The crank-rocker of a swing.",
        {"swing": ("string", '"30deg"'), "rotation": ("string", '"180deg"'), "ground": ("string", '"300mm"')},
        1,
    ),
    "path_four_bars": Tool(
        path_four_bars,
        "Four-bars whose coupler point comes nearest to points.",
        {"points": _POINTS, "closed": ("boolean", "whether the path is closed"), "count": ("integer", "at most")},
        1,
    ),
    "motion_four_bars": Tool(
        motion_four_bars,
        "Four-bars whose coupler takes three to five poses.",
        {"points": _POINTS, "angles": ("array", "of the coupler at each point, radians")},
        2,
    ),
    "knot": Tool(
        lambda points, pitch="2mm": knot([complex(x, y) for x, y in points], pitch=pitch),
        "The knot that a path through a row of warps ties, proved.",
        {"points": _POINTS, "pitch": ("string", "of the warps")},
        1,
    ),
    "cyclogram": Tool(
        cyclogram,
        "The cyclogram of a machine, checked.",
        {"name": ("string", "MACHINE, or a file")},
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
    if tool.file:
        values[tool.file] = _inside(folder, values[tool.file])
    positional = [values.pop(known) for known in list(tool.arguments)[: tool.required]]
    return answer(tool.verb(*positional, **values))


def _inside(folder: Path, name: object) -> str:
    """The path of a file in the folder; the name of a machine as it is."""
    if str(name).partition(":")[0] in list_machines():
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
    data = report.as_json()
    failed = [check.name for check in report.failed]
    verdict = f"failed: {', '.join(failed)}" if failed else "all checks hold"
    units = {found.name: si_unit(found.unit) for found in report.results}
    return {"ok": not failed, "verdict": verdict, "checks": data["checks"], "results": data["results"], "units": units}


@answer.register
def _(run: MachineRun) -> JsonObject:
    return answer(run.report)


@answer.register
def _(mechanism: JudgedMechanism) -> JsonObject:
    return {"results": dict(facts(mechanism))}


@answer.register
def _(found: Synthesis) -> JsonObject:  # type: ignore[type-arg]
    left_out = [{"reason": entry.reason, "count": entry.count} for entry in found.left_out]
    solutions = {heading: column.tolist() for heading, column in found.table().items()}
    return {"ok": bool(found), "verdict": repr(found), "left_out": left_out, "results": solutions}


@answer.register
def _(rows: RecordTable) -> JsonObject:  # type: ignore[type-arg]
    return {"results": [{field: _shown(getattr(row, field)) for field in rows.fields} for row in rows]}


@answer.register(CheckResult)
@answer.register(InspectionResult)
def _(found: CheckResult | InspectionResult) -> JsonObject:
    return {"ok": getattr(found, "ok", True), "results": found.as_json()}


def _plain(value: object) -> bool:
    return isinstance(value, bool | int | float | str | np.floating | np.integer)


def _shown(value: object) -> object:
    return value if value is None or _plain(value) else str(value)
