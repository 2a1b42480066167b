"""Thousands of plate cams at once: smallest prime radius, pressure angle, curvature, undercut, area, torque.

Each design is a rise, a fall by the same law and a dwell, with a translating roller, knife edge or sphere. The results
equal those of `sizing`, `limits` and `contact` for a single cam. Designs of one law share its samples: with s = L s(u)
and ds = L v(u)/beta all bounds are searched on one grid of u, and refined only near the maxima.
[formulas and sources: `profile`, `limits`, `contact`; Norton, Cam Design and Manufacturing, 7, 9]
"""

import itertools
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, fields

import numpy as np

from ilmek.arrays import Bool, Float, FloatArray, Int
from ilmek.cams.laws import Law
from ilmek.cams.programme import TURN
from ilmek.errors import ParameterError
from ilmek.records import record

PerDesign = Float[np.ndarray, " designs"]

_COARSE = 64
"""Points of the first grid over a law, divided among its pieces, at least _LEAST in each."""

_LEAST = 13
_ZOOM = 9
_ZOOMS = 4
_INSIDE = 1e-12
"""Distance in u inside a piece at which one-sided values are taken."""

_CLOSE = 0.05
"""Pieces whose coarse maximum is within this share of the range from the design's best are refined too."""

_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(32)


@record
class CamRequirements:
    """Data of many cams, one entry per design; lengths in m, angles in rad.

    law    index of the motion law in the accompanying list
    lift   of the follower           rise, fall   cam angles of the rise and of the fall
    limit  of the pressure angle on the rise
    offset, roller_radius            0: in line, knife edge
    mass, speed, rate, preload, load as in `contact.FollowerLoad`; default: 0
    Raises ParameterError where rise and fall exceed a turn, and unless 0 < limit < pi/2.
    """

    law: Int[np.ndarray, " designs"]
    lift: PerDesign
    rise: PerDesign
    fall: PerDesign
    limit: PerDesign
    offset: PerDesign
    roller_radius: PerDesign
    mass: PerDesign
    speed: PerDesign
    rate: PerDesign
    preload: PerDesign
    load: PerDesign

    def __post_init__(self) -> None:
        if np.any(self.rise + self.fall > TURN * (1 + 1e-12)):
            raise ParameterError("a rise and a fall that do not fit one turn", allowed="together at most 360 deg")
        if np.any((self.limit <= 0) | (self.limit >= math.pi / 2)):
            raise ParameterError("a limit of the pressure angle", allowed="above 0 deg, below 90 deg")


@record
class CamSweep:
    """Results of many cams, one entry per design.

    prime_radius          smallest for the limit of the pressure angle [m]
    pressure_angle_max    on the rise [rad]
    curvature_radius_min  of the pitch curve, convex [m]
    undercut              also true where the prime radius is not above the offset or the roller's radius
    area                  of the cam's face [m^2]; NaN where the prime radius is too small
    torque_max            largest magnitude of the shaft's torque [N m]
    """

    prime_radius: PerDesign
    pressure_angle_max: PerDesign
    curvature_radius_min: PerDesign
    undercut: Bool[np.ndarray, " designs"]
    area: PerDesign
    torque_max: PerDesign


_FIELDS = tuple(one.name for one in fields(CamRequirements))


def requirements(count: int, **given: object) -> CamRequirements:
    """Requirements of `count` designs from numbers and arrays (count,), by the names and units of `CamRequirements`.

    Fields that are not given are 0; default of `fall`: the rise, or the remaining turn if that is less.

    >>> requirements(2, law=0, lift=0.02, rise=np.array([1.5, 4.0]), limit=0.5).fall.round(4).tolist()
    [1.5, 2.2832]
    """
    values = dict.fromkeys(_FIELDS, 0.0) | given
    if "fall" not in given:
        values["fall"] = np.minimum(values["rise"], TURN - np.asarray(values["rise"]))  # type: ignore[call-overload]
    arrays = {name: np.broadcast_to(np.asarray(value, dtype=float), (count,)) for name, value in values.items()}
    return CamRequirements(**(arrays | {"law": arrays["law"].astype(np.int64)}))


