"""What feeds what in a loom: the mains, its motors by their amplifiers, supplies of direct current and what they feed.

    S = sum P / e of servos + sum of the loads of supplies over their efficiency,    I = S / (sqrt(3) U)

All motors at their rated power at once, e of `motor_loads`: no cyclogram is so hard, so that its duty is not counted.
"""

import math
from collections import Counter, defaultdict
from collections.abc import Iterator, Mapping
from types import MappingProxyType

from ilmek.elements.cabinet_devices import FANS, Fuse, PowerSupply, fuse_of, supply_for
from ilmek.elements.field_devices import CONTROLLER, RELAY, ROWS
from ilmek.elements.motor_loads import CONTROL_VOLTS, MAINS, PHASE, STEPPER_VOLTS, MotorLoad
from ilmek.elements.wiring import fuse_for
from ilmek.machines.automated_loom.equipment import signals
from ilmek.machines.weaver.tree import HEAD
from ilmek.part.part import Part
from ilmek.part.tree import Tree
from ilmek.records import record

COILS = frozenset(("holding brake", "solenoid", "clutch and brake"))
"""Processes of bought parts whose power is that of a coil on 24 V."""

_POWERS = {row.name: row.power for row in (*ROWS, *(fan for _, fan in FANS))}


@record
class MotorCircuit:
    """Motors of a part, by their sign in the plan: pieces, cables that lie together."""

    sign: str
    part: Part
    number: int
    together: int
    load: MotorLoad

    @property
    def section(self) -> float:
        """Section of its wires [mm²]."""
        return self.load.section(self.together)


@record
class Source:
    """Supplies of a voltage: id, row, how many stand side by side, load [W], ids of the parts that they feed."""

    part: str
    row: PowerSupply
    number: int
    load: float
    feeds: tuple[str, ...]

    @property
    def drawn(self) -> float:
        """Current that each draws from its phases at its rated power [A]."""
        volts = math.sqrt(3) * MAINS if self.row.phases == 3 else PHASE
        return self.row.rated / (self.row.efficiency * volts)

    @property
    def fused(self) -> Fuse:
        """The fuse of each of its phases."""
        return fuse_of(fuse_for(self.drawn, inrush=self.row.inrush), MAINS if self.row.phases == 3 else PHASE)


@record
class PowerPlan:
    """What feeds what: motors with their amplifiers, supplies of direct current, main fuses.

    protected  channels of the protector of 24 V: group of consumers and current of each [A]
    """

    motors: tuple[MotorCircuit, ...]
    steppers: Source | None
    control: Source
    protected: tuple[tuple[str, float], ...] = ()

    @property
    def sources(self) -> tuple[Source, ...]:
        """Of 24 V, and of 48 V where there are steppers."""
        return (self.control,) if self.steppers is None else (self.control, self.steppers)

    @property
    def connected(self) -> float:
        """Apparent power of all motors at their rated power, and of the supplies' loads [VA]."""
        servos = math.fsum(own.number * own.load.apparent for own in self.motors if own.load.volts >= PHASE)
        return servos + math.fsum(own.load / own.row.efficiency for own in self.sources)

    @property
    def phasing(self) -> Mapping[str, tuple[int, ...]]:
        """The phase 1, 2 or 3 of each piece that one phase feeds, by the id of its part: the largest first, each on the
        phase that has least.
        """
        pieces = [
            (own.load.drawn, own.part.id) for own in self.motors if own.load.volts == PHASE for _ in range(own.number)
        ]
        for own in self.sources:
            if own.row.phases == 1:
                each = own.load / (own.number * own.row.efficiency * PHASE)
                pieces += [(each, own.part)] * own.number
        currents, phases = [0.0, 0.0, 0.0], defaultdict[str, tuple[int, ...]](tuple)
        for current, name in sorted(pieces, reverse=True):
            phase = currents.index(min(currents))
            currents[phase] += current
            phases[name] += (phase + 1,)
        return phases

    @property
    def currents(self) -> tuple[float, float, float]:
        """Of the three phases of the mains [A]."""
        drawn = {own.part.id: own.load.drawn for own in self.motors}
        drawn |= {own.part: own.load / (own.number * own.row.efficiency * PHASE) for own in self.sources}
        three = math.fsum(own.number * own.load.drawn for own in self.motors if own.load.volts == MAINS)
        supplied = (own.load / own.row.efficiency for own in self.sources if own.row.phases == 3)
        three += math.fsum(supplied) / (math.sqrt(3) * MAINS)
        loads = [three, three, three]
        for name, phases in self.phasing.items():
            for phase in phases:
                loads[phase - 1] += drawn[name]
        first, second, third = loads
        return first, second, third

    @property
    def current(self) -> float:
        """Of the phase that has most [A]."""
        return max(self.currents)

    @property
    def main_fuse(self) -> float:
        """Rating of each of the three [A]."""
        return fuse_for(self.current)

    @property
    def fuses(self) -> Counter[Fuse]:
        """Fuses in the cabinet: main fuses, those of each amplifier, those of each supply."""
        fuses = Counter({fuse_of(self.main_fuse, MAINS): 3})
        for motor in self.motors:
            fuses[motor.load.fused] += motor.number * motor.load.poles
        for source in self.sources:
            fuses[source.fused] += source.number * source.row.phases
        return fuses

    @property
    def heat(self) -> float:
        """Heat in the cabinet, all at their rated power [W]."""
        amplifiers = math.fsum(own.number * own.load.loss for own in self.motors)
        control = CONTROLLER.power + 2 * RELAY.power
        return amplifiers + control + math.fsum(own.load * (1 / own.row.efficiency - 1) for own in self.sources)


