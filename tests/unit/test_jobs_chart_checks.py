"""What the chart job judges by itself: pile too thick for its ground, charts of too many sheets."""

import json
import re
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner
from PIL import Image

from ilmek.carpet.pile import PileParams, coarsest_count, knot_length, pile_fill
from ilmek.carpet.quality import Quality
from ilmek.cli import main
from ilmek.jobs.chart import job_json

MEDALLION = str(Path(__file__).parents[2] / "examples" / "medallion.png")


def chart(*options: str, picture: str = MEDALLION) -> tuple[Any, str]:
    result = CliRunner().invoke(main, ["chart", picture, *options, "--json", "-"])
    found = json.loads(result.stdout)
    assert result.exit_code == (0 if all(check["ok"] for check in found["checks"]) else 3), result.stderr
    return found, result.stderr


def test_fill_of_a_square_metre_by_hand() -> None:
    # 10^6 knots of two legs of 1 mm² of solid fibre: 2 m² of pile on 1 m² of ground.
    solid = PileParams(fibre_density=1000.0, packing=1.0)
    assert pile_fill(Quality(1000.0, 1000.0), 1e-3, solid) == pytest.approx(2.0)
    assert pile_fill(Quality(1000.0, 500.0), 1e-3, solid) == pytest.approx(1.0)


@pytest.mark.parametrize("ply", [1, 2, 5])
def test_the_coarsest_count_just_fits(ply: int) -> None:
    quality = Quality(300.0, 450.0)
    count = coarsest_count(quality, ply)
    assert pile_fill(quality, ply / (1000 * count)) == pytest.approx(1.0)


def test_pile_that_fits_passes(tmp_path: Path) -> None:
    found, said = chart("--size", "20x30cm", "--quality", "25x25/dm", "--yarn-count", "2.5/2")
    check = found["checks"][0]
    assert (check["ok"], check["limit"]) == (True, 1.0)
    assert check["value"] == pytest.approx(2 * 0.8e-3 * 250**2 / (1310 * 0.45))
    assert "thick" not in said


def test_pile_too_thick_names_the_count_that_fits(tmp_path: Path) -> None:
    found, said = chart("--size", "20x30cm", "--quality", "80x100/dm", "--yarn-count", "2.5/2")
    assert not found["checks"][0]["ok"]
    (warning,) = found["warnings"]
    assert f"note: {warning}" in said
    fits = re.search(r"with ply 2, Nm ([\d.]+) or finer fits", warning)
    assert fits
    # The list again, with that count: now it fits, and with one a hundredth coarser it would not.
    for count, fitting in ((float(fits[1]), True), (float(fits[1]) - 0.01, False)):
        (tmp_path / "yarns.csv").write_text(f"name,srgb,nm,ply\nred,800000,{count},2\nivory,f0e8d0,{count},2\n")
        again, _ = chart("--size", "20x30cm", "--quality", "80x100/dm", "--yarns", str(tmp_path / "yarns.csv"))
        assert again["checks"][0]["ok"] is fitting


def test_only_yarns_with_knots_are_judged(tmp_path: Path) -> None:
    # The thick magenta is in the list, but nothing in the picture is near it.
    (tmp_path / "yarns.csv").write_text("name,srgb,nm\nblack,000000,4\nivory,f0e8d0,4\nmagenta,ff00ff,0.1\n")
    Image.effect_noise((40, 60), 90.0).point(lambda grey: 255 * (grey > 128)).save(tmp_path / "grey.png")
    found, _ = chart("--size", "20x30cm", "--yarns", str(tmp_path / "yarns.csv"), picture=str(tmp_path / "grey.png"))
    assert "magenta" not in {yarn["name"] for yarn in found["yarn"]}
    assert found["checks"][0]["value"] == pytest.approx(2 * 0.25e-3 * 250**2 / (1310 * 0.45))


def test_pile_mass_per_area(tmp_path: Path) -> None:
    found, _ = chart("--size", "20x30cm", "--quality", "25x25/dm", "--yarn-count", "2.5/2", "--pile-height", "8mm")
    per_knot = knot_length("symmetric", Quality(250.0, 250.0), 0.8e-3) * 0.8e-3
    assert found["pile_mass_per_area"] == pytest.approx(per_knot * 250**2)


@pytest.mark.parametrize(
    ("options", "made"), [((), False), (("--pdf",), True), (("--no-pdf",), False), (("--pdf", "--no-pdf"), False)]
)
def test_a_chart_of_many_sheets_is_printed_where_asked(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, options: tuple[str, ...], made: bool
) -> None:
    monkeypatch.setattr("ilmek.jobs.chart.MOST_SHEETS", 0)
    out = tmp_path / "out"
    found, said = chart("--size", "30x30cm", "--quality", "20x20/dm", *options, "--out", str(out))
    assert (out / "chart.pdf").exists() is made
    assert sorted(path.name for path in out.iterdir() if path.name != ".ilmek") == sorted(
        Path(file).name for file in found["files"]
    )
    assert ("is left out; --pdf writes it" in said) is (options == ())


def test_few_sheets_are_left_out_where_asked(tmp_path: Path) -> None:
    found, said = chart("--size", "20x30cm", "--quality", "10x10/dm", "--no-pdf", "--out", str(tmp_path / "out"))
    assert not (tmp_path / "out" / "chart.pdf").exists()
    assert not any(file.endswith(".pdf") for file in found["files"])
    assert "chart.pdf" not in said


def test_results_stand_in_both_places_and_never_hide_another_name() -> None:
    found = job_json("chart", {"size": 1}, {"rows": 2}, checks=(), notes=[])
    verdict = {"holds": True, "reasons": [], "checks": []}
    assert found == {
        "job": "chart",
        "parameters": {"size": 1},
        "results": {"rows": 2},
        **verdict,
        "notes": [],
        "rows": 2,
    }
    with pytest.raises(AssertionError):
        job_json("chart", {}, {"notes": 3}, checks=(), notes=[])
