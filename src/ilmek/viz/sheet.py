"""Paper to draw a figure on, measured in points.

Lines, areas and texts are laid on the figure itself, without matplotlib's axes: every place is known here to the
point, and axes that draw their own ticks would take most of the time.
"""

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.backends.backend_svg import FigureCanvasSVG
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Polygon
from matplotlib.transforms import IdentityTransform

from ilmek.arrays import ComplexArray

_POINTS = 72.0
"""Points per inch; at this resolution matplotlib's pixels are points."""


class Sheet:
    """A sheet of width x height [pt]; places are complex, from its lower left corner [pt]."""

    def __init__(self, width: float, height: float) -> None:
        self.width, self.height = float(width), float(height)
        self.figure = Figure(figsize=(self.width / _POINTS, self.height / _POINTS), dpi=_POINTS, facecolor="none")
        FigureCanvasSVG(self.figure)

    def line(self, points: ComplexArray, **look: Any) -> None:
        """A line through points; NaN makes a gap."""
        self.figure.add_artist(Line2D(points.real, points.imag, transform=IdentityTransform(), **look))

    def lines(self, starts: ComplexArray, ends: ComplexArray, **look: Any) -> None:
        """Straight lines from each start to its end, drawn as one."""
        gaps = np.full(len(starts), complex(np.nan, np.nan))
        self.line(np.column_stack((starts, ends, gaps)).ravel(), **look)

    def area(self, points: ComplexArray, **look: Any) -> None:
        """A filled polygon."""
        corners = np.column_stack((points.real, points.imag))
        self.figure.add_artist(Polygon(corners, closed=True, transform=IdentityTransform(), **look))

    def text(self, at: complex, words: str, **look: Any) -> None:
        """A text; `ha` and `va` say which of its points lies at the place, a rotation is about that point."""
        self.figure.text(at.real, at.imag, words, transform=IdentityTransform(), rotation_mode="anchor", **look)


def circle(centre: complex, radius: float) -> ComplexArray:
    """A circle as a polygon [pt] fine enough for a figure."""
    return np.asarray(centre + radius * np.exp(2j * np.pi * np.arange(24) / 24))


def places(values: Sequence[float]) -> ComplexArray:
    """Numbers along an axis as places on the real line."""
    return np.array(values, dtype=complex)
