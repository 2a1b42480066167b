"""Pins with clearance: restitution, losses, rest, friction, momentum; what is refused."""

import math
from dataclasses import replace

import numpy as np
import pytest

from ilmek.dynamics.clearance import LAWS, ClearancePin, exact_hysteresis, hertz_stiffness
from ilmek.dynamics.inertia import Inertia
from ilmek.dynamics.multibody.system import BodyState, System, simulate, with_clearance
from ilmek.errors import MechanismError
from ilmek.linkage.model import GROUND, Body

CLEARANCE, RADIUS, MASS, MOMENT = 1e-4, 9e-3, 0.2, 1e-5
STEEL = hertz_stiffness(RADIUS, CLEARANCE, 207e9)
PIN = ClearancePin("P", GROUND, "disc", CLEARANCE, RADIUS, STEEL)


def disc(pin: ClearancePin, pose: BodyState, gravity: complex = 0j) -> System:
    """A journal alone in a bearing of the ground."""
    bodies = (Body(GROUND, {"P": 0}), Body("disc", {"P": 0}))
    return System(bodies, (pin,), {"disc": Inertia(MASS, 0j, MOMENT)}, {"disc": pose}, gravity)


def rebound(pin: ClearancePin, speed: float) -> tuple[float, float]:
    """Speed after an impact over the speed before, energy lost over the energy before."""
    run = simulate(
        disc(pin, BodyState(0j, 0.0, speed + 0j)),
        np.array([0.0, (1 + 0.5 / pin.restitution) * CLEARANCE / speed]),
        rtol=1e-10,
    )
    after = -float(np.real(run.velocity("disc", "P")[-1]))
    return after / speed, -float(np.asarray(run.work)[-1]) / (MASS * speed**2 / 2)


@pytest.mark.parametrize("restitution", [0.1, 0.5, 0.9, 0.9995, 1.0])
@pytest.mark.parametrize(("speed", "exponent"), [(0.3, 1.5), (0.03, 1.5), (0.3, 1.0)])
def test_a_bouncing_journal_keeps_its_restitution(restitution: float, speed: float, exponent: float) -> None:
    stiffness = STEEL if exponent == 1.5 else 1e8
    pin = replace(PIN, restitution=restitution, exponent=exponent, stiffness=stiffness)
    kept, lost = rebound(pin, speed)
    assert abs(kept - restitution) < 5e-5
    assert abs(lost - (1 - restitution**2)) < 1e-5


def test_published_hystereses_keep_the_restitution_roughly_where_they_are_meant_to() -> None:
    assert abs(rebound(replace(PIN, restitution=0.9, law="lankarani-nikravesh"), 0.3)[0] - 0.9) < 0.02
    for restitution in (0.2, 0.5, 0.9):
        assert abs(rebound(replace(PIN, restitution=restitution, law="flores"), 0.3)[0] - restitution) < 0.05
    assert rebound(replace(PIN, restitution=0.2, law="lankarani-nikravesh"), 0.3)[0] > 0.6


@pytest.mark.parametrize("restitution", [0.3, 0.7, 0.95, 0.998, 0.9991, 0.9999])
def test_the_exact_hysteresis_leaves_the_work_of_the_rebound(restitution: float) -> None:
    """The integral of u du / (1 + h u) from -e to 1 vanishes: here by Gauss' rule, u being the speed."""
    nodes, weights = np.polynomial.legendre.leggauss(200)
    u = (1 - restitution) / 2 + (1 + restitution) / 2 * nodes
    work = weights * u / (1 + exact_hysteresis(restitution) * u)
    assert abs(work.sum()) < 1e-12 * np.abs(work).sum()


def test_all_hystereses_meet_for_nearly_elastic_contacts() -> None:
    for law in LAWS.values():
        assert law(1.0) == 0
        assert law(0.9999) / 1e-4 == pytest.approx(1.5, rel=0.07)
    assert exact_hysteresis(0.99899) == pytest.approx(exact_hysteresis(0.99901), rel=0.03)


@pytest.mark.parametrize("direction", [1, -1j])
def test_the_peak_of_an_elastic_impact_is_that_of_hertz(direction: complex) -> None:
    """All the kinetic energy is in the contact: M v^2 / 2 = K d^2.5 / 2.5, F = K d^1.5."""
    speed = 0.3
    pose = BodyState(0j, 0.0, speed * direction)
    run = simulate(disc(replace(PIN, restitution=1.0), pose), np.array([0.0, 2 * CLEARANCE / speed]), rtol=1e-10)
    depth = (1.25 * MASS * speed**2 / STEEL) ** 0.4
    assert run.peaks["P"] == pytest.approx(STEEL * depth**1.5, rel=0.02)


def test_two_journals_rest_in_their_own_bearings() -> None:
    pins = [replace(PIN, name=name, second=f"disc {name}", restitution=0.5) for name in "PQR"]
    bodies = (Body(GROUND, dict.fromkeys("PQR", 0)), *(Body(pin.second, {pin.name: 0}) for pin in pins))
    masses = dict(zip("PQR", (MASS, 2 * MASS, 3 * MASS), strict=True))
    inertias = {pin.second: Inertia(masses[pin.name], 0j, MOMENT) for pin in pins}
    poses = {pin.second: BodyState(0j) for pin in pins}
    run = simulate(System(bodies, tuple(pins), inertias, poses, -9.81j), np.array([0.0, 0.25]))
    for name, mass in masses.items():
        assert run.pin(name)[-1] == pytest.approx(mass * 9.81j, rel=1e-5)


