"""The knives of cut pile: one beside each hook, on a shaft that a crank-rocker swings.

Loops move back along the beak of their hooks, a stitch at each stroke, until their knife shears them: its edge comes
from below past the under edge of the hook by the overlap, and goes down again until it is under the next loop. It is
beside the beak the whole time, so behind the hook's point where that is farthest back and before its stem where it is
farthest forward; it is up where the hook is forward. The linkage is the centric one of equal coupler and rocker, which
stand square to each other where the links are short against the ground link.

The force of a cut lies against the knife's motion while the edge passes the yarn; the hook bears it.
"""

import cmath
import math

import numpy as np

from ilmek.arrays import BoolArray, ComplexArray, FloatArray
from ilmek.errors import ParameterError
from ilmek.machines.tufting_machine.looper import LooperDrive
from ilmek.machines.tufting_machine.looper_parts import hook_heights
from ilmek.machines.tufting_machine.params import LooperParams, TuftingMachineParams
from ilmek.machines.tufting_machine.rocker_drive import TIP, RockerDrive, coupled
from ilmek.machines.tufting_machine.rocker_forces import RockerMotion, rocker_motion
from ilmek.machines.tufting_machine.rocker_parts import NAME, STEEL, RockerParts, arm_radius, rocker_parts
from ilmek.part.part import Part
from ilmek.part.placement import placement
from ilmek.part.profile import Profile
from ilmek.part.shapes import Prism
from ilmek.part.tree import Occurrence
from ilmek.plane.contours import polygon
from ilmek.records import computed, group, record
from ilmek.report import Check, at_least, at_most
from ilmek.synthesis.crank_rocker.dead_centres import links_of_coupler
from ilmek.synthesis.crank_rocker.selection import CENTRIC
from ilmek.units import format_quantity

KNIFE, KNIFE_BAR = f"{NAME}/knife", f"{NAME}/knife-bar"

LONG = 0.8
"""Height of a knife over its bar, over that of a hook over its own; assumed by this project."""


@record
class KnifeDrive:
    """A drive of the knives.

    hooks  motion of the looper drive      yarn  diameter of the yarn [m]
    """

    params: TuftingMachineParams
    hooks: RockerMotion
    yarn: float
    drive: RockerDrive = group("knife_")
    moves: RockerMotion

    knife_stroke = computed("mm", "height by which the knives rise", lambda it: float(np.ptp(it.edge.imag)))
    knife_overlap = computed(
        "mm", "edge of a knife over the under edge of its hook where it is highest", lambda it: float(np.max(it.over))
    )
    cut_angle = computed(
        "deg",
        "crank angles between which a knife passes the loop that it cuts",
        lambda it: [float(at) for at in it.moves.angle[np.flatnonzero(it.cutting)[[0, -1]]]] if it.cuts else None,
        absent="it passes none",
    )

    def edge_at(self, angle: FloatArray) -> ComplexArray:
        """The middle of the edge [m] at crank angles of the main shaft [rad]."""
        return np.asarray(self.moves.moved(angle).point(self.drive.bodies[2], TIP).position)

    @property
    def edge(self) -> ComplexArray:
        """The same over the turn [m]."""
        return np.asarray(self.moves.motion.point(self.drive.bodies[2], TIP).position)

    @property
    def _beside(self) -> ComplexArray:
        """Where the edge's line meets the under edge of the hook: behind the point [m], and i times its height [m]."""
        looper = self.params.looper
        turned, under = (
            self.hooks.drive.sense * self.hooks.drive.deviation(self.moves.angle),
            looper.arm - looper.height,
        )
        across = (self.edge.real - self.hooks.shaft.real - under * np.sin(turned)) / np.cos(turned)
        height = self.hooks.shaft.imag + under * np.cos(turned) - across * np.sin(turned)
        return np.asarray(-self.hooks.drive.sense * across + 1j * height)

    @property
    def over(self) -> FloatArray:
        """The edge over the under edge of the hook over the turn [m]."""
        return np.asarray(self.edge.imag - self._beside.imag)

    @property
    def cutting(self) -> BoolArray:
        """Where in the turn the edge rises past the yarn under the hook."""
        over = self.over
        rising = np.gradient(over) > 0
        return np.asarray(rising & (over >= -self.yarn) & (over <= 0))

    @property
    def cuts(self) -> bool:
        """Whether the edge passes the yarn at all."""
        return bool(np.any(self.cutting))

    @property
    def force(self) -> ComplexArray:
        """Force of a hook and its loop on their knife over the turn [N]."""
        pace = self.moves.motion.point(self.drive.bodies[2], TIP).velocity
        size = np.abs(pace)
        return np.asarray(-self.params.knife.force * self.cutting * pace / np.where(size > 0, size, 1.0))

    @property
    def on_hook(self) -> complex:
        """Where a knife presses on its hook, in the frame of the looper's rocker [m]: while both are forward."""
        at = int(np.argmax(self.over))
        rocker = self.hooks.drive.bodies[2]
        motion = self.hooks.motion
        edge = complex(self.edge[at].real, self._beside[at].imag)
        return complex((edge - motion.origin(rocker)[at]) / motion.direction(rocker)[at])

    @property
    def checks(self) -> tuple[Check, ...]:
        """The cut, the way beside the hook, room along the shafts, transmission."""
        knife, looper, over = self.params.knife, self.params.looper, self.over
        behind, source = self._beside.real, "path of the edge against the hook"
        free = looper.reach + looper.retreat + knife.width + 2 * knife.beside
        wide = looper.needle + looper.gap + looper.thickness + knife.gap + knife.thickness
        room = min(float(np.min(behind)), float(np.min(free - behind))) - knife.width / 2
        return (
            at_most(
                "knife past the hook's under edge, below its upper one", self.knife_overlap, looper.height, "mm", source
            ).with_cure("set a smaller knife.overlap, or a higher hook", KNIFE),
            at_least(
                "knife under the next loop", -float(np.min(over)) - self.yarn, 0.5 * knife.under, "mm", source
            ).with_cure("set a larger knife.under", KNIFE),
            at_least("knife beside the hook's beak the whole turn", room, 0.0, "mm", source).with_cure(
                "set a larger knife.beside", KNIFE
            ),
            at_most(
                "needle, hook and knife beside each other", wide, self.params.looper_gauge, "mm", "gauge of the loopers"
            ).with_cure("set a thinner knife, or a wider gauge", KNIFE),
            at_least(
                "transmission angle of the knives' rocker",
                self.drive.transmission,
                looper.transmission,
                "deg",
                "parameter looper",
            ).with_cure("set another knife.distance", f"{NAME}/knife-rocker"),
        )


