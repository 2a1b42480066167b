"""Machines, motion laws, chart formats and controllers of another package, installed as pip installs one."""

import os
import sys
from pathlib import Path

import pytest
from processes import ended, ilmek, python

ENTRY_POINTS = """
[ilmek.machines]
lamp = carpet_lamp:ENTRY
beat-up = carpet_lamp:ENTRY
[ilmek.motion_laws]
smoothstep = carpet_lamp:FAMILY
[ilmek.chart_formats]
rle = carpet_lamp:FORMAT
[ilmek.controllers]
soft = carpet_lamp:TARGET
"""

PACKAGE = """
from dataclasses import dataclass, replace
from ilmek.cams.laws import FAMILIES
from ilmek.cams.laws.law import LawFamily
from ilmek.io.chart.formats import ChartFormat
from ilmek.io.plc.targets import TARGETS
from ilmek.machines import Entry
from ilmek.machines.component import Component, itself
from ilmek.params import Params, kind
from ilmek.records import record
from ilmek.report import at_most

@dataclass(frozen=True, slots=True)
class LampParams(Params):
    width: float = kind.length(1.0, unit="m", above=0.0, at_most=20.0, doc="width that is lit")

@record
class Lamp:
    params: LampParams

def write(path, chart, progress):
    path.write_text(" ".join(map(str, chart.knots.ravel().tolist())))

ENTRY = Entry("light over the fell", package="carpet_lamp")
MACHINE = Component(
    name="lamp", title="Lamp", params=LampParams, design=Lamp, analysis=itself, results=lambda _: (),
    checks=lambda lamp: (at_most("width of the light", lamp.params.width, 3.0, "m", "carpet"),),
)
FAMILY = LawFamily(lambda: FAMILIES["3-4-5"].make())
FORMAT = ChartFormat("rle", "a list", "a list of knots", write)
TARGET = replace(TARGETS["codesys"], title="Soft controller")
"""

USE = """
import ilmek, numpy as np, sys
from ilmek.io.plc.targets import TARGETS
chart = ilmek.Chart.of([[0, 1], [1, 1]], ilmek.read_yarns()[:2], "4x4cm", "5x5/dm")
ilmek.write_chart("chart.rle", chart)
print(open("chart.rle").read())
failed = [check.name for check in ilmek.design("lamp", width="4m").failed]
print(failed, ilmek.list_machines()["lamp"], ilmek.design("beat-up").machine)
print(float(ilmek.motion_law("smoothstep").s(0.5)), TARGETS["soft"].title, list(TARGETS)[-1])
print([entry.name for entry in ilmek.parameters("lamp")])
"""


BROKEN = """
import ilmek
ilmek.motion_law("cycloidal")
try:
    ilmek.motion_law("x")
except ilmek.IlmekError as error:
    print(error)
"""


@pytest.fixture
def installed(tmp_path: Path) -> dict[str, str | None]:
    """An environment in which the package is installed."""
    (tmp_path / "carpet_lamp.py").write_text(PACKAGE, encoding="utf-8")
    facts = tmp_path / "carpet_lamp-1.0.dist-info"
    facts.mkdir()
    (facts / "METADATA").write_text("Metadata-Version: 2.1\nName: carpet-lamp\nVersion: 1.0\n", encoding="utf-8")
    (facts / "entry_points.txt").write_text(ENTRY_POINTS, encoding="utf-8")
    return {"PYTHONPATH": os.pathsep.join([str(tmp_path), *sys.path])}


def test_entries_of_another_package_join(installed: dict[str, str | None], tmp_path: Path) -> None:
    answer = ended(python("-c", USE), changes=installed, cwd=tmp_path)
    assert answer.stderr == ""
    assert answer.stdout.splitlines() == [
        "0 1 1 1",
        "['width of the light'] light over the fell beat-up",
        "0.5 Soft controller soft",
        "['width']",
    ]


def test_the_command_line_has_them_too(installed: dict[str, str | None], tmp_path: Path) -> None:
    assert "lamp" in ended(ilmek("machines"), changes=installed, cwd=tmp_path).stdout
    design = ended(ilmek("design", "lamp", "--set", "width=2m"), changes=installed, cwd=tmp_path)
    assert (design.returncode, design.stderr) == (0, "")
    assert "soft" in ended(ilmek("plc", "--help"), changes=installed, cwd=tmp_path).stdout


@pytest.mark.parametrize(("line", "words"), [("x = nowhere:LAW", "fails"), ("x = carpet_lamp:ENTRY", "is a Entry")])
def test_a_broken_entry_is_one_clear_error(
    installed: dict[str, str | None], tmp_path: Path, line: str, words: str
) -> None:
    facts = tmp_path / "carpet_lamp-1.0.dist-info" / "entry_points.txt"
    facts.write_text(f"[ilmek.motion_laws]\n{line}\n", encoding="utf-8")
    answer = ended(python("-c", BROKEN), changes=installed, cwd=tmp_path)
    assert words in answer.stdout
    assert answer.stderr == ""
