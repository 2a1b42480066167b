"""Four-bar through three poses of its coupler: both arms of the poses, joined, and checked with either one driven.

Each arm (`synthesis.dyad`) guides the coupler through the poses, its pivot on the ray of the ground angle. Two arms
form a four-bar: their second links are the coupler, their first links crank and rocker.
"""

from collections.abc import Mapping
from itertools import permutations

import numpy as np

from ilmek.arrays import Complex, Float, FloatArray
from ilmek.errors import MechanismError, ParameterError
from ilmek.plane.vectors import unit
from ilmek.records import computed, record
from ilmek.report import Json
from ilmek.synthesis.candidate import Candidate, judge
from ilmek.synthesis.dyad import PoseArms, RootKind, TwoLinkArm, arms_through_poses, dyads_through_poses
from ilmek.synthesis.filters import Filters, defects
from ilmek.synthesis.four_bar import FourBar
from ilmek.synthesis.task import PrecisionTask
from ilmek.units import deg, format_quantity, turn

DIRECTIONS = np.arange(360) * 0.5 * deg
"""Ground rays that are tried by default [rad]; a ray and its opposite are one line and have the same arms."""

LINK_RATIO = 10.0
"""Greatest ratio of the longest to the shortest link on a tried ray."""


@record
class ThreePoses:
    """Three poses: positions of a point H of the coupler [m], angles of the coupler [rad], and the text given."""

    points: Complex[np.ndarray, "3"]
    angles: Float[np.ndarray, "3"]
    text: str = ""


@record
class PoseFourBar:
    """A four-bar of two arms: their indices, the driven one first; its check, and its defects by filter."""

    crank: int
    rocker: int
    candidate: Candidate
    defects: Mapping[str, str]


@record
class ThreePoseSynthesis:
    """All arms through three poses with their pivots on one ray, and the four-bars formed of them.

    ground_angle  of the ray from the origin of the poses [rad]      tried  whether it was found by trial
    arms          both roots of the task                             dyads  the real arms among them
    choices       all four-bars                                      best   the selected one
    """

    poses: ThreePoses
    ground_angle: float
    tried: bool
    arms: PoseArms
    dyads: tuple[TwoLinkArm, ...]
    choices: tuple[PoseFourBar, ...]
    best: PoseFourBar

    solutions = computed(
        "",
        "every real arm through the poses, SI and radians: pivot a0 along theta0 = (pivot_x, pivot_y), links a1 and "
        "a2, theta1 and residual at the poses",
        lambda it: [it.arm_as_json(arm) for arm in it.dyads],
        shown=False,
    )
    roots = computed(
        "",
        "what each of the task's two roots is",
        lambda it: [RootKind(int(one)).words for one in it.arms.found],
        shown=False,
    )
    four_bars = computed(
        "",
        "the arms joined, either one driven, SI and radians: numbers of the driven and the other arm in solutions, "
        "links, ground_angle from O1 to O1', hand, branch; class, order of the poses, least transmission angle over "
        "the motion, its sine at the poses, whether kept, defects",
        lambda it: [it.four_bar_as_json(choice) for choice in it.choices],
        shown=False,
    )
    chosen = computed("", "number of the four-bar to build, from 1", lambda it: it.choices.index(it.best) + 1)
    pivots = computed(
        "mm", "positions of O1 and O1'", lambda it: [[arm.pivot.real, arm.pivot.imag] for arm in (it.crank, it.rocker)]
    )

    def arm_as_json(self, arm: TwoLinkArm) -> dict[str, Json]:
        """Dimensions of an arm, and its first link's angles at the poses [SI]."""
        return {
            "a0": arm.ground,
            "theta0": self.ground_angle,
            "a1": arm.first,
            "a2": arm.second,
            "theta1": arm.first_angles(self.poses.points, self.poses.angles).tolist(),
            "pivot_x": arm.pivot.real,
            "pivot_y": arm.pivot.imag,
            "residual": float(np.max(self.residuals(arm))),
        }

    def four_bar_as_json(self, one: PoseFourBar) -> dict[str, Json]:
        """A four-bar of two arms."""
        candidate, poses = one.candidate, self.poses
        # Angles of the other arm's first link relative to the coupler.
        angles = self.dyads[one.rocker].first_angles(poses.points, poses.angles) - poses.angles
        drawn, along = candidate.four_bar, candidate.four_bar.tracer_on_coupler
        return {
            "driven": one.crank + 1,
            "other": one.rocker + 1,
            **drawn.lengths._asdict(),
            "ground_angle": float(np.angle(drawn.b0 - drawn.a0)) % turn,
            "hand": (along or 0j).real,
            "branch": drawn.branch,
            "grashof": candidate.grashof.kind,
            "crank_angles": [met.crank_angle for met in candidate.positions],
            "order": candidate.order,
            "in_order": candidate.in_order,
            "one_circuit": candidate.one_circuit,
            "one_branch": candidate.one_branch,
            "transmission_angle_min": candidate.least_transmission,
            "transmission_sines": np.abs(np.sin(angles)).tolist(),
            "link_ratio": candidate.link_ratio,
            "size": candidate.size,
            "kept": not one.defects,
            "defects": list(one.defects.values()),
        }

    @property
    def crank(self) -> TwoLinkArm:
        """The arm whose first link is driven."""
        return self.dyads[self.best.crank]

    @property
    def rocker(self) -> TwoLinkArm:
        """The other arm."""
        return self.dyads[self.best.rocker]

    @property
    def hand(self) -> float:
        """The point H on the coupler, from O2 towards O2' [m]."""
        drawn = self.best.candidate.four_bar
        return (drawn.tracer_on_coupler or 0j).real

    @property
    def crank_angles(self) -> Float[np.ndarray, "3"]:
        """Angles of the driven link at the poses, rotating in one direction [rad]; the last in [0, 2 pi)."""
        return turned_through(self.best.candidate)

    def residuals(self, dyad: TwoLinkArm) -> FloatArray:
        """Distances of an arm's end from the poses [m]."""
        points, angles = self.poses.points, self.poses.angles
        return np.asarray(np.abs(dyad.end_position(dyad.first_angles(points, angles), angles) - points))


