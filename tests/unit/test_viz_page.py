"""The pages: complete in themselves, sound HTML, nothing from outside taken for markup."""

import re
from html.parser import HTMLParser

import numpy as np
import pytest

from ilmek.carpet.bill import yarn_bill
from ilmek.carpet.chart import Chart, ChartReading
from ilmek.carpet.quality import Quality
from ilmek.carpet.sizes import CarpetSize
from ilmek.carpet.yarn import Yarn
from ilmek.report import Axis, Check, Column, Lane, Plot, Report, Result, Series, Table, Timing, at_least, at_most
from ilmek.viz.page import CarpetPage, carpet_page, machine_page
from ilmek.viz.page_parts import Fact, FileNote

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
    return Chart(
        knots, yarns, CarpetSize(0.08, 0.12), Quality(250.0, 250.0), "symmetric", ChartReading("photo", "", 1.25, 1.0)
    )


def page(name: str = "plain", checks: tuple[Check, ...] = ()) -> str:
    chart = carpet(name)
    return carpet_page(
        CarpetPage(
            f"Carpet {name}",
            f"lead {name}",
            chart,
            yarn_bill(chart),
            "A<",
            (Fact("Weaving time", name, name),),
            (report(name, checks), report(name, checks)),
            (),
            (FileNote(f"{name}.png", name),),
            (name,),
        )
    )


@pytest.fixture(scope="module")
def plain() -> str:
    return page(
        checks=(at_most("slope", 0.001, 0.002, "mrad", "bearing list"), at_least("angle", 0.5, 0.7, "deg", "p. 3"))
    )


def test_needs_no_network(plain: str) -> None:
    for tag, attributes in read(plain).elements:
        for name in ("src", "href", "xlink:href", "data", "action", "srcset", "poster"):
            address = attributes.get(name) or ""
            assert not re.match(r"(?i)\s*(?:https?:|//|ftp:)", address), (tag, address)
    assert "@import" not in plain
    assert not re.search(r"url\(\s*['\"]?(?!#)", plain)
    assert not re.search(r"fetch\(|XMLHttpRequest|import\(", plain)


def test_ids_are_unique_and_links_within_are_met(plain: str) -> None:
    elements = read(plain).elements
    ids = [attributes["id"] for _, attributes in elements if "id" in attributes]
    assert len(ids) == len(set(ids))
    links = {a[name] for _, a in elements for name in ("href", "xlink:href") if (a.get(name) or "").startswith("#")}
    assert {(link or "")[1:] for link in links} <= set(ids)
    assert set(re.findall(r"url\(#([^)]+)\)", plain)) <= set(ids)


def test_says_summary_yarn_results_and_warnings(plain: str) -> None:
    text = read(plain).text
    for said in (
        "600",
        "20 across × 30 rows",
        "8 × 12 cm",
        "Weaving time",
        "3.271 N·m",
        "59.94 mm",
        "1.5",
        "force [kN]",
    ):
        assert said in text, said
    assert "careful with plain" in text
    assert "mean ΔE 1.2" in text


def test_failed_checks_come_first_and_are_marked(plain: str) -> None:
    rows = re.findall(r'<tr class="(pass|fail)">(.*?)</tr>', plain, flags=re.DOTALL)
    assert [verdict for verdict, _ in rows] == ["fail", "fail", "pass", "pass"]
    assert "✗ FAIL" in rows[0][1]
    assert "≥ 40.11" in rows[0][1]
    assert "2 checks do not hold." in read(plain).text
    assert "2 failed" in read(plain).text


def test_all_checks_held_is_said() -> None:
    text = read(page(checks=(at_most("slope", 0.001, 0.002, "mrad", "list"),))).text
    assert "2 passed" in text
    assert "not hold" not in text


def test_pictures_have_words_and_tables_have_headings(plain: str) -> None:
    reader = read(plain)
    pictures = [attributes for tag, attributes in reader.elements if tag == "img"]
    assert len(pictures) == 3
    assert all(attributes.get("alt") for attributes in pictures)
    assert all((attributes["src"] or "").startswith("data:image/") for attributes in pictures)
    drawings = [attributes for tag, attributes in reader.elements if tag == "svg"]
    assert all(attributes.get("role") == "img" and attributes.get("aria-label") for attributes in drawings)
    assert plain.count("<thead>") == plain.count("<table")
    assert all(attributes.get("scope") for tag, attributes in reader.elements if tag == "th")


@pytest.mark.parametrize("maker", ["carpet", "machine"])
def test_what_comes_from_outside_stays_text(maker: str) -> None:
    checks = (at_most(HOSTILE, 2.0, 1.0, "mm", HOSTILE),)
    made = page(HOSTILE, checks) if maker == "carpet" else machine_page(report(HOSTILE, checks))
    reader = read(made)
    assert sum(tag == "script" for tag, _ in reader.elements) == (1 if maker == "carpet" else 0)
    assert not [attributes for tag, attributes in reader.elements if "onerror" in attributes]
    assert not [a for tag, a in reader.elements if tag == "img" and "evil" in (a.get("src") or "")]
    assert reader.text.count('alert("x")') > 10


def test_machine_page_is_complete() -> None:
    made = machine_page(report("beat", (at_most("slope", 0.001, 0.002, "mrad", "list"),)))
    text = read(made).text
    assert made.startswith("<!DOCTYPE html>")
    assert "1 of 1 checks hold" in text
    assert "meaning of beat" in text
    assert made.count("<svg") == 2


def test_machine_page_of_an_empty_report_is_sound() -> None:
    read(machine_page(Report("m", "Empty", {}, (), ())))


def test_long_tables_are_folded() -> None:
    rows = tuple((float(n),) for n in range(40))
    made = machine_page(Report("m", "M", {}, (), (), (Table("t", "Points", (Column("x", "mm"),), rows),)))
    assert "<summary>Points (40 rows)</summary>" in made
