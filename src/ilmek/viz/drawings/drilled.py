"""The table of the drilled holes of a part: blind ones, counterbores, and those across."""

from collections.abc import Sequence

import numpy as np

from ilmek.part.features import drillings
from ilmek.part.shapes import Drilling
from ilmek.part.tolerances import FeatureKind, ToleratedFeature
from ilmek.sentences import Sentence
from ilmek.units import format_number, mm
from ilmek.viz.drawings.paper import table
from ilmek.viz.drawings.picture import SheetPicture, millimetres

_SAME = 1e-6
"""Distance within which a thread is that of a hole [m]."""


def drilled_table(shape: object, features: Sequence[ToleratedFeature]) -> SheetPicture | None:
    """Mouth, direction into the part, and sizes of each drilled hole in the part's axes; None where there is none."""
    threads = [one for one in features if one.kind is FeatureKind.THREAD]
    rows = [
        (f"D{number}", *(format_number(round(value / mm, 3)) for value in hole.position.origin), _along(hole), words)
        for number, (hole, words) in enumerate(((own, _words(own, threads)) for own in drillings(shape)), 1)
    ]
    if not rows:
        return None
    heads = Sentence("sheet.hole"), "X", "Y", "Z", Sentence("sheet.direction"), Sentence("sheet.dimension")
    return table(heads, rows, Sentence("sheet.drilled"))


def _along(hole: Drilling) -> str:
    """Direction of a hole: an axis with its sense, or its components."""
    along = hole.position.rotation[:, 2]
    axis = int(np.abs(along).argmax())
    if abs(along[axis]) > 1 - _SAME:
        return f"{'+' if along[axis] > 0 else '−'}{'XYZ'[axis]}"
    return " ".join(format_number(round(value, 4)) for value in along)


def _words(hole: Drilling, threads: Sequence[ToleratedFeature]) -> str:
    """Diameter and depth of each step, the thread by its name."""
    origin, along = hole.position.origin, hole.position.rotation[:, 2]
    threaded = any(
        abs(own.nominal - hole.steps[-1][0]) < _SAME
        and np.linalg.norm(np.cross(own.position.origin - origin, along)) < _SAME
        for own in threads
    )
    last = len(hole.steps) - 1
    sizes = [
        f"{'M' if threaded and number == last else '⌀'}{millimetres(diameter)} × {millimetres(length)}"
        for number, (diameter, length) in enumerate(hole.steps)
    ]
    return " / ".join(sizes)
