"""Forces through gears and racks: power balances, the lever law of gears, bearings against the teeth's force."""

import dataclasses

import numpy as np
import pytest

from ilmek.dynamics.inertia import Inertia
from ilmek.dynamics.inverse import inverse
from ilmek.dynamics.joint_friction import PinFriction
from ilmek.dynamics.loads import Gravity, Torque
from ilmek.dynamics.multibody.model import from_motion
from ilmek.errors import MechanismError
from ilmek.linkage.model import GROUND, Body, Coupling, Displacement, Mechanism, Pin, Rotation, Slide
from ilmek.linkage.solve import solve
from ilmek.linkage.structure import plan


def gear_pair(ratio=-0.5, kind="gears") -> Mechanism:
    """A wheel of 20 mm on one of 40 mm, 60 mm apart; any other ratio in proportion."""
    return Mechanism(
        bodies=(Body(GROUND, {"A": 0, "B": 0.06}), Body("small", {"A": 0}), Body("large", {"B": 0})),
        joints=(Pin("A", GROUND, "small"), Pin("B", GROUND, "large")),
        inputs=(Rotation("small", "A"),),
        couplings=(Coupling("teeth", kind, ("small", "A"), ("large", "B"), ratio, 0.0, 0.0),),
    )


def test_a_gear_pair_passes_its_torque_on_through_the_teeth():
    motion = solve(plan(gear_pair()), np.linspace(0, 5, 7), 10.0)
    forces = inverse(motion, {}, (Torque("large", -8.0),)).require()
    outward = 200 * np.tan(np.radians(20))  # 8 N m over 40 mm, on the left of the wheel, and away from the other
    np.testing.assert_allclose(forces.tooth("teeth"), -200j + outward, atol=1e-10)
    np.testing.assert_allclose(forces.pin("B"), 200j - outward, atol=1e-10)
    np.testing.assert_allclose(forces.pin("A"), -200j + outward, atol=1e-10)
    np.testing.assert_allclose(forces.effort("small"), -4.0, atol=1e-12)
    np.testing.assert_allclose(forces.torques["teeth"], 8.0, atol=1e-12)
    assert forces.power_error < 1e-13


@pytest.mark.parametrize("ratio", [-2.0, 3.0, 0.25])
def test_acceleration_goes_through_the_ratio(ratio):
    motion = solve(plan(gear_pair(ratio)), np.linspace(0, 5, 7), 10.0, 4.0)
    forces = inverse(motion, {"small": Inertia(1.0, 0j, 0.02), "large": Inertia(2.0, 0j, 0.07)}).require()
    np.testing.assert_allclose(forces.effort("small"), (0.02 + 0.07 * ratio**2) * 4.0, rtol=1e-12)
    assert forces.power_error < 1e-13


def heavy_five_bar() -> Mechanism:
    """Geared cranks and a dyad, nothing of it symmetric."""
    return Mechanism(
        bodies=(
            Body(GROUND, {"A0": 0, "B0": 1 + 0.1j}),
            Body("left", {"A0": 0, "A": 0.3}),
            Body("right", {"B0": 0, "B": 0.25}),
            Body("one", {"A": 0, "P": 0.9}),
            Body("two", {"B": 0, "P": 1.1}),
        ),
        joints=(
            Pin("A0", GROUND, "left"),
            Pin("B0", GROUND, "right"),
            Pin("A", "left", "one"),
            Pin("B", "right", "two"),
            Pin("P", "one", "two"),
        ),
        inputs=(Rotation("left", "A0"),),
        branches={"P": +1},
        couplings=(Coupling("mesh", "gears", ("left", "A0"), ("right", "B0"), -0.5, 0.3, 2.0),),
    )


def planetary(driven: str) -> Mechanism:
    """Sun, planet off its middle, arm; the ring is the ground."""
    return Mechanism(
        bodies=(Body(GROUND, {"O": 0, "C": 0}), Body("sun", {"O": 0}), Body("arm", {"C": 0, "P": 0.042}),
                Body("planet", {"P": 0, "Q": 0.018})),
        joints=(Pin("O", GROUND, "sun"), Pin("C", GROUND, "arm"), Pin("P", "arm", "planet")),
        inputs=(Rotation(driven, "O" if driven == "sun" else "C"),),
        couplings=(
            Coupling("outside", "gears", ("sun", "O"), ("planet", "P"), -24 / 18, 0.0, 0.0, "arm"),
            Coupling("inside", "gears", (GROUND, "O"), ("planet", "P"), 60 / 18, 0.0, 0.0, "arm"),
        ),
    )  # fmt: skip


