"""Pile by a map, carved lines and silk: areas and lengths by closed forms, volumes by integration, yarn by hand."""

import json
import math
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner
from PIL import Image

from ilmek.carpet.bill import pile_length, yarn_bill
from ilmek.carpet.carving import carved_length, carved_masses, require_carved
from ilmek.carpet.cells import CellKind
from ilmek.carpet.chart import Chart
from ilmek.carpet.pile import PileParams, knot_length
from ilmek.carpet.shape import ShapeParams, shaped
from ilmek.carpet.yarn_plan import YarnPlanParams
from ilmek.cli import main
from ilmek.elements.yarns import SILK, WOOL
from ilmek.errors import CarpetError, ParameterError
from ilmek.io.call_state import chart_digest
from ilmek.io.chart.oxs import write_chart_oxs
from ilmek.io.chart.oxs_reading import read_chart_oxs
from ilmek.io.chart.png import read_chart_png, write_chart_png
from ilmek.io.yarn_file import default_yarns, read_yarns
from ilmek.machines.automated_loom.cost_rates import CostRates
from ilmek.machines.automated_loom.making import finishing_steps

CARVE = ShapeParams(carve="all", carve_depth=4e-3, carve_angle=math.radians(60))
RADIUS = 0.3


def disc(quality: str = "25x25/dm", radius: float = RADIUS) -> Chart:
    """A disc of one yarn in the middle of another, 80 × 80 cm."""
    across, along = (10 * int(count) for count in quality.removesuffix("/dm").split("x"))
    y, x = (np.arange(side) + 0.5 for side in (0.8 * along, 0.8 * across))
    inside = np.hypot((x - 0.4 * across) / across, ((y - 0.4 * along) / along)[:, np.newaxis]) <= radius
    return Chart.of(inside.astype(int), default_yarns()[:2], "80x80cm", quality)


@pytest.mark.parametrize(("quality", "within"), [("25x25/dm", 4e-3), ("40x40/dm", 3e-3), ("20x30/dm", 0.02)])
def test_the_length_of_carved_lines_is_that_of_a_circle_and_nearly_that_of_a_square(
    quality: str, within: float
) -> None:
    assert carved_length(shaped(disc(quality), CARVE)) == pytest.approx(2 * math.pi * RADIUS, rel=within)
    square = Chart.of(np.pad(np.ones((100, 100), int), 50), default_yarns()[:2], "80x80cm", "25x25/dm")
    assert carved_length(shaped(square, CARVE)) == pytest.approx(4 * 0.4, rel=0.055)


@pytest.mark.parametrize("degrees", [30, 90])
def test_what_is_cut_away_is_the_volume_of_the_groove_by_integration(degrees: int) -> None:
    made = shaped(disc(), replace(CARVE, carve_angle=math.radians(degrees)))
    step = 0.2e-3
    at = np.arange(step / 2, 0.4, step)
    away = np.hypot(at, at[:, np.newaxis]) - RADIUS
    cut = np.maximum(0.0, CARVE.carve_depth - abs(away) / math.tan(math.radians(degrees / 2)))
    volumes = [4 * cut[side].sum() * step**2 for side in (away > 0, away < 0)]
    by_yarn = dict(zip((yarn.name for yarn in made.yarns), carved_masses(made), strict=True))
    for yarn, volume in zip(default_yarns()[:2], volumes, strict=True):
        density = 2 * 250**2 * made.yarns[0].linear_density
        assert by_yarn[yarn.name] == pytest.approx(volume * density, rel=0.01)
    plain, carved = yarn_bill(disc()), yarn_bill(made)
    kept = [sum(need.kept for need in bill.pile) for bill in (plain, carved)]
    assert kept[0] - kept[1] == pytest.approx(sum(by_yarn.values()))
    assert [need.mass for need in carved.pile] == pytest.approx([need.mass for need in plain.pile])
    (step_of,) = [one for one in finishing_steps(CostRates(), 0.64, carved_length(made)) if one.name == "carving"]
    hours = carved_length(made) / 4
    assert (step_of.time, step_of.cost) == (pytest.approx(hours * 3600), pytest.approx(8 * hours))


