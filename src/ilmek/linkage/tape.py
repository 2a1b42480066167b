"""A plan as a tape of instructions for the compiled executor: integer codes, and numbers for many variants.

The executor works in rows of `BLOCK` samples. A body takes ten rows: position, velocity and acceleration of its anchor
(x and y each), direction (x and y), omega, alpha. An instruction is (code, to, of, also): it writes the rows from `to`
on and reads the body at row `of`. Its numbers, one complex row per variant, follow from the points of the mechanism's
bodies. Each point may be an array over the variants.
"""

import functools
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any, TypeAlias

import numpy as np

from ilmek.arrays import ComplexArray, ComplexField, IntArray, RealField
from ilmek.errors import MechanismError
from ilmek.linkage.anchors import anchor_name
from ilmek.linkage.groups import rpp, rpr
from ilmek.linkage.groups.group import Step
from ilmek.linkage.groups.prp import CrossedSliders
from ilmek.linkage.groups.rpp import CrossSlide
from ilmek.linkage.groups.rpr import SlidingDyad
from ilmek.linkage.groups.rrp import SliderDyad
from ilmek.linkage.groups.rrr import RRRDyad
from ilmek.linkage.groups.shift import DrivenSlider, SlideTrack
from ilmek.linkage.groups.turn import DrivenCrank
from ilmek.linkage.model import GROUND, Mechanism
from ilmek.linkage.structure import Plan

CARRY, TURN, SLIP, RRR, RRP, RPR, PRP, RPP = range(8)
"""Instructions: carry a point of a body; turn a driven body; place a slider on its guide; the dyads."""

BODY, DRIVE = 10, 3
"""Rows of a body, and of an input: value, speed, acceleration."""

DIRECTION, OMEGA, ALPHA = 6, 8, 9
"""Rows of a body after its anchor's six."""

SECOND, MARGIN, ZERO, TRAVEL, LINE = 10, 20, 21, 27, 9
"""Rows of a dyad: its second body and its margin. With sliders also the zero of the line, and travel, speed and
acceleration along it. LINE is the distance in rows to the same rows of a second line."""

NUMBERS = 6
"""Maximum of complex numbers per instruction."""

Dimensions: TypeAlias = Mapping[tuple[str, str], ComplexField]
"""(body, point) -> position of the point in the body's frame [m], an array over the variants."""


@dataclass(slots=True, eq=False)
class Tape:
    """Instructions in order, their numbers, and the rows of each body.

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
    at: dict[str, ComplexField] = field(default_factory=dict)
    travel: dict[str, int] = field(default_factory=dict)

    def point(self, body: str, point: str) -> ComplexField:
        """A point in its body's frame [m]; one value per variant where it varies."""
        return self.dimensions.get((body, point), self.mechanism.point(body, point))

    def add(self, code: int, to: int, of: int = 0, also: int = 0, numbers: tuple[ComplexField, ...] = ()) -> None:
        """Append an instruction."""
        self.codes.append((code, to, of, also))
        self.numbers.append(numbers)

    def room(self, rows: int) -> int:
        """Reserve a number of rows; the index of the first."""
        self.height += rows
        return self.height - rows

    def carry(self, body: str, local: ComplexField, to: int, further: ComplexField = 0j) -> None:
        """Write the motion of the point `further` from `local` [m] of a body to six rows."""
        self.add(CARRY, to, self.rows[body], numbers=((local - self.at[body]) + further,))

    def anchor(self, body: str) -> ComplexField:
        """A body's anchor in its frame [m]; one per variant where it varies."""
        name = anchor_name(self.mechanism, body)
        return 0j if name is None else self.point(body, name)

    @property
    def span(self) -> RealField:
        """Largest distance of a point from its body's anchor [m]; one per variant where it varies; 1 if all are 0."""
        bodies = self.mechanism.bodies
        lengths = [
            np.abs(self.point(one.name, point) - self.anchor(one.name)) for one in bodies for point in one.points
        ]
        span = functools.reduce(np.maximum, lengths)
        return np.where(span == 0, 1.0, span)

    def stack(self, variants: int) -> tuple[int, IntArray, ComplexArray]:
        """Instructions and numbers as arrays: (instructions, 4) and (variants, instructions, NUMBERS).

        Those that write the ground's points, the same in all samples, come first; with their number.
        """
        slipped = {to for code, to, *_ in self.codes if code == SLIP}
        still = [code == CARRY and of == self.rows[GROUND] and to not in slipped for code, to, of, _ in self.codes]
        order = sorted(range(len(self.codes)), key=lambda k: not still[k])
        table = np.zeros((variants, len(order), NUMBERS), dtype=complex)
        for k, instruction in enumerate(order):
            for j, number in enumerate(self.numbers[instruction]):
                table[:, k, j] = number
        return sum(still), np.array([self.codes[k] for k in order], dtype=np.int64).reshape(-1, 4), table


