"""Synthesis of the compensator: the springs and their lean for the least swing of the tension.

A bar's warps, N on a lever, lengthen by l in the open shed. Held fast they would gain k l each, k = EA / L. A bar that
gives x of warp against the rate K, referred to the warp, is in equilibrium at

    x = N k l / (K + N k),      T = T0 + k (l - x) = T0 + k l s / (1 + s),      s = K / (N k)

The smaller s, the less the tension swings; s is given (`rate_share`). An error of a tenth in the springs' rate changes
the tension in the open shed by a few percent. Rest and open shed fix the torque of the springs in two positions, and
with a lean delta their preload and rate:

    F0 = N T0 W(0) / S(0),    F1 = N T1 W(phi1) / S(phi1),    ks = (F1 - F0) / (c(0) - c(phi1))

W, S arms of warps and springs, c length of the springs. Of all leans that with the least energy F1^2 / (2 ks) is taken:
the mass of a spring is proportional to the energy that it stores.                                         [derived]

With one bar for all warps l is half of the lifted warps' lengthening, and of its two halves one is k l / 2 tighter and
one k l / 2 slacker than the mean.
"""

import math
from dataclasses import dataclass, replace
from itertools import product

import numpy as np

from ilmek.elements.springs import CompressionSpring, choose_spring
from ilmek.errors import ParameterError
from ilmek.machines.tension_compensator.geometry import Lever, WarpPath
from ilmek.machines.tension_compensator.params import TensionCompensatorParams
from ilmek.records import record
from ilmek.units import deg, format_quantity, mm

LEANS = np.arange(0.0, 46.0, 1.0) * deg
"""Leans of the springs that are tried [rad]; beyond 45 deg small errors of the pins change the arm too much."""

SPRINGS = (1, 2, 3, 4, 5, 6, 8, 10, 12, 14, 16, 20)
"""Springs on a lever that are tried."""

USUAL_WIRES = "music wire", "chrome-silicon wire"
"""Wires that are tried one after the other: the second is stronger."""

PLAY = 1 * mm
"""Play of rollers and springs to what is beside them along their axis [m]; assumed by this project."""

SPREAD, ARM_SHARE = 6.0, 0.55
"""Least height of the rods over the bar, over the warp that a bar gives and over its arm; assumed by this project."""

NARROWEST = 2.5
"""Least height of the rods over the bar, over the radius of both: they do not meet."""

SEATS = 40 * mm
"""Of the springs' length from pin to pin, taken by their seats and pins; assumed by this project."""

FARTHEST = 60 * deg
"""Largest rotation of a lever."""

_GRID = 241


@dataclass(frozen=True, slots=True)
class BarTask:
    """What a bar has to do: warps on a lever N, k [N/m], T0 [N], lengthening l of their mean in the open shed [m]."""

    warps: float
    rate: float
    tension: float
    lengthening: float

    def open_tension(self, share: float) -> float:
        """Mean tension in the open shed [N] with a rate of the compensator over that of its warps."""
        return self.tension + self.rate * self.lengthening * share / (1 + share)


@record
class SprungLever:
    """A lever with its springs.

    angle      phi1, in the open shed [rad]            springs  on the lever
    preload, force, rate  of one spring, at rest and in the open shed [N], [N/m]      spring  None: none of the table
    """

    lever: Lever
    task: BarTask
    angle: float
    springs: int
    preload: float
    force: float
    rate: float
    spring: CompressionSpring | None

    @property
    def free_length(self) -> float:
        """Springs from pin to pin without force [m]."""
        return float(self.lever.spring_length(0.0)) + self.preload / self.rate

    def clearance(self, height: float) -> float:
        """Least distance of the edge of a lever of a height from the lower rod [m], at rest and in the open shed."""
        lever, least = self.lever, np.inf
        rod = complex(-lever.path.radius, -lever.path.half)
        for angle in (0.0, self.angle):
            arm = complex(lever.bar(angle)) - lever.pivot
            along = ((rod - lever.pivot) * arm.conjugate()).real / abs(arm) ** 2
            least = min(least, abs(rod - lever.pivot - min(max(along, 0.0), 1.0) * arm))
        return least - lever.path.radius - height / 2

    @property
    def pitch(self) -> float:
        """Distance of two springs beside each other [m]; 0 where none of the table is enough."""
        return 0.0 if self.spring is None else self.spring.diameter + self.spring.wire_diameter + PLAY


