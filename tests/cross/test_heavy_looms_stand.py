"""What stands of looms with many, tight warps has room: frame, cylinders, compensator, reducers of the cam shafts.

Evidence: volumes of the parts' meshes by manifold3d, in the pose at the start of a row.
"""

from functools import cache
from itertools import pairwise

import pytest

from ilmek.machines.automated_loom import AutomatedLoomParams, LoomDesign, design
from ilmek.machines.automated_loom.assembly import holds_in_space
from ilmek.machines.automated_loom.in_space.beating import beating
from ilmek.machines.automated_loom.in_space.cams import cams
from ilmek.machines.automated_loom.in_space.machines import joined
from ilmek.machines.automated_loom.in_space.standing import standing
from ilmek.machines.automated_loom.report import all_checks
from ilmek.machines.shedding.stack import part_id
from ilmek.part.contacts import contacts
from ilmek.part.shapes import shape_box
from ilmek.part.tree import Tree
from ilmek.units import mm

LOOMS = (
    {"width": "3.4m", "length": "3.5m", "knots_across": "20/dm", "tension": "30N", "lift": "60mm", "beat": "comb"},
    {"width": "1.7m", "length": "2.2m", "knots_across": "25/dm", "tension": "30N", "lift": "70mm"},
    {"width": "1m", "length": "1m", "knots_across": "50/dm", "beat": "comb"},
    {"width": "3.9m", "tension": "30N", "beat": "travelling"},
    {"width": "2.91m", "length": "3.74m", "knots_across": "45/dm", "colours": "15", "tension": "15N"},
)

CLOSE = (
    {"width": "0.6m", "knots_across": "15/dm", "beat": "comb", "weft": "rapier"},
    {"width": "1.4m", "knots_across": "36/dm", "knot": "asymmetric", "beat": "linkage", "weft": "rapier"},
    {"width": "2m", "knots_across": "40/dm", "beat": "guide-cams"},
    {"width": "0.66m", "knots_across": "30/dm", "beat": "linkage", "heads": "3"},
    {"width": "1.7m", "length": "2m", "knots_across": "36/dm", "knot": "asymmetric", "beat": "linkage"},
)
"""Wide heads at the edges, couplers at a bar, drives over a rapier's arms, motors at crank-rockers, tipping."""


@cache
def loom(number: int) -> LoomDesign:
    return design(AutomatedLoomParams.read({"aim": "price", **LOOMS[number]}))


def standing_parts(made: LoomDesign) -> Tree:
    """Frame with its rail, cylinders, compensator and beat, and of the cam shafts what does not turn."""
    shafts = cams(made)
    held = {part_id("stand", index) for index in range(len(made.side.cams))}
    stands = Tree(tuple(body for body in shafts.tree.bodies if body.id in held))
    whole = joined((*standing(made), beating(made)))
    return whole.carrying(shafts.parent, stands, shafts.position)


@pytest.mark.matrix(light=2)
@pytest.mark.parametrize("number", range(len(LOOMS)))
def test_nothing_that_stands_is_through_another(number: int) -> None:
    found = contacts(standing_parts(loom(number)))
    assert [pair.parts for pair in found.through] == []


@pytest.mark.matrix(light=1)
@pytest.mark.parametrize("settings", CLOSE)
def test_what_moves_close_together_has_room(settings: dict[str, str]) -> None:
    made = design(AutomatedLoomParams.read({"aim": "price", **settings}))
    assert [check.name for check in all_checks(made) if not check.ok] == []
    assert holds_in_space(made)


def test_the_bar_of_a_comb_goes_up_before_the_reed() -> None:
    made = loom(2)
    assert any(cam.front > cam.guide_radius for cam in made.side.cams)  # a reed stands before its cams
    assert made.beat.design.params.reach >= made.side.cam_front + made.params.clearance


@pytest.mark.parametrize(("of", "number"), [(0, 2), (4, 1)])
def test_beams_across_stand_beside_each_other(of: int, number: int) -> None:
    """Posts of the beat and of the rail on one depth, but for rounding, stand on one beam; two have room for welds."""
    bodies = standing_parts(loom(of)).bodies
    (beams,) = (own for body in bodies for own in body.occurrences if own.part.id == "automated-loom/front-beam")
    assert len(beams.positions) == number
    low, high = shape_box(beams.part.shape)
    depths = sorted(position.origin[2] for position in beams.positions)
    assert all(b - a >= high[0] - low[0] + 30 * mm for a, b in pairwise(depths))
