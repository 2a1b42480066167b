"""Four-bars for a task that is clicked and dragged: a short search while it changes, the full one after it."""

import tomllib
from collections.abc import Mapping
from dataclasses import dataclass, field

from ilmek.errors import ParameterError
from ilmek.io.mechanism_file import mechanism_toml
from ilmek.jobs.studio.answers import Context
from ilmek.jobs.studio.synthesis.answers import MechanismDocument, SynthesisAnswer
from ilmek.jobs.studio.synthesis.gallery import (
    function_required,
    gallery,
    left_out,
    loosened,
    pivot_curves,
    reasons,
    task_points,
)
from ilmek.jobs.studio.synthesis.task import is_exact
from ilmek.jobs.studio.words import spoken
from ilmek.machines.catalogue import find_machine
from ilmek.machines.four_bar_figures import own_four_bar
from ilmek.params import Params, Setting
from ilmek.records import JsonObject, alike
from ilmek.synthesis.filters import JAM
from ilmek.synthesis.four_bar import FourBar

QUICK: Mapping[str, Mapping[str, Setting]] = {
    "motion-four-bar": {"samples": "80", "links": "250", "loosen": "no"},
    "path-four-bar": {"starts": "48"},
    "function-four-bar": {},
}
"""Settings of a short search, by machine; a setting that the file states otherwise is replaced too."""


@dataclass(frozen=True, eq=False, slots=True)
class SynthesisRequest:
    """A task of synthesis, as its file states it.

    data   plain data of the file: `machine` and the table `settings`
    quick  a short search, for a task that is being dragged: it answers in a fraction of a second and may miss the best
    """

    data: JsonObject = field(default_factory=dict)
    quick: bool = False


@dataclass(frozen=True, eq=False, slots=True)
class FourBarRequest:
    """A four-bar by its pins as drawn [m]: a0, b0, a, b, and tracer where it has one."""

    pins: dict[str, list[float]]


def candidates(request: SynthesisRequest, context: Context) -> SynthesisAnswer:
    """The four-bars for a task, the best first, and why others were left out.

    Raises ParameterError where the file states another machine, or the task cannot be read; Cancelled.
    """
    name, params, short = _read(request)
    machine = find_machine(name)
    design = machine.designed(params, context.progress.part(0.0, 1.0, "search"))
    choice = design.choice
    points, angles = task_points(design)
    answer = alike(
        SynthesisAnswer,
        choice,
        machine=name,
        quick=short,
        candidates=gallery(design),
        left_out=reasons(choice),
        removed=left_out(choice),
        no_four_bar=tuple(choice.other),
        loosened=loosened(choice.cures),
        warnings=tuple(machine.warnings(design)),
        points=points,
        angles=angles,
        required=function_required(design),
        curves=pivot_curves(design),
        jam=JAM,
    )
    return spoken(answer)


def _read(request: SynthesisRequest) -> tuple[str, Params, bool]:
    """The machine, its parameters, and whether the search is short: then they have the settings of `QUICK`."""
    name = str(request.data.get("machine", ""))
    if name not in QUICK:
        raise ParameterError(f"machine = {name!r} is no synthesis", allowed=", ".join(QUICK), do="name one of them")
    settings = request.data.get("settings", {})
    if not isinstance(settings, dict):
        raise ParameterError("settings is no table", do='write [settings] and below it points = "(20mm,20mm) …"')
    shorter = QUICK[name] if request.quick and not is_exact(settings) else {}
    return name, find_machine(name).params.read({**settings, **shorter}), bool(shorter)


def mechanism(request: FourBarRequest, context: Context) -> MechanismDocument:
    """A four-bar as a mechanism file, as `ilmek design … --to FILE` writes it.

    Raises ParameterError for a pin that is missing, MechanismError for a link of length 0.
    """
    missing = [name for name in ("a0", "b0", "a", "b") if name not in request.pins]
    if missing:
        raise ParameterError(f"the four-bar has no {missing[0]}", allowed="pins a0, b0, a, b and tracer")
    wrong = [name for name, at in request.pins.items() if len(at) != 2 or name not in FourBar.__slots__]
    if wrong:
        raise ParameterError(f"pin {wrong[0]} of the four-bar", allowed="a0, b0, a, b and tracer, each [x, y]")
    known = {name: complex(*at) for name, at in request.pins.items()}
    text = mechanism_toml(own_four_bar(FourBar(**known)))
    return MechanismDocument(text, tomllib.loads(text))
