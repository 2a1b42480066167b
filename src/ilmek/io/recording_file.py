"""A recorded run of the simulated loom as a text file, an input a line.

    ilmek recording 1
    programme <64 hexadecimal digits>
    rates <seed> <probabilities: pile end, pile break, missed grip, weft break, weft end, warp break>
    start <the state's numbers>
    <time> <input>
    ...
    end <time> <64 hexadecimal digits>

Times are nanoseconds. Inputs:

    tie HEAD ROW NUMBER COLUMN TUBE      end ROW OPERATION           jog AXIS NANOMETRES      home AXIS
    aside HEAD ROW PHASE COLUMN
    change ROW PHASE WEFT... / HEAD TUBE YARN NANOMETRES ...         packages, as change
    door CLOSED    emergency PRESSED     tension LOW    repaired     speed PERMILLE    power    halt
    inject FAULT ROW COLUMN OPERATION    sensor NAME VALUE (- true false or a number)

Blanks in the names of axes, faults and sensors are written as `+`.
"""

import math
import re
from collections.abc import Callable
from dataclasses import astuple
from pathlib import Path

from ilmek.errors import LoomError, restated, shortened
from ilmek.io.text_file import read_text
from ilmek.loom.control.interlocks import LoomAxis
from ilmek.loom.control.ports import ChangePackages, EndRow, Fault, Home, Jog, StandAside, Tie
from ilmek.loom.operations import RowEnd, Stop, TubeChange
from ilmek.loom.twin.events import order_words, stop_words
from ilmek.loom.twin.model import FaultRates
from ilmek.loom.twin.recording import MOST_INPUTS, Recording
from ilmek.loom.twin.state import (
    NOWHERE,
    Door,
    EmergencyStop,
    Halt,
    Injected,
    PackageChanged,
    PlantInput,
    PowerOn,
    Repaired,
    SensorFault,
    SetSpeed,
    Tension,
)
from ilmek.units import BILLION

LARGEST = 100_000_000
"""Largest size of a recording [bytes]."""

_FIRST = "ilmek recording 1"
_WHOLE = re.compile(r"-?(0|[1-9][0-9]{0,19})", re.ASCII)
_DIGEST = re.compile(r"[0-9a-f]{64}", re.ASCII)
_NUMBER = re.compile(r"-?[0-9]{1,20}(\.[0-9]{1,20})?(e[-+]?[0-9]{1,3})?", re.ASCII)
_WORD = re.compile(r"[a-z_0-9+-]{1,60}", re.ASCII)


def recording_text(recording: Recording) -> str:
    """The content of a recording's file."""
    lines = [
        _FIRST,
        f"programme {recording.programme}",
        f"rates {' '.join(map(repr, astuple(recording.rates)))}",
        f"start {' '.join(map(str, recording.start))}",
        *(f"{time} {_words(one)}" for time, one in recording.inputs),
        f"end {recording.end} {recording.digest}\n",
    ]
    return "\n".join(lines)


def read_recording(path: Path) -> Recording:
    """Read a recording. Raises LoomError with the line."""
    with restated(LoomError, f"recording {path} ", of=LoomError):
        text = read_text(path, noun="recording of a run", largest=LARGEST, error=LoomError, do="check the path")
    lines = text.splitlines()
    if lines[0] != _FIRST:
        raise LoomError(f"{path} is no recording", allowed=f"its first line is {_FIRST!r}")
    if len(lines) < 5 or len(lines) > MOST_INPUTS + 5:
        raise LoomError(f"recording {path} has {len(lines):,} lines", allowed=f"5 to {MOST_INPUTS + 5:,}")
    number = 2
    try:
        programme = _digest(_fields(lines[1], "programme", 1)[0])
        number = 3
        rates = _rates(_fields(lines[2], "rates", 7))
        number = 4
        start = tuple(map(_whole, _fields(lines[3], "start")))
        inputs = []
        for number in range(5, len(lines)):
            time, _, words = lines[number - 1].partition(" ")
            inputs.append((_whole(time, 0), _input(words.split(" "))))
        number = len(lines)
        end, digest = _fields(lines[-1], "end", 2)
        return Recording(programme, rates, start, tuple(inputs), _whole(end, 0), _digest(digest))
    except LoomError as failed:
        raise LoomError(f"{path}, line {number}: {failed.given}", allowed=failed.allowed, do=failed.do) from None


def _words(one: PlantInput) -> str:
    match one:
        case Tie() | StandAside() | EndRow() | ChangePackages() | Jog() | Home():
            return order_words(one)
        case Door(value) | EmergencyStop(value) | Tension(value) | SetSpeed(value):
            return f"{_NAMES[type(one)]} {int(value)}"
        case PackageChanged(stop):
            return f"packages {stop_words(stop)}"
        case Injected(fault, row, column, operation):
            return f"inject {_joined(fault)} {row} {column} {'-' if operation is None else int(operation)}"
        case SensorFault(sensor, value):
            return f"sensor {_joined(sensor)} {'-' if value is None else str(value).lower()}"
    return _NAMES[type(one)]


