"""Small looms with every kind of beat, and with a rapier, stand: nothing through beat or weft, all held.

Evidence: distances and volumes of the parts' meshes by fcl and manifold3d over a row and a knot. What is neither beat
nor weft is not compared with each other here; `test_loom_stands` does so.
"""

from dataclasses import replace
from functools import cache

import pytest

from ilmek.machines.automated_loom import AutomatedLoomParams, LoomDesign, design
from ilmek.machines.automated_loom.in_space.maker import KNOT, ROW
from ilmek.machines.automated_loom.in_space.scene import loom_tree
from ilmek.machines.automated_loom.nearest_parts import machines_of_bodies, row_windows
from ilmek.part.clearances import TURN, approaches
from ilmek.part.contacts import groups
from ilmek.part.placement import Placement
from ilmek.part.tree import Tree
from ilmek.units import mm

SMALL = {"width": "0.5m", "length": "0.5m", "knots_across": "12/dm"}
LOOMS = (
    {"beat": "linkage", "heads": "2"},
    {"beat": "comb", "heads": "2", "weft": "rapier", "width": "0.6m"},
    {"beat": "guide-cams", "heads": "1"},
    {"beat": "travelling", "knotting": "hand"},
)
LOOKED_AT = {"beat-up", "hammer", "weft"}


@cache
def loom(settings: tuple[tuple[str, str], ...]) -> LoomDesign:
    return design(AutomatedLoomParams.read({"aim": "price", **SMALL, **dict(settings)}))


def thinned(tree: Tree) -> Tree:
    """Of many like parts in a body the first, the middle and the last."""

    def few(positions: tuple[Placement, ...]) -> tuple[Placement, ...]:
        return positions if len(positions) < 4 else (positions[0], positions[len(positions) // 2], positions[-1])

    return Tree(
        tuple(
            replace(body, occurrences=tuple(replace(own, positions=few(own.positions)) for own in body.occurrences))
            for body in tree.bodies
        )
    )


@pytest.mark.parametrize("settings", LOOMS, ids=str)
def test_nothing_is_through_beat_or_weft(settings: dict[str, str]) -> None:
    made = loom(tuple(settings.items()))
    machine, tree = machines_of_bodies(made), thinned(loom_tree(made))

    def required(first: str, other: str) -> float | None:
        return 0.0 if LOOKED_AT & {machine[first], machine[other]} else None

    windows = row_windows(made.row_cyclogram, made.beat.path)
    pairs = (
        *approaches(tree, ROW, 1 * mm, windows, required),
        *approaches(tree, KNOT, 1 * mm, TURN, required),
    )
    assert [pair for pair in pairs if pair.distance < 0] == []


def test_what_holds_a_rapier_is_missed_when_it_is_taken_away() -> None:
    tree = loom_tree(loom(tuple(LOOMS[2].items())))
    assert len(groups(tree)) == 1
    # The beam carries the axis; at a plate the arm's end meets an edge of it.
    for name, left in (("weft-beam", "weft/rapier"), ("weft-arm", "weft/selector")):
        without = Tree(
            tuple(
                replace(
                    body,
                    occurrences=tuple(own for own in body.occurrences if own.part.id != f"automated-loom/{name}"),
                )
                for body in tree.bodies
            )
        )
        apart = groups(without)
        assert len(apart) > 1
        assert any(left in group.parts for group in apart[1:])
