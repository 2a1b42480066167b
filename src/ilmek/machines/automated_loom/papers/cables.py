"""The cables of a loom: from where to where, wires and their section, length by the route in its tree.

L = a (|dx| + |dy| + |dz| + c) + e      from the middle of the cabinet to the device, a for bends, e in the cabinet;
                                        c the length of the energy chain of what rides on a head
"""

import math
from collections.abc import Iterator, Mapping

import numpy as np

from ilmek.elements.motor_loads import SOLENOID
from ilmek.machines.automated_loom.cabinet import CONTROL
from ilmek.machines.automated_loom.design import LoomDesign
from ilmek.machines.automated_loom.equipment import signals
from ilmek.machines.automated_loom.equipment.terminals import TerminalLevel
from ilmek.machines.automated_loom.in_space.scene import loom_tree
from ilmek.machines.automated_loom.on_rail import CHAIN
from ilmek.machines.automated_loom.papers.wiring import (
    SIGNS,
    brakes,
    connected_at,
    levels_of,
    plan_of,
    safety_signs,
    signs_of,
)
from ilmek.machines.weaver.tree import HEAD
from ilmek.part.insertion_units import standing_parts
from ilmek.part.poses import chains
from ilmek.part.straight_moves import Vector
from ilmek.records import record

SPARE, INSIDE = 0.1, 1.5
"""Share for bends, and length in the cabinet [m]; assumed by this project."""

LEAST_POWER, LEAST_SIGNAL = 0.75, 0.25
"""Least sections of wires of power and of signals outside of enclosures [mm²]: IEC 60204-1, table 5."""

_FEEDBACK = 8
"""Wires of an encoder's cable."""

_LEADS = {1: "+, -, PE", 2: "A+, A-, B+, B-, PE", 3: "U, V, W, PE"}
"""Leads of a motor by its phases."""


@record
class Cable:
    """Cables of a kind: ends, pieces, wires and their section [mm²], whether screened; length of each [m]."""

    start: str
    end: str
    wires: int
    section: float
    screened: bool
    lengths: tuple[float, ...]

    @property
    def words(self) -> str:
        """Wires and section as ordered; S: screened."""
        return f"{self.wires} × {self.section:g} mm²{' S' if self.screened else ''}"


def cables(loom: LoomDesign) -> Iterator[Cable]:
    """Every cable that leaves the cabinet, but that of the mains."""
    plan, far = plan_of(loom), routes(loom)
    of_brakes = {motor: (sign, part) for motor, sign, part in brakes(loom)}
    for motor in plan.motors:
        name, amplifier, load = motor.part.id, f"T{motor.sign[1:]}", motor.load
        section = max(motor.section, LEAST_POWER)
        leads = _LEADS[load.phases]
        yield Cable(f"{amplifier}: {leads}", motor.sign, load.wires, section, load.kind != SOLENOID, far[name])
        if load.kind != SOLENOID:
            yield Cable(f"{amplifier}: X2", motor.sign, _FEEDBACK, LEAST_SIGNAL, True, far[name])
        if name in of_brakes:
            sign, part = of_brakes[name]
            yield Cable(f"{amplifier}: BR+, BR-", sign, 2, LEAST_POWER, False, far[part.id])
    yield from _of_devices(loom, far)


def _of_devices(loom: LoomDesign, far: Mapping[str, tuple[float, ...]]) -> Iterator[Cable]:
    """Cables of encoders and of the strain transducer, of the modules on the heads, and of what is at terminals."""
    at, signs = connected_at(loom), {**SIGNS, **signs_of(loom), **safety_signs(loom)}
    for name in (*signals.ENCODED, signals.TENSION):
        if name in far:
            yield Cable(at[name], signs[name], _FEEDBACK, LEAST_SIGNAL, True, far[name])
    if signals.YARN_INPUTS in far:
        yield Cable(
            SIGNS[signals.CONTROLLER], signs[signals.YARN_INPUTS], _BUS, LEAST_SIGNAL, True, far[signals.YARN_INPUTS]
        )
    levels = dict[str, list[TerminalLevel]]()
    for level in levels_of(loom):
        levels.setdefault(level.part, []).append(level)
    for name, own in levels.items():
        strips = tuple(dict.fromkeys(level.strip for level in own))
        section = LEAST_POWER if strips == ("X2",) else LEAST_SIGNAL
        # Of one piece, or of all in series; a contact of a safety device has two wires.
        contact = len(strips) > 1 and strips[-1] == "X3"
        wires = sum((level.piece <= 1) + (contact and level.piece == 0) for level in own)
        yield Cable(", ".join(strips), signs.get(name, ""), wires, section, False, far[name])


_BUS = 4
"""Wires of the bus of the modules on the heads."""


def routes(loom: LoomDesign) -> dict[str, tuple[float, ...]]:
    """Length of the cable to each piece of a device, by the id of its part [m]."""
    tree = loom_tree(loom)
    ridden = tree.carried_by(HEAD) if loom.heads else frozenset()
    (chain,) = {own.part.purchase for body in tree.bodies for own in body.occurrences if own.part.id == CHAIN} or {None}
    along = 0.0 if chain is None else chain.length
    middles: dict[str, list[tuple[Vector, float]]] = {}
    for links in chains(tree):
        extra = along if links[-1].body.id in ridden else 0.0
        for piece in standing_parts(links):
            if piece.part.purchase is not None:
                middles.setdefault(piece.part.id, []).append((np.mean(piece.box, axis=0), extra))
    ((cabinet, _),) = middles[CONTROL]
    wired = {own.part.id for own in plan_of(loom).motors} | {part.id for *_, part in brakes(loom)} | set(signs_of(loom))
    wired |= {signals.YARN_INPUTS, *(level.part for level in levels_of(loom))}
    return {
        name: tuple((1 + SPARE) * (math.fsum(np.abs(own - cabinet).tolist()) + extra) + INSIDE for own, extra in ends)
        for name, ends in middles.items()
        if name in wired
    }