def rack(driven: str) -> Mechanism:
    """A pinion of 20 mm on a rack that slides on a slope."""
    return Mechanism(
        bodies=(Body(GROUND, {"O": 0, "way": -0.02j}), Body("pinion", {"O": 0}), Body("rack", {"way": 0})),
        joints=(Pin("O", GROUND, "pinion"), Slide("way", "rack", GROUND, along=0.5)),
        inputs=(Rotation("pinion", "O"),) if driven == "pinion" else (Displacement("way"),),
        couplings=(Coupling("mesh", "rack", ("pinion", "O"), ("rack", "way"), 0.02, 0.0, 0.0),),
    )


CASES = {
    "five-bar": heavy_five_bar(),
    "planetary, sun driven": planetary("sun"),
    "planetary, arm driven": planetary("arm"),
    "pinion drives rack": rack("pinion"),
    "rack drives pinion": rack("rack"),
}


@pytest.mark.parametrize("mechanism", CASES.values(), ids=CASES.keys())
def test_power_balances_with_masses_off_their_centres(mechanism):
    """The sum of the powers is formed without the equations that gave the forces."""
    value = np.linspace(0, 9, 50)
    motion = solve(plan(mechanism), value, 2 + np.sin(value), np.cos(value)).require()
    inertias = {
        body: Inertia(1.0 + k, complex(0.02 * k, -0.01), 0.01 * (k + 1)) for k, body in enumerate(mechanism.moving)
    }
    forces = inverse(motion, inertias, (Gravity(-9.81j), Torque(mechanism.moving[-1], 3.0))).require()
    assert np.abs(forces.input_power).max() > 0.1
    assert forces.power_error < 1e-12


def test_planetary_arm_carries_both_teeth_forces():
    """Static: torque on the arm = tooth force on both sides times the arm; the sun takes 24/84 of it [Willis]."""
    motion = solve(plan(planetary("sun")), np.array([0.7]), 1.0)
    forces = inverse(motion, {}, (Torque("arm", -7.0),)).require()
    np.testing.assert_allclose(forces.effort("sun"), 7.0 * 24 / 84, rtol=1e-12)
    along, line = 1j * motion.direction("arm"), np.cos(np.radians(20))
    outside, inside = forces.tooth("outside"), forces.tooth("inside")
    np.testing.assert_allclose(np.abs(outside), 7.0 / 0.042 / 2 / line, rtol=1e-12)
    np.testing.assert_allclose(outside + inside, 7.0 / 0.042 * along, rtol=1e-12)  # sun and ring press one another away


@pytest.mark.parametrize(("ratio", "kind"), [(-0.5, "belt"), (2.0, "belt"), (1.0, "belt"), (1.0, "gears")])
def test_a_belt_passes_its_torque_on_and_leaves_its_bearings_open(ratio, kind):
    motion = solve(plan(gear_pair(ratio, kind)), np.zeros(3), 1.0, 5.0)
    forces = inverse(motion, {"large": Inertia(1.0, 0j, 0.2)}, (Torque("large", -8.0),)).require()
    np.testing.assert_allclose(forces.torques["teeth"], 8.0 + 0.2 * 5.0 * ratio, rtol=1e-12)
    np.testing.assert_allclose(forces.effort("small"), ratio * (8.0 + 0.2 * 5.0 * ratio), rtol=1e-12)
    assert forces.undetermined.names == {"A", "B", "teeth"}
    assert np.isnan([forces.pin("A"), forces.pin("B"), forces.tooth("teeth")]).all()
    assert forces.power_error < 1e-13


def test_friction_in_a_bearing_that_a_belt_loads_leaves_the_drive_open():
    motion = solve(plan(gear_pair(-0.5, "belt")), np.zeros(3), 1.0)
    rubbing = inverse(motion, {}, (Torque("large", -8.0),), (PinFriction("A", 0.005, 0.1),))
    assert rubbing.undetermined.inputs == {"small"}
    assert np.isnan(rubbing.effort("small")).all()
    viscous = inverse(motion, {}, (Torque("large", -8.0),), (PinFriction("A", 0.0, 0.0, drag=0.1),))
    np.testing.assert_allclose(viscous.effort("small"), -4.0 + 0.1, rtol=1e-12)  # drag does not depend on the tension


def test_unknown_coupling_is_refused():
    forces = inverse(solve(plan(gear_pair()), np.zeros(1), 1.0), {})
    with pytest.raises(MechanismError, match="coupling is 'tooth'.*did you mean 'teeth'"):
        forces.tooth("tooth")
    pair = gear_pair()
    with pytest.raises(MechanismError, match="a joint and a coupling named 'A'"):
        dataclasses.replace(pair, couplings=(dataclasses.replace(pair.couplings[0], name="A"),))


def test_a_free_system_takes_no_couplings():
    motion = solve(plan(gear_pair()), np.zeros(1), 1.0)
    with pytest.raises(MechanismError, match="has a coupling 'teeth'; a general system has pins"):
        from_motion(motion, {})
