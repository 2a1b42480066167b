"""Design of the shed that a weaver opens with rod and string heddles [thesis, 3.2, Figures 3.13 to 3.15].

Every other warp runs before a rod of the diameter d, its neighbours behind it, and a string of a heddle bar is about
each of these. In the side view a warp is a chain of straight pieces from the fell (0, 0) to the upper cylinder (0, H);
z to the front, y up [m].

    rod pulled down to yl, strings slack     front warps over (d/2, yl), rear warps over (-d/2, yl)
                                             opening  s = d hw / yl
    rod pushed up to yh, strings pulled      rear warps over (p, hg) and (-d/2, yh), front warps over (d/2, yh)
                                             opening  s = hw (p / hg - d / (2 yh))

A warp of the stiffness EA that is longer by dL has T' = T + EA dL / L, L its length from fell to cylinder, and presses
on what deflects it with T' times the change of the sine of its slope. The rod is the thinnest stock tube that opens the
shed and does not bend; its sag and that of the bar are made up for by p. A lever of the length R turns the bar about
its pivot on the arm r: the hand's force is F r / R. The rod slides with the friction of all warps on it and its weight.
Both hands of a weaver alone move the rod's ends in turn, with half of its force each; two or more move it together.
"""

import math
from collections.abc import Sequence
from dataclasses import replace
from functools import lru_cache

import numpy as np

from ilmek.elements.beam import uniform
from ilmek.elements.columns import STEEL
from ilmek.elements.materials import GRAVITY
from ilmek.elements.tubes import TUBES, Tube, find_tube
from ilmek.machines.hand_shed.params import HandShedParams
from ilmek.records import computed, record, result
from ilmek.units import deg, mm

ARM, SWING = 80 * mm, 30 * deg
"""Usual arm of the heddle bar [m], and its greatest swing to a side [rad]; assumed by this project."""

SHAFT = find_tube("48.3x3.2")
"""Tube of the heddle bar's shaft, which joins both levers; assumed by this project."""

BESIDE = 10 * mm
"""From the edge of the cloth to the arms of the heddle bar [m]; assumed by this project."""

PLATE, GAP, SIDE_PLATE = 12 * mm, 1 * mm, 10 * mm
"""Thickness of arms and levers, gap beside them, thickness of the side plates [m]; assumed by this project."""

STRING = 40 * mm
"""String of a heddle from the bar to its warp at least [m]; assumed by this project."""

LOCK_ARM, LOCK_PIN = 120 * mm, 12 * mm
"""From the pivot to the pin that locks a lever, and its diameter [m]; assumed by this project."""

_STEP = 10 * mm
"""Lengths of levers are multiples of this [m]."""


@record
class WarpInShed:
    """A warp over its points in the side view, z + i y [m]: tension [N], slopes of its pieces as sines."""

    tension: float
    sines: tuple[float, ...]

    def force(self, point: int) -> float:
        """Force on what deflects it at a point of the chain, the first beyond the fell is 1 [N]; to the rear above 0.

        >>> round(WarpInShed(10.0, (0.1, -0.2)).force(1), 9)
        3.0
        """
        return self.tension * (self.sines[point - 1] - self.sines[point])


def warp_in_shed(params: HandShedParams, points: Sequence[complex]) -> WarpInShed:
    """A warp of the cloth from the fell over points [m] to the upper cylinder."""
    chain = np.array([0j, *points, 1j * params.free_length])
    pieces = np.diff(chain)
    longer = float(np.abs(pieces).sum()) - params.free_length
    rate = params.cloth.carpet_yarns.warp.stiffness / params.free_length
    return WarpInShed(params.cloth.warp_tension + rate * longer, tuple(float(one) for one in pieces.real / abs(pieces)))


