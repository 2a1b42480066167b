"""The weft side in motion: the carrier through the shed, and the weft that it lays."""

import numpy as np

from ilmek.arrays import ComplexArray, FloatArray
from ilmek.machines.weft.design import Weft
from ilmek.machines.weft.shuttle import Shuttle
from ilmek.report import Animation, Axis, Drawing, MovingStroke, Reading

FRAMES = 30
"""Frames of a passage."""


def moving(weft: Weft, plan: Drawing, cells: tuple[float, float]) -> Animation:
    """Both shuttles over two rows, or the rapier there and back, in plan.

    plan    what stands still
    cells   positions across the width of the plan of the first and of the second carrier [m]
    """
    passage = weft.passage
    time = np.arange(FRAMES) * (passage.time / FRAMES)
    motion = passage.at(time)
    if isinstance(weft.carried, Shuttle):
        strokes, motion = _shuttles(weft, weft.carried, motion, cells)
        passages = 4
    else:
        strokes, passages = _rapier(weft, weft.carried.length, motion, cells[0]), 1
    at = np.arange(passages * FRAMES) * (passage.time / FRAMES)
    readings = (
        Reading("position of the carrier", motion[0], "mm"),
        Reading("speed", motion[1], "m/s"),
        Reading("acceleration", motion[2], "m/s^2"),
    )
    period = float(passages * passage.time)
    return Animation(plan, Axis("time", "s"), at, strokes, (), period=period, readings=readings)


def _shuttles(
    weft: Weft, carried: Shuttle, motion: FloatArray, cells: tuple[float, float]
) -> tuple[tuple[MovingStroke, ...], FloatArray]:
    """Two rows: the straight weft to the right, the sinuous weft to the left, and both back; motion of the moving one.

    A shuttle waits in its box while the other passes.
    """
    distance, cloth = motion[0], weft.params.cloth.width
    stroke, rest = float(weft.passage.stroke), np.zeros(FRAMES)
    there, back = distance, stroke - distance
    straight = np.concatenate([there, rest + stroke, back, rest])
    sinuous = np.concatenate([rest + stroke, back, rest, there])
    signs = np.repeat([1.0, -1.0, -1.0, 1.0], FRAMES)
    moved = (np.concatenate([there, back, back, there]), *(np.tile(one, 4) * signs for one in motion[1:3]))
    strokes: list[MovingStroke] = []
    # A weft runs from the edge of its last turn to its shuttle.
    for label, where, height, edges in (
        ("straight weft", straight, cells[0], [0.0, cloth, cloth, 0.0]),
        ("sinuous weft", sinuous, cells[1], [cloth, cloth, 0.0, 0.0]),
    ):
        middle = where - weft.passage.run + 1j * height
        strokes += [
            MovingStroke(np.stack([np.repeat(edges, FRAMES) + 0j, middle], axis=1), "path", label),
            MovingStroke(middle[:, None] + _box(carried.length, cells), "outline", closed=True),
        ]
    return tuple(strokes), np.array(moved)


def _rapier(made: Weft, length: float, motion: FloatArray, height: float) -> tuple[MovingStroke, ...]:
    """The rapier to the packages' edge; on its path back it draws the weft."""
    head = motion[0] - made.passage.run + 1j * height
    far = made.params.cloth.width + made.params.edge + 1j * height
    drawn = np.arange(FRAMES) * 2 >= FRAMES
    weft = np.stack([head, np.where(drawn, far, head)], axis=1)
    return (MovingStroke(weft, "path", "weft"), MovingStroke(np.stack([head - length, head], axis=1), "link", "rapier"))


def _box(length: float, cells: tuple[float, float]) -> ComplexArray:
    """The shuttle's outline about its middle; its width is that of a cell, drawn larger."""
    half = 0.4 * abs(cells[1] - cells[0])
    return np.array([-1, 1, 1, -1]) * length / 2 + 1j * half * np.array([-1, -1, 1, 1])
