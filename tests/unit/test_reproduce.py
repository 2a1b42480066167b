"""`ilmek reproduce`: what it prints, the JSON it gives, and how a claim is judged."""

import json
import math
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner, Result

from ilmek.cli import main
from ilmek.units import parse_unit
from ilmek.verification import PAPERS, TITLES, VERDICTS
from ilmek.verification.claim import (
    COUNT,
    MISPRINT,
    NOT_REPRODUCIBLE,
    OFF,
    REPRODUCED,
    RESIDUAL,
    ROUNDED_INPUT,
    ROUNDING,
    UNSOUND,
    Claim,
)
from ilmek.verification.judgement import judge
from ilmek.verification.wording import computed_text
from ilmek.verification.worksheet import Worksheet


def run(*arguments: str) -> Result:
    return CliRunner().invoke(main, ["reproduce", *arguments])


@pytest.fixture(scope="module")
def everything() -> list[dict[str, Any]]:
    result = run("--json", "-")
    assert result.exit_code == 0, result.stderr
    return json.loads(result.stdout)


def test_json_has_its_names_and_the_seven_verdicts_only(everything: list[dict[str, Any]]) -> None:
    names = ["paper", "item", "kind", "printed", "printed_unit", "computed", "difference", "unit", "verdict", "roots"]
    names += ["origins", "fitted", "note", "source"]
    assert all(list(found) == names for found in everything)
    assert {found["verdict"] for found in everything} == set(VERDICTS)
    assert {found["paper"] for found in everything} == set(PAPERS) == set(TITLES)


def test_the_manual_states_the_numbers_of_rows_misprints_and_slips(everything: list[dict[str, Any]]) -> None:
    manual = (Path(__file__).parents[2] / "docs" / "verification.md").read_text(encoding="utf-8")
    misprints = [row for row in everything if row["verdict"] == "misprint"]
    slips = {(row["paper"], row["roots"][0]) for row in misprints}
    assert f"recomputes four published papers in {len(everything)} rows" in manual
    assert f"{len(misprints)} misprints come from {len(slips)} slips" in manual


def test_every_claim_has_its_own_name_and_a_source(everything: list[dict[str, Any]]) -> None:
    names = [(found["paper"], found["item"]) for found in everything]
    assert len(set(names)) == len(names)
    assert all(found["source"] and found["item"] for found in everything)


def test_a_number_is_missing_only_where_it_is_said_why(everything: list[dict[str, Any]]) -> None:
    for found in everything:
        assert (found["computed"] is None) <= (found["verdict"] in ("not reproducible", "unsound"))
        if found["verdict"] in ("rounded input", "misprint", "off", "unsound", "not reproducible"):
            assert found["note"], found["item"]
        if found["verdict"] == "reproduced":
            assert not found["note"]


FACTORS = {
    **dict.fromkeys(("", "rad", "m", "s", "kg", "N", "N m", "N s²", "m/s²", "kg m²"), 1.0),
    **dict.fromkeys(("mm", "mm/s²", "mN", "N mm", "N mm s²", "g"), 1e-3),
    **dict.fromkeys(("mm²", "mN mm", "g mm", "N mm²", "N mm² s²"), 1e-6),
    "mm³": 1e-9,
    "1/mm": 1e3,
    "1/mm²": 1e6,
    "kN/m": 1e3,
    "deg": math.pi / 180,
}
"""SI of the units as printed, written down again."""


def test_computed_and_difference_are_in_si(everything: list[dict[str, Any]]) -> None:
    """The difference is computed minus printed; `printed_unit` is that of the printed text alone."""
    numbers = [found for found in everything if found["computed"] is not None and found["kind"] != "equation"]
    assert len(numbers) > 400
    for found in numbers:
        printed = float(found["printed"].strip("<> ")) * FACTORS[found["printed_unit"]]
        assert found["difference"] == pytest.approx(found["computed"] - printed, rel=1e-9, abs=1e-12 * abs(printed))


def test_units_are_si_units_of_their_numbers(everything: list[dict[str, Any]]) -> None:
    """A factor of 1, and the dimension of the unit as printed."""
    for found in everything:
        assert parse_unit(found["unit"]).factor == 1.0, found
        if found["computed"] is not None:
            printed = parse_unit(found["printed_unit"].replace(" ", "*"))
            assert parse_unit(found["unit"]).dimension == printed.dimension


