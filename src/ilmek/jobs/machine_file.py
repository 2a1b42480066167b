"""The machine and the settings that a machine file and the command line give together."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from ilmek.errors import IlmekError
from ilmek.io.machine_file import ENDINGS, MachineFile, read_machine_file
from ilmek.machines.catalogue import find_machine
from ilmek.params import Params, Setting, listed


@dataclass(frozen=True, eq=False, slots=True)
class MachineOrder:
    """A machine of the catalogue by its name, the settings of its parameters, and the file that they are from."""

    machine: str
    settings: Mapping[str, Setting]
    file: Path | None = None


def is_machine_file(name: str) -> bool:
    """Whether a name is that of a machine file."""
    return Path(name).suffix.lower() in ENDINGS


def read_machine_order(name: str, settings: Mapping[str, Setting]) -> MachineOrder:
    """The machine and settings of a file, or a machine of the catalogue with the settings.

    settings  win over those of the file
    Raises ParameterError, for an error in the file with the line.
    """
    if not is_machine_file(name):
        return MachineOrder(name, settings)
    file = read_machine_file(Path(name))
    try:
        params = find_machine(file.machine).params
    except IlmekError as error:
        raise file.refuse(error) from None
    _check(file, params)
    names = {parameter.alias: parameter.name for parameter in listed(params) if parameter.alias}
    own = {names.get(key, key): setting for key, setting in file.settings.items()}
    return MachineOrder(
        file.machine, {**own, **{names.get(key, key): setting for key, setting in settings.items()}}, Path(name)
    )


def _check(found: MachineFile, params: type[Params]) -> None:
    """Raise ParameterError with the line of the first setting that cannot be read, else with that of the table."""
    try:
        params.read(found.settings)
    except IlmekError as error:
        for key, setting in found.settings.items():
            try:
                params.read({key: setting})
            except IlmekError as own:
                raise found.refuse(own, key) from None
        raise found.refuse(error, next(iter(found.settings), "")) from None