@record
class HandShed:
    """The shed, designed.

    rod, bar   stock tubes       low, high  a front or rear warp with the rod pulled down; the rear and the front one
    with the rod up and the strings pulled
    """

    params: HandShedParams
    rod: Tube
    bar: Tube
    low: WarpInShed
    rear: WarpInShed
    front: WarpInShed
    arm: float = result("mm", "from the pivot of the heddle bar to its axis", name="heddle_arm")
    pulled: float = result("mm", "rear warps before the plane of the warps, pulled by their strings")
    lever: float = result("mm", "length of a hand lever from its pivot")

    rod_tube = computed("", "stock tube of the shed rod", lambda it: it.rod.name)
    bar_tube = computed("", "stock tube of the heddle bar", lambda it: it.bar.name)
    stroke = computed(
        "mm",
        "stroke of the heddle bar: from slack strings to the pulled warps",
        lambda it: it.pulled + it.rod.outer / 2 * it.params.heddle_height / it.params.rod_low + it.params.clearance,
    )
    lift_angle = computed("deg", "swing of a lever", lambda it: 2 * math.asin(min(it.stroke / 2 / it.arm, 1.0)))
    lever_ratio = computed("1", "lever over the arm of the heddle bar", lambda it: it.lever / it.arm)
    heddle_force = computed("N", "force of all pulled warps on the heddle bar", lambda it: it.pulled_warps * it.pull)
    string_force = computed("N", "force of a string heddle", lambda it: it.pull)
    lever_force = computed(
        "N", "force of a hand on its lever", lambda it: it.heddle_force / it.lever_ratio / it.hands_on_levers
    )
    hand_travel = computed("mm", "travel of the hand at the end of its lever", lambda it: it.lever * it.lift_angle)
    lock_force = computed(
        "N", "force of the pin that locks a lever", lambda it: it.heddle_force / 2 * it.arm / LOCK_ARM
    )
    rod_friction = computed(
        "N", "friction of all warps on the rod, pulled down", lambda it: it.friction_of(2 * it.pulled_warps * it.press)
    )
    rod_weight = computed("N", "weight of the shed rod", lambda it: it.rod.mass(STEEL.density) * it.length * GRAVITY)
    rod_force = computed(
        "N",
        "force of a hand that pushes the rod up",
        lambda it: (it.rod_friction + it.rod_weight) / max(2 * it.params.weavers, 4),
    )
    tension_open = computed("N", "tension of a pulled warp", lambda it: it.rear.tension, name="tension_pulled")
    rod_deflection = computed(
        "mm", "sag of the rod, the strings pulled", lambda it: it.rod_bending[0], name="rod_sag", least=0.0
    )
    bar_deflection = computed(
        "mm", "sag of the heddle bar", lambda it: sag_of(it.bar, it.heddle_force, it.length), name="bar_sag", least=0.0
    )
    bar_stress = computed("MPa", "stress of the heddle bar", lambda it: stress_of(it.bar, it.heddle_force, it.length))
    rod_stress = computed("MPa", "stress of the shed rod", lambda it: it.rod_bending[1])

    @computed("mm", "opening at the weft, the rod pulled down", name="opening_low")
    def opening_low(self) -> float:
        return self.rod.outer * self.params.weft_height / self.params.rod_low

    @computed("mm", "opening at the weft in the middle, the strings pulled, sags of rod and bar subtracted")
    def opening_high(self) -> float:
        params = self.params
        front = self.rod.outer / 2 + self.rod_deflection
        rear = self.pulled - float(self.bar_deflection)
        return params.weft_height * (rear / params.heddle_height - float(front) / params.rod_high)

    @property
    def string(self) -> float:
        """Length of a string from the bar to its warp [m]: the slack bar keeps clear of the front warps."""
        warps = self.rod.outer / 2 * self.params.heddle_height / self.params.rod_low
        return max(STRING, 2 * warps + 2 * self.params.clearance)

    @property
    def width(self) -> float:
        """Of the warps [m]."""
        return self.params.cloth.width

    @property
    def length(self) -> float:
        """Of rod and heddle bar between their supports [m]."""
        return self.width + 2 * BESIDE

    @property
    def bar_limit(self) -> float:
        """Allowed sag of the heddle bar [m]."""
        return self.params.bar_sag * self.length

    @property
    def pulled_warps(self) -> int:
        """Warps with a string: every other one, the first too."""
        return (self.params.cloth.warps + 1) // 2

    @property
    def pull(self) -> float:
        """Force of a string [N]."""
        return self.rear.force(1)

    @property
    def press(self) -> float:
        """Force of a warp on the rod, pulled down [N]."""
        return abs(self.low.force(1))

    @property
    def rod_load(self) -> float:
        """Force of all warps across the rod, the strings pulled [N]: the rear ones forwards, the front ones back."""
        return self.pulled_warps * abs(-self.rear.force(2) - self.front.force(1))

    @property
    def rod_bending(self) -> tuple[float, float]:
        """Sag [m] and stress [Pa] of the rod between its ends: the warps on both sides hold it like a foundation."""
        params, high = self.params, self.params.rod_high
        each = self.front.tension * (1 / high + 1 / (params.free_length - high))
        rate = params.cloth.warps * each / self.length
        return on_foundation(self.rod, self.rod_load / self.length, rate, self.length)

    @property
    def hold(self) -> float:
        """Friction that holds the rod up, the strings pulled [N]."""
        return self.friction_of(self.pulled_warps * (abs(self.rear.force(2)) + abs(self.front.force(1))))

    @property
    def hands_on_levers(self) -> int:
        """Hands at the two levers: one each of a weaver alone, else two."""
        return 2 if self.params.weavers == 1 else 4

    def friction_of(self, force: float) -> float:
        """Friction of warps that press with a force in all [N]."""
        return self.params.cloth.yarns.friction * force


