"""A recording that was changed is refused, with the line."""

from pathlib import Path

import pytest
from small_programme import small_programme

from ilmek.errors import LoomError
from ilmek.io.recording_file import read_recording, recording_text
from ilmek.loom.control.ports import Tie
from ilmek.loom.twin.model import NO_FAULTS, plant_model
from ilmek.loom.twin.recording import Recorder, replay
from ilmek.loom.twin.state import Halt, PowerOn, first_state
from ilmek.loom.twin.step import step

PROGRAMME = small_programme(3, 12, 2, 3)


@pytest.fixture
def path(tmp_path: Path) -> Path:
    """A recording of a knot that is halted."""
    plant = plant_model(PROGRAMME.setup)
    recorder, state = Recorder(PROGRAMME, NO_FAULTS, first_state(plant)), first_state(plant)
    for one, dt in ((PowerOn(), 0), (Tie(1, 0, 0, 6, 0), 10**9), (Halt(), 5)):
        recorder(state.time, one)
        state, _ = step(plant, state, [one], dt)
    (tmp_path / "run.txt").write_text(recording_text(recorder.recording(state)))
    return tmp_path / "run.txt"


def test_the_file_is_lines_of_words(path: Path) -> None:
    lines = path.read_text().splitlines()
    assert lines[0] == "ilmek recording 1"
    assert lines[4:7] == ["0 power", "0 tie 1 0 0 6 0", "1000000000 halt"]
    assert [state.time for state, _ in replay(read_recording(path), PROGRAMME)] == [0, 10**9, 10**9 + 5]


@pytest.mark.parametrize(
    ("old", "new", "wrong"),
    [
        ("ilmek recording 1", "ilmek recording 2", "no recording"),
        ("0 power", "0 explode", "line 5: 'explode' is no input"),
        ("0 power", "-1 power", "line 5: '-1'"),
        ("0 power", "0 sensor heads_clear nan", "line 5: 'nan'"),
        ("0 power", "0 jog a/b 3", "line 5: 'a/b'"),
        ("0 power", "0 change 1 0 1 0 0 0", "line 5: a change of packages"),
        ("0 power", "0 inject flood 0 0 -", "line 5: fault 'flood'"),
        ("tie 1 0 0 6 0", "tie 1 0 0 6", "line 6"),
        ("tie 1 0 0 6 0", f"tie 1 0 0 6 {10**30}", "line 6"),
        ("rates 0", "rates -1", "line 3"),
        ("0.0", "1e999", "line 3"),
        ("programme ", "programme x", "line 2"),
        ("\nend", "\nending", "line 8"),
    ],
)
def test_a_line_that_is_no_input_is_named(path: Path, old: str, new: str, wrong: str) -> None:
    path.write_text(path.read_text().replace(old, new, 1))
    with pytest.raises(LoomError, match=wrong):
        read_recording(path)


@pytest.mark.parametrize(
    ("old", "new", "wrong"),
    [
        ("0 tie 1 0 0 6 0", "0 tie 1 0 0 99 0", "column 99"),
        ("0 tie 1 0 0 6 0", "0 tie 1 0 0 6 0\n0 tie 1 0 0 7 0", "head 1 is given an order"),
        ("0 power", "2000000000 power", "behind one"),
        ("start 0", "start -5", "time -5"),
        ("start 0 ", "start 0 0 ", "a state of"),
    ],
)
def test_a_recording_of_what_no_loom_can_do_is_refused(path: Path, old: str, new: str, wrong: str) -> None:
    path.write_text(path.read_text().replace(old, new, 1))
    with pytest.raises(LoomError, match=wrong):
        list(replay(read_recording(path), PROGRAMME))
    with pytest.raises(LoomError, match="another programme"):
        list(replay(read_recording(path), small_programme(3, 12, 2, 3, seed=9)))


@pytest.mark.parametrize(
    ("old", "new"), [("1000000000 halt", "900000000 halt"), ("0 power\n", ""), ("6 0\n1000000000 halt", "6 0")]
)
def test_a_recording_that_was_changed_has_another_digest(path: Path, old: str, new: str) -> None:
    path.write_text(path.read_text().replace(old, new, 1))
    recording = read_recording(path)
    *_, (state, _) = replay(recording, PROGRAMME)
    assert state.digest.hex() != recording.digest
