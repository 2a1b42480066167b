"""The journal's file: durable after a sync, whole after a failed write, its folder locked for one controller."""

import os
import random
from pathlib import Path

import pytest
from losing_disc import LosingDisc
from processes import ended, python

from ilmek.errors import IlmekError, LoomError, OutputError
from ilmek.io.journal_file import JournalFile
from ilmek.io.journal_folder import JournalFolder, journal_bytes, running_process


def test_what_is_appended_is_read(tmp_path: Path) -> None:
    with JournalFolder(tmp_path / "j") as folder:
        folder.journal.append(b"one")
        folder.journal.append(b"two")
        folder.journal.sync()
    with JournalFolder(tmp_path / "j") as folder:
        assert folder.journal.read() == b"onetwo"
        folder.journal.truncate(4)
        folder.journal.append(b"!")
    assert journal_bytes(tmp_path / "j") == b"onet!"
    assert {one.name for one in (tmp_path / "j").iterdir()} == {"journal", "lock"}
    assert (tmp_path / "j").stat().st_mode & 0o777 == 0o700
    assert (tmp_path / "j" / "journal").stat().st_mode & 0o777 == 0o600


def test_a_second_controller_is_refused_with_the_process(tmp_path: Path) -> None:
    with JournalFolder(tmp_path / "j"):
        assert running_process(tmp_path / "j") == os.getpid()
        with pytest.raises(LoomError, match=f"process {os.getpid()} weaves"):
            JournalFolder(tmp_path / "j")
    assert running_process(tmp_path / "j") is None


def test_the_lock_ends_with_its_process(tmp_path: Path) -> None:
    code = "import sys, os; from pathlib import Path; from ilmek.io.journal_folder import JournalFolder\n"
    code += f"JournalFolder(Path({str(tmp_path / 'j')!r})); os.kill(os.getpid(), 9)"
    assert ended(python("-c", code)).returncode == -9
    JournalFolder(tmp_path / "j").close()


def test_folders_of_something_else_are_refused(tmp_path: Path) -> None:
    (tmp_path / "photo.jpg").touch()
    with pytest.raises(LoomError, match=r"folder of something else: it has photo\.jpg"):
        JournalFolder(tmp_path)
    with pytest.raises(OutputError, match="cannot be written"):
        JournalFolder(tmp_path / "photo.jpg")
    with pytest.raises(OutputError, match="cannot be written"):
        JournalFolder(tmp_path / "no" / "folder")
    with pytest.raises(LoomError, match="has no journal"):
        journal_bytes(tmp_path)
    os.mkfifo(tmp_path / "journal")
    with pytest.raises(IlmekError):
        journal_bytes(tmp_path)


def test_a_carpet_without_its_journal_is_refused_until_a_new_one_is_begun(tmp_path: Path) -> None:
    (tmp_path / "woven").write_bytes(b"knots")
    with pytest.raises(LoomError, match="carpet but no journal"):
        JournalFolder(tmp_path)
    with JournalFolder(tmp_path, new=True) as folder:
        assert not folder.woven.exists()


def test_no_handle_is_left_open(tmp_path: Path) -> None:
    before = {one.name for one in Path("/proc/self/fd").iterdir()}
    for _ in range(3):
        with JournalFolder(tmp_path / "j"), pytest.raises(LoomError):
            JournalFolder(tmp_path / "j")
    (tmp_path / "k").mkdir()
    (tmp_path / "k" / "woven").touch()
    with pytest.raises(LoomError):
        JournalFolder(tmp_path / "k")
    assert {one.name for one in Path("/proc/self/fd").iterdir()} == before


def test_a_full_disc_loses_nothing() -> None:
    disc = LosingDisc()
    journal = JournalFile(disc)
    journal.append(b"0123456789")
    disc.room = 15
    with pytest.raises(OSError, match="No space"):
        journal.append(b"abcdefghij")
    assert bytes(disc.now) == b"0123456789"
    journal.append(b"AB")
    journal.sync()
    disc.room = None
    journal.append(b"abcdefghij")
    journal.sync()
    assert bytes(disc.durable) == b"0123456789ABabcdefghij"


def test_after_a_failed_sync_the_bytes_are_written_again() -> None:
    disc = LosingDisc()
    journal = JournalFile(disc)
    journal.append(b"first")
    journal.sync()
    disc.failing_syncs = 1
    journal.append(b"second")
    with pytest.raises(OSError, match="error"):
        journal.sync()
    disc.now[5:] = bytes(6)  # what a system may have that forgot the pages
    journal.append(b"third")
    journal.sync()
    assert bytes(disc.durable) == b"firstsecondthird"
    written = disc.written
    journal.sync()
    assert disc.written == written


def test_what_is_synced_survives_every_power_cut() -> None:
    chance = random.Random(5)
    for _ in range(200):
        disc = LosingDisc()
        journal = JournalFile(disc)
        synced = b""
        for _ in range(chance.randrange(1, 20)):
            data = chance.randbytes(chance.randrange(1, 700))
            journal.append(data)
            if chance.random() < 0.3:
                journal.sync()
                synced = bytes(disc.now)
        assert disc.after_power_cut(chance)[: len(synced)] == synced
