"""Coupler curves: the straight lines of Chebychev and Roberts, Roberts' circle of double points, cusps on centrodes."""

import mechanisms
import numpy as np
import pytest

from ilmek.errors import MechanismError
from ilmek.linkage.circuits import circuits
from ilmek.linkage.configuration_path import InputPath
from ilmek.linkage.coupler_curve import _first_of_its_kind, coupler_curve
from ilmek.linkage.fourbar import four_bar
from ilmek.linkage.instant_centres import centrodes
from ilmek.linkage.one_input import one_input
from ilmek.linkage.solve import solve
from ilmek.linkage.structure import plan

LOOP = (1.0, 0.4, 1.0, 0.9)


def path(sizes, local, branch=+1):
    """The path of a coupler point over a turn of the crank."""
    mechanism = four_bar(*sizes, branch=branch, points={"coupler": {"P": local}})
    return coupler_curve(InputPath(one_input(plan(mechanism))), "coupler", "P")


def test_crossings_at_a_triple_point_are_three() -> None:
    """Three passes through one point cross in pairs that share a parameter; a pair found twice counts once."""
    pairs = np.array([[0.0, 1.0], [1e-9, 2.0], [1.0, 2.0], [1e-9, 1.0], [1.0, 2.0 - 1e-9]])
    assert _first_of_its_kind(pairs, 1e-6).tolist() == [True, True, True, False, False]


def test_chebychevs_linkage_draws_his_line():
    """Ground 2, arms 2.5, coupler 1: its middle is at height 2 for x = 0, 1, 2, and within 0.3 % of the line between
    [Chebychev 1854; Norton, Design of Machinery, figure 3-29: bars 4 : 5 : 2]."""
    for circuit in circuits(one_input(plan(mechanisms.chebychev()))):
        middle = coupler_curve(circuit, "coupler", "M")
        places = np.linspace(0, circuit.stop, 4001)
        z = middle.at(places).position
        line = z[(np.abs(np.abs(z.imag) - 2) < 0.1) & (z.real > 0) & (z.real < 2)]
        assert np.abs(np.abs(line.imag) - 2).max() < 0.006
        for x in (0.0, 1.0, 2.0):
            assert np.abs(line - (x + 2j * np.sign(line[0].imag))).min() < 5e-3
        best, *_ = middle.straights(0.005, least=1.5)
        assert best.length == pytest.approx(2.25, abs=0.03)
        assert 0.004 < best.deviation <= 0.005
        assert abs(best.direction.imag) < 2e-3


def test_roberts_linkage_draws_its_line_between_the_pivots():
    """Equal links, the apex of the coupler's triangle as far from its ends as the links are long: through both pivots
    and the middle between them [Norton, Design of Machinery, figure 3-29]."""
    apex = 0.5 - 1j * np.sqrt(1.2**2 - 0.25)
    mechanism = four_bar(2.0, 1.2, 1.0, 1.2, branch=+1, points={"coupler": {"P": apex}})
    moved = one_input(plan(mechanism))
    seen = [coupler_curve(one, "coupler", "P") for one in circuits(moved)]
    z = np.concatenate([np.asarray(one.at(np.linspace(0, one.path.breaks[-1], 2001)).position) for one in seen])
    assert max(np.abs(z - x).min() for x in (0.0, 1.0, 2.0)) < 5e-3
    best = max((one for curve in seen for one in curve.straights(0.008, least=1.5)), key=lambda one: one.length)
    assert abs(best.middle - 1) < 0.05
    assert best.length > 1.8
    assert abs(best.direction.imag) < 5e-3


