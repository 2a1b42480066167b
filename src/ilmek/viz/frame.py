"""The frame of a plot: grid, ticks and their numbers, the names of the axes."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ilmek.arrays import ComplexArray
from ilmek.viz.scale import tick_labels
from ilmek.viz.sheet import Sheet, axis_points
from ilmek.viz.style import AXIS, GRID, MUTED, PAPER, SMALL, TEXT

_TICK = 3.0


@dataclass(frozen=True, slots=True)
class Box:
    """Rectangle of a plot on its sheet [pt]: left and lower edge, width and height."""

    left: float
    low: float
    width: float
    height: float

    @property
    def right(self) -> float:
        """The right edge."""
        return self.left + self.width

    @property
    def top(self) -> float:
        """The upper edge."""
        return self.low + self.height

    @property
    def corners(self) -> ComplexArray:
        """The four corners."""
        lower, upper = 1j * self.low, 1j * self.top
        return np.array([self.left + lower, self.right + lower, self.right + upper, self.left + upper])


def paper(sheet: Sheet, box: Box) -> None:
    """Draw the white background of a plot."""
    sheet.area(box.corners, facecolor=PAPER, linewidth=0, zorder=0.5)


def grid(sheet: Sheet, box: Box, x: Sequence[float] = (), y: Sequence[float] = ()) -> None:
    """Draw grid lines at these coordinates [pt]."""
    upright, level = axis_points(x), 1j * axis_points(y)
    starts = np.concatenate([upright + 1j * box.low, level + box.left])
    ends = np.concatenate([upright + 1j * box.top, level + box.right])
    sheet.lines(starts, ends, color=GRID, linewidth=0.6, zorder=1.0)


def lower_axis(sheet: Sheet, box: Box, at: Sequence[float], values: list[float], name: str) -> None:
    """Draw the axis along the lower edge: ticks at coordinates [pt], their values, and its name."""
    _edge(sheet, 1j * box.low + axis_points([box.left, box.right]), 1j * box.low + axis_points(at), -1j)
    for x, words in zip(at, tick_labels(values), strict=True):
        sheet.text(x + 1j * (box.low - _TICK - 2.5), words, ha="center", va="top", fontsize=SMALL, color=MUTED)
    middle = (box.left + box.right) / 2
    sheet.text(middle + 1j * (box.low - _TICK - 13.5), name, ha="center", va="top", fontsize=TEXT)


def upper_axis(sheet: Sheet, box: Box, at: Sequence[float], values: list[float], name: str) -> None:
    """Draw the axis along the upper edge."""
    _edge(sheet, 1j * box.top + axis_points([box.left, box.right]), 1j * box.top + axis_points(at), 1j)
    for x, words in zip(at, tick_labels(values), strict=True):
        sheet.text(x + 1j * (box.top + _TICK + 2.0), words, ha="center", va="bottom", fontsize=SMALL, color=MUTED)
    middle = (box.left + box.right) / 2
    sheet.text(middle + 1j * (box.top + _TICK + 13.0), name, ha="center", va="bottom", fontsize=TEXT)


def left_axis(sheet: Sheet, box: Box, at: Sequence[float], values: list[float], name: str) -> None:
    """Draw the axis along the left edge; its name is at the sheet's edge and is read from the right."""
    _edge(sheet, box.left + 1j * axis_points([box.low, box.top]), box.left + 1j * axis_points(at), -1)
    for y, words in zip(at, tick_labels(values), strict=True):
        at_tick = complex(box.left - _TICK - 2.5, y)
        sheet.text(at_tick, words, ha="right", va="center_baseline", fontsize=SMALL, color=MUTED)
    middle = complex(12.0, (box.low + box.top) / 2)
    sheet.text(middle, name, ha="center", va="baseline", fontsize=TEXT, rotation=90)


def _edge(sheet: Sheet, edge: ComplexArray, ticks: ComplexArray, outward: complex) -> None:
    """The line of an axis with its ticks."""
    sheet.line(edge, color=AXIS, linewidth=0.7, zorder=2.5)
    sheet.lines(ticks, ticks + _TICK * outward, color=AXIS, linewidth=0.6, zorder=2.5)
