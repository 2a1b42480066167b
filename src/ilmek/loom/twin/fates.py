"""How an operation of the plant will end: whole, or by a fault that was injected, is in the yarn, or is drawn."""

from dataclasses import replace

from ilmek.loom.control.ports import EndRow, Fault, Tie
from ilmek.loom.operations import EMPTY, WEFT_OF, RowEnd
from ilmek.loom.twin.model import PlantModel
from ilmek.loom.twin.state import NOWHERE, LoomCondition, PlantHead

_KNOT_FAULTS = frozenset((Fault.PILE_END, Fault.PILE_BREAK, Fault.MISSED_GRIP, Fault.WARP_BREAK, Fault.TIMEOUT))
_WEFT_FAULTS = frozenset((Fault.WEFT_BREAK, Fault.WEFT_END, Fault.TIMEOUT))
_BEAT_FAULTS = frozenset((Fault.WARP_BREAK, Fault.TIMEOUT))
"""The bobbin of each insertion of weft."""

_BEATS = (RowEnd.FIRST_BEAT, RowEnd.SECOND_BEAT)


def knot_fate(
    plant: PlantModel, loom: LoomCondition, head: PlantHead, order: Tie
) -> tuple[Fault | None, LoomCondition]:
    """The fault of a knot that begins, None: it will be tied; and the loom without the injected fault that acts."""
    own, fault = head.condition, None
    yarn = own.yarns[order.tube]
    if loom.emergency_stop:
        fault = Fault.TIMEOUT
    elif own.broken >> order.tube & 1:
        fault = Fault.PILE_BREAK
    elif order.column in loom.broken_warps:
        fault = Fault.WARP_BREAK
    elif yarn == EMPTY or head.left[order.tube] < plant.knot_yarn[yarn]:
        fault = Fault.PILE_END
    elif loom.injected:
        for index, one in enumerate(loom.injected):
            of_knot = one.operation is None and one.column in (order.column, NOWHERE)
            if of_knot and one.row == order.row and one.fault in _KNOT_FAULTS:
                return one.fault, _without(loom, index)
    if fault is None and plant.knot_limits:
        fault = plant.knot_fault(order.row, order.column, own.attempts)
    return fault, loom


def end_fate(plant: PlantModel, loom: LoomCondition, order: EndRow) -> tuple[Fault | None, LoomCondition]:
    """The fault of an operation after the knots of a row, None: it will be carried out; and the loom as above."""
    bobbin = WEFT_OF.get(order.operation)
    if loom.emergency_stop:
        return Fault.TIMEOUT, loom
    if bobbin is not None and loom.weft_broken:
        return Fault.WEFT_BREAK, loom
    if bobbin is not None and bobbin < len(loom.wefts) and loom.wefts[bobbin] < 1:
        return Fault.WEFT_END, loom
    beat = order.operation in _BEATS
    if beat and NOWHERE in loom.broken_warps:
        return Fault.WARP_BREAK, loom
    allowed = _WEFT_FAULTS if bobbin is not None else _BEAT_FAULTS if beat else frozenset((Fault.TIMEOUT,))
    for index, one in enumerate(loom.injected):
        here = one.operation is order.operation or (one.operation is None and one.column == NOWHERE)
        if here and one.row == order.row and one.fault in allowed:
            return one.fault, _without(loom, index)
    return plant.end_fault(order.row, order.operation, loom.attempts), loom


def _without(loom: LoomCondition, index: int) -> LoomCondition:
    return replace(loom, injected=(*loom.injected[:index], *loom.injected[index + 1 :]))


def after_weft(wefts: tuple[int, ...], operation: RowEnd) -> tuple[int, ...]:
    """Rows that the bobbins still last after an operation."""
    bobbin = WEFT_OF.get(operation)
    return tuple(rows - (index == bobbin) for index, rows in enumerate(wefts))


def after_end_fault(loom: LoomCondition, operation: RowEnd, fault: Fault) -> LoomCondition:
    """The condition after an operation that failed: what is broken or empty stays so until it is cured."""
    attempts, bobbin = loom.attempts + 1, WEFT_OF.get(operation)
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
