"""Joint forces found group by group, against all equations at once; virtual power of random mechanisms."""

import numpy as np
import pytest
from benchmarks.random_mechanisms import random_inertias, random_mechanism

from ilmek.dynamics.inertia import Inertia
from ilmek.dynamics.inverse import Forces, inverse
from ilmek.dynamics.loads import Gravity, PointForce, Torque
from ilmek.linkage.model import GROUND, Body, Mechanism, Pin, Rotation
from ilmek.linkage.motion import Motion
from ilmek.linkage.solve import solve
from ilmek.linkage.status import Status
from ilmek.linkage.structure import plan

WEIGHT = 3.0 - 9.0j


def dense(motion: Motion, bodies: dict[str, Inertia]) -> dict[str, np.ndarray]:
    """Forces in the joints under weight, from one system a sample about the world's origin; slides: across the line."""
    mechanism = motion.plan.mechanism
    row = {body: 3 * place for place, body in enumerate(mechanism.moving)}
    matrix = np.zeros((len(motion), 3 * len(row), 3 * len(row)))
    right = np.zeros((len(motion), 3 * len(row)))
    column, names = 0, []

    def act(body: str, force: np.ndarray | complex, at: np.ndarray, torque: float, sign: int) -> None:
        if body in row:
            moment = np.imag(np.conj(at) * force) + torque
            for offset, part in enumerate((np.real(force), np.imag(force), moment)):
                matrix[:, row[body] + offset, column] += sign * part

    for joint in mechanism.joints:
        on, by = (joint.second, joint.first) if isinstance(joint, Pin) else joint.bodies
        at = motion.point(on, joint.name).position
        line = 1.0 if isinstance(joint, Pin) else motion.direction(by) * np.exp(1j * joint.along)
        wrenches = [(1 + 0j, 0.0), (1j, 0.0)] if isinstance(joint, Pin) else [(1j * line, 0.0), (0j, 1.0)]
        if any(entry.joint == joint.name for entry in mechanism.inputs):
            wrenches.append((0j, 1.0) if isinstance(joint, Pin) else (line, 0.0))
        for force, torque in wrenches:
            act(on, force, at, torque, +1)
            act(by, force, at, torque, -1)
            names.append((joint.name, force))
            column += 1
    for body, inertia in bodies.items():
        centre = motion.carried(body, inertia.centre)
        force = inertia.mass * (centre.acceleration - WEIGHT)
        moment = np.imag(np.conj(centre.position) * force) + inertia.moment * motion.alpha(body)
        right[:, row[body] : row[body] + 3] = np.stack((force.real, force.imag, moment), axis=-1)
    usable = motion.status == Status.OK
    sizes = np.full(right.shape, np.nan)
    sizes[usable] = np.linalg.solve(matrix[usable], right[usable, :, None])[..., 0]
    found = {joint.name: np.zeros(len(motion), complex) for joint in mechanism.joints}
    driven_lines = {joint.name for joint in mechanism.joints if not isinstance(joint, Pin)}
    counted: dict[str, int] = {}
    for place, (name, force) in enumerate(names):
        counted[name] = counted.get(name, 0) + 1
        if not (name in driven_lines and counted[name] == 3):  # what drives a slide is no reaction
            found[name] += sizes[:, place] * force
    return found


def assert_dense(motion: Motion, bodies: dict[str, Inertia], forces: Forces, error: float = 1e-12) -> None:
    expected = dense(motion, bodies)
    size = max((float(np.nanmax(np.abs(force), initial=0.0)) for force in expected.values()), default=0.0)
    for name, force in expected.items():
        np.testing.assert_allclose(forces.pin(name), force, rtol=0, atol=error * size)


