"""Contours of arcs: areas and lengths against their polylines, and arcs laid through points of smooth curves."""

import math

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from ilmek.cams.laws import LAWS
from ilmek.cams.limits import area
from ilmek.cams.plate import PlateCam
from ilmek.cams.programme import CamProgramme, dwell, fall, rise
from ilmek.errors import ParameterError
from ilmek.plane import contours
from ilmek.plane.biarcs import deviation, distances, fitted
from ilmek.report import Contour


def shoelace(points: np.ndarray) -> float:
    return 0.5 * float(np.sum((np.conj(points) * np.roll(points, -1)).imag))


@given(st.floats(-4.0, 4.0).filter(lambda bulge: abs(bulge) > 0.02), st.integers(0, 2**32 - 1))
def test_distances_from_an_arc_are_those_from_its_points(bulge: float, seed: int) -> None:
    """The angle between the chord and the tangents at its ends is half the turn of the arc, 2 arctan of the bulge."""
    rng = np.random.default_rng(seed)
    start, end = complex(*rng.normal(size=2)), complex(*rng.normal(size=2))
    points = rng.normal(size=8) + 1j * rng.normal(size=8)
    half = 2 * math.atan(bulge)
    along = np.linspace(-half, half, 4001)
    radius = (end - start) / (2 * math.sin(half))
    arc = (start + end) / 2 + radius * (np.sin(along) - 1j * (np.cos(along) - math.cos(half)))
    assert arc[[0, -1]] == pytest.approx([start, end])
    wanted = np.abs(points[:, None] - arc).min(axis=1)
    assert distances(points, start, end, bulge) == pytest.approx(wanted, abs=1e-3 * abs(radius))


@settings(max_examples=30)
@given(
    st.lists(st.floats(0.5, 1.0), min_size=3, max_size=6),
    st.lists(st.floats(-0.9, 0.9) | st.floats(-1e-2, 1e-2), min_size=6, max_size=6),
)
def test_area_and_length_are_those_of_a_fine_polyline(radii: list[float], bulges: list[float]) -> None:
    count = len(radii)
    contour = Contour(np.array(radii) * np.exp(2j * np.pi * np.arange(count) / count), np.array(bulges[:count]))
    polyline = contours.along(contour, 1e-5)
    assert contours.area(contour) == pytest.approx(shoelace(polyline), abs=1e-4)
    assert contours.length(contour) == pytest.approx(np.abs(np.roll(polyline, -1) - polyline).sum(), abs=1e-4)
    low, high = contours.bounds(contour)
    assert polyline.real.min() == pytest.approx(low.real, abs=2e-5)
    assert polyline.imag.max() == pytest.approx(high.imag, abs=2e-5)


def kinks(contour: Contour) -> np.ndarray:
    """How far the direction jumps at each joint [rad]."""
    ways = np.roll(contour.points, -1) - contour.points
    half = 2 * np.arctan(contour.bulges)
    leaving, coming = np.angle(np.roll(ways, -1)) - np.roll(half, -1), np.angle(ways) + half
    return np.abs((leaving - coming + np.pi) % (2 * np.pi) - np.pi)


@pytest.mark.parametrize("law", ["harmonic", "cycloidal", "modified-sine"])
def test_arcs_follow_a_cam_within_the_tolerance_and_without_a_kink(law: str) -> None:
    turn = CamProgramme((rise(1.4, 0.03, LAWS[law]), dwell(1.0), fall(1.6, 0.03, LAWS[law]), dwell(2 * math.pi - 4.0)))
    cam = PlateCam(turn, 0.06, offset=0.004, roller_radius=0.01)
    arcs = fitted(cam.surface(-np.arange(1440) * math.pi / 720), 1e-7)
    between = cam.surface(np.linspace(0, 2 * math.pi, 5003))
    assert len(arcs.points) < 250
    assert deviation(between, arcs) < 3e-7
    assert contours.area(arcs) == pytest.approx(area(cam), rel=1e-6)
    assert kinks(arcs).max() < 1e-9


def test_a_circle_is_few_arcs_of_its_own_radius() -> None:
    arcs = fitted(1j + 0.05 * np.exp(2j * np.pi * np.arange(500) / 500), 1e-9)
    assert len(arcs.points) <= 8
    assert contours.area(arcs) == pytest.approx(math.pi * 0.05**2, rel=1e-12)


