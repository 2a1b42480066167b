"""Terminals and inputs in the cabinet of a loom, from the signals of its control and the devices that it has.

    X1  signals of devices outside of the cabinet: those of the program, then those that the motion controller reads
    X2  24 V and 0 V of each piece outside that draws them
    X3  both channels of the safety devices, there and back; reset; enabling switch

Leads of motors, of their brakes and encoders, of solenoids and of the strain transducer go to their amplifiers whole:
they are screened. An encoder is fed by its amplifier, a yarn sensor by its module on the head.
"""

from collections.abc import Iterator, Mapping
from itertools import groupby

from ilmek.elements.field_devices import CHANNELS
from ilmek.machines.automated_loom.equipment import signals
from ilmek.machines.automated_loom.equipment.power_plan import COILS, consumption
from ilmek.machines.automated_loom.equipment.signals import Signal
from ilmek.part.tree import Tree
from ilmek.records import record

ANALOG_CHANNELS = 4
"""Inputs of an analog module."""

_CHANNELS = ("1+", "1-", "2+", "2-")
_SAFE = {
    **dict.fromkeys((signals.STOP, signals.BENCH_STOP, signals.INTERLOCK, signals.GRID, signals.HANDS), _CHANNELS),
    signals.RESET: ("+", "-"),
    signals.ENABLING: _CHANNELS,
}
"""Wires of a piece of the safety circuit: there and back of its channels."""

_FED_BESIDES = frozenset((*signals.ENCODED, signals.YARN_STOP))


@record
class TerminalLevel:
    """A level of a terminal: strip, number and level on it; signal or potential; id of the device, and its piece.

    piece  from 1; 0: all of them, in series
    """

    strip: str
    number: int
    level: str
    what: str
    part: str
    piece: int

    @property
    def address(self) -> str:
        """As written beside a wire.

        >>> TerminalLevel("X1", 2, "a", "HeadsClear", "", 0).address
        'X1:2a'
        """
        return f"{self.strip}:{self.number}{self.level}"


@record
class ModuleInput:
    """An input of a module in the cabinet: id of its kind of module, index among all of these from 0; the signal of the
    program, or that which the motion controller reads; id of the device and its piece, 0: all.
    """

    module: str
    index: int
    signal: str
    part: str
    piece: int

    @property
    def channels(self) -> int:
        """Inputs of a module."""
        return ANALOG_CHANNELS if self.module == signals.ANALOG_INPUTS else CHANNELS


def module_inputs(own: tuple[Signal, ...], numbers: Mapping[str, int]) -> tuple[ModuleInput, ...]:
    """The inputs in the cabinet: of signals with a wire, then of what the controller reads; numbers of parts by ids."""
    wired = [
        (signals.ANALOG_INPUTS if name in signals.ANALOG else signals.INPUTS, name, parts[0], _piece(name))
        for name, parts in _wired(own, numbers)
    ]
    wired += [
        (own.module, name, own.part, index * own.share + 1)
        for own in signals.READ
        if own.module == signals.INPUTS
        for index, name in enumerate(own.elements(1 if own.part in signals.IN_CABINET else numbers.get(own.part, 0)))
    ]
    used: dict[str, int] = {}
    inputs = []
    for module, name, part, piece in wired:
        inputs.append(ModuleInput(module, used.setdefault(module, 0), name, part, piece))
        used[module] += 1
    return tuple(inputs)


def _wired(own: tuple[Signal, ...], numbers: Mapping[str, int]) -> Iterator[Signal]:
    """The signals that come over a wire from a device that is there."""
    for name, parts in own:
        device = signals.TENSION if parts[0] == signals.STRAIN_AMPLIFIER else parts[0]
        if parts[0] != signals.CONTROLLER and device in numbers:
            yield name, parts


def _piece(name: str) -> int:
    """The piece of a signal that each of several has; else 0."""
    _, bracket, index = name.partition("[")
    return int(index.rstrip("]")) + 1 if bracket else 0


def terminal_levels(own: tuple[Signal, ...], tree: Tree) -> tuple[TerminalLevel, ...]:
    """The levels of all terminals; tree: all bodies but those of the circuit."""
    numbers = {part.id: number for part, number in tree.occurrences()}
    levels = []
    for strip, wires in groupby(_wires(own, tree, numbers), key=lambda wire: wire[0]):
        for index, (_, what, part, piece) in enumerate(wires):
            levels.append(TerminalLevel(strip, index // 2 + 1, "ab"[index % 2], what, part, piece))
    return tuple(levels)


def terminals(levels: tuple[TerminalLevel, ...]) -> int:
    """Terminals of two levels for so many levels."""
    return len({(level.strip, level.number) for level in levels})


def _wires(own: tuple[Signal, ...], tree: Tree, numbers: Mapping[str, int]) -> Iterator[tuple[str, str, str, int]]:
    """Strip, signal or potential, part, piece, in the order of the terminals."""
    for wire in module_inputs(own, numbers):
        if wire.part not in {*signals.IN_CABINET, signals.STRAIN_AMPLIFIER}:
            yield "X1", wire.signal, wire.part, wire.piece
    fed = [own.id for own, _ in tree.occurrences() if consumption(own) and own.process not in COILS]
    for part in (*(own for own in fed if own not in _FED_BESIDES), *signals.SWITCHED):
        for piece in range(1, numbers.get(part, 0) + 1):
            yield from (("X2", volts, part, piece) for volts in ("24 V", "0 V"))
    for name, wires in _SAFE.items():
        for piece in range(1, numbers.get(name, 0) + 1):
            yield from (("X3", wire, name, piece) for wire in wires)
