"""Paths of the tufting gun: regions against scikit-image, coverage by another renderer, G-code by another reader."""

import io
import itertools
import json
import time
from pathlib import Path

import numpy as np
import pytest
import resvg_py
import rs274
from click.testing import CliRunner
from PIL import Image
from scipy.ndimage import binary_dilation
from skimage.measure import find_contours, label

from ilmek.cli import main
from ilmek.io.gcode import gcode
from ilmek.machines.tufting_gun.design import tufted_by_gun
from ilmek.machines.tufting_gun.params import TuftingGunParams
from ilmek.plane.level_sets import level_polygons
from ilmek.weaving.gun.plan import GunPlan, gun_plan
from ilmek.weaving.gun.reduction import OUTSIDE, opened, reduced
from ilmek.weaving.gun.regions import polygons_of, tuftable
from ilmek.weaving.gun.travel import in_order, least_travel, travel_of
from ilmek.weaving.tufts import Cone

SPACING, CELL, PIXEL = 3e-3, 1e-3, 0.25e-3
SMALLEST = 5e-3

x, y = np.meshgrid(np.linspace(-1, 1, 420), np.linspace(-1, 1, 420))
r, a = np.hypot(x, y), np.arctan2(y, x)
DRAWN = {
    "plain": 0 * x,
    "disc": r < 0.7,
    "rings": np.floor(4 * r),
    "stripes": np.floor(5 * (x + 1)),
    "slanted": np.floor(4 * (x + 0.6 * y + 2)),
    "waves": np.floor(3 * (y + 0.15 * np.sin(9 * x) + 2)),
    "checker": (np.floor(3 * (x + 1)) + np.floor(3 * (y + 1))) % 2,
    "petals": r < 0.55 + 0.2 * np.cos(5 * a),
    "flower": np.select([r < 0.2, r < 0.6 + 0.2 * np.cos(8 * a)], [0, 1], 2),
    "spiral": np.floor(a / np.pi * 2 + 4 * r) % 2,
    "diamonds": np.floor(3 * (x + y + 2)) % 2 + np.floor(3 * (x - y + 2)) % 2,
    "border": np.select([np.maximum(abs(x), abs(y)) > 0.85, np.maximum(abs(x), abs(y)) > 0.6], [0, 1], 2),
    "moons": np.select([np.hypot(x - 0.3, y) < 0.5, np.hypot(x + 0.2, y) < 0.6], [0, 1], 2),
    "round": np.where(r < 0.97, np.floor(3 * r), OUTSIDE),
    "islands": np.where(
        (np.hypot(x - 0.45, y) < 0.4) | (np.hypot(x + 0.4, y + 0.3) < 0.5), np.floor(2 * y + 2), OUTSIDE
    ),
    "ragged": np.where(r < 0.8 + 0.12 * np.cos(9 * a), np.floor(a + 4), OUTSIDE),
    "blobs": np.digitize(np.sin(5 * x + 2 * np.sin(3 * y)) + np.sin(4 * y), [-0.5, 0.7]),
}
PICTURES = ("matrix", "phantom", "rubik", "smarties", "star", "tr")


def labels_of(name: str) -> np.ndarray:
    if name in DRAWN:
        shades = np.asarray(DRAWN[name], dtype=float)
        return np.where(shades == OUTSIDE, OUTSIDE, shades - shades.min()).astype(np.uint8)
    picture = Image.open(Path("tests/pictures") / f"{name}.png").convert("RGBA").convert("RGB")
    height = 700
    picture = picture.resize((round(height * picture.width / picture.height), height), Image.Resampling.BOX)
    return np.array(picture.quantize(6, dither=Image.Dither.NONE)).astype(np.uint8)


def planned(labels: np.ndarray) -> GunPlan:
    rows, columns = labels.shape
    return gun_plan(labels, (columns * CELL, rows * CELL), SPACING, SMALLEST)


