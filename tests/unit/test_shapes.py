"""Shapes of carpets against closed forms, brute counts of their files, and by hand; what is refused."""

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner
from PIL import Image

from ilmek.carpet.bill import YarnBill, pile_length, yarn_bill
from ilmek.carpet.cells import CUT_AWAY, OUTSIDE, PILE, PLAIN, CellKind, CellMap, all_knots
from ilmek.carpet.chart import Chart
from ilmek.carpet.codes import NO_KNOT
from ilmek.carpet.cut_edge import edge_length, finished_area
from ilmek.carpet.overlay import HALF, KnotMark, overlay_of
from ilmek.carpet.pile import PileParams, knot_length
from ilmek.carpet.quality import carpet_quality
from ilmek.carpet.shape import SHAPES, ShapeParams, require_wide, shaped
from ilmek.carpet.sizes import CarpetSize
from ilmek.carpet.usual_pile import with_counts
from ilmek.carpet.yarn_plan import YarnPlanParams
from ilmek.cli import main
from ilmek.errors import CarpetError, ParameterError
from ilmek.io.chart.oxs import write_chart_oxs
from ilmek.io.chart.oxs_reading import read_chart_oxs
from ilmek.io.chart.png import read_chart_png, write_chart_png
from ilmek.io.yarn_file import default_yarns
from ilmek.jobs.weave import pile_checks


def area_of(shape: str, size: CarpetSize) -> float:
    """The area of a shape with an equation [m²]."""
    width, length = size.width, size.length
    least, whole = min(width, length), width * length
    cut = {
        "round": whole * (1 - math.pi / 4),
        "oval": whole * (1 - math.pi / 4),
        "octagon": 2 * (least / (2 + math.sqrt(2))) ** 2,
        "stair": (2 - math.pi / 2) * (least / 2) ** 2,
        "runner": (4 - math.pi) * (least / 2) ** 2,
    }
    return whole - cut[shape]


def carpet(width: float, length: float, quality: str = "25x25/dm", yarns: int = 2) -> Chart:
    """A carpet in stripes of its yarns along the rows."""
    per = float(quality.split("x", maxsplit=1)[0]) * 10
    rows, columns = round(length * per), round(width * per)
    knots = np.broadcast_to(np.arange(columns) % yarns, (rows, columns))
    listed = with_counts(default_yarns()[:yarns], carpet_quality(quality), "symmetric")
    return Chart(knots, listed, CarpetSize(width, length), quality, "symmetric")


PERIMETERS = {
    "round": lambda w, _: math.pi * w,
    "octagon": lambda w, _: 8 * w / (1 + math.sqrt(2)),
    "runner": lambda w, length: 2 * (length - w) + math.pi * w,
    "stair": lambda w, length: 2 * w + 2 * length - (4 - math.pi) * min(w, length) / 2,
}


@pytest.mark.parametrize(
    ("shape", "width", "length"),
    [("round", 1.6, 1.6), ("oval", 1.2, 1.8), ("octagon", 1.4, 1.4), ("stair", 0.8, 0.4), ("runner", 0.8, 2.4)],
)
def test_area_knots_and_edge_are_those_of_the_closed_form(shape: str, width: float, length: float) -> None:
    made = shaped(carpet(width, length), ShapeParams(shape=shape))
    area = area_of(shape, made.size)
    assert made.tally().knots == sum(made.counts) == pytest.approx(area * 250**2, rel=2e-3)
    assert finished_area(made) == pytest.approx(area, rel=2e-3)
    if shape in PERIMETERS:
        assert edge_length(made) == pytest.approx(PERIMETERS[shape](width, length), rel=7e-3)


def test_a_round_carpet_is_within_half_a_knot_of_its_circle() -> None:
    made = shaped(carpet(1.6, 1.6), ShapeParams(shape="round"))
    pitch, radius = 1 / 250, 0.8
    for row in range(made.rows):
        y = (row + 0.5) * pitch - radius
        inside = np.flatnonzero(made.knots[row] != NO_KNOT)
        half = math.sqrt(radius**2 - y**2)
        assert abs(inside[0] * pitch - radius + half) <= pitch / 2 + 1e-12
        assert abs((inside[-1] + 1) * pitch - radius - half) <= pitch / 2 + 1e-12
    assert np.array_equal(made.knots == NO_KNOT, made.knots[::-1, ::-1] == NO_KNOT)


