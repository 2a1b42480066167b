"""What is computed of a mechanism in motion beyond its forces: servo, strength, forward run, study of speeds."""

from collections.abc import Iterator
from typing import TYPE_CHECKING

from ilmek.dynamics.servo_choice import ServoChoice, servo_choice
from ilmek.errors import MechanismError
from ilmek.jobs.mechanism.run import MechanismRun
from ilmek.linkage.transmission import transmission_angles
from ilmek.progress import SILENT, Progress
from ilmek.records import record
from ilmek.report import Check, at_most, must

if TYPE_CHECKING:
    from ilmek.arrays import FloatArray
    from ilmek.dynamics.own_forward import OwnForward

BALANCE, ENERGY = 1e-9, 1e-6
"""Greatest relative residual of the balances of power and forces, and of the energy of a forward run."""


HINT = "motion only: for forces give bodies a mass (mass, centre, moment), or the machine loads"


@record
class Analysis:
    """A mechanism in motion with all that its file requires.

    transmission  pin -> acute transmission angle [rad] by sample
    servo, forward  None: not required
    """

    run: MechanismRun
    transmission: "dict[str, FloatArray]"
    servo: ServoChoice | None
    forward: "OwnForward | None"

    @property
    def checks(self) -> tuple[Check, ...]:
        """What the machine must do: keep moving under friction, carry its forces, have a sufficient servo."""
        servo = self.servo.checks if self.servo else ()
        return (*self._locking, *servo, *(test for test in self.self_tests if not test.ok))

    @property
    def _locking(self) -> tuple[Check, ...]:
        forces = self.run.forces
        if forces is None or not forces.forces.frictions:
            return ()
        locked = self.run.values[forces.locked] if self.run.running else forces.locked.nonzero()[0]
        where = (
            f"; it locks from {self.run.shown(locked.min())} to {self.run.shown(locked.max())}" if locked.size else ""
        )
        source = f"the drive keeps it moving against the friction of its joints{where}"
        cure = "lower the friction, lengthen the guides, or improve the transmission angle there"
        return (must("not self-locking", not locked.size, source, cure=cure),)

    @property
    def self_tests(self) -> tuple[Check, ...]:
        """Balances of power and of the forces on the frame; energy of the forward run."""
        tests = []
        if self.run.forces is not None:
            forces = self.run.forces
            tests.append(at_most("power_residual", forces.power_residual, BALANCE, "1", "virtual power, relative"))
            tests.append(
                at_most("frame_residual", forces.balance, BALANCE, "1", "Newton and Euler for the whole, relative")
            )
        if self.forward is not None:
            energy = self.forward.forward_energy_residual
            tests.append(at_most("forward_energy_residual", energy, ENERGY, "1", "energy against work, relative"))
        return tuple(tests)

    @property
    def warnings(self) -> tuple[str, ...]:
        """What is left out, and what to add."""
        return tuple(self._warnings())

    def _warnings(self) -> Iterator[str]:
        run = self.run
        try:
            run.motion.require()
        except MechanismError as error:
            yield str(error)
        if run.left_out:
            yield run.left_out
        if not run.machine.has_forces:
            yield HINT
        if run.machine.frictions and run.forces is not None and not run.forces.forces.frictions:
            yield "the friction of joints is left out: the inputs stand still; give --speed"
        if run.machine.frictions and self.forward is not None:
            yield "the friction of joints is not part of the forward run; give a damper for its losses"


def analysis(run: MechanismRun, progress: Progress = SILENT) -> Analysis:
    """All that the file requires of a mechanism in motion. Raises MechanismError; Cancelled."""
    machine, forces = run.machine, run.forces
    forward = None
    if machine.forward is not None:
        from ilmek.dynamics.own_forward import own_forward  # the integrator of scipy

        forward = own_forward(machine, run.plan, machine.forward)
    progress(1.0)
    return Analysis(
        run,
        transmission_angles(run.motion, machine.transmission),
        servo_choice(machine, forces) if machine.servo and forces is not None else None,
        forward,
    )
