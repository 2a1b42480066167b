"""Links through three to five poses: planted four-bars are found, every link keeps its length, none is missing."""

import numpy as np
import pytest
from effort import examples
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from scipy.optimize import fsolve

from ilmek.errors import ParameterError
from ilmek.linkage.solve import solve
from ilmek.linkage.structure import plan
from ilmek.synthesis.burmester.curve import burmester_curve
from ilmek.synthesis.burmester.links import (
    Guide,
    GuideKind,
    arms_of_pins,
    arms_of_pivots,
    arms_through_five_poses,
    four_bars,
)
from ilmek.synthesis.candidate import judge
from ilmek.synthesis.four_bar import FourBar, LinkLengths, from_lengths
from ilmek.synthesis.task import PrecisionTask
from ilmek.units import deg, mm

EXACT = 1e-10

lengths = st.floats(0.4, 2.0)


@st.composite
def planted(draw: st.DrawFn, count: int) -> tuple[FourBar, np.ndarray, np.ndarray]:
    """A four-bar, and points and angles of its coupler at well separated crank angles on one branch."""
    ground, crank, coupler, rocker = 1.0, draw(lengths), draw(lengths), draw(lengths)
    cranks = draw(st.floats(0, 6)) + np.cumsum([draw(st.floats(0.25, 0.9)) for _ in range(count)])
    reach = np.abs(ground - crank * np.exp(1j * cranks))
    assume(np.all(reach > abs(coupler - rocker) + 0.1) and np.all(reach < coupler + rocker - 0.1))
    tracer = complex(draw(st.floats(-1, 1)), draw(st.floats(-1, 1)))
    pin = crank * np.exp(1j * cranks)
    across = ground - pin
    along = 0.5 + 0.5 * (coupler**2 - rocker**2) / np.abs(across) ** 2
    end = pin + (along + 1j * np.sqrt((coupler / np.abs(across)) ** 2 - along**2)) * across
    assume(np.min(np.abs(np.diff(end))) > 0.05)
    angles = np.angle(end - pin)
    assume(np.ptp(angles) > 0.2)
    points = pin + tracer * np.exp(1j * angles)
    return FourBar(0j, complex(ground), complex(pin[0]), complex(end[0]), complex(points[0])), points, angles


def spread(guide: Guide, points: np.ndarray, angles: np.ndarray) -> float:
    """How much a guide's length changes over the poses, in sizes of task and guide."""
    size = max(float(np.ptp(np.abs(points - points[0]))), abs(guide.pivot), abs(guide.pin))
    return float(np.ptp(guide.reach(points, angles))) / size


@examples(60)
@given(planted(5))
def test_both_cranks_of_a_four_bar_are_among_the_links_of_five_of_its_poses(task) -> None:
    drawn, points, angles = task
    found = arms_through_five_poses(points, angles)
    assert len(found) in {2, 3, 4}
    for guide in found:
        assert spread(guide, points, angles) < EXACT
    for pivot, pin in ((drawn.a0, drawn.a), (drawn.b0, drawn.b)):
        assert min(abs(one.pivot - pivot) + abs(one.pin - pin) for one in found) < 1e-5
    pairs = four_bars(found, drawn.tracer)
    assert len(pairs) == len(found) * (len(found) - 1) // 2


def test_five_poses_have_no_link_that_newton_s_method_finds_and_this_does_not() -> None:
    random = np.random.default_rng(8)
    seen = 0
    for _ in range(4):
        points, angles = random.normal(size=5) + 1j * random.normal(size=5), random.uniform(-1.5, 1.5, size=5)
        found = arms_through_five_poses(points, angles)

        def change(x: np.ndarray, points: np.ndarray = points, angles: np.ndarray = angles) -> np.ndarray:
            reach = Guide(GuideKind.CRANK, complex(x[0], x[1]), complex(x[2], x[3])).reach(points, angles)
            return reach[1:] ** 2 - reach[0] ** 2

        for _ in range(60):
            x, _, met, _ = fsolve(change, random.normal(size=4) * 3, full_output=True)
            if met == 1 and np.max(np.abs(change(x))) < 1e-9 and np.max(np.abs(x)) < 100:
                seen += 1
                assert min(abs(one.pivot - complex(x[0], x[1])) for one in found) < 1e-5 * max(1, np.max(np.abs(x)))
    assert seen > 50


def test_random_poses_have_none_two_or_four_links() -> None:
    random = np.random.default_rng(4)
    counted = [
        len(arms_through_five_poses(random.normal(size=5) + 1j * random.normal(size=5), random.uniform(-3, 3, 5)))
        for _ in range(150)
    ]
    assert set(counted) == {0, 2, 4}


