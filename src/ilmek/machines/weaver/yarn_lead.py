"""The pile yarn on the head: from the tube in line by a guide at the right side plate to the eye in the face.

    w = angle of the yarn's directions at tube, guide and eye        at the eye a quarter more: the handler draws across

The guide stands at the right, where no tool or lever comes: a straight yarn would pass through the grippers' carriages.
"""

from collections.abc import Iterator

import numpy as np

from ilmek.arrays import Float
from ilmek.cams.loaded_plate_cam import STEEL
from ilmek.machines.weaver.design import Weaver
from ilmek.machines.weaver.head_shape import BELL_CRANKS
from ilmek.machines.weaver.knife import eye_at
from ilmek.machines.weaver.tool_parts import part_id
from ilmek.machines.weaver.widths import stack_width
from ilmek.part.part import Part
from ilmek.part.placement import ALONG_WIDTH, placement
from ilmek.part.shapes import Placed, Sum, bar, tube
from ilmek.part.tree import Occurrence
from ilmek.units import mm, turn

YARN_GUIDE = part_id("yarn-guide")
"""Id of the part."""

RING, STEM = (5 * mm, 1 * mm, 4 * mm), 2 * mm
"""Diameter, wall and length of the guide, diameter of its stem [m]; assumed by this project, as all sizes here."""

INSIDE, OVER, ABOVE_AXLE, SHARE = 6 * mm, 9 * mm, 14.5 * mm, 0.43
"""Axis of the guide from the side plate, over the eye and over the bell cranks' axle at least [m], and its share of the
path from the eye to the tube.
"""


def yarn_line(weaver: Weaver) -> Float[np.ndarray, "3 3"]:
    """Tube, guide and eye: x along the row, y up, z from the warps [m]."""
    shape, eye = weaver.shape, eye_at(weaver)
    tube_top = complex(shape.magazine.real, (shape.magazine + shape.magazine_size).imag)
    inner, face = stack_width(weaver.params) / 2, shape.body.real
    axle = max(lever.pivot.imag for track, lever in shape.levers.items() if track in BELL_CRANKS)
    depth = face + SHARE * (tube_top.real - face)
    return np.array(
        [
            (0.0, tube_top.imag, tube_top.real + weaver.magazine.pitch / 2),
            (inner - INSIDE, max(eye.imag + OVER, axle + ABOVE_AXLE), depth),
            (eye.real, eye.imag, face),
        ]
    )


def guide_at(weaver: Weaver) -> complex:
    """Where the guide's stem is in the side plate, in the side view: z from the warps + i y [m]."""
    _, (_, y, z), _ = yarn_line(weaver)
    return complex(z, y)


def yarn_wraps(weaver: Weaver) -> tuple[float, float, float]:
    """Wrap of the yarn at tube, guide and eye [rad]: it comes up in its tube and is drawn across before the eye."""
    legs = np.diff(yarn_line(weaver), axis=0)
    legs /= np.linalg.norm(legs, axis=1)[:, None]
    headings = np.vstack([(0.0, 1.0, 0.0), legs, (0.0, 0.0, -1.0)])
    cosines = np.einsum("ij,ij->i", headings[:-1], headings[1:])
    angles = np.arccos(np.clip(cosines, -1.0, 1.0))
    return float(angles[0]), float(angles[1]), float(angles[2]) + turn / 4


def yarn_guide(weaver: Weaver) -> Iterator[Occurrence]:
    """The guide; its stem is pressed into the side plate."""
    if weaver.params.side_plate <= 0:
        return
    outer, wall, long = RING
    stem = Placed(
        bar(STEM, INSIDE - outer / 2 + weaver.params.side_plate),
        (ALONG_WIDTH.after(placement(y=long / 2, z=outer / 2)),),
    )
    ring = Sum((Placed(tube(outer, wall, long)), stem))
    _, (x, y, z), _ = yarn_line(weaver)
    part = Part(YARN_GUIDE, "guide of the pile yarn", "pin or bush", ring, STEEL)
    yield Occurrence(part, (placement(float(x), float(y), float(z) - long / 2),))
