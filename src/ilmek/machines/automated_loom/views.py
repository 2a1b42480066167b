"""A loom from the side, from the front and from above: projections of its parts, its warps and carpet, names and sizes.

Every part with a shape is drawn where the tree has it, at the start of a row; dashed: the rooms of parts whose form is
the maker's or not designed. The guards are drawn from above alone: from the front they stand before all else. What
stands beside the loom is left out of the side view.
"""

from collections.abc import Iterable
from dataclasses import replace
from itertools import pairwise

import numpy as np

from ilmek.arrays import ComplexArray
from ilmek.machines.arrangement.side_view import SideView
from ilmek.machines.automated_loom.beat_motion import beat_windows
from ilmek.machines.automated_loom.cyclogram import HEADS
from ilmek.machines.automated_loom.design import LoomDesign
from ilmek.machines.automated_loom.equipment.circuit import CIRCUIT
from ilmek.machines.automated_loom.equipment.creel_parts import CREEL, YARN_DUCT
from ilmek.machines.automated_loom.equipment.guards import GUARDS
from ilmek.machines.automated_loom.frame import part_id
from ilmek.machines.automated_loom.in_space.maker import ROW, half_width
from ilmek.machines.automated_loom.in_space.scene import loom_tree
from ilmek.machines.part_views import drawn
from ilmek.part.projection import PieceOutline, View, outlines
from ilmek.part.tree import Tree
from ilmek.report import Dot, Drawing, Stroke
from ilmek.timing.track import sample
from ilmek.units import format_quantity, turn

BESIDE = (CREEL, YARN_DUCT, CIRCUIT)
"""Bodies beside the loom and in its cabinet, which from the side stand before or behind it."""

NAMED = 16
"""Bodies that have a name in a drawing, at most: those that are seen largest."""

_APART = 0.056
"""Least distance of two names, in heights of the drawing."""

_WARPS = 40
"""Warps drawn from the front; a real loom has more."""


def side(loom: LoomDesign) -> Drawing:
    """The whole loom from the side."""
    view, seen = loom.side, outlines(_without(loom, *GUARDS, *BESIDE), View.SIDE)
    box = _box(seen)
    left = box.real[0]
    floor = np.array([left - 0.05, box.real[1] + 0.1]) + 1j * view.floor
    strokes = (
        Stroke(floor, "ground"),
        *_cloth(view),
        *drawn(seen),
        *_warp_lines(view),
        *_heights(view, left),
        *named(seen),
    )
    note = "every part but creel and guards, where it stands at the start of a row; the even shed is open"
    return Drawing("loom-side", "The loom from the side", strokes, (Dot(0j, "fell", "point"),), "m", note)


def front(loom: LoomDesign) -> Drawing:
    """The whole loom from the front, as the weaver sees it."""
    return _across(loom, View.FRONT, "loom-front", "The loom from the front")


def above(loom: LoomDesign) -> Drawing:
    """The whole loom from above."""
    return _across(loom, View.TOP, "loom-above", "The loom from above")


def room(loom: LoomDesign) -> Drawing:
    """What moves between fell and guide cams, at the start of a row, and dashed while it is beaten."""
    tree, windows = _without(loom, *GUARDS, *BESIDE), beat_windows(loom.row_cyclogram)
    low, high = -0.25 * loom.side.cams[0].at.imag, loom.side.cams[0].at.imag
    moving = {body.id for body in tree.bodies if body.joint.motion is not None}
    at_fell = _angle_at_fell(loom, windows[0])
    still = [outline for outline in outlines(tree, View.SIDE) if _inside(outline, low, high)]
    beaten = [one for one in outlines(tree, View.SIDE, ROW, at_fell) if one.body in moving and _inside(one, low, high)]
    strokes = (
        *_sheets(loom.side),
        Stroke(_carpet(loom.side, low), "yarn", "carpet", closed=True, filled=True),
        *drawn(still),
        *(Stroke(curve, "construction", closed=True) for one in beaten for curve in one.curves),
        *_room_dimensions(loom, low),
    )
    note = "the even shed is open; dashed: what moves, while the comb is at the fell and the heads are retreated"
    return Drawing(
        "loom-side-room", "Room between fell and guide cams", strokes, (Dot(0j, "fell", "point"),), "mm", note
    )


