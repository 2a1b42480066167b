"""The arm for a section: of all whose needle passes the gap's middle to the hand-over, the one of least effort.

Such an arm has three free parameters: the second link a2, the needle's tilt phi0 at rest, and the distance t of the
pivot from the middle of the elbow's two positions, on their perpendicular bisector:

    E0 = G + (a2 - rho0) i e^{i phi0},   E1 = G + (a2 - rho1) i e^{i phi1},   O = (E0 + E1)/2 + t i (E1 - E0)/|E1 - E0|

phi1 and rho1 are those of the hand-over. The needle is nowhere tilted more than there, so that its clearance is the
greatest that the section has. Of the arms that fit the one is taken whose links are least moved and light:

    (a1² + a2²) (|dth1| + |dth2|)        inertia and swing

A grid of all three, then finer ones about the best: no chance in it, the same arm every time. Where no arm keeps every
limit, the one that misses the fewest is taken, and the checks of the head fail.
"""

from dataclasses import dataclass

import numpy as np

from ilmek.arrays import Bool, BoolArray, ComplexArray, Float, FloatArray
from ilmek.errors import ParameterError
from ilmek.linkage.swivelled_arm import SwivelledArm
from ilmek.machines.knotting_dyad.jaws import least_clamp
from ilmek.machines.knotting_dyad.params import KnottingDyadParams
from ilmek.machines.knotting_dyad.section import WarpSection
from ilmek.plane.vectors import cross
from ilmek.units import format_quantity

GRID, ZOOM, ROUNDS, SHRINK = (20, 21, 40), 9, 8, 0.45
"""Values of a2, phi0 and t at first; then of each, how often, and by how much the grid shrinks."""

LONGER, MISSED = 1.25, 1e3
"""Links that are tried where the second one alone is over its limit, over it; cost of a limit that is missed."""

EXACT = 1e-12
"""Part of a limit, and length [m], by which an arm that lies on the limit may miss it.

At the hand-over the needle of every arm stands at the limit beside the centre gripper: without it half of the arms
would be refused by their rounding, others on another processor.
"""

SAMPLES = 17
"""Positions on the path at which tilt and sides are checked."""


@dataclass(frozen=True, slots=True)
class _Tried:
    """Arms of a grid, each by its number.

    cost  with MISSED for each limit missed, infinite where no arm is; the own side counts for those alone that may be
          the best
    """

    pivot: ComplexArray
    first: FloatArray
    second: FloatArray
    side: FloatArray
    cost: FloatArray


