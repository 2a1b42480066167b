"""Whether the parts of a loom have room in space: their least distances over the turns of a row and of a knot.

Parts of one machine must not be through each other; those of two machines that move against each other keep the
parameter `clearance`. A beat that travels along the row strikes many times over the same path: of the strokes between
the first and the last `STATIONS` are looked at, evenly along the row.
"""

from collections.abc import Mapping
from functools import lru_cache

import numpy as np

from ilmek.machines.automated_loom.bodies import beat_windows
from ilmek.machines.automated_loom.design import LoomDesign
from ilmek.machines.automated_loom.in_space.maker import KNOT, ROW
from ilmek.machines.automated_loom.in_space.scene import branches_of, loom_tree
from ilmek.machines.beat import BeatPath
from ilmek.part.clearances import TURN, Approach, Window, approaches
from ilmek.timing.cyclogram import Cyclogram
from ilmek.units import mm, turn

HORIZON = 10 * mm
"""Parts that are always farther apart are not reported [m]."""

STATIONS = 3

_AT_FELL = 1e-9
"""Distance from the fell that counts as rounding [m]."""


@lru_cache(maxsize=4)
def nearest_parts(loom: LoomDesign) -> tuple[Approach, ...]:
    """The least distance of every two parts that come near, of both cyclograms the least; the nearest first."""
    tree, machine = loom_tree(loom), machines_of_bodies(loom)

    def required(first: str, other: str) -> float:
        return 0.0 if machine[first] == machine[other] else loom.params.clearance

    row = approaches(tree, ROW, HORIZON, row_windows(loom.row_cyclogram, loom.beat.path), required)
    knot = approaches(tree, KNOT, HORIZON, TURN, required)
    least: dict[tuple[str, ...], Approach] = {}
    for pair in (*row, *knot):
        key = (*pair.parts, *pair.bodies)
        if key not in least or pair.distance < least[key].distance:
            least[key] = pair
    return tuple(sorted(least.values(), key=lambda pair: pair.distance))


def machines_of_bodies(loom: LoomDesign) -> Mapping[str, str]:
    """Name of the machine of each body, by its id."""
    return {body.id: branch.machine for branch in branches_of(loom) for body in branch.tree.bodies}


def row_windows(row: Cyclogram, beat: BeatPath) -> tuple[Window, ...]:
    """Angles of the row that are looked at [rad]: all but the strokes that repeat others."""
    at_fell = np.flatnonzero(np.abs(beat.tip) <= np.abs(beat.tip).min() + _AT_FELL)
    strokes = np.split(at_fell, np.flatnonzero(np.diff(at_fell) > 1) + 1)
    if len(strokes) <= STATIONS + 1:
        return TURN
    windows, begin = [], 0.0
    between = np.linspace(0, len(strokes) - 2, STATIONS).astype(int).tolist()
    for start, end in beat_windows(row):
        angle = start + beat.share * (end - start)
        windows.append((begin, float(angle[strokes[0][-1]])))
        windows += [(float(angle[strokes[k][-1]]), float(angle[strokes[k + 1][0]])) for k in between]
        begin = float(angle[strokes[-1][0]])
    return (*windows, (begin, turn))
