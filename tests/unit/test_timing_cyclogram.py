"""Cyclograms: relations between tracks, figures, and what is no cyclogram."""

import numpy as np
import pytest

from ilmek.cams.laws import LAWS
from ilmek.errors import ParameterError
from ilmek.timing.cyclogram import (
    Cyclogram,
    Exclusion,
    Moment,
    Relation,
    Spans,
    Track,
    TrackEvent,
    TrackSegment,
    Zone,
    check_all,
    check_apart,
    fixed,
)
from ilmek.timing.figures import draw
from ilmek.timing.windows import Window
from ilmek.units import deg, turn

LAW = LAWS["3-4-5"]


def track(name: str, start: float, end: float) -> Track:
    parts = (
        TrackSegment("go", start * deg, end * deg, 0.0, 0.04, LAW),
        TrackSegment("back", 300 * deg, 350 * deg, 0.04, 0.0, LAW),
    )
    return Track(name, "cam", parts, (TrackEvent("there", end * deg),))


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


def test_gaps_at_most_delays_and_later_turns() -> None:
    valve = Relation(Moment("B", "go"), Moment("A", "go", "end"), 1 * deg, "valve", most=12 * deg, delay=0.04)
    later = Relation(Moment("A", "go"), Moment("B", "back", "end"), 15 * deg, "next turn", turns=1)
    least, most, again = check_all(two(), (valve, later))
    assert (least.value, least.limit) == (pytest.approx(10 * deg), pytest.approx((1 + 0.04 * 180) * deg))
    assert (most.value, most.limit) == (pytest.approx(10 * deg), pytest.approx(12 * deg))
    assert (most.ok, most.relation) == (True, "<=")
    assert (again.value, again.ok) == (pytest.approx(20 * deg), True)
    assert again.name == "A: go starts after B: back ends of the turn before"


def test_positions_and_angles_stand_in_relations() -> None:
    past = Relation(Moment("B", "go", "past", 0.02), fixed(100 * deg), 0.0, "")
    (judged,) = check_all(two(), (past,))
    assert judged.value == pytest.approx(40 * deg)  # 3-4-5 is half-way in the middle of its 80 degrees
    assert judged.name == "B: go past 20 mm after 100 deg"


@pytest.mark.parametrize(("gap", "ok"), [(10.0, True), (10.001, False)])
def test_never_both_in_one_place(gap: float, ok: bool) -> None:
    # A goes from 10 to 90 degrees and is home at 350; B starts at 100: between A's way out and B's lie 10 degrees.
    law_at = float(LAW.s(0.5)) * 0.04
    start, end = Zone("A", 0.0, 0.04, "on its way"), Zone("B", 0.0, law_at, "leaving")
    short = Cyclogram("pair", 2.0, (two().tracks[0], Track("B", "cam", two().tracks[1].segments)))
    judged = check_apart(short, Exclusion(start, end, gap * deg, "why"))
    assert judged.name == "never both A on its way and B leaving"
    assert judged.value < 0  # both come home together
    first = Exclusion(Zone("A", law_at, 0.04), Spans("B leaves", (Window(100 * deg, 140 * deg),)), gap * deg, "why")
    judged = check_apart(short, first)
    assert (judged.ok, judged.value) == (ok, pytest.approx(10 * deg))


def test_windows_that_overlap_are_told_by_how_much() -> None:
    apart = Exclusion(Zone("A", 0.0), Spans("reed", (Window(340 * deg, 380 * deg),)), 0.0, "why")
    judged = check_apart(two(), apart)
    assert (judged.ok, judged.value) == (False, pytest.approx(-20 * deg))  # 340 and 40 degrees in 360
    assert Cyclogram("pair", 2.0, two().tracks, exclusions=(apart,)).exclusions == (apart,)


@pytest.mark.parametrize(
    ("make", "said"),
    [
        (lambda: Relation(fixed(1.0), fixed(0.0), 2.0, "", most=1.0), "at least 114.592 deg, at most 57.2958 deg"),
        (lambda: Relation(fixed(1.0), fixed(0.0), 1e9, ""), "a gap of"),
        (lambda: Exclusion(Zone("A"), Zone("B"), np.nan), "a gap of nan deg"),
        (lambda: Cyclogram("p", 1.0, two().tracks, exclusions=(Exclusion(Zone("A"), Zone("C")),)), "no track 'C'"),
        (lambda: Window(1.0, 1.0), "a window from 1 to 1 rad"),
    ],
)
def test_what_is_no_relation(make, said: str) -> None:
    with pytest.raises(ParameterError, match=said):
        make()
