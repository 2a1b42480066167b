"""The head's cycle in time: every phase as quick as the drives allow, and a pause for each grip.

An arm follows its path in the least time within the limits of its joints, and back in the same motion backwards. Where
both arms move, one parameter leads both, so that the sum of both s is always one. The centre gripper moves straight, in
seven phases of constant jerk. Before a phase the grippers that take an end close, then those that release one open.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, fields
from functools import lru_cache
from typing import TypeAlias

import numpy as np

from ilmek.arrays import Float, FloatArray
from ilmek.linkage.swivelled_arm import ArmPath
from ilmek.machines.knotting_dyad.head import Head
from ilmek.machines.knotting_dyad.params import KnottingDyadParams
from ilmek.machines.knotting_dyad.sequence import LEFT, OUT, RIGHT, Phase
from ilmek.records import record
from ilmek.timing.path_speed.solve import AxesLimits, JointPath, PathMotion, Trajectory, quickest_motion
from ilmek.timing.s_curve import AxisLimits, SCurve, s_curve

GRASP, RELEASE = "grasp", "release"
"""Names of grips."""

SAMPLES, PAUSED, INTERVALS = 161, 21, 200
"""Times of a phase and of a grip that are tabulated, and intervals of a phase's spline."""


@dataclass(frozen=True, slots=True)
class CyclePart:
    """A part of the cycle [s]: a phase's motion, or a grip, `grasp` or `release`, by the grippers named."""

    name: str
    start: float
    end: float
    grippers: tuple[str, ...] = ()


@record
class ArmMotion:
    """An arm over the samples: s, and of both links the absolute angles [rad] and their rates by time.

    leads  whether it moves with an end of the yarn in its gripper
    """

    s: Float[np.ndarray, " samples"]
    angle: Float[np.ndarray, "samples 2"]
    speed: Float[np.ndarray, "samples 2"]
    acceleration: Float[np.ndarray, "samples 2"]
    jerk: Float[np.ndarray, "samples 2"]
    leads: np.ndarray

    def mirrored(self) -> "ArmMotion":
        """The mirror image about an upright line."""
        return ArmMotion(self.s, np.pi - self.angle, -self.speed, -self.acceleration, -self.jerk, self.leads)


@record
class KnotCycle:
    """A whole cycle.

    parts   in order, from 0 to the period         time    of the samples [s]; where parts meet it comes twice
    arms    left and right                         centre  height of the centre gripper's tip [m], and three rates
    used    greatest speed, acceleration and jerk of a joint over their limits, sample by sample
    usage   the greatest use of a limit, the centre gripper's among them: at most 1
    """

    parts: tuple[CyclePart, ...]
    time: Float[np.ndarray, " samples"]
    arms: Mapping[str, ArmMotion]
    centre: Float[np.ndarray, "4 samples"]
    used: Float[np.ndarray, "3 samples"]
    usage: float

    @property
    def period(self) -> float:
        """Time of a knot [s]."""
        return self.parts[-1].end


@record
class _Motions:
    """The motions that a cycle is made of: one arm in, one out while the other comes in, the centre gripper down."""

    path: ArmPath
    single: PathMotion
    both: PathMotion
    centre: SCurve
    absolute: FloatArray  # of the drives' angles, the links' absolute ones


_Piece: TypeAlias = tuple[FloatArray, ArmMotion, ArmMotion, FloatArray]
"""Times, both arms as left ones, centre gripper."""


def cycle_of(params: KnottingDyadParams, head: Head) -> KnotCycle:
    """The cycle of a head."""
    motions = _motions(params, head)
    before = (*head.sequence[-1:], *head.sequence[:-1])
    parts: list[CyclePart] = []
    pieces: list[_Piece] = []
    for last, phase in zip(before, head.sequence, strict=True):
        for grip in _grips(params, last, phase, parts[-1].end if parts else 0.0):
            parts.append(grip)
            pieces.append(_still(motions, phase, np.linspace(grip.start, grip.end, PAUSED)))
        duration, piece = _moved(motions, phase, parts[-1].end if parts else 0.0)
        parts.append(CyclePart(phase.name, float(piece[0][0]), float(piece[0][0]) + duration))
        pieces.append(piece)
    time, left, right, centre = zip(*pieces, strict=True)
    arms = {LEFT: _joined(left), RIGHT: _joined(right).mirrored()}
    most = max(float(motions.single.usage.max()), float(motions.both.usage.max()), _centre_use(params, motions.centre))
    return KnotCycle(tuple(parts), np.concatenate(time), arms, np.concatenate(centre, axis=1), _use(params, arms), most)


def drive_angles(params: KnottingDyadParams) -> Float[np.ndarray, "2 2"]:
    """Angles of the drives over the links' absolute ones: with a belt the same, else the second link's to the first."""
    return np.array([[1.0, 0.0], [0.0 if params.elbow_drive == "belt" else -1.0, 1.0]])


def _motions(params: KnottingDyadParams, head: Head) -> _Motions:
    path, turned = head.path, drive_angles(params).T
    of_one = path.theta @ turned, path.first @ turned, path.second @ turned
    backwards = [sign * one[::-1] for sign, one in zip((1, -1, 1), of_one, strict=True)]
    together = [np.concatenate(pair, axis=1) for pair in zip(backwards, of_one, strict=True)]
    return _Motions(
        path,
        _quickest(params, path.s, *of_one),
        _quickest(params, path.s, *together),
        s_curve(head.centre_stroke, AxisLimits(params.centre_speed, params.centre_acceleration, params.centre_jerk)),
        np.linalg.inv(turned),
    )


