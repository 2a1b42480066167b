"""Lines of a parts list that many machines have: motors, reducers."""

from ilmek.elements.motors import Motor, smallest_motor
from ilmek.report import Part
from ilmek.units import format_quantity, mm

PULLEY = 20 * mm
"""Radius of the pulleys of belt axes [m]: chosen."""


def motor_part(name: str, number: int, motor: Motor | None, torque: float, speed: float) -> Part:
    """A motor of the catalogue; where none is sufficient, one made to measure, priced as a servo by its power.

    torque  required [N m]        speed  of the motor [rad/s]
    """
    if motor is not None:
        return Part(name, number, motor.name, "", motor.kind, motor.mass, power=motor.power, drives=True)
    made = f"to measure: {format_quantity(torque, 'Nm', 3)} at {format_quantity(speed, 'rpm', 3)}"
    return Part(name, number, made, "", "servo", power=torque * speed, drives=True)


def axis_motor(name: str, number: int, thrust: float, speed: float) -> Part:
    """The motor of a belt axis for a thrust [N] at a speed [m/s], on a pulley without a gear."""
    torque, turns = thrust * PULLEY, speed / PULLEY
    return motor_part(name, number, smallest_motor(torque, turns), torque, turns)


def reducer_part(name: str, number: int, ratio: float, motor: Motor | None) -> Part:
    """The reducer of a motor, priced by the motor's power."""
    return Part(name, number, f"{ratio:g}:1", "", "reducer", power=motor.power if motor else 0.0)
