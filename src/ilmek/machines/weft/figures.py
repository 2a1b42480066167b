"""Figures of the weft side: the carrier in the shed, its plan, its motion, the weft left on the bobbins."""

import numpy as np

from ilmek.machines.weft.animation import moving
from ilmek.machines.weft.bobbin import Winding
from ilmek.machines.weft.design import Weft
from ilmek.machines.weft.rapier import DRIVE
from ilmek.machines.weft.shuttle import BOX_END, Shuttle
from ilmek.report import Animation, Axis, Drawing, Figure, Plot, Series, Stroke
from ilmek.units import format_quantity

MOST_ROWS = 400
"""Rows over which the weft on a bobbin is drawn."""


def figures(weft: Weft) -> tuple[Figure, ...]:
    """All figures, in the order of the report."""
    wound = (bobbin_plot(weft),) if weft.bobbins else ()
    return (shed_drawing(weft), plan_drawing(weft), moving_plan(weft), *motion_plots(weft), *wound)


def shed_drawing(weft: Weft) -> Drawing:
    """The carrier in the open shed, which is as wide at its lower edge as the carrier needs: a wedge from the fell."""
    params, carried = weft.params, weft.carried
    wide, opening = carried.opening, params.open_share * params.lift
    above = 2.5 * carried.width
    span = above / max(1 - wide / opening, 0.1)
    low = span * wide / opening
    left = (params.cloth.carpet_yarns.warp.diameter + 2 * params.play) / 2
    middle = left + carried.depth / 2 + 1j * (low + carried.width / 2)
    corners = np.array([-1 - 1j, 1 - 1j, 1 + 1j, -1 + 1j]) / 2
    carrier = middle + corners.real * carried.depth + 1j * corners.imag * carried.width
    strokes = (
        Stroke(np.array([0, 1.1j * span]), "yarn", "warps at rest"),
        Stroke(np.array([0, opening + 1j * span]), "yarn", "lifted warps"),
        Stroke(np.array([-0.4 * opening, 1.2 * opening]) + 0j, "ground", "fell"),
        Stroke(np.array([-0.2 * opening, 1.2 * opening]) + 1j * span, "construction", "axis of the cams"),
        Stroke(carrier, "outline", params.carrier, closed=True),
        Stroke(np.array([0, opening]) + 1.1j * span, "dimension", format_quantity(opening, "mm", 3)),
        Stroke(np.array([0, wide]) + 1j * low, "dimension", format_quantity(wide, "mm", 3)),
        *_wound(weft, middle),
    )
    note = "as near to the fell as it has room; in a loom the side view states where it runs"
    return Drawing("weft-shed", "The carrier in the open shed, from the side", strokes, note=note)


def _wound(weft: Weft, middle: complex) -> tuple[Stroke, ...]:
    """The bobbin in the shuttle, or the tube of the rapier."""
    circle = np.exp(2j * np.pi * np.arange(49) / 48)
    if isinstance(weft.carried, Shuttle):
        size = weft.carried.bobbin
        return tuple(Stroke(middle + circle * r / 2, "path") for r in (size.diameter, size.core))
    tall, wide, _ = weft.carried.tube
    corners = np.array([-wide - 1j * tall, wide - 1j * tall, wide + 1j * tall, -wide + 1j * tall]) / 2
    return (Stroke(middle + corners, "path", closed=True),)


def plan_drawing(weft: Weft) -> Drawing:
    """Cloth, carriers at rest and their room, seen along the warps; depth drawn larger."""
    cloth, edge, deep = weft.params.cloth.width, weft.params.edge, _depth(weft)
    carried = weft.carried
    strokes = [*_standing(weft), Stroke(np.array([0, cloth]) - 2j * deep, "dimension", format_quantity(cloth, "m"))]
    if isinstance(carried, Shuttle):
        length = carried.length
        left = -edge - length
        strokes += [
            _box((left, left + length, 0.1 * deep, 0.9 * deep), "outline", "straight weft"),
            _box((cloth + edge, cloth + edge + length, 1.1 * deep, 1.9 * deep), "outline", "sinuous weft"),
            Stroke(np.array([left, 0]) + 3j * deep, "dimension", format_quantity(edge + length, "mm", 3)),
        ]
        note = "each box has two cells: one shuttle arrives, the other leaves"
    else:
        length = carried.length
        strokes += [
            _box((-edge - length, -edge, 0.2 * deep, 0.8 * deep), "outline", "rapier"),
            Stroke(np.array([-edge - length, 0]) + 3j * deep, "dimension", format_quantity(edge + length, "m", 3)),
        ]
        note = "the rapier takes the weft at the packages' edge and draws it back"
    strokes.append(Stroke(np.array([-edge, cloth + edge]) + 0.5j * deep, "path"))
    return Drawing("weft-plan", "The weft side in plan", tuple(strokes), unit="m", note=f"{note}; true along the width")


