"""The tufting machine: what it answers, and what it refuses."""

import json
import math

import numpy as np
import pytest

from ilmek.errors import IlmekError, MechanismError, ParameterError
from ilmek.linkage.structure import plan
from ilmek.machines.catalogue import MACHINES
from ilmek.machines.tufting import MACHINE, TuftingParams, design
from ilmek.machines.tufting.model import evaluate, mechanism
from ilmek.report import Drawing, Plot, Report
from ilmek.units import deg

JOINTS = ["O", "A", "B", "C", "D", "E", "guide"]


def answer(**settings: str) -> Report:
    return MACHINE.report_for(settings)


def test_answers_by_the_names_that_are_promised() -> None:
    said = answer(crank_angle="22deg").as_json()["results"]
    assert said["theta2_range"] == pytest.approx([101.7089 * deg, 114.2518 * deg], abs=1e-6)
    assert {"theta3_range", "theta4_range", "theta5_range", "stroke", "energy_per_revolution"} < set(said)
    assert {"lowest_crank_angle", "highest_crank_angle"} < set(said)
    assert {"main_shaft_torque_max", "driven_shaft_torque_max"} < set(said)
    assert list(said["pin_force_max"]) == list(said["at"]["pin_forces"]) == JOINTS
    assert set(said["at"]) == {
        "main_shaft_torque",
        "driven_shaft_torque",
        "pin_forces",
        "needle_velocity",
        "needle_acceleration",
    }
    assert json.dumps(said)


def test_unasked_design_meets_every_check_and_is_in_the_catalogue() -> None:
    said = answer()
    assert not said.failed
    assert not said.warnings
    assert "at" not in said.as_json()["results"]
    assert MACHINES["tufting"] is MACHINE


def test_the_symbols_of_the_paper_set_the_same_parameters() -> None:
    symbols = "l1=15mm l2=138mm l3=115mm l4=125mm l5=120mm l6=440mm x1=70mm h1=155mm x2=100mm beta1=168deg fr=900N"
    given = TuftingParams.read(dict(text.split("=") for text in symbols.split()))
    assert given == TuftingParams(friction_force=900.0)


def test_forces_at_a_jump_are_the_limit_after_it() -> None:
    params = TuftingParams()
    around = np.array([21.9999999, 22, 22.0000001]) * deg
    before, at, after = evaluate(params, plan(mechanism(params)), around).main_torque.tolist()
    assert at == pytest.approx(after, abs=1e-5)
    assert before < 1 < at


def test_a_window_that_misses_the_lowest_position_fails() -> None:
    def failed(**settings: str) -> bool:
        return "needle lowest between entry and exit" in {check.name for check in answer(**settings).failed}

    assert failed(entry="200deg", exit="300deg")
    assert not failed()
    assert not failed(entry="200deg", exit="300deg", friction="always")


def test_bars_in_step_add_up_and_bars_out_of_step_smooth_the_torque() -> None:
    cases = ((1, 0.0), (3, 0.0), (3, 120 * deg))
    alone, in_step, spread = (design(TuftingParams(bars=bars, phase=phase)) for bars, phase in cases)
    one = alone.peaks["main_torque"].value
    assert alone.peaks["total_torque"].value == pytest.approx(one, rel=1e-12)
    assert in_step.peaks["total_torque"].value == pytest.approx(3 * one, rel=1e-12)
    assert in_step.peaks["bearing"].value == pytest.approx(3 * alone.peaks["O"].value, rel=1e-12)
    assert spread.peaks["total_torque"].value < 2 * one
    said = MACHINE.report(spread)
    results = said.as_json()["results"]
    assert results["total_energy_per_revolution"] == pytest.approx(3 * alone.work["drive"], rel=1e-12)
    # At 45 deg of the first crank the sum is that of three bars at their own angles.
    by_hand = evaluate(alone.params, alone.plan, np.array([45, -75, -195]) * deg).main_torque.sum()
    plot = next(figure for figure in said.figures if figure.name == "total-torque")
    assert isinstance(plot, Plot)
    assert np.interp(45 * deg, plot.series[0].x, plot.series[0].y) == pytest.approx(by_hand, rel=1e-6)


def test_figures_are_a_drawing_and_curves_over_a_turn_with_jumps_upright() -> None:
    made = MACHINE.report_for({})
    first, *plots = made.figures
    assert isinstance(first, Drawing)
    assert {dot.label for dot in first.dots} == {"O", "A", "B", "C", "D", "E", "F"}
    torques = next(plot for plot in plots if plot.name == "shaft-torques")
    assert isinstance(torques, Plot)
    x, y = torques.series[0].x, torques.series[0].y
    jump = int(np.argmax(np.abs(np.diff(y))))
    assert x[jump] == x[jump + 1]
    assert (y[jump], y[jump + 1]) == pytest.approx((-122.144, 132.396), abs=1e-3)


@pytest.mark.parametrize(
    ("settings", "kind", "said"),
    [
        (
            {"l1": "150mm"},
            MechanismError,
            r"cannot close for crank 62.0°.*lengthen one by 67.07 mm or limit the crank$",
        ),
        ({"l5": "20mm"}, MechanismError, "lengthen rod by 5 mm"),
        ({"l1": "15"}, ParameterError, "did you mean 15mm"),
        ({"l1": "0mm"}, ParameterError, "crank=0 mm"),
        ({"friction": "never"}, ParameterError, "window, always"),
        ({"speed": "0rpm"}, ParameterError, "above 0 rpm"),
        ({"fr": "-3N"}, ParameterError, "friction_force"),
        ({"crank": "15mm", "l1": "16mm"}, ParameterError, "crank is set twice"),
        ({"bars": "0"}, ParameterError, "at least 1"),
        ({"m6": "-1kg"}, ParameterError, "needle_mass"),
        (
            {"x1": "20mm", "h1": "0mm", "l1": "90mm", "l2": "100mm", "l3": "100mm", "l4": "9mm", "x2": "0mm"},
            MechanismError,
            "turns right round",
        ),
    ],
)
def test_refuses_in_words(settings: dict[str, str], kind: type[IlmekError], said: str) -> None:
    with pytest.raises(kind, match=said):
        answer(**settings)


def test_scaled_twice_without_weight_and_friction_its_angles_stay_and_its_stroke_doubles() -> None:
    lengths = ("crank", "coupler", "rocker", "arm", "rod", "shaft_distance", "shaft_height", "needle_distance")
    small = design(TuftingParams())
    large = design(TuftingParams(**{name: 2 * getattr(TuftingParams(), name) for name in lengths}))
    assert large.stroke == pytest.approx(2 * small.stroke, rel=1e-12)
    for name in ("theta2", "theta3", "theta4", "theta5"):
        assert large.ranges[name] == pytest.approx(small.ranges[name], abs=1e-12)
    assert math.isclose(large.lowest, small.lowest, abs_tol=1e-12)
