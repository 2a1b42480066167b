"""The loom as a tree: a machine joins it by one package and one entry; each parameter of its machines is reached."""

import importlib
import sys
import textwrap
from dataclasses import fields, replace
from pathlib import Path

import pytest
from default_machines import loom_report

import ilmek.machines
from ilmek.cams.laws import LAWS
from ilmek.errors import ParameterError
from ilmek.jobs.loom import read_loom_order
from ilmek.jobs.order import read_order
from ilmek.machines import loom_machines
from ilmek.machines.automated_loom import AutomatedLoomParams, design
from ilmek.machines.catalogue import MACHINES
from ilmek.params import Parameter, Params, reachable
from ilmek.timing.track import Track, TrackSegment
from ilmek.units import deg

STUB = '''
"""A lamp over the fell: a machine of thirty lines."""

from dataclasses import dataclass

from ilmek.machines.component import Component, itself
from ilmek.params import Params, kind
from ilmek.records import computed, record
from ilmek.report import BillLine, Work, at_most


@dataclass(frozen=True, slots=True)
class LampParams(Params):
    width: float = kind.length(1.0, unit="m", above=0.0, at_most=20.0, doc="width that is lit")
    power: float = kind.power(20.0, above=0.0, at_most=1e3, doc="power of the lamp")


@record
class Lamp:
    params: LampParams
    power_width = computed("W", "power for a metre of the width", lambda lamp: lamp.params.power / lamp.params.width)


MACHINE = Component(
    name="lamp",
    title="Lamp",
    params=LampParams,
    design=Lamp,
    analysis=itself,
    checks=lambda lamp: (at_most("power of the lamp", lamp.params.power, 100.0, "W", "socket"),),
    parts=lambda lamp: (BillLine("lamp", 1, "", "", "bearing", mass=2.0),),
    work=lambda lamp: (Work("light", 60.0, "row"),),
    fit=lambda task: LampParams(width=task.params.width),
)
'''


