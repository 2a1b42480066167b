"""The catalogue of machines, the form of one, one typed value of it, and its design."""

import re
from dataclasses import dataclass, field, replace
from functools import lru_cache

from ilmek.errors import ParameterError
from ilmek.io.json_file import json_text
from ilmek.jobs.design import design_machine
from ilmek.jobs.machines import machine_list
from ilmek.jobs.studio.answers import Binary, Context
from ilmek.jobs.studio.words import spoken
from ilmek.machines.catalogue import find_machine
from ilmek.params import Parameter, Setting, Value, overridden, reachable
from ilmek.records import alike
from ilmek.units import format_number, format_quantity, parse_unit, printed_unit

KINDS = {float: "quantity", int: "count", bool: "flag", str: "text"}
"""Names of the kinds of parameters; a text with choices is a "choice"."""


@dataclass(frozen=True, slots=True)
class Nothing:
    """A request without fields."""


@dataclass(frozen=True, slots=True)
class MachineName:
    """A machine of the catalogue."""

    name: str


@dataclass(frozen=True, slots=True)
class MachineSummary:
    """A machine of the catalogue and what it does, in a line."""

    name: str
    summary: str


@dataclass(frozen=True, slots=True)
class MachineList:
    """The machines of the catalogue."""

    machines: tuple[MachineSummary, ...]


@dataclass(frozen=True, slots=True)
class FormField:
    """A declared parameter.

    name     dotted where it is of a record or of another machine: `pile_handler.rise`, `shedding.law`
    group    what stands before the last dot of the name, "" for the machine's own
    machine  the other machine that it belongs to, "" for the machine's own
    kind     quantity, count, flag, choice, or text
    default  SI value; null: chosen by the design, `doc` states how          default_text  as it is shown
    shown_unit  in which it is shown, as it can be typed    printed  the same as it is printed       factor  to SI
    above, below  bounds that are excluded [SI]             at_least, at_most  bounds that are included [SI]
    allowed  the bounds or choices in words                 choices  allowed texts; of a quantity, words besides numbers
    alias    second name under which it can be set
    """

    name: str
    group: str
    machine: str
    kind: str
    default: Value
    default_text: str
    shown_unit: str
    printed: str
    factor: float
    above: float | None
    at_least: float | None
    below: float | None
    at_most: float | None
    allowed: str
    choices: tuple[str, ...]
    doc: str
    symbol: str
    alias: str


@dataclass(frozen=True, slots=True)
class MachineFields:
    """The form of a machine: its declared parameters, those of the other machines in it last.

    machines  the other machines whose parameters can be set too
    long      whether its design can take more than a second
    """

    machine: str
    title: str
    summary: str
    fields: tuple[FormField, ...]
    machines: tuple[str, ...]
    long: bool


@dataclass(frozen=True, slots=True)
class TypedValue:
    """A value that is typed for a parameter of a machine: a text with a unit, or a number in SI."""

    name: str
    parameter: str
    setting: Setting


@dataclass(frozen=True, slots=True)
class ReadValue:
    """What a typed value was read as: the SI value, and its text."""

    value: Value
    text: str


@dataclass(frozen=True, eq=False, slots=True)
class DesignRequest:
    """A design of a machine: settings by name, texts with units or numbers in SI."""

    name: str
    settings: dict[str, Setting] = field(default_factory=dict)


def list_of_machines(request: Nothing, context: Context) -> MachineList:
    """The machines of the catalogue."""
    return spoken(MachineList(tuple(MachineSummary(name, summary) for name, summary in machine_list().items())))


def form(request: MachineName, context: Context) -> MachineFields:
    """The declared parameters of a machine. Raises ParameterError for an unknown one."""
    return spoken(form_of(request.name))


def reading(request: TypedValue, context: Context) -> ReadValue:
    """Read one typed value. Raises ParameterError, as the command line does, where it is no allowed value."""
    known = parameters_of(request.name)
    if request.parameter not in known:
        raise ParameterError(f"unknown parameter {request.parameter!r}", do=f"see the parameters of {request.name}")
    parameter = known[request.parameter]
    value = parameter.read(request.setting)
    parameter.check(value)
    return ReadValue(value, value_text(value, parameter.unit))


def design(request: DesignRequest, context: Context) -> Binary:
    """Design a machine: the JSON of the command line, byte for byte. Raises as `design_machine` does."""
    design_result = design_machine(request.name, request.settings, progress=context.progress)
    return Binary("application/json", json_text(design_result.as_json(), context.progress).encode())


def value_text(value: Value, unit: str) -> str:
    """The value of a parameter as it is shown and can be typed again; "" for one that the design chooses.

    >>> value_text(0.0625, "mm"), value_text(True, ""), value_text(None, "mm"), value_text("rapier", "")
    ('62.5 mm', 'yes', '', 'rapier')
    >>> value_text(7850, "kg/m^3"), value_text(12000000, "")
    ('7850 kg/m³', '12000000')
    >>> value_text("(40.1923788646684mm,150mm)", "")
    '(40.1924mm,150mm)'
    """
    if value is None:
        return ""
    if isinstance(value, str):
        return _LONG.sub(lambda found: format_number(float(found.group()), 6), value)
    if isinstance(value, bool):
        return "yes" if value else "no"
    return str(value) if isinstance(value, int) and not unit else format_quantity(value, unit, 6)


_LONG = re.compile(r"\d+\.\d{5,}")
"""Numbers in a text with more digits than are shown."""


@lru_cache(maxsize=32)
def parameters_of(name: str) -> dict[str, Parameter]:
    """The parameters of a machine by name, each with its dotted name."""
    return {dotted: replace(one, name=dotted) for dotted, one in reachable(find_machine(name).params).items()}


@lru_cache(maxsize=32)
def form_of(name: str) -> MachineFields:
    """The form of a machine. Raises ParameterError for an unknown one."""
    machine = find_machine(name)
    others = overridden(machine.params)
    fields = tuple(_field(parameter, others) for parameter in parameters_of(name).values())
    return MachineFields(machine.name, machine.title, machine.summary, fields, others, machine.long_design is not None)


def _field(parameter: Parameter, others: tuple[str, ...]) -> FormField:
    group = parameter.name.rpartition(".")[0]
    head = parameter.name.partition(".")[0]
    return alike(
        FormField,
        parameter,
        group=group,
        machine=head if group and head in others else "",
        kind="choice" if parameter.kind is str and parameter.choices else KINDS[parameter.kind],
        default_text=value_text(parameter.default, parameter.unit),
        shown_unit=parameter.unit,
        printed=printed_unit(parameter.unit),
        factor=parse_unit(parameter.unit).factor,
        allowed=parameter.allowed(),
    )
