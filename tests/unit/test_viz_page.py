"""The pages: complete in themselves, sound HTML, nothing from outside taken for markup."""

import base64
import io
import json
import re
from dataclasses import replace
from html.parser import HTMLParser

import numpy as np
import pytest
from PIL import Image

from ilmek.carpet.bill import yarn_bill
from ilmek.carpet.chart import Chart
from ilmek.carpet.chart_reading import ChartReading
from ilmek.carpet.differences import YarnDifference
from ilmek.carpet.quality import Quality
from ilmek.carpet.sizes import CarpetSize
from ilmek.carpet.statistics import chart_statistics
from ilmek.carpet.yarn import Yarn
from ilmek.report import Axis, Check, Column, Lane, Plot, Report, Result, Series, Table, Timing, at_least, at_most
from ilmek.viz.carpet_page import CarpetPage, carpet_page
from ilmek.viz.loom_page import LoomPage, loom_page
from ilmek.viz.page import machine_page
from ilmek.viz.page_parts import Fact, FileNote
from ilmek.viz.page_pictures import LARGEST, yarn_codes

HOSTILE = '<script>alert("x")</script> & <img src=http://evil.example/x.png onerror=y>'
VOID = {"meta", "img", "br", "hr", "input", "link"}
TURN = np.linspace(0.0, 2 * np.pi, 60)


class Reader(HTMLParser):
    """Reads a page: its elements, its text, whether every element is closed in order."""

    def __init__(self) -> None:
        super().__init__()
        self.open: list[str] = []
        self.elements: list[tuple[str, dict[str, str | None]]] = []
        self.words: list[str] = []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.elements.append((tag, dict(attrs)))
        if tag not in VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.elements.append((tag, dict(attrs)))

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag

    def handle_data(self, data: str) -> None:
        if not {"script", "style"} & set(self.open):
            self.words.append(data)

    @property
    def text(self) -> str:
        return re.sub(r"\s+", " ", " ".join(self.words))


def read(page: str) -> Reader:
    reader = Reader()
    reader.feed(page)
    reader.close()
    assert reader.open == []
    return reader


def report(name: str, checks: tuple[Check, ...] = ()) -> Report:
    curve = Series(name, TURN, np.sin(TURN))
    return Report(
        name,
        f"Machine {name}",
        {"speed": 15.5, "law": name},
        (
            Result("torque", 3.2711, "N*m", f"meaning of {name}"),
            Result("lengths", {"crank": 0.05994}, "mm", "lengths"),
            Result("phases", [{"kind": name, "start": 0.0}], "", "phases"),
            Result("missing", None, "mm", "nothing"),
        ),
        checks,
        (Table("t", f"Table {name}", (Column("name"), Column("force", "kN")), ((name, 1500.0),)),),
        (
            Plot("curve", name, Axis("angle", "deg"), Axis("force", "N"), (curve, curve), note=name),
            Timing("cycle", name, 1.0, (Lane(name, name, TURN, TURN / 7),)),
        ),
        (f"careful with {name}",),
    )


def carpet(name: str = "madder") -> Chart:
    knots = np.zeros((30, 20), dtype=np.uint8)
    knots[5:9, 4:12] = 1
    yarns = (
        Yarn(name, (150, 30, 40), (0.0, 0.0, 0.0), 4.0, 2, 10.0),
        Yarn("ivory", (240, 230, 210), (9.0, 0.0, 0.0), 4.0),
    )
    reading = ChartReading("photo", "", 1.25, 1.0, differences=(YarnDifference(1.1, 3.3), YarnDifference(2.2, 7.7)))
    return Chart(knots, yarns, CarpetSize(0.08, 0.12), Quality(250.0, 250.0), "symmetric", reading)


def page(name: str = "plain", checks: tuple[Check, ...] = (), chart: Chart | None = None) -> str:
    chart = chart or carpet(name)
    return carpet_page(
        CarpetPage(
            f"Carpet {name}",
            f"lead {name}",
            chart,
            yarn_bill(chart),
            chart_statistics(chart),
            "A<",
            np.full((60, 40, 3), 128, dtype=np.uint8),
            reading=(Fact("Read as", name, name),),
            facts=(Fact("Weaving time", name, name),),
            checks=checks,
            files=(FileNote(f"{name}.png", name),),
            warnings=(f"careful with {name}",),
            loom=f"{name}.html",
            nearest=name,
        )
    )


def loom(name: str = "plain", checks: tuple[Check, ...] = ()) -> str:
    reports = (report(name, checks), report(name, checks))
    return loom_page(LoomPage(f"Loom {name}", f"lead {name}", "report.html", reports, (), (name,)))


