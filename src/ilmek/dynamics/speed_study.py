"""An own machine at several speeds: forces, drive, margins of its checks, and the greatest admissible speed.

The margin of a check is limit / value for an upper limit, value / limit for a lower one: below 1 it fails. The greatest
admissible speed lies between two speeds of the study, of which one holds and the next does not; it is found by
bisection.
"""

import itertools
import math
from collections.abc import Callable, Iterable
from typing import TypeAlias

from ilmek.dynamics.inverse_run import InverseRun
from ilmek.records import computed, record
from ilmek.report import Check

BISECTIONS = 16
"""Halvings of the interval of speeds in which a check begins to fail."""

AtSpeed: TypeAlias = Callable[[float], tuple[InverseRun, tuple[Check, ...]]]
"""Speed of the driving input [rad/s; m/s] -> the machine's run and its checks."""


@record
class SpeedPoint:
    """The machine at one speed [rad/s; m/s]."""

    speed: float
    run: InverseRun
    checks: tuple[Check, ...]

    @property
    def holds(self) -> bool:
        """Whether all checks hold."""
        return all(check.ok for check in self.checks)

    @property
    def pin_force(self) -> tuple[str, float]:
        """The pin with the greatest force, and this force [N]."""
        forces = {name: force for name, force in self.run.pin_forces_max.items() if math.isfinite(force)}
        return max(forces.items(), key=lambda item: item[1], default=("", math.nan))

    @property
    def least_margin(self) -> tuple[str, float]:
        """The check with the least margin, and this margin [1]; ("", inf) without checks."""
        margins = ((check.name, margin(check)) for check in self.checks)
        return min(margins, key=lambda item: item[1], default=("", math.inf))

    def as_json(self) -> dict[str, object]:
        """The row as plain data, SI."""
        name, force = self.pin_force
        check, least = self.least_margin
        return {
            "speed": self.speed,
            "drive": self.run.peak,
            "pin": name,
            "pin_force": force,
            "shaking_force": self.run.shaking_force_max,
            "margin": least if math.isfinite(least) else None,
            "check": check,
            "holds": self.holds,
        }


@record
class StudyOfSpeeds:
    """The machine at its speeds, in ascending order, and the greatest admissible speed.

    limit  [rad/s; m/s]; None: all speeds are admissible, or none      limited_by  name of the check that fails above it
    """

    points: tuple[SpeedPoint, ...]
    limit: float | None
    limited_by: str
    turning: bool

    @computed("rpm", "greatest admissible speed of the study", absent="every speed of the study is admissible, or none")
    def study_speed_max(self) -> float | None:
        return self.limit if self.turning else None

    @computed("m/s", "greatest admissible speed of the study", optional=True)
    def study_slide_speed_max(self) -> float | None:
        return None if self.turning else self.limit

    limiting = computed(
        "", "check that fails above it", lambda it: it.limited_by or None, name="study_limited_by", optional=True
    )
    speeds = computed(
        "", "the machine at each speed [SI]", lambda it: [one.as_json() for one in it.points], name="study", shown=False
    )


def speed_study(speeds: Iterable[float], at: AtSpeed) -> StudyOfSpeeds:
    """The machine at each speed [rad/s; m/s], ascending, and the greatest admissible speed.

    at  gives run and checks at a speed
    """
    points = tuple(SpeedPoint(speed, *at(speed)) for speed in speeds)
    limit, limited_by = None, ""
    for slow, fast in itertools.pairwise(points):
        if slow.holds and not fast.holds:
            limit, limited_by = _bisect(slow, fast, at)
            break
    return StudyOfSpeeds(points, limit, limited_by, any(point.run.turning for point in points))


def _bisect(slow: SpeedPoint, fast: SpeedPoint, at: AtSpeed) -> tuple[float, str]:
    """Greatest speed that holds between two, and the check that fails next."""
    for _ in range(BISECTIONS):
        middle = (slow.speed + fast.speed) / 2
        point = SpeedPoint(middle, *at(middle))
        slow, fast = (point, fast) if point.holds else (slow, point)
    return slow.speed, next(check.name for check in fast.checks if not check.ok)


def margin(check: Check) -> float:
    """Margin of a check [1]: how many times the value could grow, or shrink, to its limit.

    Infinite for a plain yes, 0 for a plain no and for NaN.

    >>> from ilmek.report import at_least, at_most
    >>> margin(at_most("stress", 50e6, 100e6, "MPa", "")), margin(at_least("life", 3.0, 2.0, "h", ""))
    (2.0, 1.5)
    """
    if (not check.unit and check.limit == 1) or math.isnan(check.value):
        return math.inf if check.ok else 0.0
    top, bottom = (check.value, check.limit) if check.relation == ">=" else (check.limit, check.value)
    return top / bottom if bottom > 0 else math.inf
