"""What a study evaluates: a machine of the catalogue by its parameters, or a mechanism file by its `values`."""

import cmath
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import replace
from hashlib import sha256
from pathlib import Path

from ilmek.errors import IlmekError, MechanismError, ParameterError, did_you_mean
from ilmek.io.data_text import read_data
from ilmek.io.mechanism_file import (
    MechanismFile,
    mechanism_of_data,
    read_mechanism,
    value_of,
    values_reader,
    with_values,
)
from ilmek.jobs.machine_file import read_machine_order
from ilmek.jobs.mechanism.analysis import analysis
from ilmek.jobs.mechanism.report import report as mechanism_report
from ilmek.jobs.mechanism.request import MotionRequest
from ilmek.jobs.mechanism.run import run
from ilmek.jobs.study.mechanism_arrays import arrays_serve, numbers_by_arrays
from ilmek.linkage.model import Pin
from ilmek.machines.catalogue import find_machine
from ilmek.params import Parameter, Setting, Value, reachable
from ilmek.records import record
from ilmek.report import Report
from ilmek.studies.outcome import Numbers

LONGEST_LIST = 24
"""Entries of a result of which each is a result of its own."""

EXTREMES = {"_min": min, "_max": max}
"""Ends of names of results with an entry for each part: of the whole the least or greatest is meant."""

TOGETHER, FEW = 64, 32
"""Designs of a mechanism file evaluated at once; fewer than `FEW` are quicker alone: the compiler is not loaded."""

PLAYS = {
    "clearance": ("mm", "radial play of a pin in its hole"),
    "side": ("deg", "side of the hole on which the pin lies, in the frame of its second body"),
}
"""Parameters of each pin: unit, meaning."""


@record
class MachineTarget:
    """A machine of the catalogue, with settings that do not vary; its parts are not compared in space."""

    machine: str
    settings: Mapping[str, Setting]

    @property
    def identity(self) -> Mapping[str, object]:
        """Name and settings."""
        return {"machine": self.machine, "set": dict(self.settings)}

    def parameter(self, name: str) -> Parameter:
        """The parameter of a name, with its value in force as default. Raises ParameterError, naming the nearest."""
        known = reachable(find_machine(self.machine).params)
        if name not in known:
            near = did_you_mean(name, known, otherwise=f"they are listed by: ilmek machines {self.machine}")
            raise ParameterError(f"unknown parameter {name!r} of {self.machine}", do=near)
        return known[name]

    def nominal(self, name: str) -> Value:
        """The value of a parameter where it does not vary; None: the design chooses it."""
        _, params = find_machine(self.machine).ordered(self.settings)
        return params.as_dict().get(name, self.parameter(name).default)

    def numbers(self, values: Mapping[str, Value], only: Sequence[str] | None = None) -> Numbers:
        """The design's results and checks. Raises any IlmekError."""
        machine, params = find_machine(self.machine).ordered({**self.settings, **values})
        names = None if only is None else frozenset(part for name in only for part in _parts(name))
        made = machine.report(machine.designed(params), illustrated=False, assembled=False, listed=False, only=names)
        return numbers_of(made)

    together = 1

    def numbers_together(self, _designs: object, _results: object) -> dict[int, Numbers]:
        """None: each design is made alone."""
        return {}


@record
class MechanismTarget:
    """A mechanism file of which entries of `values` vary, over a motion of its driving input.

    The clearance of a pin varies as `clearance.PIN`, the radial play of the journal in its hole [m], with the side on
    which it lies, `side.PIN` [rad] in the frame of the pin's second body: links without mass of that length.
    """

    data: Mapping[str, object]
    digest: str
    request: MotionRequest

    @property
    def identity(self) -> Mapping[str, object]:
        """Digest of the file, and its motion."""
        asked = self.request
        return {"mechanism": self.digest, "over": str(asked.over), "speed": str(asked.speed), "steps": asked.steps}

    def parameter(self, name: str) -> Parameter:
        """The entry of `values` of a name, in its unit. Raises ParameterError, naming the nearest."""
        kind, _, pin = name.partition(".")
        if pin and kind in PLAYS:
            joint = mechanism_of_data(self.data).mechanism.joint(pin)
            if not isinstance(joint, Pin):
                raise ParameterError(f"{name}: {pin} is a slide", allowed="clearance of a pin")
            unit, doc = PLAYS[kind]
            return Parameter(name, float, 0.0, doc, unit, at_least=0.0 if kind == "clearance" else None)
        value, unit = value_of(self.data, name)
        shown = {"m": "mm", "rad": "deg"}.get(unit, unit)
        return Parameter(name, float, value, "value of the mechanism file", shown)

    def nominal(self, name: str) -> Value:
        """The value in the file [SI]."""
        return self.parameter(name).default

    def numbers(self, values: Mapping[str, Value], _only: object = None) -> Numbers:
        """The results and checks of the mechanism in motion. Raises any IlmekError."""
        found = analysis(run(self._reader(values)(values), self.request))
        return numbers_of(mechanism_report(found, drawn=False))

    def _reader(self, names: Collection[str]) -> Callable[[Mapping[str, Value]], MechanismFile]:
        """Reads designs of which these vary."""
        own = [name for name in names if name.partition(".")[0] not in PLAYS]
        read = values_reader(self.data, own)
        if len(own) == len(names):
            return read
        return lambda values: with_play(read({name: values[name] for name in own}), values)

    @property
    def together(self) -> int:
        """Designs that are evaluated at once: `TOGETHER` where arrays serve them."""
        return TOGETHER if arrays_serve(mechanism_of_data(self.data).machine, self.request) else 1

    def numbers_together(self, designs: Sequence[Mapping[str, Value]], results: Sequence[str]) -> dict[int, Numbers]:
        """The numbers of those designs, by their places, that are evaluated as arrays."""
        if len(designs) < FEW:
            return {}
        machines, read = {}, self._reader(designs[0])
        for place, values in enumerate(designs):
            with suppress(IlmekError):  # alone it is refused with the reason
                machines[place] = read(values).machine
        return numbers_by_arrays(mechanism_of_data(self.data).machine, machines, self.request, results)


