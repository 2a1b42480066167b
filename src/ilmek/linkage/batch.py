"""Large batches and searches: the motions of `solve`, by compiled code.

`solve_batch` has the results of `solve`, for one mechanism at very many samples. `sweep` moves very many variants of
one plan, whose points are arrays, over one motion of the inputs: the inner loop of a search for dimensions.

Importing this module imports the compiler (a quarter of a second; the kernels themselves are kept on disk after their
first run), which pays from about 10^5 samples on; no other module of the package imports it. So the caller
chooses between the two executors, and the last digits of results do not depend on the length of the batch.

Driven bodies and all dyads with closed forms are compiled; `solve_batch` uses `solve` for plans with other groups.

>>> from ilmek.linkage.fourbar import four_bar
>>> from ilmek.linkage.structure import plan
>>> rockers = {("rocker", "B"): np.array([0.22, 0.23, 0.24])}
>>> swept = sweep(plan(four_bar(0.3, 0.06, 0.2, 0.23, branch=+1)), rockers, np.linspace(0, 6, 100), bodies=["rocker"])
>>> np.ptp(np.angle(swept.bodies["rocker"].direction), axis=1).round(3)
array([0.554, 0.528, 0.506])
"""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace

import numpy as np

from ilmek.arrays import Bool, Complex, ComplexArray, ComplexField, Float, FloatArray, Int8, RealField
from ilmek.errors import MechanismError
from ilmek.linkage import structure
from ilmek.linkage.body_motion import PointMotion
from ilmek.linkage.executor import DOUBTFUL, Statuses, executor
from ilmek.linkage.groups.group import Columns, InputMotion, Step
from ilmek.linkage.groups.shift import DrivenSlider
from ilmek.linkage.groups.turn import DrivenCrank
from ilmek.linkage.kernels import ALPHA, CARRY, DIRECTION, OMEGA, Instruction
from ilmek.linkage.model import GROUND, Body
from ilmek.linkage.motion import Motion
from ilmek.linkage.solve import InputValues, drives_of, solve, without_infinite
from ilmek.linkage.status import Status
from ilmek.linkage.structure import Plan
from ilmek.linkage.tape import Dimensions, Tape
from ilmek.records import record


@record
class BodyRotation:
    """A body's turning, (variants, samples): direction e^{i theta}, omega [rad/s], alpha [rad/s^2]."""

    direction: Complex[np.ndarray, "variants samples"]
    omega: Float[np.ndarray, "variants samples"]
    alpha: Float[np.ndarray, "variants samples"]


@record
class Sweep:
    """The motions of many variants of one mechanism.

    bodies  the requested bodies, by name        points  the requested points, by (body, point): (variants, samples)
    status  Status of each variant and sample (int8)
    margin  least distance from a dead centre over the samples and dyads, 0 at a dead centre: sine of the transmission
            angle (RRR, RRP), distance along the slide relative to the mechanism's size (RPR), sine of the angle between
            the lines (PRP). Open samples do not count, see `status`
    """

    bodies: Mapping[str, BodyRotation]
    points: Mapping[tuple[str, str], PointMotion]
    status: Int8[np.ndarray, "variants samples"]
    margin: Float[np.ndarray, " variants"]


@record
class BatchArrays:
    """Arrays for the results of `solve_batch`, made once and used again: new memory costs more than the solution.

    points  (1, complex columns, samples)    reals  (1, real columns, samples)    status  (1, samples)
    """

    points: Complex[np.ndarray, "variants pairs samples"]
    reals: Float[np.ndarray, "variants singles samples"]
    status: Int8[np.ndarray, "variants samples"]


def batch_arrays(plan: Plan, samples: int) -> BatchArrays:
    """Arrays for `solve_batch` of this plan at a number of samples.

    Raises MechanismError for a plan with a group that is not compiled.
    """
    pairs, singles = _requested(plan, _tape(plan, {}, {}))
    return _arrays(1, len(pairs), len(singles), samples)


