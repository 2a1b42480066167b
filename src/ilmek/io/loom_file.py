"""A loom that exists, from the JSON of `design automated-loom --json` or from the machine.json of `weave`.

Read are `machine`, `parameters`, `results`, and the parameters and results of the machines under `machines`; the other
entries of such a file (checks, choices, warnings ...) are known and not used. The whole file is bounded and checked.
"""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from ilmek.errors import IlmekError, LoomError
from ilmek.io.data_text import DataText, read_data
from ilmek.io.line_numbers import Path as KeyPath
from ilmek.io.schema import Table, key_faults, shown
from ilmek.params.parameter import LONGEST_TEXT
from ilmek.records import JsonObject, record

LARGEST = 2_000_000
"""Largest size of a loom file [bytes]; a loom with all its machines has 100,000."""

KNOWN = (
    "machine", "weaves", "buildable", "row_pitch_left", "holds", "reasons", "nearest", "parameters", "results",
    "checks", "self_tests", "choices", "warnings", "machines", "files",
)  # fmt: skip
"""Entries of a loom file, and of each machine in it."""


@record
class LoomFile:
    """The content of a loom file.

    parameters  of the loom, as in the file: numbers in SI, or texts with units
    machines    parameters of each machine in the loom, by its name
    results     of the loom and under their keys of the machines in it; empty where the file has none
    """

    name: str
    parameters: Table
    machines: Mapping[str, Table]
    results: Table


def read_loom_file(path: Path, machine: str) -> LoomFile:
    """The loom in a file; `machine`: its kind. Raises LoomError with the file, and the line where there is one."""
    read = read_data(path, "loom", LoomError, largest=LARGEST, longest=LONGEST_TEXT)
    source = _Source(str(path), read)
    data = source.table(read.data, ())
    for key, fault in key_faults(data, KNOWN, needs=("machine", "parameters")):
        source.refuse((key,) if key else (), fault)
    if data["machine"] != machine:
        source.refuse(("machine",), LoomError(f"{shown(data['machine'])} is no loom", allowed=machine))
    machines = source.table(data.get("machines", {}), ("machines",))
    results = dict(source.table(data.get("results", {}), ("results",)))
    parameters: dict[str, Table] = {}
    for name, inner in machines.items():
        at: KeyPath = ("machines", name)
        for key, fault in key_faults(source.table(inner, at), KNOWN, needs=("parameters",)):
            source.refuse((*at, key) if key else at, fault)
        parameters[name] = source.settings(inner["parameters"], (*at, "parameters"))
        if "results" in inner:
            results[name.replace("-", "_")] = source.table(inner["results"], (*at, "results"))
    return LoomFile(str(path), source.settings(data["parameters"], ("parameters",)), parameters, results)


@record
class _Source:
    """The file and the line of each key, for messages."""

    name: str
    read: DataText

    def refuse(self, path: KeyPath, error: IlmekError) -> None:
        """Raise a LoomError with the file, the line and the key."""
        at = path
        while at and at not in self.read.lines:
            at = at[:-1]
        key = ".".join(map(str, path))
        given = f"{self.name}, line {self.read.lines[at]}{f', {key}' if key else ''}: {error.given}"
        raise LoomError(given, allowed=error.allowed, do=error.do) from None

    def table(self, value: Any, path: KeyPath) -> JsonObject:
        """A table of the file."""
        if not isinstance(value, dict):
            self.refuse(path, LoomError(f"{shown(value)} is not a table"))
        return dict(value)

    def settings(self, value: object, path: KeyPath) -> JsonObject:
        """A table of plain values: numbers, texts, yes or no, null."""
        found = self.table(value, path)
        for key, one in found.items():
            if not (one is None or isinstance(one, bool | int | float | str)):
                self.refuse((*path, key), LoomError(f"{shown(one)} is no value of a parameter"))
        return found
