"""Straight edges along a side of a carpet in a photograph, from outside inwards.

A strip of the picture across the side is sampled: `along` × `across`. The step at a point is the difference in CIELAB
between the means of `_FLANK` pixels on both sides of it. An edge is a straight line on which, at `LEAST_SHARE` of the
points along it or more, the step is at a maximum, is above the grain, and has other colours than the floor's inside: no
seam of planks, no shadow, no ragged end of a fringe is one. Lines are counted as in a Hough transform by their offset
and slope.
"""

import numpy as np
import scipy

from ilmek.arrays import BoolArray, Float, FloatArray
from ilmek.carpet.floor import BLACK, Lab
from ilmek.records import record

LEAST_SHARE = 0.55
"""Least share of points on a line that is an edge."""

_ENDS = 0.06
"""Part of a side at each of its ends that is not used: corners are worn and round."""

_SAMPLES = 400
_STEP = 0.5
"""Distance of the samples across a side [pixels]."""

_FLANK = 4
"""Samples across that are averaged on each side of a step: 2 pixels."""

_SMOOTHED = 5
"""Samples along a side that are averaged for a step."""

_LEAST_STEP, _GRAINS = 4.0, 3.0
"""Least step of an edge: CIELAB, and of the median step outside."""

_NEAR = 2
"""Samples by which points may lie beside their line: a pixel."""

_AROUND = np.arange(-6, 7)
"""Samples about an edge among which the maximum of the step is sought."""

_BAND = 3
"""Largest number of samples of the colour inside an edge."""

_DEEP, _PART, _BESIDE = 24, 8, 3
"""Largest number of samples across a band in which threads are sought, number of those at its outer and inner edge, in
which they have to show, too, and of those at the edges that are left out."""

_SLOW = 11
"""Samples along a side beyond which a change is none of threads."""

_UNDYED = 45.0
"""L* of the lightest tenth of a band of undyed threads, at least."""

_LEAST_THREADS = 1.0
"""Least deviation of L* from thread to thread."""

_ALONG, _HARDLY, _GREY = 0.75, 0.6, 0.8
"""Ratio of that to the change along the threads, at least, and below which there are none; most ratio of a* and b* to
L* in it."""

_SLOPES = 41

_SHARP = 6
"""Distance across at which a sharp step has ended [samples]."""

_OUTSIDE, _BEYOND = (4.0, 9.0), ((-0.035, -0.005), (1.005, 1.035))
"""Where the fringe of other sides is looked for: outside a side [pixels], and beyond its ends [lengths of it]."""

_CLEAR = 2.5
"""Distance from an edge at which its own blur has ended [pixels]."""


@record
class SideStrip:
    """The picture across a side: `lab` (along, across, 3), difference to the floor, step and whether it is an edge's.

    start, end  of the side [pixels]     across  distances outwards, falling [pixels]     share  places along it, 0..1
    grain  step that the floor's grain has
    """

    start: FloatArray
    end: FloatArray
    share: FloatArray
    across: FloatArray
    lab: FloatArray
    difference: FloatArray
    step: FloatArray
    edge: BoolArray
    grain: float


@record
class Edge:
    """A straight edge: sample across it at the side's middle, its slope [samples per side], share of points on it."""

    middle: float
    slope: float
    share: float

    def column(self, strip: SideStrip) -> FloatArray:
        """Its samples across for each point along."""
        return self.middle + self.slope * (strip.share - 0.5)


@record
class SideBand:
    """A band along a side: its median colour, least mean L* just outside it, whether threads show in it, and may show.

    Threads are lighter and darker along the side, the same inwards, and of one hue with what shows between them.
    """

    colour: Float[np.ndarray, "3"]
    outside: float
    threads: bool
    perhaps: bool


