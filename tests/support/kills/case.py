"""One command, killed once, and what is found afterwards."""

import os
import re
import select
import shutil
import signal
import subprocess
import sys
import time
from dataclasses import dataclass, field
from pathlib import Path

from power_cut import Tree, read_tree

from ilmek.io.output.staging import repair
from kills.child import PAUSE
from kills.commands import EXAMPLES, ROOT, Command, prepare

SIGNALS = (signal.SIGKILL, signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
LONGEST = 120.0
DONE = (0, 3)
"""Exit codes of a command that is done; 3: a check fails."""

"""Time after which a command is taken to hang [s]."""

_HIDDEN = re.compile(r"\..+\.(part|old)$|.*\.kept(\..+)?$")
_OWN_FRAME = re.compile(r'File "(?!.*/ilmek/(__init__|lazy)\.py")[^"]*/ilmek/')
"""A frame of ilmek in a traceback; before its first line Python itself shows one for Ctrl-C."""


@dataclass(frozen=True)
class Kill:
    """When a command is killed, and how.

    at      time after its start [s], or the number of a call of the write protocol
    signal  number of the signal
    after   in the pause after the call, not in that before it
    """

    command: Command
    signal: signal.Signals
    at: float | int
    after: bool = False

    def __str__(self) -> str:
        side = "after" if self.after else "before"
        when = f"{side} call {self.at}" if isinstance(self.at, int) else f"at {self.at:.3f} s"
        return f"{self.command.name} {self.signal.name} {when}"


@dataclass
class Result:
    """What came of a kill.

    ended     the process ended before the signal
    status    of the process
    delay     from the signal to its end [s]
    errors    what it wrote to the error stream
    outcome   the outputs are "old", "new", or some of them are new ("both")
    left      something hidden was left, for the next run to repair
    findings  what is wrong; none, if all is well
    """

    kill: Kill
    ended: bool
    status: int
    delay: float
    errors: str
    outcome: str = ""
    left: bool = False
    findings: list[str] = field(default_factory=list)


@dataclass(frozen=True)
class Bench:
    """A folder in which a command is killed again and again.

    results  the outputs of both variants, as an undisturbed run makes them
    seconds  duration of an undisturbed run
    calls    number of calls of the write protocol
    """

    folder: Path
    command: Command
    results: tuple[dict[str, Tree | bytes], dict[str, Tree | bytes]]
    seconds: float
    calls: int

    @property
    def pristine(self) -> Path:
        """A copy of the folder with the old results."""
        return self.folder.with_name(f"{self.folder.name}-old")


def bench(folder: Path, command: Command) -> Bench:
    """Run both variants undisturbed: the second over the results of the first, which are then restored."""
    prepare(folder)
    _succeed(command.line(0), folder)
    shutil.copytree(folder, folder.with_name(f"{folder.name}-old"))
    old = outputs(folder, command)
    _succeed(command.line(1), folder)  # compiled kernels are there from now on
    begin = time.perf_counter()
    _succeed(command.line(1), folder)
    seconds = time.perf_counter() - begin
    made = Bench(folder, command, (old, outputs(folder, command)), seconds, 0)
    restore(made)
    return Bench(folder, command, made.results, seconds, _counted(made))


def restore(made: Bench) -> None:
    """Put the old results back."""
    shutil.rmtree(made.folder)
    shutil.copytree(made.pristine, made.folder)


def killed(made: Bench, kill: Kill, *, again: bool) -> Result:
    """Run the second variant over the results of the first, kill it, check; `again`: run it once more."""
    restore(made)
    result = interrupted(made.folder, kill)
    _check(made, result)
    if again or result.left:
        result.findings += _next_run(made)
    return result


def interrupted(folder: Path, kill: Kill) -> Result:
    """Run the second variant and kill it."""
    for number in SIGNALS[1:]:  # a shell behind `nohup` or `&` hands on that it ignores some
        signal.signal(number, signal.default_int_handler if number == signal.SIGINT else signal.SIG_DFL)
    read, write = os.pipe()
    line = [sys.executable, "-m", "ilmek", *kill.command.line(1)]
    if isinstance(kill.at, int):
        line[2:3] = ["kills.child", str(kill.at), str(write)]
    given = {"cwd": folder, "env": environment(), "stdout": subprocess.DEVNULL, "stderr": subprocess.PIPE}
    with subprocess.Popen(line, text=True, pass_fds=[write], **given) as process:
        os.close(write)
        if isinstance(kill.at, int):
            select.select([read], [], [], LONGEST)
            time.sleep(1.5 * PAUSE if kill.after else 0.0)
        else:
            _wait(process, kill.at)
        ended = process.poll() is not None
        begin = time.perf_counter()
        process.send_signal(kill.signal)
        try:
            errors = process.communicate(timeout=LONGEST)[1]
        except subprocess.TimeoutExpired:
            process.kill()
            errors = process.communicate()[1] + "hangs"
        delay = time.perf_counter() - begin
    os.close(read)
    return Result(kill, ended, process.returncode, delay, errors)


def _check(made: Bench, result: Result) -> None:
    """Complete the result: what was written, and is everything that was stated true?"""
    old, new = made.results
    found = outputs(made.folder, made.command)
    result.outcome = "new" if found == new else "old" if found == old else "both"
    result.left = any(_HIDDEN.match(path.name) for path in made.folder.iterdir())
    if result.kill.signal != signal.SIGKILL or result.status >= 0:
        result.findings += _false(result)
    if result.left:
        _repair(made)
        found = outputs(made.folder, made.command)
    result.findings += [f"{name} is neither old nor new" for name in old if found[name] not in (old[name], new[name])]
    changed = [name for name in EXAMPLES if (made.folder / name).read_bytes() != (made.pristine / name).read_bytes()]
    result.findings += [f"input {name} has changed" for name in changed]


def _false(result: Result) -> list[str]:
    """What is wrong with the status and the message."""
    number, status, outcome = result.kill.signal, result.status, result.outcome
    lines = [line for line in result.errors.splitlines() if not line.startswith("note: ")]
    text = "\n".join(lines)
    if status == 0 and not lines:
        return [] if outcome == "new" else ["status 0, but nothing new"]
    if status in (-number, 1, 130) and not _OWN_FRAME.search(text) and not text.startswith("ilmek: "):
        return [] if outcome == "old" else ["ended while Python started, but the outputs are not the old ones"]
    if status != 128 + number or len(lines) != 1 or not text.startswith("ilmek: interrupted; "):
        return [f"status {status}, {text[-400:]!r}"]
    stated = "new" if "the new result is in place" in text else "old" if "nothing was written" in text else "nothing"
    return [] if stated == outcome else [f"{text!r}, but the outputs are {outcome}"]


def _next_run(made: Bench) -> list[str]:
    done = subprocess.run(
        [sys.executable, "-m", "ilmek", *made.command.line(1)], cwd=made.folder, env=environment(), text=True,
        capture_output=True, check=False, timeout=LONGEST,
    )  # fmt: skip
    if done.returncode not in DONE or outputs(made.folder, made.command) != made.results[1]:
        return [f"the next run: status {done.returncode}, {done.stderr[-300:]!r}"]
    left = [path.name for path in made.folder.iterdir() if _HIDDEN.match(path.name)]
    return [f"left by the next run: {', '.join(left)}"] if left else []


def _repair(made: Bench) -> None:
    """What the next run does first."""
    for name in made.command.outputs:
        repair(made.folder / name)


def outputs(folder: Path, command: Command) -> dict[str, Tree | bytes]:
    """The outputs as they are; missing ones are empty."""
    found: dict[str, Tree | bytes] = {}
    for name in command.outputs:
        path = folder / name
        found[name] = read_tree(path) if path.is_dir() else path.read_bytes() if path.exists() else b""
    return found


def environment() -> dict[str, str]:
    """The environment of a command: the sources of this checkout."""
    paths = (str(ROOT / "src"), str(ROOT / "tests" / "support"))
    return dict(os.environ, PYTHONPATH=os.pathsep.join(paths), SOURCE_DATE_EPOCH="0")


def _wait(process: "subprocess.Popen[str]", seconds: float) -> None:
    try:
        process.wait(seconds)
    except subprocess.TimeoutExpired:
        return


def _succeed(arguments: list[str], folder: Path) -> None:
    line = [sys.executable, "-m", "ilmek", *arguments]
    done = subprocess.run(line, cwd=folder, env=environment(), text=True, capture_output=True, check=False)
    if done.returncode not in DONE:
        raise SystemExit(f"{' '.join(arguments)}: status {done.returncode}, {done.stderr}")


def _counted(made: Bench) -> int:
    """The number of calls of the write protocol in an undisturbed run."""
    read, write = os.pipe()
    line = [sys.executable, "-m", "kills.child", "0", str(write), *made.command.line(1)]
    subprocess.run(line, cwd=made.folder, env=environment(), capture_output=True, check=True, pass_fds=[write])
    os.close(write)
    with os.fdopen(read) as pipe:
        return int(pipe.read())
