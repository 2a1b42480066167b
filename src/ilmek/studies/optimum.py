"""The best design: a global search with the checks as constraints, then SLSQP with multipliers.

The search is differential evolution with constraints (Lampinen 2002) over the variables in the unit cube, whole numbers
and choices by rounding; it stops when its population agrees to `TOLERANCE`, or when the designs are spent. Over the
variables that are real numbers SLSQP goes on from its best, with differences of the checks that bind; its multipliers
state what a limit costs. A result is taken only if it is better and every check of it holds.
"""

from collections.abc import Callable

import numpy as np
from scipy.optimize import NonlinearConstraint, differential_evolution, minimize

from ilmek.arrays import Float
from ilmek.records import record
from ilmek.studies.variable import Variable

TOLERANCE = 1e-6
"""Spread of the goal over the population, relative to its mean, at which the search stops."""

MEMBERS, GENERATIONS = 8, 64
"""Members of the population for each variable, at least 16 in all; more where that leaves so many generations."""

POLISH = 30
"""Largest number of steps of SLSQP."""

PRECISION = 1e-9
"""Relative change of the goal at which SLSQP ends."""

ENDED = (0, 8)
"""States in which SLSQP ends at an optimum: to its precision; to the rounding of the goal and the margins."""

STEP = 1e-6
"""Step of the differences, relative to the range of a variable."""

HOPELESS = 1e12
"""Violation of a design that was not made."""

Judge = Callable[[Float[np.ndarray, "n variables"]], tuple[np.ndarray, np.ndarray]]
"""Values of the variables -> goal, to be minimised, and margins by check, (n, checks); NaN where there is none."""


@record
class Optimum:
    """The best design that was found.

    point        values of the variables [SI]; None: no design holds
    goal         its goal, to be minimised
    multipliers  check number -> what relaxing its limit by 1 (relative) would lower the goal by, where SLSQP ended
    ends         variable number -> change of the goal with the end of its range at which it is [goal / SI]
    stopped      why the search ended
    """

    point: Float[np.ndarray, " variables"] | None
    goal: float
    multipliers: dict[int, float]
    stopped: str
    ends: dict[int, float]


def violation(margins: Float[np.ndarray, "n checks"], made: np.ndarray) -> Float[np.ndarray, " n"]:
    """The sum of what the checks of each design miss; 0: every check holds."""
    missed = np.where(np.isnan(margins), 0.0, np.minimum(margins, 0.0)).clip(-1e6)
    return np.asarray(np.where(made, -missed.sum(axis=1), HOPELESS))


