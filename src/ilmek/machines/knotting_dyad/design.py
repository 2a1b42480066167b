"""The knotting dyad's design: every arm through the four timed points, and the one to build."""

from dataclasses import replace

import numpy as np

from ilmek.arrays import Complex, ComplexArray, Float, FloatArray
from ilmek.errors import ParameterError
from ilmek.linkage.swivelled_arm import SwivelledArm
from ilmek.machines.knotting_dyad.head import Head, head_of
from ilmek.machines.knotting_dyad.params import KnottingDyadParams
from ilmek.machines.knotting_dyad.search import best_arm
from ilmek.machines.knotting_dyad.section import section_of
from ilmek.params.text_lists import read_angles, read_points
from ilmek.records import computed, record
from ilmek.report import Json
from ilmek.synthesis.dyad import PointArms, RootKind, TwoLinkArm, arms_through_points, dyads_through_points

LINE = 1e-9
"""Height of a triangle of points over the path's size, below which they lie on a line."""

SHARES = (1 - np.cos((2 * np.arange(4) + 1) * np.pi / 8)) / 2
"""The four points on the path: Chebyshev's nodes, values of its parameter s."""

SAMPLES = 181
"""Positions on the path at which the bend of the arms is evaluated."""

SOLUTION = (
    "pivot a0 at theta0 = (pivot_x, pivot_y), also as ground_length and ground_angle; first link a1, below 0 if it "
    "points away from its angle; second link a2; link1, link2 their lengths; theta2, residual at the points; bend, "
    "least sine between the links, 0: elbow on both sides, -1: out of reach"
)


@record
class ArmTask:
    """The four timed points that an arm is made for: those given, or four of the path of the best arm for the knot.

    points  positions [m]              angles  of the first link there [rad]
    path    all points that it must reach [m]: the path of its end, or the four points alone
    shares  of the path, values of s, where the points were chosen on it
    """

    points: Complex[np.ndarray, "4"]
    angles: Float[np.ndarray, "4"]
    path: ComplexArray
    shares: Float[np.ndarray, "4"] | None = None


@record
class KnottingDyad:
    """A designed knotting dyad.

    dyads  every real arm through the points, in the order of its first link, one without a first link too
    arms   all three roots of the task, and their kinds
    bends  of each dyad, least |sin| of the angle between its links over the task's path; 0: its four points lie on
           both sides of the elbow; -1: a point is out of its reach
    built  number of the dyad to build, None where none has two links
    head   the head that is made of it; None where the points were given
    """

    params: KnottingDyadParams
    task: ArmTask
    dyads: tuple[TwoLinkArm, ...]
    arms: PointArms
    bends: FloatArray
    built: int | None
    head: Head | None = None

    @computed("mm", "the four points, x and y from the pair's left warp, the pile upwards")
    def timed_points(self) -> Json:
        return [[float(point.real), float(point.imag)] for point in self.task.points]

    timed_angles = computed("deg", "angles of the first link there", lambda it: it.task.angles.tolist())
    shares = computed(
        "",
        "s of the four points on the left arm's path, where they were chosen on it",
        lambda it: None if it.task.shares is None else it.task.shares.tolist(),
        absent="the points are given",
    )

    @computed("", f"every real arm, SI and radians: {SOLUTION}")
    def solutions(self) -> Json:
        return [self._solution(dyad, float(bend)) for dyad, bend in zip(self.dyads, self.bends, strict=True)]

    roots = computed("", "kind of each of the task's three roots", lambda it: [kind.words for kind in it.kinds])

    @computed("", "number of the arm to build, from 1", absent="no arm can be built")
    def chosen(self) -> int | None:
        return None if self.built is None else self.built + 1

    @property
    def kinds(self) -> tuple[RootKind, ...]:
        """Kinds of the task's roots."""
        return tuple(RootKind(int(kind)) for kind in self.arms.found)

    def _solution(self, dyad: TwoLinkArm, bend: float) -> dict[str, Json]:
        angle = float(np.angle(dyad.pivot))
        return {
            "ground_length": dyad.ground,
            "ground_angle": angle,
            "link1": abs(dyad.first),
            "link2": dyad.second,
            "a0": dyad.ground,
            "theta0": angle,
            "a1": dyad.first,
            "a2": dyad.second,
            "pivot_x": dyad.pivot.real,
            "pivot_y": dyad.pivot.imag,
            "theta2": self.second_angles(dyad).tolist(),
            "residual": self.residual(dyad),
            "bend": bend,
        }

    def second_angles(self, dyad: TwoLinkArm) -> FloatArray:
        """Angles of a dyad's second link at the four points [rad]."""
        return dyad.second_angles(self.task.points, self.task.angles)

    def residual(self, dyad: TwoLinkArm) -> float:
        """Greatest distance by which a dyad misses the four points [m]."""
        closed = dyad.end_position(self.task.angles, self.second_angles(dyad))
        return float(np.max(np.abs(closed - self.task.points)))

    def elbows(self, dyad: TwoLinkArm) -> ComplexArray:
        """A dyad's elbow at the four points [m]."""
        return np.asarray(dyad.pivot + dyad.first * np.exp(1j * self.task.angles))

    def size(self, dyad: TwoLinkArm) -> float:
        """The largest length of a dyad and its task [m], to which a residual is compared."""
        extent = float(np.max(np.abs(self.task.points - self.task.points[0])))
        return max(extent, longest_link(dyad))


