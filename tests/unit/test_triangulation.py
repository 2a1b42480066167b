"""Triangles of polygons with holes, and the solids of plates: volume, bounds, closed surfaces."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from plate_solids import plate_solid

from ilmek.errors import IlmekError
from ilmek.part.mesh import extruded
from ilmek.part.shapes import box, tube
from ilmek.plane.contours import area, bounds, circle, rounded_hull
from ilmek.plane.solids import bounds as box_of
from ilmek.plane.solids import is_closed, thinned, volume
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


def _rectangle(low: complex, high: complex, pieces: int) -> np.ndarray:
    """Corners and, on each side, points in line with them; counter-clockwise."""
    corners = np.array([low, complex(high.real, low.imag), high, complex(low.real, high.imag)])
    return np.concatenate([np.linspace(begin, end, pieces, endpoint=False) for begin, end in pairwise_ring(corners)])


def pairwise_ring(corners: np.ndarray) -> zip:
    return zip(corners, np.roll(corners, -1), strict=True)


@given(st.integers(1, 4), st.integers(1, 4), st.integers(1, 3), st.integers(0, 10**6))
def test_a_grid_of_aligned_holes_is_closed_and_has_its_volume(wide: int, high: int, pieces: int, seed: int) -> None:
    """Corners in line with others, which ear clipping alone leaves out, are corners of triangles too."""
    random = np.random.default_rng(seed)
    cells = [complex(x, y) for x in range(wide) for y in range(high) if random.random() < 0.8]
    sides = random.choice([0.25, 0.5], len(cells))
    outline = _rectangle(0, complex(wide, high), pieces)
    holes = [
        _rectangle(cell + 0.125 + 0.125j, cell + 0.125 + 0.125j + side * (1 + 1j), pieces)[::-1]
        for cell, side in zip(cells, sides, strict=True)
    ]
    points = np.concatenate([outline, *holes])
    exact = wide * high - float(np.sum(sides**2))
    assert _area(points, triangles(outline, holes)) == pytest.approx(exact, rel=1e-12)
    plate = extruded([outline, *holes], 2.0)
    assert is_closed(plate)
    assert volume(plate) == pytest.approx(2 * exact, rel=1e-12)


@given(st.integers(3, 40), st.integers(0, 10**6))
def test_no_triangle_lies_outside_or_in_a_hole(number: int, seed: int) -> None:
    """The middle of each triangle is inside by the even-odd rule."""
    random = np.random.default_rng(seed)
    outline = random.uniform(1.0, 3.0, number + 3) * np.exp(2j * math.pi * np.arange(number + 3) / (number + 3))
    hole = random.uniform(0.1, 0.4, number) * np.exp(-2j * math.pi * np.arange(number) / number)
    try:
        found = triangles(outline, [hole])
    except IlmekError:
        return  # the outline of few corners passes through the hole
    middles = np.concatenate([outline, hole])[found].mean(axis=1)
    crossings = np.zeros(len(middles), int)
    for ring in (outline, hole):
        for begin, end in pairwise_ring(ring):
            spans = (begin.imag > middles.imag) != (end.imag > middles.imag)
            if end.imag != begin.imag:
                slope = (end.real - begin.real) / (end.imag - begin.imag)
                crossings += spans & (middles.real < begin.real + slope * (middles.imag - begin.imag))
    assert (crossings % 2 == 1).all()


@pytest.mark.parametrize("hole", [5 + 5j, 1.9 + 1j])
def test_a_hole_outside_of_its_outline_or_across_it_is_refused(hole: complex) -> None:
    with pytest.raises(IlmekError, match="crosses itself"):
        triangles(_rectangle(0, 2 + 2j, 1), [_rectangle(hole, hole + 0.5 + 0.5j, 1)[::-1]])


def test_an_outline_that_crosses_itself_is_refused() -> None:
    with pytest.raises(IlmekError, match="crosses itself"):
        triangles(np.array([0, 2 + 2j, 2, 2j]))


def test_solids_are_closed_and_have_the_volume_of_their_formulas() -> None:
    solid = box(1, 2, 3).mesh()
    assert is_closed(solid)
    assert volume(solid) == pytest.approx(6.0, rel=1e-12)
    assert volume(tube(0.14, 0.005, 1.0).mesh(1e-6)) == pytest.approx(math.pi * (0.07**2 - 0.065**2), rel=1e-3)


def test_a_plate_is_as_thick_and_as_large_as_its_drawing() -> None:
    outline = rounded_hull(np.array([0, 0.09 + 0j]), 0.015)
    holes = (Hole(0j, 0.005), Hole(0.09 + 0j, 0.005))
    plate = Plate("crank", "Crank", outline, 0.01, "steel", holes, cutouts=(circle(0.045 + 0j, 0.004),))
    exact = (area(outline) - math.pi * (2 * 0.005**2 + 0.004**2)) * 0.01
    solid = plate_solid(plate)
    assert is_closed(solid)
    assert volume(solid) == pytest.approx(exact, rel=2e-3)
    low, high = bounds(outline)
    lower, upper = box_of(solid)
    assert np.allclose(lower, [low.real, low.imag, 0.0], atol=1e-12)
    assert np.allclose(upper, [high.real, high.imag, 0.01], atol=1e-12)


def test_a_thinned_line_stays_within_its_deviation() -> None:
    line = np.exp(1j * np.linspace(0, 2 * math.pi, 1440, endpoint=False)) * 0.148
    kept = thinned(line, 1e-3)
    assert len(kept) < 60
    assert np.isin(kept, line).all()
    nearest = np.abs(np.interp(np.angle(line), np.angle(kept), np.abs(kept), period=2 * math.pi))
    assert np.max(np.abs(nearest - np.abs(line))) < 1e-3
