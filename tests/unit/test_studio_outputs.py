"""Everything out: each product of a file, byte for byte as its command line writes it; listed, removed."""

import contextlib
import os
import shlex
import shutil
from io import BytesIO, StringIO
from itertools import islice
from pathlib import Path
from zipfile import ZipFile

import pytest
from click.testing import CliRunner

from ilmek.cli import main
from ilmek.errors import IlmekError, OutputError, ParameterError
from ilmek.jobs import animation
from ilmek.jobs.animation import pictures
from ilmek.jobs.studio.answers import Context
from ilmek.jobs.studio.outputs import OutputRequest, write_product
from ilmek.jobs.studio.project.folder import ProjectFolder
from ilmek.jobs.studio.project.origins import inputs
from ilmek.jobs.studio.project.out import archive, delete_written, written
from ilmek.jobs.studio.project.products import PRODUCTS, products
from ilmek.jobs.studio.project.tasks import PathRequest, ProjectRequest
from ilmek.progress import Cancelled, Progress

EXAMPLE = Path(__file__).parents[2] / "src" / "ilmek" / "data" / "example_project"
CARPET = 'plain = "ivory"\nsize = "20x30cm"\npdf = false\n\n[[border]]\nyarn = "dark red"\nwidth = 3\n'


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    for path in (
        "machines/cam.toml",
        "synthesis/square.toml",
        "linkages/slider-crank-press.toml",
        "cyclograms/press.toml",
    ):
        (tmp_path / path).parent.mkdir()
        shutil.copy(EXAMPLE / path, tmp_path / path)
    (tmp_path / "carpet.toml").write_text(CARPET)
    return tmp_path


def contents(path: Path) -> dict[str, bytes]:
    if path.is_file():
        return {"": path.read_bytes()}
    files = [file for file in path.iterdir() if file.name != ".ilmek"]
    return {
        file.name: b"" if file.suffix == ".step" else file.read_bytes() for file in files
    }  # OCC counts its products


def remove(path: Path) -> None:
    if path.is_dir():
        shutil.rmtree(path)
    else:
        path.unlink()


