"""The ends of a cam stack: a thread on the bar, a nut with its washer, a ring that it presses on the cams."""

import math

import pytest

from ilmek.elements.locknuts import LOCKNUTS, locknut_for
from ilmek.machines.shedding import MACHINE, SheddingParams
from ilmek.machines.shedding.stack import part_id
from ilmek.machines.shedding.tree import tree
from ilmek.part.fastenings import fastenings
from ilmek.part.part_lists import fastener_list
from ilmek.part.tolerances import FeatureKind
from ilmek.part.tolerancing import tolerances_of
from ilmek.units import mm

DESIGN = MACHINE.design(SheddingParams())
TREE = tree(DESIGN)


def test_the_nut_sits_on_a_thread_and_presses_the_ring() -> None:
    shaft, nut = DESIGN.first, DESIGN.first.nut
    threads = [one for one in tolerances_of(TREE)[part_id("cam-shaft")] if one.kind is FeatureKind.OUTER_THREAD]
    assert len(threads) == 2
    assert {(one.nominal, one.tolerance) for one in threads} == {(nut.thread, f"× {nut.pitch / mm:g} - 6g")}
    (turning,) = (body for body in TREE.bodies if body.id == part_id("cam shaft"))
    placed = {own.part.id: [float(each.origin[2]) for each in own.positions] for own in turning.occurrences}
    (bar,) = placed[part_id("cam-shaft")]
    for feature in threads:
        begin = bar + float(feature.position.origin[2])
        (own,) = (z for z in placed[part_id("locknut")] if begin < z + nut.width / 2 < begin + feature.length)
        assert begin <= own
        assert own + nut.width <= begin + feature.length
    squares = [one for one in tolerances_of(TREE)[part_id("cam-shaft")] if one.kind is FeatureKind.SQUARE]
    rings = placed[part_id("pressure-ring")]
    assert squares[0].length < max(rings) + 15 * mm - min(rings) - 2 * mm  # the nut meets the ring, not the bar
    assert nut.core >= shaft.seat.bearing.bore  # it comes over the journal
    assert nut.outer > shaft.shaft.bar


def test_nut_and_ring_are_fastened_and_tightened() -> None:
    held = fastenings(TREE)
    ends = {part_id(name) for name in ("pressure-ring", "tab-washer", "locknut", "cam-shaft", "shedding-cam", "shims")}
    assert not ends & set(held.loose)
    rows = {row[1]: row for row in fastener_list(TREE).rows}
    nut = rows[part_id("locknut")]
    assert nut[0] == DESIGN.first.nut.designation
    assert nut[-2] == pytest.approx(250 * 3 * DESIGN.first.nut.outer)
    assert part_id("pressure-ring") in rows[part_id("tab-washer")][3:5] or part_id("tab-washer") in nut[3:5]


def test_force_of_a_tightened_nut() -> None:
    """The work of a small turn: the torque's is that along the thread's slope and of the friction of both faces."""
    for nut in LOCKNUTS:
        turn, flank = 1e-3, nut.thread - 0.6495 * nut.pitch
        lifted = nut.tightened * nut.pitch * turn / (2 * math.pi)
        rubbed = 0.12 * nut.tightened / math.cos(math.pi / 6) * flank / 2 * turn
        rubbed += 0.12 * nut.tightened * (nut.thread + nut.outer) / 4 * turn
        assert nut.torque * turn == pytest.approx(lifted + rubbed, rel=0.02)


@pytest.mark.parametrize("bar", [5.0, 20.0, 28.0, 65.0, 200.0])
def test_every_bar_has_a_nut(bar: float) -> None:
    nut = locknut_for(bar * mm, math.inf)
    assert nut.thread <= max(bar, 10.0) * mm


def test_cams_hold_on_each_other_by_friction() -> None:
    checks = {check.name: check for check in MACHINE.report(DESIGN).all_checks}
    assert checks["torque of a cam on its clamped sheets"].ok
    assert checks["nut of the cams over the journal"].ok
    slack = MACHINE.report(MACHINE.design(SheddingParams(shaft_bar=20 * mm)))
    assert "nut of the cams over the journal" in {check.name for check in slack.failed}