def sweep(laws: Sequence[Law], designs: CamRequirements) -> CamSweep:
    """Results of all designs, law by law. Raises IndexError for an index outside the list of laws."""
    count = designs.law.size
    rows = np.empty((5, count))
    for index in np.unique(designs.law):
        here = np.flatnonzero(designs.law == index)
        rows[:, here] = _of_law(laws[index], designs, here)
    prime, pressure, bend, area, torque = rows
    radius = 1 / bend
    filled = prime <= np.maximum(np.abs(designs.offset), designs.roller_radius)
    return CamSweep(
        prime_radius=prime,
        pressure_angle_max=np.arctan(pressure),
        curvature_radius_min=radius,
        undercut=filled | (radius <= designs.roller_radius),
        area=np.where(filled, np.nan, area),
        torque_max=torque,
    )


@dataclass(frozen=True, slots=True)
class _Stroke:
    """Rise or fall of the designs of a law: columns (designs, 1), or (selected, 1) in the refinement."""

    law: Law
    base: FloatArray
    lift: FloatArray
    span: FloatArray

    def of(self, rows: Int[np.ndarray, " rows"]) -> "_Stroke":
        return _Stroke(self.law, self.base[rows], self.lift[rows], self.span[rows])

    def s(self, u: FloatArray) -> FloatArray:
        return np.asarray(self.base + self.lift * self.law.s(u))

    def ds(self, u: FloatArray) -> FloatArray:
        return np.asarray(self.lift / self.span * self.law.v(u))

    def dds(self, u: FloatArray) -> FloatArray:
        return np.asarray(self.lift / self.span**2 * self.law.a(u))


_Value = Callable[[_Stroke, FloatArray, Callable[[FloatArray], FloatArray]], FloatArray]
"""A quantity of a stroke at u; the last argument selects the rows of a column of the designs."""


def _of_law(law: Law, designs: CamRequirements, here: Int[np.ndarray, " rows"]) -> FloatArray:
    """Prime radius, tangent of the pressure angle, largest curvature, area, torque of the designs of one law."""
    column = {name: getattr(designs, name)[here][:, None] for name in _FIELDS if name != "law"}
    lift, offset, roller = column["lift"], column["offset"], column["roller_radius"]
    rising = _Stroke(law, np.zeros_like(lift), lift, column["rise"])
    falling = _Stroke(law, lift, -lift, column["fall"])
    slope = np.tan(column["limit"])

    demand = _top(rising, lambda stroke, u, pick: np.abs(stroke.ds(u) - pick(offset)) / pick(slope) - stroke.s(u))
    prime = np.hypot(np.maximum(demand, 0.0)[:, None], offset)
    near = np.sqrt(np.maximum(prime**2 - offset**2, 0.0))

    def leaning(stroke: _Stroke, u: FloatArray, pick: Callable[[FloatArray], FloatArray]) -> FloatArray:
        return np.asarray(np.abs(stroke.ds(u) - pick(offset)) / (stroke.s(u) + pick(near)))

    def bend(stroke: _Stroke, u: FloatArray, pick: Callable[[FloatArray], FloatArray]) -> FloatArray:
        e, r, ds = pick(offset), stroke.s(u) + pick(near), stroke.ds(u)
        along = r**2 + (ds - e) ** 2
        return np.asarray((r * (r - stroke.dds(u)) + (ds - e) * (2 * ds - e)) / (along * np.sqrt(along)))

    inertia = column["mass"] * column["speed"] ** 2
    pushed = column["preload"] + column["load"]

    def torque(stroke: _Stroke, u: FloatArray, pick: Callable[[FloatArray], FloatArray]) -> FloatArray:
        force = pick(inertia) * stroke.dds(u) + pick(column["rate"]) * stroke.s(u) + pick(pushed)
        return np.asarray(np.abs(force * stroke.ds(u)))

    with np.errstate(divide="ignore", invalid="ignore"):
        rest = TURN - column["rise"] - column["fall"]
        resting = np.where(rest > 1e-9, 1 / prime, -np.inf)[:, 0]
        sharpest = np.maximum(np.maximum(_top(rising, bend), _top(falling, bend)), resting)
        pressure = _top(rising, leaning)
    area = _sector(rising, near, offset, roller) + _sector(falling, near, offset, roller)
    area += 0.5 * rest * (prime - roller) ** 2
    turning = np.maximum(_top(rising, torque), _top(falling, torque))
    return np.stack([prime[:, 0], pressure, sharpest, area[:, 0], turning])


