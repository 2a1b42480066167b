"""What a loom chooses: kinds of beat until the parts have room in space, columns until the frame is stiff, motors."""

import math
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from ilmek.elements.drive_parts import PULLEY
from ilmek.elements.motors import MOTORS, find_motor
from ilmek.machines.arrangement.side_view import RETREAT
from ilmek.machines.automated_loom import MACHINE, LoomDesign, selection
from ilmek.machines.automated_loom.equipment.energy_chain import energy_chain
from ilmek.machines.automated_loom.estimate import estimated_time
from ilmek.machines.automated_loom.frame_modes import frame_modes, sway_checks
from ilmek.machines.automated_loom.in_space.scene import loom_tree
from ilmek.machines.automated_loom.on_rail import share_of
from ilmek.machines.automated_loom.own_parts import RAIL, mass_of_rail
from ilmek.machines.automated_loom.params import AutomatedLoomParams
from ilmek.machines.automated_loom.parts import parts_of_loom
from ilmek.machines.automated_loom.rail_supports import rail_supports
from ilmek.machines.automated_loom.shaking import least_frequency
from ilmek.machines.weaver import head_mass
from ilmek.report import Check, at_most
from ilmek.timing.track import peak_acceleration


def designed(**settings: str) -> LoomDesign:
    return selection.design(AutomatedLoomParams.read({"aim": "price", **settings}))


def in_the_way(*kinds: str):
    """Comparisons in space by which parts of some kinds of beat, and of no other, are through each other."""

    def compared(loom: LoomDesign) -> SimpleNamespace:
        clashes = kinds.index(loom.params.beat) + 1 if loom.params.beat in kinds else 0
        checks: tuple[Check, ...] = (at_most("parts through each other", clashes, 0, "1", "planted"),)
        return SimpleNamespace(checks=checks, holds=not clashes)

    return compared


@pytest.mark.parametrize("settings", [{}, {"width": "0.6m", "length": "0.9m"}, {"aim": "time"}], ids=str)
def test_a_beat_without_room_in_space_is_exchanged_for_the_next_that_holds(
    settings: dict[str, str], monkeypatch: pytest.MonkeyPatch
) -> None:
    params = AutomatedLoomParams.read({"aim": "price", **settings})
    first = selection.design(params)
    monkeypatch.setattr(selection, "assembly", in_the_way())
    assert selection.with_room(first, params) is first
    monkeypatch.setattr(selection, "assembly", in_the_way(first.params.beat))
    other = selection.with_room(first, params)
    assert other.params.beat != first.params.beat
    assert other.params.heads == first.params.heads
    (choice,) = (choice for choice in MACHINE.choices(other) if choice.name == "beat")
    assert choice.chosen == other.params.beat
    assert first.params.beat != choice.next_cheaper or choice.decided_by == "parts through each other"


def test_a_beat_that_is_set_stays_and_where_none_has_room_the_loom_fails(monkeypatch: pytest.MonkeyPatch) -> None:
    params = AutomatedLoomParams.read({"aim": "price", "beat": "linkage"})
    first = selection.design(params)
    every = in_the_way("linkage", "travelling", "comb", "guide-cams")
    monkeypatch.setattr(selection, "assembly", every)
    assert selection.with_room(first, params) is first
    left_open = replace(params, beat="auto")
    last = selection.with_room(selection.design(left_open), left_open)
    assert not every(last).holds


@pytest.mark.parametrize(
    "settings",
    [{"width": "2m", "heads": "10"}, {"width": "3m", "heads": "8"}, {"width": "1.8m", "heads": "9"}],
    ids=str,
)
def test_the_columns_are_the_first_that_are_stiff_enough(settings: dict[str, str]) -> None:
    """Frequencies: those of a frame with all that it carries; the section before is too slack or too weak."""
    loom = designed(beat="travelling", **settings)
    frame = parts_of_loom(loom).frame
    assert all(check.ok for check in (*frame_modes(loom, frame).checks, *frame.checks))
    assert frame_modes(loom, frame).across == next(sway_checks(loom, frame)).value
    (choice,) = (one for one in frame.choices if one.name == "frame_columns")
    assert choice.failed
    supported = rail_supports(loom, frame)
    assert all(check.ok for own in supported for check in own.checks)
    assert loom.side.heads is not None
    assert frame.guide[0].side <= loom.side.heads.rail_side  # for which the beat has room
    pushed = supported[0].push * RETREAT.imag / RETREAT.real  # by the axes that draw the rail back, not by weight
    least, mass = 2 * least_frequency(loom), (supported[0].load + pushed) / 9.80665
    assert math.sqrt(3 * 2.1e11 * supported[0].post.inertia / mass / supported[0].height ** 3) >= 2 * math.pi * least


def test_of_heads_that_shake_the_frame_there_are_so_many_that_it_bears() -> None:
    """More heads that tie as quickly shake it too much; they would weave in less time."""
    wide = {"width": "2.6m", "length": "2.6m", "knots_across": "31/dm", "beat": "travelling", "knotting": "cams"}
    loom = designed(aim="time", **wide)
    frame = parts_of_loom(loom).frame
    assert all(check.ok for check in frame_modes(loom, frame).checks)
    more = designed(heads=str(loom.heads_max), knot_cycle=f"{loom.params.knot_cycle}s", **wide)
    assert estimated_time(more) < estimated_time(loom)
    assert not all(check.ok for check in frame_modes(more, parts_of_loom(more).frame).checks)


@pytest.mark.parametrize("heads", ["1", "4", "7"])
def test_a_motor_of_the_retreat_bears_its_end_of_the_rail_wherever_the_heads_stand(heads: str) -> None:
    """By the reaction of a simply supported rail over random places of the heads in their shares."""
    loom = designed(beat="comb", heads=heads)
    listed, row = parts_of_loom(loom), loom.row_cyclogram
    (line,) = (one for one in listed.parts if one.part == "automated-loom/retreat-motor")
    assert line.number == 2
    moved = [body for body in loom_tree(loom).bodies if body.id in {RAIL, "automated-loom/chains"}]
    row_of, conduits = energy_chain(loom), 0.02 * loom.weaver.params.tubes * loom.heads
    number, rail = loom.heads, sum(body.moments.zeroth for body in moved) + conduits * row_of.length(share_of(loom))
    assert mass_of_rail(loom, listed.frame) == pytest.approx(rail, rel=1e-9)
    place = (np.arange(number) + np.random.default_rng(5).random((4000, number))) / number
    most = float((1 - place).sum(axis=1).max()) * head_mass(loom.weaver) + rail / 2
    torque = most * (peak_acceleration(row.track("heads"), row.period) - 9.81 * RETREAT.imag) * PULLEY
    chosen = find_motor(line.description)
    assert chosen.torque >= torque
    weaker = [motor for motor in MOTORS if motor.power < chosen.power and motor.speed >= chosen.speed]
    assert all(motor.torque < 1.3 * torque for motor in weaker)
