"""General planar systems: against the reduced equation, inverse dynamics, statics and oscillators; what is refused."""

import math
from dataclasses import replace

import numpy as np
import pytest
from mechanisms import slotted_lever

from ilmek.dynamics.forward import ForwardState, forward
from ilmek.dynamics.inertia import Inertia
from ilmek.dynamics.inverse import inverse
from ilmek.dynamics.loads import Gravity
from ilmek.dynamics.multibody.system import (
    BodyForce,
    BodyState,
    BodyTorque,
    Event,
    Spring,
    System,
    from_motion,
    simulate,
)
from ilmek.dynamics.reduced import reduce
from ilmek.errors import MechanismError
from ilmek.linkage.fourbar import four_bar, slider_crank
from ilmek.linkage.model import GROUND, Body, Mechanism, Pin, Slide
from ilmek.linkage.solve import solve
from ilmek.linkage.structure import plan

GRAVITY = -9.81j
BLOCK = Body("block", {"S": 0, "eye": 0.1})


MACHINES = {
    "four-bar": four_bar(0.3, 0.0597, 0.2007, 0.2308, branch=+1),
    "slider-crank": slider_crank(0.1, 0.3, branch=+1, offset=0.02),
    "whitworth": slotted_lever(),
}


def masses(mechanism: Mechanism) -> dict[str, Inertia]:
    return {name: Inertia(0.3 + 0.1 * k, 0.05 + 0.01j * k, 1e-3 * (k + 1)) for k, name in enumerate(mechanism.moving)}


@pytest.mark.parametrize("kind", MACHINES)
def test_absolute_coordinates_and_the_reduced_equation_agree(kind: str) -> None:
    mechanism = MACHINES[kind]
    inertias = masses(mechanism)
    planned = plan(mechanism)
    drive = BodyTorque("crank", 0.4, 0.01)
    system = from_motion(solve(planned, 0.3, 9.0), inertias, gravity=GRAVITY, loads=(drive,))
    times = np.linspace(0.0, 0.04, 3)
    run = simulate(system, times, rtol=1e-11)
    reduced = reduce(planned, inertias, (Gravity(GRAVITY),))
    peer = forward(
        reduced, ForwardState(0.3, 9.0), 0.04, drive=lambda _t, _q, speed: 0.4 - 0.01 * speed, every=0.02, rtol=1e-9
    )
    assert np.max(np.abs(run.angle("crank") - peer.position)) < 1e-8
    assert np.max(np.abs(run.omega("crank") - peer.speed)) < 1e-7
    assert np.max(np.abs(run.alpha("crank") - peer.acceleration)) < 1e-5
    assert np.max(np.abs(run.energy_residual)) < 1e-9
    assert run.gap < 1e-14


def test_pin_forces_are_those_of_inverse_dynamics() -> None:
    mechanism = MACHINES["four-bar"]
    inertias, planned = masses(mechanism), plan(mechanism)
    system = from_motion(solve(planned, 0.3, 20.0), inertias, gravity=GRAVITY, loads=(BodyTorque("crank", 1.5),))
    run = simulate(system, np.linspace(0.0, 0.3, 7), rtol=1e-11)
    motion = solve(planned, run.angle("crank"), run.omega("crank"), run.alpha("crank"))
    forces = inverse(motion, inertias, (Gravity(GRAVITY),))
    assert np.max(np.abs(forces.effort("crank") - 1.5)) < 1e-8
    for pin in ("A0", "A", "B", "B0"):
        assert np.max(np.abs(run.pin(pin) - forces.pin(pin))) < 1e-7 * np.max(np.abs(forces.pin(pin)))


def oscillator(damping: float = 0.0, force: complex = 0j) -> System:
    """A block of 2 kg on a line at 30 degrees, held by a spring along it."""
    line = math.pi / 6
    spring = Spring((GROUND, "S"), "block.eye", 800.0, 0.1, damping)
    return System(
        (Body(GROUND, {"S": 0.5j}), BLOCK),
        (Slide("S", "block", GROUND, along=line),),
        {"block": Inertia(2.0, 0.05 + 0.02j, 0.1)},
        {"block": BodyState(0.5j + 0.07 * np.exp(1j * line), 2 * math.pi, 0j, 0.0)},
        loads=(replace(spring, second="block.S", length=0.05), BodyForce("block", "eye", force)),
    )


def test_a_block_on_a_spring_swings_at_its_frequency() -> None:
    times = np.linspace(0.0, 0.6, 13)
    run = simulate(oscillator(), times, rtol=1e-11)
    along = np.abs(run.position("block", "S") - 0.5j)
    assert np.max(np.abs(along - (0.05 + 0.02 * np.cos(20 * times)))) < 1e-9
    assert np.max(np.abs(run.energy_residual)) < 1e-10


def test_a_damped_and_pushed_block_balances_its_energy() -> None:
    run = simulate(oscillator(damping=30.0, force=3 - 4j), np.linspace(0.0, 2.0, 9), rtol=1e-10)
    assert np.max(np.abs(run.energy_residual)) < 1e-9
    assert run.energy[-1] < run.energy[0] + 0.2
    assert abs(run.velocity("block", "eye")[-1]) < 1e-3


