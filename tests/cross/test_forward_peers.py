"""The beat-up's crank-rocker let run: our reduced equation, our general systems, exudyn, mujoco.

Ours agree to 1e-8 of a radian. The peers step by a fixed h and are held to what their order leaves at that h: exudyn's
generalised alpha 3.7e-4 rad after 2 s at 2e-4 s, mujoco's soft loop 7.6e-4 rad at 1e-3 s; and their distance from ours
must fall as h does, so that the limit they run to is our answer.
"""

from functools import cache

import numpy as np
import pytest

from ilmek.dynamics.forward import ForwardState, forward
from ilmek.dynamics.inertia import bar
from ilmek.dynamics.loads import Gravity
from ilmek.dynamics.multibody.system import BodyTorque, from_motion, simulate
from ilmek.dynamics.reduced import reduce
from ilmek.linkage.fourbar import four_bar
from ilmek.linkage.solve import solve
from ilmek.linkage.structure import plan

pytest.importorskip("exudyn", reason="exudyn is not installed")
pytest.importorskip("mujoco", reason="mujoco is not installed")
from crank_rocker_peers import COUPLER, CRANK, FALL, GROUND_LINK, LENGTH, MASS, ROCKER, exudyn_angle, mujoco_angle

RUNS = {"free": (2.0, 20.0, 0.0, 0.0), "motor": (1.0, 0.0, 0.5, 0.01)}
"""Duration, speed at the start, torque, its fall with the speed."""


@cache
def ours(run: str) -> tuple[float, float]:
    """Crank angle at the end by the reduced equation and as a general system."""
    duration, speed, torque, drag = RUNS[run]
    planned = plan(four_bar(GROUND_LINK, CRANK, COUPLER, ROCKER, branch=+1))
    masses = {name: bar(0, length, mass=MASS[name]) for name, length in LENGTH.items()}
    weights = Gravity(-FALL * 1j)
    drive = lambda _t, _q, now: torque - drag * now  # noqa: E731
    reduced = forward(reduce(planned, masses, (weights,)), ForwardState(0.0, speed), duration, drive=drive, rtol=1e-11)
    twist = BodyTorque("crank", torque, drag)
    system = from_motion(solve(planned, 0.0, speed), masses, gravity=-FALL * 1j, loads=(twist,))
    general = simulate(system, np.array([0.0, duration]), rtol=1e-11)
    return float(reduced.position[-1]), float(general.angle("crank")[-1])


@pytest.mark.parametrize("run", RUNS)
def test_reduced_equation_and_general_system_agree(run: str) -> None:
    reduced, general = ours(run)
    assert abs(reduced - general) < 1e-8


@pytest.mark.parametrize("run", RUNS)
def test_exudyn_comes_to_our_angle_with_the_square_of_its_step(run: str) -> None:
    wanted, given = ours(run)[0], RUNS[run]
    coarse, fine = (abs(exudyn_angle(given[0], h, *given[1:]) - wanted) for h in (4e-4, 2e-4))
    assert fine < 6e-4
    assert 3.0 < coarse / fine < 5.0


@pytest.mark.parametrize("run", RUNS)
def test_mujoco_comes_to_our_angle_as_its_loop_stiffens(run: str) -> None:
    wanted, given = ours(run)[0], RUNS[run]
    coarse, fine = (abs(mujoco_angle(given[0], h, *given[1:]) - wanted) for h in (1e-3, 5e-4))
    assert coarse < 1e-3
    assert coarse / fine > 2.0
