"""What is computed of a mechanism in motion beyond its forces: servo, strength, forward run, study of speeds."""

from collections.abc import Iterator
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from ilmek.dynamics.equations import STILL
from ilmek.dynamics.inverse import joint_rate
from ilmek.dynamics.inverse_run import InverseRun
from ilmek.dynamics.machine_balance import MachineBalance, machine_balance
from ilmek.dynamics.machine_checks import determined, locking
from ilmek.dynamics.machine_strength import MachineStrength, machine_strength
from ilmek.dynamics.own_machine import OwnMachine
from ilmek.dynamics.servo_choice import ServoChoice, servo_choice
from ilmek.dynamics.speed_study import StudyOfSpeeds, speed_study
from ilmek.errors import MechanismError
from ilmek.jobs.mechanism.pair_checks import grip, pressed, standing
from ilmek.jobs.mechanism.run import MechanismRun
from ilmek.linkage.solve import solve
from ilmek.linkage.status import Status
from ilmek.linkage.transmission import transmission_angles
from ilmek.progress import SILENT, Progress
from ilmek.records import record
from ilmek.report import Check, at_least, at_most

if TYPE_CHECKING:
    from ilmek.arrays import FloatArray
    from ilmek.dynamics.own_forward import OwnForward

BALANCE, ENERGY = 1e-9, 1e-6
"""Greatest relative residual of the balances of power and forces, and of the energy of a forward run."""

SHOWN = 4
"""Number of dead centres listed in a check."""

HINT = "motion only: for forces give bodies a mass (mass, centre, moment), or the machine loads"


@record
class Analysis:
    """A mechanism in motion with all that its file requires.

    transmission  pin -> acute transmission angle [rad] by sample
    servo, strength, forward, study  None: not required
    start_strength  strength over the forward run; None: not required
    balance  best counterweight and flywheel; None: not required
    """

    run: MechanismRun
    transmission: "dict[str, FloatArray]"
    servo: ServoChoice | None
    strength: MachineStrength | None
    forward: "OwnForward | None"
    study: StudyOfSpeeds | None
    start_strength: MachineStrength | None = None
    balance: MachineBalance | None = None

    @property
    def checks(self) -> tuple[Check, ...]:
        """What the machine must do: close, keep moving under friction, carry its forces, run as long as its task."""
        forces, servo = self.run.forces, self.servo.checks if self.servo else ()
        locked = (*locking(forces), *determined(self.run.machine, forces)) if forces is not None else ()
        strength = self.strength.checks if self.strength else ()
        started = self.start_strength.transient_checks if self.start_strength else ()
        started = tuple(replace(check, name=f"forward run: {check.name}") for check in started)
        ended = self.forward.checks if self.forward else ()
        failed = tuple(test for test in self.self_tests if not test.ok)
        return (
            *self._closes,
            *standing(self.run),
            *self._defined,
            *self._driven,
            *pressed(self.run),
            *grip(self.run),
            *locked,
            *strength,
            *ended,
            *started,
            *servo,
            *failed,
        )

    @property
    def _closes(self) -> tuple[Check, ...]:
        """Whether it closes over all of its range, where that is required."""
        if not self.run.required or self.run.running is None:
            return ()
        cure = "change a link's length, or the range: --over FROM..TO"
        return (
            at_least("closes over its range", self.run.closed_share, 1.0, "%", "range of the drive").with_cure(cure),
        )

    @property
    def _defined(self) -> tuple[Check, ...]:
        """Whether velocities and forces exist at every value of the drive at which it closes."""
        if self.run.running is None:
            return ()
        values = self.run.undefined
        listed = ", ".join(self.run.shown(value) for value in values[:SHOWN])
        more = f" and {len(values) - SHOWN} further" if len(values) > SHOWN else ""
        where = f"; not at {self.run.running.name} = {listed}{more}" if values else ""
        source = f"velocities and forces exist where the drive determines the motion{where}"
        cure = "change a link's length, drive another body, or keep away from it: --over FROM..TO"
        return (at_most("dead centres in its range", len(values), 0, "1", source).with_cure(cure),)

    @property
    def _driven(self) -> tuple[Check, ...]:
        """Whether an actuator that moves the only input drives it everywhere: at a dead centre no effort of it does."""
        run, names = self.run, self.run.machine.actuators
        if run.running is None or len(names) != 1:
            return ()
        unit = solve(run.plan, run.at(run.values), {run.running.name: 1.0})
        moved = joint_rate(unit, names[0])[unit.status == Status.OK]
        sign = np.where(np.abs(moved) > STILL * np.abs(moved).max(initial=0.0), np.sign(moved), 0.0)
        dead = int(np.count_nonzero(sign[1:] * sign[:-1] < 0) + np.count_nonzero((sign == 0) & (np.roll(sign, 1) != 0)))
        source = "its joint moves wherever the input does"
        cure = "put the motor at another joint, or keep away from there: --over FROM..TO"
        return (at_most(f"dead centres of actuator {names[0]}", dead, 0, "1", source).with_cure(cure),)

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
        if self.strength is not None and self.strength.links:
            balance = self.strength.balance
            tests.append(at_most("link_residual", balance, BALANCE, "1", "balance of each link, relative"))
        if self.forward is not None:
            energy = self.forward.forward_energy_residual
            tests.append(at_most("forward_energy_residual", energy, ENERGY, "1", "energy against work, relative"))
            effort = self.forward.effort_error
            tests.append(at_most("forward_effort_residual", effort, ENERGY, "1", "drive against inverse dynamics"))
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
        for value in run.closed.change_points if run.closed is not None else ():
            yield f"two assemblies meet at {run.shown(value)}: the motion is uncertain there"
        if run.left_out:
            yield run.left_out
        unknown = run.forces.forces.undetermined if run.forces is not None else None
        if unknown:
            names = ", ".join(name for name in unknown.listed if name not in unknown.couplings) or "none but its own"
            yield f"not determined without {unknown.cause}: the forces of {names}"
        if not run.machine.has_forces:
            yield HINT
        if run.assumed and run.forces is not None:
            yield f"no speed is given: forces at {run.speed:g} {'rad/s' if run.unit == 'deg' else 'm/s'}; give --speed"
        if run.machine.frictions and run.forces is not None and not run.forces.forces.frictions:
            yield "the friction of joints is left out: the inputs stand still; give --speed"


