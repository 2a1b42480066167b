"""The proof of a tuft: the yarn's path over a turn of needle and looper.

The yarn goes down one side of the needle to its eye, and up the other side to the backing, in which it is gripped. When
the needle has risen by r from its lowest position, the second leg has as much slack. It bulges away from the needle as
a slender rod between its ends does, by a half wave of the amplitude b:

    b = 2/pi sqrt(L r)      z(y) = b sin(pi (u - y) / L)      L = u - eye: length of the leg, u the backing's under side

                                                  [length of a sine over its chord: pi² b² / 4 L, first order in slack]

Seen along the shafts the hook passes across both legs. It is linked with the loop, closed through the backing, if it
passes in front of one and behind the other: between needle and bulge. The linking number of two curves is half the sum
of the signs of their crossings, and stays the same while none passes through the other; so a hook that has entered
holds the loop until its point goes back past the needle's line, wherever the needle is meanwhile.
                                                                                 [Rolfsen, Knots and Links, 5.D]
"""

import math

import numpy as np
from scipy.interpolate import CubicSpline

from ilmek.arrays import FloatArray
from ilmek.errors import ParameterError
from ilmek.machines.tufting_machine.params import TuftingMachineParams
from ilmek.machines.tufting_machine.product import TuftedCarpet
from ilmek.num.piecewise import roots
from ilmek.records import computed, record
from ilmek.report import Check, at_least, at_most, must
from ilmek.units import format_quantity, turn

LOOPER = "tufting-machine/looper"


@record
class NeedlePath:
    """Height of the needle's point over its lowest position, over a turn of the main shaft.

    rise     spline over the crank angle [rad], period 2 pi [m]
    lowest, highest  crank angles [rad], the highest within a turn after the lowest      stroke  [m]
    """

    rise: CubicSpline
    lowest: float
    highest: float
    stroke: float

    def up(self, rise: float) -> float:
        """Crank angle [rad] at which the point has risen so far [m] after its lowest position."""
        return self._crossing(rise, self.lowest, self.highest)

    def down(self, rise: float) -> float:
        """Crank angle [rad] at which the point comes down again so far [m] over its lowest position."""
        return self._crossing(rise, self.highest, self.lowest + turn)

    def _crossing(self, rise: float, start: float, end: float) -> float:
        """Raises ParameterError for a height that the needle does not reach."""
        found = [start + (float(angle) - start) % turn for angle in self.rise.solve(rise, extrapolate=False)]
        within = [angle for angle in found if angle <= end]
        if not within:
            given = f"the needle's point has to be {format_quantity(rise, 'mm')} over its lowest position"
            allowed = f"its stroke is {format_quantity(self.stroke, 'mm')}"
            raise ParameterError(given, allowed=allowed, do="set a lower pile_height, or a longer needle.crank")
        return min(within)


@record
class LoopGeometry:
    """Heights over the needle's lowest position, and what lies beside a needle.

    level, under  upper and under side of the backing [m]      hook   upper edge of the hook [m]
    slot   from the needle to the far side of the hook [m]      beside  that, the yarn and the needle together [m]
    """

    path: NeedlePath
    params: TuftingMachineParams
    yarn: float
    level: float
    under: float
    hook: float

    @property
    def slot(self) -> float:
        """From the needle's flank to the far side of the hook [m]."""
        return self.params.looper.gap + self.params.looper.thickness

    @property
    def hook_below(self) -> float:
        """Lower edge of the hook, with the clearance to the eye [m]."""
        return self.hook - self.params.looper.height - self.params.looper.clear

    @property
    def middle(self) -> float:
        """Middle of the hook's height [m]."""
        return self.hook - self.params.looper.height / 2

    def eye(self, angle: FloatArray) -> FloatArray:
        """Upper end of the needle's eye [m] at crank angles [rad]."""
        return np.asarray(self.path.rise(angle) + self.params.looper.eye)

    def bulge(self, angle: FloatArray) -> FloatArray:
        """Distance of the yarn from the needle at the hook's middle [m] at crank angles [rad]; 0 of a taut leg."""
        eye, rising = self.eye(angle), np.mod(angle - self.path.lowest, turn) < self.path.highest - self.path.lowest
        length, slack = np.maximum(self.under - eye, 0.0), rising * self.path.rise(angle)
        share = np.where(eye < self.middle, (self.under - self.middle) / np.maximum(length, 1e-9), 0.0)
        return np.asarray(2 / math.pi * np.sqrt(length * np.maximum(slack, 0.0)) * np.sin(math.pi * share))

    def linking_number(self, angle: FloatArray, ahead: FloatArray) -> FloatArray:
        """Linking number of the hook with a loop that it has not pushed aside: 1 between needle and bulge, else 0.

        angle  of the crank [rad]      ahead  hook's point past the needle's line [m]
        """
        across = (ahead > 0) & (self.eye(angle) < self.hook_below) & (self.middle < self.under)
        second = np.where(self.bulge(angle) >= self.slot, 1.0, -1.0)
        return np.where(across, (1.0 + second) / 2, 0.0)