@pytest.mark.parametrize("shape", SHAPES)
def test_a_file_of_a_shape_has_its_knots_by_another_reader_and_comes_back(tmp_path: Path, shape: str) -> None:
    made = shaped(carpet(0.4, 0.4), ShapeParams(shape=shape, kilim_ends=0.02, pile="madder red=6mm loop"))
    write_chart_png(tmp_path / "chart.png", made)
    write_chart_oxs(tmp_path / "chart.oxs", made)
    seen = np.asarray(Image.open(tmp_path / "chart.png").convert("RGBA"))
    assert np.count_nonzero(seen[..., 3]) == made.tally().knots
    for index, yarn in enumerate(made.yarns):
        own = (seen[..., :3] == yarn.srgb).all(axis=2) & (seen[..., 3] > 0)
        assert np.count_nonzero(own) == made.counts[index]
    assert (tmp_path / "chart.oxs").read_text().count("<stitch ") == made.tally().knots
    for back in (read_chart_png(tmp_path / "chart.png"), read_chart_oxs(tmp_path / "chart.oxs")[0]):
        assert back.cells is not None
        assert made.cells is not None
        assert np.array_equal(back.knots, made.knots)
        assert np.array_equal(back.cells.index, made.cells.index)
        assert back.cells.kinds == made.cells.kinds


def test_kilim_ends_and_areas_of_flat_weave() -> None:
    made = shaped(carpet(0.4, 0.4), ShapeParams(kilim_ends=0.04, flat_weave="31-40/11-30, 50"))
    assert made.cells is not None
    assert (made.rows, made.columns, made.size.length) == (120, 100, pytest.approx(0.48))
    assert made.cells.number(PLAIN) == 2 * 10 * 100 + 10 * 20 + 100
    assert (made.knots[-10:] == NO_KNOT).all()
    assert (made.knots[-50:-40, 10:30] == NO_KNOT).all()
    assert made.tally().knots == 10_000 - 10 * 20 - 100
    assert yarn_bill(made).area == pytest.approx(0.48 * 0.4)


def test_yarn_of_two_heights_and_loops_by_hand() -> None:
    chart = carpet(0.4, 0.4, yarns=3)
    first, second, third = (yarn.name for yarn in chart.yarns)
    made = shaped(chart, ShapeParams(pile=f"{first}=6mm, {second}=14mm loop"))
    lengths = {
        name: knot_length("symmetric", made.quality, yarn.linear_density, PileParams(10e-3))
        for name, yarn in zip((first, second, third), made.yarns, strict=True)
    }
    by_name = {yarn.name: index for index, yarn in enumerate(made.yarns)}
    pile = PileParams(10e-3)
    assert pile_length(made, by_name[first], pile) == pytest.approx(made.counts[0] * (lengths[first] - 2 * 4e-3))
    assert pile_length(made, by_name[second], pile) == pytest.approx(
        made.counts[1] * (lengths[second] + 2 * 4e-3 - 2 * 1e-3)
    )
    assert pile_length(made, by_name[third], pile) == pytest.approx(made.counts[2] * lengths[third])


def test_half_knots_have_the_pile_of_their_cell() -> None:
    index = np.zeros((4, 4), np.uint8)
    index[0] = 1
    cells = CellMap(index, (PILE, CellKind("low", height=5e-3)))
    overlay = overlay_of([KnotMark(0, 0, HALF, 1), KnotMark(3, 3, HALF, 1)])
    chart = Chart(np.zeros((4, 4), int), default_yarns()[:2], "4x4cm", "10x10/dm", "symmetric", overlay=overlay)
    made = Chart(chart.knots, chart.yarns, chart.size, chart.quality, chart.knot, overlay=overlay, cells=cells)
    (_, usual), (low, own) = made.tied_by_kind
    assert (usual.whole, usual.half, own.whole, own.half) == ((11, 0), (1, 1), (3, 0), (1, 1))
    assert (low.height, made.tied.whole) == (5e-3, (14, 0))


