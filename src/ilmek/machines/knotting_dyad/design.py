"""The knotting dyad's design: every arm through the four timed points, and the one to build."""

from dataclasses import dataclass, replace

import numpy as np

from ilmek.arrays import ComplexArray, FloatArray
from ilmek.errors import ParameterError
from ilmek.machines.knotting_dyad.arm_path import Arm
from ilmek.machines.knotting_dyad.head import Head, head_of
from ilmek.machines.knotting_dyad.params import KnottingDyadParams
from ilmek.machines.knotting_dyad.search import best_arm
from ilmek.machines.knotting_dyad.section import section_of
from ilmek.machines.knotting_dyad.task import ArmTask, bend, task_on
from ilmek.machines.text_lists import read_angles, read_points
from ilmek.synthesis.dyad import PointArms, RootKind, TwoLinkArm, arms_through_points, dyads_through_points

LINE = 1e-9
"""Height of a triangle of points over the path's size, below which they lie on a line."""


@dataclass(frozen=True, slots=True, eq=False)
class KnottingDyad:
    """A designed knotting dyad.

    dyads   every real arm through the points, in the order of its first link, one without a first link too
    roots   all three roots of the task, and what they are
    bends   of each dyad, least |sin| of the angle between its links over the task's course; 0: its four points lie on
            both sides of the elbow; -1: a place is out of its reach
    chosen  number of the dyad to build, None where none has two links
    head    the head that is made of it; None where the points were given
    """

    params: KnottingDyadParams
    task: ArmTask
    dyads: tuple[TwoLinkArm, ...]
    roots: PointArms
    bends: FloatArray
    chosen: int | None
    head: Head | None = None

    def second_angles(self, dyad: TwoLinkArm) -> FloatArray:
        """Angles of a dyad's second link at the four points [rad]."""
        return dyad.second_angles(self.task.points, self.task.angles)

    def residuals(self, dyad: TwoLinkArm) -> FloatArray:
        """By how much a dyad misses the four points [m]."""
        closed = dyad.place(self.task.angles, self.second_angles(dyad))
        return np.asarray(np.abs(closed - self.task.points))

    def joints(self, dyad: TwoLinkArm) -> ComplexArray:
        """A dyad's elbow at the four points [m]."""
        return np.asarray(dyad.pivot + dyad.first * np.exp(1j * self.task.angles))

    def size(self, dyad: TwoLinkArm) -> float:
        """The largest length of a dyad and its task [m], to which a residual is compared."""
        extent = float(np.max(np.abs(self.task.points - self.task.points[0])))
        return max(extent, abs(dyad.first), dyad.second)


def design(params: KnottingDyadParams) -> KnottingDyad:
    """All arms through the given points; or the arm for the knot, all others through four points of its way, its head.

    Raises ParameterError where there is none, where a family of them is, and where no arm ties the knot.
    """
    if params.points is None or params.angles is None:
        return _for_knot(params)
    points = read_points("points", params.points)
    made = _arms(params, ArmTask(points, read_angles("angles", params.angles), points))
    return replace(made, chosen=_best(params, made.dyads, made.bends))


def _for_knot(params: KnottingDyadParams) -> KnottingDyad:
    section = section_of(params)
    wanted = best_arm(params, section)
    made = _arms(params, task_on(wanted))
    chosen = min(range(len(made.dyads)), key=lambda at: abs(made.dyads[at].pivot - wanted.pivot))
    arm = _built(made.dyads[chosen], wanted)
    return replace(made, chosen=chosen, head=head_of(params, section, arm))


def _built(dyad: TwoLinkArm, wanted: Arm) -> Arm:
    """The arm of the synthesis on the way that was wanted."""
    return replace(wanted, pivot=dyad.pivot, first=abs(dyad.first), second=dyad.second)


def _arms(params: KnottingDyadParams, task: ArmTask) -> KnottingDyad:
    """All arms of a task, none chosen."""
    dyads = dyads_through_points(task.points, task.angles)
    roots = arms_through_points(task.points, task.angles)
    if not dyads:
        raise _none(task, roots)
    bends = bend(roots, task.points, task.angles, task.course)
    bends = bends[np.isin(roots.found, (RootKind.ARM, RootKind.STILL))]  # the dyads, in this order
    return KnottingDyad(params, task, dyads, roots, bends, None)


def _best(params: KnottingDyadParams, dyads: tuple[TwoLinkArm, ...], bends: FloatArray) -> int | None:
    """The dyad within the longest link that stays best bent; where all are longer, the shortest."""
    built = [at for at, dyad in enumerate(dyads) if dyad.first]
    longest = [max(abs(dyad.first), dyad.second) for dyad in dyads]
    fit = [at for at in built if longest[at] <= params.link_limit]
    if fit:
        return max(fit, key=lambda at: float(bends[at]))
    return min(built, key=lambda at: longest[at], default=None)


def _none(task: ArmTask, roots: PointArms) -> ParameterError:
    said = "; ".join(dict.fromkeys(RootKind(int(one)).words for one in roots.found))
    line = "the four points lie on a line: " if _on_a_line(task.points) else ""
    return ParameterError(
        f"{line}no arm of finite links goes through the four timed points ({said})", do="move a point or an angle"
    )


def _on_a_line(points: ComplexArray) -> bool:
    """Whether all points lie on the line from the first to the farthest."""
    arrows = points - points[0]
    far = arrows[np.argmax(np.abs(arrows))]
    return bool(np.all(np.abs((arrows * np.conj(far)).imag) <= LINE * abs(far) ** 2))
