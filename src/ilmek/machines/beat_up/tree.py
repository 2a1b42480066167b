"""The beat-up as a tree of bodies: crank-rockers on what carries them, the travelling beater on its rocker.

Axes are those of the linkage: D the origin, A on x, z along the pins, 0 in the middle of the rocker. Bodies lie at rest
as at the beat; motions are counted from there. Along z follow each other beater, rocker, coupler, crank, the plate that
carries them, and the drive [`links.layer`, `carriage`].
"""

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from functools import lru_cache

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.linkage.model import GROUND
from ilmek.linkage.solve import solve
from ilmek.machines.beat_up.beam import BeatBeam
from ilmek.machines.beat_up.beater import Beater
from ilmek.machines.beat_up.carriage import (
    AXIS_SIDE,
    BELT_WIDTH,
    BLOCK_HEIGHT,
    BLOCK_LENGTH,
    DRIVE_GAP,
    NECK,
    beam_corner,
    carried,
    drive_plate,
    drive_shaft,
    driving,
    in_links_axes,
    on_slide,
    plate_begin,
    plate_part,
    shaft,
    shared_axis,
    shared_drive,
    shared_end,
    slide_block,
)
from ilmek.machines.beat_up.crank_start import MOTOR as CRANK_MOTOR
from ilmek.machines.beat_up.crank_start import CrankStart, coupled_parts, start_parts
from ilmek.machines.beat_up.design import BeatUp
from ilmek.machines.beat_up.links import PART_IDS, layer
from ilmek.machines.beat_up.parts import link_parts, pin_part
from ilmek.machines.beat_up.travel import MOTOR, slide_length, travel_parts
from ilmek.machines.beat_up.use import BeatUpUse, in_use
from ilmek.machines.link_tree import GAP, JOURNAL
from ilmek.part import catalogue
from ilmek.part.extents import around, extents
from ilmek.part.link_motion import carriers, closures
from ilmek.part.link_motion import link_motions as motions_of
from ilmek.part.placement import IN_SIDE_VIEW, Placement, placement
from ilmek.part.tree import Closure, Joint, JointKind, Occurrence, RigidBody, Tree, depth_of, in_line
from ilmek.report.scene import SceneMotion

CARRIAGE, RAIL = "beat-up/carriage", "beat-up/rail"
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
    start    of the beater from the middle of the carpet along z [m]
    """
    across, length = use.travel, slide_length(use.travel)
    shift = beater_shift(design, across.beater)
    middle = plate_begin(design) - BLOCK_LENGTH / 2 - shift
    axis, *drive = travel_parts(across)
    high = use.beam.section.side
    on_beam = beam_corner(design) + complex(AXIS_SIDE / 2, high + AXIS_SIDE / 2)
    # A drive wider than the slide lies on the beam, too.
    raised = on_beam + 0.5j * max(0.0, *(catalogue.face_of(part) - AXIS_SIDE for part in drive))
    standing = (
        *beam_occurrences(design, use.beam),
        _in_loom(design, Occurrence(axis, (placement(z=-length / 2),)), on_beam, middle),
        *(_in_loom(design, one, raised, middle) for one in in_line(drive, -length / 2)),
    )
    rail = RigidBody(RAIL, standing)
    on_block = beam_corner(design) + complex(AXIS_SIDE / 2, high + AXIS_SIDE + BLOCK_HEIGHT / 2)
    block = _in_loom(design, Occurrence(slide_block()), on_block, plate_begin(design) - BLOCK_LENGTH)
    parts = (*on_slide(design, high, start_parts(use.start)), block)
    carriage = RigidBody(
        CARRIAGE, parts, rail.id, Joint(JointKind.SLIDE, _Z, motor=MOTOR), (placement(z=start - shift),)
    )
    bodies = Tree((rail, carriage, *crank_rockers(design, CARRIAGE, beater=across.beater)), loops(design))
    return bodies.moving(motions or {})


def beater_shift(design: BeatUp, beater: Beater) -> float:
    """Middle of the beater from that of the rocker along z [m]: beside it, with its plate between."""
    return -((0.5 + GAP) * design.params.thickness + beater.width / 2)


def beside_beater(design: BeatUp, use: BeatUpUse) -> float:
    """The run beside a cloth in which all that travels clears it: how far that reaches beyond the beater [m]."""
    riding = (extent for extent in extents(travelling(design, use), ()) if extent.body != RAIL)
    ends = around(riding)
    return use.travel.beater.width / 2 + max(float(ends[1][2]), -float(ends[0][2]))


def beam_occurrences(design: BeatUp, beam: BeatBeam) -> tuple[Occurrence, ...]:
    """The beam where it carries the plates, its middle at z = 0."""
    side = beam.section.side
    part = Occurrence(beam.part, (placement(z=-beam.length / 2),))
    return (_in_loom(design, part, beam_corner(design) + complex(side, side) / 2, 0.0),)


def _in_loom(design: BeatUp, occurrence: Occurrence, middle: complex, z: float) -> Occurrence:
    """A part along z with its section upright, its middle at a point of the side view [m]; z: where it lies."""
    upright = in_side_view(design).inverse.after(placement(0.0, middle.imag, middle.real)).after(_ACROSS)
    along = placement(z=z).after(upright)
    return replace(occurrence, positions=tuple(along.after(position) for position in occurrence.positions))


_ACROSS = Placement(np.zeros(3), IN_SIDE_VIEW.rotation @ np.diag([-1.0, 1.0, -1.0]))
"""A part whose z points to the weaver's right in the scene, its y up."""


