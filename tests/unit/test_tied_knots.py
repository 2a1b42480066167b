"""Which knot a motion ties: every knot and its mirror image, near misses, and what is refused."""

import itertools

import numpy as np
import pytest

from ilmek.errors import CarpetError
from ilmek.units import mm
from ilmek.weaving.knots.crossings import WarpRow, arc_lengths, crossings, orientation, row_of_warps
from ilmek.weaving.knots.path import KnotDimensions, knot_path
from ilmek.weaving.knots.proof import TiedKnot, joined_ends, knot_of_curve, tied_knot
from ilmek.weaving.knots.word import SINGLE, Knot, inverse, knot, mirrored, recognised, reduced, verdict, word_text

PITCH = 4 * mm
SIZE = KnotDimensions(PITCH, 1.2 * mm, 0.8 * mm, 0.2 * mm, leg=6 * mm)
WARPS = row_of_warps(13, PITCH)
KEEP_OUT = 1.0 * mm
"""Half a warp and half the yarn; the curves keep 1.2 mm."""

ALL = [
    knot("symmetric", 6),
    knot("asymmetric", 6, opens="left"),
    knot("asymmetric", 6, opens="right"),
    knot("symmetric", 5, each=2),
    knot("asymmetric", 5, opens="left", each=2),
    knot("asymmetric", 5, opens="right", each=2),
    knot(SINGLE, 7),
    Knot("symmetric", (6, 7), (8,)),
    Knot("asymmetric", (6,), (7, 8), "left"),
    Knot("asymmetric", (6,), (7, 8), "right"),
]


def path(*corners: tuple[float, float]) -> np.ndarray:
    """A polyline whose abscissae are in pitches, warp k at k, its ordinates in millimetres."""
    x, y = np.array(corners, float).T
    return np.asarray((x - 1) * PITCH + 1j * y * mm)


def tied(*corners: tuple[float, float]) -> TiedKnot:
    return tied_knot(path(*corners), WARPS, keep_out=0.6 * mm)


@pytest.mark.parametrize("known", ALL, ids=lambda known: known.name)
def test_every_knot_s_curve_ties_that_knot_and_no_other(known: Knot) -> None:
    curve = knot_path(known, SIZE)
    points = curve.point(curve.distances(0.1 * mm))
    forward = tied_knot(points, WARPS, keep_out=KEEP_OUT, lengths=arc_lengths(points))
    assert forward == TiedKnot(known, known.word, False, known.name)
    exact = knot_of_curve(lambda u: curve.point(u * curve.length), curve.length, WARPS, keep_out=KEEP_OUT)
    assert exact == forward
    backward = tied_knot(points[::-1], WARPS, keep_out=KEEP_OUT, lengths=arc_lengths(points)[::-1])
    assert backward == TiedKnot(known, inverse(known.word), True, known.name)


@pytest.mark.parametrize("known", ALL, ids=lambda known: known.name)
def test_mirror_images_tie_the_mirrored_knot(known: Knot) -> None:
    curve = knot_path(known, SIZE)
    points = curve.point(curve.distances(0.1 * mm))
    image = tied_knot(2 * curve.warps.mean().real - np.conj(points), WARPS, keep_out=KEEP_OUT)
    assert image.knot == mirrored(known)
    assert mirrored(mirrored(known)) == known


def test_thesis_knot_by_two_mirrored_grippers() -> None:
    """Two arms take the yarn in front of the middle and lead an end each round the outside and up between the warps."""
    left = path((6.5, 3), (5.5, 2), (5.5, -2), (6.4, -2), (6.4, 6))
    right = 2 * (5.5 * PITCH) - np.conj(left)
    assert tied_knot(joined_ends(left, right), WARPS, keep_out=0.6 * mm).words == "symmetric knot over warps 6 and 7"
    with pytest.raises(CarpetError, match=r"4 mm apart.*one position"):
        joined_ends(left, right + PITCH)


