"""A motor on an input: its effort at a speed.

    M = M_0 tanh((w_0 - w) / (s w_0))                     rounded: limit and line pass into one another
    M = M_0 min(1, max(-1, (w_0 - w) / (s w_0)))          sharp: the torque-speed line of textbooks, with its limit

w_0 speed without load, s the slip at which the line reaches M_0; s = 1 is a direct-current motor with the stall torque
M_0. The rounded characteristic is assumed by this project.                  [line: Norton, Design of Machinery, §2.18]
"""

import math
from contextlib import suppress

from ilmek.arguments import Arguments
from ilmek.errors import MechanismError, UnitError
from ilmek.records import value_record
from ilmek.units import parse_quantity

_GIVEN = Arguments("a motor", MechanismError)


@value_record
class MotorDrive:
    """A motor that drives an input in forward runs: torque [N m], or force [N] on a sliding input.

    effort   M_0 [N m; N]            speed  w_0 without load [rad/s; m/s]; None: constant effort
    slip     s [1]                   inertia  of rotor and flywheel, at the input [kg m²; kg]
    sharp    the line and its limit meet in a corner; default: rounded

    A text has its unit; where the effort is a force, the others are those of a sliding input. Raises MechanismError for
    values that are not finite, a speed of 0, a slip that is not above 0, a negative inertia.

    >>> motor = MotorDrive("2N*m", "1500rpm", slip=1.0, sharp=True)
    >>> round(motor.at(25 * math.pi), 12), motor.at(0.0)
    (1.0, 2.0)
    """

    effort: float
    speed: float | None = None
    slip: float = 0.05
    inertia: float = 0.0
    sharp: bool = False

    def __post_init__(self) -> None:
        for name, unit in (_SLIDING if _is_force(self.effort) else _TURNING).items():
            value = getattr(self, name)
            if value is not None or name != "speed":
                object.__setattr__(self, name, _GIVEN.number(name, value, unit))
        _GIVEN.not_negative("slip", self.slip)
        _GIVEN.not_negative("inertia", self.inertia)
        _GIVEN.flag("sharp", self.sharp)
        if 0.0 in (self.slip, self.speed):
            name = "speed without load" if self.speed == 0 else "slip"
            raise MechanismError(
                f"{name} of a motor is 0", allowed="not 0", do="leave the speed out: a constant effort"
            )

    def at(self, speed: float) -> float:
        """Its effort [N m; N] at a speed [rad/s; m/s]."""
        if self.speed is None:
            return self.effort
        share = (self.speed - speed) / (self.slip * abs(self.speed))
        return self.effort * (min(1.0, max(-1.0, share)) if self.sharp else math.tanh(share))

    def __call__(self, _time: float, _position: float, speed: float) -> float:
        """Its effort [N m; N], as a `Drive`."""
        return self.at(speed)


_TURNING = {"effort": "N*m", "speed": "rad/s", "slip": "", "inertia": "kg*m^2"}
_SLIDING = {"effort": "N", "speed": "m/s", "slip": "", "inertia": "kg"}


def _is_force(effort: object) -> bool:
    """Whether an effort is a force as a text: the motor drives a sliding input."""
    if not isinstance(effort, str):
        return False
    with suppress(UnitError):
        parse_quantity(effort, "N")
        return True
    return False
