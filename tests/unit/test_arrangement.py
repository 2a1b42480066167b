"""The side view of a loom: spans from what must have room, coordinates, and the clearances of all that moves."""

import math
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from examples import draw_arrangement

from ilmek.arrays import ComplexArray, FloatArray
from ilmek.machines.arrangement.clearances import (
    MovingBody,
    least_clearances,
    moving,
    samples,
    standing,
)
from ilmek.machines.arrangement.side_view import RETREAT
from ilmek.machines.arrangement.spans import ShedRoom, shed_spans, spans_at
from ilmek.machines.automated_loom import LoomDesign, design
from ilmek.machines.automated_loom.bodies import CARRIER, GUIDE_CAMS, LEAVES, knot_bodies, row_bodies
from ilmek.machines.automated_loom.motion.row_views import row_from_the_side
from ilmek.machines.automated_loom.params import AutomatedLoomParams
from ilmek.machines.automated_loom.parts import parts_of_loom
from ilmek.machines.automated_loom.room import TOUCHING, clearances, room_checks, room_tables
from ilmek.machines.automated_loom.views import front, room, side
from ilmek.units import deg, mm, turn

ROOM = ShedRoom(24 * mm, 36 * mm, 54 * mm, 20 * mm, 80 * mm, 30 * mm, 0.28, 0.35, 70 * mm, 1 * mm, 3 * mm)


@cache
def loom(**settings: str) -> LoomDesign:
    return design(AutomatedLoomParams.read({"beat": "comb", **settings}))


def disc(centre: complex, radius: float, points: int = 720) -> ComplexArray:
    return np.asarray(centre + radius * np.exp(1j * turn * np.arange(points) / points))


def edge_points(corners: ComplexArray, each: int = 60) -> ComplexArray:
    """Points along the edges of a polygon, its corners among them."""
    share = np.arange(each) / each
    following = np.roll(corners, -1)
    return np.asarray((corners[:, None] + (following - corners)[:, None] * share).ravel())


def inside(points: ComplexArray, corners: ComplexArray) -> bool:
    """Whether any point is within a convex polygon, counter-clockwise."""
    edges = np.roll(corners, -1) - corners
    arms = points[:, None] - corners
    return bool(((edges.conj() * arms).imag > 0).all(axis=1).any())


def brute(one: ComplexArray, other: ComplexArray) -> float:
    """Distance of two polygons by points along their edges; 0 where one has a point of the other."""
    if inside(one, other) or inside(other, one):
        return 0.0
    return float(np.abs(edge_points(one)[:, None] - edge_points(other)).min())


def test_the_carrier_has_its_clearances_at_the_height_that_the_spans_leave() -> None:
    prime, guide = 78 * mm, 148 * mm
    spans = shed_spans(ROOM, prime, guide)
    front = spans.front[0]
    opening = ROOM.opening * spans.carrier / front
    assert opening == pytest.approx(ROOM.carrier_depth + 2 * ROOM.clearance + ROOM.warp)
    leaf = complex(-5 * mm, spans.comb + ROOM.leaf_height)
    assert abs(leaf - complex(-prime, front)) - guide >= 0.8 * ROOM.clearance
    assert spans.comb - spans.carrier == pytest.approx(ROOM.carrier_width + ROOM.clearance)
    assert spans.back[0] >= front


def test_a_thicker_carrier_needs_a_longer_front_span_and_guides_of_neighbouring_shafts_clear_each_other() -> None:
    thick = shed_spans(replace(ROOM, carrier_depth=30 * mm), 78 * mm, 148 * mm)
    thin = shed_spans(ROOM, 78 * mm, 148 * mm, shafts=3)
    assert thick.front[0] > thin.front[0] * 1.2
    assert np.diff(thin.front) == pytest.approx(2 * 148 * mm + ROOM.clearance)
    assert np.add(thin.front, thin.back) == pytest.approx(thin.back_rest)


