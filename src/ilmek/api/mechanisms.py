"""Mechanisms: built from lengths or read from a file, moved, and their forces."""

from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np

from ilmek.api.slips import by_input, check_lengths, check_turning
from ilmek.arrays import FloatArray, RealField
from ilmek.dynamics import forward, inverse
from ilmek.dynamics.forward_run import Drive, ForwardRun, ForwardState
from ilmek.dynamics.inertia import Inertia
from ilmek.dynamics.inverse import Forces
from ilmek.dynamics.joint_friction import JointFriction
from ilmek.dynamics.loads import Load
from ilmek.dynamics.own_machine import OwnMachine
from ilmek.dynamics.reduced import reduce
from ilmek.errors import MechanismError
from ilmek.io import mechanism_file
from ilmek.io.mechanism_file import MechanismFile
from ilmek.jobs.mechanism.analysis import Analysis, analysis
from ilmek.jobs.mechanism.data import columns
from ilmek.jobs.mechanism.report import report
from ilmek.jobs.mechanism.request import STEPS, MotionRequest
from ilmek.jobs.mechanism.run import run
from ilmek.linkage import fourbar
from ilmek.linkage import solve as linkage
from ilmek.linkage.drawing import as_drawn
from ilmek.linkage.model import Mechanism, Rotation
from ilmek.linkage.motion import Motion
from ilmek.linkage.structure import Plan, plan
from ilmek.records import record
from ilmek.report import Report

Values = RealField | Sequence[float] | Mapping[str, RealField | Sequence[float]]
"""Values of the only input, or of several by name."""

Solvable = Mechanism | MechanismFile | Plan
"""What can be moved. A plan saves its own search where the same mechanism is solved many times."""


def four_bar(
    ground: float,
    crank: float,
    coupler: float,
    rocker: float,
    *,
    branch: int = +1,
    points: Mapping[str, Mapping[str, complex]] | None = None,
    name: str = "four-bar",
) -> Mechanism:
    """A four-bar driven by its crank, from link lengths [m]; pins A0, A, B, B0 with A0 at the origin, B0 on x.

    branch  +1: pin B on the left of A -> B0 (default), -1: on the right
    points  further points [m] by body (ground, crank, coupler, rocker), in the frame at the body's first pin with x
            to the second: `{"rocker": {"E": 0.3}}`

    Raises MechanismError for a length that is not above zero or was probably meant in millimetres.
    """
    check_lengths(MechanismError, name, ground=ground, crank=crank, coupler=coupler, rocker=rocker)
    return fourbar.four_bar(ground, crank, coupler, rocker, branch=branch, points=points, name=name)


def slider_crank(
    crank: float,
    rod: float,
    *,
    offset: float = 0.0,
    branch: int = +1,
    points: Mapping[str, Mapping[str, complex]] | None = None,
    name: str = "slider-crank",
) -> Mechanism:
    """A slider-crank driven by its crank, from lengths [m]; crank A0-A, rod A-B, slider at B on the line y = offset.

    branch  +1: the slider on the side of +x (default), -1: on the other
    points  further points [m] by body (crank, rod, slider), as of `four_bar`

    Raises MechanismError for a length that is not above zero or was probably meant in millimetres.
    """
    check_lengths(MechanismError, name, crank=crank, rod=rod, offset=offset)
    return fourbar.slider_crank(crank, rod, offset=offset, branch=branch, points=points, name=name)


def read_mechanism(path: str | Path) -> MechanismFile:
    """The `mechanism` and the `inertias` of a .toml or .json file; `solve` takes the result as it is.

    Raises MechanismError with file, line and key.
    """
    return mechanism_file.read_mechanism(Path(path))


def write_mechanism(
    path: str | Path, mechanism: Mechanism | OwnMachine, inertias: Mapping[str, Inertia] | None = None
) -> None:
    """Write a mechanism and its inertias, or a machine with its loads and task, to a .toml or .json file.

    Raises MechanismError for another ending; OutputError where the file cannot be written.
    """
    machine = mechanism if isinstance(mechanism, OwnMachine) else OwnMachine(mechanism, inertias or {})
    mechanism_file.write_mechanism(Path(path), machine)


def solve(
    mechanism: Solvable,
    values: Values,
    *,
    speed: Values = 0.0,
    acceleration: Values = 0.0,
    jerk: Values = 0.0,
) -> Motion:
    """Motion of a mechanism for a batch of input values.

    values        of the input [rad; m for a displacement], a number or one value per sample; of several inputs by name
    speed, acceleration, jerk  rates of the input [rad/s, rad/s^2, rad/s^3; m/s, ...], a number or one value per sample

    A sample that cannot be solved does not raise: see `Motion.status`, `Motion.require`. Raises MechanismError for a
    mechanism without a plan, unknown or missing inputs, and angles that were probably meant in degrees.
    """
    planned = planned_of(mechanism)
    rotates = {entry.name: isinstance(entry, Rotation) for entry in planned.mechanism.inputs}
    for name, angles in by_input(values, rotates).items():
        check_turning(name, angles)
    return linkage.solve(planned, _values(values), _values(speed), _values(acceleration), _values(jerk))


