"""A machine of one part, one joint and one check joins the loom by one package and one entry, with all its views."""

import importlib
import importlib.util
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

import ilmek.machines
from ilmek.jobs.workshop import write_workshop
from ilmek.machines.automated_loom import MACHINE, AutomatedLoomParams, design
from ilmek.part.placement import IDENTITY
from ilmek.part.space import frames_of, parts_of
from ilmek.report import Report

STUB = '''
"""A lamp over the fell."""

from dataclasses import dataclass

from ilmek.elements.materials import find_material
from ilmek.machines.component import Component, itself
from ilmek.params import Params, kind
from ilmek.part.part import Part
from ilmek.part.shapes import box
from ilmek.part.tree import Joint, JointKind, Occurrence, RigidBody, Tree
from ilmek.records import record
from ilmek.report import at_most
@dataclass(frozen=True, slots=True)
class LampParams(Params):
    width: float = kind.length(1.0, unit="m", above=0.0, at_most=20.0, doc="width that is lit")
@record
class Lamp:
    params: LampParams
    @property
    def shade(self):
        section = box(self.params.width, 0.05, 0.002)
        return Part("lamp/shade", "shade of the lamp", "laser-cut part", section, find_material("structural steel"))
    @property
    def tree(self):
        return Tree((RigidBody("lamp", (Occurrence(self.shade),), joint=Joint(JointKind.MISSING)),))
def checks(lamp):
    return (at_most("mass of the shade", lamp.shade.mass, 0.5, "kg", "hook").with_cure("", "lamp/shade"),)
MACHINE = Component(
    name="lamp", title="Lamp", params=LampParams, design=Lamp, analysis=itself, results=lambda _: (),
    checks=checks, tree=lambda lamp: lamp.tree, fit=lambda task: LampParams(width=task.params.width),
)
'''


@pytest.fixture
def report(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Report]:
    """The report of a loom with the lamp: its package in the folder of the machines, its entry in the catalogue."""
    (tmp_path / "lamp").mkdir()
    (tmp_path / "lamp" / "__init__.py").write_text(STUB.lstrip(), encoding="utf-8")
    monkeypatch.setattr(ilmek.machines, "__path__", [*ilmek.machines.__path__, str(tmp_path)])
    monkeypatch.setitem(ilmek.machines.ENTRIES, "lamp", ilmek.machines.Entry("light", part=True))
    importlib.invalidate_caches()
    design.cache_clear()
    yield MACHINE.report(design(AutomatedLoomParams(aim="price", beat="comb")), illustrated=False, assembled=False)
    design.cache_clear()
    sys.modules.pop("ilmek.machines.lamp", None)


def test_a_stub_machine_is_in_the_list_the_checks_space_dxf_and_step(report: Report, tmp_path: Path) -> None:
    (line,) = (line for line in report.parts if line.part == "lamp/shade")
    width = AutomatedLoomParams(aim="price").width
    assert (line.name, line.number) == ("shade of the lamp", 1)
    assert line.mass == pytest.approx(width * 0.05 * 0.002 * 7850, rel=0.01)
    (check,) = (check for check in report.all_checks if "lamp/shade" in check.parts)
    assert check.value == line.mass
    assert check.ok == (line.mass <= 0.5)
    assert "lamp-shade" in [plate.name for plate in report.all_plates]
    (child,) = (child for child in report.children if child.machine == "lamp")
    workshop = write_workshop(child, tmp_path / "parts")
    assert workshop.left_out == ()
    assert {Path(name).suffix for name in workshop.files} >= {".dxf"}
    if importlib.util.find_spec("OCP"):
        assert {Path(name).suffix for name in workshop.files} >= {".step"}
    # The scene of a loom still names its machines one by one: frames and parts are made here as it makes theirs.
    (lamp,) = (
        child for child in design(AutomatedLoomParams(aim="price", beat="comb")).children if child.name == "lamp"
    )
    tree = lamp.design.tree
    (frame,) = frames_of(tree, "ground", IDENTITY)
    (part,) = parts_of(tree, "lamp", IDENTITY, report.all_checks)
    assert frame.name == part.frame
    assert part.solids[0].points[:, 0].max() - part.solids[0].points[:, 0].min() == pytest.approx(width)
    assert [check.value for check in part.checks] == [pytest.approx(part.mass)]
