"""Angles and displacements determined by inputs and couplings alone, with their full turns.

Every angle theta of a body and displacement s of a slide is an unknown of one linear system:

    slide        theta_body - theta_guide = turned
    input        theta_body - theta_other = q,  or  s = q
    gears, belt  theta_2 - theta_c - second_at = ratio (theta_1 - theta_c - first_at)
    rack         s - second_at = ratio (theta_1 - theta_c - first_at)

A determined unknown is  constant + sum of factor times input  [Willis, Principles of Mechanism:
epicyclic trains by their relative angles].
"""

from collections.abc import Iterator, Mapping

import numpy as np

from ilmek.arrays import FloatArray, RealField
from ilmek.linkage.groups.group import InputMotion
from ilmek.linkage.model import GROUND, Coupling, Mechanism, Rotation, Slide
from ilmek.records import record

FREE = 1e-9
"""Least share of an unknown in the null space of the system, from which it is undetermined."""

ROUNDING = 2e-15
"""Relative distance within which a factor is rounded to twelve decimals."""


@record
class LinearRelation:
    """constant + sum of factor times input [rad or m]; shares: input -> factor."""

    constant: float
    shares: Mapping[str, float]

    def drive(self, drives: Mapping[str, InputMotion]) -> InputMotion:
        """Value and first to third rates from the motions of the inputs."""
        value: RealField = self.constant
        speed: RealField = 0.0
        acceleration: RealField = 0.0
        jerk: RealField = 0.0
        for name, factor in self.shares.items():
            value = value + factor * drives[name].value
            speed = speed + factor * drives[name].speed
            acceleration = acceleration + factor * drives[name].acceleration
            jerk = jerk + factor * drives[name].jerk
        return InputMotion(value, speed, acceleration, jerk)


def angles(mechanism: Mechanism) -> dict[str, LinearRelation]:
    """Body -> relation of its angle [rad] in the world, for the determined bodies."""
    return {name: relation for (kind, name), relation in linear_relations(mechanism).items() if kind == "angle"}


def linear_relations(mechanism: Mechanism) -> dict[tuple[str, str], LinearRelation]:
    """("angle", body) or ("travel", slide) -> relation, for those determined by inputs and couplings."""
    system = _system(mechanism)
    relations: dict[tuple[str, str], LinearRelation] = {("angle", GROUND): LinearRelation(0.0, {})}
    if len(system.left):
        for key, numbers in _determined(list(system.index), system.left, system.right):
            relations[key] = system.relation(numbers)
    return relations


def relation_between(mechanism: Mechanism, body: str, against: str) -> LinearRelation | None:
    """Relation of a body's angle against another's [rad]; None where inputs and couplings alone do not determine it.

    The difference may be determined where neither angle is: a pin of two moving bodies that is driven. It is the
    combination y of the system's equations with y left = e_body - e_against. Raises MechanismError for unknown bodies.
    """
    system = _system(mechanism)
    required = np.zeros(len(system.index))
    for name, sign in ((body, 1.0), (against, -1.0)):
        if mechanism.body(name).name != GROUND:
            required[system.index["angle", name]] += sign
    if not required.any():
        return LinearRelation(0.0, {})
    if not len(system.left):
        return None
    combined = np.linalg.lstsq(system.left.T, required, rcond=FREE)[0]
    if np.max(np.abs(combined @ system.left - required)) >= FREE:
        return None
    return system.relation([float(number) for number in _rounded(combined @ system.right)])


@record
class _System:
    """Linear equations  left · unknowns = right · (1, inputs);  index: unknown -> its column."""

    index: Mapping[tuple[str, str], int]
    inputs: tuple[str, ...]
    left: FloatArray
    right: FloatArray

    def relation(self, numbers: list[float]) -> LinearRelation:
        """The relation of a constant and a factor of each input."""
        constant, *factors = numbers
        return LinearRelation(
            constant, {name: factor for name, factor in zip(self.inputs, factors, strict=True) if factor}
        )


def _system(mechanism: Mechanism) -> _System:
    """The equations of all slides, inputs and couplings."""
    unknown = [("angle", body) for body in mechanism.moving]
    unknown += [("travel", joint.name) for joint in mechanism.joints if isinstance(joint, Slide)]
    index = {key: k for k, key in enumerate(unknown)}
    names = tuple(entry.name for entry in mechanism.inputs)
    rows = list(_rows(mechanism))
    left, right = np.zeros((len(rows), len(unknown))), np.zeros((len(rows), 1 + len(names)))
    for k, (terms, constant, entry) in enumerate(rows):
        for key, factor in terms:
            if key in index:
                left[k, index[key]] += factor
        right[k, 0] = constant
        if entry:
            right[k, 1 + names.index(entry)] = 1.0
    return _System(index, names, left, right)


def _determined(
    unknown: list[tuple[str, str]], left: FloatArray, right: FloatArray
) -> Iterator[tuple[tuple[str, str], list[float]]]:
    """The determined unknowns, with their constant and factors."""
    _, values, rows = np.linalg.svd(left, full_matrices=True)
    rank = int(np.sum(values > FREE * values[0]))
    loose = np.linalg.norm(rows[rank:], axis=0)
    solved = _rounded(np.linalg.lstsq(left, right, rcond=FREE)[0])
    for k, key in enumerate(unknown):
        if loose[k] < FREE:
            yield key, [float(number) for number in solved[k]]


def _rounded(numbers: FloatArray) -> FloatArray:
    """Numbers within rounding of twelve decimals as these."""
    whole = np.round(numbers, 12)
    return np.where(np.abs(numbers - whole) < ROUNDING * np.maximum(1, np.abs(numbers)), whole, numbers)


Row = tuple[tuple[tuple[tuple[str, str], float], ...], float, str]


def _rows(mechanism: Mechanism) -> Iterator[Row]:
    """The linear equations: terms, constant, and the input added to the constant."""
    for joint in mechanism.joints:
        if isinstance(joint, Slide):
            yield ((("angle", joint.body), 1.0), (("angle", joint.guide), -1.0)), joint.turned, ""
    for entry in mechanism.inputs:
        if isinstance(entry, Rotation):
            first, second = mechanism.joint(entry.about).bodies
            other = second if entry.body == first else first
            yield ((("angle", entry.body), 1.0), (("angle", other), -1.0)), 0.0, entry.name
        else:
            yield ((("travel", entry.slide), 1.0),), 0.0, entry.name
    for coupling in mechanism.couplings:
        if coupling.law is not None:  # not linear
            continue
        yield _coupled(coupling), coupling.second_at - coupling.ratio * coupling.first_at, ""


def _coupled(coupling: Coupling) -> tuple[tuple[tuple[str, str], float], ...]:
    first, carrier = (("angle", coupling.first[0]), -coupling.ratio), ("angle", coupling.carrier)
    if coupling.slides:
        return (("travel", coupling.ends[1][1]), 1.0), first, (carrier, coupling.ratio)
    return (("angle", coupling.second[0]), 1.0), first, (carrier, coupling.ratio - 1)


def first_angle(
    coupling: Coupling, known: Mapping[str, LinearRelation], drives: Mapping[str, InputMotion]
) -> RealField:
    """Angle of a coupling's first body against the carrier [rad], within half a turn; default: `first_at`."""
    first, carrier = known.get(coupling.first[0]), known.get(coupling.carrier)
    if first is None or carrier is None:
        return coupling.first_at
    return first.drive(drives).value - carrier.drive(drives).value
