"""What ties the knots of a loom: weavers by hand, cams and grippers of a head, or arms on it; one face for all.

A loom for weavers has no head. Else the head has the thesis' pile handler, colour magazine, cutter, warp opener, sley
and carriage:

    cams   the weaver as the thesis has it: side and centre grippers on its cams; they tie the symmetric knot alone
    arms   the knotting dyad in place of the grippers; the opener keeps cam 2, the arms tie between the opened warps and
           the sley, as quickly as their drives allow; symmetric and asymmetric knots

Cams are the cheaper ones: one motor in place of four servos. Where the usual angles of the motions do not tie the knot
within its time, the motions are stretched and overlapped within their order [`timing.solver`].
"""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from functools import lru_cache

import numpy as np

from ilmek.cams.laws import LAWS
from ilmek.errors import LoomError
from ilmek.loom.bobbins import Bobbin
from ilmek.loom.programme import least_times
from ilmek.loom.sharing import heads_that_fit
from ilmek.loom.times import Times
from ilmek.machines.automated_loom.params import AutomatedLoomParams
from ilmek.machines.catalogue import MACHINES
from ilmek.machines.component import Child
from ilmek.machines.knotting_dyad import KnottingDyad, KnottingDyadParams
from ilmek.machines.knotting_dyad.arm_drives import (
    BELTS_OVER,
    OUTSIDE,
    ROOM,
    SERVO_SHAFT,
    behind,
    beside,
    servo_axis,
    servo_face,
    standing_servos,
)
from ilmek.machines.knotting_dyad.drives import head_motion
from ilmek.machines.knotting_dyad.head import Head
from ilmek.machines.knotting_dyad.jaws import gripper_half
from ilmek.machines.knotting_dyad.motion import CyclePart
from ilmek.machines.knotting_dyad.params import ArmRoom
from ilmek.machines.knotting_dyad.sequence import CENTRE, LEFT, RIGHT
from ilmek.machines.loom_task import LoomTask
from ilmek.machines.weaver import Weaver, WeaverParams
from ilmek.machines.weaver.cyclogram import arms_window
from ilmek.machines.weaver.design import stretches, ties_as_set
from ilmek.machines.weaver.levers import HALF
from ilmek.machines.weaver.motions import CENTRE_ARM, HANDLER, LEFT_ARM, RIGHT_ARM
from ilmek.machines.weaver.sizes import larger_sizes
from ilmek.machines.weaver.stations import sheet
from ilmek.machines.weaver.tool_params import ArmsInHead
from ilmek.machines.weaver.widths import stack_width
from ilmek.machines.weaver_hands import HAND
from ilmek.records import record
from ilmek.report import BillLine, Check
from ilmek.timing.cyclogram import Cyclogram, Track, TrackEvent, TrackSegment

WEAVER, DYAD = "weaver", "knotting-dyad"
CAMS, ARMS = "cams", "arms"
KNOTTING = (CAMS, ARMS)
"""Kinds of knotting by heads, the cheaper first."""

ELBOW_ROOM = 0.6
"""Width of a weaver at her work [m]; assumed by this project."""

_SAME = 1e-9

ROUNDS = 6
"""Of sizes by loads: each is larger than the one before, or the last."""


ARM_LAW = LAWS["3-4-5"]
"""Law by which the arms' motions are drawn; their own is the quickest that the drives allow [`timing.path_speed`]."""


@record
class KnottingHead:
    """What ties the knots of a loom.

    kind      hand, cams or arms     weaver  the head, with the tracks of arms in its cyclogram; None: weavers by hand
    children  the machines of one head, by name
    """

    kind: str
    weaver: Weaver | None
    children: Mapping[str, Child]

    @property
    def checks(self) -> tuple[Check, ...]:
        """The checks of all machines of a head."""
        machines = [(child.component, child.design) for child in self.children.values()]
        return tuple(check for machine, design in machines for check in machine.checks(machine.analysis(design)))

    @property
    def width(self) -> float:
        """Width of a head, or of a weaver, along the row [m]."""
        return self.weaver.width if self.weaver else ELBOW_ROOM

    def most(self, columns: int, pitch: float) -> int:
        """The most that find room on a row of knots of a pitch [m]; weavers sit still, each before her share."""
        if self.weaver:
            return heads_that_fit(columns, pitch, self.width)
        return max(1, math.floor(columns * pitch / self.width + _SAME))

    def least_time(self, rows: int, columns: int, number: int, times: Times, bobbins: Sequence[Bobbin] = ()) -> float:
        """Weaving time [s] of a number of them without colour changes: of weavers that of the longest share."""
        return self.least_times(rows, columns, number, (times,), bobbins)[0]

    def least_times(
        self, rows: int, columns: int, number: int, times: Sequence[Times], bobbins: Sequence[Bobbin] = ()
    ) -> list[float]:
        """The same with each of some times."""
        if self.weaver is None:
            columns, number = math.ceil(columns / number), 1
        return least_times(rows, columns, number, times, bobbins)


