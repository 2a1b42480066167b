"""Linkages with a loose pin: the ideal pin in the limit, and what publications find of clearance.

Flores and Ambrosio, Computers and Structures 82 (2004) 1359: forces have peaks far above those of the ideal joint, the
slider moves all but as it did, and peaks grow with clearance. The slider-crank is of the size used there: 50, 120 mm;
0.30, 0.21, 0.14 kg; 1e-4, 2.5e-4 kg m²; bearing of 10 mm; 5,000 rpm; steel; restitution 0.9.
"""

import math

import numpy as np
import pytest

from ilmek.dynamics.clearance import ClearancePin, hertz_stiffness
from ilmek.dynamics.inertia import Inertia, bar
from ilmek.dynamics.multibody.system import System, SystemRun, from_motion, simulate, with_clearance
from ilmek.linkage.fourbar import four_bar, slider_crank
from ilmek.linkage.solve import solve
from ilmek.linkage.structure import plan
from ilmek.units import rpm

SPEED = 20.0
TURN = 2 * math.pi / SPEED
WINDOWS = 40
TIMES = np.linspace(0.0, 2 * TURN, 50 * WINDOWS + 1)
FLYWHEEL = 50.0


def beat_up() -> System:
    """The beat-up's crank-rocker behind a flywheel so heavy that its speed is constant."""
    crank, coupler, rocker = 0.0597, 0.2007, 0.2308
    masses = {
        "crank": Inertia(0.129, crank / 2 + 0j, FLYWHEEL),
        "coupler": bar(0, coupler, mass=0.434),
        "rocker": bar(0, rocker, mass=0.649),
    }
    start = solve(plan(four_bar(0.3, crank, coupler, rocker, branch=+1)), 0.0, SPEED)
    return from_motion(start, masses, gravity=-9.81j)


def loose(clearance: float, friction: float = 0.1) -> SystemRun:
    pin = ClearancePin(
        "B", "coupler", "rocker", clearance, 8e-3, hertz_stiffness(8e-3, clearance, 207e9), 0.5, friction
    )
    return simulate(with_clearance(beat_up(), pin), TIMES, rtol=1e-8)


def mean_force(run: SystemRun) -> np.ndarray:
    """Means over fortieths of the run, but for the first turn, in which the journal finds its wall."""
    means: np.ndarray = np.reshape(run.pin("B")[1:], (WINDOWS, -1)).mean(axis=1)[WINDOWS // 2 :]
    return means


def test_a_pin_of_vanishing_clearance_is_the_ideal_pin() -> None:
    ideal = simulate(beat_up(), TIMES)
    wanted, size = mean_force(ideal), float(np.max(np.abs(ideal.pin("B"))))
    runs = [loose(clearance) for clearance in (1.2e-4, 1e-6)]
    off = [float(np.max(np.abs(mean_force(run) - wanted))) / size for run in runs]
    strayed = [float(np.max(np.abs(run.angle("rocker") - ideal.angle("rocker")))) for run in runs]
    assert off[1] < 0.01 < off[0] < 0.1
    assert strayed[1] < 2e-5 < strayed[0] < 1e-3
    assert runs[1].peaks["B"] < 0.2 * runs[0].peaks["B"]
    assert max(float(np.max(np.abs(run.energy_residual))) for run in runs) < 1e-6


def engine(speed: float, clearance: float) -> tuple[SystemRun, SystemRun]:
    """Two turns of the slider-crank with an ideal and with a loose wrist pin."""
    mechanism = slider_crank(0.05, 0.12, branch=+1)
    crank, rod, slider = mechanism.moving
    masses = {
        crank: Inertia(0.30, 0.025 + 0j, 1e-4 + FLYWHEEL),
        rod: Inertia(0.21, 0.06 + 0j, 2.5e-4),
        slider: Inertia(0.14, 0j, 1e-4),
    }
    system = from_motion(solve(plan(mechanism), 0.0, speed), masses)
    name = next(pin.name for pin in system.pins if set(pin.bodies) == {rod, slider})
    pin = ClearancePin(
        name, rod, slider, clearance, 0.01 - clearance, hertz_stiffness(0.01 - clearance, clearance, 207e9)
    )
    times = np.linspace(0.0, 4 * math.pi / speed, 1501)
    return simulate(system, times), simulate(with_clearance(system, pin), times, rtol=1e-8)


def test_a_loose_wrist_pin_hammers_while_the_slider_moves_as_before() -> None:
    ideal, run = engine(5000 * rpm, 0.5e-3)
    (name,) = run.peaks
    slider = run.system.clearance(name).second
    assert 3 < run.peaks[name] / float(np.max(np.abs(ideal.pin(name)))) < 100
    place, wanted = run.position(slider, name), ideal.position(slider, name)
    assert np.max(np.abs(place - wanted)) < 2 * 0.5e-3
    flying = np.mean(np.abs(run.pin(name)) == 0)
    assert 0.05 < flying < 0.95, "free flight, impacts, following"
    assert np.max(np.abs(run.eccentricity(name))) < 0.5e-3 * 1.2
    assert np.max(np.abs(run.energy_residual)) < 1e-5 * float(np.max(run.energy - 0.5 * FLYWHEEL * (5000 * rpm) ** 2))


@pytest.mark.parametrize("clearance", [0.1e-3, 0.5e-3])
def test_impacts_grow_with_clearance_and_speed(clearance: float) -> None:
    peaks = [next(iter(engine(speed, clearance)[1].peaks.values())) for speed in (2000 * rpm, 5000 * rpm)]
    assert peaks[0] < peaks[1]
    smaller = next(iter(engine(5000 * rpm, clearance / 10)[1].peaks.values()))
    assert smaller < peaks[1]
