"""The part of an unfinished mechanism that can be computed: bodies that are joined, and groups that are determined."""

import dataclasses
from typing import Any

from ilmek.dynamics.own_machine import OwnMachine
from ilmek.errors import IlmekError
from ilmek.io.declared import TableEntry
from ilmek.io.mechanism.joints import members_of
from ilmek.io.mechanism.machine import FILE
from ilmek.io.mechanism_file import mechanism_of_data
from ilmek.io.schema import LocatedError, Table
from ilmek.linkage.branches_in_pose import Pose, branches_in_pose, required_branches
from ilmek.linkage.groups.group import Step
from ilmek.linkage.model import GROUND, Mechanism
from ilmek.linkage.structure import solvable_steps
from ilmek.records import JsonObject

_NAMED = {key: entry.refers for key, entry in FILE.entries.items() if isinstance(entry, TableEntry)}
"""Table of the file -> what its keys are the names of."""


def joined_part(data: Table) -> tuple[JsonObject, tuple[str, ...]]:
    """The data of a file without the bodies that no joint holds, and the names of these.

    What refers to such a body is left out with it. Keys that an empty drawing lacks are added.
    """
    joints, tables = _table(data, "joints"), _table(data, "bodies")
    given = {**data, "bodies": {GROUND: {}, **tables}, "joints": joints, "inputs": data.get("inputs", {})}
    if not all(
        isinstance(table, dict) and isinstance(table.get("pin") or table.get("slide") or table.get("slot"), list)
        for table in joints.values()
    ):
        return given, ()
    held = {body for bodies in members_of(joints).values() for body in bodies if isinstance(body, str)} | {GROUND}
    loose = tuple(body for body in given["bodies"] if body not in held)
    if not loose:
        return given, ()
    given["bodies"] = {body: table for body, table in given["bodies"].items() if body in held}
    for key in _NAMED.keys() & given.keys() - {"bodies", "joints", "inputs", "values"}:
        if isinstance(given[key], dict):
            gone = loose if _NAMED[key] in ("body", "input") else ()
            given[key] = {
                name: entry for name, entry in given[key].items() if name not in gone and not _names(entry, loose)
            }
    if isinstance(given.get("paths"), list):
        given["paths"] = [entry for entry in given["paths"] if not _names(entry, loose)]
    return {key: value for key, value in given.items() if value != {} or key in ("bodies", "joints", "inputs")}, loose


MOST_LEFT_OUT = 20
"""Largest number of wrong entries of a file that are left out to draw the rest."""


def is_unfinished(data: Table) -> bool:
    """Whether a mechanism file can be read as far as its bodies are joined: what is missing is named by the drawing."""
    try:
        mechanism_of_data(joined_part(data)[0])
    except IlmekError:
        return False
    return True


def sound_part(data: Table) -> JsonObject | None:
    """The data of a file without the entries that cannot be read; None where too much is wrong."""
    rest: JsonObject | None = dict(data)
    for _ in range(MOST_LEFT_OUT):
        if rest is None:
            return None
        try:
            mechanism_of_data(joined_part(rest)[0])
        except LocatedError as error:
            rest = _without(rest, error.path)
        except IlmekError:
            return None
        else:
            return rest
    return None


def _without(data: JsonObject, path: tuple[str | int, ...]) -> JsonObject | None:
    """Data without the body, the joint or another entry at a path, and without the joints that a body has."""
    table = _table(data, str(path[0])) if path else {}
    if not path or path[0] not in data:
        return None
    if len(path) == 1 or path[1] not in table:
        return {key: value for key, value in data.items() if key != path[0]}
    name = str(path[1])
    if path[0] == "bodies" and name == GROUND:  # its lengths may be right
        return {**data, "confirm": ["lengths"]} if "confirm" not in data else None
    made = {**data, path[0]: {key: value for key, value in table.items() if key != name}}
    if path[0] == "bodies":
        held = {joint: _without_body(entry, name) for joint, entry in _table(data, "joints").items()}
        made["joints"] = {joint: entry for joint, entry in held.items() if entry is not None}
    joints = _table(made, "joints")
    made["bodies"] = {
        body: _with_ends(body, entry, _table(data, "joints"), joints) for body, entry in _table(made, "bodies").items()
    }
    for key in made.keys() - {"joints"}:
        if _NAMED.get(key) == "joint":
            own = _table(made, key).items()
            made[key] = {joint: value for joint, value in own if joint in joints and value != name}
    return made


