"""The frame of the command line: help, version, exit codes, interruptions, pipes."""

import errno
import importlib
import json
import os
import signal
from pathlib import Path

import click
import pytest
from click.testing import CliRunner, Result
from processes import PATIENCE, ended, printed, python, start
from processes import ilmek as program

import ilmek
from ilmek.cli import main
from ilmek.cli.frame import LazyGroup
from ilmek.errors import OutputError


def run(*arguments: str) -> Result:
    return CliRunner().invoke(main, arguments)


def failing(error: BaseException) -> LazyGroup:
    """A program whose one command fails so."""

    @click.command()
    def command() -> None:
        raise error

    class One(LazyGroup):
        def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:  # noqa: ARG002 - click's
            return command if cmd_name == "go" else None

    return One(name="ilmek", modules={"go": ("nowhere", "Go.")})


def test_bare_program_shows_its_help() -> None:
    assert run().exit_code == 0
    assert run().stdout == run("--help").stdout
    assert all(name in run().stdout for name in main.modules)


def test_version() -> None:
    assert run("--version").stdout == f"ilmek {ilmek.__version__}\n"


@pytest.mark.parametrize("name", list(main.modules))
def test_each_command_has_help_with_examples(name: str) -> None:
    shown = run(name, "--help")
    assert shown.exit_code == 0
    assert "Examples:" in shown.stdout
    assert f"ilmek {name}" in shown.stdout
    assert importlib.import_module(main.modules[name][0]).command.help


@pytest.mark.parametrize(
    ("error", "status", "said"),
    [
        (OutputError("a", allowed="b", do="c"), 2, "ilmek: a; b; c\n"),
        (OutputError("line\nbreak \x1b[31mred"), 2, "ilmek: line break �[31mred\n"),
        (KeyboardInterrupt(), 130, "interrupted; nothing was written\n"),
        (click.Abort(), 130, "ilmek: interrupted; nothing was written\n"),
        (click.UsageError("What?"), 2, "ilmek: What?; see 'ilmek go --help'\n"),
        (
            PermissionError(errno.EACCES, "Permission denied", "a.json"),
            2,
            "a.json cannot be read or written: Permission",
        ),
        (MemoryError(), 2, "ilmek: out of memory"),
    ],
)
def test_errors_become_one_line(error: BaseException, status: int, said: str) -> None:
    result = CliRunner().invoke(failing(error), ["go"])
    assert (result.exit_code, result.stdout) == (status, "")
    assert said in result.stderr
    assert "Traceback" not in result.stderr


def test_a_defect_keeps_its_traceback() -> None:
    assert isinstance(CliRunner().invoke(failing(ZeroDivisionError()), ["go"]).exception, ZeroDivisionError)


def test_module_and_script_are_the_same_program() -> None:
    assert printed(program("--version")) == f"ilmek {ilmek.__version__}\n"


SLOW = """
import time
from pathlib import Path
import click
from ilmek.cli.frame import LazyGroup
from ilmek.io.output import Outputs

@click.command()
def command():
    with Outputs() as outputs, outputs.folder(Path("deep/out")) as work:
        (work / "chart.png").write_text("half")
        print("writing", flush=True)
        time.sleep(60)

LazyGroup.get_command = lambda self, ctx, name: command
LazyGroup(name="ilmek", modules={}).main(["go"])
"""


@pytest.mark.parametrize(("number", "status"), [(signal.SIGINT, 130), (signal.SIGTERM, 143), (signal.SIGHUP, 129)])
def test_nothing_is_half_written_after_a_signal(tmp_path: Path, number: signal.Signals, status: int) -> None:
    with start(python("-c", SLOW), cwd=tmp_path) as process:
        assert process.stdout.readline() == "writing\n"
        process.send_signal(number)
        errors = process.communicate(timeout=PATIENCE)[1]
    assert process.returncode == status
    assert errors == "ilmek: interrupted; nothing was written\n"
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("ignored", [signal.SIGINT, signal.SIGHUP])
def test_what_a_script_or_nohup_ignores_stays_ignored_and_a_termination_ends(tmp_path: Path, ignored: int) -> None:
    """`ilmek ... &` in a script goes on where Ctrl-C ends the script, `nohup ilmek ...` where the terminal closes."""
    background = f"import signal; signal.signal({int(ignored)}, signal.SIG_IGN)\n"
    with start(python("-c", background + SLOW), cwd=tmp_path) as process:
        assert process.stdout.readline() == "writing\n"
        process.send_signal(ignored)
        process.send_signal(signal.SIGTERM)
        errors = process.communicate(timeout=PATIENCE)[1]
    assert (process.returncode, errors) == (143, "ilmek: interrupted; nothing was written\n")


@pytest.mark.parametrize("arguments", [["machines"], ["machines", "--json", "-"], ["chart", "--help"]])
def test_a_reader_that_goes_away_is_no_traceback(arguments: list[str]) -> None:
    """The status is that of a program that the signal of a closed pipe ends: 128 + SIGPIPE."""
    read, write = os.pipe()
    os.close(read)
    try:
        shown = ended(python("-c", f"from ilmek.cli import main; main({arguments})"), stdout=write)
    finally:
        os.close(write)
    assert shown.returncode == 128 + signal.SIGPIPE
    assert shown.stderr == ""


@pytest.mark.parametrize("closed", [(1,), (2,), (0, 1, 2)])
def test_closed_streams_are_no_traceback(tmp_path: Path, closed: tuple[int, ...]) -> None:
    shut = "".join(f"os.close({number});" for number in closed)
    script = (
        f"import os, sys; {shut} os.execv(sys.executable, [sys.executable, '-m', 'ilmek', 'machines', '--json', 'a'])"
    )
    shown = ended(python("-c", script), cwd=tmp_path)
    assert shown.returncode == 0
    assert shown.stderr == ""
    assert json.loads((tmp_path / "a").read_text())["machines"]


def test_a_full_output_is_one_line() -> None:
    with Path("/dev/full").open("w") as full:
        shown = ended(program("machines"), stdout=full)
    assert shown.returncode == 2
    assert shown.stderr == "ilmek: the output cannot be read or written: No space left on device\n"


def test_a_terminal_without_the_signs_shows_question_marks() -> None:
    shown = ended(program("machines", "beat-up"), changes={"PYTHONIOENCODING": "ascii"})
    assert (shown.returncode, shown.stderr) == (0, "")


SWALLOWED = """
import signal, time
import click
from ilmek.cli.frame import LazyGroup

@click.command()
def command():
    print("working", flush=True)
    for _ in range(60):
        try:
            time.sleep(1)
        except BaseException:
            pass

LazyGroup.get_command = lambda self, ctx, name: command
LazyGroup(name="ilmek", modules={}).main(["go"])
"""


CAUGHT = SWALLOWED.replace("def command():", "def command():\n    native_messages().__enter__()").replace(
    "import click", "import click\nfrom ilmek.io.native_messages import native_messages"
)


@pytest.mark.parametrize("source", [SWALLOWED, CAUGHT])
def test_no_library_can_swallow_ctrl_c_or_its_message(tmp_path: Path, source: str) -> None:
    with start(python("-c", source), cwd=tmp_path) as process:
        assert process.stdout.readline() == "working\n"
        process.send_signal(signal.SIGINT)
        errors = process.communicate(timeout=PATIENCE)[1]
    assert (process.returncode, errors) == (130, "ilmek: interrupted; nothing was written\n")
