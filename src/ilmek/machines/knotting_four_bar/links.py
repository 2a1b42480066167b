"""Links of a knotting four-bar: their bars and tools, their inertia, and the parts that are made.

As bars, the report's, links are rectangles from pin to pin, holder and gripper rectangles beyond the coupler's end. As
made they are plates with round ends and holes, with their pins, the coupler one plate with holder and gripper.
"""

from dataclasses import replace
from functools import lru_cache

from ilmek.dynamics.inertia import Inertia, bar, bar_mass, combined
from ilmek.elements.gears import EqualGears
from ilmek.elements.materials import MATERIALS, Material
from ilmek.linkage.model import GROUND
from ilmek.machines.knotting_four_bar.model import mechanism
from ilmek.machines.knotting_four_bar.params import KnottingFourBarParams
from ilmek.machines.link_tree import Levels, LinkageParts, LinkSize, link_inertias, linkage_parts, pin_part
from ilmek.part.flat_link import stepped_link
from ilmek.part.part import Part, Seat
from ilmek.part.placement import placement
from ilmek.part.profile import drilled
from ilmek.part.shapes import Prism, disc
from ilmek.plane.contours import circle
from ilmek.report import Hole
from ilmek.units import mm

MACHINE_NAME = "knotting-four-bar"

FRAME = 8 * mm
"""Least thickness of the plates that stand, in which the drive has its threads [m]; assumed by this project."""

SHAFT = f"{MACHINE_NAME}/shaft"
"""Id of the shaft of a crank, which is fixed in it."""

LEVELS = ((GROUND,), ("crank",), ("coupler",), ("rocker",))


def coupler_ends(params: KnottingFourBarParams) -> tuple[float, float]:
    """Ends of the coupler's bar on its line from O2 towards O2' [m]: it reaches from pin to pin and to the hand."""
    return min(0.0, params.hand), max(params.coupler, params.hand)


def tool(params: KnottingFourBarParams) -> dict[str, tuple[float, float, float]]:
    """Holder and gripper beyond the coupler's end on the hand's side: start and end on its line, width [m]."""
    end, outward = (coupler_ends(params)[1], 1) if params.hand > 0 else (coupler_ends(params)[0], -1)
    middle = end + outward * params.holder_length
    tip = middle + outward * params.gripper_length
    return {"holder": (end, middle, params.holder_width), "gripper": (middle, tip, params.gripper_width)}


def parts(params: KnottingFourBarParams) -> dict[str, Inertia]:
    """The bars of the links, and holder and gripper."""
    bars = {
        "crank": (0.0, params.crank, params.width),
        "coupler bar": (*coupler_ends(params), params.width),
        **tool(params),
        "rocker": (0.0, params.rocker, params.width),
    }
    masses = {
        name: float(bar_mass(abs(end - start), width, params.thickness, params.density))
        for name, (start, end, width) in bars.items()
    }
    return {name: bar(start, end, mass=masses[name], width=width) for name, (start, end, width) in bars.items()}


def inertias(params: KnottingFourBarParams, hole: float) -> dict[str, Inertia]:
    """The moving bodies by `link_mass`; coupler, holder and gripper are one. hole: diameter of the pins' holes [m]."""
    if params.link_mass == "made":
        bodies = link_inertias(made_parts(params, hole), mechanism(params, 0.0))
        shaft = shaft_part(params, hole)
        turning = Inertia(shaft.mass, 0j, shaft.mass * hole**2 / 8)
        return {**bodies, "crank": combined(bodies["crank"], turning)}
    made = parts(params)
    hand = combined(made["coupler bar"], made["holder"], made["gripper"])
    return {"crank": made["crank"], "coupler": hand, "rocker": made["rocker"]}


def material_of(params: KnottingFourBarParams) -> Material:
    """The material of all parts, of the given density."""
    return replace(params.strength.of_links, density=params.density)


@lru_cache(maxsize=16)
def made_parts(params: KnottingFourBarParams, hole: float, ground_angle: float = 0.0) -> LinkageParts:
    """Plates and pins; hole: diameter of the holes [m]      ground_angle: direction of the ground link [rad]."""
    size = LinkSize(params.width, params.thickness, hole, material_of(params))
    frame = replace(size, thickness=max(size.thickness, FRAME), material=MATERIALS["structural steel"])
    levels = Levels(LEVELS, {body: frame if body == GROUND else size for level in LEVELS for body in level})
    formed = {"coupler": _coupler(params, size)}
    return linkage_parts(MACHINE_NAME, mechanism(params, ground_angle), levels, formed, ("O1",))


def shaft_part(params: KnottingFourBarParams, hole: float, low: float = 0.0) -> Part:
    """The shaft of a crank, which is fixed in it, from a height up to its face [m]."""
    top = made_parts(params, hole).levels.across(["crank"])[1]
    return pin_part(SHAFT, "shaft of a crank", hole, top - low)


def gear_part(params: KnottingFourBarParams, gears: EqualGears, bore: float) -> Part:
    """A gear on a crank's pivot as a disc of its pitch circle; bore [m], 0: none."""
    holes = (circle(0j, bore / 2),) if bore > 0 else ()
    shape = Prism(disc(gears.pitch_radius, *holes), gears.width)
    return Part(f"{MACHINE_NAME}/gear", "gear of a crank", "turned part", shape, material_of(params), envelope=True)


def _coupler(params: KnottingFourBarParams, size: LinkSize) -> Part:
    """The coupler with holder and gripper, cut from one plate: square where the holder begins."""
    low, high = coupler_ends(params)
    start, end = (low, high) if params.hand > 0 else (high, low)
    steps = [(abs(out - begin), width) for begin, out, width in tool(params).values()]
    pins = {"O2": 0j, "O2'": complex(params.coupler)}
    outline = stepped_link(complex(start), complex(end), params.width, steps)
    holes = [Hole(point, size.hole / 2) for point in pins.values()]
    return Part(
        f"{MACHINE_NAME}/coupler",
        "coupler with holder and gripper",
        "machined link",
        Prism(drilled(outline, holes), params.thickness),
        size.material,
        seats={name: Seat(placement(point.real), size.hole) for name, point in pins.items()},
    )
