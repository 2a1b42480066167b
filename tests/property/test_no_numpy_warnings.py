"""No call of the public face lets a warning of NumPy through: random mechanisms, at dead centres and beyond limits."""

import warnings
from dataclasses import replace

import numpy as np
import pytest
from benchmarks.random_mechanisms import random_inertias, random_mechanism
from hypothesis import given
from hypothesis import strategies as st

import ilmek
from ilmek.dynamics.own_machine import OwnMachine
from ilmek.errors import MechanismError
from ilmek.io.mechanism_file import MechanismFile
from ilmek.linkage.batch import solve_batch
from ilmek.linkage.fourbar import four_bar, slider_crank
from ilmek.linkage.model import Displacement, Mechanism
from ilmek.linkage.status import Status
from ilmek.linkage.structure import plan
from ilmek.linkage.transmission import transmission_angles

TURN = 2 * np.pi
SINGULAR = {
    "crank = rod": slider_crank(0.04, 0.04, branch=+1),
    "parallelogram": four_bar(0.3, 0.1, 0.3, 0.1, branch=+1),
    "kite": four_bar(0.3, 0.3, 0.1, 0.1, branch=-1),
    "closes partly": four_bar(0.3, 0.2, 0.2, 0.23, branch=+1),
    "toggle": four_bar(0.3, 0.1, 0.2, 0.2, branch=+1),
}


def use_everything(mechanism: Mechanism, values: dict[str, np.ndarray], machine: OwnMachine) -> None:
    """Motion by both executors with all its results, and the machine with forces, as a user calls them."""
    speeds, accelerations = dict.fromkeys(values, 2.0), dict.fromkeys(values, 0.5)
    for motion in (
        ilmek.solve(mechanism, values, speed=speeds, acceleration=accelerations),
        solve_batch(plan(mechanism), values, speeds, accelerations),
    ):
        motion.table()
        transmission_angles(motion)
        for body in mechanism.moving:
            assert len(motion[body].beta) == len(motion)
            assert np.isfinite(motion.omega(body)[motion.status == Status.OK]).all()
            assert not np.isinf(motion.omega(body)).any()
        ilmek.inverse_dynamics(motion, machine.inertias, [ilmek.Gravity(machine.gravity)])
    units = {entry.name: "m" if isinstance(entry, Displacement) else "rad" for entry in mechanism.inputs}
    first, *others = values
    held = {name: f"{float(values[name][0])!r}{units[name]}" for name in others}
    low, high = (f"{float(end)!r}{units[first]}" for end in values[first][[0, -1]])
    try:
        run = ilmek.run_machine(MechanismFile(machine), over=f"{low}..{high}", steps=24, fixed=held)
    except MechanismError:
        return  # it closes nowhere in this range
    assert run.table()
    assert run.report.as_json()


@given(st.integers(0, 2**32))
def test_random_mechanisms_give_no_warning(seed: int) -> None:
    draw = np.random.default_rng(seed)
    mechanism, drawn = random_mechanism(draw)
    mechanism = replace(mechanism, pose={})  # of either branch, not of the drawn one alone
    values = {name: value + np.linspace(0.0, 3.0, 25) for name, value in drawn.items()}
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        use_everything(mechanism, values, OwnMachine(mechanism, random_inertias(draw, mechanism), gravity=-9.81j))


@pytest.mark.parametrize("name", SINGULAR)
def test_singular_mechanisms_give_no_warning(name: str) -> None:
    mechanism = SINGULAR[name]
    inertias = random_inertias(np.random.default_rng(1), mechanism)
    (entry,) = mechanism.inputs
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        use_everything(mechanism, {entry.name: np.linspace(0.0, TURN, 25)}, OwnMachine(mechanism, inertias))
