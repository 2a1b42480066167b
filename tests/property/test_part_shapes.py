"""Shapes of parts: exact moments against closed forms, the own mesh's tetrahedra, and the laws of a rigid motion."""

import math
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ilmek.part.moments import Moments
from ilmek.part.placement import ALONG_WIDTH, IN_SIDE_VIEW, UPRIGHT, Placement, placement
from ilmek.part.profile import Profile
from ilmek.part.shapes import Placed, Prism, Shape, Sum, Turned, bar, box, disc, square_tube, stepped, tube
from ilmek.plane.contours import circle, keyed_bore, polygon, rounded_hull, strip
from ilmek.plane.solids import is_closed, volume
from ilmek.report.scene import Solid

_SIZE = st.floats(0.01, 2.0)
_ANGLE = st.floats(-3.0, 3.0)


@st.composite
def _placements(draw: st.DrawFn) -> Placement:
    axis = draw(st.tuples(_ANGLE, _ANGLE, _ANGLE).filter(lambda one: math.hypot(*one) > 0.1))
    return placement(draw(_ANGLE), draw(_ANGLE), draw(_ANGLE), about=axis, angle=draw(_ANGLE))


@st.composite
def _shapes(draw: st.DrawFn) -> Shape:
    """A shape of each kind, with holes, arcs of both directions, and sums at random positions."""
    a, b, length = draw(_SIZE), draw(_SIZE), draw(_SIZE)
    kind = draw(st.integers(0, 5))
    if kind == 0:
        return box(a, b, length)
    if kind == 1:
        return tube(a, draw(st.floats(0.1, 1.0)) * a / 2, length)
    if kind == 2:
        return stepped((a, length), (b, length / 2), (a / 2, b))
    if kind == 3:
        link = strip(np.array([0, a, a + b * np.exp(1j * draw(st.floats(-1.5, 1.5)))]), 0.2 * min(a, b))
        return Prism(Profile(link, (circle(0j, 0.1 * min(a, b)), circle(complex(a), 0.05 * min(a, b)))), length)
    if kind == 4:
        return Prism(disc(a, keyed_bore(0.4 * a, 0.2 * a, 0.1 * a)), length)
    return Sum((Placed(box(a, b, length), (draw(_placements()), draw(_placements()))), Placed(bar(a, b))))


def _of_mesh(solid: Solid) -> Moments:
    """Moments of a closed surface: of the tetrahedra of its triangles and the origin [Tonon 2004]."""
    corners = solid.points[solid.triangles]
    sixth = np.linalg.det(corners) / 6
    sums = corners.sum(axis=1)
    second = np.einsum("t,tci,tcj->ij", sixth, corners, corners) + np.einsum("t,ti,tj->ij", sixth, sums, sums)
    return Moments(float(sixth.sum()), sixth @ sums / 4, second / 20)


def _near(own: Moments, other: Moments, share: float) -> None:
    scale = np.trace(own.second)
    assert other.zeroth == pytest.approx(own.zeroth, rel=share)
    assert np.abs(other.first - own.first).max() <= share * math.sqrt(own.zeroth * scale)
    assert np.abs(other.second - own.second).max() <= share * scale


@given(_shapes())
def test_the_exact_moments_are_those_of_the_mesh(shape: Shape) -> None:
    solid = shape.mesh(1e-6)
    assert is_closed(solid)
    assert volume(solid) > 0
    _near(shape.moments, _of_mesh(solid), 1e-3)


@given(_shapes(), _placements())
def test_moments_move_as_the_body_does(shape: Shape, position: Placement) -> None:
    moved = shape.moments.placed(position)
    back = moved.placed(position.inverse)
    _near(shape.moments, back, 1e-9)
    assert np.linalg.eigvalsh(moved.inertia) == pytest.approx(np.linalg.eigvalsh(shape.moments.inertia), rel=1e-6)
    mesh = shape.mesh(1e-4)
    _near(_of_mesh(mesh).placed(position), _of_mesh(Solid(position.points(mesh.points), mesh.triangles)), 1e-9)


@given(_placements(), _placements())
def test_places_follow_one_another(outer: Placement, inner: Placement) -> None:
    points = np.array([[0.0, 0.0, 0.0], [1.0, 2.0, 3.0]])
    assert outer.after(inner).points(points) == pytest.approx(outer.points(inner.points(points)), abs=1e-12)
    assert outer.inverse.points(outer.points(points)) == pytest.approx(points, abs=1e-12)


