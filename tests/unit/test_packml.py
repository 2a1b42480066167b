"""The state model of ISA-TR88.00.02, against the transitions that OPC 30050 lists by name."""

from itertools import pairwise

import pytest

from ilmek.loom.control.packml import (
    COMPLETED,
    MODE_CHANGES,
    MODE_STATES,
    PACK_TAGS,
    TRANSITIONS,
    PackCommand,
    PackMode,
    PackState,
    Refusal,
    allowed_commands,
    commanded,
    mode_refused,
    state_name,
)

EXECUTE_MACHINE = (
    ("Idle", "Starting", "Execute", "Completing", "Complete", "Resetting", "Idle"),
    ("Execute", "Holding", "Held", "Unholding", "Execute"),
    ("Execute", "Suspending", "Suspended", "Unsuspending", "Execute"),
    ("Unholding", "Holding"),
    ("Starting", "Holding"),
    ("Suspending", "Holding"),
    ("Suspended", "Holding"),
    ("Unsuspending", "Holding"),
)
"""Paths through PackMLExecuteStateMachineType: each step is one of its transitions, and it has no other."""
BASE = (("Stopped", "Resetting"), ("Stopping", "Stopped"), ("Aborting", "Aborted", "Clearing", "Stopped"))
WAITING = {PackState[name] for name in ("STOPPED", "IDLE", "SUSPENDED", "ABORTED", "HELD", "COMPLETE")}
UNSTOPPABLE = {PackState.STOPPING, PackState.STOPPED, PackState.ABORTING, PackState.ABORTED, PackState.CLEARING}


def pairs() -> set[tuple[PackState, PackState]]:
    """Every step from a state to another, by command or by completion."""
    return {(state, after) for (state, _), after in TRANSITIONS.items()} | set(COMPLETED.items())


def test_there_are_17_states_with_the_numbers_of_pack_tags() -> None:
    assert [one.value for one in PackState] == list(range(1, 18))
    assert (PackState.STOPPED, PackState.EXECUTE, PackState.HELD, PackState.COMPLETE) == (2, 6, 11, 17)


def test_transitions_are_those_of_the_standard() -> None:
    paths = [[PackState[name.upper()] for name in path] for path in (*EXECUTE_MACHINE, *BASE)]
    expected = {step for path in paths for step in pairwise(path)}
    expected |= {(state, PackState.STOPPING) for state in set(PackState) - UNSTOPPABLE}
    expected |= {(state, PackState.ABORTING) for state in set(PackState) - {PackState.ABORTING, PackState.ABORTED}}
    assert pairs() == expected


def test_every_state_acts_or_waits() -> None:
    assert set(COMPLETED) == set(PackState) - WAITING
    assert all(allowed_commands(PackMode.PRODUCTION, state) for state in WAITING)


@pytest.mark.parametrize("mode", PackMode)
def test_every_state_of_a_mode_is_reached_and_left(mode: PackMode) -> None:
    states = MODE_STATES[mode]
    steps = {(before, after) for before, after in pairs() if before in states and after in states}
    for start in states:
        met, pending = {start}, [start]
        while pending:
            now = pending.pop()
            following = {after for before, after in steps if before == now} - met
            met |= following
            pending += following
        missing = {PackState.COMPLETING} & states if mode is PackMode.MANUAL else set()
        assert met | missing == states, (mode, start)


@pytest.mark.parametrize("mode", PackMode)
def test_every_command_in_every_state_is_carried_out_or_refused_with_what_is_allowed(mode: PackMode) -> None:
    for state in MODE_STATES[mode]:
        for command in PackCommand:
            found = commanded(mode, state, command)
            if command in allowed_commands(mode, state):
                assert found in MODE_STATES[mode]
            else:
                assert isinstance(found, Refusal)
                assert command.name.capitalize() in found.given
                assert state_name(state) in found.given
                assert all(one.name.capitalize() in found.allowed for one in allowed_commands(mode, state))


def test_the_mode_changes_where_nothing_moves_and_every_mode_has_the_state() -> None:
    assert all(states >= MODE_CHANGES for states in MODE_STATES.values())
    assert MODE_CHANGES <= WAITING
    assert mode_refused(PackMode.MANUAL, PackState.IDLE) is None
    refused = mode_refused(PackMode.MANUAL, PackState.EXECUTE)
    assert refused is not None
    assert refused.text == "manual mode in state Execute; the mode changes in Stopped, Idle, Aborted"


def test_tags_are_named_once_and_by_the_three_groups_of_the_standard() -> None:
    names = [one.name for one in PACK_TAGS]
    assert len(names) == len(set(names))
    assert {name.partition(".")[0] for name in names} == {"Command", "Status", "Admin"}
