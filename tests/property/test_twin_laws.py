"""Laws of the twin's runs: what adds up, what is monotone, what does not matter."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st
from small_programme import small_programme

from ilmek.loom.twin.carpet_run import run_carpet
from ilmek.loom.twin.faults import StopParams, fault_table
from ilmek.loom.twin.kernel import ALL_CALLS, COUNTS, FAILED, STOPPED, TIME, TRIED, WORK
from ilmek.loom.twin.seed_runs import run_seeds

PROGRAMME = small_programme(10, 36, 3, 4)
RATES = StopParams(pile_break=0.05, gripper_miss=0.03, weft_break=0.02, warp_break=2e-4, retries=1, retry_fails=0.4)


def params(rate: float, others: str, response: float = 60.0) -> StopParams:
    rates = {name: rate * getattr(RATES, name) for name in ("pile_break", "gripper_miss", "weft_break", "warp_break")}
    return RATES.with_values({**rates, "others": others, "response": response})


@given(seed=st.integers(0, 2**40), others=st.sampled_from(["finish", "stop"]), rate=st.floats(0.1, 5.0))
@settings(max_examples=20, deadline=None)
def test_times_add_up(seed: int, others: str, rate: float) -> None:
    run = run_carpet(PROGRAMME, fault_table(params(rate, others), PROGRAMME.setup), seed)
    assert run.time == run.base + run.sums[TRIED] + run.sums[STOPPED]
    assert run.lost.sum() == run.sums[STOPPED] == run.rows[:, 2].sum()
    assert run.uses.sum(axis=(0, 2)).tolist() == [run.time] * 3
    assert run.sums[COUNTS : COUNTS + 6].sum() == len(run.faults)
    assert (run.sums[ALL_CALLS : ALL_CALLS + 6] <= run.sums[COUNTS : COUNTS + 6]).all()
    calls = run.faults[run.faults[:, 6] >= 0][:, 6:8]
    assert (calls.sum(axis=1) <= run.rows[run.faults[run.faults[:, 6] >= 0][:, 0], 0]).all()
    if others == "stop":
        ordered = calls[np.argsort(calls[:, 0], kind="stable")]
        assert (ordered[1:, 0] >= ordered[:-1].sum(axis=1)).all()
        assert run.sums[STOPPED] == run.sums[WORK : WORK + 6].sum()


@given(seed=st.integers(0, 2**40), low=st.floats(0.1, 2.0), more=st.floats(1.0, 2.5))
@settings(max_examples=20, deadline=None)
def test_higher_rates_never_make_a_loom_that_halts_quicker(seed: int, low: float, more: float) -> None:
    """Each fault moves nearer to the beginning and keeps its repair."""
    few, many = (
        run_seeds(PROGRAMME, fault_table(params(rate, "stop"), PROGRAMME.setup), [seed])[0]
        for rate in (low, low * more)
    )
    assert (many[COUNTS : COUNTS + 6] >= few[COUNTS : COUNTS + 6]).all()
    assert many[STOPPED] >= few[STOPPED]
    assert many[FAILED] >= few[FAILED]


@given(seed=st.integers(0, 2**40), slow=st.floats(1.0, 10.0))
@settings(max_examples=20, deadline=None)
def test_a_slower_operator_never_helps_and_meets_the_same_faults(seed: int, slow: float) -> None:
    for others in ("finish", "stop"):
        quick, late = (
            run_seeds(PROGRAMME, fault_table(params(1.0, others, 30.0 * k), PROGRAMME.setup), [seed])[0]
            for k in (1.0, slow)
        )
        assert late[TIME] >= quick[TIME]
        assert (late[COUNTS : COUNTS + 12] == quick[COUNTS : COUNTS + 12]).all()


def test_faults_are_as_frequent_as_their_rates() -> None:
    table = fault_table(params(1.0, "finish"), PROGRAMME.setup)
    sums = run_seeds(PROGRAMME, table, range(4000))
    setup = PROGRAMME.setup
    yarn = setup.knots * setup.knot_yarn[0]
    wanted = [0.0, RATES.pile_break * yarn, RATES.gripper_miss * setup.knots, RATES.weft_break * 20, 2e-5 * 20]
    wanted.append(RATES.warp_break * 20 * 2 * setup.columns)
    wanted[0] = RATES.pile_end * yarn
    found = sums[:, COUNTS : COUNTS + 6].mean(axis=0)
    assert np.all(np.abs(found - wanted) <= 4 * np.sqrt(np.array(wanted) / 4000) + 1e-9)


def test_the_order_of_seeds_does_not_matter() -> None:
    table = fault_table(params(2.0, "finish"), PROGRAMME.setup)
    whole = run_seeds(PROGRAMME, table, range(30))
    parts = [run_seeds(PROGRAMME, table, seeds) for seeds in (range(20, 30), range(11), range(11, 20))]
    assert (np.concatenate([parts[1], parts[2], parts[0]]) == whole).all()
