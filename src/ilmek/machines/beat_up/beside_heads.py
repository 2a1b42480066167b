"""The arm of a crank-rocker that clears heads and reed: at rest its rocker is over heads that knot, its plate in front.

Where weavers tie, the rocker at rest is over the room of their hands, which do not retreat.

Side view, the fell at 0, the pivot of the rocker at P in front of it. At rest the rocker has swung up by d; its half
width is e. The plate of crank and rocker has its lower corner at P - e - i e, and its edge there runs as the heads
retreat, down and to the front at the angle r. A corner x + i y of a head or of its rail keeps a distance c from both

    (P - x) sin d - y cos d >= e + c,   (P - e - x) sin r - (e + y) cos r >= c                      [plane geometry]

The coupler keeps c before guide cams and reeds, by samples of a turn.

All lengths of the linkage grow with its ground, so that the least P gives the least ground.
"""

import cmath
import math
from collections.abc import Iterator, Sequence
from functools import lru_cache

import numpy as np

from ilmek.arrays import ComplexArray
from ilmek.linkage.solve import solve
from ilmek.machines.arrangement.side_view import RETREAT, SideView
from ilmek.machines.beat_up.carriage import PLATE, shaft
from ilmek.machines.beat_up.design import BeatUp
from ilmek.machines.beat_up.links import PART_IDS
from ilmek.machines.shedding.stack import DENT_TAB
from ilmek.report import Check, at_least
from ilmek.units import turn

_SAMPLES, _LARGEST, _STEP = 181, 2.0, 0.005
"""Samples of a turn and of the coupler, and the largest and the step of the scales that are tried."""

_SLOPE = -cmath.phase(RETREAT)


def ground_beside_heads(
    linkage: BeatUp, side: SideView | None, clearance: float, bar: ComplexArray | None = None, *, parked: bool = False
) -> float:
    """The ground with which a linkage keeps a clearance [m] from the heads; its own where it does, or without a side
    view.

    bar     corners of a comb's bar on the rocker, at the fell in the side view [m]
    parked  whether the mechanism is beside the cloth while weavers tie
    """
    ground = linkage.params.ground
    if side is None:
        return ground
    longer = (
        *((clearance - gap) / math.sin(linkage.swing) for gap in _over(linkage, side, parked)),
        *((clearance - gap) / math.sin(_SLOPE) for gap in _before(linkage, side)),
    )
    grown = 1 + max((*longer, 0.0)) / linkage.lengths["beater"]

    def clear(scale: float) -> bool:
        free = bar is None or _before_bar(linkage, bar, scale) >= clearance
        return free and _before_cams(linkage, side, scale) >= clearance

    return ground * next((one for one in (grown * np.arange(1.0, _LARGEST, _STEP)).tolist() if clear(one)), grown)


def room_under_baulks(outlines: Sequence[ComplexArray], side: SideView) -> float:
    """Least room of polygons in the side view under the baulks of reeds [m]; inf where there is none over them."""
    edges = np.concatenate(
        [outline + np.linspace(0.0, 1.0, _SAMPLES)[:, None] * (np.roll(outline, 1) - outline) for outline in outlines]
    )
    rooms = [math.inf]
    for cam in side.cams:
        thick = cam.front - cam.guide_radius
        under = np.abs(edges.real - cam.at.real - cam.guide_radius - thick / 2) < thick
        if thick > 0 and under.any():
            rooms.append(cam.at.imag - DENT_TAB[1] / 2 - thick - float(edges.imag.max(where=under, initial=-math.inf)))
    return min(rooms)