def test_spans_that_are_given_stay_and_carry_comb_and_carrier_with_them() -> None:
    near = spans_at(ROOM, 78 * mm, 148 * mm, (0.40,), (0.40,))
    far = spans_at(ROOM, 78 * mm, 148 * mm, (0.45,), (0.40,))
    assert far.comb - near.comb == pytest.approx(0.05)
    assert spans_at(ROOM, 78 * mm, 148 * mm, (0.08,), (0.08,)).carrier == ROOM.clearance


@pytest.mark.parametrize("turned", [0.0, 0.3, 0.7, 1.1])
def test_distances_of_bodies_are_those_of_brute_force(turned: float) -> None:
    rng = np.random.default_rng(7)
    square = np.array([0, 0.1, 0.1 + 0.05j, 0.05j]) * np.exp(1j * turned)
    triangle = np.array([0, 0.08 + 0.01j, 0.03 + 0.06j])
    for offset in 0.3 * (rng.random(12) - 0.5 + 1j * (rng.random(12) - 0.5)):
        bodies = (MovingBody("a", (standing(square),)), MovingBody("b", (standing(triangle + offset),)))
        (found,) = least_clearances(bodies, samples(), 1.0)
        assert max(found.value, 0.0) == pytest.approx(brute(square, triangle + offset), abs=0.2 * mm)


def test_a_disc_and_a_bar_that_passes_it_are_nearest_where_brute_force_finds_them() -> None:
    bar = np.array([0, 0.2, 0.2 + 0.01j, 0.01j])

    def path(angle: FloatArray) -> ComplexArray:
        return np.asarray(complex(-0.1, 0.03) + 0.4 * (angle / turn - 0.5))

    bodies = (MovingBody("disc", (standing(np.array([0j]), 0.02),)), MovingBody("bar", (moving(bar, path),)))
    (found,) = least_clearances(bodies, samples(), 1.0)
    expected = min(brute(bar + path(np.array([angle]))[0], disc(0j, 0.02)) for angle in np.linspace(0, turn, 25))
    assert found.value == pytest.approx(0.01, abs=1e-9)
    assert found.value == pytest.approx(expected, abs=0.2 * mm)


def test_a_least_distance_between_two_samples_is_found() -> None:
    """A point that runs 1 m within a degree passes a point 3 mm beside its path, between the samples."""

    def path(angle: FloatArray) -> ComplexArray:
        return np.asarray(np.clip((angle - 1.0) / deg, 0.0, 1.0) - 0.37 + 0.003j)

    bodies = (MovingBody("a", (moving(np.array([0j]), path),)), MovingBody("b", (standing(np.array([0j])),)))
    angles = samples([1.0, 1.0 + deg])
    sampled = np.abs(path(angles)).min()
    (found,) = least_clearances(bodies, angles, 5 * mm)
    assert sampled > 0.05
    assert found.value == pytest.approx(0.003, abs=0.03 * mm)
    assert found.angle == pytest.approx(1.0 + 0.37 * deg, abs=0.01 * deg)


def test_moving_a_part_away_by_a_distance_adds_it_to_the_clearance() -> None:
    base = np.array([0, 0.05, 0.05 + 0.05j, 0.05j])
    values = []
    for apart in (0.0, 7 * mm):
        bodies = (MovingBody("a", (standing(base),)), MovingBody("b", (standing(base + 0.06 + apart),)))
        values.append(least_clearances(bodies, samples(), 1.0)[0].value)
    assert values[1] - values[0] == pytest.approx(7 * mm)
    assert values[0] == pytest.approx(10 * mm)


def test_bodies_that_are_never_in_the_loom_together_have_no_clearance() -> None:
    base = np.array([0, 1, 1 + 1j, 1j])
    first = MovingBody("a", (standing(base),), ((0.0, 1.0),))
    assert least_clearances((first, MovingBody("b", (standing(base),), ((2.0, 3.0),))), samples([1.0, 2.0]), 1.0) == ()


def test_everything_on_the_default_loom_has_room() -> None:
    found = clearances(loom())
    assert all(check.ok for check in room_checks(loom(), found, 0.1))
    pairs = {frozenset((one.distance.first, one.distance.second)) for one in found}
    assert frozenset((CARRIER, "even warps")) in pairs
    assert frozenset((GUIDE_CAMS, LEAVES)) in pairs
    assert not pairs & set(TOUCHING)


