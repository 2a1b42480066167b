"""Springs, dampers, loads in a window, by hand; shapes against their integrals."""

import numpy as np
import pytest

from ilmek.dynamics.friction import AngleRange, WindowedLoad
from ilmek.dynamics.inertia import Inertia, combined
from ilmek.dynamics.inverse import inverse
from ilmek.dynamics.loads import PointForce, Torque
from ilmek.dynamics.shapes import disc, link, plate, ring
from ilmek.dynamics.springs import Spring, TorsionSpring
from ilmek.errors import MechanismError
from ilmek.linkage.fourbar import slider_crank
from ilmek.linkage.model import GROUND, Body, Displacement, Mechanism, Pin, Rotation, Slide
from ilmek.linkage.motion import Motion
from ilmek.linkage.solve import solve
from ilmek.linkage.structure import plan


def carriage(travel: np.ndarray, speed: float) -> Motion:
    """A carriage driven along x, hung beside it a point of the ground 0.3 m above."""
    mechanism = Mechanism(
        bodies=(Body(GROUND, {"line": 0, "hook": 0.3j}), Body("carriage", {"line": 0})),
        joints=(Slide("line", "carriage", GROUND),),
        inputs=(Displacement("line"),),
    )
    return solve(plan(mechanism), travel, speed)


def arm(angle: np.ndarray, speed: float) -> Motion:
    mechanism = Mechanism(
        bodies=(Body(GROUND, {"O": 0}), Body("arm", {"O": 0, "tip": 0.2})),
        joints=(Pin("O", GROUND, "arm"),),
        inputs=(Rotation("arm", "O"),),
    )
    return solve(plan(mechanism), angle, speed)


def test_a_spring_pulls_along_itself() -> None:
    travel = np.array([0.0, 0.4])  # 0.3 m and 0.5 m long
    forces = inverse(carriage(travel, 0.0), {}, (Spring((GROUND, "hook"), "carriage.line", 200.0, 0.25),))
    pull = np.array([200 * 0.05, 200 * 0.25])
    np.testing.assert_allclose(forces.effort("line"), pull * np.array([0.0, 0.8]), atol=1e-12)
    np.testing.assert_allclose(forces.pin("line"), -1j * pull * np.array([1.0, 0.6]), atol=1e-12)


def test_a_damper_takes_the_power_that_the_drive_gives() -> None:
    motion = carriage(np.array([0.4]), 2.0)
    forces = inverse(motion, {}, (Spring("carriage.line", (GROUND, "hook"), 0.0, 0.0, damping=30.0),))
    np.testing.assert_allclose(forces.input_power, 30.0 * (2.0 * 0.8) ** 2, rtol=1e-13)
    assert forces.power_error < 1e-14


@pytest.mark.parametrize("turns", [0.0, 2 * np.pi, -4 * np.pi, 2000 * np.pi])
def test_a_torsion_spring_counts_the_turns_of_the_input(turns: float) -> None:
    spring = TorsionSpring(GROUND, "arm", 40.0, angle=1.0, damping=0.5)
    wound = np.array([-0.5, 0.5]) + turns
    both = inverse(arm(np.array([0.5, 1.5]) + turns, 3.0), {}, (spring,))
    np.testing.assert_allclose(both.effort("arm"), 40.0 * wound + 1.5, rtol=1e-12)
    alone = inverse(arm(np.array([1.5 + turns]), 3.0), {}, (spring,))  # a single pose has the same turn
    np.testing.assert_allclose(alone.effort("arm"), 40.0 * wound[1:] + 1.5, rtol=1e-12)


def test_a_spring_between_moving_bodies_balances_within() -> None:
    crank = slider_crank(0.1, 0.3, branch=+1)
    motion = solve(plan(crank), np.linspace(0, 6, 30), 10.0)
    springs = (Spring("crank.A", "slider.B", 500.0, 0.2, 3.0), TorsionSpring("crank", "rod", 5.0, 0.3, 0.1))
    forces = inverse(motion, {}, springs)
    assert forces.power_error < 1e-13
    held = forces.pin("A0", on="crank") + forces.pin("line")
    np.testing.assert_allclose(held, 0, atol=1e-10)  # nothing but couples on the whole


