"""The solver of cyclograms: nothing feasible is better, all that must hold holds, and what binds is what binds."""

import itertools
import math
from dataclasses import replace

import numpy as np
import pytest
from benchmarks.bench_cyclogram import chain as chained
from benchmarks.bench_cyclogram import plain
from hypothesis import given, settings
from hypothesis import strategies as st

from ilmek.cams.laws import LAWS
from ilmek.errors import ParameterError
from ilmek.timing.cyclogram import (
    ActuatorLimits,
    Cyclogram,
    Exclusion,
    Moment,
    Relation,
    Spans,
    Track,
    TrackEvent,
    TrackSegment,
    Zone,
    check_cyclogram,
    fixed,
    riding,
)
from ilmek.timing.solver import least_acceleration, least_period, require_possible
from ilmek.timing.track import peak_acceleration, peak_speed
from ilmek.timing.windows import Window
from ilmek.units import deg, turn

LAW, OTHER = LAWS["modified-sine"], LAWS["cycloidal"]


def moved(name: str, angles: list[float], stroke: float, law=LAW, **more) -> Track:
    a, b, c, d = angles
    return Track(
        name, "cam", (TrackSegment("out", a, b, 0.0, stroke, law), TrackSegment("home", c, d, stroke, 0.0, law)), **more
    )


def press(die: list[float], feeder: list[float], **more) -> Cyclogram:
    """A die that presses 10 degrees long, and a feeder never in the tool with it."""
    in_tool = Exclusion(Zone("die", low=0.03), Zone("feeder", low=0.05), 2 * deg, "they would collide")
    pressing = Relation(Moment("die", "home"), Moment("die", "out", "end"), 10 * deg, "pressing time")
    return Cyclogram("press", 1.0, (moved("die", die, 0.1, **more), moved("feeder", feeder, 0.2, OTHER)), (pressing,),
                     (in_tool,))  # fmt: skip


def largest(cyclogram: Cyclogram) -> float:
    return max(peak_acceleration(track, cyclogram.period) for track in cyclogram.tracks)


def one_after_the_other() -> Cyclogram:
    """As it would be drawn without thinking: feed in, feed out, press down, press up."""
    return press([170 * deg, 215 * deg, 225 * deg, 270 * deg], [0.0, 80 * deg, 80 * deg, 160 * deg])


def test_no_random_feasible_cyclogram_is_better() -> None:
    best = least_acceleration(one_after_the_other())
    assert all(check.ok for check in check_cyclogram(best.cyclogram))
    rng, feasible = np.random.default_rng(3), []
    base = [part for track in best.cyclogram.tracks for part in track.segments]
    ends = np.array([angle for part in base for angle in (part.start, part.end)])
    for spread in np.geomspace(1e-4, 0.3, 40):
        shaken = np.clip(ends + rng.normal(0, spread, 8), 0, turn)
        try:
            other = press(sorted(shaken[:4]), sorted(shaken[4:]))
        except ParameterError:
            continue
        if all(check.ok for check in check_cyclogram(other)):
            feasible.append(largest(other))
    assert len(feasible) > 5
    assert min(feasible) >= best.after * (1 - 1e-9)
    assert min(feasible) < 1.05 * best.after  # and some come near


def test_overlap_lowers_the_acceleration_of_a_press() -> None:
    """The motions one after the other, each as long as it can be then, against motions that overlap."""
    start = one_after_the_other()
    apart = (Relation(Moment("die", "out"), Moment("feeder", "home", "end"), 0.0, "one after the other"),)
    serial = least_acceleration(replace(start, exclusions=(), relations=(*start.relations, *apart)))
    overlapped = least_acceleration(start)
    assert start.period == overlapped.cyclogram.period
    assert serial.after / overlapped.after > 1.4
    assert overlapped.before / overlapped.after > 3.5


@pytest.mark.parametrize(
    "limit",
    [
        Relation(Moment("feeder", "out"), fixed(70 * deg), 0.0, "not before its carpet"),
        Relation(fixed(290 * deg), Moment("feeder", "home", "end"), 0.0, "away before the turn ends"),
    ],
)
def test_of_two_orders_of_presences_that_overlap_the_better_one_is_taken(limit) -> None:
    def drawn(die: list[float], feeder: list[float]) -> Cyclogram:
        start = press([angle * deg for angle in die], [angle * deg for angle in feeder])
        return replace(start, relations=(*start.relations, limit))

    feeder_first = drawn([200, 230, 240, 270], [75, 110, 110, 150])
    die_first = drawn([75, 110, 120, 150], [160, 200, 200, 240])
    overlapping = drawn([120, 160, 170, 200], [100, 160, 160, 220])
    in_order = [least_acceleration(one).after for one in (feeder_first, die_first)]
    assert least_acceleration(overlapping).after == pytest.approx(min(in_order), rel=1e-9)
    assert max(in_order) > 1.05 * min(in_order)