def moved(draw: np.random.Generator, count: int, **how: bool) -> tuple[Motion, dict[str, Inertia]]:
    mechanism, values = random_mechanism(draw)
    at = {name: value + np.linspace(-0.05, 0.05, count) for name, value in values.items()}
    speeds = {name: float(draw.uniform(-9, 9)) for name in values}
    spurts = {name: float(draw.uniform(-50, 50)) for name in values}
    return solve(plan(mechanism, **how), at, speeds, spurts), random_inertias(draw, mechanism)


def well_held(motion: Motion) -> bool:
    """Whether the equations are well conditioned: near a dead centre two solutions differ by what rounding is there."""
    return bool((motion.status == Status.OK).any()) and all(
        float(np.nanmax(np.abs(motion.omega(body)))) < 1e3 for body in motion.plan.mechanism.moving
    )


@pytest.mark.parametrize("seed", range(6))
def test_groups_one_by_one_agree_with_all_equations_at_once(seed: int) -> None:
    draw = np.random.default_rng(seed)
    compared = 0
    while compared < 8:
        motion, bodies = moved(draw, 4)
        if well_held(motion):
            assert_dense(motion, bodies, inverse(motion, bodies, (Gravity(WEIGHT),)), 1e-11)
            compared += 1


def test_a_group_left_to_newton_agrees_too() -> None:
    motion, bodies = moved(np.random.default_rng(5), 4, closed_forms=False)
    assert (motion.status == Status.OK).all()
    assert_dense(motion, bodies, inverse(motion, bodies, (Gravity(WEIGHT),)))


def six_bar(draw: np.random.Generator) -> Mechanism:
    """A crank-rocker whose rocker, or coupler, drives a second rocker: Watt's and Stephenson's chains."""
    crank, coupler, rocker, link = draw.uniform(0.05, 0.08), *draw.uniform(0.24, 0.3, 3)
    carrier = str(draw.choice(("coupler", "rocker")))
    return Mechanism(
        bodies=(
            Body(GROUND, {"O": 0, "C": 0.3, "F": 0.55 + 0.05j}),
            Body("crank", {"O": 0, "A": crank}),
            Body("coupler", {"A": 0, "B": coupler, "D": coupler / 2 + 0.06j}),
            Body("rocker", {"C": 0, "B": rocker, "D": rocker / 2 + 0.06j}),
            Body("rod", {"D": 0, "E": link + 0.1}),
            Body("lever", {"F": 0, "E": link}),
        ),
        joints=(
            Pin("O", GROUND, "crank"),
            Pin("A", "crank", "coupler"),
            Pin("B", "coupler", "rocker"),
            Pin("C", GROUND, "rocker"),
            Pin("D", carrier, "rod"),
            Pin("E", "rod", "lever"),
            Pin("F", "lever", GROUND),
        ),
        inputs=(Rotation("crank", "O"),),
        branches={"B": +1, "E": int(draw.choice((-1, 1)))},
    )


@pytest.mark.parametrize("seed", range(4))
def test_six_bars_over_a_turn(seed: int) -> None:
    draw = np.random.default_rng(seed)
    mechanism = six_bar(draw)
    motion = solve(plan(mechanism), np.linspace(0, 2 * np.pi, 60), 12.0, -30.0)
    bodies = random_inertias(draw, mechanism)
    assert (motion.status == Status.OK).mean() > 0.5
    assert_dense(motion, bodies, inverse(motion, bodies, (Gravity(WEIGHT),)))


def test_virtual_power_of_random_mechanisms() -> None:
    draw = np.random.default_rng(2026)
    usable = 0
    for _ in range(250):
        motion, bodies = moved(draw, 5)
        last = motion.plan.mechanism.moving[-1]
        loads = (
            Gravity(WEIGHT),
            Torque(last, 3.0),
            PointForce((last, 0.3 - 0.2j), lambda moved, last=last: -20 * moved.carried(last, 0.3 - 0.2j).velocity),
        )
        assert inverse(motion, bodies, loads).power_error < 1e-10
        usable += int((motion.status == Status.OK).sum())
    assert usable > 1000