@pytest.mark.parametrize("position", [IN_SIDE_VIEW, ALONG_WIDTH, UPRIGHT])
def test_the_named_places_are_rotations(position: Placement) -> None:
    assert np.linalg.det(position.rotation) == pytest.approx(1.0)


@given(_SIZE, _SIZE)
def test_a_cylinder_has_the_moments_of_the_textbook(diameter: float, length: float) -> None:
    own, radius = bar(diameter, length).moments, diameter / 2
    mass = math.pi * radius**2 * length
    across = mass * (3 * radius**2 + length**2) / 12
    assert own.zeroth == pytest.approx(mass, rel=1e-12)
    assert own.centre == pytest.approx([0, 0, length / 2], abs=1e-12)
    assert own.inertia == pytest.approx(np.diag([across, across, mass * radius**2 / 2]), rel=1e-9, abs=1e-12)


def test_a_torus_has_the_volume_of_pappus() -> None:
    ring = Turned(Profile(circle(0.5j, 0.1)))
    assert ring.moments.zeroth == pytest.approx(2 * math.pi**2 * 0.5 * 0.1**2, rel=1e-13)
    assert ring.moments.inertia[2, 2] == pytest.approx(ring.moments.zeroth * (0.5**2 + 0.75 * 0.1**2), rel=1e-12)


@given(_shapes(), st.integers(0, 2**32 - 1))
def test_the_convex_pieces_contain_the_shape(shape: Shape, seed: int) -> None:
    """Each point of the mesh lies in a convex piece: it is a combination of its corners."""
    pieces = shape.pieces(1e-3)
    points = shape.mesh(1e-3).points
    for point in points[np.random.default_rng(seed).integers(0, len(points), 4)]:
        assert min(_outside(piece, point) for piece in pieces) <= 1e-9


def _outside(piece: np.ndarray, point: np.ndarray) -> float:
    """How far a point is outside of the convex hull of a piece, at most, in 200 directions and along its faces."""
    directions = np.random.default_rng(1).normal(size=(200, 3))
    directions = np.concatenate([directions, np.eye(3), -np.eye(3)])
    directions /= np.linalg.norm(directions, axis=1)[:, None]
    return float(np.max(directions @ point - (directions @ piece.T).max(axis=1)))


@given(_SIZE, st.floats(0.05, 0.45))
def test_a_square_tube_weighs_what_its_walls_do(side: float, share: float) -> None:
    wall = share * side
    assert square_tube(side, wall, 2.0).moments.zeroth == pytest.approx(2.0 * 4 * wall * (side - wall), rel=1e-12)


@given(st.floats(0.2, 2.0), st.floats(0.2, 2.0), st.floats(-2.0, 2.0))
def test_a_strip_is_all_that_is_near_its_line(first: float, second: float, turned: float) -> None:
    """The area of a strip by counting points near the line, its inner corner sharp: at most a sliver of r² more."""
    nodes = np.array([0, first, first + second * np.exp(1j * turned)])
    radius = 0.08
    grid = np.linspace(-2.2, 4.2, 640)
    z = grid[:, None] + 1j * grid
    distance = np.minimum(*(_to_segment(z, *pair) for pair in pairwise(nodes)))
    counted = np.count_nonzero(distance <= radius) * (grid[1] - grid[0]) ** 2
    own = Profile(strip(nodes, radius)).area
    assert counted == pytest.approx(own, rel=0.03, abs=radius**2 * math.tan(abs(turned) / 2))


def _to_segment(z: np.ndarray, start: complex, end: complex) -> np.ndarray:
    along = np.clip(((z - start) * np.conj(end - start)).real / abs(end - start) ** 2, 0.0, 1.0)
    return np.asarray(np.abs(z - start - along * (end - start)))


def test_a_hull_and_a_strip_of_two_nodes_are_one() -> None:
    nodes = np.array([0j, 0.3 + 0.1j])
    assert Profile(strip(nodes, 0.02)).area == pytest.approx(Profile(rounded_hull(nodes, 0.02)).area, rel=1e-12)
    assert Profile(polygon(np.array([0, 1, 1 + 1j, 1j]))).moment(1, 1) == pytest.approx(0.25)
