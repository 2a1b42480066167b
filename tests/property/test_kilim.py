"""Kilims: slits by brute force over pixels, wefts by integration, rows read back, and what is refused."""

import json
import math
import re
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner
from PIL import Image

from ilmek.carpet.cells import CUT_AWAY, PILE, CellMap
from ilmek.carpet.chart import Chart
from ilmek.carpet.codes import NO_KNOT
from ilmek.carpet.ground import GroundParams
from ilmek.carpet.kilim import JOINS, KilimParams, borders, is_too_long, joined, kilim_work, pick_length, slits
from ilmek.carpet.kilim_cloth import KilimPrices, kilim_cloth
from ilmek.cli import main
from ilmek.elements.carpet_yarns import carpet_yarns
from ilmek.elements.yarns import WOOL
from ilmek.errors import ParameterError
from ilmek.io.chart.join_marks import kilim_marks
from ilmek.io.kilim_rows import SIGNS, write_kilim_rows
from ilmek.io.yarn_file import default_yarns


def drawn(seed: int, yarns: int = 3) -> np.ndarray:
    """A chart of random blocks, so that it has slits of many lengths."""
    rng = np.random.default_rng(seed)
    rows, columns = rng.integers(2, 30, 2)
    blocks = rng.integers(0, yarns, (rows, columns)).repeat(rng.integers(1, 6), axis=0)
    knots = np.ascontiguousarray(blocks[: max(2, len(blocks) - 1)]).astype(np.uint8)
    if seed % 2:  # an outline, and a hole beside its middle
        y, x = (np.linspace(-1.0, 1.0, cells) for cells in knots.shape)
        radius = np.hypot(y[:, np.newaxis], x)
        knots[(radius > 1.0) | (np.hypot(y[:, np.newaxis] - 0.3, x) < 0.2)] = NO_KNOT
    return knots


def slits_by_pixels(knots: np.ndarray) -> set[tuple[int, int, int]]:
    """Column on the left, first and last row from the lower edge, one pixel after the other."""
    found, rows = set(), len(knots)
    for column in range(knots.shape[1] - 1):
        begun = None
        for number in range(1, rows + 2):
            row = rows - number
            pair = knots[row, column : column + 2].tolist() if row >= 0 else [0, 0]
            split = pair[0] != pair[1] and NO_KNOT not in pair
            if split and begun is None:
                begun = number
            if not split and begun is not None:
                found.add((column + 1, begun, number - 1))
                begun = None
    return found


@pytest.mark.parametrize("seed", range(12))
def test_slits_joins_and_bobbins_are_those_of_the_pixels(seed: int) -> None:
    knots = drawn(seed)
    expected = slits_by_pixels(knots)
    assert set(slits(knots)) == expected
    limit = 3 / KilimParams().quality.along
    for join in JOINS:
        params = KilimParams(join=join, longest_slit=limit)
        closed = np.zeros_like(borders(knots))
        for column, first, last in expected:
            if join != "slit" and last - first + 1 > 3:
                closed[len(knots) - last : len(knots) - first + 1, column - 1] = True
        assert np.array_equal(joined(knots, params), closed)
        work = kilim_work(knots, 3, params)
        rows = ["".join(map(str, row)).replace(str(NO_KNOT), "-") for row in knots.tolist()]
        runs = [len(re.findall(r"(\d)\1*", row)) for row in rows]
        assert work.bobbins.tolist() == runs
        assert (work.picks, work.joins) == (4 * sum(runs), 2 * 4 * int(closed.sum()))
        marks = kilim_marks(knots, params)
        assert not (marks.slits & marks.joints).any()
        assert np.array_equal(marks.slits | marks.joints, borders(knots))
    assert [is_too_long(slit, params) for slit in slits(knots)] == [slit.rows > 3 for slit in slits(knots)]


def test_a_pick_is_as_long_as_its_wave_and_turn_by_integration() -> None:
    params = KilimParams(warps=600.0)
    pitch = 1 / 600
    warp = carpet_yarns(GroundParams().yarns, pitch).warp.diameter
    weft = math.sqrt(4 * 0.4e-3 / (math.pi * WOOL.density * WOOL.packing))
    x = np.linspace(0.0, 7 * 2 * pitch, 200_001)
    y = (warp + weft) / 2 * np.sin(math.pi * x / pitch)
    wave = float(np.hypot(np.diff(x), np.diff(y)).sum())
    assert pick_length(7, 0, params) == pytest.approx(wave + math.pi * (warp + weft) / 2, rel=1e-6)
    dovetailed, locked = (KilimParams(warps=600.0, join=join) for join in JOINS[1:])
    assert pick_length(7, 2, dovetailed) - pick_length(7, 0, dovetailed) == pytest.approx(2 * pitch)
    assert pick_length(7, 1, locked) - pick_length(7, 0, locked) == pytest.approx(weft)


