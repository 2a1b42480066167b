"""The twin beside a plain simulation event by event, and beside times computed by hand."""

import math
from dataclasses import replace

import numpy as np
import pytest
from plain_twin import PlainTwin, plain_exponential, plain_word
from small_programme import TIMES, small_programme

from ilmek.loom.operations import ROW_ENDS, LoomSetup, RowOperations, Stop, TubeChange
from ilmek.loom.twin.carpet_run import run_carpet
from ilmek.loom.twin.durations import durations_of, ns, stop_duration
from ilmek.loom.twin.faults import RATES, Exposure, StopParams, expected_standstill, fault_table
from ilmek.loom.twin.kernel import STOPPED, TIME, TRIED
from ilmek.loom.twin.random import exponential, word
from ilmek.loom.twin.seed_runs import run_seeds

MANY = StopParams(
    pile_end=0.2, pile_break=0.3, gripper_miss=0.08, weft_break=0.05, weft_end=0.02, warp_break=5e-4, retries=2,
    retry_fails=0.5, response=20.0, looms=2,
)  # fmt: skip
"""Several faults in a phase, also at one knot."""


class Listed:
    """A programme of given rows."""

    digest = "0" * 64

    def __init__(self, setup: LoomSetup, rows: list[RowOperations]) -> None:
        self.setup, self._rows = setup, rows

    def operations(self, number: int) -> RowOperations:
        return self._rows[number]

    def chart_row(self, number: int) -> np.ndarray:
        return np.full(self.setup.columns, number % 2, np.uint8)


def changed_packages(rows: int = 8) -> Listed:
    """A programme with changes of packages before both phases of a row."""
    programme = small_programme(rows, 30, 3, 4)
    made = []
    for number in range(rows):
        row = programme.operations(number)
        if number == 3:
            stops = (Stop(3, 0, (0,), (TubeChange(0, 1, 2, 40.0),)), Stop(3, 1, (), (TubeChange(2, 0, 3, 40.0),) * 2))
            row = RowOperations(row.number, row.columns, row.tubes, row.counts, row.ends, stops)
        made.append(row)
    return Listed(programme.setup, made)


@pytest.mark.parametrize("others", ["finish", "stop"])
@pytest.mark.parametrize("seed", [0, 1, 2, 3])
def test_every_event_is_that_of_a_plain_simulation(others: str, seed: int) -> None:
    programme = changed_packages()
    table = fault_table(MANY.with_values({"others": others}), programme.setup)
    found: list[tuple[int, ...]] = []
    run = run_carpet(programme, table, seed, take=lambda _, events: found.extend(map(tuple, events.tolist())))
    plain = PlainTwin(programme, table, seed)
    assert found == plain.events
    assert (run.time, run.digest) == (plain.time, plain.digest)
    assert run.sums[TIME] == plain.time
    assert (run_seeds(programme, table, [7, seed])[1] == run.sums).all()


def test_random_numbers_are_those_of_plain_whole_numbers() -> None:
    words = [word(5, 3, ordinal) for ordinal in range(2000)]
    assert words == [plain_word(5, 3, ordinal) for ordinal in range(2000)]
    assert [exponential(one) for one in words] == [plain_exponential(one) for one in words]
    exact = -np.log((np.array(words, float) + 1) / 2**63)
    assert np.allclose([exponential(one) / 2**20 for one in words], exact, atol=2**-20, rtol=0)


def test_a_row_by_hand() -> None:
    """Two heads, two phases: times by the rules, added up on paper."""
    setup = replace(small_programme(3, 8, 2, 2).setup, rows=2)
    rows = [
        # Head 0: columns 0, 1, 3 with tubes 0, 0, 1; then 2. Head 1: 4, 5; then 7, 6.
        RowOperations(0, np.array([0, 1, 3, 2, 4, 5, 7, 6], np.int32), np.array([0, 0, 1, 1, 1, 1, 1, 0], np.uint8),
                      np.array([[3, 1], [2, 2]])),
        RowOperations(1, np.arange(8, dtype=np.int32), np.array([1, 1, 1, 1, 0, 0, 0, 0], np.uint8),
                      np.array([[2, 2], [2, 2]]),
                      stops=(Stop(1, 0, (0, 1)), Stop(1, 1, (), (TubeChange(0, 0, 1, 9.0),)))),
    ]  # fmt: skip
    programme = Listed(setup, rows)
    run = run_carpet(programme, fault_table(StopParams().without_faults(), setup), 1)
    first = (2 + 2 + 2 + 0.47 + 0.016) + (2 + 0.016 + 2 + 0.47) + 69.8
    second = 2 * 90 + 2 * 2 + 60 + 2 * 2 + 69.8
    assert run.time == ns(first + second) == run.base
    assert run.rows[:, 0].tolist() == [ns(first), ns(first + second)]
    assert run.changes.tolist() == [1, 1]
    assert stop_duration(rows[1].stops[0], setup) == ns(180.0)
    assert durations_of(TIMES).ends == (ns(18.0), ns(12.0), ns(21.0), ns(11.0), ns(7.8))
    assert len(rows[0].ends) == len(ROW_ENDS)


def test_without_faults_nothing_is_lost_and_every_knot_is_tied_once() -> None:
    programme = small_programme(12, 40, 4, 5)
    tied = []
    run = run_carpet(
        programme,
        fault_table(StopParams().without_faults(), programme.setup),
        3,
        take=lambda _, events: tied.extend(events[events[:, 3] >> 16 != 0xFFFF][:, 2].tolist()),
    )
    assert run.time == run.base
    assert run.sums[TRIED] == run.sums[STOPPED] == 0
    assert sorted(tied) == [(row << 32) + column for row in range(12) for column in range(40)]
    assert run.uses.sum(axis=(0, 2)).tolist() == [run.time] * 4


@pytest.mark.parametrize("retries", [0, 2])
def test_expected_standstill_is_the_mean_of_many_runs(retries: int) -> None:
    """Within 4 standard errors where the loom halts, and where its heads go on but faults seldom meet in a phase."""
    setup = (programme := small_programme(12, 36, 3, 4)).setup
    yarn = setup.knots * sum(setup.knot_yarn) / len(setup.knot_yarn)
    params = replace(MANY, looms=1, retries=retries)
    rare = params.with_values({name: rate / 50 for name, rate in zip(RATES, params.rates, strict=True)})
    means = []
    for stops, others, seeds in ((params, "stop", 1000), (rare, "finish", 20_000), (params, "finish", 1000)):
        table = fault_table(replace(stops, others=others), setup)
        stopped = run_seeds(programme, table, range(10**6, 10**6 + seeds))[:, STOPPED] / 1e9
        expected = expected_standstill(stops, Exposure(setup.knots, yarn, setup.rows, setup.columns))
        means.append(((stopped.mean() - expected) / expected, stopped.std() / math.sqrt(seeds) / expected))
    (halts, error), (seldom, rough), (goes_on, _) = means
    assert error < rough < 0.02
    assert abs(halts) < 4 * error
    assert abs(seldom) < 4 * rough
    assert goes_on < halts - 4 * error  # others tie on meanwhile