def tape(plan: Plan, dimensions: Dimensions, branches: Mapping[str, RealField]) -> Tape:
    """The plan's steps as instructions; default of `dimensions` and `branches`: the values of the plan.

    Raises MechanismError for a step that has no compiled form, and a link of zero length.
    """
    inputs = [entry.name for entry in plan.mechanism.inputs]
    written = Tape(plan.mechanism, dimensions, branches, BODY + DRIVE * len(inputs))
    written.at[GROUND] = written.anchor(GROUND)
    for step in plan.steps:
        write = WRITERS.get(type(step))
        if write is None:
            raise MechanismError(
                f"{step.description}: not among the compiled groups",
                allowed="driven bodies and the dyads that have closed forms",
                do="use solve",
            )
        write(written, step, inputs)
    return written


def is_compiled(plan: Plan) -> bool:
    """Whether every step of the plan has a compiled form."""
    return all(type(step) in WRITERS for step in plan.steps)


def _turn(tape: Tape, step: DrivenCrank, inputs: list[str]) -> None:
    pin = next(entry.joint for entry in tape.mechanism.inputs if entry.name == step.entry)
    to = tape.room(BODY)
    tape.carry(step.carrier, tape.point(step.carrier, pin), to)
    tape.add(TURN, to, tape.rows[step.carrier], BODY + DRIVE * inputs.index(step.entry), (step.sign,))
    tape.rows[step.body], tape.at[step.body] = to, tape.point(step.body, pin)


def _shift(tape: Tape, step: DrivenSlider, inputs: list[str]) -> None:
    to = tape.room(BODY)
    _slip(tape, (step.body, step.on, step.entry), step.track, to, BODY + DRIVE * inputs.index(step.entry))


def _dyad(tape: Tape, step: RRRDyad, inputs: list[str]) -> None:  # noqa: ARG001 - all writers are called alike
    to = tape.room(MARGIN + 1)
    arms = []
    for link, on, pin, row in zip(step.links, step.on, step.known_pins, (to, to + SECOND), strict=True):
        tape.carry(on, tape.point(on, pin), row)
        tape.rows[link], tape.at[link] = row, tape.point(link, pin)
        arms.append(_arm(tape, link, pin, step.pin))
    (a, b), branch = arms, tape.branches.get(step.pin, step.branch)
    tape.add(RRR, to, numbers=(np.abs(a), np.abs(b), branch, 1 / a, 1 / b))


def _slider_dyad(tape: Tape, step: SliderDyad, inputs: list[str]) -> None:  # noqa: ARG001 - all writers alike
    to = tape.room(TRAVEL + 3)
    link, slider, (on, guide), track = step.link, step.slider, step.on, step.track
    hinge = _between(tape.mechanism, link, on)
    tape.carry(on, tape.point(on, hinge), to)
    tape.rows[link], tape.at[link] = to, tape.point(link, hinge)
    line = _line(tape, (slider, guide, step.pin), track, to + ZERO)
    arm, branch = _arm(tape, link, hinge, step.pin), tape.branches.get(step.pin, step.branch)
    tape.add(RRP, to, tape.rows[guide], numbers=(np.abs(arm), branch, 1 / arm, track.lead))
    _slip(tape, line, track, to + SECOND, to + TRAVEL)


