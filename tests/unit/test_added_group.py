"""A group is one class and one row: a group of this file is solved, compiled, judged and shown when its row is added.

A boom lifted by a cylinder, RPRR: barrel on A, rod driven along the barrel, boom on B, rod and boom joined at C.

    |C - A| = s, the input,    |C - B| = b
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import ClassVar, Self

import numpy as np
import pytest

from ilmek.arrays import ComplexArray, FloatArray, RealField
from ilmek.dynamics.own_machine import OwnMachine
from ilmek.errors import MechanismError
from ilmek.io.mechanism_file import data_of_mechanism, mechanism_of_data
from ilmek.jobs.studio.answers import Context
from ilmek.jobs.studio.linkage.tasks import MechanismRequest, mechanism
from ilmek.linkage import structure
from ilmek.linkage.batch import solve_batch, sweep
from ilmek.linkage.body_jerk import BodyJerk
from ilmek.linkage.body_motion import BodyMotion
from ilmek.linkage.drawing import branches_as_drawn
from ilmek.linkage.groups.group import Columns, Group, GroupSolution, InputMotion, Known, KnownJerks, Step
from ilmek.linkage.groups.rrr import first_link, first_rate, second_rate
from ilmek.linkage.groups.shift import SlideTrack, track
from ilmek.linkage.groups.turn import pinned
from ilmek.linkage.kernels import ALPHA, BLOCK, BODY, DIRECTION, MARGIN, OMEGA, SECOND, Instruction, pair, put, unable
from ilmek.linkage.model import GROUND, Body, Displacement, Mechanism, Pin, Slide
from ilmek.linkage.solve import solve
from ilmek.linkage.status import Status
from ilmek.linkage.structure import plan
from ilmek.linkage.tape import Tape
from ilmek.num.compiled import compiled

_first_link, _first_rate, _second_rate = compiled(first_link), compiled(first_rate), compiled(second_rate)


@compiled
def _kernel(to: FloatArray, _of: FloatArray, drive: FloatArray, count: int, numbers: ComplexArray) -> None:
    b, branch, per_b = numbers[0].real, numbers[1].real, numbers[2]
    for i in range(min(count, BLOCK)):
        s, ds, dds = drive[i], drive[BLOCK + i], drive[2 * BLOCK + i]
        d = pair(to, SECOND * BLOCK + i) - pair(to, i)
        u, sine = _first_link(d, s, b, branch)
        v, e, per_sine = u - d, u / s, 1 / sine
        r = pair(to, (SECOND + 2) * BLOCK + i) - pair(to, 2 * BLOCK + i) - ds * e
        w, wb = _first_rate(v, r, per_sine), _second_rate(u, r, per_sine)
        r = pair(to, (SECOND + 4) * BLOCK + i) - wb * wb * v
        r = r - (pair(to, 4 * BLOCK + i) + (dds - w * w * s + 2j * w * ds) * e)
        put(to, DIRECTION * BLOCK + i, e)
        to[OMEGA * BLOCK + i] = w
        to[ALPHA * BLOCK + i] = _first_rate(v, r, per_sine)
        put(to, (SECOND + DIRECTION) * BLOCK + i, v * per_b)
        to[(SECOND + OMEGA) * BLOCK + i] = wb
        to[(SECOND + ALPHA) * BLOCK + i] = _second_rate(u, r, per_sine)
        to[MARGIN * BLOCK + i] = sine / s


@compiled
def _scale(numbers: ComplexArray) -> tuple[float, float]:
    return numbers[0].real, numbers[0].real


@dataclass(frozen=True, slots=True)
class LiftedBoom(Step):
    """Barrel, driven rod and boom; the slide and the pins of the rod are at the origins of barrel and rod."""

    kind: ClassVar[str] = "dyad"
    symbol: ClassVar[str] = "RPRR"
    instruction: ClassVar[Instruction] = Instruction(_kernel, _scale, unable)

    names: tuple[str, str, str]
    on: tuple[str, str]
    hinges: tuple[complex, complex]
    at: complex
    arm: complex
    track: SlideTrack
    entry: str
    pin: str
    branch: int

    @property
    def bodies(self) -> tuple[str, ...]:
        return self.names

    @property
    def parents(self) -> tuple[str, ...]:
        return self.on

    @property
    def description(self) -> str:
        return f"{', '.join(self.names)} joined at {self.pin} (branch {self.branch:+d}): {self.symbol}"

    @property
    def free(self) -> str:
        return self.pin

    @property
    def lengths(self) -> tuple[float, ...]:
        return abs(self.arm), 0.0, abs(self.arm)

    @property
    def size(self) -> float:
        return abs(self.arm)

    def gap(self, known: Known) -> RealField:
        A, B = (known[on].carry(hinge) for on, hinge in zip(self.on, self.hinges, strict=True))
        return np.abs(B.position - A.position)

    def shortfall(self, known: Known) -> tuple[str, str]:  # noqa: ARG002
        return "the cylinder does not reach", ""

    def solve(self, known: Known, drives: Mapping[str, InputMotion]) -> GroupSolution:
        A, B = (known[on].carry(hinge) for on, hinge in zip(self.on, self.hinges, strict=True))
        drive = drives.get(self.entry, InputMotion(abs(self.arm), 0.0, 0.0))
        s, d = drive.value, B.position - A.position
        u, sine = first_link(d, s, abs(self.arm), self.branch)
        v, e, per_sine = u - d, u / s, 1 / sine
        r = B.velocity - A.velocity - drive.speed * e
        w, wb = first_rate(v, r, per_sine), second_rate(u, r, per_sine)
        along = drive.acceleration - w * w * s + 2j * w * drive.speed
        r = (B.acceleration - wb * wb * v) - (A.acceleration + along * e)
        columns = {
            self.names[0]: (e, w, first_rate(v, r, per_sine)),
            self.names[1]: (s, drive.speed, drive.acceleration),
            self.names[2]: (v / self.arm, wb, second_rate(u, r, per_sine)),
        }
        return GroupSolution(columns, sine / s, abs(self.arm))

    def locate(self, known: Known, columns: Mapping[str, Columns]) -> Mapping[str, BodyMotion]:
        barrel, rod, boom = self.names
        turned = pinned(known[self.on[0]], self.hinges[0], 0j, columns[barrel])
        lifted = pinned(known[self.on[1]], self.hinges[1], self.at, columns[boom])
        return {barrel: turned, rod: self.track.locate(turned, columns[rod]), boom: lifted}

    def jerk(
        self, known: KnownJerks, located: Known, columns: Mapping[str, Columns], drives: Mapping[str, InputMotion]
    ) -> Mapping[str, BodyJerk]:
        raise NotImplementedError

    def write(self, tape: Tape) -> None:
        barrel, rod, boom = self.names
        to, travel = tape.room(MARGIN + 1), tape.drive(self.entry)
        tape.pinned(barrel, self.on[0], to)
        arm = tape.arm(boom, tape.pinned(boom, self.on[1], to + SECOND), self.pin)
        numbers = np.abs(arm), tape.branch(self.pin, self.branch), 1 / arm
        tape.add(self.instruction, to, also=travel, numbers=numbers)
        self.track.write(tape, rod, barrel, tape.room(BODY), travel)

    @classmethod
    def recognise(cls, group: Group) -> Self | None:
        """A loop of three bodies with one driven slide."""
        slides = [joint for joint in group.joints if isinstance(joint, Slide)]
        if len(group.bodies) != 3 or len(slides) != 1 or len(group.joints) != 4 or len(group.inputs) != 1:
            return None
        slide, mechanism = slides[0], group.mechanism
        boom = next(body for body in group.bodies if body not in slide.bodies)
        outer = [group.outer_of(body)[0] for body in (slide.guide, boom)]
        on = group.beyond(outer[0], slide.guide), group.beyond(outer[1], boom)
        pin = next(joint.name for joint in group.inner if joint is not slide)
        return cls(
            names=(slide.guide, slide.body, boom),
            on=on,
            hinges=(mechanism.point(on[0], outer[0].name), mechanism.point(on[1], outer[1].name)),
            at=mechanism.point(boom, outer[1].name),
            arm=group.arm(boom, outer[1].name, pin),
            track=track(mechanism, slide, slide.body),
            entry=group.inputs[0].name,
            pin=pin,
            branch=group.branch(pin),
        )


LIFT = Mechanism(
    bodies=(
        Body(GROUND, {"A": 0.1 + 0.05j, "B": 0.7 - 0.1j}),
        Body("barrel", {"A": 0, "S": 0}),
        Body("rod", {"S": 0, "C": 0}),
        Body("boom", {"B": 0.2j, "C": 0.4 + 0.2j, "tip": 1.1 + 0.1j}),
    ),
    joints=(Pin("A", GROUND, "barrel"), Slide("S", "rod", "barrel"), Pin("C", "rod", "boom"), Pin("B", GROUND, "boom")),
    inputs=(Displacement("S"),),
    branches={"C": -1},
    name="lift",
)
STROKE = np.linspace(0.3, 1.1, 3 * BLOCK + 5)


@pytest.fixture(autouse=True)
def row(monkeypatch: pytest.MonkeyPatch) -> None:
    """The one row."""
    monkeypatch.setattr(structure, "GROUPS", (*structure.GROUPS, LiftedBoom))


def test_it_is_solved_by_its_closed_form() -> None:
    planned = plan(LIFT)
    assert [type(step) for step in planned.steps] == [LiftedBoom]
    motion = solve(planned, STROKE, 0.2, 0.1)
    good = motion.status == Status.OK
    assert 200 < good.sum() < len(good)  # it closes for |AB| - b < s < |AB| + b
    A, B = LIFT.point(GROUND, "A"), LIFT.point(GROUND, "B")
    cosine = (abs(B - A) ** 2 + 0.4**2 - STROKE**2) / (2 * abs(B - A) * 0.4)
    turned = (A - B) / abs(A - B) * np.exp(1j * np.arccos(cosine[good]))
    assert motion.direction("boom")[good] == pytest.approx(turned, abs=1e-9)
    step = 1e-5
    before, after = (solve(planned, STROKE + sign * step).angle("boom") for sign in (-1, 1))
    inner = good & (np.abs(cosine) < 0.99)
    assert motion.omega("boom")[inner] == pytest.approx(
        (0.2 * (after - before) / (2 * step))[inner], rel=1e-5, abs=1e-8
    )


def test_newtons_method_agrees() -> None:
    start = 0.7
    pose = solve(plan(LIFT), start).pose()
    general = solve(plan(replace(LIFT, pose=pose), closed_forms=False), np.linspace(0.6, 0.9, 20), 0.2, 0.1)
    closed = solve(plan(LIFT), np.linspace(0.6, 0.9, 20), 0.2, 0.1)
    for body in LIFT.moving:
        for name in ("direction", "omega", "alpha", "origin"):
            assert getattr(closed, name)(body) == pytest.approx(getattr(general, name)(body), abs=1e-9)


def test_it_is_compiled_judged_and_swept() -> None:
    planned = plan(LIFT)
    batch, motion = solve_batch(planned, STROKE, 0.2, 0.1), solve(planned, STROKE, 0.2, 0.1)
    assert (batch.status == motion.status).all()
    good = motion.status == Status.OK
    for body in LIFT.moving:
        for name in ("direction", "omega", "alpha", "position", "acceleration"):
            assert getattr(batch[body], name)[good] == pytest.approx(
                getattr(motion[body], name)[good], rel=1e-9, abs=1e-11
            )
    longer = {("boom", "C"): np.array([0.4, 0.42]) + 0.2j}
    swept = sweep(planned, longer, np.linspace(0.5, 0.9, 9), bodies=["boom"], points=[("boom", "tip")])
    first = solve(planned, np.linspace(0.5, 0.9, 9))
    assert swept.bodies["boom"].direction[0] == pytest.approx(first.direction("boom"))
    assert swept.points["boom", "tip"].position[0] == pytest.approx(first.point("boom", "tip").position)
    assert (swept.margin > 0).all()


def test_the_studio_shows_its_symbol_and_its_sign() -> None:
    data = data_of_mechanism(OwnMachine(LIFT), si=True)
    answer = mechanism(MechanismRequest(data, over="0.5m..0.9m", steps=8), Context())
    assert [(group.kind, group.symbol, group.branch, group.free) for group in answer.structure.groups] == [
        ("dyad", "RPRR", -1, "C")
    ]
    assert answer.motion is not None
    assert set(answer.motion.status) == {0}
    assert mechanism_of_data(data).mechanism == LIFT


def test_without_a_compiled_form_a_batch_is_solved_and_a_sweep_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(LiftedBoom, "instruction", None)
    monkeypatch.setattr(LiftedBoom, "write", Step.write)
    planned = plan(LIFT)
    assert (solve_batch(planned, STROKE).status == solve(planned, STROKE).status).all()
    with pytest.raises(MechanismError, match="not among the compiled groups"):
        sweep(planned, {}, STROKE)
    assert branches_as_drawn(LIFT) == {}