def loop_geometry(params: TuftingMachineParams, path: NeedlePath, carpet: TuftedCarpet) -> LoopGeometry:
    """Heights of backing and hook."""
    level = needle_depth(params)
    under = level - params.backing_thickness
    return LoopGeometry(path, params, carpet.yarn_diameter, level, under, under - params.pile_height)


def needle_depth(params: TuftingMachineParams) -> float:
    """Depth of the needle's point under the backing's face [m]: as backing, pile, hook and eye need."""
    looper = params.looper
    return params.backing_thickness + params.pile_height + looper.height + looper.below + looper.eye


@record
class LoopWindow:
    """Crank angles of the main shaft between which the hook's point has to pass the needle's line [rad].

    opened, shut   forward: the bulge is wide enough for the hook; it is no more, or the eye comes to the hook
    out, back      backward: the needle is out of the backing; it comes down to the hook again
    opened is that of the eye where the bulge is never wide enough.
    """

    opened: float
    shut: float
    out: float
    back: float

    @property
    def middle(self) -> float:
        """Middle of the time in which the hook may enter [rad]."""
        return (self.opened + self.shut) / 2


def loop_window(geometry: LoopGeometry) -> LoopWindow:
    """When a hook can enter the loop, and when it has to leave. Raises ParameterError for too short a stroke."""
    path, looper = geometry.path, geometry.params.looper
    eye = path.up(geometry.hook_below - looper.eye)
    passed = roots(lambda angle: geometry.bulge(angle) - geometry.slot, np.linspace(path.lowest, eye, 65))
    opened, shut = (*passed.tolist(), eye, eye)[:2]
    return LoopWindow(opened, shut, path.up(geometry.level), path.down(geometry.hook + looper.clear))


@record
class Loop:
    """The proof for a looper whose point passes the needle's line at crank angles catch and release [rad].

    shift  of the hook against the needle that torsion and play allow [rad of the main shaft]
    """

    geometry: LoopGeometry
    window: LoopWindow
    catch: float
    release: float

    loop_formed = computed(
        "", "the hook enters the loop, and holds it until the needle is out", lambda it: it.linked and it.kept
    )
    timing_window = computed(
        "deg", "crank angles in which the hook can enter the loop", lambda it: [it.window.opened, it.window.shut]
    )
    catch_angle = computed("deg", "crank angle at which it enters", lambda it: it.catch)
    release_angle = computed("deg", "crank angle at which it leaves the needle's line", lambda it: it.release)
    dwell_angle = computed("deg", "turn of the crank in which it holds the loop", lambda it: it.release - it.catch)
    timing_margin = computed(
        "deg", "least distance from the ends of both windows; negative: no loop", lambda it: it.margin, least=-math.inf
    )
    depth = computed("mm", "depth of the needle's point under the backing's face", lambda it: it.geometry.level)

    @property
    def linked(self) -> bool:
        """Whether hook and loop are linked when the point has passed the needle's line."""
        after = np.array([self.catch])
        return bool(self.geometry.linking_number(after, np.ones(1))[0] == 1)

    @property
    def kept(self) -> bool:
        """Whether the hook stays until the needle is out of the backing."""
        return self.release >= self.window.out

    @property
    def margin(self) -> float:
        """Least distance from the ends of the windows [rad]."""
        window = self.window
        entry = self.catch - window.opened, window.shut - self.catch
        return min(*entry, self.release - window.out, window.back - self.release)

    @property
    def beside(self) -> float:
        """Needle, hook and yarn side by side [m]: the yarn's diameter once, on the hook's far side."""
        return self.geometry.params.looper.needle + self.geometry.slot + self.geometry.yarn

    @property
    def checks(self) -> tuple[Check, ...]:
        """The proof, step by step."""
        window, source, params = self.window, "path of the yarn", self.geometry.params
        later, earlier = "set a greater looper.late", "set a smaller looper.late"
        return (
            must("loop formed: hook and loop are linked until the needle is out", self.loop_formed, source).with_cure(
                "set looper.late to 0", LOOPER
            ),
            at_least(
                "hook enters after the loop has opened", self.catch, window.opened, "deg", "bulge of the yarn"
            ).with_cure(later, LOOPER),
            at_most(
                "hook enters before the loop closes", self.catch, window.shut, "deg", "bulge, eye under the hook"
            ).with_cure(earlier, LOOPER),
            at_least(NEEDLE_OUT, self.release, window.out, "deg", "needle's point over the backing").with_cure(
                later, LOOPER
            ),
            at_most(NEEDLE_IN, self.release, window.back, "deg", "needle's point at the hook").with_cure(
                earlier, LOOPER
            ),
            at_most(
                "needle, hook and yarn beside each other",
                self.beside,
                params.looper_gauge,
                "mm",
                "gauge of the loopers",
            ).with_cure("set a wider gauge, a thinner yarn, or thinner needles and loopers", LOOPER),
        )


NEEDLE_OUT = "hook leaves after the needle is out of the backing"
NEEDLE_IN = "hook leaves before the needle comes down to it"
