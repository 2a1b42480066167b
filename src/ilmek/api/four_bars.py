"""Synthesis of four-bars: from a path, a motion, a function, or the swing of the rocker."""

from __future__ import annotations  # so that `help` shows the aliases

import math
from collections.abc import Callable, Mapping

import numpy as np

from ilmek.arguments import LONGEST, Arguments, Points, Quantities, Quantity
from ilmek.arrays import FloatArray
from ilmek.errors import ParameterError
from ilmek.machines.catalogue import find_machine
from ilmek.params import Setting
from ilmek.progress import SILENT, Progress
from ilmek.synthesis.approximation.function_generator import FunctionApproximation, function_approximations
from ilmek.synthesis.candidate import Candidate
from ilmek.synthesis.crank_rocker.dead_centres import dead_centres
from ilmek.synthesis.crank_rocker.selection import CENTRIC, Member, member
from ilmek.synthesis.filters import REASONS
from ilmek.synthesis.four_bar import LinkLengths, from_lengths
from ilmek.synthesis.function import Function
from ilmek.synthesis.path import search
from ilmek.synthesis.path.fit import PathFit
from ilmek.synthesis.path.task import KINDS, PathTask
from ilmek.synthesis.result import FourBarSolution, LeftOut, Synthesis, transmission_over
from ilmek.units import counted

SAMPLES = 361
"""Samples of the range of a function for the least transmission angle."""

MOST_FOUR_BARS = 1000
"""Largest number of four-bars wanted of a search."""


def path_four_bars(
    points: Points,
    *,
    timing: Quantities | None = None,
    closed: bool = False,
    bounds: Mapping[str, tuple[Quantity, Quantity]] | None = None,
    kind: str = "crank-rocker",
    transmission: Quantity = 0.0,
    count: int = 5,
    seed: int = 0,
    time_limit: Quantity = math.inf,
    progress: Progress = SILENT,
) -> Synthesis[PathFit]:
    """Four-bars whose coupler point comes nearest to points [m], the best first.

    points        complex numbers, pairs (x, y), or an array of N x 2
    timing        crank angles [rad] at the points; default: free      closed  the path returns to its first point
    bounds        (low, high) of ground, crank, coupler, rocker, along, across, x, y [m], turn, start [rad]
    kind          "crank-rocker" or "double-crank"      transmission  least transmission angle [rad]
    count, seed   four-bars wanted at most; seed of the random starts
    time_limit    [s]; default: none. The search then ends with the best found so far
    progress      reports the share done, and can cancel the search

    Raises ParameterError for a task that is not one, where no start can be brought within the limits, and for points
    that were probably meant in millimetres; Cancelled.

    >>> ellipse = [(0.10 + 0.04 * math.cos(u), 0.02 * math.sin(u)) for u in (0, 1, 2, 3, 4, 5)]
    >>> found = path_four_bars(ellipse, closed=True, count=1)
    >>> found.best.error < 1e-6, found.best.mechanism.point("coupler.P") != 0
    (True, True)
    """
    given = Arguments("the path")
    task = PathTask(
        given.points("points", points, most=LONGEST),
        None if timing is None else np.atleast_1d(given.values("timing", timing, "rad")),
        closed=given.flag("closed", closed),
        bounds=given.mapping("bounds", bounds or {}, _bound),
        kind=given.one_of("kind", kind, KINDS),
        transmission=given.angle("transmission", transmission),
    )
    fits = search.path_four_bars(
        task,
        count=given.whole("count", count, least=1, most=MOST_FOUR_BARS),
        seed=given.whole("seed", seed),
        time_limit=math.inf if time_limit == math.inf else given.number("time_limit", time_limit, "s"),
        progress=given.record("progress", progress, Progress),
    )
    solutions = (FourBarSolution(fit.four_bar, fit.greatest_error, fit.least_transmission, fit) for fit in fits)
    further = fits[0].search.optima - len(fits)
    left_out = (LeftOut("an optimum of a greater error, up to twice the least", further),) if further > 0 else ()
    return Synthesis(tuple(solutions), left_out, "m")


def _bound(name: str, ends: object) -> tuple[float, float]:
    """Low and high of a number of the four-bar [m; rad]; either may be infinite."""
    given = Arguments("the path")
    low, high = given.pair(name, ends, "(low, high)")
    unit = "rad" if "turn" in name or "start" in name else "m"
    infinite = (-math.inf, math.inf)
    first, last = (end if end in infinite else given.number(name, end, unit) for end in (low, high))
    return first, last


