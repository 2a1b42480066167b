"""A row in motion: its knots in time by the rules, heads over the knots that they tie, wefts and beats behind."""

import numpy as np
import pytest
from small_programme import small_programme

from ilmek.loom.twin.durations import durations_of
from ilmek.loom.twin.row_motion import row_in_motion, timed_row
from ilmek.report import Animation, MovingStroke
from ilmek.units import BILLION


def strokes(moving: Animation, label: str) -> list[MovingStroke]:
    return [one for one in moving.strokes if one.label == label]


@pytest.mark.parametrize(("heads", "seed"), [(1, 1), (2, 2), (3, 3)])
def test_the_row_lasts_as_long_as_its_heads_by_the_rules(heads: int, seed: int) -> None:
    programme = small_programme(6, 24, heads, 4, seed=seed)
    durations, row = durations_of(programme.setup.times), programme.operations(3)
    timed = timed_row(row, durations)
    spent = np.zeros((heads, row.phases))
    for head in range(heads):
        first = row.starts[head]
        phases = np.repeat(np.arange(row.phases), row.counts[head])
        for number, phase in enumerate(phases):
            knot = first + number
            moved = abs(int(row.columns[knot]) - int(row.columns[knot - 1])) if number else 0
            changed = number > 0 and row.tubes[knot] != row.tubes[knot - 1]
            spent[head, phase] += durations.knot + changed * durations.colour_change
            spent[head, phase] += durations.travel * max(moved - 1, 0)
    assert timed.last == pytest.approx(spent.max(axis=0).sum() / BILLION)
    moving = row_in_motion(programme.setup, row)
    assert moving.period == pytest.approx(timed.last + programme.setup.times.row_ends[-1])


def test_every_knot_is_a_tick_at_the_end_and_none_at_the_begin() -> None:
    programme = small_programme(6, 24, 2, 3)
    moving = row_in_motion(programme.setup, programme.operations(2))
    ticks = strokes(moving, "knots")[0].points[:, 1::3].imag
    assert ticks[0] == pytest.approx(0.0)
    assert np.ptp(ticks[-1]) == pytest.approx(0.0)
    assert ticks[-1].min() > 0
    assert np.all(np.diff(ticks, axis=0) >= -1e-15)
    assert moving.readings[0].values[[0, -1]].tolist() == [0.0, 24.0]


def test_heads_keep_their_order_along_the_row() -> None:
    programme = small_programme(6, 24, 3, 3)
    moving = row_in_motion(programme.setup, programme.operations(1))
    middles = np.stack([one.points.real.mean(axis=1) for one in strokes(moving, "heads")], axis=1)
    assert np.all(np.diff(middles, axis=1) > 0)
