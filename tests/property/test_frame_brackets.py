"""The frame's brackets against meshes and brute force: bearings stand on them, shafts pass them, none meets another."""

import math
from functools import cache
from itertools import combinations

import numpy as np
import pytest
from default_machines import SETTLED
from hypothesis import given
from hypothesis import strategies as st
from scipy.optimize import brentq

from ilmek.machines.automated_loom import MACHINE, LoomDesign
from ilmek.machines.automated_loom.brackets import Bracket, bracket_checks, brackets_of, least_height
from ilmek.machines.automated_loom.parts import own_tree, parts_of_loom
from ilmek.machines.bearing_seats import BRACKET
from ilmek.machines.shedding.tree import reducer
from ilmek.machines.shedding.tree import tree as shedding_tree
from ilmek.machines.warp_tension.cylinders import cylinders as cylinders_of
from ilmek.machines.warp_tension.tree import tree as cylinder_tree
from ilmek.part.catalogue import BEFORE_KEY
from ilmek.part.part import Part
from ilmek.part.tree import Tree
from ilmek.plane.contours import along, rounded_hull

LOOMS: tuple[dict[str, str], ...] = (
    {},
    {**SETTLED, "width": "0.4m", "length": "0.5m"},
    {"beat": "guide-cams"},
    {**SETTLED, "width": "2.6m", "knots_across": "40/dm", "tension": "15N", "lift": "70mm", "beat": "comb"},
    {**SETTLED, "width": "1.7m", "tension": "30N", "lift": "70mm"},
)


@cache
def loom(number: int) -> LoomDesign:
    return MACHINE.designed(MACHINE.params.read(LOOMS[number]))


def extent(tree: Tree, name: str) -> tuple[Part, float]:
    """A part, and how far its mesh reaches along the shaft from the middle of the width [m]."""
    for body in tree.bodies:
        for occurrence in body.occurrences:
            if occurrence.part.id == name:
                assert occurrence.part.shape is not None
                points = occurrence.part.shape.mesh(1e-3).points
                return occurrence.part, max(
                    float(np.abs(one.points(points)[:, 2]).max()) for one in occurrence.positions
                )
    raise AssertionError(name)


@pytest.mark.parametrize("number", range(len(LOOMS)))
def test_every_bearing_touches_its_bracket_and_every_shaft_ends_at_its_outer_face(number: int) -> None:
    design = loom(number)
    made = brackets_of(design)
    cylinders, cams = cylinder_tree(design.warp_tension), shedding_tree(design.shedding)
    found = cylinders_of(design.warp_tension)
    named = {one.name: one for one in made.plates}
    for name, own in (("upper", "upper"), ("lower", "lower"), ("spacer", "spacer")):
        bracket = named[f"{own}-bracket"]
        assert extent(cylinders, f"warp-tension/{name}-bearing")[1] == pytest.approx(bracket.inner, abs=1e-9)
        assert extent(cylinders, f"warp-tension/{name}-end")[1] == pytest.approx(bracket.outer + BEFORE_KEY, abs=1e-9)
        keyed = next(one for one in found if one.name == name).driven_end.length  # goes on into the reducer
        end = bracket.outer + BEFORE_KEY + keyed
        assert extent(cylinders, f"warp-tension/{name}-driven-end")[1] == pytest.approx(end, abs=1e-9)
    assert extent(cams, "shedding/bearing")[1] == pytest.approx(named["cam-bracket"].inner, abs=1e-9)
    keyed = design.shedding.first.driven_end.length
    assert extent(cams, "shedding/cam-shaft")[1] == pytest.approx(
        named["cam-bracket"].outer + BEFORE_KEY + keyed, abs=1e-9
    )
    assert made.face >= max(one.outer for one in made.plates)


def outline(one: Bracket) -> np.ndarray:
    """The plate without the slot of its shaft."""
    return along(rounded_hull(one.nodes, one.radius), 1e-4)


def inside(points: np.ndarray, corners: np.ndarray) -> np.ndarray:
    """Which points lie in a convex polygon, counter-clockwise."""
    edges = np.roll(corners, -1) - corners
    return np.all((np.conj(edges) * (points[:, None] - corners)).imag > 0, axis=1)


@pytest.mark.parametrize("number", range(len(LOOMS)))
def test_brackets_of_a_side_surround_their_seats_and_do_not_meet(number: int) -> None:
    design = loom(number)
    plates = brackets_of(design).plates
    for one in plates:
        assert inside(one.nodes, outline(one)).all()
        for bore in one.bores:
            assert inside(along(bore, 1e-4), outline(one)).all()
    for one, other in combinations(plates, 2):
        assert not inside(outline(one), outline(other)).any()
        assert not inside(outline(other), outline(one)).any()


@pytest.mark.parametrize("number", range(len(LOOMS)))
def test_a_bracket_is_at_the_column_as_high_as_its_stress_assumes(number: int) -> None:
    """By points on the column's axis that lie in the outline."""
    design = loom(number)
    for one in brackets_of(design).plates:
        heights = np.linspace(one.nodes.imag.min() - one.radius, one.nodes.imag.max() + one.radius, 4001)
        within = heights[inside(design.side.column + 1j * heights, outline(one))]
        assert np.ptp(within) >= one.depth - 2e-3
        assert within.min() <= min(one.ends)
        assert within.max() >= max(one.ends)


@pytest.mark.parametrize("number", range(len(LOOMS)))
def test_the_upper_bracket_leaves_the_reducers_of_the_cam_shafts_their_room(number: int) -> None:
    design = loom(number)
    edge = outline(brackets_of(design).upper)
    for index, cam in enumerate(design.side.cams):
        shape = reducer(design.shedding, index).shape
        assert shape is not None
        farthest = np.hypot(*shape.mesh(1e-3).points[:, :2].T).max()
        assert np.abs(edge - cam.at).min() >= farthest


@given(st.floats(1.0, 1e5), st.floats(0.0, 1e3), st.floats(20e6, 300e6))
def test_the_least_height_has_the_stress_that_is_allowed(plane: float, across: float, stress: float) -> None:
    def excess(height: float) -> float:
        return 6 * plane / (BRACKET * height**2) + 6 * across / (height * BRACKET**2) - stress

    found = brentq(excess, 1e-6, 1e4, xtol=1e-12, rtol=1e-12)
    assert least_height((plane, across), stress) == pytest.approx(found, rel=1e-6)


@pytest.mark.parametrize("number", range(len(LOOMS)))
def test_brackets_keep_their_stress_and_columns_their_room(number: int) -> None:
    design = loom(number)
    found = parts_of_loom(design).frame
    checks = bracket_checks(design, brackets_of(design), found.column)
    assert all(check.ok for check in checks), [check.name for check in checks if not check.ok]
    listed = {line.part for line in parts_of_loom(design).parts}
    assert {part for check in checks for part in check.parts} <= listed


def test_the_frame_weighs_what_its_meshes_do() -> None:
    """Brackets with round ends by fine meshes, against the mass that the report states."""
    design = loom(0)
    masses = [
        number * _volume(part) * part.material.density
        for part, number in own_tree(design).occurrences()
        if part.material is not None and part.process in ("welded frame", "laser-cut part")
    ]
    assert math.fsum(masses) == pytest.approx(parts_of_loom(design).frame.mass, rel=1e-5)


def _volume(part: Part) -> float:
    assert part.shape is not None
    solid = part.shape.mesh(1e-6)
    first, second, third = solid.points[solid.triangles].transpose(1, 0, 2)
    return float(np.sum(first * np.cross(second, third))) / 6
