"""A turned part seen along its axis or across it: areas by hand for stepped shafts, and what its mesh shows."""

import math
from collections.abc import Iterable

import numpy as np
import pytest
from effort import examples
from hypothesis import given
from hypothesis import strategies as st
from manifold3d import CrossSection, FillRule, Manifold, Mesh

from ilmek.arrays import ComplexArray
from ilmek.elements.materials import MATERIALS
from ilmek.part.part import Part
from ilmek.part.placement import placement
from ilmek.part.profile import Profile
from ilmek.part.projection import COARSE, PieceOutline, View, outlines
from ilmek.part.shapes import Shape, Turned
from ilmek.part.tree import Occurrence, RigidBody, Tree
from ilmek.plane.contours import polygon
from ilmek.units import deg

STEPS = st.lists(st.tuples(st.floats(0.002, 0.05), st.floats(0.012, 0.08)), min_size=1, max_size=8)
"""Length and radius of each step of a shaft [m]."""


def seen(shape: Shape, view: View, **turned: object) -> PieceOutline:
    """The one piece that is seen of a part at the origin, turned by a rotation."""
    part = Part("test/shaft", "shaft", "turned", shape=shape, material=MATERIALS["structural steel"])
    body = RigidBody("shaft", (Occurrence(part, (placement(**turned),)),))  # type: ignore[arg-type]
    (piece,) = outlines(Tree((body,)), view)
    return piece


def section(curves: Iterable[ComplexArray]) -> CrossSection:
    return CrossSection([np.stack([curve.real, curve.imag], axis=1) for curve in curves], FillRule.Positive)


def length(curves: Iterable[ComplexArray]) -> float:
    return float(sum(np.abs(np.roll(curve, -1) - curve).sum() for curve in curves))


@examples(60)
@given(STEPS, st.floats(0.001, 0.011), st.floats(0.0, 6.0))
def test_a_bored_shaft_of_steps_covers_the_rectangles_of_its_steps(
    steps: list[tuple[float, float]], bore: float, about_itself: float
) -> None:
    z = np.cumsum([0.0, *(step for step, _ in steps)])
    outer = [z[number + end] + 1j * radius for number, (_, radius) in enumerate(steps) for end in (0, 1)]
    shaft = Turned(Profile(polygon(np.array([z[-1] + 1j * bore, 1j * bore, *outer])[::-1])))
    piece = seen(shaft, View.TOP, about=(0, 0, 1), angle=about_itself)
    by_hand = math.fsum(2 * radius * step for step, radius in steps)
    assert section(piece.curves).area() == pytest.approx(by_hand, abs=COARSE / 2 * length(piece.curves))
    every, largest = np.concatenate(piece.curves), max(radius for _, radius in steps)
    assert (np.ptp(every.real), np.ptp(every.imag)) == pytest.approx((2 * largest, z[-1]), abs=COARSE)
    assert piece.near == pytest.approx(largest)
    end = seen(shaft, View.FRONT)
    assert section(end.curves).area() == pytest.approx(math.pi * largest**2, rel=0.06)
    assert end.near == pytest.approx(z[-1])


@pytest.mark.parametrize("view", View)
@pytest.mark.parametrize("angle", [0.0, 90 * deg, 37 * deg])
def test_a_slotted_cylinder_is_seen_as_its_mesh_is(view: View, angle: float) -> None:
    z = np.linspace(0.0, 0.1, 41)
    slotted = [at + 1j * (0.03 - depth) for at, depth in zip(z, np.tile([0, 0, 0.002, 0.002], 11), strict=False)]
    cylinder = Turned(Profile(polygon(np.array([0.025j, 0.1 + 0.025j, *slotted[::-1]]))))
    piece = seen(cylinder, view, about=(0, 1, 0), angle=angle)
    mesh = cylinder.mesh(COARSE / 10)
    turned = view.rotation @ placement(about=(0, 1, 0), angle=angle).rotation
    solid = Manifold(Mesh(mesh.points.astype(np.float32), mesh.triangles.astype(np.uint32)))
    polygons = solid.transform(np.column_stack([turned, np.zeros(3)])).project().to_polygons()
    shown = CrossSection([max(polygons, key=lambda corners: float(np.ptp(corners[:, 0])))])
    drawn = section(piece.curves)
    assert (shown - drawn).area() + (drawn - shown).area() < COARSE * length(piece.curves)
    assert piece.near == pytest.approx((mesh.points @ turned.T)[:, 2].max(), abs=COARSE)
