"""What turns the crank: the smallest servo of the catalogue and the gears before it."""

from dataclasses import dataclass

from ilmek.elements.motors import Motor, Reducer, geared_motor
from ilmek.machines.knotting_four_bar.params import KnottingFourBarParams

RATIOS = (1.0, 3.0, 4.0, 5.0, 7.0, 10.0, 16.0, 20.0, 25.0, 35.0, 50.0, 70.0, 100.0)
"""Gears to choose from: none, and the usual planetary ones of one and two stages."""


@dataclass(frozen=True, slots=True)
class GearedServo:
    """A servo behind gears: its torque [N m] and speed [rad/s], and its class; None where none is enough."""

    reducer: Reducer
    torque: float
    speed: float
    servo: Motor | None


def drive_for(params: KnottingFourBarParams, torque: float) -> GearedServo:
    """The drive for a torque on the crank [N m], either way, at the crank's speed."""
    ratios = RATIOS if params.gear_ratio is None else (params.gear_ratio,)
    reducers = [Reducer(ratio, params.gear_efficiency) for ratio in ratios]
    load, speed = abs(torque), abs(params.speed)
    servo, reducer = geared_motor(load, speed, reducers, "servo") or (None, reducers[0])
    return GearedServo(reducer, reducer.motor_torque(load), speed * reducer.ratio, servo)
