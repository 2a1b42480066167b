"""The path of a yarn from its package to the knife's eye, and its tension: of the farthest package and head.

    behind each part of the path     T' = T e^(f w) + mu g (f s + h)      w wrap, s level length, h rise
    while the head draws             T  = (T0 + mu v²) ... + mu L a       v, a greatest speed and acceleration, L length

T0 is the force of the brake: as great as leaves the pull at the eye at what the head's drives count with, within what
a brake can do. f is the friction of the yarn on steel, or on the PTFE of the conduits.     [capstan equation, Euler,
Eytelwein; momentum of the yarn that is set in motion; weight; derived]
"""

import math
from functools import lru_cache

import numpy as np

from ilmek.elements.carpet_yarns import YarnProperties
from ilmek.elements.field_devices import BRAKE, BRAKE_FORCES
from ilmek.elements.materials import GRAVITY
from ilmek.machines.automated_loom.design import LoomDesign
from ilmek.machines.automated_loom.equipment import signals
from ilmek.machines.automated_loom.equipment.creel import BRAKE_ID, CONDUIT, PACKAGE, Creel, creel_of
from ilmek.machines.automated_loom.equipment.energy_chain import energy_chain, trough_box
from ilmek.machines.automated_loom.on_rail import share_of
from ilmek.machines.weaver.motions import HANDLER
from ilmek.machines.weaver.parts import TUBE
from ilmek.machines.weaver.yarn_lead import YARN_GUIDE, yarn_line, yarn_wraps
from ilmek.records import computed, record
from ilmek.report import Check, Table, at_least, at_most, columns
from ilmek.timing.track import peak_acceleration, peak_speed
from ilmek.units import turn
from ilmek.weaving.tension import capstan

PTFE = 0.65
"""Friction of a yarn on PTFE over that on steel; assumed by this project."""

STRENGTH_USED = 0.1
"""Tension of a yarn along its path over its breaking force, at most; assumed by this project."""


@record
class PathStep:
    """A part of the path: name, length [m], rise [m], wrap [rad], and its friction over that of the yarn on steel."""

    name: str
    length: float
    rise: float = 0.0
    wrap: float = 0.0
    share: float = 1.0

    def behind(self, tension: float, yarn: YarnProperties) -> float:
        """Tension [N] behind it of a yarn that enters with a tension [N]."""
        level = math.sqrt(max(self.length**2 - self.rise**2, 0.0))
        friction = self.share * yarn.friction
        weight = yarn.linear_density * GRAVITY * (friction * level + self.rise)
        return max(tension * capstan(friction, self.wrap) + weight, 0.0)


@record
class YarnPath:
    """The path with the motion of the yarn: greatest speed [m/s] and acceleration [m/s²], force of the brake [N]."""

    steps: tuple[PathStep, ...]
    yarn: YarnProperties
    speed: float
    acceleration: float
    brake: float

    wrap = computed("deg", "angle of wrap on that path", lambda it: it.wraps, name="yarn_wrap")
    brake_force = computed("N", "force of the brakes of the creel", lambda it: it.brake, name="yarn_brake")

    @computed("m", "path of a yarn from its package to the eye of its head, the longest", name="yarn_path")
    def length(self) -> float:
        return math.fsum(step.length for step in self.steps)

    @computed("N", "pull of a yarn at the eye of its head while it is drawn", name="yarn_tension")
    def tension(self) -> float:
        return self.tensions[-1] + self.inertia

    @property
    def wraps(self) -> float:
        """Sum of the wraps [rad]."""
        return math.fsum(step.wrap for step in self.steps)

    @property
    def conduit(self) -> float:
        """Length of a conduit, from brake to tube [m]."""
        return math.fsum(step.length for step in self.steps[1:-2])

    @property
    def inertia(self) -> float:
        """Force that accelerates the yarn [N]."""
        return self.yarn.linear_density * self.length * self.acceleration

    @property
    def tensions(self) -> tuple[float, ...]:
        """Tension behind each part, of a yarn at its greatest speed [N]."""
        return tensions(self.steps, self.yarn, self.brake + self.yarn.linear_density * self.speed**2)


def tensions(steps: tuple[PathStep, ...], yarn: YarnProperties, tension: float) -> tuple[float, ...]:
    """Tension behind each part of a path [N], of a yarn that enters it with a tension [N]."""
    behind = []
    for step in steps:
        tension = step.behind(tension, yarn)
        behind.append(tension)
    return tuple(behind)


