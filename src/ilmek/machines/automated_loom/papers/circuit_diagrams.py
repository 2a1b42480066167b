"""Diagrams of a loom's electrical plan: supply and motors in a single line, and the two channels of its safety circuit.

Signs of devices: IEC 81346-2; symbols: IEC 60617. Positions in mm: x to the right, y up.
"""

from collections.abc import Iterator, Sequence

import numpy as np

from ilmek.arrays import ComplexArray
from ilmek.records import record
from ilmek.report.sheet import LineKind, Schematic, SheetLine, SheetText
from ilmek.sentences import Sentence

Mark = SheetLine | SheetText

_PITCH, _BUS, _FUSE, _DRIVE, _MOTOR, _WORDS = 13.0, -16.0, -8.0, 18.0, 72.0, 79.0
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


def safety_circuit(
    guards: Sequence[tuple[str, int, str]],
    setting: tuple[tuple[str, str], tuple[str, str]],
    amplifiers: int,
    halt: str,
) -> Schematic:
    """The two channels through all devices that stop the loom, the safety relay, and what it switches.

    setting     sign and terminals of the enabling device, whose two contacts are in parallel with the guards while
                these are open, and of the reset
    guards      of each kind of device: its sign, pieces, and its terminals
    amplifiers  pieces      halt  input of the motion controller
    """
    (enabling, enabled_at), (reset, reset_at) = setting

    def marks() -> Iterator[Mark]:
        x = 0.0
        for channel in (0, -16):
            yield _text(channel * 1j + 2.5j, f"24 V, {'12'[channel < 0]}", anchor="left")
            yield _line(channel * 1j, 12 + channel * 1j)
        x = 12.0
        for sign, number, terminal in guards:
            shown = range(1, number + 1) if number <= _DRAWN else (1, 2, number)
            for before, index in zip((0, *shown), shown, strict=False):
                if index > before + 1:
                    yield _text(x + 4 - 8.8j, "…", 4.0)
                    yield from (_line(x + y, x + 8 + y, kind=LineKind.HIDDEN) for y in (0, -16j))
                    x += 8
                for y in (0, -16j):
                    yield from _switch(x + y, f"{sign}{index}", closed=True)
                    yield _line(x + 8 + y, x + 12 + y)
                x += 12
            yield _text(x - 12 - 24j, terminal)
        yield _box(x - 22j, 30 + 30j)
        yield _text(x + 15 - 6j, "K1", 3.0)
        yield _text(x + 15 - 10j, Sentence("electric.relay"))
        yield from (_text(x + 1 + y, words, 1.8, "left") for y, words in ((0.8j, "S11-S12"), (-15.2j, "S21-S22")))
        yield _line(x + 15 - 22j, x + 15 - 28j)
        yield from _switch(x + 7 - 28j, "", closed=False)
        yield _line(x - 1 - 28j, x + 7 - 28j)
        yield _text(x - 2 - 29j, Sentence("electric.reset", sign=reset), anchor="right")
        yield _text(x - 2 - 32.5j, reset_at, 1.8, "right")
        yield from _enabling(x, enabling)
        yield _text(x / 2 + 4 - 54j, enabled_at)
        yield from _outputs(x + 30, amplifiers, halt)

    return _schematic("safety-circuit", Sentence("electric.safety"), marks())


def _enabling(x: float, sign: str) -> Iterator[Mark]:
    """The enabling device before the relay at x: a contact of each channel, open at rest, and its own selector."""
    for channel, (y, into) in enumerate(((-40j, 19), (-50j, 22)), 1):
        yield _text(y + 2.5j, f"24 V, {channel}", anchor="left")
        yield _line(y, x / 2 + y)
        yield from _switch(x / 2 + y, f"{sign}.{channel}", closed=False)
        yield _line(x / 2 + 8 + y, x + into + y, x + into - 22j)
        yield _text(x + into - 0.8 + y + 0.8j, f"S{channel + 2}1-S{channel + 2}2", 1.8, "right")


_DRAWN = 4
"""Devices of a kind that are drawn; of more, the first two and the last."""


def _outputs(x: float, amplifiers: int, halt: str) -> Iterator[Mark]:
    """What the relay switches: the halt of the controller at once, the torque of all amplifiers after that."""
    for y, words in ((4j, "13-14"), (-6j, "37-38"), (-16j, "47-48")):
        yield _text(x - 1 + y + 0.8j, words, 1.8, "right")
        yield _line(x + y, x + 26 + y)
    yield _text(x + 1 + 5.2j, Sentence("electric.halt"), 1.8, "left")
    yield from (_text(x + 1 + y + 1.2j, f"STO {number}", 1.8, "left") for number, y in ((1, -6j), (2, -16j)))
    yield _box(x + 26 + 0j, 34 + 8j)
    yield _text(x + 43 + 4.6j, "A1")
    yield _text(x + 43 + 1j, halt, 1.8)
    yield _box(x + 26 - 20j, 34 + 17j)
    yield _text(x + 43 - 9j, f"T1 … ({amplifiers} ×)")
    yield _text(x + 43 - 13j, Sentence("electric.amplifiers"), 1.8)
    yield _line(x + 43 - 20j, x + 43 - 25j, x - 5 - 25j, x - 5 - 22j, kind=LineKind.HIDDEN)
    yield _text(x + 19 - 24j, Sentence("electric.feedback"), 1.8)
