"""An output folder or file is there whole, or not at all."""

import errno
import os
import sqlite3
import stat
from pathlib import Path

import pytest

from ilmek.errors import OutputError
from ilmek.io.output import MANIFEST, check_free, output_folder, write_whole


def listing(folder: Path) -> list[str]:
    return sorted(str(path.relative_to(folder)) for path in folder.rglob("*"))


def make(path: Path, *names: str, force: bool = False) -> None:
    with output_folder(path, force=force) as work:
        for name in names:
            (work / name).write_text(name)


def test_folder_appears_at_the_end(tmp_path: Path) -> None:
    with output_folder(tmp_path / "out") as work:
        (work / "a").write_text("a")
        assert not (tmp_path / "out").exists()
    assert listing(tmp_path) == ["out", f"out/{MANIFEST}", "out/a"]


def test_parents_are_made_and_taken_away_again(tmp_path: Path) -> None:
    make(tmp_path / "one/two/out", "a")
    assert (tmp_path / "one/two/out/a").read_text() == "a"
    with pytest.raises(ZeroDivisionError), output_folder(tmp_path / "three/four/out"):
        raise ZeroDivisionError
    assert listing(tmp_path / "one") == ["two", "two/out", f"two/out/{MANIFEST}", "two/out/a"]
    assert not (tmp_path / "three").exists()


def fail_inside(path: Path, failure: BaseException) -> None:
    with output_folder(path) as work:
        (work / "half").write_text("half")
        raise failure


@pytest.mark.parametrize("interruption", [KeyboardInterrupt, SystemExit, ValueError, MemoryError])
def test_nothing_is_left_after_an_interruption(tmp_path: Path, interruption: type[BaseException]) -> None:
    with pytest.raises(interruption):
        fail_inside(tmp_path / "out", interruption())
    assert listing(tmp_path) == []


@pytest.mark.parametrize(
    "failure", [OSError(errno.ENOSPC, "No space left on device"), sqlite3.OperationalError("database or disk is full")]
)
def test_full_disk_is_one_sentence(tmp_path: Path, failure: Exception) -> None:
    with pytest.raises(OutputError, match=r"out cannot be written: .*(space|full)"):
        fail_inside(tmp_path / "out", failure)
    assert listing(tmp_path) == []


def test_a_file_in_the_folder_is_called_by_its_place(tmp_path: Path) -> None:
    with (
        pytest.raises(OutputError, match=r"^\S*/out/deep/a\.json cannot be written"),
        output_folder(tmp_path / "out") as work,
    ):
        write_whole(work / "deep/a.json", "x")
    assert listing(tmp_path) == []


def test_existing_folder_is_refused_without_force(tmp_path: Path) -> None:
    make(tmp_path / "out", "a")
    with pytest.raises(OutputError, match="exists.*--force"), output_folder(tmp_path / "out"):
        pass
    assert listing(tmp_path) == ["out", f"out/{MANIFEST}", "out/a"]


def test_force_replaces_what_ilmek_made(tmp_path: Path) -> None:
    make(tmp_path / "out", "a", "b")
    make(tmp_path / "out", "c", force=True)
    assert listing(tmp_path) == ["out", f"out/{MANIFEST}", "out/c"]


def test_force_replaces_an_empty_folder(tmp_path: Path) -> None:
    (tmp_path / "out").mkdir()
    make(tmp_path / "out", "a", force=True)
    assert (tmp_path / "out/a").exists()


@pytest.mark.parametrize("made_by_ilmek", [True, False])
def test_force_never_loses_a_foreign_file(tmp_path: Path, made_by_ilmek: bool) -> None:
    if made_by_ilmek:
        make(tmp_path / "out", "a")
    (tmp_path / "out").mkdir(exist_ok=True)
    (tmp_path / "out/thesis.txt").write_text("years of work")
    with pytest.raises(OutputError, match=r"did not make: thesis\.txt"):
        make(tmp_path / "out", "b", force=True)
    assert (tmp_path / "out/thesis.txt").read_text() == "years of work"


def test_a_foreign_file_that_comes_meanwhile_is_kept(tmp_path: Path) -> None:
    make(tmp_path / "out", "a")
    with pytest.raises(OutputError, match=r"did not make: late\.txt"), output_folder(tmp_path / "out", force=True):
        (tmp_path / "out/late.txt").write_text("late")
    assert listing(tmp_path) == ["out", f"out/{MANIFEST}", "out/a", "out/late.txt"]


def test_old_folder_survives_a_failed_run_with_force(tmp_path: Path) -> None:
    make(tmp_path / "out", "a")
    with pytest.raises(KeyboardInterrupt), output_folder(tmp_path / "out", force=True):
        raise KeyboardInterrupt
    assert listing(tmp_path) == ["out", f"out/{MANIFEST}", "out/a"]


def test_old_folder_is_put_back_where_the_last_rename_fails(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    make(tmp_path / "out", "a")
    rename = Path.rename

    def failing(self: Path, target: Path) -> Path:
        if self.suffix == ".part":
            raise OSError(errno.EIO, "Input/output error")
        return rename(self, target)

    monkeypatch.setattr(Path, "rename", failing)
    with pytest.raises(OutputError, match="Input/output error"):
        make(tmp_path / "out", "b", force=True)
    assert listing(tmp_path) == ["out", f"out/{MANIFEST}", "out/a"]


def test_places_that_cannot_be(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "file").write_text("a file")
    with pytest.raises(OutputError, match="is not a folder"):
        check_free(tmp_path / "file", force=True)
    with pytest.raises(OutputError, match=r"file is not a folder"):
        check_free(tmp_path / "file/out")
    monkeypatch.chdir(tmp_path)
    with pytest.raises(OutputError, match="the folder you are in"):
        check_free(Path(), force=True)
    monkeypatch.setattr(os, "access", lambda *_: False)
    with pytest.raises(OutputError, match="not writable"):
        check_free(tmp_path / "out")


def test_file_is_replaced_only_when_complete(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    file = tmp_path / "a.json"
    write_whole(file, "old")

    def failing(_self: Path, _data: bytes) -> int:
        raise OSError(errno.ENOSPC, "No space left on device")

    with monkeypatch.context() as patched:
        patched.setattr(Path, "write_bytes", failing)
        with pytest.raises(OutputError, match="No space left"):
            write_whole(file, "new")
    assert file.read_text() == "old"
    write_whole(file, b"new")
    assert file.read_text() == "new"
    assert listing(tmp_path) == ["a.json"]


def test_file_through_a_link_and_to_a_device(tmp_path: Path) -> None:
    (tmp_path / "real").write_text("old")
    (tmp_path / "link").symlink_to("real")
    write_whole(tmp_path / "link", "new")
    assert (tmp_path / "link").is_symlink()
    assert (tmp_path / "real").read_text() == "new"
    write_whole(Path("/dev/null"), "gone")
    assert stat.S_ISCHR(Path("/dev/null").stat().st_mode)


def test_file_that_cannot_be_written(tmp_path: Path) -> None:
    with pytest.raises(OutputError, match="is a folder"):
        write_whole(tmp_path, "x")
    with pytest.raises(OutputError, match="there is no folder"):
        write_whole(tmp_path / "missing/a.json", "x")