def test_a_force_at_the_centre_of_mass_acts_as_gravity_does() -> None:
    inertia, pull = Inertia(2.0, 0.05 + 0.02j, 0.1), 3.0 - 4.0j
    bodies = (Body(GROUND, {"S": 0.5j}), Body("block", {"S": 0, "centre": inertia.centre}))
    states = {"block": BodyState(0.5j, 0.4, 0j, 1.0)}
    times = np.linspace(0.0, 0.5, 6)
    pendulum = System(bodies, (Pin("S", GROUND, "block"),), {"block": inertia}, states, gravity=pull)
    pushed = replace(pendulum, gravity=0j, loads=(BodyForce("block", "centre", inertia.mass * pull),))
    one, other = simulate(pendulum, times, rtol=1e-11), simulate(pushed, times, rtol=1e-11)
    assert np.max(np.abs(one.angle("block") - other.angle("block"))) < 1e-10
    assert np.max(np.abs(one.pin("S") - other.pin("S"))) < 1e-8
    assert np.ptp(one.angle("block")) > 0.2


def test_redundant_joints_change_nothing() -> None:
    line = math.pi / 6
    plain = oscillator()
    bodies = (Body(GROUND, {"S": 0.5j, "S2": 0.5j}), Body("block", {"S": 0, "S2": 0, "eye": 0.1}))
    twice = replace(plain, bodies=bodies, joints=(*plain.joints, Slide("S2", "block", GROUND, along=line)))
    times = np.linspace(0.0, 0.6, 5)
    one, two = simulate(plain, times), simulate(twice, times)
    assert np.max(np.abs(one.position("block", "S") - two.position("block", "S"))) < 1e-12
    halves = two.reactions[:, 0] - two.reactions[:, 2]
    assert np.max(np.abs(halves)) < 1e-9 * np.max(np.abs(two.reactions))


def test_gaping_or_parting_joints_are_refused() -> None:
    system = oscillator()
    pose = system.poses["block"]
    with pytest.raises(MechanismError, match=r"'S'.*has a gap of"):
        simulate(replace(system, poses={"block": replace(pose, origin=pose.origin + 0.01j)}), np.array([0.0, 1.0]))
    with pytest.raises(MechanismError, match=r"'S'.*separates at"):
        simulate(replace(system, poses={"block": replace(pose, velocity=1 - 1j)}), np.array([0.0, 1.0]))


def test_systems_that_make_no_sense_are_refused() -> None:
    system = oscillator()
    with pytest.raises(MechanismError, match="moment 0 kg"):
        replace(system, inertias={"block": Inertia(1.0, 0j, 0.0)})
    with pytest.raises(MechanismError, match="no inertia"):
        replace(system, inertias={})
    with pytest.raises(MechanismError, match="no point 'T'"):
        replace(system, joints=(Pin("T", "block", GROUND),))
    with pytest.raises(MechanismError, match="no body 'wheel'"):
        replace(system, joints=(Pin("S", "wheel", GROUND),))
    with pytest.raises(MechanismError, match="acts on 'wheel'"):
        replace(system, loads=(BodyTorque("wheel", 1.0),))
    with pytest.raises(MechanismError, match="finite"):
        replace(system, poses={"block": BodyState(complex(math.nan))})


def test_mechanisms_that_are_no_such_system_are_refused() -> None:
    motion = solve(plan(MACHINES["four-bar"]), 0.3, 9.0)
    inertias = masses(MACHINES["four-bar"])
    with pytest.raises(MechanismError, match="no body 'wheel'"):
        from_motion(motion, {**inertias, "wheel": Inertia(1.0, 0j, 1.0)})
    with pytest.raises(MechanismError, match="'coupler' of four-bar has no inertia"):
        from_motion(motion, {"crank": inertias["crank"]})
    with pytest.raises(MechanismError, match="gravity of four-bar is"):
        from_motion(motion, inertias, gravity=complex(math.nan))
    with pytest.raises(MechanismError, match="torque=nan"):
        from_motion(motion, inertias, loads=(BodyTorque("crank", math.nan),))
    with pytest.raises(MechanismError, match="no point 'Z'"):
        from_motion(motion, inertias, loads=(BodyForce("crank", "Z", 1.0 + 0j),))
    with pytest.raises(MechanismError, match="value of event 'x' is nan"):
        simulate(from_motion(motion, inertias), np.array([0.0, 0.1]), events=(Event("x", lambda _course: math.nan),))


def test_times_and_errors_that_make_no_sense_are_refused() -> None:
    for times, rtol in (([0.0], 1e-9), ([1.0, 0.0], 1e-9), ([0.0, math.inf], 1e-9), ([0.0, 1.0], 0.0)):
        with pytest.raises(MechanismError, match="times of a run|relative error"):
            simulate(oscillator(), np.array(times), rtol=rtol)


def test_a_run_without_steps_enough_says_how_far_it_came() -> None:
    with pytest.raises(MechanismError, match=r"reached 0\.\d+ s of 5 s; 10 steps"):
        simulate(oscillator(), np.array([0.0, 5.0]), steps=10)
    with pytest.raises(MechanismError, match="no pin 'S'"):
        simulate(oscillator(), np.array([0.0, 0.01])).pin("S")
