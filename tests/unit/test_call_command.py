"""`ilmek call`: steps with the keys of a terminal, goes on where it was killed, prints rows into a pipe."""

import json
import os
import pty
import re
import select
import signal
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner
from processes import PATIENCE, python, start

from ilmek.carpet.calling import CallStep, count_text, row_steps
from ilmek.carpet.cells import CellKind, CellMap
from ilmek.carpet.chart import Chart
from ilmek.carpet.overlay import HALF, JUFTI, KnotMark, overlay_of
from ilmek.carpet.quality import Quality
from ilmek.carpet.sizes import CarpetSize
from ilmek.carpet.yarn import Yarn
from ilmek.cli import main
from ilmek.cli.call_screen import colour_depth, screen_lines, swatch
from ilmek.cli.keys import keys_of
from ilmek.cli.large_figures import large
from ilmek.errors import ParameterError
from ilmek.io.call_state import DamagedStateError, chart_digest, read_state, state_file
from ilmek.io.chart.oxs import write_chart_oxs
from ilmek.io.chart.png import write_chart_png
from ilmek.io.output import disk
from ilmek.io.yarn_file import default_yarns
from ilmek.jobs.call import Calling, begin_calling

KNOTS = np.array([[0, 0, 1, 1, 2], [0, 1, 1, 1, 1], [2, 2, 2, 2, 2]], dtype=np.uint8)
YARNS = tuple(Yarn(name, (n, 90, 200), (0.0, 0.0, 0.0), 4.0) for n, name in enumerate(("madder", "indigo", "ivory")))
CHART = Chart(KNOTS, YARNS, CarpetSize(0.05, 0.03), Quality(100.0, 100.0), "symmetric")
MARKED = replace(CHART, overlay=overlay_of([KnotMark(0, 0, HALF, 2), KnotMark(0, 2, JUFTI)]))


@pytest.fixture(autouse=True)
def own_state(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))
    return


@pytest.fixture
def chart_file(tmp_path: Path) -> Path:
    write_chart_png(tmp_path / "chart.png", CHART)
    return tmp_path / "chart.png"


def test_steps_of_a_row_in_the_order_of_reading() -> None:
    steps = row_steps(MARKED, 3, "runs", "left")
    assert steps == (
        CallStep(1, 0, 2, 0, ("1",)),
        CallStep(1, JUFTI, 1, 0, ("2-3",)),
        CallStep(1, 0, 0, 0, ("4",)),
        CallStep(1, HALF, 2, 0, ("5",)),
    )
    assert [count_text(step) for step in steps] == ["1", "1j", "1", "1½"]
    assert row_steps(MARKED, 3, "colours", "alternate") == (
        CallStep(2, 0, 0, 0, ("1L", "2")),
        CallStep(1, 0, 1, 0, ("3-4j",)),
        CallStep(2, 0, 2, 0, ("1R", "5")),
    )
    assert row_steps(CHART, 2, "colours", "alternate")[0] == CallStep(1, 0, 0, 0, ("5",))


def test_moves_stay_in_the_chart() -> None:
    calling = begin_calling(CHART, "runs", "right", keep=False)
    calling.back()
    assert (calling.row, calling.step) == (1, 0)
    seen = []
    while not calling.done:
        seen.append((calling.row, calling.step))
        calling.forward()
    assert seen == [(1, 0), (2, 0), (2, 1), (3, 0), (3, 1), (3, 2)]
    calling.forward()
    calling.next_row()
    assert calling.row == 4
    calling.back()
    assert (calling.row, calling.step) == (3, 2)
    calling.row_before()
    calling.row_before()
    assert (calling.row, calling.step) == (2, 0)


def test_a_call_goes_on_where_the_last_one_stopped(tmp_path: Path) -> None:
    calling = begin_calling(CHART, "runs", "right")
    for _ in range(3):
        calling.forward()
        calling.remember()
    again = begin_calling(CHART, "runs", "right")
    assert (again.row, again.step) == (3, 0)
    assert "--from-row 1 begins anew" in again.notes[0]
    again.forward()
    again.remember()
    assert (begin_calling(CHART, "runs", "right").step, begin_calling(CHART, "colours", "right").step) == (1, 0)
    assert begin_calling(CHART, "runs", "right", 2).row == 2
    assert begin_calling(MARKED, "runs", "right").row == 1
    again.next_row()
    again.remember()
    finished = begin_calling(CHART, "runs", "right")
    assert (finished.row, finished.notes) == (1, ["all rows were called: the call begins with row 1"])
    assert [path.suffix for path in (tmp_path / "state/ilmek/call").iterdir()] == [".json"]