def moving_plan(weft: Weft) -> Animation:
    """The plan in motion."""
    shuttles = isinstance(weft.carried, Shuttle)
    note = "two rows, without the time between the passages" if shuttles else "one passage"
    note = f"{note}; true along the width"
    still = Drawing("weft-moving", "The weft side in motion", tuple(_standing(weft)), unit="m", note=note)
    return moving(weft, still, (0.5 * _depth(weft), 1.5 * _depth(weft)))


def _depth(weft: Weft) -> float:
    """Depth of a cell in plan, drawn larger [m]."""
    return 0.06 * weft.params.cloth.width


def _standing(weft: Weft) -> list[Stroke]:
    """What stands still in plan: cloth, and the boxes of shuttles or the drive and the packages of a rapier."""
    cloth, edge, deep = weft.params.cloth.width, weft.params.edge, _depth(weft)
    length = weft.carried.length
    strokes = [_box((0.0, cloth, -deep, 0.0), "yarn", "cloth")]
    if isinstance(weft.carried, Shuttle):
        bay = length + BOX_END
        return [
            *strokes,
            _box((-edge - bay, -edge, 0.0, 2 * deep), "construction", ""),
            _box((cloth + edge, cloth + edge + bay, 0.0, 2 * deep), "construction", "box"),
        ]
    return [
        *strokes,
        _box((-edge - length - DRIVE, -edge - length, 0.0, deep), "outline", "drive"),
        _box((cloth + edge, cloth + edge + 2 * deep, 0.0, 2 * deep), "outline", "packages"),
    ]


def _box(bounds: tuple[float, float, float, float], role: str, label: str) -> Stroke:
    """A rectangle; bounds: left, right, low, high [m]."""
    left, right, low, high = bounds
    corners = np.array([left + 1j * low, right + 1j * low, right + 1j * high, left + 1j * high])
    return Stroke(corners, role, label, closed=True)


def motion_plots(weft: Weft) -> tuple[Plot, Plot]:
    """Position, and speed, of the carrier over the time of its shortest passage."""
    passage = weft.passage
    time = np.linspace(0.0, passage.time, 361)
    position, speed, _, _ = passage.at(time)
    cloth = np.array([0.0, passage.time])
    edges = tuple(
        Series(name, cloth, np.full(2, at), dashed=True)
        for name, at in (("edge", passage.run), ("other edge", passage.run + weft.params.cloth.width))
    )
    over = Axis("time", "s")
    place = Axis("position", "mm")
    note = "a wider window of the shed stretches this motion"
    return (
        Plot(
            "weft-position",
            "Position of the carrier over a passage",
            over,
            place,
            (Series(weft.params.carrier, time, position), *edges),
            note=note,
        ),
        Plot(
            "weft-speed",
            "Speed of the carrier over a passage",
            over,
            Axis("speed", "m/s"),
            (Series(weft.params.carrier, time, speed),),
        ),
    )


def bobbin_plot(weft: Weft) -> Plot:
    """Weft left on the bobbins over the rows: each row takes its length, each stop brings a full one."""
    assert isinstance(weft.carried, Shuttle)
    last = min(weft.params.rows, MOST_ROWS)
    series = tuple(_left(winding, last) for winding in weft.carried.windings)
    axes = Axis("rows of knots woven"), Axis("weft on the bobbin", "m")
    return Plot("weft-bobbins", "Weft on the bobbins", *axes, series, note="each jump is a stop of the loom")


def _left(one: Winding, last: int) -> Series:
    """Weft left on a bobbin up to a row: down to what a stop finds, up to a full one."""
    lasts = max(1, one.rows)
    starts = np.arange(0, last + 1, lasts)
    ends = np.minimum(starts + lasts, last)
    rows = np.column_stack([starts, ends]).ravel().astype(float)
    left = np.column_stack([np.full(len(starts), one.capacity), one.capacity - one.a_row * (ends - starts)]).ravel()
    return Series(one.name, rows, left)