def analysis(run: MechanismRun, progress: Progress = SILENT) -> Analysis:
    """All that the file requires of a mechanism in motion; of a single pose forces and strength alone.

    Raises MechanismError, as for a servo at an input that slides; Cancelled.
    """
    machine, forces = run.machine, run.forces
    strength = machine_strength(machine, forces) if forces is not None else None
    angles = transmission_angles(run.motion, machine.transmission)
    if run.running is None:
        return Analysis(run, angles, None, strength, None, None)
    forward, started = None, None
    if machine.forward is not None:
        from ilmek.dynamics.own_forward import own_forward  # the integrator of scipy

        forward = own_forward(machine, run.plan, machine.forward)
        started = machine_strength(machine, forward.inverse)
    balance = _balance(run)
    progress(0.5)
    servo = _servo(machine, forces) if machine.servo and forces is not None and forces.time is not None else None
    return Analysis(
        run, angles, servo, strength, forward, _study(run, progress.part(0.5, 1.0, "study")), started, balance
    )


def _balance(run: MechanismRun) -> MachineBalance | None:
    """The balance of a machine; None: not required. Raises MechanismError where it has none."""
    if run.fluctuation is None:
        return None
    if run.forces is None or run.speed is None:
        raise MechanismError("balance without masses at constant speed", do="give bodies a mass, and --speed")
    return machine_balance(run.forces, run.speed, run.fluctuation)


def _servo(machine: OwnMachine, forces: InverseRun) -> ServoChoice | None:
    """The servo of a machine; None where its effort is known at no sample."""
    effort = forces.forces.efforts.get(str(machine.servo))
    return servo_choice(machine, forces) if effort is None or np.isfinite(effort).any() else None


def _study(run: MechanismRun, progress: Progress) -> StudyOfSpeeds | None:
    """The machine at the speeds of its study. Raises MechanismError where it has no drive of constant speed."""
    task = run.machine.study
    if task is None or run.forces is None:
        return None
    if run.speed is None or not run.others_rest:
        given = "a study of speeds is given for a machine without one driving input of constant speed"
        raise MechanismError(given, do="leave out the study, or fix the other inputs with --at")

    def at(speed: float) -> tuple[InverseRun, tuple[Check, ...]]:
        progress(0.0)
        found = run.at_speed(speed)
        strength = machine_strength(run.machine, found)
        return found, (*locking(found), *(strength.checks if strength else ()))

    return speed_study(task.speeds, at)
