"""Forces of own machines against calculations that share no code with the engine's force equations.

Slider-crank: closed-form kinematics and the 8 equations of Newton and Euler as one matrix [Norton, Design of Machinery,
section 11.4]. Jansen's leg: drive torque by virtual power, rates by Fourier series of the positions. Class III and
every example: all equations of all bodies as one matrix in world coordinates.
"""

import dataclasses
from collections.abc import Iterator, Mapping
from pathlib import Path

import numpy as np
import pytest
from tests.support.mechanisms import triad

from ilmek.dynamics.inertia import Inertia, bar
from ilmek.dynamics.inverse_run import InverseRun, all_loads, inverse_run
from ilmek.dynamics.loads import PointForce, Torque
from ilmek.dynamics.own_machine import NamedLoad, OwnMachine
from ilmek.io.mechanism_file import read_mechanism
from ilmek.linkage.fourbar import slider_crank
from ilmek.linkage.model import Body, Coupling, Mechanism, Pin, Rotation, Slide
from ilmek.linkage.solve import solve
from ilmek.linkage.structure import plan
from ilmek.plane.vectors import cross, dot

EXAMPLES = Path(__file__).parents[2] / "examples"
GRAVITY = -9.81j


def moved(machine: OwnMachine, values: np.ndarray, speed: float) -> InverseRun:
    name = machine.mechanism.inputs[0].name
    motion = solve(plan(machine.mechanism), values, speed)
    return inverse_run(machine, motion, name, (values - values[0]) / speed)


def test_a_slider_crank_has_the_forces_of_newton_and_euler_by_hand() -> None:
    """Crank r, rod l, slider: crank and rod of uniform bars, 5 kg slider, press force P against the motion."""
    r, length, omega, push = 0.05, 0.2, 40.0, -800.0
    crank, rod, mass = bar(0, r, mass=1.0, width=0.04), bar(0, length, mass=1.2, width=0.03), 5.0
    machine = OwnMachine(
        slider_crank(r, length, branch=+1),
        {"crank": crank, "rod": rod, "slider": Inertia(mass, 0j, 0.0)},
        gravity=GRAVITY,
        loads=(NamedLoad("press", PointForce("slider.B", complex(push))),),
    )
    angle = np.linspace(0, 2 * np.pi, 73)
    found = moved(machine, angle, omega)
    forces = found.forces
    for k, q in enumerate(angle):
        # The rod's angle phi, its rates, and the centres' accelerations, from the loop r e^iq + l e^iphi = x.
        sine = -r / length * np.sin(q)
        cosine = np.sqrt(1 - sine**2)
        phi1 = -r * omega * np.cos(q) / (length * cosine)
        phi2 = (r * omega**2 * np.sin(q) + length * sine * phi1**2) / (length * cosine)
        e, f = complex(np.cos(q), np.sin(q)), complex(cosine, sine)
        a_pin, centre = -(omega**2) * r * e, length / 2 * f
        a_rod = a_pin + (1j * phi2 - phi1**2) * centre
        a_slider = (a_pin + (1j * phi2 - phi1**2) * length * f).real
        # Unknowns: F01x F01y F12x F12y F23x F23y N T; the force Fij acts from body i on body j.
        m, y = np.zeros((8, 8)), np.zeros(8)
        arm = r / 2 * e
        m[0, [0, 2]], m[1, [1, 3]] = (1, -1), (1, -1)
        change = crank.mass * (-(omega**2) * arm - GRAVITY)
        y[0], y[1] = change.real, change.imag
        m[2] = [arm.imag, -arm.real, arm.imag, -arm.real, 0, 0, 0, 1]  # about the crank's centre, at constant speed
        m[3, [2, 4]], m[4, [3, 5]] = (1, -1), (1, -1)
        y[3], y[4] = (rod.mass * (a_rod - GRAVITY)).real, (rod.mass * (a_rod - GRAVITY)).imag
        m[5] = [0, 0, centre.imag, -centre.real, centre.imag, -centre.real, 0, 0]
        y[5] = rod.moment * phi2
        m[6, 4], y[6] = 1, mass * a_slider - push
        m[7, [5, 6]], y[7] = (1, 1), mass * 9.81
        by_hand = np.linalg.solve(m, y)
        pins = [forces.pin("A0", "crank")[k], forces.pin("A", "rod")[k], forces.pin("B", "slider")[k]]
        ours = [part for force in pins for part in (force.real, force.imag)]
        ours += [forces.pin("line", "slider")[k].imag, forces.effort("crank")[k]]
        np.testing.assert_allclose(ours, by_hand, atol=1e-10 * np.abs(by_hand).max())
        shaking = -(crank.mass * -(omega**2) * arm + rod.mass * a_rod + mass * a_slider)
        assert found.shaking.force[k] == pytest.approx(shaking, rel=1e-11)
        assert found.frame.force[k] == pytest.approx(-complex(by_hand[0], by_hand[1] + by_hand[6]), abs=1e-8)


