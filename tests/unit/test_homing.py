"""Homing after power-up: the order of the axes for whatever was cut off, what may move, failures, the journal."""

from dataclasses import replace

import pytest
from fake_loom import READY, FakeLoom, MemoryStore
from fake_loom import step as carried_out
from small_programme import small_programme

from ilmek.loom.control.controller import Controller
from ilmek.loom.control.exchange import Acknowledged, Commanded, ModeChosen
from ilmek.loom.control.homing import HOMED, next_axis
from ilmek.loom.control.interlocks import Interlock, LoomAxis, TensionLimits
from ilmek.loom.control.journal import RecordKind
from ilmek.loom.control.opening import journal_records, open_journal
from ilmek.loom.control.packml import PackCommand, PackMode, PackState
from ilmek.loom.control.ports import Done, Failed, Fault, Home, Order, Sensors, SensorsChanged
from ilmek.loom.twin.model import NO_FAULTS, plant_model
from ilmek.loom.twin.state import Halt, PlantState, first_state, sensors_of
from ilmek.loom.twin.step import step

PROGRAMME = small_programme(3, 6, 2, 2)
CUT_OFF = {
    "nothing": READY,
    "a knot": replace(READY, grippers_open=(False, True), heads_clear=False),
    "a weft": replace(READY, shed_closed=False),
    "a beat": replace(READY, beater_back=False),
}


def opened(sensors: Sensors = READY, mode: PackMode = PackMode.PRODUCTION) -> Controller:
    controller = Controller(PROGRAMME, open_journal(b"", PROGRAMME))
    controller.react((SensorsChanged(sensors, 0), ModeChosen(mode)))
    return controller


def moved(sensors: Sensors, axis: str) -> Sensors:
    """The sensors when an axis is at home."""
    after = {"grippers": {"grippers_open": (True,) * len(sensors.grippers_open)}, "heads": {"heads_clear": True},
             "beater": {"beater_back": True}, "shed": {"shed_closed": True}}  # fmt: skip
    return replace(sensors, **after.get(axis, {}))  # type: ignore[arg-type]


@pytest.mark.parametrize("cut_off", CUT_OFF)
def test_every_axis_is_homed_once_and_only_where_no_interlock_forbids_it(cut_off: str) -> None:
    sensors, order = CUT_OFF[cut_off], []
    controller = opened(sensors)
    outputs = controller.react((Commanded(PackCommand.RESET),))
    while controller.status().state is PackState.RESETTING:
        (home,) = outputs.orders
        assert isinstance(home, Home)
        order.append(home.axis)
        sensors = moved(sensors, home.axis)
        outputs = controller.react((SensorsChanged(sensors, 0), Done(home, 0)))
        outputs = outputs if outputs.orders or not outputs.questions else controller.react(())
        if not outputs.orders:
            break
    assert sorted(order) == sorted(HOMED)
    before = {"a knot": ("grippers", "heads"), "a weft": ("shuttle", "shed"), "a beat": ("beater", "heads")}
    for first, then in [before[cut_off]] if cut_off in before else []:
        assert order.index(first) < order.index(then)
    if cut_off == "a weft":
        assert order.index("shed") < order.index("heads")


def test_while_a_gripper_is_closed_on_warps_nothing_else_moves() -> None:
    door = replace(CUT_OFF["a knot"], door_closed=False)
    limits = TensionLimits(5.0, 40.0)
    assert next_axis(set(), CUT_OFF["a knot"], limits) is LoomAxis.GRIPPERS
    blocked = next_axis(set(), door, limits)
    assert isinstance(blocked, Interlock)
    assert blocked.name == "door open"


@pytest.mark.parametrize("report", ["lies", "fails"])
def test_an_axis_that_is_not_at_its_switch_stops_the_loom_with_an_alarm(report: str) -> None:
    controller = opened(CUT_OFF["a knot"])
    (home,) = controller.react((Commanded(PackCommand.RESET),)).orders
    assert home == Home("grippers")
    controller.react((Done(home, 1) if report == "lies" else Failed(home, Fault.TIMEOUT, 1),))
    status = controller.status()
    assert (status.state, [alarm.kind.number for alarm in status.alarms]) == (PackState.STOPPED, [407])
    controller.react((Acknowledged(),))
    again = controller.react((Commanded(PackCommand.RESET),)).orders
    assert again == (Home("grippers"),)


def test_what_no_axis_can_leave_is_an_alarm_and_manual_mode_needs_no_homing() -> None:
    wedged = replace(READY, beater_back=False, heads_clear=False)
    controller = opened(wedged)
    outputs = controller.react((Commanded(PackCommand.RESET),))
    assert not outputs.orders
    status = controller.status()
    assert status.state is PackState.STOPPED
    assert 407 in [alarm.kind.number for alarm in status.alarms]
    controller.react((Acknowledged(), ModeChosen(PackMode.MANUAL)))
    reset = carried_out(controller, FakeLoom(), MemoryStore(), (Commanded(PackCommand.RESET),))
    assert not reset.orders
    assert controller.status().state is PackState.IDLE
    controller.react((ModeChosen(PackMode.PRODUCTION),))
    refused = controller.react((Commanded(PackCommand.START),)).refusals
    assert refused[0].given == "Start before the axes are at home"


def test_homing_is_in_the_journal_and_begins_anew_after_every_start() -> None:
    store, loom = MemoryStore(), FakeLoom()
    for start in (1, 2):
        controller = Controller(PROGRAMME, open_journal(store.read(), PROGRAMME, nonce=1))
        carried_out(controller, loom, store, (SensorsChanged(READY, 0), Commanded(PackCommand.RESET)))
        assert controller.status().state is PackState.IDLE
        opened_journal = journal_records(store.read())
        assert opened_journal is not None
        homed = [one.code for one in opened_journal[1] if one.kind == RecordKind.HOMED]
        assert sorted(homed) == sorted(list(range(len(LoomAxis))) * start)


@pytest.mark.parametrize("after", [1_000_000_000 * tenth // 10 for tenth in range(1, 60, 4)])
def test_the_simulated_loom_is_brought_home_wherever_it_was_halted(after: int) -> None:
    """Also from among the warps: grippers open, then the heads retreat; an axis that is at its switch takes no time."""
    plant = plant_model(PROGRAMME.setup, NO_FAULTS)
    controller = opened()
    state: PlantState = first_state(plant)
    orders: tuple[Order, ...] = tuple(
        order for head in range(2) if (order := controller.state.sequence.of_head(head)) is not None
    )
    state, _ = step(plant, state, orders, after)
    state, _ = step(plant, state, (Halt(),), 0)
    controller = opened(sensors_of(plant, state))
    outputs = controller.react((Commanded(PackCommand.RESET),))
    while outputs.orders:
        state, reports = step(plant, state, outputs.orders, 5_000_000_000)
        outputs = controller.react(reports)
    assert controller.state.homed == set(LoomAxis)
    assert sensors_of(plant, state).heads_clear
