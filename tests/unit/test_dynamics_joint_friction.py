"""Friction in joints against derivations by hand: wedge-like slides, slider-crank, journal; locking; power balance."""

import numpy as np
import pytest
from benchmarks.random_mechanisms import random_inertias, random_mechanism

from ilmek.dynamics.inertia import Inertia
from ilmek.dynamics.inverse import inverse
from ilmek.dynamics.joint_friction import PinFriction, SlideFriction
from ilmek.dynamics.loads import Gravity, PointForce, Torque
from ilmek.errors import MechanismError
from ilmek.linkage.fourbar import four_bar, slider_crank
from ilmek.linkage.model import GROUND, Body, Displacement, Mechanism, Pin, Rotation, Slide
from ilmek.linkage.motion import Motion
from ilmek.linkage.solve import solve
from ilmek.linkage.status import Status
from ilmek.linkage.structure import plan

MASSES = {"rocker": Inertia(0.4, 0.115 + 0.01j, 2e-3)}
ANGLES = 0.01 + np.arange(48) * (2 * np.pi / 48)


def wedge(tilt: float) -> Motion:
    """A wedge driven along x; a shoe on its face of the slope `tilt` carries a follower in a vertical guide."""
    mechanism = Mechanism(
        bodies=(
            Body(GROUND, {"drive": 0, "guide": 0}),
            Body("wedge", {"drive": 0, "face": 0}),
            Body("shoe", {"face": 0, "knuckle": 0}),
            Body("follower", {"knuckle": 0, "guide": 0}),
        ),
        joints=(
            Slide("drive", "wedge", GROUND),
            Slide("face", "shoe", "wedge", along=np.pi - tilt),
            Pin("knuckle", "shoe", "follower"),
            Slide("guide", "follower", GROUND, along=np.pi / 2),
        ),
        inputs=(Displacement("drive"),),
        name="wedge",
    )
    return solve(plan(mechanism), np.array([0.1, 0.2]), np.array([1.0, -1.0]))


def face(coefficient: float) -> tuple[SlideFriction, ...]:
    return (SlideFriction("face", 0.1, coefficient),)


@pytest.mark.parametrize("tilt", [0.2, 0.5, 0.9])
def test_a_wedge_pushes_by_the_angle_of_friction(tilt: float) -> None:
    friction_angle = 0.3
    forces = inverse(wedge(tilt), {}, (PointForce("follower.knuckle", -100j),), face(np.tan(friction_angle)))
    # Pushed under the load by tan(tilt + rho), drawn out with tan(tilt - rho) of it holding back: inclined plane.
    sign = np.sign(wedge(tilt).point("follower", "knuckle").velocity.imag)
    assert sorted(sign) == [-1, 1]
    drive = np.abs(forces.effort("drive"))
    np.testing.assert_allclose(drive, 100 * np.abs(np.tan(tilt + sign * friction_angle)), rtol=1e-9)
    assert forces.power_error < 1e-12


def test_friction_in_the_guide_too_by_hand() -> None:
    tilt, mu, nu = 0.4, 0.2, 0.15
    rubbing = (*face(mu), SlideFriction("guide", 0.1, nu))
    forces = inverse(wedge(tilt), {}, (PointForce("follower.knuckle", -100j),), rubbing)
    lifted = wedge(tilt).point("follower", "knuckle").velocity.imag > 0
    # The face's resultant R stands at tilt + rho to the vertical: R cos = load + nu R sin.
    rho = np.arctan(mu)
    push = 100 * np.sin(tilt + rho) / (np.cos(tilt + rho) - nu * np.sin(tilt + rho))
    np.testing.assert_allclose(np.abs(forces.effort("drive"))[lifted], push, rtol=1e-9)
    assert forces.status.tolist() == [0, 0]


@pytest.mark.parametrize(("nu", "locks"), [(1.6, False), (1.7, True), (5.0, True)])
def test_beyond_a_friction_a_wedge_locks(nu: float, locks: bool) -> None:
    tilt, mu = 0.4, 0.15  # cos(tilt + rho) = nu sin(tilt + rho) at nu = 1 / tan(0.5489) = 1.636
    rubbing = (*face(mu), SlideFriction("guide", 0.1, nu))
    motion = wedge(tilt)
    forces = inverse(motion, {}, (PointForce("follower.knuckle", -100j),), rubbing)
    lifted = motion.point("follower", "knuckle").velocity.imag > 0
    assert (forces.status[lifted] == Status.NOT_CONVERGED).all() == locks
    assert np.isnan(forces.effort("drive")[lifted]).all() == locks
    if locks:
        with pytest.raises(MechanismError, match="wedge is self-locking by friction at"):
            forces.require()


