"""Diagrams of a loom's electrical plan: supply and motors in a single line, and the two channels of its safety circuit.

Signs of devices: IEC 81346-2; symbols: IEC 60617. Positions in mm: x to the right, y up.
"""

from collections.abc import Generator, Iterator, Sequence

import numpy as np

from ilmek.arrays import ComplexArray
from ilmek.records import record
from ilmek.report.sheet import LineKind, Schematic, SheetLine, SheetText
from ilmek.sentences import Sentence

Mark = SheetLine | SheetText

_PITCH, _BUS, _FUSE, _DRIVE, _MOTOR, _WORDS = 13.0, -16.0, -8.0, 28.0, 82.0, 89.0
"""Distance of two rows, and x of busbar, fuse, amplifier, motor, words [mm]."""


def _line(*points: complex, kind: LineKind = LineKind.VISIBLE) -> SheetLine:
    return SheetLine(kind, np.array(points))


def _box(corner: complex, size: complex, kind: LineKind = LineKind.VISIBLE) -> SheetLine:
    corners: ComplexArray = corner + np.array([0, size.real, size, 1j * size.imag])
    return SheetLine(kind, corners, closed=True)


def _circle(centre: complex, radius: float) -> SheetLine:
    return SheetLine(LineKind.VISIBLE, centre + radius * np.array([1.0, -1.0]), np.ones(2), closed=True)


def _text(position: complex, words: str, height: float = 2.2, anchor: str = "center") -> SheetText:
    return SheetText(position, words, height, anchor)


def _schematic(name: str, title: str, marks: Iterator[Mark]) -> Schematic:
    drawn = tuple(marks)
    lines = tuple(mark for mark in drawn if isinstance(mark, SheetLine))
    return Schematic(name, title, lines, tuple(mark for mark in drawn if isinstance(mark, SheetText)))


def _fuse(at: complex, words: str) -> Iterator[Mark]:
    """A fuse in a level line, from `at` 8 mm to the right."""
    yield _box(at - 1.5j, 8 + 3j)
    yield _line(at, at + 8)
    yield _text(at + 4 + 2.5j, words)


def _switch(at: complex, words: str, *, closed: bool) -> Iterator[Mark]:
    """A contact in a level line, from `at` 8 mm to the right, at rest; closed: it opens when it is actuated."""
    yield _line(at, at + 8 + (-2j if closed else 2.5j))
    if closed:
        yield _line(at + 8, at + 8 - 2.4j)
    yield _line(at + 4 + (-1j if closed else 1.2j), at + 4 + 3.5j, kind=LineKind.HIDDEN)
    yield _text(at + 4 + 4.2j, words)


@record
class MotorRow:
    """Motor circuits of a kind in words: their number, pieces, phases of the motor, fuse, amplifier, wire, motor, its
    power. Each piece has its own fuse, amplifier and cable, drawn once.
    """

    number: str
    pieces: int
    kind: str
    fuse: str
    drive: str
    wire: str
    motor: str
    power: str

    def sign(self, letter: str) -> str:
        """Signs of the devices of a kind.

        >>> MotorRow("3", 38, "3~", "", "", "", "", "").sign("T")
        'T3.1 … T3.38'
        """
        own = f"{letter}{self.number}"
        return own if self.pieces == 1 else f"{own}.1 … {own}.{self.pieces}"


@record
class FedRow:
    """Supplies of direct current in words: sign, fuse, rating, what they give; the motor circuits on their bar."""

    sign: str
    fuse: str
    rating: str
    given: str
    rows: Sequence[MotorRow]


def single_line(mains: str, feed: str, servos: Sequence[MotorRow], supplies: Sequence[FedRow]) -> Schematic:
    """Mains, switch, fuse, busbar; of each motor circuit fuse, amplifier, wire, motor; supplies with their own bars."""

    def marks() -> Iterator[Mark]:
        yield _text(-72 + 2.5j, mains, anchor="left")
        yield _line(-72, -50)
        yield from _switch(-50 + 0j, "Q1", closed=False)
        yield _line(-42, -34)
        yield from _fuse(-34 + 0j, f"F0: {feed}")
        yield _line(-26, _BUS)
        low = -_PITCH * (len(servos) + len(supplies))
        yield SheetLine(LineKind.FRAME, np.array([complex(_BUS, 4), complex(_BUS, low - 4)]))
        for number, row in enumerate(servos, 1):
            yield from _motor(row, -_PITCH * number)
        below = low
        for number, own in enumerate(supplies, len(servos) + 1):
            y = -1j * _PITCH * number
            yield _line(_BUS + y, _FUSE + y)
            yield from _fuse(_FUSE + y, f"F{own.sign}: {own.fuse}")
            yield _line(_FUSE + 8 + y, _DRIVE + y)
            yield _box(_DRIVE + y - 4j, 26 + 8j)
            yield _text(_DRIVE + 13 + y + 0.6j, own.sign)
            yield _text(_DRIVE + 13 + y - 2.8j, own.rating)
            yield _line(_DRIVE + 26 + y, _WORDS - 2 + y)
            yield _text(_WORDS + y - 1j, own.given, anchor="left")
            if own.rows:
                # From the end of the line down, and back to the bar of its motors.
                bar, x = below - 1.2 * _PITCH, _WORDS - 12 - 3 * (number - len(servos))
                yield _line(x + y, complex(x, bar), complex(_BUS, bar))
                yield _text(complex(_BUS + 2, bar + 1.2), own.given, anchor="left")
                below = bar - _PITCH * len(own.rows)
                yield SheetLine(LineKind.FRAME, np.array([complex(_BUS, bar + 2), complex(_BUS, below - 4)]))
                for index, row in enumerate(own.rows, 1):
                    yield from _motor(row, bar - _PITCH * index)

    return _schematic("single-line", Sentence("electric.single-line"), marks())


