"""Each interlock: the orders that it blocks, in the controller, and that nothing else is blocked."""

from dataclasses import replace

import pytest
from fake_loom import READY, FakeLoom, MemoryStore, step
from small_programme import small_programme

from ilmek.loom.control.controller import Controller
from ilmek.loom.control.exchange import Acknowledged, Commanded, JogRequested, ModeChosen
from ilmek.loom.control.interlocks import (
    CONTRADICTIONS,
    INTERLOCKS,
    JOG_LIMITS,
    Interlock,
    LoomAxis,
    Reaction,
    axes_of,
    contradictions,
    jog_axis,
    usual_limits,
    violated,
)
from ilmek.loom.control.opening import open_journal
from ilmek.loom.control.packml import PackCommand, PackMode, PackState
from ilmek.loom.control.ports import ChangePackages, Done, EndRow, Jog, Order, Sensors, SensorsChanged, Tie
from ilmek.loom.operations import RowEnd, Stop

PROGRAMME = small_programme()
LIMITS = usual_limits(PROGRAMME.setup.warp_pitch)
ORDERS: dict[str, Order] = {
    "tie": Tie(0, 0, 0, 0, 0),
    "straight weft": EndRow(0, RowEnd.STRAIGHT_WEFT),
    "sinuous weft": EndRow(0, RowEnd.SINUOUS_WEFT),
    "beat": EndRow(0, RowEnd.FIRST_BEAT),
    "take-up": EndRow(0, RowEnd.TAKE_UP),
    "change": ChangePackages(Stop(0, 0)),
    **{f"jog {axis}": Jog(axis, 0.01) for axis in LoomAxis},
}
MOTIONS = set(ORDERS) - {"change"}

BLOCKED: dict[str, tuple[Sensors, set[str]]] = {
    "emergency stop": (replace(READY, emergency_stop=True), MOTIONS),
    "door open": (replace(READY, door_closed=False), MOTIONS),
    "warp tension unknown": (
        replace(READY, warp_tension=None),
        MOTIONS - {"take-up", "jog take-up", "jog grippers"},
    ),
    "warp tension low": (
        replace(READY, warp_tension=0.9 * LIMITS.least),
        MOTIONS - {"take-up", "jog take-up", "jog grippers"},
    ),
    "warp tension high": (
        replace(READY, warp_tension=1.1 * LIMITS.most),
        MOTIONS - {"jog carriage", "jog grippers"},
    ),
    "gripper closed on warps": (
        replace(READY, grippers_open=(False,) * 16, heads_clear=False),
        {"tie", "jog carriage"},
    ),
    "gripper in the shed": (
        replace(READY, grippers_open=(True, False), heads_clear=False),
        {"straight weft", "sinuous weft", "beat", "take-up", "jog shed", "jog beater", "jog take-up"},
    ),
    "head in the comb's path": (replace(READY, heads_clear=False), {"beat", "jog beater"}),
    "head between the warps": (
        replace(READY, heads_clear=False),
        {"straight weft", "sinuous weft", "take-up", "jog shed", "jog shuttle", "jog take-up"},
    ),
    "beater not back": (
        replace(READY, beater_back=False),
        MOTIONS - {"beat", "jog beater"},
    ),
    "shed open": (
        replace(READY, shed_closed=False),
        MOTIONS - {"straight weft", "sinuous weft", "jog shed", "jog shuttle"},
    ),
}  # fmt: skip


def test_every_interlock_has_a_case_and_a_name_of_its_own() -> None:
    assert [rule.name for rule in INTERLOCKS] == list(BLOCKED)


@pytest.mark.parametrize("rule", INTERLOCKS, ids=[rule.name for rule in INTERLOCKS])
def test_an_interlock_blocks_the_operations_that_it_is_about(rule: Interlock) -> None:
    sensors, expected = BLOCKED[rule.name]
    blocked = set()
    for name, order in ORDERS.items():
        head = order.head if isinstance(order, Tie) else None
        if rule in violated(axes_of(order), sensors, LIMITS, head):
            blocked.add(name)
    assert blocked == expected