def test_clearances_of_the_loom_are_those_of_brute_force_at_every_degree() -> None:
    made = loom()
    bodies = {body.name: body for body in row_bodies(made.side, made.row_cyclogram, made.beat.path, stack=False)}
    found = {frozenset((one.distance.first, one.distance.second)): one.distance for one in clearances(made)}
    angles = np.arange(0.0, turn, deg)
    for first, second in (("comb's bar", "sley"), ("comb's leaves", CARRIER), ("head", "comb's bar")):
        near = math.inf
        for angle in angles:
            at = np.array([angle])
            both = [bodies[name] for name in (first, second)]
            if not all(any(low <= angle <= high for low, high in body.windows) for body in both):
                continue
            one, other = (body.parts[0].corners(at)[0] for body in both)
            near = min(near, brute(one, other))
        assert found[frozenset((first, second))].value == pytest.approx(near, abs=1.5 * mm)


def test_half_spans_of_80_mm_let_cams_run_into_what_holds_the_warps() -> None:
    """The thesis' loom with spans too short: the clearances find it."""
    made = loom(**{"shedding.half_span": "80mm"})
    failed = [check for check in room_checks(made, clearances(made), 0.1) if not check.ok]
    worst = {check.name: check.value for check in failed}
    assert worst["clearance: guide cams and carpet"] < 0
    assert worst["clearance: guide cams and back rest"] < 0
    assert all(check.cure for check in failed)


def test_a_shed_too_low_for_its_carrier_fails_its_clearance() -> None:
    made = loom(lift="15mm")
    assert not next(check for check in room_checks(made, clearances(made), 0.1) if CARRIER in check.name).ok


def test_heads_retreat_until_they_are_below_what_beats() -> None:
    made = loom()
    lowest = min(made.beat.path.carried(one, made.beat.path.tip).imag.min() for one in made.beat.path.outline)
    top = made.side.head.top + made.side.retreat * RETREAT.imag
    assert top == pytest.approx(min(lowest, 0.0) - made.side.room.clearance, abs=1e-12)
    track = made.row_cyclogram.track("heads")
    assert track.stroke == made.side.retreat
    axes = [part.length for part in parts_of_loom(made).parts if part.name == "axis of the rail's retreat"]
    assert axes == [pytest.approx(made.side.retreat)]


def test_the_stack_goes_down_with_the_comb_on_the_guide_cams() -> None:
    made = loom(beat="guide-cams")
    (cams,) = (
        body
        for body in row_bodies(made.side, made.row_cyclogram, made.beat.path, stack=True)
        if body.name == GUIDE_CAMS
    )
    heights = cams.parts[0].corners(samples())[:, 0].imag
    assert heights.max() - heights.min() == pytest.approx(made.side.beat_stroke, rel=1e-3)


def test_tools_reach_behind_the_warps_while_they_knot_and_stand_clear_in_the_row() -> None:
    made = loom()
    knot, row = made.cyclograms
    deepest = {body.name: body.parts[0].corners(samples()).real.min() for body in knot_bodies(made.side, knot)}
    in_row = row_bodies(made.side, row, made.beat.path, stack=False)
    clear = {body.name: body.parts[0].corners(np.array([turn / 4])).real.min() for body in in_row}
    for tool in ("side grippers", "opener", "centre gripper"):
        assert deepest[tool] < -made.side.room.warp / 2
        assert clear[tool] > made.side.retreat * RETREAT.real


def test_coordinates_agree() -> None:
    side, pile = loom().side, loom().params.pile.pile_height
    assert side.warp_length > side.spans.back_rest
    assert side.fell_height == pytest.approx(-side.floor)
    assert side.loom_height > side.spans.back_rest + side.fell_height
    assert side.lower.at.imag - side.roll > side.floor
    assert side.roll**2 == pytest.approx(side.lower.radius**2 + 1.8 * (pile + 3 * side.room.warp) / math.pi)