def _motor(row: MotorRow, height: float) -> Iterator[Mark]:
    """A motor circuit from its busbar: fuse, amplifier, wire, motor."""
    y = 1j * height
    yield _line(_BUS + y, _FUSE + y)
    yield from _fuse(_FUSE + y, "")
    yield _text(_BUS + 1.5 + y + 2.5j, f"{row.sign('F')}: {row.fuse}", anchor="left")
    yield _line(_FUSE + 8 + y, _DRIVE + y)
    yield _box(_DRIVE + y - 4j, 26 + 8j)
    yield _text(_DRIVE + 13 + y + 0.6j, row.sign("T"))
    yield _text(_DRIVE + 13 + y - 2.8j, row.drive)
    yield _line(_DRIVE + 26 + y, _MOTOR - 4.5 + y)
    yield _text((_DRIVE + 26 + _MOTOR - 4.5) / 2 + y + 1.2j, row.wire)
    yield _circle(_MOTOR + y, 4.5)
    yield _text(_MOTOR + y + 0.4j, "M")
    yield _text(_MOTOR + y - 3j, row.kind)
    yield _text(_WORDS + y + 0.5j, f"{row.sign('M')}: {row.motor}", anchor="left")
    yield _text(_WORDS + y - 3j, row.power, anchor="left")


@record
class SafeSwitch:
    """Devices of a kind with two channels: letter or sign, pieces, terminals."""

    sign: str
    number: int
    terminals: str

    @property
    def shown(self) -> tuple[int, ...]:
        """The pieces that are drawn: of many the first two and the last."""
        return tuple(range(1, self.number + 1)) if self.number <= _DRAWN else (1, 2, self.number)


@record
class SafeRelay:
    """A safety relay: sign, the devices in series in both of its channels, input of its contact."""

    sign: str
    switches: Sequence[SafeSwitch]
    halt: str


_DRAWN = 4
"""Devices of a kind that are drawn; of more, the first two and the last."""

_CHANNEL, _GUARDS, _RELAY_BOX = -30j, -74j, 30 + 46j
"""The second channel from the first, those of the guards from those of the stops, size of a relay [mm]."""


def safety_circuit(
    stops: SafeRelay, guards: SafeRelay, enabling: SafeSwitch, mode: SafeSwitch, reset: SafeSwitch, *, amplifiers: int
) -> Schematic:
    """Emergency stops on a relay of their own; guards, or the enabling device at setting, on the other; what they open.

    The contacts of both relays are in series: an emergency stop acts at setting too, and the enabling device is beside
    the guards alone. The mode selector takes the contacts of one or the other, and limits the speed at setting.
    amplifiers  pieces
    """

    def marks() -> Iterator[Mark]:
        end = 12.0 + 12 * max(
            sum(len(own.shown) + (own.number > _DRAWN) for own in one.switches) for one in (stops, guards)
        )
        x = end + 26
        for relay, origin in ((stops, 0j), (guards, _GUARDS)):
            for channel in (0, 1):
                y = origin + channel * _CHANNEL
                yield _text(y + 2.5j, f"24 V, {channel + 1}", anchor="left")
                reached = yield from _series(relay.switches, y, words=channel == 1)
                into = x + y.imag * 1j
                if relay is guards:
                    yield from _modes(end, y, reached, f".{channel + 1}", (enabling, mode))
                    yield _line(end + 22 + y, into)
                else:
                    yield _line(reached + y, into)
            yield from _relay(x, origin, relay, reset)
        yield from _outputs(x + _RELAY_BOX.real, stops, guards, amplifiers)
        yield from _speed(x, mode)

    return _schematic("safety-circuit", Sentence("electric.safety"), marks())


