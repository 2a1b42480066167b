"""The result of `solve`: the motion of every body at each sample, and the status of the sample."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, NamedTuple, TypeAlias

import numpy as np

from ilmek.arguments import Arguments
from ilmek.arrays import Bool, Complex, ComplexField, Float, Int8, RealField
from ilmek.errors import MechanismError
from ilmek.linkage.body_jerk import STILL_JERK, BodyJerk
from ilmek.linkage.body_motion import STILL, BodyMotion
from ilmek.linkage.faults import first_fault
from ilmek.linkage.followed import followed_angle
from ilmek.linkage.groups.group import Columns, InputMotion
from ilmek.linkage.joints import FreePoint
from ilmek.linkage.model import GROUND, Mechanism, Pin, Rotation
from ilmek.linkage.status import Status
from ilmek.linkage.structure import Plan
from ilmek.records import record
from ilmek.report.framed import Framed
from ilmek.units import turn

__all__ = ["Motion", "Status"]

Reals: TypeAlias = Float[np.ndarray, " samples"]
Points: TypeAlias = Complex[np.ndarray, " samples"]


class AttachedPoint(NamedTuple):
    """Position [m], velocity [m/s] and acceleration [m/s^2] of a body's point, complex, one value per sample."""

    position: Points
    velocity: Points
    acceleration: Points


@dataclass(frozen=True, slots=True)
class MovedPoint:
    """A point of a body over the samples of a motion, and the turning of its body: `motion["rocker.E"]`."""

    motion: "Motion"
    body: str
    local: complex

    @property
    def position(self) -> Points:
        """Position [m], complex."""
        return self.motion.carried(self.body, self.local).position

    @property
    def velocity(self) -> Points:
        """Velocity [m/s], complex."""
        return self.motion.carried(self.body, self.local).velocity

    @property
    def acceleration(self) -> Points:
        """Acceleration [m/s^2], complex."""
        return self.motion.carried(self.body, self.local).acceleration

    @property
    def jerk(self) -> Points:
        """Jerk [m/s^3], complex."""
        return self.motion._points(self.motion._jerk(self.body).carry(self.local))

    @property
    def direction(self) -> Points:
        """Unit complex e^{i theta} along the x axis of the body's frame."""
        return self.motion.direction(self.body)

    @property
    def angle(self) -> Reals:
        """Angle of the body [rad], counted through full turns."""
        return self.motion.angle(self.body)

    @property
    def omega(self) -> Reals:
        """Angular velocity of the body [rad/s]."""
        return self.motion.omega(self.body)

    @property
    def alpha(self) -> Reals:
        """Angular acceleration of the body [rad/s^2]."""
        return self.motion.alpha(self.body)

    @property
    def beta(self) -> Reals:
        """Angular jerk of the body [rad/s^3]."""
        return self.motion._reals(self.motion._jerk(self.body).beta)


