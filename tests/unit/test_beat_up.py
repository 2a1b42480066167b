"""The beat-up machine: what it answers, and what it refuses."""

import json
import math

import numpy as np
import pytest

from ilmek.dynamics.balance import counterweighted, harmonics, shaking
from ilmek.errors import IlmekError, MechanismError, ParameterError
from ilmek.linkage.solve import solve
from ilmek.machines.beat_up import MACHINE, BeatUpParams, design
from ilmek.machines.beat_up.linkage import evaluate
from ilmek.report import Animation, Drawing, Plot, Report
from ilmek.units import deg


def answer(**settings: str) -> Report:
    return MACHINE.report_for(settings)


def test_answers_by_the_names_that_are_promised() -> None:
    said = answer(swing="30deg", crank_rotation="180deg", beta="48deg", crank_angle="60deg").as_json()["results"]
    assert said["crank_coupler_ratio"] == pytest.approx(0.297588, abs=1e-6)
    assert said["transmission_angle_min"] / deg == pytest.approx(67.2445, abs=1e-4)
    assert (said["crank"], said["coupler"], said["rocker"]) == pytest.approx((0.19913, 0.66913, 0.76936), abs=5e-6)
    assert list(said["lengths"]) == ["ground", "crank", "coupler", "rocker", "beater"]
    assert list(said["masses"]) == list(said["inertias"]) == ["crank", "coupler", "rocker"]
    assert list(said["pin_force_max"]) == list(said["at"]["pin_forces"]) == ["A", "B", "C", "D"]
    assert {"beater_acceleration_max", "beater_force_max", "drive_torque_max"} < set(said)
    assert {"drive_torque", "beater_acceleration", "beater_velocity"} < set(said["at"])
    assert json.dumps(said)


def test_unasked_design_meets_every_check() -> None:
    said = answer()
    assert not said.failed
    assert not said.warnings
    assert len(said.checks) == 29
    assert len(said.self_tests) == 3
    assert "at" not in said.as_json()["results"]


def test_peaks_are_not_below_any_instant() -> None:
    made = design(BeatUpParams())
    fine = np.linspace(0, 2 * math.pi, 20011)
    for angle in (0.3, 0.7134, 5.9):
        at = design(BeatUpParams(crank_angle=angle)).at
        assert at is not None
        assert float(np.abs(at.torque[0])) <= made.peaks["drive_torque"].value
    torque = np.interp(fine, made.state.angle, np.abs(made.state.torque))
    assert torque.max() <= made.peaks["drive_torque"].value <= torque.max() * (1 + 1e-4)


def test_lengths_given_outright_come_back_to_the_last_bit_with_what_they_do() -> None:
    given = dict(crank="59.7mm", coupler="200.7mm", rocker="230.8mm", beater="300.1mm")
    made = design(BeatUpParams.read(given))
    assert made.lengths == {"ground": 0.3, **{name: getattr(made.params, name) for name in given}}
    assert float(made.dead_centres.swing) / deg == pytest.approx(30, abs=0.05)
    assert made.beta / deg == pytest.approx(48, abs=0.05)


def test_a_beater_below_the_pin_keeps_the_bar_to_the_pin() -> None:
    made = design(BeatUpParams.read({"beater": "100mm", "link_mass": "bars"}))
    assert made.masses["rocker"] == pytest.approx(made.lengths["rocker"] * 0.03 * 0.01 * 7200)


@pytest.mark.parametrize("rotation", [150, 200, 209.9999999, 210, 210.0000001, 230])
def test_every_turn_of_the_crank_gives_a_design_whose_checks_tell(rotation: float) -> None:
    said = answer(crank_rotation=f"{rotation}deg")
    results = said.as_json()["results"]
    assert results["crank_rotation"] / deg == pytest.approx(rotation, abs=1e-6)
    assert results["swing"] / deg == pytest.approx(30, abs=1e-6)
    well = next(check for check in said.checks if check.name == "transmission angle, to run well")
    assert not well.ok


