"""What a mechanism with masses, loads and friction needs at constant speed, computed when it is asked for."""

from dataclasses import dataclass
from functools import cached_property

from ilmek.arrays import FloatArray
from ilmek.dynamics.balance import Shaking
from ilmek.dynamics.inverse import Forces
from ilmek.dynamics.inverse_run import InverseRun, friction_power, inverse_run
from ilmek.dynamics.machine_balance import MachineBalance, machine_balance
from ilmek.dynamics.own_machine import OwnMachine
from ilmek.errors import MechanismError
from ilmek.linkage.judged import JudgedMechanism

FLUCTUATION = 0.02
"""Default of (omega_max - omega_min) / omega [1]; assumed by this project."""


@dataclass(frozen=True, eq=False, repr=False)
class JudgedMachine(JudgedMechanism):
    """A judged mechanism with its masses, loads and friction, at a constant speed of its input.

    machine  mechanism, masses, loads, friction      speed  of the input [rad/s; m/s]

    All forces are at the samples of `motion`, over the range of the input.

    >>> from ilmek import bar, four_bar, judged
    >>> linkage = four_bar(0.300, 0.060, 0.200, 0.230)
    >>> beat_up = judged(linkage, inertias={"rocker": bar(0, 0.230, mass=0.4)}, speed="150rpm")
    >>> round(float(abs(beat_up.shaking.force).max()), 2), round(beat_up.balance().flywheel_inertia, 6)
    (4.04, 0.01373)
    """

    machine: OwnMachine
    speed: float

    @cached_property
    def run(self) -> InverseRun:
        """Forces, powers and their greatest values, as `ilmek mechanism` reports them.

        Raises MechanismError without masses, loads and friction, and at speed 0.
        """
        if not (self.machine.has_forces and self.speed):
            missing = "speed" if self.speed == 0 else "mass, load or friction"
            given = f"{self.mechanism.name} is judged without a {missing}"
            raise MechanismError(given, do="give judged inertias and a speed")
        motion = self.moved.motion(self.values, self.speed)
        return inverse_run(self.machine, motion, self.moved.name, (self.values - self.values[0]) / abs(self.speed))

    @property
    def forces(self) -> Forces:
        """Joint forces and drive efforts, friction of joints included."""
        return self.run.forces

    @property
    def shaking(self) -> Shaking:
        """Shaking force [N] and moment about the ground's origin [N m] of the moving masses."""
        return self.run.shaking

    @property
    def on_frame(self) -> Shaking:
        """Force [N] and moment [N m] of all joints and drives on the frame, with gravity and loads."""
        return self.run.frame

    @property
    def friction_power(self) -> FloatArray | None:
        """Power lost to friction of joints [W]; None without friction."""
        return friction_power(self.forces)

    def balance(self, fluctuation: float = FLUCTUATION) -> MachineBalance:
        """The best counterweight on the crank, and the flywheel that keeps a fluctuation of the speed [1].

        Raises MechanismError where no crank on the ground turns fully.
        """
        return machine_balance(self.run, self.speed, fluctuation)

    def flywheel(self, fluctuation: float = FLUCTUATION) -> float:
        """Moment of inertia on the crank [kg m²] that keeps a fluctuation of its speed [1]; raises as `balance`."""
        return self.balance(fluctuation).flywheel_inertia
