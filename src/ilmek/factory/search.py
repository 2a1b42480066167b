"""The search of CP-SAT, with the same result for any number of threads.

A model that is settled while it is loaded, like one whose plans all cost the same, is given to one worker first: the
workers of OR-tools 9.15 that share one search abort the process there (`heuristics.fixed_search != nullptr`).
"""

from typing import Any

from ilmek.factory.model import SolveLimits

WORKERS = 2
"""Threads of the solver."""

FIRST_SHARE = 0.05
"""Share of the deterministic time that one worker has first."""

LEAST_SECONDS = 0.1
"""Least time of a run [s]."""


def searched(cp: Any, model: Any, limits: SolveLimits) -> tuple[Any, Any, bool]:
    """The solver behind its search, the status, and whether no clock stopped it."""
    settled = (cp.OPTIMAL, cp.INFEASIBLE)
    solver, status = _run(cp, model, 1, FIRST_SHARE * limits.deterministic, limits.seconds)
    if status in settled:
        return solver, status, True
    seconds = max(limits.seconds - solver.wall_time, LEAST_SECONDS)
    solver, status = _run(cp, model, WORKERS, limits.deterministic, seconds)
    return solver, status, status in settled or solver.wall_time < seconds


def _run(cp: Any, model: Any, workers: int, deterministic: float, seconds: float) -> tuple[Any, Any]:
    solver = cp.CpSolver()
    settings = solver.parameters
    settings.random_seed = 0
    settings.num_workers = workers
    settings.interleave_search = workers > 1
    settings.cp_model_probing_level = 0  # it takes all the time of a short run
    settings.max_deterministic_time = deterministic
    settings.max_time_in_seconds = seconds
    return solver, solver.solve(model)
