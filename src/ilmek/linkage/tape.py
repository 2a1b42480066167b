"""A plan written out as a tape of instructions for the compiled executor: integers, and numbers for many variants.

The executor works in rows of `BLOCK` samples. A body takes ten rows: position, velocity and acceleration of its anchor
(x and y each), direction (x and y), omega, alpha. An instruction is (code, to, of, also): it fills the rows from `to`
on, reading the body at row `of`; its numbers, one complex row a variant, come from the points of the mechanism's
bodies, any of which may be an array over the variants.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any, TypeAlias

import numpy as np

from ilmek.arrays import ComplexArray, ComplexField, IntArray, RealField
from ilmek.errors import MechanismError
from ilmek.linkage.groups.group import Step
from ilmek.linkage.groups.rrp import SliderDyad
from ilmek.linkage.groups.rrr import Dyad
from ilmek.linkage.groups.shift import Shift, Track
from ilmek.linkage.groups.turn import Turn
from ilmek.linkage.model import GROUND, Mechanism
from ilmek.linkage.structure import Plan

CARRY, TURN, RRR, RRP, SLIP = range(5)
"""Instructions: carry a point of a body; turn a driven body; the two dyads; place a slider on its guide."""

BODY, DRIVE = 10, 3
"""Rows of a body, and of an input: value, speed, acceleration."""

DIRECTION, OMEGA, ALPHA = 6, 8, 9
"""Rows of a body after its anchor's six."""

SECOND, MARGIN, ZERO, TRAVEL = 10, 20, 21, 27
"""Rows of a dyad: its second body, its margin; of RRP also the line's zero and the slider's travel, speed, gain."""

NUMBERS = 6
"""Most complex numbers an instruction takes."""

Dimensions: TypeAlias = Mapping[tuple[str, str], ComplexField]
"""(body, point) -> the point's place in the body's frame [m], an array over the variants."""


@dataclass(slots=True)
class Tape:
    """Instructions in order, their numbers, and where each body, its anchor and its columns stand.

    rows    body -> its first row           at  body -> its anchor in its frame [m]
    travel  slider -> row of its travel     height  rows in all
    """

    mechanism: Mechanism
    dimensions: Dimensions
    branches: Mapping[str, RealField]
    height: int
    codes: list[tuple[int, int, int, int]] = field(default_factory=list)
    numbers: list[tuple[ComplexField, ...]] = field(default_factory=list)
    rows: dict[str, int] = field(default_factory=lambda: {GROUND: 0})
    at: dict[str, ComplexField] = field(default_factory=lambda: {GROUND: 0j})
    travel: dict[str, int] = field(default_factory=dict)

    def point(self, body: str, point: str) -> ComplexField:
        """A point in its body's frame [m], one a variant where it varies."""
        return self.dimensions.get((body, point), self.mechanism.point(body, point))

    def add(self, code: int, to: int, of: int = 0, also: int = 0, numbers: tuple[ComplexField, ...] = ()) -> None:
        """One more instruction."""
        self.codes.append((code, to, of, also))
        self.numbers.append(numbers)

    def room(self, rows: int) -> int:
        """The first of so many further rows."""
        self.height += rows
        return self.height - rows

    def carry(self, body: str, local: ComplexField, to: int) -> None:
        """Motion of the place `local` [m] of a body into six rows."""
        self.add(CARRY, to, self.rows[body], numbers=(local - self.at[body],))

    def stack(self, variants: int) -> tuple[IntArray, ComplexArray]:
        """Instructions and numbers as arrays: (instructions, 4) and (variants, instructions, NUMBERS)."""
        table = np.zeros((variants, len(self.codes), NUMBERS), dtype=complex)
        for k, numbers in enumerate(self.numbers):
            for j, number in enumerate(numbers):
                table[:, k, j] = number
        return np.array(self.codes, dtype=np.int64).reshape(-1, 4), table


def tape(plan: Plan, dimensions: Dimensions, branches: Mapping[str, RealField]) -> Tape:
    """The plan's steps as instructions; what `dimensions` and `branches` do not name is as the plan has it.

    Raises MechanismError for a step that has no compiled form, and a link of zero length.
    """
    inputs = [entry.name for entry in plan.mechanism.inputs]
    written = Tape(plan.mechanism, dimensions, branches, BODY + DRIVE * len(inputs))
    for step in plan.steps:
        write = WRITERS.get(type(step))
        if write is None:
            raise MechanismError(
                f"{step.words}: not among the compiled groups",
                allowed="driven bodies, RRR and RRP dyads",
                do="use solve",
            )
        write(written, step, inputs)
    return written