def longest_link(dyad: TwoLinkArm) -> float:
    """Length of the longer link [m]."""
    return max(abs(dyad.first), dyad.second)


def design(params: KnottingDyadParams) -> KnottingDyad:
    """All arms through the given points; or the arm for the knot, all others through four points of its path, its head.

    Raises ParameterError where there is none, where a family of them is, and where no arm ties the knot.
    """
    if params.points is None or params.angles is None:
        return _for_knot(params)
    points = read_points("points", params.points)
    made = _through(params, ArmTask(points, read_angles("angles", params.angles), points))
    return replace(made, built=_best(params, made.dyads, made.bends))


def _for_knot(params: KnottingDyadParams) -> KnottingDyad:
    section = section_of(params)
    best = best_arm(params, section)
    made = _through(params, task_on(best))
    built = min(range(len(made.dyads)), key=lambda at: abs(made.dyads[at].pivot - best.pivot))
    dyad = made.dyads[built]
    arm = replace(best, pivot=dyad.pivot, first=abs(dyad.first), second=dyad.second)
    return replace(made, built=built, head=head_of(params, section, arm))


def task_on(arm: SwivelledArm) -> ArmTask:
    """Four points of an arm's path, and the angles that its first link has there."""
    path = arm.tip(np.linspace(0.0, 1.0, SAMPLES))
    return ArmTask(arm.tip(SHARES), np.ascontiguousarray(arm.path(SHARES).theta[:, 0]), path, SHARES)


def _through(params: KnottingDyadParams, task: ArmTask) -> KnottingDyad:
    """All arms of a task, none chosen."""
    dyads = dyads_through_points(task.points, task.angles)
    arms = arms_through_points(task.points, task.angles)
    if not dyads:
        kinds = "; ".join(dict.fromkeys(RootKind(int(one)).words for one in arms.found))
        line = "the four points lie on a line: " if _on_a_line(task.points) else ""
        raise ParameterError(
            f"{line}no arm of finite links goes through the four timed points ({kinds})", do="move a point or an angle"
        )
    bends = bend(arms, task.points, task.angles, task.path)
    bends = bends[np.isin(arms.found, (RootKind.ARM, RootKind.STILL))]  # the dyads, in this order
    return KnottingDyad(params, task, dyads, arms, bends, None)


def bend(arms: PointArms, points: ComplexArray, angles: FloatArray, path: ComplexArray) -> FloatArray:
    """Least |sin| of the angle between the links over the path [m], of each arm of a batch.

    0 where the four points are not on one side of the elbow, -1 where a point of the path is out of reach, or where
    there is no arm: |cos| = |d² - a1² - a2²| / (2 |a1| a2) with the distance d from the pivot.
    """
    there = arms.found == RootKind.ARM
    pivot, first, second = (np.where(there, one, 1.0)[..., None] for one in (arms.pivot, arms.first, arms.second))
    distance = np.abs(path - pivot)
    cosine = (distance**2 - first**2 - second**2) / (2 * np.abs(first) * second)
    least = 1 - np.max(cosine**2, axis=-1)
    u = np.exp(1j * angles)[..., None, :]
    side = np.sign(((points[..., None, :] - pivot - first * u) * np.conj(u)).imag)
    one_side = np.abs(np.sum(side, axis=-1)) == side.shape[-1]
    bent = np.where(least < 0, -1.0, np.where(one_side, np.sqrt(np.maximum(least, 0)), 0.0))
    return np.asarray(np.where(there, bent, -1.0))


def _best(params: KnottingDyadParams, dyads: tuple[TwoLinkArm, ...], bends: FloatArray) -> int | None:
    """The dyad within the longest link that stays best bent; where all are longer, the shortest."""
    links = [at for at, dyad in enumerate(dyads) if dyad.first]
    fit = [at for at in links if longest_link(dyads[at]) <= params.link_limit]
    if fit:
        return max(fit, key=lambda at: float(bends[at]))
    return min(links, key=lambda at: longest_link(dyads[at]), default=None)


def _on_a_line(points: ComplexArray) -> bool:
    """Whether all points lie on the line from the first to the farthest."""
    arrows = points - points[0]
    far = arrows[np.argmax(np.abs(arrows))]
    return bool(np.all(np.abs((arrows * np.conj(far)).imag) <= LINE * abs(far) ** 2))
