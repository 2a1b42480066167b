"""Each state of the studio as its command line and as Python; both give the same numbers.

Paths are relative to the project's folder, in which both are run.
"""

import shlex
from collections.abc import Mapping
from dataclasses import dataclass, field

from ilmek.errors import ParameterError
from ilmek.io.toml_text import written_quantity
from ilmek.jobs.cyclogram import GOALS
from ilmek.jobs.machine_file import read_machine_order
from ilmek.jobs.studio.answers import Context
from ilmek.machines.catalogue import find_machine
from ilmek.params import Setting, reachable


@dataclass(frozen=True, eq=False, slots=True)
class CommandRequest:
    """A state that is shown as its command line and as Python.

    kind      carpet, chart, machine, linkage, cyclogram
    path      the project's file; "": `machine`, of the catalogue; of a cyclogram also MACHINE:CYCLOGRAM
    settings  of the machine, by name: beside a file they win over it
    options   of the command, by name: `over`, `speed`, `steps`, `at` of a linkage, `solve` of a cyclogram, `out` of a
              carpet
    """

    kind: str
    path: str = ""
    machine: str = ""
    settings: dict[str, Setting] = field(default_factory=dict)
    options: dict[str, Setting] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class ShownCommand:
    """The same state as command line and as Python."""

    command: str
    python: str


def shown_command(request: CommandRequest, context: Context) -> ShownCommand:
    """A state as its command line and as Python. Raises ParameterError for an unknown kind or option."""
    name = request.path or request.machine
    if request.kind not in _OPTIONS:
        raise ParameterError(f"{request.kind!r} has no command", allowed=", ".join(_OPTIONS))
    unknown = request.options.keys() - _OPTIONS[request.kind]
    if unknown:
        allowed = ", ".join(_OPTIONS[request.kind]) or "none"
        raise ParameterError(f"unknown options {', '.join(sorted(unknown))}", allowed=allowed)
    options = {key: value for key, value in request.options.items() if value not in (None, "")}
    if request.kind in ("carpet", "chart"):
        return carpet_command(name, str(options.get("out", "")), chart=request.kind == "chart")
    if request.kind == "machine":
        return design_command(name, request.settings)
    if request.kind == "linkage":
        return mechanism_command(name, options)
    return cyclogram_command(name, request.settings, str(options.get("solve", "")))


_OPTIONS: Mapping[str, tuple[str, ...]] = {
    "carpet": ("out",),
    "chart": ("out",),
    "machine": (),
    "linkage": ("over", "speed", "steps", "at"),
    "cyclogram": ("solve",),
}


def design_command(name: str, settings: Mapping[str, Setting]) -> ShownCommand:
    """The design of a machine of the catalogue or of a machine file, with settings."""
    units = _units(name) if any(isinstance(value, int | float) for value in settings.values()) else {}
    given = [f"{key}={_text(value, units.get(key, ''))}" for key, value in settings.items()]
    shown = ", ".join(f"{key!r}: {value!r}" for key, value in settings.items())
    argument = f", {{{shown}}}" if settings else ""
    return ShownCommand(
        _line("ilmek", "design", name, *given),
        f"import ilmek\n\nreport = ilmek.design({name!r}{argument})\nprint(report)\n",
    )


def carpet_command(recipe: str, out: str = "", *, chart: bool = False) -> ShownCommand:
    """The carpet of a recipe with its loom; `chart`: the chart and the yarn alone.

    out  folder of the files; default: out/NAME
    """
    folder = out or f"out/{recipe.removesuffix('.toml')}{'-chart' if chart else ''}"
    if chart:
        python = (
            "from pathlib import Path\n\n"
            "from ilmek.jobs.chart import chart_order\nfrom ilmek.jobs.order import read_order\n\n"
            f"charted, files = chart_order(read_order(Path({recipe!r})), Path({folder!r}))\nprint(files)\n"
        )
    else:
        python = f"import ilmek\n\nwoven = ilmek.weave({recipe!r}, {folder!r}, force=True)\nprint(woven.weaves)\n"
    return ShownCommand(
        _line("ilmek", "chart" if chart else "weave", recipe, "--out", folder, *(() if chart else ("--force",))), python
    )


def mechanism_command(name: str, options: Mapping[str, Setting] | None = None) -> ShownCommand:
    """The motion of a mechanism file. options: over, speed, steps, at."""
    options = options or {}
    arguments = [part for key, value in options.items() for part in (f"--{key}", _text(value))]
    given = {key: value for key, value in options.items() if key != "at"}
    if "at" in options:
        driven, _, value = _text(options["at"]).rpartition("=")
        given["fixed"] = {driven: value}  # type: ignore[assignment]
    keywords = "".join(f", {key}={value!r}" for key, value in given.items())
    return ShownCommand(
        _line("ilmek", "mechanism", name, *arguments),
        f"import ilmek\n\nrun = ilmek.run_machine({name!r}{keywords})\nprint(run.report)\n",
    )


def cyclogram_command(name: str, settings: Mapping[str, Setting] | None = None, goal: str = "") -> ShownCommand:
    """The cyclogram of a file or of a machine of the catalogue, solved for a goal where one is given."""
    if goal and goal not in GOALS:
        raise ParameterError(f"goal {goal!r}", allowed=" or ".join(GOALS))
    settings = settings or {}
    arguments = [part for key, value in settings.items() for part in ("--set", f"{key}={_text(value)}")]
    shown = f"{{{', '.join(f'{key!r}: {_text(value)!r}' for key, value in settings.items())}}}"
    lines = [
        f"from ilmek.jobs.cyclogram import find, report{', solve' if goal else ''}",
        "",
        f"cyclogram = find({name!r}, {shown})",
        *([f"solution = solve(cyclogram, {goal!r})"] if goal else []),
        f"print(report({'solution.cyclogram, solution' if goal else 'cyclogram'}))",
    ]
    command = _line("ilmek", "cyclogram", name, *arguments, *(("--solve", goal) if goal else ()))
    return ShownCommand(command, "\n".join(lines) + "\n")


def _units(name: str) -> dict[str, str]:
    """The units of a machine's parameters by name. Raises ParameterError for an unknown machine."""
    params = find_machine(read_machine_order(name, {}).machine).params
    return {key: parameter.unit for key, parameter in reachable(params).items()}


def _text(value: Setting, unit: str = "") -> str:
    """A setting as on the command line; a number, in SI, with its unit."""
    if isinstance(value, bool):
        return "yes" if value else "no"
    return str(written_quantity(value, unit)) if unit and isinstance(value, int | float) else str(value)


def _line(*parts: str) -> str:
    return shlex.join(parts)
