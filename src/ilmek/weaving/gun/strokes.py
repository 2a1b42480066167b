"""Strokes of the gun: the outlines of a region half a row inside its border, then rows that fill it.

The centre of the gun may be where it is at least half a row from the border. Rows lie on lines a row apart, on the same
lines for the whole carpet. A row is as long as anything within a share of half a row beside its centre is deeper than a
row, so is not covered by the outline. Rows that follow each other are joined to one stroke where a way between their
ends keeps the distance from the border.

All regions of a colour are cut at once: region k is laid k strips further up, and comes back when its strokes are made.
"""

from collections.abc import Iterator

import numpy as np
from manifold3d import CrossSection

from ilmek.arrays import Bool, Complex, Int
from ilmek.plane.vectors import cross, following
from ilmek.records import record
from ilmek.weaving.gun.cuts import LINE, Cuts, common, cut, nearest
from ilmek.weaving.gun.regions import deeper, polygons_of, section

SHARES = (0.4, 0.99)
"""Share of half a row beside the centre of a row in which what is not covered makes the row longer: at first, and in
regions of which too little is covered.
"""

_HALVES = np.linspace(-0.5, 0.5, 7)
"""Where that is looked for, of this share [rows]."""

_STEPS = tuple((np.arange(1, 8) / 8).tolist())
"""Where the way from a row to the next is kept clear of the border."""

_ASIDE = 0.5
"""Largest distance from the straight way [rows]."""

_SHORTEST = 0.02
"""Shortest row [rows]."""

TOLERANCE = 0.006
"""Deviation of outlines [rows]."""


@record
class RegionStrokes:
    """The strokes of a connected region of one colour; points [m], areas [m²].

    outlines  closed, the outer one first                  rows      chains of rows
    area      of the region                                bare      of it that no stroke covers
    beyond    covered outside the region                   unlined   of the region that no outline covers
    """

    outlines: tuple[Complex[np.ndarray, " corners"], ...]
    rows: tuple[Complex[np.ndarray, " corners"], ...]
    area: float
    bare: float
    beyond: float
    unlined: float

    @property
    def outline_length(self) -> float:
        """Length of the outlines [m]."""
        return sum(map(length_of, self.outlines))

    @property
    def length(self) -> float:
        """Length of all strokes [m]."""
        return self.outline_length + sum(map(length_of, self.rows))


def length_of(points: Complex[np.ndarray, " points"]) -> float:
    """Length of a polyline [m]."""
    return float(np.abs(np.diff(points)).sum())


def strokes_of(shape: CrossSection, spacing: float, least: float) -> list[RegionStrokes]:
    """Strokes of each region of a section.

    spacing  distance of the rows, and the width that one covers [m]
    least    share of a region below which its rows are made longer
    """
    regions = [region for region in shape.decompose() if not region.is_empty()]
    first, longer = SHARES
    strokes = _strokes(regions, spacing, first)
    bare = [number for number, own in enumerate(strokes) if own.bare > (1 - least) * own.area]
    again = _strokes([regions[number] for number in bare], spacing, longer)
    for number, own in zip(bare, again, strict=True):
        strokes[number] = own
    return strokes


def _strokes(regions: list[CrossSection], spacing: float, share: float) -> list[RegionStrokes]:
    """Strokes of regions, laid one over the other."""
    if not regions:
        return []
    tolerance = TOLERANCE * spacing
    lines = int(max(region.bounds()[3] for region in regions) / spacing) + 3
    strip = 1j * lines * spacing
    laid = section(points + number * strip for number, region in enumerate(regions) for points in polygons_of(region))
    clear = deeper(laid, spacing / 2).simplify(tolerance)
    around = polygons_of(clear)
    core = deeper(clear, spacing / 2)
    inner = polygons_of(core)
    thin = common([cut(inner, spacing, half * share * spacing) for half in _HALVES.tolist()], 1)
    rows = common([thin, cut(around, spacing, 0.0)], 2).of_length(_SHORTEST * spacing)
    chains = list(_chains(rows, [cut(around, spacing, step * spacing) for step in _STEPS], spacing))
    band = deeper(clear, -spacing / 2) - core
    covered = band + section(_rectangles(chains, spacing / 2))
    parts = (laid, laid - covered, covered, band)
    area, bare, stroked, lined = (_areas(polygons_of(part), strip.imag, len(regions)) for part in parts)
    closed = [np.append(ring, ring[0]) for ring in sorted(around, key=lambda ring: -np.ptp(ring.real))]
    outlines, filled = (_by_region(strokes, strip, len(regions)) for strokes in (closed, chains))
    return [
        RegionStrokes(
            outlines[k], filled[k], area[k], bare[k], max(0.0, stroked[k] + bare[k] - area[k]), area[k] - lined[k]
        )
        for k in range(len(regions))
    ]


