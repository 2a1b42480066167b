"""An output folder or file is there whole, or not at all."""

import contextlib
import errno
import os
import sqlite3
import stat
from collections.abc import Iterator
from pathlib import Path

import pytest

from ilmek.errors import OutputError
from ilmek.io.output import MANIFEST, Outputs, disk, manifest, write_file
from ilmek.io.output.staging import repair


def listing(folder: Path) -> list[str]:
    return sorted(str(path.relative_to(folder)) for path in folder.rglob("*"))


@contextlib.contextmanager
def output_folder(path: Path, *, force: bool = False) -> Iterator[Path]:
    with Outputs(force=force) as outputs, outputs.folder(path) as work:
        yield work


def check_free(path: Path, *, force: bool = False) -> None:
    Outputs(force=force).expect_folder(path)


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
        write_file(work / "deep/a.json", "x")
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
    with pytest.raises(OutputError, match=r"did not write: thesis\.txt"):
        make(tmp_path / "out", "b", force=True)
    assert (tmp_path / "out/thesis.txt").read_text() == "years of work"


def test_a_foreign_file_that_comes_meanwhile_is_kept(tmp_path: Path) -> None:
    make(tmp_path / "out", "a")
    with pytest.raises(OutputError, match=r"did not write: late\.txt"), output_folder(tmp_path / "out", force=True):
        (tmp_path / "out/late.txt").write_text("late")
    assert listing(tmp_path) == ["out", f"out/{MANIFEST}", "out/a", "out/late.txt"]


def test_old_folder_survives_a_failed_run_with_force(tmp_path: Path) -> None:
    make(tmp_path / "out", "a")
    with pytest.raises(KeyboardInterrupt), output_folder(tmp_path / "out", force=True):
        raise KeyboardInterrupt
    assert listing(tmp_path) == ["out", f"out/{MANIFEST}", "out/a"]


@pytest.mark.parametrize("atomic", [True, False])
def test_old_folder_is_put_back_where_the_new_one_cannot_be(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, atomic: bool
) -> None:
    make(tmp_path / "out", "a")
    rename = disk.rename

    def failing(source: Path, target: Path) -> None:
        if source.suffix == ".part":
            raise OSError(errno.EIO, "Input/output error")
        rename(source, target)

    def exchanging(first: Path, second: Path) -> bool:
        if atomic:
            raise OSError(errno.EIO, "Input/output error")
        return False

    monkeypatch.setattr(disk, "rename", failing)
    monkeypatch.setattr(disk, "exchange", exchanging)
    with pytest.raises(OutputError, match="Input/output error; nothing was written; the old one is kept"):
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
    write_file(file, "old")

    def failing(_path: Path) -> None:
        raise OSError(errno.ENOSPC, "No space left on device")

    with monkeypatch.context() as patched:
        patched.setattr(disk, "sync", failing)
        with pytest.raises(OutputError, match="No space left"):
            write_file(file, "new")
    assert file.read_text() == "old"
    write_file(file, b"new")
    assert file.read_text() == "new"
    assert listing(tmp_path) == ["a.json"]


def test_file_through_a_link_and_to_a_device(tmp_path: Path) -> None:
    (tmp_path / "real").write_text("old")
    (tmp_path / "link").symlink_to("real")
    write_file(tmp_path / "link", "new")
    assert (tmp_path / "link").is_symlink()
    assert (tmp_path / "real").read_text() == "new"
    write_file(Path("/dev/null"), "gone")
    assert stat.S_ISCHR(Path("/dev/null").stat().st_mode)


def test_file_that_cannot_be_written(tmp_path: Path) -> None:
    with pytest.raises(OutputError, match="is a folder"):
        write_file(tmp_path, "x")
    with pytest.raises(OutputError, match="there is no folder"):
        write_file(tmp_path / "missing/a.json", "x")


def leave(place: Path, name: str) -> Path:
    """A folder as a killed run leaves it."""
    folder = place.parent / name
    folder.mkdir(parents=True)
    (folder / "half").write_text("half")
    manifest.begin(folder)
    return folder


def test_what_a_killed_run_left_is_removed_by_the_next(tmp_path: Path) -> None:
    leave(tmp_path / "out", ".out.0123abcd.part")
    make(tmp_path / "out", "a")
    leave(tmp_path / "out", ".out.4567abcd.old")
    make(tmp_path / "out", "b", force=True)
    assert listing(tmp_path) == ["out", f"out/{MANIFEST}", "out/b"]


def test_the_longest_names_are_taken(tmp_path: Path) -> None:
    for name in ("x" * 255, "ç" * 127):
        make(tmp_path / name, "a")
        make(tmp_path / name, "b", force=True)
        assert (tmp_path / name / "b").read_text() == "b"


def test_a_run_that_lives_keeps_its_folder(tmp_path: Path) -> None:
    with output_folder(tmp_path / "out") as work:
        (work / "a").write_text("a")
        repair(tmp_path / "out")
        assert (work / "a").read_text() == "a"
    assert (tmp_path / "out/a").read_text() == "a"


def test_only_what_is_surely_left_over_is_removed(tmp_path: Path) -> None:
    kept = [
        leave(tmp_path / "out", name)
        for name in (".out.part", ".out.0123abcd.part.bak", ".other.0123abcd.part", ".out.0123ABCD.part", "out.0.part")
    ]
    (tmp_path / ".out.99999999.part").write_text("a file")
    (tmp_path / ".out.88888888.part").symlink_to(kept[0])
    repair(tmp_path / "out")
    assert all((folder / "half").exists() for folder in kept)
    assert (tmp_path / ".out.99999999.part").exists()
    assert (tmp_path / ".out.88888888.part").is_symlink()


@pytest.mark.parametrize("whole", [True, False])
def test_a_swap_that_was_cut_off_is_completed_or_undone(tmp_path: Path, whole: bool) -> None:
    for name in ("new", "old"):
        make(tmp_path / name, name)
    if not whole:
        (tmp_path / "new/new").write_text("cut off")
    (tmp_path / "new").rename(tmp_path / ".out.0123abcd.part")
    (tmp_path / "old").rename(tmp_path / ".out.0123abcd.old")
    repair(tmp_path / "out")
    found = listing(tmp_path)
    if whole:
        assert found == ["out", f"out/{MANIFEST}", "out/new"]
    else:  # what matches no manifest is kept, where it can be seen
        kept = ["out.0123abcd.kept", f"out.0123abcd.kept/{MANIFEST}", "out.0123abcd.kept/new"]
        assert found == sorted(["out", f"out/{MANIFEST}", "out/old", *kept])


def test_links_in_a_circle(tmp_path: Path) -> None:
    (tmp_path / "loop").symlink_to(tmp_path / "loop")
    for path in (tmp_path / "loop", tmp_path / "loop/out"):
        with pytest.raises(OutputError, match=r"circle|is not a folder"):
            check_free(path)
        with pytest.raises(OutputError, match=r"circle|no folder"):
            write_file(path, "x")
    assert listing(tmp_path) == ["loop"]