def optimum(variables: tuple[Variable, ...], judge: Judge, count: int, seed: int) -> Optimum:
    """The design of least goal of which every check holds, from at most `count` designs and those of SLSQP."""
    cube = _Cube(variables, judge)
    size = max(16, MEMBERS * len(variables), count // GENERATIONS)
    generations = max(count // size - 1, 1)
    start = cube.unit(np.array([v.nominal for v in variables]))
    found = differential_evolution(
        lambda x: cube.columns(x)[0],
        [(0.0, 1.0)] * len(variables),
        constraints=NonlinearConstraint(lambda x: cube.columns(x)[1], -np.inf, 0.0),
        popsize=size // len(variables),
        maxiter=generations,
        tol=TOLERANCE,
        x0=start,
        vectorized=True,
        updating="deferred",
        polish=False,
        rng=seed,
    )
    best = cube.best()
    stopped = "the population agrees" if found.success else f"{generations} generations are spent"
    if best is None:
        return Optimum(None, np.nan, {}, stopped, {})
    multipliers: dict[int, float] = {}
    ends: dict[int, float] = {}
    real = np.array([variable.continuous for variable in variables])
    if real.any():
        multipliers, shares = _polish(cube, best, real)
        ends = {n: share / (variables[n].high - variables[n].low) for n, share in shares.items()}
        stopped += ", then SLSQP"
        best = cube.best()
        assert best is not None
    return Optimum(cube.values(best[None])[0], cube.goal_of(best), multipliers, stopped, ends)


class _Cube:
    """The judge over the unit cube; it remembers designs, so that goal and constraints cost one evaluation."""

    def __init__(self, variables: tuple[Variable, ...], judge: Judge) -> None:
        self._variables, self._judge = variables, judge
        self._known: dict[bytes, tuple[float, np.ndarray, bool]] = {}
        self._points: dict[bytes, np.ndarray] = {}

    def values(self, unit: np.ndarray) -> np.ndarray:
        return np.asarray(np.column_stack([v.across(unit[:, n]) for n, v in enumerate(self._variables)]))

    def unit(self, values: np.ndarray) -> np.ndarray:
        shares = [variable.share(value) for value, variable in zip(values, self._variables, strict=True)]
        return np.asarray(np.clip(np.array(shares), 0.0, 1.0))

    def judged(self, unit: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Goals, margins, and whether made, of points of the cube."""
        unit = np.ascontiguousarray(unit)
        keys = [point.tobytes() for point in unit]
        new = {key: point for key, point in zip(keys, unit, strict=True) if key not in self._known}
        if new:
            goals, margins = self._judge(self.values(np.array(list(new.values()))))
            for number, (key, point) in enumerate(new.items()):
                made = bool(np.isfinite(goals[number]))
                self._known[key], self._points[key] = (float(goals[number]), margins[number], made), point
        rows = [self._known[key] for key in keys]
        widest = max(len(row[1]) for row in rows)
        margins = np.full((len(rows), widest), np.nan)
        for number, row in enumerate(rows):
            margins[number, : len(row[1])] = row[1]
        return np.array([row[0] for row in rows]), margins, np.array([row[2] for row in rows])

    def columns(self, x: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Goals and violations of points in columns, as `differential_evolution` gives them; or of one point."""
        goals, margins, made = self.judged(np.atleast_2d(x.T))
        missed = violation(margins, made)
        goals = np.where(made, goals, HOPELESS)
        return (goals, missed[None, :]) if x.ndim == 2 else (goals[0], missed)

    def best(self) -> np.ndarray | None:
        """The best point of which every check holds."""
        keys = list(self._known)
        goals, margins, made = self.judged(np.array([self._points[key] for key in keys]))
        holds = made & (violation(margins, made) == 0)
        return self._points[keys[int(np.argmin(np.where(holds, goals, np.inf)))]] if holds.any() else None

    def goal_of(self, point: np.ndarray) -> float:
        return float(self.judged(point[None])[0][0])


def _polish(cube: _Cube, start: np.ndarray, real: np.ndarray) -> tuple[dict[int, float], dict[int, float]]:
    """SLSQP over the real variables from a point of which every check holds; the multipliers of checks and ranges.

    Of the ranges: number of a variable at an end of its range -> change of the goal with that end [goal / range], what
    the gradient of the goal has beyond that of the checks.

    Every point that it tries is remembered, so that the best that holds is never worse than the start.
    """
    goal, margins, _ = cube.judged(start[None])
    kept = np.flatnonzero(np.isfinite(margins[0]))
    scale = abs(float(goal[0])) or 1.0

    def judged(x: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Goals and margins of points of the real variables, a row each."""
        whole = np.tile(start, (len(x), 1))
        whole[:, real] = x
        return cube.judged(whole)[:2]

    def differences(x: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        step = np.where(x + STEP <= 1.0, STEP, -STEP)
        goals, around = judged(np.vstack([x, x + np.diag(step)]))
        around = np.nan_to_num(around[:, kept], nan=-1.0, neginf=-1e6)
        return (goals[1:] - goals[0]) / step / scale, ((around[1:] - around[0]) / step[:, None]).T

    def limits(x: np.ndarray) -> np.ndarray:
        return np.asarray(np.nan_to_num(judged(x[None])[1][0, kept], nan=-1.0, neginf=-1e6))

    found = minimize(
        lambda x: float(np.nan_to_num(judged(x[None])[0][0], nan=HOPELESS)) / scale,
        start[real],
        jac=lambda x: np.nan_to_num(differences(x)[0]),
        method="SLSQP",
        bounds=[(0.0, 1.0)] * int(real.sum()),
        constraints={"type": "ineq", "fun": limits, "jac": lambda x: np.nan_to_num(differences(x)[1])},
        options={"maxiter": POLISH, "ftol": PRECISION},
    )
    values = getattr(found, "multipliers", None)
    if values is None or found.status not in ENDED:
        return {}, {}
    forces = np.ravel(values)[: len(kept)]
    slopes, around = differences(found.x)
    rest = np.nan_to_num(slopes - around.T @ forces)
    at_end = ((found.x <= STEP) & (rest > PRECISION)) | ((found.x >= 1 - STEP) & (rest < -PRECISION))
    ends = {int(np.flatnonzero(real)[n]): float(rest[n]) * scale for n in np.flatnonzero(at_end)}
    return {int(n): float(v) * scale for n, v in zip(kept, forces, strict=True) if v > 1e-9}, ends