def test_the_sensitivity_is_in_si(everything: list[dict[str, Any]]) -> None:
    """ω3/ω1 changes by 0.563 where θs changes by 0.0622499°."""
    row = next(found for found in everything if found["item"] == "ω3/ω1")
    (origin,) = row["origins"]
    assert origin["change"] == pytest.approx(0.563, rel=1e-3)
    assert origin["sensitivity"] == pytest.approx(0.563 / math.radians(0.0622499), rel=1e-3)


@pytest.mark.parametrize(
    ("item", "value"),
    [
        ("stroke of the needle, 'about'", 0.03278838),
        ("crank angle of the lowest point", 1.867092),
        ("R_inner 50 mm, R_outer 60 mm: y_max", 1.8298e-4),
        ("load on the shaft at a safety of 2", 13666.67),
        ("λ1", 46221.23980),
        ("M1 at rest", -46.42874564),
        ("m3 a of G3, y", 5.583315),
        ("volume of link 1", 2.47035e-6),
    ],
)
def test_numbers_of_the_json_are_in_si(item: str, value: float, everything: list[dict[str, Any]]) -> None:
    found = next(found for found in everything if found["item"] == item)
    assert found["computed"] == pytest.approx(value, rel=1e-4)


def test_fitted_constants_are_reported_on_their_rows(everything: list[dict[str, Any]]) -> None:
    fitted = {found["item"]: found["fitted"] for found in everything if found["fitted"]}
    assert fitted["R_inner 50 mm: least R_outer"].startswith("l = 1.25 m, E = 210 GPa; on the beam of y_max, 1.2 m")
    assert fitted["tube 140 x 5 mm: slope"] == "l = 1.2 m, E = 210 GPa"
    assert fitted["length AE"] == "AE = 1.3 AB"
    assert fitted["entry"] == "backing at half of the stroke"
    shown = " ".join(run("--paper", "thesis").stdout.split())
    assert "fitted: E = 200 GPa" in shown
    assert f"; {sum(found['paper'] == 'thesis' and bool(found['fitted']) for found in everything)} with fitted" in shown


def test_one_paper_can_be_asked_for() -> None:
    result = run("--paper", "beat-up", "--json", "-")
    assert {found["paper"] for found in json.loads(result.stdout)} == {"beat-up"}


def test_an_unknown_paper_is_one_line() -> None:
    result = run("--paper", "beatup")
    assert result.exit_code == 2
    assert result.stderr.count("\n") == 1
    assert "beat-up" in result.stderr


def test_the_table_has_a_line_for_each_paper() -> None:
    result = run()
    assert result.exit_code == 0
    for paper in PAPERS:
        assert f"\n{paper}: " in f"\n{result.stdout}"
        assert f"{paper}: {TITLES[paper]}"[:100] in result.stdout


def claim(printed: str, value: float | None, unit: str = "", **more: Any) -> Claim:
    return Claim("paper", "item", printed, unit, lambda: value, "source", "why", **more)


@pytest.mark.parametrize(
    ("printed", "value", "verdict"),
    [
        ("0.2340", 0.234049, REPRODUCED),
        ("0.2340", 0.234099, REPRODUCED),  # truncated
        ("0.2340", 0.233951, REPRODUCED),
        ("0.2340", 0.233930, ROUNDING),
        ("0.2340", 0.233895, MISPRINT),
        ("0.2340", 0.233849, MISPRINT),
        ("-7.89", -7.6778, MISPRINT),
        ("-0.585", 0.5867, MISPRINT),
        ("0", 0.9, REPRODUCED),  # truncated
        ("0.0", -0.09, REPRODUCED),
        ("> 60", 63.5, REPRODUCED),
        ("> 60", 59.9, MISPRINT),
        ("< 5", 4.0, REPRODUCED),
        ("1e-5", None, NOT_REPRODUCIBLE),
        ("1e-5", math.nan, NOT_REPRODUCIBLE),
        ("4.073e-5", 4.0734e-5, REPRODUCED),
    ],
)
def test_numbers_are_judged_by_their_last_printed_digit(printed: str, value: float | None, verdict: str) -> None:
    found = judge(claim(printed, value))
    assert found.verdict == verdict
    assert found.note == ("" if verdict == REPRODUCED else "why")


@pytest.mark.parametrize("missed", [OFF, UNSOUND])
def test_a_reading_or_a_reasoning_gets_its_own_verdict(missed: str) -> None:
    assert judge(claim("108", 107.6, missed=missed)).verdict == REPRODUCED
    assert judge(claim("108", 106.98, missed=missed)).verdict == missed  # no allowance for rounding
    assert judge(claim("> 1", 0.64, missed=missed)).verdict == missed
    assert judge(claim("4", 3, COUNT, missed=missed)).verdict == missed
    assert judge(claim("a = b", 0.5, RESIDUAL, missed=missed)).verdict == missed
    assert judge(claim("a = b", 1e-15, RESIDUAL, missed=missed)).verdict == REPRODUCED


