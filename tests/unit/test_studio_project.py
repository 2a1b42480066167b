"""The files of a project: opened, read, saved, undone, refused; comments kept, nothing lost."""

import os
import tomllib
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import pytest

from ilmek.errors import IlmekError, OutputError, ParameterError
from ilmek.jobs.studio.answers import Context
from ilmek.jobs.studio.project import folder as project_folder
from ilmek.jobs.studio.project.history import MOST_STATES, history_path
from ilmek.jobs.studio.project.opening import open_project
from ilmek.jobs.studio.project.pictures import UploadRequest, delete_picture, upload_picture
from ilmek.jobs.studio.project.tasks import (
    FileContent,
    NewRequest,
    PathRequest,
    ProjectRequest,
    RenameRequest,
    SaveRequest,
    delete_file,
    new_file,
    project,
    read_file,
    redo,
    rename_file,
    save_file,
    undo,
)
from ilmek.jobs.studio.project.watch import ProjectWatch

EXAMPLE = Path(__file__).parents[2] / "src" / "ilmek" / "data" / "example_project"
RECIPE = 'plain = "ivory"  # the field\nsize = "60x90cm"\n\n# the edge\n[[border]]\nyarn = "dark red"\nwidth = 3\n'


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    base = tmp_path / "mine"
    (base / "machines").mkdir(parents=True)
    (base / "carpet.toml").write_text(RECIPE)
    (base / "machines" / "beat-up.toml").write_text('machine = "beat-up"\n\n[settings]\nswing = "30deg"\n')
    return open_project(base)


@pytest.fixture
def context(folder: Path) -> Context:
    return Context(str(folder))


def content(context: Context, path: str = "carpet.toml") -> FileContent:
    return read_file(PathRequest(path), context)


def save(context: Context, text: str, path: str = "carpet.toml") -> FileContent:
    saved = save_file(SaveRequest(path, content(context, path).digest, text=text), context)
    assert saved.saved
    return saved.file


def test_a_missing_folder_is_filled_with_an_example_without_errors(tmp_path: Path) -> None:
    found = project(ProjectRequest(), Context(str(open_project(tmp_path / "new"))))
    assert {file.kind for file in found.files} == {"carpet", "machine", "linkage", "synthesis", "cyclogram"}
    assert {file.path: file.error for file in found.files if file.error} == {}
    assert [picture.path for picture in found.pictures] == ["pictures/medallion.png"]


def test_a_filling_that_was_killed_goes_on(tmp_path: Path) -> None:
    (tmp_path / ".studio").mkdir()
    (tmp_path / ".studio" / "filling").touch()
    (tmp_path / "carpet.toml").write_text("# mine\n")
    open_project(tmp_path)
    assert (tmp_path / "carpet.toml").read_text() == "# mine\n"
    assert (tmp_path / "linkages" / "four-bar.toml").is_file()
    assert not (tmp_path / ".studio" / "filling").exists()


def test_another_folder_and_a_file_are_refused(tmp_path: Path) -> None:
    (tmp_path / "letter.txt").write_text("Dear all")
    with pytest.raises(OutputError, match=r"no project.*carpet\.toml"):
        open_project(tmp_path)
    with pytest.raises(OutputError, match="is a file; give a folder"):
        open_project(tmp_path / "letter.txt")
    assert [file.name for file in tmp_path.iterdir()] == ["letter.txt"]