def synthesised(poses: ThreePoses, ground_angle: float | None) -> ThreePoseSynthesis:
    """The four-bar through three poses with the better one of two cranks.

    ground_angle  [rad]; None: the best of rays half a degree apart

    Raises ParameterError where there are fewer than two real arms, or no four-bar through the poses without defects.
    The message names the ground angles that have one.
    """
    tried = ground_angle is None
    if ground_angle is None:
        ground_angle = best_ray(poses)
        if ground_angle is None:
            raise ParameterError(
                f"no ground ray out of {DIRECTIONS.size}, half a degree apart, has a four-bar through the three poses "
                "that passes them in order on one branch",
                do="move or turn a pose",
            )
    dyads = dyads_through_poses(poses.points, poses.angles, ground_angle)
    roots = arms_through_poses(poses.points, poses.angles, ground_angle)
    if len(dyads) < 2:
        raise _too_few(poses, ground_angle, roots)
    choices = tuple(_choices(poses, dyads))
    kept = [choice for choice in choices if not choice.defects]
    if not kept:
        raise _only_defective(poses, ground_angle, choices)
    best = max(kept, key=lambda one: one.candidate.least_transmission)
    return ThreePoseSynthesis(poses, ground_angle, tried, roots, dyads, choices, best)


def best_ray(poses: ThreePoses) -> float | None:
    """The ray with the best transmission angle among rays half a degree apart [rad]; None where none has a four-bar.

    The angles at the poses are upper bounds of that over the whole motion: four-bars are checked from the highest bound
    downwards.
    """
    bounds = _bounds(poses)
    best, most = None, 0.0
    for at in np.argsort(-np.max(bounds, axis=-1)):
        if np.max(bounds[at]) <= most:
            break
        dyads = dyads_through_poses(poses.points, poses.angles, float(DIRECTIONS[at]))
        for choice in _choices(poses, dyads, Filters(link_ratio_max=LINK_RATIO)):
            if not choice.defects and choice.candidate.least_transmission > most:
                best, most = float(DIRECTIONS[at]), choice.candidate.least_transmission
    return best


def _bounds(poses: ThreePoses) -> Float[np.ndarray, "rays 2"]:
    """Upper bound of the transmission angle [rad] for each ray and driven arm; -1 where there is no four-bar.

    Left out are four-bars with the poses on two branches, and those whose crank does not rotate fully and meets the
    poses out of order.
    """
    shape = (DIRECTIONS.size, 3)
    points, angles = (np.broadcast_to(one, shape) for one in (poses.points, poses.angles))
    arms = arms_through_poses(points, angles, DIRECTIONS)
    real = np.all(arms.found == RootKind.ARM, axis=-1)[:, None]
    pivot, first, second = (np.where(real, one, 1.0) for one in (arms.pivot, arms.first, arms.second))
    turned = np.asarray(unit(angles))[:, None]
    links = points[:, None] - pivot[..., None] - second[..., None] * turned
    # Sines of the angle between the coupler and the first link of the other arm.
    sines = (np.imag(links * np.conj(turned)) / first[..., None])[:, ::-1]
    across = np.diff(pivot, axis=-1) * np.array([1, -1])
    cranks = np.angle(links * np.conj(across)[..., None])
    ground, coupler, rocker = np.abs(across), np.abs(np.diff(second)), first[:, ::-1]
    folded, stretched = (
        (np.abs(coupler - rocker) <= span) & (span <= coupler + rocker)
        for span in (np.abs(ground - first), ground + first)
    )
    # A crank that passes the stretched pose is half a turn from the ground line there: no branch cut at that angle.
    steps = np.diff(np.where(stretched[..., None], np.mod(cranks, turn), cranks))
    in_order = np.all(steps > 0, axis=-1) | np.all(steps < 0, axis=-1) | (folded & stretched)
    one_branch = np.abs(np.sum(np.sign(sines), axis=-1)) == 3
    likely = real & one_branch & in_order
    return np.where(likely, np.arcsin(np.minimum(np.min(np.abs(sines), axis=-1), 1.0)), -1.0)