def test_catalogue_is_the_whole_of_what_is_recognised() -> None:
    """All reduced words of up to four letters on four warps: the ten kinds of knot, both ways, and nothing else."""
    letters = [sign * warp for warp in range(1, 5) for sign in (1, -1)]
    words = {reduced(word) for n in range(5) for word in itertools.product(letters, repeat=n)}
    groups = [((1,), (2,)), ((2,), (3,)), ((3,), (4,)), ((1,), (2, 3)), ((1, 2), (3,)), ((2,), (3, 4)), ((2, 3), (4,))]
    groups += [((1,), (2, 3, 4)), ((1, 2, 3), (4,)), ((1, 2), (3, 4))]
    known = [Knot("symmetric", *pair) for pair in groups]
    known += [Knot("asymmetric", *pair, side) for pair in groups for side in ("left", "right")]
    known += [Knot(SINGLE, (warp,), ()) for warp in range(1, 5)]
    expected = {word: one for one in known for word in (one.word, inverse(one.word))}
    assert len(expected) == 2 * len(known)
    assert {word: recognised(word) for word in words if recognised(word)} == expected


@pytest.mark.parametrize(
    ("corners", "words"),
    [
        (((6.5, 6), (6.5, -2), (6.5, 6)), "no knot: pulled, the yarn comes away from every warp"),
        (((6.5, 6), (5.5, 2), (5.5, 6)), "no knot: pulled, the yarn comes away from every warp"),
        (((5.5, 6), (5.5, -2), (7.5, -2), (7.5, 6)), "no knot: the yarn only passes behind warps 6 and 7 from left"),
        (  # symmetric, but the right end misses warp 7
            ((6.5, 6), (6.5, -2), (5.5, -2), (5.5, 2), (6.6, 2), (6.6, -2), (6.6, 6)),
            "no knot: the yarn only passes behind warp 6 from right to left",
        ),
        (  # symmetric round 6 and 8: warp 7 is left out
            ((6.5, 6), (6.5, -2), (5.5, -2), (5.5, 2), (8.5, 2), (8.5, -2), (7.5, -2), (7.5, 6)),
            "no knot: the yarn passes behind warp 6 from right to left, behind warp 8 from right to left",
        ),
        (  # the left warp wound once too often
            (
                *((6.5, 6), (6.5, -2), (5.5, -2), (5.5, 2), (6.5, 2), (6.5, -2), (5.5, -2), (5.5, 2)),
                *((7.5, 2), (7.5, -2), (6.6, -2), (6.6, 6)),
            ),
            "no knot: but for a turn too many round warp 6, a symmetric knot over warps 6 and 7",
        ),
        (  # both the wrong way round: one sweep behind both
            ((6.5, 6), (6.5, 2), (5.5, 2), (5.5, -2), (6.5, -2), (6.5, 2), (6.5, -2), (7.5, -2), (7.5, 2), (6.5, 6)),
            "no knot: the yarn only passes behind warps 6 and 7 from left to right",
        ),
    ],
)
def test_near_misses_tie_none_and_say_why(corners: tuple[tuple[float, float], ...], words: str) -> None:
    result = tied(*corners)
    assert result.knot is None
    assert result.words.startswith(words)


def test_symmetric_knot_with_one_warp_wound_the_wrong_way_is_the_asymmetric_one() -> None:
    wrong = tied((6.5, 6), (6.5, 2), (5.5, 2), (5.5, -2), (6.5, -2), (6.5, 2), (7.5, 2), (7.5, -2), (6.6, -2), (6.6, 6))
    assert wrong.knot == knot("asymmetric", 6, opens="left")


def test_jufti_wound_twice_and_jufti_with_a_warp_missed() -> None:
    twice = (-6, -5, -6, -5, -8, -7)
    assert verdict(twice).startswith("no knot: but for a turn too many round warps 5 and 6, a jufti symmetric knot")
    assert recognised((-6, -8, -7)) == Knot("symmetric", (6,), (7, 8))
    assert verdict((-6, -8, -7)) == "uneven jufti symmetric knot over warps 6, 7 and 8"