def fourier_rate(values: np.ndarray) -> np.ndarray:
    """d/dq of samples at equal steps over a turn, without its end."""
    number = np.fft.fftfreq(len(values), 1 / len(values))
    return np.fft.ifft(1j * number * np.fft.fft(values))


def test_jansens_leg_needs_the_torque_of_virtual_power() -> None:
    """T omega = Σ (m a · v + J alpha omega) - Σ F · v, with rates by Fourier series of the positions alone."""
    mechanism = read_mechanism(EXAMPLES / "jansen_leg.toml").mechanism
    inertias = {
        body: Inertia(0.1 * (k + 1), complex(np.mean(list(mechanism.body(body).points.values()))), 1e-5 * (k + 1))
        for k, body in enumerate(mechanism.moving)
    }
    foot = NamedLoad("ground", PointForce("leg.F", 12 + 30j))
    machine = OwnMachine(mechanism, inertias, gravity=GRAVITY, loads=(foot,))
    speed, samples = 7.0, 1024
    angle = np.arange(samples) * 2 * np.pi / samples
    run = moved(machine, angle, speed)
    motion, power = run.forces.motion, np.zeros(samples)
    for body, inertia in inertias.items():
        position = motion.origin(body) + motion.direction(body) * inertia.centre
        velocity = speed * fourier_rate(position)
        acceleration = speed * fourier_rate(velocity)
        omega = speed * (fourier_rate(motion.direction(body)) / (1j * motion.direction(body))).real
        alpha = speed * fourier_rate(omega).real
        power += inertia.mass * dot(acceleration - GRAVITY, velocity) + inertia.moment * alpha * omega
    position = motion.origin("leg") + motion.direction("leg") * mechanism.point("leg", "F")
    power -= dot(12 + 30j, speed * fourier_rate(position))
    np.testing.assert_allclose(run.effort, power / speed, atol=1e-9 * np.abs(power).max())
    assert run.power_residual < 1e-12
    assert run.balance < 1e-12


Place = tuple[complex, complex]
"""Origin and direction of a body."""


def transmitted(
    mechanism: Mechanism, place: Mapping[str, Place], flanks: Mapping[str, int]
) -> Iterator[tuple[str, str, str, complex, complex, float]]:
    """Name, body, other body, position, unit force and unit couple of all that joints, teeth and the drive transmit.

    flanks  coupling -> +1 or -1, the flank of its teeth that carries; default: +1
    """

    def at(body: str, point: str) -> complex:
        return complex(place[body][0] + place[body][1] * mechanism.point(body, point))

    for joint in mechanism.joints:
        if isinstance(joint, Pin):
            on, by = joint.second, joint.first
            units, drive = [(1 + 0j, 0.0), (1j, 0.0)], (0j, 1.0)
        else:
            on, by = joint.body, joint.guide
            line = complex(place[by][1] * np.exp(1j * joint.along))
            units, drive = [(1j * line, 0.0), (0j, 1.0)], (line, 0.0)
        yield from ((joint.name, on, by, at(on, joint.name), *unit) for unit in units)
        if any(entry.joint == joint.name for entry in mechanism.inputs):
            yield "drive", on, by, at(on, joint.name), *drive
    for mesh in mechanism.couplings:
        start, end = at(*mesh.first), at(*mesh.second)
        if mesh.kind == "rack":
            (way,) = (joint for joint in mechanism.joints if isinstance(joint, Slide) and joint.name == mesh.second[1])
            along = place[mesh.carrier][1] * np.exp(1j * way.along)
            pole, from_teeth = start - 1j * mesh.ratio * along, -1j * np.sign(mesh.ratio) * along
        else:
            pole = start + mesh.ratio / (mesh.ratio - 1) * (end - start)  # where both rims have the same velocity
            along, small = 1j * (end - start) / abs(end - start), abs(end - pole) < abs(start - pole)
            # Teeth press a wheel towards its own middle; of a ring and a wheel in it the wheel, and the ring outward.
            from_teeth = -(start - pole) / abs(start - pole) if mesh.ratio > 0 and not small else end - pole
            from_teeth = from_teeth / abs(from_teeth)
        side = flanks.get(mesh.name, 1) * np.tan(mesh.pressure_angle)
        yield mesh.name, mesh.second[0], mesh.first[0], pole, along + side * from_teeth, 0.0


