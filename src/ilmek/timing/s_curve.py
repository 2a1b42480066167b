"""Time-optimal move of one axis from rest to rest within limits of speed, acceleration and jerk.

Seven phases: jerk +J, constant acceleration, jerk -J, cruise, and the same mirrored. r is the time of a jerk phase
(ramp), h that of constant acceleration (hold), c that of the cruise:

    v = J r (r + h),    d = v (2 r + h + c),    T = 4 r + 2 h + c

    to reach a speed v:   r = A/J, h = v/A - A/J   where v J >= A^2;   else r = sqrt(v/J), h = 0
    c = d/V - (2 r + h)   where the speed limit V is reached, else c = 0 and
    v = 2 d / (sqrt((A/J)^2 + 4 d/A) + A/J)        where d >= 2 A^3/J^2;   else v = (J d^2 / 4)^(1/3)

[derived; Biagiotti and Melchiorri, Trajectory Planning for Automatic Machines and Robots, 3.4]
"""

import math
from dataclasses import dataclass

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.errors import ParameterError


@dataclass(frozen=True, slots=True)
class AxisLimits:
    """Limits of one axis: speed [SI/s], acceleration [SI/s^2], jerk [SI/s^3]; inf: no limit.

    Raises ParameterError unless all are above 0 and acceleration or jerk is finite.
    """

    speed: float
    acceleration: float
    jerk: float = math.inf

    def __post_init__(self) -> None:
        for name in self.__slots__:
            value = float(getattr(self, name))
            if not value > 0:
                raise ParameterError(f"{name} limit {value:g} of an axis", allowed="above 0", do="give another limit")
        if math.isinf(self.acceleration) and math.isinf(self.jerk):
            raise ParameterError("an axis without limits of acceleration and jerk", allowed="one of them finite")


@dataclass(frozen=True, slots=True)
class SCurve:
    """A jerk-limited move from rest to rest.

    distance            [SI], of either sign
    ramp, hold, cruise  times of a jerk phase, of constant acceleration, and of the cruise [s]
    jerk                magnitude in the phases 1, 3, 5 and 7 [SI/s^3]; inf where the acceleration jumps
    """

    distance: float
    ramp: float
    hold: float
    cruise: float
    jerk: float = math.inf

    @property
    def time(self) -> float:
        """Time from rest to rest [s]."""
        return 4 * self.ramp + 2 * self.hold + self.cruise

    @property
    def speed(self) -> float:
        """Magnitude of the largest speed [SI/s]; 0 for no distance."""
        spent = 2 * self.ramp + self.hold + self.cruise
        return abs(self.distance) / spent if spent > 0 else 0.0

    def at(self, time: FloatArray) -> FloatArray:
        """Position, speed, acceleration and jerk at times [s], stacked, (4, times); at rest outside the move.

        Where two phases meet, the jerk is that of the later one. Raises ParameterError for an infinite jerk.
        """
        if math.isinf(self.jerk):
            raise ParameterError("the motion of a move without a jerk limit", allowed="a finite jerk limit")
        times = (self.ramp, self.hold, self.ramp, self.cruise, self.ramp, self.hold, self.ramp)
        jerks = math.copysign(self.jerk, self.distance) * np.array([0, 1, 0, -1, 0, -1, 0, 1, 0])
        ends = np.append(0.0, np.cumsum(times))
        ends[-1] = self.time
        phase = np.searchsorted(ends, time, side="right")
        states = np.zeros((9, 3))
        for at, length in enumerate(times, 1):
            states[at + 1] = _after(states[at], float(jerks[at]), length)
        states[-1] = self.distance, 0.0, 0.0
        begin = np.append(0.0, ends)[phase]
        rest = (phase == 0) | (phase == 8)
        moved = _after(states[phase].T, jerks[phase], np.where(rest, 0.0, time - begin))
        return np.asarray(np.concatenate([moved, jerks[phase][None]]))


def s_curve(distance: float, limits: AxisLimits) -> SCurve:
    """The fastest move over a distance [SI] of either sign. Raises ParameterError unless the distance is finite.

    >>> move = s_curve(1.0, AxisLimits(speed=1.0, acceleration=2.0, jerk=8.0))
    >>> move.ramp, move.hold, move.cruise, move.time
    (0.25, 0.25, 0.25, 1.75)
    """
    if not math.isfinite(distance):
        raise ParameterError(f"a move over {distance:g}", allowed="a finite distance")
    length, jerk = abs(distance), limits.jerk
    if length == 0:
        return SCurve(distance, 0.0, 0.0, 0.0, jerk)
    top = _top_speed(length, limits.acceleration, jerk)
    ramp, hold = _ramp(min(top, limits.speed), limits.acceleration, jerk)
    cruise = max(length / limits.speed - (2 * ramp + hold), 0.0) if limits.speed < top else 0.0
    return SCurve(distance, ramp, hold, cruise, jerk)


def move_time(distance: float, limits: AxisLimits) -> float:
    """Time of the fastest move [s] over a distance [SI].

    >>> move_time(0.5, AxisLimits(1.0, 2.0)), move_time(0.25, AxisLimits(1.0, 4.0))
    (1.0, 0.5)
    """
    return s_curve(distance, limits).time


def travel_time(pitch: float, window: float, limits: AxisLimits) -> float:
    """Time t of each further pitch p [SI] of a longer move [s], such that no move of d pitches takes longer than this:

        move_time(d p) <= W + (d - 1) t   for every d,   W = max(window, move_time(p))

    Where the window [s] is long enough for start and stop, t is p / v; a shorter one lengthens t. Up to the distance at
    which the speed v is reached, move_time is concave, so that the t required for d pitches,
    (move_time(d p) - W)/(d - 1), rises to one maximum and then falls, and bisection finds it. From there on move_time
    is straight, with a slope that is steeper than just before where the jerk is finite, and the required t tends
    monotonically to p / v: the first such d and the limit are compared.
    """
    room = max(window, move_time(pitch, limits))

    def required(pitches: int) -> float:
        return (move_time(pitches * pitch, limits) - room) / (pitches - 1)

    jerking, steady = _ramp(limits.speed, limits.acceleration, limits.jerk)
    reach = limits.speed * (2 * jerking + steady)
    low = 2
    high = last = max(low, math.floor(reach / pitch))
    while low < high:
        middle = (low + high) // 2
        low, high = (middle + 1, high) if required(middle + 1) > required(middle) else (low, middle)
    return max(pitch / limits.speed, required(low), required(last + 1))


def _ramp(speed: float, acceleration: float, jerk: float) -> tuple[float, float]:
    """Times of a jerk phase and of constant acceleration [s] to reach a speed."""
    if speed * jerk < acceleration**2:
        return math.sqrt(speed / jerk), 0.0
    return acceleration / jerk, speed / acceleration - acceleration / jerk


def _top_speed(length: float, acceleration: float, jerk: float) -> float:
    """Largest speed of a move over a length without a speed limit."""
    top = math.cbrt(jerk * length**2 / 4)
    if top * jerk <= acceleration**2:
        return top
    lag = acceleration / jerk
    return 2 * length / (math.sqrt(lag**2 + 4 * length / acceleration) + lag)


def _after(state: FloatArray, jerk: FloatArray | float, time: FloatArray | float) -> FloatArray:
    """State (position, speed, acceleration) after a time of constant jerk."""
    position, speed, acceleration = state
    return np.stack(
        [
            position + time * (speed + time * (acceleration / 2 + time * jerk / 6)),
            speed + time * (acceleration + time * jerk / 2),
            acceleration + time * jerk,
        ]
    )
