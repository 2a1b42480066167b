"""One hand: its four-bar and its finger, the stroke behind the warps, and the clearance that it is sure to keep.

Between two samples a point of the coupler moves at most

    ds <= a |dt| + |A P| |df|           a crank, t its angle, A pin of the crank, f angle of the coupler

for both angles go one way. So a finger is sure to keep what its samples keep, less half of the greatest ds and half of
the distance of two points of its edges.                                                         [derived here]
"""

from functools import lru_cache

import numpy as np

from ilmek.arrays import ComplexArray, FloatArray
from ilmek.cams.laws.polynomial_345 import LAW
from ilmek.linkage.motion import Motion
from ilmek.linkage.solve import solve
from ilmek.linkage.structure import plan
from ilmek.machines.knotting_four_bar.hands.batch import HandBatch, MovedHands, moved
from ilmek.machines.knotting_four_bar.hands.section import InclinedSection, finger_points
from ilmek.records import record
from ilmek.synthesis.four_bar import FourBar
from ilmek.weaving.knots.led_yarn import SampledPath

FINE = 6401
"""Samples of the coupler's angle at which the clearance of the chosen hands is computed."""

EDGE_POINTS = 1500
"""Points of each edge of a finger at which it is computed."""

INSTANTS = 241
"""Samples of a stroke in time."""


@record
class TyingHand:
    """The left hand at the middle of its stroke; the right one is the same, turned half about y, towards the pile.

    four_bar  its tracer is the foot of the finger      pins  the same as numbers of the search
    centre    of the finger's arc, with its radius and its span from tip to foot [m, rad]
    crank     angles at both ends of the stroke, as followed [rad]
    """

    section: InclinedSection
    pins: HandBatch
    four_bar: FourBar
    centre: complex
    radius: float
    span: float
    crank: tuple[float, float]

    @property
    def tip(self) -> complex:
        """Tip of the finger on the coupler, in the coupler's frame [m]."""
        return self.on_coupler(self.centre - 1j * self.radius)

    def on_coupler(self, at: complex) -> complex:
        """A point of the middle of the stroke in the coupler's frame [m]."""
        return complex((at - self.four_bar.a) * np.exp(-1j * self.four_bar.coupler_angle))

    @property
    def swing(self) -> float:
        """Of the crank [rad]."""
        return abs(self.crank[1] - self.crank[0])

    def stroke(self, samples: int = INSTANTS) -> Motion:
        """The motion from one end to the other in the time of the task, by the 3-4-5 polynomial."""
        return solve(plan(self.four_bar.mechanism()), *self._law(samples)).require()

    def _law(self, samples: int) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Crank angle, speed and acceleration over the stroke."""
        u, (first, last), time = np.linspace(0.0, 1.0, samples), self.crank, self.section.task.stroke_time
        swing = last - first
        s, v, a = (np.asarray(curve(u)) for curve in (LAW.s, LAW.v, LAW.a))
        return first + swing * s, swing / time * v, swing / time**2 * a

    def tip_path(self, samples: int) -> SampledPath:
        """The tip's path in the section, samples evenly over the coupler's angle, and bounds of the length between."""
        hands, active = _fine(self, samples)
        return SampledPath(self.section.projected(hands.tip[0, active]), _bounds(hands, active, abs(self.tip)))

    @property
    def depth(self) -> float:
        """Of the finger's path behind the warps' axes [m]."""
        return float(-np.min(self.tip_path(201).points.imag))

    @property
    def led(self) -> float:
        """Length of the tip's path in its plane [m]."""
        hands, active = _fine(self, FINE)
        return float(np.sum(np.abs(np.diff(hands.tip[0, active]))))

    @property
    def transmission(self) -> float:
        """Least transmission angle over the stroke [rad]."""
        return float(_fine(self, FINE)[0].transmission[0])

    @property
    def clearance(self) -> float:
        """Least distance of the finger from all warps that the whole stroke is sure to keep [m]."""
        return _sure_clearance(self)

    @property
    def bent(self) -> float:
        """Bending of the finger's tip by the yarn in its plane [m]."""
        return float(self.section.bent(np.array(self.radius * self.span)))


def hand_of(section: InclinedSection, hands: HandBatch, number: int) -> TyingHand:
    """The hand of a number of a batch."""
    pins = hands[number]
    fine, _ = moved(section, pins, FINE)
    crank = fine.crank[0, fine.active[0]]
    return TyingHand(
        section=section,
        pins=pins,
        four_bar=pins.four_bar(0, complex(fine.foot_at[0])),
        centre=complex(fine.centre[0]),
        radius=float(fine.radius[0]),
        span=float(fine.span[0]),
        crank=(float(crank[0]), float(crank[-1])),
    )


def _fine(hand: TyingHand, samples: int) -> tuple[MovedHands, FloatArray]:
    hands, _ = moved(hand.section, hand.pins, samples)
    return hands, np.flatnonzero(hands.active[0])


def _bounds(hands: MovedHands, active: FloatArray, arm: float) -> FloatArray:
    """Bounds of the path of a point at a distance from A [m] between the active samples [m]."""
    crank, f = hands.crank[0, active], hands.f[0, active]
    length = abs(complex(hands.hands.a[0] - hands.hands.a0[0]))
    return np.asarray(length * np.abs(np.diff(crank)) + arm * np.diff(f))


@lru_cache(maxsize=64)
def _sure_clearance(hand: TyingHand) -> float:
    hands, active = _fine(hand, FINE)
    width, one = hand.section.task.finger_width, np.array([hand.centre])
    points = finger_points(one, np.array([hand.radius]), np.array([hand.span]), width, EDGE_POINTS)[0]
    arms = points - hands.hands.a[0]
    least = np.inf
    for start in range(0, len(active), 100):
        chosen = active[start : start + 100]
        at: ComplexArray = hands.a[0, chosen][:, None] + arms * np.exp(1j * hands.f[0, chosen])[:, None]
        least = min(least, float(hand.section.clearance(at)))
    between = float(np.max(_bounds(hands, active, float(np.max(np.abs(arms))))))
    apart = (hand.radius + width / 2) * (hand.span + width / hand.radius) / (EDGE_POINTS - 1)
    return least - between / 2 - apart / 2
