"""Start and stop of a beat's crank: its torque against Newton and Euler, its energy against motion and fell."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ilmek.dynamics.inverse import inverse
from ilmek.dynamics.loads import PointForce
from ilmek.linkage.solve import solve
from ilmek.machines.beat_up import BeatUpParams, design
from ilmek.machines.beat_up.crank_start import CrankDuty, CrankStart, crank_start, start_checks
from ilmek.machines.beat_up.use_params import CrankStartParams
from ilmek.units import turn
from ilmek.weaving.fell import assumed_fabric

FABRIC = assumed_fabric(4e-3, 15.0, 1350.0, 1.5)


def started(speed: float = 15.5, mass: float = 2.5, run_up: float = 0.75, drive: str = "servo", **duty) -> CrankStart:
    linkage = design(BeatUpParams(speed=speed, beater_mass=mass, crank_rotation=duty.pop("rotation", np.pi)))
    settings = {"number": 1, "fabric": FABRIC, "warps": 6, "force": 10.0, "every": 6.0, **duty}
    return crank_start(CrankDuty(linkage, **settings), CrankStartParams(drive=drive, run_up=run_up))


drives = st.fixed_dictionaries(
    {
        "speed": st.floats(5.0, 40.0),
        "mass": st.floats(0.5, 100.0),
        "run_up": st.floats(0.3, 0.9),
        "rotation": st.floats(2.9, 3.5),
    }
)


@settings(max_examples=15)
@given(drives)
def test_torque_is_that_of_newton_and_euler(asked) -> None:
    """The same motion by the joint forces of every link, with the fell's force on the beater: no reduced inertia."""
    start = started(**asked)
    linkage = start.duty.linkage
    rise = np.gradient(start.speed, start.time)
    motion = solve(linkage.plan, start.angle, start.speed, rise)
    beater = motion.carried("rocker", linkage.plan.mechanism.point("rocker", "E"))
    speed = np.abs(beater.velocity)
    # The fell pushes the beater away from it, on its way there and back.
    away = np.where(start.angle < linkage.back_angle + turn - linkage.crank_rotation, -1, 1)
    direction = np.divide(away * beater.velocity, speed, out=np.zeros_like(beater.velocity), where=speed > 0)
    fell = PointForce("rocker.E", start.fell_force * direction)
    torque = inverse(motion, linkage.bodies, (fell,)).effort("crank")
    near = slice(2, -2)
    scale = np.max(np.abs(start.torque))
    # Numeric acceleration jumps at the ends of run-up and stop.
    wrong = np.abs(torque - start.torque)[near] > 0.02 * scale
    assert np.count_nonzero(wrong) <= 6


@settings(max_examples=15)
@given(drives)
def test_work_from_rest_to_rest_packs_the_row(asked) -> None:
    """Kinetic energy and stretched warps come back: what is left is the packing."""
    start = started(**{**asked, "mass": min(asked["mass"], 5.0)}, warps=600)
    packed = 600 * FABRIC.packing_work(float(FABRIC.spacing(10.0)))
    assert np.trapezoid(start.torque * start.speed, start.time) == pytest.approx(packed, rel=0.08)


@settings(max_examples=15)
@given(drives, st.sampled_from(["servo", "clutch"]))
def test_the_run_up_pays_motion_fell_and_losses(asked, drive) -> None:
    """Kinetic energy of every link at the end of the run-up, by their velocities."""
    start = started(**asked, drive=drive)
    linkage = start.duty.linkage
    end = int(np.argmin(np.abs(start.time - start.run_up_time)))
    motion = solve(linkage.plan, start.angle[end : end + 1], linkage.params.speed)
    energy = 0.0
    for name, body in linkage.bodies.items():
        centre = motion.carried(name, body.centre)
        energy += 0.5 * body.mass * abs(centre.velocity[0]) ** 2 + 0.5 * body.moment * float(motion.omega(name)[0]) ** 2
    assert start.run_up_energy == pytest.approx(energy, rel=1e-9)
    assert start.run_up_loss > 0
    assert start.run_up_work == pytest.approx(start.run_up_energy + start.run_up_loss, rel=1e-2, abs=1e-3)
    shaft, time = (start.torque * start.speed)[: end + 1], start.time[: end + 1]
    driven = np.trapezoid(np.where(shaft > 0, shaft / 0.9, shaft * 0.9), time)
    if drive == "clutch":
        slip = asked["speed"] - start.speed[: end + 1]
        driven += np.trapezoid(np.maximum(start.torque[: end + 1], 0) / 0.9 * slip, time)
    assert start.run_up_work == pytest.approx(driven, rel=0.01, abs=1e-3 * np.max(np.abs(start.torque)))


@given(st.floats(5.0, 40.0), st.floats(0.1, 1.0))
@settings(max_examples=10)
def test_time_from_rest_to_rest_is_the_integral_of_the_motion(speed, run_up) -> None:
    start = started(speed, run_up=run_up)
    assert start.beat_time == pytest.approx((1 + run_up) * turn / speed)
    turned = np.trapezoid(start.speed, start.time)
    assert turned == pytest.approx(turn, rel=1e-4)
    assert start.angle[-1] - start.angle[0] == pytest.approx(turn)
    at_beat = int(np.argmin(start.travel))
    assert start.travel[at_beat] < 1e-3 * start.travel[0]
    assert start.speed[at_beat] == pytest.approx(speed)


def test_a_clutch_loses_half_of_what_it_accelerates() -> None:
    """A constant torque to a constant inertia: the flywheel gives J w^2, the shaft has J w^2 / 2. Here J varies."""
    servo, clutch = started(drive="servo"), started(drive="clutch")
    assert clutch.run_up_work > 1.3 * servo.run_up_work
    assert clutch.start_flywheel * 15.5**2 * 0.1 == pytest.approx(clutch.start_work)


def test_strokes_lengthen_the_beat_by_a_turn_each() -> None:
    one, many = started(every=60.0), started(strokes=100, every=60.0)
    assert many.beat_time - one.beat_time == pytest.approx(99 * turn / 15.5)
    assert many.start_work > 50 * one.start_work


@pytest.mark.parametrize("long", [0.1, 0.59, 0.61, 4.6])
def test_a_flywheel_is_not_longer_than_wide(long: float) -> None:
    """A hollow cylinder of 600 by 200 mm has J = pi rho l (R^4 - r^4) / 2; a shorter one is thinner than its rim."""
    inertia = math.pi * 7850 * long * (0.3**4 - 0.1**4) / 2
    wheel = replace(started(drive="clutch"), start_flywheel=inertia)
    (check,) = (one for one in start_checks(wheel) if one.name == "length of the flywheel")
    assert check.ok is (long < 0.6)
    if long > 0.2:
        assert check.value == pytest.approx(long, rel=1e-9)
