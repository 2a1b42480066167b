"""State of the loom as a plant, and what acts on it: orders, an operator, faults."""

from typing import TypeAlias

from ilmek.loom.control.ports import ChangePackages, EndRow, Fault, Home, Jog, Order, Sensors, Tie
from ilmek.loom.operations import EMPTY, RowEnd, Stop
from ilmek.loom.twin.model import OPEN_SHED, SLACK, PlantModel, nanometres
from ilmek.records import value_record

NOWHERE = -1
"""Column and tube of a head before its first knot in the carpet."""


@value_record
class Door:
    """The door of the guard is opened or closed."""

    closed: bool


@value_record
class EmergencyStop:
    """The emergency stop is pressed, which halts the loom, or released."""

    pressed: bool


@value_record
class Repaired:
    """The operator has pieced broken yarns, replaced empty packages, mended sensors, brought all axes to their rest."""


@value_record
class PackageChanged:
    """The operator has changed packages, out of the programme's order."""

    stop: Stop


@value_record
class Tension:
    """The mean tension of the warps falls, or is restored."""

    low: bool


@value_record
class Injected:
    """The next attempt at an operation of a row fails: the knot of a column, or an operation after the knots.

    column     NOWHERE, without an operation: the next operation of the row that the fault can strike
    operation  after the knots; None: a knot
    """

    fault: Fault
    row: int
    column: int = NOWHERE
    operation: RowEnd | None = None


@value_record
class SensorFault:
    """A sensor answers `value` whatever is true; None: it does not answer.

    sensor  a name of `Sensors`, of a list with an index ("grippers_open 2"), "knotted" or "ended"
    """

    sensor: str
    value: bool | float | None


@value_record
class SetSpeed:
    """Speed of the operations that begin from now on, in thousandths of the programme's."""

    permille: int


@value_record
class PowerOn:
    """The loom starts: its sensors report."""


@value_record
class Halt:
    """Every motion stops at once."""


Act: TypeAlias = Door | EmergencyStop | Repaired | PackageChanged | Tension | Injected | SensorFault
"""What an operator does, and what goes wrong."""

PlantInput: TypeAlias = Order | Act | SetSpeed | PowerOn | Halt


@value_record
class HeadCondition:
    """What seldom changes of a head.

    yarns     in its tubes                    broken  tubes of which the yarn is broken, as bits
    attempts  at one knot that failed         closed  the gripper was closed on warps when it was halted
    """

    yarns: tuple[int, ...]
    attempts: int = 0
    closed: bool = False
    broken: int = 0


@value_record
class PlantHead:
    """A head.

    column, tube  of its last knot            left   yarn in each tube [nm]
    order         in progress                 grip   when the gripper closes [ns]
    end           of the order [ns]           fault  how it will end
    """

    column: int
    tube: int
    left: tuple[int, ...]
    condition: HeadCondition
    order: Tie | None = None
    grip: int = 0
    end: int = 0
    fault: Fault | None = None


@value_record
class LoomWork:
    """An operation of the whole loom in progress.

    marks  changes of sensors that are still to come: time [ns], sensor, value
    """

    order: EndRow | ChangePackages | Jog | Home
    end: int
    fault: Fault | None
    marks: tuple[tuple[int, str, bool], ...]


@value_record
class LoomCondition:
    """What seldom changes of a loom.

    wefts     rows that each bobbin still lasts            weft_broken, broken_warps  columns of the latter
    work      of the whole loom in progress                attempts  that failed, of one operation after a row
    between   heads were halted among the warps            slack     the warps' tension is low
    permille  speed of operations that begin               faulty    sensors that do not answer what is true
    injected  faults to come
    """

    wefts: tuple[int, ...]
    weft_broken: bool = False
    broken_warps: tuple[int, ...] = ()
    work: LoomWork | None = None
    attempts: int = 0
    door_closed: bool = True
    emergency_stop: bool = False
    between: bool = False
    beater_back: bool = True
    shed_closed: bool = True
    slack: bool = False
    permille: int = 1000
    faulty: tuple[SensorFault, ...] = ()
    injected: tuple[Injected, ...] = ()


@value_record
class PlantState:
    """The loom at a time [ns].

    shown  the last report of the sensors showed a head among the warps
    digest of all reports, one after the other
    """

    time: int
    heads: tuple[PlantHead, ...]
    condition: LoomCondition
    shown: bool = False
    digest: bytes = bytes(32)


def first_state(plant: PlantModel) -> PlantState:
    """The loom before the carpet: full packages, all axes at rest, door closed."""
    heads = tuple(
        PlantHead(NOWHERE, NOWHERE, full_tubes(plant, head), HeadCondition(tuple(plant.setup.loading[head].tolist())))
        for head in range(plant.setup.heads)
    )
    return PlantState(0, heads, LoomCondition(tuple(weft.rows for weft in plant.setup.wefts)))


def full_tubes(plant: PlantModel, head: int) -> tuple[int, ...]:
    """Yarn in each tube of a head when the carpet begins [nm]."""
    loaded = zip(plant.setup.loading[head].tolist(), plant.setup.packages[head].tolist(), strict=True)
    return tuple(0 if yarn == EMPTY else nanometres(length) for yarn, length in loaded)


def gripping(head: PlantHead, time: int) -> bool:
    """Whether a head's gripper is closed on warps: during the knot after its travel, and after a halt in it."""
    return head.condition.closed or (head.order is not None and head.grip <= time)


def sensors_of(plant: PlantModel, state: PlantState) -> Sensors:
    """What the sensors show."""
    loom = state.condition
    closed = [gripping(head, state.time) for head in state.heads]
    top, bottom = SLACK if loom.slack else (1, 1) if loom.shed_closed else OPEN_SHED
    answers: dict[str, bool | float | None] = {fault.sensor: fault.value for fault in loom.faulty}
    tension = answers.get("warp_tension", plant.tension * top // bottom / 1000)
    return Sensors(
        door_closed=bool(answers.get("door_closed", loom.door_closed)),
        emergency_stop=bool(answers.get("emergency_stop", loom.emergency_stop)),
        warp_tension=None if tension is None else float(tension),
        grippers_open=tuple(bool(answers.get(f"grippers_open {index}", not one)) for index, one in enumerate(closed)),
        heads_clear=bool(answers.get("heads_clear", not loom.between and not any(closed))),
        beater_back=bool(answers.get("beater_back", loom.beater_back)),
        shed_closed=bool(answers.get("shed_closed", loom.shed_closed)),
    )


def next_instant(state: PlantState) -> int | None:
    """The next time at which something ends or a sensor changes [ns]; None: nothing is in progress."""
    found = [head.end for head in state.heads if head.order is not None]
    work = state.condition.work
    if work is not None:
        found.append(work.marks[0][0] if work.marks else work.end)
    return min(found, default=None)
