"""Cyclograms: relations between tracks, figures, and what is no cyclogram."""

import numpy as np
import pytest

from ilmek.cams.laws import LAWS
from ilmek.errors import ParameterError
from ilmek.timing.cyclogram import Cyclogram, Event, Moment, Relation, Segment, Track, check_all
from ilmek.timing.figures import draw
from ilmek.units import deg, turn

LAW = LAWS["3-4-5"]


def track(name: str, start: float, end: float) -> Track:
    parts = (
        Segment("go", start * deg, end * deg, 0.0, 0.04, LAW),
        Segment("back", 300 * deg, 350 * deg, 0.04, 0.0, LAW),
    )
    return Track(name, "cam", parts, (Event("there", end * deg),))


def two() -> Cyclogram:
    return Cyclogram("pair", 2.0, (track("A", 10, 90), track("B", 100, 180)))


@pytest.mark.parametrize(("gap", "ok"), [(5, True), (10, True), (10.001, False)])
def test_b_starts_after_a_ends(gap: float, ok: bool) -> None:
    after = Relation(Moment("B", "go"), Moment("A", "go", "end"), gap * deg, "they share the place")
    (judged,) = check_all(two(), (after,))
    assert (judged.ok, judged.value) == (ok, pytest.approx(10 * deg))
    assert judged.name == "B: go starts after A: go ends"


def test_events_stand_in_relations() -> None:
    after, before = Moment("B", "there", "event"), Moment("A", "there", "event")
    checks = check_all(two(), (Relation(after, before, 90 * deg, "x"), Relation(before, after, 0.0, "y")))
    assert [judged.ok for judged in checks] == [True, False]


@pytest.mark.parametrize(
    ("moment", "said"),
    [
        (Moment("C", "go"), "no track 'C'; its tracks: A, B"),
        (Moment("A", "jump"), "no motion 'jump'; its motions: go, back"),
        (Moment("A", "gone", "event"), "no event 'gone'; its events: there"),
        (Moment("A", "go", "middle"), "no middle 'go'"),
    ],
)
def test_a_relation_names_what_is_there(moment: Moment, said: str) -> None:
    with pytest.raises(ParameterError, match=said):
        check_all(two(), (Relation(moment, Moment("A", "go"), 0.0, ""),))


def test_figure_has_lanes_as_shares_of_the_stroke() -> None:
    figure = draw(two(), "Two tracks")
    assert (figure.name, figure.period, [lane.name for lane in figure.lanes]) == ("pair", 2.0, ["A", "B"])
    for lane in figure.lanes:
        assert lane.angle[0] == 0
        assert lane.angle[-1] == pytest.approx(turn)
        assert np.all(np.diff(lane.angle) > 0)
        assert (lane.position.min(), lane.position.max()) == (0.0, pytest.approx(1.0))
    assert [(mark.label, mark.x) for mark in figure.lanes[0].events] == [("there", 90 * deg)]


@pytest.mark.parametrize(("period", "names"), [(0.0, "AB"), (float("nan"), "AB"), (1.0, "AA")])
def test_what_is_no_cyclogram(period: float, names: str) -> None:
    with pytest.raises(ParameterError):
        Cyclogram("x", period, tuple(track(name, 10, 90) for name in names))
