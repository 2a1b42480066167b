"""Synthesis of four-bars: from a path, a motion, a function, or the swing of the rocker."""

import math
from collections.abc import Callable, Mapping, Sequence

import numpy as np

from ilmek.api.slips import check_angle, check_lengths
from ilmek.arrays import FloatArray, NumberArray
from ilmek.errors import ParameterError
from ilmek.machines.catalogue import find_machine
from ilmek.progress import SILENT, Progress
from ilmek.synthesis.approximation.function_generator import FunctionApproximation, function_approximations
from ilmek.synthesis.candidate import Candidate
from ilmek.synthesis.crank_rocker.selection import CENTRIC, member
from ilmek.synthesis.four_bar import LinkLengths
from ilmek.synthesis.function import Function
from ilmek.synthesis.path import search
from ilmek.synthesis.path.fit import PathFit
from ilmek.synthesis.path.task import PathTask


def path_four_bars(
    points: NumberArray | Sequence[complex],
    *,
    timing: NumberArray | Sequence[float] | None = None,
    closed: bool = False,
    bounds: Mapping[str, tuple[float, float]] | None = None,
    kind: str = "crank-rocker",
    transmission: float = 0.0,
    count: int = 5,
    seed: int = 0,
    time_limit: float = math.inf,
    progress: Progress = SILENT,
) -> tuple[PathFit, ...]:
    """Four-bars whose coupler point comes nearest to points [m, complex], the best first.

    timing        crank angles [rad] at the points; default: free      closed  the path returns to its first point
    bounds        (low, high) of ground, crank, coupler, rocker, along, across, x, y [m], turn, start [rad]
    kind          "crank-rocker" or "double-crank"      transmission  least transmission angle [rad]
    count, seed   four-bars wanted at most; seed of the random starts
    time_limit    [s]; default: none. The search then ends with the best found so far
    progress      reports the share done, and can cancel the search

    Raises ParameterError for a task that is not one, where no start can be brought within the limits; Cancelled.
    """
    task = PathTask(
        np.asarray(points, dtype=complex),
        None if timing is None else np.asarray(timing, dtype=float),
        closed=closed,
        bounds=bounds or {},
        kind=kind,
        transmission=transmission,
    )
    return search.path_four_bars(task, count=count, seed=seed, time_limit=time_limit, progress=progress)


def motion_four_bars(
    points: NumberArray | Sequence[complex], angles: Sequence[float] | FloatArray, **settings: str | float | int
) -> tuple[Candidate, ...]:
    """Four-bars whose coupler takes three, four or five poses exactly, the best first; those with defects left out.

    points    position of one point of the coupler at each pose [m], complex
    angles    angle of the coupler at each pose [rad]
    settings  parameters of the machine "motion-four-bar", like pivots="(0,0) (40mm,0)"; see `design`

    Raises ParameterError for another number of poses, and poses that a whole family of links takes.
    """
    places, turned = np.asarray(points, dtype=complex), np.asarray(angles, dtype=float)
    if places.shape != turned.shape or places.ndim != 1:
        raise ParameterError(f"{places.size} points and {turned.size} angles", allowed="one angle for each point")
    check_lengths(ParameterError, "a pose", x=float(np.abs(places.real).max()), y=float(np.abs(places.imag).max()))
    for angle in turned:
        check_angle(ParameterError, "the angle of a pose", float(angle))
    poses = " ".join(
        f"({float(p.real)!r}m,{float(p.imag)!r}m,{float(a)!r}rad)" for p, a in zip(places, turned, strict=True)
    )
    machine = find_machine("motion-four-bar")
    found = machine.design(machine.params.read({"poses": poses, **settings}))
    return tuple(option.candidate for option in found.choice.kept)


def function_four_bars(
    function: Callable[[FloatArray], FloatArray],
    start: float,
    stop: float,
    crank_swing: float,
    rocker_swing: float,
    *,
    criterion: str = "minimax",
    crank_start: float | None = None,
    rocker_start: float | None = None,
    ground: float = 1.0,
) -> tuple[FunctionApproximation, ...]:
    """Four-bars whose rocker generates y = f(x) from the crank angle, the best first.

    function      of an array, gives an array      start, stop  range of x
    crank_swing, rocker_swing  angles [rad] that show the ranges of x and y
    criterion     "minimax", "least squares" or "interpolation"
    crank_start, rocker_start  angles at `start` against the ground link [rad]; default: free
    ground        A0-B0 [m]

    Raises ParameterError for an empty range, swings of more than a turn, an unknown criterion, and a function that a
    whole family of four-bars generates.
    """
    wanted = Function(function, start, stop, crank_swing, rocker_swing)
    check_lengths(ParameterError, "the four-bar", ground=ground)
    return function_approximations(
        wanted, criterion, crank_start=crank_start, rocker_start=rocker_start, ground=ground
    ).found


def crank_rocker(
    swing: float, rotation: float = CENTRIC, *, beta: float | None = None, ground: float = 1.0
) -> LinkLengths:
    """Ground, crank, coupler and rocker [m] of a crank-rocker; `four_bar(*crank_rocker(30 * deg))` builds it.

    swing     of the rocker [rad]
    rotation  of the crank from the folded to the extended dead centre [rad]; default: half a turn
    beta      crank angle of the extended dead centre [rad]; default: chosen for transmission angle and crank length
    ground    [m]

    Raises ParameterError, with the allowed interval, where no such crank-rocker exists.
    """
    check_angle(ParameterError, "the swing of the rocker", swing)
    check_angle(ParameterError, "the rotation of the crank", rotation)
    check_lengths(ParameterError, "the crank-rocker", ground=ground)
    found = member(swing, rotation, beta)
    return LinkLengths(ground, ground * found.crank, ground * found.coupler, ground * found.rocker)