def drawer(breadth: float, coefficient: float, speed: float = 1.0) -> tuple[Motion, tuple[SlideFriction, ...]]:
    """A drawer pulled 0.3 m beside its middle line by a rod along it: it jams where 2 mu 0.3 m > breadth."""
    mechanism = Mechanism(
        bodies=(
            Body(GROUND, {"pull": 0.3j, "rail": 0}),
            Body("puller", {"pull": 0, "knob": 0}),
            Body("link", {"knob": 0, "handle": 1.0}),
            Body("drawer", {"handle": 0.3j, "rail": 0}),
        ),
        joints=(
            Slide("pull", "puller", GROUND),
            Pin("knob", "puller", "link"),
            Pin("handle", "link", "drawer"),
            Slide("rail", "drawer", GROUND),
        ),
        inputs=(Displacement("pull"),),
        branches={"handle": -1},
        name="drawer",
    )
    return solve(plan(mechanism), 0.5, speed), (SlideFriction("rail", breadth, coefficient),)


@pytest.mark.parametrize("speed", [1.0, -1.0])
def test_a_drawer_pulled_aside_jams_by_its_breadth(speed: float) -> None:
    drag = PointForce("drawer.rail", -10.0 * np.sign(speed))
    for breadth, mu in ((0.5, 0.2), (0.25, 0.4), (0.2, 0.3)):
        motion, rubbing = drawer(breadth, mu, speed)
        forces = inverse(motion, {}, (drag,), rubbing)
        # F = 10 N + mu 2 C / b with the couple C = 0.3 m F
        np.testing.assert_allclose(np.abs(forces.effort("pull")), 10 / (1 - 0.6 * mu / breadth), rtol=1e-9)
    motion, rubbing = drawer(0.2, 0.34, speed)
    forces = inverse(motion, {}, (drag,), rubbing)
    assert forces.status.tolist() == [Status.NOT_CONVERGED]
    assert motion.ok


def test_slider_crank_by_hand() -> None:
    radius, rod, mu, mass = 0.1, 0.3, 0.12, 2.0
    motion = solve(plan(slider_crank(radius, rod, branch=+1)), ANGLES, 10.0)
    forces = inverse(motion, {"slider": Inertia(mass, 0j, 0.01)}, (), (SlideFriction("line", 0.1, mu),))
    slider = motion.point("slider", "B")
    lean = -radius * np.sin(ANGLES) / rod
    tangent = lean / np.sqrt(1 - lean**2)
    # m a = P + f, the guide gives -P tangent, f = -mu |P tangent| sgn(v): piecewise linear in the rod's push P.
    along, sense = mass * slider.acceleration.real, np.sign(slider.velocity.real)
    pushes = [along / (1 - mu * np.abs(tangent) * sense * sign) for sign in (1, -1)]
    push = np.where(pushes[0] > 0, pushes[0], pushes[1])
    np.testing.assert_allclose(forces.pin("B").real, push, rtol=1e-9)
    np.testing.assert_allclose(forces.frictions["line"], -mu * np.abs(push * tangent) * sense, atol=1e-9)
    assert forces.power_error < 1e-13


def test_a_journal_takes_mu_r_F_omega() -> None:
    mechanism = Mechanism(
        bodies=(Body(GROUND, {"O": 0}), Body("rotor", {"O": 0})),
        joints=(Pin("O", GROUND, "rotor"),),
        inputs=(Rotation("rotor", "O"),),
    )
    motion = solve(plan(mechanism), ANGLES, -30.0)
    rubbing = (PinFriction("O", 0.02, 0.1, drag=0.003),)
    forces = inverse(motion, {"rotor": Inertia(50.0, 0j, 1.0)}, (Gravity(-9.81j),), rubbing)
    np.testing.assert_allclose(forces.effort("rotor"), -0.1 * 0.02 * 50 * 9.81 - 0.003 * 30, rtol=1e-12)
    np.testing.assert_allclose(forces.frictions["O"], 0.1 * 0.02 * 50 * 9.81 + 0.003 * 30, rtol=1e-12)


