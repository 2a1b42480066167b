"""Targets of every kind: strange paths, links, devices, pipes, modes, several writers, interrupts at every line."""

import errno
import json
import os
import signal
import stat
import sys
import threading
from collections.abc import Callable, Iterator
from itertools import count
from pathlib import Path
from types import FrameType
from typing import Any

import pytest
from output_scenarios import SCENARIOS, Scenario, at, hidden, news, nexts, prepare, write
from power_cut import Tree, read_tree
from processes import PATIENCE, ended, python, start

from ilmek.errors import OutputError
from ilmek.io.output import MANIFEST, Outputs, disk, manifest, outputs, write_file


def make(path: Path, content: str = "a", *, force: bool = False) -> None:
    with Outputs(force=force) as outputs, outputs.folder(path) as work:
        (work / "a.txt").write_text(content)


def names(folder: Path) -> list[str]:
    return sorted(path.name for path in folder.iterdir())


def write_all(contents: dict[Path, str]) -> None:
    with Outputs(force=True) as outputs:
        for path, content in contents.items():
            outputs.write(path, content)


def mode(path: Path) -> int:
    return stat.S_IMODE(path.stat().st_mode)


@pytest.fixture
def mask() -> Iterator[Callable[[int], int]]:
    before = os.umask(0o022)
    yield os.umask
    os.umask(before)


@pytest.mark.parametrize("name", ["x" * 256, "a\0b", "ü" * 200])
def test_names_that_the_system_does_not_take(tmp_path: Path, name: str) -> None:
    for path in (tmp_path / name, tmp_path / name / "out"):
        with pytest.raises(OutputError, match=r"name too long|null|is not a folder"):
            Outputs().expect_folder(path)
        with pytest.raises(OutputError, match=r"name too long|null|no folder"):
            Outputs().expect_file(path)
    assert list(tmp_path.iterdir()) == []


def test_a_name_that_is_no_text(tmp_path: Path) -> None:
    name = os.fsdecode(b"out\xff")
    make(tmp_path / name)
    make(tmp_path / name, "b", force=True)
    write_file(tmp_path / f"{name}.json", "x")
    assert names(tmp_path) == [name, f"{name}.json"]


@pytest.mark.parametrize("path", ["out/", "./out", "in/../out", "link/out"])
def test_a_folder_by_other_names(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, path: str) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "in").mkdir()
    (tmp_path / "link").symlink_to(".")
    make(Path(path))
    make(Path("out"), "b", force=True)
    assert names(tmp_path) == ["in", "link", "out"]
    assert (tmp_path / "out/a.txt").read_text() == "b"


@pytest.mark.parametrize("path", ["", ".", "..", "/"])
def test_folders_that_contain_the_present_one(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, path: str) -> None:
    monkeypatch.chdir(tmp_path)
    for force in (False, True):
        with pytest.raises(OutputError, match=r"exists|you are in"):
            Outputs(force=force).expect_folder(Path(path))
        with pytest.raises(OutputError, match="is a folder"):
            Outputs(force=force).expect_file(Path(path))


def test_links_stay_links(tmp_path: Path) -> None:
    (tmp_path / "folder").symlink_to("real")
    (tmp_path / "file").symlink_to("real.json")
    for content in ("a", "b"):
        make(tmp_path / "folder", content, force=True)
        write_file(tmp_path / "file", content)
        assert (tmp_path / "real/a.txt").read_text() == (tmp_path / "real.json").read_text() == content
    assert names(tmp_path) == ["file", "folder", "real", "real.json"]


def test_outputs_inside_one_another(tmp_path: Path) -> None:
    outputs = Outputs()
    outputs.expect_folder(tmp_path / "parts", "--workshop")
    with pytest.raises(OutputError, match="one inside the other"):
        outputs.expect_folder(tmp_path / "parts/out", "--out")
    with pytest.raises(OutputError, match="the same"):
        outputs.expect_folder(tmp_path / "parts/../parts", "--out")


