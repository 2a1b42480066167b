"""How a loom is wired: signs of its devices, what feeds each consumer, where sensors and brakes are connected."""

from collections.abc import Iterator, Mapping, Sequence

from ilmek.elements.field_devices import CHANNELS
from ilmek.elements.motor_loads import CONTROL_VOLTS, MAINS, PHASE
from ilmek.machines.automated_loom.design import LoomDesign
from ilmek.machines.automated_loom.equipment import signals
from ilmek.machines.automated_loom.equipment.power_plan import PowerPlan, consumption, power_plan
from ilmek.machines.automated_loom.equipment.site import site_of
from ilmek.machines.automated_loom.equipment.terminals import TerminalLevel, module_inputs, terminal_levels
from ilmek.machines.automated_loom.equipment.tree import without_circuit
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
    signals.ANALOG_INPUTS: "A5",
    signals.STRAIN_AMPLIFIER: "N1",
    signals.SUPPLY: "G1",
    signals.STEPPER_SUPPLY: "G2",
    signals.BRAKING: "R1",
    signals.PROTECTOR: "F24",
    signals.SWITCH: "Q1",
    signals.RELAY: "K1",
    signals.GUARD_RELAY: "K2",
    signals.MODE: "S8",
    signals.RESET: "S0",
    signals.ENABLING: "S9",
    signals.TERMINAL: "X1",
    signals.MAINS_TERMINAL: "X0",
    signals.FAN: "E1",
    signals.PROTECTIVE_BAR: "PE",
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


@record
class Channel:
    """An input of a module: sign of the module, input, its variable, id of the device, its piece."""

    module: str
    number: int
    signal: str
    part: str
    piece: int

    @property
    def address(self) -> str:
        """Module and input."""
        return f"{self.module}:{self.number}"


_SAFETY = {
    signals.STOP: "S", signals.BENCH_STOP: "S", signals.INTERLOCK: "B", signals.GRID: "B", signals.HANDS: "H",
}  # fmt: skip


def safety_signs(loom: LoomDesign) -> dict[str, str]:
    """Letter of the signs of what starts a safety function, by the ids of the parts."""
    return {part: f"{sign}1 …" for part, sign in _SAFETY.items() if part in numbers_of(loom)}


def channels(loom: LoomDesign) -> Iterator[Channel]:
    """Each input of a module in the cabinet, then on the heads."""
    numbers = numbers_of(loom)
    for wire in module_inputs(site_of(loom).signals, numbers):
        module = f"{SIGNS[wire.module]}.{wire.index // wire.channels + 1}"
        yield Channel(module, wire.index % wire.channels + 1, wire.signal, wire.part, wire.piece)
    each = numbers.get(signals.YARN_STOP, 0) // max(loom.heads, 1)
    modules = numbers.get(signals.YARN_INPUTS, 0) // max(loom.heads, 1)
    (yarns,) = (own for own in signals.READ if own.part == signals.YARN_STOP)
    for index, name in enumerate(yarns.elements(numbers.get(signals.YARN_STOP, 0))):
        head, yarn = divmod(index, each)
        module = f"{SIGNS[signals.YARN_INPUTS]}.{head * modules + yarn // CHANNELS + 1}"
        yield Channel(module, yarn % CHANNELS + 1, name, signals.YARN_STOP, index + 1)


def levels_of(loom: LoomDesign) -> tuple[TerminalLevel, ...]:
    """The levels of the terminals of a loom."""
    return terminal_levels(site_of(loom).signals, without_circuit(loom))


def connected_at(loom: LoomDesign) -> dict[str, str]:
    """Where each sensor is connected, by its id: inputs of a module, or what reads it."""
    inputs = dict[str, list[str]]()
    for channel in channels(loom):
        inputs.setdefault(channel.part, []).append(channel.address)
    at = {part: listed(own) for part, own in inputs.items()}
    motors = {one.part.id: one.sign for one in plan_of(loom).motors}
    at |= {
        name: f"T{motors[motor][1:]}"
        for name, offered in signals.ENCODED.items()
        for motor in offered
        if motor in motors
    }
    return at | {signals.TENSION: SIGNS[signals.STRAIN_AMPLIFIER]}  # whose output is at an analog input


def listed(own: Sequence[str]) -> str:
    """Names or addresses in words, of many the first and the last.

    >>> listed(["A2.1:1", "A2.1:2"]), listed(["A2.1:1", "A2.1:2", "A2.1:3"])
    ('A2.1:1, A2.1:2', 'A2.1:1 … A2.1:3')
    """
    return ", ".join(own) if len(own) < _MANY else f"{own[0]} … {own[-1]}"


_MANY = 3


def signal_rows(loom: LoomDesign) -> Iterator[tuple[str, str, str, str]]:
    """Each signal of the control with an address: its name, its input or A1, its terminal or "", its parts."""
    there = numbers_of(loom)
    inputs = {own.signal: own.address for own in channels(loom)}
    levels = {own.what: own.address for own in levels_of(loom)}
    read = ((name, (own.part, own.module)) for name, own in read_signals(loom))
    for name, parts in (*site_of(loom).signals, *read):
        shown = " ".join(part for part in parts if part in there)
        yield name, inputs.get(name, SIGNS[signals.CONTROLLER]), levels.get(name, ""), shown


def read_signals(loom: LoomDesign) -> tuple[tuple[str, signals.DeviceSignal], ...]:
    """Each variable that the motion controller reads besides those of the program, in the order of their inputs."""
    read = {own.name: own for own in signals.READ}
    variables = (own.signal for own in channels(loom))
    return tuple((name, own) for name in variables for own in [read.get(name.partition("[")[0])] if own)


def run_of(items: Sequence[int | str]) -> str:
    """A run of numbers or names in words."""
    return f"{items[0]}" if len(items) == 1 else f"{items[0]} … {items[-1]}"