def test_nothing_is_blocked_while_all_is_well() -> None:
    assert not any(violated(axes_of(order), READY, LIMITS) for order in ORDERS.values())


def test_a_head_waits_for_its_own_gripper_alone() -> None:
    sensors = replace(READY, grippers_open=(False, True))
    assert [one.name for one in violated(axes_of(ORDERS["tie"]), sensors, LIMITS, 0)] == ["gripper closed on warps"]
    assert violated(axes_of(ORDERS["tie"]), sensors, LIMITS, 1) == ()


def weaving(sensors: Sensors = READY) -> tuple[Controller, FakeLoom, MemoryStore]:
    loom, store = FakeLoom(), MemoryStore()
    controller = Controller(PROGRAMME, open_journal(b"", PROGRAMME))
    step(controller, loom, store, (SensorsChanged(READY, 0), Commanded(PackCommand.RESET)))
    loom.now = sensors
    step(controller, loom, store, (SensorsChanged(sensors, 0), Commanded(PackCommand.START)))
    return controller, loom, store


REACHED = {
    Reaction.ABORT: PackState.ABORTED,
    Reaction.HOLD: PackState.HELD,
    Reaction.SUSPEND: PackState.SUSPENDED,
}


@pytest.mark.parametrize("name", [name for name, (_, blocked) in BLOCKED.items() if "tie" in blocked])
def test_the_controller_does_not_begin_what_is_blocked_and_raises_the_alarm(name: str) -> None:
    sensors, _ = BLOCKED[name]
    controller, loom, store = weaving(sensors)
    step(controller, loom, store)
    rule = next(one for one in INTERLOCKS if one.name == name)
    expected = {Reaction.ABORT: PackState.ABORTED, Reaction.HOLD: PackState.HELD, Reaction.SUSPEND: PackState.SUSPENDED}
    assert loom.moving == []
    assert name in {one.kind.name for one in controller.status().alarms}
    assert controller.status().state is expected[rule.reaction]


@pytest.mark.parametrize("name", [rule.name for rule in INTERLOCKS if rule.guards])
def test_a_guard_ends_what_moves(name: str) -> None:
    controller, loom, store = weaving()
    assert loom.moving
    rule = next(one for one in INTERLOCKS if one.name == name)
    outputs = step(controller, loom, store, (SensorsChanged(BLOCKED[name][0], 1),))
    step(controller, loom, store, (SensorsChanged(BLOCKED[name][0], 1),))
    assert outputs.halt is (rule.reaction is Reaction.ABORT)
    assert bool(loom.moving) is not outputs.halt
    while loom.moving:
        step(controller, loom, store, loom.receive())
    step(controller, loom, store)
    assert controller.status().state is REACHED[rule.reaction]


def test_tension_that_returns_weaves_on_by_itself_and_a_door_does_not() -> None:
    controller, loom, store = weaving(BLOCKED["warp tension low"][0])
    step(controller, loom, store, (SensorsChanged(READY, 1),))
    assert controller.status().state is PackState.EXECUTE
    assert controller.status().alarms == ()
    step(controller, loom, store, (SensorsChanged(BLOCKED["door open"][0], 2),))
    step(controller, loom, store, (SensorsChanged(READY, 3),))
    step(controller, loom, store)
    assert controller.status().state is PackState.ABORTED
    step(controller, loom, store, (Commanded(PackCommand.CLEAR),))
    step(controller, loom, store, (Commanded(PackCommand.RESET),))
    refused = step(controller, loom, store, (Commanded(PackCommand.START),)).refusals[0]
    assert "acknowledge alarm 102" in refused.text
    step(controller, loom, store, (Acknowledged(102), Commanded(PackCommand.START)))
    assert controller.status().state is PackState.EXECUTE