@pytest.mark.parametrize(
    "text",
    [
        "",
        "{",
        "[]",
        "\x00" * 5000,
        '{"version": 1}',
        '{"version": 1, "row": 0, "step": 0, "by": "runs", "direction": "right"}',
        '{"version": 1, "row": true, "step": 0, "by": "runs", "direction": "right"}',
        '{"version": 1, "row": 1, "step": -1, "by": "runs", "direction": "right"}',
        '{"version": 1, "row": 1e9, "step": 0, "by": "runs", "direction": "right"}',
        '{"version": 2, "row": 1, "step": 0, "by": "runs", "direction": "right"}',
        "[" * 1500,
    ],
)
def test_a_damaged_state_begins_with_row_1(text: str) -> None:
    path = state_file(CHART)
    path.parent.mkdir(parents=True)
    path.write_text(text, encoding="utf-8")
    with pytest.raises(DamagedStateError):
        read_state(path, 3)
    calling = begin_calling(CHART, "runs", "right")
    assert (calling.row, calling.step) == (1, 0)
    assert "is damaged: the call begins with row 1" in calling.notes[0]
    calling.forward()
    calling.remember()
    assert begin_calling(CHART, "runs", "right").row == 2


def test_a_state_is_on_the_disk_before_it_takes_its_name(monkeypatch: pytest.MonkeyPatch) -> None:
    path, calls = state_file(CHART), []
    path.parent.mkdir(parents=True)
    (path.parent / f".{path.stem}.1.part").write_text("half a st", encoding="utf-8")
    for name in ("write", "sync", "replace"):
        real = getattr(disk, name)
        monkeypatch.setattr(
            disk, name, lambda *given, name=name, real=real: (calls.append((name, given[0])), real(*given))
        )
    calling = begin_calling(CHART, "runs", "right")
    calling.remember()
    new = path.with_name(f".{path.stem}.{os.getpid()}.part")
    assert calls == [("write", new), ("sync", new), ("replace", new), ("sync", path.parent)]
    assert list(path.parent.iterdir()) == [path]


def test_a_state_that_cannot_be_kept_is_noted_once(tmp_path: Path) -> None:
    (tmp_path / "state").write_text("a file", encoding="utf-8")
    calling = begin_calling(CHART, "runs", "right")
    calling.remember()
    calling.remember()
    assert len(calling.notes) == 1
    assert "not remembered" in calling.notes[0]


