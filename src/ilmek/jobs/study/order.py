"""The order of a study, as options or a file state it: what varies, goals, limits, method."""

import re
from collections.abc import Mapping, Sequence
from dataclasses import field
from pathlib import Path

from ilmek.elements.fits import tolerance_zone
from ilmek.errors import IlmekError, ParameterError, did_you_mean, restated
from ilmek.io.data_text import read_data
from ilmek.jobs.study.targets import StudyTarget
from ilmek.params import Parameter, Setting, Value
from ilmek.records import JsonObject, record
from ilmek.studies.outcome import Hold, result_named
from ilmek.studies.samples import SAMPLINGS
from ilmek.studies.variable import NORMAL, TRIANGULAR, UNIFORM, Variable
from ilmek.units import parse_quantity, read_number

METHODS = ("sweep", "local", "morris", "sobol", "tolerance", "optimum")
"""Sweep; derivatives; elementary effects; variance-based indices; random parts; the best design, or a front."""

SAMPLES = {"sweep": 256, "local": 0, "morris": 256, "sobol": 1024, "tolerance": 1024, "optimum": 1024}
"""Default number of designs by method; of derivatives it follows from the variables."""

_PLUS_MINUS = re.compile(r"\s*(?:\+-|\+/-|±)\s*")
_CLASS = re.compile(r"(.+?)\s+([A-Za-z]{1,2}\d{1,2})$")
_HOLD = re.compile(r"\s*([\w.\-]+)\s*(<=|>=)\s*(.+?)\s*$")
_PAIR = re.compile(r"\s*([\w.\-]+)\s*,\s*([\w.\-]+)\s*=\s*(\S+)\s*")
_SPREAD = re.compile(rf"(.+?)\s+({UNIFORM}|{NORMAL}|{TRIANGULAR})$")


@record
class StudyOrder:
    """What is studied, as texts.

    target   machine, machine file or mechanism file       fixed   settings that do not vary
    vary     name -> range, values or tolerance            goals   results, `most` before one that is to be large
    holds    limits of results                             record  further results that the file has
    correlate  pairs of variables, "a, b = 0.8"            yield_target  yield for which tolerances are found; 0: none
    costs    variable -> cost of its present tolerance, relative to the others
    """

    target: str
    fixed: Mapping[str, Setting]
    vary: Mapping[str, str]
    goals: tuple[str, ...] = ()
    holds: tuple[str, ...] = ()
    record: tuple[str, ...] = ()
    method: str = "sweep"
    sampling: str = "sobol"
    samples: int | None = None
    seed: int = 0
    time_limit: float = 0.0
    over: str = ""
    speed: str = ""
    correlate: tuple[str, ...] = ()
    yield_target: float = 0.0
    costs: Mapping[str, float] = field(default_factory=dict)


@record
class Goal:
    """A result that is to be small, or large where `sign` is -1."""

    result: str
    sign: int = 1

    @property
    def text(self) -> str:
        """In words."""
        return f"{'least' if self.sign > 0 else 'most'} {self.result}"


def read_variable(target: StudyTarget, name: str, text: str) -> Variable:
    """A varied parameter: `20deg..40deg`, `a, b, c`, `80mm+-0.05mm`, `20mm H7`; a distribution may follow.

    A tolerance is normally distributed, its limits three standard deviations from its middle; a range uniformly.
    Raises ParameterError for an unknown name, a text that cannot be read, and bounds outside the declaration.
    """
    name = name.removeprefix("values.")
    parameter = target.parameter(name)
    nominal = target.nominal(name)
    with restated(ParameterError, f"--vary {name}={text}: ", of=IlmekError):
        spread = _SPREAD.fullmatch(text.strip())
        body, kind = (spread.group(1), spread.group(2)) if spread else (text.strip(), "")
        if "," in body or parameter.kind in (bool, str):
            return _choices(parameter, name, body, nominal)
        low, high, middle, usual = _limits(parameter, body)
        for value in (low, high):
            parameter.check(value)
        if middle is None:
            given = isinstance(nominal, int | float) and not isinstance(nominal, bool) and low <= nominal <= high
            middle = float(nominal) if given else (low + high) / 2  # type: ignore[arg-type]
        whole = parameter.kind is int
        return Variable(name, parameter.unit, low, high, middle, whole=whole, spread=kind or usual)


