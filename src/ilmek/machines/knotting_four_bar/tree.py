"""The knotting four-bar as a tree of bodies: one side or both, and the drive of its first crank in line with the shaft.

It moves from the first pose to the last and back, without poses over the whole range of its crank. The crank's shaft
turns in the frame plate, with the drive on that plate's back; with both sides on a base plate behind the gears.
"""

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import lru_cache

import numpy as np

from ilmek.arrays import ComplexArray
from ilmek.linkage.mirror import other
from ilmek.linkage.model import GROUND, Mechanism
from ilmek.linkage.solve import solve
from ilmek.machines.knotting_four_bar.design import KnottingFourBar
from ilmek.machines.knotting_four_bar.links import MACHINE_NAME, gear_part, made_parts, shaft_part
from ilmek.machines.knotting_four_bar.sides import KnottingSides
from ilmek.machines.link_tree import GAP, Levels, LinkageParts, LinkSize, linkage_parts, linkage_tree, pin_part
from ilmek.part import catalogue
from ilmek.part.part import Part
from ilmek.part.placement import placement
from ilmek.part.profile import drilled
from ilmek.part.shapes import Prism
from ilmek.part.tree import Occurrence, Tree, in_line
from ilmek.plane.contours import rounded_hull
from ilmek.report import Hole
from ilmek.units import mm

PILLAR = 12 * mm
"""Diameter of the pillars between frame plate and base plate [m]; assumed by this project."""

EVERY = 6
"""Every n-th sample of the design is a pose in space."""


@lru_cache(maxsize=8)
def tree(design: KnottingFourBar) -> Tree:
    """The bodies at the beginning of their motion."""
    there, params, sides = design.moving.angle[::EVERY], design.params, design.sides
    turns = design.working is None and design.range is None
    angles = there if turns else np.concatenate([there, there[-2::-1]])
    planned = sides.plan if sides else design.plan
    mechanism, drive = planned.mechanism, tuple(_drive(design))
    pivots, parts = mechanism.body(GROUND).points, parts_of(design, mechanism)
    face = catalogue.face_of(drive[0]) / 2 * np.array([1 + 1j, -1 + 1j, -1 - 1j, 1 - 1j])
    carried = pivots["O1"] + face
    begin, cranks = 0.0, {"crank": list[Occurrence]()}
    others: dict[str, Sequence[Occurrence]] = {}
    if sides is not None:
        gap, pillars = GAP * params.thickness, _pillars(sides, pivots["O1"])
        low = -sides.gears.width - 2 * gap
        begin = low - _stands(design).thickness
        nodes = np.concatenate([carried, pillars, [pivots["O1"], pivots[other("O1")]]])
        base = _plate(design, "base", "base plate", nodes, [pivots["O1"], pivots[other("O1")]])
        post = pin_part(f"{MACHINE_NAME}/pillar", "pillar of the base plate", PILLAR, -low)
        others[GROUND] = (
            Occurrence(base, (placement(z=begin),)),
            Occurrence(post, tuple(placement(point.real, point.imag, low) for point in pillars)),
        )
        gear = Occurrence(gear_part(params, sides.gears, design.hole), (placement(z=low + gap),))
        cranks = {"crank": [gear], other("crank"): [gear]}
        carried = pillars
    points = np.concatenate([list(pivots.values()), carried])
    frame = _plate(design, "frame", "frame plate", points, list(pivots.values()))
    shaft = shaft_part(params, design.hole, begin)
    others |= {body: (*own, Occurrence(shaft, (placement(z=begin),))) for body, own in cranks.items()}
    others[GROUND] = (*others.get(GROUND, ()), *in_line(drive, begin, pivots["O1"]))
    plates = {**parts.plates, GROUND: frame}
    return linkage_tree(replace(parts, plates=plates), solve(planned, angles).require(), others)


def _pillars(sides: KnottingSides, pivot: complex) -> ComplexArray:
    """Axes of the pillars on the mirror, above and below both gears, of which they keep clear [m]; pivot  of one."""
    radius = sides.gears.pitch_radius
    aside = math.sqrt((radius + sides.gears.module + PILLAR) ** 2 - radius**2)
    return complex(sides.mirror, pivot.imag) + 1j * np.array([aside, -aside])


def _plate(design: KnottingFourBar, name: str, title: str, nodes: ComplexArray, bores: Sequence[complex]) -> Part:
    """A plate that stands: about some nodes, with bores for pins and shafts [m]."""
    size = _stands(design)
    outline = rounded_hull(nodes, max(size.width, PILLAR) / 2)
    shape = Prism(drilled(outline, [Hole(point, design.hole / 2) for point in bores]), size.thickness)
    return Part(f"{MACHINE_NAME}/{name}", title, "machined link", shape, size.material)


def _stands(design: KnottingFourBar) -> LinkSize:
    return made_parts(design.params, design.hole, design.ground_angle).levels.sizes[GROUND]


def parts_of(design: KnottingFourBar, mechanism: Mechanism) -> LinkageParts:
    """Plates and pins of a side, or of both: links and their mirror images are the same parts."""
    one = made_parts(design.params, design.hole, design.ground_angle)
    if design.sides is None:
        return one
    sizes, moving = one.levels.sizes, {body: part for body, part in one.plates.items() if body != GROUND}
    levels = Levels(
        tuple((*level, *(other(body) for body in level if body != GROUND)) for level in one.levels.bodies),
        {**sizes, **{other(body): sizes[body] for body in moving}},
    )
    plates = {**moving, **{other(body): part for body, part in moving.items()}}
    return linkage_parts(MACHINE_NAME, mechanism, levels, plates, ("O1", other("O1")))


def _drive(design: KnottingFourBar) -> Iterator[Part]:
    """The servo of the first crank behind its gears, from the crank on."""
    drive = design.drive
    if drive.reducer.ratio != 1:
        yield catalogue.reducer(f"{MACHINE_NAME}/reducer", "reducer of the crank", drive.reducer, drive.servo)
    yield catalogue.motor(f"{MACHINE_NAME}/motor", "servo of the crank", drive.servo, drive.torque, drive.speed)
