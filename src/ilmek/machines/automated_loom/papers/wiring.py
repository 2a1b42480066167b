"""How a loom is wired: signs of its devices, what feeds each consumer, where sensors and brakes are connected."""

from collections.abc import Iterator, Mapping, Sequence

from ilmek.elements.field_devices import CHANNELS
from ilmek.elements.motor_loads import CONTROL_VOLTS, MAINS, PHASE
from ilmek.machines.automated_loom.design import LoomDesign
from ilmek.machines.automated_loom.equipment import signals
from ilmek.machines.automated_loom.equipment.power_plan import PowerPlan, consumption, power_plan
from ilmek.machines.automated_loom.equipment.signals import signals_of
from ilmek.machines.automated_loom.in_space.scene import loom_tree
from ilmek.part.catalogue import brakes_of
from ilmek.part.part import Bought, Part
from ilmek.records import record

SENSING = frozenset(("sensor", "load cell", "yarn sensor", "light barrier"))
"""Processes of sensors."""

SIGNS: Mapping[str, str] = {
    signals.CONTROLLER: "A1",
    signals.INPUTS: "A2",
    signals.YARN_INPUTS: "A3",
    signals.OUTPUTS: "A4",
    signals.STRAIN_AMPLIFIER: "N1",
    signals.SUPPLY: "G1",
    signals.STEPPER_SUPPLY: "G2",
    signals.BRAKING: "R1",
    signals.PROTECTOR: "F24",
    signals.SWITCH: "Q1",
    signals.RELAY: "K1",
    signals.RESET: "S0",
    signals.ENABLING: "S9",
    signals.TERMINAL: "X1",
    signals.FAN: "E1",
}
"""Signs of devices that a loom has one kind of: IEC 81346-2."""


def plan_of(loom: LoomDesign) -> PowerPlan:
    """What feeds what in a loom."""
    return power_plan(loom_tree(loom), loom.heads)


def braked(loom: LoomDesign) -> dict[str, str]:
    """Sign of the brake of each motor that has one, by the motor's id."""
    return {motor: brake for motor, brake, _ in brakes(loom)}


def brakes(loom: LoomDesign) -> Iterator[tuple[str, str, Part]]:
    """The brakes: id of the motor, sign, part."""
    tree = loom_tree(loom)
    behind = {motor: part for body in tree.bodies for motor, part in brakes_of(body).items()}
    return (
        (one.part.id, f"Y{one.sign[1:]}", behind[one.part.id]) for one in plan_of(loom).motors if one.part.id in behind
    )


def bought_of(part: Part) -> Bought:
    """The purchase of a bought part."""
    assert part.purchase is not None
    return part.purchase


def numbers_of(loom: LoomDesign) -> dict[str, int]:
    """Pieces of each part, by its id."""
    return {part.id: number for part, number in loom_tree(loom).occurrences()}


@record
class Feed:
    """A consumer: id of its part, pieces, voltage [V] and power of all [W]; sign of what feeds it, and what that gives.

    source  id of the part that feeds it; "": the mains
    """

    part: Part
    number: int
    volts: float
    power: float
    source: str
    given: float

    @property
    def sign(self) -> str:
        """Of what feeds it."""
        return SIGNS.get(self.source, "F0")


def feeds(loom: LoomDesign) -> Iterator[Feed]:
    """Every consumer of a loom with its voltage, and what feeds it."""
    plan = plan_of(loom)
    fed = {name: source for source in plan.sources for name in source.feeds}
    for motor in plan.motors:
        source, load = fed.get(motor.part.id), motor.load
        given = source.row.volts if source else MAINS if load.poles == 3 else PHASE  # a phase and N
        yield Feed(
            motor.part, motor.number, load.volts, motor.number * load.apparent, source.part if source else "", given
        )
    driven = {motor.part.id for motor in plan.motors}
    for part, number in loom_tree(loom).occurrences():
        if consumption(part) and part.id not in driven:
            source = fed[part.id]
            yield Feed(part, number, CONTROL_VOLTS, number * consumption(part), source.part, source.row.volts)


def signs_of(loom: LoomDesign) -> dict[str, str]:
    """Signs of the sensors by their ids."""
    sensors = [part.id for part, _ in loom_tree(loom).occurrences() if part.process in SENSING]
    return {part: f"B{number}" for number, part in enumerate(sensors, 101)}


def channels(loom: LoomDesign) -> Iterator[tuple[str, int, str, int]]:
    """Each input of a module that reads a sensor: sign of the module, input, id of the sensor, which of its pieces."""
    numbers, used = numbers_of(loom), 0
    for name, share in signals.READ.items():
        for piece in range(1, numbers.get(name, 0) + 1, share):
            yield f"{SIGNS[signals.INPUTS]}.{used // CHANNELS + 1}", used % CHANNELS + 1, name, piece
            used += 1
    each = numbers.get(signals.YARN_STOP, 0) // max(loom.heads, 1)
    modules = numbers.get(signals.YARN_INPUTS, 0) // max(loom.heads, 1)
    for head in range(loom.heads if each else 0):
        for yarn in range(each):
            module = head * modules + yarn // CHANNELS + 1
            piece = head * each + yarn + 1
            yield f"{SIGNS[signals.YARN_INPUTS]}.{module}", yarn % CHANNELS + 1, signals.YARN_STOP, piece


def connected_at(loom: LoomDesign) -> dict[str, str]:
    """Where each sensor is connected, by its id: a terminal, inputs of a module, or what reads it."""
    first = dict[str, list[str]]()
    for _, number, level, parts in terminal_rows(loom):
        for part in parts.split()[:1]:
            first.setdefault(part, []).append(f"X1:{number}{level}")
    at = {part: _addresses(own) for part, own in first.items()}
    motors = {one.part.id: one.sign for one in plan_of(loom).motors}
    at |= {
        name: f"T{motors[motor][1:]}"
        for name, offered in signals.ENCODED.items()
        for motor in offered
        if motor in motors
    }
    for module, _, name, _ in channels(loom):
        at[name] = module.partition(".")[0]
    return at | {signals.TENSION: SIGNS[signals.STRAIN_AMPLIFIER]}  # whose output is at a terminal


def _addresses(own: Sequence[str]) -> str:
    return ", ".join(own) if len(own) < _MANY else f"{own[0]} … {own[-1]}"


_MANY = 3


def terminal_rows(loom: LoomDesign) -> Iterator[tuple[str, int, str, str]]:
    """Each signal of the control with an address: its name, its terminal and level, its parts."""
    there = numbers_of(loom)
    for number, (name, parts) in enumerate(signals_of(loom.heads, loom.weavers)):
        yield name, number // 2 + 1, "ab"[number % 2], " ".join(part for part in parts if part in there)


def run_of(numbers: Sequence[int]) -> str:
    """A run of numbers in words."""
    return f"{numbers[0]}" if len(numbers) == 1 else f"{numbers[0]} … {numbers[-1]}"