def consumption(part: Part) -> float:
    """Power that a part draws at 24 V [W]; 0 of one that draws none."""
    bought = part.purchase
    if bought is None:
        return 0.0
    return bought.power if part.process in COILS else _POWERS.get(bought.row, 0.0)


def motor_circuits(tree: Tree, heads: int) -> tuple[MotorCircuit, ...]:
    """The circuits of all motors; the cables of those on a head lie together in its energy chain."""
    ridden = tree.carried_by(HEAD) if heads else ()
    on_head = {own.part.id for name in ridden for own in tree.body(name).occurrences}
    motors = [(part, part.purchase, number) for part, number in tree.occurrences() if part.purchase is not None]
    driving = [
        (part, MotorLoad(part.process, bought.power), number) for part, bought, number in motors if bought.drives
    ]
    together = sum(number // heads for part, _, number in driving if part.id in on_head)
    return tuple(
        MotorCircuit(f"M{sign}", part, number, together if part.id in on_head else 1, load)
        for sign, (part, load, number) in enumerate(driving, 1)
    )


def power_plan(tree: Tree, heads: int, more: Mapping[str, float] = MappingProxyType({})) -> PowerPlan:
    """What feeds the consumers of a loom's tree; more: power at 24 V of parts that are not in it yet, by their ids."""
    motors = motor_circuits(tree, heads)
    fed = [own for own in motors if own.load.volts == STEPPER_VOLTS]
    drawn = {part.id: number * consumption(part) for part, number in tree.occurrences() if consumption(part)}
    drawn |= more
    load = math.fsum(own.number * own.load.apparent for own in fed)
    processes = {part.id: part.process for part, _ in tree.occurrences()}
    return PowerPlan(
        motors,
        _source(signals.STEPPER_SUPPLY, STEPPER_VOLTS, load, tuple(own.part.id for own in fed)) if fed else None,
        _source(signals.SUPPLY, CONTROL_VOLTS, math.fsum(drawn.values()), tuple(drawn)),
        tuple(_protected(drawn, processes)),
    )


PROTECTED = 6.0
"""Rating of a channel of the protector of 24 V [A]."""


_IN_CABINET = frozenset(
    (signals.CONTROLLER, signals.INPUTS, signals.OUTPUTS, signals.ANALOG_INPUTS, signals.STRAIN_AMPLIFIER, signals.FAN)
)


def group_of(name: str, process: str) -> str:
    """The group of a consumer of 24 V, by its id and process, which channels of the protector feed."""
    if process in COILS:
        return "coils"
    if name in signals.IN_CABINET or process in {"interlock", "light grid"}:
        return "safety"
    return "control" if name in _IN_CABINET else "sensors"


def _protected(drawn: Mapping[str, float], processes: Mapping[str, str]) -> Iterator[tuple[str, float]]:
    """The channels of the protector, as many of a group as its current needs."""
    currents: dict[str, float] = defaultdict(float)
    for name, power in drawn.items():
        currents[group_of(name, processes.get(name, ""))] += power / CONTROL_VOLTS
    for group, current in currents.items():
        channels = math.ceil(current / PROTECTED - 1e-9)
        yield from ((group, current / channels) for _ in range(channels))


def _source(part: str, volts: float, load: float, feeds: tuple[str, ...]) -> Source:
    return Source(part, *supply_for(volts, load), load, feeds)