def _with_ends(body: str, table: Any, before: JsonObject, after: JsonObject) -> Any:
    """A body whose length was between two joints, with their names where one of them is gone."""
    if not isinstance(table, dict) or "length" not in table or "between" in table:
        return table
    own = [name for name, joint in before.items() if _names(joint, (body,)) and name not in table.get("points", {})]
    kept = all(name in after and _names(after[name], (body,)) for name in own)
    return table if kept or len(own) != 2 else {**table, "between": own}


def _without_body(joint: Any, body: str) -> Any | None:
    """A joint without a body; None where fewer than two are left."""
    if not isinstance(joint, dict) or not _names(joint, (body,)):
        return joint
    left = [one for one in joint.get("pin", ()) if one != body]
    return {**joint, "pin": left} if len(left) > 1 else None


def loose_points(data: Table, body: str) -> dict[str, tuple[float, float]]:
    """The points of a body without a joint [m]; none where they cannot be read, or follow from its joints alone.

    It is read as if its first point were pinned to the ground.
    """
    table = _table(data, "bodies")[body]
    own = {key: table[key] for key in ("points", "length", "between") if key in table}
    first = next(iter([*table.get("between", ()), *table.get("points", {})]), None)
    if first is None:
        return {}
    alone = {
        "bodies": {GROUND: {"points": {first: [0, 0]}}, body: own},
        "joints": {first: {"pin": [GROUND, body]}},
        "inputs": {},
        **{key: data[key] for key in ("values", "units") if key in data},
    }
    try:
        points = mechanism_of_data(alone).mechanism.body(body).points
    except IlmekError:
        return {}
    return {name: (at.real, at.imag) for name, at in points.items()}


def _table(data: Table, key: str) -> JsonObject:
    """A table of the file; empty if it is missing or no table, which the reader of the file reports."""
    found = data.get(key)
    return found if isinstance(found, dict) else {}


def _names(entry: object, bodies: tuple[str, ...]) -> bool:
    """Whether an entry names one of the bodies, or one of their points, "body.point"."""
    inner = entry.values() if isinstance(entry, dict) else entry if isinstance(entry, list) else ()
    return entry.partition(".")[0] in bodies if isinstance(entry, str) else any(_names(one, bodies) for one in inner)


def solved_part(mechanism: Mechanism, steps: tuple[Step, ...]) -> Mechanism:
    """The mechanism of the bodies that some steps locate."""
    bodies = {GROUND, *(body for step in steps for body in step.bodies)}
    if len(bodies) == len(mechanism.bodies):
        return mechanism
    joints = tuple(joint for joint in mechanism.joints if set(joint.bodies) <= bodies)
    names = {joint.name for joint in joints}
    return dataclasses.replace(
        mechanism,
        bodies=tuple(body for body in mechanism.bodies if body.name in bodies),
        joints=joints,
        inputs=tuple(entry for entry in mechanism.inputs if entry.joint in names),
        branches={name: sign for name, sign in mechanism.branches.items() if name in names},
        pose={body: pose for body, pose in mechanism.pose.items() if body in bodies},
        couplings=tuple(coupling for coupling in mechanism.couplings if set(coupling.bodies) <= bodies),
    )


def machine_of_part(machine: OwnMachine, part: Mechanism) -> OwnMachine:
    """A machine of a part: its motion only, as loads and masses belong to the whole."""
    if part is machine.mechanism:
        return machine
    inputs = {entry.name for entry in part.inputs}
    return OwnMachine(part, motions={name: motion for name, motion in machine.motions.items() if name in inputs})


def drawn_branches(mechanism: Mechanism, pose: Pose) -> dict[str, int]:
    """The signs of branches that the mechanism lacks, as its bodies show them in a pose.

    pose  of bodies; default of one that is not listed: that of the mechanism, or as drawn
    """
    lacking = tuple(name for name in required_branches(mechanism) if name not in mechanism.branches)
    return signs_in_pose(mechanism, pose, lacking) if lacking else {}


def signs_in_pose(mechanism: Mechanism, pose: Pose, names: tuple[str, ...]) -> dict[str, int]:
    """The signs of some branches, as the bodies show them in a pose; of the part that can be solved."""
    every = dataclasses.replace(mechanism, branches=dict.fromkeys(names, +1) | dict(mechanism.branches))
    part = solved_part(every, solvable_steps(every)[0])
    inside = {joint.name for joint in part.joints}
    known = {body: one for body, one in {**mechanism.pose, **pose}.items() if body in part.moving}
    return branches_in_pose(part, known, tuple(name for name in names if name in inside))