def test_corners_and_straight_edges_stay() -> None:
    square = np.array([1 + 1j, -1 + 1j, -1 - 1j, 1 - 1j])
    edges = np.concatenate(
        [a + (b - a) * np.linspace(0, 1, 7)[:-1] for a, b in zip(square, np.roll(square, -1), strict=True)]
    )
    for points in (square, edges):
        kept = fitted(points, 1e-6)
        assert not kept.bulges.any()
        assert contours.area(kept) == pytest.approx(4.0, rel=1e-15)


def test_a_cusp_of_two_arcs_keeps_its_corners() -> None:
    lens = contours.along(Contour(np.array([1j, -1j]), np.array([0.4, 0.4])), 1e-5)
    kept = fitted(lens, 1e-7)
    assert len(kept.points) <= 8
    assert contours.area(kept) == pytest.approx(contours.area(Contour(np.array([1j, -1j]), np.full(2, 0.4))), rel=1e-6)


@settings(max_examples=30)
@given(st.floats(0.01, 0.2), st.floats(0.01, 0.2), st.floats(0.1, 3.0), st.floats(0.003, 0.02))
def test_a_rounded_triangle_has_the_area_of_its_parts(a: float, b: float, angle: float, radius: float) -> None:
    corners = np.array([0, a, b * np.exp(1j * angle)])
    sides = np.abs(np.roll(corners, -1) - corners).sum()
    expected = 0.5 * a * b * math.sin(angle) + sides * radius + math.pi * radius**2
    assert contours.area(contours.rounded_hull(corners, radius)) == pytest.approx(expected, rel=1e-9)


def test_a_keyed_bore_has_the_area_of_bore_and_slot() -> None:
    radius, width, depth = 0.0125, 0.008, 0.0033
    half = math.asin(width / 2 / radius)
    sliver = radius**2 * (half - math.sin(half) * math.cos(half))  # of the circle, inside the slot
    at = radius * math.cos(half)
    expected = math.pi * radius**2 - sliver + width * (radius + depth - at)
    assert contours.area(contours.keyed_bore(radius, width, depth)) == pytest.approx(expected, rel=1e-12)
    with pytest.raises(ParameterError, match="a keyway 25 mm wide; above 0 mm, less than the bore of 25 mm"):
        contours.keyed_bore(radius, 2 * radius, depth)


@settings(max_examples=40)
@given(
    st.floats(0.003, 0.1), st.floats(0.1, 0.6), st.floats(-0.3, 0.3), st.integers(1, 2), st.floats(0, 6), st.booleans()
)
def test_a_keyed_bore_is_known_again_wherever_it_lies(  # noqa: PLR0917
    radius: float, wide: float, deep: float, number: int, angle: float, back: bool
) -> None:
    assume(abs(deep) > 0.05)
    width, depth = wide * radius, deep * radius
    drawn = contours.keyed_bore(radius, width, depth, number)
    points, bulges = 0.3 - 0.1j + np.exp(1j * angle) * drawn.points, drawn.bulges
    if back:
        points, bulges = points[::-1], -np.roll(bulges[::-1], -1)
    keyed = contours.as_keyed(Contour(points, bulges))
    assert keyed is not None
    assert keyed.centre == pytest.approx(0.3 - 0.1j, abs=1e-9)
    assert (keyed.radius, keyed.width, keyed.floor) == pytest.approx((radius, width, radius + depth), rel=1e-7)
    assert min(abs(one - np.exp(1j * angle)) for one in keyed.directions) < 1e-7
    assert len(keyed.directions) == number


def test_other_contours_are_no_keyed_bore() -> None:
    bar = contours.rounded_hull(np.array([0, 0.1 + 0j]), 0.01)  # two arcs and two straight pieces
    tilted = contours.keyed_bore(0.01, 0.006, 0.0028)
    moved = Contour(tilted.points + np.array([0, 0, 1e-4, 0]), tilted.bulges)
    square = contours.polygon(np.array([0, 1, 1 + 1j, 1j]))
    assert [contours.as_keyed(one) for one in (bar, moved, square, contours.circle(0j, 1.0))] == [None] * 4
