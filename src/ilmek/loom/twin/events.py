"""The chain of a plant's reports: digest = SHA-256(digest before + report), the same on every machine."""

import hashlib
import struct

from ilmek.loom.control.ports import (
    ChangePackages,
    Done,
    EndRow,
    Failed,
    Home,
    Order,
    PortReport,
    SensorsChanged,
    StandAside,
    Tie,
)
from ilmek.loom.operations import Stop
from ilmek.units import BILLION

_KNOT = struct.Struct("<cqiiiii")
_sha256 = hashlib.sha256


def chained(digest: bytes, report: PortReport) -> bytes:
    """The digest behind one more report."""
    if type(report) is Done and type(report.order) is Tie:
        one = report.order
        return _sha256(
            digest + _KNOT.pack(b"K", report.time, one.head, one.row, one.number, one.column, one.tube)
        ).digest()
    return _sha256(digest + _line(report).encode()).digest()


def order_words(order: Order) -> str:
    """An order as words and whole numbers.

    >>> order_words(Tie(0, 3, 1, 17, 2))
    'tie 0 3 1 17 2'
    """
    if isinstance(order, Tie):
        return f"tie {order.head} {order.row} {order.number} {order.column} {order.tube}"
    if isinstance(order, StandAside):
        return f"aside {order.head} {order.row} {order.phase} {order.column}"
    if isinstance(order, EndRow):
        return f"end {order.row} {int(order.operation)}"
    if isinstance(order, ChangePackages):
        return f"change {stop_words(order.stop)}"
    if isinstance(order, Home):
        return f"home {order.axis}"
    return f"jog {order.axis.replace(' ', '+')} {round(BILLION * order.distance)}"


def stop_words(stop: Stop) -> str:
    """A stop as words: row, phase, bobbins / head, tube, yarn and length [nm] of each package.

    >>> from ilmek.loom.operations import TubeChange
    >>> stop_words(Stop(3, 0, (1,), (TubeChange(0, 2, 4, 0.5),)))
    '3 0 1 / 0 2 4 500000000'
    """
    tubes = (f"{tube.head} {tube.tube} {tube.yarn} {round(BILLION * tube.length)}" for tube in stop.tubes)
    return " ".join([str(stop.row), str(stop.phase), *map(str, stop.wefts), "/", *tubes])


def _line(report: PortReport) -> str:
    if isinstance(report, SensorsChanged):
        one = report.sensors
        tension = "-" if one.warp_tension is None else round(1000 * one.warp_tension)
        levels = (one.door_closed, one.emergency_stop, one.heads_clear, one.beater_back, one.shed_closed)
        return f"sensors {report.time} {tension} {(*map(int, levels), *map(int, one.grippers_open))}"
    if isinstance(report, Failed):
        return f"failed {report.time} {report.fault} {order_words(report.order)}"
    return f"done {report.time} {order_words(report.order)}"
