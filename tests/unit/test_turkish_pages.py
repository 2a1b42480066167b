"""Pages of reports in Turkish: what is read, or read aloud, or drawn by the client is not English."""

import re
from collections.abc import Iterator
from html.parser import HTMLParser
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner
from default_machines import default_report, page_data
from english_words import ENGLISH_ALONE, words

from ilmek.cli import main
from ilmek.jobs.page import page_text
from ilmek.report import Choice, Report, at_most

KEPT = re.compile(r"Norton, Cam Design and Manufacturing|^through$")
"""Titles of books, and values of parameters."""


def texts_of(data: Any) -> Iterator[str]:
    """The texts of a figure's data but its names."""
    if isinstance(data, str):
        yield data
    below = [one for key, one in data.items() if key != "name"] if isinstance(data, dict) else data
    for one in below if isinstance(below, list) else ():
        yield from texts_of(one)


class Texts(HTMLParser):
    """The texts of a page, of its attributes for people and of its figures' data, without names in code."""

    def __init__(self, page: str) -> None:
        super().__init__()
        self.within, self.texts, self.language = "", set(texts_of(page_data(page))), ""
        self.feed(page)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        given = dict(attrs)
        self.within = tag
        self.language = self.language or given.get("lang") or ""
        self.texts |= {given.get(name) or "" for name in ("aria-label", "title", "data-label", "alt")}

    def handle_data(self, data: str) -> None:
        if self.within not in {"script", "style", "code"}:
            self.texts.add(data.strip())

    def handle_endtag(self, _: str) -> None:
        self.within = ""

    @property
    def english(self) -> list[str]:
        """Those that have words of English."""
        return sorted(text for text in self.texts if words(KEPT.sub("", text)) & ENGLISH_ALONE)


@pytest.mark.parametrize("name", ["shedding", "weft", "beat-up"])
def test_the_page_of_a_machine_says_no_english(name: str) -> None:
    report = default_report(name)
    assert len(Texts(page_text(report, []) or "").english) > 40
    said = Texts(page_text(report, [], "tr") or "")
    assert (said.language, said.english) == ("tr", [])


def test_a_verdict_that_fails_says_no_english() -> None:
    checks = [at_most("stress of a leaf", 2.0, 1.0, "MPa", "given").with_cure("set a larger clearance")] * 2
    choice = Choice("bearing", "10 mm", "price")
    report = Report("cam", "Cam", {}, (), tuple(checks), choices=(choice,), self_tests=(checks[0],), warnings=("no",))
    said = Texts(page_text(report, [], "tr") or "")
    assert said.english == []
    assert {"✗ KALDI", "Seçilenler", "2 / 2 denetim tutmuyor. En ağır neden başta.", "1 / 1 kaldı"} <= said.texts


def test_lang_of_the_command_is_that_of_its_page(tmp_path: Path) -> None:
    call = ["design", "tufting", "--report", str(tmp_path / "page.html"), "--lang", "tr"]
    CliRunner().invoke(main, call, catch_exceptions=False)
    said = Texts((tmp_path / "page.html").read_text(encoding="utf-8"))
    assert (said.language, said.english) == ("tr", [])