def test_lines_are_at_named_yarns_and_not_at_loops_nor_the_edge() -> None:
    knots = np.repeat(np.arange(3), 20)[np.newaxis].repeat(60, axis=0)
    chart = Chart.of(knots, default_yarns()[:3], "24x24cm", "25x25/dm")
    names = [yarn.name for yarn in chart.yarns]
    usual = ShapeParams(carve="all")
    both = carved_length(shaped(chart, usual))
    assert both == pytest.approx(2 * 0.24, rel=0.07)
    assert carved_length(shaped(chart, replace(usual, carve=names[0]))) == pytest.approx(both / 2)
    assert carved_length(shaped(chart, replace(usual, pile=f"{names[2]}=loop"))) == pytest.approx(both / 2)
    assert carved_length(shaped(chart, replace(usual, flat_weave="1-60/21-40"))) == 0
    assert carved_length(chart) == 0


def test_a_chart_keeps_its_lines_in_its_files_and_has_another_digest(tmp_path: Path) -> None:
    made = shaped(disc(), replace(CARVE, carve=default_yarns()[1].name))
    write_chart_png(tmp_path / "chart.png", made)
    write_chart_oxs(tmp_path / "chart.oxs", made)
    assert made.cells is not None
    for back in (read_chart_png(tmp_path / "chart.png"), read_chart_oxs(tmp_path / "chart.oxs")[0]):
        assert back.cells is not None
        assert back.cells.carving == made.cells.carving
        assert chart_digest(back) == chart_digest(made)
    assert chart_digest(made) != chart_digest(shaped(disc(), CARVE))


def test_a_map_gives_each_cell_the_pile_of_most_of_its_grey(tmp_path: Path) -> None:
    rng = np.random.default_rng(3)
    levels = rng.integers(0, 4, (50, 40))
    grey = np.array([0, 128, 255, 77], np.uint8)[levels].repeat(3, axis=0).repeat(3, axis=1)
    rgba = np.stack([grey, grey, grey, np.where(levels.repeat(3, axis=0).repeat(3, axis=1) == 3, 0, 255)], axis=2)
    rgba[::3, ::3] = (255, 255, 255, 255)  # a ninth of each cell
    Image.fromarray(rgba.astype(np.uint8)).save(tmp_path / "map.png")
    Image.fromarray(np.full((50, 40, 3), (150, 30, 40), np.uint8)).save(tmp_path / "field.png")
    order = ["chart", str(tmp_path / "field.png"), "--size", "16x20cm", "--out", str(tmp_path / "out"), "--pile-map"]
    order += [str(tmp_path / "map.png"), "--pile-levels", "5mm, 8mm loop, 12mm"]
    made = CliRunner().invoke(main, order)
    assert made.exit_code == 0, made.output
    cells = read_chart_png(tmp_path / "out" / "chart.png").cells
    assert cells is not None
    wanted = [(5e-3, False), (8e-3, True), (12e-3, False), (None, False)]
    found = [(kind.height, kind.loop) for kind in cells.kinds]
    assert [[found[kind] for kind in row] for row in cells.index] == [
        [wanted[level] for level in row] for row in levels
    ]
    listed = json.loads((tmp_path / "out" / "chart.json").read_text())["cells"]
    counts = {(kind["height"], kind["loop"]): kind["cells"] for kind in listed}
    assert counts == {kind: np.count_nonzero(levels == level) for level, kind in enumerate(wanted)}


