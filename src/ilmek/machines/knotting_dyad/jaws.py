"""The jaws of the grippers: what they open, hold and need. A finger under each blade turns on a pin under its link.

It opens in the plane of its blade, along the warps, so that it takes no room across the gap. A spring closes it; a
solenoid opens it by a rod, which moves its tail by s at the arm a from the pin; the jaws, at the arm b, open by w:

    s = a w / b,    F_rod = F w / s,    F = S F_yarn / 2 mu                                [`weaver.forces`: the grip]

The spring presses so with the yarn, pressed to its thickness, between the jaws. An arm's rod lies on the axis of its
elbow; so s is limited there, and the pin's place follows: a = s T / (w + s), T from the elbow to the tip. The centre
gripper's finger has the same arm b, and a as the rod over its bar requires. Blades and fingers end in a wedge of the
tilt between arm and centre gripper at the hand-over, where so all of them meet in their tips, side by side.
"""

import math
from collections.abc import Iterator
from functools import lru_cache

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.elements.materials import MATERIALS
from ilmek.elements.solenoids import PEAK, Solenoid, shortest
from ilmek.elements.springs import CompressionSpring, choose_spring
from ilmek.machines.knotting_dyad.arm_drives import HUB, NAME
from ilmek.machines.knotting_dyad.arm_drives import WALL as HUB_WALL
from ilmek.machines.knotting_dyad.head import Head
from ilmek.machines.knotting_dyad.motion import RELEASE, KnotCycle
from ilmek.machines.knotting_dyad.params import KnottingDyadParams
from ilmek.machines.knotting_dyad.sequence import CENTRE, LEFT, RIGHT
from ilmek.machines.linkage_strength import smallest_pin
from ilmek.machines.weaver.forces import grip_force
from ilmek.machines.weaver.params import LEAST_FRICTION
from ilmek.records import computed, record, result
from ilmek.report import Check, at_least, at_most, must
from ilmek.units import mm

STEEL = MATERIALS["heat-treatable steel"]

STROKE, TAIL = 0.5 * mm, 1.15 * mm
"""Stroke of an arm's rod, at most, and from its link down to its finger's pin, and to the tail's middle [m]; assumed by
this project, as all sizes here."""

TINE, UNDER, EYE = 0.5 * mm, 0.15 * mm, 0.55 * mm
"""Depth of a finger's tines and, at least, of its needle; room between its body and the link over it; its depth under
its pin, more under a broad blade [m]."""

PLAY = 0.03 * mm
"""Play between wedges that meet [m]."""

PIN, LUG, CHEEK = 0.6 * mm, 2 * mm, 0.55 * mm
"""Diameter of a finger's pin, side and thickness of the lugs that hold it [m]."""

ON_CLAMP = 0.6 * LUG
"""From a finger's pin to the end of its link, at least [m]."""

IN_BORE, WALL, COLLAR = 0.2 * mm, 0.8 * mm, 0.4 * mm
"""Room of a rod about it in a bore, least wall about this, and thickness of the rod's collar on the spring [m]."""

CUP = 0.6 * mm
"""Wall of the cup about the spring [m]; its ends are as thick as the collar."""

STEEPER = (0.35, 0.7, 1.4, 2.8, 5.6, 11.0)
"""Rise of the spring's force over the stroke, over the force with which it holds a yarn: the first that fits."""

SPARE = 1.2
"""Least force of a solenoid over that of the spring, at both ends of the stroke."""

_LED = 1e-3
"""Factor of the length that counts for buckling: a spring on a rod does not buckle."""

ON_ROD, ROUND = 4 * mm, 2.2 * mm
"""Length of the spring while the jaws are closed, and its diameter over that of the holes, at most [m]."""


