"""Variants of one mechanism: its dimensions as arrays, all moved at once by the compiled tape.

The motions of the variants are one `Motion`, whose fields have the shape (variants, samples) and whose bodies' points
the shape (variants, 1): every formula of a motion broadcasts over them.

>>> from ilmek.linkage.fourbar import four_bar
>>> swept = four_bar(0.3, 0.06, 0.2, 0.23, branch=+1).vary(crank=np.array([0.05, 0.06])).evaluate(
...     turn=73, want=["transmission_angle_min", "coupler.B x"]
... )
>>> np.degrees(swept["transmission_angle_min"]).round(2), swept["coupler.B x"].shape
(array([70.7 , 66.49]), (2, 73))
"""

from collections.abc import Collection, Iterator, Mapping, Sequence
from typing import Any, NoReturn

import numpy as np

from ilmek.arguments import Arguments
from ilmek.arrays import ComplexArray, ComplexField, FloatArray, RealField
from ilmek.errors import MechanismError, did_you_mean
from ilmek.linkage.anchors import anchor_name
from ilmek.linkage.batch import sweep
from ilmek.linkage.body_motion import BodyMotion
from ilmek.linkage.groups.group import Columns, Group, Known, Step
from ilmek.linkage.model import Body, Mechanism
from ilmek.linkage.motion import Motion
from ilmek.linkage.solve import InputValues, drives_of
from ilmek.linkage.status import Status
from ilmek.linkage.structure import Plan, plan
from ilmek.linkage.tape import Dimensions
from ilmek.linkage.transmission import transmission_angles
from ilmek.records import record, with_fields
from ilmek.report.framed import Framed
from ilmek.units import turn as full_turn

BLOCK = 16384
"""Samples of all variants that are computed at once: their arrays stay near the processor."""

ROTATIONS = ("angle", "omega", "alpha")
"""Results of a body: angle in (-pi, pi] [rad], rates [rad/s; rad/s^2]."""

COMPONENTS = {
    f"{rate}{axis}": (order, part)
    for rate, order in (("", "position"), ("v", "velocity"), ("a", "acceleration"))
    for axis, part in (("x", "real"), ("y", "imag"))
}
"""Results of a point: its coordinates [m], velocity and acceleration by x and y."""


class SweptGroup(Step):
    """A group whose bodies' motions are known for all variants."""

    kind = "swept"
    bodies: tuple[str, ...] = ()
    parents = ()
    description = ""

    def __init__(self, step: Step, located: Mapping[str, BodyMotion]) -> None:
        self.bodies, self.description, self.located = step.bodies, step.description, located

    @classmethod
    def recognise(cls, group: Group) -> None:
        """None."""

    def locate(self, known: Known, columns: Mapping[str, Columns]) -> Mapping[str, BodyMotion]:  # noqa: ARG002
        """The motions, also of other bodies."""
        return self.located

    def solve(self, *_: object) -> NoReturn:
        """Raise MechanismError: it is solved."""
        raise MechanismError("jerks of variants", allowed="positions, velocities, accelerations", do="use solve")

    jerk = solve  # type: ignore[assignment]


def variant_motion(
    planned: Plan, dimensions: Dimensions, values: InputValues, speed: InputValues, bodies: Collection[str] = ()
) -> tuple[Motion, FloatArray]:
    """The motions of all variants, each field (variants, samples), and the margin of each, as of `batch.Sweep`.

    bodies  those that are wanted; default: all      Arguments and errors are those of `batch.sweep`
    """
    mechanism = planned.mechanism
    ends = {body: str(anchor_name(mechanism, body)) for body in bodies or mechanism.moving}
    swept = sweep(planned, dimensions, values, speed, bodies=ends, points=ends.items())
    varied = with_points(mechanism, {key: np.reshape(one, (-1, 1)) for key, one in dimensions.items()})
    located = {
        body: BodyMotion(swept.points[body, end], varied.point(body, end), one.direction, one.omega, one.alpha)
        for (body, end), one in zip(ends.items(), swept.bodies.values(), strict=True)
    }
    steps = tuple(SweptGroup(step, located) for step in planned.steps)
    drives = drives_of(planned, values, speed, 0.0)
    return Motion(Plan(varied, steps), drives, dict.fromkeys(mechanism.moving, ()), swept.status), swept.margin