def test_a_journal_comes_to_rest_at_the_depth_of_hertz() -> None:
    run = simulate(disc(replace(PIN, restitution=0.5), BodyState(0j), gravity=-9.81j), np.array([0.0, 0.2]))
    assert run.pin("P")[-1] == pytest.approx(MASS * 9.81j, rel=1e-6)
    depth = -np.imag(run.eccentricity("P")[-1]) - CLEARANCE
    assert depth == pytest.approx((MASS * 9.81 / STEEL) ** (2 / 3), rel=1e-6)
    assert np.max(np.abs(run.energy_residual)) < 1e-9


def test_friction_turns_a_pressed_journal_about_the_angle_of_friction() -> None:
    friction, spin, weight = 0.2, 300.0, MASS * 9.81
    angle = math.atan(friction)
    depth = (weight * math.cos(angle) / STEEL) ** (2 / 3)
    place = -1j * (CLEARANCE + depth) * np.exp(1j * angle)
    pin = replace(PIN, friction=friction, slip=1e-6)
    run = simulate(disc(pin, BodyState(complex(place), 0.0, 0j, -spin), gravity=-9.81j), np.array([0.0, 1e-6]))
    mirrored = simulate(disc(pin, BodyState(-complex(place).conjugate(), 0.0, 0j, spin), -9.81j), np.array([0.0, 1e-6]))
    assert np.abs(run.pin("P")[0]) == pytest.approx(weight, rel=1e-9)
    braking = weight * math.sin(angle) * RADIUS / MOMENT
    for course, sign in ((run, 1), (mirrored, -1)):
        assert course.alpha("disc")[0] == pytest.approx(sign * braking, rel=1e-6)
        assert course.pin("P")[0] == pytest.approx(1j * weight, rel=1e-6)


def test_two_free_bodies_keep_their_momentum_and_their_spin() -> None:
    pin = replace(PIN, first="ring", restitution=0.7, friction=0.3)
    bodies = (Body(GROUND, {}), Body("ring", {"P": 0.02j}), Body("disc", {"P": -0.01}))
    masses = {"ring": Inertia(0.5, 0.01 + 0j, 4e-4), "disc": Inertia(0.2, 0j, 2e-5)}
    origin = complex(0.02j * np.exp(0.1j) + 0.01 * np.exp(0.4j))
    poses = {"ring": BodyState(0j, 0.1, 0.2 + 0j, 3.0), "disc": BodyState(origin, 0.4, 0.3j, -40.0)}
    run = simulate(System(bodies, (pin,), masses, poses), np.linspace(0.0, 0.02, 11), rtol=1e-10)
    assert run.peaks["P"] > 100
    mass = np.array([0.5, 0.2])
    centre = run.states[:, [0, 3]] + 1j * run.states[:, [1, 4]]
    speed = run.slopes[:, [0, 3]] + 1j * run.slopes[:, [1, 4]]
    order = [run.system.order.index(name) for name in ("ring", "disc")]
    momentum = speed[:, order] @ mass
    moment = np.imag(np.conj(centre) * speed)[:, order] @ mass + run.omega("ring") * 4e-4 + run.omega("disc") * 2e-5
    assert np.max(np.abs(momentum - momentum[0])) < 1e-12
    assert np.max(np.abs(moment - moment[0])) < 1e-12
    assert np.max(np.abs(run.energy_residual)) < 1e-8


@pytest.mark.parametrize(
    ("what", "value"),
    [("clearance", 0.0), ("radius", -1.0), ("stiffness", math.nan), ("restitution", 0.0), ("restitution", 1.1),
     ("friction", -0.1), ("exponent", 0.5), ("slip", 0.0), ("law", "newton")],
)  # fmt: skip
def test_clearance_pins_that_make_no_sense_are_refused(what: str, value: float | str) -> None:
    with pytest.raises(MechanismError, match=f"{what} of clearance pin 'P'"):
        replace(PIN, **{what: value})  # type: ignore[arg-type]


def test_places_of_clearance_that_are_not_there_are_refused() -> None:
    with pytest.raises(MechanismError, match="modulus -1"):
        hertz_stiffness(RADIUS, CLEARANCE, -1.0)
    system = disc(PIN, BodyState(0j))
    with pytest.raises(MechanismError, match="no pin 'Q'"):
        with_clearance(system, replace(PIN, name="Q"))
    with pytest.raises(MechanismError, match="no pin with clearance 'Q'"):
        simulate(system, np.array([0.0, 1e-6])).eccentricity("Q")


@pytest.mark.parametrize("restitution", [0.9, 1.0])
def test_an_oblique_impact_without_friction_is_not_limited_by_rounding_of_a_spin_of_0(restitution: float) -> None:
    pose = BodyState(0.5j * CLEARANCE, 0.0, 0.3 + 0.1j)
    system = disc(replace(PIN, restitution=restitution), pose)
    run = simulate(system, np.array([0.0, 20 * CLEARANCE / 0.3]), steps=2000)
    balance = run.energy - run.energy[0] - run.work
    assert np.max(np.abs(balance)) < 1e-4 * run.energy[0]