def motion_four_bars(points: Points, angles: Quantities, **settings: Setting) -> Synthesis[Candidate]:
    """Four-bars whose coupler takes three, four or five poses exactly, the best first; `left_out` has the defects.

    points    position of one point of the coupler at each pose [m]: complex numbers, pairs (x, y), or an array of N x 2
    angles    angle of the coupler at each pose [rad]
    settings  parameters of the machine "motion-four-bar", like pivots="(0,0) (40mm,0)"; see `design`

    Raises ParameterError for another number of poses, and poses that a whole family of links takes.

    >>> found = motion_four_bars([(0, 0), (0.025, 0.015), (0.030, 0.001)], ["10deg", "3deg", "-25deg"])
    >>> found.best.error < 1e-9, max(found.left_out, key=lambda entry: entry.count).reason
    (True, 'positions on two branches')
    """
    given = Arguments("the poses")
    positions = given.points("points", points, most=LONGEST)
    turned = np.atleast_1d(given.values("angles", angles, "rad"))
    if turned.shape != positions.shape:
        raise ParameterError(
            f"{counted(positions.size, 'point')} and {counted(turned.size, 'angle')}",
            allowed="one angle for each point",
        )
    for number, angle in enumerate(turned, 1):
        given.angle(f"angle {number}", float(angle))
    poses = " ".join(
        f"({float(p.real)!r}m,{float(p.imag)!r}m,{float(a)!r}rad)" for p, a in zip(positions, turned, strict=True)
    )
    machine = find_machine("motion-four-bar")
    choice = machine.design(machine.params.read({"poses": poses, **settings})).choice
    candidates = [option.candidate for option in choice.kept]
    left_out = [LeftOut(REASONS[name], count) for name, count in choice.left_out.items() if count]
    left_out += [LeftOut(words, 1) for words in choice.other]
    left_out += [LeftOut("further four-bars; `count` lists more", choice.more)] if choice.more else []
    return Synthesis(
        tuple(FourBarSolution(one.four_bar, one.point_error, one.least_transmission, one) for one in candidates),
        tuple(left_out),
        "m",
        choice.cures,
    )


def function_four_bars(
    function: Callable[[FloatArray], FloatArray],
    start: float,
    stop: float,
    crank_swing: Quantity,
    rocker_swing: Quantity,
    *,
    criterion: str = "minimax",
    crank_start: Quantity | None = None,
    rocker_start: Quantity | None = None,
    ground: Quantity = 1.0,
) -> Synthesis[FunctionApproximation]:
    """Four-bars whose rocker generates y = f(x) from the crank angle, the best first.

    function      of an array, gives an array      start, stop  range of x
    crank_swing, rocker_swing  angles [rad] that show the ranges of x and y
    criterion     "minimax", "least-squares" or "interpolation"
    crank_start, rocker_start  angles at `start` against the ground link [rad]; default: free
    ground        A0-B0 [m]

    Raises ParameterError for an empty range, swings of more than a turn, an unknown criterion, and a function that a
    whole family of four-bars generates.

    >>> function_four_bars(lambda x: np.sqrt(1 + x), 0, 3, "80deg", "60deg", crank_start=1, rocker_start=0.8)
    <1 four-bar; left out: none>
    >>> function_four_bars(np.log10, 1, 10, "60deg", "90deg", criterion="interpolation")
    <0 four-bars; left out: a four-bar that does not close over the whole range (1)>
    """
    given = Arguments("the function")
    task = Function(
        given.function("function", function, "an array"),
        given.number("start", start),
        given.number("stop", stop),
        given.angle("crank_swing", crank_swing),
        given.angle("rocker_swing", rocker_swing),
    )
    found, left_out = function_approximations(
        task,
        given.text("criterion", criterion).replace("-", " "),
        crank_start=None if crank_start is None else given.angle("crank_start", crank_start),
        rocker_start=None if rocker_start is None else given.angle("rocker_start", rocker_start),
        ground=given.length("ground", ground),
    )
    x = np.linspace(task.start, task.stop, SAMPLES)
    turned = task.crank(x)
    solutions = []
    for generator in found:
        cranks = generator.four_bar.crank_angle + turned - task.crank(np.array(generator.drawn_at))
        transmission = transmission_over(generator.four_bar, cranks)
        solutions.append(FourBarSolution(generator.four_bar, generator.greatest, transmission, generator))
    return Synthesis(tuple(solutions), tuple(LeftOut(*entry) for entry in left_out.items()), "rad")


def crank_rocker(
    swing: Quantity, rotation: Quantity = CENTRIC, *, beta: Quantity | None = None, ground: Quantity = 1.0
) -> Synthesis[Member]:
    """The crank-rocker of a swing: `crank_rocker("30deg").best.mechanism`, drawn with its crank at 90 degrees.

    swing     of the rocker [rad]
    rotation  of the crank from the folded to the extended dead centre [rad]; default: half a turn
    beta      crank angle of the extended dead centre [rad]; default: chosen for transmission angle and crank length
    ground    [m]

    Raises ParameterError, with the allowed interval, where no such crank-rocker exists.

    >>> best = crank_rocker("30deg", ground=0.3).best
    >>> [round(length, 4) for length in best.lengths], round(math.degrees(best.transmission), 2)
    ([0.3, 0.06, 0.1998, 0.2316], 67.14)
    """
    given = Arguments("the crank-rocker")
    base = given.length("ground", ground)
    if base <= 0:
        raise ParameterError(f"ground of the crank-rocker is {base:g} m", allowed="above 0")
    wanted = given.angle("swing", swing)
    links = member(
        wanted,
        given.angle("rotation", rotation),
        None if beta is None else given.angle("beta", beta),
    )
    lengths = LinkLengths(base, base * links.crank, base * links.coupler, base * links.rocker)
    four_bar = from_lengths(lengths, 0.5 * math.pi, branch=+1)
    error = abs(float(dead_centres(links.links).swing) - wanted)
    solution = FourBarSolution(four_bar, error, transmission_over(four_bar, [0.0, math.pi]), links)
    return Synthesis((solution,), (), "rad")
