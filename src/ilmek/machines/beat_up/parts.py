"""Parts of crank-rockers: links and pins, and where their drive stands.

Links have their first pin in the origin, x along them, z from 0 to their thickness. Crank and rocker run in one plane,
the coupler beside them; pins reach through both. The drive stands in line with the crank shaft, on the other side.
"""

from functools import lru_cache

from ilmek.machines.beat_up.design import BeatUp
from ilmek.machines.beat_up.links import LINKS, PART_IDS, pin_holes, pin_length, spans
from ilmek.machines.link_tree import JOURNAL, PIN_STEEL
from ilmek.part.flat_link import flat_link
from ilmek.part.part import Part, Seat
from ilmek.part.placement import placement
from ilmek.part.shapes import bar


def link_parts(linkage: BeatUp) -> dict[str, Part]:
    """Crank, coupler and rocker, bored for their pins."""
    params, drilled = linkage.params, pin_holes(linkage.lengths, linkage.hole)
    reaches = spans(linkage.lengths, params.before_beater)
    return {
        name: Part(
            PART_IDS[name],
            f"{name} of the beat-up",
            "machined link",
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
    shape, seats = bar(diameter, pin_length(linkage.params.thickness)), {JOURNAL: Seat(placement(), diameter)}
    return Part(PART_IDS["B"], "pin of the beat-up", "pin or bush", shape, PIN_STEEL, seats=seats)