@pytest.fixture
def lamp(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A package in the folder of the machines, and an entry in the catalogue."""
    (tmp_path / "lamp").mkdir()
    (tmp_path / "lamp" / "__init__.py").write_text(textwrap.dedent(STUB).lstrip(), encoding="utf-8")
    monkeypatch.setattr(ilmek.machines, "__path__", [*ilmek.machines.__path__, str(tmp_path)])
    monkeypatch.setitem(ilmek.machines.ENTRIES, "lamp", ilmek.machines.Entry("light over the fell", part=True))
    importlib.invalidate_caches()
    design.cache_clear()
    yield
    design.cache_clear()
    sys.modules.pop("ilmek.machines.lamp", None)


@pytest.mark.usefixtures("lamp")
def test_a_machine_joins_the_loom_by_one_package_and_one_entry() -> None:
    lit, plain = ({"lamp.power": "120W", "beat": "comb"}, {"beat": "comb"})
    with_lamp, without = (
        loom_report(design(AutomatedLoomParams.read({"aim": "price", **settings}))) for settings in (lit, plain)
    )
    assert with_lamp["lamp.power_width"] == pytest.approx(100.0)
    assert with_lamp.as_json()["results"]["lamp"] == {"power_width": pytest.approx(100.0)}
    assert [check.name for check in with_lamp.failed] == ["lamp: power of the lamp"]
    assert without.failed == ()
    shares, knots = with_lamp["power_shares"], float(str(with_lamp["weaving_time"]))
    assert isinstance(shares, dict)
    assert shares["light"] == pytest.approx(60.0 * float(str(without["rows"])) / 0.7 / knots)
    assert with_lamp["mass"] == pytest.approx(float(str(without["mass"])))
    assert "lamp" in [part.name for part in with_lamp.parts]


@pytest.mark.usefixtures("lamp")
def test_the_tracks_of_a_machine_are_on_the_cyclogram_of_a_row(monkeypatch: pytest.MonkeyPatch) -> None:
    law = LAWS["harmonic"]
    shade = Track(
        "shade",
        "motor",
        (TrackSegment("open", 0.0, 1.0, 0.0, 0.1, law), TrackSegment("close", 2.0, 3.0, 0.1, 0.0, law)),
    )
    package = importlib.import_module("ilmek.machines.lamp")
    monkeypatch.setattr(package, "MACHINE", replace(package.MACHINE, tracks=lambda _: (shade,)))
    row = design(AutomatedLoomParams(aim="price", beat="comb")).row_cyclogram
    assert row.track("shade") is shade
    assert [track.name for track in row.tracks][-1] == "shade"


def test_a_stub_machine_has_thirty_lines() -> None:
    assert len(STUB.strip().splitlines()) <= 42
    assert len([line for line in STUB.splitlines() if line.strip()]) <= 32


def another(parameter: Parameter) -> object:
    """A value within the bounds of a parameter, other than its default."""
    if parameter.choices:
        return next(choice for choice in parameter.choices if choice != parameter.default)
    if parameter.kind is bool:
        return not parameter.default
    if parameter.kind is str:
        return "text"
    bounds = (parameter.above, parameter.at_least, parameter.below, parameter.at_most)
    middle = [bound for bound in bounds if bound is not None]
    tried = [1.01 * (parameter.default or 0), 0.99 * (parameter.default or 0), *middle, sum(middle) / 2, 1.0]
    values = (round(value) if parameter.kind is int else value for value in tried)
    return next(value for value in values if value != parameter.default and parameter.within(value))


@pytest.mark.parametrize("machine", loom_machines())
def test_every_parameter_of_every_machine_is_reached_from_weave(machine: str) -> None:
    """Through the settings of `ilmek weave --loom`: the value arrives in the parameters that the machine gets.

    But cloth and hands, which all machines have from the loom.
    """
    order = read_order(Path("nowhere.png"))
    params = MACHINES[machine].params
    names = {name: one for name, one in reachable(params).items() if not name.startswith(("cloth.", "hands."))}
    assert names
    for name, parameter in names.items():
        value = another(parameter)
        asked = read_loom_order(order, loom={f"{machine}.{name}": value})
        assert asked.params.machines.of(machine) == {name: value}
        assert value_of(asked.params, f"{machine}.{name}") == value


def value_of(params: AutomatedLoomParams, dotted: str) -> object:
    return params.as_dict()[dotted]


@pytest.mark.parametrize(
    ("settings", "machine", "name", "value"),
    [
        ({"shedding.law": "modified-sine"}, "shedding", "law", "modified-sine"),
        ({"warp-tension.ratio": "25"}, "warp-tension", "ratio", 25.0),
        ({"warp_tension.ratio": "25"}, "warp-tension", "ratio", 25.0),
        ({"weaver.lever": "1.9"}, "weaver", "lever", 1.9),
        ({"beat-up.swing": "32deg"}, "beat-up", "swing", 32 * deg),
        ({"hammer.comb_depth": "90mm"}, "hammer", "comb_depth", 0.09),
    ],
)
def test_a_machine_in_the_loom_is_designed_with_the_value_set_for_it(
    settings: dict[str, str], machine: str, name: str, value: object
) -> None:
    loom = design(
        AutomatedLoomParams.read({"aim": "price", "beat": "travelling" if machine == "beat-up" else "comb", **settings})
    )
    (child,) = (child for child in loom.children if child.name == machine)
    assert getattr(child.design.params, name) == pytest.approx(value)


def test_a_value_that_contradicts_the_machine_is_refused_with_its_name() -> None:
    with pytest.raises(ParameterError, match=r"^weaver: prepare_end=.* leaves the step"):
        design(AutomatedLoomParams.read({"aim": "price", "weaver.prepare_end": "5deg"}))
    with pytest.raises(ParameterError, match=r"did you mean shedding.law\?"):
        AutomatedLoomParams.read({"aim": "price", "sheding.law": "cycloidal"})


def test_loom_sums_what_its_machines_return() -> None:
    report = loom_report(loom := design(AutomatedLoomParams(aim="price", beat="comb")))
    assert [child.machine for child in report.children] == [child.name for child in loom.children]
    checks = {check.name for child in report.children for check in child.all_checks}
    assert {check.name.split(": ", 1)[-1] for check in report.all_checks} > checks
    of_machines = {part.name for child in loom.machines.values() for part in child.parts}
    assert of_machines < {part.name for part in report.parts}
    assert all(isinstance(child.design.params, Params) for child in loom.children)
    assert {one.name for one in fields(loom)} >= {"machines", "beat", "task"}
