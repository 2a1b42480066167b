"""The side view of a loom, to scale: the whole, what moves between fell and guide cams, and both over a row."""

from itertools import pairwise

import numpy as np

from ilmek.arrays import ComplexArray
from ilmek.machines.arrangement.side_view import RETREAT, CamPosition, RoundPart, SideBox, SideView, rectangle
from ilmek.machines.automated_loom.design import LoomDesign
from ilmek.machines.automated_loom.parts import built_side
from ilmek.report import Dot, Drawing, Stroke
from ilmek.units import format_quantity, turn

_AROUND = np.exp(1j * turn * np.arange(73) / 72)
_COLUMN = 0.1
"""Depth of a column as drawn [m]."""

_SEEN = 0.01
"""Width of a path that is seen beside the warps [m]."""

_APART = 0.062
"""Least distance of two names, in heights of the drawing."""


def side(loom: LoomDesign) -> Drawing:
    """The whole loom from the side, the even shed open, the comb at rest, a head at the fell."""
    view = built_side(loom)
    left, right = -view.loom_depth + view.retreat * RETREAT.real + _front(view), _front(view)
    strokes = (
        *_frame(view, left, right),
        *_warps(view),
        *_cylinders(view),
        *_cams(view),
        *_moving(view),
        *_heights(view, left),
        *_names(view, right),
    )
    note = "floor, columns, cylinders, cams, comb and heads true to scale; the even shed is open, the comb at rest"
    return Drawing("loom-side", "The loom from the side", strokes, _axes(view), "m", note)


def room(loom: LoomDesign) -> Drawing:
    """What moves between fell and guide cams: at rest, and swept."""
    view, path = built_side(loom), loom.beat.path
    lowest = view.cams[0]
    sight = complex(lowest.at.real - lowest.guide_radius, lowest.at.imag)
    arc = np.exp(1j * np.linspace(-0.5, 0.15, 40) * turn)
    stroke = path.tip[np.linspace(0, int(np.argmin(np.abs(path.tip))), 40).astype(int)]
    strokes = (
        Stroke(lowest.at + lowest.guide_radius * arc, "outline", "guide cams"),
        *_sheets(view, lowest),
        Stroke(_carpet(view, -0.12), "yarn", "carpet", closed=True, filled=True),
        *(Stroke(polygon, "outline", "comb at rest", closed=True, filled=True) for polygon in view.comb),
        *(Stroke(polygon, "construction", closed=True) for polygon in path.outline),
        *((Stroke(stroke, "path", "path of the comb's tip"),) if np.ptp(stroke.real) > _SEEN else ()),
        Stroke(rectangle(view.carrier), "outline", closed=True, filled=True),
        *_head(view, 0.0, "outline", "head while it knots"),
        *_head(view, view.retreat * RETREAT, "construction"),
        *_room_dimensions(view, sight.real),
    )
    note = "the even shed is open; dashed: the comb at the fell, the heads retreated as in the row"
    dots = Dot(0j, "fell", "point"), Dot(view.carrier.corner + view.carrier.size / 2, "carrier", "point")
    return Drawing("loom-side-room", "Room between fell and guide cams", strokes, dots, "mm", note)


def _front(view: SideView) -> float:
    """The foremost x while the heads knot [m]."""
    return (view.rail.corner + view.rail.size).real


def _circle(part: RoundPart, radius: float | None = None) -> ComplexArray:
    return np.asarray(part.at + (part.radius if radius is None else radius) * _AROUND)


def _carpet(view: SideView, low: float) -> ComplexArray:
    return rectangle(SideBox(complex(-view.room.warp, low), complex(view.pile, -low)))


def _frame(view: SideView, left: float, right: float) -> tuple[Stroke, ...]:
    """Floor and one column, behind the others."""
    column = SideBox(complex(view.column - _COLUMN / 2, view.floor), complex(_COLUMN, view.top - view.floor))
    floor = np.array([left - 0.05, right + 0.1]) + 1j * view.floor
    return Stroke(floor, "ground"), Stroke(rectangle(column), "construction", closed=True)


def _warps(view: SideView) -> tuple[Stroke, ...]:
    """Both sheets to the back rest, over it, and level to the upper cylinder."""
    rest, end = view.back_rest, 1j * view.spans.back_rest
    over = rest.at + rest.radius * np.exp(1j * np.linspace(0.0, turn / 4, 12))
    level = np.array([view.upper.at + 1j * view.upper.radius])
    lifted = (Stroke(np.array([0j, complex(cam.lift, cam.at.imag), end]), "yarn") for cam in view.cams)
    return (Stroke(np.concatenate([[0j], over, level]), "yarn"), *lifted)


def _sheets(view: SideView, cam: CamPosition) -> tuple[Stroke, ...]:
    """The warps at rest and the lifted ones of a cam shaft, to above its guide cams."""
    above = 1.25 * cam.guide_radius
    share = above / (view.spans.back_rest - cam.at.imag)
    peak, top = complex(cam.lift, cam.at.imag), complex((1 - share) * cam.lift, cam.at.imag + above)
    return Stroke(np.array([0j, 1j * top.imag]), "yarn", "warps"), Stroke(np.array([0j, peak, top]), "yarn")


def _cylinders(view: SideView) -> tuple[Stroke, ...]:
    return (
        Stroke(_carpet(view, view.lower.at.imag), "yarn", closed=True, filled=True),
        *(
            Stroke(_circle(one), "outline", filled=True)
            for one in (view.upper, view.back_rest, view.spacer, view.lower)
        ),
        Stroke(_circle(view.lower, view.roll), "construction"),
        Stroke(rectangle(view.compensator), "construction", closed=True),
    )