def under_edge(
    params: LooperParams, drive: RockerDrive, deviation: FloatArray, away: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """The under edge of a hook at x = away from its shaft [m]: along the beak from over the shaft, and its height [m].

    deviation  of the loopers from the middle of their swing, forward positive [rad]
    """
    turned, under = drive.sense * deviation, params.arm - params.height
    across = (away - under * np.sin(turned)) / np.cos(turned)
    return np.asarray(across), np.asarray(under * np.cos(turned) - across * np.sin(turned))


def knife_drive(params: TuftingMachineParams, looper: LooperDrive, hooks: RockerMotion, yarn: float) -> KnifeDrive:
    """The drive of the knives for loopers in motion. Raises ParameterError for a shaft that cannot be there."""
    knife, own, shaft = params.knife, params.looper, hooks.shaft
    line = shaft.real + looper.sense * own.arm * math.sin(looper.forward)
    behind = own.retreat + knife.beside + knife.width / 2
    away = np.array(line - looper.sense * behind - shaft.real)
    high, low = (
        float(shaft.imag + under_edge(own, looper.rocker, np.array(side * looper.rocker.swing / 2), away)[1])
        for side in (1, -1)
    )
    at = complex(line + looper.sense * knife.distance, shaft.imag + own.arm - knife.depth)
    high, low = high + knife.overlap - at.imag, low - yarn - knife.under - at.imag
    tip = complex(line - looper.sense * behind - at.real, (high + low) / 2)
    reach = abs(tip)
    if high >= reach:
        raise ParameterError(
            f"knives {format_quantity(reach, 'mm')} from their shaft cannot reach the loops",
            allowed=f"more than {format_quantity(high, 'mm')} over it",
            do="set a smaller knife.depth, or a longer knife.distance",
        )
    ends = math.asin(low / reach), math.asin(high / reach)
    swing, ground = ends[1] - ends[0], at - hooks.crank_shaft
    linkage = coupled(links_of_coupler(swing, CENTRIC, math.sqrt(0.5)), swing, CENTRIC)
    drive = RockerDrive(
        "knife",
        linkage,
        abs(ground),
        cmath.phase(ground),
        -1,
        -linkage.beta - hooks.drive.forward_end,
        swing,
        CENTRIC,
    )
    moves = rocker_motion(drive, at, cmath.rect(reach, sum(ends) / 2), params.needle.speed)
    return KnifeDrive(params, hooks, yarn, drive, moves)


@record
class KnifeParts:
    """The parts of a drive of the knives; needles: of the whole machine."""

    params: TuftingMachineParams
    needles: int
    rocker: RockerParts
    knife: Part

    def carried(self, number: int) -> tuple[Occurrence, ...]:
        """What the rocker of a drive, counted from 0, carries in its frame beside its plate."""
        away = self.params.looper.thickness + self.params.knife.gap
        heights = (z + away for z in hook_heights(self.params, self.needles, number))
        return self.rocker.carried(Occurrence(self.knife, tuple(placement(z=z) for z in heights)))


def knife_parts(params: TuftingMachineParams, drive: KnifeDrive, needles: int, like: RockerParts) -> KnifeParts:
    """The parts of a drive of the knives, which lean from their bar back to the hooks; like: those of the loopers.

    The bar lies flat on its arms, which lead straight away from the shaft.
    """
    knife, tip = params.knife, drive.moves.tip * cmath.exp(1j * drive.drive.middle)
    top, half = tip - LONG * params.looper.stem * (1 + 1j), knife.bar / 2
    over, least = abs(top), 2 * (knife.bar + arm_radius(params.looper.shaft))
    if over < least:
        raise ParameterError(
            f"the knives' bar is {format_quantity(over, 'mm')} from their shaft",
            allowed=f"at least {format_quantity(least, 'mm')}, for its arm",
            do="set a longer knife.distance, or a thinner looper.shaft",
        )
    along = cmath.exp(1j * (cmath.phase(top) - math.asin(least / 2 / over)))
    foot = half * along
    outline = polygon(np.array([tip - knife.width / 2, top - foot, top + foot, tip + knife.width / 2]))
    shape = Prism(Profile(outline), knife.thickness)
    part = Part(KNIFE, "knife", "laser-cut part", shape, STEEL, joins=(KNIFE_BAR,))
    pitch, square = params.width / params.drives, (top - 1j * foot, knife.bar, along)
    shift = knife.gap + (params.looper.thickness + knife.thickness) / 2
    made = rocker_parts(drive.drive, drive.moves.plan.mechanism, params.looper, pitch, square, like=like, shift=shift)
    return KnifeParts(params, needles, made, part)