def knotting_head(task: LoomTask) -> KnottingHead:
    """The head of a loom, of the kind that its parameters name. No pitch and no knot is refused: checks fail.

    Raises LoomError where the settings of its machines contradict the loom's.
    """
    if task.params.knotting == HAND:
        return KnottingHead(HAND, None, {})
    component = MACHINES[WEAVER]
    assert component.fit is not None
    params: WeaverParams = component.fit(task)
    if task.params.knotting == CAMS:
        params = _sized(task, params)
        if params.with_arms:
            raise LoomError("weaver.arms.time, and knotting=cams", do="set knotting=arms, or leave weaver.arms out")
        return _on_cams(params)
    arms = _arms(task)
    weaver = _weaver(_sized(task, replace(params, arms=_in_head(task, arms))))
    placed = replace(arms, params=task.parameters(DYAD, replace(arms.params, room=_room(task, weaver, arms))))
    return _by_arms(_sized(task, replace(params, arms=_in_head(task, placed))), placed)


def arms_alone(task: LoomTask) -> tuple[ArmsInHead, Sequence[BillLine]]:
    """The arms for a loom's warps, pile and knot without the head that carries them, and their parts."""
    arms = _arms(task)
    return _in_head(task, arms), MACHINES[DYAD].parts(arms)


def _in_head(task: LoomTask, arms: KnottingDyad) -> ArmsInHead:
    """What a head has to know of its arms."""
    if arms.head is None:
        raise LoomError("points for the arms of a loom", do="leave knotting-dyad.points and angles out")
    head, params, inside = arms.head, arms.params, arms.head.section
    motion = head_motion(params, head)
    rest = head.arm.tip(np.array([0.0]))[0]
    first, last = (servo_axis(params, head, motion, number) for number in (0, standing_servos(params) - 1))
    return ArmsInHead(
        time=motion.cycle.period,
        yarn=head.yarn_needed,
        pair=inside.pair,
        outer=inside.outer,
        width=head.width,
        rest=float(rest.imag),
        stroke=max(_travel(spans) for spans in _arm_positions(head).values()),
        breadth=params.needle_breadth,
        mass=sum(part.mass_all for part in MACHINES[DYAD].parts(arms)),
        back=behind(head) + task.params.clearance,
        beside=beside(head) + task.params.clearance,
        grip=gripper_half(params) + task.params.clearance,
        aside=inside.middle - float(rest.real),
        bar_width=params.link_width,
        bar_height=2 * motion.jaws.bar,
        servo_aside=inside.middle - first.real,
        servo_depth=first.imag,
        servo_pitch=last.imag - first.imag,
        belts_end=last.imag + OUTSIDE,
        belts_over=BELTS_OVER,
        servo_shaft=SERVO_SHAFT,
    )


def _room(task: LoomTask, weaver: Weaver, arms: KnottingDyad) -> ArmRoom:
    """Where a head has room for its arms' drives: under the plate over its case, behind the followers of its cams; and
    below the opener.
    """
    assert arms.head is not None
    shape, opener = weaver.shape, weaver.params.opener
    top, face = (shape.body + shape.size).imag - sheet(weaver), servo_face(head_motion(arms.params, arms.head))
    return replace(
        arms.params.room,
        level=top - opener.front_span - opener.height / 2,
        face=shape.body.real,
        below=opener.height / 2 + opener.plate + task.params.clearance,
        depth=shape.axis.real + 2 * HALF + face / 2,
        aside=(stack_width(weaver.params) - face) / 2 - ROOM / 2,
    )


def _sized(task: LoomTask, derived: WeaverParams) -> WeaverParams:
    """The parameters of a head for the loom's knot: the user's, and of those left open as large as its loads need."""
    for _ in range(ROUNDS):
        params = task.parameters(WEAVER, derived)
        if stretches(params) and not ties_as_set(params):
            derived = replace(derived, optimise=True)
            params = task.parameters(WEAVER, derived)
        larger = larger_sizes(_weaver(params))
        if task.parameters(WEAVER, replace(derived, **larger)) == params:
            break
        derived = replace(derived, **larger)
    return params


