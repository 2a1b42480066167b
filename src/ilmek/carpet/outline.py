"""Outline of a carpet in a photograph: its four corners, where it lies on a floor or wall of other colours.

1. What differs from the floor is found in any light [`floor`]. The carpet is the largest region of it, holes filled.
   Its first corners are those of the largest quadrilateral in its convex hull.
2. Each side has straight edges about it [`straight_edges`]. The carpet's is the outermost; but where a stripe of one
   colour runs around the carpet inside the edges, and what lies outside it on some sides is light, that is a fringe,
   and is left out.
3. Lines are fitted to the points of these edges. The corners are their intersections. Twice, because the lines across
   are then square to the side.

Clearness is the least of: the share of points on their line, of each side, and the share that region and quadrilateral
have in common. Below `LEAST_CLEARNESS` the outline is not used.
"""

import itertools
from collections.abc import Sequence

import numpy as np
import scipy

from ilmek.arrays import BoolArray, Float, FloatArray, Rgb
from ilmek.carpet.colour import srgb_to_lab
from ilmek.carpet.design import resampled
from ilmek.carpet.floor import BLACK, evened, floor_difference
from ilmek.carpet.paper.sheet import squared_paper
from ilmek.carpet.picture_points import Points
from ilmek.carpet.projection import MadeRgb
from ilmek.carpet.straight_edges import Edge, SideStrip, band_inside, edges_of, fitted_line, sampled, step_outside
from ilmek.errors import PictureError
from ilmek.plane.curves import hull
from ilmek.progress import SILENT, Progress
from ilmek.sentences import Sentence

LEAST_CLEARNESS = 0.8
"""Least clearness of an outline that is used."""

_LONG, _COARSE = 2400, 600
"""Long side of the pictures in which the sides are located, and in which the region is found [pixels]."""

_LEAST_AREA = 0.05
"""Least area of a carpet in the picture."""

_PLAIN = 2.0
"""Difference to the floor in the region of the carpet: above that of its grain."""

_REACH, _NEAR = 0.08, 0.015
"""Half length of the lines across a side, of the picture's short side, in the first and the second pass."""

_TILT = 0.04
"""Largest difference of the offsets of an edge at the ends of its side, of the picture's short side."""

_TOLERANCE = 1.5
"""Largest distance of a point from its line [pixels]."""

_ALIKE = 12.0
"""Largest colour difference within the stripe that runs around a carpet, CIELAB."""

_LEAST_LIGHT, _MOST_CHROMA = 50.0, 30.0
"""Least L* of a fringe on a light floor, and most chroma of its threads."""

_SHADOW = 0.8
"""L* + 16 of a fringe in shadow, of that in the light."""

_MOST_CUT = 0.03
"""Largest share of the picture's edge that the carpet may touch, as with the end of a fringe."""

_DARK = 18.0
"""L* of a floor on which a dark frame is not seen."""

_LARGEST_STEP = 2.8
"""Largest step outside an edge, CIELAB, on three of the sides: a fainter edge has more."""

_TRIED = 4
"""Number of edges of a side that are tried."""