@pytest.mark.parametrize("local", [0.5 + 0.8j, 0.2 - 0.5j, 1.2 + 0.4j, -0.4 + 0.1j, 1.8 + 0.3j])
def test_double_points_lie_on_the_circle_of_the_foci(local):
    """A0, B0 and the apex C0 of the triangle on A0 B0 similar to the coupler's hold all double points [Roberts].

    A sextic with two threefold points at infinity has at most three others, and a line meets it six times at most.
    """
    curve = path(LOOP, local)
    found = curve.crossings()
    assert len(found) <= 3
    apex = local / LOOP[2] * LOOP[0]
    centre = 0.5 + 1j * (abs(apex) ** 2 - apex.real) / (2 * apex.imag)
    for one in found:
        u, v = curve.at(np.array(one.parameters)).position
        assert abs(u - v) < 1e-12
        assert one.angle > 0
        assert abs(one.position - centre) == pytest.approx(abs(centre), rel=1e-10)
    z = curve.at(np.linspace(-np.pi, np.pi, 2001)).position
    for angle in np.linspace(0, np.pi, 12, endpoint=False):
        height = np.imag((z - np.mean(z[:-1])) * np.exp(-1j * angle))
        assert np.count_nonzero(height[:-1] * height[1:] < 0) <= 6


def test_some_of_these_paths_do_cross():
    """Beside a point on the moving centrode lies one with a small loop, however small."""
    assert len(path(LOOP, 1.2 + 0.4j).crossings()) == 1
    motion = solve(plan(four_bar(*LOOP, branch=+1)), 0.7, 1.0)
    cusp = complex(centrodes(motion, "coupler").moving[0])
    beside = [len(path(LOOP, cusp + 1e-3 * turn).crossings()) for turn in (1, 1j, -1, -1j)]
    assert path(LOOP, cusp).crossings() == ()
    assert sorted(beside) == [0, 0, 1, 1]


def test_a_point_on_the_moving_centrode_has_a_cusp():
    where = 0.7
    motion = solve(plan(four_bar(*LOOP, branch=+1)), where, 1.0)
    local = complex(centrodes(motion, "coupler").moving[0])
    curve = path(LOOP, local)
    (cusp,) = curve.cusps()
    assert cusp.input == pytest.approx(where, abs=1e-9)
    assert abs(curve.at(np.array([cusp.parameter])).velocity[0]) < 1e-9
    assert path(LOOP, local + 1e-4).cusps() == ()


def test_lengths_are_exact():
    """Of a circle, of an ellipse of the trammel by its elliptic integral, and of a path with a cusp in two parts."""
    crank = coupler_curve(InputPath(one_input(plan(four_bar(*LOOP, branch=+1)))), "crank", "A")
    assert crank.length() == pytest.approx(2 * np.pi * 0.4, rel=1e-14)
    np.testing.assert_allclose(crank.curvature(np.linspace(0, 6, 9)), 1 / 0.4)
    curve = path(LOOP, 0.5 + 0.8j)
    chords = np.abs(np.diff(curve.at(np.linspace(-np.pi, np.pi, 200001)).position)).sum()
    assert curve.length() == pytest.approx(chords, rel=1e-9)
    motion = solve(plan(four_bar(*LOOP, branch=+1)), 0.7, 1.0)
    cusped = path(LOOP, complex(centrodes(motion, "coupler").moving[0]))
    chords = np.abs(np.diff(cusped.at(np.linspace(-np.pi, np.pi, 200001)).position)).sum()
    assert cusped.length() == pytest.approx(chords, rel=1e-8)


def test_inflections_have_no_curvature_and_part_left_from_right():
    curve = path(LOOP, 1.2 + 0.4j)
    found = curve.inflections()
    assert len(found) >= 2
    places = np.array([one.parameter for one in found])
    assert np.abs(curve.curvature(places)).max() < 1e-9
    assert (curve.curvature(places - 1e-4) * curve.curvature(places + 1e-4) < 0).all()


def test_a_path_run_back_on_itself_does_not_cross_itself():
    mechanism = four_bar(*LOOP, branch=+1)
    assert coupler_curve(InputPath(one_input(plan(mechanism))), "rocker", "B").crossings() == ()


def test_what_has_no_path_is_refused():
    mechanism = four_bar(0.3, 0.2, 0.2, 0.23, branch=+1)
    with pytest.raises(MechanismError, match="cannot close for crank"):
        InputPath(one_input(plan(mechanism)))
    with pytest.raises(MechanismError, match="from 1.0 to 1.0"):
        InputPath(one_input(plan(mechanism)), 1.0, 1.0)
    with pytest.raises(MechanismError, match="straight within 0 m for 1.0 m"):
        path(LOOP, 1 + 1j).straights(0, least=1.0)