def test_an_end_left_behind_the_warps_ties_none() -> None:
    assert "ends 2 mm behind the front" in tied((6.5, 6), (6.5, -2), (5.5, -2), (5.5, 2), (7.5, 2), (7.5, -2)).words
    assert "begins 2 mm behind the front" in tied((6.5, -2), (6.5, 6)).words


def test_closed_motion_comes_back_to_its_start() -> None:
    corners = path((6.5, 6), (6.5, -2), (5.5, -2), (5.5, 2), (7.5, 2), (7.5, -2), (6.5, -2))
    assert tied_knot(corners, WARPS, closed=True).knot == knot("symmetric", 6)
    assert tied_knot(corners, WARPS).knot is None


@pytest.mark.parametrize("pile", [1j, -1j, 1.0, -2.0, 1 + 1j])
def test_pile_on_any_side(pile: complex) -> None:
    curve = knot_path(knot("asymmetric", 4), SIZE)
    turn = pile / abs(pile) / 1j
    points = curve.point(curve.distances(0.1 * mm)) * turn
    assert tied_knot(points, WARPS * turn, keep_out=KEEP_OUT, pile=pile).knot == curve.knot


def test_warps_out_of_line_as_in_an_open_shed() -> None:
    shed = WARPS + 1j * np.where(np.arange(13) % 2, 1.5 * mm, 0.0)
    corners = path((6.5, 6), (6.5, -3), (5.5, -3), (5.5, 4), (7.5, 4), (7.5, -3), (6.5, -3), (6.5, 6))
    assert tied_knot(corners, shed, keep_out=0.6 * mm).knot == knot("symmetric", 6)


def test_touching_a_warp_is_an_error_that_names_it() -> None:
    with pytest.raises(CarpetError, match=r"touches warp 7: at point 1 it comes within 0\.4 mm.*0\.6 mm or more"):
        tied((6.5, 6), (7.1, 0), (7.5, -2), (7.5, 6))
    with pytest.raises(CarpetError, match="touches warp 6"):
        tied((5.5, 6), (5.5, -2), (6.05, -2), (6.05, 6))
    with pytest.raises(CarpetError, match="warp 3"):
        tied_knot(path((3, 5), (3, -5)), WARPS)
    with pytest.raises(CarpetError, match="warp 3"):
        tied_knot(path((2.5, 5), (3.5, -5)), WARPS)
    curve = knot_path(knot("symmetric", 6), SIZE)
    with pytest.raises(CarpetError, match="warp 6"):
        knot_of_curve(lambda u: curve.point(u * curve.length), curve.length, WARPS, keep_out=1.3 * mm)
    with pytest.raises(CarpetError, match="warp 7"):  # the axis itself grazes the room: no sampling can tell
        knot_of_curve(lambda u: curve.point(u * curve.length), curve.length, WARPS, keep_out=1.2 * mm)


def test_samples_too_coarse_are_refused_and_fine_ones_are_not() -> None:
    curve = knot_path(knot("symmetric", 6), SIZE)
    coarse = curve.point(np.linspace(0.0, curve.length, 12))
    with pytest.raises(CarpetError, match=r"too coarse near warp .*sample it more finely"):
        tied_knot(coarse, WARPS, keep_out=0.4 * mm, lengths=np.full(11, curve.length / 11))
    fine = curve.point(np.linspace(0.0, curve.length, 121))
    known = tied_knot(fine, WARPS, keep_out=0.4 * mm, lengths=np.full(120, curve.length / 120))
    assert known.knot == curve.knot


def test_a_loop_round_a_warp_that_the_samples_miss_is_not_missed() -> None:
    """Three samples see a dip between two warps; the length of the path between them tells that they do not know."""
    points = path((5.5, 6), (5.6, 2), (5.7, 6))
    assert tied_knot(points, WARPS).word == ()
    with pytest.raises(CarpetError, match="too coarse near warp"):
        tied_knot(points, WARPS, lengths=np.full(2, 20 * mm))
    with pytest.raises(CarpetError, match=r"4\.02 mm apart.*stated to be 1 mm long"):
        tied_knot(points, WARPS, lengths=np.full(2, 1 * mm))


