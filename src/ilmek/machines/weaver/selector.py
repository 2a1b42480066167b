"""The colour selector: the stepper that brings a tube in line, on the axle of a drum, or by the pulley of a slide.

    error = max |i t / s - round(i t / s)| s + k s + h         i = 1 to n,   s = 2 pi R / 200

A tube i at the pitch t has no whole number of full steps s, at the radius R of the drum's tubes or of the pulley; a
step has the accuracy k, and the sensor at which the magazine begins to count the repeat accuracy h.          [derived]
"""

import numpy as np

from ilmek.elements.duty import MARGIN
from ilmek.elements.field_devices import REPEATED
from ilmek.elements.motors import FULL_STEPS, NO_MOTOR, Motor, smallest_motor
from ilmek.machines.weaver.magazine import Magazine, tubes_radius
from ilmek.machines.weaver.params import WeaverParams
from ilmek.part.catalogue import SPECIAL_FACE
from ilmek.records import computed, record, result
from ilmek.units import turn

STEP_ACCURACY = 0.05
"""Of a full step, not added up over several: usual for steppers of two phases."""


@record
class Selector:
    """The stepper that brings a tube in line; `stepper` is None where none of the table is enough.

    speed  of the motor [rad/s]
    """

    torque: float = result("Nm", "torque that it must give")
    speed: float
    step: float = result("mm", "travel of the tubes for a step of it")
    error: float = result("mm", "greatest error of a tube's position, by full steps")
    stepper: Motor | None

    @property
    def face(self) -> float:
        """Side of the motor's flange [m]."""
        return SPECIAL_FACE if self.stepper is None else self.stepper.face

    @property
    def length(self) -> float:
        """Length of the motor [m]."""
        return 2 * SPECIAL_FACE if self.stepper is None else self.stepper.length

    motor = computed("", "stepper that moves the tubes", lambda it: it.stepper and it.stepper.name, absent=NO_MOTOR)


def selector_of(params: WeaverParams, magazine: Magazine) -> Selector:
    """The selector's stepper."""
    radius, mass = tubes_radius(magazine) or params.selector_pulley, magazine.moved(params.tube_mass)
    # A drum turns its tubes at the radius of their pitch: the same mass, moved along its circumference.
    torque, speed = MARGIN * mass * params.selector_acceleration * radius, params.selector_speed / radius
    step = turn * radius / FULL_STEPS
    steps = np.arange(1, magazine.per_tier + 1) * magazine.pitch / step
    error = (float(np.abs(steps - np.round(steps)).max()) + STEP_ACCURACY) * step + REPEATED
    return Selector(torque, speed, step, error, smallest_motor(torque, speed, kind="stepper"))
