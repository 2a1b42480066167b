"""Undo and redo of the files of a project: through restarts, two tabs and cut-off files, nothing is lost."""

from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest
from studio_project import RECIPE, content, sample_project, save

from ilmek.errors import OutputError
from ilmek.jobs.studio.answers import Context
from ilmek.jobs.studio.project.history import MOST_STATES, history_path
from ilmek.jobs.studio.project.tasks import (
    PathRequest,
    SaveRequest,
    delete_file,
    redo,
    save_file,
    undo,
)


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    return sample_project(tmp_path)


@pytest.fixture
def context(folder: Path) -> Context:
    return Context(str(folder))


def test_a_disc_that_fills_between_file_and_history_loses_nothing(
    folder: Path, context: Context, monkeypatch: pytest.MonkeyPatch
) -> None:
    save(context, 'plain = "camel"\n')
    before = history_path(folder, "carpet.toml").read_bytes()
    base = content(context).digest

    def full(*_: object) -> None:
        raise OSError(28, "No space left on device")

    with monkeypatch.context() as patched:
        patched.setattr("ilmek.jobs.studio.project.history.os.fsync", full)
        with pytest.raises(OutputError, match="No space left"):
            save_file(SaveRequest("carpet.toml", base, text='plain = "red"\n'), context)
    assert history_path(folder, "carpet.toml").read_bytes() == before
    again = save_file(SaveRequest("carpet.toml", base, text='plain = "red"\n'), context)
    assert again.file.text == 'plain = "red"\n'  # the page sees its own state there, and takes it as saved
    assert undo(PathRequest("carpet.toml"), context).data == {"plain": "camel"}


def test_a_change_of_another_program_is_not_overwritten(folder: Path, context: Context) -> None:
    mine = content(context)
    (folder / "carpet.toml").write_text('plain = "camel"\n')
    answer = save_file(SaveRequest("carpet.toml", mine.digest, text="plain = 'red'\n"), context)
    assert not answer.saved
    assert answer.file.data == {"plain": "camel"}
    assert (folder / "carpet.toml").read_text() == 'plain = "camel"\n'
    kept = save_file(SaveRequest("carpet.toml", answer.file.digest, text=RECIPE), context)
    assert kept.saved
    assert undo(PathRequest("carpet.toml"), context).data == {"plain": "camel"}


def test_a_state_that_is_set_aside_is_brought_back_by_undo(folder: Path, context: Context) -> None:
    theirs = 'plain = "camel"\n'
    (folder / "carpet.toml").write_text(theirs)
    answer = save_file(SaveRequest("carpet.toml", "", text="plain = 'red'\n", aside=True), context)
    assert (folder / "carpet.toml").read_text() == answer.file.text == theirs
    assert undo(PathRequest("carpet.toml"), context).data == {"plain": "red"}
    assert redo(PathRequest("carpet.toml"), context).text == theirs
    (folder / "carpet.toml").unlink()
    answer = save_file(SaveRequest("carpet.toml", "", text="plain = 'blue'\n", aside=True), context)
    assert (answer.file.digest, answer.file.undo) == ("", True)
    assert not (folder / "carpet.toml").exists()
    assert undo(PathRequest("carpet.toml"), context).data == {"plain": "blue"}


def test_a_file_that_has_gone_is_brought_back_by_undo(folder: Path, context: Context) -> None:
    never = content(context, "machines/never.toml")
    assert (never.digest, never.data, never.error, never.undo) == ("", None, None, False)
    save(context, 'plain = "camel"\n')
    for remove in (lambda: delete_file(PathRequest("carpet.toml"), context), (folder / "carpet.toml").unlink):
        remove()
        found = content(context)
        assert (found.digest, found.undo) == ("", True)
        assert "undo brings it back" in found.error.do
        assert undo(PathRequest("carpet.toml"), context).data == {"plain": "camel"}


def test_undo_and_redo_go_through_restarts(context: Context) -> None:
    for size in ("70x90cm", "80x90cm", "90x90cm"):
        save(context, f'plain = "ivory"\nsize = "{size}"\n')
    sizes = [undo(PathRequest("carpet.toml"), context).data["size"] for _ in range(4)]
    assert sizes == ["80x90cm", "70x90cm", "60x90cm", "60x90cm"]
    assert not content(context).undo
    assert [redo(PathRequest("carpet.toml"), context).data["size"] for _ in range(2)] == ["70x90cm", "80x90cm"]
    assert content(context).redo
    save(context, RECIPE)
    assert not content(context).redo


def test_two_tabs_that_save_at_once_lose_nothing(context: Context) -> None:
    def tab(name: str) -> int:
        conflicts = 0
        for number in range(10):
            text = f'plain = "ivory"  # {name} {number}\n'
            base = content(context).digest
            while not (answer := save_file(SaveRequest("carpet.toml", base, text=text), context)).saved:
                base = answer.file.digest
                conflicts += 1
        return conflicts

    with ThreadPoolExecutor(2) as tabs:
        assert all(conflicts < 11 for conflicts in tabs.map(tab, "ab"))
    seen = [content(context).text]
    while content(context).undo:
        seen.append(undo(PathRequest("carpet.toml"), context).text)
    assert seen[-1] == RECIPE
    for name in "ab":
        assert [text for text in reversed(seen) if f"# {name}" in text] == [
            f'plain = "ivory"  # {name} {number}\n' for number in range(10)
        ]


def test_an_undo_of_one_tab_is_a_change_for_the_other(context: Context) -> None:
    first = save(context, 'plain = "camel"\n')
    undone = undo(PathRequest("carpet.toml"), context)
    answer = save_file(SaveRequest("carpet.toml", first.digest, text='plain = "red"\n'), context)
    assert (answer.saved, answer.file.text) == (False, RECIPE)
    assert redo(PathRequest("carpet.toml"), context).text == first.text
    assert undo(PathRequest("carpet.toml"), context).digest == undone.digest


def test_a_history_cut_off_at_any_byte_loses_nothing_saved(folder: Path, context: Context) -> None:
    for number in range(3):
        save(context, f'plain = "ivory"\nsize = "{6 + number}0x90cm"  # ğ\n')
    file = history_path(folder, "carpet.toml")
    whole, text = file.read_bytes(), (folder / "carpet.toml").read_text()
    for size in range(0, len(whole), 7):
        file.write_bytes(whole[:size])
        (folder / "carpet.toml").write_text(text)
        assert content(context).text == text
        assert save(context, RECIPE).undo
        assert undo(PathRequest("carpet.toml"), context).text == text


def test_a_history_is_bounded(folder: Path, context: Context, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("ilmek.jobs.studio.project.history.MOST_STATES", 5)
    monkeypatch.setattr("ilmek.jobs.studio.project.tasks.file_error", lambda *_: None)
    for number in range(30):
        save(context, f"plain = '{number}'\n")
    assert len(history_path(folder, "carpet.toml").read_bytes().splitlines()) <= 2 * 5
    assert undo(PathRequest("carpet.toml"), context).data == {"plain": "28"}
    assert MOST_STATES >= 100