def find_outline(rgb: Rgb, progress: Progress = SILENT) -> tuple[Points, float]:
    """The corners of the carpet in a photograph, clockwise from the upper left, and the clearness of its outline.

    Of a sheet of squared paper those of its grid: the outer field of its drawing may reach to the edge of the picture,
    and is no floor then; the clearness is the share of its cells that are not doubtful.
    Raises PictureError where the outline is not clear.
    """
    sheet = squared_paper(rgb, progress.part(0.0, 0.4))
    if sheet is not None:
        inside = np.clip(sheet.cells.corners, 0.0, [rgb.shape[1], rgb.shape[0]])
        return inside, 1.0 - sheet.doubts / sheet.numbers.size
    lab: FloatArray = evened(srgb_to_lab(_reduced(rgb, _LONG, progress.part(0.0, 0.8))).astype(np.float32))
    difference, floor = floor_difference(lab)
    if floor[0] < _DARK:
        raise _unclear(Sentence("picture.outline-dark"))
    step = max(1, round(max(difference.shape) / _COARSE))
    region = _region(difference, step)
    border = np.concatenate([region[0], region[-1], region[:, 0], region[:, -1]])
    if np.count_nonzero(border) > _MOST_CUT * len(border):
        raise _unclear(Sentence("picture.outline-cut"))
    first = _largest_quadrilateral(_hull(region)) * step
    height, width = difference.shape
    short = min(height, width)
    strips = _strips(lab, difference, first, _REACH * short)
    edges = _edges_around(strips, _TILT * short, floor)
    corners, _ = _refined(strips, edges)
    progress(0.9)
    strips = _strips(lab, difference, corners, _NEAR * short, strips)
    middle = Edge(0.5 * len(strips[0].across), 0.0, 0.0)
    corners, shares = _refined(strips, [middle] * 4)
    if sorted(map(step_outside, strips))[1] > _LARGEST_STEP:
        raise _unclear(Sentence("picture.outline-fainter"))
    clearness = min(_common_share(region, first / step), *shares)
    if clearness < LEAST_CLEARNESS or (corners < 0).any() or (corners > (width, height)).any():
        raise _unclear(
            Sentence("picture.outline-clearness", clearness=f"{max(clearness, 0.0):.2f}", least=f"{LEAST_CLEARNESS:g}")
        )
    return corners * (rgb.shape[1] / width, rgb.shape[0] / height), clearness


def _strips(
    lab: FloatArray, difference: FloatArray, corners: Points, reach: float, before: Sequence[SideStrip] = ()
) -> list[SideStrip]:
    """Strips of the picture across the four sides; their grain is that of those before."""
    following = np.roll(corners, -1, axis=0)
    if np.hypot(*(following - corners).T).min() < 4:
        raise _unclear(Sentence("picture.outline-no-length"))
    grains: Sequence[float | None] = [strip.grain for strip in before] or (None,) * 4
    sides = zip(corners, following, grains, strict=True)
    return [sampled(lab, difference, a, b, reach, grain) for a, b, grain in sides]


def _edges_around(strips: list[SideStrip], tilt: float, floor: FloatArray) -> list[Edge]:
    """The edge of the carpet of each side.

    The outermost edges, or the next ones inwards of sides with a fringe: what is left out may be threads, and the bands
    inside the edges are of one colour then.
    """
    tried = [edges_of(strip, tilt)[:_TRIED] for strip in strips]
    if not all(tried):
        raise _unclear(Sentence("picture.outline-no-edge"))
    bands = []
    for strip, edges in zip(strips, tried, strict=True):
        ends = [edge.middle for edge in edges[1:]] + [np.inf]
        bands.append([band_inside(strip, edge, end) for edge, end in zip(edges, ends, strict=True)])
    choices = sorted(itertools.product(*[range(len(edges)) for edges in tried]), key=sum)
    for choice in choices:
        left_out = [band for k, own in zip(choice, bands, strict=True) for band in own[:k]]
        colours = np.array([own[k] for k, own in zip(choice, bands, strict=True)])
        apart = np.linalg.norm(colours - np.median(colours, axis=0), axis=1).max()
        if apart <= _ALIKE and all(_of_threads(band, floor) for band in left_out):
            return [edges[k] for k, edges in zip(choice, tried, strict=True)]
    if any(_of_threads(own[0], floor) for own in bands):
        raise _unclear(Sentence("picture.outline-fringe"))
    return [edges[0] for edges in tried]


def _of_threads(band: FloatArray, floor: FloatArray) -> bool:
    """Whether a band may be a fringe: undyed threads with that floor between them."""
    most = max(_MOST_CHROMA, float(np.hypot(floor[1], floor[2])))
    least = _SHADOW * (min(floor[0], _LEAST_LIGHT) + BLACK[0])
    return bool(band[0] + BLACK[0] > least and np.hypot(band[1], band[2]) < most)


def _refined(strips: list[SideStrip], edges: list[Edge]) -> tuple[Points, list[float]]:
    """Corners as intersections of lines fitted to the edges, and for each side the share of points on its line."""
    fitted = [fitted_line(strip, edge, _TOLERANCE) for strip, edge in zip(strips, edges, strict=True)]
    lines = [line.tolist() for line, _ in fitted]
    crossings = []
    for (a, b, c), (d, e, f) in zip([lines[-1], *lines[:-1]], lines, strict=True):
        determinant = a * e - b * d
        if abs(determinant) < 1e-6:
            raise _unclear(Sentence("picture.outline-parallel"))
        crossings.append(((c * e - b * f) / determinant, (a * f - c * d) / determinant))
    return np.array(crossings), [share for _, share in fitted]


