"""Given motions of inputs: constant speed, motion laws in sequence, a smooth curve through a table of values."""

import itertools
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
import scipy

from ilmek.arrays import FloatArray
from ilmek.cams.laws import law_of
from ilmek.cams.laws.law import Law
from ilmek.dynamics.own_machine import GivenMotion
from ilmek.errors import MechanismError
from ilmek.io.declared import FlagEntry, ListEntry, TableEntry, TextEntry, keys, quantity, variant
from ilmek.io.mechanism.names import input_of, position_of_input, speed_of_input, unit_of, value_of
from ilmek.io.schema import Measured, SourceText, Table
from ilmek.linkage.model import Mechanism
from ilmek.records import JsonObject
from ilmek.units import turn

_SAME = 1e-9

_NUMBER = quantity("1")

LAW = variant(
    TextEntry("name of the law"),
    TableEntry(
        "name and parameters",
        {"name": TextEntry("")},
        others=variant(_NUMBER, ListEntry("numbers", _NUMBER, 1, 100)),
    ),
    name="law",
    doc="motion law",
)


def steps_entry(doc: str, move: TableEntry, dwell: str, of: str) -> ListEntry:
    """Motions and dwells in sequence; dwell  meaning of its duration, in the unit `of`."""
    further = {"law": replace(LAW, doc="default: 3-4-5")}
    move = replace(move, optional=further)
    rest = keys({"dwell": quantity(of, dwell, above=0.0)})
    return ListEntry(doc, variant(move, rest), 1, 100)


_START = position_of_input("default: 0")
_SPEED = speed_of_input()

MOTION = variant(
    _SPEED,
    keys({"speed": _SPEED}, {"start": replace(_START, doc="value at time 0; default: 0")}),
    keys(
        {
            "steps": steps_entry(
                "motions and dwells, one after the other",
                keys({"to": position_of_input("value at the end"), "time": quantity("s", "duration", above=0.0)}),
                "duration at rest",
                "s",
            )
        },
        {
            "start": _START,
            "repeat": FlagEntry("default: true where the last value is the first, or a full turn further"),
        },
    ),
    keys(
        {
            "table": ListEntry(
                "[[time, value], ...] with a smooth curve through them",
                ListEntry("time and value", quantity(("s", "rad", "m")), 2, 2),
                3,
                1000,
            )
        },
        {"repeat": FlagEntry("default: as of steps")},
    ),
    name="motion",
)


