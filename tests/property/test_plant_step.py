"""Laws of the plant: a step in parts is the step, a recorded run replays, and nothing is woven but what is reported."""

import tempfile
from collections.abc import Sequence
from dataclasses import astuple
from pathlib import Path

import pytest
from effort import examples
from hypothesis import given, settings
from hypothesis import strategies as st
from plant_driver import weave
from small_programme import small_programme

from ilmek.drivers.twin_port import TwinPort
from ilmek.errors import LoomError
from ilmek.io.recording_file import read_recording, recording_text
from ilmek.loom.control.ports import ChangePackages, Done, EndRow, Failed, Fault, Jog, Tie
from ilmek.loom.operations import RowEnd, Stop, TubeChange
from ilmek.loom.twin.draws import draw
from ilmek.loom.twin.model import FaultRates, plant_model
from ilmek.loom.twin.random import word
from ilmek.loom.twin.recording import Recorder, Recording, replay
from ilmek.loom.twin.state import (
    Door,
    EmergencyStop,
    Halt,
    Injected,
    PackageChanged,
    PlantInput,
    PlantState,
    PowerOn,
    Repaired,
    SensorFault,
    SetSpeed,
    Tension,
    first_state,
)
from ilmek.loom.twin.step import step
from ilmek.loom.twin.woven import Woven, state_words, woven_size

PROGRAMME = small_programme(4, 12, 2, 3)
RATES = FaultRates(5, pile_end=0.02, pile_break=0.05, missed_grip=0.1, weft_break=0.1, weft_end=0.05, warp_break=0.05)
PLANT = plant_model(PROGRAMME.setup, RATES)

_ROWS, _COLUMNS = st.integers(0, 3), st.integers(0, 11)
_ENDS = st.sampled_from(RowEnd)
_SENSORS = st.sampled_from(
    ["door_closed", "emergency_stop", "warp_tension", "grippers_open 1", "heads_clear", "knotted"]
)
_STOPS = st.builds(
    Stop,
    _ROWS,
    st.just(0),
    st.lists(st.integers(0, 1), max_size=2).map(tuple),
    st.lists(
        st.builds(
            TubeChange, st.integers(0, 1), st.integers(0, 2), st.integers(0, 2), st.sampled_from([0.0, 0.1, 7.5])
        ),
        max_size=2,
    ).map(tuple),
)
INPUTS: st.SearchStrategy[PlantInput] = st.one_of(
    st.builds(Tie, st.integers(0, 1), _ROWS, st.integers(0, 5), _COLUMNS, st.integers(0, 2)),
    st.builds(EndRow, _ROWS, _ENDS),
    st.builds(ChangePackages, _STOPS),
    st.builds(PackageChanged, _STOPS),
    st.builds(
        Jog, st.sampled_from(["grippers", "gripper 1", "heads", "beater", "shed"]), st.sampled_from([-0.01, 0.01])
    ),
    st.builds(Door, st.booleans()),
    st.builds(EmergencyStop, st.booleans()),
    st.builds(Tension, st.booleans()),
    st.builds(Injected, st.sampled_from(Fault), _ROWS, st.integers(-1, 11), st.none() | _ENDS),
    st.builds(SensorFault, _SENSORS, st.one_of(st.none(), st.booleans())),
    st.builds(SetSpeed, st.integers(1, 1000)),
    st.sampled_from([Repaired(), PowerOn(), Halt()]),
)
DURATIONS = st.integers(0, 90_000_000_000)


def taken(state: PlantState, inputs: Sequence[PlantInput]) -> tuple[PlantState, list[PlantInput]]:
    """The state behind those inputs that the loom can carry out, and these."""
    done = []
    for one in inputs:
        try:
            state, _ = step(PLANT, state, [one], 0)
        except LoomError:
            continue
        done.append(one)
    return state, done


@examples(100)
@given(st.lists(st.tuples(st.lists(INPUTS, max_size=4), DURATIONS, DURATIONS), max_size=6))
def test_a_step_in_two_parts_is_the_step(steps: list[tuple[list[PlantInput], int, int]]) -> None:
    state = first_state(PLANT)
    for inputs, first, second in steps:
        _, possible = taken(state, inputs)
        whole, reports = step(PLANT, state, possible, first + second)
        middle, before = step(PLANT, state, possible, first)
        end, after = step(PLANT, middle, (), second)
        assert end == whole
        assert before + after == reports
        assert [one.time for one in reports] == sorted(one.time for one in reports)
        state = whole


@examples(100)
@given(st.lists(st.tuples(INPUTS, DURATIONS), max_size=25))
def test_inputs_of_one_time_act_alike_together_and_one_by_one(steps: list[tuple[PlantInput, int]]) -> None:
    state = first_state(PLANT)
    alone, possible = taken(state, [one for one, _ in steps])
    together, _ = step(PLANT, state, possible, 0)
    assert together == alone


def woven_in_memory() -> Woven:
    woven = Woven(PROGRAMME.setup, bytearray(woven_size(PROGRAMME.setup)))
    woven.keep(first_state(PLANT))
    return woven


@pytest.mark.parametrize("seed", range(4))
def test_a_run_with_faults_weaves_every_knot_once_and_replays_from_its_file(seed: int, tmp_path: Path) -> None:
    rates = FaultRates(seed, 0.02, 0.05, 0.1, 0.1, 0.05, 0.05)
    woven = woven_in_memory()
    recorder = Recorder(PROGRAMME, rates, first_state(PLANT))
    port = TwinPort(PROGRAMME.setup, woven, rates=rates, record=recorder)
    reports = list(weave(port, PROGRAMME, cure=lambda _: port.act(Repaired())))
    assert sum(isinstance(one, Failed) for one in reports) > 3
    done = [one.order for one in reports if isinstance(one, Done)]
    assert len(done) == len(set(map(str, map(order_key, done))))
    assert all(woven.counts(row).tolist() == [1] * 12 and woven.ends(row).tolist() == [1] * 5 for row in range(4))
    (tmp_path / "run.txt").write_text(recording_text(recorder.recording(port.state)))
    states = list(replay(read_recording(tmp_path / "run.txt"), PROGRAMME))
    assert states[-1][0] == port.state
    assert [one for _, some in states for one in some] == reports


def order_key(order: object) -> tuple[object, ...]:
    return tuple(getattr(order, name) for name in ("row", "column", "operation") if hasattr(order, name))


@settings(max_examples=20)
@given(st.lists(st.tuples(DURATIONS, INPUTS), max_size=20))
def test_a_recording_is_read_as_it_was_written(inputs: list[tuple[int, PlantInput]]) -> None:
    recording = Recording(PROGRAMME.digest, RATES, state_words(first_state(PLANT)), tuple(inputs), 7, "ab" * 32)
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "run.txt"
        path.write_text(recording_text(recording))
        assert astuple(read_recording(path)) == astuple(recording)


@given(st.integers(0, 2**62), st.integers(0, 2**62), st.integers(0, 2**62))
def test_a_draw_is_the_word_of_the_kernels(seed: int, stream: int, ordinal: int) -> None:
    assert draw(seed, stream, ordinal) == word(seed, stream, ordinal)