@pytest.mark.parametrize("row", [0, -1, 4, 10**12])
def test_a_row_outside_of_the_chart_is_refused(row: int, chart_file: Path) -> None:
    with pytest.raises(ParameterError, match="rows 1 to 3"):
        begin_calling(CHART, "runs", "right", row)
    result = CliRunner().invoke(main, ["call", str(chart_file), "--from-row", str(row)])
    assert result.exit_code == 2
    assert f"--from-row {row}; rows 1 to 3" in result.stderr


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["rows.txt"], "is no knot chart"),
        (["missing.png"], "missing.png"),
        (["chart.png", "--by", "colour"], "did you mean 'colours'?"),
        (["chart.png", "--direction", "up"], "right, left, alternate"),
    ],
)
def test_bad_input_is_one_line(words: list[str], said: str, chart_file: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(chart_file.parent)
    Path("rows.txt").write_text("no chart", encoding="utf-8")
    result = CliRunner().invoke(main, ["call", *words])
    assert result.exit_code == 2
    assert result.stderr.count("\n") == 1
    assert said in result.stderr


def test_into_a_pipe_rows_are_printed_plainly(chart_file: Path) -> None:
    result = CliRunner().invoke(main, ["call", str(chart_file), "--from-row", "2"])
    assert result.exit_code == 0
    assert result.stdout == "A madder\nB indigo\nC ivory\nrow 2 → 1 A, 4 B\nrow 3 → 2 A, 2 B, 1 C\n"
    result = CliRunner().invoke(main, ["call", str(chart_file), "--by", "colours", "--direction", "left"])
    assert result.stdout.endswith("row 2 ← 1 A: 5, 4 B: 1-4\nrow 3 ← 2 A: 4-5, 2 B: 2-3, 1 C: 1\n")
    assert not state_file(CHART).exists()


def test_an_oxs_chart_is_called_with_its_overlay(tmp_path: Path) -> None:
    for write, name in ((write_chart_oxs, "chart.oxs"), (write_chart_png, "chart.png")):
        write(tmp_path / name, MARKED)
        result = CliRunner().invoke(main, ["call", str(tmp_path / name), "--from-row", "3"])
        assert result.stdout.endswith("row 3 → 1½ AC, 1 A, 1j B, 1 C\n"), result.stderr


def test_screens_keep_the_width_and_show_the_step() -> None:
    calling = Calling(MARKED, "runs", "right", 3)
    for width in (20, 80):
        for _ in range(3):
            lines = list(screen_lines(calling, 0, width))
            assert max(map(len, lines)) <= width
            assert all(line.isprintable() for line in lines)
            calling.forward()
        calling.row_before()
    lines = list(screen_lines(calling, 1 << 24, 80))
    assert "madder" in "\n".join(lines)
    assert "\x1b[48;2;0;90;200m" in "\n".join(lines)
    assert large("8") != large("3")
    assert len(set(map(len, large("12½")))) == 1


def test_colours_of_a_terminal() -> None:
    assert colour_depth({"TERM": "xterm", "COLORTERM": "truecolor"}) == 1 << 24
    assert colour_depth({"TERM": "xterm", "COLORTERM": "truecolor", "NO_COLOR": "1"}) == 0
    assert colour_depth({}) == colour_depth({"TERM": "dumb"}) == colour_depth({"TERM": "vt100"}) == 0
    assert swatch((255, 0, 0), 2, 256) == "\x1b[48;5;196m  \x1b[0m"
    assert swatch((255, 0, 0), 2, 0) == ""


def test_unknown_keys_do_nothing() -> None:
    assert list(keys_of(b"x\x1b[Zz\xff")) == []
    assert list(keys_of(b"\r\x7f\x1bOCP")) == ["next", "back", "next", "row before"]


ON_A_TERMINAL = """
import fcntl, runpy, termios
fcntl.ioctl(0, termios.TIOCSCTTY, 0)
runpy.run_module("ilmek", run_name="__main__", alter_sys=True)
"""
"""ilmek, whose input is the terminal that sends it signals."""


class Session:
    """`ilmek call` on a terminal of its own."""

    def __init__(self, process: Any, terminal: int) -> None:
        self.process, self.terminal, self.shown = process, terminal, b""

    def wait_for(self, text: str, last: str = "q end") -> str:
        """The screen, once it has a text and its last line."""
        end = time.monotonic() + PATIENCE
        while text not in (screen := self._screen()) or last not in screen:
            assert time.monotonic() < end, screen
            if select.select([self.terminal], [], [], 0.2)[0]:
                try:
                    self.shown += os.read(self.terminal, 65536)
                except OSError:  # the child has ended
                    assert text in self.shown.decode("utf-8", "replace")
                    break
        return screen

    def _screen(self) -> str:
        return self.shown.split(b"\x1b[H\x1b[2J")[-1].decode("utf-8", "replace")

    def press(self, keys: bytes) -> None:
        os.write(self.terminal, keys)

    def end(self, number: int | None = None) -> int:
        """The exit code, after a signal or by itself."""
        if number is not None:
            self.process.send_signal(number)
        return int(self.process.wait(PATIENCE))


@contextmanager
def session(file: Path, *words: str, **changes: str) -> Iterator[Session]:
    terminal, inner = pty.openpty()
    changes = {"TERM": "xterm-256color", "COLORTERM": "truecolor", **changes}
    command = python("-c", ON_A_TERMINAL, "call", file, *words)
    try:
        with start(command, changes=changes, stdin=inner, stdout=inner, stderr=inner) as process:
            os.close(inner)
            yield Session(process, terminal)
    finally:
        os.close(terminal)


def test_a_killed_call_goes_on_at_its_step(chart_file: Path) -> None:
    with session(chart_file, "--from-row", "2") as first:
        first.wait_for("Row 2 of 3 →   step 1 of 2")
        first.press(b" ")
        screen = first.wait_for("step 2 of 2")
        assert "indigo" in screen
        assert "then the next row" in screen
        first.press(b"n\r")
        first.wait_for("Row 3 of 3 →   step 2 of 3")
        assert first.end(signal.SIGKILL) == -signal.SIGKILL
    with session(chart_file, NO_COLOR="1") as again:
        screen = again.wait_for("Row 3 of 3 →   step 2 of 3")
        assert "\x1b[4" not in screen
        again.press(b"\x1b[D")
        again.wait_for("step 1 of 3")
        again.press(b"q")
        again.wait_for("note: goes on at row 3, step 2")
        assert again.end() == 0
    assert json.loads(state_file(CHART).read_text(encoding="utf-8"))["step"] == 0


def test_an_interrupt_keeps_the_step_and_the_terminal(chart_file: Path) -> None:
    with session(chart_file, PYTHONIOENCODING="ascii") as shown:
        assert "##" in shown.wait_for("Row 1 of 3 >")
        shown.press(b"n")
        shown.wait_for("Row 2 of 3")
        shown.press(b"\x03")
        shown.wait_for("interrupted; the last step is kept")
        assert shown.end() == 130
        assert re.search(rb"step 1 of 2", shown.shown)
    assert begin_calling(CHART, "runs", "right").row == 2


def test_what_is_tied_otherwise_has_another_digest() -> None:
    """Size, density, pile and loops belong to the carpet as knots and colours do."""
    knots = np.zeros((4, 4), np.uint8)
    plain = Chart(knots, default_yarns()[:2], "4x4cm", "10x10/dm", "symmetric")
    larger = Chart(knots, default_yarns()[:2], "8x8cm", "5x5/dm", "symmetric")
    piles = [
        replace(plain, cells=CellMap(knots, (kind,)))
        for kind in (CellKind("a", height=0.006), CellKind("a", loop=True))
    ]
    assert len({chart_digest(chart) for chart in (plain, larger, *piles)}) == 4
    assert chart_digest(plain) == chart_digest(replace(plain, reading=replace(plain.reading, reason="read again")))