def _limits(parameter: Parameter, text: str) -> tuple[float, float, float | None, str]:
    """Low, high, nominal where the text has one, and the usual distribution."""
    if ".." in text:
        first, _, last = text.partition("..")
        return _number(parameter, _with_unit(first, last)), _number(parameter, last), None, UNIFORM
    parts = _PLUS_MINUS.split(text)
    if len(parts) == 2:
        middle, half = _number(parameter, parts[0]), _tolerance(parameter, parts[1])
        return middle - half, middle + half, middle, NORMAL
    fitted = _CLASS.fullmatch(text)
    if fitted:
        size = _number(parameter, fitted.group(1))
        zone = tolerance_zone(fitted.group(2), size)
        return size + zone.lower, size + zone.upper, size + (zone.lower + zone.upper) / 2, NORMAL
    raise ParameterError(
        "cannot be read", allowed="a range FROM..TO, values A,B,C, a tolerance 80mm+-0.05mm, or a class 20mm H7"
    )


def _with_unit(first: str, last: str) -> str:
    """The lower bound with the unit of the upper, where it is written without: `10..20rad/s`."""
    unit = re.sub(r"^\s*[-+]?[\d.]+(?:[eE][-+]?\d+)?\s*", "", last)
    return f"{first}{unit}" if re.fullmatch(r"\s*[-+]?[\d.]+(?:[eE][-+]?\d+)?\s*", first) else first


def _number(parameter: Parameter, text: str) -> float:
    value = parameter.read(text)
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise ParameterError(f"{text!r} is no number", allowed=parameter.allowed())
    return float(value)


def _tolerance(parameter: Parameter, text: str) -> float:
    """A tolerance: as a quantity, or in % of nothing: it needs its unit as the nominal value does."""
    half = parse_quantity(text, parameter.unit or "1")
    if half <= 0:
        raise ParameterError(f"tolerance {text}", allowed="above 0")
    return half


def read_correlations(texts: Sequence[str]) -> dict[tuple[str, str], float]:
    """Correlations by pairs of names, from texts like `a, b = 0.8`. Raises ParameterError."""
    found = {}
    for text in texts:
        parts = _PAIR.fullmatch(text)
        number = None if parts is None else read_number(parts.group(3))
        if parts is None or number is None:
            raise ParameterError(f"correlation {text!r} cannot be read", do='write "NAME, NAME = 0.8"')
        found[parts.group(1), parts.group(2)] = number
    return found


def read_costs(texts: Mapping[str, object] | Sequence[str]) -> dict[str, float]:
    """Costs by variable, from a table or from texts `NAME=COST`. Raises ParameterError."""
    pairs = texts.items() if isinstance(texts, Mapping) else (text.partition("=")[::2] for text in texts)
    found = {}
    for name, cost in pairs:
        number = read_number(str(cost))
        if number is None:
            raise ParameterError(f"--cost {name}={cost} is no number", do="write NAME=COST, like crank=2")
        found[name.strip()] = number
    return found


def read_yield(text: str) -> float:
    """A yield, `99%` or 0.99. Raises ParameterError for one that is not between 0 and 1."""
    with restated(ParameterError, f"--yield {text}: ", of=IlmekError):
        value = parse_quantity(text, "1")
    if not 0 < value < 1:
        raise ParameterError(f"--yield {text}", allowed="above 0 and below 100%")
    return float(value)


def _choices(parameter: Parameter, name: str, text: str, nominal: Value) -> Variable:
    values = [parameter.read(one) for one in text.split(",")]
    for value in values:
        parameter.check(value)
    if len(set(values)) < len(values):
        raise ParameterError("a value is given twice", do="give each once")
    start = values.index(nominal) if nominal in values else 0
    unit = parameter.unit if parameter.kind is float else ""
    return Variable(name, unit, 0.0, float(len(values) - 1), float(start), choices=tuple(values))