@pytest.mark.matrix(light=3)
@pytest.mark.parametrize(
    ("path", "names"),
    [
        ("carpet.toml", ("chart",)),
        ("machines/cam.toml", ("page", "data")),
        ("synthesis/square.toml", ("mechanism",)),
        ("linkages/slider-crank-press.toml", ("page", "parts", "table", "animation", "data")),
        ("cyclograms/press.toml", ("page", "table", "data")),
    ],
)
def test_a_product_is_what_its_command_and_its_python_write(
    folder: Path, path: str, names: tuple[str, ...], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(animation, "pictures", lambda *given: islice(pictures(*given), 2))  # all of them take 10 s
    context = Context(str(folder))
    found = {one.name: one for one in products(PathRequest(path), context).products}
    for name in names:
        done = write_product(OutputRequest(path, name), context)
        assert (done.target, done.failed) == (found[name].target, ())
        by_studio = contents(folder / done.target)
        with contextlib.chdir(folder):
            result = CliRunner().invoke(main, shlex.split(found[name].command)[1:])
            assert result.exit_code == 0, result.output
            assert contents(folder / done.target) == by_studio
            remove(Path(done.target))
            with contextlib.redirect_stdout(StringIO()):
                exec(compile(found[name].python, "shown", "exec"), {})
        assert contents(folder / done.target) == by_studio
    entries = written(ProjectRequest(), context).entries
    assert {entry.path for entry in entries} == {found[name].target for name in names}
    assert all(entry.size == sum(file.size for file in entry.files) > 0 for entry in entries)
    for entry in entries:
        delete_written(PathRequest(entry.path), context)
    assert written(ProjectRequest(), context).entries == ()


def test_a_list_that_is_read_while_a_folder_is_deleted_has_nothing_of_it(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    context, seen = Context(str(folder)), []
    (folder / "out" / "chart").mkdir(parents=True)
    for name in ("carpet.png", "chart.png"):
        (folder / "out" / "chart" / name).write_bytes(b"x")
    remove = shutil.rmtree

    def slowly(path: Path) -> None:
        (path / "carpet.png").unlink()
        seen.append(written(ProjectRequest(), context).entries)
        remove(path)

    monkeypatch.setattr(shutil, "rmtree", slowly)
    delete_written(PathRequest("out/chart"), context)
    assert seen == [()]
    assert list((folder / "out").iterdir()) == []


def test_every_kind_has_products(folder: Path) -> None:
    context = Context(str(folder))
    for path in ("carpet.toml", "machines/cam.toml", "linkages/slider-crank-press.toml"):
        assert len(products(PathRequest(path), context).products) >= 2
    assert products(PathRequest("yarns/mine.toml"), context).products == ()
    assert set(PRODUCTS) == {"carpet", "machine", "synthesis", "linkage", "cyclogram"}


def test_a_cancelled_or_impossible_product_writes_nothing(folder: Path) -> None:
    (folder / "linkages" / "bad.toml").write_text("name = 1\n")
    with pytest.raises(Cancelled):
        write_product(OutputRequest("carpet.toml", "chart"), Context(str(folder), Progress(cancelled=lambda: True)))
    for path, name in (("linkages/bad.toml", "page"), ("machines/cam.toml", "poem"), ("../x.toml", "page")):
        with pytest.raises(IlmekError):
            write_product(OutputRequest(path, name), Context(str(folder)))
    (folder / "linked").symlink_to(folder / "machines")
    (folder / "out").mkdir(exist_ok=True)
    assert list((folder / "out").iterdir()) == []
    for path in ("machines/cam.toml", "out", "out/../carpet.toml", "out/nothing"):
        with pytest.raises(ParameterError):
            delete_written(PathRequest(path), Context(str(folder)))


def changed(folder: Path) -> dict[str, tuple[str, ...]]:
    return {entry.path: entry.changed for entry in written(ProjectRequest(), Context(str(folder))).entries}


def test_what_has_changed_since_a_product_was_written_is_named(folder: Path) -> None:
    context = Context(str(folder))
    file = folder / "cyclograms" / "press.toml"
    text = file.read_text()
    (folder / "out").mkdir()
    by_command = folder / "out" / "cyclogram-press.csv"
    by_command.write_text("0\n")
    write_product(OutputRequest("cyclograms/press.toml", "data"), context)
    assert changed(folder) == {"out/cyclogram-press.json": (), "out/cyclogram-press.csv": ()}
    file.write_text(text + "\n# later\n")
    os.utime(file, (2e9, 2e9))
    assert set(changed(folder).values()) == {("cyclograms/press.toml",)}
    file.write_text(text)  # undone; the command's file is compared by time alone
    os.utime(file, (2e9, 2e9))
    assert changed(folder)["out/cyclogram-press.json"] == ()
    assert changed(folder)["out/cyclogram-press.csv"] == ("cyclograms/press.toml",)
    (folder / ".studio" / "written.json").write_text("[broken")
    assert changed(folder)["out/cyclogram-press.json"] == ("cyclograms/press.toml",)
    file.unlink()
    assert changed(folder) == {"out/cyclogram-press.json": (), "out/cyclogram-press.csv": ()}


def test_files_that_a_file_names_are_its_inputs(folder: Path) -> None:
    (folder / "yarns").mkdir()
    (folder / "yarns" / "mine.toml").write_text('[[yarn]]\nname = "ivory"\nsrgb = "#efe6d2"\n')
    (folder / "machines" / "loom.toml").write_text('machine = "cam"\n[settings]\nmotion = "@law.csv"\n')
    (folder / "machines" / "law.csv").write_text("0,0\n")
    (folder / "carpet.toml").write_text(
        'yarns = "yarns/mine.toml"\nloom_file = "machines/loom.toml"\npicture = "/etc/x.png"\n'
    )
    found = inputs(ProjectFolder(folder), "carpet.toml")
    assert found == ["carpet.toml", "yarns/mine.toml", "machines/loom.toml", "machines/law.csv"]


def test_a_folder_is_packed(folder: Path) -> None:
    (folder / "out" / "carpet" / "rows").mkdir(parents=True)
    (folder / "out" / "carpet" / "rows" / "ğ 1.txt").write_text("row")
    (folder / "out" / "carpet" / ".ilmek").write_text("hidden")
    packed = archive(PathRequest("out/carpet"), Context(str(folder)))
    with ZipFile(BytesIO(packed.body)) as files:
        assert {name: files.read(name) for name in files.namelist()} == {"carpet/rows/ğ 1.txt": b"row"}
    for path in ("out", "out/nothing", "machines", "../x"):
        with pytest.raises(ParameterError):
            archive(PathRequest(path), Context(str(folder)))


def test_a_name_with_spaces_and_turkish_letters_is_written_by_its_command(folder: Path) -> None:
    (folder / "cyclograms" / "çark ğıİ 2.toml").write_bytes((folder / "cyclograms" / "press.toml").read_bytes())
    context = Context(str(folder))
    found = products(PathRequest("cyclograms/çark ğıİ 2.toml"), context).products
    done = write_product(OutputRequest("cyclograms/çark ğıİ 2.toml", "data"), context)
    assert done.target == "out/cyclogram-çark ğıİ 2.json"
    by_studio = contents(folder / done.target)
    with contextlib.chdir(folder):
        command = next(one.command for one in found if one.name == "data")
        assert CliRunner().invoke(main, shlex.split(command)[1:]).exit_code == 0
    assert contents(folder / done.target) == by_studio


@pytest.mark.parametrize("product", ["page", "data", "table"])
def test_out_that_is_deleted_during_the_work_is_made_again_or_reported(folder: Path, product: str) -> None:
    context = Context(str(folder), Progress(lambda *_: shutil.rmtree(folder / "out", ignore_errors=True)))
    with contextlib.suppress(OutputError):
        write_product(OutputRequest("cyclograms/press.toml", product), context)
    done = write_product(OutputRequest("cyclograms/press.toml", product), Context(str(folder)))
    assert [entry.path for entry in written(ProjectRequest(), context).entries] == [done.target]


def test_a_full_disc_leaves_nothing_half_written(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def full(*_: object, **__: object) -> None:
        raise OSError(28, "No space left on device")

    context = Context(str(folder))
    write_product(OutputRequest("cyclograms/press.toml", "data"), context)
    before = contents(folder / "out" / "cyclogram-press.json")
    with monkeypatch.context() as patched:
        patched.setattr("ilmek.io.output.disk.write", full)
        with pytest.raises(OutputError, match="No space left"):
            write_product(OutputRequest("cyclograms/press.toml", "data"), context)
    with monkeypatch.context() as patched:
        patched.setattr("ilmek.jobs.studio.project.folder.disk.sync", full)
        (folder / "out" / "cyclogram-press.json").unlink()
        with contextlib.suppress(OutputError):
            write_product(OutputRequest("cyclograms/press.toml", "data"), context)
    write_product(OutputRequest("cyclograms/press.toml", "data"), context)
    assert contents(folder / "out" / "cyclogram-press.json") == before
    assert [file.name for file in (folder / "out").iterdir()] == ["cyclogram-press.json"]


def test_out_that_is_a_link_is_refused(folder: Path) -> None:
    (folder / "out").symlink_to(folder / "machines")
    context = Context(str(folder))
    for task in (
        lambda: written(ProjectRequest(), context),
        lambda: write_product(OutputRequest("cyclograms/press.toml", "data"), context),
        lambda: delete_written(PathRequest("out/cam.toml"), context),
        lambda: archive(PathRequest("out/cam.toml"), context),
    ):
        with pytest.raises(ParameterError, match="is a link"):
            task()
    assert [file.name for file in (folder / "machines").iterdir()] == ["cam.toml"]
