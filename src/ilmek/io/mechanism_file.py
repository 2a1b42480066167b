"""Mechanism files, TOML or JSON: a whole machine with the same keys (`ilmek.io.mechanism.machine.FILE`).

    name = "slider-crank"
    gravity = "9.81m/s^2"

    [values]
    r = "40mm"

    [bodies]
    ground.points = { O = [0, 0], guide = [0, 0] }
    crank.length = "r"                          # from its first joint, at the origin, to its second, on x
    rod = { length = "3.5 r", mass = "0.4kg" }
    ram = {}                                    # a block: all its joints at its origin

    [joints]
    O.pin = ["ground", "crank"]
    A.pin = ["crank", "rod"]
    B.pin = ["rod", "ram"]
    guide = { slide = ["ram", "ground"], along = "0deg" }

    [inputs]
    O = "crank"                                 # the joint that is driven, and the body that it turns

    [branches]
    B = 1

Every quantity has its unit; 0 needs none. Written files are read again without loss: every number to its last bit,
every name, every order.
"""

import json
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from importlib import import_module
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

from ilmek.dynamics.inertia import Inertia
from ilmek.dynamics.own_machine import OwnMachine
from ilmek.errors import MechanismError, did_you_mean
from ilmek.io.data_text import DataText, parse_data, plain_data, read_data
from ilmek.io.declared import EntryReader
from ilmek.io.mechanism.expressions import printed_dimension
from ilmek.io.mechanism.machine import FILE, machine_data, machine_of
from ilmek.io.mechanism.values import named_values
from ilmek.io.output import write_file
from ilmek.io.schema import SourceText
from ilmek.io.toml_text import toml_text
from ilmek.linkage.model import Mechanism
from ilmek.linkage.structure import Plan, plan
from ilmek.records import JsonObject, brief

if TYPE_CHECKING:
    from ilmek.dynamics.machine_variants import MachineVariants


@dataclass(frozen=True, slots=True)
class MechanismFile:
    """Contents of a file: the mechanism with its masses, loads, drive, members and task.

    text  of a TOML file, with its comments; "" for JSON      data  plain, as read; empty for a machine made in Python
    """

    machine: OwnMachine
    source: SourceText = field(default_factory=lambda: SourceText("mechanism", {(): 1}), compare=False, repr=False)
    text: str = field(default="", compare=False, repr=False)
    data: Mapping[str, Any] = field(default_factory=dict, compare=False, repr=False)

    def __hash__(self) -> int:
        return hash((self.mechanism, tuple(self.inertias)))

    @property
    def mechanism(self) -> Mechanism:
        """The mechanism."""
        return self.machine.mechanism

    @property
    def inertias(self) -> Mapping[str, Inertia]:
        """Inertias of those bodies that have some."""
        return self.machine.inertias

    def __repr__(self) -> str:
        return brief(self)

    def vary(self, **values: Any) -> "MachineVariants":
        """Variants of it: entries of the file's table `values` as arrays [SI], which broadcast.

        Raises MechanismError for a name that the file does not have, and for a variant that cannot be read.
        """
        varied = import_module("ilmek.dynamics.machine_variants").varied_machines  # the compiler
        units = {name: value_of(self.data, name)[1] for name in values}

        def machine(row: Mapping[str, float]) -> OwnMachine:
            return _read(DataText(with_values(self.data, stated(row, units)), {}, ""), "mechanism").machine

        variants: MachineVariants = varied(values, units, machine)
        return variants

    def plan(self) -> Plan:
        """The mechanism's plan. Raises MechanismError with the file, the line and the key if it cannot be solved."""
        with self.source.located():
            return plan(self.mechanism)


def read_mechanism(path: Path, values: Mapping[str, str | float] = MappingProxyType({})) -> MechanismFile:
    """The mechanism of a .toml or .json file.

    values  take the place of entries of its table `values`: texts as in the file
    Raises MechanismError with the file, the line and the key for any error in the file, and for a value that it does
    not have.
    """
    text = read_data(path, "mechanism", MechanismError)
    return _read(text._replace(data=with_values(text.data, values)) if values else text, str(path))


