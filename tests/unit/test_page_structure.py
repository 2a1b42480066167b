"""The pages of all machines: order of the parts, contents, one colour for each body, cursors that read the curves."""

import re
from collections.abc import Iterator
from dataclasses import dataclass
from xml.etree import ElementTree as ET

import numpy as np
import pytest
from default_machines import default_page, default_report, page_data

from ilmek.machines.catalogue import MACHINES
from ilmek.report import Animation, Axis, Drawing, Plot, Report, Series, at_most, rounded
from ilmek.units import deg, parse_unit
from ilmek.viz.looks import dashes, looked, marker, subject
from ilmek.viz.number_format import number
from ilmek.viz.page import FIRST_CHECKS, TESTS, machine_page
from ilmek.viz.style import colour
from ilmek.viz.svg import svg

PATH = re.compile(r"-?\d+(?:\.\d+)?")


@dataclass(frozen=True)
class Made:
    """A report and its page."""

    report: Report
    page: str


@pytest.fixture(scope="module", params=MACHINES)
def made(request: pytest.FixtureRequest) -> Made:
    """The page of each machine's design by default."""
    return Made(default_report(request.param), default_page(request.param)[0])


def colours(report: Report) -> Iterator[tuple[str, str]]:
    """Subject and colour of each curve of the plots and each bar of the mechanisms, as drawn."""
    for figure in looked(report.figures):
        root = ET.fromstring(svg(figure))
        if isinstance(figure, Plot):
            curves = [one.get("stroke") for one in root.iter() if one.get("stroke-width") == "1.5"]
            several = len(figure.series) > 1 or figure.series[0].label not in ("", figure.y.label, figure.title)
            keys = curves[len(curves) - len(figure.series) :] if several else curves
            yield from zip((one.label for one in figure.series), keys, strict=True)
        elif isinstance(figure, Drawing | Animation):
            bars = [one.get("stroke") for one in root.iter() if one.get("stroke-width") == "7"]
            links = [one.label for one in figure.strokes if one.role == "link"]
            yield from zip(links, bars, strict=len(links) == len(bars))


@pytest.mark.one_in(3)
def test_a_label_has_one_colour_in_all_figures_of_a_page(made: Made) -> None:
    found: dict[str, set[str]] = {}
    for label, shade in colours(made.report):
        if label:
            found.setdefault(subject(label), set()).add(shade)
    for label, shades in found.items():
        assert len(shades) <= 1, label


def test_curves_of_a_plot_differ_in_more_than_colour(made: Made) -> None:
    for plot in (one for one in looked(made.report.figures) if isinstance(one, Plot)):
        styles = [(dashes(one.look, dashed=one.dashed), marker(one.look)) for one in plot.series]
        assert len(set(styles)) == len(styles), plot.name


def test_parts_are_in_order_and_the_contents_lead_to_them(made: Made) -> None:
    parts = ('class="contents"', 'class="answer', 'class="machine"', 'id="checks"', 'id="m1-results"', 'id="tests"')
    at = [made.page.index(part) for part in parts if part in made.page]
    assert at == sorted(at)
    assert made.page.index("<figure") < made.page.index('id="checks"')
    contents = made.page[made.page.index('class="contents"') : made.page.index("</nav>")]
    anchors = re.findall(r'href="#([^"]+)"', contents)
    places = [made.page.index(f'id="{anchor}"') for anchor in anchors]
    assert places == sorted(places)
    assert len(anchors) >= 4


def test_charts_over_the_drive_stand_beside_the_mechanism(made: Made) -> None:
    drives = {one.drive.label for one in made.report.figures if isinstance(one, Animation)}
    beside = [one for one in made.report.figures if isinstance(one, Plot) and one.x.label in drives]
    blocks = "".join(re.findall(r'<div class="motion">(.*?)</div></div>\n', made.page, flags=re.DOTALL))
    assert all(f"<b>{one.title}</b>".replace("'", "&#39;") in blocks for one in beside)


def test_pages_stay_small_and_every_cell_of_a_card_has_its_label(made: Made) -> None:
    assert len(made.page.encode()) < 2_700_000  # the loom with head, creel, guards: motions of 290 kinds of parts
    for table in re.findall(r'<table class="cards">(.*?)</table>', made.page, flags=re.DOTALL):
        assert not re.findall(r'<td class="number">', table)