def test_a_load_in_a_window_has_a_value_on_either_side_of_its_ends() -> None:
    ends = np.array([1.0, 1.0, 1.5, 2.0, 2.0, 2.5])
    side = np.array([-1.0, 1.0, 1.0, -1.0, 1.0, 1.0])
    load = WindowedLoad(Torque("arm", lambda motion: 7.0 * motion.angle("arm")), "arm", AngleRange(1.0, 2.0), side)
    forces = inverse(arm(ends, 1.0), {}, (load,))
    np.testing.assert_allclose(forces.effort("arm"), [0, -7.0, -10.5, -14.0, 0, 0], atol=1e-12)
    push = WindowedLoad(PointForce("arm.tip", 5j), "arm", AngleRange(1.0, 2.0))
    at_middle = inverse(arm(np.array([1.5]), 1.0), {}, (push,))
    np.testing.assert_allclose(at_middle.effort("arm"), -5.0 * 0.2 * np.cos(1.5), rtol=1e-12)


@pytest.mark.parametrize("numbers", [(-1.0, 0.1, 0.0), (1.0, np.nan, 0.0), (1.0, 0.1, -2.0)])
def test_springs_of_impossible_numbers_are_refused(numbers: tuple[float, float, float]) -> None:
    with pytest.raises(MechanismError, match="of a spring is"):
        Spring("a.p", "b.q", *numbers)


def summed(inside: np.ndarray, at: np.ndarray, cell: float) -> Inertia:
    """Mass 1 for each square metre, by cells."""
    points, area = at[inside], cell**2
    mass, centre = area * points.size, points.mean()
    return Inertia(mass, complex(centre), float(area * np.sum(np.abs(points - centre) ** 2)))


def test_shapes_are_their_integrals() -> None:
    cell = 5e-4
    axis = np.arange(-0.3, 0.3, cell) + cell / 2
    at = axis[:, None] + 1j * axis[None, :]
    nearest = np.clip(at.real, -0.1, 0.15)
    corners = np.array([-0.2 - 0.1j, 0.2 - 0.2j, 0.25 + 0.1j, -0.05 + 0.25j])
    across = [(np.conj(q - p) * (at - p)).imag for p, q in zip(corners, np.roll(corners, -1), strict=True)]
    for shape, inside in (
        (disc(0.2, 0.5, 2.0, at=0.05j), np.abs(at - 0.05j) < 0.2),
        (ring(0.2, 0.12, 0.5, 2.0), (np.abs(at) < 0.2) & (np.abs(at) > 0.12)),
        (link(-0.1, 0.15, 0.16, 0.5, 2.0), np.abs(at - nearest) < 0.08),
        (plate(corners.tolist(), 0.5, 2.0), np.all(np.array(across) > 0, axis=0)),
        (plate(corners[::-1].tolist(), 0.5, 2.0), np.all(np.array(across) > 0, axis=0)),
    ):
        expected = summed(inside, at, cell)
        assert shape.mass == pytest.approx(expected.mass, rel=1e-3)
        assert shape.moment == pytest.approx(expected.moment, rel=2e-3)
        assert shape.centre == pytest.approx(expected.centre, abs=1e-4)


def test_a_disc_far_away_is_its_own_plate_and_parts_join() -> None:
    corners = [1e3 + 0.1 * np.exp(2j * np.pi * k / 5000) for k in range(5000)]
    assert plate(corners, 0.01, 7800.0).moment == pytest.approx(disc(0.1, 0.01, 7800.0).moment, rel=1e-5)
    halves = combined(
        plate([0, 0.1, 0.1 + 0.1j, 0.1j], 0.01, 1e3), plate([0.1, 0.2, 0.2 + 0.1j, 0.1 + 0.1j], 0.01, 1e3)
    )
    whole = plate([0, 0.2, 0.2 + 0.1j, 0.1j], 0.01, 1e3)
    assert (halves.mass, halves.moment) == pytest.approx((whole.mass, whole.moment), rel=1e-12)


def test_shapes_of_impossible_numbers_are_refused() -> None:
    with pytest.raises(MechanismError, match="thickness of a shape is -1"):
        disc(0.1, -1.0, 7800.0)
    with pytest.raises(MechanismError, match="hole"):
        ring(0.1, 0.1, 0.01, 7800.0)
    with pytest.raises(MechanismError, match="no area"):
        plate([0, 1, 2], 0.01, 7800.0)
    with pytest.raises(MechanismError, match="radius of a shape is nan"):
        disc(float("nan"), 0.1, 1.0)
