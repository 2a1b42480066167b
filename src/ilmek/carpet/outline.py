"""Outline of a carpet in a photograph: its four corners, where it lies on a floor or wall of other colours.

1. The colours of the floor are those of the picture's margin, in `_FLOORS` clusters. The difference of a pixel is its
   distance to the nearest cluster in CIELAB, in standard deviations of that cluster.
2. The carpet is the largest region whose difference is above that of the margin, holes filled, threads of a fringe
   removed. Its first corners are those of the largest quadrilateral in its convex hull.
3. Each side is then located to a part of a pixel: on `_SAMPLES` lines across it, from outside, where the difference
   rises to half of the carpet's. A straight line is fitted to these points by least squares, without the outliers. The
   corners are the intersections of these lines. Twice, because the lines across are then square to the side.

Clearness is the least of: the share of points on their line, of each side, and the share that region and quadrilateral
have in common. Below `LEAST_CLEARNESS` the outline is not used.
"""

import itertools

import numpy as np
import scipy

from ilmek.arrays import BoolArray, Float, FloatArray, Rgb
from ilmek.carpet.colour import srgb_to_lab
from ilmek.carpet.design import resampled
from ilmek.carpet.paper.sheet import squared_paper
from ilmek.carpet.picture_points import Points
from ilmek.carpet.projection import MadeRgb
from ilmek.errors import PictureError
from ilmek.plane.curves import hull
from ilmek.progress import SILENT, Progress
from ilmek.records import record

LEAST_CLEARNESS = 0.7
"""Least clearness of an outline that is used."""

_LONG, _COARSE = 2400, 600
"""Long side of the pictures in which the sides are located, and in which the region is found [pixels]."""

_FLOORS = 5
_MARGIN = 0.04
"""Width of the margin, of the picture's short side."""

_LEAST_SPREAD = 2.0
"""Least standard deviation of a colour of the floor, CIELAB: an even floor has noise too."""

_LEAST_AREA = 0.05
"""Least area of a carpet in the picture."""

_THREAD = 0.03
"""Largest width of a thread of the fringe, of the side that it hangs on."""

_FAINTEST = 0.15
"""Difference beside the outline, above that of the margin, that is not the floor's."""

_AROUND = 0.15
"""Distance from the outline within which no other edge may run along it, of the picture's short side."""

_SAMPLES = 300
_ENDS = 0.06
"""Part of a side at each of its ends that is not used: corners are worn and round."""

_REACH = (0.06, 0.015)
"""Half length of the lines across a side, of the picture's short side, in the first and the second pass."""

_SMOOTHED = 5
"""Samples across a side that are averaged."""

_STEP = 0.5
"""Distance of the samples on a line across [pixels]."""


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
    lab: FloatArray = srgb_to_lab(_reduced(rgb, _LONG, progress.part(0.0, 0.8))).astype(np.float32)
    margin = _margin(lab.shape[0], lab.shape[1])
    floor, difference = _difference(lab, margin)
    step = max(1, round(max(difference.shape) / _COARSE))
    region = _region(difference, step)
    corners = _largest_quadrilateral(_hull(region)) * step
    alike = _common_share(region, corners / step)
    shares: tuple[float, ...] = ()
    for reach in _REACH:
        corners, shares = _refined(lab, floor, corners, reach * min(difference.shape))
        progress(0.9)
    clearness = min(alike, *shares)
    height, width = difference.shape
    if clearness < LEAST_CLEARNESS or (corners < 0).any() or (corners > (width, height)).any():
        raise _unclear(f"clearness {max(clearness, 0.0):.2f}, at least {LEAST_CLEARNESS:g} is required")
    _check_surroundings(lab, floor, difference, margin, corners)
    return corners * (rgb.shape[1] / width, rgb.shape[0] / height), clearness


def _unclear(reason: str) -> PictureError:
    return PictureError(
        f"the outline of the carpet is not clear ({reason})",
        allowed="corners=auto needs the whole carpet on a floor of other colours",
        do='give the corners: --corners "x,y x,y x,y x,y"',
    )


def _reduced(rgb: Rgb, long: int, progress: Progress) -> MadeRgb:
    factor = max(rgb.shape[:2]) / long
    if factor <= 1:
        return rgb
    return resampled(rgb, max(1, round(rgb.shape[0] / factor)), max(1, round(rgb.shape[1] / factor)), progress)


