"""The compensator over a turn of the shedding cams: equilibrium of its bars, tensions of both parities, forces."""

import math

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.cams.laws import LAWS
from ilmek.cams.programme import TURN, CamProgramme, dwell, fall, rise
from ilmek.machines.tension_compensator.design import TensionCompensator, equilibrium_tension
from ilmek.machines.tension_compensator.linkage import PIVOT, lever_forces, spring_forces
from ilmek.machines.tension_compensator.params import TensionCompensatorParams
from ilmek.machines.tension_compensator.synthesis import BarTask, SprungLever
from ilmek.records import computed, group, record
from ilmek.weaving.shed import shed_lengthening

SAMPLES = 181
"""Cam angles of the analysis, 2 degrees apart."""

BALANCE = 1e-6
"""Torque missing to the equilibrium, over that of the warps, that counts as rounding."""

BEYOND = 0.02
"""Rotation beyond rest and open shed in which the equilibrium is sought [rad]."""

TABLE, POLISHING = 129, 5
"""Rotations of the table by which the equilibrium is found, and corrections after it."""


@record
class CompensatorAnalysis:
    """A compensator over a turn.

    angle            of the cams [rad], (SAMPLES,)        even, odd  tensions of a warp of each parity [N]
    rotation         of the levers of the even warps' bar [rad], or of the only one
    spring           force of each of its springs [N]     pivot      force on a lever's pivot [N]
    effort           torque that the engine finds missing to the equilibrium [N m]
    """

    design: TensionCompensator = group()
    angle: FloatArray
    even: FloatArray
    odd: FloatArray
    rotation: FloatArray
    spring: FloatArray
    pivot: FloatArray
    effort: FloatArray

    tension_max = computed("N", "greatest tension of a warp over the turn", lambda it: float(it.both.max()))
    tension_min = computed("N", "least tension of a warp over the turn", lambda it: float(it.both.min()))
    spring_max = computed("N", "greatest force of a spring over the turn", lambda it: float(it.spring.max()))
    pivot_force = computed("N", "greatest force on a lever's pivot", lambda it: float(it.pivot.max()))
    energy = computed(
        "J", "energy that the springs of all bars take up when a shed opens", lambda it: it.stored, name="spring_energy"
    )

    @property
    def balanced(self) -> bool:
        """Whether warps and springs are in equilibrium over the whole turn."""
        return bool(np.abs(self.effort).max() <= BALANCE * self.design.loads.torque)

    @property
    def both(self) -> FloatArray:
        """Tensions of both parities [N], (2, SAMPLES)."""
        return np.stack([self.even, self.odd])

    @property
    def stored(self) -> float:
        """Energy of the springs of a bar in the open shed beyond that at rest [J]."""
        one, params = self.design.one, self.design.params
        force = spring_forces(one, np.array([0.0, one.angle]))
        return float(params.levers * one.springs * (force[1] ** 2 - force[0] ** 2) / (2 * one.rate))


def lifting(params: TensionCompensatorParams) -> CamProgramme:
    """The lift of an even warp over the turn of the cams."""
    law, rest = LAWS[params.law], TURN - params.lifted_angle
    segments = (
        rise(params.rise, params.lift, law),
        *((dwell(params.dwell),) if params.dwell > 0 else ()),
        fall(params.fall, params.lift, law),
        *((dwell(rest),) if rest > 1e-9 else ()),
    )
    return CamProgramme(segments)


def equilibrium(one: SprungLever, lengthening: FloatArray) -> FloatArray:
    """Rotations of a lever [rad] at which warps of a mean lengthening [m] and springs are in equilibrium.

    The lengthening that belongs to a rotation is known in closed form: what the lever gives and what the tension that
    holds the springs stretches. It is inverted on a table, then to rounding. 0 where the lever counts as fixed: where
    the lengthening does not grow with the rotation, a small one has no equilibrium.
    """
    task, fixed = one.task, np.zeros(lengthening.shape)
    if one.angle <= 0:
        return fixed

    def longer(phi: FloatArray) -> FloatArray:
        return np.asarray(one.lever.slack(phi) + (equilibrium_tension(one, phi) - task.tension) / task.rate)

    angles = np.linspace(-BEYOND, one.angle + BEYOND, TABLE)
    table = longer(angles)
    slope = np.gradient(table, angles)
    if not (slope > 0).all():
        return fixed
    found = np.interp(lengthening, table, angles)
    for _ in range(POLISHING):
        found = found - (longer(found) - lengthening) / np.interp(found, angles, slope)
    return np.asarray(found)


def mean_tension(task: BarTask, lengthening: FloatArray, slack: FloatArray) -> FloatArray:
    """Mean tension of the warps of a bar [N] that gives a length of each [m]."""
    return np.asarray(task.tension + task.rate * (lengthening - slack))


def lengthenings(params: TensionCompensatorParams, lift: FloatArray) -> FloatArray:
    """Mean lengthenings of the warps of a parity [m] at lifts of them [m]."""
    spans = params.front_span, params.back_span
    scale = params.longer / float(shed_lengthening(params.lift, *spans))
    return np.asarray(scale * shed_lengthening(lift, *spans))


def lever_rotations(design: TensionCompensator, even: FloatArray, odd: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Rotations of the levers of both parities [rad] at lifts of even and odd warps [m]; of one bar the same."""
    longer = [lengthenings(design.params, lift) for lift in (even, odd)]
    if design.bars == 1:
        longer = [(longer[0] + longer[1]) / 2] * 2
    of_even, of_odd = (equilibrium(design.one, mean) for mean in longer)
    return of_even, of_odd


def analyse(design: TensionCompensator) -> CompensatorAnalysis:
    """The compensator over a turn, by the linkage engine."""
    params, one = design.params, design.one
    angle = np.linspace(0.0, TURN, SAMPLES)
    programme = lifting(params)
    even, odd = (lengthenings(params, programme.at(angle - lag).s) for lag in (0.0, math.pi))
    mean = even if design.bars == 2 else (even + odd) / 2
    rotation = equilibrium(one, mean)
    tension = mean_tension(one.task, mean, one.lever.slack(rotation))
    forces = lever_forces(one, rotation, params.speed * np.gradient(rotation, angle), tension)
    if design.bars == 2:
        other = mean_tension(one.task, odd, one.lever.slack(equilibrium(one, odd)))
    else:
        other = tension + one.task.rate * (odd - mean)
        tension = tension + one.task.rate * (even - mean)
    return CompensatorAnalysis(
        design,
        *(angle, tension, other, rotation, spring_forces(one, rotation)),
        pivot=np.abs(forces.pin(PIVOT)),
        effort=forces.effort("lever"),
    )
