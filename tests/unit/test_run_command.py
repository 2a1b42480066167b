"""`ilmek run`, `status`, `hold`, `resume`, `stop`: what a user sees, and what goes wrong."""

import errno
import json
import os
import random
import re
import signal
import threading
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner, Result
from processes import PATIENCE, ilmek, start, until
from small_programme import small_programme

from ilmek.cli import main
from ilmek.errors import LoomError
from ilmek.io.journal_file import SystemFile
from ilmek.io.programme_file import write_programme
from ilmek.jobs.run.loom_run import LoomRun
from ilmek.jobs.run.order import RunOrder
from ilmek.jobs.run.result import snapshot_json
from ilmek.jobs.status import run_status
from ilmek.loom.control.ports import Fault
from ilmek.loom.control.view import Snapshot
from ilmek.loom.twin.state import Injected, SensorFault

FAULTS = ("--faults", "7", *(f"--set={one}" for one in ("gripper_miss=0.05", "weft_break=0.05", "pile_break=1/m")))


@pytest.fixture(scope="session")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    made = tmp_path_factory.mktemp("programmes")
    write_programme(made / "carpet.ilmek", small_programme(6, 24, 2, 3))
    write_programme(made / "other.ilmek", small_programme(6, 24, 2, 3, seed=2))
    return made


@pytest.fixture
def carpet(folder: Path) -> Path:
    return folder / "carpet.ilmek"


def call(*line: object) -> Result:
    return CliRunner().invoke(main, [str(one) for one in line])


def as_json(*line: object, code: int = 0) -> dict[str, Any]:
    result = call(*line, "--json", "-")
    assert result.exit_code == code, result.output
    found: dict[str, Any] = json.loads(result.stdout)
    return found


def error(*line: object) -> str:
    result = call(*line)
    assert result.exit_code == 2, result.output
    assert result.stdout == ""
    assert result.stderr.count("\n") == 1
    return result.stderr


def test_a_carpet_is_woven_and_compared(carpet: Path, tmp_path: Path) -> None:
    found = as_json("run", carpet, "--journal", tmp_path / "j", "--speed", "max")
    assert (found["state"], found["knots"], found["faults"], found["begun"]) == ("Complete", 144, 0, 0)
    assert len(found["digest"]) == 64
    again = call("run", carpet, "--journal", tmp_path / "j", "--speed", "max")
    assert "is complete; --new begins another one" in again.stderr
    assert "144 of 144, equal to the chart" in again.stdout
    assert found["digest"] in again.stdout
    status = as_json("status", "--journal", tmp_path / "j")
    assert (status["state"], status["knots"], status["running"]) == ("Complete", 144, False)
    anew = as_json("run", carpet, "--journal", tmp_path / "j", "--speed", "max", "--new")
    assert (anew["begun"], anew["digest"], anew["time"]) == (0, found["digest"], found["time"])


def documented(heading: str) -> set[str]:
    page = (Path(__file__).parents[2] / "docs/reference/json.md").read_text(encoding="utf-8")
    section = page.partition(f"## `{heading}`\n")[2].partition("\n## ")[0]
    rows = re.findall(r"^\| ([a-z_, ]+) \| (?!meaning)[^|]* \| (?!meaning)", section, re.MULTILINE)
    return {name for row in rows for name in row.split(", ")} - {"name"}


def test_the_names_in_the_json_are_those_of_the_page(carpet: Path, tmp_path: Path) -> None:
    found = as_json("run", carpet, "--journal", tmp_path / "j", "--speed", "max")
    assert set(found) == documented("ilmek run FILE --json -")
    with LoomRun(RunOrder(carpet, tmp_path / "k")) as run:
        shown = snapshot_json(run.snapshot(), run.programme.setup)
    names = documented("ilmek status --journal DIR --json -")
    assert {*shown, "running", "process", "journal"} == names
    assert set(as_json("status", "--journal", tmp_path / "j")) - {"commit"} <= names


def test_the_journal_is_beside_the_programme_by_default(carpet: Path) -> None:
    assert RunOrder(carpet).folder == carpet.with_name("carpet.journal")


def test_faults_are_repaired(carpet: Path, tmp_path: Path) -> None:
    found = as_json("run", carpet, "--journal", tmp_path / "j", "--speed", "max", *FAULTS)
    assert found["repairs"] > 3
    assert (found["state"], found["faults"]) == ("Complete", 0)


