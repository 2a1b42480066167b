"""The four-bar for a function: what it answers by each criterion, and what it refuses."""

import json
import math

import numpy as np
import pytest

from ilmek.errors import ParameterError
from ilmek.linkage.solve import solve
from ilmek.linkage.structure import plan
from ilmek.machines.catalogue import MACHINES
from ilmek.machines.function_four_bar import MACHINE
from ilmek.machines.function_four_bar.params import NAMED, named
from ilmek.report import Animation, Plot, Report
from ilmek.synthesis.four_bar import FourBar
from ilmek.units import deg

POWER = {"function": "x^1.5", "start": "1", "stop": "4", "crank_swing": "90deg", "rocker_swing": "90deg"}
STARTS = {"crank_start": "40deg", "rocker_start": "70deg"}


def answer(**settings: str) -> Report:
    return MACHINE.report_for(settings)


def errors(found: dict[str, float], f: np.ufunc, ends: tuple[float, float], swings: tuple[float, float]) -> np.ndarray:
    """Rocker less what is wanted, over the range, by moving the four-bar from its start angles alone."""
    drawn = FourBar(*(complex(*found[name]) for name in ("a0", "b0", "a", "b")))
    x = np.linspace(*ends, 400)
    y, first, last = f(x), float(f(ends[0])), float(f(ends[1]))
    crank = found["crank_start"] + swings[0] * (x - ends[0]) / (ends[1] - ends[0])
    wanted = found["rocker_start"] + swings[1] * (y - first) / (last - first)
    motion = solve(plan(drawn.mechanism()), crank)
    return np.angle(motion.direction("rocker") * np.exp(-1j * wanted))


def test_the_default_generates_log10_and_is_exact_at_five_places() -> None:
    said = answer()
    (found,) = json.loads(json.dumps(said.as_json()))["results"]["solutions"]
    seen = errors(found, np.log10, (1.0, 2.0), (60 * deg, -60 * deg))
    assert np.abs(seen).max() == pytest.approx(found["error_max"], rel=1e-4)
    assert np.count_nonzero(np.diff(np.sign(seen))) >= 5
    assert found["rocker_errors"] == pytest.approx([0.0] * 5, abs=1e-9)
    assert not said.failed
    assert [type(figure) for figure in said.figures[1:]] == [Animation, Plot, Plot]
    assert MACHINES["function-four-bar"] is MACHINE


def test_the_transmission_angle_is_that_of_the_whole_range() -> None:
    settings = {"rocker_swing": "60deg", "crank_start": "45deg", "rocker_start": "60deg"}
    said = answer(**settings)
    (found,) = said.as_json()["results"]["solutions"]
    drawn = FourBar(*(complex(*found[name]) for name in ("a0", "b0", "a", "b")))
    motion = solve(plan(drawn.mechanism()), found["crank_start"] + np.linspace(0, 60 * deg, 200))
    least = np.abs(np.sin(np.angle(motion.direction("rocker") / motion.direction("coupler")))).min()
    assert found["transmission_min"] == pytest.approx(np.arcsin(least), abs=1e-9)
    assert [(check.name, check.source) for check in said.failed] == [
        ("transmission angle", "rule of thumb for rockers")
    ]
    required = next(
        one for one in answer(**settings, transmission_min="20deg").checks if one.name == "transmission angle"
    )
    assert (required.ok, required.limit, required.source) == (True, pytest.approx(20 * deg), "transmission_min")


@pytest.mark.parametrize("criterion", ["least-squares", "minimax"])
def test_criteria_over_the_range_with_both_start_angles_given(criterion: str) -> None:
    exact = answer(**POWER, **STARTS).as_json()["results"]["solutions"][0]
    said = answer(**POWER, **STARTS, criterion=criterion)
    found = said.as_json()["results"]["solutions"][0]
    seen = errors(found, lambda x: x**1.5, (1.0, 4.0), (90 * deg, 90 * deg))
    assert np.abs(seen).max() == pytest.approx(found["error_max"], rel=1e-3)
    name = "error_rms" if criterion == "least-squares" else "error_max"
    assert found[name] < exact[name]
    assert np.mod([found["crank_start"], found["rocker_start"]], np.pi) == pytest.approx([40 * deg, 70 * deg], abs=1e-9)
    assert said.self_tests[-1].ok
    if criterion == "minimax":
        alternating = [extreme["error"] for extreme in found["extremes"]]
        assert np.abs(alternating) == pytest.approx(np.full(len(alternating), found["error_max"]), rel=1e-6)
        assert found["bound"] == pytest.approx(found["error_max"], rel=1e-6)