def best_arm(params: KnottingDyadParams, section: WarpSection) -> SwivelledArm:
    """The left arm. Raises ParameterError where there is none."""
    least = section.needle_length + least_clamp(params)
    limit = max(params.link_limit, LONGER * least)
    seconds = np.geomspace(least, limit, GRID[0])
    tilts = np.linspace(-section.tilt, section.tilt, GRID[1])
    offsets = np.geomspace(section.reach / 10, limit, GRID[2] // 2)
    axes = [np.log(seconds), tilts, np.concatenate([np.log(offsets), np.log(offsets)])]
    signs = np.repeat([1.0, -1.0], GRID[2] // 2)
    grids = np.meshgrid(axes[0], axes[1], np.arange(GRID[2]), indexing="ij")
    number = grids[2].ravel()
    at = np.stack([grids[0].ravel(), grids[1].ravel(), axes[2][number]], axis=-1)
    tried = _tried(params, section, at, signs[number])
    chosen = int(np.argmin(tried.cost))
    if not np.isfinite(tried.cost[chosen]):
        raise _none(params, "none reaches the hand-over")
    steps = np.array([axis[1] - axis[0] for axis in axes])
    return _refined(params, section, at[chosen], steps, float(signs[number[chosen]]))


def _refined(
    params: KnottingDyadParams, section: WarpSection, centre: Float[np.ndarray, "3"], steps: FloatArray, sign: float
) -> SwivelledArm:
    """The best of ever finer grids about a set of parameters that fits."""
    spread = np.linspace(-1.0, 1.0, ZOOM)
    cube = np.stack([axis.ravel() for axis in np.meshgrid(spread, spread, spread, indexing="ij")], axis=-1)
    for _ in range(ROUNDS):
        at = centre + cube * steps
        tried = _tried(params, section, at, np.full(len(at), sign))
        best = int(np.argmin(tried.cost))
        centre, steps = at[best], steps * SHRINK
    return SwivelledArm(
        pivot=complex(tried.pivot[best]),
        first=float(tried.first[best]),
        second=float(tried.second[best]),
        swivel=section.gap,
        side=int(tried.side[best]),
        begin=-section.front,
        end=section.reach,
    )


def _tried(params: KnottingDyadParams, section: WarpSection, at: Float[np.ndarray, "n 3"], sign: FloatArray) -> _Tried:
    second, tilt, offset = np.exp(at[:, 0]), at[:, 1], sign * np.exp(at[:, 2])
    gap, r0, r1 = section.gap, second + section.front, second - section.reach
    E0, E1 = gap + r0 * 1j * np.exp(1j * tilt), gap + r1 * 1j * np.exp(1j * section.tilt)
    pivot = (E0 + E1) / 2 + offset * 1j * (E1 - E0) / np.abs(E1 - E0)
    first, side = np.abs(pivot - E0), np.sign(cross(pivot - gap, E0 - gap))
    with np.errstate(invalid="ignore", divide="ignore"):
        bent = _bent(np.abs(pivot - gap), first, r0, r1)
        there = (side == np.sign(cross(pivot - gap, E1 - gap))) & (r1 > 0) & (bent > 0)
        limits = (
            np.abs(tilt) <= section.tilt * (1 + EXACT),
            np.maximum(first, second) <= params.link_limit * (1 + EXACT),
            second >= (section.needle_length + least_clamp(params)) * (1 - EXACT),
            bent >= np.sin(params.bend_limit) * (1 - EXACT),
            _pivot_clear(params, section, pivot),
        )
        missed = np.sum([~limit for limit in limits], axis=0)
        turns = np.abs(np.angle((E1 - pivot) / (E0 - pivot))) + np.abs(tilt - section.tilt)
        effort = (first**2 + second**2) * turns
        before = np.where(there, effort + MISSED * missed, np.inf)
        near = there & (before <= np.min(before) + MISSED)  # no other can be the best
        missed[near] += ~_own_side(params, section, *(one[near] for one in (pivot, first, second, side)))
    cost = np.where(there, effort + MISSED * missed, np.inf)
    return _Tried(pivot, first, second, side, cost)


def _bent(base: FloatArray, first: FloatArray, r0: FloatArray, r1: FloatArray) -> FloatArray:
    """Least sine between the links: see `SwivelledArm.bend`."""
    cosine = np.maximum(*(np.abs(r + (first**2 - base**2) / r) for r in (r0, r1))) / (2 * first)
    return np.asarray(np.sqrt(1 - cosine**2))


def _pivot_clear(params: KnottingDyadParams, section: WarpSection, pivot: ComplexArray) -> BoolArray:
    """The pivot is above warps and pile, and leaves room for the other arm's motor."""
    room = section.middle - pivot.real >= params.pivot_room / 2 - EXACT
    return np.asarray(room & (pivot.imag >= 2 * params.leg - EXACT))


def _own_side(  # noqa: PLR0917
    params: KnottingDyadParams,
    section: WarpSection,
    pivot: ComplexArray,
    first: FloatArray,
    second: FloatArray,
    side: FloatArray,
) -> Bool[np.ndarray, " n"]:
    """The wide parts stay above the warps, and on their side of the centre gripper's; the elbows, which bear the necks
    of the solenoids, beside the opener's plates; the tilt within its limit.
    """
    base = np.abs(pivot - section.gap)[:, None]
    beyond = np.linspace(-section.front, section.reach, SAMPLES)
    r = second[:, None] - beyond
    cosine = (r + (base**2 - first[:, None] ** 2) / r) / (2 * base)
    out = np.exp(1j * (np.angle(pivot - section.gap)[:, None] + side[:, None] * np.arccos(cosine)))
    elbow, wide = section.gap + r * out, section.gap + (section.needle_length - beyond) * out
    room = section.width + section.room - EXACT
    above = section.width / 2 + section.warp / 2 + section.room - EXACT
    right = np.maximum(elbow.real, wide.real)
    low = np.minimum(elbow.imag, wide.imag)
    straight = out.imag >= np.cos(section.tilt) - EXACT
    beside = elbow.real <= section.middle - _elbow_room(params, section) + EXACT
    fits: Bool[np.ndarray, " n"] = np.all(
        (right <= section.middle - room) & (low >= above) & beside & straight, axis=-1
    )
    return fits & (pivot.real <= section.middle - room) & (pivot.imag >= above)


def _elbow_room(params: KnottingDyadParams, section: WarpSection) -> float:
    """From the middle of the pair to the elbows, at least [m]: an opener's plates reach to the pair's neighbours."""
    return 0.0 if params.room.plates is None else section.plate_half + params.room.plates


def _none(params: KnottingDyadParams, why: str) -> ParameterError:
    given = f"no arm with links of {format_quantity(params.link_limit, 'mm')} or less ties this knot: {why}"
    return ParameterError(given, do="allow longer links, less pivot_room or bend_limit, or a shorter leg")