def with_points(mechanism: Mechanism, points: Mapping[tuple[str, str], ComplexField]) -> Mechanism:
    """The mechanism with other points, (body, point) -> positions [m], unchecked: they may be arrays."""

    def moved(body: Body) -> Body:
        return with_fields(body, points={name: points.get((body.name, name), at) for name, at in body.points.items()})

    return with_fields(mechanism, bodies=tuple(moved(body) for body in mechanism.bodies))


@record
class VariantResults(Framed):
    """Results of variants by name: arrays of the variants' shape, with the samples along a last axis where they differ.

    given   what varies, by name [SI], broadcast      input    values of the input [rad; m], (samples,)
    closes  share of the samples that each variant can be moved to [1]
    margin  least distance from a dead centre over the samples that close, as of `batch.Sweep`: 0 at a dead centre [1]
    """

    given: Mapping[str, np.ndarray]
    input: FloatArray
    closes: FloatArray
    margin: FloatArray
    results: Mapping[str, np.ndarray]

    def __getitem__(self, name: str) -> np.ndarray:
        return self.results[name]

    def table(self) -> dict[str, np.ndarray]:
        """Columns with a row a variant, or a row a sample where a result has samples; `frame`: as a DataFrame."""
        shape = self.closes.shape
        sampled = any(one.ndim > len(shape) for one in self.results.values())
        whole = (*shape, len(self.input)) if sampled else shape

        def column(values: np.ndarray) -> np.ndarray:
            aligned = values[..., None] if sampled and values.ndim == len(shape) else values
            return np.broadcast_to(aligned, whole).ravel()

        columns = {name: column(values) for name, values in self.given.items()}
        if sampled:
            columns["input"] = np.broadcast_to(self.input, whole).ravel()
        return columns | {name: column(values) for name, values in self.results.items()}


@record
class Variants:
    """Variants of a mechanism; `Mechanism.vary` makes them.

    given       what varies, by name [SI], broadcast to one shape
    dimensions  (body, point) -> its position in each variant [m], (variants,)
    """

    plan: Plan
    given: Mapping[str, np.ndarray]
    dimensions: Mapping[tuple[str, str], ComplexArray]

    def evaluate(
        self, turn: int = 73, *, want: Sequence[str], values: RealField | None = None, speed: RealField = 0.0
    ) -> VariantResults:
        """Results of all variants over one motion of the input.

        turn   number of samples over a full turn, both ends included; or
        values of the input [rad; m]                         speed  of the input [rad/s; m/s]
        want   "BODY angle", "BODY omega", "BODY alpha"; "BODY.POINT x", y, vx, vy, ax, ay; "transmission_angle_min",
               also of one pin, "transmission_angle_min.PIN"
        A variant is NaN where it does not close. Raises MechanismError for other names, with the nearest, and for a
        group without a closed form.
        """
        samples = np.linspace(0.0, full_turn, turn) if values is None else np.atleast_1d(values).astype(float)
        check_result_names(want, result_names(self.plan.mechanism))
        bodies = {name.rpartition(" ")[0].partition(".")[0] for name in want}
        bodies = bodies if "" not in bodies else set()  # an angle of transmission needs all

        def results(part: slice) -> Iterator[np.ndarray]:
            dimensions = {key: one[part] for key, one in self.dimensions.items()}
            motion, margin = variant_motion(self.plan, dimensions, samples, speed, sorted(bodies))
            yield margin
            yield np.mean(motion.status == Status.OK, axis=-1)
            yield from (motion_result(motion, name) for name in want)

        margin, closes, *found = in_blocks(results, self.given, len(samples))
        return VariantResults(self.given, samples, closes, margin, dict(zip(want, found, strict=True)))


