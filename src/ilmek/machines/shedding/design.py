"""Shedding cams: one cam per warp, opposed for odd and even warps, on square shafts.    [thesis, chapter 3.2]

Each cam lifts its warp by the programme rise, dwell, fall, rest; the cams of the odd warps are the same, half a turn
later. Between the cams stand round guide cams, higher than the nose, or the dents of a reed, and keep the warps apart.
A warp drawn taut over the cam presses with F across the cam's axis: the given force, or that of its tension (`warp`).

Where the pitch leaves no room for cams that stand, k shafts stand one above the other along the warps, each for every
k-th warp (`stack`). The guides of neighbouring shafts clear each other. A shaft at the distance z beyond the first,
which is at a from the fell, lifts its warps by

    L(z) = L (a + z) / a

so that all lifted warps lie on one line from the fell to the noses, and the shuttle finds one shed. Each shaft has a
motor; what the shafts need together is the sum over them. Staggered cams: `phases`.                           [derived]
"""

from collections.abc import Callable
from functools import lru_cache

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.cams import limits
from ilmek.cams.plate import PlateCam
from ilmek.cams.programme import TURN, CamProgramme, jumps
from ilmek.elements.square_shaft import SquareShaft
from ilmek.machines.shedding.cam_shaft import CamShaft, SheddingDrive, cam_shaft, least_prime, of_shaft, smallest_prime
from ilmek.machines.shedding.guideway import Guideway, guideway_of
from ilmek.machines.shedding.params import SheddingParams
from ilmek.machines.shedding.phases import Shed
from ilmek.machines.shedding.positions import dealt, positions
from ilmek.machines.shedding.stack import CamStack
from ilmek.machines.shedding.stack_choice import ChosenStack, chosen_stack
from ilmek.machines.shedding.tolerance_chain import ToleranceChain, tolerance_chain
from ilmek.machines.shedding.warp import lifting_work
from ilmek.num.piecewise import supremum
from ilmek.records import computed, record
from ilmek.report import Choice, Json
from ilmek.weaving.shed import shed_lengthening