def chain(strokes: list[float], gaps: list[float]) -> Cyclogram:
    """Tracks one after the other around the turn, a gap before each, homes free to take what is left."""
    tracks, relations, at = [], [], 0.0
    step = (turn - sum(gaps)) / (2 * len(strokes))
    for number, (stroke, gap) in enumerate(zip(strokes, gaps, strict=True)):
        start = at + gap
        tracks.append(moved(f"t{number}", [start, start + step, start + step, start + 2 * step], stroke))
        first = Moment(f"t{number - 1}", "home", "end") if number else fixed(0.0)
        relations.append(Relation(Moment(f"t{number}", "out"), first, gap, "order"))
        at = start + 2 * step
    return Cyclogram("chain", 2.0, tuple(tracks), tuple(relations))


@settings(max_examples=15)
@given(
    strokes=st.lists(st.floats(0.01, 0.3), min_size=1, max_size=4),
    gaps=st.lists(st.floats(0.0, 0.3), min_size=4, max_size=4),
)
def test_a_chain_has_the_closed_form(strokes, gaps) -> None:
    # All betas share turn - gaps, each as sqrt(h): A = Ca (w sum sqrt(h) / room)^2.
    gaps = gaps[: len(strokes)]
    room, roots = turn - sum(gaps), 2 * sum(map(math.sqrt, strokes))
    expected = LAW.acceleration_peak * (math.pi * roots / room) ** 2
    solved = least_acceleration(chain(strokes, gaps))
    assert solved.after == pytest.approx(expected, rel=1e-8)
    assert sum(one.share for one in solved.binding if one.kind == "motion") == pytest.approx(1.0)
    assert all(check.ok for check in check_cyclogram(solved.cyclogram))
    costs = [one.cost for one in solved.binding if one.kind == "relation"]
    assert costs == pytest.approx([2 / room] * len(costs), rel=1e-6)  # d ln A / d gap


@settings(max_examples=10)
@given(strokes=st.lists(st.floats(0.01, 0.3), min_size=1, max_size=3), speed=st.floats(0.2, 5), a=st.floats(0.5, 50))
def test_the_shortest_turn_of_a_chain_has_the_closed_form(strokes, speed, a) -> None:
    # T (1 - gaps/turn) = sum of the least times of the motions.
    limits = ActuatorLimits(speed=speed, acceleration=a)
    start = chain(strokes, [0.1] * len(strokes))
    start = replace(start, tracks=tuple(replace(track, limits=limits) for track in start.tracks))
    times = (max(h * LAW.velocity_peak / speed, math.sqrt(h * LAW.acceleration_peak / a)) for h in strokes)
    expected = 2 * sum(times) / (1 - 0.1 * len(strokes) / turn)
    solved = least_period(start)
    assert solved.after == pytest.approx(expected, rel=1e-8)
    for track in solved.cyclogram.tracks:
        assert peak_speed(track, solved.after) <= speed * (1 + 1e-8)
        assert peak_acceleration(track, solved.after) <= a * (1 + 1e-8)
    assert all(check.ok for check in check_cyclogram(solved.cyclogram))


def test_a_multiplier_is_what_a_degree_more_costs() -> None:
    start = one_after_the_other()
    solved, more = least_acceleration(start), 1e-5
    (cost,) = [one.cost for one in solved.binding if one.kind == "relation"]
    (relation,) = start.relations
    tighter = replace(start, relations=(replace(relation, gap=relation.gap + more),))
    assert math.log(least_acceleration(tighter).after / solved.after) / more == pytest.approx(cost, rel=1e-3)


def test_what_does_not_settle_the_answer_is_stretched_too() -> None:
    lazy = moved("lazy", [0.1, 0.2, 0.3, 0.4], 0.01)
    start = Cyclogram("two", 1.0, (moved("busy", [0.0, 0.1, 0.2, 0.3], 0.4), lazy))
    solved = least_acceleration(start).cyclogram
    assert [part.beta for part in solved.track("lazy").segments] == pytest.approx([turn / 2] * 2)


