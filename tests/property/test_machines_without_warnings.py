"""Random machines with loads from Python's public face: no warning of numpy, finite forces wherever a sample is solved.

Warnings are errors in the test run. Lengths that meet at change points and dead centres are drawn on purpose.
"""

import numpy as np
from effort import examples, number
from hypothesis import example, given
from hypothesis import strategies as st

import ilmek
from ilmek.dynamics.friction import AngleRange, Friction, WindowedLoad
from ilmek.dynamics.inertia import Inertia
from ilmek.dynamics.input_loads import Drag, FollowerForce, TabulatedLoad
from ilmek.dynamics.joint_friction import JointFriction, PinFriction
from ilmek.dynamics.loads import Gravity, Load, PointForce, Torque
from ilmek.dynamics.motor_drive import MotorDrive
from ilmek.dynamics.own_machine import ForwardTask, NamedLoad, OwnMachine
from ilmek.dynamics.springs import Spring, TorsionSpring
from ilmek.linkage.model import Mechanism
from ilmek.linkage.status import Status

LENGTHS = st.sampled_from([0.1, 0.2, 0.3])
"""Few lengths, so that crank = rod, parallelograms and kites are drawn often."""

TIME = number(0.02, 0.05)
"""Of a run forward in time [s]."""

Numbers = tuple[str, tuple[float, float, float, float], int, float, float, float]
DESIGNS = st.tuples(
    st.sampled_from(["four-bar", "slider-crank"]),
    st.tuples(LENGTHS, LENGTHS, LENGTHS, LENGTHS),
    st.integers(0, 255),
    st.floats(-20.0, 20.0),
    st.floats(-10.0, 10.0),
    st.floats(0.0, 0.2),
)


def mechanism_of(kind: str, lengths: tuple[float, float, float, float]) -> Mechanism:
    if kind == "slider-crank":
        return ilmek.slider_crank(lengths[0], lengths[1], branch=+1)
    return ilmek.four_bar(*lengths, branch=+1)


def loads_of(mechanism: Mechanism, chosen: int, size: float, angle: float) -> list[Load]:
    """Some of the loads, by the bits of a number."""
    crank, follower = mechanism.moving[0], mechanism.moving[-1]
    fixed = next(iter(mechanism.body("ground").points))
    every: list[Load] = [
        PointForce((crank, "A"), size + 2j),
        FollowerForce((follower, "B"), 1 - size * 1j),
        Torque(follower, size),
        Drag((follower, "B"), abs(size)),
        TabulatedLoad(PointForce((follower, "B"), 1j), crank, (0.0, 1.0, 4.0), (size, 1.0, -size)),
        WindowedLoad(PointForce((crank, "A"), size * 1j), crank, AngleRange(0.3, angle)),
        Friction((follower, "B"), abs(size), crank),
        TorsionSpring("ground", mechanism.moving[1], abs(size), angle, 0.1),
    ]
    return [
        Spring(("ground", fixed), (crank, "A"), 10.0, 0.05, 0.1),
        *(load for k, load in enumerate(every) if chosen >> k & 1),
    ]


@examples(15, light=4)
@given(DESIGNS)
@example(("slider-crank", (0.1, 0.1, 0.1, 0.1), 255, 5.0, 3.0, 0.1))
@example(("four-bar", (0.3, 0.1, 0.3, 0.1), 255, 5.0, -8.0, 0.1))
@example(("four-bar", (0.2, 0.2, 0.2, 0.2), 129, -3.0, 9.0, 0.0))
def test_random_machines_give_no_warnings(design: Numbers) -> None:
    kind, lengths, chosen, size, angle, rubbing = design
    mechanism = mechanism_of(kind, lengths)
    inertias = {body: Inertia(0.2 + 0.1 * k, 0.01 - 0.02j, 0.003 * (k + 1)) for k, body in enumerate(mechanism.moving)}
    loads = loads_of(mechanism, chosen, size, angle)
    frictions: tuple[JointFriction, ...] = (PinFriction("A", 0.01, rubbing, 0.01),)
    motion = ilmek.solve(mechanism, np.linspace(0.0, 2 * np.pi, 73), speed=7.0)  # 0, 90, 180 degrees: dead centres
    forces = ilmek.inverse_dynamics(motion, inertias, [Gravity(-9.81j), *loads], frictions)
    solved = forces.status == Status.OK
    assert np.isfinite(forces.effort("crank")[solved]).all()
    assert all(np.isfinite(force[solved]).all() for force in forces.reactions.values())
    coasting = (
        ilmek.forward_dynamics(mechanism, inertias, TIME, position=0.4, speed=6.0, loads=loads, every=0.01)
        if motion.ok
        else None
    )
    assert coasting is None or np.isfinite(coasting.position).all()
    if not solved[::3].any():  # it may close nowhere: an error of its own
        return
    machine = OwnMachine(
        mechanism,
        inertias,
        gravity=-9.81j,
        loads=tuple(NamedLoad(f"load {k}", load) for k, load in enumerate(loads)),
        frictions=frictions,
        forward=ForwardTask(TIME, 0.4, 6.0, MotorDrive(2.0, 30.0)) if motion.status[5] == Status.OK else None,
    )
    found = ilmek.run_machine(machine, speed="70rpm", steps=24)
    assert found.forces is not None
    assert found.report.as_json()["checks"] is not None
