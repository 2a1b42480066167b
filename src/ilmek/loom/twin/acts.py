"""What an operator, a jog and faults from outside do to the plant."""

from collections.abc import Sequence
from dataclasses import replace

from ilmek.errors import LoomError
from ilmek.loom.control.interlocks import LoomAxis
from ilmek.loom.control.ports import Fault, Home, Jog
from ilmek.loom.operations import Stop
from ilmek.loom.twin.model import PlantModel, nanometres
from ilmek.loom.twin.state import (
    Door,
    EmergencyStop,
    Injected,
    LoomCondition,
    PackageChanged,
    PlantHead,
    PlantInput,
    Repaired,
    SensorFault,
    SetSpeed,
    Tension,
    full_tubes,
    gripping,
)

MOST_INJECTED = 1000
"""Faults that wait for their operation, and sensors at fault, at most."""

Heads = Sequence[PlantHead]


def acted(plant: PlantModel, loom: LoomCondition, heads: Heads, one: PlantInput) -> tuple[LoomCondition, Heads]:
    """The loom and its heads after an act. Raises LoomError for a package or a sensor that does not exist."""
    if isinstance(one, Jog | Home):
        forward = one.distance > 0 if isinstance(one, Jog) else one.axis not in _OUTWARD
        return _moved(loom, heads, one.axis, forward=forward)
    match one:
        case Door(closed):
            loom = replace(loom, door_closed=closed)
        case EmergencyStop(pressed):
            loom = replace(loom, emergency_stop=pressed)
        case Tension(low):
            loom = replace(loom, slack=low)
        case SetSpeed(permille):
            if not 0 < permille <= 1000:
                raise LoomError(f"speed {permille} / 1000", allowed="above 0, at most that of the programme")
            loom = replace(loom, permille=permille)
        case PackageChanged(stop):
            plant.change_time(stop)
            loom, heads = changed_packages(plant, loom, heads, stop)
        case Injected() | SensorFault():
            loom = _injected(plant, loom, one)
        case Repaired():
            loom, heads = _repaired(plant, loom, heads)
    return loom, heads


def changed_packages(plant: PlantModel, loom: LoomCondition, heads: Heads, stop: Stop) -> tuple[LoomCondition, Heads]:
    """The loom and its heads with new bobbins of weft and new packages."""
    wefts = tuple(
        plant.setup.wefts[index].rows if index in stop.wefts else rows for index, rows in enumerate(loom.wefts)
    )
    found = list(heads)
    for tube in stop.tubes:
        head = found[tube.head]
        left, yarns = list(head.left), list(head.condition.yarns)
        left[tube.tube], yarns[tube.tube] = nanometres(tube.length), tube.yarn
        broken = head.condition.broken & ~(1 << tube.tube)
        found[tube.head] = replace(
            head, left=tuple(left), condition=replace(head.condition, yarns=tuple(yarns), broken=broken)
        )
    return replace(loom, wefts=wefts), found


def halted(loom: LoomCondition, heads: Heads, time: int) -> tuple[LoomCondition, Heads]:
    """The loom and its heads with every motion stopped where it is."""
    closed = [gripping(head, time) for head in heads]
    stopped = [
        PlantHead(head.column, head.tube, head.left, replace(head.condition, closed=one))
        for head, one in zip(heads, closed, strict=True)
    ]
    return replace(loom, work=None, between=loom.between or any(closed)), stopped


def _repaired(plant: PlantModel, loom: LoomCondition, heads: Heads) -> tuple[LoomCondition, Heads]:
    """Broken yarns pieced, empty packages replaced by full ones, sensors mended, axes at rest, faults gone."""
    wefts = tuple(rows or one.rows for rows, one in zip(loom.wefts, plant.setup.wefts, strict=True))
    rest = replace(
        loom, wefts=wefts, weft_broken=False, broken_warps=(), between=False, beater_back=True, shed_closed=True,
        slack=False, faulty=(),
    )  # fmt: skip
    return rest, [_mended(plant, index, head) for index, head in enumerate(heads)]


def _mended(plant: PlantModel, index: int, head: PlantHead) -> PlantHead:
    need = [plant.knot_yarn[yarn] if yarn < len(plant.knot_yarn) else 0 for yarn in head.condition.yarns]
    full = [max(one, 1000 * knot) for one, knot in zip(full_tubes(plant, index), need, strict=True)]
    left = tuple(one if one >= knot else new for one, knot, new in zip(head.left, need, full, strict=True))
    return replace(head, left=left, condition=replace(head.condition, broken=0, closed=False))


def _injected(plant: PlantModel, loom: LoomCondition, one: Injected | SensorFault) -> LoomCondition:
    if max(len(loom.injected), len(loom.faulty)) >= MOST_INJECTED:
        raise LoomError("a further fault", allowed=f"at most {MOST_INJECTED} that wait for their operation")
    if isinstance(one, Injected):
        if not isinstance(one.fault, Fault):
            raise LoomError(f"fault {one.fault}", allowed=", ".join(Fault))
        return replace(loom, injected=(*loom.injected, one))
    allowed = {*_SENSORS, *(f"grippers_open {index}" for index in range(plant.setup.heads))}
    if one.sensor not in allowed:
        raise LoomError(f"sensor {one.sensor!r}", allowed=", ".join(sorted(allowed)))
    return replace(loom, faulty=(*(old for old in loom.faulty if old.sensor != one.sensor), one))


_SENSORS = ("door_closed", "emergency_stop", "warp_tension", "heads_clear", "beater_back", "shed_closed",
            "knotted", "ended")  # fmt: skip


_OUTWARD = (LoomAxis.BEATER, LoomAxis.SHED)
"""Axes that leave their switch when they move forward."""


def _moved(loom: LoomCondition, heads: Heads, axis: str, *, forward: bool) -> tuple[LoomCondition, Heads]:
    """Forward: grippers open, heads retreat, beater and shed leave their rest; backward: the opposite."""
    if axis in ("grippers", *(f"gripper {index}" for index in range(len(heads)))):
        return loom, [
            replace(head, condition=replace(head.condition, closed=not forward))
            if axis in ("grippers", f"gripper {index}")
            else head
            for index, head in enumerate(heads)
        ]
    if axis == "heads":
        return replace(loom, between=not forward), heads
    if axis == "beater":
        return replace(loom, beater_back=not forward), heads
    if axis == "shed":
        return replace(loom, shed_closed=not forward), heads
    return loom, heads
