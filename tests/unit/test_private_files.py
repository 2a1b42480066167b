"""The cache folder: only where nobody else can write, only whole entries of the user, never larger than its bound."""

import os
import time
from pathlib import Path

import pytest
from processes import PATIENCE, python, start

from ilmek.num import private_files
from ilmek.num.private_files import DamagedEntryError, private_folder, prune, read_entry, write_entry

NOBODY = 65534
as_root = pytest.mark.skipif(os.name != "posix" or os.geteuid() != 0, reason="only root gives folders away")


@pytest.fixture
def cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    return tmp_path / "cache"


def made(name: str = "kernels") -> Path:
    folder = private_folder(name)
    assert folder is not None
    return folder


def test_the_folder_is_made_closed_to_others(cache):
    assert made() == cache / "ilmek" / "kernels"
    assert [one.stat().st_mode & 0o777 for one in (cache, cache / "ilmek", made())] == [0o700] * 3


@pytest.mark.parametrize("mode", [0o755, 0o720, 0o701, 0o777])
def test_a_folder_open_to_others_is_not_used(cache, mode):
    made().chmod(mode)
    assert private_folder("kernels") is None


@pytest.mark.parametrize(("mode", "used"), [(0o777, False), (0o1777, True), (0o755, True), (0o702, False)])
def test_a_folder_above_that_others_can_write_is_not_trusted_unless_sticky(cache, mode, used):
    made()
    cache.chmod(mode)
    assert (private_folder("kernels") is not None) == used


@as_root
@pytest.mark.parametrize("above", [0, 1, 2])
def test_a_folder_of_someone_else_is_not_trusted(cache, above):
    folder = made()
    os.chown((folder, *folder.parents)[above], NOBODY, -1)
    assert private_folder("kernels") is None


@as_root
def test_a_group_of_others_that_can_write_is_not_trusted(cache):
    made()
    os.chown(cache, -1, NOBODY)
    cache.chmod(0o770)
    assert private_folder("kernels") is None


def test_a_folder_that_is_a_link_is_not_used(cache, tmp_path):
    made().rename(tmp_path / "elsewhere")
    (cache / "ilmek" / "kernels").symlink_to(tmp_path / "elsewhere")
    assert private_folder("kernels") is None


def test_a_link_above_is_followed_where_its_target_is_trusted(cache, tmp_path):
    (tmp_path / "disc" / "inner").mkdir(parents=True)
    cache.symlink_to(Path("disc", "inner"))
    assert private_folder("kernels") is not None
    (tmp_path / "disc").chmod(0o777)
    assert private_folder("kernels") is None


@pytest.mark.parametrize("kind", ["file", "no folder", "loop", "too long"])
def test_a_cache_home_that_cannot_be_used_is_not_used(tmp_path, monkeypatch, kind):
    (tmp_path / "file").touch()
    (tmp_path / "loop").symlink_to(tmp_path / "loop")
    homes = {"file": "file", "no folder": "file/below", "loop": "loop", "too long": "x" * 5000}
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / homes[kind]))
    assert private_folder("kernels") is None


@pytest.mark.parametrize("given", [None, "", "relative/folder"])
def test_without_an_absolute_cache_home_it_is_in_the_home_folder(tmp_path, monkeypatch, given):
    monkeypatch.setenv("HOME", str(tmp_path))
    monkeypatch.delenv("XDG_CACHE_HOME", raising=False)
    if given is not None:
        monkeypatch.setenv("XDG_CACHE_HOME", given)
    assert made() == tmp_path / ".cache" / "ilmek" / "kernels"


def test_without_a_home_there_is_no_folder(monkeypatch):
    def unknown() -> Path:
        raise RuntimeError("Could not determine home directory.")

    monkeypatch.delenv("XDG_CACHE_HOME", raising=False)
    monkeypatch.setattr(Path, "home", unknown)
    assert private_folder("kernels") is None


def test_an_entry_is_read_as_written(cache):
    path = made() / "a.kernel"
    assert read_entry(path) is None
    write_entry(path, b"machine code")
    assert read_entry(path) == b"machine code"
    assert [one.name for one in path.parent.iterdir()] == ["a.kernel"]


