"""Every notation reads back what it wrote, exactly, and writes back what it read."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from ilmek.carpet.quality import NOTATIONS, Quality, parse_quality, write_quality

COUNTS = st.floats(10.0, 5000.0)
PAIRS = [name for name, notation in NOTATIONS.items() if notation.is_pair]
SINGLES = [name for name in NOTATIONS if name not in PAIRS]


@pytest.mark.parametrize("notation", PAIRS)
@given(across=COUNTS, along=COUNTS)
def test_any_quality_survives_a_pair(notation: str, across: float, along: float) -> None:
    quality = Quality(across, along)
    assert parse_quality(write_quality(quality, notation)) == quality


@pytest.mark.parametrize("notation", SINGLES)
@given(count=COUNTS)
def test_any_even_quality_survives_one_number(notation: str, count: float) -> None:
    quality = Quality(count, count)
    assert parse_quality(write_quality(quality, notation)) == quality


@given(count=COUNTS, gereh=st.sampled_from([0.06, 0.065, 0.068, 0.07]))
def test_raj_survives_in_every_town(count: float, gereh: float) -> None:
    quality = Quality(count, count)
    assert parse_quality(write_quality(quality, "raj", gereh=gereh)) == quality


@pytest.mark.parametrize(
    ("notation", "form", "low", "high"),
    [
        ("dm", "{}x{}/dm", 1, 500),
        ("cm", "{}x{}/cm", 1, 50),
        ("inch", "{}x{}/in", 1, 126),
        ("india", "{}/{}", 2, 100),
        ("raj", "{}raj", 2, 300),
        ("line", "{}line", 4, 1500),
        ("kpsi", "{}kpsi", 1, 15_000),
        ("m2", "{}/m2", 100, 20_000_000),
        ("dm2", "{}/dm2", 1, 200_000),
    ],
)
@given(data=st.data())
def test_any_text_survives(notation: str, form: str, low: int, high: int, data: st.DataObject) -> None:
    numbers = [data.draw(st.integers(low, high)) for _ in range(form.count("{}"))]
    text = form.format(*numbers)
    assert write_quality(parse_quality(text), notation) == text
