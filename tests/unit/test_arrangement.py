"""The side view of a loom: spans from what must have room, coordinates, distances from warps and carpet."""

import math
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from examples import draw_arrangement

from ilmek.arrays import ComplexArray
from ilmek.machines.arrangement.side_view import RETREAT
from ilmek.machines.arrangement.spans import ShedRoom, shed_spans, spans_at
from ilmek.machines.automated_loom import LoomDesign, design
from ilmek.machines.automated_loom.cloth_clearances import (
    CAMS,
    CARPET,
    CARRIER,
    HEAD,
    WARPS,
    WORKING,
    cloth_checks,
    cloth_clearances,
    cloth_table,
)
from ilmek.machines.automated_loom.cyclogram import EVEN, ODD, weft_windows
from ilmek.machines.automated_loom.motion.row_views import row_from_the_side
from ilmek.machines.automated_loom.params import AutomatedLoomParams
from ilmek.machines.automated_loom.parts import parts_of_loom
from ilmek.machines.automated_loom.views import front, room, side
from ilmek.machines.weaver.head_shape import SLEY_TOOL
from ilmek.timing.track import sample
from ilmek.units import deg, mm, turn

ROOM = ShedRoom(24 * mm, 36 * mm, 54 * mm, 20 * mm, 80 * mm, 30 * mm, 0.28, 0.35, 70 * mm, 1 * mm, 3 * mm)


@cache
def loom(**settings: str) -> LoomDesign:
    return design(AutomatedLoomParams.read({"aim": "price", "beat": "comb", **settings}))


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


def _from_sheet(made: LoomDesign, moved: ComplexArray, lift: float) -> float:
    """Distance of a polygon, by points along its edges, from a sheet with a lift at its cams [m]."""
    top, rest = complex(lift, made.side.cams[0].at.imag), 1j * made.side.spans.back_rest
    share = np.linspace(0.0, 1.0, 5_001)
    line = np.concatenate([top * share, top + (rest - top) * share])
    return float(np.abs(edge_points(moved)[:, None] - line).min()) - made.side.room.warp / 2


@pytest.mark.parametrize("settings", [{}, {"width": "0.6m", "lift": "55mm"}, {"knot": "asymmetric"}], ids=str)
def test_the_carrier_is_as_far_from_the_warps_as_points_along_its_edges(settings: dict[str, str]) -> None:
    made = loom(**settings)
    found = {(one.body, one.cloth): one for one in cloth_clearances(made)}[CARRIER, WARPS]
    corner, size = made.side.carrier.corner, made.side.carrier.size
    box = corner + np.array([0, size.real, size, 1j * size.imag])
    tracks = [made.row_cyclogram.track(name) for name in (EVEN, ODD)]
    passing = [np.linspace(*window, 40) for window in weft_windows(made.row_cyclogram)]
    angles = np.append(np.concatenate(passing), found.angle) % turn
    lifts = {float(lift) for track in tracks for lift in sample(track, angles).position}
    assert found.value == pytest.approx(min(_from_sheet(made, box, lift) for lift in lifts), abs=0.02 * mm)


@pytest.mark.parametrize("settings", [{}, {"width": "0.6m"}, {"beat": "linkage"}], ids=str)
def test_distances_from_the_carpet_are_those_of_points_along_the_edges(settings: dict[str, str]) -> None:
    made = loom(**settings)
    side, row = made.side, made.row_cyclogram
    low, back = side.lower.at.imag, -side.room.warp
    yarns, pile = made.task.yarns, made.params.pile
    leg = yarns.warp.diameter / 2 + yarns.pile.diameter + pile.pile_height + pile.cut_waste
    carpet = np.array([complex(back, low), complex(leg, low), leg, back])
    away = sample(row.track("heads"), np.arange(0.0, turn, 2 * deg)).position * RETREAT
    shape = side.of_heads.shape
    head = shape.body + np.array([0, shape.size.real, shape.size, 1j * shape.size.imag])
    found = {(one.body, one.cloth): one.value for one in cloth_clearances(made)}
    tools = [
        tool.corner + np.array([0, tool.size.real, tool.size, 1j * tool.size.imag])
        for tool in shape.tools
        if tool.name != SLEY_TOOL
    ]
    nearest = min(brute(box + shift, carpet) for box in (head, *tools) for shift in away)
    assert found[HEAD, CARPET] == pytest.approx(nearest, abs=0.6 * mm)


