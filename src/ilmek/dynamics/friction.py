"""Forces that set in and turn round: windows of an input, and friction against the motion of a point.

Such a load jumps. At a jump it has two values, one just before and one just after: `side` says which one is meant, and
everything that may jump is judged a moment to that side of the instant, so that forces at a jump are limits.
"""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

import numpy as np

from ilmek.arrays import BoolArray, ComplexArray, FloatArray, RealField
from ilmek.dynamics.attached import attached
from ilmek.dynamics.inertia import Inertia
from ilmek.dynamics.loads import Load, Wrench
from ilmek.errors import MechanismError
from ilmek.linkage.motion import Motion
from ilmek.units import turn

MOMENT = 1e-9
"""How far beside an instant jumps are judged, in the input [rad, m]."""


@dataclass(frozen=True, slots=True)
class AngleRange:
    """Angles of an input from `start` to `end` [rad], upward, whatever the turn; `end` below `start` goes through 0.

    >>> AngleRange(6.0, 1.0).holds(np.array([0.5, 3.0, 6.5]))
    array([ True, False,  True])
    """

    start: float
    end: float

    def holds(self, angle: RealField) -> BoolArray:
        """Whether angles [rad] lie in the window; its start does, its end does not."""
        span = self.end - self.start
        inside = np.mod(np.asarray(angle) - self.start, turn) < np.mod(span, turn)
        return np.asarray(inside | (abs(span) >= turn))


@dataclass(frozen=True, slots=True)
class WindowedLoad:
    """A load that acts only while an input is in a window: the backing's resistance, a knife's cut, a beat.

    paced   the input whose angle opens the window
    side    at the window's ends: +1 what acts further on in the input, -1 further back, one number or one a sample
    """

    load: Load
    paced: str
    window: AngleRange
    side: RealField = 1.0

    def wrenches(self, motion: Motion, inertias: Mapping[str, Inertia]) -> Iterable[Wrench]:
        """The load's wrenches, nothing outside the window."""
        open_ = self.window.holds(motion.drives[self.paced].value + MOMENT * np.asarray(self.side))
        for wrench in self.load.wrenches(motion, inertias):
            yield Wrench(wrench.body, wrench.force * open_, wrench.at, wrench.torque * open_)


@dataclass(frozen=True, slots=True)
class Friction:
    """A force of given size [N] on a point of a body, against its velocity, while the input is in the window.

    point   by name, or where it is in the body's frame [m]
    size    [N], one number or one a sample
    paced   the input whose angle opens the window; it must move
    window  unsaid: always
    side    at a jump: +1 the force further on in the input, -1 further back, one number or one a sample
    """

    body: str
    point: str | complex
    size: RealField
    paced: str
    window: AngleRange | None = None
    side: RealField = 1.0

    def force(self, motion: Motion) -> ComplexArray:
        """The force [N], one a sample: - size v/|v|, where v is the velocity a moment to the `side`.

        Raises MechanismError where the input does not move: friction at rest has no definite direction.
        """
        drive = motion.drives[self.paced]
        speed = np.asarray(drive.speed, dtype=float)
        if not speed.all():
            raise MechanismError(
                f"friction on {self.body!r} has no direction: {self.paced} does not move", do="give the input a speed"
            )
        place = attached(motion, self.body, self._local(motion))
        velocity = place.velocity + MOMENT * self.side / speed * place.acceleration
        pace = np.abs(velocity)
        direction = np.divide(velocity, pace, out=np.zeros_like(velocity), where=pace > 0)
        size: FloatArray = np.asarray(self.size, dtype=float)
        if self.window is not None:
            size = size * self.window.holds(drive.value + MOMENT * np.asarray(self.side))
        force: ComplexArray = -size * direction
        return force

    def wrenches(self, motion: Motion, inertias: Mapping[str, Inertia]) -> Iterable[Wrench]:  # noqa: ARG002
        """One wrench."""
        yield Wrench(self.body, self.force(motion), self._local(motion))

    def _local(self, motion: Motion) -> complex:
        return motion.plan.mechanism.point(self.body, self.point) if isinstance(self.point, str) else self.point
