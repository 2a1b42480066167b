"""Triangles of polygons with holes, and the solids of plates: volume, bounds, closed surfaces."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ilmek.errors import IlmekError
from ilmek.plane.contours import area, bounds, circle, rounded_hull
from ilmek.plane.solids import bounds as box_of
from ilmek.plane.solids import box, is_closed, lengthwise, plate_solid, square_tube, thinned, tube, upright, volume
from ilmek.plane.triangulation import triangles
from ilmek.plane.vectors import cross
from ilmek.report import Hole, Plate


def _area(points: np.ndarray, found: np.ndarray) -> float:
    one, two, three = points[found].T
    each = cross(two - one, three - one)
    assert (each > -1e-15).all()
    return float(each.sum() / 2)


@given(st.integers(5, 60), st.integers(0, 10**6))
def test_triangles_of_a_star_shaped_polygon_with_a_hole_have_its_area(number: int, seed: int) -> None:
    random = np.random.default_rng(seed)
    angle = np.sort(random.uniform(0, 2 * math.pi, number)) + np.arange(number) * 1e-3
    outline = random.uniform(1.0, 3.0, number) * np.exp(1j * np.arange(number) * 2 * math.pi / number)
    hole = 0.4 * np.exp(-1j * angle / angle[-1] * 6.0)
    points = np.concatenate([outline, hole])
    found = triangles(outline, [hole])
    twice = [float(np.sum(cross(one, np.roll(one, -1)))) for one in (outline, hole)]
    assert _area(points, found) == pytest.approx(sum(twice) / 2, rel=1e-9)
    assert len(found) == len(points)  # corners + 2 holes - 2


def test_an_outline_that_crosses_itself_is_refused() -> None:
    with pytest.raises(IlmekError, match="crosses itself"):
        triangles(np.array([0, 2 + 2j, 2, 2j]))


def test_solids_are_closed_and_have_the_volume_of_their_formulas() -> None:
    for made, exact in (
        (box((0, 0, 0), (1, 2, 3)), 6.0),
        (square_tube(0.08, 0.004, -1, 1), 2 * (0.08**2 - 0.072**2)),
    ):
        for turned in (made, upright(made), lengthwise(made)):
            assert is_closed(turned)
            assert volume(turned) == pytest.approx(exact, rel=1e-12)
    assert volume(tube(0.1j, 0.07, 0.065, 0, 1, chord_error=1e-6)) == pytest.approx(
        math.pi * (0.07**2 - 0.065**2), rel=1e-3
    )


def test_a_plate_is_as_thick_and_as_large_as_its_drawing() -> None:
    outline = rounded_hull(np.array([0, 0.09 + 0j]), 0.015)
    holes = (Hole(0j, 0.005), Hole(0.09 + 0j, 0.005))
    plate = Plate("crank", "Crank", outline, 0.01, "steel", holes, cutouts=(circle(0.045 + 0j, 0.004),))
    exact = (area(outline) - math.pi * (2 * 0.005**2 + 0.004**2)) * 0.01
    solid = plate_solid(plate, -0.005)
    assert is_closed(solid)
    assert volume(solid) == pytest.approx(exact, rel=2e-3)
    low, high = bounds(outline)
    lower, upper = box_of(solid)
    assert np.allclose(lower, [-0.005, low.imag, low.real], atol=1e-12)
    assert np.allclose(upper, [0.005, high.imag, high.real], atol=1e-12)


def test_a_thinned_line_stays_within_its_deviation() -> None:
    line = np.exp(1j * np.linspace(0, 2 * math.pi, 1440, endpoint=False)) * 0.148
    kept = thinned(line, 1e-3)
    assert len(kept) < 60
    assert np.isin(kept, line).all()
    nearest = np.abs(np.interp(np.angle(line), np.angle(kept), np.abs(kept), period=2 * math.pi))
    assert np.max(np.abs(nearest - np.abs(line))) < 1e-3