def checks_beside_heads(
    linkage: BeatUp, side: SideView | None, clearance: float, *, parked: bool = False
) -> tuple[Check, ...]:
    """Whether rocker and plate keep the clearance [m]; none without a side view. `parked`: as above."""
    if side is None:
        return ()
    cure = "leave the ground of the crank-rocker open, or set fewer heads"
    source = "parameter clearance; the rail no larger than its room in the arrangement"
    named = "clearance: coupler and cams", _before_cams(linkage, side), clearance, "mm", "parameter clearance"
    tying = "heads" if side.heads else "hands"
    return (
        at_least(*named).with_cure("leave the ground of the crank-rocker open", PART_IDS["coupler"]),
        *(
            at_least(f"clearance: rocker at rest and {tying} that knot", gap, clearance, "mm", source).with_cure(
                cure, PART_IDS["rocker"]
            )
            for gap in sorted(_over(linkage, side, parked))[:1]
        ),
        *(
            at_least(
                "clearance: plate of the crank-rocker and heads that retreat", gap, clearance, "mm", source
            ).with_cure(cure, PLATE)
            for gap in sorted(_before(linkage, side))[:1]
        ),
    )


def _over(linkage: BeatUp, side: SideView, parked: bool) -> Iterator[float]:
    """Gaps between the rocker at rest and the corners of heads and rail, or of hands where it is not parked [m]."""
    tying = side.tying if side.heads or not parked else ()
    swing, arm, half = linkage.swing, linkage.lengths["beater"], linkage.params.width / 2
    return ((arm - corner.real) * math.sin(swing) - corner.imag * math.cos(swing) - half for corner in tying)


def _before(linkage: BeatUp, side: SideView) -> Iterator[float]:
    """Gaps between the plate and the ways of these corners in the retreat [m]."""
    arm, half = linkage.lengths["beater"], linkage.params.width / 2
    return (
        (arm - half - corner.real) * math.sin(_SLOPE) - (half + corner.imag) * math.cos(_SLOPE)
        for corner in (side.heads.corners if side.heads else ())
    )


def _before_cams(linkage: BeatUp, side: SideView, scale: float = 1.0) -> float:
    """Least gap between the coupler of a linkage of a scale and guide cams and reeds over a turn [m]."""
    points, half, gaps = scale * _coupler(linkage), linkage.params.width / 2, []
    for cam in side.cams:
        gaps.append(float(np.abs(points - cam.at).min()) - cam.guide_radius)
        beside = np.abs(points.imag - cam.at.imag) < 2 * (cam.front - cam.guide_radius)  # the baulks of a reed
        gaps.append(float(points.real.min(where=beside, initial=math.inf)) - cam.at.real - cam.front)
    return min(gaps) - half


def _before_bar(linkage: BeatUp, bar: ComplexArray, scale: float) -> float:
    """Least gap between the coupler of a linkage of a scale and the bar that turns with its rocker, over a turn [m]."""
    points = scale * (_coupler(linkage, on_rocker=True) + linkage.lengths["beater"])
    aside = np.maximum(np.maximum(bar.real.min() - points.real, points.real - bar.real.max()), 0.0)
    over = np.maximum(np.maximum(bar.imag.min() - points.imag, points.imag - bar.imag.max()), 0.0)
    return float(np.hypot(aside, over).min()) - linkage.params.width / 2


@lru_cache(maxsize=8)
def _coupler(linkage: BeatUp, *, on_rocker: bool = False) -> ComplexArray:
    """Points of the coupler's middle line over a turn in the side view [m], or from the pivot as seen on the rocker,
    which points to the warps.
    """
    motion, lengths = solve(linkage.plan, np.linspace(0.0, turn, _SAMPLES)), linkage.lengths
    crank, rocker = (lengths[name] * np.exp(1j * motion.angle(name)) for name in ("crank", "rocker"))
    first, last = _in_side_view(linkage, crank), _in_side_view(linkage, lengths["ground"] + rocker)
    points = np.asarray(first + np.linspace(0.0, 1.0, _SAMPLES)[:, None] * (last - first))
    if not on_rocker:
        return points
    pivot = _in_side_view(linkage, np.asarray(complex(lengths["ground"])))
    return np.asarray((points - pivot) * -lengths["rocker"] / (last - pivot))


def _in_side_view(linkage: BeatUp, pin: ComplexArray) -> ComplexArray:
    """Positions of a pin of the linkage in the side view [m] (see `tree.in_side_view`)."""
    return np.asarray(shaft(linkage) - np.conj(pin) * np.exp(1j * linkage.rocker_angles[0]))