def all_at_once(
    machine: OwnMachine, run: InverseRun, k: int, flanks: Mapping[str, int] | None = None
) -> dict[str, tuple[complex, float]]:
    """Force and couple of each joint and coupling, and the drive's effort, of one sample: three equations of each body
    in world coordinates, solved as one system. Pins have two unknowns, slides a cross force and a couple, teeth one
    along their line of action; where that pulls, the other flank carries.
    """
    mechanism, motion = machine.mechanism, run.forces.motion
    bodies, load = mechanism.moving, {body: np.zeros(3) for body in mechanism.moving}
    place = {body: (motion.origin(body)[k], motion.direction(body)[k]) for body in bodies}
    place["ground"] = (0j, 1 + 0j)
    inertia = {body: machine.inertias.get(body, Inertia(0.0, 0j, 0.0)) for body in bodies}
    centre = {body: place[body][0] + place[body][1] * inertia[body].centre for body in bodies}

    def acting(body: str, at: complex, force: complex, torque: float = 0.0) -> np.ndarray:
        return np.array([force.real, force.imag, cross(at - centre[body], force) + torque])

    for one in all_loads(machine):
        for wrench in one.wrenches(motion, inertia):
            if wrench.body != "ground":
                force, torque = (np.broadcast_to(each, len(motion))[k] for each in (wrench.force, wrench.torque))
                at = place[wrench.body][0] + place[wrench.body][1] * wrench.at
                load[wrench.body] += acting(wrench.body, at, force, torque)
    units = list(transmitted(mechanism, place, flanks or {}))
    m, y = np.zeros((3 * len(bodies), len(units))), np.zeros(3 * len(bodies))
    for row, body in enumerate(bodies):
        rates = 1j * motion.alpha(body)[k] - motion.omega(body)[k] ** 2
        arm = centre[body] - place[body][0]
        change = inertia[body].mass * (motion[body].acceleration[k] + rates * arm)
        rows = slice(3 * row, 3 * row + 3)
        y[rows] = np.array([change.real, change.imag, inertia[body].moment * motion.alpha(body)[k]]) - load[body]
        for column, (_, on, by, at, force, couple) in enumerate(units):
            if body in (on, by):
                m[rows, column] = (1.0 if body == on else -1.0) * acting(body, at, force, couple)
    assert m.shape[0] == m.shape[1]
    scale = np.tile([1.0, 1.0, 10.0], len(bodies))
    sizes = np.linalg.solve(m * scale[:, None], y * scale)
    if flanks is None and mechanism.couplings:
        pulling = {unit[0] for size, unit in zip(sizes, units, strict=True) if size < 0}
        return all_at_once(
            machine, run, k, {mesh.name: -1 if mesh.name in pulling else 1 for mesh in mechanism.couplings}
        )
    assert all(
        size * flank >= 0 for size, unit in zip(sizes, units, strict=True) if (flank := (flanks or {}).get(unit[0]))
    )
    found: dict[str, tuple[complex, float]] = {}
    for size, (name, _, _, _, force, couple) in zip(sizes, units, strict=True):
        before = found.get(name, (0j, 0.0))
        found[name] = before[0] + size * force, before[1] + size * couple
    return found


def compare(machine: OwnMachine, values: np.ndarray, speed: float) -> None:
    run = moved(machine, values, speed)
    forces, driven = run.forces, machine.mechanism.inputs[0]
    assert forces.motion.ok
    for k in range(len(values)):
        found = all_at_once(machine, run, k)
        size = max(abs(force) for force, _ in found.values())
        for name, force in forces.reactions.items():
            assert force[k] == pytest.approx(found[name][0], abs=1e-9 * size), name
        for name, couple in forces.couples.items():
            assert couple[k] == pytest.approx(found[name][1], abs=1e-9 * size), name
        joint = machine.mechanism.joint(driven.joint)
        sign = (
            1.0 if driven.name in ((joint.second if isinstance(joint, Pin) else joint.name), joint.bodies[-1]) else -1.0
        )
        assert forces.effort(driven.name)[k] * sign == pytest.approx(sum(found["drive"]).real, abs=1e-9 * size)
    assert run.power_residual < 1e-11
    assert run.balance < 1e-11


def test_a_class_three_mechanism_has_the_forces_of_all_equations_at_once() -> None:
    mechanism = triad()
    inertias = {
        body: Inertia(1.0 + k, complex(np.mean(list(mechanism.body(body).points.values()))) + 0.1j, 0.2 + 0.1 * k)
        for k, body in enumerate(mechanism.moving)
    }
    loads = (NamedLoad("work", PointForce("plate.P", 50 - 20j)), NamedLoad("brake", Torque("left", -3.0)))
    compare(OwnMachine(mechanism, inertias, gravity=GRAVITY, loads=loads), np.linspace(-0.2, 0.25, 13), 3.0)


