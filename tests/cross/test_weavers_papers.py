"""The weaver's papers in seven languages: every text has its sentence, pages are read back by pdfium in the order of
reading, the display order is that of python-bidi, and no Latin word is left.
"""

import re
import unicodedata
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import numpy as np
import pypdfium2
import pytest
from bidi.algorithm import get_display
from reportlab.pdfbase import pdfmetrics

from ilmek import sentences
from ilmek.carpet.bill import yarn_bill
from ilmek.carpet.cells import CUT_AWAY, PILE, Carving, CellKind, CellMap
from ilmek.carpet.chart import Chart
from ilmek.carpet.ground import GroundParams
from ilmek.carpet.kilim import KilimParams
from ilmek.carpet.kilim_cloth import KilimCloth, KilimPrices, kilim_cloth
from ilmek.carpet.mounting import mounting
from ilmek.carpet.overlay import HALF, JUFTI, KnotMark, overlay_of
from ilmek.carpet.quality import Quality
from ilmek.carpet.rows import DIRECTIONS
from ilmek.carpet.sizes import CarpetSize, parse_size
from ilmek.carpet.usual_pile import with_counts
from ilmek.carpet.yarn_plan import OVERCAST, TAPE, YarnPlanParams
from ilmek.cli.call_screen import print_rows, screen_lines, spoken_step
from ilmek.io.chart import bidi, lettering
from ilmek.io.chart.join_marks import kilim_printing
from ilmek.io.chart.legend import mounting_lines
from ilmek.io.chart.pdf import write_chart_pdf
from ilmek.io.chart.printing import PrintCanvas, Printing
from ilmek.io.chart.rows_colours_pdf import colour_pages, write_colours_pdf
from ilmek.io.chart.rows_pdf import write_rows_pdf
from ilmek.io.chart.rows_text import header
from ilmek.io.chart.wall import write_wall_pdf
from ilmek.io.kilim_rows import write_kilim_rows
from ilmek.io.yarn_file import default_yarns
from ilmek.jobs.call import Calling
from ilmek.sentences import LANGUAGES, WEAVERS, Sentence, catalogue_of, in_language, translated
from ilmek.sentences.english import ENGLISH
from ilmek.sentences.order_english import ORDER
from ilmek.sentences.weaver_english import NOUNS, WEAVER

FOREIGN = [language for language in WEAVERS if language not in LANGUAGES]
MARKS = [KnotMark(0, 0, HALF, 1), KnotMark(2, 4, JUFTI)]
CODES = re.compile(r"(?<![A-Za-z])(AC?|B|C|L|R|jB?|strike-off\.pdf)(?![A-Za-z])")
"""Symbols of yarns and of parts of cells, and the name of a file, which are Latin in every language."""


def chart_of(
    rows: int, columns: int, yarns: int = 4, *, size: CarpetSize | None = None, cells: CellMap | None = None
) -> Chart:
    """A chart of diagonal stripes, with marks where it has four yarns."""
    size = size or CarpetSize(columns / 250, rows / 250)
    quality = Quality(columns / size.width, rows / size.length)
    named = (*default_yarns(), *(replace(default_yarns()[0], name=f"dark red {n}", number=None) for n in range(2, 60)))
    knots = np.indices((rows, columns)).sum(0) // (5 if yarns < 9 else 1) % yarns
    marks = overlay_of(MARKS) if yarns == 4 and cells is None else overlay_of([])
    return Chart(
        knots, with_counts(named[:yarns], quality, "symmetric"), size, quality, "symmetric", overlay=marks, cells=cells
    )