def lever_for(params: TensionCompensatorParams, radius: float, slack: float, span: float = 0.0) -> Lever:
    """The lever for rollers of a radius [m] that is to give a length of warp [m], its springs upright.

    The rods stand so far from the bar that the strands' deflection changes little, at least a span [m]. Raises
    ParameterError for a guide_span at which bar and rods meet.
    """
    if params.guide_span is not None and params.guide_span < NARROWEST * radius:
        shown, least = (format_quantity(one, "mm") for one in (params.guide_span, NARROWEST * radius))
        given = f"guide_span={shown} between rollers of {format_quantity(2 * radius, 'mm')}"
        raise ParameterError(given, allowed=f"at least {least}", do="leave guide_span out, or set a smaller bar_tube")
    usual = max(4 * radius, SPREAD * slack, ARM_SHARE * params.bar_arm, span)
    path = WarpPath(params.guide_span or usual, radius)
    rest = path.at_rest(params.strand_angle)
    return Lever(path, rest, params.bar_arm, params.arm_angle, params.spring_arm, params.strut, 0.0)


def open_angle(lever: Lever, slack: float) -> float:
    """Rotation that gives a length of warp [m]; the largest of the linkage where none does."""
    angles = np.linspace(0.0, FARTHEST, _GRID)
    with np.errstate(invalid="ignore"):
        given, arms = lever.slack(angles), lever.warp_arm(angles)
    usable = np.isfinite(given) & (arms > 0)
    last = int(np.argmin(usable)) - 1 if not usable.all() else _GRID - 1
    if last < 1 or given[last] <= slack:
        return float(angles[max(last, 1)])
    found = float(np.interp(slack, given[: last + 1], angles[: last + 1]))
    for _ in range(4):
        found -= (float(lever.slack(found)) - slack) / float(lever.warp_arm(found))
    return found


def synthesise(params: TensionCompensatorParams, task: BarTask, radius: float, span: float = 0.0) -> SprungLever:
    """Lean and springs of a lever, its rods at least a span [m] from its bar."""
    wanted = task.lengthening - (task.open_tension(params.rate_share) - task.tension) / task.rate
    upright = lever_for(params, radius, wanted, span)
    angle = open_angle(upright, wanted)
    tension = task.tension + task.rate * (task.lengthening - float(upright.slack(angle)))
    leaning = replace(upright, lean=LEANS)
    arms, lengths = leaning.spring_moment_arm, leaning.spring_length
    with np.errstate(divide="ignore", invalid="ignore"):
        preload = task.warps * task.tension * float(upright.warp_arm(0.0)) / arms(0.0)
        force = task.warps * tension * float(upright.warp_arm(angle)) / arms(angle)
        rate = (force - preload) / (lengths(0.0) - lengths(angle))
        energy = np.where((rate > 0) & (arms(angle) > 0), force**2 / (2 * rate), np.inf)
    best = int(np.argmin(energy))
    lever = SprungLever(
        replace(upright, lean=float(LEANS[best])),
        *(task, angle, 1, float(preload[best]), float(force[best]), float(rate[best]), None),
    )
    if np.isfinite(energy[best]):
        return with_springs(params, lever)
    # No lean gives such torques: the lever counts as fixed, and its check fails.
    return replace(lever, angle=0.0, force=lever.preload, rate=lever.preload / params.strut)


def spring_room(params: TensionCompensatorParams, number: int) -> float:
    """Greatest outer diameter of so many springs of a lever [m]: they stand on both sides of it, in its share of the
    width.
    """
    beside = (params.cloth.width / params.levers - params.lever_thickness) / 2
    return beside / math.ceil(number / 2) - PLAY


def wires(params: TensionCompensatorParams) -> tuple[str, ...]:
    """The wires offered for the springs."""
    return USUAL_WIRES if params.wire is None else (params.wire,)


def with_springs(params: TensionCompensatorParams, one: SprungLever) -> SprungLever:
    """The lever with the fewest springs of the table, or the number given; with the most where none is enough."""
    numbers = (params.springs,) if params.springs else SPRINGS
    made = [shared(params, one, number, wire) for wire, number in product(wires(params), numbers)]
    return next((one for one in made if one.spring is not None), made[-1])


def shared(params: TensionCompensatorParams, one: SprungLever, number: int, wire: str) -> SprungLever:
    """The lever with its springs' force shared by a number of them, of a wire."""
    total = one.springs
    preload, force, rate = (total * value / number for value in (one.preload, one.force, one.rate))
    travel = (force - preload) / rate
    spring = choose_spring(
        rate,
        preload,
        travel,
        wire=wire,
        outer=spring_room(params, number),
        length=params.strut - SEATS,
        fatigue=params.spring_fatigue,
    )
    return replace(one, springs=number, preload=preload, force=force, rate=rate, spring=spring)
