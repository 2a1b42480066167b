"""Whether the parts of a loom have room in space: their least distances over the turns of a row and of a knot.

Parts of one machine must not be through each other; those of two machines that move against each other keep the
parameter `clearance`. A beat that travels along the row strikes many times over the same path: of the strokes between
the first and the last `STATIONS` are looked at, evenly along the row.

The heads stand in the middle of their shares of the row. What is on them is compared with all else also where they
stand at both ends of these, over the row and over the knot, and, with their tools at rest, everywhere between.
"""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from functools import lru_cache

import numpy as np

from ilmek.machines.automated_loom.beat_motion import beat_windows
from ilmek.machines.automated_loom.design import LoomDesign
from ilmek.machines.automated_loom.in_space.maker import KNOT, ROW
from ilmek.machines.automated_loom.in_space.scene import branches_of, loom_tree
from ilmek.machines.beat import BeatPath
from ilmek.machines.weaver.tree import HEAD
from ilmek.part.clearances import Approach, approaches
from ilmek.part.placement import placement
from ilmek.part.swept import TURN, Window
from ilmek.part.tree import Tree
from ilmek.records import record
from ilmek.report import Json
from ilmek.report.scene import SceneMotion
from ilmek.timing.cyclogram import Cyclogram
from ilmek.units import mm, turn

HORIZON = 10 * mm
"""Parts that are always farther apart are not reported [m]."""

STATIONS = 3

ALONG = "share"
"""Drive that takes the heads from one end of their shares to the other, their tools at rest."""

LEFT, MIDDLE, RIGHT, BETWEEN = "at the left end", "in the middle", "at the right end", "between the ends"
"""Where the heads stand in their shares."""

_AT_FELL = 1e-9
"""Distance from the fell that counts as rounding [m]."""


@record
class NearParts:
    """Two parts that come near to each other, and where the heads, if any, stand in their shares of the row."""

    approach: Approach
    heads: str = ""

    def heads_shift(self, range_: float) -> float:
        """Distance of the heads from the middles of their shares, whose length is given [m]."""
        if self.heads == BETWEEN:
            return (self.approach.angle / turn - 0.5) * range_
        return {LEFT: -0.5, RIGHT: 0.5}.get(self.heads, 0.0) * range_

    def as_json(self, range_: float = 0.0) -> Json:
        """As JSON; range_: length of a head's share [m]."""
        pair = self.approach
        return {
            "parts": list(pair.parts),
            "bodies": list(pair.bodies),
            "distance": pair.distance,
            "volume": pair.volume,
            "cyclogram": pair.drive,
            "angle": pair.angle,
            "heads": self.heads,
            "heads_shift": self.heads_shift(range_),
        }


@lru_cache(maxsize=4)
def nearest_parts(loom: LoomDesign) -> tuple[NearParts, ...]:
    """The least distance of every two parts that move against each other and come near; the nearest first."""
    return nearest_of(near for each in passes(loom, HORIZON) for near in each)


def nearest_of(every: Iterable[NearParts]) -> tuple[NearParts, ...]:
    """Of every two parts the least distance, the nearest first."""
    least: dict[tuple[str, ...], NearParts] = {}
    for near in every:
        key = (*near.approach.parts, *near.approach.bodies)
        if key not in least or near.approach.distance < least[key].approach.distance:
            least[key] = near
    return tuple(sorted(least.values(), key=lambda near: near.approach.distance))


def passes(loom: LoomDesign, horizon: float) -> Iterator[tuple[NearParts, ...]]:
    """The parts that come nearer than a horizon [m] over each cyclogram, for each place of the heads."""
    return (tuple(NearParts(pair, heads) for pair in pairs) for heads, pairs in _passes(loom, horizon))


def _passes(loom: LoomDesign, horizon: float) -> Iterator[tuple[str, tuple[Approach, ...]]]:
    tree, machine = loom_tree(loom), machines_of_bodies(loom)
    windows = row_windows(loom.row_cyclogram, loom.beat.path)

    def required(first: str, other: str) -> float:
        return 0.0 if machine[first] == machine[other] else loom.params.clearance

    yield MIDDLE, approaches(tree, ROW, horizon, windows, required)
    if not loom.heads:
        return
    yield MIDDLE, approaches(tree, KNOT, horizon, TURN, required)
    on_heads = frozenset(tree.carried_by(HEAD))
    range_ = range_of_a_head(loom)
    for heads, shift in ((LEFT, -range_ / 2), (RIGHT, range_ / 2)):
        moved = _shifted(tree, shift)
        yield heads, approaches(moved, ROW, horizon, windows, required, on_heads)
        yield heads, approaches(moved, KNOT, horizon, TURN, required, on_heads)
    run = SceneMotion(ALONG, np.array([0.0, turn]), np.outer([-range_ / 2, range_ / 2], (1.0, 0.0, 0.0)), np.zeros(2))
    yield BETWEEN, approaches(tree.moving({HEAD: run}), ALONG, horizon, TURN, required, on_heads)


def range_of_a_head(loom: LoomDesign) -> float:
    """Length of the share of the row that a head ties, between its first and its last knot [m]; 0 without heads."""
    return loom.task.cloth.width / loom.heads - loom.knot_pitch if loom.heads else 0.0


def _shifted(tree: Tree, shift: float) -> Tree:
    """The tree with the heads moved along the row [m]."""
    aside = placement(shift)
    return tree.replaced(
        replace(body, positions=tuple(aside.after(own) for own in body.positions)) if body.id == HEAD else body
        for body in tree.bodies
    )


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