CHECKS = (at_most("slope", 0.001, 0.002, "mrad", "bearing list"), at_least("angle", 0.5, 0.7, "deg", "p. 3"))
MAKERS = {"carpet": page, "loom": loom, "machine": lambda name, checks: machine_page(report(name, checks))}


@pytest.fixture(scope="module", params=MAKERS)
def each(request: pytest.FixtureRequest) -> str:
    """Each page."""
    return MAKERS[request.param]("plain", CHECKS)


@pytest.fixture(scope="module")
def plain() -> str:
    return page(checks=CHECKS)


def test_needs_no_network(each: str) -> None:
    for tag, attributes in read(each).elements:
        for name in ("src", "href", "xlink:href", "data", "action", "srcset", "poster"):
            address = attributes.get(name) or ""
            assert not re.match(r"(?i)\s*(?:https?:|//|ftp:)", address), (tag, address)
    assert "@import" not in each
    assert not re.search(r"url\(\s*['\"]?(?!#)", each)
    assert not re.search(r"fetch\(|XMLHttpRequest|import\(", each)


def test_ids_are_unique_and_links_within_are_met(each: str) -> None:
    elements = read(each).elements
    ids = [attributes["id"] for _, attributes in elements if "id" in attributes]
    assert len(ids) == len(set(ids))
    links = {a[name] for _, a in elements for name in ("href", "xlink:href") if (a.get(name) or "").startswith("#")}
    assert {(link or "")[1:] for link in links} <= set(ids)
    assert set(re.findall(r"url\(#([^)]+)\)", each)) <= set(ids)


def test_the_page_of_a_carpet_states_summary_yarn_and_statistics(plain: str) -> None:
    text = read(plain).text
    stated = ("600", "20 across × 30 rows", "8 × 12 cm", "Weaving time", "mean ΔE 1.2", "Read as", "careful with plain")
    for words in (*stated, "1.1", "3.3", "7.7", "Hardest rows", "22 (2), 23 (2), 24 (2), 25 (2)", "Changes of colour"):
        assert words in text, words


def test_the_page_of_a_loom_has_results_and_warnings() -> None:
    text = read(loom(checks=CHECKS)).text
    for words in ("3.271 N·m", "59.94 mm", "1.5", "force [kN]", "careful with plain", "1 of 2 checks do not hold"):
        assert words in text, words


def test_failed_checks_come_first_and_are_marked() -> None:
    made = loom(checks=CHECKS)
    rows = re.findall(r'<tr class="(pass|fail)">(.*?)</tr>', made, flags=re.DOTALL)
    assert [verdict for verdict, _ in rows] == ["fail", "fail", "pass", "pass"]
    assert "✗ FAIL" in rows[0][1]
    assert "≥ 40.11" in rows[0][1]
    assert "2 of 4 checks do not hold." in read(made).text


def test_sections_with_a_failed_check_are_open() -> None:
    reports = (report("a"), report("b"), report("c", CHECKS))
    made = loom_page(LoomPage("t", "l", "report.html", reports))
    folded = [attributes for tag, attributes in read(made).elements if tag == "details" and attributes.get("class")]
    assert ["open" in attributes for attributes in folded] == [True, False, True]


def test_the_verdict_of_a_carpet_is_short_and_links_to_the_loom(plain: str) -> None:
    many = tuple(at_most(f"check {number}", 2.0, 1.0, "mm", "") for number in range(9))
    made = page(checks=many)
    assert "<summary>6 more</summary>" in made
    assert "9 of 9 checks do not hold" in read(made).text
    assert '<a href="plain.html">' in made
    assert "1 of 2 checks does not hold" in read(plain).text
    assert "not hold" not in read(page(checks=CHECKS[:1])).text


def test_pictures_have_words_and_tables_have_headings(each: str) -> None:
    reader = read(each)
    pictures = [attributes for tag, attributes in reader.elements if tag == "img"]
    assert all(attributes.get("alt") for attributes in pictures)
    assert all((attributes["src"] or "").startswith("data:image/") for attributes in pictures)
    drawings = [attributes for tag, attributes in reader.elements if tag == "svg"]
    assert all(attributes.get("role") == "img" and attributes.get("aria-label") for attributes in drawings)
    assert each.count("<thead>") == each.count("<table")
    assert all(attributes.get("scope") for tag, attributes in reader.elements if tag == "th")


def test_every_number_of_a_card_has_its_label(plain: str) -> None:
    """On a narrow screen the headings are hidden: each number of the yarn table needs its label."""
    rows = re.findall(
        r"<tr><th scope=\"row\">.*?</tr>", plain[plain.index('id="yarn"') : plain.index('id="statistics"')]
    )
    numbers = re.findall(r"<td class=\"number[^>]*>[^<]+", "".join(rows))
    assert len(numbers) > 20
    assert all("data-label" in number for number in numbers)


