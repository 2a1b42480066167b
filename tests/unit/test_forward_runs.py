"""Forward runs: start-up, coasting, events, limits of the range, and what is refused."""

import math

import numpy as np
import pytest

from ilmek.dynamics import forward as module
from ilmek.dynamics.forward import Drive, EndKind, ForwardState, RunEvent, at_angle, at_rest, at_speed, forward
from ilmek.dynamics.fourier_terms import tabulate
from ilmek.dynamics.inertia import Inertia, bar
from ilmek.dynamics.loads import Gravity, Torque
from ilmek.dynamics.reduced import ReducedMechanism, reduce
from ilmek.errors import MechanismError
from ilmek.linkage.fourbar import four_bar, slider_crank
from ilmek.linkage.quality import input_range
from ilmek.linkage.structure import plan

J = 0.02
CRANK_ROCKER = plan(four_bar(0.3, 0.0597, 0.2007, 0.2308, branch=+1))
BARS = {
    "crank": bar(0, 0.0597, mass=0.129),
    "coupler": bar(0, 0.2007, mass=0.434),
    "rocker": bar(0, 0.2308, mass=0.649),
}


def rotor() -> ReducedMechanism:
    """Only the crank has inertia: J q'' = M."""
    return reduce(CRANK_ROCKER, {"crank": Inertia(0.0, 0j, J)})


def machine() -> ReducedMechanism:
    return reduce(CRANK_ROCKER, BARS, (Gravity(-9.81j),))


def motor(_time: float, _position: float, speed: float) -> float:
    return 2.0 * (1 - speed / 50)


def test_a_motor_of_straight_curve_starts_a_rotor_exponentially() -> None:
    run = forward(rotor(), ForwardState(0.0), 1.0, drive=motor, every=0.1)
    assert np.allclose(run.speed, 50 * (1 - np.exp(-run.time * 2.0 / (J * 50))), rtol=1e-9)
    assert run.end.kind is EndKind.TIME


def test_an_event_is_met_to_rounding() -> None:
    run = forward(rotor(), ForwardState(0.0), 9.0, drive=motor, events=(at_speed(25.0),))
    assert run.end.kind is EndKind.EVENT
    assert run.end.reason == "speed 25 reached"
    assert math.isclose(run.end.state.time, math.log(2) * J * 50 / 2.0, rel_tol=1e-9)
    assert math.isclose(run.end.state.speed, 25.0, rel_tol=1e-12)


def test_the_earliest_of_several_events_ends_the_run() -> None:
    events = (at_speed(49.0), at_angle(2.0), RunEvent("clock", lambda state: state.time - 5.0))
    run = forward(rotor(), ForwardState(0.0), 9.0, drive=motor, events=events)
    assert run.end.reason == "position 2 reached"
    assert math.isclose(run.position[-1], 2.0, rel_tol=1e-12)


def test_an_event_minds_its_direction() -> None:
    falling = RunEvent("slow", lambda state: state.speed - 10.0, direction=-1)
    started = forward(rotor(), ForwardState(0.0), 0.5, drive=motor, events=(falling,))
    assert started.end.kind is EndKind.TIME
    braked = forward(rotor(), started.end.state, 5.0, drive=lambda _t, _q, _w: -1.0, events=(falling,))
    assert braked.end.reason == "slow"


def test_events_that_do_not_end_the_run_are_told_in_their_order() -> None:
    turns = RunEvent("half turn", lambda state: math.sin(state.position), terminal=False)
    run = forward(machine(), ForwardState(0.1, 20.0), 1.0, events=(turns, at_angle(8.0)))
    assert [one.name for one in run.events] == ["half turn", "half turn", "position 8 reached"]
    assert np.allclose([one.state.position for one in run.events], [math.pi, 2 * math.pi, 8.0], rtol=1e-13)
    assert run.events[-1].state == run.end.state


def test_coasting_against_dry_friction_comes_to_rest_when_its_momentum_is_spent() -> None:
    run = forward(rotor(), ForwardState(0.0, 30.0, 1.0), 9.0, drive=lambda _t, _q, _w: -0.4, events=(at_rest(),))
    assert math.isclose(run.end.state.time, 1.0 + J * 30.0 / 0.4, rel_tol=1e-9)
    assert math.isclose(run.drive_work[-1], -J * 30.0**2 / 2, rel_tol=1e-9)


