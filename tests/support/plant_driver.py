"""Drives a port through a programme as the rules of time have it: all heads begin a phase together."""

from collections.abc import Callable, Iterator, Sequence

from ilmek.loom.control.ports import ChangePackages, Done, EndRow, Failed, LoomPort, Order, PortReport, Tie
from ilmek.loom.operations import LoomProgramme, RowOperations

Cure = Callable[[Failed], None]


def carry_out(port: LoomPort, orders: Sequence[Order], cure: Cure) -> list[PortReport]:
    """Send orders for different axes and wait for their reports; those that fail are cured and sent again."""
    port.send(orders)
    waiting, found = len(orders), list[PortReport]()
    while waiting:
        for report in port.receive(0.1):
            found.append(report)
            if isinstance(report, Failed):
                cure(report)
                port.send([report.order])
            waiting -= isinstance(report, Done)
    return found


def knots_of(row: RowOperations) -> list[list[list[Tie]]]:
    """The knots of a row: phase by phase, head by head."""
    first = [0, *row.counts.sum(axis=1).cumsum().tolist()]
    found: list[list[list[Tie]]] = []
    done = [0] * row.heads
    for phase in range(row.phases):
        found.append([])
        for head, count in enumerate(row.counts[:, phase].tolist()):
            numbers = range(done[head], done[head] + count)
            at = [first[head] + number for number in numbers]
            found[-1].append(
                [
                    Tie(head, row.number, number, int(row.columns[index]), int(row.tubes[index]))
                    for number, index in zip(numbers, at, strict=True)
                ]
            )
            done[head] += count
    return found


def weave(
    port: LoomPort, programme: LoomProgramme, rows: range | None = None, cure: Cure = lambda _: None
) -> Iterator[PortReport]:
    """Weave rows, default: all, and give the reports. cure: removes the cause of a failure, before the next attempt."""
    for number in range(programme.setup.rows) if rows is None else rows:
        row = programme.operations(number)
        for phase, heads in enumerate(knots_of(row)):
            for stop in row.stops:
                if stop.phase == phase:
                    yield from carry_out(port, [ChangePackages(stop)], cure)
            yield from _weave_phase(port, heads, cure)
        for operation in row.ends:
            yield from carry_out(port, [EndRow(number, operation)], cure)


def _weave_phase(port: LoomPort, heads: list[list[Tie]], cure: Cure) -> Iterator[PortReport]:
    left = [iter(knots) for knots in heads]
    orders = [order for one in left if (order := next(one, None)) is not None]
    busy = len(orders)
    port.send(orders)
    while busy:
        for report in port.receive(0.1):
            yield report
            if isinstance(report, Failed):
                cure(report)
                port.send([report.order])
            elif isinstance(report, Done) and isinstance(report.order, Tie):
                following = next(left[report.order.head], None)
                port.send([] if following is None else [following])
                busy -= following is None