def _cams(view: SideView) -> tuple[Stroke, ...]:
    return tuple(
        Stroke(cam.at + radius * _AROUND, role)
        for cam in view.cams
        for radius, role in ((cam.guide_radius, "outline"), (-cam.at.real, "construction"))
    )


def _moving(view: SideView) -> tuple[Stroke, ...]:
    """Comb at rest, carrier, a head at the fell and retreated, and the rail."""
    return (
        *(Stroke(polygon, "outline", closed=True, filled=True) for polygon in view.comb),
        Stroke(rectangle(view.carrier), "outline", closed=True, filled=True),
        *_head(view, 0.0, "outline"),
        *_head(view, view.retreat * RETREAT, "construction"),
        Stroke(rectangle(SideBox(view.head.magazine, view.head.magazine_size)), "outline", closed=True),
        Stroke(rectangle(view.rail), "outline", closed=True),
        Stroke(rectangle(view.rail) + view.retreat * RETREAT, "construction", closed=True),
    )


def _head(view: SideView, away: complex, role: str, label: str = "") -> tuple[Stroke, ...]:
    """The head's body and its tools, at a distance from where they knot [m]."""
    body = SideBox(view.head.body, view.head.size)
    face = body.corner.real
    tools = (SideBox(tool.corner, complex(face - tool.corner.real, tool.size.imag)) for tool in view.head.tools)
    boxes = (body, *(tool for tool in tools if tool.size.real > 0))
    return tuple(
        Stroke(rectangle(box) + away, role, label if not number else "", closed=True)
        for number, box in enumerate(boxes)
    )


def _axes(view: SideView) -> tuple[Dot, ...]:
    axes = (*(cam.at for cam in view.cams), view.upper.at, view.spacer.at, view.lower.at)
    return tuple(Dot(at, "", "point") for at in axes)


def _upright(x: float, low: float, high: float, name: str = "") -> Stroke:
    """A vertical dimension."""
    label = f"{name} {format_quantity(high - low, 'mm', 3)}".strip()
    return Stroke(np.array([complex(x, low), complex(x, high)]), "dimension", label)


def _heights(view: SideView, left: float) -> tuple[Stroke, ...]:
    """Dimensions at the left: spans, fell over the floor, the whole; below the floor: the depth."""
    inner, outer, rest = left - 0.08, left - 0.22, view.spans.back_rest
    cams = [0.0, *(cam.at.imag for cam in view.cams), rest]
    width = np.array([left, left + view.loom_depth]) + 1j * (view.floor - 0.1)
    return (
        _upright(inner, view.floor, 0.0),
        *(_upright(inner, low, high) for low, high in pairwise(cams)),
        _upright(outer, view.floor, view.top),
        Stroke(width, "dimension", format_quantity(view.loom_depth, "mm", 3)),
        *(Stroke(np.array([complex(inner, height), 1j * height]), "construction") for height in (0.0, rest)),
    )


def _room_dimensions(view: SideView, left: float) -> tuple[Stroke, ...]:
    """Front span, height of the weft and stroke of the beat at the left, the retreat below the head."""
    corner = view.head.body
    away = corner - 0.06j + np.array([0.0, view.retreat]) * RETREAT
    return (
        _upright(left - 0.02, 0.0, view.front_span, "front span"),
        _upright(left + 0.05, 0.0, view.weft_height, "weft"),
        _upright(left + 0.10, 0.0, view.beat_stroke, "beat"),
        Stroke(away, "dimension", f"retreat {format_quantity(view.retreat, 'mm', 3)}"),
    )


def _names(view: SideView, right: float) -> tuple[Stroke, ...]:
    """Leaders from the parts to their names at the right, in the order of their heights."""
    kink = right + view.retreat * RETREAT.real + 0.06
    end = kink + 0.56
    named = {
        "upper cylinder": view.upper.at + view.upper.radius,
        "back rest": view.back_rest.at + view.back_rest.radius,
        "tension compensator": view.compensator.corner + view.compensator.size,
        **{
            f"guide cams{f' {number + 1}' if len(view.cams) > 1 else ''}": cam.at + cam.guide_radius * np.exp(0.6j)
            for number, cam in enumerate(view.cams)
        },
        "comb at rest": complex(max(one.real.max() for one in view.comb), view.comb[0].imag.mean()),
        "carrier of the weft": view.carrier.corner + view.carrier.size.real,
        "rail of the heads": view.rail.corner + view.rail.size,
        "knotting head": view.head.body + view.head.size,
        "yarns of the head": view.head.magazine + view.head.magazine_size.real / 2,
        "spacer cylinder": view.spacer.at + view.spacer.radius * np.exp(-0.9j),
        "carpet": complex(view.pile, (view.lower.at + view.spacer.at).imag / 2),
        "lower cylinder, full": view.lower.at + view.roll,
    }
    order = sorted(named, key=lambda name: named[name].imag)
    heights = spread([named[name].imag for name in order], _APART * (view.top - view.floor))
    return tuple(
        Stroke(np.array([complex(end, height), complex(kink, height), named[name]]), "construction", name)
        for name, height in zip(order, heights, strict=True)
    )


def spread(heights: list[float], apart: float) -> list[float]:
    """Heights in ascending order, at least `apart` from each other, as near those given as that allows."""
    spread = [heights[0]]
    for height in heights[1:]:
        spread.append(max(height, spread[-1] + apart))
    lower = (spread[-1] - heights[-1]) / 2
    return [height - lower for height in spread]
