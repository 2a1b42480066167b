"""Rates of stops from a file: a table of the parameters of `loom.twin.faults.StopParams`, TOML or JSON.

gripper_miss = 0.001
response = "90s"
pile_break = "0.2/km"
"""

from collections.abc import Mapping
from pathlib import Path

from ilmek.errors import IlmekError, LoomError
from ilmek.io.data_text import read_data
from ilmek.io.schema import shown
from ilmek.loom.twin.faults import StopParams
from ilmek.params import Setting


def read_stops(path: Path | None, settings: Mapping[str, Setting]) -> StopParams:
    """Stops from a file, if there is one, and settings, which replace those of the file.

    Raises ParameterError, UnitError, LoomError.
    """
    return StopParams.read({**({} if path is None else read_stops_file(path)), **settings})


def read_stops_file(path: Path) -> dict[str, Setting]:
    """The settings in a file, each of which `StopParams` accepts. Raises LoomError with the file and the line."""
    read = read_data(path, "stops", LoomError)
    if not isinstance(read.data, dict):
        raise LoomError(f"{path}: {shown(read.data)} is not a table", do="write NAME = VALUE")
    found: dict[str, Setting] = {}
    for name, value in read.data.items():
        try:
            if not (value is None or isinstance(value, bool | int | float | str)):
                raise LoomError(f"{name}: {shown(value)} is no value of a parameter")
            StopParams.read({name: value})
        except IlmekError as error:
            line = read.lines.get((name,), 1)
            raise LoomError(f"{path}, line {line}: {error.given}", allowed=error.allowed, do=error.do) from None
        found[name] = value
    return found
