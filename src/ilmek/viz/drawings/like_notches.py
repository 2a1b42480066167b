"""A row of like notches as its sheet shows it: the first and the last ones, the edge between them whole [ISO 128-3]."""

from dataclasses import replace

import numpy as np

from ilmek.part.shapes import Prism, Sum
from ilmek.report import Contour
from ilmek.units import um

KEPT, LEAST, SIDES = 3, 20, 4
"""Notches that are shown at each end of a row, least number of a row that is shortened, and sides of a notch with the
land beside it."""


def shortened(shape: object) -> object:
    """A shape whose prisms have of a long row of like notches the ends alone; others as they are."""
    if not isinstance(shape, Sum):
        return shape
    members = tuple(
        replace(own, shape=_shortened(own.shape)) if isinstance(own.shape, Prism) else own for own in shape.members
    )
    return shape if members == shape.members else Sum(members)


def _shortened(prism: Prism) -> Prism:
    outline = prism.section.outline
    if prism.section.smooth or len(outline.points) < SIDES * LEAST or outline.bulges.any():
        return prism
    step = np.diff(outline.points)
    breaks = np.flatnonzero(np.abs(step[SIDES:] - step[:-SIDES]) > um)
    ends = np.concatenate([[-1], breaks, [len(step) - SIDES]])
    longest = int(np.diff(ends).argmax())
    begin, notches = int(ends[longest]) + 1, (int(ends[longest + 1]) - int(ends[longest]) - 1) // SIDES
    if notches < LEAST:
        return prism
    left_out = slice(begin + SIDES * KEPT, begin + SIDES * (notches - KEPT))
    points = np.delete(outline.points, np.arange(len(outline.points))[left_out])
    return replace(prism, section=replace(prism.section, outline=Contour(points, np.zeros(len(points)))))
