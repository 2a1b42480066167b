"""Mechanisms as TOML or JSON: the same keys, the same schema (`ilmek.data/mechanism.schema.json`).

    name = "needle drive"

    [bodies.ground]
    points = { O = [0, 0], guide = ["80mm", 0] }

    [bodies.crank]
    points = { O = [0, 0], A = ["40mm", 0] }
    mass = "0.2kg"                              # with centre and moment, for dynamics

    [joints]
    O = { pin = ["ground", "crank"] }
    guide = { slide = ["needle", "ground"], along = "-90deg" }

    [inputs]
    O = "crank"                                 # the joint that is driven, and the body that it turns

    [branches]
    B = 1

Numbers are SI and radians; text has its unit. Written files are read again without loss: every number to its last bit,
every name, every order.
"""

import json
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field
from functools import lru_cache
from importlib import resources
from pathlib import Path
from typing import Any

from ilmek.dynamics.inertia import Inertia
from ilmek.dynamics.own_machine import OwnMachine
from ilmek.errors import IlmekError, MechanismError
from ilmek.io.data_text import DataText, parse_data, read_data
from ilmek.io.output import write_file
from ilmek.io.schema import Reader, Schema, SourceText
from ilmek.io.toml_text import toml_text
from ilmek.linkage.model import (
    GROUND,
    KINDS,
    Body,
    Coupling,
    Displacement,
    Input,
    Joint,
    Mechanism,
    Pin,
    Rotation,
    Slide,
)
from ilmek.linkage.structure import Plan, plan
from ilmek.records import brief

MOST_ENTRIES = 100
"""Largest number of bodies, of joints and of couplings of a file."""


@dataclass(frozen=True, slots=True)
class MechanismFile:
    """Contents of a file: the mechanism with its masses, loads, drive, members and task."""

    machine: OwnMachine
    source: SourceText = field(default_factory=lambda: SourceText("mechanism", {(): 1}), compare=False, repr=False)

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

    def plan(self) -> Plan:
        """The mechanism's plan. Raises MechanismError with the file, the line and the key if it cannot be solved."""
        with _located(self.source):
            return plan(self.mechanism)


def read_mechanism(path: Path) -> MechanismFile:
    """The mechanism of a .toml or .json file.

    Raises MechanismError with the file, the line and the key for any error in the file.
    """
    return _read(read_data(path, "mechanism", MechanismError), str(path))


def parse_mechanism(text: str, *, name: str = "mechanism", toml: bool = True) -> MechanismFile:
    """The mechanism of a TOML or JSON text; messages call it `name`. Raises as `read_mechanism`."""
    return _read(parse_data(text, name=name, toml=toml, error=MechanismError), name)


def _read(text: DataText, name: str) -> MechanismFile:
    source = SourceText(name, text.lines)
    data = Reader(schema(), source).read(text.data)
    for key in ("bodies", "joints", "couplings"):
        if len(data.get(key, ())) > MOST_ENTRIES:
            given = f"has {len(data[key])} {key}"
            source.refuse((key,), MechanismError(given, allowed=f"at most {MOST_ENTRIES}"))
    return _built(data, source)


def write_mechanism(path: Path, mechanism: Mechanism, inertias: Mapping[str, Inertia] | None = None) -> None:
    """Write a .toml or .json file. Raises OutputError; MechanismError for another suffix."""
    writers = {".toml": mechanism_toml, ".json": mechanism_json}
    writer = writers.get(path.suffix.lower())
    if writer is None:
        raise MechanismError(f"mechanism file {path} ends in {path.suffix!r}", allowed=".toml or .json")
    write_file(path, writer(mechanism, inertias or {}))


def mechanism_toml(mechanism: Mechanism, inertias: Mapping[str, Inertia]) -> str:
    """The mechanism as TOML text."""
    return toml_text(_data(mechanism, inertias))


def mechanism_json(mechanism: Mechanism, inertias: Mapping[str, Inertia]) -> str:
    """The mechanism as JSON text."""
    return json.dumps(_data(mechanism, inertias), indent=2, ensure_ascii=False, allow_nan=False) + "\n"


@lru_cache(maxsize=1)
def schema() -> Schema:
    """The JSON schema of both kinds of file."""
    text = resources.files("ilmek.data").joinpath("mechanism.schema.json").read_text(encoding="utf-8")
    found: Schema = json.loads(text)
    return found


@contextmanager
def _located(source: SourceText, *path: str) -> Iterator[None]:
    """Add the line of the entry that an error concerns, or of `path`, to errors raised inside."""
    try:
        yield
    except IlmekError as error:
        source.refuse(getattr(error, "about", ()) or path, error)


