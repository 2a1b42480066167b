"""The magazine of a head: the yarn tubes on their carrier, a drum or a slide, on an axle over the colours' motor."""

from collections.abc import Iterator

from ilmek.cams.loaded_plate_cam import STEEL
from ilmek.machines.weaver.design import Weaver
from ilmek.machines.weaver.head_shape import AXLE
from ilmek.machines.weaver.magazine import ALUMINIUM, CARRIER, DRUM, TUBE_BORE, TUBE_OUTER
from ilmek.machines.weaver.parts import TUBE
from ilmek.machines.weaver.tool_parts import part_id
from ilmek.part.part import Bought, Part
from ilmek.part.placement import UPRIGHT, placement
from ilmek.part.shapes import bar, tube
from ilmek.part.tree import Occurrence
from ilmek.units import format_quantity, mm, turn

TUBE_CARRIER, TUBE_AXLE = part_id("tube-carrier"), part_id("tube-axle")
"""Ids of the parts."""

AXLE_DIAMETER = 8 * mm
"""Of the axle between motor and carrier [m]; assumed by this project."""


def magazine_parts(weaver: Weaver) -> Iterator[Occurrence]:
    """Tubes in tiers, one on the other, the carrier below them, its axle; upright, about the axis of the magazine."""
    magazine, shape = weaver.magazine, weaver.shape
    pitch, flat = magazine.pitch, magazine.tubes_at
    depth = (shape.magazine + shape.magazine_size / 2).real
    low = (shape.magazine + shape.magazine_size / 2).imag - magazine.tiers * pitch / 2
    part = Part(
        TUBE,
        "yarn tube",
        "yarn tube",
        "one for each colour, with its share of the slide",
        tube(TUBE_OUTER * pitch, (TUBE_OUTER - TUBE_BORE) / 2 * pitch, pitch),
        purchase=Bought("yarn tube", weaver.params.tube_mass),
        envelope=True,
    )
    cells = (divmod(cell, magazine.per_tier) for cell in range(magazine.tubes))
    yield Occurrence(
        part,
        tuple(
            placement(float(flat[column].real), low + tier * pitch, depth + float(flat[column].imag)).after(UPRIGHT)
            for tier, column in cells
        ),
    )
    kind = "drum" if magazine.kind == DRUM else "slide"
    plate, size = magazine.carrier, f"{format_quantity(CARRIER, 'mm')} thick"
    carrier = Part(TUBE_CARRIER, f"{kind} of the yarn tubes", "machined link", size, plate, ALUMINIUM)
    lying = UPRIGHT.after(placement(about=(0.0, 0.0, 1.0), angle=turn / 4))
    yield Occurrence(carrier, (placement(0.0, low - CARRIER, depth).after(lying),))
    flange = shape.magazine.imag - CARRIER - AXLE
    size = f"round {format_quantity(AXLE_DIAMETER, 'mm')}"
    axle = Part(
        TUBE_AXLE, f"axle of the {kind}", "pin or bush", size, bar(AXLE_DIAMETER, low - CARRIER - flange), STEEL
    )
    yield Occurrence(axle, (placement(0.0, flange, depth).after(UPRIGHT),))
