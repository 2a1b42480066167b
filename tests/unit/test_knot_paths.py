"""Knots as curves: length in closed form, one tangent throughout, room kept from the warps, refusals."""

import numpy as np
import pytest
from examples.draw_knots import knot_drawing

from ilmek.carpet.pile import PileParams, knot_length, leg_length
from ilmek.carpet.quality import Quality
from ilmek.elements.carpet_yarns import usual_warp
from ilmek.elements.yarns import WOOL
from ilmek.errors import CarpetError
from ilmek.units import mm
from ilmek.weaving.knots.path import KnotDimensions, KnotPath, knot_path
from ilmek.weaving.knots.word import SINGLE, Knot, knot, mirrored

DIMENSIONS = KnotDimensions(4 * mm, 1.2 * mm, 0.8 * mm, 0.2 * mm, leg=7 * mm)
TOUCHING = KnotDimensions(2 * mm, 1.2 * mm, 0.8 * mm, leg=3 * mm)
KNOTS = [
    knot("symmetric"),
    knot("asymmetric"),
    knot("asymmetric", 3, opens="right"),
    knot("symmetric", 2, each=2),
    knot("asymmetric", each=2),
    knot("asymmetric", 5, opens="right", each=2),
    knot(SINGLE, 4),
    Knot("symmetric", (1,), (2, 3)),
    Knot("asymmetric", (2, 3), (4,), "right"),
]
PATHS = [knot_path(known, size) for known in KNOTS for size in (DIMENSIONS, TOUCHING)]


@pytest.fixture(params=PATHS, ids=lambda path: f"{path.knot.name}-{path.dimensions.pitch * 1e3:g}")
def path(request: pytest.FixtureRequest) -> KnotPath:
    made: KnotPath = request.param
    return made


def test_closed_length_is_that_of_the_pieces_and_of_the_samples(path: KnotPath) -> None:
    assert path.lengths.sum() == pytest.approx(path.length, rel=1e-14)
    chords = np.abs(np.diff(path.point(path.distances(path.length / 20_000))))
    assert chords.sum() == pytest.approx(path.length, rel=1e-6)


def test_pieces_meet_with_one_tangent(path: KnotPath) -> None:
    half = path.curvatures * path.lengths / 2
    ends = path.starts + path.lengths * np.sinc(half / np.pi) * np.exp(1j * (path.headings + half))
    turned = np.exp(1j * (path.headings + 2 * half))
    np.testing.assert_allclose(ends[:-1], path.starts[1:], rtol=0, atol=1e-16)
    np.testing.assert_allclose(turned[:-1], np.exp(1j * path.headings[1:]), rtol=0, atol=1e-14)


def test_both_ends_rise_upright_from_the_warps_to_the_leg_s_height(path: KnotPath) -> None:
    begin, end = path.point(np.array([0.0, path.length]))
    assert begin.imag == pytest.approx(path.dimensions.leg)
    assert end.imag == pytest.approx(path.dimensions.leg)
    np.testing.assert_allclose(path.direction(np.array([0.0, path.length])), [-1j, 1j], rtol=0, atol=1e-14)
    np.testing.assert_allclose(path.point(np.array([path.length - path.dimensions.leg])).imag, 0.0, rtol=0, atol=1e-16)


def test_direction_and_curvature_are_the_derivatives(path: KnotPath) -> None:
    s, step = np.linspace(1e-5, path.length - 1e-5, 997), 1e-7
    tangent = (path.point(s + step) - path.point(s - step)) / (2 * step)
    np.testing.assert_allclose(path.direction(s), tangent, rtol=0, atol=2e-4)
    turning = np.angle(path.direction(s + step) / path.direction(s - step)) / (2 * step)
    smooth = path.curvature(s + step) == path.curvature(s - step)
    np.testing.assert_allclose(path.curvature(s)[smooth], turning[smooth], rtol=1e-6, atol=1e-5)