def test_yarn_mass_time_and_cost_of_a_small_kilim_by_hand() -> None:
    params = KilimParams(warps=100.0, picks=400.0, longest_slit=0.5)
    knots = np.array([[0, 0, 1, 1]] * 8 + [[0, 0, 0, 0]] * 2)  # 2 x 10 cells of 2 warps, 4 picks a row
    chart = Chart(knots, default_yarns()[:2], "8x10cm", params.quality, "symmetric")
    prices = KilimPrices((24.0, None), 8.0, 1e-3)
    cloth = kilim_cloth(chart, params, GroundParams(), prices)
    half, whole = (pick_length(cells, 0, params) for cells in (2, 4))
    assert cloth.work.weft == pytest.approx([4 * (8 * half + 2 * whole), 4 * 8 * half])
    picks, weft = 4 * (8 * 2 + 2), float(cloth.work.weft.sum())
    assert cloth.work.time == pytest.approx(picks * params.pick_time + weft / params.hand_speed)
    assert (cloth.bobbins_per_row, cloth.picks_woven, cloth.slits_joined) == (2, picks, 0)
    assert cloth.weft_mass == pytest.approx(weft * 0.4e-3)
    length = GroundParams().warp_length(0.10)
    warp = 8 * length * carpet_yarns(GroundParams().yarns, 0.01).warp.linear_density
    assert cloth.warp_mass == pytest.approx(warp)
    kept = warp * (1 - GroundParams().loom_waste / length)
    assert cloth.cloth_mass == pytest.approx((weft * 0.4e-3 + kept) / (0.08 * 0.10))
    assert cloth.kilim_cost["sum"] is None
    assert cloth.kilim_cost["wage"] == pytest.approx(1e-3 * cloth.work.time)
    assert [row["price"] for row in cloth.kilim_colours] == [pytest.approx(24 * cloth.masses[0]), None]


@pytest.mark.parametrize("join", JOINS)
def test_the_rows_say_every_cell_and_join(tmp_path: Path, join: str) -> None:
    knots = drawn(5)
    params = KilimParams(join=join, longest_slit=2 / KilimParams().quality.along)
    size = f"{100 * knots.shape[1] / params.quality.across!r}x{100 * len(knots) / params.quality.along!r}cm"
    cells = CellMap(knots == NO_KNOT, (PILE, CUT_AWAY))
    chart = Chart(knots, default_yarns()[:3], size, params.quality, "symmetric", cells=cells)
    cloth = kilim_cloth(chart, params, GroundParams(), KilimPrices((None,) * 3, None, 0.0))
    write_kilim_rows(tmp_path / "rows.txt", cloth, "fa")
    text = (tmp_path / "rows.txt").read_text(encoding="utf-8")
    rows = [line.split(": ", 1) for line in text.splitlines() if re.match(r"\d+: ", line)]
    assert [int(number) for number, _ in rows] == list(range(1, len(knots) + 1))
    joints = joined(knots, params)
    for number, line in rows:
        row, at = len(knots) - int(number), 0
        runs = re.findall(r"(\d+)([A-Z·])", line)
        signs = {0: "A", 1: "B", 2: "C", NO_KNOT: "·"}
        assert "".join(sign * int(count) for count, sign in runs) == "".join(
            signs[code] for code in knots[row].tolist()
        )
        for between in re.split(r"\d+[A-Z·]", line)[1:-1]:
            at = next(column for column in range(at, len(knots[row])) if knots[row, column] != knots[row, column + 1])
            edge = NO_KNOT in knots[row, at : at + 2]
            assert between == (" " if edge else SIGNS[join] if joints[row, at] else SIGNS["slit"])
            at += 1


