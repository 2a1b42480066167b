"""Declared parameters: bounds, kinds, unknown names and the slips they guess."""

import math
from dataclasses import dataclass

import pytest

from ilmek.errors import ParameterError
from ilmek.machines.cam import CamParams
from ilmek.params import Overrides, Params, declared, kind, nested, overrides, param, reachable
from ilmek.units import deg, mm


@dataclass(frozen=True, slots=True)
class Sample(Params):
    swing: float = param(30 * deg, unit="deg", above=0.0, below=math.pi, doc="swing")
    lift: float = param(60 * mm, unit="mm", above=0.0, at_most=1.0, doc="lift", alias="H1")
    warps: int = param(600, at_least=2, doc="warps")
    law: str = param("harmonic", choices=("harmonic", "cycloidal"), doc="law")
    both: bool = param(False, doc="both")
    crank: float | None = param(None, unit="mm", above=0.0, doc="crank")


def test_a_bound_is_reached_in_every_unit() -> None:
    """10 um is the bound of 0.01 mm, though 10 times 1e-6 is less than 1e-5 in floating point."""
    lift = next(one for one in declared(CamParams) if one.name == "lift")
    assert lift.read("10um") == lift.read("0.01mm") == lift.at_least
    with pytest.raises(ParameterError, match="at least"):
        lift.read("9.99um")


def test_reads_units_and_keeps_defaults() -> None:
    sample = Sample.read({"swing": "170deg", "warps": "300", "both": "yes", "crank": "59.7mm"})
    assert sample.swing == pytest.approx(170 * deg)
    assert (sample.warps, sample.both, sample.lift) == (300, True, 60 * mm)
    assert sample.crank == pytest.approx(0.0597)
    assert [p.name for p in declared(Sample)] == ["swing", "lift", "warps", "law", "both", "crank"]


@pytest.mark.parametrize(
    ("settings", "said"),
    [
        ({"swnig": "30deg"}, "did you mean swing"),
        ({"lift": "50mm", "h1": "60mm"}, "lift is set twice, as lift and as h1"),
        ({"H1": "60kg"}, "lift: '60kg' has the wrong unit"),
        ({"h12": "60mm"}, "did you mean h1"),
        ({"swing": "200deg"}, "below 180 deg"),
        ({"swing": "30"}, "did you mean 30deg"),
        ({"lift": "60"}, "did you mean 60mm"),
        ({"lift": "0mm"}, "above 0 mm"),
        ({"lift": "60kg"}, "wrong unit"),
        ({"lift": float("nan")}, "not a number"),
        ({"lift": "1e-320"}, "is too small"),
        ({"lift": 1e-70}, "did you mean 0"),
        ({"lift": 1e300}, "is too large"),
        ({"warps": "3.5"}, "whole number"),
        ({"warps": "1"}, "at least 2"),
        ({"law": "harmonik"}, "did you mean harmonic"),
        ({"both": "maybe"}, "neither true nor false"),
        ({"crank": "-1mm"}, "above 0 mm"),
        ({"swing": "none"}, "not a quantity"),
    ],
)
def test_says_what_is_wrong(settings: dict[str, str], said: str) -> None:
    with pytest.raises(ParameterError, match=said):
        Sample.read(settings)


@pytest.mark.parametrize("name", ["lift", "H1", "h1"])
def test_an_alias_sets_the_same_parameter(name: str) -> None:
    assert Sample.read({name: "50mm"}).as_dict()["lift"] == 50 * mm


@dataclass(frozen=True, slots=True)
class Inner(Params):
    rise: float = kind.angle(60 * deg, above=0.0, below=math.pi, doc="rise")
    density: float = kind.knot_density(250.0, at_least=1.0, at_most=1e4, doc="knots across")


@dataclass(frozen=True, slots=True)
class Outer(Params):
    lift: float = kind.length(60 * mm, unit="m", above=0.0, at_most=1.0, doc="lift")
    handler: Inner = nested(Inner, doc="pile handler")
    machines: Overrides = overrides(lambda: {"sample": Sample, "outer": Middle}, doc="machines in the loom")


@dataclass(frozen=True, slots=True)
class Middle(Params):
    inner: Inner = nested(Inner, doc="inner")


def test_dotted_names_reach_nested_parameters_and_those_of_other_machines() -> None:
    outer = Outer.read({"lift": "5cm", "handler.rise": "70deg", "sample.law": "cycloidal", "outer.inner.rise": "80deg"})
    assert outer.handler == Inner(rise=70 * deg)
    assert outer.machines.over("sample", Sample(warps=300)) == Sample(warps=300, law="cycloidal")
    assert outer.machines.over("outer", Middle()).inner.rise == pytest.approx(80 * deg)
    assert outer.as_dict() == {
        "lift": 0.05,
        "handler.rise": 70 * deg,
        "handler.density": 250.0,
        "sample.law": "cycloidal",
        "outer.inner.rise": pytest.approx(80 * deg),
    }
    assert {"lift", "handler.rise", "sample.swing", "outer.inner.density"} < set(reachable(Outer))
    assert outer != Outer()
    assert hash(outer) != hash(Outer())


@dataclass(frozen=True, slots=True)
class Steep(Params):
    handler: Inner = nested(Inner, default=Inner(rise=80 * deg), doc="a handler with defaults of its own")
    around: Middle = nested(Middle, default=Middle(inner=Inner(density=400.0)), doc="two levels")


def test_a_nested_record_may_have_other_defaults_than_its_class() -> None:
    assert Steep.read({"handler.density": "30/dm"}).handler == Inner(rise=80 * deg, density=300.0)
    assert Steep.read({"around.inner.rise": "50deg"}).around.inner == Inner(rise=50 * deg, density=400.0)
    assert Steep.read({}) == Steep()
    known = reachable(Steep)
    assert {name: known[name].default for name in known} == Steep().as_dict()
    assert repr(Steep()) == "Steep()"


@pytest.mark.parametrize(
    ("settings", "message"),
    [
        ({"handler.ries": "70deg"}, r"unknown parameter 'handler.ries'; did you mean handler.rise\?"),
        ({"handler.rise": "200deg"}, r"handler.rise=200 deg is out of bounds; allowed: .* below 180 deg"),
        ({"sample.lwa": "cycloidal"}, r"did you mean sample.law\?"),
        ({"sample.warps": "1"}, "sample.warps=1 is out of bounds; allowed: at least 2"),
        ({"smaple.law": "cycloidal"}, r"did you mean sample.law\?"),
        ({"rise": "70deg"}, r"did you mean handler.rise\?"),
        ({"handler.density": "40"}, r"handler.density=40 has no unit; did you mean 40/dm\?"),
        ({"lift": "120"}, r"did you mean 120mm\?"),
    ],
)
def test_a_wrong_dotted_setting_names_the_nearest(settings: dict[str, str], message: str) -> None:
    with pytest.raises(ParameterError, match=message):
        Outer.read(settings)


def test_a_kind_refuses_a_unit_of_another_dimension() -> None:
    with pytest.raises(TypeError, match="mm is not a unit of the same dimension as kg"):
        kind.mass(1.0, unit="mm", doc="mass")


@pytest.mark.parametrize(("bounds", "inside"), [({"at_most": 1.0}, True), ({"below": 1.0}, False)])
def test_a_bound_is_included_or_excluded_as_declared(bounds: dict[str, float], inside: bool) -> None:
    @dataclass(frozen=True, slots=True)
    class Bounded(Params):
        share: float = kind.ratio(0.5, doc="share", **bounds)

    assert declared(Bounded)[0].within(1.0) is inside
