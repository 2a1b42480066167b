"""What is made weighs what the forces count: every machine with a tree, its parameters changed at random.

Mass, centre and inertia tensor of each made part are measured on its mesh, tetrahedron by tetrahedron: the code's own
moments have no part in it.
"""

import dataclasses
import math
import random
from collections.abc import Callable, Iterator, Mapping
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ilmek.arrays import Float
from ilmek.dynamics.inertia import Inertia
from ilmek.errors import IlmekError
from ilmek.linkage.mirror import other
from ilmek.machines.catalogue import MACHINES
from ilmek.machines.knotting_dyad.drives import head_motion
from ilmek.params import declared
from ilmek.part.part import Part
from ilmek.part.tree import Tree
from ilmek.report.scene import Solid

SETTLED: Mapping[str, Mapping[str, Any]] = {
    "knotting-four-bar": {"link_mass": "made"},
    "tufting": {"link_mass": "made"},
}
"""Parameters with which the forces count the made links."""

FINE = 1e-5
"""Deviation of a mesh over the cube root of the part's volume."""


def changed(machine: str, seed: int) -> Any:
    """The design of a machine with up to four lengths, masses and angles changed by a third; None: it cannot be."""
    chance, params = random.Random(seed), MACHINES[machine].params(**SETTLED.get(machine, {}))
    numbers = [one.name for one in declared(type(params)) if isinstance(getattr(params, one.name), float)]
    picked = chance.sample(numbers, min(len(numbers), chance.randint(0, 4)))
    values = {name: getattr(params, name) * math.exp(chance.uniform(-0.3, 0.3)) for name in picked}
    try:
        return MACHINES[machine].designed(dataclasses.replace(params, **values))
    except IlmekError:
        return None


def measured(solid: Solid, density: float) -> tuple[float, Float[np.ndarray, "3"], Float[np.ndarray, "3 3"]]:
    """Mass, centre and inertia tensor about it of a closed surface, as tetrahedra from its first point.

    One with the corners 0, a, b, c: V = det / 6, the integral of r r^T is V/20 (sum r_i r_i^T + s s^T), s = a + b + c.
    """
    start = solid.points[0]
    corners = solid.points[solid.triangles] - start
    volume = np.linalg.det(corners) / 6
    sums = corners.sum(axis=1)
    second = np.einsum("t,tci,tcj->ij", volume, corners, corners) + np.einsum("t,ti,tj->ij", volume, sums, sums)
    first = np.einsum("t,ti->i", volume, sums) / 4
    whole = float(volume.sum())
    centre = first / whole
    central = second / 20 - whole * np.outer(centre, centre)
    return density * whole, centre + start, density * (np.trace(central) * np.eye(3) - central)


def made_parts(tree: Tree) -> Iterator[Part]:
    """Each part that is made."""
    return (part for part, _ in tree.occurrences() if part.material is not None)


def deviation_of(part: Part) -> float:
    """Greatest relative difference of mass, place of the centre and tensor from those of the mesh."""
    assert part.shape is not None
    assert part.material is not None
    size = part.shape.volume ** (1 / 3)
    mass, centre, tensor = measured(part.shape.mesh(FINE * size), part.material.density)
    own = part.moments
    assert own is not None
    scale = np.linalg.norm(own.inertia)
    return max(
        abs(mass / part.mass - 1),
        float(np.linalg.norm(centre - own.centre)) / size,
        float(np.linalg.norm(tensor - own.inertia) / scale),
    )


def counted(machine: str, design: Any) -> dict[str, Inertia]:
    """Inertias that the forces of a machine count, by the ids of the bodies."""
    if machine == "knotting-four-bar":
        return {f"{machine}/{body}": inertia for body, inertia in design.inertias.items()}
    if machine == "tufting":
        return {f"{machine}/{body}": inertia for body, inertia in design.bodies.items()}
    if machine == "knotting-dyad":
        arms = head_motion(design.params, design.head).arms
        sides: tuple[Callable[[str], str], ...] = (str, other)
        return {
            f"{machine}/{side(body).replace(' ', '-')}": inertia
            for arm, side in zip(arms.values(), sides, strict=True)
            for body, inertia in arm.loaded.inertias.items()
        }
    return {}


