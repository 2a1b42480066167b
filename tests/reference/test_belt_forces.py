"""What the tension of a belt leaves open, as the null space of all equations of all bodies in world coordinates.

A massless belt: any force F on its second wheel, -F on the first, and the torques of its pulls about both middles, in
balance. Wheels that turn alike by other means, as by an idler: any force on either, against their carrier.
"""

from collections.abc import Sequence

import numpy as np
import pytest

from ilmek.dynamics.inertia import Inertia
from ilmek.dynamics.inverse_run import InverseRun, inverse_run
from ilmek.dynamics.own_machine import OwnMachine
from ilmek.linkage.model import Body, Coupling, Mechanism, Pin, Rotation, Slide
from ilmek.linkage.solve import solve
from ilmek.linkage.structure import plan
from ilmek.plane.vectors import cross

GRAVITY = -9.81j

Ends = Sequence[tuple[str, complex, complex, float]]
"""What an unknown does to bodies: body, position, force, torque."""


def belted(kind: str, ratio: float, *, on_arm: bool) -> Mechanism:
    """A wheel on the ground, or on a driven arm, that turns a second one, with a slider-crank behind it."""
    carrier = "arm" if on_arm else "ground"
    own = {"O": 0, "W": 0.1j, "Q": 0.5 + 0.1j}
    ground = {"way": 0.1j, **({"O": 0} if on_arm else own)}
    bodies = [Body("ground", ground), Body("wheel", {"W": 0}), Body("second", {"Q": 0, "R": 0.2})]
    bodies += [Body("rod", {"R": 0, "P": 0.9}), Body("slider", {"P": 0, "way": 0.05})]
    joints = [Pin("W", carrier, "wheel"), Pin("Q", carrier, "second"), Pin("R", "second", "rod")]
    joints = [*joints, Pin("P", "rod", "slider")]
    inputs = [Rotation("wheel", "W")]
    if on_arm:
        bodies.append(Body("arm", own))
        joints.append(Pin("O", "ground", "arm"))
        inputs.append(Rotation("arm", "O"))
    belt = Coupling("belt", kind, ("wheel", "W"), ("second", "Q"), ratio, 0.0, 0.4, carrier)
    way = Slide("way", "slider", "ground")
    return Mechanism(tuple(bodies), (*joints, way), tuple(inputs), {"P": 1}, couplings=(belt,))


def unknowns(mechanism: Mechanism, run: InverseRun, k: int) -> list[tuple[str, Ends]]:
    """Name and ends of every unknown of one sample: joint or input, "torque" and "tension" of the belt."""
    motion, (belt,) = run.forces.motion, mechanism.couplings

    def at(body: str, point: str) -> complex:
        local = mechanism.point(body, point)
        return local if body == "ground" else motion.origin(body)[k] + motion.direction(body)[k] * local

    columns: list[tuple[str, Ends]] = []
    for joint in mechanism.joints:
        on, by = (joint.second, joint.first) if isinstance(joint, Pin) else (joint.body, joint.guide)
        place = at(on, joint.name)
        units = [(1 + 0j, 0.0), (1j, 0.0)] if isinstance(joint, Pin) else [(1j, 0.0), (0j, 1.0)]
        columns += [(joint.name, [(on, place, force, turn), (by, place, -force, -turn)]) for force, turn in units]
        columns += [
            (entry.name, [(on, place, 0j, 1.0), (by, place, 0j, -1.0)])
            for entry in mechanism.inputs
            if entry.joint == joint.name
        ]
    start, end = at("wheel", "W"), at("second", "Q")
    torque: list[tuple[str, complex, complex, float]] = [("second", end, 0j, 1.0), ("wheel", start, 0j, -belt.ratio)]
    columns.append(("torque", torque))
    for force in (1 + 0j, 1j):
        if belt.kind == "belt":
            columns.append(("tension", [("second", end, force, 0.0), ("wheel", start, -force, 0.0)]))
        else:
            for body, place in (("second", end), ("wheel", start)):
                columns.append(("tension", [(body, place, force, 0.0), (belt.carrier, place, -force, 0.0)]))
    return columns


