"""The plant beside the kernel that weaves whole carpets: the same faults give every attempt the same end."""

import pytest
from plant_driver import weave
from small_programme import small_programme

from ilmek.arrays import IntArray
from ilmek.drivers.twin_port import TwinPort
from ilmek.loom.control.ports import ChangePackages, Done, EndRow, Failed, PortReport, Tie
from ilmek.loom.operations import RowEnd, RowOperations
from ilmek.loom.twin.carpet_run import run_carpet
from ilmek.loom.twin.faults import CAUSES, StopParams, fault_table
from ilmek.loom.twin.kernel import CHANGED, NO_HEAD
from ilmek.loom.twin.model import plant_model
from ilmek.loom.twin.state import Injected, Repaired, first_state
from ilmek.loom.twin.woven import Woven, woven_size

MANY = StopParams(
    pile_end=1e-3, pile_break=0.2, gripper_miss=0.05, weft_break=0.05, weft_end=0.01, warp_break=3e-4,
    retry_fails=0.5, retries=1, response=0.0, repair_pile_end=0.0, repair_pile_break=0.0, repair_miss=0.0,
    repair_weft_break=0.0, repair_weft_end=0.0, repair_warp_break=0.0,
)  # fmt: skip
"""Many faults, of which each is cured at once: the plant has no operator of its own."""

Attempt = tuple[int, int, int, int, int, int]
"""End [ns], row, column or operation, head, tube, outcome."""


def attempts_of(events: IntArray) -> list[Attempt]:
    """The attempts of the kernel's events, without planned changes."""
    found = []
    for _, end, where, what in events.tolist():
        if what & 255 != CHANGED:
            found.append((end, where >> 32, where & 0xFFFFFFFF, what >> 16, what >> 8 & 255, what & 255))
    return found


def attempt_of(report: PortReport) -> Attempt | None:
    """The attempt of a report, as the kernel has it."""
    if not isinstance(report, Done | Failed) or isinstance(report.order, ChangePackages):
        return None
    outcome = 1 + CAUSES.index(report.fault) if isinstance(report, Failed) else 0
    if isinstance(report.order, Tie):
        one = report.order
        return report.time, one.row, one.column, one.head, one.tube, outcome
    assert isinstance(report.order, EndRow)
    return report.time, report.order.row, int(report.order.operation), NO_HEAD, 0, outcome


def injected(attempt: Attempt) -> Injected:
    """The fault of an attempt."""
    _, row, at, head, _, outcome = attempt
    fault = CAUSES[outcome - 1]
    return Injected(fault, row, operation=RowEnd(at)) if head == NO_HEAD else Injected(fault, row, at)


@pytest.mark.parametrize("seed", range(4))
def test_every_attempt_ends_at_the_same_time(seed: int) -> None:
    programme = small_programme(12, 24, 3, 4, seed=seed)
    expected: list[Attempt] = []

    def take(_: RowOperations, events: IntArray) -> None:
        expected.extend(attempts_of(events))

    run = run_carpet(programme, fault_table(MANY, programme.setup), seed, take=take)
    woven = Woven(programme.setup, bytearray(woven_size(programme.setup)))
    woven.keep(first_state(plant_model(programme.setup)))
    port = TwinPort(programme.setup, woven)
    port.act(*(injected(one) for one in expected if one[5]))
    reports = list(weave(port, programme, cure=lambda _: port.act(Repaired())))
    assert sorted(found for one in reports if (found := attempt_of(one))) == sorted(expected)
    assert sum(one[5] > 0 for one in expected) > 10
    assert port.time == run.time
    assert all(woven.counts(row).tolist() == [1] * 24 for row in range(12))