def _by_region(
    strokes: list[Complex[np.ndarray, " points"]], strip: complex, number: int
) -> list[tuple[Complex[np.ndarray, " points"], ...]]:
    """The strokes of each region, where it was before it was laid."""
    own: list[list[Complex[np.ndarray, " points"]]] = [[] for _ in range(number)]
    for stroke in strokes:
        region = int(stroke[0].imag // strip.imag)
        own[region].append(stroke - region * strip)
    return [tuple(of_region) for of_region in own]


def _areas(polygons: list[Complex[np.ndarray, " corners"]], strip: float, number: int) -> list[float]:
    """Area in the strip of each region [m²]."""
    areas = np.zeros(number)
    for ring in polygons:
        corners = ring - ring[0]
        region = min(max(int(ring[0].imag // strip), 0), number - 1)
        areas[region] += 0.5 * float(np.sum(cross(corners, following(corners))))
    return areas.tolist()


def _rectangles(chains: list[Complex[np.ndarray, " points"]], half: float) -> Iterator[Complex[np.ndarray, " corners"]]:
    """What each straight piece covers, half of a row on each side of it, with square ends."""
    for points in chains:
        start, piece = points[:-1], np.diff(points)
        side = 1j * half * piece / np.abs(piece)
        yield from np.stack([start - side, start + piece - side, start + piece + side, start + side], axis=1)


def _chains(rows: Cuts, ways: list[Cuts], spacing: float) -> Iterator[Complex[np.ndarray, " corners"]]:
    """Rows joined turn by turn, where each of two lines has one row beside the other's."""
    after = _row_after(rows)
    alone = np.ones(len(after), dtype=bool)
    alone[after[after >= 0]] = False
    ends = np.stack([rows.start, rows.end]) + 1j * (rows.line + 0.5) * spacing
    links, bent = _links(ends, after, rows, ways, spacing)
    clear = np.isfinite(links).all(axis=2)
    for first in np.flatnonzero(alone).tolist():
        row, side = first, 0
        chain = [ends[0, row], ends[1, row]]
        while (beside := int(after[row])) >= 0:
            if clear[1 - side, row]:
                side = 1 - side
                chain += links[side, row, bent[side, row]].tolist()
            else:
                yield np.array(chain)
                chain, side = [], 0
            row = beside
            chain += [ends[side, row], ends[1 - side, row]]
        yield np.array(chain)


def _row_after(rows: Cuts) -> Int[np.ndarray, " rows"]:
    """The row on the next line that each is joined to: the only one beside it, beside no other; -1: none."""
    first, number = _beside(rows, 1)
    _, numbers = _beside(rows, -1)
    after = np.where(number == 1, first, -1)
    return np.where((after >= 0) & (numbers[after] == 1), after, -1)


def _beside(rows: Cuts, step: int) -> tuple[Int[np.ndarray, " rows"], Int[np.ndarray, " rows"]]:
    """The first row on the line `step` further that has an x in common with each, and how many have."""
    line = LINE * (rows.line + step)
    first = np.searchsorted(LINE * rows.line + rows.end, line + rows.start, side="right")
    return first, np.searchsorted(LINE * rows.line + rows.start, line + rows.end) - first


def _links(
    ends: Complex[np.ndarray, "2 rows"],
    after: Int[np.ndarray, " rows"],
    rows: Cuts,
    ways: list[Cuts],
    spacing: float,
) -> tuple[Complex[np.ndarray, "2 rows steps"], Bool[np.ndarray, "2 rows steps"]]:
    """Points between each end of a row and that of the next, as near to the straight way as the border allows, and
    whether they are beside it; NaN: the centre cannot go there.
    """
    links = np.full((*ends.shape, len(_STEPS)), np.nan + 0j)
    bent = np.zeros(links.shape, dtype=bool)
    for number, (step, way) in enumerate(zip(_STEPS, ways, strict=True)):
        for side in (0, 1):
            x = ends[side].real + step * (ends[side, after].real - ends[side].real)
            near = nearest(way, rows.line, x)
            points = near + 1j * (ends[side].imag + step * spacing)
            bent[side, :, number] = near != x
            links[side, :, number] = np.where(np.abs(near - x) <= _ASIDE * spacing, points, np.nan)
    return links, bent