def _unclear(reason: str) -> PictureError:
    return PictureError(
        Sentence("picture.outline", reason=reason),
        allowed=Sentence("picture.outline-allowed"),
        do=Sentence("picture.outline-do"),
    )


def _reduced(rgb: Rgb, long: int, progress: Progress) -> MadeRgb:
    factor = max(rgb.shape[:2]) / long
    if factor <= 1:
        return rgb
    return resampled(rgb, max(1, round(rgb.shape[0] / factor)), max(1, round(rgb.shape[1] / factor)), progress)


def _region(difference: FloatArray, step: int) -> BoolArray:
    """The carpet in the picture reduced by `step`: the largest region above the margin's difference."""
    rows, columns = (side // step * step for side in difference.shape)
    blocks = difference[:rows, :columns].reshape(rows // step, step, columns // step, step)
    mask = scipy.ndimage.binary_fill_holes(blocks.mean(axis=(1, 3)) > _PLAIN)
    radius = max(1, round(0.012 * max(mask.shape)))
    mask = scipy.ndimage.binary_opening(mask, np.ones((2 * radius + 1, 2 * radius + 1), dtype=bool))
    labels, count = scipy.ndimage.label(mask)
    if count == 0:
        raise _unclear("nothing differs from the margin of the picture")
    areas = np.bincount(labels.ravel())[1:]
    if areas.max() < _LEAST_AREA * mask.size:
        raise _unclear("what differs from the margin of the picture is too small")
    largest: BoolArray = scipy.ndimage.binary_fill_holes(labels == areas.argmax() + 1)
    return largest


def _hull(region: BoolArray) -> Points:
    """Corners of the convex hull of a region, clockwise in the picture, whose y points down."""
    rows = np.flatnonzero(region.any(axis=1))
    left, right = region.argmax(axis=1)[rows], region.shape[1] - region[:, ::-1].argmax(axis=1)[rows]
    upper = np.concatenate([left, right]) + 1j * np.concatenate([rows, rows])
    corners = hull(np.concatenate([upper, upper + 1j]))
    return np.stack([corners.real, corners.imag], axis=1)


def _largest_quadrilateral(polygon: Points) -> Float[np.ndarray, "4 2"]:
    """The largest quadrilateral with corners among those of a convex polygon, clockwise from the upper left."""
    if len(polygon) < 4:
        raise _unclear("what differs from the margin of the picture has no four corners")
    polygon = polygon[:: -(-len(polygon) // 120)] if len(polygon) > 120 else polygon
    x, y = polygon.T
    largest, corners = -1.0, (0, 1, 2, 3)
    for begin, end in itertools.combinations(range(len(polygon)), 2):
        side = (x[end] - x[begin]) * (y - y[begin]) - (y[end] - y[begin]) * (x - x[begin])
        if (area := float(side.max() - side.min())) > largest:
            largest, corners = area, (begin, int(side.argmin()), end, int(side.argmax()))
    chosen = polygon[list(corners)]
    centre = chosen.mean(axis=0)
    chosen = chosen[np.argsort(np.arctan2(*(chosen - centre).T[::-1]), kind="stable")]
    return np.asarray(np.roll(chosen, -int(chosen.sum(axis=1).argmin()), axis=0))


def _common_share(region: BoolArray, corners: Points) -> float:
    """Area that region and quadrilateral have in common, of the area of both."""
    y, x = np.mgrid[0.5 : region.shape[0], 0.5 : region.shape[1]]
    inside = np.ones(region.shape, dtype=bool)
    for (ax, ay), (bx, by) in zip(corners.tolist(), np.roll(corners, -1, axis=0).tolist(), strict=True):
        inside &= (bx - ax) * (y - ay) - (by - ay) * (x - ax) >= 0
    return int(np.count_nonzero(inside & region)) / max(1, int(np.count_nonzero(inside | region)))
