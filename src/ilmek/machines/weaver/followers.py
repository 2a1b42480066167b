"""The followers of a head's cams: each a fork with a roller, in the slot of one guide across the head.

In the head's side view the follower slides along the line from the cam shaft's axis to the warps. Its roller is from
the axis by the prime radius and the lift s of its programme:

    x = -(r0 + s(angle))        x to the front from the axis; the shaft is turned so that angle 0 of the cams lies there

The guide stands before the largest cam and its roller. A bar in it ends with the guide where it is lowest, so it
stands out of it by the lift.
"""

from collections.abc import Iterator
from functools import lru_cache

import numpy as np

from ilmek.cams.loaded_plate_cam import ROLLER, STEEL, LoadedPlateCam
from ilmek.machines.weaver.cams import stack_width
from ilmek.machines.weaver.case import ALUMINIUM, WEB
from ilmek.machines.weaver.design import Weaver
from ilmek.machines.weaver.head_shape import GUIDE, LAP, PLAY
from ilmek.machines.weaver.tool_parts import part_id
from ilmek.part.part import Part
from ilmek.part.placement import Placement, placement
from ilmek.part.profile import Profile
from ilmek.part.shapes import Placed, Prism, Sum, bar, rectangle, tube
from ilmek.part.tree import Joint, JointKind, Occurrence, RigidBody
from ilmek.plane.contours import circle, polygon
from ilmek.report import Contour
from ilmek.units import format_quantity, mm

FOLLOWER_GUIDE, CAM_ROLLER, ROLLER_PIN = part_id("follower-guide"), part_id("cam-roller"), part_id("roller-pin")
"""Ids of the parts."""

PIN_SHARE, CHEEK_SHARE, HALF_SHARE = 0.4, 0.4, 0.75
"""Pin over roller; a fork's cheek over the gap of the cams; half a fork's height over the roller's radius; assumed by
this project, the stress of the fork is checked."""


LEAST_CHEEK = 0.1 * mm
"""Of a fork whose cams have no gap beside them [m]."""

FORK_STRESS = (STEEL.fatigue or 0.0) / 2
"""Allowed stress of a fork [Pa]: the fatigue limit over a safety of 2, assumed by this project."""


def follower_id(track: str) -> str:
    """Id of the follower of a cam, and of its body."""
    return part_id(f"{track.replace(' ', '-')}-follower")


def follower_bodies(weaver: Weaver, parent: str, about: Placement, stations: list[float]) -> Iterator[RigidBody]:
    """A fork with its roller for each cam, at angle 0.

    about  the cam shaft's frame, its x to the front       stations  where each cam begins along it [m]
    """
    for cam, station in zip(weaver.cams, stations, strict=True):
        at = placement(-cam.cam.prime_radius - float(cam.motion.s[0]), 0.0, station)
        parts = _follower(weaver, cam)
        yield RigidBody(follower_id(cam.name), parts, parent, Joint(JointKind.CAM, (1.0, 0.0, 0.0)), (about.after(at),))


def follower_mass(weaver: Weaver, cam: LoadedPlateCam) -> float:
    """Mass of the follower of a cam, with roller and pin [kg]."""
    return sum(occurrence.part.mass for occurrence in _follower(weaver, cam))


def fork_stress(weaver: Weaver, cam: LoadedPlateCam) -> float:
    """Greatest stress of a fork's cheeks beside the pin, by half the contact force each [Pa]."""
    cheek, pin = _sizes(weaver)
    return cam.contact_max / (2 * cheek * (2 * HALF_SHARE * weaver.params.roller_radius - pin))


def _sizes(weaver: Weaver) -> tuple[float, float]:
    """Thickness of a fork's cheek, diameter of its pin [m]."""
    params = weaver.params
    return max(CHEEK_SHARE * params.cam_gap, LEAST_CHEEK), 2 * PIN_SHARE * params.roller_radius


def _follower(weaver: Weaver, cam: LoadedPlateCam) -> tuple[Occurrence, ...]:
    roller, bolt = _roller(weaver)
    cheek, _ = _sizes(weaver)
    return Occurrence(_fork(weaver, cam)), Occurrence(roller), Occurrence(bolt, (placement(z=-cheek),))


@lru_cache(maxsize=8)
def _roller(weaver: Weaver) -> tuple[Part, Part]:
    """Roller and pin, alike for all cams."""
    radius, thick = weaver.params.roller_radius, weaver.params.cam_thickness
    cheek, pin = _sizes(weaver)
    ring = tube(2 * radius, radius - pin / 2, thick)
    return (
        Part(CAM_ROLLER, "roller of a cam", "pin or bush", _round(2 * radius), ring, ROLLER),
        Part(ROLLER_PIN, "pin of a roller", "pin or bush", _round(pin), bar(pin, thick + 2 * cheek), STEEL),
    )


def guide(weaver: Weaver, stations: list[float]) -> Occurrence:
    """A plate between the side plates with a slot for each follower, about the cam shaft."""
    params = weaver.params
    thick, half = params.cam_thickness, HALF_SHARE * params.roller_radius
    wide, tall = stack_width(params, len(weaver.cams)), 4 * half
    ends = [(z, z + thick) for z in stations]
    if params.cam_gap < WEB:  # no wall is left between two slots: one window
        ends = [(min(stations) + WEB, max(stations) + thick - WEB)]
    slots = tuple(_box(complex(low, -half), complex(high, half)) for low, high in ends)
    outline = _box(complex(-wide / 2, -tall), complex(wide / 2, tall))
    size = f"{format_quantity(GUIDE, 'mm')} thick"
    part = Part(
        FOLLOWER_GUIDE,
        "guide of the followers",
        "machined link",
        size,
        Prism(Profile(outline, slots), GUIDE),
        ALUMINIUM,
    )
    across = placement(about=(0.0, 1.0, 0.0), angle=-np.pi / 2)
    return Occurrence(part, (placement(-weaver.shape.guide).after(across),))


def _fork(weaver: Weaver, cam: LoadedPlateCam) -> Part:
    """Bar and two cheeks, about the roller's axis, x towards the cam's axis."""
    cheek, pin = _sizes(weaver)
    radius, thick = weaver.params.roller_radius, cam.thickness
    half, near = HALF_SHARE * radius, radius + PLAY
    far = weaver.shape.guide + GUIDE - cam.cam.prime_radius
    body = Placed(Prism(Profile(_box(complex(-far, -half), complex(-near, half))), thick))
    plate = Profile(_box(complex(-near - LAP, -half), complex(pin, half)), (circle(0j, pin / 2),))
    sides = Placed(Prism(plate, cheek), (placement(z=-cheek), placement(z=thick)))
    size = format_quantity(far, "mm")
    return Part(follower_id(cam.name), f"follower of the {cam.name}", "machined link", size, Sum((body, sides)), STEEL)


def _box(low: complex, high: complex) -> Contour:
    middle, size = (low + high) / 2, high - low
    return polygon(middle + rectangle(size.real, size.imag).points)


def _round(diameter: float) -> str:
    return f"round {format_quantity(diameter, 'mm')}"