def test_everything_on_the_default_loom_has_room() -> None:
    assert all(check.ok for check in cloth_checks(loom()))
    pairs = {(one.body, one.cloth) for one in cloth_clearances(loom())}
    assert {(CARRIER, WARPS), (HEAD, CARPET), (HEAD, WARPS)} <= pairs
    assert not pairs & WORKING


def test_spans_too_short_let_the_guide_cams_run_into_the_carpet() -> None:
    """The thesis' loom with half spans of 80 mm: a disc against the fell, by hand."""
    made = loom(**{"shedding.half_span": "80mm"})
    worst = {check.name: check for check in cloth_checks(made) if not check.ok}
    (cam,) = made.side.cams
    edge = complex(-made.side.room.warp, 0.0)
    assert worst["clearance: guide cams and carpet"].value == pytest.approx(abs(cam.at - edge) - cam.guide_radius)
    assert all(check.cure for check in worst.values())


@pytest.mark.parametrize("lift", ["15mm", "20mm"])
def test_a_shed_too_low_for_its_carrier_fails_its_clearance(lift: str) -> None:
    assert not next(check for check in cloth_checks(loom(lift=lift)) if CARRIER in check.name).ok


def test_heads_retreat_until_they_are_below_what_beats() -> None:
    made = loom()
    lowest = min(made.beat.path.carried(one, made.beat.path.tip).imag.min() for one in made.beat.path.outline)
    top = made.side.of_heads.shape.top + made.side.of_heads.retreat * RETREAT.imag
    assert top == pytest.approx(min(lowest, 0.0) - made.side.room.clearance, abs=1e-12)
    track = made.row_cyclogram.track("heads")
    assert track.stroke == made.side.of_heads.retreat
    axes = [part.length for part in parts_of_loom(made).parts if part.name == "axis of the rail's retreat"]
    assert axes == [pytest.approx(made.side.of_heads.retreat)]


def test_the_stack_goes_down_with_the_comb_on_the_guide_cams() -> None:
    """It is as much nearer to the fell as the comb's stroke says."""
    made = loom(beat="guide-cams")
    sunk = {(one.body, one.cloth): one.value for one in cloth_clearances(made)}[CAMS, CARPET]
    (cam,) = made.side.cams
    low = cam.at - 1j * made.side.beat_stroke
    assert sunk == pytest.approx(abs(low + made.side.room.warp) - cam.guide_radius, abs=0.2 * mm)


def test_coordinates_agree() -> None:
    side, pile = loom().side, loom().params.pile.pile_height
    assert side.warp_length > side.spans.back_rest
    assert side.fell_height == pytest.approx(-side.floor)
    assert side.loom_height > side.spans.back_rest + side.fell_height
    assert side.lower.at.imag - side.roll > side.floor
    woven = 450 * loom().task.cloth.row_distance
    assert side.roll**2 == pytest.approx(side.lower.radius**2 + woven * (pile + 3 * side.room.warp) / math.pi)


def test_the_figures_of_the_docs_are_those_of_the_default_loom() -> None:
    for name, text in draw_arrangement.drawn().items():
        assert 'width="' in text
        assert (draw_arrangement.OUT / f"{name}.svg").read_text(encoding="utf-8")[:200] == text[:200]
    assert draw_arrangement.least() >= 2 * mm


def test_the_side_views_dimensions_are_the_results() -> None:
    made = loom()
    (retreat,) = (one for one in room(made).strokes if one.label.startswith("retreat"))
    assert abs(retreat.points[1] - retreat.points[0]) == pytest.approx(made.side.of_heads.retreat)
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
    found = cloth_clearances(made)
    assert found
    assert len(side(made).strokes) > 20
    assert len(room(made).strokes) > 10
    kept = all(check.ok for check in cloth_checks(made))
    assert kept == ("shedding.half_span" not in settings)
    assert len(cloth_table(made).rows) == len(found)


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
    tolerance = 0.02 if "shedding.shafts" in settings else 1e-3  # the beams' flange is known after the lengths
    for length in (made.task.side.warp_length, made.warp_tension.params.free_length, made.shedding.params.warp_length):
        assert length == pytest.approx(made.side.warp_length, rel=tolerance)
    assert made.shedding.params.front_span == pytest.approx(made.side.front_span)


def test_more_colours_than_a_tier_holds_make_the_head_deeper_not_the_row_wider() -> None:
    few, many = loom(), loom(colours="200")
    assert many.side.of_heads.shape.magazine_size.imag > few.side.of_heads.shape.magazine_size.imag
    assert all(check.ok for check in cloth_checks(many))
