"""The knotting head of two mirrored arms and the centre gripper between them: what they do together, and its results.

A needle is a blade, as thin across the section as the gap requires, broader along the warps, clamped where the wide
link ends. The yarn pulls at the tip against its motion with the force F across the needle, which deflects it at the
warps, x from the clamp of the length L, by

    y = F x² (3 L - x) / 6 E I,      I = breadth d³/12                            [cantilever with a force at its end]

Along itself it bears pi² E I / 4 L² before it buckles [Euler, clamped and free]. The yarn must reach from gripper to
gripper: as the arms rest, a apart, with their tips f above the warps; while an end is handed over, at the depth h; and
round the pair in the finished knot, on the radius r = (D + d)/2, with both ends at rest:

    a,      |rest - warp| + pi r + |hand-over - warp|,      wrap + 2 f                       and two tails that are held
"""

import math
from dataclasses import asdict

import numpy as np

from ilmek.elements.knot_kinds import WRAPS
from ilmek.elements.materials import MATERIALS
from ilmek.linkage.swivelled_arm import ArmPath, SwivelledArm
from ilmek.machines.knotting_dyad.clearance import clearances
from ilmek.machines.knotting_dyad.params import KnottingDyadParams
from ilmek.machines.knotting_dyad.section import WarpSection, knot_of
from ilmek.machines.knotting_dyad.sequence import Phase, sequence
from ilmek.machines.knotting_dyad.yarn import tied_by
from ilmek.plane.round_bars import LeastDistance
from ilmek.records import computed, group, record, result
from ilmek.report import Json
from ilmek.weaving.knots.proof import TiedKnot
from ilmek.weaving.knots.word import Knot, knot

STEEL = MATERIALS["heat-treatable steel"]

SAMPLES, BENDING_SAMPLES = 401, 201
"""Samples of the path that are tabulated, and at which the needle's deflection is computed."""

REPORTED = 40
"""Every n-th sample of the path is reported."""


@record
class Head:
    """A head that ties a knot.

    knot  required          arm          the left one; the right mirrored     path  of the left arm, tabulated
    tied  proved            least        distances of everything that moves, over the whole cycle
    """

    section: WarpSection = group()
    knot: Knot
    arm: SwivelledArm
    path: ArmPath
    sequence: tuple[Phase, ...]
    least: tuple[LeastDistance, ...]
    tied: TiedKnot
    bent: float = result("um", "deflection of the needle by the yarn's pull, at the warps' axes", name="needle_bent")
    buckling: float = result("N", "load along the needle under which it buckles", name="needle_buckling")
    yarn_needed: float = result("mm", "pile yarn that the arms need for a knot")
    width: float = result("mm", "width that both arms and their motors take, along the row", name="arms_width")

    clearances = computed(
        "", "each least distance over the cycle [m]", lambda it: {one.name: one.value for one in it.least}
    )
    clearance_min = computed(
        "mm", "least of all clearances over the cycle; below 0: overlap", lambda it: min(it.clearances.values())
    )
    centre_stroke = computed("mm", "stroke of the centre gripper", lambda it: it.section.front + it.section.depth)

    @computed("", "the knot that the motion is proved to tie", absent="it is not the required one")
    def knot_tied(self) -> str | None:
        return self.knot.kind if self.tied.knot == self.knot else None

    @computed("", "conclusion of the proof; the pair's warps are 1 and 2, else warps are counted from the left")
    def proof(self) -> str:
        return knot(self.knot.kind, opens=self.knot.opens or "left").name if self.knot_tied else self.tied.words

    @computed("", "radii about the pivot that bound the workspace, where the arm is singular [m]")
    def workspace(self) -> Json:
        return {"inner": abs(self.arm.first - self.arm.second), "outer": self.arm.first + self.arm.second}

    @computed("", "of a cycle: s of the arms at begin and end, the centre gripper's height [m], carriers of the ends")
    def phases(self) -> Json:
        return [asdict(one) for one in self.sequence]

    @computed("", "of the left arm along its path, and their derivatives by s [rad]")
    def servo_angles(self) -> Json:
        names = ("s", "theta1", "theta2", "theta1_by_s", "theta2_by_s")
        values = (self.path.s, *self.path.theta.T, *self.path.first.T)
        return [
            {name: float(value[at]) for name, value in zip(names, values, strict=True)}
            for at in range(0, len(self.path.s), REPORTED)
        ]


def head_of(params: KnottingDyadParams, section: WarpSection, arm: SwivelledArm) -> Head:
    """The head of an arm."""
    required = knot_of(params)
    phases = sequence(required, section.front, -section.depth)
    return Head(
        section=section,
        knot=required,
        arm=arm,
        path=arm.path(np.linspace(0.0, 1.0, SAMPLES)),
        sequence=phases,
        least=clearances(section, arm),
        tied=tied_by(section, arm, phases),
        bent=needle_deflection(params, section, arm),
        buckling=buckling_load(params, section),
        yarn_needed=yarn_of(params, section, arm),
        width=width_of(params, section, arm),
    )


def needle_inertia(params: KnottingDyadParams, section: WarpSection) -> float:
    """Second moment of area of the needle's section, in the plane of the section across the warps [m⁴]."""
    return params.needle_breadth * section.needle**3 / 12


def buckling_load(params: KnottingDyadParams, section: WarpSection) -> float:
    """Load along the needle under which it buckles [N]: pi² E I / 4 L²."""
    return math.pi**2 * STEEL.modulus * needle_inertia(params, section) / (4 * section.needle_length**2)


def yarn_of(params: KnottingDyadParams, section: WarpSection, arm: SwivelledArm) -> float:
    """Pile yarn that the arms need for a knot [m], both tails held included."""
    rest, radius = complex(arm.tip(np.array([0.0]))[0]), (section.warp + params.yarn) / 2
    apart = 2 * (section.middle - rest.real)
    # The other arm, at rest, is the mirror image; the yarn goes from it to the first warp of the pair, and behind.
    other = complex(2 * section.middle - rest.conjugate())
    handed = abs(other) + math.pi * radius + abs(section.handover)
    wrap = WRAPS[params.knot](section.pair, radius)
    return max(apart, handed, wrap + 2 * section.front) + 2 * params.tail


def width_of(params: KnottingDyadParams, section: WarpSection, arm: SwivelledArm) -> float:
    """Width that both arms take over their motion [m]: pivots with their motors, links."""
    motor = arm.pivot.real - params.pivot_room / 2
    links = float(np.min(arm.elbow(np.linspace(0.0, 1.0, BENDING_SAMPLES)).real)) - params.link_width / 2
    return 2 * (section.middle - min(motor, links))


def needle_deflection(params: KnottingDyadParams, section: WarpSection, arm: SwivelledArm) -> float:
    """Greatest deflection of the needle [m] at the warps' axes, on its path behind them."""
    s = np.linspace(0.0, 1.0, BENDING_SAMPLES)
    beyond, length = arm.beyond(s), section.needle_length
    turn = arm.path(s).first[:, 1] * beyond  # the tip across the needle, by s; along it the stroke
    across = params.yarn_pull * np.abs(turn) / np.hypot(turn, arm.stroke)
    x = length - np.maximum(beyond, 0.0)
    inertia = needle_inertia(params, section)
    bent = across * x**2 * (3 * length - x) / (6 * STEEL.modulus * inertia)
    return float(np.max(bent[beyond >= 0]))