def equations(
    machine: OwnMachine, run: InverseRun, k: int, columns: list[tuple[str, Ends]]
) -> tuple[np.ndarray, np.ndarray]:
    """Three rows of each body, Σ F = m a and Σ M = J alpha about its centre, and the balance of a belt's moments."""
    motion, bodies = run.forces.motion, machine.mechanism.moving
    m, y = np.zeros((3 * len(bodies) + 1, len(columns))), np.zeros(3 * len(bodies) + 1)
    for row, body in enumerate(bodies):
        inertia, rows = machine.inertias[body], slice(3 * row, 3 * row + 3)
        arm = motion.direction(body)[k] * inertia.centre
        centre, turning = motion.origin(body)[k] + arm, 1j * motion.alpha(body)[k] - motion.omega(body)[k] ** 2
        change = inertia.mass * (motion[body].acceleration[k] + turning * arm - GRAVITY)
        y[rows] = change.real, change.imag, inertia.moment * motion.alpha(body)[k]
        for column, (_, ends) in enumerate(columns):
            for _, place, force, torque in (end for end in ends if end[0] == body):
                m[rows, column] += np.array([force.real, force.imag, float(cross(place - centre, force)) + torque])
    (belt,) = machine.mechanism.couplings
    if belt.kind == "belt":
        for column, (name, ends) in enumerate(columns):
            if name in ("torque", "tension"):
                m[-1, column] = sum(torque + cross(place, force) for _, place, force, torque in ends)
    return m, y


@pytest.mark.parametrize("on_arm", [False, True])
@pytest.mark.parametrize(("kind", "ratio"), [("belt", 0.6), ("belt", -1.5), ("belt", 1.0), ("gears", 1.0)])
def test_what_a_belt_leaves_open_is_the_null_space(kind: str, ratio: float, on_arm: bool) -> None:
    mechanism = belted(kind, ratio, on_arm=on_arm)
    inertias = {body: Inertia(1.0 + k, 0.05 - 0.02j * k, 0.02 * (k + 1)) for k, body in enumerate(mechanism.moving)}
    values = {entry.name: np.linspace(0.2, 0.5 + k, 5) for k, entry in enumerate(mechanism.inputs)}
    motion = solve(plan(mechanism), values, dict.fromkeys(values, 4.0)).require()
    machine = OwnMachine(mechanism, inertias, gravity=GRAVITY)
    run = inverse_run(machine, motion, "wheel", np.arange(5.0))
    forces = run.forces
    for k in range(5):
        columns = unknowns(mechanism, run, k)
        m, y = equations(machine, run, k, columns)
        sizes = np.linalg.lstsq(m, y)[0]
        np.testing.assert_allclose(m @ sizes, y, atol=1e-9 * np.abs(y).max())
        loose = np.linalg.norm(np.linalg.svd(m)[2][np.linalg.matrix_rank(m) :], axis=0) > 1e-9
        left_open = {name for (name, _), free in zip(columns, loose, strict=True) if free} - {"tension"}
        assert left_open == forces.undetermined.joints == {"W", "Q"}
        found: dict[str, complex] = {}
        for size, (name, ends) in zip(sizes, columns, strict=True):
            found[name] = found.get(name, 0j) + size * (ends[0][2] or ends[0][3] * (name not in forces.couples))
        for name, force in forces.reactions.items():
            if name in (*left_open, "belt"):
                assert np.isnan(force[k])
            else:
                assert force[k] == pytest.approx(found[name], abs=1e-8), name
        for name, effort in forces.efforts.items():
            assert effort[k] == pytest.approx(found[name].real, abs=1e-8), name
        assert forces.torques["belt"][k] == pytest.approx(found["torque"].real, abs=1e-8)
    assert run.power_residual < 1e-11
    assert run.balance < 1e-11