def _series(switches: Sequence[SafeSwitch], y: complex, *, words: bool) -> Generator[Mark, None, float]:
    """The contacts of a channel in series, with their terminals below; x of its end."""
    yield _line(y, 12 + y)
    x = 12.0
    for row in switches:
        begin = x
        for before, index in zip((0, *row.shown), row.shown, strict=False):
            if index > before + 1:
                yield _text(x + 6 + y + 1.2j, "…", 4.0)
                yield _line(x + y, x + 12 + y, kind=LineKind.HIDDEN)
                x += 12
            yield from _switch(x + y, f"{row.sign}{index}", closed=True)
            yield _line(x + 8 + y, x + 12 + y)
            x += 12
        if words:
            yield _text((begin + x) / 2 + y - 6j, row.terminals, 1.8)
    return x


def _modes(
    end: float, y: complex, reached: float, channel: str, setting: tuple[SafeSwitch, SafeSwitch]
) -> Iterator[Mark]:
    """The selector in a channel: through the guards, or below them through the enabling device."""
    (enabling, mode), low = setting, y - 15j
    yield _line(reached + y, end + y)
    yield from _switch(end + y, f"{mode.sign}{channel}", closed=True)
    yield _line(end + 8 + y, end + 22 + y)
    yield _text(low + 1.5j, f"24 V, {channel[1:]}", 1.8, "left")
    yield _line(low, end - 20 + low)
    yield from _switch(end - 20 + low, f"{enabling.sign}{channel}", closed=False)
    yield _text(end - 16 + low - 3j, enabling.terminals, 1.8)
    yield _line(end - 12 + low, end + low)
    yield from _switch(end + low, f"{mode.sign}{channel}", closed=False)
    yield _line(end + 8 + low, end + 18 + low, end + 18 + y)


def _relay(x: float, origin: complex, relay: SafeRelay, reset: SafeSwitch) -> Iterator[Mark]:
    """The box of a relay with its two inputs and its reset."""
    yield _box(x + origin + 6j - 1j * _RELAY_BOX.imag, _RELAY_BOX)
    yield _text(x + 15 + origin - 6j, relay.sign, 3.0)
    yield _text(x + 15 + origin - 10j, Sentence("electric.relay"))
    for y, words in ((0j, "S11-S12"), (_CHANNEL, "S21-S22")):
        yield _text(x + 1 + origin + y + 0.8j, words, 1.8, "left")
    y = origin - 46j
    yield _line(x + 8 + y, x + 8 + origin - 40j)
    yield _text(x + 7 + y - 2.5j, Sentence("electric.reset", sign=reset.sign), anchor="right")
    yield _text(x + 7 + y - 6j, reset.terminals, 1.8, "right")


def _outputs(x: float, stops: SafeRelay, guards: SafeRelay, amplifiers: int) -> Iterator[Mark]:
    """What the relays open: the halt of the controller at once, the torque of all amplifiers after that."""
    for relay, origin in ((stops, 0j), (guards, _GUARDS)):
        yield _line(x + origin, x + 26 + origin)
        yield _text(x - 1 + origin + 0.8j, "13-14", 1.8, "right")
        yield _text(x + 1 + origin + 1.2j, Sentence("electric.halt"), 1.8, "left")
        yield _box(x + 26 + origin - 4j, 34 + 8j)
        yield _text(x + 43 + origin + 0.6j, "A1")
        yield _text(x + 43 + origin - 3j, relay.halt, 1.8)
    for number, words in ((1, "37-38"), (2, "47-48")):
        down, out = -8j - 8j * number, _GUARDS - 6j - 8j * number
        bend = x + 25 - 2.5 * number
        yield _line(x + down, bend + down, bend + out + 3j, x + out + 3j)
        yield from (_text(x - 1 + y + 0.8j, words, 1.8, "right") for y in (down, out))
        yield _line(x + out, x + 26 + out)
        yield _text(x + 27 + out - 0.7j, f"STO {number}", 1.8, "left")
    y = _GUARDS - 50j
    yield _box(x + 26 + y, 34 + 42j)
    yield _text(x + 43 + y + 12j, f"T1 … ({amplifiers} ×)")
    yield _text(x + 43 + y + 8j, Sentence("electric.amplifiers"), 1.8)
    back = x + 64 + 0j
    yield _line(x + 60 + y + 30j, back + y + 30j, back + 14j, x - 15 + 14j, x - 15 + 6j, kind=LineKind.HIDDEN)
    yield _text(x + 24 + 15j, Sentence("electric.feedback"), 1.8)


def _speed(x: float, mode: SafeSwitch) -> Iterator[Mark]:
    """The contacts of the selector that release the full speed: open at setting."""
    for number in (1, 2):
        y = _GUARDS - (54 + 6 * number) * 1j
        end = x + _RELAY_BOX.real + 32 + 6 * number
        yield _text(x - 26 + y + 1j, "24 V", 1.8, "right")
        yield _line(x - 25 + y, x - 12 + y)
        yield from _switch(x - 12 + y, "", closed=True)
        yield _text(x - 2 + y + 1j, f"{mode.sign}.{number + 2}", 1.8, "left")
        yield _line(x - 4 + y, end + y, end + _GUARDS - 50j)
        yield _text(end - 1 + y + 1j, f"SLS {number}", 1.8, "right")
