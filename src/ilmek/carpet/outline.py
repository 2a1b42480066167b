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
from ilmek.carpet.straight_edges import (
    Edge,
    SideBand,
    SideStrip,
    band_inside,
    edges_of,
    fitted_line,
    sampled,
    share_like_floor,
    share_unlike_beyond,
    sharp_step_outside,
    step_beside,
    step_outside,
    unlike_in_any_light,
)
from ilmek.errors import PictureError
from ilmek.plane.curves import hull
from ilmek.progress import SILENT, Progress
from ilmek.sentences import Sentence

LEAST_CLEARNESS = 0.81
"""Least clearness of an outline that is used."""

_LONG, _COARSE = 2400, 600
"""Long side of the pictures in which the sides are located, and in which the region is found [pixels]."""

_LEAST_AREA = 0.05
"""Least area of a carpet in the picture."""

_LEAST_PART, _LEAST_TOGETHER, _MOST_BESIDE = 0.01, 0.85, 0.1
"""Least area of a part of a carpet, of its largest, least share of a quadrilateral that the parts fill, and largest
area of all parts beside a carpet, of its own.
"""

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

_DEEPEST = 0.4
"""L* + 16 of a floor in shadow beside a fringe, at least, of that in the light."""

_MOST_CUT = 0.03
"""Largest share of the picture's edge that the carpet may touch, as with the end of a fringe."""

_LEAST_SHARP, _SHARP = 1.2, 0.1
"""Largest sharp step of L* outside an edge, at least, and of the floor's L*: planks differ by less, a frame that is
nearly as dark as the floor by more."""

_THIN = 5.0
"""Largest width of a frame that the stripe inside it hides: the corners are those of the frame [pixels]."""

_BEYOND, _GOES_ON = ((-0.2, -0.07), (1.07, 1.2)), 0.4
"""Where a line is looked at beyond its ends, in lengths of the side, and least step there of one that goes on."""

_LIKE_FLOOR = 0.5
"""Share of the band inside an edge that may look like the floor, and of what lies outside its ends that may not."""

_BETWEEN_THREADS = 0.03
"""Share of it between the threads of a fringe: of two opposite sides alone."""

_LARGEST_STEP = 2.8
"""Largest step outside an edge, CIELAB, on three of the sides: a fainter edge has more."""

_TRIED = 4
"""Number of edges of a side that are tried."""


def find_outline(rgb: Rgb, progress: Progress = SILENT) -> tuple[Points, float]:
    """The corners of the carpet in a photograph, clockwise from the upper left, and the clearness of its outline.

    Of a sheet of squared paper those of its grid: the outer field of its drawing may reach to the edge of the picture,
    and is no floor then; the clearness is the share of its cells that are not doubtful.
    Raises PictureError where the outline is not clear, with the corners as far as they are known.
    """
    sheet = squared_paper(rgb, progress.part(0.0, 0.4))
    if sheet is not None:
        inside = np.clip(sheet.cells.corners, 0.0, [rgb.shape[1], rgb.shape[0]])
        return inside, 1.0 - sheet.doubts / sheet.numbers.size
    lab: FloatArray = evened(srgb_to_lab(_reduced(rgb, _LONG, progress.part(0.0, 0.8))).astype(np.float32))
    height, width = lab.shape[:2]
    scale = (rgb.shape[1] / width, rgb.shape[0] / height)
    difference, floor = floor_difference(lab)
    step = max(1, round(max(difference.shape) / _COARSE))
    region = _region(difference, step)
    first = _largest_quadrilateral(_hull(region)) * step
    try:
        corners, shares, doubts = _sides(lab, difference, floor, first)
    except _NoSides as no_sides:
        raise _unclear(no_sides.reason, np.clip(first, 0, (width, height)) * scale) from None
    clearness = max(0.0, min(_common_share(region, first / step), *shares))
    border = np.concatenate([region[0], region[-1], region[:, 0], region[:, -1]])
    if np.count_nonzero(border) > _MOST_CUT * len(border) or (corners < 0).any() or (corners > (width, height)).any():
        doubts.append(Sentence("picture.outline-cut"))
    if clearness < LEAST_CLEARNESS:
        values = {"clearness": f"{clearness:.2f}", "least": f"{LEAST_CLEARNESS:g}"}
        doubts.append(Sentence("picture.outline-clearness", **values))
    if doubts:
        raise _unclear(doubts[-1], np.clip(corners, 0, (width, height)) * scale)
    return corners * scale, clearness


class _NoSides(Exception):
    """No four sides, and why."""

    def __init__(self, reason: str) -> None:
        super().__init__(reason)
        self.reason = reason


