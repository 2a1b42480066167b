"""A snapshot of the controller as values of the server's nodes, by path. None: the node has no value now."""

from ilmek.drivers.opcua.model import LOOM, LoomNameplate
from ilmek.drivers.opcua.states import MODE_NUMBERS, STATE_NUMBERS, item_state, nested_states, operation_mode
from ilmek.loom.control.view import Snapshot
from ilmek.records import value_record

MILLISECONDS = 1e-6
"""Milliseconds of a nanosecond."""

BLOCKS = f"{LOOM}.MachineryBuildingBlocks"
PACKML = f"{LOOM}.PackML"

NESTED = {
    f"{PACKML}.BaseStateMachine": "PackML:PackMLBaseStateMachineType",
    f"{PACKML}.BaseStateMachine.MachineState": "PackML:PackMLMachineStateMachineType",
    f"{PACKML}.BaseStateMachine.MachineState.ExecuteState": "PackML:PackMLExecuteStateMachineType",
}
"""The nested state machines of PackML, from the outermost, and their types."""

_BOBBIN = {"Weft": "name", "RowsLeft": "left"}


@value_record
class CurrentState:
    """The current state of a state machine: its type, by namespace and name, and the state's browse name."""

    machine: str
    name: str


def fixed_values(plate: LoomNameplate) -> dict[str, object]:
    """The values that do not change while the loom runs."""
    nameplate = f"{LOOM}.Identification"
    return {
        f"{nameplate}.Manufacturer": plate.manufacturer,
        f"{nameplate}.Model": plate.model,
        f"{nameplate}.SerialNumber": plate.serial,
        f"{nameplate}.ProductInstanceUri": plate.uri,
        f"{nameplate}.SoftwareRevision": plate.software,
        f"{LOOM}.Carpet.Programme": plate.programme,
        f"{LOOM}.Carpet.Title": plate.title,
        f"{LOOM}.Carpet.Rows": plate.rows,
        f"{LOOM}.Carpet.Columns": plate.columns,
        f"{PACKML}.PackMLVersion": "ISA-TR88.00.02-2022",
        f"{PACKML}.TagID": plate.serial,
        f"{PACKML}.Status.EquipmentBlocked": False,
    }


def snapshot_values(plate: LoomNameplate, snapshot: Snapshot) -> dict[str, object]:
    """The values that a snapshot gives."""
    yarn_empty = any("yarn" in alarm.name or "weft" in alarm.name for alarm in snapshot.alarms if alarm.stops)
    return {
        **_states(snapshot),
        **_carpet(snapshot),
        **_heads(plate, snapshot),
        **_yarn(plate, snapshot),
        **_alarms(snapshot),
        f"{PACKML}.Status.CurMachSpeed": 60.0 * snapshot.speed,
        f"{PACKML}.Status.MachSpeed": 60.0 * snapshot.speed,
        f"{PACKML}.Status.UnitModeCurrent": MODE_NUMBERS.get(snapshot.mode, 0),
        f"{PACKML}.Status.EquipmentStarved": yarn_empty or bool(snapshot.stop),
    }


def _states(snapshot: Snapshot) -> dict[str, object]:
    nested = zip(NESTED.items(), nested_states(snapshot.state), strict=True)
    machines = {
        f"{BLOCKS}.MachineryItemState": ("Machinery:MachineryItemState_StateMachineType", item_state(snapshot.state)),
        f"{BLOCKS}.MachineryOperationMode": (
            "Machinery:MachineryOperationModeStateMachineType",
            operation_mode(snapshot.mode),
        ),
        **{path: (machine, state) for (path, machine), state in nested},
    }
    return {
        f"{LOOM}.Status.State": snapshot.state,
        f"{LOOM}.Status.StateNumber": STATE_NUMBERS.get(snapshot.state, 0),
        f"{LOOM}.Status.Mode": snapshot.mode,
        f"{LOOM}.Status.ModeNumber": MODE_NUMBERS.get(snapshot.mode, 0),
        f"{LOOM}.Status.Commands": list(snapshot.commands),
        **{
            f"{path}.CurrentState": None if state is None else CurrentState(machine, state)
            for path, (machine, state) in machines.items()
        },
    }


def _carpet(snapshot: Snapshot) -> dict[str, object]:
    carpet = {
        "Row": snapshot.row,
        "Knots": snapshot.knots,
        "KnotsTotal": snapshot.total,
        "KnotsUncertain": snapshot.uncertain,
        "Faults": snapshot.faults,
        "LoomTime": snapshot.time * MILLISECONDS,
        "TimeLeft": snapshot.left * MILLISECONDS,
        "OperatorTask": snapshot.stop,
    }
    return {f"{LOOM}.Carpet.{name}": value for name, value in carpet.items()}


def _heads(plate: LoomNameplate, snapshot: Snapshot) -> dict[str, object]:
    heads: dict[str, object] = {}
    for number, head in enumerate(snapshot.heads):
        values = {
            "Column": head.column,
            "Tube": head.tube,
            "Yarn": _name(plate, head.yarn),
            "RowKnots": head.knots,
            "RowKnotsTied": head.tied,
            "NextYarn": _name(plate, head.next_yarn),
        }
        heads |= {f"{LOOM}.Heads.Head{number}.{name}": value for name, value in values.items()}
    return heads


def _yarn(plate: LoomNameplate, snapshot: Snapshot) -> dict[str, object]:
    found: dict[str, object] = {}
    for head in range(plate.heads):
        for tube in range(plate.tubes):
            found |= {f"{LOOM}.Heads.Head{head}.Tube{tube}.{name}": None for name in ("Yarn", "Left")}
    for package in snapshot.yarns:
        path = f"{LOOM}.Heads.Head{package.head}.Tube{package.tube}"
        found |= {f"{path}.Yarn": _name(plate, package.yarn), f"{path}.Left": package.left}
    for index, bobbin in enumerate(snapshot.wefts):
        found |= {f"{LOOM}.Bobbins.Bobbin{index}.{name}": getattr(bobbin, field) for name, field in _BOBBIN.items()}
    return found


def _alarms(snapshot: Snapshot) -> dict[str, object]:
    path = f"{LOOM}.Alarms"
    return {
        f"{path}.Count": len(snapshot.alarms),
        f"{path}.Names": [alarm.name for alarm in snapshot.alarms],
        f"{path}.Causes": [alarm.cause for alarm in snapshot.alarms],
        f"{path}.Remedies": [alarm.remedy for alarm in snapshot.alarms],
        f"{path}.Stops": [alarm.stops for alarm in snapshot.alarms],
    }


def _name(plate: LoomNameplate, yarn: int | None) -> str | None:
    return None if yarn is None or not 0 <= yarn < len(plate.yarns) else plate.yarns[yarn]