def solve_batch(
    plan: Plan,
    angle: InputValues,
    speed: InputValues = 0.0,
    acceleration: InputValues = 0.0,
    *,
    into: BatchArrays | None = None,
) -> Motion:
    """Motion of the mechanism for a large batch of input values: `solve`, by compiled code.

    Arguments, result and errors are those of `solve`. The numbers agree to 1e-13 of their magnitude; beyond 1e6 rad to
    the rounding of the angle.

    into  `batch_arrays` of the same plan and number of samples, overwritten: the motion of an earlier call that has
          them is no longer valid. Default: new arrays. Not used for a plan with a group that is not compiled

    >>> from ilmek.linkage.fourbar import four_bar
    >>> from ilmek.linkage.structure import plan
    >>> planned, angle = plan(four_bar(0.3, 0.06, 0.2, 0.23, branch=+1)), np.linspace(0, 6, 100)
    >>> arrays = batch_arrays(planned, 100)
    >>> [round(float(solve_batch(planned, angle, w, into=arrays).omega("rocker").max()), 3) for w in (1.0, 2.0)]
    [0.268, 0.536]
    """
    if any(step.instruction is None for step in plan.steps):
        return solve(plan, angle, speed, acceleration)
    drives = drives_of(plan, angle, speed, acceleration)
    written = _tape(plan, {}, {})
    answer = _run(written, drives, _requested(plan, written), arrays=into)
    columns = {body: _columns(written, step, body, drives, answer) for step in plan.steps for body in step.bodies}
    doubtful = answer.status[0] == DOUBTFUL
    if doubtful.any():
        answer.status[0, doubtful] = _decided(plan, drives, doubtful)
    return Motion(plan, drives, without_infinite(columns, answer.status[0]), answer.status[0])


def sweep(
    plan: Plan,
    dimensions: Dimensions,
    angle: InputValues,
    speed: InputValues = 0.0,
    acceleration: InputValues = 0.0,
    *,
    branches: Mapping[str, RealField] | None = None,
    bodies: Iterable[str] = (),
    points: Iterable[tuple[str, str]] = (),
) -> Sweep:
    """Motion of many variants of a mechanism over one motion of its inputs.

    dimensions  (body, point) -> position of the point in the body's frame [m] in each variant: arrays of one length,
                or numbers; default: the points of the plan's mechanism. The angles of its slides do not vary
    branches    free pin's name -> +1 or -1 in each variant; default: the branches of the plan's mechanism
    bodies, points  the requested results, see `Sweep`
    angle, speed, acceleration  as for `solve`

    Raises MechanismError for unknown names, arrays of different lengths, positions that are not finite, links
    of zero length, a plan with a group that is not compiled, and as `solve`.
    """
    drives, bodies, points = drives_of(plan, angle, speed, acceleration), tuple(bodies), tuple(points)
    branches = branches or {}
    variants = _variants(plan, dimensions, branches)
    written = _tape(plan, dimensions, branches)
    rows = [written.rows[plan.mechanism.body(body).name] for body in bodies]
    pairs, singles = [row + DIRECTION for row in rows], [row + rate for row in rows for rate in (OMEGA, ALPHA)]
    for body, point in points:
        plan.mechanism.point(body, point)
        to = written.room(6)
        written.carry(body, written.point(body, point), to)
        pairs += [to, to + 2, to + 4]
    answer = _run(written, drives, (pairs, singles), variants, judged=True)
    for variant in np.flatnonzero((answer.status == DOUBTFUL).any(axis=1)):
        doubtful = answer.status[variant] == DOUBTFUL
        one = _variant(plan, dimensions, branches, int(variant))
        answer.status[variant, doubtful] = _decided(one, drives, doubtful)
    turning = {
        body: BodyRotation(answer.pair(row + DIRECTION), answer.single(row + OMEGA), answer.single(row + ALPHA))
        for body, row in zip(bodies, rows, strict=True)
    }
    moved = {
        one: _in_world([answer.pair(row) for row in pairs[len(rows) + 3 * k :][:3]], written.at[GROUND])
        for k, one in enumerate(points)
    }
    return Sweep(turning, moved, answer.status, answer.margin)


