"""Energy chains that carry cables and tubes to what moves: classes of plastic chains, their fill and their bend.

    w = sum ceil(n / k) q + s,   k = floor((h + s) / (q + s)),   q = d (1 + room)      lines in layers on shelves
    R >= b d, b 7.5 to 10      10 % of room about a cable, 20 % about a tube; w at most the inner width, h inner height
    l = S / 2 + pi R + 2 p                                 fixed in the middle of the travel S, a pitch at each end

n lines of the diameter d, s thickness of shelves and separators, R bend radius.      [rules of makers for their chains]
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

from ilmek.units import mm


@dataclass(frozen=True, slots=True)
class EnergyChain:
    """A class of chains.

    inner, outer  width and height [m]      radius  of its bend, in its middle [m]      pitch  of its links [m]
    line_mass     empty [kg/m]              free    greatest length of the upper run without support [m]
    """

    name: str
    inner: tuple[float, float]
    outer: tuple[float, float]
    radius: float
    pitch: float
    line_mass: float
    free: float

    @property
    def loop(self) -> tuple[float, float]:
        """Height of the chain with its loop, and how far the loop reaches past the end of its straight runs [m]."""
        return 2 * self.radius + self.outer[1], self.radius + self.outer[1] / 2

    def length(self, travel: float) -> float:
        """For a travel, fixed in its middle [m]."""
        return travel / 2 + math.pi * self.radius + 2 * self.pitch


@dataclass(frozen=True, slots=True)
class ChainLines:
    """A number of lines of one kind: diameter [m], room about each over it, least bend radius over it, mass [kg/m]."""

    name: str
    number: int
    diameter: float
    room: float
    bend: float
    line_mass: float

    def width(self, high: float) -> float:
        """Width that they need in an inner height [m]; inf where one is too thick."""
        pitch = self.diameter * (1 + self.room)
        layers = math.floor((high + SHELF) / (pitch + SHELF) + 1e-9)
        return math.ceil(self.number / layers) * pitch if layers else math.inf


GLIDING = 50.0
"""Travel of a chain whose upper run glides on its lower one, at most [m]: makers allow more with rollers."""

SHELF = 2 * mm
"""Thickness of shelves and separators [m]: usual."""

_RADII = {17: (38, 48, 75, 100), 21: (48, 60, 75, 100, 125), 25: (63, 75, 100, 125), 35: (63, 75, 100, 125, 150)}
"""Bend radii of each inner height [mm]."""

_ROWS = """
17 30 23 42 30.5 0.50 0.9
17 50 23 62 30.5 0.65 0.9
21 38 28 54 35 0.70 1.2
21 57 28 73 35 0.85 1.2
21 77 28 93 35 1.00 1.2
25 57 35 73 46 1.00 1.5
25 77 35 93 46 1.15 1.5
25 103 35 119 46 1.35 1.5
35 75 50 91 56 1.60 2.0
35 100 50 116 56 1.85 2.0
35 125 50 141 56 2.10 2.0
35 150 50 166 56 2.35 2.0
35 200 50 216 56 2.85 2.0
"""


def _rows(line: str) -> list[EnergyChain]:
    high, wide, outer, over, pitch, mass, free = map(float, line.split())
    inner, size = (wide * mm, high * mm), (over * mm, outer * mm)
    name = f"{high:g} x {wide:g}"
    return [
        EnergyChain(f"chain {name}, R {radius}", inner, size, radius * mm, pitch * mm, mass, free)
        for radius in _RADII[int(high)]
    ]


ENERGY_CHAINS = tuple(
    sorted(
        (row for line in _ROWS.strip().split("\n") for row in _rows(line)),
        key=lambda row: (row.loop[0], row.line_mass),
    )
)
"""The least loop first, then the lightest. Inner height and width, outer ones, and pitch that makers have in common,
within some millimetres; mass and free length within a fifth."""


def width_needed(row: EnergyChain, lines: Sequence[ChainLines]) -> float:
    """Inner width that lines need, with a separator between kinds [m]."""
    return math.fsum(one.width(row.inner[1]) for one in lines) + (len(lines) - 1) * SHELF


def bend_needed(lines: Sequence[ChainLines]) -> float:
    """Least bend radius of all lines [m]."""
    return max(one.bend * one.diameter for one in lines)


def chain_for(lines: Sequence[ChainLines], widest: float = math.inf) -> EnergyChain:
    """The chain with the least loop, then the lightest, that takes the lines and is no wider than its room [m]; the
    largest that has room where none does.
    """
    offered, bend = [row for row in ENERGY_CHAINS if row.outer[0] <= widest * (1 + 1e-9)], bend_needed(lines)
    enough = (row for row in offered if bend <= row.radius and width_needed(row, lines) <= row.inner[0])
    return next(enough, None) or max(offered or ENERGY_CHAINS[:1], key=_capacity)


def _capacity(row: EnergyChain) -> tuple[float, float]:
    return row.inner[0] * row.inner[1], -row.radius
