"""A plan as a tape of instructions for the compiled executor: numbers for many variants.

An instruction writes the rows from `to` on and reads the rows from `of` and `also` on; see `kernels`. Its numbers, one
complex row per variant, follow from the points of the mechanism's bodies. Each point may be an array over the variants.
"""

import functools
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TypeAlias

import numpy as np

from ilmek.arrays import ComplexArray, ComplexField, IntArray, RealField
from ilmek.errors import MechanismError
from ilmek.linkage.anchors import anchor_name
from ilmek.linkage.kernels import BODY, CARRY, DRIVE, NUMBERS, Instruction
from ilmek.linkage.model import GROUND, Mechanism

Dimensions: TypeAlias = Mapping[tuple[str, str], ComplexField]
"""(body, point) -> position of the point in the body's frame [m], an array over the variants."""


@dataclass(slots=True, eq=False)
class Tape:
    """Instructions in order, their numbers, and the rows of each body.

    lines   instruction, to, of, also         numbers  of each line
    rows    body -> its first row             at       body -> its anchor in its frame [m]
    travel  slider -> row of its travel       height   rows in all
    """

    mechanism: Mechanism
    dimensions: Dimensions
    branches: Mapping[str, RealField]
    height: int = 0
    lines: list[tuple[Instruction, int, int, int]] = field(default_factory=list)
    numbers: list[tuple[ComplexField, ...]] = field(default_factory=list)
    rows: dict[str, int] = field(default_factory=lambda: {GROUND: 0})
    at: dict[str, ComplexField] = field(default_factory=dict)
    travel: dict[str, int] = field(default_factory=dict)

    def __post_init__(self) -> None:
        self.height = BODY + DRIVE * len(self.mechanism.inputs)
        self.at[GROUND] = self.anchor(GROUND)

    def point(self, body: str, point: str) -> ComplexField:
        """A point in its body's frame [m]; one value per variant where it varies."""
        return self.dimensions.get((body, point), self.mechanism.point(body, point))

    def branch(self, joint: str, sign: int) -> RealField:
        """The branch of a free joint, one value per variant where it varies; default: `sign`."""
        return self.branches.get(joint, sign)

    def drive(self, entry: str) -> int:
        """The first row of an input."""
        return BODY + DRIVE * [one.name for one in self.mechanism.inputs].index(entry)

    def add(
        self, instruction: Instruction, to: int, of: int = 0, also: int = 0, numbers: tuple[ComplexField, ...] = ()
    ) -> None:
        """Append an instruction."""
        self.lines.append((instruction, to, of, also))
        self.numbers.append(numbers)

    def room(self, rows: int) -> int:
        """Reserve a number of rows; the index of the first."""
        self.height += rows
        return self.height - rows

    def carry(self, body: str, local: ComplexField, to: int, further: ComplexField = 0j) -> None:
        """Write the motion of the point `further` from `local` [m] of a body to six rows."""
        self.add(CARRY, to, self.rows[body], numbers=((local - self.at[body]) + further,))

    def pinned(self, body: str, on: str, to: int) -> str:
        """Write a pin of a known body as the anchor of a body that it joins; the pin's name."""
        pin = self.between(body, on)
        self.carry(on, self.point(on, pin), to)
        self.rows[body], self.at[body] = to, self.point(body, pin)
        return pin

    def between(self, body: str, other: str) -> str:
        """The joint of two bodies."""
        return next(joint.name for joint in self.mechanism.joints if set(joint.bodies) == {body, other})

    def arm(self, link: str, start: str, end: str) -> ComplexField:
        """From one point of a link to another in its frame [m]. Raises MechanismError where they coincide."""
        arm = self.point(link, end) - self.point(link, start)
        if np.any(arm == 0):
            raise MechanismError(
                f"link {link!r} of {self.mechanism.name} has zero length: {start} and {end} coincide",
                do="give every variant a length above 0",
            )
        return arm

    def anchor(self, body: str) -> ComplexField:
        """A body's anchor in its frame [m]; one per variant where it varies."""
        name = anchor_name(self.mechanism, body)
        return 0j if name is None else self.point(body, name)

    @property
    def span(self) -> RealField:
        """Largest distance of a point from its body's anchor [m]; one per variant where it varies; 1 if all are 0."""
        bodies = self.mechanism.bodies
        lengths = [
            np.abs(self.point(body.name, point) - self.anchor(body.name)) for body in bodies for point in body.points
        ]
        span = functools.reduce(np.maximum, lengths)
        return np.where(span == 0, 1.0, span)

    def stack(self, instructions: tuple[Instruction, ...], variants: int) -> tuple[int, IntArray, ComplexArray]:
        """Codes and numbers as arrays: (lines, 5) and (variants, lines, NUMBERS).

        instructions  those that the executor has; a code is (index among them, to, of, also, whether it has a margin)
        Lines that write the ground's points, the same in all samples, come first; with their number.
        """
        shifted = {to for instruction, to, *_ in self.lines if instruction.shifts}
        still = [
            instruction is CARRY and of == self.rows[GROUND] and to not in shifted
            for instruction, to, of, _ in self.lines
        ]
        order = sorted(range(len(self.lines)), key=lambda k: not still[k])
        table = np.zeros((variants, len(order), NUMBERS), dtype=complex)
        codes = np.zeros((len(order), 5), dtype=np.int64)
        for k, line in enumerate(order):
            instruction, *rows = self.lines[line]
            codes[k] = instructions.index(instruction), *rows, instruction.scale is not None
            for j, number in enumerate(self.numbers[line]):
                table[:, k, j] = number
        return sum(still), codes, table