def crank_rockers(
    design: BeatUp, parent: str, stations: Sequence[float] = (0.0,), *, beater: Beater | None = None
) -> tuple[RigidBody, ...]:
    """Cranks, couplers and rockers at stations along z [m], on a body with the linkage's axes.

    beater  on the rocker, where there is one
    """
    links, pin, lengths = link_parts(design), pin_part(design), design.lengths
    thick = design.params.thickness
    motion = solve(design.plan, np.array([design.beta]))
    coupler, crank = float(motion.angle("coupler")[0]) - design.beta, layer("crank", thick)
    struck = () if beater is None else tuple(_struck(design, beater))
    flat = placement(z=-thick / 2)

    def body(link: str, on: str, joined: str, positions: Sequence[Placement], *others: Occurrence) -> RigidBody:
        part = links[link]
        seats = (f"{part.id}:{joined}", f"{pin.id}:{JOURNAL}")
        joint = Joint(JointKind.PIN, _Z, seats=seats, motor=CRANK_MOTOR if link == "crank" else "")
        return RigidBody(part.id, (Occurrence(part, (flat,)), *others), on, joint, tuple(positions))

    def pinned(length: str, depth: float) -> Occurrence:
        """The pin at the end of a link, from the plane of the rocker or of the coupler on."""
        return Occurrence(pin, (placement(x=lengths[length], z=-depth - thick / 2),))

    return (
        body(
            *("crank", parent, "D", [_turned(0.0, z + crank, design.beta) for z in stations]),
            pinned("crank", layer("coupler", thick)),
        ),
        body("coupler", PART_IDS["crank"], "C", [_turned(lengths["crank"], -layer("coupler", thick), coupler)]),
        body("rocker", parent, "A", [rocker_position(design, z) for z in stations], pinned("rocker", 0.0), *struck),
    )


def loops(design: BeatUp) -> tuple[Closure, ...]:
    """The joints that close the loops of `crank_rockers`."""
    return closures(design.plan.mechanism, {**PART_IDS, GROUND: CARRIAGE})


