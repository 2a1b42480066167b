"""Figures: well-formed SVG that says what the figure says, the same each time, and small."""

import re
from collections.abc import Sequence
from xml.etree import ElementTree as ET

import numpy as np
import pytest

from ilmek.report import Axis, Dot, Drawing, Figure, Lane, Mark, Plot, Series, Stroke, Timing
from ilmek.units import deg, mm
from ilmek.viz.svg import svg

TURN = np.linspace(0.0, 2 * np.pi, 5000)
ROLES = ("outline", "link", "ground", "guide", "path", "construction", "dimension", "yarn")

PLOT = Plot(
    "torque",
    "Drive torque",
    Axis("crank angle", "deg"),
    Axis("torque", "N*m"),
    (Series("inertia", TURN, 12 * np.sin(TURN)), Series("limit", TURN, np.full_like(TURN, 15.0), dashed=True)),
    (Mark(90 * deg, "beat"), Mark(92 * deg, "front dead centre")),
)
DRAWING = Drawing(
    "linkage",
    "Every role",
    tuple(Stroke(np.array([0, 0.1 + 0.02j * n, 0.2]), role, f"the {role}") for n, role in enumerate(ROLES)),
    (Dot(0j, "A", "pivot"), Dot(0.1 + 0j, "B"), Dot(0.2 + 0j, "C", "point")),
)
TIMING = Timing(
    "knot",
    "One knot",
    2.0,
    (
        Lane("hook", "cam 1", TURN, 0.5 - 0.5 * np.cos(TURN), (Mark(1.0, "caught"), Mark(6.2, "home again"))),
        Lane("knife", "cam 2", TURN, np.zeros_like(TURN), (Mark(3.0, "cut"),)),
    ),
)
FIGURES: tuple[Figure, ...] = (PLOT, DRAWING, TIMING)


def parsed(text: str) -> ET.Element:
    return ET.fromstring(text)


def texts(element: ET.Element) -> list[str]:
    return [(one.text or "").strip() for one in element.iter() if one.tag.endswith("}text")]


def points(path: str) -> list[tuple[float, float]]:
    numbers = [float(number) for number in re.findall(r"-?\d+(?:\.\d+)?", path)]
    return list(zip(numbers[::2], numbers[1::2], strict=True))


@pytest.mark.parametrize("figure", FIGURES, ids=lambda figure: figure.name)
def test_is_well_formed_small_and_the_same_each_time(figure: Figure) -> None:
    text = svg(figure)
    root = parsed(text)
    assert root.tag == "{http://www.w3.org/2000/svg}svg"
    assert root.get("aria-label") == figure.title
    assert len(text.encode()) < 80_000
    assert svg(figure) == text
    assert "date" not in text.lower()


@pytest.mark.parametrize("figure", FIGURES, ids=lambda figure: figure.name)
def test_has_no_ids_and_no_styles_of_its_own(figure: Figure) -> None:
    """A page holds many figures: an id would stand there twice, a style would hold for the whole page."""
    text = svg(figure)
    assert not re.search(r"\sid=|href=|url\(|<style", text)


def test_plot_says_labels_units_marks_and_angles() -> None:
    said = texts(parsed(svg(PLOT)))
    assert {"crank angle [°]", "torque [N·m]", "inertia", "limit", "beat", "front dead centre"} <= set(said)
    first = said.index("45") - 1
    assert said[first : first + 9] == [str(45 * n) for n in range(9)]


def test_plot_shows_the_data_in_the_axis_unit() -> None:
    """12 N·m stay 12 on the axis, radians become degrees."""
    said = texts(parsed(svg(PLOT)))
    assert {"10", "−10", "360"} <= set(said)


def test_small_numbers_at_the_ticks_keep_their_decimals() -> None:
    small = Series("error", np.arange(3.0), np.array([0.0, 1e-3, 2e-3]) * deg)
    said = texts(parsed(svg(Plot("small", "Small", Axis("x"), Axis("error", "deg"), (small,)))))
    assert {"0.0005", "0.0010", "0.0020"} <= set(said)


def test_one_curve_named_like_its_axis_needs_no_legend() -> None:
    alone = Plot("one", "One", Axis("time", "s"), Axis("force", "N"), (Series("force", TURN, TURN),))
    assert "force" not in texts(parsed(svg(alone)))
    assert "force [N]" in texts(parsed(svg(alone)))


@pytest.mark.parametrize("values", [[], [np.nan, np.nan], [3.0, 3.0], [np.inf, 1.0], [1e-9, 2e-9], [-1e8, 1e8]])
def test_plot_of_odd_data_is_drawn(values: Sequence[float]) -> None:
    data = np.array(values, dtype=float)
    parsed(svg(Plot("odd", "Odd", Axis("x", "mm"), Axis("y"), (Series("s", np.arange(len(data)) * 1.0, data),))))
    parsed(svg(Plot("none", "None", Axis("x", "mm"), Axis("y"), ())))


def test_drawing_has_one_scale_for_both_directions() -> None:
    """A square of 100 mm is as high as wide, and the scale bar measures it."""
    square = np.array([0, 100 * mm, (100 + 100j) * mm, 100j * mm])
    root = parsed(svg(Drawing("square", "Square", (Stroke(square, "outline", closed=True),))))
    shapes = [points(one.get("d", "")) for one in root.iter() if one.tag.endswith("path")]
    (outline,) = [shape for shape in shapes if len(shape) == 5 and shape[0] == shape[-1] and shape[0][0] > 1]
    width = max(x for x, _ in outline) - min(x for x, _ in outline)
    height = max(y for _, y in outline) - min(y for _, y in outline)
    assert width == pytest.approx(height, abs=0.02)
    (label,) = [one for one in texts(root) if one.endswith(" mm")]
    (bar,) = [shape for shape in shapes if len(shape) == 6]
    length = max(x for x, _ in bar) - min(x for x, _ in bar)
    assert length / width == pytest.approx(float(label.split()[0]) / 100, rel=1e-3)


def test_drawing_names_every_stroke_and_dot() -> None:
    assert {f"the {role}" for role in ROLES} | {"A", "B", "C"} <= set(texts(parsed(svg(DRAWING))))


def test_drawing_of_nothing_or_of_one_point_is_drawn() -> None:
    parsed(svg(Drawing("empty", "Empty", ())))
    parsed(svg(Drawing("dot", "Dot", (Stroke(np.array([1 + 1j]), "path"),), (Dot(1 + 1j, "A"),))))


def test_timing_says_tracks_events_angle_and_time() -> None:
    said = set(texts(parsed(svg(TIMING))))
    assert {"hook", "cam 1", "knife", "caught", "home again", "cut", "master angle [°]", "time [s]"} <= said
    assert {str(30 * n) for n in range(13)} <= said
    assert "time [ms]" in texts(parsed(svg(Timing("quick", "Quick", 0.2, TIMING.lanes))))


def test_hostile_words_stay_words() -> None:
    words = 'a < b & "c" $x_{1}$ \x07 \\frac </svg><script>'
    figure = Plot("x y/<z>", words, Axis(words), Axis(words), (Series(words, TURN, TURN), Series("b", TURN, -TURN)))
    root = parsed(svg(figure))
    assert not [one for one in root.iter() if one.tag.endswith("script")]
    assert words.replace("\x07", "") in texts(root)


def test_letters_that_the_font_lacks_are_no_reason_to_warn() -> None:
    assert "絨毯" in svg(Plot("k", "絨毯", Axis("x"), Axis("y"), (Series("絨毯", TURN, TURN),)))
