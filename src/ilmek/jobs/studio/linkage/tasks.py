"""A mechanism as one draws it: its structure, finished or not, and its motion, while a joint is dragged."""

import dataclasses
from collections.abc import Mapping
from copy import deepcopy
from dataclasses import dataclass, field
from functools import lru_cache

import msgspec

from ilmek.dynamics.own_machine import OwnMachine
from ilmek.errors import IlmekError, MechanismError, ParameterError
from ilmek.io.mechanism.moved_joint import FileChange, moved_joint
from ilmek.io.mechanism_file import MechanismFile, mechanism_of_data
from ilmek.io.schema import Table
from ilmek.jobs.studio.answers import Context
from ilmek.jobs.studio.linkage.answer import BodyAnswer, LinkageFault, MechanismAnswer
from ilmek.jobs.studio.linkage.motion import RunOptions, motion_of
from ilmek.jobs.studio.linkage.part import (
    drawn_branches,
    joined_part,
    loose_points,
    machine_of_part,
    signs_in_pose,
    solved_part,
    sound_part,
)
from ilmek.jobs.studio.linkage.structure import bodies_of, couplings_of, inputs_of, joints_of, structure_of
from ilmek.jobs.studio.words import in_page
from ilmek.linkage.branches_in_pose import Pose
from ilmek.linkage.initial_pose import inputs_in_pose
from ilmek.linkage.model import GROUND, Mechanism
from ilmek.linkage.structure import Plan, solvable_steps
from ilmek.records import JsonObject

MOST_STEPS = 3600
"""Largest number of steps of a range."""


@dataclass(frozen=True, slots=True)
class DraggedJoint:
    """A joint of the file and its new position [m]."""

    joint: str
    x: float
    y: float


@dataclass(frozen=True, eq=False, slots=True)
class MechanismRequest:
    """A mechanism, saved or not, and the motion that is to be computed.

    mechanism  the plain data of a mechanism file
    fixed      input -> value, like "30deg"; of several inputs all but one are fixed, by default at 0
    over       range of the driving input, like "0deg..360deg"; default: a turn, or the range in which a slide closes
    speed      of the driving input, like "60rpm"; default: that of the file, or 1 rad/s
    steps      of the range
    poses      body -> origin [m] and angle [rad] as drawn at present: for bodies without a motion, branches, a drag
    drag       a joint moved to a new position, from the pose in `poses`
    rates, forces  whether velocities and accelerations, or forces, are required
    """

    mechanism: JsonObject
    fixed: dict[str, str] = field(default_factory=dict)
    over: str = ""
    speed: str = ""
    steps: int = 360
    poses: dict[str, tuple[float, float, float]] = field(default_factory=dict)
    drag: DraggedJoint | None = None
    rates: bool = False
    forces: bool = False


@dataclass(frozen=True, eq=False, slots=True)
class DrawnMechanism:
    """A mechanism of plain data, with what a drag and the drawing change.

    loose  bodies without a joint      pose  as drawn      values  of the inputs in a dragged pose
    """

    machine: OwnMachine
    loose: tuple[str, ...]
    pose: Pose
    changes: tuple[FileChange, ...]
    values: dict[str, float]

    @property
    def mechanism(self) -> Mechanism:
        """The mechanism."""
        return self.machine.mechanism


def mechanism(request: MechanismRequest, context: Context) -> MechanismAnswer:
    """The structure of a mechanism and its motion, from the plain data of a mechanism file.

    An unfinished mechanism has a structure that names what is missing, and the motion of the part that is determined.
    Entries that cannot be read are left out, and the first of them is reported; so is a drag that makes one.
    Raises MechanismError for data that are no mechanism file, with the key.
    """
    try:
        return _answer(request, context)
    except MechanismError as error:
        rest = sound_part(request.mechanism)
        if rest is None:
            raise
        answer = _answer(dataclasses.replace(request, mechanism=rest, drag=None), context)
        return dataclasses.replace(answer, changes=(), refused=fault_of(error))


