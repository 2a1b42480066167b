"""A cyclogram of a file or a machine: checked, optimised, reported, tabulated."""

from collections.abc import Mapping
from pathlib import Path

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.errors import ParameterError
from ilmek.io.cyclogram_file import cyclogram_data, read_cyclogram
from ilmek.io.table_csv import check_size
from ilmek.machines.catalogue import MACHINES, find_machine
from ilmek.params import Setting
from ilmek.progress import SILENT, Progress
from ilmek.report import Check, Column, Json, Report, Result, Table, at_most
from ilmek.timing.cyclogram import Cyclogram, Track, check_cyclogram
from ilmek.timing.figures import draw
from ilmek.timing.solver import Binding, Solution, least_acceleration, least_period, require_possible
from ilmek.timing.track import peak_acceleration, peak_speed, sample
from ilmek.units import deg, format_number, format_quantity, from_si, turn

GOALS = {"acceleration": least_acceleration, "period": least_period}
"""Goals that a cyclogram can be solved for."""


def find(name: str, settings: Mapping[str, Setting]) -> Cyclogram:
    """The cyclogram of a file or of a machine of the catalogue, given as MACHINE or MACHINE:CYCLOGRAM.

    settings  parameters of the machine by name, with units
    Raises ParameterError for settings of a file, a machine without cyclograms, and a machine with several cyclograms of
    which none is named.
    """
    machine, _, which = name.partition(":")
    if machine not in MACHINES or Path(name).suffix.lower() in (".toml", ".json"):
        path = Path(name)
        if not path.suffix and not path.exists():
            machines = ", ".join(timed())
            raise ParameterError(f"{name} is neither a cyclogram file nor a machine", allowed=f"a path, or {machines}")
        if settings:
            raise ParameterError(f"{name} is a file and has no parameters to set", allowed=", ".join(timed()))
        return read_cyclogram(path)
    made = {cyclogram.name: cyclogram for cyclogram in cyclograms_of(machine, settings)}
    if which not in made and (which or len(made) > 1):
        choices = " or ".join(f"{machine}:{one}" for one in made)
        raise ParameterError(f"{name} has several cyclograms", allowed=choices)
    return made[which] if which else next(iter(made.values()))


def cyclograms_of(machine: str, settings: Mapping[str, Setting], progress: Progress = SILENT) -> tuple[Cyclogram, ...]:
    """The cyclograms of a machine of the catalogue.

    Raises ParameterError for an unknown machine, and for one without cyclograms; Cancelled.
    """
    kind, params = find_machine(machine).ordered(settings)
    cyclograms = kind.cyclograms(kind.designed(params, progress)) if kind.cyclograms else ()
    if not cyclograms:
        raise ParameterError(f"{kind.name} has no cyclogram", allowed=f"machines with some: {', '.join(timed())}")
    return tuple(cyclograms)


def timed() -> list[str]:
    """The machines of the catalogue that have cyclograms."""
    return [name for name, machine in MACHINES.items() if machine.cyclograms is not None]


def solve(cyclogram: Cyclogram, goal: str, progress: Progress = SILENT) -> Solution:
    """The cyclogram solved for a goal, a key of `GOALS`.

    Raises ParameterError for an unknown goal, and as the solver; Cancelled.
    """
    if goal not in GOALS:
        raise ParameterError(f"--solve {goal}", allowed=" or ".join(GOALS))
    return GOALS[goal](cyclogram, progress.part(0.0, 1.0, "solve"))


def report(cyclogram: Cyclogram, solution: Solution | None = None) -> Report:
    """The report of a cyclogram; of a solved one also the improvement and the binding constraints.

    Raises ParameterError if its constraints contradict each other, so that no timing can satisfy them.
    """
    checks = (*check_cyclogram(cyclogram), *limit_checks(cyclogram))
    if solution is None and not all(check.ok for check in checks):
        require_possible(cyclogram)
    notes = {
        "Shaded: occupation of a zone that another track needs too.": cyclogram.exclusions,
        "Arrows: required order of events.": cyclogram.relations,
    }
    note = " ".join(text for text, used in notes.items() if used)
    tables = [_motions_table(cyclogram), _tracks_table(cyclogram)]
    results = [
        Result("period", cyclogram.period, "s", "time of a turn of the master shaft"),
        Result("tracks", _peaks(cyclogram), "", "largest speed and acceleration of each track", shown=False),
        Result("cyclogram", cyclogram_data(cyclogram), "", "the cyclogram, as in a file", shown=False),
    ]
    if solution is not None:
        results += _improvement(solution)
        tables.insert(0, _binding_table(solution))
    return Report(
        machine="cyclogram",
        title=f"Cyclogram: {cyclogram.name}",
        parameters={},
        results=tuple(results),
        checks=checks,
        tables=tuple(tables),
        figures=(draw(cyclogram, cyclogram.name, note),),
    )