@pytest.mark.parametrize(
    ("line", "message"),
    [
        (("--speed", "0x"), "--speed '0x'; a factor above 0 like 1000x"),
        (("--speed", "fast"), "--speed 'fast'"),
        (("--commit", "0"), "--commit 0; 1 to 10,000 knots"),
        (("--faults", "-1"), "a seed: a whole number"),
        (("--set", "gripper_miss=0.1"), "rates of faults without --faults; give a seed"),
        (("--faults", "7", "--set", "response=1min"), "--set response; rates of faults: pile_end, "),
        (("--operator", "me"), "--operator 'me'; auto, ask"),
    ],
)
def test_bad_options_are_refused(carpet: Path, line: tuple[str, str], message: str) -> None:
    assert message in error("run", carpet, *line)
    assert not carpet.with_name("carpet.journal").exists()


def test_journals_that_do_not_fit_are_refused(carpet: Path, tmp_path: Path) -> None:
    as_json("run", carpet, "--journal", tmp_path / "j", "--speed", "max")
    journal = tmp_path / "j" / "journal"
    content = journal.read_bytes()
    other = carpet.with_name("other.ilmek")
    assert "programme" in error("run", other, "--journal", tmp_path / "j")
    for offset in (3, 60, 500, len(content) // 2):
        damaged = bytearray(content)
        damaged[offset] ^= 4
        journal.write_bytes(damaged)
        assert "damaged" in error("run", carpet, "--journal", tmp_path / "j", "--speed", "max")
        assert journal.read_bytes() == damaged
    journal.write_bytes(content)
    (tmp_path / "j" / "woven").unlink()
    assert "journal but no carpet" in error("run", carpet, "--journal", tmp_path / "j", "--speed", "max")


def test_a_journal_cut_short_is_behind_its_carpet_and_nothing_is_tied_twice(carpet: Path, tmp_path: Path) -> None:
    first = as_json("run", carpet, "--journal", tmp_path / "j", "--speed", "max")
    journal = tmp_path / "j" / "journal"
    journal.write_bytes(journal.read_bytes()[:3000])
    found = as_json("run", carpet, "--journal", tmp_path / "j", "--speed", "max")
    assert (found["state"], found["faults"], found["digest"]) == ("Complete", 0, first["digest"])


def test_damaged_journals_are_refused_or_read(carpet: Path, tmp_path: Path) -> None:
    as_json("run", carpet, "--journal", tmp_path / "j", "--speed", "max")
    journal, chance = tmp_path / "j" / "journal", random.Random(4)
    content, read, refusals = journal.read_bytes(), 0, 0
    for _ in range(150):
        damaged = bytearray(content[: chance.choice((len(content), chance.randrange(1, len(content))))])
        for _ in range(chance.randrange(3)):
            at, wrong = chance.randrange(len(damaged)), chance.randbytes(chance.randrange(1, 40))
            damaged[at : at + len(wrong)] = wrong
        journal.write_bytes(damaged)
        try:
            found = run_status(tmp_path / "j")
        except LoomError:
            refusals += 1
        else:
            read += 1
            assert 0 <= found["knots"] <= 144
    assert min(read, refusals) > 20


def test_commands_without_a_controller(carpet: Path, tmp_path: Path) -> None:
    assert "has no journal" in error("status", "--journal", tmp_path)
    assert "has no journal" in error("hold", "--journal", tmp_path)
    as_json("run", carpet, "--journal", tmp_path / "j", "--speed", "max")
    for name in ("hold", "resume", "stop"):
        assert f"{name}: no controller runs" in error(name, "--journal", tmp_path / "j")


def test_commands_to_a_run(carpet: Path, tmp_path: Path) -> None:
    journal = tmp_path / "j"
    with LoomRun(RunOrder(carpet, journal, speed=50.0)) as run:
        seen: list[Snapshot] = []
        thread = threading.Thread(target=run.work, args=(seen.append,))
        thread.start()
        assert f"process {os.getpid()} weaves" in error("run", carpet, "--journal", journal)
        _until(run, "Execute")
        assert run.command("hold").ok
        _until(run, "Held")
        status = as_json("status", "--journal", journal)
        assert (status["running"], status["state"], status["process"]) == (True, "Held", os.getpid())
        assert status["yarns"][0]["left"] > 0
        assert "hold is refused: Hold in state Held" in error("hold", "--journal", journal)
        assert "no command 'fly'" in run.command("fly").reason
        assert as_json("resume", "--journal", journal)["state"] in ("Execute", "Held", "Unholding")
        _until(run, "Execute")
        assert call("stop", "--journal", journal).exit_code == 0
        thread.join(PATIENCE)
        assert not thread.is_alive()
        assert not run.result().ok
    assert as_json("status", "--journal", journal)["state"] == "Stopped"
    assert as_json("run", carpet, "--journal", journal, "--speed", "max")["faults"] == 0


def _until(run: LoomRun, state: str) -> None:
    until(lambda: run.snapshot().state == state, f"the state {state}")


def test_a_person_is_asked_what_the_sensor_cannot_tell(carpet: Path, tmp_path: Path) -> None:
    with LoomRun(RunOrder(carpet, tmp_path / "j", speed=None, operator=False)) as run:
        run.port.act(Injected(Fault.TIMEOUT, 2, 3), SensorFault("knotted", None))
        thread = threading.Thread(target=run.work)
        thread.start()
        _until(run, "Held")
        found = as_json("status", "--journal", tmp_path / "j")
        assert "operation not finished in time, row 3" in found["alarms"][0]["cause"]
        assert run.command("yes").reason == "the controller asks nothing"
        assert not run.command("unhold").ok
        assert run.command("acknowledge").ok
        assert run.command("unhold").ok
        _until(run, "Unholding")
        assert "is the knot of row 3 on warp pair 4 tied" in run.snapshot().requests[0]
        assert "asks" in call("status", "--journal", tmp_path / "j").stdout
        assert call("resume", "--journal", tmp_path / "j", "--answer", "no").exit_code == 0
        thread.join(PATIENCE)
        assert not thread.is_alive()
        assert run.result().ok


def test_a_run_waits_for_room_on_the_disc(carpet: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("ilmek.jobs.run.loom_run._RETRY", 0.0)
    write, calls, alarms = SystemFile.write, [0], set()

    def full(self: SystemFile, data: bytes, offset: int) -> int:
        calls[0] += 1
        if calls[0] == 30:
            return write(self, data[:10], offset)
        if 30 < calls[0] < 40:
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
        return write(self, data, offset)

    def show(snapshot: Snapshot) -> None:
        alarms.update(one.name for one in snapshot.alarms)

    monkeypatch.setattr(SystemFile, "write", full)
    monkeypatch.setattr("ilmek.jobs.run.loom_run.INTERVAL", 0.0)
    with LoomRun(RunOrder(carpet, tmp_path / "j", speed=None)) as run:
        run.work(show)
        found = run.result()
    assert calls[0] > 40
    assert "disc full" in alarms
    assert (found.state, found.faults, found.snapshot.knots) == ("Complete", 0, 144)


def test_a_carpet_whose_journal_is_lost_is_found_by_its_sensors(carpet: Path, tmp_path: Path) -> None:
    journal = tmp_path / "j"
    with LoomRun(RunOrder(carpet, journal, speed=None)) as run:
        run.work(lambda now: run.stop() if now.knots >= 30 else None)
    (journal / "journal").write_bytes(b"")
    with LoomRun(RunOrder(carpet, journal, speed=None)) as run:
        run.work()
        found = run.result()
    assert (found.state, found.faults, found.snapshot.knots) == ("Complete", 0, 144)


def test_a_server_goes_on_after_a_carpet(carpet: Path, tmp_path: Path) -> None:
    after: list[int] = []
    with LoomRun(RunOrder(carpet, tmp_path / "j", speed=None, serves=True)) as run:

        def show(snapshot: Snapshot) -> None:
            if snapshot.state == "Complete":
                after.append(snapshot.knots)
            if len(after) == 2:
                run.stop()

        run.work(show)
    assert after[:2] == [144, 144]


def test_a_run_that_is_killed_goes_on(carpet: Path, tmp_path: Path) -> None:
    journal = tmp_path / "j" / "journal"
    with start(ilmek("run", carpet, "--speed", "20x", "--journal", tmp_path / "j")) as process:
        until(lambda: journal.exists() and journal.stat().st_size >= 1000, "the journal")
        process.send_signal(signal.SIGKILL)
        assert process.wait(PATIENCE) == -signal.SIGKILL
    begun = as_json("status", "--journal", tmp_path / "j")
    assert begun["state"] == "Stopped"
    assert begun["uncertain"] >= 2
    found = as_json("run", carpet, "--journal", tmp_path / "j", "--speed", "max")
    assert found["begun"] >= begun["knots"] > 0
    assert (found["state"], found["faults"]) == ("Complete", 0)


def test_a_carpet_is_drawn_while_it_is_woven_and_at_the_end(carpet: Path, tmp_path: Path) -> None:
    journal = tmp_path / "j"
    run = call("run", carpet, "--journal", journal, "--speed", "max", "--picture", tmp_path / "run.png")
    assert run.exit_code == 0, run.output
    assert f"picture: {tmp_path / 'run.png'}" in run.stdout
    line = ["status", "--journal", journal, "--picture", tmp_path / "status.png"]
    assert "give it with --programme" in error(*line)
    shown = call(*line, "--programme", carpet)
    assert shown.exit_code == 0, shown.output
    assert (tmp_path / "status.png").read_bytes() == (tmp_path / "run.png").read_bytes()
    assert "another programme" in error(*line, "--force", "--programme", carpet.with_name("other.ilmek"))
    assert "--picture carpet.svg ends in '.svg'" in error(
        "run", carpet, "--journal", journal, "--picture", "carpet.svg"
    )


def test_a_recorded_run_is_replayed(carpet: Path, tmp_path: Path) -> None:
    recording = tmp_path / "run.txt"
    line = ["--journal", tmp_path / "j", "--speed", "max", *FAULTS]
    assert f"recording: {recording}" in call("run", carpet, *line, "--record", recording).stdout
    found = as_json("replay", recording, carpet)
    assert (found["ok"], found["knots"], found["begin"]) == (True, 144, 0.0)
    assert found["failures"] > 0
    assert found["digest"] == found["recorded"]
    assert "the recorded run" in call("replay", recording, carpet).stdout
    recording.write_text(recording.read_text().replace("0 power", "0 tension 0", 1))
    changed = as_json("replay", recording, carpet, code=3)
    assert changed["digest"] != changed["recorded"]
    assert "NOT the recorded run" in call("replay", recording, carpet).stdout
    assert "another programme" in error("replay", recording, carpet.with_name("other.ilmek"))
    assert "does not exist" in error("replay", tmp_path / "none.txt", carpet)


def test_rows_that_were_taken_out_are_woven_again(carpet: Path, tmp_path: Path) -> None:
    """Also in the middle of a row, and after the carpet is complete; the journal counts what is on the loom."""
    run = LoomRun(RunOrder(carpet, tmp_path / "j", speed=None))
    with run:
        run.work(lambda snapshot: run.stop() if snapshot.knots >= 80 else None)
    found = as_json("status", "--journal", tmp_path / "j")
    row = found["row"] - (found["state"] != "Complete")  # in work; where it stops depends on the machine's speed
    back = 0 if row == 4 else 1  # the packages were changed before row 5
    order = RunOrder(carpet, tmp_path / "j", speed=None, start=False, serves=True, rows_back=back)
    with LoomRun(order) as run:
        assert run.snapshot().row == row - back
        assert run.snapshot().knots == run.begun == 24 * (row - back)
        assert [run.woven.counts(number).any() for number in range(6)] == [number < row - back for number in range(6)]
    found = as_json("status", "--journal", tmp_path / "j")
    assert (found["row"], found["knots"]) == (row - back + 1, 24 * (row - back))
    found = as_json("run", carpet, "--journal", tmp_path / "j", "--speed", "max")
    assert (found["state"], found["knots"], found["faults"]) == ("Complete", 144, 0)
    assert "rows back in row 7; 0 (the row in work alone) to" in error(
        "run", carpet, "--journal", tmp_path / "j", "--speed", "max", "--rows-back", 20
    )
    assert "--rows-back 21; 0 to 20" in error("run", carpet, "--speed", "max", "--rows-back", 21)


def test_a_loom_that_serves_is_moved_by_hand_and_takes_rows_back(carpet: Path, tmp_path: Path) -> None:
    with LoomRun(RunOrder(carpet, tmp_path / "j", speed=None, start=False, serves=True)) as run:
        work = threading.Thread(target=run.work)
        work.start()
        journal = ("--journal", tmp_path / "j")
        assert "Stopped" in call("mode", "manual", *journal).output
        for command in ("reset", "start"):
            assert run.command(command).ok
        assert run.snapshot().state == "Execute"
        assert call("jog", "carriage", "20mm", *journal).exit_code == 0
        assert "up to 0.05 m" in error("jog", "carriage", "80mm", *journal)
        assert "wrong unit" in error("jog", "beater", "2mm", *journal)
        assert "allowed in Stopped" in run.command("rows-back 0").reason
        assert "the mode changes in" in error("mode", "production", *journal)
        assert run.command("stop").ok
        until(lambda: run.snapshot().state == "Stopped")
        assert run.command("rows-back 0").ok
        assert not run.command("rows-back 1").ok
        run.stop()
        work.join(PATIENCE)
