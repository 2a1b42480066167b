"""Tasks of the studio for cyclograms: curves with jumps, margins, solutions, machines' cyclograms."""

import copy
import time
import tomllib
from pathlib import Path
from typing import Any

import msgspec
import numpy as np
import pytest

from ilmek.errors import ParameterError
from ilmek.io.cyclogram_file import cyclogram_of_data, read_cyclogram, timed_data
from ilmek.jobs.cyclogram import solve
from ilmek.jobs.studio.answers import Binary, Context
from ilmek.jobs.studio.cyclogram.tasks import (
    CyclogramRequest,
    MachineCyclogramRequest,
    SolveRequest,
    of_machine,
    solved,
    view,
)
from ilmek.progress import Cancelled, Progress
from ilmek.timing.track import curves, sample

PRESS = Path(__file__).parents[2] / "examples" / "press.toml"


@pytest.fixture
def press() -> dict[str, Any]:
    return tomllib.loads(PRESS.read_text())


def opened(answer: Binary) -> tuple[dict[str, Any], list[np.ndarray]]:
    """The JSON of a packed answer and the curves of each track: rows angle, position and three derivatives."""
    size = int.from_bytes(answer.body[:4], "little")
    about, at, parts = msgspec.json.decode(answer.body[4 : 4 + size]), 4 + size, []
    for length in about["lengths"]:
        parts.append(np.frombuffer(answer.body[at : at + length], dtype="<f4").reshape(5, -1))
        at += length + -length % 8
    return about, parts


def shown(data: dict[str, Any]) -> dict[str, Any]:
    return opened(view(CyclogramRequest(data), Context()))[0]


def test_curves_have_the_peaks_and_the_strokes_of_their_tracks(press: dict[str, Any]) -> None:
    about, parts = opened(view(CyclogramRequest(press), Context()))
    for track, (angle, position, *rates) in zip(about["tracks"], parts, strict=True):
        assert len(angle) == track["count"]
        assert (np.diff(angle) >= 0).all()
        assert (angle[0], angle[-1]) == pytest.approx((0.0, 2 * np.pi))
        assert position.min() == pytest.approx(track["low"], abs=1e-7)
        for name, rate in zip(("speed", "acceleration", "jerk"), rates, strict=True):
            assert np.abs(rate).max() == pytest.approx(track["peaks"][name], rel=5e-3)


def test_curves_are_the_samples_of_the_track_and_a_jump_has_its_angle_twice(press: dict[str, Any]) -> None:
    press["tracks"]["die"]["motions"]["down"]["law"] = "parabolic"
    for track in cyclogram_of_data(press).tracks:
        rows = curves(track, 720)
        assert rows.position == pytest.approx(sample(track, rows.angle).position, abs=1e-12)
        twice = np.flatnonzero(np.diff(rows.angle) < 1e-12)
        assert len(twice) >= 2 * len(track.segments) - 1
        if track.name == "die":
            middle = np.radians(192.5)
            bends = rows.bend[np.abs(rows.angle - middle) < 1e-9]
            assert bends.min() == pytest.approx(-bends.max())


def test_relations_and_exclusions_are_those_of_the_checks(press: dict[str, Any]) -> None:
    about = shown(press)
    assert [one["label"] for one in about["relations"] if not one["ok"]] == [
        "feeder: out starts after feeder: blank let go"
    ]
    broken = about["relations"][0]
    assert broken["margin"] == pytest.approx(np.radians(5) - 0.015 * 2 * np.pi)
    assert about["exclusions"][0]["ok"]
    assert [one["limit"] for one in about["limits"]] == [4.0, 100.0, 3.0, 100.0]
    assert all(one["ok"] and one["value"] < one["limit"] for one in about["limits"])


def test_an_overlap_of_two_presences_is_reported(press: dict[str, Any]) -> None:
    press["tracks"]["feeder"]["motions"]["out"] |= {"start": "140deg", "end": "220deg"}
    one = shown(press)["exclusions"][0]
    assert not one["ok"]
    assert one["margin"] < 0
    ((start, end),) = one["overlaps"]
    assert np.radians(170) < start < end < np.radians(220)


def test_a_view_answers_while_it_is_dragged(press: dict[str, Any]) -> None:
    shown(press)
    begun = time.process_time()
    for _ in range(5):
        shown(press)
    assert (time.process_time() - begun) / 5 < 0.15


@pytest.mark.parametrize("goal", ["acceleration", "period"])
def test_a_solution_keeps_the_file_and_changes_its_timing_alone(press: dict[str, Any], goal: str) -> None:
    before = copy.deepcopy(press)
    answer = solved(SolveRequest(press, goal), Context())
    assert press == before
    assert cyclogram_of_data(answer.data) == pytest.approx(solve(read_cyclogram(PRESS), goal).cyclogram)
    assert answer.binding
    assert answer.after < answer.before
    made = shown(answer.data)
    assert all(one["ok"] for name in ("relations", "exclusions", "limits") for one in made[name])
    assert answer.data["tracks"]["die"]["events"] == press["tracks"]["die"]["events"]
    assert (answer.data["period"] == press["period"]) == (goal == "acceleration")


def test_timed_data_of_its_own_cyclogram_is_the_same(press: dict[str, Any]) -> None:
    assert timed_data(press, cyclogram_of_data(press)) == press


def test_contradicting_relations_are_named(press: dict[str, Any]) -> None:
    press["relations"][1]["gap"] = "350deg"
    with pytest.raises(ParameterError, match="relation loop"):
        solved(SolveRequest(press), Context())


def test_a_solution_can_be_cancelled(press: dict[str, Any]) -> None:
    with pytest.raises(Cancelled):
        solved(SolveRequest(press), Context(progress=Progress(cancelled=lambda: True)))


def test_a_machine_gives_its_cyclograms() -> None:
    assert of_machine(MachineCyclogramRequest(), Context()).machines == (
        "automated-loom",
        "weaver",
        "hand-loom",
        "tufting-machine",
    )
    found = of_machine(MachineCyclogramRequest("weaver"), Context())
    for one in found.cyclograms:
        assert tomllib.loads(one.text)["name"] == one.name
        assert shown(one.data)["tracks"]
    with pytest.raises(ParameterError, match="has no cyclogram"):
        of_machine(MachineCyclogramRequest("beat-up"), Context())


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"period": "0s"}, "period"),
        ({"tracks": {}}, "no tracks"),
        ({"tracks": 3}, "tracks"),
        ({"speed": 3}, "speed"),
    ],
)
def test_wrong_data_are_refused_with_the_key(press: dict[str, Any], change: dict[str, Any], words: str) -> None:
    with pytest.raises(ParameterError, match=words) as refused:
        view(CyclogramRequest(press | change), Context())
    assert "line" not in str(refused.value)