@dataclass(frozen=True, slots=True)
class ConstantSpeed:
    """value = start + speed t; start [rad; m], speed [rad/s; m/s]."""

    start: float
    speed: float

    def __call__(self, time: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Value, speed and acceleration at times [s]."""
        zero = np.zeros_like(np.asarray(time, dtype=float))
        return self.start + self.speed * time, zero + self.speed, zero


@dataclass(frozen=True, slots=True)
class MotionStep:
    """A motion to a value [rad; m] within a time [s] by a law; the same value again is a dwell.

    Of a cam's lift the time is its angle [rad].
    """

    to: float
    time: float
    law: Law


@dataclass(frozen=True, slots=True)
class MotionSequence:
    """Motions and dwells in sequence, from `start` [rad; m] on.

    repeats  whether they repeat; each repetition begins where the last one ended

    value = begin + (to - begin) s(u), u = (t - t_k) / time, within each step; at rest before and after.
    """

    start: float
    steps: tuple[MotionStep, ...]
    repeats: bool

    @property
    def ends(self) -> tuple[float, ...]:
        """Times at which the steps end [s]."""
        return tuple(itertools.accumulate(step.time for step in self.steps))

    def __call__(self, time: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Value, speed and acceleration at times [s]."""
        ends = np.array(self.ends)
        within, further = _wrapped(time, ends[-1] if self.repeats else None, self.steps[-1].to - self.start)
        value, speed, acceleration = (np.zeros_like(within) for _ in range(3))
        value += np.where(within < 0, self.start, self.steps[-1].to)
        levels = (self.start, *(step.to for step in self.steps[:-1]))
        begins = (0.0, *self.ends[:-1])  # `end - step.time` may be a rounding later, and no step has what lies between
        for step, level, begin, end in zip(self.steps, levels, begins, ends, strict=True):
            inside = (within >= begin) & (within < end)
            curve = step.law.motion(np.clip((within[inside] - begin) / step.time, 0.0, 1.0))
            rise = step.to - level
            value[inside] = level + rise * curve.s
            speed[inside] = rise / step.time * curve.v
            acceleration[inside] = rise / step.time**2 * curve.a
        return value + further, speed, acceleration


@dataclass(frozen=True, slots=True)
class TableMotion:
    """A cubic spline through values [rad; m] at times [s], ascending; at rest at the ends unless it repeats."""

    times: tuple[float, ...]
    values: tuple[float, ...]
    repeats: bool

    def __call__(self, time: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Value, speed and acceleration at times [s]."""
        at, values = np.array(self.times), np.array(self.values)
        span, rise = at[-1] - at[0], values[-1] - values[0]
        slope = rise / span if self.repeats else 0.0
        level = values - slope * (at - at[0])
        if self.repeats:
            level[-1] = level[0]
        spline = scipy.interpolate.CubicSpline(at, level, bc_type="periodic" if self.repeats else "clamped")
        within, further = _wrapped(np.asarray(time, dtype=float) - at[0], span if self.repeats else None, rise)
        rest = (within < 0) | (within > span)
        inside = np.clip(within, 0.0, span) + at[0]
        value = spline(inside) + slope * (inside - at[0]) + further
        speed = np.where(rest, 0.0, spline(inside, 1) + slope)
        return value, speed, np.where(rest, 0.0, spline(inside, 2))


def _wrapped(time: FloatArray, period: float | None, rise: float) -> tuple[FloatArray, FloatArray]:
    """Times within the first period, and the rise of all periods before."""
    times = np.asarray(time, dtype=float)
    if period is None:
        return times, np.zeros_like(times)
    count = np.floor(times / period)
    return times - count * period, count * rise


def motions_of(
    tables: Mapping[str, Table | Measured], mechanism: Mechanism, source: SourceText
) -> dict[str, GivenMotion]:
    """Input -> the motion that it follows. Raises MechanismError with the line."""
    motions: dict[str, GivenMotion] = {}
    for name, table in tables.items():
        with source.located("motions", name):
            entry = input_of(name, mechanism)
            if entry.name in motions:
                raise MechanismError(f"the motion of {name!r} is given twice", do="give it once")
            motions[entry.name] = _motion(table, unit_of(entry))
    return motions


def _motion(table: Table | Measured, unit: str) -> GivenMotion:
    if isinstance(table, Measured):
        table = {"speed": table}
    start = value_of(table["start"], unit, "start") if "start" in table else 0.0
    if "speed" in table:
        speed = value_of(table["speed"], f"{unit}/s", "speed")
        if speed == 0:
            raise MechanismError("speed is 0: the input does not move", do="fix the input with --at, or give a speed")
        return GivenMotion(ConstantSpeed(start, speed), None, (), speed)
    if "table" in table:
        return _table_motion(table, unit)
    steps = steps_of(table["steps"], unit, start)
    repeats = _repeats(table.get("repeat"), start, steps[-1].to, turning=unit == "rad")
    law = MotionSequence(start, steps, repeats)
    breaks = sorted(
        {
            *law.ends,
            *(end - step.time * (1 - u) for step, end in zip(steps, law.ends, strict=True) for u in step.law.breaks),
        }
    )
    return GivenMotion(law, law.ends[-1] if repeats else None, tuple(breaks))


def steps_of(rows: Sequence[Table], unit: str, start: float, over: str = "time") -> tuple[MotionStep, ...]:
    """The steps of a motion over time [s], or of a cam's lift over its angle [rad]; over: the key of the durations.

    Raises MechanismError.
    """
    steps: list[MotionStep] = []
    at = start
    for number, row in enumerate(rows, start=1):
        duration = row["dwell"] if "dwell" in row else row[over]
        at = value_of(row["to"], unit, "to") if "to" in row else at
        law = _law(row.get("law", "3-4-5"))
        if not math.isfinite(law.acceleration_peak):
            given = f"the velocity of law {law.name} of step {number} jumps"
            raise MechanismError(given, do="use a law of finite acceleration, like 3-4-5 or modified-uniform")
        steps.append(MotionStep(at, duration, law))
    if all(step.to == start for step in steps):
        raise MechanismError("all steps are at one value: the input does not move")
    return tuple(steps)


def _law(given: str | Table) -> Law:
    if isinstance(given, str):
        return law_of(given)
    return law_of(given["name"], {key: value for key, value in given.items() if key != "name"})


def _table_motion(table: Table, unit: str) -> GivenMotion:
    rows = table["table"]
    times = tuple(value_of(row[0], "s", "the first of a row") for row in rows)
    values = tuple(value_of(row[1], unit, "the second of a row") for row in rows)
    if times[0] != 0 or any(later <= earlier for earlier, later in itertools.pairwise(times)):
        raise MechanismError("the times of a table do not ascend from 0 s", do="write each above the one before")
    repeats = _repeats(table.get("repeat"), values[0], values[-1], turning=unit == "rad")
    return GivenMotion(TableMotion(times, values, repeats), times[-1] if repeats else None, times[1:])


def _repeats(given: bool | None, first: float, last: float, *, turning: bool) -> bool:
    """Whether a motion repeats: as given, by default where its last value is its first one."""
    apart = math.remainder(last - first, turn) if turning else last - first
    closed = abs(apart) <= _SAME
    if given and not closed:
        further = ", or full turns further" if turning else ""
        raise MechanismError(
            "a motion that repeats ends elsewhere", allowed=f"its last value is its first one{further}"
        )
    return closed if given is None else given


def motion_data(name: str, motion: GivenMotion, unit: str) -> JsonObject:
    """The table of a motion in a unit. Raises MechanismError for one that no file can express."""
    law = motion.law
    if isinstance(law, ConstantSpeed):
        return {"speed": Measured(law.speed, f"{unit}/s"), "start": Measured(law.start, unit)}
    if isinstance(law, TableMotion):
        rows = table_rows(law.times, "s", law.values, unit)
        return {"table": rows, "repeat": law.repeats}
    if isinstance(law, MotionSequence):
        steps = [step_data(step, unit) for step in law.steps]
        return {"start": Measured(law.start, unit), "steps": steps, "repeat": law.repeats}
    raise MechanismError(f"the motion of {name!r} is a function that no file expresses")


def step_data(step: MotionStep, unit: str, over: str = "time") -> JsonObject:
    """The table of a step; over: the key of its duration."""
    parameters = {key: list(value) if isinstance(value, tuple) else value for key, value in step.law.parameters.items()}
    law = {"name": step.law.name, **parameters} if parameters else step.law.name
    return {"to": Measured(step.to, unit), over: step.time, "law": law}


def table_rows(first: Sequence[float], unit: str, second: Sequence[float], of: str) -> list[list[Measured]]:
    """The rows of a table of two columns, with their units."""
    return [[Measured(one, unit), Measured(other, of)] for one, other in zip(first, second, strict=True)]