def read_goal(text: str, units: Mapping[str, str]) -> Goal:
    """A goal: `drive_torque_max`, `least drive_torque_max` or `most transmission_angle_min`."""
    first, _, rest = text.strip().partition(" ")
    if first in ("least", "most"):
        return Goal(result_named(rest.strip(), units), 1 if first == "least" else -1)
    return Goal(result_named(text.strip(), units))


def read_hold(text: str, units: Mapping[str, str]) -> Hold:
    """A limit: `transmission_angle_min >= 40deg`. Raises ParameterError."""
    parts = _HOLD.fullmatch(text)
    if parts is None:
        raise ParameterError(f"{text!r} is no limit", do="write RESULT >= VALUE or RESULT <= VALUE, with its unit")
    name, relation, value = parts.groups()
    unit = units[result_named(name, units)]
    with restated(ParameterError, f"{text}: ", of=IlmekError):
        return Hold(name, relation, parse_quantity(value, unit or "1"), unit)


KEYS = {
    "target": str, "set": dict, "vary": dict, "goals": list, "hold": list, "record": list, "method": str,
    "sampling": str, "samples": int, "seed": int, "over": str, "speed": str,
    "correlate": list, "yield": str, "cost": dict,
}  # fmt: skip
"""Keys of a study file, and the kinds of their values."""


def study_file(path: Path) -> JsonObject | None:
    """The data of a study file, which has the key `target`; None for a file of another kind.

    The target's file is found beside it. Raises ParameterError with file and line.
    """
    text = read_data(path, "study", ParameterError)
    data = text.data
    if not isinstance(data, dict) or "target" not in data:
        return None
    for key, value in data.items():
        kind = KEYS.get(key)
        at = f"study file {path}, line {text.lines.get((key,), 1)}"
        if kind is None:
            raise ParameterError(
                f"{at}: unknown key {key!r}", do=did_you_mean(key, KEYS, otherwise=f"keys: {', '.join(KEYS)}")
            )
        if not isinstance(value, kind):
            raise ParameterError(
                f"{at}: {key} is {value!r}",
                allowed={dict: "a table", list: "a list", str: "a text", int: "a whole number"}[kind],
            )
    beside = path.parent / data["target"]
    return {**data, "target": str(beside)} if beside.suffix in (".toml", ".json") else data


def check_words(order: StudyOrder) -> None:
    """Raise ParameterError for an unknown method or sampling, and for a study in which nothing varies."""
    for option, word, known in (("--method", order.method, METHODS), ("--sampling", order.sampling, SAMPLINGS)):
        if word not in known:
            raise ParameterError(f"{option} {word}", allowed=", ".join(known), do=did_you_mean(word, known))
    if not order.vary:
        raise ParameterError("nothing varies", do="give --vary NAME=FROM..TO")
    if order.method in ("local", "morris", "sobol", "tolerance") and not (order.goals or order.record or order.holds):
        raise ParameterError(f"--method {order.method} without a result", do="name one with --goal or --record")
    if order.method != "tolerance" and (order.correlate or order.yield_target or order.costs):
        raise ParameterError(
            f"--correlate, --yield and --cost with --method {order.method}", allowed="they are of --method tolerance"
        )
    if not 0 <= order.yield_target < 1:
        raise ParameterError(f"a yield of {order.yield_target:g}", allowed="above 0 and below 1")
    for name, cost in order.costs.items():
        if name not in order.vary or not cost > 0:
            near = did_you_mean(name, order.vary)
            raise ParameterError(f"--cost {name}={cost:g}", allowed="a variable, and a cost above 0", do=near)
    if order.method == "optimum" and not order.goals:
        raise ParameterError("an optimum without a goal", do="give --goal RESULT")


def names_of(texts: Sequence[str], units: Mapping[str, str]) -> tuple[str, ...]:
    """Results by name. Raises ParameterError for one that is unknown."""
    return tuple(result_named(text, units) for text in texts)