def sag_of(tube: Tube, force: float, length: float) -> float:
    """Deflection in the middle [m] of a tube under a force spread over its length: 5 F l³ / (384 E I).

    >>> from ilmek.elements.tubes import find_tube
    >>> tube = find_tube("40x3")
    >>> round(sag_of(tube, 1000.0, 1.0) * 384 * 210e9 * tube.inertia, 6)
    5000.0
    """
    return float(uniform.deflection_max(force / length, length, STEEL.modulus, tube.inertia))


def on_foundation(tube: Tube, load: float, rate: float, length: float) -> tuple[float, float]:
    """Sag [m] and stress [Pa] in the middle of a tube with both ends supported, on what yields evenly.

    u = l / 2 (k / 4 E I)^(1/4),   D = cosh 2u + cos 2u
    y = q / k (1 - 2 cosh u cos u / D),   M = q l² / (4 u²) sinh u sin u / D           [Hetenyi, 1946]

    load  q [N/m]      rate  k of the foundation [N/m²]      length  l [m]
    """
    stiff = STEEL.modulus * tube.inertia
    u = length / 2 * (rate / (4 * stiff)) ** 0.25
    both = math.cosh(2 * u) + math.cos(2 * u)
    sag = load / rate * (1 - 2 * math.cosh(u) * math.cos(u) / both)
    moment = load * length**2 / (4 * u**2) * math.sinh(u) * math.sin(u) / both
    return sag, abs(moment) * tube.outer_radius / tube.inertia


def stress_of(tube: Tube, force: float, length: float) -> float:
    """Bending stress [Pa] of such a tube: F l / 8 over its section modulus."""
    return float(uniform.bending_stress(uniform.moment_max(force / length, length), tube.outer_radius, tube.inertia))


@lru_cache(maxsize=8)
def design(params: HandShedParams) -> HandShed:
    """Rod, bar, strings and levers: the thinnest tubes that keep the limits, the stiffest where none does."""
    tubes = sorted(TUBES.values(), key=lambda tube: (tube.outer, tube.area))
    needed = params.opening * params.rod_low / params.weft_height
    wide = [tube for tube in tubes if tube.outer >= needed * (1 - 1e-9)] or tubes[-1:]
    for tube in wide[:-1]:
        shed = _with_rod(params, tube, tubes)
        if _holds(shed):
            return shed
    return _with_rod(params, wide[-1], tubes)


def _holds(made: HandShed) -> bool:
    limit = STEEL.strength / made.params.safety
    return bool(made.rod_deflection <= made.params.rod_sag and made.rod_stress <= limit)


def _with_rod(params: HandShedParams, rod: Tube, tubes: Sequence[Tube]) -> HandShed:
    """The shed with a rod, the thinnest bar that keeps its limits, and the lever for the hand's force.

    How far the warps are pulled makes up for the rod's sag, which grows with it.
    """
    shed, sag = _pulled(params, rod, tubes[-1], 0.0), 0.0
    for _ in range(_ROUNDS):
        if abs(shed.rod_deflection - sag) < _SAME or shed.rod_deflection > params.rod_sag:
            break
        sag = shed.rod_deflection
        shed = _pulled(params, rod, tubes[-1], sag)
    force, length, limit = shed.heddle_force, shed.length, STEEL.strength / params.safety
    kept = (
        tube
        for tube in tubes
        if sag_of(tube, force, length) <= shed.bar_limit and stress_of(tube, force, length) <= limit
    )
    bar = next(kept, tubes[-1])
    allowed = shed.hands_on_levers * params.hand_limit
    least = max(bar.outer_radius + SHAFT.outer_radius + GAP, shed.stroke / (2 * math.sin(SWING)))
    arm = params.arm or max(min(ARM, allowed * params.lever_limit / force), least)
    lever = force * arm / allowed
    long = min(max(math.ceil(lever / _STEP - 1e-9) * _STEP, 2 * LOCK_ARM), params.lever_limit)
    return replace(shed, bar=bar, arm=arm, lever=long)


_ROUNDS, _SAME = 50, 1e-12


def _pulled(params: HandShedParams, rod: Tube, bar: Tube, sag: float) -> HandShed:
    """The shed whose warps are pulled so far that it opens with a sag of its rod [m], and the bar's allowed one."""
    half = rod.outer / 2
    front = (half + sag) / params.rod_high
    beyond = params.bar_sag * (params.cloth.width + 2 * BESIDE)
    pulled = params.heddle_height * (params.opening / params.weft_height + front) + beyond
    rear = (complex(pulled, params.heddle_height), complex(-half, params.rod_high))
    return HandShed(
        params=params,
        rod=rod,
        bar=bar,
        low=warp_in_shed(params, [complex(half, params.rod_low)]),
        rear=warp_in_shed(params, rear),
        front=warp_in_shed(params, [complex(half, params.rod_high)]),
        arm=ARM,
        pulled=pulled,
        lever=params.lever_limit,
    )