@lru_cache(maxsize=32)
def _weaver(params: WeaverParams) -> Weaver:
    """A head, designed once for each set of parameters: a loom's choices ask for the same one."""
    design: Weaver = MACHINES[WEAVER].design(params)
    return design


@lru_cache(maxsize=4)
def _on_cams(params: WeaverParams) -> KnottingHead:
    """A head on its cams."""
    weaver = _weaver(params)
    return KnottingHead(CAMS, weaver, {WEAVER: Child(MACHINES[WEAVER], weaver)})


@lru_cache(maxsize=4)
def _by_arms(params: WeaverParams, arms: KnottingDyad) -> KnottingHead:
    """A head with arms."""
    made = _weaver(params)
    weaver = replace(made, cyclogram=with_arms(made, arms))
    children = {WEAVER: Child(MACHINES[WEAVER], weaver), DYAD: Child(MACHINES[DYAD], arms)}
    return KnottingHead(ARMS, weaver, children)


def _arms(task: LoomTask) -> KnottingDyad:
    """The arms for a loom's warps, pile and knot."""
    component = MACHINES[DYAD]
    assert component.fit is not None
    params: KnottingDyadParams = task.parameters(DYAD, component.fit(task))
    return _designed(params)


def require_knot(params: AutomatedLoomParams) -> None:
    """Raise LoomError where a machine that ties is set to another knot than that of the loom."""
    for name in (WEAVER, DYAD):
        knot = params.machines.of(name).get("knot", params.knot)
        if knot != params.knot:
            given = f"{name}.knot={knot} in a loom for {params.knot} knots"
            raise LoomError(given, do=f"leave it out, and set knot={knot}")


@lru_cache(maxsize=32)
def _designed(params: KnottingDyadParams) -> KnottingDyad:
    """The arms, designed once for each set of parameters."""
    dyad: KnottingDyad = MACHINES[DYAD].design(params)
    return dyad


def with_arms(weaver: Weaver, arms: KnottingDyad) -> Cyclogram:
    """The head's cyclogram with the phases of its arms, from the opened warps on.

    The arms grasp the pile while the handler presents it, before it turns home.
    """
    assert arms.head is not None
    motion, tied = head_motion(arms.params, arms.head), weaver.cyclogram
    parts, speed = motion.cycle.parts, tied.speed
    opened = arms_window(tied)[0]
    first = next(part.start for part in parts if not part.grippers)
    home = tied.track(HANDLER).segment("home").start

    def at(time: float) -> float:
        return opened + (time - first) * speed if time >= first else home + (time - first) * speed

    moved = [part for part in parts if not part.grippers]
    tracks = {
        name: [
            TrackSegment(part.name, at(part.start), at(part.end), begin, finish, ARM_LAW)
            for part, (begin, finish) in zip(moved, spans, strict=True)
            if begin != finish
        ]
        for name, spans in _arm_positions(arms.head).items()
    }
    made = (
        Track(name, actuator, tuple(tracks[name]), _grips(parts, gripper, at, speed))
        for name, actuator, gripper in (
            (LEFT_ARM, "two servos", LEFT),
            (RIGHT_ARM, "two servos", RIGHT),
            (CENTRE_ARM, "linear axis", CENTRE),
        )
    )
    opener, *others = tied.tracks
    return replace(tied, tracks=(opener, *made, *others))


def _arm_positions(head: Head) -> dict[str, list[tuple[float, float]]]:
    """Of each arm the positions of its tip at the begin and the end of each phase of the sequence [m]."""
    stroke, front = head.arm.stroke, head.section.front
    return {
        LEFT_ARM: [(stroke * phase.left[0], stroke * phase.left[1]) for phase in head.sequence],
        RIGHT_ARM: [(stroke * phase.right[0], stroke * phase.right[1]) for phase in head.sequence],
        CENTRE_ARM: [(front - phase.centre[0], front - phase.centre[1]) for phase in head.sequence],
    }


def _travel(spans: list[tuple[float, float]]) -> float:
    ends = np.ravel(spans)
    return float(ends.max() - ends.min())


def _grips(
    parts: tuple[CyclePart, ...], gripper: str, at: Callable[[float], float], speed: float
) -> tuple[TrackEvent, ...]:
    """The ends of a gripper's grasps and releases as events, numbered."""
    mine = [part for part in parts if gripper in part.grippers]
    counted = [sum(one.name == part.name for one in mine[: k + 1]) for k, part in enumerate(mine)]
    ends = [at(part.start) + (part.end - part.start) * speed for part in mine]
    return tuple(TrackEvent(f"{part.name} {k}", end) for part, k, end in zip(mine, counted, ends, strict=True))