def crank_frame(design: BeatUp, beam: BeatBeam, start: CrankStart, stations: Sequence[float]) -> RigidBody:
    """What stands of crank-rockers at stations along z [m]: the beam, a plate with its pins at each, and the drive."""
    shared, coupled = shared_end(design, start.start_torque, len(stations)).shaft, coupled_parts(start)
    geared, neck = start_parts(start)[len(coupled) :], NECK + (0.0 if coupled else design.params.thickness)
    plate = plate_part(design, beam.section.side, beam.section.side, design.params.width, shared)
    parts: dict[str, Occurrence] = {}
    for one in (part for z in stations for part in carried(design, plate, z, belted=True)):
        before = parts[one.part.id].positions if one.part.id in parts else ()
        parts[one.part.id] = replace(one, positions=(*before, *one.positions))
    end = max(stations) + plate_begin(design) + design.params.thickness + BELT_WIDTH + NECK
    axis = complex(in_links_axes(design, np.array([shared_axis(design, shared)]))[0])
    belts = shared_drive(design, start.start_torque, stations, neck)
    beyond = end + math.fsum(depth_of(one) for one in coupled)
    drive = [*driving(start_parts(start), end, axis)[: len(coupled)]]
    if coupled:
        drive.append(Occurrence(drive_shaft(design, geared[0]), (placement(axis.real, axis.imag, beyond),)))
        beyond += DRIVE_GAP
    plate = drive_plate(design, beam.section.side, geared[0], shared)
    drive += [Occurrence(plate, (placement(z=beyond),)), *driving(geared, beyond + design.params.thickness, axis)]
    return RigidBody(CARRIAGE, (*beam_occurrences(design, beam), *parts.values(), *belts, *drive))


def link_motions(design: BeatUp, drive: str, angle: FloatArray, crank: FloatArray) -> dict[str, SceneMotion]:
    """Motions of the links by the ids of their bodies.

    drive  of the scene, and its angles [rad]      crank  angle of the crank at them, without jumps [rad]
    """
    parents = {body: parent for body, (parent, _) in carriers(design.plan.mechanism).items()}
    motion, rest = solve(design.plan, crank), solve(design.plan, np.array([design.beta]))
    return {PART_IDS[name]: one for name, one in motions_of(motion, rest, parents, drive, angle).items()}


def in_side_view(design: BeatUp) -> Placement:
    """Where the linkage lies in a loom whose fell is the origin: its rocker points to the back at the beat.

    It stands mirrored in the side view: a direction e^(i t) of it is e^(i (g - t)) there, g = pi + r0, with r0 the
    angle of the rocker at the beat. Its z points across, to the weaver's right.
    """
    first, axis = design.rocker_angles[0], shaft(design)
    up, front = math.sin(math.pi + first), math.cos(math.pi + first)
    rotation = np.array([[0.0, 0.0, 1.0], [up, -front, 0.0], [front, up, 0.0]])
    return Placement(np.array([0.0, axis.imag, axis.real]), rotation)


def rocker_position(design: BeatUp, z: float = 0.0) -> Placement:
    """Where a rocker lies at the beat."""
    return _turned(design.lengths["ground"], z, design.rocker_angles[0])


def _turned(x: float, z: float, angle: float) -> Placement:
    return placement(x, z=z, about=_Z, angle=angle)


def _struck(design: BeatUp, beater: Beater) -> Iterator[Occurrence]:
    """The parts of a beater on its rocker, beside it."""
    shift = placement(z=beater_shift(design, beater))
    for occurrence in beater.occurrences:
        placed = on_rocker(occurrence, design.lengths["beater"])
        yield replace(placed, positions=tuple(shift.after(position) for position in placed.positions))


def on_rocker(occurrence: Occurrence, arm: float) -> Occurrence:
    """A part of the beater, in the axes of the side view, on the rocker, which points from its pivot to the back."""
    mirrored = placement(arm, about=(0.0, 1.0, 0.0), angle=math.pi)
    return replace(occurrence, positions=tuple(mirrored.after(position) for position in occurrence.positions))
