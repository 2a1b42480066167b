"""What takes longer than a drag: circuits, mobility by rank, coupler curves, forces against their limits."""

import math
from dataclasses import dataclass, field, replace

import numpy as np

from ilmek.errors import IlmekError
from ilmek.jobs.mechanism.analysis import analysis
from ilmek.jobs.mechanism.run import MechanismRun
from ilmek.jobs.studio.answers import Context
from ilmek.jobs.studio.linkage.answer import LinkageFault
from ilmek.jobs.studio.linkage.motion import RunOptions, mechanism_run
from ilmek.jobs.studio.linkage.part import machine_of_part, solved_part
from ilmek.jobs.studio.linkage.tasks import MechanismRequest, drawn_mechanism, fault_of, plan_of
from ilmek.jobs.studio.words import all_in_page, in_page, spoken
from ilmek.linkage.circuits import Branch, Circuit, circuits
from ilmek.linkage.configuration_path import InputPath
from ilmek.linkage.coupler_curve import coupler_curve
from ilmek.linkage.mobility import mobility
from ilmek.linkage.motion import moving_points
from ilmek.linkage.one_input import OneInput
from ilmek.linkage.status import Status
from ilmek.linkage.structure import solvable_steps
from ilmek.linkage.transmission import transmission_angles
from ilmek.records import JsonObject

MOST_BRANCHES = 5
"""Largest number of branches whose combinations are followed to find circuits."""


@dataclass(frozen=True, slots=True)
class CircuitAnswer:
    """A circuit: its branches in order, values of the input at which it reverses, and at which another one crosses.

    current  whether the mechanism as drawn is on it      closed  whether the path returns to its start
    """

    branches: tuple[Branch, ...]
    dead_centres: tuple[float, ...]
    crossings: tuple[float, ...]
    closed: bool
    current: bool


@dataclass(frozen=True, slots=True)
class SpecialPoint:
    """A point of a coupler curve: value of the input [rad; m] and position [m]."""

    input: float
    x: float
    y: float


@dataclass(frozen=True, slots=True)
class CurveAnswer:
    """A coupler curve over the longest range that closes: length [m], cusps, crossings with itself, inflections."""

    body: str
    point: str
    length: float
    cusps: tuple[SpecialPoint, ...]
    crossings: tuple[SpecialPoint, ...]
    inflections: tuple[SpecialPoint, ...]


@dataclass(frozen=True, slots=True)
class LeastTransmission:
    """The least transmission angle at a pin [rad], and the value of the input there [rad; m]."""

    pin: str
    angle: float
    input: float


@dataclass(frozen=True, eq=False, slots=True)
class QualityAnswer:
    """The quality of a mechanism.

    circuits  with all assemblies; empty where `left_out` states why      mobility  degrees of freedom by count and rank
    checks    as in the JSON of `ilmek mechanism`                        warnings  what is left out, and what to add
    fault     why there is nothing                has_forces  whether there is a mass, a load or friction
    """

    circuits: tuple[CircuitAnswer, ...] = ()
    curves: tuple[CurveAnswer, ...] = ()
    transmission: tuple[LeastTransmission, ...] = ()
    mobility: str = ""
    checks: tuple[JsonObject, ...] = ()
    warnings: tuple[str, ...] = ()
    left_out: tuple[str, ...] = field(default_factory=tuple)
    fault: LinkageFault | None = None
    has_forces: bool = False


def quality(request: MechanismRequest, context: Context) -> QualityAnswer:
    """Circuits, mobility, coupler curves, least transmission angles, and the checks of the command line.

    Of an unfinished mechanism its determined part.
    """
    try:
        drawn = drawn_mechanism(request)
    except IlmekError as error:
        return QualityAnswer(fault=fault_of(error))
    part = solved_part(drawn.mechanism, solvable_steps(drawn.mechanism)[0])
    if not part.inputs:
        return QualityAnswer(fault=LinkageFault("nothing is driven", do="add a drive"))
    machine = machine_of_part(drawn.machine, part)
    options = RunOptions(request.fixed, request.over, request.speed, request.steps, forces=True)
    try:
        run = mechanism_run(machine, plan_of(part), options, drawn.pose)
    except IlmekError as error:
        return QualityAnswer(fault=fault_of(error))
    moved = _moved(run)
    context.progress(0.2)
    found, left_out = _circuits(moved) if moved is not None else ((), ())
    context.progress(0.6)
    checks, warnings = _checks(run, context)
    return QualityAnswer(
        found,
        _curves(run, moved) if moved is not None else (),
        _transmission(run),
        in_page(_mobility(run)),
        checks,
        all_in_page(warnings),
        all_in_page(left_out),
        has_forces=machine.has_forces,
    )


