"""The twin beside SimPy's processes: the same times, the same number of attempts."""

import pytest
from benchmarks.simpy_twin import SimpyTwin
from small_programme import small_programme

from ilmek.loom.twin.carpet_run import run_carpet
from ilmek.loom.twin.faults import StopParams, fault_table

MANY = StopParams(pile_break=0.2, gripper_miss=0.05, weft_break=0.05, warp_break=3e-4, retry_fails=0.5, retries=1)


@pytest.mark.parametrize("seed", range(6))
def test_processes_of_heads_and_operator_take_the_same_time(seed: int) -> None:
    programme = small_programme(15, 40, 4, 4)
    table = fault_table(MANY, programme.setup)
    counted = []
    run = run_carpet(programme, table, seed, take=lambda _, events: counted.append((events[:, 3] & 255 != 16).sum()))
    other = SimpyTwin(programme, table, seed)
    assert other.time == run.time
    assert other.events == sum(counted)