@record
class Motion(Framed):
    """The motion of a mechanism over a batch of samples.

    Only directions and rates are kept; points and origins are computed on request. Every result is an array over the
    samples, and may be a read-only view. NaN where a sample is not solved.

    status  Status of each sample (int8)        drives  the inputs' motions by name
    time    of the samples [s], for loads that vary over it; None: not known

    >>> from ilmek import four_bar, solve
    >>> motion = solve(four_bar(0.300, 0.060, 0.200, 0.230), [0.0, 0.5, 1.0], speed=15.5)
    >>> motion
    <Motion of four-bar: 3 of 3 samples solved>
    >>> bool(abs(motion["crank.A"].velocity[0] - 0.93j) < 1e-12), motion["rocker"].omega.shape, motion.solved.all()
    (True, (3,), np.True_)
    """

    plan: Plan
    drives: Mapping[str, InputMotion]
    columns: Mapping[str, Columns]
    status: Int8[np.ndarray, " samples"]
    time: Reals | None = None

    def __len__(self) -> int:
        return len(self.status)

    def __repr__(self) -> str:
        solved = int(np.count_nonzero(self.status == Status.OK))
        return f"<Motion of {self.plan.mechanism.name[:60]}: {solved} of {len(self)} samples solved>"

    @property
    def ok(self) -> bool:
        """Whether every sample could be solved."""
        return not self.status.any()

    @property
    def solved(self) -> Bool[np.ndarray, " samples"]:
        """Which samples are solved."""
        return np.asarray(self.status == Status.OK)

    def __getitem__(self, name: FreePoint) -> MovedPoint:
        """A point, "body.point"; of a body alone, the origin of its frame. Raises MechanismError for an unknown one."""
        if isinstance(name, str) and "." not in name:
            return MovedPoint(self, self.plan.mechanism.body(name).name, 0j)
        return MovedPoint(self, *self.plan.mechanism.located(name))

    def body(self, name: str) -> BodyMotion:
        """A body's motion, constants as plain numbers. Raises MechanismError for an unknown body."""
        self.plan.mechanism.body(name)
        if name == GROUND:
            return STILL
        step = self.plan.step_of(name)
        known = {parent: self.body(parent) for parent in step.parents}
        with np.errstate(invalid="ignore", over="ignore"):  # at a dead centre rates are infinite; `status` says so
            return step.locate(known, {body: self.columns[body] for body in step.bodies})[name]

    def point(self, body: str, point: str = "") -> AttachedPoint:
        """Motion of a point, "body.point", or of a body and a point's name."""
        return self.carried(*self._located(body, point))

    def carried(self, body: str, local: complex) -> AttachedPoint:
        """Motion of the point of a body at `local` [m] in its frame."""
        with np.errstate(invalid="ignore", over="ignore"):  # at a dead centre rates are infinite; `status` says so
            point = self.body(body).carry(local)
        return AttachedPoint(*(self._points(rate) for rate in (point.position, point.velocity, point.acceleration)))

    def origin(self, body: str) -> Points:
        """World position of the origin of a body's frame [m]."""
        return self._points(self.carried(body, 0j).position)

    def pose(self, sample: int = 0) -> dict[str, tuple[complex, float]]:
        """Body -> (origin [m], angle [rad]) at one sample, in the form of a mechanism's `pose`."""
        sample = Arguments("a motion", MechanismError).whole("sample", sample, least=-len(self), most=len(self) - 1)
        return {
            body: (complex(self.origin(body)[sample]), float(np.angle(self.direction(body)[sample])))
            for body in self.plan.mechanism.moving
        }

    def direction(self, body: str) -> Points:
        """Unit complex e^{i theta} along the x axis of a body's frame."""
        return self._points(self.body(body).direction)

    def angle(self, body: str) -> Reals:
        """Angle of a body's frame against the world's x [rad], counted through full turns, the first in (-pi, pi].

        Samples may be many turns apart; see `followed`. NaN for samples without a position.
        """
        angle = np.angle(self.direction(body))
        turns = np.round((followed_angle(self.plan, self.drives, body, GROUND) - angle) / turn)
        solved = np.flatnonzero(np.isfinite(turns))
        return np.asarray(angle + turn * (turns - turns[solved[0]])) if len(solved) else angle

    def omega(self, body: str) -> Reals:
        """Angular velocity of a body [rad/s]."""
        return self._reals(self.body(body).omega)

    def alpha(self, body: str) -> Reals:
        """Angular acceleration of a body [rad/s^2]."""
        return self._reals(self.body(body).alpha)

    def _located(self, body: str, point: str) -> tuple[str, complex]:
        mechanism = self.plan.mechanism
        named = isinstance(point, str) and not point
        return mechanism.located(body) if named else (body, mechanism.point(body, point))

    def _jerk(self, name: str) -> BodyJerk:
        """A body's motion with its jerk, from those of the bodies to which it is attached."""
        self.plan.mechanism.body(name)
        if name == GROUND:
            return STILL_JERK
        step = self.plan.step_of(name)
        known = {parent: self._jerk(parent) for parent in step.parents}
        columns = {body: self.columns[body] for body in step.bodies}
        located = step.locate({parent: one.motion for parent, one in known.items()}, columns)
        with np.errstate(invalid="ignore", divide="ignore", over="ignore"):
            return step.jerk(known, located, columns, self.drives)[name]

    def table(self) -> dict[str, Reals]:
        """The motion as columns of a table: heading with SI unit -> one value per sample; NaN where it does not close.

        For each input `crank [rad]`; for each moving body `rocker angle [rad]`, `rocker omega [rad/s]`, `rocker alpha
        [rad/s^2]`; for each moving point, joints once, `rocker.B x [m]`, `rocker.B y [m]` and likewise the velocity
        `vx`, `vy` [m/s] and the acceleration `ax`, `ay` [m/s^2]. `frame` is the same as a DataFrame.
        """
        columns = {
            f"{entry.name} [{'rad' if isinstance(entry, Rotation) else 'm'}]": np.asarray(self.drives[entry.name].value)
            for entry in self.plan.mechanism.inputs
        }
        for body in self.plan.mechanism.moving:
            columns[f"{body} angle [rad]"] = self.angle(body)
            columns[f"{body} omega [rad/s]"] = self.omega(body)
            columns[f"{body} alpha [rad/s^2]"] = self.alpha(body)
        for body, point in moving_points(self.plan.mechanism):
            moved = self.point(body, point)
            for rate, vector, unit in (
                ("", moved.position, "m"),
                ("v", moved.velocity, "m/s"),
                ("a", moved.acceleration, "m/s^2"),
            ):
                columns[f"{body}.{point} {rate}x [{unit}]"] = np.real(vector)
                columns[f"{body}.{point} {rate}y [{unit}]"] = np.imag(vector)
        return columns

    def require(self) -> "Motion":
        """The motion itself, if every sample is solved.

        Raises MechanismError with the range of the input that fails, the gap, and a remedy.
        """
        if self.ok:
            return self
        raise first_fault(self.plan, self.drives, self.status)

    def _points(self, value: ComplexField) -> Points:
        points: Points = _over(value, self.status.shape, np.dtype(complex))
        return points

    def _reals(self, value: RealField) -> Reals:
        reals: Reals = _over(value, self.status.shape, np.dtype(float))
        return reals


def moving_points(mechanism: Mechanism) -> tuple[tuple[str, str], ...]:
    """The named points that move, each once: body and point; a joint's by the first body that carries it.

    Pins of several bodies at one point, `NAME` and `NAME.BODY`, count once.
    """
    pins = {joint.name for joint in mechanism.joints if isinstance(joint, Pin)}
    seen = {joint.name for joint in mechanism.joints if isinstance(joint, Pin) and GROUND in joint.bodies}
    moving_points = []
    for body in mechanism.moving:
        for point in mechanism.body(body).points:
            if point not in seen and point.rpartition(".")[0] not in mechanism.body(body).points:
                moving_points.append((body, point))
                seen |= {point} & pins
    return tuple(moving_points)


def free_points(mechanism: Mechanism) -> tuple[tuple[str, str], ...]:
    """Those of `moving_points` that are no joints."""
    joints = {joint.name for joint in mechanism.joints}
    return tuple(point for point in moving_points(mechanism) if point[1] not in joints)


def _over(value: ComplexField, shape: tuple[int, ...], dtype: np.dtype[Any]) -> Any:
    """A constant as a read-only array over the samples; an array as it is."""
    if isinstance(value, np.ndarray) and value.ndim:
        return value
    return np.broadcast_to(np.asarray(value, dtype=dtype), shape)
