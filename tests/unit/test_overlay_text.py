"""The overlay in a chart's file: what was written comes back, damaged and hostile texts are refused."""

import base64
import zlib

import numpy as np
import pytest

from ilmek.carpet.overlay import HALF, JUFTI, MOST_MARKS, KnotMark, no_overlay, overlay_of
from ilmek.errors import IlmekError
from ilmek.io.overlay_text import LONGEST_OVERLAY, overlay_text, read_overlay

KNOTS = np.zeros((6, 8), dtype=np.uint8)
OVERLAY = overlay_of([KnotMark(0, 0, JUFTI), KnotMark(2, 7, HALF, 1), KnotMark(5, 7, HALF, 2)])


def packed(steps: list[int], kinds: list[int], seconds: list[int]) -> str:
    data = np.array(steps, "<i4").tobytes() + bytes(kinds) + bytes(seconds)
    return base64.b64encode(zlib.compress(data)).decode()


def test_marks_come_back() -> None:
    assert read_overlay(overlay_text(OVERLAY, 8), KNOTS, 3).equals(OVERLAY)
    assert overlay_text(no_overlay(), 8) == ""
    assert len(read_overlay("", KNOTS, 3)) == 0


def test_the_text_is_as_documented() -> None:
    assert read_overlay(packed([0, 23, 24], [2, 1, 1], [0, 1, 2]), KNOTS, 3).equals(OVERLAY)


BOMB = base64.b64encode(zlib.compress(bytes(6 * MOST_MARKS + 6), 9)).decode()


@pytest.mark.parametrize(
    "text",
    [
        "no base64!",
        base64.b64encode(b"no zlib").decode(),
        base64.b64encode(zlib.compress(b"1234567")).decode(),
        overlay_text(OVERLAY, 8)[:-8],
        packed([0, 0], [1, 1], [1, 1]),  # two marks in a cell
        packed([5, -3], [1, 1], [1, 1]),  # not in order
        packed([-1], [1], [1]),
        packed([48], [1], [1]),  # outside of the chart
        packed([2**31 - 1, 2**31 - 1], [1, 1], [1, 1]),
        packed([3], [3], [1]),  # no such kind
        packed([3], [1], [3]),  # no such yarn
        packed([3], [1], [0]),  # its own yarn
        packed([7], [2], [0]),  # over the edge
        BOMB,
        "A" * (LONGEST_OVERLAY + 4),
    ],
)
def test_other_texts_are_refused(text: str) -> None:
    with pytest.raises(IlmekError):
        read_overlay(text, KNOTS, 3)