def test_a_four_bar_of_five_poses_takes_them_all_when_it_is_moved() -> None:
    drawn = from_lengths(LinkLengths(1.0, 0.4, 1.1, 0.9), 0.4, branch=+1, tracer=0.5 + 0.3j)
    motion = solve(plan(drawn.mechanism()), 0.4 + np.array([0, 0.8, 1.7, 2.9, 4.4]))
    points, angles = np.asarray(motion.point("coupler", "P").position), np.asarray(motion.angle("coupler"))
    judged = [
        judge(one.four_bar, PrecisionTask(points=points, coupler=angles))
        for one in four_bars(arms_through_five_poses(points, angles), complex(points[0]))
        if one.four_bar is not None
    ]
    # Some of the pairs have to be taken apart on the way; whatever is reached is met.
    assert any(one.met and one.one_branch for one in judged)
    assert all(error < 1e-6 for one in judged for error in [m.point_error for m in one.positions if m.reached])


def slider_crank(turns: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Points and angles of a rod of 3 whose end slides on y = 0.5."""
    pin = np.exp(1j * turns)
    end = np.sqrt(9 - (pin.imag - 0.5) ** 2) + pin.real + 0.5j
    angles = np.angle(end - pin)
    return pin + (0.7 + 0.9j) * np.exp(1j * angles), angles


TURNS = np.array([0.1, 0.6, 1.1, 1.7, 2.4])


def test_a_slider_is_a_link_with_its_pivot_infinitely_far() -> None:
    points, angles = slider_crank(TURNS)
    found = arms_through_five_poses(points, angles)
    slider = next(one for one in found if one.kind is GuideKind.SLIDER)
    assert np.sin(slider.line) == pytest.approx(0, abs=1e-9)
    np.testing.assert_allclose(slider.pins(points, angles).imag, 0.5, atol=1e-10)
    assert slider.length == np.inf
    with_slider = [one for one in four_bars(found) if slider in (one.one, one.other)]
    assert with_slider
    assert all(one.four_bar is None and "straight line" in one.description for one in with_slider)


def test_a_turning_block_is_a_link_with_its_pin_infinitely_far() -> None:
    pin = np.exp(1j * TURNS)
    angles = np.angle(3 - pin)
    points = pin + (0.7 + 0.9j) * np.exp(1j * angles)
    block = next(one for one in arms_through_five_poses(points, angles) if one.kind is GuideKind.BLOCK)
    assert block.pivot == pytest.approx(3)
    assert np.sin(block.line - angles[0]) == pytest.approx(0, abs=1e-9)
    assert spread(block, points, angles) < EXACT


def test_a_body_with_two_angles_has_a_link_with_both_ends_infinitely_far() -> None:
    points = np.array([0, 1 + 0.3j, 0.2 + 1.1j, -0.4 + 0.9j, 0.8 - 0.6j])
    angles = np.array([0.0, 0.0, 0.7, 0.7, 0.7])
    found = arms_through_five_poses(points, angles)
    assert GuideKind.ANGLE in {one.kind for one in found}
    assert all(spread(one, points, angles) < EXACT for one in found)


@settings(max_examples=25)
@given(planted(4))
def test_both_cranks_of_a_four_bar_lie_on_the_curves_of_four_of_its_poses(task) -> None:
    drawn, points, angles = task
    curve = burmester_curve(points, angles, 400)
    for guide in curve.guides()[::7]:
        assert spread(guide, points, angles) < EXACT
    for branches, places in (
        (curve.centre_branches, (drawn.a0, drawn.b0)),
        (curve.circle_branches, (drawn.a, drawn.b)),
    ):
        for place in places:
            nearest = min(distance(branch.points, branch.closed, place) for branch in branches)
            assert nearest < 0.05 * max(1, abs(place))


def distance(places: np.ndarray, closed: bool, place: complex) -> float:
    """From a place to a polyline."""
    if closed:
        places = np.append(places, places[0])
    if len(places) < 2:
        return float(np.min(np.abs(places - place)))
    along = np.diff(places)
    share = ((place - places[:-1]) * np.conj(along)).real / np.maximum(np.abs(along) ** 2, 1e-300)
    return float(np.min(np.abs(places[:-1] + np.clip(share, 0, 1) * along - place)))


def four_poses() -> tuple[np.ndarray, np.ndarray]:
    points, angles = slider_crank(TURNS)
    return points[:4] + np.array([0, 0.1j, 0.05, -0.1]), angles[:4]


def test_the_curves_go_through_the_poles_of_their_poses_and_infinity_along_the_asymptote() -> None:
    points, angles = four_poses()
    curve = burmester_curve(points, angles, 2000)
    for i in range(4):
        for j in range(i):
            turned = np.exp(1j * (angles[i] - angles[j]))
            pole = (points[i] - turned * points[j]) / (1 - turned)
            gap = min(distance(branch.points, branch.closed, pole) for branch in curve.centre_branches)
            assert gap < 2e-3 * max(1, abs(pole))
    for branches, asymptote in (
        (curve.centre_branches, curve.centre_asymptote),
        (curve.circle_branches, curve.circle_asymptote),
    ):
        ends = [places[k] for places, closed in branches if not closed for k in (0, -1)]
        assert len(ends) == 2  # a circular cubic goes to infinity once
        away = [((end - asymptote.foot) * np.exp(-1j * asymptote.angle)) for end in ends]
        assert all(abs(one) > 50 and abs(one.imag) < 0.1 for one in away)
        assert away[0].real * away[1].real < 0


def test_a_curve_is_in_order_finer_samples_lie_nearer() -> None:
    points, angles = four_poses()

    def jump(samples: int) -> float:
        loops = burmester_curve(points, angles, samples).loops
        ring = [np.concatenate([loop.centres, loop.centres[:1]]) for loop in loops]
        return max(float(np.max(np.linalg.norm(np.cross(one[1:], one[:-1]), axis=1))) for one in ring)

    assert jump(2000) < jump(500) / 3 < jump(125) / 9


@settings(max_examples=40)
@given(planted(3))
def test_three_poses_give_every_pivot_its_pin_and_back(task) -> None:
    drawn, points, angles = task
    pivots, pins = np.array([drawn.a0, drawn.b0]), np.array([drawn.a, drawn.b])
    of_pivots, of_pins = arms_of_pivots(points, angles, pivots), arms_of_pins(points, angles, pins)
    for guide, back, pivot, pin in zip(of_pivots, of_pins, pivots, pins, strict=True):
        assert abs(guide.pin - pin) < 1e-6
        assert abs(back.pivot - pivot) < 1e-6
        assert max(spread(guide, points, angles), spread(back, points, angles)) < EXACT


def test_the_knotting_report_s_cranks_have_these_pins() -> None:
    """Section 2: pivots 1.2557 and 23.2855 mm out on the ray of 275 deg; cranks 17.16552771 and 37.52517660 mm."""
    points, angles = np.array([0, 25 + 15j, 30 + 1j]) * mm, np.array([10, 3, -25]) * deg
    pivots = np.array([1.255712017, 23.28552206]) * mm * np.exp(275j * deg)
    found = arms_of_pivots(points, angles, pivots)
    assert [one.length / mm for one in found] == pytest.approx([17.16552771, 37.52517660])
    assert [one.pin / mm for one in found] == pytest.approx(-np.array([17.22932881, 31.52594265]) * np.exp(10j * deg))


def test_a_pivot_in_a_pole_has_a_line_of_pins() -> None:
    points, angles = np.array([0, 1 + 1j, 3 + 0j]), np.array([0.0, 0.5, 1.2])
    pole = (points[1] - np.exp(0.5j) * points[0]) / (1 - np.exp(0.5j))
    (guide,) = arms_of_pivots(points, angles, np.array([pole]))
    assert guide.kind is GuideKind.FREE
    assert "any point of a line" in guide.kind.words


def test_scaling_and_moving_the_poses_scales_and_moves_the_links() -> None:
    random = np.random.default_rng(21)
    points, angles = random.normal(size=5) + 1j * random.normal(size=5), random.uniform(-1.5, 1.5, size=5)
    factor, by = 250 * np.exp(0.7j), 3000 - 2000j
    found = arms_through_five_poses(points, angles)
    other = arms_through_five_poses(factor * points + by, angles + 0.7)
    assert len(found) == len(other) > 0
    for one, two in zip(found, other, strict=True):
        assert two.pivot == pytest.approx(factor * one.pivot + by, rel=1e-8)
        assert two.pin == pytest.approx(factor * one.pin + by, rel=1e-8)


FIVE = np.array([0, 1, 1 + 1j, 2j, 3 + 1j])


@pytest.mark.parametrize(
    ("method", "points", "angles", "said"),
    [
        (arms_through_five_poses, FIVE[:4], TURNS[:4], "given 4 poses; exactly 5; for 4: burmester_curve"),
        (burmester_curve, FIVE, TURNS, "given 5 poses; exactly 4; for 5: arms_through_five_poses"),
        (burmester_curve, FIVE[:2], TURNS[:2], "exact methods: 3"),
        (arms_through_five_poses, FIVE, TURNS[:4], "5 points and 4 angles"),
        (arms_through_five_poses, FIVE, TURNS / deg, "angles are in radians"),
        (arms_through_five_poses, FIVE * np.array([1, 1, np.nan, 1, 1]), TURNS, "pose 3 is not finite"),
        (arms_through_five_poses, FIVE[[0, 1, 2, 3, 1]], TURNS[[0, 1, 2, 3, 1]], "poses 2 and 5 are the same"),
        (arms_through_five_poses, FIVE, 0 * TURNS, "same angle at all poses"),
        (arms_through_five_poses, 1j + np.exp(1j * TURNS), TURNS, "all poses are rotations about one point"),
        (arms_through_five_poses, np.cos(TURNS) + 0.3 * np.exp(1j * TURNS), TURNS, "a family"),
        (burmester_curve, FIVE[:4], 0 * TURNS[:4], "same angle at all poses"),
        (burmester_curve, 1j + np.exp(1j * TURNS[:4]), TURNS[:4], "all poses are rotations about one point"),
    ],
)
def test_what_is_no_task_of_poses(method, points, angles, said: str) -> None:
    with pytest.raises(ParameterError, match=said):
        method(points, angles)


def test_too_few_samples_are_no_curve() -> None:
    with pytest.raises(ParameterError, match="8 or more"):
        burmester_curve(*four_poses(), samples=3)
