"""Clearance of bodies: against closed forms, brute force and the geometry of outlines."""

import mechanisms
import numpy as np
import pytest

from ilmek.errors import IlmekError, MechanismError
from ilmek.linkage.circuits import circuits
from ilmek.linkage.clearance import OutlinedBody, clearance, distances, outlined
from ilmek.linkage.configuration_path import InputPath
from ilmek.linkage.fourbar import four_bar, slider_crank
from ilmek.linkage.model import GROUND
from ilmek.linkage.one_input import one_input
from ilmek.linkage.structure import plan
from ilmek.plane.outlines import Outline, between, nearest, to_outline

SQUARE = np.array([0, 1, 1 + 1j, 1j])


def slider() -> InputPath:
    return InputPath(one_input(plan(slider_crank(0.1, 0.3, branch=+1))))


def test_a_block_runs_up_to_a_wall_at_the_dead_centre_only():
    wall = OutlinedBody(GROUND, (Outline((0.5 - 1j, 0.5 + 1j)),))
    block = OutlinedBody("slider", (Outline((-0.02 - 0.01j, 0.03 - 0.01j, 0.03 + 0.01j)),))
    found = clearance(slider(), block, wall)
    assert found.least == pytest.approx(0.5 - 0.43, abs=1e-15)
    assert found.input == pytest.approx(0, abs=1e-7)
    assert found.interference == ()
    assert [point.real for point in found.points] == pytest.approx([0.43, 0.5])


def test_interference_begins_and_ends_where_the_way_says():
    wall = OutlinedBody(GROUND, (Outline((0.40 - 1j, 0.40 + 1j)),))
    block = OutlinedBody("slider", (Outline((0,), 0.03),))
    found = clearance(slider(), block, wall)
    assert found.least == pytest.approx(-0.03, abs=1e-15)
    ((start, stop),) = found.interference
    edge = np.arccos((0.1**2 + 0.37**2 - 0.3**2) / (2 * 0.1 * 0.37))
    assert (start, stop) == (pytest.approx(-edge, rel=1e-12), pytest.approx(edge, rel=1e-12))


def test_an_overlap_shorter_than_a_sample_is_found():
    angle, radius = 1.234567, 1e-9
    post = OutlinedBody(GROUND, (Outline((0.1 * np.exp(1j * angle) * (1 + radius),), 0.0),))
    tip = OutlinedBody("crank", (Outline((0.1,), 2e-10 + 0.1 * radius),))
    found = clearance(slider(), tip, post)
    assert found.least < 0
    ((start, stop),) = found.interference
    assert start < angle < stop < start + 1e-7


def test_overlap_across_the_end_of_the_turn_is_one_stretch():
    post = OutlinedBody(GROUND, (Outline((-0.1,), 0.01),))
    ((start, stop),) = clearance(slider(), OutlinedBody("crank", (Outline((0, 0.1)),)), post).interference
    half = np.arcsin(0.01 / 0.1)
    assert (start, stop) == (pytest.approx(np.pi - half), pytest.approx(half - np.pi))


@pytest.mark.parametrize("names", [("crank", "rocker"), ("coupler", GROUND)])
def test_least_clearance_is_that_of_a_very_fine_scan(names):
    mechanism = four_bar(1.0, 0.3, 0.9, 0.8, branch=+1, points={"coupler": {"P": 0.4 + 0.2j}})
    way = InputPath(one_input(plan(mechanism)))
    first = outlined(mechanism, names[0], 0.02)
    second = (
        outlined(mechanism, "rocker", 0.03)
        if names[1] != GROUND
        else OutlinedBody(GROUND, (Outline((0.4j, 0.4 - 0.5j, 0.6), 0.01),))
    )
    found = clearance(way, first, second)
    scan = distances(way, first, second, np.linspace(-np.pi, np.pi, 100001))
    assert found.least <= scan.min() + 1e-15
    assert found.least == pytest.approx(scan.min(), abs=2e-3)
    if found.least > 0:
        assert abs(found.points[0] - found.points[1]) == pytest.approx(found.least, rel=1e-12)


def test_clearance_round_a_circuit_goes_through_both_branches():
    mechanism = mechanisms.chebychev()
    first, *_ = circuits(one_input(plan(mechanism)))
    post = OutlinedBody(GROUND, (Outline((1.0 - 2.1j, 1.0 - 2.3j), 0.02),))
    found = clearance(first, outlined(mechanism, "coupler", 0.01), post)
    scan = distances(first, outlined(mechanism, "coupler", 0.01), post, np.linspace(0, first.stop, 5001))
    assert found.least == pytest.approx(scan.min(), abs=2e-3)
    assert found.least <= scan.min()


def test_outlines_measure_as_squares_and_discs_do():
    assert Outline(SQUARE, 0.5).area == pytest.approx(1 + 2 + np.pi / 4)
    assert Outline((0, 2), 0.5).area == pytest.approx(2 + np.pi / 4)
    turned = SQUARE * np.exp(0.25j * np.pi)
    assert between(SQUARE, turned + 3) == pytest.approx(2 - np.sqrt(0.5))
    assert nearest(SQUARE, turned + 3) == (pytest.approx(1 + np.sqrt(0.5) * 1j), pytest.approx(turned[3] + 3))
    assert between(np.array([-1 + 0j, 1]), np.array([-1j, 0.5j])) == pytest.approx(-0.5)
    assert between(np.array([0j]), np.array([3 + 4j])) == 5
    assert to_outline(np.array([0.2 + 0.5j, 0.5 + 2j, -3 - 4j]), Outline(SQUARE)).tolist() == [-0.2, 1, 5]


def test_an_overlap_is_the_shortest_way_out():
    """Of two squares by every shift: the polygons moved apart by it along some direction just touch."""
    for shift in (0.3 + 0.9j, 0.5 - 0.2j, -0.9 + 0.1j):
        depth = -float(between(SQUARE, SQUARE + shift))
        assert depth == pytest.approx(1 - max(abs(shift.real), abs(shift.imag)))


def test_what_has_no_outline_is_refused():
    way = slider()
    with pytest.raises(MechanismError, match="clearance of 'crank' from itself"):
        clearance(way, outlined(way.mechanism, "crank", 0.0), outlined(way.mechanism, "crank", 0.0))
    with pytest.raises(MechanismError, match="has no body 'wheel'"):
        clearance(way, outlined(way.mechanism, "crank", 0.0), OutlinedBody("wheel", (Outline((0,)),)))
    with pytest.raises(IlmekError, match="an outline of radius -1 m"):
        Outline((0, 1), -1)
    with pytest.raises(IlmekError, match="one or more, all finite"):
        Outline(())