def test_the_figures_of_the_docs_are_those_of_the_default_loom() -> None:
    for name, text in draw_arrangement.drawn().items():
        assert 'width="' in text
        assert (draw_arrangement.OUT / f"{name}.svg").read_text(encoding="utf-8")[:200] == text[:200]
    assert draw_arrangement.least() >= 2 * mm


def test_the_side_views_dimensions_are_the_results() -> None:
    made = loom()
    (retreat,) = (one for one in room(made).strokes if one.label.startswith("retreat"))
    assert abs(retreat.points[1] - retreat.points[0]) == pytest.approx(made.side.retreat)
    spans = [one for one in side(made).strokes if one.role == "dimension"]
    lengths = [abs(one.points[-1] - one.points[0]) for one in spans]
    for size in (made.side.front_span, made.side.back_span, made.side.fell_height, made.side.loom_height):
        assert any(length == pytest.approx(size) for length in lengths)


_VIEWS = (front, side)


def test_front_and_side_show_the_same_heights() -> None:
    made = loom()
    heights = [
        (min(one.points.imag.min() for one in closed), max(one.points.imag.max() for one in closed))
        for closed in (
            [one for one in view(made).strokes if one.closed and one.role != "yarn"] for view in (front, side)
        )
    ]
    assert heights[0] == pytest.approx(heights[1], abs=1 * mm)
    assert heights[0][0] == pytest.approx(made.side.floor, abs=1 * mm)


@pytest.mark.matrix(light=3)
@pytest.mark.parametrize(
    "settings",
    [
        {"beat": "linkage"},
        {"beat": "guide-cams"},
        {"knot": "asymmetric"},
        {"width": "4m"},
        {"shedding.shafts": "2"},
        {"knots_across": "60/dm"},
        {"shedding.half_span": "80mm"},
    ],
    ids=str,
)
def test_other_looms_have_their_views_and_clearances(settings: dict[str, str]) -> None:
    made = loom(**settings)
    found = clearances(made)
    assert found
    assert len(side(made).strokes) > 20
    assert len(room(made).strokes) > 10
    kept = all(check.ok for check in room_checks(made, found, 0.1))
    assert kept == ("shedding.half_span" not in settings)
    tables = room_tables(found)
    assert len(tables[0].rows) == len(found)
    assert all(all(row) for row in tables[1].rows)


def test_the_row_from_the_side_has_its_shuttle_only_in_the_shed() -> None:
    made = loom()
    moving_row = row_from_the_side(made)
    shuttle = next(one for one in moving_row.strokes if one.label == "shuttle of the straight weft").points
    size = np.ptp(shuttle.real, axis=1)
    first, last = made.row_timing.window
    assert size.max() == pytest.approx(made.weft.carried.depth, rel=0.02)
    assert size[(moving_row.at < first) | (moving_row.at > last)] == pytest.approx(0.0, abs=1e-12)
    comb = next(one for one in moving_row.strokes if one.label == "comb").points
    assert comb.imag.min() == pytest.approx(0.0, abs=10 * mm)


@pytest.mark.parametrize("settings", [{}, {"width": "6m"}, {"shedding.shafts": "2"}], ids=str)
def test_machines_are_designed_for_the_lengths_that_the_view_reports(settings: dict[str, str]) -> None:
    """But for a compensator that needs more room than was kept for it."""
    made = loom(**settings)
    assert made.task.side is not None
    tolerance = 0.02 if "shedding.shafts" in settings else 1e-9
    for length in (made.task.side.warp_length, made.warp_tension.params.free_length, made.shedding.params.warp_length):
        assert length == pytest.approx(made.side.warp_length, rel=tolerance)
    assert made.shedding.params.front_span == pytest.approx(made.side.front_span)


def test_more_colours_than_a_tier_holds_make_the_head_deeper_not_the_row_wider() -> None:
    few, many = loom(), loom(colours="200")
    assert many.side.head.magazine_size.imag > few.side.head.magazine_size.imag
    assert all(check.ok for check in room_checks(many, clearances(many), 0.1))