def test_runs_one_after_the_other_are_one_run() -> None:
    whole = forward(machine(), ForwardState(0.0, 20.0), 1.0, rtol=1e-11)
    first = forward(machine(), ForwardState(0.0, 20.0), 0.4, rtol=1e-11)
    second = forward(machine(), first.end.state, 0.6, rtol=1e-11)
    assert math.isclose(second.position[-1], whole.position[-1], rel_tol=1e-9)
    assert second.time[-1] == pytest.approx(1.0)


def test_a_flywheel_adds_its_inertia() -> None:
    free = machine().terms(np.linspace(0, 6, 5))
    laden = reduce(CRANK_ROCKER, BARS, flywheel=0.5).terms(np.linspace(0, 6, 5))
    assert np.allclose(laden.inertia - free.inertia, 0.5, rtol=1e-14)


def test_the_slope_is_the_derivative_of_the_inertia() -> None:
    at, step = np.linspace(0, 6, 50), 1e-5
    found = machine().terms(at)
    rise = (machine().terms(at + step).inertia - machine().terms(at - step).inertia) / (2 * step)
    assert np.max(np.abs(found.slope - rise)) < 1e-8 * np.max(np.abs(found.slope))


def test_the_table_is_the_engine_to_rounding() -> None:
    reduced = machine()
    table = tabulate(reduced)
    assert table is not None
    assert table.error < 1e-13
    at = np.random.default_rng(1).uniform(-50, 50, 40)
    found = reduced.terms(at)
    rows = np.array([table(float(q)) for q in at])
    assert np.max(np.abs(rows[:, 0] - found.inertia)) < 1e-13 * np.max(found.inertia)
    assert np.max(np.abs(rows[:, 1] - found.weight)) < 1e-13 * np.max(np.abs(found.weight))
    effort = reduced.torque(at, 20.0)
    assert np.max(np.abs(table.torque(at, 20.0) - effort)) < 1e-12 * np.max(np.abs(effort))


def test_a_run_on_the_table_is_the_run_on_the_engine(monkeypatch: pytest.MonkeyPatch) -> None:
    quick = forward(machine(), ForwardState(0.0, 20.0), 0.1)
    monkeypatch.setattr(module, "tabulate", lambda _reduced: None)
    slow = forward(machine(), ForwardState(0.0, 20.0), 0.1)
    assert slow.table_error is None
    assert quick.table_error is not None
    assert math.isclose(quick.position[-1], slow.position[-1], rel_tol=1e-12)


def test_a_run_stops_where_its_linkage_cannot_go_on() -> None:
    lengths = (0.3, 0.2, 0.2, 0.23)
    bars = dict(zip(("crank", "coupler", "rocker"), (bar(0, x, mass=x) for x in lengths[1:]), strict=True))
    reduced = reduce(plan(four_bar(*lengths, branch=+1)), bars, (Gravity(-9.81j),))
    assert tabulate(reduced) is None
    run = forward(reduced, ForwardState(2.0, 6.0), 1.0, rtol=1e-6)
    limit = input_range(*lengths)[0][1]
    assert run.end.kind is EndKind.CANNOT_CLOSE
    assert limit - 1e-8 < run.end.state.position < limit
    assert "coupler + rocker = 430 mm" in run.end.reason
    assert 0 < run.end.state.time < 0.1
    assert run.energy_error < 1e-4


def test_a_run_that_comes_to_a_dead_centre_stops_there_with_time_state_and_reason() -> None:
    bars = {name: bar(0, length, mass=length) for name, length in (("crank", 0.2), ("coupler", 0.5), ("rocker", 0.2))}
    parallelogram = reduce(plan(four_bar(0.5, 0.2, 0.5, 0.2, branch=+1)), bars)
    run = forward(parallelogram, ForwardState(3.0, 10.0), 1.0, rtol=1e-6)
    assert run.end.kind is EndKind.DEAD_CENTRE
    assert abs(run.end.state.position - math.pi) < 2e-4  # where the last two digits of accelerations end
    assert run.end.state.time == pytest.approx((math.pi - 3.0) / 10, rel=1e-3)
    assert run.end.state.speed == pytest.approx(10.0, rel=1e-2)
    assert run.end.reason == "four-bar is at a dead centre for crank 180.0°"


