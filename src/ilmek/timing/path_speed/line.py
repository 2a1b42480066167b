"""One axis on a straight way, from rest to rest: seven phases of constant jerk, in closed form.

    v reached:           T = L/v + t_a,   t_a = v/a + a/j  (v j >= a²),   2 sqrt(v/j)  (v j < a²)
    v not reached:       T = 2 t_a(v'),   v' t_a(v') = L

with t_a(v) the time to reach the speed v. The way up to v takes v t_a/2, the way down the same. Of the limits those
count that are reached: with v' the first case gives v' = a (sqrt(a²/j² + 4 L/a) - a/j)/2, the second v' = cbrt(j L²/4).
                                                                             [integration of the phases; derived]
"""

import math
from dataclasses import dataclass

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.errors import ParameterError


@dataclass(frozen=True, slots=True)
class LineMotion:
    """The quickest motion over a distance.

    distance   [m or rad], with its sign
    jerk       jerk of the phases 1, 3, 5 and 7, without sign
    times      lengths of the seven phases [s]
    """

    distance: float
    jerk: float
    times: tuple[float, float, float, float, float, float, float]

    @property
    def duration(self) -> float:
        """Time from rest to rest [s]."""
        return math.fsum(self.times)

    @property
    def speed(self) -> float:
        """Greatest speed."""
        return self.jerk * self.times[0] * (self.times[0] + self.times[1])

    def at(self, time: FloatArray) -> FloatArray:
        """Position, speed, acceleration and jerk at times [s], stacked in this order; at rest outside the motion.

        At the joint of two phases the jerk is that of the later one.
        """
        if self.distance < 0:
            return -LineMotion(-self.distance, self.jerk, self.times).at(time)
        jerks = self.jerk * np.array([0, 1, 0, -1, 0, -1, 0, 1, 0])
        ends = np.append(0.0, np.cumsum(self.times))
        ends[-1] = self.duration
        phase = np.searchsorted(ends, time, side="right")
        states = np.zeros((9, 3))
        for at, length in enumerate(self.times, 1):
            states[at + 1] = _after(states[at], float(jerks[at]), length)
        states[-1] = self.distance, 0.0, 0.0
        begin = np.append(0.0, ends)[phase]
        rest = (phase == 0) | (phase == 8)
        moved = _after(states[phase].T, jerks[phase], np.where(rest, 0.0, time - begin))
        return np.asarray(np.concatenate([moved, jerks[phase][None]]))


def line_motion(distance: float, speed: float, acceleration: float, jerk: float) -> LineMotion:
    """The quickest motion from rest to rest over a distance, within the limits; speed and acceleration may be infinite.

    Raises ParameterError for limits that are not above 0, and where distance or jerk is not finite.
    >>> round(line_motion(2.0, 1.0, 2.0, 4.0).duration, 9)  # v reached, a not exceeded: L/v + v/a + a/j
    3.0
    """
    for name, limit in (("speed", speed), ("acceleration", acceleration), ("jerk", jerk)):
        if not limit > 0 or (name == "jerk" and math.isinf(limit)):
            raise ParameterError(
                f"{name} limit {limit:g} of a motion", allowed="above 0, the jerk's finite", do="give another limit"
            )
    if not math.isfinite(distance):
        raise ParameterError(f"a motion over {distance:g}", allowed="a finite distance")
    way = abs(distance)
    top = min(speed, _top_speed(way, acceleration, jerk))
    ramp, hold = _ramp(top, acceleration, jerk)
    cruise = max(way / top - (2 * ramp + hold), 0.0) if top else 0.0
    return LineMotion(distance, jerk, (ramp, hold, ramp, cruise, ramp, hold, ramp))


def _ramp(speed: float, acceleration: float, jerk: float) -> tuple[float, float]:
    """Time of a jerk phase, and of constant acceleration between two, to reach a speed."""
    if speed * jerk < acceleration**2:
        return math.sqrt(speed / jerk), 0.0
    return acceleration / jerk, speed / acceleration - acceleration / jerk


def _top_speed(way: float, acceleration: float, jerk: float) -> float:
    """Speed that is reached where it is not limited."""
    top = math.cbrt(jerk * way**2 / 4)
    if top * jerk <= acceleration**2:
        return top
    lag = acceleration / jerk
    return 2 * way / (math.sqrt(lag**2 + 4 * way / acceleration) + lag)


def _after(state: FloatArray, jerk: FloatArray | float, time: FloatArray | float) -> FloatArray:
    """Position, speed and acceleration after a time of constant jerk."""
    position, speed, acceleration = state
    return np.stack(
        [
            position + time * (speed + time * (acceleration / 2 + time * jerk / 6)),
            speed + time * (acceleration + time * jerk / 2),
            acceleration + time * jerk,
        ]
    )
