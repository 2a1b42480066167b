"""Forward runs against the energy integral: t = ∫ sqrt(J / 2 (E + W - V)) dq, J and V by Freudenstein-style formulas.

The linkage is that of the project's comparison of solvers (`fb-free`, `fb-spin`): crank-rocker .3/.0597/.2007/.2308 m,
.129/.434/.649 kg, J = m L²/12, fall 9.81 m/s². `fb-spin` is said there to make 99.6 turns in 2 s.
"""

from collections.abc import Iterable, Mapping
from itertools import pairwise

import numpy as np
import pytest

from ilmek.dynamics.forward import ForwardState, forward
from ilmek.dynamics.inertia import Inertia, bar
from ilmek.dynamics.input_loads import Drag, FollowerForce
from ilmek.dynamics.inverse import inverse
from ilmek.dynamics.loads import Gravity, Load, Torque, Wrench
from ilmek.dynamics.reduced import ReducedMechanism, reduce
from ilmek.dynamics.springs import Spring
from ilmek.linkage.fourbar import four_bar
from ilmek.linkage.motion import Motion
from ilmek.linkage.structure import plan

G, A, B, C = 0.3, 0.0597, 0.2007, 0.2308
MASS = (0.129, 0.434, 0.649)
FALL = 9.81
NODES, WEIGHTS = np.polynomial.legendre.leggauss(400)


def linkage() -> ReducedMechanism:
    bodies = {
        name: bar(0, length, mass=mass)
        for name, length, mass in zip(("crank", "coupler", "rocker"), (A, B, C), MASS, strict=True)
    }
    return reduce(plan(four_bar(G, A, B, C, branch=+1)), bodies, (Gravity(-FALL * 1j),))


def by_hand(q: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """J and V of the linkage, by arcs and sines, without the engine."""
    pin = A * np.exp(1j * q)
    reach = np.abs(G - pin)
    turned = np.arccos((B**2 + reach**2 - C**2) / (2 * B * reach))
    coupler = np.angle(G - pin) + turned
    end = pin + B * np.exp(1j * coupler)
    rocker = np.angle(end - G)
    wb = A * np.sin(rocker - q) / (B * np.sin(coupler - rocker))
    wc = A * np.sin(coupler - q) / (C * np.sin(coupler - rocker))
    middle = 1j * pin + 0.5j * B * wb * np.exp(1j * coupler)
    inertia = MASS[0] * A**2 / 3 + MASS[1] * (np.abs(middle) ** 2 + B**2 * wb**2 / 12) + MASS[2] * C**2 * wc**2 / 3
    heights = MASS[0] * pin.imag / 2 + MASS[1] * (pin + end).imag / 2 + MASS[2] * end.imag / 2
    return inertia, FALL * heights


def time_to(q: float, speed: float, torque: float) -> float:
    """Time from 0 to q by Gauss's rule, quarter turn by quarter turn; q = u² at first where the start is from rest."""
    (inertia,), (height,) = by_hand(np.zeros(1))
    energy = height + inertia * speed**2 / 2

    def pace(at: np.ndarray) -> np.ndarray:
        j, v = by_hand(at)
        return np.sqrt(j / (2 * (energy + torque * at - v)))

    first = 0.05
    half = np.sqrt(first) / 2
    roots = half * (NODES + 1)
    total = half * float(WEIGHTS @ (2 * roots * pace(roots**2)))
    edges = np.linspace(first, q, max(2, int(q / 1.5)))
    for low, high in pairwise(edges):
        half = (high - low) / 2
        total += half * float(WEIGHTS @ pace(low + half * (NODES + 1)))
    return total


@pytest.mark.parametrize(("rtol", "error"), [(1e-9, 3e-8), (1e-12, 5e-11)])
def test_a_free_run_takes_the_time_that_its_energy_says(rtol: float, error: float) -> None:
    run = forward(linkage(), ForwardState(0.0, 20.0), 2.0, rtol=rtol)
    assert abs(time_to(float(run.position[-1]), 20.0, 0.0) - 2.0) < error
    assert run.energy_error < 10 * rtol


def test_a_constant_torque_spins_it_up_as_its_work_says() -> None:
    run = forward(linkage(), ForwardState(0.0), 2.0, drive=lambda _t, _q, _w: 0.5, rtol=1e-11)
    assert round(float(run.position[-1]) / (2 * np.pi), 1) == 99.6
    assert abs(time_to(float(run.position[-1]), 0.0, 0.5) - 2.0) < 1e-8
    assert np.allclose(run.drive_work, 0.5 * run.position, rtol=0, atol=1e-8)


def test_the_motion_of_a_run_needs_the_effort_that_drove_it() -> None:
    def motor(time: float, _q: float, speed: float) -> float:
        return 0.8 - 0.02 * speed + 0.1 * np.sin(40 * time)

    run = forward(linkage(), ForwardState(0.3, 5.0), 0.5, drive=motor, every=0.01)
    needed = inverse(run.motion().require(), run.reduced.inertias, (Gravity(-FALL * 1j),)).effort("crank")
    assert np.max(np.abs(needed - run.effort)) < 1e-12
    assert np.allclose(run.time, 0.01 * np.arange(51), rtol=0, atol=1e-12)


def test_loads_enter_alike_as_constants_functions_and_drive() -> None:
    plain = linkage()
    loaded = reduce(plain.plan, plain.inertias, (*plain.weights, Torque("rocker", 0.3)))
    lively = reduce(plain.plan, plain.inertias, (*plain.weights, Torque("rocker", lambda _motion: 0.3)))
    runs = [forward(one, ForwardState(0.0, 15.0), 0.05, rtol=1e-11) for one in (loaded, lively)]
    assert len(lively.live) == len(loaded.steady) == 1
    assert abs(runs[0].position[-1] - runs[1].position[-1]) < 1e-10
    turned = runs[0].motion().angle("rocker")
    assert np.allclose(runs[0].load_work, 0.3 * (turned - turned[0]), rtol=0, atol=1e-10)


class Foreign:
    """A load of which nothing is known."""

    def __init__(self, load: Load) -> None:
        self.load = load

    def wrenches(self, motion: Motion, inertias: Mapping[str, Inertia]) -> Iterable[Wrench]:
        return self.load.wrenches(motion, inertias)


@pytest.mark.parametrize(
    "load",
    [
        Drag("coupler.B", 4.0),
        Spring("ground.B0", "coupler.A", 400.0, 0.2, damping=3.0),
        FollowerForce("rocker.B", 2 + 1j),
    ],
    ids=lambda load: type(load).__name__,
)
def test_a_load_in_the_table_is_that_of_the_mechanism(load: Load) -> None:
    plain = linkage()
    known, foreign = (reduce(plain.plan, plain.inertias, (*plain.weights, one)) for one in (load, Foreign(load)))
    runs = [forward(one, ForwardState(0.3, 15.0), 0.03, rtol=1e-11) for one in (known, foreign)]
    assert not known.live
    assert foreign.live
    assert abs(runs[0].position[-1] - runs[1].position[-1]) < 1e-10
    assert abs(runs[0].load_work[-1] - runs[1].load_work[-1]) < 1e-8
    assert np.allclose(runs[0].acceleration[0], runs[1].acceleration[0], rtol=1e-10)