def test_a_folder_without_permission_and_a_full_disc_have_clear_errors(
    folder: Path, context: Context, monkeypatch: pytest.MonkeyPatch
) -> None:
    def full(*_: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(project_folder.disk, "sync", full)
    with pytest.raises(OutputError, match="No space left.*free some space"):
        save(context, "plain = 'camel'\n")
    assert (folder / "carpet.toml").read_text() == RECIPE
    assert not list(folder.glob("*.tmp"))

    def closed(*_: object, **__: object) -> None:
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr(Path, "mkdir", closed)
    with pytest.raises(OutputError, match="Permission denied.*permission"):
        open_project(folder)


FOUR_BAR = (EXAMPLE / "linkages" / "four-bar.toml").read_text()
PRESS = (EXAMPLE / "cyclograms" / "press.toml").read_text()


@pytest.mark.parametrize(
    ("path", "text", "line", "words"),
    [
        ("x.toml", 'plain = "ivory"\nsize = "huge"\n', 2, "unknown size"),
        ("x.toml", 'plain = "ivory"\nsize = "60x90cm"\npattern = 3\n', 3, "unknown key"),
        ("x.toml", '# mine\npicture = "pictures/none.png"\n', 2, "is not there"),
        ("machines/x.toml", 'machine = "cam"\n[settings]\nrise = 12 13\n', 3, "column"),
        ("machines/x.toml", 'machine = "cam"\n\udcff\n', 2, "UTF-8"),
        ("machines/x.toml", 'machine = "beat-up"\n[settings]\n\nswing = "900deg"\n', 4, "out of bounds"),
        ("machines/x.toml", 'machine = "cam"\n[settings]\nlift = "12kg"\n', 3, "wrong unit"),
        ("machines/x.toml", "", None, "is empty"),
        ("linkages/x.toml", FOUR_BAR.replace("120mm", "abc"), 11, "unknown name"),
        ("linkages/x.toml", FOUR_BAR.replace("A0.pin", "A0.pni"), 18, "has none of pin"),
        ("linkages/x.toml", FOUR_BAR + "[joints\n", 22, "column"),
        ("synthesis/x.toml", 'machine = "path-four-bar"\n\n[settings]\npoints = "(60mm"\n', 4, "no list of points"),
        ("synthesis/x.toml", 'machine = "path-four-br"\n', 1, "unknown machine"),
        ("cyclograms/x.toml", PRESS.replace("modified-sine", "modified-sin", 1), 22, "no law"),
        ("cyclograms/x.toml", PRESS.replace("deg", "dog", 1), 11, "unknown unit"),
        ("yarns/x.toml", '[[yarn]]\nname = "a"\nsrgb = "#112233"\n[[yarn]]\nname = "b"\nsrgb = "#zz"\n', 4, "srgb"),
    ],
)
def test_a_broken_file_names_its_line_and_the_rest_opens(
    context: Context, path: str, text: str, line: int | None, words: str
) -> None:
    folder = context.folder
    (folder / path).parent.mkdir(exist_ok=True)
    (folder / path).write_bytes(text.encode("utf-8", "surrogateescape"))
    files = {file.path: file for file in project(ProjectRequest(), context).files}
    error = files.pop(path).error
    assert error.line == line
    assert words in error.given
    assert str(folder) not in error.given
    assert [file.error for file in files.values()] == [None] * 2
    found = content(context, path)
    assert found.error == error
    assert found.text.encode("utf-8", "replace").decode() == text.encode("utf-8", "replace").decode()


def test_a_closed_folder_and_a_linked_one_are_reported_and_the_rest_opens(
    folder: Path, context: Context, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "elsewhere").mkdir()
    (tmp_path / "elsewhere" / "secret.toml").write_text("name = 1\n")
    (folder / "linkages").symlink_to(tmp_path / "elsewhere")
    scan = os.scandir

    def scandir(path: Path) -> Any:
        if Path(path).name == "machines":
            raise PermissionError(13, "Permission denied")
        return scan(path)

    monkeypatch.setattr(os, "scandir", scandir)
    found = project(ProjectRequest(), context)
    assert [file.path for file in found.files] == ["carpet.toml"]
    assert [words in problem for words, problem in zip(("Permission denied", "is a link"), found.problems, strict=True)]
    assert ProjectWatch(folder).changes() == ()


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


def test_data_is_saved_with_comments_and_only_changes_are_written(folder: Path, context: Context) -> None:
    found = content(context)
    data = {**found.data, "size": "80x120cm", "colours": 4}
    saved = save_file(SaveRequest("carpet.toml", found.digest, data=data), context)
    assert saved.saved
    assert saved.file.data == data
    text = (folder / "carpet.toml").read_text()
    assert "# the field" in text
    assert "# the edge" in text
    assert tomllib.loads(text) == data


def test_work_in_progress_is_saved_with_its_error(folder: Path, context: Context) -> None:
    found = save(context, 'plain = "ivory"\nsize = "huge"\n')
    assert found.error is not None
    assert found.error.line == 2
    assert save(context, "plain = [").data is None
    assert (folder / "carpet.toml").read_text() == "plain = ["


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


def test_files_are_created_copied_renamed_deleted_and_brought_back(folder: Path, context: Context) -> None:
    new_file(NewRequest("machines/b.toml", source="machines/beat-up.toml"), context)
    save(context, 'machine = "cam"\n', "machines/b.toml")
    rename_file(RenameRequest("machines/b.toml", "machines/c.toml"), context)
    assert "beat-up" in undo(PathRequest("machines/c.toml"), context).text
    delete_file(PathRequest("machines/c.toml"), context)
    assert not (folder / "machines" / "c.toml").exists()
    assert "beat-up" in undo(PathRequest("machines/c.toml"), context).text
    with pytest.raises(ParameterError, match="exists already"):
        new_file(NewRequest("machines/c.toml"), context)
    with pytest.raises(ParameterError, match="another kind"):
        rename_file(RenameRequest("machines/c.toml", "linkages/c.toml"), context)


@pytest.mark.parametrize(
    "path",
    ["", "../carpet.toml", "/etc/passwd", "machines/../../x.toml", "machines//x.toml", "a\\b.toml", "machines/.x.toml",
     ".studio/secret.toml", "machines/\0.toml", "machines/con.toml", "machines/x.toml ", "machines/\u202ex.toml",
     "x" * 101 + ".toml", "machines/deep/x.toml", "pictures/x.toml", "carpet.txt", "C:/x.toml", "./carpet.toml"],
)  # fmt: skip
def test_no_path_leaves_the_folder(path: str, folder: Path, context: Context) -> None:
    before = sorted(folder.parent.rglob("*"))
    for task in (
        lambda: read_file(PathRequest(path), context),
        lambda: save_file(SaveRequest(path, "", text="x = 1\n"), context),
        lambda: new_file(NewRequest(path), context),
        lambda: new_file(NewRequest("machines/n.toml", source=path or "."), context),
        lambda: rename_file(RenameRequest("machines/beat-up.toml", path), context),
        lambda: delete_file(PathRequest(path), context),
        lambda: undo(PathRequest(path), context),
        lambda: delete_picture(PathRequest(path), context),
    ):
        with pytest.raises(IlmekError):
            task()
    assert [file for file in sorted(folder.parent.rglob("*")) if file not in before] in ([], [folder / ".studio/lock"])


def test_links_are_not_followed(folder: Path, context: Context, tmp_path: Path) -> None:
    (tmp_path / "secret.toml").write_text("secret = 1\n")
    (folder / "linked.toml").symlink_to(tmp_path / "secret.toml")
    (folder / "linkages").symlink_to(tmp_path)
    for path in ("linked.toml", "linkages/secret.toml", "linkages/new.toml"):
        with pytest.raises(ParameterError, match="is a link"):
            save_file(SaveRequest(path, "", text="x = 1\n"), context)
    assert (tmp_path / "secret.toml").read_text() == "secret = 1\n"
    assert "linked.toml" not in {file.path for file in project(ProjectRequest(), context).files}


def test_pictures_are_taken_by_their_content(folder: Path, context: Context) -> None:
    png = b"\x89PNG\r\n\x1a\n" + bytes(20)
    assert upload_picture(UploadRequest("C:\\My Photos\\../rug (1).JPG", png), context).path == "pictures/rug--1.png"
    assert upload_picture(UploadRequest("rug--1.png", png), context).path == "pictures/rug--1.png"
    assert upload_picture(UploadRequest("rug--1.png", png + b"x"), context).path == "pictures/rug--1-2.png"
    for name, body in (("x.png", b"<html>"), ("x.svg", b"<?xml version='1.0'?><svg/>"), ("", b"")):
        with pytest.raises(ParameterError, match="no picture"):
            upload_picture(UploadRequest(name, body), context)
    delete_picture(PathRequest("pictures/rug--1.png"), context)
    assert not (folder / "pictures" / "rug--1.png").exists()


def test_changes_of_all_programs_are_seen(folder: Path, context: Context) -> None:
    watch = ProjectWatch(folder)
    assert watch.changes() == ()
    save(context, 'plain = "camel"\n')
    (folder / "out" / "carpet").mkdir(parents=True)
    (folder / "out" / "carpet" / "report.html").write_text("<p>")
    (folder / "machines" / "beat-up.toml").unlink()
    assert watch.changes() == ("carpet.toml", "machines/beat-up.toml", "out/carpet/report.html")
    assert watch.changes() == ()