def test_a_shape_cuts_only_away_and_the_map_is_left_out_where_it_says_nothing() -> None:
    chart = carpet(0.4, 0.4)
    assert shaped(chart, ShapeParams()) is chart
    assert shaped(chart, ShapeParams(shape="rectangle")) is chart
    made = shaped(shaped(chart, ShapeParams(shape="round")), ShapeParams(shape="octagon"))
    assert made.cells is not None
    assert made.cells.kinds == (PILE, CUT_AWAY)
    assert made.cells.number(OUTSIDE) > 10_000 * (1 - math.pi / 4) * 0.99


def island(rows: slice, columns: slice) -> np.ndarray:
    inside = np.zeros((100, 100), dtype=bool)
    inside[40:60, 40:60] = inside[rows, columns] = True
    return inside


REFUSED = {
    "round and oblong": (lambda: shaped(carpet(0.4, 0.6), ShapeParams(shape="round")), "equal sides"),
    "unknown shape": (lambda: ShapeParams.read({"shape": "ovall"}), "did you mean 'oval'"),
    "thin island": (
        lambda: shaped(carpet(0.4, 0.4), ShapeParams(shape="picture"), island(slice(10, 12), slice(5, 30))),
        "island too thin to weave, rows 89..90, knots 6..30",
    ),
    "island within a cell": (
        lambda: require_wide(island(slice(0), slice(0)), island(slice(9, 10), slice(8, 9))),
        "island too thin to weave, rows 91..91, knots 9..9",
    ),
    "rows beyond": (lambda: shaped(carpet(0.4, 0.4), ShapeParams(flat_weave="90-101")), "100 rows of 100"),
    "no area": (lambda: ShapeParams.read({"flat_weave": "7-3"}), "write 1-12/10-30"),
    "no yarn": (lambda: shaped(carpet(0.4, 0.4), ShapeParams(pile="Purple=6mm")), "no yarn has this name"),
    "no height": (lambda: ShapeParams.read({"pile": "Red=high"}), "write Red=6mm"),
    "too high": (lambda: ShapeParams.read({"pile": "Red=2m"}), "up to 100 mm"),
    "nothing": (lambda: all_knots(9, 9).woven(np.ones((9, 9), bool), CUT_AWAY), "without a knot"),
    "a knot of no yarn": (lambda: Chart([[0, 255]] * 2, default_yarns()[:2], "2x2cm", "10x10/dm", "symmetric"), "255"),
}


@pytest.mark.parametrize("name", REFUSED)
def test_what_no_carpet_is_is_refused_in_one_line(name: str) -> None:
    make, allowed = REFUSED[name]
    with pytest.raises((CarpetError, ParameterError), match=allowed):
        make()


def design(path: Path) -> np.ndarray:
    """A disc of two colours, hard edged, on nothing; its alpha."""
    y, x = np.mgrid[0:400, 0:400] + 0.5
    far = np.hypot(x - 200, y - 200)
    rgba = np.zeros((400, 400, 4), np.uint8)
    rgba[far < 190] = (150, 30, 40, 255)
    rgba[far < 90] = (20, 40, 90, 255)
    Image.fromarray(rgba).save(path)
    return rgba[..., 3]


def test_the_transparent_part_of_a_picture_buys_no_yarn(tmp_path: Path) -> None:
    alpha = design(tmp_path / "disc.png")
    order = ["chart", str(tmp_path / "disc.png"), "--size", "40x40cm", "--shape", "picture", "--out"]
    made = CliRunner().invoke(main, [*order, str(tmp_path / "a")])
    assert made.exit_code == 0, made.output
    chart = read_chart_png(tmp_path / "a" / "chart.png")
    covered = alpha.reshape(100, 4, 100, 4).mean(axis=(1, 3)) / 255
    assert np.array_equal(chart.knots != NO_KNOT, covered >= 0.5)
    assert chart.colours == 2
    Image.fromarray(255 - alpha).save(tmp_path / "mask.png")  # the light part is the carpet: all but the disc
    order[order.index("picture")] = str(tmp_path / "mask.png")
    made = CliRunner().invoke(main, [*order, str(tmp_path / "b"), "--ground", "#ffffff"])
    assert made.exit_code == 0, made.output
    other = read_chart_png(tmp_path / "b" / "chart.png")
    assert np.array_equal(other.knots == NO_KNOT, covered > 0.5)