def _quickest(params: KnottingDyadParams, s: FloatArray, *nodes: FloatArray) -> PathMotion:
    """The quickest motion along a path with two derivatives at its nodes, within the limits of the joints."""
    limits = params.joint_speed, params.joint_acceleration, params.joint_jerk
    return _kept_motion(limits, *(np.ascontiguousarray(one).tobytes() for one in (s, *nodes)))


@lru_cache(maxsize=8)
def _kept_motion(limits: tuple[float, float, float], *nodes: bytes) -> PathMotion:
    """The same, computed once for a path and its limits: arms that differ elsewhere share it."""
    s, *every = (np.frombuffer(node) for node in nodes)
    path = JointPath(s, *(one.reshape(len(s), -1) for one in every))
    axes = path.positions.shape[1]
    return quickest_motion(path, AxesLimits(*(np.full(axes, limit) for limit in limits)), INTERVALS)


def _grips(params: KnottingDyadParams, last: Phase, phase: Phase, now: float) -> Iterator[CyclePart]:
    """The grips before a phase: those that take an end close, then those that had it open."""
    changes = [(old, new) for old, new in zip(last.carries, phase.carries, strict=True) if old != new]
    leavers = tuple(dict.fromkeys(old for old, _ in changes if old))
    takers = tuple(dict.fromkeys(new for _, new in changes if new))
    for name, grippers, takes in ((GRASP, takers, params.grasp_time), (RELEASE, leavers, params.release_time)):
        if grippers and takes:
            yield CyclePart(name, now, now + takes, grippers)
            now += takes


def _moved(motions: _Motions, phase: Phase, now: float) -> tuple[float, _Piece]:
    """A phase's motion from a time on, both arms as left ones."""
    moves = [name for name, span in ((LEFT, phase.left), (RIGHT, phase.right)) if span[0] != span[1]]
    if not moves:
        duration = motions.centre.time if phase.centre[0] != phase.centre[1] else 0.0
        time, left, right, centre = _still(motions, phase, now + np.linspace(0.0, duration, SAMPLES))
        return duration, (time, left, right, _centre(motions, phase, time - now))
    motion = motions.both if len(moves) == 2 else motions.single
    along = motion.even(SAMPLES)
    time, *arms, centre = _still(motions, phase, now + along.time)
    moved = []
    for name, span, still in ((LEFT, phase.left, arms[0]), (RIGHT, phase.right, arms[1])):
        comes = span[0] == OUT
        leads = np.full(SAMPLES, name in phase.carries)
        arm = _arm(along, motions, 2 * (comes and len(moves) == 2), leads)
        # Alone an arm goes out as it comes in, backwards; of two, the first axes go out and the last come in.
        backwards = not comes and len(moves) == 1
        moved.append(still if name not in moves else _reversed(arm) if backwards else arm)
    return motion.duration, (time, moved[0], moved[1], centre)


def _arm(along: Trajectory, motions: _Motions, axis: int, leads: np.ndarray) -> ArmMotion:
    """The arm of the two axes from `axis` on, as a left one."""
    of = slice(axis, axis + 2)
    s = along.s if axis or along.position.shape[1] == 2 else 1 - along.s
    rates = along.position, along.speed, along.acceleration, along.jerk
    angle, speed, acceleration, jerk = (rate[:, of] @ motions.absolute for rate in rates)
    return ArmMotion(s, angle, speed, acceleration, jerk, leads)


def _reversed(motion: ArmMotion) -> ArmMotion:
    """The same motion backwards in time."""
    speed, jerk = -motion.speed[::-1], -motion.jerk[::-1]
    return ArmMotion(motion.s[::-1], motion.angle[::-1], speed, motion.acceleration[::-1], jerk, motion.leads)


def _still(motions: _Motions, phase: Phase, time: FloatArray) -> _Piece:
    """Nothing moves: all stand as the phase begins."""
    left, right = (_standing(motions.path, span[0], len(time)) for span in (phase.left, phase.right))
    centre = np.zeros((4, len(time)))
    centre[0] = phase.centre[0]
    return time, left, right, centre


def _standing(path: ArmPath, s: float, samples: int) -> ArmMotion:
    zero = np.zeros((samples, 2))
    angle = np.broadcast_to(path.theta[0 if s == OUT else -1], (samples, 2))
    return ArmMotion(np.full(samples, s), angle + zero, zero, zero, zero, np.zeros(samples, bool))


def _centre(motions: _Motions, phase: Phase, time: FloatArray) -> FloatArray:
    """The centre gripper's tip and its rates over a phase."""
    begin, end = phase.centre
    moved = np.sign(end - begin) * motions.centre.at(time)
    moved[0] += begin
    return np.asarray(moved)


def _joined(motions: tuple[ArmMotion, ...]) -> ArmMotion:
    """One motion after the other."""
    return ArmMotion(
        *(np.concatenate([getattr(motion, part.name) for motion in motions]) for part in fields(ArmMotion))
    )


def _use(params: KnottingDyadParams, arms: Mapping[str, ArmMotion]) -> FloatArray:
    """The greatest use of each of the joints' limits over the samples."""
    turned = drive_angles(params).T
    speed, acceleration, jerk = (
        np.max([np.abs(rate @ turned).max(axis=1) for rate in rates], axis=0)
        for rates in zip(*((arm.speed, arm.acceleration, arm.jerk) for arm in arms.values()), strict=True)
    )
    return np.stack([speed / params.joint_speed, acceleration / params.joint_acceleration, jerk / params.joint_jerk])


def _centre_use(params: KnottingDyadParams, centre: SCurve) -> float:
    """The centre gripper's greatest use of a limit."""
    top = centre.jerk * centre.ramp
    return max(centre.speed / params.centre_speed, top / params.centre_acceleration, centre.jerk / params.centre_jerk)
