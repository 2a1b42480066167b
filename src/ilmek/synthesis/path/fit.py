"""Result of path synthesis: the four-bar, its error at each point, and the active limits."""

import cmath
import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ilmek.arrays import Complex, Float, Int
from ilmek.records import record
from ilmek.synthesis.candidate import Candidate, judge
from ilmek.synthesis.cognates import cognates
from ilmek.synthesis.four_bar import FourBar
from ilmek.synthesis.path.extent import RESERVE, extent
from ilmek.synthesis.path.limits import MARGIN, excess
from ilmek.synthesis.path.model import NAMES, SIZE, TURN, coupler_point
from ilmek.synthesis.path.task import PathTask
from ilmek.synthesis.task import PrecisionTask
from ilmek.units import format_quantity

FULL_TURN = 2 * math.pi

ACTIVE = 1e-7
"""Distance from a limit, in sizes of the path, up to which it is active."""


@dataclass(frozen=True, slots=True)
class Search:
    """Record of a search; the same seed and starts give the same result.

    seed          of the random starts
    starts        number of random starts
    evaluations   number of evaluations at all points, or for long paths at a part of them
    runs          number of independent runs that the starts are divided into
    optima        number of different errors up to twice the least (root mean square) that were met
    missed        estimated probability that a better optimum exists (`path.confidence`)
    agreed        number of random starts that ended at this squared error
    runs_agreed   number of runs that ended at it, by random starts or by variations of others
    """

    seed: int
    starts: int
    evaluations: int
    runs: int
    optima: int
    missed: float
    agreed: int = 0
    runs_agreed: int = 0


@record
class PathFit:
    """A four-bar for the points of a path.

    four_bar            drawn at the first point
    design              the ten numbers by name [m; rad]; the names are those of `PathTask.bounds`
    crank_angles        crank angle in the ground frame at each point [rad], continuous from the first
    errors              position of the tracer minus the point, at each point [m], complex
    active              active limits, as sentences
    least_transmission  least angle between coupler and rocker, or its supplement, over a whole turn [rad]
    search              record of the search
    """

    four_bar: FourBar
    design: Mapping[str, float]
    crank_angles: Float[np.ndarray, " points"]
    errors: Complex[np.ndarray, " points"]
    active: tuple[str, ...]
    least_transmission: float
    search: Search

    @property
    def squared_error(self) -> float:
        """Sum of the squared distances [m^2]."""
        return float(np.sum(np.abs(self.errors) ** 2))

    @property
    def greatest_error(self) -> float:
        """Greatest distance from a point [m]."""
        return float(np.max(np.abs(self.errors)))


class SearchEnd(NamedTuple):
    """End of a search.

    design  the ten numbers [m; rad]
    angles  crank angle relative to the ground link at each point [rad]
    branch  +1 or -1
    blocks  index of the block of each point; points of one block are met at one crank angle
    """

    design: Float[np.ndarray, "10"]
    angles: Float[np.ndarray, " points"]
    branch: int
    blocks: Int[np.ndarray, " points"]


def path_fit(task: PathTask, pose: SearchEnd, search: Search) -> PathFit:
    """The result of the end of a search."""
    design, angles, branch, blocks = pose
    drawn = _drawn(design, float(angles[0]), branch)
    reached = np.array([coupler_point(design, float(angle), branch) for angle in angles])
    named = {name: float(value) for name, value in zip(NAMES, design, strict=True)}
    named["turn"] = cmath.phase(cmath.exp(1j * named["turn"]))
    return PathFit(
        four_bar=drawn,
        design=named,
        crank_angles=angles - angles[0] + drawn.crank_angle,
        errors=reached - task.points,
        active=_active(task, design, branch, blocks),
        least_transmission=least_transmission(design),
        search=search,
    )


def judged(task: PathTask, fit: PathFit) -> Candidate:
    """Check of the four-bar by forward simulation: circuit, branch and order of each point (`candidate.judge`).

    Points count as met within the greatest error of the fit, at its crank angles.
    """
    crank = fit.crank_angles[0] + np.clip(fit.crank_angles - fit.crank_angles[0], -FULL_TURN, FULL_TURN)
    near = fit.greatest_error * (1 + 1e-6) + ACTIVE * task.size
    return judge(fit.four_bar, PrecisionTask(points=task.points, crank=crank, point_tolerance=near))