def mass_error(machine: str, design: Any, tree: Tree) -> float:
    """Greatest relative difference of mass, first and second moment of a body in the forces from those of its parts."""
    worst = _of_follower(design, tree) if machine == "cam" else 0.0
    for name, inertia in counted(machine, design).items():
        body = tree.body(name)
        weights = [
            (len(one.positions), one.part.shape.volume * one.part.material.density)
            if one.part.material is not None and one.part.shape is not None
            else (len(one.positions), one.part.mass)
            for one in body.occurrences
        ]
        mass = math.fsum(number * weight for number, weight in weights)
        moments = body.moments
        worst = max(worst, abs(inertia.mass - mass) / (mass or 1.0))
        if mass:
            away = abs(complex(*moments.centre[:2]) - inertia.centre)
            worst = max(worst, away / (abs(inertia.centre) or 1.0), abs(moments.inertia[2, 2] / inertia.moment - 1))
    return worst


def _of_follower(design: Any, tree: Tree) -> float:
    """Relative difference of the moving mass in a cam's forces from the follower's, no less than its rollers'."""
    if not tree.bodies:
        return 0.0
    mass, rollers = tree.body("cam/follower").moments.zeroth, 0.0
    for one in tree.body("cam/follower").occurrences:
        rollers += len(one.positions) * one.part.mass if one.part.id == "cam/roller" else 0.0
    return float(abs(mass - max(design.params.mass, rollers)) / (mass or 1.0))


QUICK = ("cam", "function-four-bar", "knotting-four-bar", "tufting", "knotting-dyad")
OTHERS = ("beat-up", "hammer", "shedding", "tension-compensator", "warp-tension", "weaver", "weft")


@pytest.mark.parametrize("machine", QUICK)
@settings(max_examples=2)
@given(seed=st.integers(0, 10**6))
def test_made_parts_weigh_what_the_forces_count(machine: str, seed: int) -> None:
    design = changed(machine, seed)
    if design is None:
        return
    tree_of = MACHINES[machine].tree
    assert tree_of is not None
    tree = tree_of(design)
    assert mass_error(machine, design, tree) <= 1e-6
    for part in made_parts(tree):
        assert deviation_of(part) <= 1e-4, part.id


@pytest.mark.parametrize("machine", [*QUICK, *OTHERS])
def test_every_line_of_the_list_is_a_part_with_a_shape_and_checks_name_them(machine: str) -> None:
    """At the default parameters; drives, rollers and followers too."""
    component = MACHINES[machine]
    assert component.tree is not None
    design = component.designed(component.params())
    parts = {part.id: (part, number) for part, number in component.tree(design).occurrences()}
    assert parts
    assert {line.part: line.number for line in component.parts(design)} == {name: n for name, (_, n) in parts.items()}
    assert all(part.shape is not None for part, _ in parts.values())
    named = {name for check in component.report(design, illustrated=False).checks for name in check.parts}
    assert named <= set(parts)


@pytest.mark.parametrize("kind", ["plate", "grooved", "conjugate", "barrel", "face", "wedge"])
def test_cams_of_every_kind_weigh_what_their_surface_encloses(kind: str) -> None:
    machine = MACHINES["cam"]
    design = machine.designed(machine.params.read({"kind": kind, "lift": "17mm", "prime_radius": "45mm"}))
    assert machine.tree is not None
    parts = list(made_parts(machine.tree(design)))
    assert len(parts) == (2 if kind == "conjugate" else 1)
    for part in parts:
        assert deviation_of(part) <= 1e-4
    listed = next(one.value for one in machine.report(design, illustrated=False).results if one.name == "mass")
    assert listed == pytest.approx(math.fsum(part.mass for part in parts), rel=1e-12)
