"""A chart of any array of indices: what is written in every format is what was given, or an error names the fault."""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from PIL import Image
from processes import ended, python

import ilmek
from ilmek.carpet.chart import Chart
from ilmek.carpet.overlay import HALF, Overlay
from ilmek.carpet.quality import Quality
from ilmek.carpet.sizes import CarpetSize
from ilmek.carpet.yarn import Yarn
from ilmek.errors import CarpetError, PictureError, YarnError
from ilmek.io.chart.formats import FORMATS, read_chart
from ilmek.io.picture import Picture

TYPES = (*np.typecodes["AllInteger"], "?", *np.typecodes["Float"])
ORDERS: tuple[Callable[[np.ndarray], np.ndarray], ...] = (
    np.asarray,
    np.asfortranarray,
    lambda array: array[::-1, ::-1],
    lambda array: np.repeat(array, 2, axis=1)[:, ::2],
    lambda array: array.astype(array.dtype.newbyteorder()),
)


def yarns(number: int) -> tuple[Yarn, ...]:
    return tuple(Yarn(f"yarn {k}", (k, 255 - k, k * 7 % 256), (50.0, k / 4, 0.0)) for k in range(number))


def chart(knots: object, number: int = 2, grid: tuple[int, int] = (12, 9)) -> Chart:
    """A chart of a carpet with these rows and columns at 10 x 10 knots per dm."""
    return Chart(knots, yarns(number), CarpetSize(grid[1] / 100, grid[0] / 100), Quality(100.0, 100.0), "symmetric")


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("arrays")


@given(
    st.tuples(st.sampled_from(TYPES), st.sampled_from(ORDERS)),
    st.integers(2, 255),
    st.tuples(st.integers(2, 25), st.integers(2, 25)),
    st.integers(0, 10**6),
)
def test_every_type_of_numbers_and_order_comes_back_from_every_format(
    folder: Path, form: tuple[str, Callable[[np.ndarray], np.ndarray]], number: int, grid: tuple[int, int], seed: int
) -> None:
    kind, order = form
    most = 2 if kind == "?" else min(number, 127)
    indices = np.random.default_rng(seed).integers(0, most, grid)
    given_chart = chart(order(indices.astype(kind)), number, grid)
    drawn = order(indices)
    assert given_chart.counts == tuple(np.bincount(drawn.ravel(), minlength=number).tolist())
    for row in FORMATS.values():
        row.save(folder / row.file, given_chart)
        if row.read is not None:
            back, notes = read_chart(folder / row.file)
            assert (back.knots.tolist(), notes) == (drawn.tolist(), ())
            assert back.yarns == given_chart.yarns
    with Image.open(folder / "chart.bmp") as picture:
        assert np.asarray(picture).tolist() == drawn.tolist()
    colours = np.array([yarn.srgb for yarn in given_chart.yarns])
    with Image.open(folder / "chart.png") as picture:
        assert np.asarray(picture.convert("RGB")).tolist() == colours[drawn].tolist()


@given(
    st.sampled_from(TYPES[:-4]),
    st.integers(1, 255),
    st.integers(-(2**70), 2**70) | st.integers(-300, 600),
    st.integers(0, 11),
    st.integers(0, 8),
)
def test_one_index_out_of_range_is_an_error_that_names_it(
    kind: str, number: int, index: int, row: int, column: int
) -> None:
    knots = np.zeros((12, 9), kind)
    limits = np.iinfo(kind) if kind != "?" else None
    if limits is None or not limits.min <= index <= limits.max or 0 <= index < number:
        index = -1 if limits is not None and limits.min < 0 else number
        if limits is None or index > limits.max:
            return
    knots[row, column] = index
    with pytest.raises(CarpetError, match=rf"knots\[{row}, {column}\] is .*whole numbers 0 to {number - 1}:"):
        chart(knots, number)


