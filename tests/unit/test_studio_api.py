"""The API as programs use it, over HTTP: what it answers is what the command line writes."""

import re
import runpy
import sys
import tomllib
from collections.abc import Iterator
from pathlib import Path

import pytest
from click.testing import CliRunner
from studio_server import Studio, studio

from ilmek.cli import main
from ilmek.jobs.machines import machine_list
from ilmek.jobs.studio.project.opening import open_project
from ilmek.web.openapi import openapi

PAGE = Path(__file__).parents[2] / "docs" / "reference" / "studio-api.md"
DESIGNS = {
    "beat-up": {"swing": "32deg"},
    "cam": {"lift": "25mm", "law": "cycloidal"},
    "shedding": {},
    "hammer": {},
    "knotting-dyad": {},
}


@pytest.fixture(scope="module")
def server(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Studio]:
    with studio(open_project(tmp_path_factory.mktemp("api") / "project"), size=2, real=True) as served:
        yield served


def test_the_machines_are_those_of_the_command_line(server: Studio) -> None:
    listed = server.send("GET", "/api/machines").json["machines"]
    assert {one["name"]: one["summary"] for one in listed} == machine_list()


@pytest.mark.parametrize("name", DESIGNS)
def test_a_design_is_byte_for_byte_the_json_of_the_command_line(server: Studio, name: str) -> None:
    options = [part for setting, value in DESIGNS[name].items() for part in ("--set", f"{setting}={value}")]
    written = CliRunner().invoke(main, ["design", name, *options, "--json", "-"])
    answer = server.send("POST", f"/api/machines/{name}/design", {"settings": DESIGNS[name]})
    assert (answer.status, answer.headers["content-type"]) == (200, "application/json")
    assert answer.body == written.stdout.encode()


def test_a_mechanism_is_answered(server: Studio) -> None:
    file = tomllib.loads((server.project / "linkages" / "four-bar.toml").read_text(encoding="utf-8"))
    answer = server.send("POST", "/api/mechanism", {"mechanism": file, "steps": 90})
    assert answer.status == 200
    assert server.send("POST", "/api/mechanism", {}).given == "Object missing required field `mechanism`"


def test_the_api_describes_itself(server: Studio) -> None:
    answer = server.send("GET", "/api/openapi.json")
    assert answer.json == openapi()
    page = server.send("GET", "/api")
    assert page.headers["content-type"].startswith("text/html")


def test_the_example_of_the_page_runs(
    server: Studio, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    example = re.findall(r"```python\n(.*?)```", PAGE.read_text(encoding="utf-8"), re.DOTALL)
    assert len(example) == 1
    (tmp_path / "example.py").write_text(example[0], encoding="utf-8")
    address = f"http://127.0.0.1:{server.port}/?token={server.access.token}"
    monkeypatch.setattr(sys, "argv", ["example.py", address])
    runpy.run_path(str(tmp_path / "example.py"), run_name="__main__")
    shown = capsys.readouterr().out.splitlines()
    assert shown[0] == f"{len(machine_list())} machines"
    assert shown[1].startswith("beat-up with a swing of 30deg: ")
    assert shown[2] == "out/machine-beat-up.html"
    assert (server.project / shown[2]).is_file()
