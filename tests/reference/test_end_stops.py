"""End stops and the ratchet of forward runs: a bouncing ball, a wheel with a ratchet, and another integrator."""

import math
import tomllib

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from ilmek import Body, EndStop, Gravity, Inertia, Mechanism, Slide, bar, forward_dynamics, slider_crank
from ilmek.dynamics.forward_run import ForwardRun
from ilmek.errors import MechanismError
from ilmek.io.mechanism_file import mechanism_of_data, mechanism_toml
from ilmek.linkage.model import Displacement, Pin, Rotation

G = 9.81


def dropped_ball(rebound: float, duration: float) -> ForwardRun:
    """A mass that falls along an upright guide from 1 m onto a stop at 0."""
    ground, ball = Body("ground", {"S": 0}), Body("ball", {"S": 0})
    mechanism = Mechanism((ground, ball), (Slide("S", "ball", "ground", along=math.pi / 2),), (Displacement("S"),))
    return forward_dynamics(
        mechanism,
        {"ball": Inertia(2.0, 0, 0.1)},
        duration,
        position=1.0,
        loads=[Gravity(-1j * G)],
        stops=[EndStop("0mm", rebound, "floor")],
        every=0.01,
    )


@pytest.mark.parametrize("rebound", [0.3, 0.7, 0.9])
def test_a_ball_bounces_as_by_galileo(rebound: float) -> None:
    """Impacts at t0 (1 + 2e + 2e² + ...), heights e^2n; it comes to rest at t0 (1 + e)/(1 - e)."""
    fall = math.sqrt(2 / G)
    run = dropped_ball(rebound, fall * (1 + rebound) / (1 - rebound) + 0.5)
    hits = [event.time for event in run.events]
    expected = fall * (1 + 2 * np.cumsum([0.0, *(rebound**n for n in range(1, len(hits)))]))
    assert hits == pytest.approx(expected, abs=1e-7)
    assert len(hits) > math.log(1e-4) / math.log(rebound)
    speeds = [abs(float(event.state.speed)) for event in run.events]
    assert speeds == pytest.approx([math.sqrt(2 * G) * rebound**n for n in range(len(hits))], rel=1e-6)
    assert float(run.position[-1]) == 0
    assert float(run.speed[-1]) == float(run.acceleration[-1]) == 0
    assert run.end.reason == "its duration was reached"
    assert float(run.load_work[-1]) == pytest.approx(-2.0 * G, rel=1e-9)  # all energy is lost in the impacts
    assert run.energy_error < 1e-9


def test_a_wheel_on_a_ratchet_turns_in_the_halves_that_drive_it() -> None:
    """J q'' = M sin(w t) - M0: it starts where sin(w t) = M0/M and rests again where its speed is 0, each turn."""
    inertia, torque, against, pace = 0.2, 3.0, 1.0, 5.0
    mechanism = Mechanism(
        (Body("ground", {"A": 0}), Body("wheel", {"A": 0})),
        (Pin("A", "ground", "wheel"),),
        (Rotation("wheel", "A"),),
    )
    drive = lambda time, _position, _speed: torque * math.sin(pace * time) - against  # noqa: E731
    run = forward_dynamics(mechanism, {"wheel": Inertia(1.0, 0, inertia)}, 3.0, drive=drive, ratchet=1, every=0.002)
    begins = math.asin(against / torque) / pace

    def speed(time: float) -> float:
        gone = torque / pace * (math.cos(pace * begins) - math.cos(pace * time))
        return (gone - against * (time - begins)) / inertia

    times = np.linspace(begins + 0.05, begins + 2 * math.pi / pace, 20_000)
    ends = times[np.flatnonzero([speed(time) < 0 for time in times])[0]]
    period = 2 * math.pi / pace
    for time, shown in zip(run.time.tolist(), run.speed.tolist(), strict=True):
        phase = (time - begins) % period if time >= begins else period
        expected = speed(begins + phase) if begins + phase < ends else 0.0
        assert shown == pytest.approx(expected, abs=2e-3)
    assert float(np.min(run.speed)) >= -1e-9
    assert [event.name for event in run.events] == ["ratchet"] * len(run.events)
    assert len(run.events) >= 3
    assert run.energy_error < 1e-6


