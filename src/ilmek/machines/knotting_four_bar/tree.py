"""The knotting four-bar as a tree of bodies: one side or both, and the drive of its first crank in line with the shaft.

It moves from the first pose to the last and back, without poses over the whole range of its crank. With both sides the
gears of the cranks lie between the plate that stands and the drive.
"""

from collections.abc import Iterator, Sequence
from functools import lru_cache

import numpy as np

from ilmek.linkage.mirror import other
from ilmek.linkage.model import GROUND, Mechanism
from ilmek.linkage.solve import solve
from ilmek.machines.knotting_four_bar.design import KnottingFourBar
from ilmek.machines.knotting_four_bar.links import MACHINE_NAME, gear_part, made_parts
from ilmek.machines.link_tree import GAP, Levels, LinkageParts, linkage_parts, linkage_tree
from ilmek.part import catalogue
from ilmek.part.part import Part
from ilmek.part.placement import placement
from ilmek.part.tree import Occurrence, Tree, in_line

EVERY = 6
"""Every n-th sample of the design is a pose in space."""


@lru_cache(maxsize=8)
def tree(design: KnottingFourBar) -> Tree:
    """The bodies at the beginning of their motion."""
    there, params, sides = design.moving.angle[::EVERY], design.params, design.sides
    turns = design.working is None and design.range is None
    angles = there if turns else np.concatenate([there, there[-2::-1]])
    planned = sides.plan if sides else design.plan
    mechanism, below = planned.mechanism, -GAP * params.thickness
    others: dict[str, Sequence[Occurrence]] = {}
    if sides is not None:
        below -= sides.gears.width
        gear = (Occurrence(gear_part(params, sides.gears, design.hole), (placement(z=below),)),)
        others |= {"crank": gear, other("crank"): gear}
    others[GROUND] = in_line(tuple(_drive(design)), below, mechanism.body(GROUND).points["O1"])
    return linkage_tree(parts_of(design, mechanism), solve(planned, angles).require(), others)


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
    return linkage_parts(
        MACHINE_NAME, mechanism, levels, {**moving, **{other(body): part for body, part in moving.items()}}
    )


def _drive(design: KnottingFourBar) -> Iterator[Part]:
    """The servo of the first crank behind its gears, from the crank on."""
    drive = design.drive
    if drive.reducer.ratio != 1:
        yield catalogue.reducer(f"{MACHINE_NAME}/reducer", "reducer of the crank", drive.reducer, drive.servo)
    yield catalogue.motor(f"{MACHINE_NAME}/motor", "servo of the crank", drive.servo, drive.torque, drive.speed)
