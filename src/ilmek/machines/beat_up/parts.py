"""Parts of crank-rockers: links and pins, and where their drive stands.

Links have their first pin in the origin, x along them, z from 0 to their thickness. Crank and rocker run in one plane,
the coupler beside them; pins reach through both. The drive stands in line with the crank shaft, on the other side.
"""

from collections.abc import Sequence
from functools import lru_cache

from ilmek.machines.beat_up.design import BeatUp
from ilmek.machines.beat_up.links import LINKS, PART_IDS, PIN_MATERIAL, pin_holes, pin_length, spans
from ilmek.part.flat_link import flat_link
from ilmek.part.part import Part, Seat
from ilmek.part.placement import placement
from ilmek.part.shapes import bar
from ilmek.part.tree import Occurrence
from ilmek.units import format_quantity, mm

JOURNAL = "journal"
"""Seat of a pin."""


def link_parts(linkage: BeatUp) -> dict[str, Part]:
    """Crank, coupler and rocker, bored for their pins."""
    params, drilled = linkage.params, pin_holes(linkage.lengths, linkage.hole)
    reaches = spans(linkage.lengths, params.before_beater)
    section = f"{format_quantity(params.width / mm, '')} x {format_quantity(params.thickness, 'mm')}"
    return {
        name: Part(
            PART_IDS[name],
            f"{name} of the beat-up",
            "machined link",
            f"{section}, {format_quantity(linkage.lengths[name], 'mm')}",
            flat_link(float(reaches[name]), params.width, params.thickness, drilled[name].values()),
            params.link_material,
            seats={pin: Seat(placement(float(hole.at)), float(hole.diameter)) for pin, hole in drilled[name].items()},
        )
        for name in LINKS
    }


@lru_cache(maxsize=16)
def pin_part(linkage: BeatUp) -> Part:
    """The pin of every joint."""
    diameter = linkage.pin
    return Part(
        PART_IDS["B"],
        "pin of the beat-up",
        "pin or bush",
        f"round {format_quantity(diameter, 'mm')}",
        bar(diameter, pin_length(linkage.params.thickness)),
        PIN_MATERIAL,
        seats={JOURNAL: Seat(placement(), diameter)},
    )


def in_line(parts: Sequence[Part], begin: float) -> tuple[Occurrence, ...]:
    """Parts behind one another from z = begin [m] towards -z, the last, a motor, with its flange to the others."""
    occurrences = []
    for part in parts[:-1]:
        begin -= depth_of(part)
        occurrences.append(Occurrence(part, (placement(z=begin),)))
    return (*occurrences, Occurrence(parts[-1], (placement(z=begin),)))


def depth_of(part: Part) -> float:
    """Length along z of a part from z = 0 [m]."""
    assert part.shape is not None
    return max(float(piece[:, 2].max()) for piece in part.shape.pieces(1 * mm))