@pytest.mark.parametrize(("path", "reason"), [("/dev/full", "No space left"), ("/proc/self/mem", "is not|cannot")])
def test_devices_that_take_nothing(tmp_path: Path, path: str, reason: str) -> None:
    with pytest.raises(OutputError, match=rf"{path} .*{reason}.*|{reason}.*nothing was written"):
        write_all({tmp_path / "a.json": "a", Path(path): "b"})
    assert list(tmp_path.iterdir()) == []


def test_what_a_pipe_has_taken_is_stated(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    got: list[str] = []
    reader = threading.Thread(target=lambda: got.append(pipe.read_text()))
    reader.start()

    def failing(_source: Path, _target: Path) -> None:
        raise OSError(errno.EIO, "Input/output error")

    monkeypatch.setattr(disk, "rename", failing)
    with pytest.raises(OutputError, match=rf"error; only {pipe} was written"):
        write_all({pipe: "a" * 100_000, tmp_path / "a.json": "a"})
    reader.join()
    assert got == ["a" * 100_000]
    assert names(tmp_path) == ["pipe"]


BLOCKED = """
import sys
from ilmek.cli import main

def tell(event, arguments):
    if event == "open" and str(arguments[0]).endswith("pipe"):
        sys.stdout.write("opening\\n")
        sys.stdout.flush()

sys.addaudithook(tell)
main(["machines", "--json", "pipe"], prog_name="ilmek")
"""


def test_a_pipe_without_a_reader_can_be_interrupted(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "pipe")
    with start(python("-c", BLOCKED), cwd=tmp_path) as process:
        assert process.stdout.readline() == "opening\n"
        process.send_signal(signal.SIGINT)
        errors = process.communicate(timeout=PATIENCE)[1]
    assert (process.returncode, errors) == (130, "ilmek: interrupted; nothing was written\n")
    assert names(tmp_path) == ["pipe"]


@pytest.mark.parametrize("kept", [0o600, 0o644, 0o640, 0o222])
def test_the_mode_of_a_file_stays(tmp_path: Path, kept: int) -> None:
    write_file(tmp_path / "a.json", "old")
    (tmp_path / "a.json").chmod(kept)
    write_file(tmp_path / "a.json", "new")
    assert mode(tmp_path / "a.json") == kept
    assert names(tmp_path) == ["a.json"]


@pytest.mark.parametrize("kept", [0o700, 0o755, 0o555, 0o2755])
def test_the_modes_of_a_folder_stay(tmp_path: Path, kept: int) -> None:
    make(tmp_path / "out")
    (tmp_path / "out/a.txt").chmod(0o600)
    (tmp_path / "out").chmod(kept)
    make(tmp_path / "out", "b", force=True)
    assert (mode(tmp_path / "out"), mode(tmp_path / "out/a.txt")) == (kept, 0o600)
    assert names(tmp_path) == ["out"]


@pytest.mark.parametrize(("umask", "folder", "file"), [(0o022, 0o755, 0o644), (0o077, 0o700, 0o600)])
def test_new_modes_follow_the_mask(
    tmp_path: Path, mask: Callable[[int], int], umask: int, folder: int, file: int
) -> None:
    mask(umask)
    make(tmp_path / "out")
    write_file(tmp_path / "a.json", "a")
    found = [mode(tmp_path / name) for name in ("out", "out/a.txt", f"out/{MANIFEST}", "a.json")]
    assert found == [folder, file, file, file]


def test_the_group_of_a_folder_is_inherited(tmp_path: Path) -> None:
    tmp_path.chmod(0o2755)
    make(tmp_path / "out")
    assert mode(tmp_path / "out") & stat.S_ISGID


AS_NOBODY = """
import os, sys
from pathlib import Path
from ilmek.io.output import Outputs, write_file
if os.getuid() == 0:  # who may do everything
    os.setgid(65534)
    os.setuid(65534)
os.chdir(sys.argv[1])
for content in ("a", "b"):
    with Outputs(force=True) as outputs, outputs.folder(Path("out")) as work:
        (work / "a.txt").write_text(content)
    os.chmod("out", 0o555)
write_file(Path("a.json"), "a")
os.chmod("a.json", 0o200)
write_file(Path("a.json"), "b")
modes = [oct(os.stat(name).st_mode) for name in ("a.json", "out")]
print(sorted(os.listdir(".")), Path("out/a.txt").read_text(), *modes)
"""


@pytest.fixture
def passable(tmp_path: Path) -> Iterator[Path]:
    """A folder in which everybody can write, below folders through which everybody can pass."""
    tmp_path.chmod(0o777)
    above = {folder: folder.stat().st_mode for folder in tmp_path.parents if not folder.stat().st_mode & 0o001}
    for folder, mode in above.items():
        folder.chmod(mode | 0o011)
    yield tmp_path
    for folder, mode in above.items():
        folder.chmod(mode)


def test_folders_and_files_that_are_closed_to_their_owner(passable: Path) -> None:
    done = ended(python("-B", "-c", AS_NOBODY, passable))
    assert done.stdout == "['a.json', 'out'] b 0o100200 0o40555\n", done.stderr


@pytest.mark.parametrize(
    "text",
    [
        '{"ilmek": 1, "files": {"thesis.txt": {"size": 4, "sha256": "' + "0" * 64 + '"}}}',
        '{"ilmek": 1, "files": {"../thesis.txt": {"size": 4, "sha256": "' + "0" * 64 + '"}}}',
        '{"ilmek": 1, "files": {"thesis.txt": 7}}',
        '{"ilmek": 1, "files": [], "unfinished": false}',
        '{"ilmek": 2, "unfinished": true}',
        "[" * 100_000,
        " " * (manifest.LARGEST + 1),
        "{",
    ],
)
def test_a_manifest_of_others_gives_no_leave_to_delete(tmp_path: Path, text: str) -> None:
    out = tmp_path / "out"
    out.mkdir()
    (out / "thesis.txt").write_text("work")
    (out / MANIFEST).write_text(text)
    with pytest.raises(OutputError, match="did not write"):
        make(out, force=True)
    assert (out / "thesis.txt").read_text() == "work"


@pytest.mark.parametrize("what", ["changed", "nested", "link"])
def test_an_old_folder_that_was_changed_stays(tmp_path: Path, what: str) -> None:
    out = tmp_path / "out"
    make(out)
    if what == "changed":
        (out / "a.txt").write_text("b")  # of the same size
    elif what == "nested":
        (out / "deep").mkdir()
    else:
        (out / "a.txt").rename(tmp_path / "a.txt")
        (out / "a.txt").symlink_to("../a.txt")
    before = read_tree(out)
    with pytest.raises(OutputError, match="did not write"):
        make(out, "c", force=True)
    assert read_tree(out) == before


def test_an_empty_output_can_be_replaced(tmp_path: Path) -> None:
    for _ in range(2):
        with Outputs(force=True) as outputs, outputs.folder(tmp_path / "out"):
            pass
    assert names(tmp_path / "out") == [MANIFEST]


def test_a_manifest_of_too_many_files(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(manifest, "LARGEST", 50)
    with pytest.raises(OutputError, match="1 files are too many for a manifest; nothing was written"):
        make(tmp_path / "out")
    assert list(tmp_path.iterdir()) == []


def test_a_file_without_a_mark_needs_force(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(manifest, "mark", lambda _: None)
    write_file(tmp_path / "a.json", "a")
    with pytest.raises(OutputError, match="--force"):
        Outputs().expect_file(tmp_path / "a.json")
    write_file(tmp_path / "a.json", "b")
    assert (tmp_path / "a.json").read_text() == "b"


def test_a_system_without_second_names(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def unsupported(*_: Any) -> None:
        raise OSError(errno.EPERM, "Operation not permitted")

    write_file(tmp_path / "a.json", "a")
    monkeypatch.setattr(os, "link", unsupported)
    monkeypatch.setattr(disk, "exchange", lambda *_: False)
    write_file(tmp_path / "a.json", "b")
    assert read_tree(tmp_path) == {"a.json": b"b"}


def test_writers_of_one_target_at_once(tmp_path: Path) -> None:
    errors: list[str] = []

    def work(name: str) -> None:
        for number in range(15):
            try:
                make(tmp_path / "out", f"{name} {number}", force=True)
                write_file(tmp_path / "a.json", f"{name} {number}")
            except OutputError as error:
                errors.append(str(error))

    writers = [threading.Thread(target=work, args=(name,)) for name in "ab"]
    for writer in writers:
        writer.start()
    for writer in writers:
        writer.join()
    assert {name.split(".")[0] for name in names(tmp_path)} <= {"out", "a"}
    make(tmp_path / "out", "last", force=True)
    assert manifest.is_whole(tmp_path / "out")
    assert not list(hidden({name: b"" for name in names(tmp_path) if name.startswith(".")}))
    assert all("cannot be written" in error or "did not write" in error for error in errors), errors


class Interrupt:
    """Raises KeyboardInterrupt at a line of `ilmek.io.output`, counted from the begin."""

    def __init__(self, line: int) -> None:
        self.line, self.number, self.raised = line, 0, False

    def __call__(self, frame: FrameType, event: str, _argument: object) -> Any:
        if "/ilmek/io/output/" not in frame.f_code.co_filename:
            return None
        if event == "line":
            self.number += 1
            if self.number == self.line:
                self.raised = True
                raise KeyboardInterrupt
        return self


def interrupted(scenario: Scenario, root: Path, line: int) -> Interrupt:
    """A run that is interrupted at a line."""
    interrupt, before = Interrupt(line), sys.gettrace()
    sys.settrace(interrupt)
    try:
        write(root, news(scenario))
    except KeyboardInterrupt:
        pass
    finally:
        sys.settrace(before)
    return interrupt


@pytest.mark.filterwarnings("ignore::pytest.PytestUnraisableExceptionWarning", "ignore::ResourceWarning")
@pytest.mark.parametrize("name", ["folder replaced", "folder and files"])
def test_an_interrupt_at_every_line(name: str, memory: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    scenario = next(scenario for scenario in SCENARIOS if scenario.name == name)
    monkeypatch.setattr(os, "fsync", lambda _: None)
    step = 7 if len(scenario.targets) > 1 else 2  # every line takes a minute
    for line in count(1, step):
        root = memory / str(line)
        prepare(scenario, root)
        # A trace can raise where a lock is about to be released; there Python looks for signals only afterwards.
        monkeypatch.setattr(outputs, "_COMMIT", threading.Lock())
        run = interrupted(scenario, root, line)
        monkeypatch.setattr(outputs, "_COMMIT", threading.Lock())
        tree = read_tree(root)
        for target, (old, new) in scenario.targets.items():
            assert at(tree, target) in (old, new), (line, target)
        write(root, nexts(scenario))
        written: Tree = read_tree(root)
        assert not list(hidden(written)), (line, names(root))
        assert all(at(written, target) == content for target, content in nexts(scenario).items()), line
        if not run.raised:
            return


def test_a_manifest_is_read_again_after_a_change(tmp_path: Path) -> None:
    make(tmp_path / "out")
    listed = json.loads((tmp_path / "out" / MANIFEST).read_text())["files"]
    assert list(listed) == ["a.txt"]
    old = (tmp_path / "out/a.txt").stat()
    assert manifest.is_whole(tmp_path / "out")
    (tmp_path / "out/a.txt").write_text("b")
    os.utime(tmp_path / "out/a.txt", ns=(old.st_atime_ns, old.st_mtime_ns))
    assert not manifest.is_whole(tmp_path / "out")