def _without(loom: LoomDesign, *left_out: str) -> Tree:
    """The bodies of a loom but those that stand before all that is seen."""
    tree = loom_tree(loom)
    return replace(tree, bodies=tuple(body for body in tree.bodies if body.id not in left_out))


def _angle_at_fell(loom: LoomDesign, window: tuple[float, float]) -> float:
    """The angle of the row at which the first beat is at the fell [rad]."""
    path, (start, end) = loom.beat.path, window
    return start + float(path.share[int(np.argmin(np.abs(path.tip)))]) * (end - start)


def _inside(outline: PieceOutline, low: float, high: float) -> bool:
    """Whether it lies between two heights and not far from the warps, or reaches a little beyond [m]."""
    every, middle = np.concatenate(outline.curves), outline.middle
    is_small = np.ptp(every.imag) < 1.5 * (high - low)
    return bool(is_small and low < middle.imag < 1.2 * high and abs(middle.real) < 1.2 * high)


def _across(loom: LoomDesign, view: View, name: str, title: str) -> Drawing:
    tree = _without(loom, *GUARDS) if view is View.FRONT else loom_tree(loom)
    seen, half = outlines(tree, view), half_width(loom)
    box = _box(seen)
    low, high = box.imag
    across = np.array([-half, half]) + 1j * (low - 0.06 * (high - low))
    lines = _upright_warps(loom) if view is View.FRONT else ()
    strokes = (
        *drawn(outline for outline in seen if outline.near <= 0),
        *lines,
        *drawn(outline for outline in seen if outline.near > 0),
        Stroke(across, "dimension", format_quantity(2 * half, "m")),
        *named(seen),
    )
    pitch = format_quantity(loom.task.cloth.warp_pitch, "mm", 4)
    note = f"{loom.warps} warps at {pitch}; every part where it stands at the start of a row"
    return Drawing(name, title, strokes, (), "m", note)


def _box(seen: Iterable[PieceOutline]) -> ComplexArray:
    """Lower left and upper right corner of all that is seen [m]."""
    every = np.concatenate([curve for outline in seen for curve in outline.curves])
    return np.array([complex(every.real.min(), every.imag.min()), complex(every.real.max(), every.imag.max())])


def named(seen: tuple[PieceOutline, ...]) -> tuple[Stroke, ...]:
    """Leaders from the bodies to their names at the right, in the order of their heights."""
    box = _box(seen)
    largest: dict[str, PieceOutline] = {}
    for outline in sorted(seen, key=_extent, reverse=True):
        largest.setdefault(_name(outline.body), outline)
    order = sorted(list(largest.items())[:NAMED], key=lambda item: _right_end(item[1]).imag)
    size = complex(box[1] - box[0])
    kink, end = box[1].real + 0.06 * size.real, box[1].real + 0.55 * max(size.real, size.imag)
    heights = spread([_right_end(outline).imag for _, outline in order], _APART * max(size.real, size.imag))
    return tuple(
        Stroke(np.array([complex(end, height), complex(kink, height), _right_end(outline)]), "construction", name)
        for height, (name, outline) in zip(heights, order, strict=True)
    )


def _name(body: str) -> str:
    """What a body is called: of a machine of the loom, after that."""
    return body.removeprefix(part_id("")).replace("/", ": ").replace("-", " ")


def _extent(outline: PieceOutline) -> float:
    every = np.concatenate(outline.curves)
    return float(np.hypot(np.ptp(every.real), np.ptp(every.imag)))


def _right_end(outline: PieceOutline) -> complex:
    every = np.concatenate(outline.curves)
    return complex(every[int(every.real.argmax())])


def _cloth(view: SideView) -> tuple[Stroke, ...]:
    """The carpet, and dashed the roll of the whole one."""
    around = np.exp(1j * np.linspace(0.0, turn, 73))
    return (
        Stroke(_carpet(view, view.lower.at.imag), "yarn", "carpet", closed=True, filled=True),
        Stroke(view.lower.at + view.roll * around, "construction", "whole carpet"),
    )


def _carpet(view: SideView, low: float) -> ComplexArray:
    back, pile = -view.room.warp, view.pile
    return np.array([complex(back, low), complex(pile, low), complex(pile, 0.0), complex(back, 0.0)])