def drawn(body: str, shape: tuple[int, int]) -> np.ndarray:
    """What resvg fills, without antialiasing; y upwards."""
    height, width = (round(side * CELL / PIXEL) for side in shape)
    text = (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" shape-rendering="crispEdges">'
        f'<rect width="{width}" height="{height}" fill="#fff"/>{body}</svg>'
    )
    return np.array(Image.open(io.BytesIO(bytes(resvg_py.svg_to_bytes(svg_string=text)))).convert("L")) < 128


def path(points: np.ndarray, *, close: bool = False) -> str:
    return "M" + " L".join(f"{z.real / PIXEL:.3f},{z.imag / PIXEL:.3f}" for z in points) + ("Z" if close else "")


def stroked(strokes: list[np.ndarray], shape: tuple[int, int]) -> np.ndarray:
    lines = " ".join(path(one) for one in strokes)
    return drawn(
        f'<path d="{lines}" fill="none" stroke="#000" stroke-width="{SPACING / PIXEL}" stroke-linejoin="round" '
        'stroke-linecap="round"/>',
        shape,
    )


@pytest.mark.matrix(light=7)
@pytest.mark.parametrize("name", [*DRAWN, *PICTURES])
def test_strokes_cover_each_region_within_its_border(name: str) -> None:
    labels = labels_of(name)
    plan, made = planned(labels), reduced(labels, round(SMALLEST / CELL))
    assert plan.coverage >= 0.99
    assert plan.beyond <= 0.004
    assert plan.tufted <= 1.15 * plan.least_tufted
    covered = np.zeros(0)
    for colour in plan.colours:
        polygons = polygons_of(tuftable(made, colour.label, CELL, SPACING))
        region = drawn(f'<path d="{" ".join(path(one, close=True) for one in polygons)}"/>', labels.shape)
        rows = stroked(list(colour.strokes), labels.shape)
        parts = label(region, connectivity=1)
        area, inside = (np.bincount(parts[mask], minlength=parts.max() + 1)[1:] for mask in (region, region & rows))
        assert (inside >= 0.99 * area - 24).all(), name  # of a border known to a pixel, the smallest has 300 of them
        assert np.count_nonzero(rows & ~region) <= 5e-4 * np.count_nonzero(region) + 8
        cells = np.kron(made[::-1] == colour.label, np.ones((4, 4), dtype=bool))
        assert not (rows & ~binary_dilation(cells, iterations=3)).any()  # the border is within 3/4 of a cell
        covered = rows if not covered.size else covered | rows
    inside = np.kron(labels[::-1] != OUTSIDE, np.ones((4, 4), dtype=bool))
    assert covered[inside].mean() >= 0.98
    assert not (covered & ~binary_dilation(inside, iterations=3)).any()


def test_regions_have_the_level_sets_of_another_library() -> None:
    field = np.pad(np.random.default_rng(1).random((40, 50)), 1)

    def area(ring: np.ndarray) -> float:
        return float(0.5 * np.sum((ring.conj() * np.roll(ring, -1)).imag))

    ours = sorted(area(ring) for ring in level_polygons(field, 0.6))
    theirs = find_contours(field, 0.6, fully_connected="low", positive_orientation="low")
    assert ours == pytest.approx(sorted(area(ring[:-1, 1] + 1j * ring[:-1, 0]) for ring in theirs), abs=1e-9)


def test_what_is_finer_than_the_smallest_feature_takes_the_nearest_colour() -> None:
    labels = np.zeros((60, 60), dtype=np.uint8)
    labels[20:24], labels[40:46], labels[5, 5] = 1, 2, 3
    made = reduced(labels, 5)
    assert not (made == 1).any()
    assert not (made == 3).any()
    assert (made[41:45] == 2).all()
    assert opened(made[:40, :20], 5)[5:-5, 5:-5].all()
    plan = planned(labels)
    assert plan.lost == (1, 3)
    assert plan.changed == pytest.approx((4 * 60 + 1) / 3600)


