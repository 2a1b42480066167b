"""The room between fell and guide cams over a row: sheds, carrier, what beats, and the heads' retreat."""

import numpy as np

from ilmek.arrays import ComplexArray, FloatArray
from ilmek.machines.automated_loom.bodies import BAR, CARPET, CARRIER, GUIDE_CAMS, HEAD, LEAVES, row_bodies
from ilmek.machines.automated_loom.cyclogram import EVEN, HEADS, ODD
from ilmek.machines.automated_loom.design import LoomDesign
from ilmek.machines.automated_loom.room import GUIDED
from ilmek.report import Animation, Axis, Dot, Drawing, MovingStroke, Reading, Stroke
from ilmek.timing.cyclogram import Cyclogram
from ilmek.timing.track import sample
from ilmek.units import turn

FRAMES = 120
_AROUND = np.exp(1j * turn * np.arange(72) / 72)


def one_row_from_the_side(loom: LoomDesign) -> Animation:
    """A row over the cyclogram's angle; the carrier is drawn only while it is in the shed."""
    angle, row = np.arange(FRAMES) * (turn / FRAMES), loom.row_cyclogram
    stack = loom.params.beat == GUIDED
    bodies = {body.name: body for body in row_bodies(loom.side, row, loom.beat.path, stack=stack)}

    def at(name: str, part: int = 0) -> ComplexArray:
        corners = bodies[name].parts[part].corners(angle)
        return np.broadcast_to(corners, (FRAMES, corners.shape[1]))

    carrier, inside = at(CARRIER), np.zeros(FRAMES, bool)
    for first, last in bodies[CARRIER].windows:
        inside |= (angle >= first) & (angle <= last)
    carrier = np.where(inside[:, None], carrier, carrier.mean(axis=1, keepdims=True))
    beating = [MovingStroke(at(LEAVES), "path", "comb", closed=True)]
    beating += [MovingStroke(at(BAR, part), "path", "comb", closed=True) for part in range(len(bodies[BAR].parts))]
    strokes = (
        *(MovingStroke(_sheet(at(name), at(name, 1)), "path", name) for name in (EVEN, ODD)),
        MovingStroke(at(GUIDE_CAMS) + loom.side.cams[0].guide_radius * _AROUND, "path", "guide cams", closed=True),
        *beating,
        MovingStroke(carrier, "path", "carrier", closed=True),
        MovingStroke(at(HEAD), "path", "head", closed=True),
    )
    carpet = at(CARPET)[0]
    low = 1j * max(carpet.imag.min(), loom.side.head.body.imag)
    still = Drawing(
        "loom-row-moving",
        "A row from the side",
        (Stroke(np.where(carpet.imag < 0, carpet.real + low, carpet), "yarn", "carpet", closed=True, filled=True),),
        (Dot(0j, "fell", "point"),),
        note="over the angle of the row's cyclogram; the carrier is drawn while it is in the shed",
    )
    readings = (
        _reading(EVEN, row, EVEN, angle),
        _reading(ODD, row, ODD, angle),
        _reading("heads' retreat", row, HEADS, angle),
    )
    return Animation(still, Axis("angle of the row", "deg"), angle, strokes, (), period=row.period, readings=readings)


def _sheet(low: ComplexArray, high: ComplexArray) -> ComplexArray:
    """From the fell over the point of lift to the back rest, cut above the guide cams."""
    lifted, fell, rest = low[:, :1], low[:, 1:], high[:, 1:]
    return np.asarray(np.concatenate([fell, lifted, lifted + 0.5 * (rest - lifted)], axis=1))


def _reading(label: str, row: Cyclogram, name: str, angle: FloatArray) -> Reading:
    return Reading(label, sample(row.track(name), angle).position, "mm")