def varied(mechanism: Mechanism, points: Mapping[str, Any], lengths: Mapping[str, Any]) -> Variants:
    """The variants of `Mechanism.vary`."""
    shaped = given_arrays({**lengths, **points}, dict.fromkeys(lengths, "m"))
    dimensions: dict[tuple[str, str], ComplexArray] = {}
    for name in lengths:
        body, start, end = _link(mechanism, name)
        if not (shaped[name] > 0).all():
            raise MechanismError(f"{name} has a length that is not above 0", allowed="lengths above 0")
        first = dimensions.get((body, start), mechanism.point(body, start))
        along = mechanism.point(body, end) - mechanism.point(body, start)
        dimensions[body, end] = np.asarray(first + shaped[name].ravel() * (along / abs(along)))
    for name in points:
        body, _, point = name.partition(".")
        mechanism.point(body, point)
        dimensions[body, point] = shaped[name].ravel()
    return Variants(plan(mechanism), shaped, dimensions)


def given_arrays(values: Mapping[str, Any], units: Mapping[str, str]) -> dict[str, np.ndarray]:
    """What varies as arrays [SI] of one shape; names without a unit are points. Raises MechanismError."""
    given = Arguments("variants", MechanismError)
    read = {
        name: np.asarray(given.values(name, one, units[name]) if name in units else given.vectors(name, one, "m"))
        for name, one in values.items()
    }
    if not read:
        raise MechanismError("nothing varies", do="give arrays, like crank=np.linspace(0.05, 0.06, 11)")
    try:
        return dict(zip(read, np.broadcast_arrays(*read.values()), strict=True))
    except ValueError:
        listed = ", ".join(f"{name} {one.shape}" for name, one in read.items())
        raise MechanismError(f"arrays of shapes that do not broadcast: {listed}") from None


def _link(mechanism: Mechanism, body: str) -> tuple[str, str, str]:
    """A body with its first two joints at different points: its length is between them."""
    points = mechanism.body(body).points
    joints = [name for name in points if any(joint.name == name for joint in mechanism.joints)]
    if len(joints) != 2 or points[joints[0]] == points[joints[1]]:
        given = f"body {body!r} of {mechanism.name} has {len(joints)} joints: its length is not defined"
        raise MechanismError(given, allowed="a link with two joints", do=f'give points: vary({{"{body}.POINT": ...}})')
    return body, joints[0], joints[1]


def in_blocks(results: Any, given: Mapping[str, np.ndarray], samples: int, block: int = BLOCK) -> list[np.ndarray]:
    """Results of slices of the variants, joined, in the variants' shape."""
    shape = next(iter(given.values())).shape
    count, size = int(np.prod(shape)), max(1, block // samples)
    parts = [list(results(slice(start, start + size))) for start in range(0, count, size)]
    joined = (np.concatenate(blocks) for blocks in zip(*parts, strict=True))
    return [one.reshape(*shape, *one.shape[1:]) for one in joined]


def result_names(mechanism: Mechanism) -> tuple[str, ...]:
    """The names of all results of its motion."""
    turning = (f"{body} {kind}" for body in mechanism.moving for kind in ROTATIONS)
    points = (f"{body}.{point}" for body in mechanism.moving for point in mechanism.body(body).points)
    angles = (f"transmission_angle_min.{joint.name}" for joint in mechanism.joints)
    moved = (f"{point} {kind}" for point in points for kind in COMPONENTS)
    return (*turning, *moved, "transmission_angle_min", *angles)


def check_result_names(want: Sequence[str], known: Sequence[str]) -> None:
    """Raise MechanismError for a name that is none of the known."""
    for name in want:
        if name not in known:
            raise MechanismError(f"no result {name!r}", do=did_you_mean(name, known, otherwise=", ".join(known[:12])))


def motion_result(motion: Motion, name: str) -> np.ndarray:
    """A result of all variants by its name, (variants, samples) or (variants,)."""
    head, _, kind = name.rpartition(" ")
    if not head:
        pin = name.partition(".")[2]
        angles = transmission_angles(motion, (pin,) if pin else ())
        return np.asarray(np.fmin.reduce([np.fmin.reduce(angle, axis=-1) for angle in angles.values()]))
    if kind == "angle":
        return np.asarray(np.angle(motion.direction(head)))
    if kind in ROTATIONS:
        return np.array(getattr(motion, kind)(head))
    order, part = COMPONENTS[kind]
    body, _, point = head.partition(".")
    moved: ComplexArray = getattr(motion.point(body, point), order)
    return np.array(moved.real if part == "real" else moved.imag)