def test_no_page_shows_rounding_noise(made: Made) -> None:
    text = re.sub(r"<(script|style|metadata).*?</\1>", "", made.page, flags=re.DOTALL)
    assert not re.findall(r"10⁻(?:9|1\d)[^<]{0,3}(?:mm|°|N)\b", text)
    assert "nan" not in re.findall(r"\bnan\b", text)


def test_a_cursor_reads_the_curves_as_they_are() -> None:
    """Straight between the samples that a page holds, as the client reads them, a curve is known to 1/1000."""
    x = np.linspace(0.0, 2 * np.pi, 721)
    curves = (Series("a", x, 3.0 * np.sin(x)), Series("b", x, 40.0 + 5.0 * np.cos(3 * x), dashed=True))
    figure = Plot("p", "P", Axis("angle", "deg"), Axis("force", "N"), curves)
    (data,) = page_data(machine_page(Report("m", "M", {}, (), (), figures=(figure,))))
    at = np.random.default_rng(3).uniform(0.0, 2 * np.pi, 500)
    for curve, shown in zip(curves, data["plot"]["series"], strict=True):
        assert len(shown["x"]) < 360
        assert np.abs(np.interp(at, shown["x"], shown["y"]) - np.interp(at, curve.x, curve.y)).max() < 1e-3 * 48.0


def test_checks_that_hold_are_folded_beyond_the_first_and_failed_ones_never() -> None:
    checks = tuple(at_most(f"check {n}", 2.0 if n % 2 else 0.5, 1.0, "mm", "") for n in range(30))
    page = machine_page(Report("m", "M", {}, (), checks))
    assert "<summary>15 more checks, which hold</summary>" in page
    assert page.index("check 29</th>") < page.index("15 more checks") < page.index("check 0</th>")
    few = machine_page(Report("m", "M", {}, (), checks[: FIRST_CHECKS + 2]))
    assert "more checks" not in few


def test_self_tests_stand_apart_at_the_end() -> None:
    tests = (at_most("power balance", 1e-15, 1e-9, "", "virtual power"),)
    page = machine_page(Report("m", "M", {}, (), (at_most("sag", 1.0, 2.0, "mm", ""),), self_tests=tests))
    assert page.index("sag</th>") < page.index(f">{TESTS}</h2>") < page.index("power balance</th>")
    assert "1 of 1 checks hold" not in page
    assert "The only one passes" in page
    assert "The only check holds." in page


@pytest.mark.parametrize(
    ("value", "unit", "shown"),
    [
        (1.735e-17, "mm", "0"),
        (-1.2e-19, "mm", "0"),
        (0.0597375, "mm", "59.74"),
        (0.0051234, "mm", "5.123"),
        (4.5123e-7, "mm", "0.00045"),
        (12.3456 * deg, "deg", "12.35"),
        (0.1234 * deg, "deg", "0.12"),
        (1e-14 * deg, "deg", "0"),
        (123456.0, "N", "123\u202f456"),
        (3e-16, "", "0"),
        (0.00012345, "", "0.0001234"),
        (float("nan"), "mm", "–"),
    ],
)
def test_numbers_are_rounded_as_an_engineer_would(value: float, unit: str, shown: str) -> None:
    assert number(value, unit) == shown


def test_rounding_keeps_four_digits_or_the_resolution() -> None:
    rng = np.random.default_rng(1)
    for unit, resolution in (("mm", 1e-3), ("deg", 1e-2), ("N", 1e-3), ("s", 0.0)):
        factor = parse_unit(unit).factor
        for shown in 10.0 ** rng.uniform(-2, 6, 200) * rng.choice([-1.0, 1.0], 200):
            error = abs(rounded(shown * factor, unit) / factor - shown)
            assert error <= max(0.5 * resolution, 0.05 * min(abs(shown), 10 * resolution)) + 1e-9 * abs(shown)


def test_more_curves_than_colours_still_differ() -> None:
    x = np.linspace(0.0, 1.0, 5)
    plot = Plot("p", "P", Axis("x"), Axis("y"), tuple(Series(f"curve {n}", x, x) for n in range(20)))
    (made,) = looked((plot,))
    assert isinstance(made, Plot)
    assert len({(colour(one.look), dashes(one.look), marker(one.look)) for one in made.series}) == 20
