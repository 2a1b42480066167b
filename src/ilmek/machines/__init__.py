"""The catalogue of machines. A new machine is a package here and a name below."""

import difflib
import importlib
from collections.abc import Iterator, Mapping

from ilmek.errors import ParameterError
from ilmek.machines.machine import Machine

NAMES = (
    "automated-loom",
    "weaver",
    "beat-up",
    "cam",
    "shedding",
    "hammer",
    "warp-tension",
    "tufting",
    "knotting-four-bar",
    "knotting-dyad",
    "path-four-bar",
    "motion-four-bar",
    "function-four-bar",
)
"""The machines in the order of the catalogue, each in the package of its name with _ for -."""


class Catalogue(Mapping[str, Machine]):
    """Every machine by its name. A machine's package is read when the machine is asked for: most jobs need one."""

    def __getitem__(self, name: str) -> Machine:
        """The machine of a name; KeyError for any other."""
        if name not in NAMES:
            raise KeyError(name)
        machine = importlib.import_module(f"ilmek.machines.{name.replace('-', '_')}").MACHINE
        assert isinstance(machine, Machine)
        return machine

    def __iter__(self) -> Iterator[str]:
        return iter(NAMES)

    def __len__(self) -> int:
        return len(NAMES)


MACHINES = Catalogue()
"""Every machine by its name, in the order of the catalogue."""


def find_machine(name: str) -> Machine:
    """The machine of a name. Raises ParameterError, naming the nearest."""
    if name in NAMES:
        return MACHINES[name]
    near = difflib.get_close_matches(name.lower().replace("_", "-"), NAMES, n=1)
    hint = f"did you mean {near[0]}?" if near else ""
    raise ParameterError(f"unknown machine {name!r}", allowed=f"machines: {', '.join(NAMES)}", do=hint)