def test_a_head_that_cannot_cut_two_heights_fails_a_check(tmp_path: Path) -> None:
    chart = carpet(0.4, 0.4, yarns=3)
    first, second, _ = (yarn.name for yarn in chart.yarns)
    two = shaped(chart, ShapeParams(pile=f"{first}=6mm, {second}=loop"))
    assert [(check.ok, check.value) for check in pile_checks(two)] == [(False, 2), (False, two.counts[1])]
    assert pile_checks(shaped(chart, ShapeParams(shape="round"))) == ()


def charted(*arguments: str) -> Chart:
    made = CliRunner().invoke(main, ["chart", *arguments])
    assert made.exit_code == 0, made.output
    return read_chart_png(Path(arguments[arguments.index("--out") + 1]) / "chart.png")


def test_a_chart_with_cells_on_another_grid_keeps_its_shape_and_buys_no_ground(tmp_path: Path) -> None:
    design(tmp_path / "disc.png")
    first = charted(str(tmp_path / "disc.png"), "--size", "40x40cm", "--shape", "picture", "--out", str(tmp_path / "a"))
    chart = str(tmp_path / "a" / "chart.png")
    half = charted(chart, "--size", "44x44cm", "--quality", "12x12/dm", "--out", str(tmp_path / "b"))
    assert half.knots.shape == (53, 53)
    tied = half.knots != NO_KNOT
    assert half.cells is not None
    assert {kind.name for kind in half.cells.kinds} == {"knot", OUTSIDE}
    y, x = np.mgrid[0:53, 0:53] + 0.5
    far, edge = np.hypot(x - 26.5, y - 26.5), 0.95 * 26.5
    assert tied[far < edge - 0.8].all()
    assert not tied[far > edge + 0.8].any()
    assert half.colours == first.colours == 2
    assert finished_area(half) == pytest.approx(math.pi * (0.95 * 0.22) ** 2, rel=0.02)
    (tmp_path / "two.csv").write_text("name,srgb\nClay,#a03020\nNight,#182858\n", encoding="utf-8")
    other = charted(chart, "--yarns", str(tmp_path / "two.csv"), "--out", str(tmp_path / "c"))
    assert np.array_equal(other.knots == NO_KNOT, first.knots == NO_KNOT)
    assert sorted(yarn.name for yarn in map(other.yarns.__getitem__, other.used)) == ["Clay", "Night"]


def test_the_plain_rows_of_a_chart_follow_its_grid_and_what_is_shown_of_it(tmp_path: Path) -> None:
    design(tmp_path / "disc.png")
    area = ["--flat-weave", "41-60", "--out", str(tmp_path / "a")]
    charted(str(tmp_path / "disc.png"), "--size", "40x40cm", *area)
    size = ["--size", "40x20cm", "--quality", "20x20/dm", "--fit", "crop", "--out", str(tmp_path / "b")]
    part = charted(str(tmp_path / "a" / "chart.png"), *size)
    assert part.cells is not None
    plain = np.flatnonzero(part.cells.are(PLAIN).all(axis=1))
    assert part.rows == 40
    assert len(plain) == 16  # 8 cm of 20 cm
    assert np.array_equal(plain, np.arange(plain[0], plain[0] + 16))


@pytest.mark.parametrize("fit", [("--turn", "90deg"), ("--crop", "10%,10% 90%,90%"), ("--fit", "pad")])
def test_a_chart_with_cells_that_is_turned_or_cropped_is_refused(tmp_path: Path, fit: tuple[str, str]) -> None:
    design(tmp_path / "disc.png")
    charted(str(tmp_path / "disc.png"), "--size", "40x40cm", "--shape", "round", "--out", str(tmp_path / "a"))
    order = ["chart", str(tmp_path / "a" / "chart.png"), "--size", "40x60cm", *fit, "--out", str(tmp_path / "b")]
    refused = CliRunner().invoke(main, order)
    assert refused.exit_code == 2
    told = " ".join(refused.output.split())
    assert "chart with cells of its own (knot, outside), turned, cropped or with a border" in told


