"""Round holes as a sheet names and draws them; threads by ISO 6410-1: core wide, three quarters of a thin circle."""

from collections import defaultdict
from collections.abc import Sequence

import numpy as np

from ilmek.elements.machine_screws import core_of
from ilmek.part.shapes import Drilling
from ilmek.plane.contours import circle
from ilmek.records import record
from ilmek.report.sheet import LineKind
from ilmek.viz.drawings.face_notes import Direction
from ilmek.viz.drawings.feature_note import FeatureNote
from ilmek.viz.drawings.picture import millimetres
from ilmek.viz.drawings.view import NO_NOTE, DrawnView

_ALONG = 1e-9
"""Deviation of a direction that counts as rounding."""


@record
class NamedHole:
    """A hole: its number on the sheet, what it is, and which kinds of pieces have it; "": all.

    threaded  its last step is a thread
    """

    number: int
    hole: Drilling
    words: str
    note: FeatureNote = NO_NOTE
    kinds: str = ""
    threaded: bool = False

    @property
    def tag(self) -> str:
        """Its name on the sheet."""
        return f"H{self.number}"

    @property
    def into(self) -> Direction:
        """Its direction into the part."""
        return np.asarray(self.hole.position.rotation[:, 2])

    @property
    def is_in_front(self) -> bool:
        """Whether it is seen from the front."""
        return bool(self.into[2] < -1 + _ALONG)

    @property
    def centre(self) -> complex:
        """Its mouth, seen along z [m]."""
        return complex(*self.hole.position.origin[:2])

    @property
    def radius(self) -> float:
        """Of its mouth [m]."""
        return self.hole.steps[0][0] / 2

    @property
    def diameters(self) -> tuple[float, ...]:
        """Of its steps from the mouth [m]."""
        return tuple(size for size, _ in self.hole.steps)


def hole_words(hole: Drilling, note: FeatureNote, *, threaded: bool) -> str:
    """Diameter and depth of each step, with its fit; a thread by its name, with its core.

    >>> from ilmek.part.placement import IDENTITY
    >>> hole_words(Drilling(IDENTITY, ((2.5e-3, 3.75e-3),)), FeatureNote(" 6H"), threaded=True)
    'M2.5 - 6H × 3.75 / ⌀2.05 × 5.1'
    """
    first = "".join(f"⌀{millimetres(wide)} × {millimetres(deep)} / " for wide, deep in hole.steps[:-1])
    size, deep = hole.steps[-1]
    if threaded:
        return f"{first}{thread_words(size, note.words, 0.0 if hole.through else deep)}"
    last = f"{first}⌀{millimetres(size)}{note.words}"
    return last if hole.through else f"{last} × {millimetres(deep)}"


def thread_words(size: float, words: str, deep: float = 0.0) -> str:
    """A thread of a diameter [m] with its class, its depth and that of its core; deep  0: both go through.

    >>> thread_words(12e-3, " 6H"), thread_words(64e-3, " 6H", 0.02)
    ('M12 - 6H / ⌀10.2', 'M64 - 6H × 20')
    """
    if "×" in words:  # a fine thread, whose class has its pitch
        return f"M{millimetres(size)}{words}"
    core, name = core_of(size), f"M{millimetres(size)} -{words}"
    name = f"{name} × {millimetres(deep)}" if deep else name
    if core is None:
        return name
    drilled = f"{name} / ⌀{millimetres(core[0])}"
    return f"{drilled} × {millimetres(round(deep + core[1], 4))}" if deep else drilled


def mark_holes(view: DrawnView, named: Sequence[NamedHole], origin: complex = 0j) -> None:
    """Names beside holes that are seen in a view along z about an origin [m], what they must hold at the last alike."""
    alike = defaultdict[tuple[str, FeatureNote], list[NamedHole]](list)
    for own in named:
        at = own.centre - origin
        view.tag(own.tag, at * view.scale, own.radius * view.scale)
        alike[own.words, own.note].append(own)
    for (_, note), (first, *others) in alike.items():
        if not note.is_bare:
            last = others[-1] if others else first
            words = f"{first.tag}–{last.tag}" if others else first.tag
            view.leader(words, (last.centre - origin) * view.scale, last.radius * view.scale, kind=None, note=note)


def draw_hole(view: DrawnView, at: complex, diameters: Sequence[float], *, threaded: bool = False) -> None:
    """A hole seen along its axis [m]: its steps, with centre lines; of a thread its core, and the thread thin."""
    core = core_of(diameters[-1]) if threaded else None
    for size in diameters if core is None else (*diameters[:-1], core[0]):
        view.contour(LineKind.VISIBLE, circle(at, size / 2))
    if core is not None:
        view.line(LineKind.DIMENSION, at + diameters[-1] / 2 * _THREE_QUARTERS, body=False)
    view.cross(at, diameters[0] / 2)


_THREE_QUARTERS = np.exp(1j * (np.linspace(0.0, 1.5 * np.pi, 60) - 0.6 * np.pi))