def test_the_pictures_of_a_carpet_lie_over_each_other_in_one_geometry(plain: str) -> None:
    pictures = [attributes for tag, attributes in read(plain).elements if tag == "img"]
    assert len(pictures) == 4
    pile = dict(re.findall(r"--(left|top|width|height): ([\d.]+)%", plain))
    shares = {name: float(share) / 100 for name, share in pile.items()}
    assert 2 * shares["left"] + shares["width"] == pytest.approx(1.0)
    assert 2 * shares["top"] + shares["height"] == pytest.approx(1.0)
    whole = Image.open(io.BytesIO(base64.b64decode((pictures[0]["src"] or "").partition(",")[2])))
    across, down = shares["width"] * whole.width, shares["height"] * whole.height
    assert across / down == pytest.approx(0.08 / 0.12, rel=0.005)


def shown_chart(made: str) -> tuple[np.ndarray, dict[str, object]]:
    """The pixels of the chart's picture, and the page's data of them."""
    address = re.search(r'class="layer chart"><img[^>]*src="data:image/png;base64,([^"]+)"', made)
    data = re.search(r'id="chart-data">(.*?)</script>', made)
    assert address
    assert data
    picture = Image.open(io.BytesIO(base64.b64decode(address[1]))).convert("RGB")
    return np.asarray(picture, dtype=np.int64) @ np.array([65536, 256, 1]), json.loads(data[1])


def test_a_pixel_of_the_chart_tells_its_yarn_even_of_one_colour() -> None:
    chart = carpet()
    same = tuple(replace(chart.yarns[0], name=name) for name in ("one", "two", "three"))
    knots = np.arange(600, dtype=np.uint8).reshape(30, 20) % 3
    pixels, data = shown_chart(page(chart=Chart(knots, same, chart.size, chart.quality, "symmetric")))
    assert np.array_equal(np.array(data["codes"])[knots], pixels)
    assert data["names"] == ["one", "two", "three"]
    assert (data["rows"], data["columns"], data["step"]) == (30, 20, 1)


@pytest.mark.matrix(light=1)
@pytest.mark.parametrize("srgb", [(0, 0, 0), (255, 255, 255), (9, 250, 4)])
def test_yarns_of_one_colour_get_codes_of_their_own_nearby(srgb: tuple[int, int, int]) -> None:
    yarns = tuple(Yarn(str(number), srgb, (0.0, 0.0, 0.0), 4.0) for number in range(255))
    codes = yarn_codes(replace(carpet(), yarns=yarns))
    assert len(set(codes)) == 255
    assert codes[0] == srgb
    assert max(abs(a - b) for code in codes for a, b in zip(code, srgb, strict=True)) <= 8


def test_a_large_chart_is_thinned_to_exact_knots() -> None:
    knots = np.random.default_rng(1).integers(0, 2, (3300, 2), dtype=np.uint8)
    large = Chart(knots, carpet().yarns, CarpetSize(0.01, 13.2), Quality(250.0, 250.0), "symmetric")
    pixels, data = shown_chart(page(chart=large))
    assert data["step"] == 3
    assert max(pixels.shape) <= LARGEST
    assert np.array_equal(np.array(data["codes"])[knots[::3, ::3]], pixels)


@pytest.mark.parametrize("maker", MAKERS)
def test_what_comes_from_outside_stays_text(maker: str) -> None:
    made = MAKERS[maker](HOSTILE, (at_most(HOSTILE, 2.0, 1.0, "mm", HOSTILE),))
    reader = read(made)
    scripts = sum(tag == "script" and "type" not in attributes for tag, attributes in reader.elements)
    assert scripts == {"carpet": 2, "loom": 1, "machine": 1}[maker]
    assert not [attributes for tag, attributes in reader.elements if "onerror" in attributes]
    assert not [a for tag, a in reader.elements if tag == "img" and "evil" in (a.get("src") or "")]
    assert reader.text.count('alert("x")') > 10


def test_machine_page_is_complete() -> None:
    made = machine_page(report("beat", (at_most("slope", 0.001, 0.002, "mrad", "list"),)))
    text = read(made).text
    assert made.startswith("<!DOCTYPE html>")
    assert "The only check holds." in text
    assert "meaning of beat" in text
    assert made.count("<svg") == 2


def test_machine_page_of_an_empty_report_is_sound() -> None:
    read(machine_page(Report("m", "Empty", {}, (), ())))


def test_long_tables_are_folded() -> None:
    rows = tuple((float(n),) for n in range(40))
    made = machine_page(Report("m", "M", {}, (), (), (Table("t", "Points", (Column("x", "mm"),), rows),)))
    assert "<summary>Points (40 rows)</summary>" in made
