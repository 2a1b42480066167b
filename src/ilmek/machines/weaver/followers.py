"""The followers of a head's cams: each a fork with a roller, upright in the slot of one guide over the cam shaft.

The axis of a roller is over that of the cams by the prime radius and the lift s of its programme:

    y = r0 + s(angle)        the shaft is turned so that angle 0 of the cams lies upright

A follower ends where it drives: with cheeks about the pin of a lever, with a rail on which a roller of the jaws' rocker
runs wherever its carriage is, or with a rack.
"""

from collections.abc import Iterator
from dataclasses import replace
from functools import lru_cache

import numpy as np

from ilmek.cams.loaded_plate_cam import ROLLER, LoadedPlateCam
from ilmek.elements.materials import MATERIALS
from ilmek.elements.pin_joints import side_play
from ilmek.machines.weaver.case import ALUMINIUM, WEB
from ilmek.machines.weaver.design import Weaver
from ilmek.machines.weaver.head_shape import GUIDE, HALF_GUIDE, LAP, PLAY
from ilmek.machines.weaver.jaws import rail_of
from ilmek.machines.weaver.levers import OVER, PIN, SOLID
from ilmek.machines.weaver.motions import HANDLER
from ilmek.machines.weaver.stations import cheek, follower_half, station
from ilmek.machines.weaver.tool_parts import part_id
from ilmek.machines.weaver.turning import follower_top, rack, rack_at, rack_top
from ilmek.machines.weaver.widths import fork_beside, roller_width, stack_width
from ilmek.part.part import Part
from ilmek.part.placement import IN_SIDE_VIEW, Placement, placement
from ilmek.part.profile import Profile
from ilmek.part.shapes import Placed, Prism, Sum, bar, rectangle, tube
from ilmek.part.tree import Joint, JointKind, Occurrence, RigidBody
from ilmek.plane.contours import circle, polygon
from ilmek.report import Contour
from ilmek.units import mm, turn

FOLLOWER_GUIDE, CAM_ROLLER, ROLLER_PIN = part_id("follower-guide"), part_id("cam-roller"), part_id("roller-pin")
LEVER_PIN = part_id("lever-pin")
"""Ids of the parts."""

PIN_SHARE = 0.34
"""Pin over roller; assumed by this project, the fork's stress is checked."""

FOLLOWER_STEEL, PIN_STEEL = MATERIALS["heat-treatable steel"], MATERIALS["induction-hardened steel"]
"""Of followers: their cheeks are too thin for a hardened surface. The pins in them are hardened."""

RAIL = 5 * mm
"""Height of a rail [m]; assumed by this project."""

FORK_STRESS = (FOLLOWER_STEEL.fatigue or 0.0) / 2
"""Allowed stress of a fork [Pa]: the fatigue limit over a safety of 2, assumed by this project."""


def follower_id(track: str) -> str:
    """Id of the follower of a cam, and of its body."""
    return part_id(f"{track.replace(' ', '-')}-follower")


def follower_bodies(weaver: Weaver, parent: str) -> Iterator[RigidBody]:
    """A fork with its roller for each cam, at angle 0: x of its frame down to the cam's axis, y to the front."""
    axis = weaver.shape.axis
    for cam in weaver.cams:
        height = axis.imag + cam.cam.prime_radius + float(cam.motion.s[0])
        position = placement(station(weaver, cam.name) + cam.thickness / 2, height, axis.real).after(IN_SIDE_VIEW)
        parts = _follower(weaver, cam)
        if cam.name == HANDLER:
            upright = rack_at(weaver, rack_top(weaver) + float(cam.motion.s[0]))
            welded = replace(rack(weaver), joins=(follower_id(cam.name),))
            parts = *parts, Occurrence(welded, (position.after(_DOWN).inverse.after(upright),))
        yield RigidBody(
            follower_id(cam.name), parts, parent, Joint(JointKind.CAM, (1.0, 0.0, 0.0)), (position.after(_DOWN),)
        )


_DOWN = placement(about=(0.0, 0.0, 1.0), angle=-turn / 4)


def fork_stress(weaver: Weaver, cam: LoadedPlateCam) -> float:
    """Greatest stress of a fork's cheeks beside the pin, by half the contact force each [Pa]."""
    fork, pin = _sizes(weaver)
    return cam.contact_max / (2 * fork * (2 * follower_half(weaver) - pin))


def _sizes(weaver: Weaver) -> tuple[float, float]:
    """Thickness of a fork's cheek, diameter of its pin [m]."""
    params = weaver.params
    wide = params.cam_thickness + 2 * fork_beside(params)
    free = wide - roller_width(params) - side_play(roller_width(params))
    return free / 2, 2 * PIN_SHARE * params.roller_radius


def _follower(weaver: Weaver, cam: LoadedPlateCam) -> tuple[Occurrence, ...]:
    roller, bolt = _roller(weaver)
    aside = (weaver.params.cam_thickness - roller_width(weaver.params)) / 2
    across = Occurrence(roller, (placement(z=aside),), turning=True)
    parts = Occurrence(_fork(weaver, cam)), across, Occurrence(bolt, (placement(z=-fork_beside(weaver.params)),))
    if cam.name not in weaver.shape.levers:
        return parts
    return *parts, Occurrence(lever_pin(weaver), (placement(-_pin_height(weaver, cam)),))


@lru_cache(maxsize=8)
def lever_pin(weaver: Weaver) -> Part:
    """The pin of a follower or a drawbar in the slot of its lever, across both cheeks."""
    title = "pin of a lever of the head"
    return Part(LEVER_PIN, title, "pin or bush", bar(PIN, weaver.params.cam_thickness), PIN_STEEL)