def inverse_dynamics(
    motion: Motion,
    inertias: Mapping[str, Inertia],
    loads: Sequence[Load] = (),
    joint_frictions: Sequence[JointFriction] = (),
) -> Forces:
    """Joint forces and drive efforts that a motion requires.

    motion           with speeds and accelerations: from `solve(..., speed=...)`
    inertias         body -> inertia; a body that is not listed is massless
    loads            loads such as `Gravity`, `PointForce`, `Torque`, `Spring`; default: none
    joint_frictions  friction of joints, `ilmek.dynamics.PinFriction`, `SlideFriction`; default: none

    `forces.pin("B")` is the force in a pin [N], `forces.effort("crank")` the torque of the drive [N m].
    Raises MechanismError for an unknown body or joint. A sample that cannot be solved does not raise.
    """
    return inverse.inverse(motion, inertias, loads, joint_frictions)


def simulate(
    mechanism: Solvable,
    inertias: Mapping[str, Inertia],
    duration: float,
    *,
    position: float = 0.0,
    speed: float = 0.0,
    drive: Drive | None = None,
    loads: Sequence[Load] = (),
    flywheel: float = 0.0,
    every: float | None = None,
) -> ForwardRun:
    """Run of a mechanism with one input from a state, under its drive and loads (forward dynamics).

    inertias  body -> inertia; a body that is not listed is massless
    duration  [s]
    position, speed  of the input at the start [rad, rad/s; m, m/s]
    drive     effort on the input [N m; N] as a function of time, position and speed; default: the machine coasts
    loads     loads such as `Gravity`; default: none
    flywheel  inertia that moves with the input [kg m²; kg for a sliding input]
    every     time between the reported samples [s]; default: the steps of the integrator

    Raises MechanismError for several inputs, no moving mass, a start at which the mechanism does not close, and values
    that are not finite.
    """
    planned = planned_of(mechanism)
    if any(isinstance(entry, Rotation) for entry in planned.mechanism.inputs):
        check_turning(planned.mechanism.inputs[0].name, position)
    reduced = reduce(planned, inertias, loads, flywheel=flywheel)
    return forward.forward(reduced, ForwardState(position, speed), duration, drive=drive, every=every)


@record
class MachineRun:
    """An own machine in motion: what `ilmek mechanism` reports of it.

    analysis  motion, forces, strength, servo, study and forward run, as far as the machine states them
    report    results by name (`run.report["drive_torque_max"]`), checks, tables, figures
    """

    analysis: Analysis
    report: Report

    @property
    def motion(self) -> Motion:
        """The motion over the range."""
        return self.analysis.run.motion

    @property
    def forces(self) -> Forces | None:
        """Joint forces and drive efforts by sample; None without masses, loads and friction."""
        found = self.analysis.run.forces
        return None if found is None else found.forces

    @property
    def table(self) -> dict[str, FloatArray]:
        """All columns of `--csv` by heading, SI and radians."""
        return columns(self.analysis)


def run_machine(
    machine: OwnMachine | MechanismFile | Mechanism | str | Path,
    *,
    over: tuple[float, float] | str = "",
    speed: float | str = "",
    steps: int = STEPS,
    fixed: Mapping[str, float | str] | None = None,
) -> MachineRun:
    """Motion, forces and strength of an own machine over a range of its driving input, as `ilmek mechanism` gives them.

    machine  a file or its path, a machine, or a mechanism
    over     range of the driving input [rad; m], or a text like "0deg..180deg"; default: a full turn
    speed    of the driving input [rad/s; m/s], or a text like "150rpm"; default: that of the machine, else 1
    steps    of the range
    fixed    input -> value [rad; m] or text; with all inputs fixed one pose is computed; default: none

    Raises MechanismError, as for a range in which the mechanism closes nowhere; UnitError for a text that is no
    quantity.
    """
    if isinstance(machine, str | Path):
        machine = read_mechanism(machine)
    if isinstance(machine, Mechanism):
        machine = OwnMachine(as_drawn(machine))
    file = machine if isinstance(machine, MechanismFile) else MechanismFile(machine)
    texts = {name: value if isinstance(value, str) else repr(float(value)) for name, value in (fixed or {}).items()}
    reach = over if isinstance(over, str) else f"{float(over[0])!r}..{float(over[1])!r}"
    pace = speed if isinstance(speed, str) else repr(float(speed))
    found = analysis(run(file, MotionRequest(texts, reach, pace, steps)))
    return MachineRun(found, report(found))


def planned_of(mechanism: Solvable) -> Plan:
    """The plan of a mechanism. Raises MechanismError where it has none, or for another object."""
    if isinstance(mechanism, Plan):
        return mechanism
    if isinstance(mechanism, MechanismFile):
        return mechanism.plan()
    if isinstance(mechanism, Mechanism):
        return plan(as_drawn(mechanism))
    raise MechanismError(
        f"{type(mechanism).__name__} given for a mechanism",
        allowed="a Mechanism, the result of `read_mechanism`, or a plan",
    )


def _values(values: Values) -> linkage.InputValues:
    """Sequences as arrays."""
    if isinstance(values, Mapping):
        return {name: _array(one) for name, one in values.items()}
    return _array(values)


def _array(values: RealField | Sequence[float]) -> RealField:
    return np.asarray(values, dtype=float) if isinstance(values, Sequence) else values