@record
class SheddingDesign:
    """The design of shedding cams.

    params   as given; of each shaft: `shafts`      guides   what keeps the warps on the cams
    shafts   the cam shafts, the nearest to the fell first
    choice   of the number of shafts and the guides; None where both are given
    Cam, shed, shaft and drive without a shaft named are those of the first one.
    """

    params: SheddingParams
    shafts: tuple[CamShaft, ...]
    guides: str
    choice: Choice | None
    shuttle_window: tuple[float, float]

    @property
    def first(self) -> CamShaft:
        """The shaft nearest to the fell."""
        return self.shafts[0]

    @property
    def cam(self) -> PlateCam:
        """Cam of the first shaft."""
        return self.first.cam

    @property
    def even(self) -> CamProgramme:
        """Programme of the even warps of the first shaft."""
        return self.first.even

    @property
    def odd(self) -> CamProgramme:
        """Programme of the odd warps of the first shaft."""
        return self.first.odd

    @property
    def shed(self) -> Shed:
        """Cams of the first shaft."""
        return self.first.shed

    @property
    def shaft(self) -> SquareShaft:
        """The first shaft."""
        return self.first.shaft

    @property
    def drive(self) -> SheddingDrive:
        """Drive of the first shaft."""
        return self.first.drive

    @property
    def stack(self) -> CamStack:
        """Stack of the first shaft, with mass and inertia of all."""
        one, stacks = self.first.stack, [each.stack for each in self.shafts]
        return CamStack(
            one.thickness,
            one.guide_thickness,
            one.guide_radius,
            one.cam_mass,
            one.guide_mass,
            sum(each.mass for each in stacks),
            sum(each.inertia for each in stacks),
            one.shares,
            one.spacer_mass,
        )

    @property
    def chain(self) -> ToleranceChain:
        """Tolerances along the first shaft, from one place of shims to the next."""
        return tolerance_chain(self.first.params, self.first.stack.shares)

    @property
    def parity_numbers(self) -> tuple[int, int]:
        """Even and odd warps of all shafts."""
        return sum(shaft.numbers[0] for shaft in self.shafts), sum(shaft.numbers[1] for shaft in self.shafts)

    @property
    def guideway(self) -> Guideway:
        """The tips of the first shaft's lifted cams, on which the shuttle runs."""
        return guideway_of(self.first, self.shuttle_window)

    def torque(self, angle: FloatArray) -> FloatArray:
        """Torque of the warps on all shafts together [N m]."""
        return sum((shaft.shed.torque(angle) for shaft in self.shafts), np.zeros_like(angle))

    shaft_count = computed("1", "cam shafts one above the other", lambda it: len(it.shafts), name="shafts")
    guides_shown = computed(
        "", "what keeps the warps on their cams: guide cams, or a reed", lambda it: it.guides, name="guides"
    )

    @computed("", "distance of each shaft beyond the first [m]", name="shaft_positions")
    def shaft_distances(self) -> list[float]:
        return [shaft.beyond for shaft in self.shafts]

    lifts = computed("", "lift of the warps of each shaft [m]", lambda it: [shaft.params.lift for shaft in it.shafts])
    prime_radius = computed("mm", "prime radius of the cam, Rp", lambda it: it.cam.prime_radius, least=0.0)
    prime_radius_min = computed("mm", "smallest for the pressure angle", lambda it: it.first.smallest_prime.value)

    @computed("mm", "smallest that leaves the wall outside the corners of the square bore")
    def prime_radius_for_bore(self) -> float:
        return self.first.prime_radius_for_bore

    pressure_angle_max = computed("deg", "largest pressure angle", lambda it: limits.pressure_angle_max(it.cam).value)
    pressure_angle_at = computed("deg", "cam angle of that maximum", lambda it: limits.pressure_angle_max(it.cam).at)
    curvature_radius_min = computed(
        "mm", "least convex radius of the pitch curve", lambda it: limits.convex_radius_min(it.cam).value
    )

    @computed("mm", "least concave radius of the pitch curve", absent="it is convex all round")
    def concave_radius_min(self) -> float | None:
        hollow = limits.concave_radius_min(self.cam)
        return hollow.value if hollow else None

    cam_area = computed("cm^2", "area inside the cam's surface, bore included", lambda it: limits.area(it.cam))

    shim_interval = computed("1", "pitches of a shaft from one pile of shims to the next", lambda it: it.chain.interval)
    shims = computed("mm", "nominal thickness of a pile of shims", lambda it: it.chain.shims, name="shim_thickness")

    shed_opening = computed("mm", "largest distance of even and odd warps", lambda it: it.peak(it.shed.opening))
    shuttle_start = computed("deg", "shaft angle at which the even shed opens", lambda it: it.shuttle_window[0])
    shuttle_end = computed(
        "deg", "shaft angle at which it closes; the odd shed follows half a turn later", lambda it: it.shuttle_window[1]
    )

    @computed("deg", "shaft angle for which a shed is open for the shuttle", name="shuttle_window")
    def shuttle_window_angle(self) -> float:
        return self.shuttle_window[1] - self.shuttle_window[0]

    shuttle_time = computed("s", "time that each shed is open", lambda it: it.shuttle_window_angle / it.params.speed)
    turn_time = computed("s", "time of a turn: two sheds", lambda it: TURN / it.params.speed)
    phase_groups = computed("1", "groups of each parity's cams, staggered", lambda it: it.shed.groups)
    phase_spread = computed("deg", "angle from the first group to the last", lambda it: it.shed.spread)

    @computed("deg", "angle for which one parity falls while the other rises, at each change of the shed")
    def shed_overlap(self) -> float:
        return max(0.0, self.params.lifted_angle + self.shed.spread - TURN / 2)

    velocity_max = computed(
        "mm/s", "largest warp velocity", lambda it: it.params.speed * it.peak(lambda q: it.even.at(q).ds)
    )
    acceleration_max = computed(
        "mm/s^2", "largest warp acceleration", lambda it: it.params.speed**2 * it.peak(lambda q: it.even.at(q).dds)
    )

    @computed("", "jumps of the acceleration of the even warps, shaft angle [rad]")
    def acceleration_jumps(self) -> Json:
        return [{"angle": jump.angle, "place": jump.where} for jump in jumps(self.even)]

    shaft_supports = computed("1", "supports of a shaft, both ends included", lambda it: it.params.spans + 1)
    warps_across = computed(
        "N", "largest force of the lifted warps across the shaft", lambda it: it.first.across_max.value
    )
    torque_max = computed(
        "Nm", "largest torque of all shafts together", lambda it: supremum(it.torque, it.shed.knots).value
    )
    power_max = computed("W", "largest power of all shafts together", lambda it: it.torque_max * it.params.speed)

    @computed("J", "work of lifting the even warps once, returned when they fall")
    def shed_work(self) -> float:
        return float(sum(shaft.numbers[0] * lifting_work(shaft.params) for shaft in self.shafts))

    @computed("", "the cycle of even and odd warps, shaft angles [rad]")
    def phases(self) -> Json:
        names = ("warps", "phase", "start", "end")
        return [dict(zip(names, phase, strict=True)) for phase in self.cycle_phases]

    @property
    def cycle_phases(self) -> tuple[tuple[str, str, float, float], ...]:
        """Parity, phase, first and last shaft angle [rad] of each part of the turn; odd ones may exceed a turn."""
        return tuple(
            (parity, segment.name, float(programme.start + begin), float(programme.start + begin + segment.span))
            for parity, programme in (("even", self.even), ("odd", self.odd))
            for begin, segment in zip(programme.edges, programme.segments, strict=False)
        )

    def peak(self, function: Callable[[FloatArray], FloatArray]) -> float:
        """Largest magnitude over the turn of a function of the shaft's angle."""
        return supremum(lambda angle: np.abs(function(angle)), self.shed.knots).value