@record
class Jaws:
    """The jaws of a head.

    rod   its diameter [m]                                crank  of the centre gripper's finger, as `arm` [m]
    arm   of an arm's finger, from its pin to its rod [m]  tip    from a finger's pin to its tip [m]
    deep  from the needles' middle down to this pin [m]    preload, rate  of the spring [N, N/m]
    spring  None where none fits, on_rod: its length while the jaws are closed [m]
    moved  mass at a rod: plunger, rod, the finger's share [kg]
    cup  length of a neck's part about the spring; neck: of the whole neck, from the hub to the solenoid [m]
    """

    opening: float = result("mm", "opening of the jaws: a pile yarn, the clearance on both sides", name="jaw_opening")
    grip: float = result("N", "force with which the jaws hold a yarn", name="jaw_grip")
    rod: float
    arm: float
    crank: float
    tip: float
    deep: float
    preload: float
    rate: float
    spring: CompressionSpring | None
    on_rod: float
    solenoid: Solenoid
    moved: float
    cup: float
    neck: float

    @property
    def strokes(self) -> dict[str, float]:
        """Stroke of each gripper's rod [m]."""
        return {
            name: arm * self.opening / self.tip
            for name, arm in ((LEFT, self.arm), (RIGHT, self.arm), (CENTRE, self.crank))
        }

    @property
    def stroke(self) -> float:
        """The longest of them [m]."""
        return max(self.strokes.values())

    @property
    def coil(self) -> float:
        """Outer diameter of the spring, and of the collar behind it [m]."""
        return 2 * self.rod if self.spring is None else self.spring.diameter + self.spring.wire_diameter

    @property
    def around(self) -> float:
        """Outer diameter of the cup [m]."""
        return self.coil + IN_BORE + 2 * CUP

    @property
    def over(self) -> float:
        """From the needles' middle up to the axis of the centre gripper's rod [m]."""
        return self.crank - self.deep

    @property
    def bar(self) -> float:
        """Half the height of the centre gripper's bar, in which its rod moves [m]."""
        return self.over + (self.rod + IN_BORE) / 2 + WALL

    @property
    def wound(self) -> float:
        """Force of the spring that is wound the most, with open jaws [N]."""
        return self.preload + self.rate * self.stroke

    @property
    def angle(self) -> float:
        """By which a finger opens [rad]."""
        return math.asin(min(self.opening / self.tip, 0.5))

    @computed("ms", "time in which a solenoid opens the jaws", name="jaw_opening_time")
    def opens_in(self) -> float:
        return self.solenoid.closes_in(self.stroke, self.preload, self.reserve, self.moved)

    @computed("ms", "time in which the spring closes them on a yarn, or on themselves", name="jaw_closing_time")
    def closes_in(self) -> float:
        return self.solenoid.opens_in(self.stroke, (self.preload + self.wound) / 2, self.moved)

    @computed("N", "least force of a solenoid over that of the spring, over the stroke", name="jaw_reserve")
    def reserve(self) -> float:
        moved, pulse = np.linspace(0.0, self.stroke, 21), PEAK * self.solenoid.power
        pushed = np.array([self.solenoid.force(gap, pulse) for gap in moved[::-1].tolist()])
        return float(np.min(pushed - self.preload - self.rate * moved))

    def energy(self, cycle: KnotCycle, gripper: str) -> float:
        """Electric energy of a gripper's solenoid over a cycle [J]: pulses of twice its time, and what holds."""
        hold = self.solenoid.holds_with(self.wound)
        pulses = sum(gripper in part.grippers and part.name == RELEASE for part in cycle.parts) * 2 * self.opens_in
        held = float(np.trapezoid(openness(cycle, gripper, cycle.time), cycle.time))
        return pulses * PEAK * self.solenoid.power + held * hold


@lru_cache(maxsize=8)
def jaws_of(params: KnottingDyadParams, head: Head, hole: float) -> Jaws:
    """The jaws of a head; hole: diameter of its links' holes [m]."""
    opening, long = _opening(params), head.arm.second
    rod = hole - 2 * IN_BORE
    clamp = long - head.section.needle_length
    arm = min(STROKE * long / (opening + STROKE), max(clamp - ON_CLAMP, clamp / 2))
    tip, crank = long - arm, TAIL + params.link_thickness + IN_BORE / 2 + rod / 2
    friction = max(params.cloth.yarns.friction, LEAST_FRICTION)
    grip = grip_force(params.grip_safety, friction, 1, params.yarn_pull)
    at_rod, stroke, travel = grip * tip / arm, arm * opening / tip, max(arm, crank) * opening / tip
    held = stroke * min(params.pressed / opening, 1.0)  # of the rod, with a yarn between the jaws
    for steeper in STEEPER:
        rate = steeper * at_rod / stroke
        preload = max(at_rod - rate * held, 0.0)
        spring = choose_spring(rate, preload, travel, inner=hole, outer=hole + ROUND, length=ON_ROD, end=_LED)
        if spring is not None:
            break
    on_rod = ON_ROD if spring is None else spring.free_length - preload / rate
    solenoid = shortest(travel, SPARE * preload, SPARE * (preload + rate * travel))
    cup = 2 * COLLAR + on_rod + COLLAR + IN_BORE
    neck = max(params.room.below - params.link_thickness / 2 - HUB, cup + COLLAR)
    finger = STEEL.density * rod * TAIL * (arm + tip) * (long / arm) ** 2 / 3
    shaft = STEEL.density * math.pi * rod**2 / 4 * (HUB + neck)
    moved = solenoid.moving + shaft + finger
    deep = params.link_thickness / 2 + TAIL
    return Jaws(opening, grip, rod, arm, crank, tip, deep, preload, rate, spring, on_rod, solenoid, moved, cup, neck)