def _sides(
    lab: FloatArray, difference: FloatArray, floor: FloatArray, first: Points
) -> tuple[Points, list[float], list[str]]:
    """The corners by lines fitted to the sides, the share of points on each line, and doubts about the sides."""
    short = min(difference.shape)
    strips = _strips(lab, difference, first, _REACH * short)
    edges, doubts = _edges_around(strips, _TILT * short, floor)
    corners, _ = _refined(strips, edges)
    strips = _strips(lab, difference, corners, _NEAR * short, strips)
    middle = Edge(0.5 * len(strips[0].across), 0.0, 0.0)
    most, reach = max(_LEAST_SHARP, _SHARP * float(floor[0])), _REACH * short
    wide = [sharp_step_outside(strip) for strip in _strips(lab, difference, corners, reach, strips)]
    thin = [distance if step > most and distance <= _THIN else 0.0 for step, distance in wide]
    corners, shares = _refined(strips, [middle] * 4, thin)
    if sorted(map(step_outside, strips))[1] > _LARGEST_STEP:
        doubts.append(Sentence("picture.outline-fainter"))
    for strip, (step, distance) in zip(strips, wide, strict=True):
        if step > most and distance > _THIN and not _goes_on(lab, difference, strip, (reach, distance, step)):
            doubts.append(Sentence("picture.outline-fainter-side"))
        if share_unlike_beyond(difference, strip) > _LIKE_FLOOR:
            doubts.append(Sentence("picture.outline-fainter-side"))
        if unlike_in_any_light(strip, floor) > _ALIKE:
            doubts.append(Sentence("picture.outline-unlike"))
        like_floor = np.linalg.norm(band_inside(strip, middle, None).colour - floor) < _ALIKE
        if like_floor and _goes_on(lab, difference, strip, (reach, 0.0, step_beside(strip, 0.0))):
            doubts.append(Sentence("picture.outline-goes-on"))
    shares_like_floor = [share_like_floor(strip) for strip in strips]
    if max(shares_like_floor) > _LIKE_FLOOR:
        doubts.append(Sentence("picture.outline-like-floor"))
    ends, sides = sorted((shares_like_floor[::2], shares_like_floor[1::2]), key=min)[::-1]
    if min(ends) > _BETWEEN_THREADS > max(sides):
        doubts.append(Sentence("picture.outline-fringe"))
    return corners, shares, doubts


def _strips(
    lab: FloatArray, difference: FloatArray, corners: Points, reach: float, before: Sequence[SideStrip] = ()
) -> list[SideStrip]:
    """Strips of the picture across the four sides; their grain is that of those before."""
    following = np.roll(corners, -1, axis=0)
    if np.hypot(*(following - corners).T).min() < 4:
        raise _NoSides(Sentence("picture.outline-no-length"))
    grains: Sequence[float | None] = [strip.grain for strip in before] or (None,) * 4
    sides = zip(corners, following, grains, strict=True)
    return [sampled(lab, difference, a, b, reach, grain) for a, b, grain in sides]


def _goes_on(lab: FloatArray, difference: FloatArray, strip: SideStrip, edge: tuple[float, float, float]) -> bool:
    """Whether an edge along a side goes on beyond both its ends: it is the floor's, a seam of planks.

    edge  reach of the strips in which it is looked for, distance outside the side [pixels], and step of L*
    """
    reach, distance, step = edge
    along = strip.end - strip.start
    ends = [(strip.start + a * along, strip.start + b * along) for a, b in _BEYOND]
    return all(step_beside(sampled(lab, difference, *end, reach), distance) > _GOES_ON * step for end in ends)


def _edges_around(strips: list[SideStrip], tilt: float, floor: FloatArray) -> tuple[list[Edge], list[str]]:
    """The edge of the carpet of each side, and the doubt whether what lies along a side is a fringe.

    The outermost edges, or the next ones inwards of two sides with a fringe. Where it is not sure whether threads show,
    the bands inside the edges have to be of one colour.
    """
    tried = [edges_of(strip, tilt)[:_TRIED] for strip in strips]
    if not all(tried):
        raise _NoSides(Sentence("picture.outline-no-edge"))
    bands = [
        [band_inside(strip, edge, end) for edge, end in zip(edges, [*edges[1:], None], strict=True)]
        for strip, edges in zip(strips, tried, strict=True)
    ]
    for choice in sorted(itertools.product(*[range(len(edges)) for edges in tried]), key=sum):
        left_out = [band for k, own in zip(choice, bands, strict=True) for band in own[:k]]
        kept = [own[k] for k, own in zip(choice, bands, strict=True)]
        apart = _apart(kept)
        if apart <= _ALIKE and not left_out and sum(_of_threads(band, floor, sure=True) for band in kept) == 1:
            break  # a frame of one colour around the carpet, with a dense pattern on one side; or a fringe on it
        if any(_of_threads(band, floor, sure=True) for band in kept) or (
            choice[0] + choice[2] and choice[1] + choice[3]
        ):
            continue
        if left_out and _apart(left_out) > _ALIKE:
            continue  # a fringe has one colour
        sure = apart <= _ALIKE or not any(_of_threads(band, floor) for band in kept)
        if sure and all(_of_threads(band, floor, sure=apart > _ALIKE) for band in left_out):
            return [edges[k] for k, edges in zip(choice, tried, strict=True)], []
    return [edges[0] for edges in tried], [Sentence("picture.outline-fringe")]


