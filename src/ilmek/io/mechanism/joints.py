"""Joints of a mechanism file. A pin of several bodies becomes pins of two bodies each, a pin in a slot one of a block.

All pins of one point are attached to the body that is located first, outward from the ground and the inputs: so each
dyad keeps its closed form. The first of these pins has the joint's name, the others `NAME.BODY`.

>>> [pin.name for pin in joints_of({"M": {"pin": ["crank", "rod", "link"]}}, {}, {})]
['M', 'M.link']
"""

from collections.abc import Iterator, Mapping
from dataclasses import replace
from itertools import combinations

from ilmek.io.declared import ListEntry, TextEntry, keys, variant
from ilmek.io.mechanism.names import ANGLE, two_names
from ilmek.io.schema import Table
from ilmek.linkage.model import GROUND, KINDS, Body, Joint, Pin, Slide

_BODIES = "the bodies that the pin joins: two or more; of two: branch +1 is on the left of first to second"
_ALONG = replace(ANGLE, doc="direction of the line in the guide's frame; default: 0")

JOINT = variant(
    keys({"pin": ListEntry(_BODIES, TextEntry("", "body"), 2, 10)}),
    keys(
        {"slide": two_names("the sliding body and its guide", "body")},
        {"along": _ALONG, "turned": replace(ANGLE, doc="the sliding body against the guide; default: 0")},
    ),
    keys(
        {"slot": two_names("the body with the pin and the body with the slot", "body")},
        {"along": replace(ANGLE, doc="direction of the slot's line in the frame of its body; default: 0")},
    ),
    name="joint",
)

Members = Mapping[str, tuple[str, ...]]
"""Joint -> its bodies, two or more."""


def members_of(tables: Table) -> Members:
    """The bodies of each joint of the file."""
    return {name: tuple(table.get("pin") or table.get("slot") or table["slide"]) for name, table in tables.items()}


def blocks_of(tables: Table, points: Mapping[str, Mapping[str, complex]]) -> Iterator[Body]:
    """The massless blocks of all slots: in the frame of the pin's body, which is that of the drawing.

    points  body -> name -> position in its frame [m]
    """
    for name, table in tables.items():
        if "slot" in table:
            at = points[table["slot"][0]][name]
            yield Body(f"{name}.block", {name: at, f"{name}.slot": at})


def joints_of(tables: Table, inputs: Mapping[str, str], couplings: Table) -> tuple[Joint, ...]:
    """The joints of the file, each of two bodies.

    tables, inputs, couplings  as in the file, checked by the schema
    """
    members = members_of(tables)
    several = any(len(bodies) > 2 for bodies in members.values())
    rank = _ranks(members, inputs, couplings) if several else {}
    return tuple(joint for name, table in tables.items() for joint in _joints(name, table, rank))


def _joints(name: str, table: Table, rank: Mapping[str, int]) -> Iterator[Joint]:
    if "slide" in table:
        body, guide = table["slide"]
        yield Slide(name, body, guide, along=table.get("along", 0.0), turned=table.get("turned", 0.0))
        return
    if "slot" in table:
        body, slotted = table["slot"]
        yield Pin(name, body, f"{name}.block")
        yield Slide(f"{name}.slot", f"{name}.block", slotted, along=table.get("along", 0.0))
        return
    bodies = table["pin"]
    if len(bodies) == 2:
        yield Pin(name, *bodies)
        return
    order = sorted(bodies, key=lambda body: (rank.get(body, len(rank)), bodies.index(body)))
    first, *others = order
    for number, other in enumerate(others):
        pair = sorted((first, other), key=bodies.index)
        yield Pin(name if number == 0 else f"{name}.{other}", *pair)


def joint_data(joint: Joint) -> Table:
    """The table of a joint of two bodies."""
    if isinstance(joint, Pin):
        return {"pin": list(joint.bodies)}
    return {"slide": list(joint.bodies), "along": float(joint.along), "turned": float(joint.turned)}


def _ranks(members: Members, inputs: Mapping[str, str], couplings: Table) -> dict[str, int]:
    """Body -> number of the step in which it is located: driven bodies, wheels and dyads, outward from the ground."""
    known = {GROUND: 0}
    while True:
        found = _driven(known, members, inputs) or _geared(known, couplings) or _dyad(known, members)
        if not found:
            return known
        step = max(known.values()) + 1
        known |= dict.fromkeys(found, step)


def _driven(known: Mapping[str, int], members: Members, inputs: Mapping[str, str]) -> tuple[str, ...]:
    for joint, body in inputs.items():
        bodies = members.get(joint, ())
        if body in bodies and body not in known and known.keys() & set(bodies):
            return (body,)
    return ()


def _geared(known: Mapping[str, int], couplings: Table) -> tuple[str, ...]:
    for table in couplings.values():
        kind = next(kind for kind in KINDS if kind in table)
        bodies = {table[kind][0][0], table[kind][1][0], table.get("carrier", GROUND)}
        left = tuple(body for body in bodies if body not in known)
        if len(left) == 1:
            return left
    return ()


def _dyad(known: Mapping[str, int], members: Members) -> tuple[str, ...]:
    """Two bodies with a joint between them, each with another joint to a known body."""
    attached: dict[str, set[str]] = {}
    for joint, bodies in members.items():
        if known.keys() & set(bodies):
            for body in bodies:
                attached.setdefault(body, set()).add(joint)
    for joint, bodies in members.items():
        if known.keys() & set(bodies):
            continue
        for pair in combinations(bodies, 2):
            if all(attached.get(body, set()) - {joint} and body not in known for body in pair):
                return pair
    return ()
