"""Main and looper shaft along the width: torsion under the torques of all drives, flywheel, motor, critical speed.

The motor is at one end, flywheel and the belt between both shafts at the other. A drive is a disc: the mean inertia of
its links at the crank. Drive k asks for the torque T(theta - k phase) of constant speed, the motor gives the mean of
all. The needle at a drive is then late by its twist against the belt's end, the hook by that of the looper shaft:

    |twist_main - twist_looper| <= share of the looper's timing margin
                                                                  [`elements.torsion`; the purpose that the paper names]

The flywheel keeps the fluctuation of the speed, J = (max W - min W) / (delta w²), W the work of the torque over its
mean (`dynamics.flywheel`), of all torques together.
"""

import math
from collections.abc import Mapping

import numpy as np

from ilmek.arrays import Float, FloatArray
from ilmek.dynamics.flywheel import flywheel
from ilmek.elements.duty import MARGIN
from ilmek.elements.materials import MATERIALS
from ilmek.elements.motors import SERVO, Motor, geared_motor
from ilmek.elements.reducers import DIRECT, PLANETARY, Reducer
from ilmek.elements.torsion import TorsionModes, steady_twist, torsion_modes
from ilmek.elements.whirl import uniform_speed
from ilmek.machines.tufting.strength import SERVO_PEAK, SHAFTS
from ilmek.machines.tufting_machine.params import TuftingMachineParams
from ilmek.records import computed, record, result
from ilmek.report import Check, at_least, at_most, must
from ilmek.units import turn

STEEL = MATERIALS["heat-treatable steel"]
SAMPLES = 360

CRITICAL = 3.0
"""Critical speed over the speed at least; assumed by this project."""

SHAFT_IDS = MAIN_SHAFT, LOOPER_CRANKS = "tufting/main-shaft", "tufting-machine/looper-crank-shaft"
MOTOR_ID, FLYWHEEL_ID = "tufting-machine/motor", "tufting-machine/flywheel"


@record
class CrankTorques:
    """What turns with the shafts: torques of a drive at even steps of a turn [N m], by shaft; inertias [kg m²]."""

    torques: Mapping[str, Float[np.ndarray, " samples"]]
    inertias: Mapping[str, float]


@record
class ShaftTorsion:
    """A shaft: its modes, and the twist of each drive against the belt's end over a turn [rad], (drives, samples)."""

    modes: TorsionModes
    late: Float[np.ndarray, "drives samples"]


@record
class TuftingShafts:
    """The shafts of a machine; margin: the looper's timing margin [rad]."""

    params: TuftingMachineParams
    margin: float
    diameter: float = result("mm", "diameter of the main shaft", name="shaft_diameter")
    shafts: Mapping[str, ShaftTorsion]
    flywheel: float = result("kg*m^2", "moment of inertia of the flywheel", name="flywheel_inertia")
    torque: Float[np.ndarray, " samples"]
    motor: tuple[Motor, Reducer] | None

    natural_frequency = computed(
        "Hz", "first natural frequency of torsion of the main shaft", lambda it: it.frequencies[0]
    )
    natural_frequencies = computed(
        "Hz", "natural frequencies of torsion of the main shaft, the first three", lambda it: it.frequencies
    )
    looper_natural_frequency = computed(
        "Hz", "that of the looper shaft", lambda it: float(it.shafts["looper"].modes.frequencies[1]) / turn
    )
    shaft_twist_max = computed(
        "deg",
        "greatest twist of a drive against the belt's end, by shaft",
        lambda it: {name: float(np.max(np.abs(one.late))) for name, one in it.shafts.items()},
    )
    needle_twist = computed(
        "deg", "twist of the first needle against the last", lambda it: float(np.max(np.abs(np.ptp(it.main, axis=0))))
    )
    timing_error = computed(
        "deg", "greatest twist of a needle against its looper", lambda it: float(np.max(np.abs(it.main - it.looper)))
    )
    critical_speed = computed("rpm", "critical speed of the main shaft between its drives", lambda it: it.whirl)
    drive_torque_rms = computed("N*m", "root mean square of the torque of all drives", lambda it: it.rms_torque)
    drive_torque_max = computed("N*m", "its greatest magnitude", lambda it: float(np.max(np.abs(it.torque))))
    drive_motor = computed(
        "", "motor of the main shaft", lambda it: it.motor[0].name if it.motor else None, absent="none is enough"
    )

    @property
    def main(self) -> FloatArray:
        """Twist of the needle drives [rad], (drives, samples)."""
        return self.shafts["main"].late

    @property
    def looper(self) -> FloatArray:
        """Twist of the looper drives [rad], (drives, samples)."""
        return self.shafts["looper"].late

    @property
    def frequencies(self) -> list[float]:
        """Natural frequencies of torsion of the main shaft [1/s]."""
        return [float(value) / turn for value in self.shafts["main"].modes.frequencies[1:4]]

    @property
    def rms_torque(self) -> float:
        """Root mean square of the torque of all drives [N m]."""
        return float(np.sqrt(np.mean(self.torque**2)))

    @property
    def whirl(self) -> float:
        """Critical speed of a shaft between the bearings of neighbouring drives [rad/s]."""
        area = math.pi * self.diameter**2 / 4
        rigidity = STEEL.modulus * math.pi * self.diameter**4 / 64
        return uniform_speed(1, "hinged", self.params.width / self.params.drives, rigidity, STEEL.density * area)

    @property
    def checks(self) -> tuple[Check, ...]:
        """Twist against the looper's window, resonance, critical speed, motor."""
        given, speed = self.params.shafts, self.params.needle.speed
        cure, ids = "set a larger shafts.diameter, more or lighter drives", SHAFT_IDS
        first = min(self.natural_frequency, self.looper_natural_frequency)
        return (
            at_most(
                "twist of a needle against its looper",
                self.timing_error,
                given.twist * max(self.margin, 0.0),
                "deg",
                "share shafts.twist of the timing margin",
            ).with_cure(cure, *ids),
            at_least(
                "torsional frequency over that of the shaft",
                first * turn / speed,
                given.resonance,
                "1",
                "parameter shafts.resonance",
            ).with_cure(cure, *ids),
            at_least(
                "critical speed over the speed", self.whirl / speed, CRITICAL, "1", "hinged between drives; assumed"
            ).with_cure("set more drives", *ids),
            must("a servo turns the shafts", self.motor is not None, "motor table, margin 1.25").with_cure(
                "set a lower needle.speed", MOTOR_ID
            ),
        )


