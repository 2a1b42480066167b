"""Display order of mixed scripts against python-bidi, which has the algorithm of the Rust crate unicode-bidi."""

import unicodedata

import pytest
from bidi import get_display
from effort import examples
from hypothesis import given
from hypothesis import strategies as st

from ilmek.io.chart.bidi import levels, visual_runs

LETTERS = "abÇγЖاىپک\u0650\u064eאבָ٠٣۱۲019  -+,.:/#%№·()[]{}\u200c\u200d羊が한क्"


def shown(text: str) -> str:
    """The characters from left to right, brackets not mirrored."""
    return "".join(part if rightward else part[::-1] for part, rightward in visual_runs(text))


def without_joiners(text: str) -> str:
    return "".join(letter for letter in text if unicodedata.bidirectional(letter) != "BN")


@given(st.text(LETTERS, min_size=1, max_size=24))
@examples(400, light=100)
def test_order_of_any_mixture(text: str) -> None:
    assert without_joiners(shown(text)) == without_joiners(get_display(text, base_dir=None))


@pytest.mark.parametrize(
    "name",
    ["لاکی ۱۲", "قرمز (روناس) №7", "سرمه‌ای 3/2", "red לכיש (12)", "צבע a-b 5", "100% پشم", "Lâcivert – İğdır №7 ⅛"],
)
def test_order_of_names(name: str) -> None:
    assert without_joiners(shown(name)) == without_joiners(get_display(name, base_dir=None))
    assert len(levels(name)) == len(name)