def turned_through(candidate: Candidate) -> Float[np.ndarray, "3"]:
    """Crank angles at the positions of a candidate that meets them in order, rotating in one direction [rad]."""
    angles = np.array([met.crank_angle for met in candidate.positions])
    if candidate.crank_turns:
        onward, back = (np.mod(sign * (angles - angles[0]), turn) for sign in (+1, -1))
        angles = angles[0] + (onward if np.all(np.diff(onward) > 0) else -back)
    return np.asarray(angles - turn * np.floor(angles[-1] / turn))


def _choices(poses: ThreePoses, dyads: tuple[TwoLinkArm, ...], filters: Filters | None = None) -> list[PoseFourBar]:
    """Every pair of arms as a four-bar, with either of them driven."""
    task = PrecisionTask(points=poses.points, coupler=poses.angles)
    choices = []
    for crank, rocker in permutations(range(len(dyads)), 2):
        drawn = _joined(poses, dyads[crank], dyads[rocker])
        if drawn:
            candidate = judge(drawn, task)
            choices.append(PoseFourBar(crank, rocker, candidate, defects(candidate, filters)))
    return choices


def _joined(poses: ThreePoses, crank: TwoLinkArm, rocker: TwoLinkArm) -> FourBar | None:
    """Two arms as a four-bar drawn at the first pose; None where two of its pins coincide."""
    A, B = (poses.points[0] - arm.second * unit(poses.angles[0]) for arm in (crank, rocker))
    try:
        return FourBar(crank.pivot, rocker.pivot, complex(A), complex(B), complex(poses.points[0]))
    except MechanismError:
        return None


def _too_few(poses: ThreePoses, ground_angle: float, roots: PoseArms) -> ParameterError:
    count = int(np.sum(roots.found == RootKind.ARM))
    kinds = dict.fromkeys(RootKind(int(one)).words for one in roots.found if one != RootKind.ARM)
    arms = ("no real arm takes", "only one real arm takes")[count]
    return ParameterError(
        f"{arms} the three poses with its pivot on the ray at {format_quantity(ground_angle, 'deg')} "
        f"(of two roots, {'the other' if count else 'both'}: {'; '.join(kinds)})",
        allowed="a four-bar takes two",
        do=_rays_with_two(poses),
    )


def _rays_with_two(poses: ThreePoses) -> str:
    """Which ground angles have two real arms."""
    shape = (DIRECTIONS.size, 3)
    points, angles = (np.broadcast_to(one, shape) for one in (poses.points, poses.angles))
    real = np.all(arms_through_poses(points, angles, DIRECTIONS).found == RootKind.ARM, axis=-1)
    if not real.any():
        return "no ground angle has two: move or turn a pose"
    edges = np.flatnonzero(np.diff(np.concatenate([[False], real, [False]]).astype(int)))
    spans = [
        f"{np.degrees(DIRECTIONS[start]):g}deg..{np.degrees(DIRECTIONS[stop - 1]):g}deg"
        for start, stop in edges.reshape(-1, 2)
    ]
    return f"ground_angle {' or '.join(spans)}, or their opposites, has two; the default is the best"


def _only_defective(poses: ThreePoses, ground_angle: float, choices: tuple[PoseFourBar, ...]) -> ParameterError:
    reasons = "; ".join(
        f"driven at arm {choice.crank + 1}: {' and '.join(choice.defects.values())}" for choice in choices
    )
    best = best_ray(poses)
    other = "move or turn a pose" if best is None else f"ground_angle={np.degrees(best):g}deg has one"
    return ParameterError(
        f"with the ground ray at {format_quantity(ground_angle, 'deg')} no four-bar goes through the three poses "
        f"({reasons or 'both arms are one'})",
        allowed="all poses on one branch, in order",
        do=other,
    )