def test_keeps_its_radius_from_every_warp_of_the_row(path: KnotPath) -> None:
    points = path.point(path.distances(path.length / 5000))
    row = np.arange(-2, 12) * path.dimensions.pitch
    gaps = np.abs(points[:, None] - row).min(axis=0)
    assert gaps.min() == pytest.approx(path.dimensions.radius, rel=1e-9)
    own = np.abs(points[:, None] - path.warps).min(axis=0)
    np.testing.assert_allclose(own, path.dimensions.radius, rtol=1e-4)


@pytest.mark.parametrize("known", KNOTS, ids=lambda known: known.name)
def test_mirror_image_of_the_knot_is_the_mirror_image_of_its_curve(known: Knot) -> None:
    curve, image = knot_path(known, DIMENSIONS), knot_path(mirrored(known), DIMENSIONS)
    s = curve.distances(0.1 * mm)
    middle = curve.warps.mean().real
    reflected = 2 * middle - np.conj(curve.point(s))
    same_way = known.kind == "asymmetric"
    np.testing.assert_allclose(image.point(s if same_way else curve.length - s), reflected, rtol=0, atol=1e-15)


@pytest.mark.parametrize("kind", ["symmetric", "asymmetric"])
def test_curve_is_as_long_as_the_yarn_that_is_bought(kind: str) -> None:
    """The path and `knot_length` are one geometry: the same knot in the same carpet takes the same yarn."""
    quality, density, pile = Quality(150.0, 150.0), 0.3e-3, PileParams()
    warp, yarn = usual_warp(quality.warp_pitch).diameter, WOOL.diameter(density)
    size = KnotDimensions(quality.warp_pitch, warp, yarn, leg=leg_length(warp, yarn, pile))
    assert knot_path(knot(kind), size).length == pytest.approx(knot_length(kind, quality, density, pile), rel=1e-14)


def test_jufti_takes_less_yarn_than_two_knots_and_more_than_one() -> None:
    for kind in ("symmetric", "asymmetric"):
        plain, wide = (knot_path(knot(kind, each=each), DIMENSIONS).length for each in (1, 2))
        assert plain < wide < 2 * plain


@pytest.mark.parametrize(
    ("numbers", "said"),
    [
        ((1.9 * mm, 1.2 * mm, 0.8 * mm), "pitch of 2 mm or more"),
        ((4 * mm, 1.2 * mm, 0.8 * mm, 1.1 * mm), "pitch of 4.2 mm or more"),
        ((0.0, 1.2 * mm, 0.8 * mm), "pitch .* more than 0"),
        ((4 * mm, -1.2 * mm, 0.8 * mm), "warp diameter"),
        ((4 * mm, 1.2 * mm, float("nan")), "yarn diameter"),
        ((4 * mm, 1.2 * mm, 0.8 * mm, -0.1 * mm), "clearance .* 0 or more"),
        ((4 * mm, 1.2 * mm, 0.8 * mm, 0.0, 0.0), "leg"),
    ],
)
def test_dimensions_that_leave_no_room_are_refused(numbers: tuple[float, ...], said: str) -> None:
    with pytest.raises(CarpetError, match=said):
        KnotDimensions(*numbers)


def test_steps_of_nothing_are_refused() -> None:
    with pytest.raises(CarpetError, match="more than 0"):
        PATHS[0].distances(0.0)


def test_drawing_shows_the_warps_with_a_neighbour_on_each_side_and_the_whole_yarn() -> None:
    curve = knot_path(knot("symmetric", 3), DIMENSIONS)
    drawing = knot_drawing(curve, cuts=True)
    assert [stroke.role for stroke in drawing.strokes].count("outline") == 4
    assert [stroke.label for stroke in drawing.strokes if stroke.role == "construction"] == ["2", "3", "4", "5"]
    (yarn,) = (stroke for stroke in drawing.strokes if stroke.role == "yarn")
    assert np.abs(np.diff(yarn.points)).sum() == pytest.approx(curve.length, rel=1e-4)
    assert drawing.title == "symmetric knot over warps 3 and 4"
    assert [dot.label for dot in knot_drawing(curve).dots] == ["2", "3", "4", "5", "begins", "ends"]
