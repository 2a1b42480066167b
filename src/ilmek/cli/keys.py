"""Keys of a terminal as they are pressed, without waiting for the end of a line; of a pipe, its characters."""

import importlib
import importlib.util
import os
import select
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from ilmek.cli.interrupts import before_end

termios: Any = importlib.import_module("termios") if importlib.util.find_spec("termios") else None
"""Modes of a terminal; None on Windows, where a key counts when Enter follows it."""

_SEQUENCES = {
    b"\x1b[C": "next",
    b"\x1b[B": "next",
    b"\x1bOC": "next",
    b"\x1bOB": "next",
    b"\x1b[D": "back",
    b"\x1b[A": "back",
    b"\x1bOD": "back",
    b"\x1bOA": "back",
    b"\x1b[6~": "row",
    b"\x1b[5~": "row before",
}
"""Sequences of the arrows and page keys, in both modes of cursor keys."""

_KEYS = {
    **dict.fromkeys(b"\r\n ", "next"),
    **dict.fromkeys(b"bB\x7f\x08", "back"),
    **dict.fromkeys(b"nN", "row"),
    **dict.fromkeys(b"pP", "row before"),
    **dict.fromkeys(b"qQ\x04", "quit"),
}

_OF_PEDAL = {**dict.fromkeys(b"bcBC", "next"), **dict.fromkeys(b"aA", "back")}
_PAGES = {"row": "next", "row before": "back"}
"""What a foot switch means: a, b, c of one with three pedals, and the page keys of one that turns pages."""

_HELD = 0.7
"""Time in which a pedal that is pressed again counts as held down [s]: longer than the delay of repeated keys."""

_INTERVAL = 0.5
"""Interval in which the mode of the terminal is set again [s]: a shell that stopped the command has changed it."""


def keys_of(data: bytes, *, pedal: bool = False) -> Iterator[str]:
    r"""The meanings of the bytes that keys send; others have none.

    pedal  a foot switch sends them: no key leaves the row

    >>> list(keys_of(b" \x1b[Db\x1b[6~xq"))
    ['next', 'back', 'back', 'row', 'quit']
    >>> list(keys_of(b"abc\x1b[5~", pedal=True))
    ['back', 'next', 'next', 'back']
    """
    at = 0
    while at < len(data):
        length = next((length for length in (4, 3) if data[at : at + length] in _SEQUENCES), 0)
        if length:
            key = _SEQUENCES[data[at : at + length]]
            yield _PAGES.get(key, key) if pedal else key
        elif data[at] in (keys := {**_KEYS, **_OF_PEDAL} if pedal else _KEYS):
            yield keys[data[at]]
        at += length or 1


def pressed_keys(*, pedal: bool = False) -> Iterator[str]:
    """The keys until the end of the input; of a foot switch, a pedal that is held down counts once."""
    number, last, pressed = sys.stdin.fileno(), -_HELD, ""
    with _each_key_at_once(number) as again:
        while True:
            while again is not None and not select.select([number], [], [], _INTERVAL)[0]:
                again()
            data = os.read(number, 64)
            if not data:
                return
            for key in keys_of(data, pedal=pedal):
                now, before = time.monotonic(), pressed
                held = pedal and key == before and now - last < _HELD
                last, pressed = now, key
                if not held:
                    yield key


@contextmanager
def _each_key_at_once(number: int) -> Iterator[Any]:
    """Set the terminal so that keys are read at once and not shown; yields a function that does so again."""
    if termios is None or not os.isatty(number):
        yield None
        return
    before = termios.tcgetattr(number)
    mode = termios.tcgetattr(number)
    mode[3] &= ~(termios.ECHO | termios.ICANON)
    mode[6][termios.VMIN], mode[6][termios.VTIME] = 1, 0

    def restore() -> str:
        termios.tcsetattr(number, termios.TCSANOW, before)
        return "the last step is kept"

    def again() -> None:
        if termios.tcgetattr(number)[3] != mode[3]:
            termios.tcsetattr(number, termios.TCSANOW, mode)

    with before_end(restore):
        termios.tcsetattr(number, termios.TCSANOW, mode)
        try:
            yield again
        finally:
            restore()