def _apart(bands: list[SideBand]) -> float:
    """Largest distance of the bands' colours from their median."""
    colours = np.array([band.colour for band in bands])
    return float(np.linalg.norm(colours - np.median(colours, axis=0), axis=1).max())


def _of_threads(band: SideBand, floor: FloatArray, *, sure: bool = False) -> bool:
    """Whether a band may be, or surely is, a fringe: undyed threads with that floor between them."""
    most = max(_MOST_CHROMA, float(np.hypot(floor[1], floor[2])))
    light = band.colour[0] + BLACK[0] > _SHADOW * (min(floor[0], _LEAST_LIGHT) + BLACK[0])
    if band.outside + BLACK[0] < _DEEPEST * (floor[0] + BLACK[0]):
        return False  # a dark frame lies outside it
    return bool((band.threads if sure else band.perhaps) and light and np.hypot(*band.colour[1:]) < most)


def _refined(
    strips: list[SideStrip], edges: list[Edge], outwards: Sequence[float] = (0.0,) * 4
) -> tuple[Points, list[float]]:
    """Corners as intersections of lines fitted to the edges, and for each side the share of points on its line.

    outwards  distance by which each line is moved [pixels]
    """
    fitted = [fitted_line(strip, edge, _TOLERANCE) for strip, edge in zip(strips, edges, strict=True)]
    lines = [(*line[:2].tolist(), float(line[2]) - far) for (line, _), far in zip(fitted, outwards, strict=True)]
    crossings = []
    for (a, b, c), (d, e, f) in zip([lines[-1], *lines[:-1]], lines, strict=True):
        determinant = a * e - b * d
        if abs(determinant) < 1e-6:
            raise _NoSides(Sentence("picture.outline-parallel"))
        crossings.append(((c * e - b * f) / determinant, (a * f - c * d) / determinant))
    return np.array(crossings), [share for _, share in fitted]


def _unclear(reason: str, corners: Points | None = None) -> PictureError:
    """The error of an outline that is not clear, with the corners that were found, to be pasted if they are right."""
    points = "x,y x,y x,y x,y" if corners is None else " ".join(f"{x:.1f},{y:.1f}" for x, y in corners.tolist())
    return PictureError(
        Sentence("picture.outline", reason=reason),
        allowed=Sentence("picture.outline-allowed"),
        do=Sentence("picture.outline-do" if corners is None else "picture.outline-paste", corners=points),
    )


def _reduced(rgb: Rgb, long: int, progress: Progress) -> MadeRgb:
    factor = max(rgb.shape[:2]) / long
    if factor <= 1:
        return rgb
    return resampled(rgb, max(1, round(rgb.shape[0] / factor)), max(1, round(rgb.shape[1] / factor)), progress)


def _region(difference: FloatArray, step: int) -> BoolArray:
    """The carpet in the picture reduced by `step`: the largest region above the margin's difference.

    Or all large ones, where they fill one quadrilateral: a stripe of the floor's colour divides the carpet.
    """
    rows, columns = (side // step * step for side in difference.shape)
    blocks = difference[:rows, :columns].reshape(rows // step, step, columns // step, step)
    mask = scipy.ndimage.binary_fill_holes(blocks.mean(axis=(1, 3)) > _PLAIN)
    radius = max(1, round(0.012 * max(mask.shape)))
    mask = scipy.ndimage.binary_opening(mask, np.ones((2 * radius + 1, 2 * radius + 1), dtype=bool))
    labels, count = scipy.ndimage.label(mask)
    if count == 0:
        raise _unclear(Sentence("picture.outline-plain"))
    areas = np.bincount(labels.ravel())
    areas[0] = 0
    if areas.max() < _LEAST_AREA * mask.size:
        raise _unclear(Sentence("picture.outline-small"))
    largest: BoolArray = scipy.ndimage.binary_fill_holes(labels == areas.argmax())
    parts = np.flatnonzero(areas > _LEAST_PART * areas.max())
    together = np.isin(labels, parts)
    if len(parts) > 1 and _common_share(together, _largest_quadrilateral(_hull(together))) > _LEAST_TOGETHER:
        return together
    if areas.sum() - areas.max() > _MOST_BESIDE * areas.max():
        raise _unclear(Sentence("picture.outline-parts"))
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
        raise _unclear(Sentence("picture.outline-no-corners"))
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
