"""The weft robot: a rapier on a belt axis that draws the weft from packages at rest.  [thesis, conclusion: future work]

The rapier stands beside the loom, as long as the cloth. It goes through the open shed, its gripper takes the weft that
the selector offers at the far edge, and draws it back through the same shed. The packages stand at the far edge, one
tied to the next, so that the loom is not stopped for them. Every weft is cut, and both ends are tucked into the next
shed. The rapier is a tube that projects from its guide at the edge:

    sag = w L⁴ / (8 E I) + m g L³ / (3 E I)          w weight over length, m of the gripper, L projecting length
    buckling force  pi² E I / (4 L²)                 one end clamped, against the force that accelerates the rapier
"""

import math

from ilmek.elements.materials import GRAVITY
from ilmek.machines.weft.carriers import GRIPPER, NEEDLE, RAPIER_TUBE, hollow
from ilmek.machines.weft.params import WeftParams
from ilmek.machines.weft.shed import needed_opening, shed_check
from ilmek.records import computed, record, result
from ilmek.report import Alternative, Check, Choice, Json, at_least, at_most, choose
from ilmek.units import format_quantity, mm

HEIGHTS = tuple(size * mm for size in (16, 20, 25, 32, 40, 50, 63, 80, 100))
"""Heights of the tubes, along the warps [m]; preferred numbers R10."""

WIDTH, WALL = 0.4, 0.06
"""Width and wall of a tube over its height; assumed by this project."""

LEAST_WIDTH, LEAST_WALL = 10 * mm, 1.5 * mm
"""Least width and wall of a tube [m]."""

CLAMP = 0.1
"""Length of the rapier that its clamp on the belt holds [m]."""

DRIVE = 0.2
"""Length of its drive beyond the rapier at rest [m]."""

BUCKLING = 3.0
"""Required safety against buckling."""

TUCKED = 2
"""Warps round which a tucked end winds at least, over one and under the next; assumed by this project."""


@record
class Rapier:
    """A rapier; tube: height along the warps, width across the shed, wall [m]."""

    tube: tuple[float, float, float]
    gripper: float
    depth: float = result("mm", "depth of the carrier across the shed", name="carrier_depth")
    length: float = result("mm", "length of the carrier", name="carrier_length")
    opening: float = result("mm", "opening of the shed that the carrier needs where it runs", name="shed_needed")
    mass: float = result("kg", "mass of rapier and gripper")
    rigidity: float = result("N*m^2", "E I of the rapier's tube, against its weight")
    sag: float = result("mm", "sag of the tip, gone all through the shed")
    buckling: float = result("N", "Euler's buckling force")

    @property
    def width(self) -> float:
        """Size along the warps [m]: of the tube or the gripper, and the sag towards the fell."""
        return max(self.tube[0], self.gripper) + self.sag

    @computed("", "height, width and wall of the rapier's tube [m]", name="tube")
    def tube_size(self) -> Json:
        return dict(zip(("height", "width", "wall"), self.tube, strict=True))


def rapier_for(params: WeftParams) -> tuple[Rapier, tuple[Choice, ...]]:
    """The lightest rapier whose checks hold, and that choice."""
    heights = (params.rapier_height,) if params.rapier_height else HEIGHTS
    tried = [_rapier(params, height) for height in heights]
    named = [
        Alternative(f"tube {format_quantity(one.tube[0], 'mm')}", size_checks(params, one, params.acceleration))
        for one in tried
    ]
    index, choice = choose("rapier_height", named, "price")
    return tried[index], (choice,) if len(tried) > 1 else ()


def reach(params: WeftParams) -> float:
    """Length that projects from the guide when the rapier is all through the shed, and its stroke [m]."""
    return params.cloth.width + 2 * params.edge


def _rapier(params: WeftParams, tall: float) -> Rapier:
    wide, wall = max(LEAST_WIDTH, WIDTH * tall), min(max(LEAST_WALL, WALL * tall), tall / 3, LEAST_WIDTH / 3)
    inner = tall - 2 * wall, wide - 2 * wall
    rigidity = params.rapier_modulus * (wide * tall**3 - inner[1] * inner[0] ** 3) / 12
    sideways = params.rapier_modulus * (tall * wide**3 - inner[0] * inner[1] ** 3) / 12
    span, length = reach(params), reach(params) + CLAMP
    line_mass = params.rapier_density * hollow((tall, wide, wall)).area
    weight = line_mass * GRAVITY
    sag = (weight * span**4 / 8 + params.gripper_mass * GRAVITY * span**3 / 3) / rigidity
    depth = max(wide, params.gripper_size)
    return Rapier(
        tube=(tall, wide, wall),
        gripper=params.gripper_size,
        depth=depth,
        length=length,
        opening=needed_opening(params, depth),
        mass=line_mass * length + params.gripper_mass,
        rigidity=rigidity,
        sag=sag,
        buckling=math.pi**2 * min(rigidity, sideways) / (4 * span**2),
    )


def size_checks(params: WeftParams, rapier: Rapier, acceleration: float) -> tuple[Check, ...]:
    """The checks that the tube decides."""
    return (
        at_most(
            "sag of the rapier",
            rapier.sag,
            params.sag_limit,
            "mm",
            "a cantilever from the edge; assumed by this project: parameter sag_limit",
        ).with_cure("set weft=shuttle or a narrower carpet", RAPIER_TUBE),
        at_least(
            "safety of the rapier against buckling",
            rapier.buckling / (rapier.mass * acceleration),
            BUCKLING,
            "1",
            "Euler, one end clamped; safety 3, assumed by this project",
        ).with_cure("set a lower weft.acceleration or weft=shuttle", RAPIER_TUBE),
        shed_check(params, rapier.opening, "weft=shuttle", RAPIER_TUBE),
    )


def rapier_checks(params: WeftParams, rapier: Rapier, acceleration: float, tension: float) -> tuple[Check, ...]:
    """All checks of the rapier at an acceleration [m/s²] and a tension of the weft [N]."""
    holds = 2 * params.cloth.yarns.friction * params.grip_force
    tucked = params.turn / 2 / params.cloth.warp_pitch
    return (
        *size_checks(params, rapier, acceleration),
        at_most(
            "pull of the weft in the gripper",
            params.safety * tension,
            holds,
            "N",
            "friction on both jaws; assumed by this project: parameter grip_force",
        ).with_cure("set a lower weft.speed or weft.brake", GRIPPER),
        at_least(
            "warps that bind a tucked end",
            tucked,
            TUCKED,
            "1",
            "over one warp and under the next, assumed by this project; half of parameter turn",
        ).with_cure("set a longer weft.turn", NEEDLE),
    )
