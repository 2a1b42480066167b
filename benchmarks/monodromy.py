"""All solutions of a general task from one: monodromy.

A task with a solution is made backwards: u and T are chosen at random, and each position's d and d' follow from its two
equations, a quadratic. Along a closed path through random tasks the solutions return permuted, and unknown ones appear.
All solutions are reached, since the set of all pairs of tasks and solutions is irreducible: u and T are free, and each
position adds an independent quadratic. The search ends when closed paths bring nothing new several times in succession.
[Sommese, Verschelde and Wampler 2001; Duff, Hill, Jensen, Lee, Leykin and Sommars, Solving polynomial systems via
 homotopy continuation and monodromy, 2019]
"""

import numpy as np

from ilmek.arrays import Bool
from ilmek.progress import SILENT, Progress
from ilmek.synthesis.alt_burmester.equations import UNKNOWNS
from ilmek.synthesis.alt_burmester.homotopy import SolvedTask, random_task, repeated, track

IDLE = 5
"""Closed paths in succession without a new solution, after which the search ends."""

MOST_LOOPS = 100


def task_with_solution(rng: np.random.Generator, pose: Bool[np.ndarray, " positions"]) -> SolvedTask:
    """A random task with one random solution."""
    numbers = rng.normal(size=(2, UNKNOWNS)) / np.sqrt(2)
    u = numbers[0] + 1j * numbers[1]
    T = random_task(rng, pose)[2]
    A, A1, x, x1, B, B1, y, y1 = u
    p, p1, pp = T * x - A, x1 / T - A1, (x - A) * (x1 - A1)
    s, s1, ss = T * y - B - p, y1 / T - B1 - p1, (y - B) * (y1 - B1)
    # q = d + p, q' = d' + p': q q' = pp and (q + s)(q' + s') = ss give s' q² + (pp + s s' - ss) q + s pp = 0
    middle = pp + s * s1 - ss
    root = np.sqrt(middle**2 - 4 * s * s1 * pp) * rng.choice([-1, 1], size=len(T))
    q = (root - middle) / (2 * s1)
    return SolvedTask(pose, np.array([q - p, pp / q - p1, T]), u[None], T[None])


def all_solutions(begin: SolvedTask, seed: int = 0, progress: Progress = SILENT) -> SolvedTask:
    """All solutions of a task, one of each class, from at least one of them. Raises Cancelled."""
    rng, known, idle = np.random.default_rng(seed), begin, 0
    for loop in range(MOST_LOOPS):
        found = _around(known, rng, progress)
        idle = idle + 1 if len(found.unknowns) == len(known.unknowns) else 0
        known = found
        progress(loop / MOST_LOOPS)
        if idle == IDLE:
            break
    return known


def _around(known: SolvedTask, rng: np.random.Generator, progress: Progress) -> SolvedTask:
    """The known solutions and those that a random closed path adds, followed until it adds no more."""
    corners = [random_task(rng, known.pose), random_task(rng, known.pose), known.task]
    queue = known
    while len(queue.unknowns):
        good = np.ones(len(queue.unknowns), dtype=bool)
        moved = queue
        for corner in corners:
            found = track(moved, corner, progress.part(0.0, 0.0))
            good &= found.good
            moved = found.solved
        queue = _new(known, moved.only(np.flatnonzero(good)))
        known = SolvedTask(
            known.pose,
            known.task,
            np.concatenate([known.unknowns, queue.unknowns]),
            np.concatenate([known.rotations, queue.rotations]),
        )
    return known


def _new(known: SolvedTask, found: SolvedTask) -> SolvedTask:
    """Solutions that are not known, each once."""
    keys = np.concatenate([known.keys(), found.keys()])
    new = ~repeated(keys)[len(known.unknowns) :]
    return found.only(np.flatnonzero(new))
