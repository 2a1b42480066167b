"""`ilmek studio` as a program: its one line, its end by any means, and what it refuses."""

import contextlib
import errno
import http.client
import os
import re
import signal
import socket
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
from click.testing import CliRunner

from ilmek.cli import main


@contextmanager
def started(project: Path, *options: str) -> Iterator[tuple["subprocess.Popen[str]", int, str]]:
    """A studio in a process: the process, its port and its token."""
    command = [sys.executable, "-m", "ilmek", "studio", str(project), "--no-browser", *options]
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    try:
        assert process.stdout is not None
        found = re.fullmatch(r"http://127\.0\.0\.1:(\d+)/\?token=([\w-]+)\n", process.stdout.readline())
        assert found is not None
        yield process, int(found[1]), found[2]
    finally:
        process.kill()
        process.communicate()


def get(port: int, path: str, **headers: str) -> tuple[int, bytes, str]:
    connection = http.client.HTTPConnection("127.0.0.1", port, timeout=20)
    with contextlib.closing(connection):
        connection.request("GET", path, headers=headers)
        reply = connection.getresponse()
        return reply.status, reply.read(), reply.getheader("set-cookie", "").partition(";")[0]


def children(number: int) -> list[int]:
    """The processes that a process has started."""
    listed = subprocess.run(["ps", "-o", "pid=", "--ppid", str(number)], capture_output=True, text=True, check=False)
    return [int(line) for line in listed.stdout.split()]


def assert_ended(numbers: list[int]) -> None:
    end = time.monotonic() + 5
    for number in numbers:
        with contextlib.suppress(ProcessLookupError):
            while Path(f"/proc/{number}/stat").read_text(encoding="utf-8").split(") ")[1][0] != "Z":
                assert time.monotonic() < end, "a worker outlives its server"
                time.sleep(0.02)
                os.kill(number, 0)


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
        _, errors = process.communicate(timeout=5)
        assert process.returncode == 130
        assert errors == f"ilmek: interrupted; the studio is closed; the project is in {tmp_path / 'carpets'}\n"
        assert_ended(workers)


def test_a_port_in_use_is_reported(tmp_path: Path) -> None:
    with socket.create_server(("127.0.0.1", 0)) as other:
        port = int(other.getsockname()[1])
        with started(tmp_path / "carpets", "--port", str(port)) as (process, taken, _):
            assert taken > port
            process.terminate()
            _, errors = process.communicate(timeout=5)
    assert errors.splitlines()[0] == f"note: port {port} is in use; the studio takes {taken}"


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
