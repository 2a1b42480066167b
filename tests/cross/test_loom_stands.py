"""The default loom stands: no part through another and none in the air, by meshes; what is taken away is missed.

Evidence: distances and volumes of the parts' meshes by fcl and manifold3d over a row and a knot.
"""

from dataclasses import replace

from ilmek.machines.automated_loom import AutomatedLoomParams, design
from ilmek.machines.automated_loom.assembly import assembly
from ilmek.machines.automated_loom.in_space.scene import loom_tree
from ilmek.part.contacts import groups
from ilmek.part.tree import Tree


def test_no_part_of_the_default_loom_is_through_another_or_in_the_air() -> None:
    found = assembly(design(AutomatedLoomParams()))
    assert found.through == ()
    assert [len(group.parts) for group in found.groups[1:]] == []
    assert found.nearest_pairs


def test_an_arm_that_is_taken_away_leaves_the_weft_side_in_the_air() -> None:
    whole = loom_tree(design(AutomatedLoomParams()))
    without = Tree(
        tuple(
            replace(
                body,
                occurrences=tuple(own for own in body.occurrences if own.part.id != "automated-loom/weft-arm"),
            )
            for body in whole.bodies
        )
    )
    first, second = groups(without)
    assert "weft/shuttle" in second.parts
    assert "automated-loom/column" in first.parts