@pytest.mark.parametrize(
    ("knots", "reason"),
    [
        (np.full((12, 9), 0.5), r"knots\[0, 0\] is 0.5"),
        (np.full((12, 9), np.nan), r"knots\[0, 0\] is nan"),
        (np.full((12, 9), np.inf), r"knots\[0, 0\] is inf"),
        (np.full((12, 9), 1j), "complex128"),
        (np.full((12, 9), "1"), "<U1"),
        (np.full((12, 9), None), "object"),
        (np.full((12, 9), np.datetime64("2026-01-01")), "datetime64"),
        (np.ma.masked_equal(np.zeros((12, 9), int), 0), "masked"),
        (np.zeros((9, 12), int), r"\(9, 12\); \(12, 9\), rows and columns of 9 × 12 cm at 10x10/dm"),
        (np.zeros((10, 10), np.uint8), r"\(10, 10\)"),
        (np.zeros((12, 9, 1), int), r"\(12, 9, 1\)"),
        (np.zeros(108, int), r"\(108,\)"),
        (np.zeros((0, 0), int), r"\(0, 0\)"),
        (np.zeros((0, 9), np.uint8), r"\(0, 9\)"),
        ([[0] * 9] * 11 + [[0] * 8], "different lengths"),
        ("knots", "<U5"),
        (None, "object"),
        (0, r"\(1,\)"),
    ],
)
def test_what_is_no_array_of_indices_is_an_error(knots: object, reason: str) -> None:
    with pytest.raises(CarpetError, match=reason):
        chart(knots)


def test_rows_of_numbers_and_masks_are_indices() -> None:
    disc = np.hypot(*np.mgrid[-6:6, -4:5]) < 3
    as_rows = chart(disc.astype(int).tolist())
    assert as_rows.knots.dtype == np.uint8
    assert chart(disc).counts == as_rows.counts == (int((~disc).sum()), int(disc.sum()))


FIELDS = {
    "knot": [("celtic", "unknown knot"), (3, "unknown knot 3"), (None, "unknown knot None")],
    "size": [(None, "size is None"), (1.2, "size is 1.2"), ("tiny", "unknown size"), (CarpetSize(1.0, 1.0), "shape")],
    "quality": [(None, "quality is None"), (100, "quality is 100"), ("fine", "unknown quality")],
    "yarns": [((), "0 yarns"), (None, "None"), (("red",), "'red'"), (yarns(1) * 256, "256 yarns")],
    "overlay": [(None, "NoneType"), ([], "list")],
}


@pytest.mark.parametrize(
    ("name", "value", "reason"), [(name, *case) for name, cases in FIELDS.items() for case in cases]
)
def test_other_fields_are_checked(name: str, value: object, reason: str) -> None:
    with pytest.raises((CarpetError, YarnError), match=reason):
        replace(chart(np.zeros((12, 9), int)), **{name: value})


def test_texts_and_trade_names_are_read_as_by_the_command_line() -> None:
    made = Chart(np.zeros((12, 9), int), list(yarns(2)), "9x12cm", "10x10/dm", "Senneh")
    assert (made.size, made.quality, made.knot) == (CarpetSize(0.09, 0.12), Quality(100.0, 100.0), "asymmetric")
    assert made.yarns == yarns(2)


@pytest.mark.parametrize(
    ("change", "reason"),
    [
        ({"rows": np.array([-1], np.int32)}, "outside"),
        ({"columns": np.array([-1], np.int32)}, "outside"),
        ({"columns": np.array([9], np.int32)}, "outside"),
        ({"rows": np.array([1])}, "rows of the overlay"),
        ({"kinds": np.array([7], np.uint8)}, "no kind"),
        ({"seconds": np.array([2], np.uint8)}, "second yarn"),
        ({"seconds": np.array([], np.uint8)}, "seconds of the overlay"),
    ],
)
def test_an_overlay_of_arrays_is_checked(change: dict[str, np.ndarray], reason: str) -> None:
    fields = {
        "rows": np.array([1], np.int32),
        "columns": np.array([1], np.int32),
        "kinds": np.array([HALF], np.uint8),
        "seconds": np.array([1], np.uint8),
    }
    good = chart(np.zeros((12, 9), int))
    assert replace(good, overlay=Overlay(**fields)).tied.half == (1, 1)
    with pytest.raises(CarpetError, match=reason):
        replace(good, overlay=Overlay(**{**fields, **change}))


