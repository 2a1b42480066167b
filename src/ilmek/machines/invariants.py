"""Invariants of every design: what must hold of a report whatever machine made it.

Numbers are finite; no mass, area, time, or result with a declared bound is below it; a value is absent only where its
declaration states when; parts have a count, a mass, a length and a power of 0 and more; plates have a thickness, an
area, and holes inside their outline; axes have a period; acts take energy. Machines refuse impossible input themselves:
a broken invariant is a defect, and becomes a failed check, so that such a design is never reported as sound.
"""

import math
from collections.abc import Iterable, Iterator, Mapping
from typing import Any

import numpy as np

from ilmek.arrays import ComplexArray
from ilmek.plane import biarcs, contours
from ilmek.plane.vectors import dot
from ilmek.report import BillLine, CamTable, Check, Contour, Plate, Report, Result, Work

SOURCE = "invariant of every design"


ROUNDING = 1e-9
"""Energy below 0 that counts as rounding [J]: it is a sum of work in both directions."""


def broken(report: Report, work: Iterable[Work] = ()) -> tuple[Check, ...]:
    """A failed check for each invariant that does not hold of a report, and of the work of its machine.

    The reports of the machines in it have their own.
    """
    return (
        *(check for result in report.results for check in _of_result(result)),
        *(check for one in report.checks for check in _of_check(one)),
        *(check for part in report.parts for check in _of_part(part)),
        *(check for plate in report.plates for check in _of_plate(plate)),
        *(check for table in report.cam_tables for check in _of_cam_table(table)),
        *(check for one in work for check in _of_work(one)),
    )


def _of_result(result: Result) -> Iterator[Check]:
    if result.value is None:
        if not result.absent:
            yield _count(f"{result.name} has a value", 1)
        return
    numbers = list(_numbers(result.value))
    infinite = sum(not math.isfinite(number) for number in numbers)
    if infinite:
        yield _count(f"{result.name} is finite", infinite)
    yield from _at_least(f"{result.name} is not below its bound", _least(numbers), result.least, result.unit)


def _of_check(check: Check) -> Iterator[Check]:
    infinite = (not math.isfinite(check.value)) + (not math.isfinite(check.limit))
    if check.ok and infinite:
        yield _count(f"{check.name}: value and limit are finite", infinite)


def _of_part(part: BillLine) -> Iterator[Check]:
    quantities = (("number", part.number, "1"), ("length", part.length, "m"), ("power", part.power, "W"))
    weighed = () if math.isnan(part.mass) else (("mass", part.mass, "kg"),)
    for name, value, unit in (*quantities, *weighed):
        yield from _at_least(f"{name} of the {part.name} is positive", value, 0.0, unit)


def _of_plate(plate: Plate) -> Iterator[Check]:
    outline = plate.outline
    closed = outline if isinstance(outline, Contour) else contours.polygon(outline)
    yield from _above(f"thickness of the plate {plate.name} is positive", plate.thickness, "mm")
    yield from _above(f"area of the plate {plate.name} is positive", contours.area(closed), "mm^2")
    if plate.area is not None:
        yield from _above(f"area of the plate {plate.name}, holes not taken off, is positive", plate.area, "mm^2")
    for hole in plate.holes:
        yield from _above(f"radius of a hole of the plate {plate.name} is positive", hole.radius, "mm")
        room = _distance_inside(outline, hole.at) - hole.radius
        yield from _at_least(f"the holes of the plate {plate.name} are inside of its outline", room, 0.0, "mm")


def _of_cam_table(table: CamTable) -> Iterator[Check]:
    if not table.period > 0:  # a cam at rest has an infinite one
        yield from _above(f"period of {table.name} is positive", table.period, "s")


def _of_work(work: Work) -> Iterator[Check]:
    if not -ROUNDING <= work.energy < math.inf:
        yield Check(f"energy of {work.name} is positive", work.energy, 0.0, "J", False, SOURCE, ">=")


def _count(name: str, number: int) -> Check:
    return Check(name, float(number), 0.0, "1", False, SOURCE)


def _at_least(name: str, value: float, limit: float, unit: str) -> Iterator[Check]:
    if not value >= limit:
        yield Check(name, value, limit, unit, False, SOURCE, ">=")


def _above(name: str, value: float, unit: str) -> Iterator[Check]:
    if not 0 < value < math.inf:
        yield Check(name, value, 0.0, unit, False, SOURCE, ">")


def _least(numbers: list[float]) -> float:
    return min((number for number in numbers if math.isfinite(number)), default=math.inf)


def _numbers(value: Any) -> Iterator[float]:
    """Every number in a value, of groups and arrays all of them; a complex one is two."""
    if isinstance(value, np.ndarray | np.generic):
        value = value.tolist()
    if isinstance(value, bool | str) or value is None:
        return
    if isinstance(value, int | float):
        yield value
    elif isinstance(value, complex):
        yield from (value.real, value.imag)
    else:
        for one in value.values() if isinstance(value, Mapping) else value:
            yield from _numbers(one)


def _distance_inside(outline: ComplexArray | Contour, at: complex) -> float:
    """Distance of a point from an outline [m], negative outside."""
    if isinstance(outline, Contour):
        kept = outline.points != np.roll(outline.points, -1)
        contour = Contour(outline.points[kept], outline.bulges[kept])
        distance = biarcs.deviation(np.array([at]), contour)
        corners = contours.along(contour, distance / 10) if distance > 0 else contour.points
    else:
        corners = outline[outline != np.roll(outline, -1)]
        edges = np.roll(corners, -1) - corners
        share = np.clip(dot(at - corners, edges) / np.abs(edges) ** 2, 0.0, 1.0)
        distance = float(np.abs(corners + share * edges - at).min(initial=math.inf))
    winding = np.angle((np.roll(corners, -1) - at) / (corners - at)).sum() if distance > 0 else 0.0
    return distance if abs(winding) > math.pi else -distance