def _in_world(moved: list[ComplexArray], origin: ComplexField) -> PointMotion:
    """A point's motion from that about the ground's anchor, which is at `origin` [m], one or one per variant."""
    position, velocity, acceleration = moved
    return PointMotion(position + np.reshape(origin, (-1, 1)), velocity, acceleration)


def _decided(plan: Plan, drives: Mapping[str, InputMotion], doubtful: Bool[np.ndarray, " samples"]) -> Statuses:
    """Status of some samples, by `solve`."""
    parts = {name: drive.part(doubtful) for name, drive in drives.items()}
    values, speeds, accelerations = (
        {name: getattr(part, order) for name, part in parts.items()} for order in ("value", "speed", "acceleration")
    )
    return solve(plan, values, speeds, accelerations).status


def _variant(plan: Plan, dimensions: Dimensions, branches: Mapping[str, RealField], variant: int) -> Plan:
    """The plan of one variant."""

    def own(field: ComplexField) -> complex:
        return complex(np.ravel(field)[variant if np.ndim(field) else 0])

    mechanism = plan.mechanism
    bodies = tuple(
        Body(body.name, {name: own(dimensions.get((body.name, name), at)) for name, at in body.points.items()})
        for body in mechanism.bodies
    )
    signs = {pin: int(own(branches.get(pin, sign)).real) for pin, sign in mechanism.branches.items()}
    return structure.plan(replace(mechanism, bodies=bodies, branches=signs))


@dataclass(frozen=True, slots=True)
class _Answer:
    """The requested rows by index, each (variants, samples); an empty margin where it is not requested."""

    pairs: Mapping[int, int]
    singles: Mapping[int, int]
    points: ComplexArray
    reals: FloatArray
    status: Int8[np.ndarray, "variants samples"]
    margin: FloatArray

    def pair(self, row: int) -> Complex[np.ndarray, "variants samples"]:
        return self.points[:, self.pairs[row]]

    def single(self, row: int) -> Float[np.ndarray, "variants samples"]:
        return self.reals[:, self.singles[row]]


def _run(
    written: Tape,
    drives: Mapping[str, InputMotion],
    requested: tuple[list[int], list[int]],
    variants: int = 1,
    *,
    judged: bool = False,
    arrays: BatchArrays | None = None,
) -> _Answer:
    """The tape run for all variants and samples; default of the arrays: new ones."""
    pairs, singles = ({row: k for k, row in enumerate(dict.fromkeys(rows))} for rows in requested)
    inputs = list(drives.values())
    values = inputs[0].value if len(inputs) == 1 else np.stack([np.asarray(one.value) for one in inputs])
    values = np.ascontiguousarray(values, dtype=float).reshape(len(inputs), -1)
    fields = [np.atleast_1d(rate) for one in inputs for rate in (one.speed, one.acceleration)]
    rates = np.stack(np.broadcast_arrays(*fields)).astype(float).reshape(len(inputs), 2, -1)
    samples = values.shape[1]
    arrays = arrays or _arrays(variants, len(pairs), len(singles), samples)
    rows = arrays.points.shape, arrays.reals.shape
    if rows != ((variants, len(pairs), samples), (variants, len(singles), samples)):
        raise MechanismError("the arrays belong to another plan or number of samples", do="make them by batch_arrays")
    arrays.status[:] = Status.OK
    margin = np.full(variants if judged else 0, np.inf)
    answer = _Answer(pairs, singles, arrays.points, arrays.reals, arrays.status, margin)
    lists = np.array(list(pairs), dtype=np.int64), np.array(list(singles), dtype=np.int64)
    instructions = _instructions()
    executor(instructions)(
        written.height,
        *written.stack(instructions, variants),
        np.broadcast_to(written.span, variants).astype(float),
        values,
        rates,
        *lists,
        answer.points,
        answer.reals,
        answer.status,
        answer.margin,
    )
    return answer