def is_compiled(plan: Plan) -> bool:
    """Whether every step of the plan has a compiled form."""
    return all(type(step) in WRITERS for step in plan.steps)


def _turn(tape: Tape, step: Turn, inputs: list[str]) -> None:
    pin = next(entry.joint for entry in tape.mechanism.inputs if entry.name == step.entry)
    to = tape.room(BODY)
    tape.carry(step.carrier, tape.point(step.carrier, pin), to)
    tape.add(TURN, to, tape.rows[step.carrier], BODY + DRIVE * inputs.index(step.entry), (step.sign,))
    tape.rows[step.body], tape.at[step.body] = to, tape.point(step.body, pin)


def _shift(tape: Tape, step: Shift, inputs: list[str]) -> None:
    to = tape.room(BODY)
    _slip(tape, (step.body, step.on, step.entry), step.track, to, BODY + DRIVE * inputs.index(step.entry))


def _dyad(tape: Tape, step: Dyad, inputs: list[str]) -> None:  # noqa: ARG001 - all writers are called alike
    to = tape.room(MARGIN + 1)
    arms = []
    for link, on, pin, row in zip(step.links, step.on, step.hung_at, (to, to + SECOND), strict=True):
        tape.carry(on, tape.point(on, pin), row)
        tape.rows[link], tape.at[link] = row, tape.point(link, pin)
        arms.append(_arm(tape, link, pin, step.pin))
    (a, b), branch = arms, tape.branches.get(step.pin, step.branch)
    tape.add(RRR, to, numbers=(np.abs(a), np.abs(b), branch, 1 / a, 1 / b))


def _slider_dyad(tape: Tape, step: SliderDyad, inputs: list[str]) -> None:  # noqa: ARG001 - all writers alike
    to = tape.room(TRAVEL + 3)
    link, slider, (on, guide), track = step.link, step.slider, step.on, step.track
    hinge, slide = _between(tape.mechanism, link, on), _between(tape.mechanism, slider, guide)
    tape.carry(on, tape.point(on, hinge), to)
    tape.rows[link], tape.at[link] = to, tape.point(link, hinge)
    reach = tape.point(slider, step.pin) - tape.point(slider, slide)
    tape.carry(guide, tape.point(guide, slide) + track.twist * reach, to + ZERO)
    arm, branch = _arm(tape, link, hinge, step.pin), tape.branches.get(step.pin, step.branch)
    tape.add(RRP, to, tape.rows[guide], numbers=(np.abs(arm), branch, 1 / arm, track.lead))
    _slip(tape, (slider, guide, slide), track, to + SECOND, to + TRAVEL)


def _slip(tape: Tape, names: tuple[str, str, str], track: Track, to: int, travel: int) -> None:
    """The body on its guide: its anchor, the slide's point, carried and slid; its direction and rates."""
    body, guide, slide = names
    tape.carry(guide, tape.point(guide, slide), to)
    tape.add(SLIP, to, tape.rows[guide], travel, (track.lead, track.twist))
    tape.rows[body], tape.at[body], tape.travel[body] = to, tape.point(body, slide), travel


def _arm(tape: Tape, link: str, start: str, end: str) -> ComplexField:
    """From one point of a link to another in its frame [m]. Raises MechanismError where they coincide."""
    arm = tape.point(link, end) - tape.point(link, start)
    if np.any(arm == 0):
        raise MechanismError(
            f"link {link!r} of {tape.mechanism.name} has zero length: {start} and {end} coincide",
            do="give every variant a length above 0",
        )
    return arm


def _between(mechanism: Mechanism, body: str, other: str) -> str:
    return next(joint.name for joint in mechanism.joints if set(joint.bodies) == {body, other})


WRITERS: dict[type[Step], Callable[[Tape, Any, list[str]], None]] = {
    Turn: _turn,
    Shift: _shift,
    Dyad: _dyad,
    SliderDyad: _slider_dyad,
}
"""The steps that have a compiled form, and how each is written."""
