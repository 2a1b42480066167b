"""The creel: a package of pile yarn on a peg for each tube of a head, its brake with a stop motion, and the conduits.

It stands at the left side of the fence, or where a rapier runs out there at the right one, outside of the fence, so
that packages are changed while the loom weaves. Rows of pegs along the fence point to it; the yarn leaves its package
over the nose, runs through the brake, and in a conduit of its own through the mesh, in a duct over the front foot, and
in the energy chain of its head to its tube.

A package of the mass m, as long as it is thick, on a core of the diameter c:   pi (d² - c²) d rho / 4 = m    [volume]

Axes of the scene: x to the right, y up from the fell, z to the front [m].
"""

import math
from functools import lru_cache

import numpy as np

from ilmek.elements.field_devices import BRAKE
from ilmek.machines.automated_loom.design import LoomDesign
from ilmek.machines.automated_loom.equipment.energy_chain import trough_box
from ilmek.machines.automated_loom.equipment.guards import POST, fence_of, side_posts
from ilmek.machines.automated_loom.equipment.site import site_of
from ilmek.machines.automated_loom.equipment.surroundings import Surroundings, surroundings
from ilmek.machines.automated_loom.frame import part_id
from ilmek.machines.automated_loom.on_rail import CONDUIT_SIZE
from ilmek.machines.weft.params import RAPIER
from ilmek.part.extents import Extent
from ilmek.records import record
from ilmek.units import mm

PACKAGE, PEG, BRAKE_ID = part_id("yarn-package"), part_id("peg"), part_id("yarn-brake")
CONDUIT, DUCT = part_id("yarn-conduit"), part_id("duct")
"""Ids of parts."""

DENSITY, CORE = 350.0, 40 * mm
"""Of a wound package of wool [kg/m³], and diameter of its core [m]; assumed by this project."""

BETWEEN = 60 * mm
"""Room between two packages, for a hand [m]; assumed by this project."""

HIGHEST = 1.9
"""Axis of the highest package over the floor [m]: a person changes it from the floor; assumed by this project."""

FILLED = 0.5
"""Share of a duct that conduits fill."""

LEAST_DUCT, DUCT_MASS = 40 * mm, 0.6
"""Least side of the duct [m], mass per length of one of that side [kg/m]."""

_STEP = 10 * mm


@record
class Creel:
    """Where the packages are.

    size     diameter and length of a package [m]       pitch  of neighbours [m]
    rows     heights of their axes [m]                   columns  z of their axes, from the front [m]
    ends     of its rails, z [m]: past all columns, to a post of the fence
    hand     side of the fence, -1 left, 1 right
    base     x of the packages' bases, their axes point to the fence [m]
    inner    x of the rails' faces that carry the brakes [m]
    number   of packages                                 mouth  where the duct begins, x, y, z [m]
    duct     side of its section [m]                     duct_end  x of its end [m]
    """

    size: float
    pitch: float
    rows: tuple[float, ...]
    columns: tuple[float, ...]
    ends: tuple[float, float]
    hand: int
    base: float
    inner: float
    number: int
    mouth: tuple[float, float, float]
    duct: float
    duct_end: float

    @property
    def axes(self) -> tuple[tuple[float, float], ...]:
        """Height and depth of the axis of each package [m]."""
        every = ((y, z) for z in self.columns for y in self.rows)
        return tuple(every)[: self.number]


def package_size(mass: float) -> float:
    """Diameter of a package that is as long as it is thick [m]: the positive root of d³ - c² d = 4 m / (pi rho).

    >>> d = package_size(1.0)
    >>> round(math.pi / 4 * (d**2 - CORE**2) * d * DENSITY, 9)
    1.0
    """
    roots = np.roots([1.0, 0.0, -(CORE**2), -4 * mass / (math.pi * DENSITY)])
    return float(max(root.real for root in roots if abs(root.imag) < _REAL))


_REAL = 1e-9


@lru_cache(maxsize=4)
def creel_of(loom: LoomDesign) -> Creel:
    """The creel of a loom."""
    near, fence = surroundings(loom), fence_of(site_of(loom))
    size, number = package_size(loom.params.package_mass), loom.heads * loom.weaver.params.tubes
    hand = 1 if loom.weft.carrier == RAPIER else -1
    foot = foot_under_duct(near, hand)
    side = max(LEAST_DUCT, math.ceil(CONDUIT_SIZE * math.sqrt(number / FILLED) / _STEP) * _STEP)
    low, high = trough_box(loom)
    height = max(float(low[1] + high[1]) / 2, float(foot.high[1]) + side)
    end = float(foot.high[0]) + side / 2 if hand < 0 else float(foot.low[0]) - side / 2
    start = fence.left if hand < 0 else fence.right
    depth = _free_depth(near, (min(start, end), max(start, end)), height, side, float(low[2] + high[2]) / 2)
    pitch, inner = size + BETWEEN, start + hand * 2 * POST
    lowest = fence.floor + size / 2 + 2 * BETWEEN
    rows = np.arange(lowest, max(fence.floor + HIGHEST, lowest) + _REAL, pitch).tolist()
    many = math.ceil(number / len(rows))
    columns = tuple(depth + ((many - 1) / 2 - k) * pitch for k in range(many))
    begin, last = columns[-1] - (pitch + POST) / 2, columns[0] + (pitch + POST) / 2
    post = max((z for z in side_posts(fence) if z < last), default=begin)
    return Creel(
        size=size,
        pitch=pitch,
        rows=tuple(rows),
        columns=columns,
        ends=(min(begin, post), last),
        hand=hand,
        base=inner + hand * (BRAKE.size[2] + 2 * size),
        inner=inner,
        number=number,
        mouth=(start, height, depth),
        duct=side,
        duct_end=end,
    )


def foot_under_duct(near: Surroundings, hand: int) -> Extent:
    """The front foot, the outermost one of a side, over which the duct leads."""
    return near.of(part_id("front-foot"))[0 if hand < 0 else -1]


def _free_depth(near: Surroundings, ends: tuple[float, float], height: float, side: float, wished: float) -> float:
    """Axis of the duct, z [m], as near to what is wished as it has room over the front foot with its stand."""
    foot, (begin, end) = near.of(part_id("front-foot"))[0], ends
    half = side / 2
    offered: list[float] = np.arange(float(foot.low[2]) + half, float(foot.high[2]) - half, _STEP).tolist()
    for z in sorted(offered, key=lambda one: abs(one - wished)):
        low = np.array([begin, float(foot.high[1]) + _REAL, z - half])
        if near.free(low, np.array([end, height + half, z + half]), but=foot.part):
            return z
    return wished
