"""The catalogue of machines, and the parameters of one of them."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

from ilmek.machines import ENTRIES
from ilmek.records import JsonObject
from ilmek.units import si_unit

if TYPE_CHECKING:
    from ilmek.params import Parameter

FIELDS = ("name", "default", "above", "at_least", "below", "at_most", "choices", "doc", "symbol", "alias")
"""Entries of a parameter in JSON, beside its units."""


@dataclass(frozen=True, slots=True)
class MachineForm:
    """The declared parameters of a machine, nested ones by dotted names.

    machines  other machines whose parameters can be set too, as `shedding.law`
    """

    machine: str
    summary: str
    parameters: "tuple[Parameter, ...]"
    machines: tuple[str, ...] = ()

    def as_json(self) -> JsonObject:
        """The parameters as plain data: default and bounds in SI, their unit, and the unit in which they are shown."""
        parameters = [
            {name: getattr(parameter, name) for name in FIELDS}
            | {"unit": si_unit(parameter.unit), "shown_unit": parameter.unit}
            for parameter in self.parameters
        ]
        return {
            "machine": self.machine,
            "summary": self.summary,
            "parameters": parameters,
            "machines": list(self.machines),
        }


def machine_list() -> dict[str, str]:
    """The summary of each machine by its name. No machine is imported."""
    return {name: entry.summary for name, entry in ENTRIES.items()}


def machine_form(name: str) -> MachineForm:
    """The parameters of a machine. Raises ParameterError for an unknown name."""
    from ilmek.machines.catalogue import find_machine
    from ilmek.params import listed, overridden

    machine = find_machine(name)
    return MachineForm(machine.name, machine.summary, listed(machine.params), overridden(machine.params))