@lru_cache(maxsize=4)
def yarn_path(loom: LoomDesign) -> YarnPath:
    """The longest path of a loom's yarns, and the brake's force for it."""
    weaver, yarn, steps = loom.weaver, loom.task.yarns.pile, _steps(loom, creel_of(loom))
    handler, period = weaver.cyclogram.track(HANDLER), weaver.cyclogram.period
    speed = weaver.handler_radius * peak_speed(handler, period)
    acceleration = weaver.handler_radius * peak_acceleration(handler, period)
    path = YarnPath(steps, yarn, speed, acceleration, 0.0)
    # The tension at the end is a line over that at the begin, by which it is solved.
    ratio, most_pull = (
        math.prod(capstan(step.share * yarn.friction, step.wrap) for step in steps),
        weaver.params.forces.yarn_pull,
    )
    by_weight = tensions(steps, yarn, most_pull)[-1] - ratio * most_pull
    wished = (most_pull - path.inertia - by_weight) / ratio - yarn.linear_density * speed**2
    least, most = BRAKE_FORCES
    return YarnPath(steps, yarn, speed, acceleration, min(max(wished, least), most))


def _steps(loom: LoomDesign, creel: Creel) -> tuple[PathStep, ...]:
    (start, height, depth), (low, high) = creel.mouth, trough_box(loom)
    nose, half = abs(creel.inner - creel.base) - BRAKE.size[2] - creel.size, creel.size / 2
    y, z = max(creel.axes, key=lambda one: math.hypot(one[0] - height, one[1] - depth))
    along, up = abs(creel.duct_end) - float(high[0]), float(low[1] + high[1]) / 2 - height
    loop = math.hypot(along, up)
    share, long = share_of(loom), float(high[0] - low[0])
    heads = loom.side.of_heads
    tube, middle = heads.shape.magazine, float(low[2] + high[2]) / 2
    rise, back = tube.imag - float(low[1]), middle - tube.real
    line, (at_tube, at_guide, at_eye) = yarn_line(loom.weaver), yarn_wraps(loom.weaver)
    first, last = np.diff(line, axis=0).tolist()
    return (
        PathStep("from the package over its nose", math.hypot(nose, half), 0.0, math.atan2(half, nose)),
        PathStep("conduit to the duct", math.hypot(y - height, z - depth), height - y, turn / 2, PTFE),
        PathStep("duct over the foot", abs(creel.duct_end - start), share=PTFE),
        PathStep("loop to the rail", loop + heads.retreat, up, 2 * math.atan2(abs(up), max(along, 0.0)), PTFE),
        PathStep("trough to the farthest head", long - share / 2, share=PTFE),
        PathStep("energy chain", energy_chain(loom).length(share), 0.0, turn / 2, PTFE),
        PathStep("to the tube", math.hypot(rise, back), rise, turn / 4, PTFE),
        PathStep("from the tube to the guide", math.hypot(*first), first[1], at_tube + at_guide),
        PathStep("from the guide to the eye", math.hypot(*last), last[1], at_eye),
    )


def yarn_checks(loom: LoomDesign) -> tuple[Check, ...]:
    """The pull at the eye, the force of the brakes, and the tension against the yarn's strength."""
    path, pull = yarn_path(loom), loom.weaver.params.forces.yarn_pull
    cure = "set a greater weaver.forces.yarn_pull, or a lower yarns.friction"
    return (
        at_most(
            "yarn path: pull at the eye",
            path.tension,
            pull * (1 + _ROUNDING),
            "N",
            "weaver.forces.yarn_pull, with which the head's drives count; capstan equation",
        ).with_cure(cure, YARN_GUIDE, TUBE, CONDUIT, BRAKE_ID),
        at_least(
            "yarn path: force of the brakes",
            path.brake,
            BRAKE_FORCES[0],
            "N",
            "least of the brake's range: less lets a package overrun",
        ).with_cure(cure, BRAKE_ID, signals.YARN_STOP),
        at_most(
            "yarn path: tension of the yarn",
            path.tension,
            STRENGTH_USED * path.yarn.breaking_force,
            "N",
            "a tenth of its breaking force, assumed by this project",
        ).with_cure("set a heavier pile yarn", PACKAGE, TUBE),
    )


_ROUNDING = 1e-9


def yarn_tables(loom: LoomDesign) -> tuple[Table, ...]:
    """The parts of the path with their lengths, wraps and tensions."""
    path = yarn_path(loom)
    rows = tuple(
        (step.name, step.length, step.wrap, tension) for step, tension in zip(path.steps, path.tensions, strict=True)
    )
    heads = columns("part of the path", "length [m]", "wrap [deg]", "tension behind it [N]")
    return (Table("loom-yarn-path", "Path of a yarn from its package to its tube", heads, rows),)
