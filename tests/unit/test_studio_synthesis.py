"""Tasks of the studio for synthesis: candidates, reasons, loosened limits, mechanism files."""

import math
import time
import tomllib
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from ilmek.errors import ParameterError
from ilmek.io.mechanism_file import parse_mechanism
from ilmek.jobs.design import design_machine, mechanism_text
from ilmek.jobs.studio.answers import Context
from ilmek.jobs.studio.synthesis.answers import ShownFourBar, SynthesisAnswer
from ilmek.jobs.studio.synthesis.tasks import FourBarRequest, SynthesisRequest, candidates, mechanism
from ilmek.progress import Cancelled, Progress

BOW = "(60mm,0mm) (52mm,12mm) (30mm,18mm) (8mm,12mm) (0mm,0mm) (15mm,0mm) (30mm,0mm) (45mm,0mm)"
FLAP = "(0mm,0mm,35deg) (40mm,22mm,12deg) (78mm,12mm,-22deg) (92mm,-28mm,-60deg)"


def answer(machine: str, *, quick: bool = True, **settings: Any) -> SynthesisAnswer:
    return candidates(SynthesisRequest({"machine": machine, "settings": settings}, quick), Context())


def positions(row: list[float]) -> np.ndarray:
    xy = np.array(row).reshape(-1, 2)
    return xy[:, 0] + 1j * xy[:, 1]


def links_of(one: ShownFourBar) -> np.ndarray:
    """Lengths of crank, coupler and rocker at each position of the motion, less those that are stated."""
    a, b = positions(one.motion.a), positions(one.motion.b)
    a0, b0 = complex(*one.pins["a0"]), complex(*one.pins["b0"])
    stated = [[one.links[name]] for name in ("crank", "coupler", "rocker")]
    return np.abs(np.array([a - a0, b - a, b - b0])) - np.array(stated)


@pytest.mark.parametrize(
    ("machine", "settings"),
    [
        ("path-four-bar", {"points": BOW, "closed": "yes"}),
        ("motion-four-bar", {}),
        ("motion-four-bar", {"poses": FLAP}),
        ("function-four-bar", {}),
    ],
)
def test_the_links_keep_their_lengths_in_motion(machine: str, settings: dict[str, Any]) -> None:
    found = answer(machine, **settings)
    assert found.quick == (machine != "function-four-bar")
    assert found.candidates
    for one in found.candidates:
        assert len(one.motion.a) == 240
        assert np.abs(links_of(one)).max() < 3e-8


def test_the_tracer_passes_the_points_within_the_error() -> None:
    found = answer("path-four-bar", points=BOW, closed="yes")
    for one in found.candidates:
        curve = positions(one.curve)
        assert one.error_max is not None
        steps = np.abs(np.diff(curve)).max()
        for point in found.points:
            assert np.abs(curve - complex(*point)).min() <= one.error_max + steps


def test_merit_is_the_fourth_root_of_its_factors() -> None:
    for one in answer("motion-four-bar").candidates:
        assert one.merit is not None
        assert one.merit.value**4 == pytest.approx(math.prod(one.merit.factors.values()), rel=1e-12)


def test_the_candidates_are_those_of_the_command_line() -> None:
    found = answer("path-four-bar", quick=False, points=BOW, closed="yes", starts=64)
    report = design_machine("path-four-bar", {"points": BOW, "closed": "yes", "starts": "64"}).as_json()
    assert [one.links for one in found.candidates] == [
        {name: one[name] for name in ("ground", "crank", "coupler", "rocker")}
        for one in report["results"]["candidates"]
    ]


def test_the_mechanism_is_what_the_command_line_writes() -> None:
    made = design_machine("motion-four-bar", {"samples": "40", "poses": FLAP}).mechanism
    assert made is not None
    best = answer("motion-four-bar", quick=False, samples=40, poses=FLAP).candidates[0]
    document = mechanism(FourBarRequest(best.pins), Context())
    assert document.text == mechanism_text(made, Path("flap.toml"))
    assert document.data == tomllib.loads(document.text)
    assert parse_mechanism(document.text).mechanism == made.mechanism


def test_without_an_answer_reasons_and_single_limits_are_named() -> None:
    limits = {"size_max": "200mm", "transmission_min": "60deg", "full_turn": True, "samples": 40}
    quick = answer("motion-four-bar", poses=FLAP, **limits)
    assert not quick.candidates
    assert not quick.loosened
    assert quick.left_out[0].words == "transmission angle too small"
    assert quick.removed
    assert all(one.reasons for one in quick.removed)
    full = answer("motion-four-bar", quick=False, poses=FLAP, **limits)
    assert {one.name for one in full.loosened} >= {"transmission_min"}
    for one in full.loosened:
        assert answer("motion-four-bar", quick=False, **{"poses": FLAP, **limits, one.name: one.value}).candidates


def test_a_function_has_its_curve_for_each_candidate() -> None:
    swings = {"crank_swing": "90deg", "rocker_swing": "90deg"}
    found = answer("function-four-bar", function="x^1.5", start=1.0, stop=4.0, criterion="minimax", **swings)
    assert len(found.candidates) == 2
    assert found.required is not None
    for one in found.candidates:
        assert one.function is not None
        assert one.error_max is not None
        assert np.abs(one.function.error).max() == pytest.approx(one.error_max, rel=1e-2)


def test_four_poses_have_the_curves_of_pivots_and_pins() -> None:
    found = answer("motion-four-bar", poses=FLAP)
    assert found.curves is not None
    assert all(len(part) <= 604 for part in (*found.curves.pivots, *found.curves.pins))
    assert found.angles[0] == pytest.approx(math.radians(35))


def test_a_short_search_answers_in_time() -> None:
    for machine, settings in (("motion-four-bar", {}), ("path-four-bar", {"points": BOW, "closed": "yes"})):
        answer(machine, **settings)
        begun = time.process_time()
        answer(machine, **settings)
        assert time.process_time() - begun < 2.0  # of both processors


def test_a_search_can_be_cancelled() -> None:
    context = Context(progress=Progress(cancelled=lambda: True))
    with pytest.raises(Cancelled):
        candidates(SynthesisRequest({"machine": "path-four-bar"}), context)


@pytest.mark.parametrize(
    ("data", "words"),
    [
        ({}, "is no synthesis"),
        ({"machine": "beat-up"}, "is no synthesis"),
        ({"machine": "path-four-bar", "settings": 3}, "settings is no table"),
        ({"machine": "path-four-bar", "settings": {"points": "(1mm)"}}, "points"),
    ],
)
def test_a_wrong_file_is_refused(data: dict[str, Any], words: str) -> None:
    with pytest.raises(ParameterError, match=words):
        candidates(SynthesisRequest(data), Context())


def test_a_four_bar_without_a_pin_is_refused() -> None:
    with pytest.raises(ParameterError, match="has no b"):
        mechanism(FourBarRequest({"a0": [0.0, 0.0], "b0": [1.0, 0.0], "a": [0.0, 1.0]}), Context())