def test_samples_are_gone_through_and_their_range_is_the_function_s() -> None:
    pairs = " ".join(f"({x:.6f},{math.sin(x):.9f})" for x in np.linspace(0.2, 1.2, 21))
    swings = {"crank_swing": "70deg", "rocker_swing": "50deg", "link_ratio_max": "100"}
    one = answer(samples=pairs, **swings).as_json()["results"]["solutions"][0]
    other = answer(function="sin", start="0.2", stop="1.2", **swings).as_json()["results"]["solutions"][0]
    assert [one[name] for name in ("ground", "crank")] == pytest.approx([other["ground"], other["crank"]], rel=0.05)
    less = answer(samples=pairs, start="0.4", stop="1", **swings).as_json()["results"]["solutions"]
    assert all(0.4 <= found["x_drawn"] <= 1.0 for found in less)


def test_what_is_too_unequal_goes_and_says_so() -> None:
    said = answer(**POWER)
    results = said.as_json()["results"]
    assert results["removed_counts"] == {"link_ratio": 1}
    assert "times the shortest, allowed at most 10" in results["removed"][0]["reasons"]["link_ratio"]
    none = answer(error_max="0.0001deg")
    assert none.as_json()["results"]["chosen"] is None
    assert isinstance(none.figures[0], Plot)
    assert none.failed[0].name == "four-bars without defects"


@pytest.mark.parametrize("name", NAMED)
def test_named_functions_take_arrays_and_say_where_they_end(name: str) -> None:
    assert np.isfinite(named(name)(np.array([0.5, 1.0]))).all()
    assert named(name)(np.array([[0.5]])).shape == (1, 1)


@pytest.mark.parametrize(
    ("settings", "said"),
    [
        ({"function": "logarithm"}, "function='logarithm' is unknown; log10, ln"),
        ({"function": "log"}, "did you mean log10?"),
        ({"function": "x^0"}, "y is 1 at x = 1 and 1 at x = 2"),
        ({"start": "-1"}, "y is nan at x = -1"),
        ({"start": "2"}, "x from 2 to 2; two finite ends that differ"),
        ({"function": "tan", "start": "1", "stop": "2"}, "between its ends the function goes to -701.3, at x = 1.572"),
        ({"crank_swing": "60"}, "did you mean 60deg? a bare number is in radians"),
        ({"crank_swing": "0deg"}, "crank_swing 0 rad; not 0, at most a turn"),
        ({"crank_start": "40"}, "did you mean 40deg"),
        ({"points": "3"}, "points=3 and 0 start angles; 3 points go with both start angles given; set crank_start"),
        ({"points": "5", **STARTS}, "leave points out: 3 fit"),
        ({"points": "6"}, "criterion=least-squares or minimax fits all over the range"),
        ({"points": "2"}, "points=2; 3 with both start angles given"),
        ({"points": "5", "criterion": "minimax"}, "points are chosen for interpolation alone"),
        ({"criterion": "least squares"}, "did you mean least-squares"),
        ({"samples": "(1,0) (2,0.3) (2,0.4)"}, "samples are not in order; finite values, x rising"),
        ({"samples": "(1,0)"}, "two or more pairs"),
        ({"samples": "1,0,2,3"}, "no list of pairs; pairs are written (1,0) (2,0.301)"),
        ({"samples": "(1mm,0) (2mm,3)"}, "'1mm' has the wrong unit"),
        ({"samples": "(1,0) (2,0.3) (3,0.5)", "stop": "4"}, "stop=4 is outside of the samples; 1 to 3"),
        ({"function": "x^1", "rocker_swing": "60deg"}, "family"),
    ],
)
def test_refuses_in_words(settings: dict[str, str], said: str) -> None:
    with pytest.raises(ParameterError) as refused:
        answer(**settings)
    assert said in str(refused.value)
