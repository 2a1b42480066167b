"""The bench of weavers who sit beside each other at a loom: its height follows the fell, their elbows at its height.

    shoulder   z = hip - h sin(lean),  y = seat + h cos(lean);       reach  sqrt(z² + y²) to the fell   [plane geometry]

Its two beams are simply supported, each with half of the weavers, spread over it. Sizes of bodies are assumed by this
project, for small women where they limit the reach. Axes of the scene: x to the right, y up from the fell, z to the
front [m].
"""

import math
from collections.abc import Iterator

from ilmek.elements.beam import uniform
from ilmek.elements.columns import STEEL, HollowSquare, ascending
from ilmek.elements.materials import BEECH, GRAVITY
from ilmek.machines.automated_loom.frame import member, part_id
from ilmek.part.part import Part
from ilmek.part.placement import ALONG_WIDTH, UPRIGHT, placement
from ilmek.part.shapes import box
from ilmek.part.tree import Occurrence
from ilmek.records import computed, record
from ilmek.report import Check, at_most
from ilmek.units import deg, mm

ELBOW, SHOULDER, ARM = 0.22, 0.52, 0.62
"""Elbow and shoulder of a weaver over her seat, and from the shoulder to the fingers that tie [m]."""

HIP, TRUNK = 0.22, 0.12
"""From the front of the seat to the hip's axis, and from there to the front of the trunk [m]."""

LEAN = 20 * deg
"""Inclination of the trunk of a weaver who ties, at most: ISO 11226."""

LEAST_SEAT, FREE_FEET = 0.25, 0.45
"""Lowest seat over the floor, and highest without a foot board [m]."""

WEIGHT = 100.0
"""Of a weaver [kg]."""

BOARD = (0.36, 30 * mm)
"""Depth and thickness of the bench's board [m]."""

SECTION = HollowSquare(40 * mm, 3 * mm)
"""Of legs, rails and foot board, and of the beams at least."""

_SAG = 1 / 300


@record
class Bench:
    """The bench: front of the seat [m], its height over the floor, that of the floor, ends of the bench [m].

    section, sag  of its beams, and their deflection [m]
    """

    front: float
    seat: float
    floor: float
    half: float
    section: HollowSquare
    sag: float

    seat_height = computed("mm", "bench of the weavers over the floor", lambda it: it.seat)

    @computed("mm", "from the shoulder of a weaver who leans forward to the fell", name="weaver_reach")
    def reach(self) -> float:
        return abs(self.shoulder)

    @property
    def shoulder(self) -> complex:
        """Shoulder of a weaver who leans forward, in the side view, the fell at 0 [m]."""
        forward = self.front + HIP - SHOULDER * math.sin(LEAN)
        return complex(forward, self.floor + self.seat + SHOULDER * math.cos(LEAN))

    @property
    def rear(self) -> float:
        """Rear of the bench, z [m]."""
        return self.front + BOARD[0]

    @property
    def legs(self) -> tuple[float, float]:
        """Axes of its front and rear legs, z [m]."""
        return self.front + SECTION.side / 2, self.rear - SECTION.side / 2

    def checks(self, cure: str) -> tuple[Check, Check]:
        """Reach of the weavers, and the beams."""
        assumed = "assumed by this project"
        return (
            at_most("weavers: reach to the fell", self.reach, ARM, "mm", assumed).with_cure(
                cure, part_id("bench-board")
            ),
            at_most(
                "bench: deflection of a beam", self.sag, _SAG * 2 * self.half, "mm", f"length over 300, {assumed}"
            ).with_cure("set fewer weavers", part_id("bench-beam")),
        )


def bench_for(front: float, seat: float, floor: float, half: float, weavers: int) -> Bench:
    """The bench with the lightest beams that keep their limit, else the largest."""
    load = weavers * WEIGHT * GRAVITY / (2 * 2 * half)
    offered = [(square, _sag(square, load, 2 * half)) for square in ascending() if square.side >= SECTION.side]
    section, sag = next((own for own in offered if own[1] <= _SAG * 2 * half), offered[-1])
    return Bench(front, seat, floor, half, section, sag)


def _sag(section: HollowSquare, load: float, span: float) -> float:
    every = load + section.line_mass * GRAVITY
    return float(uniform.deflection_max(every, span, STEEL.modulus, section.inertia))


def bench_parts(bench: Bench, low: float, over: float) -> Iterator[Occurrence]:
    """Legs from a height [m], beams along the width, the board on them, and a foot board under a high seat.

    over  upper side of the feet, which the foot board passes over [m]
    """
    half, section, (deep, thick) = bench.half, bench.section, BOARD
    under, side = bench.floor + bench.seat - thick, SECTION.side
    leg = member("bench-leg", "leg of the bench", SECTION, under - section.side - low)
    sides = (side / 2 - half, half - side / 2)
    yield Occurrence(leg, tuple(placement(x, low, z).after(UPRIGHT) for x in sides for z in bench.legs))
    beam = member("bench-beam", "beam of the bench", section, 2 * half)
    ends = (bench.front + section.side / 2, bench.rear - section.side / 2)
    yield Occurrence(beam, tuple(placement(-half, under - section.side / 2, z).after(ALONG_WIDTH) for z in ends))
    board = Part(part_id("bench-board"), "board of the bench", "machined link", box(2 * half, thick, deep), BEECH)
    yield Occurrence(board, (placement(0.0, under + thick / 2, bench.front),))
    if bench.seat > FREE_FEET:
        rail = member("foot-board", "foot board of the bench", SECTION, 2 * half - 2 * side)
        at = max(bench.floor + bench.seat - FREE_FEET, over + side / 2)
        yield Occurrence(rail, (placement(side - half, at, bench.legs[0]).after(ALONG_WIDTH),))