@pytest.mark.parametrize("damage", ["cut", "empty", "changed", "link", "pipe", "open", "large"])
def test_an_entry_that_is_not_whole_or_not_the_users_is_damaged(cache, monkeypatch, damage):
    path, other = made() / "a.kernel", made() / "b.kernel"
    write_entry(path, b"machine code")
    whole = path.read_bytes()
    if damage in ("cut", "empty", "changed"):
        path.write_bytes({"cut": whole[:-1], "empty": b"", "changed": whole[:-1] + b"!"}[damage])
    elif damage in ("link", "pipe"):
        path.rename(other)
        path.symlink_to(other) if damage == "link" else os.mkfifo(path)
    elif damage == "open":
        path.chmod(0o622)
    else:
        monkeypatch.setattr(private_files, "LARGEST_ENTRY", len(whole) - 1)
    with pytest.raises(DamagedEntryError):
        read_entry(path)


@as_root
def test_an_entry_of_someone_else_is_damaged(cache):
    path = made() / "a.kernel"
    write_entry(path, b"machine code")
    os.chown(path, NOBODY, -1)
    with pytest.raises(DamagedEntryError):
        read_entry(path)


def test_a_full_disc_is_no_error_and_leaves_nothing(cache, monkeypatch):
    path = made() / "a.kernel"

    def full(*_: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(Path, "replace", full)
    write_entry(path, b"machine code")
    assert list(path.parent.iterdir()) == []


def test_an_entry_too_large_is_not_written(cache, monkeypatch):
    monkeypatch.setattr(private_files, "LARGEST_ENTRY", 40)
    write_entry(made() / "a.kernel", b"machine code")
    assert list(made().iterdir()) == []


def aged(path: Path, days: float, size: int = 10) -> Path:
    path.parent.mkdir(exist_ok=True)
    path.write_bytes(bytes(size))
    os.utime(path, (time.time() - days * 86400,) * 2)
    return path


def test_unused_entries_and_what_interrupted_runs_left_are_removed(cache):
    folder = made()
    kept = {aged(folder / "new.kernel", 0), aged(folder / "used.kernel", 80), aged(folder / "tmpabc", 0)}
    gone = {aged(folder / "old.kernel", 91), aged(folder / "tmpdef", 0.1), aged(folder / "module" / "a.kernel", 91)}
    prune(folder)
    assert set(folder.iterdir()) == kept
    assert not any(one.exists() for one in gone)


def test_beyond_its_bound_the_folder_loses_what_was_unused_for_longest(cache, monkeypatch):
    monkeypatch.setattr(private_files, "LARGEST_FOLDER", 1000)
    for days in range(5):
        aged(made() / f"{days}.kernel", days, 300)
    prune(made())
    assert sorted(one.name for one in made().iterdir()) == ["0.kernel", "1.kernel", "2.kernel"]


def test_a_use_is_noted_once_a_day(cache):
    path = made() / "a.kernel"
    write_entry(path, b"machine code")
    for days, noted in ((0.5, False), (2.0, True)):
        os.utime(path, (time.time() - days * 86400,) * 2)
        read_entry(path)
        assert (time.time() - path.stat().st_mtime < 60) == noted


def test_a_folder_is_pruned_once_in_a_run(cache):
    folder = made()
    write_entry(folder / "a.kernel", b"machine code")
    old = aged(folder / "old.kernel", 91)
    write_entry(folder / "b.kernel", b"machine code")
    assert old.exists()


def test_two_processes_at_once_keep_whole_entries(cache):
    script = (
        "import sys\nfrom ilmek.num.private_files import private_folder, read_entry, write_entry\n"
        "path = private_folder('kernels') / 'a.kernel'\n"
        "for turn in range(300):\n    write_entry(path, sys.argv[1].encode() * 1000 * turn)\n    read_entry(path)\n"
    )
    with start(python("-c", script, "warp")) as warp, start(python("-c", script, "weft")) as weft:
        assert [run.communicate(timeout=PATIENCE)[1] for run in (warp, weft)] == ["", ""]
    assert read_entry(made() / "a.kernel") in (b"warp" * 299000, b"weft" * 299000)
    assert len(list(made().iterdir())) == 1