@record
class _Floor:
    """Colours of the floor: means and standard deviations of the clusters; `unit` of the differences to them."""

    clusters: tuple[tuple[FloatArray, FloatArray], ...]
    unit: float

    def difference(self, lab: FloatArray) -> FloatArray:
        """Difference of colours to the nearest cluster; 1 is above all but 1 % of the margin."""
        least = np.full(lab.shape[:-1], np.inf, dtype=np.float32)
        for mean, spread in self.clusters:
            np.minimum(least, (((lab - mean) / spread) ** 2).sum(axis=-1), out=least)
        return np.asarray(np.sqrt(least) / self.unit)


def _margin(height: int, width: int) -> BoolArray:
    """The margin of a picture."""
    broad = max(2, round(_MARGIN * min(height, width)))
    margin = np.ones((height, width), dtype=bool)
    margin[broad:-broad, broad:-broad] = False
    return margin


def _difference(lab: FloatArray, margin: BoolArray) -> tuple[_Floor, Float[np.ndarray, "height width"]]:
    """The floor, and the difference of each pixel to it, of the mean of 3 × 3 pixels."""
    smooth: FloatArray = scipy.ndimage.uniform_filter(lab, (3, 3, 1))
    colours = smooth[margin]
    clusters = _floors(colours[:: max(1, len(colours) // 20_000)])
    usual = _Floor(clusters, 1.0).difference(colours)
    floor = _Floor(clusters, 1.2 * float(np.quantile(usual, 0.99)) + 1e-3)
    return floor, floor.difference(smooth)


def _floors(colours: Float[np.ndarray, "colours 3"]) -> tuple[tuple[FloatArray, FloatArray], ...]:
    """Means and standard deviations of the clusters of colours: k-means from the farthest colours."""
    means = [np.median(colours, axis=0)]
    for _ in range(_FLOORS - 1):
        distance = np.min([((colours - mean) ** 2).sum(axis=1) for mean in means], axis=0)
        means.append(colours[distance.argmax()])
    for _ in range(8):
        nearest = np.argmin([((colours - mean) ** 2).sum(axis=1) for mean in means], axis=0)
        means = [colours[nearest == k].mean(axis=0) if (nearest == k).any() else mean for k, mean in enumerate(means)]
    large = [k for k in range(_FLOORS) if np.count_nonzero(nearest == k) >= 0.01 * len(colours)]
    return tuple((means[k], np.maximum(colours[nearest == k].std(axis=0), _LEAST_SPREAD)) for k in large)


def _region(difference: FloatArray, step: int) -> BoolArray:
    """The carpet in the picture reduced by `step`: the largest region above the margin's difference."""
    rows, columns = (side // step * step for side in difference.shape)
    blocks = difference[:rows, :columns].reshape(rows // step, step, columns // step, step)
    mask = scipy.ndimage.binary_fill_holes(blocks.mean(axis=(1, 3)) > 1)
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


def _check_surroundings(
    lab: FloatArray, floor: _Floor, difference: FloatArray, margin: BoolArray, corners: Points
) -> None:
    """Raise PictureError where the outline is that of a part of the carpet: what is beside it is not the floor."""
    usual, fainter = float(np.median(difference[margin])), 0
    across = np.arange(_AROUND * min(difference.shape), 3.0, -1.0)
    for start, end in zip(corners, np.roll(corners, -1, axis=0), strict=True):
        strip = _strip(lab, floor, start, end, across)
        fainter += float(np.median(strip[:, across < 9])) > usual + _FAINTEST
        if (np.median(_without_threads(strip), axis=0) > 1).any():
            raise _unclear("another edge runs beside it")
    if fainter >= 3:
        raise _unclear("a fainter edge runs around it")


def _strip(lab: FloatArray, floor: _Floor, start: FloatArray, end: FloatArray, across: FloatArray) -> FloatArray:
    """The difference at distances `across` outwards of points along a side, (samples, distances).

    Grain is smoothed across the side alone, so that threads of a fringe, which lie across it, are not mixed with the
    floor between them.
    """
    along = (end - start) / np.hypot(*(end - start))
    share = np.linspace(_ENDS, 1 - _ENDS, _SAMPLES)[:, None, None]
    points = start + share * (end - start) + across[:, None] * np.array([along[1], -along[0]]) - 0.5
    pixels = points[..., 1], points[..., 0]
    seen = [scipy.ndimage.map_coordinates(lab[..., axis], pixels, order=1, mode="nearest") for axis in range(3)]
    smoothed = scipy.ndimage.uniform_filter1d(np.stack(seen, axis=-1), _SMOOTHED, axis=1, mode="nearest")
    return floor.difference(smoothed)


def _without_threads(strip: FloatArray) -> FloatArray:
    """A strip without what is narrower than _THREAD along the side."""
    opened: FloatArray = scipy.ndimage.grey_opening(strip, size=(max(3, round(_THREAD * _SAMPLES)), 1))
    return opened


def _refined(lab: FloatArray, floor: _Floor, corners: Points, reach: float) -> tuple[Points, tuple[float, ...]]:
    """Corners as intersections of lines fitted to the sides, and for each side the share of points on its line."""
    sides = [_side(lab, floor, a, b, reach) for a, b in zip(corners, np.roll(corners, -1, axis=0), strict=True)]
    lines = [line for line, _ in sides]
    crossings = []
    for (a, b, c), (d, e, f) in zip(np.roll(lines, 1, axis=0).tolist(), [line.tolist() for line in lines], strict=True):
        determinant = a * e - b * d
        if abs(determinant) < 1e-6:
            raise _unclear("two sides that meet are parallel")
        crossings.append(((c * e - b * f) / determinant, (a * f - c * d) / determinant))
    return np.array(crossings), tuple(share for _, share in sides)


def _side(lab: FloatArray, floor: _Floor, start: FloatArray, end: FloatArray, reach: float) -> tuple[FloatArray, float]:
    """The line a x + b y = c along a side, and the share of points on it."""
    length = float(np.hypot(*(end - start)))
    if length < 4:
        raise _unclear("a side has no length")
    along = (end - start) / length
    outwards = np.array([along[1], -along[0]])
    across = np.arange(reach, -reach, -_STEP)
    strip = _without_threads(_strip(lab, floor, start, end, across))
    share = np.linspace(_ENDS, 1 - _ENDS, _SAMPLES)
    offsets = np.array([_edge(line, across) for line in strip])
    return _fitted_line(start, along, outwards, share * length, offsets, max(1.5, 0.004 * length))


def _edge(line: FloatArray, across: FloatArray) -> float:
    """Where the difference, from outside, rises to half of the carpet's; NaN: nowhere."""
    above = line > 1
    if not above.any() or above[0]:
        return np.nan
    first = int(above.argmax())
    level = max(0.5, 0.5 * float(line[first : first + 8].max()))
    while line[first] < level:
        first += 1
    while first > 0 and line[first - 1] >= level:
        first -= 1
    if first == 0:
        return np.nan
    share = (level - line[first - 1]) / (line[first] - line[first - 1])
    return float(across[first - 1] + share * (across[first] - across[first - 1]))


def _fitted_line(  # noqa: PLR0917
    start: FloatArray,
    along: FloatArray,
    outwards: FloatArray,
    positions: FloatArray,
    offsets: FloatArray,
    tolerance: float,
) -> tuple[FloatArray, float]:
    """The line through points along a side and `offsets` outwards [pixels], by least squares without outliers.

    The first line is that of the pair of points, a third of the side apart, with the most points within the tolerance;
    every fifth point is tried with every tenth.
    """
    seen = np.flatnonzero(np.isfinite(offsets))
    if len(seen) < 0.3 * len(offsets):
        raise _unclear("a side is not found")
    x, y = positions[seen], offsets[seen]
    third = len(seen) // 3
    best, on = -1, np.ones(len(seen), dtype=bool)
    for first in range(0, len(seen) - third, 5):
        for other in range(first + third, len(seen), 10):
            slope = (y[other] - y[first]) / (x[other] - x[first])
            near = np.abs(y - y[first] - slope * (x - x[first])) <= tolerance
            if (count := int(np.count_nonzero(near))) > best:
                best, on = count, near
    for _ in range(3):
        mean_x, mean_y = x[on].mean(), y[on].mean()
        slope = ((x[on] - mean_x) * (y[on] - mean_y)).sum() / ((x[on] - mean_x) ** 2).sum()
        offset = mean_y - slope * mean_x
        on = np.abs(y - offset - slope * x) <= tolerance
    point, direction = start + offset * outwards, along + slope * outwards
    normal = np.array([-direction[1], direction[0]])
    return np.array([*normal, normal @ point]), float(np.count_nonzero(on) / len(offsets))