@pytest.mark.parametrize("goal", [least_acceleration, least_period])
def test_overlapping_presences_are_parted_the_better_way(goal) -> None:
    limits = ActuatorLimits(acceleration=100.0)
    both = [0.5, 1.0, 1.5, 2.0]
    tracks = tuple(moved(name, both, stroke, limits=limits) for name, stroke in (("a", 0.1), ("b", 0.3)))
    apart = Exclusion(Zone("a", low=0.0), Zone("b", low=0.02), 0.01, "one place")
    after = Relation(Moment("b", "out"), fixed(0.4), 0.0, "not before")
    start = Cyclogram("two", 1.0, tracks, (after,), (apart,))
    solved = goal(start)
    assert not any(check.ok for check in check_cyclogram(start) if "never" in check.name)
    assert all(check.ok for check in check_cyclogram(solved.cyclogram))
    orders = [0.1, 0.2, 0.3, 0.35], [4.0, 4.5, 5.0, 5.5]
    ways = [replace(start, tracks=(moved("a", order, 0.1, limits=limits), start.tracks[1])) for order in orders]
    forced = [goal(way).after for way in ways]
    assert solved.after == pytest.approx(min(forced), rel=1e-9)


def test_held_tracks_windows_events_and_delays() -> None:
    tool = moved("tool", [1.0, 1.5, 2.0, 2.5], 0.1, limits=ActuatorLimits(acceleration=40.0, speed=3.0, jerk=8000.0))
    tool = replace(tool, events=(riding("there", tool.segments[0], 1.0), TrackEvent("cut", 1.7)))
    held = moved("crank", [0.0, 1.0, 1.0, 2.0], 0.05, locked=True, limits=ActuatorLimits(time=0.02))
    relations = (
        Relation(Moment("tool", "cut", "event"), Moment("tool", "there", "event"), 0.0, "valve", delay=0.01),
        Relation(Moment("tool", "home"), Moment("tool", "cut", "event"), 5 * deg, "cut first", most=60 * deg),
        Relation(Moment("tool", "out"), Moment("tool", "home", "end"), 0.2, "rest", turns=1),
        Relation(Moment("tool", "out", "past", 0.03), Moment("crank", "out", "past", 0.02), 0.1, "clear"),
    )
    geometry = Exclusion(Zone("tool", low=0.04, name="in the warps"), Spans("reed", (Window(4.0, 4.8),)), 0.05)
    start = Cyclogram("cell", 0.5, (tool, held), relations, (geometry,))
    for solve in (least_acceleration, least_period):
        solved = solve(start)
        assert all(check.ok for check in check_cyclogram(solved.cyclogram)), solve
        assert solved.cyclogram.track("crank").segments == held.segments
        moved_tool, w = solved.cyclogram.track("tool"), solved.cyclogram.speed
        out = moved_tool.segment("out")
        assert moved_tool.event("there").angle == pytest.approx(out.end)
        for part in moved_tool.segments:
            assert 0.1 * LAW.jerk_peak * (w / part.beta) ** 3 <= 8000.0 * (1 + 1e-8)
    assert solved.after < 0.5


def test_a_motion_may_run_through_the_end_of_the_turn() -> None:
    through = moved("axis", [1.0, 2.0, 5.0, 6.5], 0.1)
    solved = least_acceleration(Cyclogram("one", 1.0, (through,))).cyclogram
    assert [part.beta for part in solved.tracks[0].segments] == pytest.approx([turn / 2] * 2)


def test_a_relation_loop_is_named() -> None:
    names = "abc"
    tracks = tuple(moved(name, [0.5, 1.0, 1.5, 2.0], 0.1) for name in names)
    loop = [
        Relation(Moment(then, "out"), Moment(first, "out", "end"), 5 * deg, "")
        for first, then in itertools.pairwise("abca")
    ]
    innocent = Relation(Moment("c", "home"), Moment("a", "out"), 0.1, "")
    with pytest.raises(ParameterError, match="relation loop in the cyclogram") as caught:
        require_possible(Cyclogram("loop", 1.0, tracks, (*loop, innocent)))
    for first, then in itertools.pairwise("abca"):
        assert f"{then}: out starts after {first}: out ends" in caught.value.given
    assert "home" not in caught.value.given
    assert "15" in caught.value.allowed


@pytest.mark.parametrize(
    ("more", "said"),
    [
        ({"locked": True}, "no motion is free"),
        ({}, "no limit is given for axis"),
        ({"law": LAWS["uniform"], "limits": ActuatorLimits(acceleration=1.0)}, "never keeps its limit of acceleration"),
    ],
)  # fmt: skip
def test_what_cannot_be_solved_is_said(more, said) -> None:
    with pytest.raises(ParameterError, match=said):
        least_period(Cyclogram("one", 1.0, (moved("axis", [1.0, 2.0, 3.0, 4.0], 0.1, **more),)))


@pytest.mark.parametrize("cyclogram", [one_after_the_other(), chained(3, 1), chained(4, 2)], ids=["press", "3", "4"])
def test_a_general_optimiser_finds_the_same(cyclogram: Cyclogram) -> None:
    assert plain(cyclogram) == pytest.approx(least_acceleration(cyclogram).after, rel=1e-6)