def _instructions() -> tuple[Instruction, ...]:
    """Those of all groups, whatever plan is run: one executor is compiled."""
    own = [group.instruction for group in structure.GROUPS if group.instruction is not None]
    return tuple(dict.fromkeys((CARRY, *own)))


def _tape(plan: Plan, dimensions: Dimensions, branches: Mapping[str, RealField]) -> Tape:
    """The plan's steps as instructions; default of `dimensions` and `branches`: the values of the plan.

    Raises MechanismError for a step that has no compiled form, and a link of zero length.
    """
    written = Tape(plan.mechanism, dimensions, branches)
    for step in plan.steps:
        step.write(written)
    return written


def _requested(plan: Plan, written: Tape) -> tuple[list[int], list[int]]:
    """The rows of all columns of a plan's motion, complex and real."""
    kept = [_rows_kept(written, step, body) for step in plan.steps for body in step.bodies]
    pairs, singles = (list(dict.fromkeys(row for rows in kept for row in rows[which])) for which in (0, 1))
    return pairs, singles


def _arrays(variants: int, pairs: int, singles: int, samples: int) -> BatchArrays:
    """New arrays for so many rows."""
    return BatchArrays(
        np.empty((variants, pairs, samples), dtype=complex),
        np.empty((variants, singles, samples)),
        np.empty((variants, samples), dtype=np.int8),
    )


def _rows_kept(written: Tape, step: Step, body: str) -> tuple[list[int], list[int]]:
    """The rows of a body's columns, complex and real, that are not the inputs' own."""
    row = written.rows[body]
    if isinstance(step, DrivenSlider):
        return [], []
    if body in written.travel:
        return [], [written.travel[body] + order for order in range(3)]
    return [row + DIRECTION], [] if _is_free(step) else [row + OMEGA, row + ALPHA]


def _columns(written: Tape, step: Step, body: str, drives: Mapping[str, InputMotion], answer: _Answer) -> Columns:
    """A body's columns, equal to those of its step."""
    if isinstance(step, DrivenSlider):
        drive = drives[step.entry]
        return drive.value, drive.speed, drive.acceleration
    pairs, singles = _rows_kept(written, step, body)
    columns = (*(answer.pair(row)[0] for row in pairs), *(answer.single(row)[0] for row in singles))
    if isinstance(step, DrivenCrank) and _is_free(step):
        drive = drives[step.entry]
        return (*columns, step.sign * drive.speed, step.sign * drive.acceleration)
    return columns


def _is_free(step: Step) -> bool:
    """Whether a body is driven against the ground, so that its rates are the input's."""
    return isinstance(step, DrivenCrank) and step.carrier == GROUND


def _variants(plan: Plan, dimensions: Dimensions, branches: Mapping[str, RealField]) -> int:
    """Common length of all arrays, checked."""
    for (body, point), positions in dimensions.items():
        plan.mechanism.point(body, point)
        if not np.isfinite(positions).all():
            raise MechanismError(f"point {point!r} of body {body!r} is not finite in every variant")
    for pin, signs in branches.items():
        plan.mechanism.joint(pin)
        if not np.isin(signs, (-1, 1)).all():
            raise MechanismError(f"branch of {pin!r} is not +1 or -1 in every variant", allowed="+1 or -1")
    shapes = {np.shape(one) for one in (*dimensions.values(), *branches.values()) if np.ndim(one)} or {(1,)}
    if len(shapes) > 1 or len(min(shapes)) != 1:
        listed = " and ".join(str(shape) for shape in sorted(shapes))
        raise MechanismError(
            f"dimensions have arrays of shapes {listed}", allowed="one-dimensional arrays of one length"
        )
    return int(min(shapes)[0])
