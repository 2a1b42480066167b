"""The default loom stands: no part through another and none in the air, by meshes; planted faults are found.

Evidence: distances and volumes of the parts' meshes by fcl and manifold3d over a row and a knot; positions of the heads
at the ends of their shares, from the carpet's width alone.
"""

from collections.abc import Callable
from dataclasses import replace
from functools import cache

import pytest

from ilmek.elements.materials import MATERIALS
from ilmek.machines.automated_loom import AutomatedLoomParams, LoomDesign, design
from ilmek.machines.automated_loom.assembly import assembly
from ilmek.machines.automated_loom.in_space.maker import MachineTree
from ilmek.machines.automated_loom.in_space.scene import branches_of, loom_tree
from ilmek.machines.automated_loom.nearest_parts import BETWEEN, LEFT, RIGHT, nearest_parts
from ilmek.part.contacts import contacts, groups
from ilmek.part.part import Part
from ilmek.part.placement import UPRIGHT, placement
from ilmek.part.shapes import box
from ilmek.part.tree import GROUND, Occurrence, RigidBody, Tree
from ilmek.units import mm

NEAREST_PARTS = "ilmek.machines.automated_loom.nearest_parts"


@cache
def loom() -> LoomDesign:
    return design(AutomatedLoomParams(aim="price"))


def with_occurrences(change: Callable[[Occurrence], tuple[Occurrence, ...]]) -> Tree:
    whole = loom_tree(loom())
    return whole.replaced(
        replace(body, occurrences=tuple(own for old in body.occurrences for own in change(old)))
        for body in whole.bodies
    )


def test_no_part_of_the_default_loom_is_through_another_or_in_the_air() -> None:
    found = assembly(loom())
    assert found.through == ()
    assert [len(group.parts) for group in found.contacts.groups[1:]] == []
    assert found.buildable
    distances = [near.approach.distance for near in found.apart[: len(found.nearest_pairs)]]
    assert len(distances) == 10
    assert distances == sorted(distances)


def test_an_arm_that_is_taken_away_leaves_the_weft_side_in_the_air() -> None:
    without = with_occurrences(lambda own: () if own.part.id == "automated-loom/weft-arm" else (own,))
    first, second = groups(without)
    assert "weft/shuttle" in second.parts
    assert "automated-loom/column" in first.parts


@pytest.mark.matrix(light=2)
@pytest.mark.parametrize("name", ["weaver/left-side-plate", "warp-tension/upper-bearing", "shedding/guide-cam"])
def test_a_part_that_is_moved_by_a_millimetre_is_through_another(name: str) -> None:
    """One piece of it, to all sides: to one of them its neighbour is."""

    def moved(along: tuple[float, float, float]) -> Callable[[Occurrence], tuple[Occurrence, ...]]:
        def change(own: Occurrence) -> tuple[Occurrence, ...]:
            if own.part.id != name:
                return (own,)
            middle = len(own.positions) // 2
            aside = own.positions[middle].after(placement(*along))
            return (replace(own, positions=(*own.positions[:middle], aside, *own.positions[middle + 1 :])),)

        return change

    tries = [(shift, 0.0, 0.0) for shift in (-mm, mm)] + [(0.0, 0.0, shift) for shift in (-mm, mm)]
    through = [pair.parts for along in tries for pair in contacts(with_occurrences(moved(along))).through]
    assert any(name in parts for parts in through)


@pytest.mark.matrix(light=1)
@pytest.mark.parametrize(("side", "heads"), [(-1, LEFT), (1, RIGHT)])
def test_a_post_at_the_end_of_the_heads_way_is_met_there_alone(
    side: int, heads: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A head stands in the middle of the width; a post as high as it at the carpet's edge is free of it there."""
    made = loom()
    head, edge = made.side.of_heads.shape, side * made.task.cloth.width / 2
    at = placement(edge, head.body.imag, head.body.real + head.size.real / 2)
    shape = box(20 * mm, 20 * mm, head.size.imag)
    post = Part("test/post", "post", "machined link", shape=shape, material=MATERIALS["structural steel"])
    stands = Tree((RigidBody("test post", (Occurrence(post, (UPRIGHT,)),), positions=(at,)),))
    branches, whole = (*branches_of(made), MachineTree("test", stands)), loom_tree(made).carrying(GROUND, stands)
    monkeypatch.setattr(f"{NEAREST_PARTS}.loom_tree", lambda _: whole)
    monkeypatch.setattr(f"{NEAREST_PARTS}.branches_of", lambda _: branches)
    nearest = nearest_parts.__wrapped__(made)
    met = [near for near in nearest if "test/post" in near.approach.parts and near.approach.distance < 0]
    on_head = [near for near in met if any(part.startswith("weaver/") for part in near.approach.parts)]
    assert on_head
    assert {near.heads for near in on_head} <= {heads, BETWEEN}
