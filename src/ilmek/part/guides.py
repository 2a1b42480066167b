"""Linear guides from the rows of their catalogue: rail and carriage, each with the room that it takes."""

import numpy as np

from ilmek.elements.linear_guides import LinearGuide
from ilmek.part.part import Bought, HolePattern, Part
from ilmek.part.profile import Profile
from ilmek.part.shapes import Prism, rectangle
from ilmek.plane.contours import polygon
from ilmek.units import format_quantity


def guide_rail(name: str, title: str, row: LinearGuide, length: float) -> Part:
    """The rail of a linear guide along z, its base on y = 0, upwards."""
    section = polygon(rectangle(row.rail, row.rail_height).points + 0.5j * row.rail_height)
    holes = HolePattern(0.0, row.pitch, row.rail_screw, in_rows=True, faces=(0,))
    bought = Bought(f"rail {row.name}", row.line_mass * length, length=length, holes=(holes,))
    return Part(
        name,
        title,
        "linear guide",
        Prism(Profile(section), length),
        purchase=bought,
        size=format_quantity(length, "mm", 4),
    )


def guide_block(name: str, title: str, row: LinearGuide) -> Part:
    """The carriage of a linear guide along z from z = 0, over its rail, whose base is on y = 0."""
    half, inner, low = row.block / 2, row.rail / 2, row.height / 5
    corners = [-half, -inner, -inner, inner, inner, half, half, -half]
    heights = [low, low, row.rail_height, row.rail_height, low, low, row.height, row.height]
    section = Profile(polygon(np.array(corners) + 1j * np.array(heights)))
    holes = HolePattern(*row.holes, row.block_screw, tapped=True, faces=(0,))
    bought = Bought(f"carriage {row.name}", row.block_mass, holes=(holes,))
    return Part(name, title, "guide carriage", shape=Prism(section, row.block_length), purchase=bought)