def test_a_machine_is_not_cleared_while_its_emergency_stop_is_pressed() -> None:
    controller, loom, store = weaving(BLOCKED["emergency stop"][0])
    step(controller, loom, store)
    refused = step(controller, loom, store, (Commanded(PackCommand.CLEAR),)).refusals[0]
    assert refused.text.startswith("Clear with emergency stop")


@pytest.mark.parametrize("one", CONTRADICTIONS, ids=[one.name for one in CONTRADICTIONS])
def test_a_contradiction_of_sensors_holds_the_loom(one: object) -> None:
    changes = {one.sensor: one.value, one.other: one.other_value}  # type: ignore[attr-defined]
    if "grippers_open" in changes:
        changes["grippers_open"] = (True, False)
    sensors = replace(READY, **changes)
    assert one in contradictions(sensors)
    assert contradictions(READY) == ()
    controller, loom, store = weaving()
    step(controller, loom, store, (SensorsChanged(sensors, 1),))
    assert controller.status().state is PackState.HOLDING
    assert controller.status().alarms[0].kind.number == 401


@pytest.mark.parametrize(("end", "sensor"), [(RowEnd.STRAIGHT_WEFT, "shed"), (RowEnd.FIRST_BEAT, "beater")])
def test_a_sensor_that_does_not_change_while_its_axis_moves_is_stuck(end: RowEnd, sensor: str) -> None:
    controller, loom, store = weaving()
    while EndRow(0, end) not in loom.moving:
        step(controller, loom, store, loom.receive())
    loom.moving.clear()
    loom.woven.append(EndRow(0, end))
    step(controller, loom, store, (Done(EndRow(0, end), loom.time),))
    assert controller.status().state is PackState.HELD
    alarm = controller.status().alarms[0]
    assert (alarm.kind.number, alarm.note.startswith(sensor)) == (402, True)
    assert controller.state.sequence.ends_done == end + 1


@pytest.mark.parametrize("name", [name for name in ORDERS if name.startswith("jog")])
def test_a_jog_obeys_the_interlocks_and_the_limits_of_its_axis(name: str) -> None:
    axis = LoomAxis(name.removeprefix("jog "))
    loom, store = FakeLoom(), MemoryStore()
    controller = Controller(PROGRAMME, open_journal(b"", PROGRAMME))
    step(controller, loom, store, (SensorsChanged(READY, 0), ModeChosen(PackMode.MANUAL), Commanded(PackCommand.RESET)))
    step(controller, loom, store, (Commanded(PackCommand.START),))
    assert loom.moving == []
    limit = JOG_LIMITS[axis].distance
    for distance in (0.0, 1.01 * limit, -1.01 * limit, float("nan")):
        outputs = step(controller, loom, store, (JogRequested(axis, distance),))
        assert outputs.refusals[0].allowed.startswith("up to")
        assert outputs.orders == ()
    for rule in INTERLOCKS:
        sensors, blocked = BLOCKED[rule.name]
        step(controller, loom, store, (SensorsChanged(sensors, 0),))
        assert controller.status().state is PackState.EXECUTE
        if name in blocked:
            outputs = step(controller, loom, store, (JogRequested(axis, limit),))
            assert outputs.refusals
            assert outputs.orders == ()
    step(controller, loom, store, (SensorsChanged(READY, 0),))
    assert step(controller, loom, store, (JogRequested(axis, -limit),)).orders == (Jog(axis, -limit),)
    assert step(controller, loom, store, (JogRequested(axis, limit),)).refusals[0].allowed == "one axis moves at a time"


def test_axes_are_known_by_their_names() -> None:
    assert jog_axis("beater") is LoomAxis.BEATER
    assert jog_axis("gripper 3") is LoomAxis.GRIPPERS
    assert (jog_axis("gripper"), jog_axis("gripper x"), jog_axis("sley")) == (None, None, None)
