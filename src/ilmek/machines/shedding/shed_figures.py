"""Figures of the shed: side view of the cam shafts with the warps between their holds, and a section of the stack."""

from itertools import pairwise

import numpy as np

from ilmek.arrays import ComplexArray
from ilmek.cams.programme import TURN
from ilmek.machines.shedding.cam_shaft import CamShaft
from ilmek.machines.shedding.design import SheddingDesign
from ilmek.report import Dot, Drawing, Stroke
from ilmek.units import format_quantity

_CIRCLE = np.exp(1j * np.linspace(0.0, TURN, 181))
_SECTION = 3.5, 2.0, -1.5
"""Edges of guide cams, of the lifted cam and of the section's foot over the warps' line, in pitches of the warps."""


def side_view(design: SheddingDesign) -> tuple[Drawing, ...]:
    """All cam shafts with the even shed fully open, the fell at the origin; nothing where no spans are given."""
    spans = design.params.spans_of_warp
    if spans is None:
        return ()
    front, back = spans
    top = front + design.shafts[-1].beyond + back
    strokes: list[Stroke] = [Stroke(np.array([0j, 1j * top]), "yarn", "warps at rest")]
    dots = [Dot(0j, "fell", "point"), Dot(1j * top, "back hold", "point")]
    for index, one in enumerate(design.shafts):
        axis = complex(-one.base_radius, front + one.beyond)
        tip = complex(one.params.lift, axis.imag)
        strokes += _shaft_strokes(one, axis)
        strokes.append(Stroke(np.array([0j, tip, 1j * top]), "yarn", "" if index else "lifted warps"))
        strokes.append(
            Stroke(np.array([axis.imag * 1j, tip]), "dimension", f"lift {format_quantity(one.params.lift, 'mm')}")
        )
        dots.append(Dot(axis, "", "pivot"))
    aside = -2.2 * max(shaft.stack.guide_radius for shaft in design.shafts)
    heights = [0.0, *(front + shaft.beyond for shaft in design.shafts), top]
    for low, high in pairwise(heights):
        strokes.append(
            Stroke(np.array([aside + 1j * low, aside + 1j * high]), "dimension", format_quantity(high - low, "mm"))
        )
    note = "the front of the loom is on the right; all lifted warps lie on one line from the fell"
    return (Drawing("side", "Cam shafts and warps with the even shed open", tuple(strokes), tuple(dots), note=note),)


def _shaft_strokes(shaft: CamShaft, axis: complex) -> list[Stroke]:
    """An even cam with its nose to the front, the bore, and the guides."""
    angle = np.linspace(0.0, TURN, 361)
    turned = np.exp(1j * (shaft.params.rise + shaft.params.dwell / 2))
    side = shaft.shaft.bar / 2
    bore = side * np.array([1 + 1j, -1 + 1j, -1 - 1j, 1 - 1j]) * turned
    guide = "guide cams" if shaft.stack.shares.guides else "outer edge of the reed"
    return [
        Stroke(axis + shaft.stack.guide_radius * _CIRCLE, "construction", guide, closed=True),
        Stroke(axis + shaft.cam.surface(angle) * turned, "outline", "", closed=True, filled=True),
        Stroke(axis + bore, "outline", "", closed=True),
    ]


def stack_section(design: SheddingDesign) -> Drawing:
    """Section of the first stack along its axis at the warps' line: cams at rest and lifted, guides, other warps."""
    one, params = design.first, design.params
    shares, pitch = one.stack.shares, one.stack.shares.pitch
    tall, nose, base = (share * params.cloth.warp_pitch for share in _SECTION)
    strokes: list[Stroke] = []
    for number, top in enumerate((0.0, nose)):
        left, right = number * pitch - shares.thickness / 2, number * pitch + shares.thickness / 2
        strokes.append(_box(left, right, base, top))
        warp = complex(number * pitch, top + params.diameter / 2)
        strokes.append(_warp(warp, params.diameter, "lifted warp" if number else "warp at rest"))
        if shares.guides:
            strokes.append(_box(right, right + shares.guide, base, tall))
        if shares.guides == 2 or (shares.guides and not number):
            strokes.append(_box(left - shares.guide, left, base, tall))
    strokes += _passing(design)
    low = base - 0.4 * params.cloth.warp_pitch
    strokes.append(Stroke(np.array([1j * low, pitch + 1j * low]), "dimension", f"pitch {format_quantity(pitch, 'mm')}"))
    thick, guide = format_quantity(shares.thickness, "mm"), format_quantity(shares.guide, "mm")
    others = (
        f"the highest plates are guide cams, {guide}"
        if shares.guides
        else f"a reed with dents of {guide} stands in front of and beyond this section"
    )
    note = f"under the warps: cams, {thick}, one at rest and one lifted, not to its whole height; {others}"
    return Drawing("stack", "Section of the stack at the warps' line", tuple(strokes), (), note=note)


def _passing(design: SheddingDesign) -> list[Stroke]:
    """Warps of the other shafts, evenly in the gap between the first cam with its guides and the second."""
    shares, diameter = design.first.stack.shares, design.params.diameter
    number = len(design.shafts) - 1
    start = shares.thickness / 2 + (shares.guide if shares.guides else 0.0)
    room = shares.pitch - 2 * start
    return [
        _warp(complex(start + room * (index + 0.5) / number, diameter / 2), diameter, "" if index else "passing warps")
        for index in range(number)
    ]


def _warp(at: complex, diameter: float, label: str) -> Stroke:
    return Stroke(at + diameter / 2 * _CIRCLE, "path", label, closed=True)


def _box(left: float, right: float, low: float, high: float) -> Stroke:
    corners: ComplexArray = np.array([left + 1j * low, right + 1j * low, right + 1j * high, left + 1j * high])
    return Stroke(corners, "outline", "", closed=True, filled=True)
