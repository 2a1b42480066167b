"""The woven carpet beside its chart: what is counted, where, the digest, and the picture."""

import io

import numpy as np
import pytest
from PIL import Image
from small_programme import small_programme

from ilmek.errors import LoomError
from ilmek.loom.operations import EMPTY, ROW_ENDS, LoomProgramme, RowEnd
from ilmek.loom.twin.comparison import EndFault, WovenFault, WovenFaultKind, chart_digest, compare
from ilmek.loom.twin.woven import MOST_TIMES, Woven, woven_size
from ilmek.viz.woven_picture import draw_woven

PROGRAMME = small_programme(6, 24, 2, 3)


def woven_of(programme: LoomProgramme, rows: int, without: frozenset[tuple[int, int]] = frozenset()) -> Woven:
    """The first rows of a carpet, but for some knots."""
    woven = Woven(programme.setup, bytearray(woven_size(programme.setup)))
    for row in range(rows):
        for column, yarn in enumerate(programme.chart_row(row).tolist()):
            if (row, column) not in without:
                woven.tie(row, column, yarn)
        for operation in ROW_ENDS:
            woven.end(row, operation)
    return woven


def test_a_carpet_without_faults_has_the_digest_of_its_chart() -> None:
    woven = woven_of(PROGRAMME, 6)
    result = compare(woven, PROGRAMME)
    assert result.complete
    assert (result.knots, result.rows, result.to_come) == (144, 6, 0)
    assert result.digest == chart_digest(PROGRAMME)


def test_every_fault_is_counted_and_found() -> None:
    woven = woven_of(PROGRAMME, 4, frozenset({(1, 5)}))
    wrong = (int(PROGRAMME.chart_row(2)[7]) + 1) % 3
    woven.tie(2, 7, wrong)
    woven.tie(4, 0, int(PROGRAMME.chart_row(4)[0]))
    woven.end(3, RowEnd.SECOND_BEAT)
    result = compare(woven, PROGRAMME)
    assert (result.knots, result.missing, result.double, result.wrong, result.ends) == (96, 1, 1, 1, 1)
    assert (result.rows, result.to_come, result.complete) == (3, 47, False)
    expected = [int(PROGRAMME.chart_row(row)[column]) for row, column in ((1, 5), (2, 7))]
    assert result.faults == (
        WovenFault(WovenFaultKind.MISSING, 1, 5, EMPTY, expected[0], 0),
        WovenFault(WovenFaultKind.DOUBLE, 2, 7, wrong, expected[1], 2),
        WovenFault(WovenFaultKind.WRONG_YARN, 2, 7, wrong, expected[1], 2),
    )
    assert result.end_faults == (EndFault(3, RowEnd.SECOND_BEAT, 2),)
    assert result.digest != chart_digest(PROGRAMME)


def test_the_operations_that_a_later_one_has_left_out_are_missing() -> None:
    woven = Woven(PROGRAMME.setup, bytearray(woven_size(PROGRAMME.setup)))
    woven.end(0, RowEnd.FIRST_BEAT)
    assert compare(woven, PROGRAMME).end_faults == (EndFault(0, RowEnd.STRAIGHT_WEFT, 0),)
    assert compare(woven, PROGRAMME).missing == 24


def test_counts_stop_at_their_limit() -> None:
    woven = Woven(PROGRAMME.setup, bytearray(woven_size(PROGRAMME.setup)))
    for _ in range(MOST_TIMES + 2):
        woven.tie(0, 0, 2)
        woven.end(0, RowEnd.TAKE_UP)
    assert (woven.times_tied(0, 0), woven.times_ended(0, RowEnd.TAKE_UP)) == (MOST_TIMES, MOST_TIMES)
    assert woven.yarns(0)[:2].tolist() == [2, EMPTY]


def test_a_carpet_of_another_size_is_refused() -> None:
    with pytest.raises(LoomError, match="24 x 6"):
        compare(woven_of(small_programme(4, 24, 2, 3), 1), PROGRAMME)
    with pytest.raises(LoomError, match="bytes"):
        Woven(PROGRAMME.setup, bytearray(10))


def test_the_picture_shows_knots_bare_warps_and_marks() -> None:
    rows = range(6)
    whole = draw_woven(
        PROGRAMME.setup,
        np.array([woven_of(PROGRAMME, 6).yarns(row) for row in rows]),
        compare(woven_of(PROGRAMME, 6), PROGRAMME),
        width=300,
    )
    part = woven_of(PROGRAMME, 3, frozenset({(1, 12)}))
    drawn = draw_woven(
        PROGRAMME.setup, np.array([part.yarns(row) for row in rows]), compare(part, PROGRAMME), width=300
    )
    assert (whole.marks, drawn.marks) == (0, 1)
    with Image.open(io.BytesIO(drawn.png)) as read:
        assert read.size == (300, whole.image.height + 22)
        pixels = np.asarray(read.convert("RGB")).astype(int)
    assert np.count_nonzero((pixels == (208, 0, 111)).all(axis=2)) > 40
    bare, cotton = pixels[10, 60:240], np.ptp(pixels[10, 60:240], axis=1)
    assert bare.mean() > 100
    assert cotton.max() < 80