def test_a_slider_crank_between_two_stops_as_another_integrator_has_it() -> None:
    """Its reduced inertia by the closed form of the slider, DOP853 of SciPy with events, 9 impacts."""
    crank, rod, mass, wheel = 0.05, 0.2, 3.0, 0.01

    def rates(_time: float, state: np.ndarray) -> list[float]:
        q, w = state
        sine, cosine = crank * math.sin(q), crank * math.cos(q)
        root = math.sqrt(rod**2 - sine**2)
        slope = -sine - sine * cosine / root
        bend = -cosine - (cosine**2 - sine**2) / root - (sine * cosine) ** 2 / root**3
        return [w, (0.8 - mass * slope * bend * w**2) / (wheel + mass * slope**2)]

    low, high = 0.4, 2.2
    hit = [lambda _t, y: y[0] - high, lambda _t, y: y[0] - low]
    for event, sense in zip(hit, (1, -1), strict=True):
        event.terminal, event.direction = True, sense
    time, state, impacts = 0.0, np.array([1.0, 2.0]), []
    while len(impacts) < 9:
        found = solve_ivp(rates, (time, time + 5), state, events=hit, rtol=1e-11, atol=1e-12, method="DOP853")
        time, state = float(found.t[-1]), found.y[:, -1] * np.array([1.0, -0.6])
        impacts.append((time, float(found.y[1, -1])))
    run = forward_dynamics(
        slider_crank(crank, rod),
        {"slider": Inertia(mass, 0, 0.1)},
        impacts[-1][0] + 0.001,
        position=1.0,
        speed=2.0,
        drive=lambda *_: 0.8,
        flywheel=wheel,
        stops=[EndStop(high, 0.6, "high"), EndStop(low, 0.6, "low")],
    )
    ours = [(event.time, float(event.state.speed)) for event in run.events]
    assert np.array(ours) == pytest.approx(np.array(impacts), rel=2e-5, abs=2e-5)
    assert run.energy_error < 1e-7


def test_an_input_pressed_on_its_stop_leaves_when_the_drive_turns() -> None:
    """A constant torque that changes its sense at 1 s."""
    masses = {"crank": bar(0, 0.05, mass=0.4)}
    run = forward_dynamics(
        slider_crank(0.05, 0.2),
        masses,
        1.2,
        drive=lambda time, *_: 0.01 if time < 1 else -0.01,
        stops=[EndStop("30deg")],
        every=0.01,
    )
    resting = (run.time > 0.6) & (run.time < 0.995)
    assert run.position[resting] == pytest.approx(math.radians(30), abs=1e-12)
    assert not run.speed[resting].any()
    inertia = 0.4 * 0.05**2 / 3
    assert float(run.speed[-1]) == pytest.approx(-0.01 * 0.2 / inertia, rel=1e-3)


FILE = """
inputs = { A = "arm" }
bodies.arm = { mass = "1kg", moment = "0.01kg*m^2", points = { A = [0, 0], P = ["200mm", 0] } }
bodies.ground.points = { A = [0, 0] }
joints.A.pin = ["ground", "arm"]
[forward]
duration = "1s"
motor = { torque = "1N*m" }
ratchet = "up"
stops.wall = { position = "90deg", rebound = 0.5 }
"""


def test_stops_and_ratchet_in_a_file_are_written_as_they_are_read() -> None:
    data = tomllib.loads(FILE)
    file = mechanism_of_data(data)
    task = file.machine.forward
    assert task is not None
    assert (task.ratchet, task.stops) == (1, (EndStop("90deg", 0.5, "wall"),))
    again = mechanism_of_data(tomllib.loads(mechanism_toml(file.machine))).machine.forward
    assert again is not None
    assert (again.stops, again.ratchet, again.duration) == (task.stops, task.ratchet, task.duration)


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"stops": [EndStop(0.0)]}, "starts on its stop"),
        ({"ratchet": -1, "speed": 1.0}, "against its ratchet"),
        ({"ratchet": 2}, "ratchet"),
    ],
)
def test_limits_that_contradict_the_start_are_one_error(changes: dict[str, object], message: str) -> None:
    with pytest.raises(MechanismError, match=message):
        forward_dynamics(slider_crank(0.05, 0.2), {"crank": bar(0, 0.05, mass=0.4)}, 1.0, **changes)  # type: ignore[arg-type]


def test_a_rebound_is_at_most_that_of_a_ball_that_loses_nothing() -> None:
    with pytest.raises(MechanismError, match="rebound .* is 1.2; 0 to 1"):
        EndStop(1.0, 1.2)