def _moved(run: MechanismRun) -> OneInput | None:
    """The mechanism moved by its driving input; None where others move too."""
    if run.running is None or not run.others_rest:
        return None
    values = run.at(run.values)
    return OneInput(
        run.plan,
        run.running.name,
        {name: float(np.ravel(v)[0]) for name, v in values.items() if name != run.running.name},
    )


def _circuits(moved: OneInput) -> tuple[tuple[CircuitAnswer, ...], tuple[str, ...]]:
    """All circuits, or why they are left out."""
    count = len(moved.plan.mechanism.branches)
    if count > MOST_BRANCHES:
        return (), (f"circuits of {count} branches, {2**count} assemblies; at most {MOST_BRANCHES} branches",)
    try:
        return tuple(_circuit(circuit, dict(moved.plan.mechanism.branches)) for circuit in circuits(moved)), ()
    except IlmekError as error:
        return (), (str(error),)


def _circuit(circuit: Circuit, own: dict[str, int]) -> CircuitAnswer:
    current = any(branch.branches == own for branch in circuit.branches)
    return CircuitAnswer(circuit.branches, circuit.dead_centres, circuit.crossings, circuit.closed, current)


def _curves(run: MechanismRun, moved: OneInput) -> tuple[CurveAnswer, ...]:
    """The coupler curves of the points that are no joints, or of the file's paths."""
    ranges = [(low, high) for low, high in run.closing if high > low]
    joints = {joint.name for joint in run.plan.mechanism.joints}
    points = list(run.machine.paths) or [one for one in moving_points(run.plan.mechanism) if one[1] not in joints]
    if not ranges or not points:
        return ()
    low, high = max(ranges, key=lambda ends: ends[1] - ends[0])
    inside = 0.0 if math.isclose(high - low, 2 * math.pi) else 1e-6 * (high - low)
    try:
        path = InputPath(moved, low + inside, high - inside)
    except IlmekError:
        return ()
    return tuple(_curve(path, body, point) for body, point in points)


def _curve(path: InputPath, body: str, point: str) -> CurveAnswer:
    curve = coupler_curve(path, body, point)
    cusps = tuple(SpecialPoint(cusp.input, cusp.position.real, cusp.position.imag) for cusp in curve.cusps())
    bends = tuple(
        SpecialPoint(inflection.input, inflection.position.real, inflection.position.imag)
        for inflection in curve.inflections()
    )
    crossings = tuple(
        SpecialPoint(crossing.inputs[0], crossing.position.real, crossing.position.imag)
        for crossing in curve.crossings()
    )
    return CurveAnswer(body, point, curve.length(), cusps, crossings, bends)


def _transmission(run: MechanismRun) -> tuple[LeastTransmission, ...]:
    transmissions = []
    for pin, angles in transmission_angles(run.motion, run.machine.transmission).items():
        if np.isfinite(angles).any():
            at = int(np.nanargmin(angles))
            transmissions.append(LeastTransmission(pin, float(angles[at]), float(run.values[at])))
    return tuple(transmissions)


def _mobility(run: MechanismRun) -> str:
    """The mobility in the middle of the samples that close."""
    (good,) = np.nonzero(run.motion.status == Status.OK)
    if not len(good):
        return ""
    try:
        return mobility(run.plan.mechanism, run.motion.pose(int(good[len(good) // 2]))).description
    except IlmekError as error:
        return str(error)


def _checks(run: MechanismRun, context: Context) -> tuple[tuple[JsonObject, ...], tuple[str, ...]]:
    """The checks and warnings of the mechanism, as the command line reports them."""
    try:
        found = analysis(run, context.progress.part(0.6, 0.9, "forces"))
    except IlmekError as error:
        return (), (str(error),)
    shown = (spoken(replace(check, name=in_page(check.name))) for check in found.checks)
    return tuple(check.as_json() for check in shown), found.warnings
