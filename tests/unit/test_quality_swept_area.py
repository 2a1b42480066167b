"""Swept areas: discs, rings, sectors and stadiums by their formulas, a coupler by its poses' union; convergence."""

import mechanisms
import numpy as np
import pytest

from ilmek.errors import MechanismError
from ilmek.linkage.clearance import OutlinedBody, outlined
from ilmek.linkage.configuration_path import InputPath
from ilmek.linkage.fourbar import four_bar, slider_crank
from ilmek.linkage.one_input import one_input
from ilmek.linkage.structure import plan
from ilmek.linkage.swept_area import swept_region
from ilmek.plane.outlines import Outline, to_outline
from ilmek.plane.regions import region

TURN = InputPath(one_input(plan(slider_crank(0.1, 0.3, branch=+1))))
BAR = OutlinedBody("crank", (Outline((0.03 - 0.005j, 0.06 - 0.005j, 0.06 + 0.005j, 0.03 + 0.005j)),))


def test_a_bar_turned_about_its_end_covers_a_disc_ever_more_exactly():
    exact = np.pi * 0.11**2
    found = [swept_region(TURN, outlined(TURN.mechanism, "crank", 0.010), cells=cells) for cells in (16, 32, 64)]
    errors = [abs(one.area - exact) for one in found]
    assert errors[1] < 0.35 * errors[0]
    assert errors[2] < 0.35 * errors[1]
    assert errors[2] < 4e-4 * exact
    for one, error in zip(found, errors, strict=True):
        assert error < one.bound
        assert len(one.outline) == 1
    assert found[1].bound < 0.6 * found[0].bound
    np.testing.assert_allclose(np.abs(found[2].outline[0]), 0.11, atol=1e-4)


def test_a_bar_that_misses_its_pivot_covers_a_ring():
    found = swept_region(TURN, BAR, cells=64)
    assert found.area == pytest.approx(np.pi * (0.06**2 + 0.005**2 - 0.03**2), rel=4e-3)
    outer, inner = found.outline
    assert np.mean(np.abs(outer)) == pytest.approx(abs(0.06 + 0.005j), rel=1e-3)
    assert np.mean(np.abs(inner)) == pytest.approx(0.03, rel=1e-3)
    areas = [0.5 * np.sum(np.imag(np.conj(loop) * np.roll(loop, -1))) for loop in found.outline]
    assert areas[0] > 0 > areas[1]


def test_a_part_turn_covers_a_sector_with_both_end_poses():
    way = InputPath(TURN.moved, 0.2, 0.2 + 1.1)
    found = swept_region(way, outlined(way.mechanism, "crank", 0.01), cells=64)
    sector = 0.5 * 1.1 * 0.11**2
    sides = 2 * 0.1 * 0.01 + 0.5 * np.pi * 0.01**2  # half a bar beside each end pose, a half tip on each
    pivot = 0.5 * (np.pi - 1.1) * 0.01**2
    assert found.area == pytest.approx(sector + sides + pivot, rel=2e-3)


def test_a_slider_covers_a_strip():
    found = swept_region(TURN, OutlinedBody("slider", (Outline((0,), 0.02),)), cells=64)
    assert found.area == pytest.approx(0.2 * 0.04 + np.pi * 0.02**2, rel=2e-3)


def test_a_coupler_covers_all_its_poses_and_little_else():
    mechanism = four_bar(*mechanisms.BEAT_UP, branch=+1)
    way = InputPath(one_input(plan(mechanism)))
    outline = Outline((0, 0.2007), 0.01)
    found = swept_region(way, OutlinedBody("coupler", (outline,)), cells=32)
    poses = way.bodies(np.linspace(-np.pi, np.pi, 721))["coupler"]
    rng = np.random.default_rng(2)
    points = rng.uniform(-0.1, 0.32, 4000) + 1j * rng.uniform(-0.1, 0.3, 4000)
    local = (points[:, None] - poses.carry(0j).position) * np.conj(poses.direction)
    share = np.mean(to_outline(local, outline).min(axis=1) <= 0)
    assert found.area == pytest.approx(share * 0.42 * 0.4, rel=0.05)


def test_a_body_of_two_parts_covers_what_both_do():
    """Two discs on the slider, farther apart than its stroke: two strips; nearer: one."""
    parts = [Outline((place,), 0.02) for place in (0.0, 0.3, 0.1)]
    apart = swept_region(TURN, OutlinedBody("slider", tuple(parts[:2])), cells=64)
    alone = 0.2 * 0.04 + np.pi * 0.02**2
    assert apart.area == pytest.approx(2 * alone, rel=1e-2)
    assert len(apart.outline) == 2
    together = swept_region(TURN, OutlinedBody("slider", (parts[0], parts[2])), cells=64)
    assert together.area == pytest.approx(0.3 * 0.04 + np.pi * 0.02**2, rel=2e-3)


def test_regions_with_holes_and_islands_are_measured():
    def rings(z):
        return np.minimum(np.abs(np.abs(z) - 1) - 0.2, np.abs(z) - 0.3)

    found = region(rings, -1.51 - 1.5j, 3.0, cells=256)
    assert found.area == pytest.approx(np.pi * (1.2**2 - 0.8**2 + 0.3**2), rel=1e-4)
    assert len(found.outline) == 3


def test_what_covers_nothing_is_refused():
    with pytest.raises(MechanismError, match="an outline of body 'crank' has no area; give it a radius"):
        swept_region(TURN, outlined(TURN.mechanism, "crank", 0.0))
    with pytest.raises(MechanismError, match="100 cells across; a power of 2"):
        swept_region(TURN, BAR, cells=100)
