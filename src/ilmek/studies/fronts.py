"""Several goals: the front of designs of which none is better in every goal, and its knee.

NSGA-II for two goals, for more NSGA-III, whose members spread over reference directions (Das and Dennis), of pymoo.
"""

from importlib import import_module
from math import comb
from typing import Any

import numpy as np

from ilmek.arrays import Float
from ilmek.errors import ParameterError
from ilmek.studies.optimum import HOPELESS, Judge, violation
from ilmek.studies.variable import Variable

MEMBERS = 64
"""Members of the population; fewer where the designs are few."""

LARGE = 1e30
"""Goal of a design that was not made."""


def evolve(variables: tuple[Variable, ...], goals: int, judge: Judge, count: int, seed: int) -> None:
    """Ask the judge for generations until `count` designs are spent; the judge records them.

    Constraints are the checks: a design that holds dominates one that does not (Deb 2000). Raises ParameterError
    without the extra.
    """
    size = max(8, min(MEMBERS, count // 4))
    try:
        problems, terminations = import_module("pymoo.core.problem"), import_module("pymoo.core.termination")
        algorithm = _algorithm(goals, size)
    except ImportError:
        raise ParameterError(
            "a front of several goals needs the extra study", do="pip install 'ilmek[study]'"
        ) from None
    problem = problems.Problem(n_var=len(variables), n_obj=goals, n_ieq_constr=1, xl=0.0, xu=1.0)
    algorithm.setup(problem, termination=terminations.NoTermination(), seed=seed, verbose=False)
    for _ in range(max(count // algorithm.pop_size, 1)):
        members = algorithm.ask()
        unit = members.get("X")
        points = np.column_stack([v.across(unit[:, n]) for n, v in enumerate(variables)])
        values, margins = judge(points)
        made = np.asarray(np.isfinite(values).all(axis=1))
        members.set("F", np.where(made[:, None], values, LARGE))
        members.set("G", np.minimum(violation(margins, made), HOPELESS)[:, None])
        members.set("H", np.zeros((len(unit), 0)))
        for member in members:
            member.evaluated.update({"F", "G", "H"})
        algorithm.tell(infills=members)


def _algorithm(goals: int, size: int) -> Any:
    """The algorithm for a number of goals and members."""
    if goals == 2:
        return import_module("pymoo.algorithms.moo.nsga2").NSGA2(pop_size=size)
    steps = 1
    while comb(goals + steps, goals - 1) <= size:
        steps += 1
    directions = import_module("pymoo.util.ref_dirs").get_reference_directions("das-dennis", goals, n_partitions=steps)
    return import_module("pymoo.algorithms.moo.nsga3").NSGA3(directions, pop_size=max(size, len(directions)))


def knee(costs: Float[np.ndarray, "members goals"]) -> int:
    """The knee of a front: the member of the least sum of goals, each scaled to its range over the front.

    >>> knee(np.array([[0.0, 1.0], [0.2, 0.2], [1.0, 0.0]]))
    1
    """
    length = np.ptp(costs, axis=0)
    scaled = (costs - costs.min(axis=0)) / np.where(length > 0, length, 1.0)
    return int(np.argmin(scaled.sum(axis=1)))
