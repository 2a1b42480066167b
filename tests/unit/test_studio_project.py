"""The files of a project: opened, read, saved, undone, refused; comments kept, nothing lost."""

import os
import tomllib
from pathlib import Path
from typing import Any

import pytest
from studio_project import RECIPE, content, sample_project, save

from ilmek.errors import IlmekError, OutputError, ParameterError
from ilmek.jobs.studio.answers import Context
from ilmek.jobs.studio.project import folder as project_folder
from ilmek.jobs.studio.project.opening import open_project
from ilmek.jobs.studio.project.pictures import delete_picture
from ilmek.jobs.studio.project.tasks import (
    NewRequest,
    PathRequest,
    ProjectRequest,
    RenameRequest,
    SaveRequest,
    delete_file,
    new_file,
    project,
    read_file,
    rename_file,
    save_file,
    undo,
)
from ilmek.jobs.studio.project.watch import ProjectWatch

EXAMPLE = Path(__file__).parents[2] / "src" / "ilmek" / "data" / "example_project"


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    return sample_project(tmp_path)


@pytest.fixture
def context(folder: Path) -> Context:
    return Context(str(folder))


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


def test_changes_of_all_programs_are_seen(folder: Path, context: Context) -> None:
    watch = ProjectWatch(folder)
    assert watch.changes() == ()
    save(context, 'plain = "camel"\n')
    (folder / "out" / "carpet").mkdir(parents=True)
    (folder / "out" / "carpet" / "report.html").write_text("<p>")
    (folder / "machines" / "beat-up.toml").unlink()
    assert watch.changes() == ("carpet.toml", "machines/beat-up.toml", "out/carpet/report.html")
    assert watch.changes() == ()