@pytest.mark.parametrize(
    "field",
    [
        {"srgb": (1, 2)},
        {"srgb": (1, 2, 300)},
        {"srgb": (-1, 2, 3)},
        {"srgb": (0.5, 2, 3)},
        {"srgb": "#102030"},
        {"lab": (50.0, 0.0)},
        {"lab": (50.0, float("nan"), 0.0)},
        {"lab": None},
        {"metric_count": 0.0},
        {"metric_count": "2.5"},
        {"ply": 0},
        {"ply": 1.5},
        {"price": -1.0},
        {"name": 5},
    ],
)
def test_a_yarn_is_checked(field: dict[str, object]) -> None:
    with pytest.raises(YarnError, match=f"a yarn with .*{next(iter(field))}"):
        Yarn(**{"name": "red", "srgb": (200, 0, 0), "lab": (40.0, 60.0, 50.0), **field})


@pytest.mark.parametrize("record", [CarpetSize, Quality])
@pytest.mark.parametrize("value", ["1", None, True, 1j, float("nan"), float("inf"), (1.0,)])
def test_a_size_and_a_quality_are_of_numbers(record: type, value: object) -> None:
    with pytest.raises(CarpetError):
        record(value, 100.0 if record is Quality else 1.0)


@given(st.sampled_from(np.typecodes["AllInteger"]), st.integers(0, 10**6))
def test_pixels_of_every_type_of_integers_are_one_picture(kind: str, seed: int) -> None:
    pixels = np.random.default_rng(seed).integers(0, 128, (9, 8, 3))
    assert Picture(pixels.astype(kind)).rgb.tolist() == pixels.tolist()
    if np.iinfo(kind).max > 255:
        pixels[4, 3, 1] = 256
        with pytest.raises(PictureError, match=r"rgb\[4, 3, 1\] is 256"):
            Picture(pixels.astype(kind))


@pytest.mark.parametrize(
    ("pixels", "reason"),
    [
        (np.zeros((9, 8, 3)), r"\(255 \* rgb\)\.round\(\)\.astype"),
        (np.full((9, 8, 3), 200.0), r"; rgb\.round\(\)\.astype"),
        (np.zeros((9, 8, 3), bool), "bool"),
        (np.zeros((9, 8), np.uint8), r"\(9, 8\)"),
        (np.zeros((9, 8, 4), np.uint8), r"\(9, 8, 4\)"),
        (None, "a NoneType given for a picture"),
        ([[1, 2], [3]], "different lengths"),
    ],
)
def test_what_is_no_picture_is_an_error(pixels: object, reason: str) -> None:
    for make in (Picture, lambda rgb: ilmek.make_chart(rgb, "9x12cm", "10x10/dm")):
        with pytest.raises(PictureError, match=reason):
            make(pixels)


CHECKED = """
import sys
import numpy as np
from ilmek.carpet.chart import Chart
from ilmek.carpet.confetti import merge_patches
from ilmek.carpet.statistics import chart_statistics
from ilmek.carpet.yarn import Yarn, yarn_labs
from ilmek.io.chart.rows_text import write_rows_text
from ilmek.viz.carpet_picture import draw_carpet

for number, grid in ((2, (2, 2)), (255, (17, 31)), (3, (40, 9))):
    yarns = tuple(Yarn(f"yarn {k}", (k, k, k), (k / 3, 0.0, 0.0), 5.0) for k in range(number))
    knots = np.random.default_rng(number).integers(0, number, grid)
    knots[0, 0] = knots[-1, -1] = number - 1
    chart = Chart(knots, yarns, f"{grid[1]}x{grid[0]}cm", "10x10/dm", "senneh")
    assert sum(chart.counts) == knots.size
    chart_statistics(chart)
    draw_carpet(chart, 200)
    merge_patches(chart.knots, np.zeros((*grid, 3), np.uint8), yarn_labs(yarns), 4)
print("checked")
"""


def test_kernels_of_a_chart_keep_inside_their_arrays() -> None:
    """Each index is checked in the machine code; one outside is an IndexError."""
    run = ended(python("-c", CHECKED), changes={"ILMEK_BOUNDS_CHECK": "1"})
    assert (run.stdout, run.returncode) == ("checked\n", 0), run.stderr


def test_a_changed_array_does_no_harm_to_the_memory() -> None:
    """A chart keeps an array of its own type as it is; the table of the counts has every code."""
    knots = np.zeros((12, 9), np.uint8)
    made = chart(knots)
    knots[3, 4] = 200
    assert sum(made.counts) == 107