def test_too_weak_a_beat_names_the_speed_that_would_do() -> None:
    said = answer(beat_force="100N")
    assert [check.name for check in said.failed] == ["force on the beater"]
    speed = float(said.warnings[0].rpartition("at ")[2].removesuffix(" rad/s"))
    assert design(BeatUpParams(speed=speed)).peaks["beater_force"].value == pytest.approx(100, rel=1e-3)


@pytest.mark.parametrize(
    ("settings", "error", "said"),
    [
        ({"crank": "60mm"}, ParameterError, "give crank, coupler and rocker"),
        ({"crank": "60mm", "coupler": "100mm", "rocker": "150mm"}, MechanismError, "cannot close"),
        ({"crank": "300mm", "coupler": "400mm", "rocker": "350mm", "ground": "100mm"}, MechanismError, "right round"),
        ({"crank": "50mm", "coupler": "300mm", "rocker": "50mm"}, MechanismError, ""),
        ({"beta": "80deg"}, ParameterError, "below 75 deg"),
        ({"beta": "48"}, ParameterError, "did you mean 48deg"),
        ({"swing": "170deg", "crank_rotation": "100deg"}, ParameterError, "above 175 deg, below 355 deg"),
        ({"speed": "0"}, ParameterError, "above 0 rad/s"),
        ({"speed": "15.5mm/s"}, ParameterError, "wrong unit"),
        ({"beater_mass": "-1kg"}, ParameterError, "at least 0 kg"),
        ({"swnig": "30deg"}, ParameterError, "did you mean swing"),
    ],
)
def test_refuses_in_words(settings: dict[str, str], error: type[IlmekError], said: str) -> None:
    with pytest.raises(error) as refused:
        design(BeatUpParams.read(settings))
    assert said in str(refused.value)


def test_figures_are_a_drawing_of_the_beat_and_curves_over_a_turn() -> None:
    said = answer()
    drawing, moving, *plots, start = said.figures[:10]
    assert start.name == "run-speed"
    assert [figure.name for figure in said.figures[10:]] == [
        *(f"beat-up-{name}" for name in ("start-speed", "start-torque", "strokes")),
        *(f"family-{name}" for name in ("angle", "beat", "force", "torque", "rocker", "alpha", "links", "size")),
        *(f"family-front-{name}" for name in ("force-at-beat", "drive-torque")),
    ]
    assert isinstance(drawing, Drawing)
    assert isinstance(moving, Animation)
    places = {dot.label: dot.at for dot in drawing.dots}
    made = design(BeatUpParams())
    # The beat is the extended dead centre: D, C and B in line, and the beater at the end of its path.
    assert abs(places["B"]) == pytest.approx(made.lengths["crank"] + made.lengths["coupler"])
    assert np.angle(places["C"]) == pytest.approx(made.beta)
    path = next(stroke for stroke in drawing.strokes if stroke.label == "path of the beater")
    assert np.min(np.abs(path.points - places["E"])) < 1e-5
    for plot in plots:
        assert isinstance(plot, Plot)
        assert [mark.label for mark in plot.marks] == ["beat", "farthest back"]
        assert all(np.isfinite(series.y).all() and series.x[-1] == pytest.approx(2 * math.pi) for series in plot.series)


def test_machine_is_in_the_shape_of_the_catalogue() -> None:
    assert MACHINE.name == "beat-up"
    made = MACHINE.design(MACHINE.params.read({"swing": "25deg"}))
    assert MACHINE.report(made).machine == "beat-up"


@pytest.mark.parametrize(("swing", "rotation"), [("30deg", "180deg"), ("31.3deg", "281.5deg"), ("84.3deg", "311.3deg")])
def test_mean_torque_is_that_of_dense_samples_however_near_a_toggle(swing: str, rotation: str) -> None:
    """Down to a transmission angle of 0.04 degrees, where half a degree of crank misses the peak altogether."""
    made = design(BeatUpParams.read({"swing": swing, "crank_rotation": rotation}))
    rms = made.motor_run().duty.rms
    bodies = made.bodies
    angle = (np.arange(100_000) + 0.3) * (2 * math.pi / 100_000)
    torque = evaluate(made.params, made.plan, bodies, angle).torque
    assert rms == pytest.approx(math.sqrt(float(np.mean(torque**2))), rel=1e-5)
    assert rms <= made.peaks["drive_torque"].value


