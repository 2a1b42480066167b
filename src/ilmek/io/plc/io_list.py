"""The list of inputs and outputs of the main program, with addresses, and the parts of the loom that they are wired to.

Bits are packed into bytes, words begin at even bytes, double words at multiples of four. An address counts bytes, or
words and double words as they are: that differs between controllers. Signals of the host (commands, the row's data) and
of the operator's panel are variables without an address.
"""

from collections.abc import Container, Iterable
from dataclasses import dataclass

from ilmek.errors import LoomError
from ilmek.io.csv_cells import csv_rows
from ilmek.io.plc.units import PlcUnit
from ilmek.machines.automated_loom.equipment.signals import SIGNALS, DeviceSignal

_SIZES = {"BOOL": 0, "USINT": 1, "INT": 2, "DINT": 4, "REAL": 4}
_LETTERS = {0: "X", 1: "B", 2: "W", 4: "D"}

HOST = frozenset(
    ("CntrlCmd", "CmdChangeRequest", "UnitMode", "UnitModeChangeRequest", "StepKnot", "Acknowledge", "GiveUp",
     "RowsBack", "RowsBackKnots", "RowsBackRequest", "JogAxis", "Recipe", "RowData", "RowRequest", "StateCurrent",
     "UnitModeCurrent", "Refused", "Alarm", "KnotsDone", "CarpetDone", "TieAnswer", "EndAnswer", "AskTie", "AskEnd",
     "ChangeStart", "ChangeDone", "HostBeat", "PlcBeat")
)  # fmt: skip
"""Variables that the host or the operator's panel reads and writes."""

HEADER = ("variable", "direction", "type", "address", "meaning", "parts")

IoRow = tuple[str, str, str, str, str, str]


@dataclass(frozen=True, slots=True)
class AddressStyle:
    """How a controller counts addresses: by_bytes: words by their first byte, else by their number; bit: its letter."""

    by_bytes: bool
    bit: str = "X"


USUAL_STYLE = AddressStyle(by_bytes=False)
"""Words by their number."""


def io_rows(
    program: PlcUnit,
    style: AddressStyle = USUAL_STYLE,
    placed: Container[str] | None = None,
    read: Iterable[tuple[str, DeviceSignal]] = (),
) -> list[IoRow]:
    """A row for each signal: variable, direction, type, address, meaning, ids of its parts; those of the host last.

    placed  ids of the parts of a loom, of which alone rows name some; None: of looms of all kinds
    read    inputs of this loom that the motion controller reads besides, each with its variable
    Raises LoomError for a signal with an address that no part of the loom gives or takes.
    """
    field: list[IoRow] = []
    host: list[IoRow] = []
    for kind, direction, letter in (("VAR_INPUT", "input", "I"), ("VAR_OUTPUT", "output", "Q")):
        addresses = _Addresses(letter, style)
        for variable in program.of_kind(kind):
            if variable.name in HOST:
                host.append((variable.name, direction, str(variable.kind), "", variable.meaning, ""))
                continue
            if variable.name not in SIGNALS:
                raise LoomError(f"signal {variable.name} without a part", allowed=", ".join(SIGNALS))
            parts = " ".join(part for part in SIGNALS[variable.name] if placed is None or part in placed)
            for name, element in variable.elements:
                field.append((name, direction, element, addresses.next(element), variable.meaning, parts))
        if direction == "input":
            field += (
                (name, direction, "BOOL", addresses.next("BOOL"), own.meaning, f"{own.part} {own.module}")
                for name, own in read
            )
    return [*field, *host]


def io_csv(program: PlcUnit, style: AddressStyle = USUAL_STYLE) -> str:
    """The list as CSV."""
    return csv_rows((HEADER, *io_rows(program, style)))


class _Addresses:
    """Free addresses of inputs or outputs, in ascending order."""

    def __init__(self, letter: str, style: AddressStyle) -> None:
        self._letter, self._style, self._byte, self._bit = letter, style, 0, 0

    def next(self, kind: str) -> str:
        size = _SIZES[kind]
        if size == 0:
            address = f"%{self._letter}{self._style.bit}{self._byte}.{self._bit}"
            self._bit += 1
            if self._bit == 8:
                self._byte, self._bit = self._byte + 1, 0
            return address
        if self._bit:
            self._byte, self._bit = self._byte + 1, 0
        self._byte = -(-self._byte // size) * size
        address = f"%{self._letter}{_LETTERS[size]}{self._byte if self._style.by_bytes else self._byte // size}"
        self._byte += size
        return address
