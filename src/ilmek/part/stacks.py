"""Parts that lie alternately along an axis, as cams and shims on a shaft: their order in runs that repeat."""

import math
from collections.abc import Sequence

import numpy as np

from ilmek.part.part import Part
from ilmek.part.placement import Placement
from ilmek.records import record
from ilmek.units import deg

LONGEST = 60
"""Most parts of a run before it repeats."""

StackPiece = tuple[Part, float]
"""A part of a stack, and its angle about the axis from the first of its kind [rad]."""


@record
class StackRun:
    """Parts that follow each other along the axis, and how many times they do."""

    pieces: tuple[StackPiece, ...]
    times: int


def stack_runs(pieces: Sequence[tuple[Part, Placement]]) -> tuple[StackRun, ...]:
    """The runs of parts that stand with parallel z axes, along that of the first: at each that which covers most.

    >>> from ilmek.part.placement import placement
    >>> from ilmek.elements.materials import MATERIALS
    >>> from ilmek.part.shapes import bar
    >>> steel, disc = MATERIALS["structural steel"], bar(0.1, 0.01)
    >>> cam, ring = (Part(name, name, "", shape=disc, material=steel) for name in ("cam", "ring"))
    >>> row = [(part, placement(z=0.02 * k + at)) for part, at in ((cam, 0.0), (ring, 0.01)) for k in range(3)]
    >>> [([part.id for part, _ in run.pieces], run.times) for run in stack_runs(row)]
    [(['cam', 'ring'], 3)]
    """
    axis = pieces[0][1].rotation[:, 2]
    first = {part.id: position.rotation for part, position in reversed(pieces)}
    parts = {part.id: part for part, _ in pieces}
    ordered = sorted(pieces, key=lambda own: float(axis @ own[1].origin))
    tokens = [(part.id, _turned(first[part.id].T @ position.rotation)) for part, position in ordered]
    runs, begin = list[StackRun](), 0
    while begin < len(tokens):
        period, times = max(
            ((period, _repeats(tokens, begin, period)) for period in range(1, LONGEST + 1)),
            key=lambda own: (own[0] * own[1] if own[1] > 1 else 1, -own[0]),
        )
        pieces_of_run = tuple((parts[name], angle * deg) for name, angle in tokens[begin : begin + period])
        runs.append(StackRun(pieces_of_run, times))
        begin += period * times
    return tuple(runs)


def _turned(rotation: np.ndarray) -> int:
    """Angle about z, rounded [deg]."""
    return round(math.degrees(math.atan2(rotation[1, 0], rotation[0, 0]))) % 360


def _repeats(tokens: Sequence[tuple[str, int]], begin: int, period: int) -> int:
    """How many times the tokens of a period follow each other."""
    times = 1
    while tokens[begin : begin + period] == tokens[begin + times * period : begin + (times + 1) * period] != []:
        times += 1
    return times
