"""How an operation of the plant will end: whole, or by a fault that was injected, is in the yarn, or is drawn."""

from dataclasses import replace

from ilmek.loom.control.ports import EndRow, Fault, Tie
from ilmek.loom.operations import EMPTY, RowEnd
from ilmek.loom.twin.model import PlantModel
from ilmek.loom.twin.state import NOWHERE, LoomCondition, PlantHead

_KNOT_FAULTS = frozenset((Fault.PILE_END, Fault.PILE_BREAK, Fault.MISSED_GRIP, Fault.WARP_BREAK, Fault.TIMEOUT))
_WEFT_FAULTS = frozenset((Fault.WEFT_BREAK, Fault.WEFT_END, Fault.TIMEOUT))
_BEAT_FAULTS = frozenset((Fault.WARP_BREAK, Fault.TIMEOUT))
_WEFTS = {RowEnd.STRAIGHT_WEFT: 0, RowEnd.SINUOUS_WEFT: 1}
"""The bobbin of each insertion of weft."""

_BEATS = (RowEnd.FIRST_BEAT, RowEnd.SECOND_BEAT)


def knot_fate(plant: PlantModel, loom: LoomCondition, head: PlantHead, order: Tie) -> Fault | None:
    """The fault of a knot that begins; None: it will be tied."""
    own = head.condition
    if loom.emergency_stop:
        return Fault.TIMEOUT
    if own.broken >> order.tube & 1:
        return Fault.PILE_BREAK
    if order.column in loom.broken_warps:
        return Fault.WARP_BREAK
    yarn = own.yarns[order.tube]
    if yarn == EMPTY or head.left[order.tube] < plant.knot_yarn[yarn]:
        return Fault.PILE_END
    if loom.injected:
        found = _injected(loom, order.row, order.column, _KNOT_FAULTS)
        if found is not None:
            return found
    return plant.knot_fault(order.row, order.column, own.attempts) if plant.knot_limits else None


def end_fate(plant: PlantModel, loom: LoomCondition, order: EndRow) -> Fault | None:
    """The fault of an operation after the knots of a row that begins; None: it will be carried out."""
    bobbin = _WEFTS.get(order.operation)
    if loom.emergency_stop:
        return Fault.TIMEOUT
    if bobbin is not None and loom.weft_broken:
        return Fault.WEFT_BREAK
    if bobbin is not None and bobbin < len(loom.wefts) and loom.wefts[bobbin] < 1:
        return Fault.WEFT_END
    beat = order.operation in _BEATS
    if beat and NOWHERE in loom.broken_warps:
        return Fault.WARP_BREAK
    allowed = _WEFT_FAULTS if bobbin is not None else _BEAT_FAULTS if beat else frozenset((Fault.TIMEOUT,))
    found = _injected(loom, order.row, int(order.operation), allowed)
    return found if found is not None else plant.end_fault(order.row, order.operation, loom.attempts)


def used(loom: LoomCondition, fault: Fault, row: int, at: int) -> LoomCondition:
    """The condition without the injected fault that has just acted."""
    for index, one in enumerate(loom.injected):
        if one.fault is fault and one.row == row and one.at in (at, NOWHERE):
            return replace(loom, injected=(*loom.injected[:index], *loom.injected[index + 1 :]))
    return loom


def after_weft(wefts: tuple[int, ...], operation: RowEnd) -> tuple[int, ...]:
    """Rows that the bobbins still last after an operation."""
    bobbin = _WEFTS.get(operation)
    return tuple(rows - (index == bobbin) for index, rows in enumerate(wefts))


def after_end_fault(loom: LoomCondition, operation: RowEnd, fault: Fault) -> LoomCondition:
    """The condition after an operation that failed: what is broken or empty stays so until it is cured."""
    attempts, bobbin = loom.attempts + 1, _WEFTS.get(operation)
    if fault is Fault.WEFT_BREAK:
        return replace(loom, attempts=attempts, weft_broken=True)
    if fault is Fault.WEFT_END:
        left = tuple(0 if index == bobbin else rows for index, rows in enumerate(loom.wefts))
        return replace(loom, attempts=attempts, wefts=left)
    if fault is Fault.WARP_BREAK:
        return with_broken_warp(replace(loom, attempts=attempts), NOWHERE)
    return replace(loom, attempts=attempts)


def with_broken_warp(loom: LoomCondition, column: int) -> LoomCondition:
    """The condition with a broken warp of a column; NOWHERE: one that the beat has broken."""
    return loom if column in loom.broken_warps else replace(loom, broken_warps=(*loom.broken_warps, column))


def _injected(loom: LoomCondition, row: int, at: int, kinds: frozenset[Fault]) -> Fault | None:
    for one in loom.injected:
        if one.row == row and one.at in (at, NOWHERE) and one.fault in kinds:
            return one.fault
    return None
