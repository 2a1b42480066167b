"""The machines of the catalogue, each found by its name."""

import difflib
import importlib
from collections.abc import Iterator, Mapping

from ilmek.errors import ParameterError, joined_message
from ilmek.machines import ENTRIES
from ilmek.machines.component import AnyComponent, Component


class UnknownMachineError(ParameterError, KeyError):
    """A name that no machine has: a KeyError to whoever reads the catalogue as a mapping."""

    def __str__(self) -> str:
        return joined_message(self.given, self.allowed, self.do)


class Catalogue(Mapping[str, AnyComponent]):
    """Every machine by its name. A machine's package is imported when the machine is looked up: most jobs need one."""

    def __getitem__(self, name: str) -> AnyComponent:
        """The machine of a name. Raises UnknownMachineError, a KeyError that names the nearest machine."""
        if name not in ENTRIES:
            near = difflib.get_close_matches(name.lower().replace("_", "-"), ENTRIES, n=1)
            hint = f"did you mean {near[0]}?" if near else ""
            raise UnknownMachineError(f"unknown machine {name!r}", allowed=f"machines: {', '.join(ENTRIES)}", do=hint)
        package = ENTRIES[name].package or f"ilmek.machines.{name.replace('-', '_')}"
        machine = importlib.import_module(package).MACHINE
        assert isinstance(machine, Component)
        return machine

    def __iter__(self) -> Iterator[str]:
        return iter(ENTRIES)

    def __len__(self) -> int:
        return len(ENTRIES)


MACHINES = Catalogue()
"""Every machine by its name, in the order of the catalogue."""


def find_machine(name: str) -> AnyComponent:
    """The machine of a name. Raises ParameterError, naming the nearest."""
    return MACHINES[name]