def test_a_reasoning_without_a_number_is_unsound_and_a_reading_is_not_reproducible() -> None:
    assert judge(claim("65.4", None, missed=UNSOUND)).verdict == UNSOUND
    assert judge(claim("curve", None, missed=OFF)).verdict == NOT_REPRODUCIBLE


def test_a_count_off_by_one_is_wrong() -> None:
    assert judge(claim("32", 33, COUNT)).verdict == MISPRINT
    assert judge(claim("33", 33, COUNT)).verdict == REPRODUCED


def test_numbers_that_follow_from_rounded_ones_are_rounding() -> None:
    """θ3 = θs + 67.52367°: from 125.06223° it is 192.5859°, from the printed 125° the printed 192.524°."""
    angle = replace(claim("125", 125.06223), item="angle")
    assert judge(claim("192.524", 192.5859)).verdict == MISPRINT
    for shift, verdict in ((67.52367, ROUNDED_INPUT), (67.6, MISPRINT)):
        row = claim("192.524", 192.5859, follows=lambda of, shift=shift: of["angle"] + shift)
        found = judge(row, Worksheet((angle, row)))
        assert found.verdict == verdict
    row = claim("192.524", 192.5859, follows=lambda of: of["angle"] + 67.52367)
    (origin,) = judge(row, Worksheet((angle, row))).origins
    assert (origin.name, origin.printed) == ("angle", "125")
    assert (origin.change, origin.sensitivity, origin.bound) == pytest.approx((0.06223, 1.0, 0.5))


def test_a_misprint_names_the_slip_that_it_follows_from() -> None:
    """The area of a square of 3.2: a slip in the side, or in the step."""
    side, area = replace(claim("2.3", 3.2), item="side"), claim("5.29", 10.24, follows=lambda of: of["side"] ** 2)
    assert judge(area, Worksheet((side, area))).roots == ("side",)
    side = replace(side, printed="3.2")
    row = replace(area, printed="6.4", slips=("mN as N",), follows=lambda of: 2 * of["side"])
    row = replace(row, right=lambda of: of["side"] ** 2)
    found = judge(row, Worksheet((side, row)))
    assert (found.verdict, found.roots) == (MISPRINT, ("mN as N",))
    assert found.origins[0].change == pytest.approx(3.2**2 - 6.4)


def test_a_printed_equation_is_a_misprint_only_where_the_mended_one_holds() -> None:
    assert judge(claim("a = b", 1e-15, RESIDUAL)).verdict == REPRODUCED
    assert judge(claim("a = b", 0.5, RESIDUAL, mended=lambda: 1e-15)).verdict == MISPRINT
    assert judge(claim("a = b", 0.5, RESIDUAL, mended=lambda: 0.1)).verdict == NOT_REPRODUCIBLE
    assert judge(claim("a = b", 0.5, RESIDUAL)).verdict == NOT_REPRODUCIBLE


@pytest.mark.parametrize(
    ("printed", "value", "shown"),
    [("0.2340", 0.23392952, "0.233930"), ("32", 33, "33.00"), ("4.073e-5", 4.80377e-5, "4.80377e-5")],
)
def test_computed_numbers_are_shown_with_two_digits_more(printed: str, value: float, shown: str) -> None:
    assert computed_text(judge(claim(printed, value))) == shown


def test_the_table_has_what_is_not_reproduced_first_and_counts_at_its_end(everything: list[dict[str, Any]]) -> None:
    said = run("--paper", "tufting", "--paper", "thesis").stdout
    tufting = said[said.index("tufting: Xu") :]
    order = ("unsound", "misprint", "off", "not reproducible", "reproduced")
    places = [tufting.index(f"  {verdict}  ") for verdict in order]
    assert places == sorted(places)
    counted = {paper: sum(found["paper"] == paper for found in everything) for paper in ("thesis", "tufting")}
    table = said[said.index("claims  ") :]
    rows = [line.split()[:2] for line in table.splitlines() if line.split()[:1] in (["thesis"], ["tufting"], ["all"])]
    total = ["all", str(sum(counted.values()))]
    assert rows == [["thesis", str(counted["thesis"])], ["tufting", str(counted["tufting"])], total]