def least_transmission(design: Float[np.ndarray, "10"]) -> float:
    """Least of mu and its supplement over a turn [rad]: cos mu = (r3^2 + r4^2 - (r1 -+ r2)^2) / (2 r3 r4)."""
    r1, r2, r3, r4 = (float(length) for length in design[:4])
    cosines = ((r3**2 + r4**2 - reach**2) / (2 * r3 * r4) for reach in (r1 - r2, r1 + r2))
    return min(math.acos(min(1.0, abs(cosine))) for cosine in cosines)


def _drawn(design: Float[np.ndarray, "10"], angle: float, branch: int) -> FourBar:
    """The four-bar drawn at a crank angle relative to its ground link [rad]."""
    at_b = design.copy()
    at_b[4], at_b[5] = design[2], 0.0
    a0, turn = complex(design[6], design[7]), cmath.exp(1j * design[TURN])
    a = a0 + complex(design[1] * turn * cmath.exp(1j * angle))
    b, tracer = (complex(coupler_point(of, angle, branch)) for of in (at_b, design))
    return FourBar(a0, a0 + complex(design[0] * turn), a, b, tracer)


def _active(
    task: PathTask, design: Float[np.ndarray, "10"], branch: int, blocks: Int[np.ndarray, " points"]
) -> tuple[str, ...]:
    """Active limits of a design, as sentences."""
    low, high = task.limits()
    near, active = ACTIVE * task.size, []
    for index in range(SIZE):
        name, unit = NAMES[index], "deg" if index >= TURN else "mm"
        if low[index] == high[index]:
            continue
        if design[index] - low[index] <= near:
            active.append(f"{name} at its lower bound {format_quantity(low[index], unit)}")
        if high[index] - design[index] <= near:
            active.append(f"{name} at its upper bound {format_quantity(high[index], unit)}")
    if excess(design, task.sign, task.kappa) >= -near:
        least = f"transmission angle at its limit {math.degrees(task.transmission):.4g} deg"
        active.append(least if task.transmission else "full rotation of the crank at its limit (Grashof)")
    if max(design[:4]) >= (1 - 2 * MARGIN) * task.link_ratio * min(design[:4]):
        active.append(f"ratio of links at its limit {task.link_ratio:.4g}")
    if math.isfinite(task.size_max) and extent(design, branch, np.empty(SIZE)) >= (RESERVE - MARGIN) * task.size_max:
        active.append(f"size at its limit {format_quantity(task.size_max, 'mm')}, less 1 %")
    if task.timing is None:
        active += [
            f"order: points {k + 1} and {k + 2} met at one crank angle"
            for k in np.flatnonzero(blocks[1:] == blocks[:-1])
        ]
    return tuple(active)


def cognate_fit(task: PathTask, fit: PathFit) -> PathFit | None:
    """The cognate that rotates with the same crank (`synthesis.cognates`), with the same errors.

    None where it is degenerate, or not within the limits of the task.
    """
    other = cognates(fit.four_bar).timed
    if other is None:
        return None
    lengths, tracer = other.lengths, other.tracer_on_coupler
    assert tracer is not None
    turned = cmath.phase(other.b0 - other.a0) - cmath.phase(fit.four_bar.b0 - fit.four_bar.a0)
    turn = fit.design["turn"] + turned
    numbers = (*lengths, tracer.real, tracer.imag, other.a0.real, other.a0.imag, turn, fit.design["start"])
    design, (low, high) = np.array(numbers), task.limits()
    lowest, highest = low[TURN], high[TURN]
    if math.isfinite(lowest):
        design[TURN] = lowest + (turn - lowest) % FULL_TURN if highest - lowest > 0 else turn
    near = ACTIVE * task.size
    inside = ((low - near <= design) & (design <= high + near)).all()
    if not inside or excess(design, task.sign, task.kappa) > near:
        return None
    design[TURN] = cmath.phase(cmath.exp(1j * turn))
    return PathFit(
        four_bar=other,
        design={name: float(value) for name, value in zip(NAMES, design, strict=True)},
        crank_angles=fit.crank_angles + turned,
        errors=fit.errors,
        active=_active(task, design, other.branch, np.arange(len(task.points))),
        least_transmission=least_transmission(design),
        search=fit.search,
    )