def openness(cycle: KnotCycle, gripper: str, time: FloatArray) -> FloatArray:
    """How far the jaws of a gripper are open at times of a cycle [s], 0 to 1: from each release to the next grasp."""
    events = [part for part in cycle.parts if gripper in part.grippers]
    if not events:
        return np.zeros_like(time)
    after = [float(part.name == RELEASE) for part in events]
    when = np.ravel([(part.start, part.end) for part in events])
    values = np.ravel([(before, then) for before, then in zip([after[-1], *after[:-1]], after, strict=True)])
    return np.asarray(np.interp(time, when, values))


def gripper_half(params: KnottingDyadParams) -> float:
    """From a needle's middle to the end of its open finger, the farthest along the warps [m]."""
    return depth_of(params) + _opening(params)


def depth_of(params: KnottingDyadParams) -> float:
    """From the needles' middle to the lower edge of a closed finger, under its pin and its blade [m]."""
    return max(params.link_thickness / 2 + TAIL + EYE, params.needle_breadth / 2 + TINE)


def least_clamp(params: KnottingDyadParams) -> float:
    """Length of an arm's second link before its needle, at least [m]: its width; the finger's pin before the hub."""
    return max(params.link_width, _before_hub(smallest_pin(params.strength, params.link_width)) + ON_CLAMP)


def _before_hub(hole: float) -> float:
    """From an elbow with a hole to the pin of its finger, whose lugs stand before the hub [m]."""
    return hole / 2 + HUB_WALL + LUG / 2


def _opening(params: KnottingDyadParams) -> float:
    """Opening of the jaws [m]: for a pile yarn, with the clearance on both sides."""
    return params.yarn + 2 * params.clearance


def jaw_checks(params: KnottingDyadParams, head: Head, jaws: Jaws, cycle: KnotCycle) -> Iterator[Check]:
    """The jaws hold, open and close in their times, and have their room."""
    source, parts = "assumed by this project: parameters grip_safety, yarn_pull", (f"{NAME}/finger", f"{NAME}/solenoid")
    softer = "set a smaller yarn_pull or grip_safety"
    yield must("spring of the jaws", jaws.spring is not None, "springs of the table").with_cure(softer, *parts)
    yield at_least(
        "solenoid of the jaws over their spring", jaws.reserve, 0.0, "N", f"pulse of 10 % duty; {source}"
    ).with_cure(softer, *parts)
    for name, takes, limit in (
        ("opening of the jaws", jaws.opens_in, params.release_time),
        ("closing of the jaws", jaws.closes_in, params.grasp_time),
    ):
        yield at_most(name, takes, limit, "ms", "current, then the masses at the rod").with_cure(
            "set a longer release_time or grasp_time", *parts
        )
    heat = max(jaws.energy(cycle, gripper) for gripper in (LEFT, RIGHT, CENTRE)) / cycle.period
    yield at_most(
        "heat of a solenoid of the jaws", heat, jaws.solenoid.power, "W", "its row, mounted on metal"
    ).with_cure(softer, *parts)
    body = depth_of(params) - max(params.link_thickness / 2 + UNDER, params.needle_breadth / 2 + PLAY)
    bent = 6 * jaws.grip * head.section.needle_length / (params.needle_diameter * body**2)
    yield at_most(
        "stress of a finger", bent, STEEL.strength / 1.5, "MPa", "bending where it leaves the link"
    ).with_cure(softer, parts[0])
    before = _before_hub(jaws.rod + 2 * IN_BORE)
    yield at_least("finger's pin from the elbow", jaws.arm, before, "mm", "its lugs stand before the hub").with_cure(
        "set a finer pile yarn, or a longer link", parts[0]
    )