MACHINES = [
    path
    for path in sorted(EXAMPLES.glob("*.toml"))
    if "[joints]" in path.read_text(encoding="utf-8") and read_mechanism(path).machine.has_forces
]


@pytest.mark.parametrize("path", MACHINES, ids=lambda path: path.stem)
def test_every_example_has_the_forces_of_all_equations_at_once(path: Path) -> None:
    """Without the friction of joints: six-bars, quick return, Klann's and Jansen's legs, gears, class III, springs."""
    machine = dataclasses.replace(read_mechanism(path).machine, frictions=())
    compare(machine, np.linspace(0.1, 6.2, 9), 5.0)


def geared(kind: str) -> Mechanism:
    """A driven wheel in mesh with a second one, which drives a slider by a rod; or a pinion whose rack does."""
    ratio, middle = {"external": (-0.4, 0.7), "in a ring": (3.0, 0.4), "ring around": (0.4, 0.3j - 0.2)}[kind]
    wheels = Coupling("mesh", "gears", ("wheel", "O"), ("second", "Q"), ratio, 0.2, 1.0)
    return Mechanism(
        bodies=(
            Body("ground", {"O": 0, "Q": middle, "way": 0.4j}),
            Body("wheel", {"O": 0.01}),
            Body("second", {"Q": 0, "R": 0.2}),
            Body("rod", {"R": 0, "P": 1.1}),
            Body("slider", {"P": 0.02j, "way": -0.1}),
        ),
        joints=(
            Pin("O", "ground", "wheel"),
            Pin("Q", "ground", "second"),
            Pin("R", "second", "rod"),
            Pin("P", "rod", "slider"),
            Slide("way", "slider", "ground", along=0.3),
        ),
        inputs=(Rotation("wheel", "O"),),
        branches={"P": 1},
        couplings=(wheels,),
    )


def racked(ratio: float) -> Mechanism:
    """A driven pinion on either side of its rack, which slides on a slope and pushes a rocker by a rod."""
    return Mechanism(
        bodies=(
            Body("ground", {"O": 0.1, "way": 0.2 - 0.1j, "S": 1.0 + 0.3j}),
            Body("pinion", {"O": 0.01j}),
            Body("bar", {"way": 0, "R": 0.3}),
            Body("rod", {"R": 0, "T": 0.5}),
            Body("rocker", {"T": 0.4, "S": 0}),
        ),
        joints=(
            Pin("O", "ground", "pinion"),
            Slide("way", "bar", "ground", along=0.4, turned=0.1),
            Pin("R", "bar", "rod"),
            Pin("T", "rod", "rocker"),
            Pin("S", "ground", "rocker"),
        ),
        inputs=(Rotation("pinion", "O"),),
        branches={"T": -1},
        couplings=(Coupling("mesh", "rack", ("pinion", "O"), ("bar", "way"), ratio, 0.0, 0.05),),
    )


@pytest.mark.parametrize("angle", [0.0, 20.0, 28.0])
@pytest.mark.parametrize(
    "mechanism",
    [geared("external"), geared("in a ring"), geared("ring around"), racked(0.15), racked(-0.15)],
    ids=["external", "in a ring", "ring around", "rack", "rack on the other side"],
)
def test_teeth_have_the_forces_of_all_equations_at_once(mechanism: Mechanism, angle: float) -> None:
    """Both flanks carry within a turn; with a pressure angle every bearing takes the force that separates the teeth."""
    mesh = dataclasses.replace(mechanism.couplings[0], pressure_angle=np.radians(angle))
    mechanism = dataclasses.replace(mechanism, couplings=(mesh,))
    inertias = {body: Inertia(1.0 + k, 0.05 - 0.02j * k, 0.02 * (k + 1)) for k, body in enumerate(mechanism.moving)}
    values = np.linspace(-0.7, 0.7, 15)
    bare = dataclasses.replace(mechanism, couplings=(dataclasses.replace(mesh, pressure_angle=0.0),))
    flanks = []
    for size in (400.0, -400.0):
        push = PointForce("bar.R", size * np.exp(0.4j)) if mesh.kind == "rack" else Torque("second", size)
        loads = (NamedLoad("push", push),)
        compare(OwnMachine(mechanism, inertias, gravity=GRAVITY, loads=loads), values, 6.0)
        along, tooth = (
            moved(OwnMachine(own, inertias, gravity=GRAVITY, loads=loads), values, 6.0).forces.tooth("mesh")
            for own in (bare, mechanism)
        )
        np.testing.assert_allclose(np.abs(tooth) * np.cos(mesh.pressure_angle), np.abs(along), rtol=1e-9)
        flanks.append(along)
    assert np.all(dot(*flanks) < 0)  # one flank carries, then the other
