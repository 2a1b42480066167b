"""Quality: the notations read and written, and what is refused."""

import pytest

from ilmek.carpet.quality import NOTATIONS, Quality, parse_quality, write_quality
from ilmek.errors import CarpetError


@pytest.mark.parametrize(
    ("text", "across", "along"),
    [
        ("25x25/dm", 250.0, 250.0),
        ("26 × 33 per dm", 260.0, 330.0),
        ("25/dm", 250.0, 250.0),
        ("10x10/cm", 1000.0, 1000.0),
        ("9/16 per inch", 9 / 0.0254, 16 / 0.0254),
        ("9x16/in", 9 / 0.0254, 16 / 0.0254),
        ("9/60", 10 / 0.0254, 60 / 4.5 / 0.0254),
        ("62500/m2", 250.0, 250.0),
        ("62500 knots/m²", 250.0, 250.0),
        ("625/dm^2", 250.0, 250.0),
        ("100 per cm2", 1000.0, 1000.0),
        ("40raj", 40 / 0.07, 40 / 0.07),
        ("40 Raj@6.5cm", 40 / 0.065, 40 / 0.065),
        ("40 redj (6.5 cm)", 40 / 0.065, 40 / 0.065),
        ("90line", 90 / 0.3048, 90 / 0.3048),
        ("90 lines", 90 / 0.3048, 90 / 0.3048),
    ],
)
def test_read(text: str, across: float, along: float) -> None:
    quality = parse_quality(text)
    assert (quality.across, quality.along) == pytest.approx((across, along), rel=1e-15)


def test_written_in_every_notation() -> None:
    quality = parse_quality("40raj")
    assert write_quality(quality, "raj") == "40raj"
    assert write_quality(quality, "raj", gereh=0.065, digits=4) == "37.14raj/6.5cm"
    assert write_quality(quality, "dm", digits=4) == str(quality) == "57.14x57.14/dm"
    assert write_quality(parse_quality("9/60"), "india") == "9/60"
    assert write_quality(parse_quality("9/16 per inch"), "inch") == "9x16/in"
    assert write_quality(parse_quality("26x33/dm"), "m2") == "85800/m2"


def test_one_number_stands_for_the_knots_per_area() -> None:
    uneven, even = Quality(200.0, 450.0), Quality(300.0, 300.0)
    for notation in ("raj", "line", "kpsi", "m2", "dm2", "cm2"):
        assert write_quality(uneven, notation) == write_quality(even, notation)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("0x25/dm", "is too coarse"),
        ("0/dm", "is too coarse"),
        ("-5/m2", "is too coarse"),
        ("0 kpsi", "is too coarse"),
        ("600x600/dm", "warp every 0.08333 mm"),
        ("25x25", "unknown quality"),
        ("25", "25x25/dm"),
        ("fine", "unknown quality"),
        ("", "unknown quality"),
        ("40raj@70cm", "gereh"),
        ("40raj@.cm", "gereh"),
        ("25x25/km", "unknown quality"),
        ("9" * 400 + "/dm", "too long"),
        ("1e3/m2", "unknown quality"),
    ],
)
def test_refused_in_words(text: str, said: str) -> None:
    with pytest.raises(CarpetError) as caught:
        parse_quality(text)
    assert said in str(caught.value)


def test_unknown_notation() -> None:
    with pytest.raises(CarpetError, match="kpsi"):
        write_quality(Quality(250.0, 250.0), "bundles")
    assert "bundles" not in NOTATIONS