def test_an_outline_of_an_svg_file_is_the_shape_that_it_draws(tmp_path: Path) -> None:
    design(tmp_path / "disc.png")
    drawn = '<ellipse cx="50" cy="50" rx="40" ry="30" fill="#000"/><circle cx="50" cy="50" r="10" fill="#fff"/>'
    svg = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 100" width="100" height="100">{drawn}</svg>'
    (tmp_path / "outline.svg").write_text(svg, encoding="utf-8")
    order = [str(tmp_path / "disc.png"), "--size", "40x40cm", "--ground", "#ffffff"]
    made = charted(*order, "--shape", str(tmp_path / "outline.svg"), "--out", str(tmp_path / "a"))
    y, x = np.mgrid[0:100, 0:100] + 0.5
    level = np.hypot((x - 50) / 40, (y - 50) / 30)
    tied = made.knots != NO_KNOT
    assert tied[level < 0.97].all()  # what is drawn is the carpet, in any colour
    assert not tied[level > 1.03].any()
    assert int(tied.sum()) == pytest.approx(math.pi * 40 * 30, rel=0.01)
    (tmp_path / "outline.svg").write_text("no drawing", encoding="utf-8")
    refused = CliRunner().invoke(main, ["chart", *order, "--shape", str(tmp_path / "outline.svg")])
    assert (refused.exit_code, "Traceback" in refused.output) == (2, False)
    assert "outline.svg" in refused.output


def bound(binding: str, **plan: object) -> YarnBill:
    return yarn_bill(shaped(carpet(1.6, 1.6), ShapeParams(shape="round")), YarnPlanParams(binding=binding, **plan))


def test_a_tape_has_its_length_mass_and_price_and_no_binding_has_none() -> None:
    edge = math.pi * 1.6
    tape = next(line for line in bound("tape").ground if line.use == "tape")
    assert tape.length == pytest.approx(edge, rel=5e-3)
    assert tape.mass == pytest.approx(edge * 2 * 8e-3 * 0.35, rel=5e-3)  # both faces of 8 mm, 350 g/m²
    assert tape.price == pytest.approx(edge * 1.1, rel=5e-3)  # 1 EUR a metre, and the reserve
    assert (tape.kept, tape.hanks) == (tape.mass, 0)
    wide = next(line for line in bound("tape", binding_width=16e-3, tape_price=2.0).ground if line.use == "tape")
    assert (wide.mass, wide.price) == (pytest.approx(2 * tape.mass), pytest.approx(2 * tape.price))
    lira = next(line for line in bound("tape", currency="TRY").ground if line.use == "tape")
    assert lira.price is None
    none, overcast = bound("none"), bound("overcast")
    assert {line.use for line in none.ground} & {"tape", "binding", "selvedge"} == set()
    assert none.edge == overcast.edge == bound("tape").edge > 0
    assert bound("tape").mass - none.mass == pytest.approx(tape.mass)
    sewn = next(line for line in overcast.ground if line.use == "binding")
    assert overcast.mass - none.mass == pytest.approx(sewn.mass)
    assert yarn_bill(carpet(1.0, 1.0), YarnPlanParams(binding="tape")).edge == 0  # a rectangle has its selvedges


def test_the_binding_is_of_the_yarn_that_is_named() -> None:
    first, second = carpet(1.6, 1.6).yarns
    assert first.metric_count is not None
    thin, thick = replace(first, name="Thin"), replace(second, name="Thick", metric_count=first.metric_count / 2)
    chart = shaped(replace(carpet(1.6, 1.6), yarns=(thin, thick)), ShapeParams(shape="round"))
    lines = {
        name: next(line for line in yarn_bill(chart, YarnPlanParams(binding_yarn=name)).ground if line.use == "binding")
        for name in ("Thin", "thick")
    }
    assert lines["thick"].mass > 1.3 * lines["Thin"].mass  # twice the mass a metre, in fewer turns
    with pytest.raises(CarpetError, match="did you mean 'Thick'"):
        yarn_bill(chart, YarnPlanParams(binding_yarn="Thik"))


def test_the_tape_is_on_the_yarn_list_of_the_order(tmp_path: Path) -> None:
    design(tmp_path / "disc.png")
    order = ["chart", str(tmp_path / "disc.png"), "--size", "40x40cm", "--shape", "picture", "--binding", "tape"]
    made = CliRunner().invoke(main, [*order, "--out", str(tmp_path / "a")])
    assert made.exit_code == 0, made.output
    assert "tape of the edge" in (tmp_path / "a" / "yarn.csv").read_text(encoding="utf-8")
