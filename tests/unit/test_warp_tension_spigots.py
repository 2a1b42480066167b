"""The shaft ends of the cylinders fit the bored ends of their tubes, and a weld that bears the torque holds them."""

import math

import pytest

from ilmek.elements.fillet_welds import STRENGTH
from ilmek.machines.warp_tension import MACHINE, WarpTensionParams
from ilmek.machines.warp_tension.cylinders import LOWER, SPACER, UPPER, cylinders
from ilmek.machines.warp_tension.spigot import weld_force
from ilmek.machines.warp_tension.tree import tree
from ilmek.part.contacts import contacts
from ilmek.part.features import features_of_size
from ilmek.part.placement import placement
from ilmek.part.welds import welds_of


def test_spigot_and_bore_are_one_size_and_leave_half_of_the_wall() -> None:
    design = MACHINE.design(WarpTensionParams())
    assert MACHINE.tree is not None
    parts = {part.id: part for part, _ in MACHINE.tree(design).occurrences()}
    for cylinder in cylinders(design):
        tube = parts["warp-tension/spacer" if cylinder.name == "spacer" else "warp-tension/cylinder"]
        bores = [one for one in features_of_size(tube.shape) if one.inside and one.size == cylinder.spigot[0]]
        assert [one.length for one in bores] == [pytest.approx(0.02)] * 2
        for end in ("end", "driven-end"):
            own = parts[f"warp-tension/{cylinder.name}-{end}"].shape
            assert cylinder.spigot[0] in [one.size for one in features_of_size(own) if not one.inside]
        assert cylinder.inner < cylinder.spigot[0] / 2 < (cylinder.inner + cylinder.outer) / 2
        # The flange stands out by the leg of the weld, which ends on the tube.
        assert cylinder.flange - cylinder.shell.outer_radius >= math.sqrt(2) * cylinder.throat
        assert cylinder.weld <= STRENGTH * cylinder.throat


def test_the_force_of_a_weld_is_that_of_its_ring_as_a_thin_tube() -> None:
    radius, thin, torque, moment = 0.07, 1e-6, 630.0, 250.0
    outer, inner = radius + thin / 2, radius - thin / 2
    polar = math.pi / 2 * (outer**4 - inner**4)
    shear, bending = torque * radius / polar, moment * radius / (polar / 2)
    assert weld_force(radius, torque, moment) == pytest.approx(math.hypot(shear, bending) * thin, rel=1e-4)


def test_the_check_is_of_the_most_loaded_weld() -> None:
    design = MACHINE.design(WarpTensionParams())
    (named,) = [
        check
        for check in MACHINE.report(design, illustrated=False).checks
        if check.name.startswith("weld of the shaft end")
    ]
    assert named.ok
    assert named.value == max(one.weld / one.throat for one in cylinders(design))


def test_each_tube_is_welded_round_both_ends_to_the_flanges_of_its_shaft_ends() -> None:
    design = MACHINE.design(WarpTensionParams())
    where = {name: placement(y=k * 1.0) for k, name in enumerate((UPPER, LOWER, SPACER))}
    welds = welds_of(tree(design, where))
    assert set(welds) == {"warp-tension/cylinder", "warp-tension/spacer"}
    ends = {f"warp-tension/spacer-{end}" for end in ("end", "driven-end")}
    assert {weld.other for weld in welds["warp-tension/spacer"]} == ends
    for name, own in welds.items():
        cylinder = cylinders(design)[2 if name.endswith(SPACER) else 0]
        assert {round(float(weld.middle[2]), 9) for weld in own} == {0.0, cylinder.length}
        for weld in own:
            assert weld.lengths == (pytest.approx(2 * math.pi * cylinder.shell.outer_radius, rel=1e-3),)
            assert weld.throat >= cylinder.throat


def test_the_machine_alone_is_one_machine() -> None:
    assert MACHINE.tree is not None
    alone = contacts(MACHINE.tree(MACHINE.design(WarpTensionParams())))
    assert (len(alone.groups), alone.through) == (1, ())
