"""Sizes: spellings, units and what is refused."""

import pytest

from ilmek.carpet.sizes import STANDARD_SIZES, CarpetSize, parse_size
from ilmek.errors import CarpetError


@pytest.mark.parametrize(
    ("text", "name"),
    [
        ("Küçük Yastık", "küçük yastık"),
        ("KUCUK-YASTIK", "küçük yastık"),
        ("kucuk_yastik", "küçük yastık"),
        ("KÜÇÜK YASTIK", "küçük yastık"),
        ("YASTİK", "yastık"),
        ("ceyrek", "çeyrek"),
        ("Çeyrek", "çeyrek"),
        (" Seccade ", "seccade"),
        ("seccade large", "seccade-large"),
        ("seccade-130x200", "seccade-large"),
        ("SECCADE 130×200", "seccade-large"),
        ("Karyola", "karyola"),
        ("kelle", "kelle"),
    ],
)
def test_standard_names(text: str, name: str) -> None:
    assert parse_size(text) is STANDARD_SIZES[name]


@pytest.mark.parametrize(
    "text",
    ["120x180cm", "120 x 180 cm", "120 × 180 cm", "1.2x1.8m", "1200X1800mm", "120cm x 180cm", "12*18 dm", "1.2mx1.8m"],
)
def test_free_sizes(text: str) -> None:
    assert parse_size(text) == CarpetSize(1.2, 1.8)


def test_feet_and_inches_are_exact() -> None:
    assert parse_size("4x6ft") == CarpetSize(1.2192, 1.8288)
    assert parse_size("47x71in") == CarpetSize(1.1938, 1.8034)
    assert parse_size("48 in x 72 in") == parse_size("4' x 6'")


def test_size_says_itself() -> None:
    assert str(parse_size("seccade")) == "seccade, 120 × 180 cm"
    assert str(parse_size("4x6ft")) == "121.9 × 182.9 cm"
    assert parse_size("kelle").area == 6.0


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("secade", "did you mean 'seccade'?"),
        ("ceyrec", "did you mean 'çeyrek'?"),
        ("tabann", "did you mean 'taban'?"),
        ("nonsense", "standard sizes: küçük yastık"),
        ("", "standard sizes"),
        ("taban", "above 6 m²"),
        ("YOLLUK", "80x300cm"),
        ("120x180", "has no unit"),
        ("120cm x 180", "second side"),
        ("120cm x 1.8m", "mixes cm and m"),
        ("120x180kg", "unknown unit 'kg'"),
        ("0x180cm", "above zero"),
        ("-120x180cm", "above zero"),
        ("0.5x180cm", "1 cm to 50 m"),
        ("120x51m", "1 cm to 50 m"),
        ("120x180x5cm", "unknown unit"),
        ("1,2x1,8m", "unknown size"),
        ("9" * 400 + "x1m", "too long"),
        ("nanxnan cm", "unknown size"),
    ],
)
def test_refused_in_words(text: str, said: str) -> None:
    with pytest.raises(CarpetError) as caught:
        parse_size(text)
    assert said in str(caught.value)
