"""The PDF of a paper has the words of its page, and no others: read by a PDF reader of another make."""

from collections import Counter
from html.parser import HTMLParser
from pathlib import Path

import numpy as np
import pytest
from pypdf import PdfReader
from pypdfium2 import PdfDocument  # type: ignore[import-untyped]

from ilmek.io.papers.pdf import write_paper_pdf
from ilmek.report import Column, Drawing, Paper, PaperSection, Stroke, Table
from ilmek.report.paper import PrintedPaper
from ilmek.report.sheet import Issue
from ilmek.sentences import LANGUAGES, Sentence
from ilmek.viz.document_page import document_page, printed


class PageWords(HTMLParser):
    """The words of a page that a person sees."""

    def __init__(self, page: str) -> None:
        super().__init__()
        self.words, self.hidden = Counter[str](), 0
        self.feed(page)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:  # noqa: ARG002
        self.hidden += tag in ("style", "title", "nav", "a")

    def handle_endtag(self, tag: str) -> None:
        self.hidden -= tag in ("style", "title", "nav", "a")

    def handle_data(self, data: str) -> None:
        if not self.hidden:
            self.words.update(data.split())


def same_words(paper: PrintedPaper, file: Path) -> int:
    """Compare the words of both; the number of pages."""
    pages = PdfReader(file).pages
    words = Counter(word for page in pages for word in page.extract_text().split())
    furniture = f"{paper.title} {paper.issue} {paper.footer} / {paper.stamp}".split()
    heads = [word for section in paper.sections for head in (*section.heads, section.measured) for word in head.split()]
    seen = PageWords(document_page(paper, "paper")).words
    seen.subtract(word for word in ("✗",) if paper.warning)
    assert not seen - words
    more = words - seen
    numbers = {str(number) for number in range(1, len(pages) + 1)}
    assert set(more) <= {*furniture, *heads, *numbers, "☐"}
    for page in pages:
        assert {*paper.issue.split(), *paper.footer.split()} <= {*page.extract_text().split()}
    return len(pages)


def paper_of(rows: int) -> Paper:
    heads = (Column(Sentence("electric.motor")), Column(Sentence("electric.power"), "W", 3))
    table = Table("motors", "", heads, tuple((Sentence("list.purchase"), 1234567.0 / (n + 1)) for n in range(rows)))
    square = Stroke(np.array([0j, 1, 1 + 1j, 1j]) * 0.1, "outline", closed=True)
    figure = Drawing("square", Sentence("manual.picture"), (square,))
    sections = (
        PaperSection(Sentence("electric.motors"), (Sentence("electric.residual"),), table, boxes=True),
        PaperSection(Sentence("risk.transport"), (Sentence("lift.how"),), figure=figure),
    )
    return Paper("try", Sentence("electric.title"), Sentence("electric.lead"), sections)


@pytest.mark.parametrize("language", LANGUAGES)
@pytest.mark.parametrize(("rows", "pages"), [(3, 1), (150, 4), (400, 9)])
def test_a_pdf_has_the_words_of_the_page(tmp_path: Path, language: str, rows: int, pages: int) -> None:
    paper = printed(paper_of(rows), "Loom", language, Issue(date="2026-11-29", revision="C"))
    write_paper_pdf(tmp_path / "try.pdf", paper)
    assert same_words(paper, tmp_path / "try.pdf") == pages
    text = [page.extract_text() for page in PdfReader(tmp_path / "try.pdf").pages]
    with_rows = [page for page in text if paper.sections[0].rows[0][0].text in page]
    assert all(paper.sections[0].measured in page for page in with_rows)
    assert all(f"\n{number} / {pages}\n" in page for number, page in enumerate(text, 1))
    assert "".join(text).count("☐") == rows + len(with_rows)
    for page in PdfDocument(tmp_path / "try.pdf"):
        printed_page, (width, height) = page.get_textpage(), page.get_size()
        boxes = np.array([printed_page.get_charbox(number) for number in range(printed_page.count_chars())])
        assert boxes.min() > 0
        assert boxes[:, 2].max() < width
        assert boxes[:, 3].max() < height


def test_turkish_letters_are_read_as_they_are_written(tmp_path: Path) -> None:
    paper = printed(paper_of(1), "Tezgâh İIıiğüşöç", "tr", Issue())
    write_paper_pdf(tmp_path / "try.pdf", paper)
    assert "Tezgâh İIıiğüşöç" in PdfReader(tmp_path / "try.pdf").pages[0].extract_text()


def test_a_paper_that_is_not_released_says_so_on_every_page(tmp_path: Path) -> None:
    paper = printed(paper_of(90), "Loom", "tr", Issue(unreleased=True))
    write_paper_pdf(tmp_path / "try.pdf", paper)
    assert same_words(paper, tmp_path / "try.pdf") > 1
    assert all("ONAYLANMADI" in page.extract_text() for page in PdfReader(tmp_path / "try.pdf").pages)


def test_the_same_paper_gives_the_same_bytes(tmp_path: Path) -> None:
    for name in "ab":
        write_paper_pdf(tmp_path / name, printed(paper_of(20), "Loom", "en", Issue(date="2026-11-29")))
    assert (tmp_path / "a").read_bytes() == (tmp_path / "b").read_bytes()
