"""Faults planted in a part of the loom: found by the project's own measure, and by a judge of the GLB file alike.

Evidence: the judge reads the file's own meshes and shares no code with the project. Many more: `make campaigns
PARTS=faults`.
"""

from functools import cache

import numpy as np
import pytest
from planted_faults import Verdict, judged, opened, own_verdict, pushed, without

from ilmek.machines.automated_loom import AutomatedLoomParams, design
from ilmek.machines.automated_loom.in_space.scene import loom_tree
from ilmek.part.tree import Tree
from ilmek.units import mm

_SOUND = Verdict(1, frozenset(), frozenset())
_BODIES = {"automated-loom/frame", "weft/guide", "weft/box at the left edge", "weft/box at the right edge"}


@cache
def _weft_side() -> Tree:
    """The frame, and of the weft side what stands on it at the start of a row."""
    whole = loom_tree(design(AutomatedLoomParams(aim="price")))
    return Tree(tuple(body for body in whole.bodies if body.id in _BODIES))


def _verdicts(tree: Tree) -> Verdict:
    own = own_verdict(tree)
    assert judged(tree) == own
    return own


def test_without_a_fault_nothing_is_found() -> None:
    assert _verdicts(_weft_side()) == _SOUND


def test_a_part_that_is_moved_into_another_by_1_mm_is_found() -> None:
    found = _verdicts(pushed(_weft_side(), "weft/rail", np.array([0.0, -1.0 * mm, 0.0])))
    assert found.through == {frozenset({"weft/rail", "weft/bar"})}
    assert found.is_open == frozenset()


@pytest.mark.parametrize(("part", "groups"), [("automated-loom/weft-arm", 2)])
def test_a_bracket_that_is_taken_away_leaves_what_it_carries_in_the_air(part: str, groups: int) -> None:
    assert _verdicts(without(_weft_side(), part)) == Verdict(groups, frozenset(), frozenset())


def test_a_mesh_that_is_opened_is_found() -> None:
    assert _verdicts(opened(_weft_side(), "weft/rail", 7)) == Verdict(1, frozenset(), frozenset({"weft/rail"}))
