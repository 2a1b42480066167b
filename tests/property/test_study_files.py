"""Results files of studies: the same bits however they come about; designs that fail, hang or end their process."""

import sqlite3
from collections.abc import Callable
from concurrent.futures import Future
from contextlib import nullcontext
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from study_targets import FunctionTarget

from ilmek.errors import OutputError, ParameterError
from ilmek.progress import Cancelled, Progress
from ilmek.studies.outcome import Outcome, Question
from ilmek.studies.recorder import DesignRecorder
from ilmek.studies.samples import sampled
from ilmek.studies.store import StudyFile
from ilmek.studies.variable import Variable
from ilmek.studies.workers import Design, Workers

VARIABLES = (Variable("x", "mm", 0.5, 1.0, 0.6), Variable("y", "", 0.0, 2.0, 0.0, choices=("a", "b", "c")))


def carried_out(path: Path, count: int = 700, *, workers: int = 1, stop: float = 2.0, function: str = "bad") -> str:
    """A study in a file, stopped at a share of its designs; its digest."""
    shares: list[float] = []
    progress = Progress(lambda _, share: shares.append(share), lambda: bool(shares) and shares[-1] > stop)
    question = Question(FunctionTarget(function), ("f",), time_limit=0.2)
    with StudyFile(path, {"study": function}, ["x", "y"], ["f"]) as file, Workers(question, workers) as running:
        recorder = DesignRecorder(file, VARIABLES, running, count, progress)
        try:
            recorder(sampled(VARIABLES, "sobol", count, 3))
        except Cancelled:
            return "cancelled"
        return file.digest()


@settings(max_examples=5, deadline=None)
@given(stops=st.lists(st.floats(0.01, 0.99), min_size=1, max_size=3).map(sorted))
def test_a_study_that_goes_on_has_the_same_file_bit_for_bit(
    tmp_path_factory: pytest.TempPathFactory, stops: list[float]
) -> None:
    folder = tmp_path_factory.mktemp("study")
    whole = carried_out(folder / "whole.sqlite")
    for stop in stops:
        assert carried_out(folder / "parts.sqlite", stop=stop) in ("cancelled", whole)
    assert carried_out(folder / "parts.sqlite") == whole
    assert (folder / "parts.sqlite").read_bytes() == (folder / "whole.sqlite").read_bytes()


@pytest.mark.parametrize("batches", [[1, 15, 16, 8], [256, 256, 100]])
def test_how_often_a_file_is_opened_leaves_no_trace(tmp_path: Path, batches: list[int]) -> None:
    """Batches of an optimiser are small: they change no size of the file, and SQLite counts changes otherwise there."""
    outcome = Outcome("done", "", (1.0,), {"check": 1.0}, 0)

    def written(path: Path, sessions: list[list[int]]) -> bytes:
        for session in sessions:
            with StudyFile(path, {}, ["x"], ["f"]) as file:
                for count in session:
                    file.append(np.zeros((count, 1)), [outcome] * count)
        check = sqlite3.connect(path)
        assert check.execute("PRAGMA integrity_check").fetchone() == ("ok",)
        check.close()
        return path.read_bytes()

    once = written(tmp_path / "once.sqlite", [batches])
    assert written(tmp_path / "often.sqlite", [[], *([count] for count in batches), []]) == once


def test_workers_write_the_same_file(tmp_path: Path) -> None:
    first = carried_out(tmp_path / "one.sqlite", 100)
    assert carried_out(tmp_path / "two.sqlite", 100, workers=2) == first
    assert (tmp_path / "one.sqlite").read_bytes() == (tmp_path / "two.sqlite").read_bytes()


def test_a_transaction_that_was_cut_off_is_taken_back(tmp_path: Path) -> None:
    """As after a power cut: a journal with the pages before the last transaction lies beside the file."""
    whole = carried_out(tmp_path / "whole.sqlite")
    carried_out(tmp_path / "cut.sqlite", stop=0.5)
    base = sqlite3.connect(tmp_path / "cut.sqlite", isolation_level=None)
    base.execute("BEGIN IMMEDIATE")
    base.execute("DELETE FROM design WHERE id > 10")
    base.close()
    assert carried_out(tmp_path / "cut.sqlite") == whole


@pytest.mark.parametrize("workers", [1, 2])
def test_designs_that_cannot_be_made_are_rows_with_their_reason(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, workers: int
) -> None:
    if workers > 1:
        monkeypatch.setenv("ILMEK_STUDY_DIES", "1")
    question = Question(FunctionTarget("bad"), ("f",), time_limit=0.1)
    points = np.array([[x, 0.0] for x in (0.1, 0.25, 0.35, 0.45, 0.7, 0.9)])
    with StudyFile(tmp_path / "s.sqlite", {}, ["x", "y"], ["f"]) as file, Workers(question, workers) as running:
        rows = DesignRecorder(file, VARIABLES, running, len(points))(points)
        statuses = {status: reason for status, reason, _ in file.reasons()}
    assert statuses.keys() == {"refused", "fault", "timeout"} | ({"died"} if workers > 1 else set())
    assert (statuses["refused"], statuses["fault"]) == ("cannot close", "ZeroDivisionError: a fault")
    assert rows.made.tolist() == [False, False, False, workers == 1, True, True]
    assert rows.feasible.tolist()[-2:] == [True, False]
    assert np.isnan(rows.results[:3]).all()