def test_a_motor_too_weak_is_told_so() -> None:
    run = forward(machine(), ForwardState(0.0), 1.0, drive=lambda _t, _q, _w: 0.2, events=(at_rest(),))
    with pytest.raises(MechanismError, match="made 0.*of 1 turns.*at rest.*stronger drive"):
        run.require_turns()
    assert forward(machine(), ForwardState(0.0), 1.0, drive=lambda _t, _q, _w: 0.5).require_turns(3)


def test_a_drive_that_fails_on_the_way_ends_the_run_there() -> None:
    run = forward(rotor(), ForwardState(0.0, 1.0), 2.0, drive=lambda time, _q, _w: math.nan if time > 1 else 0.1)
    assert run.end.kind is EndKind.STEP
    assert run.end.state.time == pytest.approx(1.0, abs=1e-3)


@pytest.mark.parametrize(
    ("start", "duration", "options", "words"),
    [
        (ForwardState(0.0), -1.0, {}, "duration"),
        (ForwardState(math.nan), 1.0, {}, "finite"),
        (ForwardState(0.0), 1.0, {"rtol": 0.0}, "relative error"),
        (ForwardState(0.0), 1.0, {"every": 0.0}, "time between samples"),
        (ForwardState(0.0), 1.0, {"drive": lambda _t, _q, _w: math.inf}, "finite efforts"),
    ],
)
def test_bad_runs_are_refused(
    start: ForwardState, duration: float, options: dict[str, float | Drive], words: str
) -> None:
    with pytest.raises(MechanismError, match=words):
        forward(rotor(), start, duration, **options)  # type: ignore[arg-type]


def test_a_start_that_cannot_close_is_refused() -> None:
    reduced = reduce(plan(slider_crank(0.3, 0.2, branch=+1)), {"crank": Inertia(0.0, 0j, J)})
    with pytest.raises(MechanismError, match="cannot close"):
        forward(reduced, ForwardState(1.5), 1.0)


def test_a_machine_that_cannot_be_reduced_is_refused() -> None:
    with pytest.raises(MechanismError, match="no body"):
        reduce(CRANK_ROCKER, {})
    with pytest.raises(MechanismError, match="flywheel"):
        reduce(CRANK_ROCKER, BARS, flywheel=-1.0)
    with pytest.raises(MechanismError, match="acceleration of gravity is nan"):
        reduce(CRANK_ROCKER, BARS, (Gravity(complex(math.nan)),))
    with pytest.raises(MechanismError, match="mass centre of a body is"):
        Inertia(1.0, complex(math.nan), 1.0)
    with pytest.raises(MechanismError, match="value of event 'x' is nan"):
        forward(rotor(), ForwardState(0.0, 1.0), 1.0, events=(RunEvent("x", lambda _state: math.nan),))
    with pytest.raises(MechanismError, match="by sample"):
        reduce(CRANK_ROCKER, BARS, (Torque("crank", np.ones(3)),))


def test_a_run_beyond_its_most_steps_keeps_what_it_reached() -> None:
    """Constant torque on a rotor: q = M t² / 2 J holds at every sample that was reached."""
    whole = forward(rotor(), ForwardState(0.0), 2.0, drive=lambda _t, _q, _w: 1.0)
    steps = len(whole.time) - 1
    for every in (None, 0.001):
        run = forward(rotor(), ForwardState(0.0), 2.0, drive=lambda _t, _q, _w: 1.0, every=every, most_steps=steps - 3)
        assert run.end.kind is EndKind.STEPS
        assert run.end.kind.early
        assert 0 < run.time[-1] < 2.0
        assert run.end.state.time == run.time[-1]
        assert f"{steps - 3} steps of the integrator reached" in run.end.reason
        assert np.all(np.diff(run.time) > 0)
        np.testing.assert_allclose(run.position, run.time**2 / (2 * J), rtol=1e-8, atol=1e-12)
    assert not whole.end.kind.early
