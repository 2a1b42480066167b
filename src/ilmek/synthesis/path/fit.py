"""One answer to the task of a path: the four-bar, how near it comes to each point, and which limits hold it."""

import cmath
import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ilmek.arrays import Complex, Float, Int
from ilmek.records import record
from ilmek.synthesis.candidate import Candidate, judge
from ilmek.synthesis.four_bar import FourBar
from ilmek.synthesis.path.limits import excess
from ilmek.synthesis.path.model import NAMES, SIZE, TURN, coupler_point
from ilmek.synthesis.path.task import PathTask
from ilmek.synthesis.task import PrecisionTask

ONCE = 2 * math.pi

AT = 1e-7
"""Distance from a limit, in sizes of the path, at which it is active."""


@dataclass(frozen=True, slots=True)
class Search:
    """How an answer was searched for: the same seed and starts give the same answers.

    seed, starts    random starts that were begun, in all
    evaluations     of the four-bar at all points or, for long paths, at a part of them
    agreed          starts that ended at this squared error
    """

    seed: int
    starts: int
    evaluations: int
    agreed: int


@record
class PathFit:
    """A four-bar for the points of a path.

    four_bar      drawn at the first point; its tracer is where it comes nearest (or at the timing's angle)
    design        the ten numbers by name [m, rad], as `PathTask.bounds` names them
    crank_angles  of the crank against the world's x at each point [rad], going on from the first
    errors        tracer less point, at each point [m], complex
    active        the limits at which the search ended, in words
    least_transmission  least angle [rad] between coupler and rocker, or its supplement, over a whole turn
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
        """Distance from the point that is missed most [m]."""
        return float(np.max(np.abs(self.errors)))


class SearchEnd(NamedTuple):
    """Where a search ended: the ten numbers [m, rad], the crank's angles against the ground link [rad], the branch, and
    the block of each point, whose points are met at one angle.
    """

    design: Float[np.ndarray, "10"]
    angles: Float[np.ndarray, " points"]
    branch: int
    blocks: Int[np.ndarray, " points"]


def path_fit(task: PathTask, pose: SearchEnd, search: Search) -> PathFit:
    """The answer from where a search ended."""
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
        active=_active(task, design, blocks),
        least_transmission=least_transmission(design),
        search=search,
    )


def judged(task: PathTask, fit: PathFit) -> Candidate:
    """The four-bar as every method's are judged: circuit, branch and order of each point, by forward simulation.

    Points count as met within the fit's own greatest error, at its own crank angles.
    """
    crank = fit.crank_angles[0] + np.clip(fit.crank_angles - fit.crank_angles[0], -ONCE, ONCE)
    near = fit.greatest_error * (1 + 1e-6) + AT * task.size
    return judge(fit.four_bar, PrecisionTask(points=task.points, crank=crank, point_tolerance=near))


def least_transmission(design: Float[np.ndarray, "10"]) -> float:
    """Least of mu and its supplement [rad] over a turn: cos mu = (r3^2 + r4^2 - (r1 -+ r2)^2) / (2 r3 r4)."""
    r1, r2, r3, r4 = (float(length) for length in design[:4])
    cosines = ((r3**2 + r4**2 - reach**2) / (2 * r3 * r4) for reach in (r1 - r2, r1 + r2))
    return min(math.acos(min(1.0, abs(cosine))) for cosine in cosines)


def _drawn(design: Float[np.ndarray, "10"], angle: float, branch: int) -> FourBar:
    """The four-bar at a crank angle against its ground link."""
    at_b = design.copy()
    at_b[4], at_b[5] = design[2], 0.0
    a0, turn = complex(design[6], design[7]), cmath.exp(1j * design[TURN])
    a = a0 + complex(design[1] * turn * cmath.exp(1j * angle))
    b, tracer = (complex(coupler_point(of, angle, branch)) for of in (at_b, design))
    return FourBar(a0, a0 + complex(design[0] * turn), a, b, tracer)


def _active(task: PathTask, design: Float[np.ndarray, "10"], blocks: Int[np.ndarray, " points"]) -> tuple[str, ...]:
    """The limits that hold a design, in words."""
    low, high = task.limits()
    near, words = AT * task.size, []
    for place in range(SIZE):
        name, unit = NAMES[place], "rad" if place >= TURN else "m"
        if low[place] == high[place]:
            continue
        if design[place] - low[place] <= near:
            words.append(f"{name} at its lower bound {low[place]:.6g} {unit}")
        if high[place] - design[place] <= near:
            words.append(f"{name} at its upper bound {high[place]:.6g} {unit}")
    if excess(design, task.sign, task.kappa) >= -near:
        least = f"transmission angle at its limit {math.degrees(task.transmission):.4g} deg"
        words.append(least if task.transmission else "the crank only just turns fully (Grashof)")
    if task.timing is None:
        words += [
            f"order: points {k + 1} and {k + 2} met at one crank angle"
            for k in np.flatnonzero(blocks[1:] == blocks[:-1])
        ]
    return tuple(words)
