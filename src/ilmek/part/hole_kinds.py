"""Which holes the pieces of a part have: a hole for a screw is in those pieces alone in which a screw is.

Copies of a part have other neighbours, and other screws. Pieces with the same holes are of one kind.
"""

from collections import Counter, defaultdict
from collections.abc import Mapping
from functools import lru_cache

import numpy as np

from ilmek.arrays import BoolArray, Float
from ilmek.part.features import round_holes
from ilmek.part.insertion_units import is_screw, standing_parts
from ilmek.part.part import Part
from ilmek.part.placement import Placement
from ilmek.part.poses import chains
from ilmek.part.shapes import Drilling, shape_box
from ilmek.part.tree import Tree
from ilmek.records import record
from ilmek.units import um

_SAME = 10 * um
"""Distance of a screw from its hole that counts as rounding [m]."""


@record
class HoleKinds:
    """Kinds of pieces of a part: how many pieces each has, the most first, and which kinds have each round hole.

    holes  by the numbers of `round_holes`; the kinds of each, ascending
    """

    pieces: tuple[int, ...]
    holes: tuple[tuple[int, ...], ...]


@lru_cache(maxsize=4)
def hole_kinds(tree: Tree) -> Mapping[str, HoleKinds]:
    """The kinds of pieces by the ids of parts that have more than one; of a tree with its screws."""
    pieces, screws = _placed(tree)
    kinds = {}
    for name, (part, places) in pieces.items():
        holes = round_holes(part.shape)
        lines = np.array(screws[name]).reshape(-1, 7)
        if len(places) < 2 or not holes or not len(lines):
            continue
        filled = np.array([[_filled(hole, lies, lines) for hole in holes] for lies in places])
        rows = Counter(map(tuple, (filled | ~filled.any(0)).tolist())).most_common()
        if len(rows) > 1:
            has = np.array([row for row, _ in rows])
            own = tuple(tuple(np.flatnonzero(has[:, number]).tolist()) for number in range(len(holes)))
            kinds[name] = HoleKinds(tuple(number for _, number in rows), own)
    return kinds


_Lines = Float[np.ndarray, "screws 7"]


def _placed(tree: Tree) -> tuple[dict[str, tuple[Part, list[Placement]]], dict[str, list[list[float]]]]:
    """Parts with all their positions by id; and of the screws by the ids of what they join: head, direction, length."""
    parts: dict[str, tuple[Part, list[Placement]]] = {}
    screws: dict[str, list[list[float]]] = defaultdict(list)
    for piece in (piece for links in chains(tree) for piece in standing_parts(links)):
        part, lies = piece.part, piece.position
        assert part.shape is not None
        if part.joins and is_screw(part):
            line = [*lies.origin, *lies.rotation[:, 2], float(shape_box(part.shape)[1][2])]
            for name in part.joins:
                screws[name].append(line)
        else:
            parts.setdefault(part.id, (part, []))[1].append(lies)
    return parts, screws


def _filled(hole: Drilling, lies: Placement, screws: _Lines) -> bool:
    """Whether a screw is in a hole of a piece at a position: its head on the step, or its thread in the hole."""
    mouth = lies.after(hole.position)
    into = mouth.rotation[:, 2]
    away, along = screws[:, :3] - mouth.origin, screws[:, 3:6]
    begin = away @ into
    on_axis: BoolArray = np.abs(away - begin[:, None] * into).max(1) < _SAME
    if len(hole.steps) > 1:
        seated = np.abs(begin - hole.steps[0][1]) < _SAME
        return bool((on_axis & seated & (along @ into > 0)).any())
    end = begin + along @ into * screws[:, 6]
    deep = hole.steps[0][1]
    inside = np.minimum(np.maximum(begin, end), deep) - np.maximum(np.minimum(begin, end), 0.0) > _SAME
    return bool((on_axis & inside & (np.abs(along @ into) > 1 - _SAME)).any())
