"""Each rule of the proof: a programme that breaks it in one operation, and the fault that is found."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from edited_programme import edited, part_of, with_knot, with_knot_twice, without_knot
from small_programme import small_programme

from ilmek.errors import LoomError
from ilmek.loom.operations import EMPTY, RowEnd, RowOperations, Stop, TubeChange
from ilmek.loom.proof import MOST_FAULTS, FaultyPart, prove


@pytest.mark.parametrize(("heads", "columns"), [(1, 5), (2, 24), (3, 40), (5, 40)])
def test_a_compiled_programme_is_proved(heads: int, columns: int) -> None:
    programme = small_programme(9, columns, heads, 4, seed=heads)
    proof = prove(programme)
    assert (proof.ok, proof.faults, proof.totals.knots) == (True, (), 9 * columns)
    assert (proof.totals.stops, proof.totals.wefts) == (2, 3)


def first(row: RowOperations) -> RowOperations:
    return replace(row, ends=row.ends[1:])


def swapped(row: RowOperations) -> RowOperations:
    return replace(row, ends=(*row.ends[:3], RowEnd.TAKE_UP, RowEnd.SECOND_BEAT))


def changed(change: TubeChange, phase: int = 0) -> Callable[[RowOperations], RowOperations]:
    return lambda row: replace(row, stops=(Stop(row.number, phase, tubes=(change,)),))


EDITS: list[tuple[int, Callable[[RowOperations], RowOperations], FaultyPart, str]] = [
    (1, lambda row: without_knot(row, 3), FaultyPart.ROW, "no head ties it"),
    (1, lambda row: with_knot_twice(row, 3), FaultyPart.KNOT, "is tied 2 times in the row, by heads 1 and 1"),
    (2, lambda row: with_knot(row, 5, column=99), FaultyPart.KNOT, "the row has knots 1 to 24"),
    (2, lambda row: with_knot(row, 5, column=-1), FaultyPart.KNOT, "the row has knots 1 to 24"),
    (2, lambda row: with_knot(row, 5, tube=(row.tubes[5] + 1) % 3), FaultyPart.KNOT, "the chart has yarn"),
    (2, lambda row: with_knot(row, 5, tube=7), FaultyPart.KNOT, "the head has tubes 1 to 3"),
    (0, lambda row: with_knot(row, 5, column=11), FaultyPart.KNOT, "heads 1 and 2 come within"),
    (3, first, FaultyPart.END, "first beat at the end of the row, must be straight weft"),
    (3, swapped, FaultyPart.END, "take-up at the end of the row, must be second beat"),
    (3, lambda row: replace(row, ends=row.ends[:4]), FaultyPart.ROW, "nothing at the end of the row, must be take-up"),
    (3, lambda row: replace(row, ends=(*row.ends, RowEnd.TAKE_UP)), FaultyPart.END, "must be nothing more"),
    (4, lambda row: replace(row, stops=()), FaultyPart.END, "the bobbin of straight weft has ended"),
    (4, lambda row: replace(row, stops=(Stop(4, 0, (7,)),)), FaultyPart.CHANGE, "the loom has 2"),
    (4, lambda row: replace(row, stops=(Stop(4, 0, (0, 0)),)), FaultyPart.CHANGE, "twice in a stop"),
    (4, lambda row: replace(row, stops=(Stop(4, 5, (0,)),)), FaultyPart.CHANGE, "not in the order of the row"),
    (1, changed(TubeChange(5, 0, 0, 9.0)), FaultyPart.CHANGE, "the loom has 2 heads of 3 tubes"),
    (1, changed(TubeChange(0, 0, 9, 9.0)), FaultyPart.CHANGE, "the list has yarns 1 to 3"),
    (1, changed(TubeChange(0, 0, 0, 0.0)), FaultyPart.CHANGE, "more than 0 m needed"),
    (0, changed(TubeChange(0, 0, 0, 0.13)), FaultyPart.KNOT, "the package of tube 1 (yarn 1) has ended before"),
    (0, changed(TubeChange(0, 0, 1, 9.0)), FaultyPart.KNOT, "tube 1 has yarn 2, the chart has yarn 1"),
    (2, lambda row: replace(row, counts=row.counts + 1), FaultyPart.ROW, "by its counts"),
    (2, lambda row: replace(row, number=3), FaultyPart.ROW, "is numbered 4, must be 3"),
]


@pytest.mark.parametrize(("number", "edit", "part", "what"), EDITS)
def test_an_edited_operation_is_named(
    number: int, edit: Callable[[RowOperations], RowOperations], part: FaultyPart, what: str
) -> None:
    proof = prove(edited(small_programme(), number, edit))
    assert not proof.ok
    # A bobbin that is not changed is a fault of its next weft, wherever that is.
    assert any(fault.part is part and what in fault.what for fault in proof.faults), proof.faults


def test_an_exchange_within_a_head_and_a_phase_breaks_no_rule() -> None:
    programme = small_programme()

    def exchanged(row: RowOperations) -> RowOperations:
        order = np.arange(len(row.columns))
        order[[0, 1]] = [1, 0]
        return replace(row, columns=row.columns[order], tubes=row.tubes[order])

    assert part_of(programme.operations(2), 0) == part_of(programme.operations(2), 1)
    assert prove(edited(programme, 2, exchanged)).ok


def test_a_package_gives_exactly_the_knots_of_its_length() -> None:
    programme = small_programme(3, 12, 1, 2)
    used = sum(int((programme.chart_row(row) == 0).sum()) for row in range(3))
    for knots, ok in ((used, True), (used - 1, False)):
        packages = np.array([[knots * 0.04, 100.0]])
        assert prove(edited(programme, packages=packages)).ok is ok


def test_an_empty_tube_gives_no_yarn() -> None:
    programme = small_programme()
    loading = programme.setup.loading.copy()
    loading[0, int(programme.operations(0).tubes[0])] = EMPTY
    assert "the tube has no yarn" in prove(edited(programme, loading=loading)).faults[0].what


def test_heads_that_need_more_room_meet() -> None:
    programme = small_programme(3, 24, 3)
    assert prove(edited(programme, spacing=5)).ok
    faults = prove(edited(programme, spacing=6)).faults
    assert "heads 1 and 2 come within 5 knots of each other in a phase; at least 6 needed" in faults[0].what
    assert {fault.part for fault in faults} == {FaultyPart.KNOT}


def test_a_head_that_stands_is_met() -> None:
    """Head 2 ties nothing in a row and stands where it was: head 1 must not tie there."""
    programme = small_programme(3, 12, 2, 2)
    before = programme.operations(0)

    def all_by_the_first(row: RowOperations) -> RowOperations:
        order = np.argsort(row.columns)
        return replace(row, columns=row.columns[order], tubes=row.tubes[order], counts=np.array([[12, 0], [0, 0]]))

    assert before.counts.min() > 0
    proof = prove(edited(programme, 1, all_by_the_first))
    assert {fault.row for fault in proof.faults} == {1}
    assert "heads 1 and 2 come within" in proof.faults[0].what


def test_the_move_to_the_next_row_takes_no_longer_than_its_end() -> None:
    programme = small_programme(3, 24, 1)
    times = replace(programme.setup.times, travel=4.0)

    end = int(programme.operations(0).columns[-1])

    def from_the_other_edge(row: RowOperations) -> RowOperations:
        order = np.argsort(row.columns if end > 12 else -row.columns)
        return replace(row, columns=row.columns[order], tubes=row.tubes[order])

    faults = prove(edited(programme, 1, from_the_other_edge, times=times)).faults
    assert f"head 1 goes from knot {end + 1} to knot {1 if end > 12 else 24} before the row" in faults[0].what


def test_the_time_is_that_of_the_rules() -> None:
    """One head, three knots: 2 s each, a change 0.47 s, an idle pitch of 16 ms, and the end of the row."""
    programme = small_programme(3, 3, 1, 2)
    whole = prove(programme).totals

    def order(row: RowOperations) -> RowOperations:
        return replace(row, columns=np.array([2, 0, 1], np.int32), tubes=programme.chart_row(2)[[2, 0, 1]])

    assert len(set(programme.chart_row(2).tolist())) == 1
    totals = prove(edited(programme, 2, order)).totals
    assert totals.time == whole.time + 16_000_000
    assert (totals.idle, totals.moved, totals.changes) == (whole.idle + 1, whole.moved + 1, whole.changes)
    assert whole.time == 9 * 2_000_000_000 + whole.changes * 470_000_000 + 3 * 69_800_000_000


def test_faults_are_listed_up_to_a_number_and_all_counted() -> None:
    programme = small_programme(40, 240, 1, 3)
    proof = prove(edited(programme, loading=np.array([[1, 2, 0]], np.uint8)))
    assert len(proof.faults) == MOST_FAULTS < proof.count


@pytest.mark.parametrize(
    "entries",
    [
        {"spacing": 0},
        {"loading": np.full((2, 3), 9, np.uint8)},
        {"packages": np.full((2, 3), np.nan)},
        {"knot_yarn": (0.04, 0.04)},
        {"knot_yarn": (0.04, 0.04, 0.0)},
        {"times": replace(small_programme().setup.times, row_ends=(1.0, 2.0))},
    ],
)
def test_a_setup_that_no_loom_has_is_refused(entries: dict[str, object]) -> None:
    with pytest.raises(LoomError, match="cannot be those of a loom"):
        prove(edited(small_programme(), **entries))