def test_arc_lengths_are_exact_on_a_circle_and_on_a_line() -> None:
    circle = 3.0 * np.exp(1j * np.arange(8) * 0.7)
    np.testing.assert_allclose(arc_lengths(circle), 2.1, rtol=1e-14)
    np.testing.assert_allclose(arc_lengths(np.array([0j, 1j, 1j, 3j])), [1.0, 0.0, 2.0])
    np.testing.assert_allclose(arc_lengths(np.array([0j, 0j])), [0.0])


def test_crossings_are_counted_once_where_a_corner_lies_on_a_cut() -> None:
    row = WarpRow(np.array([0j]))
    assert crossings(row, np.array([-1 - 1j, 0 - 1j, 1 - 1j])) == (1,)
    assert crossings(row, np.array([-1 - 1j, 0 - 1j, 0 - 2j, -1 - 2j])) == ()
    assert crossings(row, np.array([1 - 1j, 0 - 1j, 0 - 2j, 1 - 2j])) == (-1, 1)
    assert crossings(row, np.array([-1 + 1j, 0 + 1j, 1 + 1j])) == ()


def test_side_of_a_warp_is_decided_exactly() -> None:
    """0.1, 0.2 and 0.3 are no decimals to a computer: the warp lies beside the line by less than rounding."""
    start, end, place = np.array([0j]), np.array([0.3 + 0.3j]), complex(0.1, 0.1)
    assert orientation(start, end, place)[0] == 0
    above, below = complex(0.1, np.nextafter(0.1, 1)), complex(0.1, np.nextafter(0.1, 0))
    assert (orientation(start, end, above)[0], orientation(start, end, below)[0]) == (1, -1)
    far = np.array([12.0 + 12.0j]), np.array([24.0 + 24.0j])
    hair = complex(0.5, 0.5 + 2.0**-53)
    assert orientation(*far, hair)[0] == 1
    assert orientation(far[1], far[0], hair)[0] == -1
    assert crossings(WarpRow(np.array([above])), np.array([0j, 0.3 + 0.3j])) == (1,)
    assert crossings(WarpRow(np.array([below])), np.array([0j, 0.3 + 0.3j])) == ()


@pytest.mark.parametrize(
    ("points", "warps", "said"),
    [
        (path((6.5, 6)), WARPS, "1 point"),
        (np.array([0j, complex("nan")]), WARPS, "point 1 of the path is no number"),
        (path((6.5, 6), (6.5, 7)), WARPS[::-1], "warp 2 does not lie to the right of warp 1"),
        (path((6.5, 6), (6.5, 7)), WARPS[:0], "0 warps"),
        (path((6.5, 6), (6.5, 7)), np.array([0j, complex("inf")]), "not numbers"),
    ],
)
def test_bad_input_is_refused_in_words(points: np.ndarray, warps: np.ndarray, said: str) -> None:
    with pytest.raises(CarpetError, match=said):
        tied_knot(points, warps)


def test_bad_rooms_piles_and_knots_are_refused_in_words() -> None:
    with pytest.raises(CarpetError, match="0 or more"):
        WarpRow(WARPS, -1.0)
    with pytest.raises(CarpetError, match="direction"):
        tied_knot(path((6.5, 6), (6.5, 7)), WARPS, pile=0)
    for bad in (("granny", (1,), (2,)), ("symmetric", (1,), (2,), "left"), ("asymmetric", (1,), (2,))):
        with pytest.raises(CarpetError, match="allowed|symmetric"):
            Knot(*bad)
    for left, right in (((1,), (3,)), ((2,), (1,)), ((0,), (1,)), ((1,), ()), ((), (1,))):
        with pytest.raises(CarpetError, match=r"neighbouring|one or more on each side"):
            Knot("symmetric", left, right)
    with pytest.raises(CarpetError, match="0 warps on each side"):
        knot("symmetric", each=0)
    with pytest.raises(CarpetError, match="did you mean symmetric"):
        knot("symetric")


def test_words_are_told_as_the_yarn_goes() -> None:
    assert word_text((3, 4, -5)) == "behind warps 3 and 4 from left to right, behind warp 5 from right to left"