CHARTS = [
    chart_of(95, 70),  # four sheets
    chart_of(12, 30),
    chart_of(5, 700),  # rows in parts
    chart_of(9, 9, 1),
    chart_of(30, 20, size=parse_size("seccade")),
    chart_of(9, 60, 60),  # a legend of two pages
]
outside = np.hypot(*(np.indices((24, 24)) - 11.5)) > 12
CHARTS.insert(1, chart_of(24, 24, cells=CellMap(outside.astype(int), (PILE, CUT_AWAY))))  # a round carpet
CHARTS.insert(2, chart_of(22, 22, cells=CellMap(outside[1:-1, 1:-1].astype(int), (PILE, CUT_AWAY))))  # bound with tape
piles = CellMap(np.indices((9, 30))[1] // 10 % 3, (PILE, CellKind("low", height=5e-3), CellKind("loops", loop=True)))
CHARTS.insert(-1, chart_of(9, 30, cells=replace(piles, carving=Carving(2e-3, 1.0))))
CHARTS.insert(-1, chart_of(9, 30, cells=replace(piles, carving=Carving(2e-3, 1.0, (default_yarns()[0].name,)))))


def papers(language: str, folder: Path, charts: Sequence[Chart]) -> Iterator[Path]:
    """Every printed paper of charts in a language."""
    for number, chart in enumerate(charts):
        plan = YarnPlanParams(binding=TAPE if chart.rows == 22 else OVERCAST)
        printing = Printing("", yarn_bill(chart, plan), mounting(chart), language)
        file = folder / f"{number}.pdf"
        writers: list[Callable[[], None]] = [
            lambda: write_chart_pdf(file, chart, printing=printing),  # noqa: B023 - called at once
            lambda: write_wall_pdf(file, chart, printing=printing),  # noqa: B023
        ]
        if chart.rows in (12, 24, 95) or chart.columns == 9:  # an even number of cells, round, four sheets, an odd one
            kilim = kilim_printing(kilim_of(chart), "", language)
            writers.append(lambda: write_chart_pdf(file, chart, printing=kilim))  # noqa: B023
        for direction in DIRECTIONS if chart.rows in (12, 24) else ("both",):
            pages = len(list(colour_pages(chart, direction)))
            writers += [
                lambda way=direction: write_rows_pdf(file, chart, way, printing=printing),  # type: ignore[misc] # noqa: B023
                lambda way=direction, n=pages: write_colours_pdf(file, chart, way, n, printing=printing),  # type: ignore[misc] # noqa: B023
            ]
        for write in writers:
            write()
            yield file


def kilim_of(chart: Chart) -> KilimCloth:
    """A chart as a kilim with open slits."""
    prices = KilimPrices((None,) * len(chart.yarns), None, 0.0)
    return kilim_cloth(chart, KilimParams(), GroundParams(), prices)


def call_of(chart: Chart) -> Iterator[str]:
    """Every line of a call of a chart."""
    calling = Calling(chart, "runs", "right")
    while not calling.done:
        yield from screen_lines(calling, 0, 200)
        yield spoken_step(calling)
        calling.forward()
    yield from screen_lines(calling, 0, 200)


class Recorded(dict[str, str]):
    """A catalogue that remembers which sentences were said."""

    said: set[str]

    def get(self, key: str, default: str | None = None) -> str:  # type: ignore[override]
        self.said.add(key)
        return super().get(key, default or "")


def test_the_papers_say_what_the_catalogues_have(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """The keys are found by making every paper; each language has exactly them, and the nouns."""
    recorded = Recorded(catalogue_of("fa"))
    recorded.said = set()
    monkeypatch.setattr(sentences, "catalogue_of", lambda _: recorded)
    assert len(list(papers("fa", tmp_path, CHARTS))) > 20
    with in_language("fa"):
        for split in ("runs", "colours"):
            header(CHARTS[1], split, "both")
        write_kilim_rows(tmp_path / "rows.txt", kilim_of(CHARTS[1]), "fa")
        for chart in CHARTS[1:4]:
            assert len(list(call_of(chart))) > 20
            print_rows(Calling(chart, "colours", "left"))
    capsys.readouterr()
    # Notes on a call are said on a terminal only.
    notes = {"call.again", "call.goes-on", "call.not-spoken"}
    needed = recorded.said | notes | NOUNS.keys() | ORDER.keys()
    for language in FOREIGN:
        catalogue = catalogue_of(language)
        assert needed == catalogue.keys(), language


@pytest.mark.parametrize("language", FOREIGN)
def test_no_braces_are_lost_and_no_latin_word_is_left(language: str) -> None:
    def names(text: str) -> set[str]:
        return set(re.findall(r"\{(\w+)\}", text))

    for key, text in catalogue_of(language).items():
        assert names(text) <= names(ENGLISH[key]), key
        assert names(ENGLISH[key]) - names(text) <= ({"count"} if key in ("count.colour",) else set()), key
        plain = CODES.sub("", re.sub(r"\{\w+\}", "", text))
        if not key.startswith("call."):
            assert not [letter for letter in plain if unicodedata.name(letter, "").startswith("LATIN")], (key, plain)


def read_back(file: Path) -> str:
    """All text of a file, as pdfium reads it, in one line without blanks and without the mirroring of brackets."""
    pages = (page.get_textpage().get_text_range() for page in pypdfium2.PdfDocument(file))
    return bare("\n".join(pages))


def bare(text: str) -> str:
    return re.sub(r"[\s\u200c\[\]()]", "", text).replace("\ufffe", "").replace("\u00a0", "")


def expected(key: str, language: str, **values: object) -> str:
    """A sentence straight from the catalogue, with the digits of the language."""
    text = catalogue_of(language)[key].format(**values)
    return bare(text.translate(str.maketrans("0123456789", WEAVERS[language].digits)).replace("\u202f", ""))


@pytest.mark.parametrize("language", FOREIGN)
def test_pages_are_read_back_in_the_order_of_reading(language: str, tmp_path: Path) -> None:
    chart = CHARTS[0]
    printing = Printing("", yarn_bill(chart), mounting(chart), language)
    write_chart_pdf(tmp_path / "chart.pdf", chart, printing=printing)
    write_rows_pdf(tmp_path / "rows.pdf", chart, printing=printing)
    write_wall_pdf(tmp_path / "wall.pdf", chart, printing=printing)
    shown = read_back(tmp_path / "chart.pdf")
    for key, values in {
        "chart.order": {}, "chart.shaded": {}, "legend.ground": {}, "legend.all": {},
        "mounting.title": {}, "ground.warp": {}, "ground.straight-weft": {}, "ground.selvedges": {},
        "colour.madder-red": {}, "mounting.warps": {},
        "mounting.between-knots": {"number": 35, "next": 36, "length": "@"},
        "mounting.in-row": {"number": 48, "length": "@"},
        "chart.sheet-of": {"number": 2, "count": 4},
    }.items():  # fmt: skip
        for part in expected(key, language, **values).split("@"):
            assert part in shown, (key, part)
    assert expected("rows.both", language) in read_back(tmp_path / "rows.pdf")
    assert expected("rows.below", language) in read_back(tmp_path / "rows.pdf")
    assert expected("chart.grid", language, columns=70, rows=95) in read_back(tmp_path / "wall.pdf")


KNOT = {"en": "knot", "tr": "ilme|düğüm", "fa": "گره", "ar": "عقد", "ur": "گرہ", "hi": "गाँठ", "ne": "गाँठ"}


@pytest.mark.parametrize("language", WEAVERS)
def test_a_kilim_has_no_knots(language: str, tmp_path: Path) -> None:
    cloth = kilim_of(CHARTS[0])
    write_kilim_rows(tmp_path / "rows.txt", cloth, language)
    write_chart_pdf(tmp_path / "kilim.pdf", cloth.chart, printing=kilim_printing(cloth, "", language))
    shown = read_back(tmp_path / "kilim.pdf")
    assert expected("kilim.chart.order", language) in shown
    _, *rows = (tmp_path / "rows.txt").read_text().splitlines()  # the first names the format
    assert not re.search(KNOT[language], shown + " ".join(rows), re.IGNORECASE)
    write_chart_pdf(tmp_path / "pile.pdf", cloth.chart, printing=Printing(language=language))
    assert re.search(KNOT[language], read_back(tmp_path / "pile.pdf"), re.IGNORECASE)


@pytest.mark.parametrize("language", FOREIGN)
def test_no_english_is_left_and_no_glyph_is_a_box(language: str, tmp_path: Path) -> None:
    words: set[str] = set()
    for file in papers(language, tmp_path, CHARTS[:-1]):  # the last has symbols that are digits
        text = "\n".join(page.get_textpage().get_text_range() for page in pypdfium2.PdfDocument(file))
        assert not re.search(r"[0-9]", text.replace("1/2", "½")), re.findall(r".*[0-9].*", text)[:3]
        words |= set(re.findall(r"[A-Za-z]{3,}", text)) - {"".join(run) for run in re.findall(r"[A-D]{3,}", text)}
    assert not words
    for chart in CHARTS[1:2]:
        for line in (line for pair in mounting_lines(chart, mounting(chart)) for line in pair):
            with in_language(language):
                said = translated(line)
                assert not lettering.missing_letters(said)
                for part in lettering._parts(said):
                    face = pdfmetrics.getFont(part.font).face
                    assert min(face.charToGlyph[ord(code)] for code in part.glyphs) > 0


@pytest.mark.parametrize("language", WEAVERS)
def test_no_text_runs_into_the_next(language: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Of two texts on a baseline of a page, the left one ends before the other begins."""
    drawn: list[tuple[int, float, float, float, str]] = []
    draw = PrintCanvas._draw

    def noted(canvas: PrintCanvas, x: float, y: float, text: str, share: float) -> None:
        width = canvas.text_width(text)
        drawn.append((canvas.getPageNumber(), y, x - share * width, x + (1 - share) * width, text))
        draw(canvas, x, y, text, share)

    monkeypatch.setattr(PrintCanvas, "_draw", noted)
    for _ in papers(language, tmp_path, CHARTS[1:2]):
        texts = sorted(one for one in drawn if len(one[-1]) > 2)
        assert texts
        assert not [(a, b) for a, b in pairwise(texts) if a[:2] == b[:2] and b[2] < a[3] + 1.0]
        drawn.clear()


@pytest.mark.parametrize("language", [code for code in FOREIGN if WEAVERS[code].leftward])
def test_the_display_order_is_that_of_another_library(language: str) -> None:
    """python-bidi, UAX #9, at the level of a line that begins at the right."""
    values = {name: Sentence("colour.red") for name in ("colour", "knot", "first", "second")}
    digits = str.maketrans("0123456789", WEAVERS[language].digits)
    mirrored = str.maketrans("()[]<>", ")(][><")
    numbers: Mapping[str, str] = {name: str(n) for n, name in enumerate(re.findall(r"\{(\w+)\}", str(ENGLISH)), 17)}
    for key in catalogue_of(language):
        if key not in WEAVER or "½" in catalogue_of(language)[key]:
            continue
        names = set(re.findall(r"\{(\w+)", ENGLISH[key]))
        with in_language(language):
            said = translated(Sentence(key, **{name: values.get(name, numbers[name]) for name in names}))
        line = said.translate(digits).replace("\u200c", "")  # which the other library leaves out
        runs = bidi.visual_runs(line, rightward=False)
        ours = "".join(run if rightward else run[::-1].translate(mirrored) for run, rightward in runs)
        assert ours.strip() == get_display(line, base_dir="R").strip(), key
