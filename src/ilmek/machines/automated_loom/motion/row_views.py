"""A row in motion from the side, from the front and from above: what moves of the loom's parts, warps and wefts.

Axes as in the views of the whole loom: from the side the front is at the right, across 0 is the middle of the cloth.
"""

import numpy as np

from ilmek.arrays import ComplexArray, FloatArray
from ilmek.machines.arrangement.side_view import SideView
from ilmek.machines.automated_loom.cyclogram import BEATER, EVEN, HEADS, ODD, TAKE_UP
from ilmek.machines.automated_loom.design import LoomDesign
from ilmek.machines.automated_loom.in_space.maker import ROW, half_width
from ilmek.machines.automated_loom.in_space.scene import loom_tree
from ilmek.machines.automated_loom.in_space.weft import wefts
from ilmek.machines.part_views import moving_bodies, named_strokes
from ilmek.machines.weaver.tree import HEAD
from ilmek.part.projection import MovingOutline, View, moving_outlines
from ilmek.report import Animation, Axis, Dot, Drawing, MovingStroke, Reading, Stroke
from ilmek.timing.track import sample
from ilmek.units import turn

FRAMES = 72
DRIVE = Axis("angle of the row", "deg")

_LINES = 24
"""Warps drawn; a real loom has more."""

_CLOTH = 0.12
"""Height of the cloth below the fell that is drawn, in widths of the cloth."""

_LARGEST = 2
"""Parts of a body that are drawn: those that are seen largest."""


def row_from_the_side(loom: LoomDesign) -> Animation:
    """A row from the side; what lays the wefts is drawn only while it is in the shed."""
    angle, row, view = _angles(), loom.row_cyclogram, loom.side
    sheets = (MovingStroke(_sheet(view, sample(row.track(name), angle).position), "yarn", name) for name in (EVEN, ODD))
    strokes = (*sheets, *named_strokes(_in_the_shed(outline, loom) for outline in _moving(loom, View.SIDE)))
    low = 1j * min(-view.lower.radius, *((view.heads.shape.body.imag,) if view.heads else ()), 0.0)
    carpet = np.array([-view.room.warp + low, view.pile + low, view.pile, -view.room.warp])
    still = Drawing(
        "loom-row-moving",
        "A row from the side",
        (Stroke(carpet, "yarn", "carpet", closed=True, filled=True),),
        (Dot(0j, "fell", "point"),),
        note="over the angle of the row's cyclogram; shuttles and their carriage are drawn while they are in the shed",
    )
    return _animation(loom, still, strokes, (EVEN, ODD, *((HEADS,) if loom.heads else ())))


def row_from_the_front(loom: LoomDesign) -> Animation:
    """What beats, and what lays the wefts, before the warps. The heads, which stand in front of them, are not drawn."""
    half, top = half_width(loom), 1.3 * float(loom.side.cams[0].at.imag)
    cloth = np.array([-half, half, half - 2j * _CLOTH * half, -half - 2j * _CLOTH * half])
    warps = (Stroke(np.array([x, x + 1j * top]), "construction") for x in np.linspace(-half, half, _LINES))
    still = Drawing(
        "loom-row-front",
        "A row from the front",
        (Stroke(cloth, "yarn", closed=True, filled=True), *warps),
        (Dot(complex(-half), "fell", "point"),),
        note=f"{_LINES} of {loom.warps} warps are drawn, and no heads, which stand in front",
    )
    seen = named_strokes(outline for outline in _moving(loom, View.FRONT) if outline.body != HEAD)
    strokes = (*seen, *_wefts(loom, View.FRONT))
    return _animation(loom, still, strokes, (loom.row_timing.carrier, BEATER, TAKE_UP))


def row_from_above(loom: LoomDesign) -> Animation:
    """Both sheets of warps at the height of the wefts, and all that moves, from above."""
    angle, row, half = _angles(), loom.row_cyclogram, half_width(loom)
    share = loom.side.weft_height / float(loom.side.cams[0].at.imag)
    ends = np.array([-half, half])
    sheets = (
        MovingStroke(ends - 1j * share * sample(row.track(name), angle).position[:, None], "yarn", name)
        for name in (EVEN, ODD)
    )
    note = "the sheets of warps at the height of the wefts; the weaver stands below the picture"
    still = Drawing("loom-row-above", "A row from above", (Stroke(ends + 0j, "yarn", "fell"),), note=note)
    strokes = (*sheets, *named_strokes(_moving(loom, View.TOP)), *_wefts(loom, View.TOP))
    return _animation(loom, still, strokes, (EVEN, ODD, *((HEADS,) if loom.heads else ())))


def _angles() -> FloatArray:
    return np.arange(FRAMES) * (turn / FRAMES)


def _animation(
    loom: LoomDesign, still: Drawing, strokes: tuple[MovingStroke, ...], names: tuple[str, ...]
) -> Animation:
    angle, row = _angles(), loom.row_cyclogram
    tracks = [row.track(name) for name in names]
    readings = tuple(Reading(track.name, sample(track, angle).position, track.unit) for track in tracks)
    return Animation(still, DRIVE, angle, strokes, (), period=row.period, readings=readings)


def _moving(loom: LoomDesign, view: View) -> tuple[MovingOutline, ...]:
    """What moves over a row but the tools of the heads: of each body the parts that are seen largest."""
    tree = loom_tree(loom)
    bodies = moving_bodies(tree, ROW, but=HEAD)
    chosen: dict[str, list[MovingOutline]] = {body: [] for body in bodies}
    for outline in sorted(moving_outlines(tree, view, ROW, _angles(), bodies), key=_size, reverse=True):
        if len(chosen[outline.body]) < _LARGEST or (outline.body == HEAD and outline.part is chosen[HEAD][0].part):
            chosen[outline.body].append(outline)
    return tuple(outline for outlines in chosen.values() for outline in outlines)


def _size(outline: MovingOutline) -> float:
    return float(np.hypot(np.ptp(outline.points[0].real), np.ptp(outline.points[0].imag)))


def _in_the_shed(outline: MovingOutline, loom: LoomDesign) -> MovingOutline:
    """The outline as a point while it is beside the cloth and something that lays wefts."""
    carriers = {body.id for body in loom.weft.bodies.tree.bodies}
    outside = np.abs(outline.depth) > half_width(loom)
    if outline.body not in carriers or not outside.any():
        return outline
    middle = outline.points.mean(axis=1, keepdims=True)
    points = np.where(outside[:, None], middle, outline.points)
    return MovingOutline(outline.part, outline.body, points, outline.depth)


def _sheet(view: SideView, lift: FloatArray) -> ComplexArray:
    """From the fell over the point of lift to the back rest, cut above the guide cams."""
    cam, rest = view.cams[0], 1j * view.spans.back_rest
    lifted = lift + 1j * float(cam.at.imag)
    return np.stack([np.zeros_like(lifted), lifted, lifted + 0.5 * (rest - lifted)], axis=1)


def _wefts(loom: LoomDesign, view: View) -> tuple[MovingStroke, ...]:
    """Both wefts as the scene has them."""
    strokes = []
    for yarn in wefts(loom):
        ends = yarn.points.transpose(1, 2, 0)
        frames = [np.array([np.interp(_angles(), yarn.angle, axis) for axis in end]) for end in ends]
        seen = [view.rotation @ frame for frame in frames]
        strokes.append(MovingStroke(np.stack([at[0] + 1j * at[1] for at in seen], axis=1), "yarn", yarn.title))
    return tuple(strokes)