def _warp_lines(view: SideView) -> tuple[Stroke, ...]:
    """Both sheets to the back rest, over it, and level to the upper cylinder."""
    rest, end = view.back_rest, 1j * view.spans.back_rest
    over = rest.at + rest.radius * np.exp(1j * np.linspace(0.0, turn / 4, 12))
    level = np.array([view.upper.at + 1j * view.upper.radius])
    lifted = (Stroke(np.array([0j, complex(cam.lift, cam.at.imag), end]), "yarn") for cam in view.cams)
    return (Stroke(np.concatenate([[0j], over, level]), "yarn", "warps"), *lifted)


def _sheets(view: SideView) -> tuple[Stroke, ...]:
    """The warps at rest and the lifted ones of the lowest cam shaft, to above its guide cams."""
    cam = view.cams[0]
    beyond = 1.25 * cam.guide_radius
    share = beyond / (view.spans.back_rest - cam.at.imag)
    peak, top = complex(cam.lift, cam.at.imag), complex((1 - share) * cam.lift, cam.at.imag + beyond)
    return Stroke(np.array([0j, 1j * top.imag]), "yarn", "warps"), Stroke(np.array([0j, peak, top]), "yarn")


def _upright_warps(loom: LoomDesign) -> tuple[Stroke, ...]:
    """Some of the warps from the front, from the fell to the back rest."""
    number, half = min(loom.warps, _WARPS), half_width(loom)
    columns = half * (2 * (np.arange(number) + 0.5) / number - 1)
    return tuple(Stroke(x + np.array([0.0, 1j * loom.side.spans.back_rest]), "yarn") for x in columns.tolist())


def _upright(x: float, low: float, high: float, name: str = "") -> Stroke:
    """A vertical dimension."""
    label = f"{name} {format_quantity(high - low, 'mm', 3)}".strip()
    return Stroke(np.array([complex(x, low), complex(x, high)]), "dimension", label)


def _heights(view: SideView, left: float) -> tuple[Stroke, ...]:
    """Dimensions at the left: spans, fell over the floor, the whole; below the floor: the depth."""
    inner, outer, rest = left - 0.08, left - 0.22, view.spans.back_rest
    cams = [0.0, *(cam.at.imag for cam in view.cams), rest]
    width = view.front + np.array([-view.loom_depth, 0.0]) + 1j * (view.floor - 0.1)
    return (
        _upright(inner, view.floor, 0.0),
        *(_upright(inner, low, high) for low, high in pairwise(cams)),
        _upright(outer, view.floor, view.top),
        Stroke(width, "dimension", format_quantity(view.loom_depth, "mm", 3)),
        *(Stroke(np.array([complex(inner, height), 1j * height]), "construction") for height in (0.0, rest)),
    )


def _room_dimensions(loom: LoomDesign, low: float) -> tuple[Stroke, ...]:
    """Front span, height of the weft and stroke of the beat at the left, the retreat of heads below."""
    view, cam = loom.side, loom.side.cams[0]
    left = cam.at.real - cam.guide_radius
    return (
        *(() if view.heads is None else (_retreat(loom, view.heads.shape.body.real, low),)),
        _upright(left - 0.02, 0.0, view.front_span, "front span"),
        _upright(left + 0.05, 0.0, view.weft_height, "weft"),
        _upright(left + 0.10, 0.0, view.beat_stroke, "beat"),
    )


def _retreat(loom: LoomDesign, corner: float, low: float) -> Stroke:
    """The dimension of the heads' retreat from the lower corner of their bodies, at a height [m]."""
    retreat = float(sample(loom.row_cyclogram.track(HEADS), np.linspace(0.0, turn, 721)).position.max())
    away = np.array([corner, corner + retreat]) + 1j * low
    return Stroke(away, "dimension", f"retreat {format_quantity(retreat, 'mm', 3)}")


def spread(heights: list[float], apart: float) -> list[float]:
    """Heights in ascending order, at least `apart` from each other, as near those given as that allows."""
    ascending = [heights[0]]
    for height in heights[1:]:
        ascending.append(max(height, ascending[-1] + apart))
    lower = (ascending[-1] - heights[-1]) / 2
    return [height - lower for height in ascending]
