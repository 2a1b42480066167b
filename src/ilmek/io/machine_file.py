"""Machine files, TOML or JSON: a machine of the catalogue and values of its parameters.

    machine = "beat-up"

    [settings]
    swing = "30deg"
    "strength.pin_diameter" = "8mm"             # of a nested parameter; or a table [settings.strength]

Texts have their units, as on the command line; numbers are SI.
"""

from collections.abc import Mapping
from pathlib import Path

from ilmek.errors import IlmekError, MechanismError, ParameterError, restated
from ilmek.io.data_text import read_data
from ilmek.io.file_entry import FileEntry
from ilmek.io.schema import SourceText
from ilmek.params import Setting
from ilmek.params.parameter import LONGEST_TEXT
from ilmek.records import record

ENDINGS = (".toml", ".json")
"""Endings of a machine file."""


@record
class MachineFile:
    """A machine by its name, and settings of its parameters by name, nested ones by dotted names."""

    machine: str
    settings: Mapping[str, Setting]
    source: SourceText

    def refuse(self, error: IlmekError, name: str = "") -> ParameterError:
        """The error with the file and the line of a setting; "": of the machine."""
        keys = tuple(name.split("."))
        tried = [("settings", *keys), ("settings", name)] if name else [("machine",)]
        path = next((path for path in tried if path in self.source.lines), tried[0])
        try:
            self.source.refuse(path, error)
        except MechanismError as located:
            return ParameterError(located.given, allowed=located.allowed, do=located.do)


def read_machine_file(path: Path) -> MachineFile:
    """The content of a .toml or .json file; whether there is such a machine is not checked.

    Raises ParameterError with the file, the line and the key for any error in the file.
    """
    read = read_data(path, "machine", ParameterError, longest=LONGEST_TEXT)
    source = SourceText(str(path), read.lines)
    with restated(ParameterError, of=MechanismError):
        root = FileEntry(read.data, (), source)
        root.keys("machine", "settings", needs=("machine",))
        settings = dict(root.table("settings").settings())
        return MachineFile(root.text("machine"), settings, source)
