"""Declared parameters: bounds, kinds, unknown names and the slips they guess."""

import math
from dataclasses import dataclass

import pytest

from ilmek.errors import ParameterError
from ilmek.params import Params, declared, param
from ilmek.units import deg, mm


@dataclass(frozen=True, slots=True)
class Sample(Params):
    swing: float = param(30 * deg, unit="deg", above=0.0, below=math.pi, doc="swing")
    lift: float = param(60 * mm, unit="mm", above=0.0, at_most=1.0, doc="lift", alias="H1")
    warps: int = param(600, at_least=2, doc="warps")
    law: str = param("harmonic", choices=("harmonic", "cycloidal"), doc="law")
    both: bool = param(False, doc="both")
    crank: float | None = param(None, unit="mm", above=0.0, doc="crank")


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
        ({"lift": "1e-320"}, "next to nothing"),
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