def sampled(  # noqa: PLR0917
    lab: Lab, difference: FloatArray, start: FloatArray, end: FloatArray, reach: float, grain: float | None = None
) -> SideStrip:
    """The strip about the side from `start` to `end`, `reach` to both sides [pixels].

    grain  of the floor; default: the median step in the outer quarter of the strip
    """
    direction = (end - start) / np.hypot(*(end - start))
    outwards = np.array([direction[1], -direction[0]])
    across = np.arange(reach, -reach, -_STEP)
    share = np.linspace(_ENDS, 1 - _ENDS, _SAMPLES)
    points = start + share[:, None, None] * (end - start) + across[:, None] * outwards - 0.5
    pixels = points[..., 1], points[..., 0]
    seen = np.stack([scipy.ndimage.map_coordinates(lab[..., k], pixels, order=1, mode="nearest") for k in range(3)], -1)
    unlike = scipy.ndimage.map_coordinates(difference, pixels, order=1, mode="nearest")
    smooth = scipy.ndimage.uniform_filter1d(seen, _SMOOTHED, axis=0)
    sums = np.cumsum(np.pad(smooth, ((0, 0), (1, 0), (0, 0))), axis=1)
    means = (sums[:, _FLANK:] - sums[:, :-_FLANK]) / _FLANK
    step = np.zeros(unlike.shape)
    step[:, _FLANK:-_FLANK] = np.linalg.norm(means[:, _FLANK + 1 :] - means[:, : -_FLANK - 1], axis=-1)
    if grain is None:
        grain = float(np.median(step[:, _FLANK : len(across) // 4]))
    top = step == scipy.ndimage.maximum_filter1d(step, _FLANK + 3, axis=1)
    inside = scipy.ndimage.maximum_filter1d(unlike, 6, axis=1, origin=-3)
    edge = top & (step > max(_LEAST_STEP, _GRAINS * grain)) & (inside > 1)
    return SideStrip(start, end, share, across, seen, unlike, step, edge, grain)


def edges_of(strip: SideStrip, tilt: float) -> list[Edge]:
    """Straight edges in a strip, from outside inwards, whose ends are at most `tilt` apart across [pixels]."""
    wide = scipy.ndimage.maximum_filter1d(strip.edge, 2 * _NEAR + 1, axis=1)
    columns = np.arange(len(strip.across))
    slopes = np.linspace(-tilt, tilt, _SLOPES) / _STEP
    shares = np.empty((_SLOPES, len(columns)))
    rows = np.arange(_SAMPLES)[:, None]
    for number, slope in enumerate(slopes):
        column = np.rint(slope * (strip.share - 0.5)).astype(int)[:, None] + columns
        within = (column >= 0) & (column < len(columns))
        shares[number] = (wide[rows, column.clip(0, len(columns) - 1)] & within).mean(axis=0)
    profile = shares.max(axis=0)
    peaks = (profile == scipy.ndimage.maximum_filter1d(profile, 4 * _NEAR - 1)) & (profile >= LEAST_SHARE)
    labels, count = scipy.ndimage.label(scipy.ndimage.maximum_filter1d(peaks, 3))
    edges = []
    for number in range(1, count + 1):
        among = np.flatnonzero((labels == number) & peaks)
        middle = int(among[len(among) // 2])
        best = np.flatnonzero(shares[:, middle] == profile[middle])
        edges.append(Edge(float(middle), float(slopes[best].mean()), float(profile[middle])))
    return [edge for edge in edges if not any(_crossed(edge, other) for other in edges)]


def _crossed(edge: Edge, other: Edge) -> bool:
    """Whether an edge crosses a clearer one along the side: it consists of parts of others."""
    apart, turned = edge.middle - other.middle, 0.5 * (edge.slope - other.slope)
    return other.share > edge.share and abs(apart) < abs(turned)


def band_inside(strip: SideStrip, edge: Edge, end: Edge | None) -> SideBand:
    """The band inside an edge, as far as the edge `end`."""
    column = edge.column(strip)
    depth = np.inf if end is None else float(np.median(end.column(strip) - column))
    near = _samples(strip, column + 2.0, int(min(_BAND, max(2.0, depth - 2.0))))
    wide = _samples(strip, column + _BESIDE, int(np.clip(depth - 2 * _BESIDE, 2, _DEEP)))
    deep, deeply = _of_threads(wide)
    outer, outwards = _of_threads(wide[:, :_PART])
    threads, perhaps = outer > _ALONG * outwards, outer > _HARDLY * outwards or deep > _HARDLY * deeply
    if end is not None and depth >= 4 * _PART:
        inner, inwards = _of_threads(_samples(strip, end.column(strip) - _BESIDE - _PART, _PART))
        threads = threads and inner > _HARDLY * inwards
    if np.quantile(wide[..., 0], 0.9) < _UNDYED:
        threads = perhaps = False
    outside = float(_samples(strip, column - _PART, _PART)[..., 0].mean(axis=0).min())
    return SideBand(np.median(near, axis=(0, 1)), outside, threads and deep > 0, threads or perhaps)


def _of_threads(colours: Float[np.ndarray, "along across 3"]) -> tuple[float, float]:
    """The deviation of L* from thread to thread, 0 where there is none, and the change along the threads."""
    means = colours.mean(axis=1)
    quick = np.abs(means - scipy.ndimage.median_filter(means, (_SLOW, 1)))
    light, a, b = (1.48 * np.median(quick, axis=0)).tolist()
    along = float(np.sqrt(np.mean(np.diff(colours[..., 0], axis=1) ** 2)))
    return light if light >= _LEAST_THREADS and max(a, b) <= _GREY * light else 0.0, along


def _samples(strip: SideStrip, column: FloatArray, count: int) -> FloatArray:
    """The colours at so many samples inwards from a column, (along, count, 3)."""
    columns = np.rint(column[:, None] + np.arange(count)).astype(int).clip(0, len(strip.across) - 1)
    return np.asarray(strip.lab[np.arange(_SAMPLES)[:, None], columns])


def step_outside(strip: SideStrip) -> float:
    """Largest step in the mean colours along a side, from `_CLEAR` pixels outside its middle line outwards, CIELAB.

    A change of light is a factor on L* + 16, a* and b*, and is left out.
    """
    colours = strip.lab.mean(axis=0) + BLACK
    floor = colours[: len(strip.across) // 4].mean(axis=0)
    unlit = colours - (colours @ floor / (floor @ floor))[:, None] * floor
    outside = unlit[: len(strip.across) // 2 - round(_CLEAR / _STEP)]
    return float(np.linalg.norm(outside[_FLANK:] - outside[:-_FLANK], axis=1).max(initial=0.0))


def sharp_step_outside(strip: SideStrip) -> tuple[float, float]:
    """Largest step of the mean L* along a side, outside its middle line, over the steps `_SHARP` samples beside it, and
    its distance from the line [pixels].

    The edge of a shadow is softer. 0 where threads begin at the line: a fringe ends sharply, too.
    """
    middle = len(strip.across) // 2
    if band_inside(strip, Edge(middle - _DEEP, 0.0, 0.0), Edge(middle, 0.0, 0.0)).threads:
        return 0.0, 0.0
    step = _steps_of_light(strip)[: middle - round(_CLEAR / _STEP) - _FLANK // 2]
    padded = np.pad(step, (0, _SHARP))
    prominent = step[_SHARP:] - np.maximum(step[:-_SHARP], padded[2 * _SHARP :])
    place = int(prominent.argmax()) + _SHARP
    return float(prominent[place - _SHARP]), _STEP * (middle - place - _FLANK / 2)


def step_beside(strip: SideStrip, distance: float) -> float:
    """Largest step of the mean L* along a side, about that distance outside its middle line [pixels]."""
    place = len(strip.across) // 2 - round(distance / _STEP + _FLANK / 2)
    return float(_steps_of_light(strip)[max(0, place - _SHARP) : max(1, place + _SHARP)].max())


def _steps_of_light(strip: SideStrip) -> FloatArray:
    light = strip.lab[..., 0].mean(axis=0)
    return np.asarray(np.abs(light[_FLANK:] - light[:-_FLANK]))


def unlike_in_any_light(strip: SideStrip, floor: FloatArray) -> float:
    """Distance of the colour just outside the middle line of a side to that of the floor in any light, CIELAB.

    0 where threads are there.
    """
    middle = len(strip.across) // 2
    band = band_inside(strip, Edge(middle - _DEEP // 2, 0.0, 0.0), Edge(middle, 0.0, 0.0))
    colour, lit = band.colour + BLACK, floor + BLACK
    return 0.0 if band.perhaps else float(np.linalg.norm(colour - (colour @ lit / (lit @ lit)) * lit))


def share_like_floor(strip: SideStrip) -> float:
    """Share of what is just inside the middle line of a side that differs from the floor no more than its grain."""
    first = len(strip.across) // 2 + _FLANK
    return float(np.mean(strip.difference[:, first : first + 2 * _FLANK] < 1))


def share_unlike_beyond(difference: FloatArray, strip: SideStrip) -> float:
    """Share of what is just outside a side's line and beyond either end of it that is no floor, the lesser of both.

    The fringe of the sides that meet it ends at that line: where it reaches farther, so does the carpet.
    """
    along = strip.end - strip.start
    unit = along / np.hypot(*along)
    across = np.arange(*_OUTSIDE)[:, None] * np.array([unit[1], -unit[0]])
    shares = []
    for end in _BEYOND:
        places = strip.start + np.linspace(*end, 20)[:, None, None] * along + across - 0.5
        unlike = scipy.ndimage.map_coordinates(difference, (places[..., 1], places[..., 0]), order=1, mode="nearest")
        shares.append(float(np.mean(unlike > 1)))
    return min(shares)


def fitted_line(strip: SideStrip, edge: Edge, tolerance: float) -> tuple[FloatArray, float]:
    """The line a x + b y = c of an edge, by least squares without outliers, and the share of points on it.

    The column of a step is the vertex of the parabola through its maximum and the two samples beside it.
    """
    rows = np.arange(_SAMPLES)
    nearest = np.rint(edge.column(strip)).astype(int)[:, None] + _AROUND
    steps = np.where(strip.edge[rows[:, None], nearest.clip(0, len(strip.across) - 1)], 1.0, 0.0)
    steps -= 0.01 * np.abs(_AROUND)
    best = steps.argmax(axis=1)
    seen = steps[rows, best] > 0.5
    peak = nearest[rows, best].clip(1, len(strip.across) - 2)
    before, top, after = (strip.step[rows, peak + k] for k in (-1, 0, 1))
    bend = before - 2 * top + after
    vertex = np.where(bend < 0, 0.5 * (before - after) / np.minimum(bend, -1e-9), 0.0).clip(-1, 1)
    x, y = strip.share[seen], strip.across[0] - _STEP * (peak + vertex)[seen]
    slope, offset = -_STEP * edge.slope, strip.across[0] - _STEP * (edge.middle - 0.5 * edge.slope)
    on = np.zeros(len(x), dtype=bool)
    for width in (2 * tolerance, tolerance, tolerance):
        on = np.abs(y - offset - slope * x) <= width
        if np.count_nonzero(on) < 2:
            break
        slope, offset = np.polyfit(x[on], y[on], 1)
    length = float(np.hypot(*(strip.end - strip.start)))
    along = (strip.end - strip.start) / length
    outwards = np.array([along[1], -along[0]])
    direction = along * length + slope * outwards
    normal = np.array([-direction[1], direction[0]]) / np.hypot(*direction)
    return np.array([*normal, normal @ (strip.start + offset * outwards)]), float(np.count_nonzero(on)) / _SAMPLES
