"""The motion of a mechanism from its plan and the motion of its inputs.

The batch is computed in blocks that fit the processor's cache. Samples do not depend on one another.
"""

from collections.abc import Mapping

import numpy as np

from ilmek.arrays import Int8, RealField
from ilmek.errors import MechanismError
from ilmek.linkage.anchors import anchors
from ilmek.linkage.groups.general import GeneralGroup
from ilmek.linkage.groups.group import Columns, InputMotion
from ilmek.linkage.judgement import judge
from ilmek.linkage.model import GROUND
from ilmek.linkage.motion import Motion
from ilmek.linkage.solution import local_starts, solved_steps
from ilmek.linkage.structure import Plan
from ilmek.progress import SILENT, Progress

BLOCK = 16384
"""Samples per block: enough to make calls cheap, few enough for the second-level cache."""

NEWTON_BLOCK = 1 << 15
"""Largest number of samples per block with a group for Newton's method, which first follows the path from the
mechanism's pose."""

NEWTON_MEMORY = 60_000_000
"""Largest size of the matrices of a block [bytes]; a group of 5 bodies reaches it with `NEWTON_BLOCK` samples."""

InputValues = RealField | Mapping[str, RealField]
"""One input's values, or several inputs' by name: a rotation's by its body, a displacement's by its slide."""


def solve(
    plan: Plan,
    angle: InputValues,
    speed: InputValues = 0.0,
    acceleration: InputValues = 0.0,
    jerk: InputValues = 0.0,
    *,
    progress: Progress = SILENT,
) -> Motion:
    """Motion of the mechanism for a batch of input values.

    angle         value of the input [rad, or m for a displacement]: a number, or an array over the samples
    speed         its rate [rad/s, m/s], one number or an array over the samples
    acceleration  its second rate [rad/s^2, m/s^2], likewise
    jerk          its third rate [rad/s^3, m/s^3], likewise; used by `Motion.jerk` only
    For several inputs: mappings from the input's name; default of a rate: zero.

    Never fails for a sample: see `Motion.status` and `Motion.require`. Raises MechanismError for unknown or missing
    inputs, values that are not finite, arrays that are empty or of different lengths, and for a group that Newton's
    method would have to follow over too long a path from the pose; Cancelled.
    """
    drives = drives_of(plan, angle, speed, acceleration, jerk)
    size = _block_size(plan)
    samples = np.size(drives[plan.mechanism.inputs[0].name].value)
    status = np.zeros(samples, dtype=np.int8)
    columns: dict[str, Columns] = {}
    with np.errstate(invalid="ignore", divide="ignore", over="ignore"):
        for start in range(0, samples, size):
            part = slice(start, start + size)
            solved = _block(plan, {name: drive.part(part) for name, drive in drives.items()}, status[part])
            if start == 0:
                columns = {body: _room(fields, samples) for body, fields in solved.items()}
            for body, fields in solved.items():
                _write(columns[body], fields, part)
            progress(min(1.0, (start + size) / samples))
    return Motion(plan, drives, without_infinite(columns, status), status)


def without_infinite(columns: Mapping[str, Columns], status: Int8[np.ndarray, " samples"]) -> Mapping[str, Columns]:
    """The same columns, in place: rates are infinite at a dead centre, and NaN says so without warnings of NumPy."""
    unsolved = np.flatnonzero(status)
    for field in (field for fields in columns.values() for field in fields) if len(unsolved) else ():
        if isinstance(field, np.ndarray) and field.shape == status.shape and field.flags.writeable:
            field[unsolved[~np.isfinite(field[unsolved])]] = np.nan
    return columns


def _block_size(plan: Plan) -> int:
    """Samples per block."""
    largest = max((len(step.bodies) for step in plan.steps if isinstance(step, GeneralGroup)), default=0)
    return min(NEWTON_BLOCK, NEWTON_MEMORY // (8 * (3 * largest) ** 2)) if largest else BLOCK


def _block(plan: Plan, drives: Mapping[str, InputMotion], status: np.ndarray) -> dict[str, Columns]:
    """Every body's columns for one block of samples; writes into `status`."""
    start = local_starts(plan, drives)
    known, solved = solved_steps(plan, drives, start)
    status[:] = judge(plan, drives, start, known, solved)[0]
    origin = anchors(plan.mechanism)[GROUND]
    columns: dict[str, Columns] = {}
    for step, one in zip(plan.steps, solved, strict=True):
        columns.update(step.in_world(one.columns, origin) if isinstance(step, GeneralGroup) else one.columns)
    return columns


def _room(fields: Columns, samples: int) -> Columns:
    """Arrays for all samples where the first block's columns are arrays; else the constant itself."""
    return tuple(np.empty(samples, field.dtype) if isinstance(field, np.ndarray) else field for field in fields)


def _write(arrays: Columns, fields: Columns, part: slice) -> None:
    for array, field in zip(arrays, fields, strict=True):
        if isinstance(array, np.ndarray):
            array[part] = field


def drives_of(
    plan: Plan, angle: InputValues, speed: InputValues, acceleration: InputValues, jerk: InputValues = 0.0
) -> dict[str, InputMotion]:
    """The inputs' motions by name, checked, with values broadcast over the samples; errors as `solve`."""
    names = [entry.name for entry in plan.mechanism.inputs]
    values, *rates = (
        _by_name(names, inputs, what)
        for inputs, what in ((angle, "value"), (speed, "speed"), (acceleration, "acceleration"), (jerk, "jerk"))
    )
    missing = [name for name in names if name not in values]
    if missing:
        raise MechanismError(f"no value given for input {missing[0]!r} of {plan.mechanism.name}")
    fields = [value for given in (values, *rates) for value in given.values()]
    samples = _samples(fields)
    return {
        name: InputMotion(
            np.broadcast_to(values[name], samples), *(_spread(given.get(name, 0.0), samples) for given in rates)
        )
        for name in names
    }


def _by_name(names: list[str], inputs: InputValues, what: str) -> dict[str, RealField]:
    """Values by input name, checked; a single number or array belongs to the only input, or is zero for all."""
    if not isinstance(inputs, Mapping):
        if len(names) > 1 and np.any(np.asarray(inputs) != 0):
            raise MechanismError(f"one {what} given for the inputs {', '.join(names)}", do="give a mapping by name")
        inputs = dict.fromkeys(names, inputs)
    for name, value in inputs.items():
        if name not in names:
            raise MechanismError(f"unknown input {name!r}", allowed=f"the inputs are {', '.join(names)}")
        if not np.isfinite(value).all():
            raise MechanismError(f"the {what} of input {name!r} is not finite everywhere")
    return {name: _real(value) for name, value in inputs.items()}


def _real(value: RealField) -> RealField:
    return np.asarray(value, dtype=float) if np.size(value) != 1 else float(np.asarray(value).item())


def _spread(value: RealField, samples: int) -> RealField:
    return np.broadcast_to(value, samples) if np.ndim(value) else value


def _samples(inputs: list[RealField]) -> int:
    """Common length of all arrays; 1 if there are numbers only."""
    shapes = {np.shape(value) for value in inputs if np.ndim(value)} or {(1,)}
    if len(shapes) > 1 or len(min(shapes)) != 1:
        listed = " and ".join(str(shape) for shape in sorted(shapes))
        raise MechanismError(f"inputs have arrays of shapes {listed}", allowed="one-dimensional arrays of one length")
    if (samples := int(min(shapes)[0])) == 0:
        raise MechanismError("inputs have no samples", allowed="one or more")
    return samples
