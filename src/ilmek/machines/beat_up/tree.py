"""The beat-up as a tree of bodies: crank-rockers on what carries them, the travelling beater on its rocker.

Axes are those of the linkage: D the origin, A on x, z along the pins, 0 in the middle of crank and rocker. Bodies lie
at rest as at the beat; motions are counted from there.
"""

import cmath
import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import lru_cache

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.linkage.solve import solve
from ilmek.machines.beat_up.beater import Beater
from ilmek.machines.beat_up.crank_start import start_parts
from ilmek.machines.beat_up.design import BeatUp
from ilmek.machines.beat_up.links import PART_IDS, pin_length
from ilmek.machines.beat_up.parts import link_parts, pin_part
from ilmek.machines.beat_up.travel import AXIS_SIDE, travel_parts
from ilmek.machines.beat_up.use import BeatUpUse, in_use
from ilmek.machines.link_tree import GAP, JOURNAL
from ilmek.part.link_motion import carriers
from ilmek.part.link_motion import link_motions as motions_of
from ilmek.part.part import Part
from ilmek.part.placement import Placement, placement
from ilmek.part.tree import Joint, JointKind, Occurrence, RigidBody, Tree, in_line
from ilmek.report.scene import SceneMotion

CARRIAGE = "beat-up/carriage"
"""Body that carries crank and rocker."""

_Z = (0.0, 0.0, 1.0)


@lru_cache(maxsize=8)
def tree(design: BeatUp) -> Tree:
    """The bodies of a beat-up as it is used by itself, at the beat in the middle of the carpet."""
    return travelling(design, in_use(design))


def travelling(
    design: BeatUp, use: BeatUpUse, motions: Mapping[str, SceneMotion] | None = None, start: float = 0.0
) -> Tree:
    """The bodies of a beater that travels on its slide.

    motions  of the bodies by their ids, of `link_motions` and of the carriage along z
    start    of the carriage from the middle of the carpet along z [m]
    """
    across, begin = travel_parts(use.travel), -_clear(design)
    axis, length = across[0], use.travel.cloth.width
    below = -design.params.width - AXIS_SIDE
    rail = RigidBody(
        "beat-up/rail",
        (
            Occurrence(axis, (placement(y=below, z=-length / 2),)),
            *(_moved(one, y=below) for one in in_line(across[1:], -length / 2)),
        ),
        joint=Joint(JointKind.MISSING),
    )
    carriage = RigidBody(
        CARRIAGE,
        (*_fixed_pins(design, [0.0]), *in_line(start_parts(use.start), begin)),
        rail.id,
        Joint(JointKind.SLIDE, _Z),
        (placement(z=start),),
    )
    bodies = Tree((rail, carriage, *crank_rockers(design, CARRIAGE, beater=use.travel.beater)))
    return bodies.moving(motions or {})


def crank_rockers(
    design: BeatUp, parent: str, stations: Sequence[float] = (0.0,), *, beater: Beater | None = None
) -> tuple[RigidBody, ...]:
    """Cranks, couplers and rockers at stations along z [m], on a body with the linkage's axes.

    beater  on the rocker, where there is one
    """
    links, pin, lengths = link_parts(design), pin_part(design), design.lengths
    thick = design.params.thickness
    motion = solve(design.plan, np.array([design.beta]))
    coupler, beside = float(motion.angle("coupler")[0]) - design.beta, (1 + GAP) * thick
    struck = () if beater is None else tuple(on_rocker(one, lengths["beater"]) for one in beater.occurrences)
    flat = placement(z=-thick / 2)

    def body(link: str, on: str, joined: str, positions: Sequence[Placement], *others: Occurrence) -> RigidBody:
        part = links[link]
        seats = (f"{part.id}:{joined}", f"{pin.id}:{JOURNAL}")
        return RigidBody(
            part.id, (Occurrence(part, (flat,)), *others), on, Joint(JointKind.PIN, _Z, seats=seats), tuple(positions)
        )

    def carried(length: str) -> Occurrence:
        return Occurrence(pin, (placement(x=lengths[length], z=-thick / 2),))

    return (
        body("crank", parent, "D", [_turned(0.0, z, design.beta) for z in stations], carried("crank")),
        body("coupler", PART_IDS["crank"], "C", [_turned(lengths["crank"], beside, coupler)]),
        body(
            "rocker",
            parent,
            "A",
            [rocker_position(design, z) for z in stations],
            carried("rocker"),
            *struck,
        ),
    )


def crank_frame(design: BeatUp, use_parts: Sequence[Part], stations: Sequence[float]) -> RigidBody:
    """What stands of crank-rockers at stations along z [m]: pins of their pivots, and the drive of the crank shaft."""
    begin = min(stations) - _clear(design)
    return RigidBody(
        CARRIAGE,
        (*_fixed_pins(design, stations), *in_line(use_parts, begin)),
        joint=Joint(JointKind.MISSING),
    )


def link_motions(design: BeatUp, drive: str, angle: FloatArray, crank: FloatArray) -> dict[str, SceneMotion]:
    """Motions of the links by the ids of their bodies.

    drive  of the scene, and its angles [rad]      crank  angle of the crank at them, without jumps [rad]
    """
    parents = {body: parent for body, (parent, _) in carriers(design.plan.mechanism).items()}
    motion, rest = solve(design.plan, crank), solve(design.plan, np.array([design.beta]))
    return {PART_IDS[name]: one for name, one in motions_of(motion, rest, parents, drive, angle).items()}


def in_side_view(design: BeatUp, across: float = 0.0) -> Placement:
    """Where the linkage lies in a loom whose fell is the origin: its rocker points to the back at the beat.

    It stands mirrored in the side view: a direction e^(i t) of it is e^(i (g - t)) there, g = pi + r0, with r0 the
    angle of the rocker at the beat. Its z points across, to the weaver's right.
    """
    first, arm = design.rocker_angles[0], design.lengths["beater"]
    shaft = arm + design.lengths["ground"] * cmath.exp(1j * first)
    up, front = math.sin(math.pi + first), math.cos(math.pi + first)
    rotation = np.array([[0.0, 0.0, 1.0], [up, -front, 0.0], [front, up, 0.0]])
    return Placement(np.array([across, shaft.imag, shaft.real]), rotation)


def _clear(design: BeatUp) -> float:
    """From the middle plane of the crank to the drive, beyond the pins of the pivots [m]."""
    return pin_length(design.params.thickness) - design.params.thickness / 2


def _fixed_pins(design: BeatUp, stations: Sequence[float]) -> tuple[Occurrence, ...]:
    """Pins A and D at each station, towards -z."""
    low, ground = -_clear(design), design.lengths["ground"]
    return (Occurrence(pin_part(design), tuple(placement(x, z=low + z) for z in stations for x in (0.0, ground))),)


def rocker_position(design: BeatUp, z: float = 0.0) -> Placement:
    """Where a rocker lies at the beat."""
    return _turned(design.lengths["ground"], z, design.rocker_angles[0])


def _turned(x: float, z: float, angle: float) -> Placement:
    return placement(x, z=z, about=_Z, angle=angle)


def _moved(one: Occurrence, y: float) -> Occurrence:
    return replace(one, positions=tuple(placement(y=y).after(position) for position in one.positions))


def on_rocker(one: Occurrence, arm: float) -> Occurrence:
    """A part of the beater, in the axes of the side view, on the rocker, which points from its pivot to the back."""
    mirrored = placement(arm, about=(0.0, 1.0, 0.0), angle=math.pi)
    return replace(one, positions=tuple(mirrored.after(position) for position in one.positions))
