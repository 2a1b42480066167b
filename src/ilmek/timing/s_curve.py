"""A jerk-limited move of one axis from rest to rest: the shortest that keeps speed, acceleration and jerk.

Seven parts: jerk +J, acceleration held, jerk -J, cruise, and the same mirrored. With r the time of a jerk (ramp), h
that of held acceleration and c that of the cruise:

    v = J r (r + h),    d = v (2 r + h + c),    T = 4 r + 2 h + c

    r = A/J, h = V/A - A/J          where V J >= A^2; else r = sqrt(V/J), h = 0
    c = d/V - (2 r + h)             where that is not negative; else the speed is not reached, c = 0 and
    r = A/J, h = (sqrt(r^2 + 4 d/A) - 3 r)/2      where d >= 2 A^3/J^2; else r = (d/(2 J))^(1/3), h = 0

[derived; Biagiotti and Melchiorri, Trajectory Planning for Automatic Machines and Robots, 3.4]
"""

import math
from dataclasses import dataclass

from ilmek.errors import ParameterError


@dataclass(frozen=True, slots=True)
class AxisLimits:
    """What an axis keeps: speed [SI/s], acceleration [SI/s^2], jerk [SI/s^3]; inf jerk: none is kept.

    Raises ParameterError where one is not above 0, or speed or acceleration is not finite.
    """

    speed: float
    acceleration: float
    jerk: float = math.inf

    def __post_init__(self) -> None:
        for name in self.__slots__:
            value = float(getattr(self, name))
            if not value > 0 or (name != "jerk" and not math.isfinite(value)):
                raise ParameterError(f"{name} limit of an axis {value:g}", allowed="above 0, and finite but for jerk")


@dataclass(frozen=True, slots=True)
class SCurve:
    """A move over `distance` [SI]: times of each jerk, of held acceleration and of the cruise [s]."""

    distance: float
    ramp: float
    hold: float
    cruise: float

    @property
    def time(self) -> float:
        """Time from rest to rest [s]."""
        return 4 * self.ramp + 2 * self.hold + self.cruise

    @property
    def speed(self) -> float:
        """Greatest speed [SI/s]; 0 for no distance."""
        spent = 2 * self.ramp + self.hold + self.cruise
        return self.distance / spent if spent > 0 else 0.0


def s_curve(distance: float, limits: AxisLimits) -> SCurve:
    """The shortest move over a distance [SI], not below 0.

    >>> move = s_curve(1.0, AxisLimits(speed=1.0, acceleration=2.0, jerk=8.0))
    >>> move.ramp, move.hold, move.cruise, move.time
    (0.25, 0.25, 0.25, 1.75)
    """
    if not distance >= 0:
        raise ParameterError(f"a move over {distance:g}", allowed="a distance of 0 or more")
    speed, most, jerk = limits.speed, limits.acceleration, limits.jerk
    held = speed * jerk >= most**2
    ramp = most / jerk if held else math.sqrt(speed / jerk)
    hold = speed / most - most / jerk if held else 0.0
    cruise = distance / speed - (2 * ramp + hold)
    if cruise >= 0:
        return SCurve(distance, ramp, hold, cruise)
    ramp = most / jerk
    if distance >= 2 * most * ramp**2:
        return SCurve(distance, ramp, 0.5 * (math.sqrt(ramp**2 + 4 * distance / most) - 3 * ramp), 0.0)
    return SCurve(distance, (distance / (2 * jerk)) ** (1 / 3), 0.0, 0.0)


def move_time(distance: float, limits: AxisLimits) -> float:
    """Time of the shortest move [s].

    >>> move_time(0.5, AxisLimits(1.0, 2.0)), move_time(0.25, AxisLimits(1.0, 4.0))
    (1.0, 0.5)
    """
    return s_curve(distance, limits).time