def test_friction_turns_round_with_its_joint_and_has_a_limit_on_either_side() -> None:
    motion = solve(plan(slider_crank(0.1, 0.3, branch=+1)), np.array([np.pi, np.pi]), 10.0)
    load = (PointForce("slider.B", 20j),)
    forces = inverse(motion, {}, load, (SlideFriction("line", 0.1, 0.25),), side=np.array([-1.0, 1.0]))
    np.testing.assert_allclose(forces.frictions["line"], [5.0, -5.0], rtol=1e-9)


def test_every_joint_rubbing_is_consistent_and_closes_the_power_balance() -> None:
    draw = np.random.default_rng(7)
    usable = 0
    for _ in range(40):
        mechanism, values = random_mechanism(draw)
        at = {name: value + np.linspace(-0.1, 0.1, 4) for name, value in values.items()}
        motion = solve(plan(mechanism), at, {name: float(draw.uniform(1, 9)) for name in values})
        rubbing = tuple(
            PinFriction(joint.name, 0.02, 0.1, 0.01)
            if isinstance(joint, Pin)
            else SlideFriction(joint.name, 1.0, 0.05, 0.2)
            for joint in mechanism.joints
        )
        loads = (Gravity(-9.81j), Torque(mechanism.moving[-1], 30.0))
        forces = inverse(motion, random_inertias(draw, mechanism), loads, rubbing)
        good = forces.status == Status.OK
        usable += int(good.sum())
        assert forces.power_error < 1e-10
        for one in rubbing:
            if isinstance(one, PinFriction):
                pressed = 0.1 * 0.02 * np.abs(forces.pin(one.joint)[good])
                rates = [motion.omega(body)[good] for body in mechanism.joint(one.joint).bodies]
                spin = rates[1] - rates[0]
                expected = -pressed * np.sign(spin) - 0.01 * spin
                np.testing.assert_allclose(forces.frictions[one.joint][good], expected, rtol=1e-7, atol=1e-7)
    assert usable > 100


def test_a_linkage_that_starts_from_rest_has_friction_as_it_begins_to_move() -> None:
    written = plan(four_bar(0.3, 0.06, 0.2, 0.23, branch=+1))
    time = np.linspace(0.0, 1.0, 5)
    speed, acceleration = 30 * time**2 * (1 - time) ** 2, 60 * time * (1 - time) * (1 - 2 * time)
    angle = 10 * time**3 - 15 * time**4 + 6 * time**5
    pin = PinFriction("B", 0.01, 0.1)
    whole = inverse(solve(written, angle, speed, acceleration), MASSES, (), (pin,))
    for sample in (1, 2, 3):
        single = inverse(solve(written, angle[sample], speed[sample], acceleration[sample]), MASSES, (), (pin,))
        assert whole.effort("crank")[sample] == pytest.approx(single.effort("crank")[0], rel=1e-12)
    assert np.all(whole.frictions["B"][[0, -1]] == 0)
    starting = inverse(solve(written, np.ones(2), np.array([0.0, 1e-9]), 20.0), MASSES, (), (pin,))
    assert starting.frictions["B"][0] == pytest.approx(
        inverse(solve(written, 1.0, 1e-9, 20.0), MASSES, (), (pin,)).frictions["B"][0], rel=1e-6
    )
    assert starting.frictions["B"][0] != 0


def test_bad_friction_is_refused() -> None:
    motion = solve(plan(four_bar(0.3, 0.06, 0.2, 0.23, branch=+1)), ANGLES, 1.0)
    pin = PinFriction("B", 0.01, 0.1)
    for rubbing, words in (
        ((PinFriction("X", 0.01, 0.1),), "no joint 'X'"),
        ((SlideFriction("B", 0.1, 0.1),), "SlideFriction is given for 'B', a pin"),
        ((pin, pin), "given twice"),
    ):
        with pytest.raises(MechanismError, match=words):
            inverse(motion, {}, (), rubbing)
    with pytest.raises(MechanismError, match="its inputs stand still"):
        inverse(solve(motion.plan, ANGLES), {}, (), (pin,))
    with pytest.raises(MechanismError, match="coefficient of joint 'B' is -0.1"):
        PinFriction("B", 0.01, -0.1)
    with pytest.raises(MechanismError, match="breadth of slide 'B' is 0"):
        SlideFriction("B", 0.0, 0.1)