def columns(cyclogram: Cyclogram, steps: int) -> dict[str, FloatArray]:
    """Columns of a table by heading with unit: master angle, time; position, velocity, acceleration of each track.

    steps  of a turn; the table has one row more
    Raises ParameterError for a table of more than `MOST_NUMBERS` numbers.
    """
    check_size(steps + 1, 2 + 3 * len(cyclogram.tracks), "--steps", ParameterError)
    angle = np.linspace(0.0, turn, steps + 1)
    w = cyclogram.speed
    columns = {"master angle [deg]": np.linspace(0.0, 360.0, steps + 1), "time [s]": angle / w}
    for track in cyclogram.tracks:
        motion, unit = sample(track, angle), track.unit or "1"
        scale = from_si(1.0, track.unit)
        columns[f"{track.name} position [{unit}]"] = motion.position * scale
        columns[f"{track.name} velocity [{unit}/s]"] = motion.slope * w * scale
        columns[f"{track.name} acceleration [{unit}/s^2]"] = motion.bend * w**2 * scale
    return columns


def binding_words(solution: Solution) -> list[str]:
    """The binding constraints, one line each, in the order of the turn."""
    return [f"{one.label}: {binding_cost(one, solution)}" for one in solution.binding]


def binding_cost(one: Binding, solution: Solution) -> str:
    """What a binding constraint costs, as a phrase."""
    if one.kind == "motion":
        return f"{format_number(100 * one.share, 3)} % of the turn's requirement"
    if one.kind in ("order", "turn"):
        return "no gap left" if one.kind == "order" else "end of the turn"
    grows = "period" if solution.goal == "period" else "acceleration"
    return f"1 deg less would reduce the {grows} by {format_number(100 * one.cost * deg, 3)} %"


def limit_checks(cyclogram: Cyclogram) -> list[Check]:
    """Largest speed and acceleration of each track against its limits."""
    checks = []
    for track in cyclogram.tracks:
        limits, unit, source = track.limits, track.unit, f"limit of {track.actuator or track.name}"
        speed, acceleration = peak_speed(track, cyclogram.period), peak_acceleration(track, cyclogram.period)
        if np.isfinite(limits.speed):
            checks.append(at_most(f"{track.name}: speed", _rounded(speed), limits.speed, f"{unit}/s", source))
        if np.isfinite(limits.acceleration):
            name = f"{track.name}: acceleration"
            checks.append(at_most(name, _rounded(acceleration), limits.acceleration, f"{unit}/s^2", source))
    return checks


def _rounded(value: float) -> float:
    """The value to nine digits, free of rounding errors."""
    return float(f"{value:.9g}")


def _peaks(cyclogram: Cyclogram) -> dict[str, Json]:
    return {
        track.name: {
            "speed": peak_speed(track, cyclogram.period),
            "acceleration": peak_acceleration(track, cyclogram.period),
        }
        for track in cyclogram.tracks
    }


def _improvement(solution: Solution) -> list[Result]:
    binding: list[Json] = [
        {"said": one.label, "kind": one.kind, "share": one.share, "cost": one.cost} for one in solution.binding
    ]
    return [
        Result("goal", solution.goal, "", "quantity that was minimised"),
        Result("before", solution.before, solution.unit, f"{solution.measure}, as given"),
        Result("after", solution.after, solution.unit, f"{solution.measure}, solved: least for this order"),
        Result("binding", binding, "", "binding constraints, in the order of the turn", shown=False),
    ]  # fmt: skip


def _binding_table(solution: Solution) -> Table:
    columns = (Column("constraint"), Column("kind"), Column("effect"))
    rows = tuple((one.label, one.kind, binding_cost(one, solution)) for one in solution.binding)
    return Table("binding", "Binding constraints, in the order of the turn", columns, rows, brief=True)


def _motions_table(cyclogram: Cyclogram) -> Table:
    columns = (
        *(Column("track"), Column("motion"), Column("from", "deg"), Column("to", "deg")),
        *(Column("position from"), Column("position to"), Column("law")),
    )
    rows = tuple(
        (track.name, part.name, part.start, part.end, _at(track, part.begin), _at(track, part.finish), part.law.name)
        for track in cyclogram.tracks
        for part in track.segments
    )
    return Table("motions", "Motions", columns, rows)


def _tracks_table(cyclogram: Cyclogram) -> Table:
    columns = (Column("track"), Column("actuator"), Column("largest speed"), Column("largest acceleration"))
    rows = tuple(
        (
            track.name,
            track.actuator,
            format_quantity(peak_speed(track, cyclogram.period), f"{track.unit or '1'}/s"),
            format_quantity(peak_acceleration(track, cyclogram.period), f"{track.unit or '1'}/s^2"),
        )
        for track in cyclogram.tracks
    )
    return Table("tracks", "Tracks", columns, rows, brief=True)


def _at(track: Track, position: float) -> str:
    return format_quantity(position, track.unit)