def _built(data: Mapping[str, Any], source: SourceText) -> MechanismFile:
    """The records from data that satisfy the schema."""
    bodies, inertias = [], {}
    for name, table in data["bodies"].items():
        with _located(source, "bodies", name):
            bodies.append(Body(name, {point: complex(*at) for point, at in table["points"].items()}))
            if table.keys() & {"mass", "centre", "moment"}:
                centre = complex(*table.get("centre", (0, 0)))
                inertias[name] = Inertia(table.get("mass", 0.0), centre, table.get("moment", 0.0))
    joints = tuple(_joint(name, table) for name, table in data["joints"].items())
    sliding = {joint.name for joint in joints if isinstance(joint, Slide)}
    with _located(source):
        mechanism = Mechanism(
            bodies=tuple(bodies),
            joints=joints,
            inputs=tuple(_input(name, body, name in sliding) for name, body in data["inputs"].items()),
            branches=data.get("branches", {}),
            name=data.get("name", "mechanism"),
            couplings=tuple(_coupling(name, table) for name, table in data.get("couplings", {}).items()),
            pose={body: (complex(*pose["origin"]), pose["angle"]) for body, pose in data.get("pose", {}).items()},
        )
        for entry in mechanism.inputs:
            _check_driven(mechanism, entry, data["inputs"][entry.joint])
    return MechanismFile(OwnMachine(mechanism, inertias), source)


def _joint(name: str, table: Mapping[str, Any]) -> Joint:
    if "pin" in table:
        first, second = table["pin"]
        return Pin(name, first, second)
    body, guide = table["slide"]
    return Slide(name, body, guide, along=table.get("along", 0.0), turned=table.get("turned", 0.0))


def _coupling(name: str, table: Mapping[str, Any]) -> Coupling:
    kind = next(kind for kind in KINDS if kind in table)
    first, second = (tuple(end) for end in table[kind])
    carrier = table.get("carrier", GROUND)
    return Coupling(name, kind, first, second, table["ratio"], table["first_at"], table["second_at"], carrier)


def _input(joint: str, body: str, slides: bool) -> Input:
    return Displacement(joint) if slides else Rotation(body, joint)


def _check_driven(mechanism: Mechanism, entry: Input, body: str) -> None:
    """Raise MechanismError if an input at a slide names another body than the sliding one."""
    joint = mechanism.joint(entry.joint)
    if isinstance(joint, Slide) and body != joint.body:
        given = f"slide {joint.name!r} is driven by {body!r}"
        raise MechanismError(given, allowed=f"its sliding body is {joint.body!r}", about=("inputs", joint.name))


def _data(mechanism: Mechanism, inertias: Mapping[str, Inertia]) -> dict[str, Any]:
    """The records as data that satisfy the schema."""
    joined = {entry.joint: _driven(mechanism, entry) for entry in mechanism.inputs}
    data: dict[str, Any] = {
        "name": mechanism.name,
        "bodies": {body.name: _body_data(body, inertias.get(body.name)) for body in mechanism.bodies},
        "joints": {joint.name: _joint_data(joint) for joint in mechanism.joints},
        "couplings": {coupling.name: _coupling_data(coupling) for coupling in mechanism.couplings},
        "inputs": joined,
        "branches": dict(mechanism.branches),
        "pose": {body: {"origin": _xy(at), "angle": float(angle)} for body, (at, angle) in mechanism.pose.items()},
    }
    return {key: value for key, value in data.items() if value != {} or key in schema()["required"]}


def _driven(mechanism: Mechanism, entry: Input) -> str:
    joint = mechanism.joint(entry.joint)
    return joint.body if isinstance(joint, Slide) else entry.name


def _body_data(body: Body, inertia: Inertia | None) -> dict[str, Any]:
    data: dict[str, Any] = {"points": {name: _xy(point) for name, point in body.points.items()}}
    if inertia is not None:
        data |= {"mass": float(inertia.mass), "centre": _xy(inertia.centre), "moment": float(inertia.moment)}
    return data


def _joint_data(joint: Joint) -> dict[str, Any]:
    if isinstance(joint, Pin):
        return {"pin": list(joint.bodies)}
    return {"slide": list(joint.bodies), "along": float(joint.along), "turned": float(joint.turned)}


def _coupling_data(one: Coupling) -> dict[str, Any]:
    numbers = {name: float(getattr(one, name)) for name in ("ratio", "first_at", "second_at")}
    return {one.kind: [list(one.first), list(one.second)], "carrier": one.carrier, **numbers}


def _xy(point: complex) -> list[float]:
    return [float(point.real), float(point.imag)]