@lru_cache(maxsize=16)
def design(params: SheddingParams) -> SheddingDesign:
    """Cams, stacks, shafts and drives for the parameters. Raises ParameterError where the cam cannot exist.

    A loom designs its cams to find their spans, and again as one of its machines: the last designs are kept.
    """
    prime = params.prime_radius or smallest_prime(params).value
    chosen = chosen_stack(params, prime / params.lift)
    shafts = _shafts(params, chosen, prime / params.lift)
    return SheddingDesign(params, shafts, chosen.guides, chosen.choice, shafts[0].window)


def _shafts(params: SheddingParams, chosen: ChosenStack, slender: float) -> tuple[CamShaft, ...]:
    """The shafts, so far apart that the guides of neighbours clear each other also where bores enlarge the cams."""
    numbers, needed = dealt(params.cloth.warps, chosen.shafts), least_prime(params)
    if chosen.shafts == 1:
        return (cam_shaft(params, numbers[0], chosen.shares),)
    for _ in range(_TRIALS):
        along = positions(params, chosen.shafts, slender, needed)
        shafts = tuple(
            cam_shaft(of_shaft(params, beyond, along[-1], sum(number)), number, chosen.shares, beyond)
            for beyond, number in zip(along, numbers, strict=True)
        )
        enlarged = [
            shaft.cam.prime_radius for shaft in shafts if shaft.cam.prime_radius > shaft.params.lift * slender + _SAME
        ]
        if max(enlarged, default=0.0) <= needed:
            break
        needed = max(enlarged)
    return shafts


_TRIALS, _SAME = 4, 1e-6


def shed_lengthenings(design: SheddingDesign, angle: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Mean lengthening [m] of the even and of the odd warps at angles of the shafts [rad], any shape; 0 without spans.

    The mean over all warps of a parity, as shafts one above the other and staggered groups lengthen theirs differently:
    times its number of warps (`SheddingDesign.parity_numbers`) it gives what they are lengthened by together.
    """
    totals = np.zeros(np.shape(angle)), np.zeros(np.shape(angle))
    for shaft in design.shafts:
        spans = shaft.params.spans_of_warp
        if spans is None:
            continue
        for total, parity in zip(totals, (shaft.shed.even, shaft.shed.odd), strict=True):
            for number, motion in zip(parity.numbers, parity.motions(angle), strict=True):
                total += number * shed_lengthening(motion.s, *spans)
    even, odd = design.parity_numbers
    return totals[0] / max(even, 1), totals[1] / max(odd, 1)
