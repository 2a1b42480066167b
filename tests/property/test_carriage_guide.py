"""The guide of a head's carriage: its load against balls in rows under a rigid carriage, its life by hand; its belt.

The judge shares the load among single balls, by the least squares of a rigid body on springs, and solves the belt as
springs between the heads.
"""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ilmek.elements.linear_guides import LINEAR_GUIDES
from ilmek.machines.weaver import MACHINE, Weaver, WeaverParams
from ilmek.machines.weaver.carriage_belt import BELT, CLAMP, LOOP, ON_PULLEY, RADIUS, ROLLER, TEETH, loop
from ilmek.machines.weaver.carriage_drive import drive_checks, tension_check
from ilmek.machines.weaver.carriage_guide import BALLS, GUIDE_CARRIAGE, carriages, guide_for, guide_load
from ilmek.machines.weaver.tree import HEAD, carriage_guide, drive_of, head_tree
from ilmek.plane.contours import area
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
    assert guide_load(weaver, mass, row, step) == pytest.approx(expected, rel=2e-3)


@pytest.mark.parametrize("weaver", HEADS)
def test_the_guide_is_the_lowest_that_lasts_and_carries_the_head(weaver: Weaver) -> None:
    row, tree = carriage_guide(weaver), head_tree(weaver)
    mass, step = tree.mass, weaver.params.carriage_acceleration
    (check,) = (check for check in MACHINE.report(weaver).checks if check.name == "life of the head's guide")
    assert check.value == pytest.approx(50e3 * (row.dynamic / guide_load(weaver, mass, row, step)) ** 3, rel=1e-9)
    assert check.limit == pytest.approx(2e8 * weaver.params.cloth.knot_pitch)
    assert check.ok
    lower = [other for other in LINEAR_GUIDES if other.height < row.height]
    bare = mass - row.block_mass * carriages(weaver, row)
    assert all(50e3 * (other.dynamic / guide_load(weaver, bare, other, step)) ** 3 < check.limit for other in lower)
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


@given(st.sampled_from(HEADS), st.integers(1, 8), st.data())
def test_the_belt_lags_as_springs_between_the_heads_and_stays_taut(weaver: Weaver, heads: int, data) -> None:
    """Heads anywhere in their shares, each of which pulls: springs from clamp to clamp in series, by linear algebra."""
    drive, long = drive_of(weaver), weaver.belt_length - 2 * CLAMP
    places = [(k + data.draw(st.floats(0.01, 0.99))) / heads * long for k in range(heads)]
    spans = np.diff([0.0, *places, long])
    rates = BELT.stiffness * drive.width / spans
    stiffness = np.diag(rates[:-1] + rates[1:]) - np.diag(rates[1:-1], 1) - np.diag(rates[1:-1], -1)
    shifts = np.linalg.solve(stiffness, np.full(heads, drive.force))
    changes = rates * np.diff([0.0, *shifts, 0.0])
    rest = drive.force * (heads + 1) / 2
    assert rest + changes.min() >= -1e-9
    assert rest + changes.max() <= tension_check(drive, heads).value * (1 + 1e-9)
    (lag,) = (check for check in drive_checks(weaver, drive) if check.name == "lag of a head on its belt")
    alone = drive.drag / (BELT.stiffness * drive.width * (1 / places[0] + 1 / (long - places[0])))
    assert alone <= lag.value * (1 + 1e-9)
    assert lag.ok


def test_the_belt_goes_half_round_the_pulley_between_its_rollers() -> None:
    """Its area over its height is the length of its middle line; at both ends it leaves the straight line."""
    height = RADIUS + BELT.back - BELT.belt.tip_radius(TEETH) - ON_PULLEY  # without its teeth
    arcs = np.pi * (RADIUS + BELT.back - height / 2) + np.pi * (ROLLER + height / 2)
    outer, leaves = ROLLER + height, np.arccos(ROLLER / (ROLLER + height))
    beyond = outer**2 * leaves - ROLLER * outer * np.sin(leaves)
    assert area(loop()) == pytest.approx(height * arcs - beyond, rel=1e-2)
    assert np.pi * (RADIUS + ROLLER + BELT.back) - 2 * (RADIUS + ROLLER + BELT.back) == pytest.approx(LOOP)
    about, roller = np.abs(loop().points), np.abs(np.abs(loop().points.imag) - (RADIUS + ROLLER + BELT.back))
    assert about.min() == pytest.approx(RADIUS + BELT.back - height)
    assert np.hypot(loop().points.real, roller).min() == pytest.approx(ROLLER, rel=1e-6)


def test_a_heavy_head_needs_a_larger_motor_and_a_wider_belt() -> None:
    light, heavy = (drive_of(MACHINE.design(WeaverParams(head_mass=mass))) for mass in (10.0, 25.0))
    assert light.motor is not None
    assert heavy.motor is not None
    assert (light.width, light.motor.power) < (heavy.width, heavy.motor.power)
    assert not tension_check(light, 40).ok