@lru_cache(maxsize=8)
def _roller(weaver: Weaver) -> tuple[Part, Part]:
    """Roller and pin, alike for all cams."""
    params, (_, pin) = weaver.params, _sizes(weaver)
    radius, long = params.roller_radius, params.cam_thickness + 2 * fork_beside(params)
    ring = tube(2 * radius, radius - pin / 2, roller_width(params))
    return (
        Part(CAM_ROLLER, "roller of a cam", "pin or bush", ring, ROLLER),
        Part(ROLLER_PIN, "pin of a roller of a cam", "pin or bush", bar(pin, long), PIN_STEEL),
    )


def guide(weaver: Weaver) -> Occurrence:
    """Two plates between the side plates that meet on the cams' line, with half of a slot for each follower.

    Neither its fork nor its rail goes through a whole one.
    """
    params, half = weaver.params, follower_half(weaver)
    wide, shape = stack_width(params), weaver.shape
    middles = sorted(station(weaver, cam.name) for cam in weaver.cams)
    ends = [(middle - params.cam_thickness / 2, middle + params.cam_thickness / 2) for middle in middles]
    if params.cam_gap < WEB:  # no wall is left between two slots: one window
        ends = [(ends[0][0] + WEB, ends[-1][1] - WEB)]
    deep = HALF_GUIDE * params.roller_radius
    corners = [complex(0.0, -wide / 2), complex(-deep, -wide / 2), complex(-deep, wide / 2), complex(0.0, wide / 2)]
    for low, high in ends:
        corners += [complex(0.0, -low), complex(-half, -low), complex(-half, -high), complex(0.0, -high)]
    section = Profile(polygon(np.array(corners)[::-1]))
    part = Part(FOLLOWER_GUIDE, "guide of the followers", "machined link", Prism(section, GUIDE), ALUMINIUM)
    front = placement(0.0, shape.axis.imag + shape.guide, shape.axis.real).after(_LYING)
    return Occurrence(part, (front, front.after(placement(z=GUIDE, about=(0.0, 1.0, 0.0), angle=turn / 2))))


_LYING = Placement(np.zeros(3), np.array([[0.0, -1.0, 0.0], [0.0, 0.0, 1.0], [-1.0, 0.0, 0.0]]))
"""A plate that lies level: its x to the warps, its y to the weaver's left, its z up."""


def _height(weaver: Weaver, cam: LoadedPlateCam, level: float, lift: float) -> float:
    """Over the axis of a cam's roller [m]: a level above the fell that its follower has at a lift."""
    return level - weaver.shape.axis.imag - cam.cam.prime_radius - lift


def _pin_height(weaver: Weaver, cam: LoadedPlateCam) -> float:
    """Of the pin that moves its lever, over the axis of a cam's roller [m]."""
    return _height(weaver, cam, weaver.shape.levers[cam.name].pivot.imag, cam.lift / 2)


def _fork(weaver: Weaver, cam: LoadedPlateCam) -> Part:
    """Bar and two cheeks about the roller's axis; at its upper end what moves the lever, the jaws or the handler."""
    fork, pin = _sizes(weaver)
    radius, thick = weaver.params.roller_radius, cam.thickness
    half, near = follower_half(weaver), radius + PLAY
    upper, ends = _upper(weaver, cam, half)
    body = Placed(Prism(Profile(_bar(near, upper, half, weaver, cam)), thick))
    beside = fork_beside(weaver.params)
    cheeks = Prism(Profile(_box(complex(-near, -half), complex(pin, half)), (circle(0j, pin / 2),)), fork)
    laps = Prism(Profile(_box(complex(-near - LAP, -half), complex(-near, half))), beside)
    sides = (
        Placed(cheeks, (placement(z=-beside), placement(z=thick + beside - fork))),
        Placed(laps, (placement(z=-beside), placement(z=thick))),
    )
    title = f"follower of the {cam.name}"
    return Part(follower_id(cam.name), title, "machined link", Sum((body, *sides, *ends)), FOLLOWER_STEEL)


def _upper(weaver: Weaver, cam: LoadedPlateCam, half: float) -> tuple[float, tuple[Placed, ...]]:
    """Upper end of a follower's bar over its roller [m], and the cheeks about its lever's pin."""
    if cam.name == HANDLER:
        return _height(weaver, cam, follower_top(weaver), 0.0), ()
    if cam.name not in weaver.shape.levers:
        return _height(weaver, cam, rail_of(weaver, cam.name).top, 0.0), ()
    height, thick = _pin_height(weaver, cam), cheek(weaver)
    hole = (circle(complex(-height), PIN / 2),)
    plate = Profile(_box(complex(-height - OVER, -half), complex(SOLID - height, half)), hole)
    places = placement(), placement(z=cam.thickness - thick)
    return height - SOLID, (Placed(Prism(plate, thick), places),)


def _bar(near: float, upper: float, half: float, weaver: Weaver, cam: LoadedPlateCam) -> Contour:
    """A follower's bar, of the jaws with their rail across its upper end."""
    if cam.name == HANDLER or cam.name in weaver.shape.levers:
        return _box(complex(-upper, -half), complex(-near, half))
    rail, line = rail_of(weaver, cam.name), weaver.shape.axis.real
    low, high = min(rail.begin - line, -half), max(rail.end - line, half)
    corners = [
        complex(-upper, low),
        complex(RAIL - upper, low),
        complex(RAIL - upper, -half),
        complex(-near, -half),
        complex(-near, half),
        complex(RAIL - upper, half),
        complex(RAIL - upper, high),
        complex(-upper, high),
    ]
    return polygon(np.array([corner for k, corner in enumerate(corners) if corner != corners[k - 1]]))


def _box(low: complex, high: complex) -> Contour:
    middle, size = (low + high) / 2, high - low
    return polygon(middle + rectangle(size.real, size.imag).points)