def _answer(request: MechanismRequest, context: Context) -> MechanismAnswer:
    """The answer of a file without a wrong entry."""
    drawn = drawn_mechanism(request)
    steps, reason = solvable_steps(drawn.mechanism)
    part = solved_part(drawn.mechanism, steps)
    options = RunOptions(request.fixed, request.over, request.speed, request.steps, request.rates, request.forces)
    context.progress(0.5)
    try:
        motion, why = motion_of(machine_of_part(drawn.machine, part), plan_of(part), options, drawn.pose), None
    except IlmekError as error:
        motion, why = None, fault_of(error)
    loose = tuple(BodyAnswer(body, loose_points(request.mechanism, body), solved=False) for body in drawn.loose)
    known = {GROUND, *(body for step in steps for body in step.bodies)}
    return MechanismAnswer(
        drawn.mechanism.name,
        bodies_of(drawn.mechanism, known) + loose,
        joints_of(drawn.mechanism, request.mechanism.get("joints", {})),
        couplings_of(drawn.mechanism),
        inputs_of(drawn.mechanism),
        structure_of(drawn.mechanism, steps, drawn.loose, fault_of(reason) if reason else None),
        {
            body: (origin.real, origin.imag, angle)
            for body, (origin, angle) in _all_poses(drawn).items()
            if motion is None or body not in known
        },
        motion,
        why,
        drawn.changes,
        drawn.values,
    )


def plan_of(part: Mechanism) -> Plan:
    """The plan of a part of which all steps can be solved."""
    return Plan(part, solvable_steps(part)[0])


def fault_of(error: IlmekError) -> LinkageFault:
    """The parts of an error's message."""
    return LinkageFault(*(in_page(part) for part in (error.given, error.allowed, error.do)))


def drawn_mechanism(request: MechanismRequest) -> DrawnMechanism:
    """The mechanism of a request, with a drag and lacking branches. Raises MechanismError; ParameterError."""
    if not 1 <= request.steps <= MOST_STEPS:
        raise ParameterError(f"{request.steps} steps", allowed=f"1 to {MOST_STEPS}")
    data, loose = joined_part(request.mechanism)
    file = _file(msgspec.json.encode(data))
    pose: dict[str, tuple[complex, float]] = dict(file.mechanism.pose)
    pose |= {body: (complex(x, y), angle) for body, (x, y, angle) in request.poses.items()}
    pose = {body: pose.get(body, (0j, 0.0)) for body in file.mechanism.moving}
    if request.drag is not None:
        return _dragged(data, file, pose, request.drag, loose)
    signs = drawn_branches(file.mechanism, pose) if solvable_steps(file.mechanism)[1] is not None else {}
    changes = tuple(FileChange(("branches", name), sign) for name, sign in signs.items())
    return DrawnMechanism(_with_branches(file, signs), loose, pose, changes, {})


def _dragged(
    data: JsonObject, file: MechanismFile, pose: Pose, drag: DraggedJoint, loose: tuple[str, ...]
) -> DrawnMechanism:
    """The mechanism with a joint moved: its branches are those of the new drawing, or else of the new pose."""
    moved = moved_joint(data, file.mechanism, dict(pose), drag.joint, complex(drag.x, drag.y))
    before = file.mechanism.branches
    rest = {key: value for key, value in data.items() if key != "branches"}  # they may contradict the new drawing
    file = mechanism_of_data(changed(rest, list(moved.changes)))
    shown = signs_in_pose(file.mechanism, moved.pose, tuple(before)) if before else {}
    signs = {**before, **drawn_branches(file.mechanism, moved.pose), **shown, **file.mechanism.branches}
    needless = {**file.mechanism.branches, **{name: before[name] for name in data.get("branches", {})}}
    changes = [FileChange(("branches", name), sign) for name, sign in signs.items() if needless.get(name) != sign]
    values = inputs_in_pose(dataclasses.replace(file.mechanism, pose=moved.pose))
    machine = _with_branches(file, signs)
    return DrawnMechanism(machine, loose, moved.pose, (*moved.changes, *changes), values)


def _with_branches(file: MechanismFile, signs: Mapping[str, int]) -> OwnMachine:
    whole = dataclasses.replace(file.mechanism, branches={**file.mechanism.branches, **signs})
    return dataclasses.replace(file.machine, mechanism=whole)


@lru_cache(maxsize=4)
def _file(data: bytes) -> MechanismFile:
    """The mechanism of plain data, as JSON: that from which a joint is dragged stays the same."""
    return mechanism_of_data(msgspec.json.decode(data))


def changed(data: Table, changes: list[FileChange]) -> JsonObject:
    """Data with new values of some entries."""
    made: JsonObject = deepcopy(dict(data))
    for change in changes:
        table = made
        for key in change.path[:-1]:
            table = table.setdefault(key, {})
        table[change.path[-1]] = change.value
    return made


def _all_poses(drawn: DrawnMechanism) -> dict[str, tuple[complex, float]]:
    """The poses as drawn; bodies without a joint as in their frame."""
    return {**dict.fromkeys(drawn.loose, (0j, 0.0)), **drawn.pose}
