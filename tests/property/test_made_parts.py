"""What is made weighs what the forces count: every machine with a tree, its parameters changed at random.

Mass, centre and inertia tensor of each made part are measured on its mesh, tetrahedron by tetrahedron: the code's own
moments have no part in it. Of 200 looms and machines: `make campaigns PARTS=weights`.
"""

import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from made_parts import OTHERS, QUICK, changed, deviation_of, made_parts, mass_error

from ilmek.machines.catalogue import MACHINES


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
    report = component.report(design, illustrated=False)
    assert {line.part: line.number for line in report.parts} == {name: n for name, (_, n) in parts.items()}
    assert all(part.shape is not None for part, _ in parts.values())
    named = {name for check in report.checks for name in check.parts}
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
