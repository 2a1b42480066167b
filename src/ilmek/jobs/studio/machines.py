"""The catalogue of machines, the form of one, and its design."""

from dataclasses import dataclass, field
from typing import Any

from ilmek.jobs.design import design_machine
from ilmek.jobs.machines import machine_form, machine_list
from ilmek.jobs.studio.answers import Context
from ilmek.params import Setting


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
class DesignRequest:
    """A design of a machine: settings by name, texts with units or numbers in SI."""

    name: str
    settings: dict[str, Setting] = field(default_factory=dict)


def list_of_machines(request: Nothing, context: Context) -> MachineList:
    """The machines of the catalogue."""
    return MachineList(tuple(MachineSummary(name, summary) for name, summary in machine_list().items()))


def form(request: MachineName, context: Context) -> dict[str, Any]:
    """The declared parameters of a machine. Raises ParameterError for an unknown one."""
    return machine_form(request.name).as_json() | {"machines": list(machine_form(request.name).machines)}


def design(request: DesignRequest, context: Context) -> dict[str, Any]:
    """Design a machine: the JSON of the command line. Raises as `design_machine` does."""
    return design_machine(request.name, request.settings, progress=context.progress).as_json()
