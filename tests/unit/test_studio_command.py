"""`ilmek studio` as a program: its one line, its end by any means, and what it refuses."""

import contextlib
import errno
import http.client
import os
import re
import signal
import socket
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner
from processes import PATIENCE, ended, ilmek, start, until

from ilmek.cli import main
from ilmek.jobs.studio.project.opening import open_project, served_alone


@contextmanager
def started(project: Path, *options: str, token: bool = True) -> Iterator[tuple[Any, int, str]]:
    """A studio in a process: the process, its port and its token, if it has one."""
    with start(ilmek("studio", project, "--no-browser", *options)) as process:
        pattern = r"http://127\.0\.0\.1:(\d+)/" + (r"\?token=([\w-]+)\n" if token else "()\n")
        address = re.fullmatch(pattern, process.stdout.readline())
        assert address is not None
        yield process, int(address[1]), address[2]


def get(port: int, path: str, **headers: str) -> tuple[int, bytes, str]:
    connection = http.client.HTTPConnection("127.0.0.1", port, timeout=PATIENCE)
    with contextlib.closing(connection):
        connection.request("GET", path, headers=headers)
        reply = connection.getresponse()
        return reply.status, reply.read(), reply.getheader("set-cookie", "").partition(";")[0]


def children(number: int) -> list[int]:
    """The processes that a process has started."""
    return [int(word) for word in ended(["ps", "-o", "pid=", "--ppid", str(number)]).stdout.split()]


def assert_ended(numbers: list[int]) -> None:
    for number in numbers:
        until(lambda: has_ended(number), f"the end of worker {number}")  # noqa: B023 - called at once


def has_ended(number: int) -> bool:
    try:
        return Path(f"/proc/{number}/stat").read_text(encoding="utf-8").rpartition(") ")[2][0] == "Z"
    except (FileNotFoundError, ProcessLookupError):
        return True


def test_a_page_is_known_after_the_server_was_killed_and_started_again(tmp_path: Path) -> None:
    with started(tmp_path / "carpets", "--port", "0") as (process, port, token):
        status, _, cookie = get(port, f"/?token={token}")
        assert status == 303
        assert get(port, "/api/machines", Cookie=cookie)[0] == 200
        workers = children(process.pid)
        assert workers
        process.kill()
        process.wait()
        assert_ended(workers)
    with started(tmp_path / "carpets", "--port", str(port)) as (process, again, other):
        assert (again, other != token) == (port, True)
        assert get(port, "/api", Cookie=cookie)[0] == 200
        workers = children(process.pid)
        process.send_signal(signal.SIGINT)
        further, errors = process.communicate(timeout=PATIENCE)
        assert (process.returncode, further) == (130, "")
        assert errors == f"ilmek: interrupted; the studio is closed; the project is in {tmp_path / 'carpets'}\n"
        assert_ended(workers)


def test_a_port_in_use_is_reported(tmp_path: Path) -> None:
    with socket.create_server(("127.0.0.1", 0)) as other:
        port = int(other.getsockname()[1])
        with started(tmp_path / "carpets", "--port", str(port)) as (process, taken, _):
            assert taken > port
            process.terminate()
            _, errors = process.communicate(timeout=PATIENCE)
    assert errors.splitlines()[0] == f"note: port {port} is in use; the studio takes {taken}"


def test_a_second_studio_on_the_project_is_reported(tmp_path: Path) -> None:
    note = "note: the project is open in another studio too; each shows what the other saves"
    with started(tmp_path / "carpets", "--port", "0") as (one, *_), started(tmp_path / "carpets", "--port", "0") as two:
        for process, reported in ((one, False), (two[0], True)):
            process.send_signal(signal.SIGINT)
            assert (note in process.communicate(timeout=PATIENCE)[1].splitlines()) is reported


def test_a_studio_in_the_background_of_a_script_is_ended_by_a_termination(tmp_path: Path) -> None:
    """Its parent ignores Ctrl-C; so does the studio, and ends as ever by SIGTERM, with its workers."""
    shell = ["sh", "-c", 'trap "" INT; exec "$@"', "sh", *ilmek("studio", tmp_path / "p", "--no-browser", "--port", 0)]
    with start(shell) as process:
        assert "token" in process.stdout.readline()
        workers = until(lambda: children(process.pid), "a worker")
        process.send_signal(signal.SIGINT)
        process.terminate()
        errors = process.communicate(timeout=PATIENCE)[1]
    assert process.returncode == 143
    assert errors == f"ilmek: interrupted; the studio is closed; the project is in {tmp_path / 'p'}\n"
    assert_ended(workers)


def test_a_project_is_served_alone_again_after_the_others_end(tmp_path: Path) -> None:
    project = open_project(tmp_path / "carpets")
    with served_alone(project) as first, served_alone(project) as second:
        assert (first, second) == (True, False)
    with served_alone(project) as third:
        assert third


def test_no_secret_is_on_a_command_line_or_in_the_environment(tmp_path: Path) -> None:
    (tmp_path / "password").write_text("right horse staple\n")
    (tmp_path / "password").chmod(0o600)
    options = ("--port", "0", "--password-file", str(tmp_path / "password"))
    with started(tmp_path / "carpets", *options, token=False) as (process, port, _):
        assert get(port, "/")[0] == 303
        shown = secrets_of(process.pid)
    with started(tmp_path / "carpets", "--port", "0") as (process, port, token):
        assert get(port, "/api/machines", Authorization=f"Bearer {token}")[0] == 200
        shown += secrets_of(process.pid)
    assert b"ilmek" in shown
    for secret in ("horse", token, (tmp_path / "carpets" / ".studio" / "secret").read_text()):
        assert secret.encode() not in shown


def secrets_of(number: int) -> bytes:
    """What other programs can see of a process and its workers."""
    folders = [Path(f"/proc/{process}") for process in (number, *children(number))]
    return b"".join((folder / name).read_bytes() for folder in folders for name in ("cmdline", "environ"))


def refused(*arguments: str, typed: str = "") -> str:
    result = CliRunner().invoke(main, ["studio", "--no-browser", *arguments], input=typed)
    assert result.exit_code == 2, result.output
    return result.output


def test_what_cannot_be_served_is_refused_in_one_line(tmp_path: Path) -> None:
    file = tmp_path / "file"
    file.write_text("")
    (tmp_path / "empty").write_text("")
    (tmp_path / "empty").chmod(0o600)
    assert "port 70000; 0 to 65535" in refused(str(tmp_path / "p"), "--port", "70000")
    assert "is a file" in refused(str(file))
    assert "other files" in refused(str(tmp_path))
    assert "no password" in refused(str(tmp_path / "p"), "--host", "0.0.0.0", typed="\n")
    assert "short password" in refused(str(tmp_path / "p"), "--host", "0.0.0.0", typed="short\n")
    assert "has 0 bytes" in refused(
        str(tmp_path / "p"), "--host", "0.0.0.0", "--password-file", str(tmp_path / "empty")
    )
    assert not (tmp_path / "p").exists()


@pytest.mark.parametrize(("code", "text"), [("ENOSPC", "No space left"), ("EACCES", "Permission denied")])
def test_a_full_disc_and_a_locked_folder_are_one_line(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, code: str, text: str
) -> None:
    number = getattr(errno, code)

    def fails(*arguments: object, **options: object) -> None:
        raise OSError(number, os.strerror(number))

    monkeypatch.setattr(os, "scandir", fails)
    assert text in refused(str(tmp_path / "p"))