def tufting_shafts(params: TuftingMachineParams, loads: CrankTorques, margin: float, least: float) -> TuftingShafts:
    """The shafts: as given, or the least of stock whose checks hold, else the largest.

    margin  of the looper's timing [rad]      least  diameter that the strength of the main shaft needs [m]
    """
    given = params.shafts
    offered = (given.diameter,) if given.diameter else tuple(size for size in SHAFTS if size >= least)
    tried: TuftingShafts | None = None
    for diameter in offered or (least,):
        tried = _shafts(params, loads, margin, diameter)
        if all(check.ok for check in tried.checks):
            break
    assert tried is not None
    return tried


def _shafts(params: TuftingMachineParams, loads: CrankTorques, margin: float, diameter: float) -> TuftingShafts:
    speed, lags = params.needle.speed, params.needle.phase * np.arange(params.drives)
    torques = {name: np.array([_shifted(torque, lag) for lag in lags]) for name, torque in loads.torques.items()}
    total = np.sum([one.sum(axis=0) for one in torques.values()], axis=0)
    wheel = _flywheel(total, speed, params.shafts.fluctuation)
    pitch = params.width / params.drives
    stations = np.arange(params.drives + 1) * pitch
    required = max(MARGIN * float(np.sqrt(np.mean(total**2))), float(np.max(np.abs(total))) / SERVO_PEAK)
    motor = geared_motor(required, speed, (DIRECT, *PLANETARY), SERVO)
    rotor = motor[0].inertia * motor[1].ratio ** 2 if motor else wheel
    shafts = {}
    for name, torque in torques.items():
        mean, end = np.full((1, torque.shape[1]), torque.sum(axis=0).mean()), max(wheel, loads.inertias[name])
        inertias = np.concatenate(([end], np.full(params.drives, loads.inertias[name])))
        if name == "main":  # the motor beyond the last drive gives the mean; it reaches the loopers by the belt
            modes = torsion_modes(
                np.append(stations, params.width + pitch / 2), np.append(inertias, rotor), diameter, STEEL
            )
            asked = np.concatenate((0 * mean, -torque, mean))
        else:
            modes = torsion_modes(stations, inertias, params.looper.shaft, STEEL)
            asked = np.concatenate((mean, -torque))
        twist = steady_twist(modes, asked, speed, params.shafts.damping)
        shafts[name] = ShaftTorsion(modes, twist[1 : params.drives + 1] - twist[0])
    return TuftingShafts(params, margin, diameter, shafts, wheel, total, motor)


def _shifted(torque: FloatArray, lag: float) -> FloatArray:
    """A torque of a turn at even steps, later by an angle [rad]."""
    if not lag:
        return torque
    order = np.arange(torque.size // 2 + 1)
    return np.asarray(np.fft.irfft(np.fft.rfft(torque) * np.exp(-1j * order * lag), torque.size))


def _flywheel(torque: FloatArray, speed: float, fluctuation: float) -> float:
    """Moment of inertia that keeps the fluctuation of the speed [kg m²]; torque at even steps of a turn."""
    work = np.cumsum(torque - torque.mean()) * turn / torque.size
    return float(flywheel(float(np.ptp(work)), speed, fluctuation))