def order(tmp_path: Path, *settings: str) -> tuple[int, dict, str]:
    """The exit code, the report and the output of a kilim with a stripe along the warps and a stepped diagonal."""
    picture = np.zeros((40, 30, 3), np.uint8)
    picture[:, :10] = (150, 40, 40)
    for row in range(40):
        picture[row, 12 + row // 4 :] = (30, 50, 110)
    picture[:, 10:12] = picture[0, 11]
    Image.fromarray(np.where(picture.any(axis=2, keepdims=True), picture, (235, 225, 200)).astype(np.uint8)).save(
        tmp_path / "stripe.png"
    )
    asked = ["weave", str(tmp_path / "stripe.png"), "--technique", "kilim", "--size", "12x8cm", "--read", "exact"]
    made = CliRunner().invoke(main, [*asked, "--out", str(tmp_path / "out"), "--force", *settings])
    report = tmp_path / "out" / "report.json"
    return made.exit_code, json.loads(report.read_text()) if report.exists() else {}, " ".join(made.output.split())


def test_a_long_slit_is_a_failed_check_with_its_place_and_a_join_cures_it(tmp_path: Path) -> None:
    code, report, told = order(tmp_path)
    assert (code, report["weaves"], report["slits_joined"]) == (3, False, 1)
    assert "between columns 10 and 11, rows 1..40" in told
    assert not (tmp_path / "out" / "rows.txt").exists()
    code, report, _ = order(tmp_path, "--kilim", "join=interlock")
    assert (code, report["weaves"], report["joins_woven"]) == (0, True, 2 * 4 * 40)
    assert report["kilim_cost"]["sum"] > 0
    assert sorted(path.name for path in (tmp_path / "out").iterdir() if path.name != ".ilmek") == [
        "carpet.png", "chart.pdf", "chart.png", "report.html", "report.json", "rows.txt"
    ]  # fmt: skip


def test_a_round_kilim_of_one_colour_is_the_chords_of_its_circle(tmp_path: Path) -> None:
    Image.new("RGB", (40, 40), (150, 40, 40)).save(tmp_path / "red.png")
    asked = ["weave", str(tmp_path / "red.png"), "--technique", "kilim", "--size", "40x40cm", "--shape", "round"]
    made = CliRunner().invoke(main, [*asked, "--out", str(tmp_path / "round")])
    assert made.exit_code == 0, made.output
    report = json.loads((tmp_path / "round" / "report.json").read_text())
    rows, params = 200, KilimParams()
    middles = (np.arange(rows) + 0.5) / rows * 0.4 - 0.2
    chords = 2 * np.sqrt(0.2**2 - middles**2)
    assert (report["bobbins_per_row"], report["mean_bobbins"], report["slit_length"]) == (1, 1.0, 0.0)
    base, cell = pick_length(0, 0, params), pick_length(1, 0, params) - pick_length(0, 0, params)
    weft = 4 * (rows * base + cell * chords.sum() * params.quality.across)
    assert report["weft_length"] == pytest.approx(weft, rel=2e-3)
    ground = GroundParams()
    warp = 200 * ground.warp_length(0.4) * carpet_yarns(ground.yarns, 1 / params.warps).warp.linear_density
    kept = (1 - ground.loom_waste / ground.warp_length(0.4)) * math.pi / 4
    assert report["cloth_mass"] == pytest.approx((weft * 0.4e-3 + kept * warp) / (math.pi * 0.2**2), rel=4e-3)
    with Image.open(tmp_path / "round" / "carpet.png") as drawn_round:
        white = (np.asarray(drawn_round.convert("RGB")) == 255).all(axis=2).mean()
    assert white == pytest.approx(1 - math.pi / 4, abs=2e-3)


@pytest.mark.parametrize(
    ("settings", "told"),
    [
        (("--loom", "beat=comb"), "a kilim is woven by hand: a loom would need a bobbin for each run"),
        (("--knot", "symmetric"), "leave it out"),
        (("--quality", "25x25/dm"), "set --kilim warps=50/dm"),
        (("--kilim", "step=3"), "set step=4"),
        (("--kilim-ends", "2cm"), "; an outline of one height"),
        (("--kilim", "join=knot"), "slit, dovetail"),
    ],
)
def test_what_no_kilim_is_is_refused_in_one_line(tmp_path: Path, settings: tuple[str, ...], told: str) -> None:
    code, _, output = order(tmp_path, *settings)
    assert (code, "Traceback" in output) == (2, False)
    assert told in output


def test_a_row_of_an_odd_number_of_picks_is_refused() -> None:
    with pytest.raises(ParameterError, match="out and back"):
        KilimParams.read({"step": "5"})