def test_no_order_is_shorter_than_the_bound_of_the_travel() -> None:
    random = np.random.default_rng(3)
    for _ in range(5):
        strokes = [np.array([z, z + w]) for z, w in random.random((5, 2)) + 1j * random.random((5, 2))]
        best = min(
            travel_of([stroke[::side] for stroke, side in zip(order, sides, strict=True)])
            for order in itertools.permutations(strokes)
            for sides in itertools.product((1, -1), repeat=5)
        )
        assert 0 < least_travel(strokes) <= best + 1e-12


def tufted(plan: GunPlan, **settings: float):
    cones = tuple(Cone(f"yarn {number}", f"#{number:06x}", 20.0) for number in range(8))
    return tufted_by_gun(TuftingGunParams(**settings), plan, cones)


def test_another_reader_draws_the_programme_mirrored_with_the_gun_on_in_its_rows_alone() -> None:
    labels = labels_of("flower")
    plan = planned(labels)
    machine = rs274.read("\n".join(gcode(tufted(plan), "flower (test)")))
    assert machine.ended
    assert {21.0, 90.0, 94.0, 17.0} <= machine.modes
    assert machine.pauses == len(machine.messages) == len(plan.colours) == 3
    strokes: dict[int, list[np.ndarray]] = {}
    for tool, on, rapid, start, end in machine.moves:
        moved = complex(end["X"] - start["X"], end["Y"] - start["Y"])
        if moved and on:
            assert not rapid
            assert end["Z"] == 0
            assert abs(np.exp(1j * np.deg2rad(end["C"])) - moved / abs(moved)) < 0.5 / max(abs(moved), 1e-3) * 0.01
            strokes.setdefault(tool, []).append(
                np.array([plan.width - p["X"] / 1e3 + 1j * p["Y"] / 1e3 for p in (start, end)])
            )
        elif moved:
            assert rapid
            assert end["Z"] == 25
    made = reduced(labels, round(SMALLEST / CELL))
    for number, colour in enumerate(plan.colours, 1):
        assert sum(abs(one[1] - one[0]) for one in strokes[number]) == pytest.approx(colour.length, rel=1e-5)
        rows, cells = stroked(strokes[number], labels.shape), np.kron(made[::-1] == colour.label, np.ones((4, 4)))
        assert np.count_nonzero(rows & (cells > 0)) >= 0.985 * np.count_nonzero(cells)


def test_yarn_and_time_by_hand() -> None:
    plan = planned(np.zeros((300, 200), dtype=np.uint8))
    made = tufted(plan, pile_height=0.012, stitch=0.004, waste=0.05, stitch_rate=10.0)
    loops = plan.tufted / 0.004
    assert sum(made.yarn.values()) == pytest.approx(loops * (2 * 0.0125 + 0.004) + 0.1 * plan.strokes)
    assert made.yarn_per_stitch == pytest.approx(0.029)
    assert plan.tufted == pytest.approx(0.2 * 0.3 / SPACING, rel=0.06)
    least = 90 + plan.tufted / 0.04 + 0.4 * plan.strokes
    assert least < made.clock[-1] < 1.4 * least
    assert made.gun_cost["sum"] == pytest.approx(sum(made.gun_cost[cause] for cause in made.gun_cost if cause != "sum"))


def test_a_square_metre_takes_less_than_five_seconds() -> None:
    labels = np.kron(labels_of("flower"), np.ones((3, 3), dtype=np.uint8))[:1000, :1000]
    begin = time.process_time()
    plan = planned(labels)
    assert plan.least_travel > 0
    assert time.process_time() - begin < 5


