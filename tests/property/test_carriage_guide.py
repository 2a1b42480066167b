"""The guide of a head's carriage: its load against balls in rows under a rigid carriage, its life by hand.

The judge shares the load among single balls, by the least squares of a rigid body on springs.
"""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ilmek.elements.linear_guides import LINEAR_GUIDES
from ilmek.machines.weaver import MACHINE, Weaver, WeaverParams
from ilmek.machines.weaver.carriage_guide import BALLS, GUIDE_CARRIAGE, carriages, guide_for, guide_load
from ilmek.machines.weaver.tree import HEAD, carriage_guide, head_tree
from ilmek.units import mm

HEADS = tuple(MACHINE.design(WeaverParams(**settings)) for settings in ({}, {"tubes": 5}, {"cam_thickness": 14 * mm}))


@given(st.sampled_from(HEADS), st.sampled_from(LINEAR_GUIDES[2:]), st.floats(1.0, 60.0))
def test_the_load_is_that_of_the_most_loaded_balls(weaver: Weaver, row, mass: float) -> None:
    """Balls are at half the rail's width; at a rating all carry alike, so the most loaded decides."""
    shape, step = weaver.shape, weaver.params.carriage_acceleration
    middle = shape.body + shape.size / 2
    behind, aside = shape.front - middle.real, abs(shape.rail - middle.imag)
    z = np.linspace(-0.5, 0.5, 4001) * BALLS * row.block_length
    side = np.array([-0.5, 0.5]) * row.rail
    # q = a + b x + c z of rigid bodies on springs: forces and moments of each case over all balls.
    balls = np.array([(1.0, x, y) for x in side for y in z])
    weight, turned, pitched = mass * 9.80665, mass * 9.80665 * behind, mass * step * (behind + aside)
    cases = (weight, 0.0, 0.0), (0.0, turned, 0.0), (0.0, 0.0, pitched)
    loads = [np.abs(balls @ np.linalg.solve(balls.T @ balls, np.array(case))).max() for case in cases]
    expected = len(balls) * sum(loads) / carriages(weaver, row)
    assert guide_load(weaver, mass, row) == pytest.approx(expected, rel=2e-3)


@pytest.mark.parametrize("weaver", HEADS)
def test_the_guide_is_the_lowest_that_lasts_and_carries_the_head(weaver: Weaver) -> None:
    row, tree = carriage_guide(weaver), head_tree(weaver)
    mass = tree.mass
    (check,) = (check for check in MACHINE.report(weaver).checks if check.name == "life of the head's guide")
    assert check.value == pytest.approx(50e3 * (row.dynamic / guide_load(weaver, mass, row)) ** 3, rel=1e-9)
    assert check.limit == pytest.approx(2e8 * weaver.params.cloth.knot_pitch)
    assert check.ok
    lower = [other for other in LINEAR_GUIDES if other.height < row.height]
    bare = mass - sum(row.block_mass for _ in range(carriages(weaver, row)))
    assert all(50e3 * (other.dynamic / guide_load(weaver, bare, other)) ** 3 < check.limit for other in lower)
    (blocks,) = (one for one in tree.body(HEAD).occurrences if one.part.id == GUIDE_CARRIAGE)
    assert len(blocks.positions) == carriages(weaver, row)
    assert blocks.part.shape is not None
    corners = np.concatenate([position.points(blocks.part.shape.mesh().points) for position in blocks.positions])
    assert float(corners[:, 2].min()) == pytest.approx(weaver.shape.front)
    assert float(corners[:, 0].max()) == pytest.approx(-float(corners[:, 0].min()))


def test_a_heavy_head_fails() -> None:
    weaver = MACHINE.design(WeaverParams(head_mass=80.0))
    assert guide_for(weaver, 80.0).name == "size-20"
    assert {"life of the head's guide", "static safety of the head's guide"} <= {
        check.name for check in MACHINE.report(weaver).failed
    }