def _sliding_dyad(tape: Tape, step: SlidingDyad, inputs: list[str]) -> None:  # noqa: ARG001 - all writers alike
    to = tape.room(MARGIN + 1)
    (guide, body), mechanism = step.links, tape.mechanism
    hinges = [_between(mechanism, link, on) for link, on in zip(step.links, step.on, strict=True)]
    for link, on, hinge, row in zip(step.links, step.on, hinges, (to, to + SECOND), strict=True):
        tape.carry(on, tape.point(on, hinge), row)
        tape.rows[link], tape.at[link] = row, tape.point(link, hinge)
    root, at = tape.point(guide, step.slide), tape.point(body, step.slide)
    off = rpr.offset(tape.at[guide], root, tape.at[body], at, step.track)
    branch = tape.branches.get(step.slide, step.branch)
    tape.add(RPR, to, numbers=(off, branch, step.track.lead.conjugate(), step.track.twist, tape.span))


def _crossed_sliders(tape: Tape, step: CrossedSliders, inputs: list[str]) -> None:  # noqa: ARG001 - all writers alike
    to = tape.room(TRAVEL + LINE + 3)
    one, two = (
        _line(tape, (slider, on, step.pin), track, to + ZERO + k * LINE)
        for k, (slider, on, track) in enumerate(zip(step.sliders, step.on, step.tracks, strict=True))
    )
    first, second = (tape.rows[guide] for guide in step.on)
    tape.add(PRP, to, first, second, tuple(track.lead for track in step.tracks))
    _slip(tape, one, step.tracks[0], to, to + TRAVEL)
    _slip(tape, two, step.tracks[1], to + SECOND, to + TRAVEL + LINE)


def _cross_slide(tape: Tape, step: CrossSlide, inputs: list[str]) -> None:  # noqa: ARG001 - all writers alike
    to = tape.room(TRAVEL + 3)
    (link, slider), (on, guide), mechanism = step.bodies, step.on, tape.mechanism
    hinge, slide, between = (_between(mechanism, *two) for two in ((link, on), (slider, guide), (link, slider)))
    at = tape.point(link, hinge)
    tape.carry(on, tape.point(on, hinge), to)
    tape.rows[link], tape.at[link] = to, at
    inner = tape.point(slider, between), tape.point(link, between)
    arm = rpp.zero(tape.point(slider, slide), inner, at, (step.track.twist, step.twist))
    tape.carry(guide, tape.point(guide, slide), to + ZERO, arm)
    turned = step.track.twist
    tape.add(RPP, to, tape.rows[guide], numbers=(step.track.lead, turned * step.lead, turned * step.twist))
    _slip(tape, (slider, guide, slide), step.track, to + SECOND, to + TRAVEL)


def _line(tape: Tape, names: tuple[str, str, str], track: SlideTrack, zero: int) -> tuple[str, str, str]:
    """Write the position of a slider's pin at zero travel; slider, guide and slide."""
    slider, guide, pin = names
    slide = _between(tape.mechanism, slider, guide)
    reach = tape.point(slider, pin) - tape.point(slider, slide)
    tape.carry(guide, tape.point(guide, slide), zero, track.twist * reach)
    return slider, guide, slide


def _slip(tape: Tape, names: tuple[str, str, str], track: SlideTrack, to: int, travel: int) -> None:
    """Write the motion of a body on its guide: anchor, direction and rates."""
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
    DrivenCrank: _turn,
    DrivenSlider: _shift,
    RRRDyad: _dyad,
    SliderDyad: _slider_dyad,
    SlidingDyad: _sliding_dyad,
    CrossedSliders: _crossed_sliders,
    CrossSlide: _cross_slide,
}
"""The steps that have a compiled form, and how each is written."""