def run(tmp_path: Path, *more: str) -> tuple[int, dict, str]:
    """The command on a flower; RELIEF: a picture whose left half is black, its right half white."""
    relief = tmp_path / "relief.png"
    Image.fromarray(np.indices((40, 40))[1].astype(np.uint8) // 20 * 255).save(relief)
    Image.fromarray((labels_of("flower") * 100).astype(np.uint8)).save(tmp_path / "flower.png")
    common = ("weave", str(tmp_path / "flower.png"), "--technique", "gun", "--out", str(tmp_path / "out"), "--force")
    given = (str(relief) if one == "RELIEF" else one for one in more)
    result = CliRunner().invoke(main, [*common, *given, "--json", str(tmp_path / "gun.json")])
    data = json.loads((tmp_path / "gun.json").read_text()) if result.exit_code in {0, 3} else {}
    return result.exit_code, data, result.output


def test_the_command_writes_programme_page_and_report(tmp_path: Path) -> None:
    code, data, _ = run(tmp_path, "--size", "40x40cm")
    assert code == 0
    assert data["tufts"] is True
    assert data["coverage"] >= 0.99
    assert data["row_length"] >= data["row_bound"] > 0
    assert data["travel"] >= data["travel_bound"] > 0
    assert {Path(file).name for file in data["files"]} == {"report.html", "gun.ngc", "report.json"}
    assert sum(own["yarn"] for own in data["gun_colours"]) == pytest.approx(data["gun_yarn"])
    assert rs274.read((tmp_path / "out/gun.ngc").read_text()).ended


def test_a_round_carpet_of_two_piles_takes_yarn_by_their_heights(tmp_path: Path) -> None:
    """Yarn by hand; the gun stays within the circle, half a row and 3/4 of a cell of the chart beyond its path."""
    piles = ("--pile-map", "RELIEF", "--pile-levels", "8mm, 14mm loop")
    code, data, output = run(tmp_path, "--size", "40x40cm", "--shape", "round", *piles)
    assert code == 0, output
    low = [own for own in data["gun_colours"] if own["name"].endswith(", 8 mm")]
    high = [own for own in data["gun_colours"] if own["name"].endswith(", 14 mm, loop")]
    assert len(low) + len(high) == len(data["gun_colours"])
    for own, height in [*((one, 8e-3) for one in low), *((one, 14e-3) for one in high)]:
        stitch = 2 * (height + 0.5e-3) + 3e-3
        assert own["yarn"] == pytest.approx(own["rows"] / 3e-3 * stitch + 2 * 0.03 * own["strokes"])
    assert data["coverage"] >= 0.99
    moves = rs274.read((tmp_path / "out/gun.ngc").read_text()).moves
    points = np.array([(at["X"], at["Y"]) for _, on, _, start, end in moves if on for at in (start, end)])
    assert np.hypot(*(points - 200.0).T).max() <= 200.0 - 1.5 + 0.75


@pytest.mark.parametrize(
    ("settings", "check"),
    [
        (("--pile-map", "RELIEF", "--pile-levels", "9mm, 70mm"), "highest pile"),
        (("--pile-map", "RELIEF", "--pile-levels", "0.5mm, 9mm"), "lowest pile"),
        (("--gun", "cones=2"), "colours on the creel"),
        (("--gun", "room_width=30cm"), "width on the gantry"),
        (("--gun", "room_length=30cm"), "length on the gantry"),
        (("--gun", "row_spacing=20mm", "--gun", "smallest=80mm"), "detail finer than the gun"),
        (("--deadline", "1min"), "tufting time"),
    ],
)
def test_what_the_gun_cannot_do_is_a_failed_check(tmp_path: Path, settings: tuple[str, ...], check: str) -> None:
    code, data, _ = run(tmp_path, "--size", "40x40cm", *settings)
    assert code == 3
    assert data["tufts"] is False
    assert check in {one["name"] for one in data["reasons"]}
    assert not (tmp_path / "out/gun.ngc").exists()


@pytest.mark.parametrize(
    ("settings", "words"),
    [
        (("--gun", "smallest=2mm"), "smallest=2 mm"),
        (("--quality", "20x20/dm"), "row_spacing"),
        (("--heads", "2"), "--heads"),
        (("--gun", "cone=2"), "cone"),
        (("--gun", "row_spacing=3"), "did you mean 3mm?"),
    ],
)
def test_bad_input_is_one_clear_error(tmp_path: Path, settings: tuple[str, ...], words: str) -> None:
    code, _, output = run(tmp_path, *settings)
    assert code == 2
    assert words in output
    assert "Traceback" not in output
    assert not (tmp_path / "out").exists()


def test_strokes_of_no_region_have_no_order() -> None:
    assert in_order([], 0j) == []
