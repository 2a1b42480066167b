"""Complete synthesis: every four-bar for nine points, or for poses and points that determine it.

The solutions of a general complex task (`start_sets`) are followed to the required one (`homotopy`): with probability
one all its isolated solutions are found. The real ones are proven by interval arithmetic (`certificate`).
"""

from collections.abc import Mapping

import numpy as np

from ilmek.arrays import ComplexArray, FloatArray
from ilmek.errors import MechanismError
from ilmek.progress import SILENT, Progress
from ilmek.records import record
from ilmek.synthesis.alt_burmester.certificate import Certificate, certify, unit_length
from ilmek.synthesis.alt_burmester.homotopy import complete
from ilmek.synthesis.alt_burmester.real_solutions import DEGENERATE, real_solutions
from ilmek.synthesis.alt_burmester.start_sets import start_set
from ilmek.synthesis.alt_burmester.task import PosesAndPoints
from ilmek.synthesis.four_bar import FourBar

TRACKED = 0.9
"""Share of the progress that the paths take."""


@record
class CompleteFourBar:
    """A four-bar that meets a task exactly.

    four_bar   as drawn at the first position; of A and B the crank is the one that rotates fully, if one does
    angles     of the coupler at the positions, relative to the first one [rad], in (-pi, pi]
    family     number of its coupler curve, from 1: the cognates of one curve have one number
    certified  whether its existence is proven      distance  within which its exact pins lie [m]; NaN if not proven
    """

    four_bar: FourBar
    angles: FloatArray
    family: int
    certified: bool
    distance: float


@record
class CompleteFourBars:
    """All four-bars of a task.

    found     the real ones, cognates one after the other      paths  that were followed
    left_out  ends of paths that are no four-bar: their number by reason
    complete  whether every path ended at a solution that stands alone
    """

    found: tuple[CompleteFourBar, ...]
    paths: int
    left_out: Mapping[str, int]
    complete: bool


def complete_four_bars(task: PosesAndPoints, progress: Progress = SILENT) -> CompleteFourBars:
    """Every real four-bar whose coupler meets poses and points exactly. Raises Cancelled.

    Order, circuit and branch are not considered: see `candidate.judge`. Each four-bar is listed once, not again with
    crank and rocker exchanged. A task with symmetries may have whole families of four-bars, or several in one: their
    paths do not end at a solution that stands alone, and `complete` is False.
    """
    begin = start_set(task.poses).aligned(task.scaled)
    found = complete(begin, task.scaled, progress.part(0.0, TRACKED))
    solutions = real_solutions(task, found)
    proof = certify(task, solutions.pins, solutions.turns)
    progress(1.0)
    drawn = [
        _drawn(task, int(solutions.family[k]) + 1, proof, int(k)) for k in np.argsort(solutions.family, kind="stable")
    ]
    left_out = dict(solutions.left_out)
    if None in drawn:
        left_out[DEGENERATE] = left_out.get(DEGENERATE, 0) + drawn.count(None)
    good = not left_out.keys() - {"complex", DEGENERATE}
    return CompleteFourBars(tuple(one for one in drawn if one), len(found.ends), left_out, good)


def _drawn(task: PosesAndPoints, family: int, proof: Certificate, k: int) -> CompleteFourBar | None:
    """A solution as a four-bar in metres at the first position; None where a link has no length."""
    turns: ComplexArray = np.ones(len(task.points), dtype=complex)
    turns[task.others] = proof.turns[k]
    A, x, B, y = proof.pins[k] * unit_length(task)
    origin, first = task.points[task.reference], task.points[0]
    try:
        bar = FourBar(origin + A, origin + B, first + turns[0] * x, first + turns[0] * y, complex(first))
    except MechanismError:
        return None
    if bar.reversed().grashof.crank_turns and not bar.grashof.crank_turns:
        bar = bar.reversed()
    return CompleteFourBar(
        bar, np.asarray(np.angle(turns / turns[0])), family, bool(proof.certified[k]), _distance(task, proof, k)
    )


def _distance(task: PosesAndPoints, proof: Certificate, k: int) -> float:
    """Distance of the exact pins at the first position from the drawn ones [m], rounding included."""
    size = float(np.abs(proof.pins[k]).max())
    found = proof.pin_error[k] + (0.0 if task.reference == 0 else size * proof.turn_error[k])
    rounding = 8 * float(np.finfo(float).eps) * (size * unit_length(task) + float(np.abs(task.points).max()))
    return float(found) * unit_length(task) + rounding