_NAMES: dict[type, str] = {
    Door: "door",
    EmergencyStop: "emergency",
    Tension: "tension",
    SetSpeed: "speed",
    Repaired: "repaired",
    PowerOn: "power",
    Halt: "halt",
}


def _input(words: list[str]) -> PlantInput:
    """The input of a line. Raises LoomError."""
    name, *rest = words
    count, parse = _PARSERS.get(name, (-1, None))
    if parse is None or count not in (len(rest), None):
        raise LoomError(f"{shortened(' '.join(words))!r} is no input of a loom", allowed=", ".join(_PARSERS))
    return parse(rest)


_PARSERS: dict[str, tuple[int | None, Callable[[list[str]], PlantInput]]] = {
    "tie": (5, lambda rest: Tie(*(_whole(word, 0) for word in rest))),
    "aside": (4, lambda rest: StandAside(*(_whole(word, 0) for word in rest))),
    "end": (2, lambda rest: EndRow(_whole(rest[0], 0), _row_end(rest[1]))),
    "jog": (2, lambda rest: Jog(_name(rest[0]), _whole(rest[1]) / BILLION)),
    "home": (1, lambda rest: Home(_axis(rest[0]))),
    "speed": (1, lambda rest: SetSpeed(_whole(rest[0], 1, 1000))),
    "change": (None, lambda rest: ChangePackages(_stop(rest))),
    "packages": (None, lambda rest: PackageChanged(_stop(rest))),
    "door": (1, lambda rest: Door(_flag(rest[0]))),
    "emergency": (1, lambda rest: EmergencyStop(_flag(rest[0]))),
    "tension": (1, lambda rest: Tension(_flag(rest[0]))),
    "inject": (4, lambda rest: Injected(_fault(rest[0]), _whole(rest[1], 0), _whole(rest[2], NOWHERE), _end(rest[3]))),
    "sensor": (2, lambda rest: SensorFault(_name(rest[0]), _value(rest[1]))),
    "repaired": (0, lambda _: Repaired()),
    "power": (0, lambda _: PowerOn()),
    "halt": (0, lambda _: Halt()),
}
"""The inputs: number of their words, None: any, and what they are."""


def _stop(words: list[str]) -> Stop:
    if words.count("/") != 1 or words.index("/") < 2 or (len(words) - words.index("/") - 1) % 4:
        raise LoomError("a change of packages", allowed="ROW PHASE WEFT... / HEAD TUBE YARN NANOMETRES ...")
    at = words.index("/")
    row, phase, *wefts = (_whole(word, 0) for word in words[:at])
    numbers = [_whole(word, 0) for word in words[at + 1 :]]
    tubes = tuple(
        TubeChange(numbers[n], numbers[n + 1], numbers[n + 2], numbers[n + 3] / BILLION)
        for n in range(0, len(numbers), 4)
    )
    return Stop(row, phase, tuple(wefts), tubes)


def _fields(line: str, name: str, count: int | None = None) -> list[str]:
    first, *rest = line.split(" ")
    if first != name or (count is not None and len(rest) != count):
        raise LoomError(f"{shortened(line)!r}", allowed=f"{name} and {count or 'its'} values")
    return rest


def _rates(words: list[str]) -> FaultRates:
    seed, *rates = words
    return FaultRates(_whole(seed, 0, (1 << 64) - 1), *map(_number, rates))


def _whole(word: str, least: int = -(10**18), most: int = 10**18) -> int:
    if _WHOLE.fullmatch(word) is None or not least <= int(word) <= most:
        raise LoomError(f"{shortened(word)!r}", allowed=f"a whole number from {least} to {most}")
    return int(word)


def _row_end(word: str) -> RowEnd:
    return RowEnd(_whole(word, 0, len(RowEnd) - 1))


def _end(word: str) -> RowEnd | None:
    return None if word == "-" else _row_end(word)


def _flag(word: str) -> bool:
    return _whole(word, 0, 1) == 1


def _number(word: str) -> float:
    if _NUMBER.fullmatch(word) is None or not math.isfinite(float(word)):
        raise LoomError(f"{shortened(word)!r}", allowed="a finite number")
    return float(word)


def _value(word: str) -> bool | float | None:
    known: dict[str, bool | None] = {"-": None, "true": True, "false": False}
    return known[word] if word in known else _number(word)


def _digest(word: str) -> str:
    if _DIGEST.fullmatch(word) is None:
        raise LoomError(f"{shortened(word)!r}", allowed="64 hexadecimal digits")
    return word


def _joined(words: str) -> str:
    return words.replace(" ", "+")


def _name(word: str) -> str:
    if _WORD.fullmatch(word) is None:
        raise LoomError(f"{shortened(word)!r}", allowed="a name of small letters, digits, _ + and -")
    return word.replace("+", " ")


def _axis(word: str) -> LoomAxis:
    if word not in set(LoomAxis):
        raise LoomError(f"axis {shortened(word)!r}", allowed=", ".join(LoomAxis))
    return LoomAxis(word)


def _fault(word: str) -> Fault:
    name = _name(word)
    if name not in set(Fault):
        raise LoomError(f"fault {shortened(word)!r}", allowed=", ".join(map(_joined, Fault)))
    return Fault(name)
