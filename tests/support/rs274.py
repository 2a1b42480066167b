"""A reader of RS-274/NGC, from its grammar: words of a letter and a number, comments in brackets, modal groups.

It shares nothing with the writer: each line is read word by word, and the state of a machine follows from it.
"""

import re
from dataclasses import dataclass, field

_WORD = re.compile(r"\s*([A-Z])\s*([+-]?(?:\d+\.?\d*|\.\d+))", re.ASCII)
_MOTION = {0, 1, 2, 3, 80}


@dataclass
class Machine:
    """Moves (tool, gun on, rapid, from, to) in the programme's units, messages and pauses."""

    moves: list[tuple[int, bool, bool, dict[str, float], dict[str, float]]] = field(default_factory=list)
    messages: list[str] = field(default_factory=list)
    pauses: int = 0
    modes: set[float] = field(default_factory=set)
    ended: bool = False


def read(text: str) -> Machine:
    """Run a programme. Raises ValueError for a line that is none, and for a move without a feed or after the end."""
    machine, at = Machine(), dict.fromkeys("XYZC", 0.0)
    state = {"F": 0.0, "S": 0.0, "T": 0.0}
    motion, on = None, False
    for line in text.splitlines():
        words = _words(line, machine)
        if machine.ended and words:
            raise ValueError(f"after the end: {line!r}")
        state |= {letter: value for letter, value in words if letter in state}
        codes = {letter: {value for own, value in words if own == letter} for letter in "GM"}
        machine.modes |= codes["G"] - _MOTION
        motion = next(iter(codes["G"] & _MOTION), motion)
        if 3 in codes["M"] and state["S"] <= 0:
            raise ValueError("M3 without S")
        on = (on or 3 in codes["M"]) and 5 not in codes["M"]
        machine.pauses += 0 in codes["M"]
        machine.ended = 2 in codes["M"]
        axes = {letter: value for letter, value in words if letter in at}
        if axes and (motion is None or (motion == 1 and state["F"] <= 0)):
            raise ValueError(f"a move without motion or feed: {line!r}")
        if axes:
            machine.moves.append((int(state["T"]), on, motion == 0, at, {**at, **axes}))
            at = {**at, **axes}
    return machine


def _words(line: str, machine: Machine) -> list[tuple[str, float]]:
    for comment in re.findall(r"\(([^()]*)\)", line):
        if comment.upper().startswith("MSG,"):
            machine.messages.append(comment[4:].strip())
    rest, words = re.sub(r"\([^()]*\)", "", line).strip(), []
    while rest:
        word = _WORD.match(rest)
        if word is None:
            raise ValueError(f"no word: {line!r}")
        words.append((word[1], float(word[2])))
        rest = rest[word.end() :].strip()
    return words