def with_play(file: MechanismFile, values: Mapping[str, Value]) -> MechanismFile:
    """The file with each hole of the second body of a pin displaced by its clearance to its side."""
    mechanism = file.mechanism
    for name, clearance in values.items():
        kind, _, pin = name.partition(".")
        if kind == "clearance":
            joint, side = mechanism.joint(pin), values.get(f"side.{pin}", 0.0)
            body = mechanism.body(joint.bodies[1])
            shift = complex(cmath.rect(float(clearance or 0), float(side or 0)))
            moved = replace(body, points={**body.points, joint.name: body.points[joint.name] + shift})
            mechanism = replace(mechanism, bodies=tuple(moved if one is body else one for one in mechanism.bodies))
    return replace(file, machine=replace(file.machine, mechanism=mechanism))


StudyTarget = MachineTarget | MechanismTarget


def read_target(name: str, settings: Mapping[str, Setting], request: MotionRequest) -> StudyTarget:
    """The target of a study: a machine's name, a machine file, or a mechanism file.

    Raises ParameterError, MechanismError; ParameterError for settings that a mechanism does not have.
    """
    path = Path(name)
    if path.suffix.lower() not in (".toml", ".json"):
        _no_motion(request, name)
        return MachineTarget(find_machine(name).name, dict(settings))
    text = read_data(path, "mechanism", MechanismError)
    if isinstance(text.data, Mapping) and "machine" in text.data:
        order = read_machine_order(name, settings)
        _no_motion(request, name)
        return MachineTarget(order.machine, dict(order.settings))
    values = {given.removeprefix("values."): str(setting) for given, setting in settings.items()}
    read_mechanism(path, values)  # the first error has its line
    return target_of_data(with_values(text.data, values), request)


def target_of_data(data: Mapping[str, object], request: MotionRequest) -> MechanismTarget:
    """The target of a mechanism file's plain data, in which no value is replaced."""
    return MechanismTarget(data, sha256(repr(sorted(data.items())).encode()).hexdigest(), request)


def _no_motion(request: MotionRequest, name: str) -> None:
    if request.over or request.speed:
        raise ParameterError(f"--over and --speed are given for {name}", allowed="they are of a mechanism file")


def _parts(name: str) -> Iterator[str]:
    """What a result may be called in the report that has it: the parts of its name that follow each other."""
    words = name.split(".")
    for first in range(len(words)):
        yield from (".".join(words[first:last]) for last in range(first + 1, len(words) + 1))


def numbers_of(report: Report) -> Numbers:
    """The numbers of a report and of the machines in it: results that are numbers, and those of groups by name.

    A group whose name ends in `_min` or `_max` is itself the least or greatest of its numbers.
    """
    entries = dict(_numbers(report, ""))
    return Numbers(
        {name: value for name, (value, _) in entries.items()},
        {name: unit for name, (_, unit) in entries.items()},
        report.all_checks,
    )


def _numbers(report: Report, prefix: str) -> Iterator[tuple[str, tuple[float, str]]]:
    for result in report.results:
        value, name = result.value, f"{prefix}{result.name}"
        if isinstance(value, bool | int | float):
            yield name, (float(value), result.unit)
        elif isinstance(value, Mapping) and 0 < len(value) <= LONGEST_LIST:
            group = {key: float(one) for key, one in value.items() if isinstance(one, int | float)}
            yield from ((f"{name}.{key}", (number, result.unit)) for key, number in group.items())
            extreme = EXTREMES.get(result.name[-4:])
            if extreme and group:
                yield name, (extreme(group.values()), result.unit)
    for child in report.children:
        yield from _numbers(child, f"{prefix}{child.key}.")
