"""Over random looms: what is listed is what is placed, weighs what its shape does, and is what checks name."""

import math
from typing import Any

import pytest
from cam_bars import beyond_cams
from hypothesis import given, settings
from hypothesis import strategies as st
from made_parts import moving_error

from ilmek.elements.materials import MATERIALS
from ilmek.errors import IlmekError
from ilmek.machines.automated_loom import MACHINE
from ilmek.machines.automated_loom.equipment.tree import whole_list
from ilmek.machines.automated_loom.own_parts import carried_tree, frame_tree
from ilmek.machines.automated_loom.parts import needs_of, parts_of_loom
from ilmek.machines.shedding import MACHINE as SHEDDING
from ilmek.machines.shedding.tree import tree as shedding_tree
from ilmek.machines.tension_compensator.tree import tree as compensator_tree
from ilmek.machines.warp_tension.tree import tree as cylinder_tree
from ilmek.part.tree import Tree
from ilmek.plane.solids import volume

_LOOMS = st.fixed_dictionaries(
    {
        "width": st.floats(0.4, 4.0),
        "length": st.floats(0.5, 3.0),
        "warp_pitch": st.sampled_from([0.0015, 0.002, 0.003, 0.004]),
        "heads": st.sampled_from([1, 2, 4]),
        "beat": st.sampled_from(["travelling", "linkage", "comb", "guide-cams"]),
    }
)


def _trees(loom: Any) -> dict[str, Tree]:
    machines = loom.machines
    return {
        "shedding": shedding_tree(loom.shedding),
        "warp-tension": cylinder_tree(loom.warp_tension),
        "tension-compensator": compensator_tree(machines["tension-compensator"].design),
        "carried": carried_tree(loom, parts_of_loom(loom).frame),
        "frame": frame_tree(loom, parts_of_loom(loom).frame, needs_of(loom, parts_of_loom(loom).parts)),
    }


@settings(max_examples=2)
@given(_LOOMS)
def test_list_tree_masses_and_checks_agree(wishes: dict[str, Any]) -> None:
    try:
        loom = MACHINE.designed(MACHINE.params(**wishes))
    except IlmekError:
        return
    listed = {line.part: line for line in parts_of_loom(loom).parts if line.part}
    placed = {part.id: (part, number) for tree in _trees(loom).values() for part, number in tree.occurrences()}
    assert set(placed) <= set(listed)
    for name, (part, number) in placed.items():
        line = listed[name]
        assert line.number == number, name
        assert part.shape is not None, name
        if part.material is not None:
            exact = part.shape.moments.zeroth * part.material.density
            assert line.mass == pytest.approx(exact, rel=1e-9), name
    assert moving_error(loom) <= 1e-6
    report = MACHINE.report(loom, illustrated=False, assembled=False)
    named = {name for check in report.all_checks for name in check.parts}
    assert named <= {line.part for line in whole_list(loom).parts}


@pytest.mark.parametrize("shafts", [1, 2])
def test_the_stacks_of_cams_weigh_what_their_parts_do(shafts: int) -> None:
    """Cams, guide cams, spacers and the bar between the ends of the stack, by the moments of the bodies."""
    design = SHEDDING.design(SHEDDING.params(shafts=shafts))
    whole = math.fsum(body.moments.zeroth for body in shedding_tree(design).bodies[1::2])
    assert whole == pytest.approx(design.stack.mass + _spare(design), rel=1e-6)


def _spare(design: Any) -> float:
    """Mass of the bars beyond their stacks, of their ends, and of what clamps the cams [kg]."""
    steel = MATERIALS["structural steel"].density
    return math.fsum(_spare_volume(design, index) for index in range(len(design.shafts))) * steel


def _spare_volume(design: Any, index: int) -> float:
    shaft = design.shafts[index]
    end, nut = shaft.driven_end, shaft.nut
    key = end.number * end.keyway.width * end.keyway.height * end.length
    ring = math.pi / 4 * (nut.outer**2 - nut.thread**2) * (nut.washer + nut.width)
    length = sum(shaft.numbers) * shaft.stack.shares.pitch
    return float(beyond_cams(design, index, length) + key + 2 * ring)


def test_the_spacer_weighs_its_tube_less_its_slots() -> None:
    """By its mesh, fine enough to show the slots."""
    loom = MACHINE.designed(MACHINE.params.read({}))
    tree = cylinder_tree(loom.warp_tension)
    spacer = next(part for part, _ in tree.occurrences() if part.id == "warp-tension/spacer")
    assert spacer.shape is not None
    assert volume(spacer.shape.mesh(1e-5)) == pytest.approx(spacer.shape.moments.zeroth, rel=1e-3)
