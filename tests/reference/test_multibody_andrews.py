"""Andrews' squeezing mechanism against the Test Set for IVP Solvers (problem `andrews`; IFToMM A03), t = 0.03 s."""

import numpy as np
import pytest

from ilmek.dynamics.inertia import Inertia
from ilmek.dynamics.multibody.system import BodyState, BodyTorque, Spring, System, SystemRun, simulate
from ilmek.linkage.model import GROUND, Body, Pin

A, B, C = -0.06934 - 0.00227j, -0.03635 + 0.03273j, 0.014 + 0.072j
D, DA, E, EA, RR, RA, SS, SA, SB, SC, SD = (
    0.028,
    0.0115,
    0.02,
    0.01421,
    0.007,
    0.00092,
    0.035,
    0.01874,
    0.01043,
    0.018,
    0.02,
)
TA, TB, U, UA, UB, ZF, ZT, FA = 0.02308, 0.00916, 0.04, 0.01228, 0.00449, 0.02, 0.04, 0.01421
MASS = (0.04325, 0.00365, 0.02373, 0.00706, 0.07050, 0.00706, 0.05498)
MOMENT = (2.194e-6, 4.410e-7, 5.255e-6, 5.667e-7, 1.169e-5, 5.667e-7, 1.912e-5)
TORQUE = 0.033
START = (-0.0617138900142764, 0.0, 0.455279819163070, 0.222668390165886, 0.487364979543843, -0.222668390165886,
         1.23054744454982)  # fmt: skip
PRINTED = (15.81077119629904, -15.75637105984298, 0.04082224013073101, -0.5347301163226948, 0.5244099658805304,
           0.5347301163226948, 1.048080741042263)  # fmt: skip
SPEEDS = (1139.920302151208, -1424.379294994111, 11.03291221937134, 19.29337464421385, 0.5735699284790808,
          -19.29337464421385, 0.3231791658026955)  # fmt: skip


def squeezer() -> System:
    """Each body's frame stands on its first pin: 1 at O, 2 at the crank pin, 3 at B, 4, 5 at their joint, A, 6, 7."""
    beta, big, gamma, phi, delta, omega, eps = START
    turns = (beta, beta + big, gamma, phi + delta, delta, omega + eps, eps)
    crank_pin = RR * np.exp(1j * beta)
    knee, hip = A + ZT * np.exp(1j * delta), A - 1j * U * np.exp(1j * eps)
    origins = (0j, crank_pin, B, knee, A, hip, A)
    points = (
        {"O": 0, "P": RR}, {"P": 0, "E3": -D, "E4": -D, "E6": -D}, {"B": 0, "E3": -1j * SS, "D": SD - 1j * SC},
        {"knee": 0, "E4": -1j * E}, {"A5": 0, "knee": ZT}, {"hip": 0, "E6": ZF}, {"A7": 0, "hip": -1j * U},
    )  # fmt: skip
    centres = (RA, -DA, SB - 1j * SA, -1j * (E - EA), TA + 1j * TB, ZF - FA, -UB - 1j * UA)
    names = [f"K{k}" for k in range(1, 8)]
    ground = Body(GROUND, {"O": 0, "B": B, "A5": A, "A7": A, "C": C})
    pins = (
        ("O", GROUND, "K1"), ("P", "K1", "K2"), ("E3", "K2", "K3"), ("E4", "K2", "K4"), ("E6", "K2", "K6"),
        ("B", GROUND, "K3"), ("knee", "K4", "K5"), ("A5", GROUND, "K5"), ("hip", "K6", "K7"), ("A7", GROUND, "K7"),
    )  # fmt: skip
    return System(
        (ground, *(Body(name, one) for name, one in zip(names, points, strict=True))),
        tuple(Pin(*pin) for pin in pins),
        {n: Inertia(m, complex(c), i) for n, m, c, i in zip(names, MASS, centres, MOMENT, strict=True)},
        {n: BodyState(complex(o), t) for n, o, t in zip(names, origins, turns, strict=True)},
        loads=(Spring("K3.D", (GROUND, "C"), 4530.0, 0.07785), BodyTorque("K1", TORQUE)),
        name="squeezing mechanism",
    )


def minimal(run: SystemRun, what: str) -> np.ndarray:
    """The Test Set's seven coordinates from the bodies' angles, at the last sample."""
    one, two, three, four, five, six, seven = (float(getattr(run, what)(f"K{k}")[-1]) for k in range(1, 8))
    return np.array([one, two - one, three, four - five, five, six - seven, seven])


@pytest.mark.parametrize(("rtol", "error"), [(1e-8, 1e-6), (1e-12, 1e-8)])
def test_seven_coordinates_after_30_milliseconds(rtol: float, error: float) -> None:
    run = simulate(squeezer(), np.array([0.0, 0.03]), rtol=rtol)
    assert np.max(np.abs(minimal(run, "angle") / PRINTED - 1)) < error
    assert np.max(np.abs(minimal(run, "omega") / SPEEDS - 1)) < 100 * error


def test_first_accelerations_are_the_printed_ones() -> None:
    run = simulate(squeezer(), np.array([0.0, 1e-6]))
    assert abs(float(run.alpha("K1")[0]) / 14222.4439199541 - 1) < 1e-10
    assert abs(float(run.alpha("K2")[0] - run.alpha("K1")[0]) / -10666.8329399656 - 1) < 1e-10


def test_energy_is_the_torque_times_the_turning() -> None:
    run = simulate(squeezer(), np.linspace(0.0, 0.05, 26), rtol=1e-10)
    work = TORQUE * (run.angle("K1") - START[0])
    assert np.max(np.abs(run.energy - run.energy[0] - work)) < 1e-9
    assert np.max(np.abs(run.energy_residual)) < 1e-9
    assert run.gap < 1e-15
