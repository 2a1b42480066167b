"""The plan of a tufted carpet: of each colour its regions, and the strokes of the gun in their order.

L >= sum over regions (outlines + what they leave bare / row spacing)         length of strokes that begin with outlines
"""

import numpy as np

from ilmek.arrays import Complex, UInt8
from ilmek.progress import SILENT, Progress
from ilmek.records import record
from ilmek.weaving.gun.reduction import OUTSIDE, opened, reduced
from ilmek.weaving.gun.regions import tuftable
from ilmek.weaving.gun.strokes import RegionStrokes, length_of, strokes_of
from ilmek.weaving.gun.travel import in_order, least_travel, travel_of

CELLS = 3
"""Cells of the chart in a row of the gun."""


@record
class ColourPlan:
    """The regions of a colour, and its strokes in the order and the direction of the gun, as seen on the pile [m]."""

    label: int
    regions: tuple[RegionStrokes, ...]
    strokes: tuple[Complex[np.ndarray, " points"], ...]

    @property
    def length(self) -> float:
        """Length of the strokes [m]."""
        return sum(map(length_of, self.strokes))


@record
class GunPlan:
    """The plan of a carpet of width x length [m].

    colours  in the order of the gun            spacing  distance of the rows [m]
    area     within the outline of the carpet [m²]
    changed  share of the cells that took another colour, because what they are of is finer than the smallest feature
    lost     labels that have no stroke
    """

    colours: tuple[ColourPlan, ...]
    width: float
    length: float
    area: float
    spacing: float
    changed: float
    lost: tuple[int, ...]

    @property
    def regions(self) -> tuple[RegionStrokes, ...]:
        """The regions of all colours."""
        return tuple(region for colour in self.colours for region in colour.regions)

    @property
    def strokes(self) -> int:
        """Number of strokes: before each the gun is set down, after it lifted."""
        return sum(len(colour.strokes) for colour in self.colours)

    @property
    def tufted(self) -> float:
        """Length of all strokes [m]."""
        return sum(colour.length for colour in self.colours)

    @property
    def least_tufted(self) -> float:
        """Length that no strokes with these outlines fall below, when their rows do not overlap [m]."""
        return sum(region.outline_length + region.unlined / self.spacing for region in self.regions)

    @property
    def travel(self) -> float:
        """Distance with the gun lifted, from stroke to stroke of a colour [m]."""
        return sum(travel_of(colour.strokes) for colour in self.colours)

    @property
    def least_travel(self) -> float:
        """Distance that no order of the strokes falls below [m]."""
        return sum(least_travel(colour.strokes) for colour in self.colours)

    @property
    def coverage(self) -> float:
        """Least share of a region that its strokes cover."""
        return min((1 - region.bare / region.area for region in self.regions), default=0.0)

    @property
    def beyond(self) -> float:
        """Largest share of a region that strokes cover beyond its border."""
        return max((region.beyond / region.area for region in self.regions), default=0.0)

    @property
    def covered(self) -> float:
        """Share of the carpet that strokes cover."""
        return sum(region.area - region.bare for region in self.regions) / self.area


def gun_plan(
    labels: UInt8[np.ndarray, "rows columns"],
    size: tuple[float, float],
    spacing: float,
    smallest: float,
    *,
    least: float = 0.99,
    progress: Progress = SILENT,
) -> GunPlan:
    """The plan of labels, row 0 at the top; OUTSIDE: not of the carpet.

    size      width and length of the carpet [m], of square cells        spacing   distance of the rows [m]
    smallest  width of the smallest feature that stays [m], at least the distance of the rows
    least     share of a region that its strokes are to cover
    """
    width, length = size
    cell = width / labels.shape[1]
    diameter = max(CELLS, round(smallest / cell))
    made = reduced(labels, diameter)
    inside = labels != OUTSIDE
    present = np.unique(labels[inside]).tolist()
    colours: list[ColourPlan] = []
    here = 0j
    for number, label in enumerate(sorted(present, key=lambda one: -int(np.count_nonzero(made == one)))):
        progress(number / len(present))
        regions = tuple(strokes_of(tuftable(made, label, cell, spacing), spacing, least))
        strokes = tuple(in_order(regions, here))
        if strokes:
            colours.append(ColourPlan(label, regions, strokes))
            here = complex(strokes[-1][-1])
    lost = set(present) - {colour.label for colour in colours}
    wide = (opened(made, diameter) & inside).any()
    changed = float(np.mean((made != labels)[inside])) if wide else 1.0
    area = cell**2 * np.count_nonzero(inside)
    return GunPlan(tuple(colours), width, length, area, spacing, changed, tuple(sorted(lost)))