def _sector(stroke: _Stroke, near: FloatArray, offset: FloatArray, roller: FloatArray) -> FloatArray:
    """Area inside the surface swept by a stroke: 1/2 integral of (K . n) flow_K, as `limits.area` (Green)."""
    u, weight = _nodes(stroke.law)
    r, ds, dds = stroke.s(u) + near, stroke.ds(u), stroke.dds(u)
    square = r**2 + (ds - offset) ** 2
    flow = np.sqrt(square)
    turning = (r * (r - dds) + (ds - offset) * (2 * ds - offset)) / square
    out = (r**2 - offset * (ds - offset)) / flow - roller
    inside = 0.5 * out * (flow - roller * turning)
    return np.asarray(stroke.span * np.sum(weight * inside, axis=1, keepdims=True))


def _nodes(law: Law) -> tuple[FloatArray, FloatArray]:
    """Gauss' nodes and weights over the pieces of a law."""
    edges = np.array([0.0, *law.breaks, 1.0])
    half = 0.5 * np.diff(edges)[:, None]
    middle = 0.5 * (edges[1:] + edges[:-1])[:, None]
    return (middle + half * _NODES).ravel(), (half * _WEIGHTS).ravel()


def _top(stroke: _Stroke, value: _Value) -> PerDesign:
    """Supremum over u of a quantity of each design, piece by piece, one-sided at the breaks."""
    edges = np.array([0.0, *stroke.law.breaks, 1.0])
    count = max(_LEAST, _COARSE // (edges.size - 1))
    pieces = [np.linspace(low + _INSIDE, high - _INSIDE, count) for low, high in itertools.pairwise(edges)]
    coarse = [value(stroke, u, lambda column: column) for u in pieces]
    tops = np.stack([np.max(rows, axis=1) for rows in coarse])
    best = np.max(tops, axis=0)
    spread = best - np.min(np.stack([np.min(rows, axis=1) for rows in coarse]), axis=0)
    for u, rows, top in zip(pieces, coarse, tops, strict=True):
        close = np.flatnonzero(top >= best - _CLOSE * spread)
        if close.size:
            best[close] = np.maximum(best[close], _refined(stroke, value, close, u, rows[close]))
    return np.asarray(best)


def _refined(
    stroke: _Stroke, value: _Value, rows: Int[np.ndarray, " rows"], u: FloatArray, found: FloatArray
) -> Float[np.ndarray, " rows"]:
    """Maximum of some designs in one piece: zooming grids, then the vertex of a parabola."""
    some, grid = stroke.of(rows), np.broadcast_to(u, found.shape)
    row = np.arange(rows.size)
    for _ in range(_ZOOMS):
        at = np.argmax(found, axis=1)
        low, high = grid[row, np.maximum(at - 1, 0)], grid[row, np.minimum(at + 1, grid.shape[1] - 1)]
        grid = low[:, None] + (high - low)[:, None] * np.linspace(0.0, 1.0, _ZOOM)
        found = value(some, grid, lambda column: column[rows])
    at = np.clip(np.argmax(found, axis=1), 1, _ZOOM - 2)
    before, middle, after = found[row, at - 1], found[row, at], found[row, at + 1]
    curve = before - 2 * middle + after
    with np.errstate(divide="ignore", invalid="ignore"):
        vertex = middle - (after - before) ** 2 / (8 * curve)
    inside = (curve < 0) & (np.abs(after - before) <= -2 * curve)
    return np.asarray(np.where(inside, vertex, np.max(found, axis=1)))