def test_a_row_takes_at_most_200_bytes(tmp_path: Path) -> None:
    carried_out(tmp_path / "s.sqlite", 4096)
    assert (tmp_path / "s.sqlite").stat().st_size / 4096 < 200


def test_files_of_others_are_refused(tmp_path: Path) -> None:
    carried_out(tmp_path / "s.sqlite", 10)
    with pytest.raises(ParameterError, match="another study: its study is"):
        carried_out(tmp_path / "s.sqlite", 10, function="stack")
    (tmp_path / "text.sqlite").write_text("no database, but long enough to be read as its header" * 30)
    with pytest.raises(OutputError, match="not a database"):
        carried_out(tmp_path / "text.sqlite", 10)
    with StudyFile(tmp_path / "t.sqlite", {}, ["x"], ["f"]) as file:
        assert len(file) == 0
        with pytest.raises(OutputError, match="locked"):
            StudyFile(tmp_path / "t.sqlite", {}, ["x"], ["f"])


def test_a_file_with_other_designs_is_refused(tmp_path: Path) -> None:
    carried_out(tmp_path / "s.sqlite", 10)
    base = sqlite3.connect(tmp_path / "s.sqlite")
    base.execute("UPDATE design SET x = 0.75 WHERE id = 3")
    base.commit()
    base.close()
    with pytest.raises(ParameterError, match="other designs"):
        carried_out(tmp_path / "s.sqlite", 10)


def test_a_cluster_that_goes_away_is_an_error_that_keeps_what_is_there(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    class Leaving(nullcontext[None]):
        """A client whose cluster answers for the designs of a first block alone."""

        left = 256

        def __enter__(self) -> "Leaving":  # type: ignore[override]
            return self

        def get_executor(self, *, pure: bool) -> "Leaving":
            assert not pure
            return self

        def submit(self, function: Callable[..., list[Outcome]], question: Question, designs: list[Design]) -> Any:
            answer: Future[list[Outcome]] = Future()
            self.left -= len(designs)
            if self.left >= 0:
                answer.set_result(function(question, designs))
            else:
                answer.set_exception(OSError("the scheduler is closed"))
            return answer

    monkeypatch.setattr("ilmek.studies.workers.cluster_client", lambda _: Leaving())
    question = Question(FunctionTarget("stack"), ("gap",))
    points = sampled(VARIABLES[:1], "sobol", 300, 3)
    with StudyFile(tmp_path / "s.sqlite", {}, ["x"], ["gap"]) as file:
        with (
            Workers(question, cluster="tcp://there") as running,
            pytest.raises(ParameterError, match=r"go on with --resume"),
        ):
            DesignRecorder(file, VARIABLES[:1], running, 300)(points)
        assert len(file) == 256


def test_a_cluster_that_computes_twice_and_in_another_order_gives_the_same_file(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A scheduler asks again where a worker was lost, and what it hears first may be the later block."""
    asked: list[Callable[[], None]] = []

    class Asked(Future[list[Outcome]]):
        def result(self, timeout: float | None = None) -> list[Outcome]:
            while asked:
                asked.pop()()
            return super().result(timeout)

    class Twice(nullcontext[None]):
        def __enter__(self) -> "Twice":  # type: ignore[override]
            return self

        def get_executor(self, *, pure: bool) -> "Twice":
            assert not pure
            return self

        def submit(self, function: Callable[..., list[Outcome]], question: Question, designs: list[Design]) -> Asked:
            answer = Asked()
            function(question, designs)
            asked.append(lambda: answer.set_result(function(question, designs)))
            return answer

    monkeypatch.setattr("ilmek.studies.workers.cluster_client", lambda _: Twice())
    points = sampled(VARIABLES[:1], "sobol", 300, 3)
    for name, cluster in (("here", None), ("there", "tcp://there")):
        with (
            StudyFile(tmp_path / name, {}, ["x"], ["gap"]) as file,
            Workers(Question(FunctionTarget("stack"), ("gap",)), cluster=cluster) as running,
        ):
            DesignRecorder(file, VARIABLES[:1], running, 300)(points)
            assert len(file) == 300
    assert (tmp_path / "here").read_bytes() == (tmp_path / "there").read_bytes()


def test_a_full_disc_is_an_error_that_keeps_what_is_there(tmp_path: Path) -> None:
    path = tmp_path / "s.sqlite"
    carried_out(path, 10)
    with StudyFile(path, {"study": "bad"}, ["x", "y"], ["f"]) as file:
        file._base.execute(f"PRAGMA max_page_count = {file._base.execute('PRAGMA page_count').fetchone()[0]}")
        points = np.full((5000, 2), 0.7)
        with Workers(Question(FunctionTarget("bad"), ("f",))) as running, pytest.raises(OutputError, match="full"):
            DesignRecorder(file, VARIABLES, running, 1)(np.vstack([sampled(VARIABLES, "sobol", 10, 3), points]))
        assert len(file) % 256 == 10
