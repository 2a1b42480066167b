"""A motor elsewhere than the motion: forces of a linkage that its rocker leads and its crank drives.

The judge is the same motion given at the crank, where motor and motion are at one joint: another order of groups in the
equations, and no superposition.
"""

from dataclasses import replace

import numpy as np
import pytest
from tests.support.mechanisms import CRANK_ROCKER

from ilmek.dynamics.inertia import Inertia
from ilmek.dynamics.inverse import Forces, inverse
from ilmek.dynamics.joint_friction import JointFriction, PinFriction
from ilmek.dynamics.loads import Gravity, Load, PointForce
from ilmek.errors import MechanismError
from ilmek.io.mechanism_file import MechanismFile, parse_mechanism
from ilmek.jobs.mechanism.analysis import analysis
from ilmek.jobs.mechanism.request import MotionRequest
from ilmek.jobs.mechanism.run import run
from ilmek.linkage.fourbar import four_bar
from ilmek.linkage.model import Rotation
from ilmek.linkage.motion import Motion
from ilmek.linkage.solve import solve
from ilmek.linkage.structure import plan

FILE = """\
name = "drive from the output"
inputs = { D = "rocker" }
branches = { B = 1 }
gravity = "9.81m/s^2"
motions.D.steps = [
{ to = "115deg", time = "0.5s", law = "cycloidal" }, { to = "80deg", time = "0.5s", law = "cycloidal" } ]
motions.D.start = "80deg"
[bodies]
ground.points = { A = [0, 0], D = ["200mm", 0] }
crank = { length = "80mm", mass = "0.3kg" }
coupler = { length = "200mm", mass = "0.5kg" }
rocker = { length = "120mm", mass = "0.4kg" }
[joints]
A.pin = ["ground", "crank"]
B.pin = ["crank", "coupler"]
C.pin = ["coupler", "rocker"]
D.pin = ["ground", "rocker"]
"""


def led_by_rocker(extra: str = "") -> MechanismFile:
    return parse_mechanism(extra + FILE)


def by_crank(motion: Motion) -> Motion:
    """The same motion with its values, speeds and accelerations given at the crank."""
    mechanism = motion.plan.mechanism
    crank = replace(mechanism, inputs=(Rotation("crank", "A"),))
    angle = np.unwrap(np.angle(motion.direction("crank")))
    for branch in (1, -1):
        written = plan(replace(crank, branches={"C": branch}, pose={}))
        found = solve(written, angle, motion.omega("crank"), motion.alpha("crank"))
        if np.allclose(found.direction("rocker"), motion.direction("rocker"), rtol=0, atol=1e-9):
            return found
    raise AssertionError("no branch of the crank has this motion")


def forces_of(
    motion: Motion, actuators: tuple[str, ...] = (), frictions: tuple[JointFriction, ...] = (), side: float = 1.0
) -> Forces:
    loads: list[Load] = [Gravity(-9.81j), PointForce("coupler.C", 3 - 5j)]
    inertias = {
        "crank": Inertia(0.3, 0.04, 2e-4),
        "coupler": Inertia(0.5, 0.1 + 0.01j, 1.7e-3),
        "rocker": Inertia(0.4, 0.06, 5e-4),
    }
    return inverse(motion, inertias, loads, frictions, actuators=actuators, side=side)


@pytest.mark.parametrize("frictions", [(), (PinFriction("B", 0.008, 0.2), PinFriction("D", 0.01, 0.15, 0.002))])
def test_forces_are_those_of_the_same_motion_given_at_the_motor(frictions: tuple[JointFriction, ...]) -> None:
    led = run(led_by_rocker(), MotionRequest(fixed={})).motion
    driven = by_crank(led)
    theirs, ours = forces_of(driven, (), frictions), forces_of(led, ("A",), frictions)
    size = np.max(np.abs(theirs.reactions["B"]))
    for joint in "ABCD":
        assert np.max(np.abs(ours.reactions[joint] - theirs.reactions[joint])) < 1e-9 * size
    torque = theirs.effort("crank")
    assert np.max(np.abs(ours.effort("A") - torque)) < 1e-9 * np.max(np.abs(torque))
    assert list(ours.efforts) == ["A"]
    assert ours.power_error < 1e-12


def test_a_motor_at_the_rocker_has_the_power_of_one_at_the_crank() -> None:
    motion = solve(plan(four_bar(0.3, 0.06, 0.25, 0.2, branch=1)), np.linspace(0.3, 1.2, 7), 5.0)
    weights = {"rocker": Inertia(0.4, 0.1, 1e-3)}
    own = inverse(motion, weights).effort("crank")
    rocker = inverse(motion, weights, actuators=("B0",))
    assert np.allclose(rocker.effort("B0") * motion.omega("rocker"), own * 5.0, rtol=1e-9)
    with pytest.raises(MechanismError, match="2 actuators.*as many as inputs: 1"):
        inverse(motion, weights, actuators=("A0", "B0"))


def test_a_servo_is_chosen_at_the_motor_of_the_file() -> None:
    file = led_by_rocker('servo = "A"\nactuators = { A = "torque" }\n')
    found = analysis(run(file, MotionRequest(fixed={})))
    assert found.servo is not None
    assert found.run.forces is not None
    assert found.run.forces.driver == "A"
    assert found.run.forces.drive_torque_max == pytest.approx(np.max(np.abs(found.run.forces.forces.effort("A"))))


def test_an_actuator_at_its_dead_centre_fails_a_check_and_gives_no_force() -> None:
    """Coupler and rocker of a crank-rocker turn back against each other twice in a turn of the crank."""
    file = parse_mechanism('actuators = { C = "torque" }\ngravity = "9.81m/s^2"\n' + CRANK_ROCKER)
    found = analysis(run(file, MotionRequest(fixed={}, speed="1rad/s")))
    assert [(check.name, check.value) for check in found.checks if not check.ok] == [("dead centres of actuator C", 2)]
    assert found.run.forces is not None
    effort = found.run.forces.forces.effort("C")
    assert np.isnan(effort[-1])
    assert np.nanmax(np.abs(effort)) < 1e3
    apart = run(file, MotionRequest(fixed={}, speed="1rad/s", over="20deg..160deg"))
    assert all(check.ok for check in analysis(apart).checks)


@pytest.mark.parametrize(
    ("line", "message"),
    [
        ('actuators = { A = "force" }', "is a force; in this joint a torque"),
        ('actuators = { E = "torque" }', "there is no joint 'E'"),
        ('actuators = { A = "torque", C = "torque" }', "2 actuators and 1 input"),
        ('actuators = { A = "push" }', "push"),
        ('actuators = { A = "torque" }\nservo = "D"', "there is no actuator 'D'"),
    ],
)
def test_actuators_that_cannot_drive_are_refused(line: str, message: str) -> None:
    with pytest.raises(MechanismError, match=message):
        led_by_rocker(line + "\n")