def with_values(data: Any, values: Mapping[str, object]) -> JsonObject:
    """Data of a file with other entries in its table `values`. Raises MechanismError, naming the nearest."""
    known = data.get("values", {}) if isinstance(data, Mapping) else {}
    for name in values:
        if name not in known:
            near = did_you_mean(name, known, otherwise=f"its values: {', '.join(known) or 'none'}")
            raise MechanismError(f"unknown value {name!r} of the mechanism", do=near)
    return {**data, "values": {**known, **values}}


def value_of(data: Any, name: str) -> tuple[float, str]:
    """An entry of the table `values` [SI] and its SI unit. Raises MechanismError, naming the nearest."""
    values = with_values(data, {name: data.get("values", {}).get(name)})["values"]
    amount = named_values(values, SourceText("mechanism", {(): 1}), si=data.get("units") == "SI").known[name]
    unit = printed_dimension(amount.dimension)
    return amount.value, "" if unit == "a plain number" else unit


def mechanism_of_values(data: Any, values: Mapping[str, object]) -> MechanismFile:
    """The mechanism of plain data with other values [SI]. Raises MechanismError with the key."""
    return mechanism_of_data(with_values(data, stated(values, {name: value_of(data, name)[1] for name in values})))


def stated(values: Mapping[str, object], units: Mapping[str, str]) -> dict[str, str]:
    """Values [SI] as texts with their units."""
    return {name: f"{value!r} {units[name]}".strip() for name, value in values.items()}


def parse_mechanism(text: str, *, name: str = "mechanism", toml: bool = True) -> MechanismFile:
    """The mechanism of a TOML or JSON text; messages call it `name`. Raises as `read_mechanism`."""
    return _read(parse_data(text, name=name, toml=toml, error=MechanismError), name)


def mechanism_of_data(data: Mapping[str, object]) -> MechanismFile:
    """The mechanism of the plain data of a file, as `tomllib` or `json` reads them.

    Raises MechanismError with the key.
    """
    return _read(DataText(plain_data(data, "mechanism", MechanismError), {}, ""), "mechanism")


def _read(text: DataText, name: str) -> MechanismFile:
    source = SourceText(name, text.lines)
    data = whole = text.data
    if isinstance(data, Mapping):
        values = named_values(data.get("values", {}), source, si=data.get("units") == "SI")
        data = {key: value for key, value in data.items() if key != "values"}
    else:
        values = named_values({}, source, si=False)
    checked = FILE.read(data, EntryReader(source, values.quantity))
    return MechanismFile(machine_of(checked, source), source, text.text, whole)


def schema() -> JsonObject:
    """The JSON Schema of both kinds of file."""
    definitions: JsonObject = {}
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "$id": "https://ilmek.invalid/mechanism.schema.json",
        "title": "Mechanism file",
        **FILE.schema(definitions),
        "$defs": definitions,
    }


def write_mechanism(path: Path, machine: OwnMachine) -> None:
    """Write a .toml or .json file. Raises OutputError; MechanismError for another suffix."""
    write_file(path, writer_for(path)(machine))


def writer_for(path: Path) -> Callable[[OwnMachine], str]:
    """The writer of a file's ending. Raises MechanismError for another than .toml and .json."""
    writers = {".toml": mechanism_toml, ".json": mechanism_json}
    writer = writers.get(path.suffix.lower())
    if writer is None:
        raise MechanismError(f"mechanism file {path} ends in {path.suffix!r}", allowed=".toml or .json")
    return writer


def data_of_mechanism(machine: OwnMachine, *, si: bool) -> JsonObject:
    """The plain data of a file; with `si` plain numbers in SI, else texts with units. Raises as `mechanism_toml`."""
    data = FILE.write(machine_data(machine), si=si)
    return {"units": "SI", **data} if si else data


def mechanism_toml(machine: OwnMachine) -> str:
    """The machine as TOML text, quantities with their units. Raises MechanismError for a load without a file form."""
    return toml_text(data_of_mechanism(machine, si=False))


def mechanism_json(machine: OwnMachine) -> str:
    """The machine as JSON text, numbers in SI. Raises MechanismError for a load without a file form."""
    return json.dumps(data_of_mechanism(machine, si=True), indent=2, ensure_ascii=False, allow_nan=False) + "\n"
