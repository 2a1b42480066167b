"""Loads that jump: loads within a range of an input, and friction against the motion of a point.

At a jump such a load has two one-sided values. `side` selects one: +1 the value further on in the input, -1 further
back. The load is evaluated at a small offset to that side, so that the force at a jump is the one-sided limit.
"""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

import numpy as np

from ilmek.arrays import BoolArray, ComplexArray, FloatArray, RealField
from ilmek.dynamics.inertia import Inertia
from ilmek.dynamics.loads import Load, Wrench
from ilmek.errors import MechanismError
from ilmek.linkage.joints import FreePoint, set_points
from ilmek.linkage.motion import Motion
from ilmek.records import record
from ilmek.units import turn

OFFSET = 1e-9
"""Offset in the input at which one-sided values are evaluated [rad; m]."""


@dataclass(frozen=True, slots=True)
class AngleRange:
    """Angles of an input from `start` upward to `end` [rad], in every turn; with `end` below `start` through 0.

    >>> AngleRange(6.0, 1.0).contains(np.array([0.5, 3.0, 6.5]))
    array([ True, False,  True])
    """

    start: float
    end: float

    def contains(self, angle: RealField) -> BoolArray:
        """Whether angles [rad] are in the range, of the same shape; the start is included, the end is not."""
        span = self.end - self.start
        inside = np.mod(np.asarray(angle) - self.start, turn) < np.mod(span, turn)
        return np.asarray(inside | (abs(span) >= turn))


@dataclass(frozen=True, slots=True)
class ValueRange:
    """Values of an input from `start` up to `end` [rad; m], once.

    >>> ValueRange(0.0, 1.0).contains(np.array([-0.1, 0.0, 0.5, 1.0]))
    array([False,  True,  True, False])
    """

    start: float
    end: float

    def contains(self, value: RealField) -> BoolArray:
        """Whether values are in the range, of the same shape; the start is included, the end is not."""
        values = np.asarray(value)
        return np.asarray((values >= self.start) & (values < self.end))


@record
class WindowedLoad:
    """A load that acts only while an input is in a range: resistance of a backing, a knife's cut, a beat-up.

    load        the load inside the range
    input_name  name of the input
    window      range of the input's angle [rad], or of its values
    side        at the ends of the range: +1 the load further on in the input, -1 further back; a number or one per
                sample
    """

    load: Load
    input_name: str
    window: AngleRange | ValueRange
    side: RealField = 1.0

    def wrenches(self, motion: Motion, inertias: Mapping[str, Inertia]) -> Iterable[Wrench]:
        """The wrenches of the load; zero outside the range."""
        open_ = self.window.contains(motion.drives[self.input_name].value + OFFSET * np.asarray(self.side))
        for wrench in self.load.wrenches(motion, inertias):
            yield Wrench(wrench.body, wrench.force * open_, wrench.at, wrench.torque * open_)


@record
class Friction:
    """A force of given magnitude on a point of a body, against its velocity, while an input is in a range.

    on          the point of the body, "body.point"
    magnitude   [N], a number or one value per sample
    input_name  name of the input; it must move
    window      range of the input's angle [rad]; default: the whole turn
    side        at a jump: +1 the force further on in the input, -1 further back; a number or one per sample
    """

    on: FreePoint
    magnitude: RealField
    input_name: str
    window: AngleRange | ValueRange | None = None
    side: RealField = 1.0

    def __post_init__(self) -> None:
        set_points(self, "on")

    def force(self, motion: Motion) -> ComplexArray:
        """The force [N], one value per sample: - magnitude v/|v|, with v the velocity on the given `side`; 0 at v = 0.

        Raises MechanismError where the input does not move: the direction of friction at rest is not determined.
        """
        drive = motion.drives[self.input_name]
        speed = np.asarray(drive.speed, dtype=float)
        if not speed.all():
            raise MechanismError(
                f"friction on {self.on!r} has no direction: {self.input_name} does not move",
                do="give the input a speed",
            )
        moved = motion.carried(*motion.plan.mechanism.located(self.on))
        velocity = moved.velocity + OFFSET * self.side / speed * moved.acceleration
        pace = np.abs(velocity)
        direction = np.divide(velocity, pace, out=np.zeros_like(velocity), where=pace > 0)
        magnitude: FloatArray = np.asarray(self.magnitude, dtype=float)
        if self.window is not None:
            magnitude = magnitude * self.window.contains(drive.value + OFFSET * np.asarray(self.side))
        force: ComplexArray = -magnitude * direction
        return force

    def wrenches(self, motion: Motion, inertias: Mapping[str, Inertia]) -> Iterable[Wrench]:  # noqa: ARG002
        """One wrench."""
        body, local = motion.plan.mechanism.located(self.on)
        yield Wrench(body, self.force(motion), local)