def test_rocker_angles_at_the_dead_centres_are_those_of_the_links_not_of_samples() -> None:
    made = design(BeatUpParams())
    for crank, rocker in zip((made.beta, made.back_angle), made.rocker_angles, strict=True):
        motion = solve(made.plan, np.array([crank]))
        placed = complex(np.ravel(motion.point("rocker", "B").position)[0]) - made.lengths["ground"]
        assert math.atan2(placed.imag, placed.real) == pytest.approx(rocker, abs=1e-12)


def test_counterweight_flywheel_and_motor_by_the_names_that_are_promised() -> None:
    said = answer().as_json()["results"]
    assert {"counterweight_moment", "counterweight_mass", "counterweight_angle"} < set(said)
    assert said["counterweight_moment"] == pytest.approx(said["counterweight_mass"] * said["lengths"]["crank"])
    assert set(said["full_balance_moment"]) == set(said["full_balance_angle"]) == {"crank", "rocker"}
    assert set(said["shaking_first_harmonic"]) == {"with_crank", "against_crank"}
    names = "shaking_moment_max work_excess flywheel_inertia motor_torque start_time run_speed_mean run_fluctuation"
    assert set(names.split()) < set(said)
    assert said["shaking_force_max_balanced"] < 0.7 * said["shaking_force_max"]
    assert said["drive_torque_mean"] == 0.0
    assert said["run_speed_mean"] == pytest.approx(BeatUpParams().speed, rel=5e-3)


def test_the_counterweight_leaves_the_harmonic_that_turns_against_the_crank() -> None:
    made = design(BeatUpParams())
    left = harmonics(made.balance.after.force[:-1], 1)
    assert abs(left[1]) < 1e-9
    assert abs(left[-1]) == pytest.approx(made.balance.first[1])
    half = design(BeatUpParams(balance_share=0.5, counterweight_radius=0.1)).balance
    assert abs(harmonics(half.after.force[:-1], 1)[1]) == pytest.approx(made.balance.first[0] / 2)
    assert half.mass == pytest.approx(abs(half.counterweight) / 0.1)
    none = design(BeatUpParams(balance_share=0.0)).balance
    np.testing.assert_array_equal(none.after.force, none.before.force)


def test_the_whole_balance_leaves_nothing() -> None:
    made = design(BeatUpParams())
    bodies = made.bodies
    weighted = bodies | {
        link: counterweighted(bodies[link], static_moment, 0.05)
        for link, static_moment in zip(("crank", "rocker"), made.balance.whole, strict=True)
    }
    assert np.abs(shaking(made.state.motion, weighted).force).max() < 1e-12


@pytest.mark.parametrize("speed", [5.0, 40.0])
def test_the_flywheel_keeps_the_fluctuation_at_any_speed(speed: float) -> None:
    running = design(BeatUpParams(speed=speed, slip=0.3, fluctuation=0.02)).motor_run()  # so soft a motor leaves it so
    assert running.last_turn is not None
    assert running.last_turn.fluctuation == pytest.approx(0.02, rel=0.1)


def test_a_motor_too_weak_for_the_weight_is_said() -> None:
    said = answer(gravity="9.81m/s^2", motor_torque="0.2N*m", speed="15.5rad/s")
    assert "speed that the motor reaches" in [check.name for check in said.failed]
    assert any("does not bring the crank to its speed" in warning for warning in said.warnings)
    assert said.as_json()["results"]["start_time"] is None


def test_beside_a_toggle_nothing_is_run_which_fails() -> None:
    said = answer(swing="84.3deg", crank_rotation="311.3deg")
    assert "the motor runs the linkage" in {check.name for check in said.failed}
    assert said.as_json()["results"]["start_time"] is None