def test_a_border_and_a_motif_of_a_recipe_have_piles_of_their_own(tmp_path: Path) -> None:
    y, x = np.mgrid[0:12, 0:12] - 5.5
    disc_of = np.hypot(x, y) <= 5
    Image.fromarray(np.where(disc_of[..., None], (150, 30, 40), 255).astype(np.uint8)).save(tmp_path / "disc.png")
    lines = [
        'size = "16x20cm"', 'quality = "25x25/dm"', 'yarns = "wool"', 'plain = "ivory"', "[[border]]",
        "width = 4", 'yarn = "indigo navy"', 'pile = "6mm loop"', "[[motif]]", 'picture = "disc.png"',
        'transparent = "#ffffff"', 'pile = "14mm"',
    ]  # fmt: skip
    (tmp_path / "carpet.toml").write_text("\n".join(lines), encoding="utf-8")
    order = ["chart", str(tmp_path / "carpet.toml"), "--out", str(tmp_path / "out"), "--save-recipe"]
    made = CliRunner().invoke(main, [*order, str(tmp_path / "again.toml")])
    assert made.exit_code == 0, made.output
    cells = read_chart_png(tmp_path / "out" / "chart.png").cells
    assert cells is not None
    wanted = np.zeros((50, 40))
    wanted[:4] = wanted[-4:] = wanted[:, :4] = wanted[:, -4:] = 6e-3
    wanted[19:31, 14:26][disc_of] = 14e-3
    assert np.array_equal(np.array([kind.height or 0 for kind in cells.kinds])[cells.index], wanted)
    assert np.array_equal(np.array([kind.loop for kind in cells.kinds])[cells.index], wanted == 6e-3)
    again = (tmp_path / "again.toml").read_text(encoding="utf-8")
    assert ('pile = "6mm loop"' in again, 'pile = "14mm"' in again) == (True, True)
    (tmp_path / "carpet.toml").write_text("\n".join(lines).replace("14mm", "high"), encoding="utf-8")
    refused = CliRunner().invoke(main, order[:2])
    assert (refused.exit_code, "Traceback" in refused.output) == (2, False)
    assert "line 9" in " ".join(refused.output.split())


def test_silk_among_wool_has_its_own_count_price_and_thickness(tmp_path: Path) -> None:
    lines = ["name,srgb,nm,ply,material", "Ground,#802020,1.3,2,", "Light,#f0e8d0,4,1,silk"]
    (tmp_path / "yarns.csv").write_text("\n".join(lines), encoding="utf-8")
    yarns = read_yarns(tmp_path / "yarns.csv")
    chart = Chart.of(np.arange(3600).reshape(60, 60) % 2, yarns, "24x24cm", "25x25/dm")
    assert [yarn.material for yarn in yarns] == [None, "silk"]
    thin = PileParams(fibre_density=SILK.density, packing=SILK.packing)
    own = knot_length("symmetric", chart.quality, 1 / 4000, thin)
    assert pile_length(chart, 1) == pytest.approx(1800 * own)
    assert own < knot_length("symmetric", chart.quality, 1 / 4000)
    bill = yarn_bill(chart, YarnPlanParams(reserve=0.0))
    assert [need.material for need in bill.pile] == ["wool", "silk"]
    assert [need.price for need in bill.pile] == [
        pytest.approx(need.mass * price) for need, price in zip(bill.pile, (20.0, 120.0), strict=True)
    ]
    write_chart_png(tmp_path / "chart.png", chart)
    assert read_chart_png(tmp_path / "chart.png").yarns == chart.yarns
    usual = Chart.of(chart.knots, [replace(yarn, metric_count=None, ply=1) for yarn in yarns], "15x15cm", "40x40/dm")
    wool, silk = (yarn.linear_density for yarn in usual.yarns)
    assert silk / wool == pytest.approx(SILK.density * SILK.packing / (WOOL.density * WOOL.packing), rel=0.03)


REFUSED = {
    "as deep as the pile": (
        lambda: require_carved(shaped(disc(), replace(CARVE, carve_depth=9e-3)), PileParams(8e-3)),
        "carved 9 mm deep into a pile of 8 mm.*less than 8 mm",
    ),
    "no colours meet": (
        lambda: require_carved(shaped(disc(radius=0.0), CARVE), PileParams(8e-3)),
        "no colours meet",
    ),
    "no yarn": (lambda: shaped(disc(), replace(CARVE, carve="Purple")), "carved round 'Purple': no yarn"),
    "one level": (lambda: ShapeParams.read({"pile_levels": "6mm"}), "1 level.*2 to 16"),
    "no level": (lambda: ShapeParams.read({"pile_levels": "6mm, high"}), "'high' cannot be read"),
    "too high": (lambda: CellKind("pile", height=0.2), "up to 100 mm"),
}


@pytest.mark.parametrize("name", REFUSED)
def test_piles_and_lines_that_no_carpet_has_are_refused(name: str) -> None:
    make, told = REFUSED[name]
    with pytest.raises((CarpetError, ParameterError)) as refused:
        make()
    assert re.search(told, str(refused.value))
