"""The colour selector: the stepper that brings a tube in line, by a belt."""

from ilmek.elements.duty import MARGIN
from ilmek.elements.motors import FULL_STEPS, NO_MOTOR, Motor, smallest_motor
from ilmek.machines.weaver.magazine import Magazine
from ilmek.machines.weaver.params import WeaverParams
from ilmek.part.catalogue import SPECIAL_FACE
from ilmek.records import computed, record, result
from ilmek.units import turn


@record
class Selector:
    """The stepper that brings a tube in line; `stepper` is None where none of the table is enough.

    speed  of the motor [rad/s]
    """

    torque: float = result("Nm", "torque that it must give")
    speed: float
    step: float = result("mm", "travel of the tubes for a step of it")
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
    """The selector's stepper, on a belt round its pulley."""
    radius, mass = params.selector_pulley, magazine.moved(params.tube_mass)
    # A drum turns its tubes at the radius of their pitch: the same mass, moved along its circumference.
    torque, speed = MARGIN * mass * params.selector_acceleration * radius, params.selector_speed / radius
    return Selector(torque, speed, turn * radius / FULL_STEPS, smallest_motor(torque, speed, kind="stepper"))
