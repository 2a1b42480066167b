"""Sizes of a head by its loads: room of the opener, cams with their levers, forks and belt, the masses that they move.

A stress falls as the size that bears it grows. So a size that bears too little is multiplied by the use of its limit,
and rounded up to what is made. A larger part weighs more, so sizes are repeated until all are enough. A head whose
carriage needs a wider motor than has room steps more slowly.
"""

import math
from collections.abc import Iterator
from dataclasses import replace

from ilmek.cams.loaded_plate_cam import PRESSURE_LIMIT
from ilmek.elements.duty import MARGIN
from ilmek.machines.weaver.cam_belt import PROFILE
from ilmek.machines.weaver.carriage_drive import slower
from ilmek.machines.weaver.design import Weaver
from ilmek.machines.weaver.followers import FORK_STRESS, fork_stress
from ilmek.machines.weaver.lever_parts import LEVER_STRESS, lever_stress
from ilmek.machines.weaver.moved import moved_mass
from ilmek.machines.weaver.opener_checks import tools_height
from ilmek.machines.weaver.tree import drive_of
from ilmek.machines.weaver.widths import STATIONS
from ilmek.records import JsonObject
from ilmek.units import g, mm

PLATES = (8 * mm, 10 * mm, 12 * mm, 15 * mm, 20 * mm)
"""Thicknesses of the plates of which cams are cut [m]."""

GAP_STEP, MASS_STEP = 0.1 * mm, 10 * g
"""To which gaps [m] and masses [kg] are rounded up."""


GREATEST = {
    "cam_thickness": PLATES[-1],
    "cam_gap": 6 * mm,
    "cam_belt": PROFILE.widths[-1],
    "tool_mass": 1000 * g,
    "sley_stroke": 100 * mm,
    "height": 60 * mm,
}
"""The greatest of each size [m, kg], where a check fails; assumed by this project."""


def larger_sizes(weaver: Weaver) -> JsonObject:
    """The parameters of a head that its loads need larger, by name; empty where all are enough."""
    params, own = weaver.params, weaver.params.opener
    height = min(max(own.height, tools_height(weaver)), max(own.height, GREATEST["height"]))
    needed = {
        "cam_thickness": _made(PLATES, params.cam_thickness * _cam_use(weaver)),
        "cam_gap": _up(max(params.cam_gap * _fork_use(weaver), _beside_opener(weaver), _about_sley(weaver)), GAP_STEP),
        "cam_belt": _made(PROFILE.widths, MARGIN * weaver.belt.pull / weaver.belt.allowed * params.cam_belt),
        "tool_mass": _up(max(_heavy(weaver), default=0.0), MASS_STEP),
        "sley_stroke": own.front_span + height + own.plate,
    }
    sizes = {name: min(size, GREATEST[name]) for name, size in needed.items()}
    more: JsonObject = {name: size for name, size in sizes.items() if size > getattr(params, name)}
    if height > own.height:
        back = max(own.back_span + own.height - height, own.front_span)
        more["opener"] = replace(own, height=height, back_span=back)
    if not more and (quick := slower(weaver, drive_of(weaver))) < params.carriage_acceleration:
        more["carriage_acceleration"] = quick
    return more


def _cam_use(weaver: Weaver) -> float:
    """Use of what bears in proportion to the thickness of cams: bending of levers, pressure squared on the cams."""
    bent = max(lever_stress(weaver, weaver.cam(track)) for track in weaver.shape.levers) / LEVER_STRESS
    return max(bent, *((cam.pressure_max / PRESSURE_LIMIT) ** 2 for cam in weaver.cams))


def _fork_use(weaver: Weaver) -> float:
    """Use of the followers' forks, whose cheeks are a share of the gap between cams."""
    return max(fork_stress(weaver, cam) for cam in weaver.cams) / FORK_STRESS


def _beside_opener(weaver: Weaver) -> float:
    """The gap with which the sley's cam at the left, and the block over it, stand beside the opener [m]."""
    params = weaver.params
    return (weaver.tool_bodies.opener_half + params.clearance - 2 * params.cam_thickness - params.cam_belt / 2) / 3


def _about_sley(weaver: Weaver) -> float:
    """The gap with which the sley's arm stands between the side plates [m]."""
    params, tools = weaver.params, weaver.tool_bodies
    cams = STATIONS * params.cam_thickness + params.cam_belt
    return (2 * (tools.sley_arm + params.clearance) - cams) / (STATIONS + 2)


def _heavy(weaver: Weaver) -> Iterator[float]:
    """The masses that cams move and that are more than those they are designed for [kg]."""
    for cam in weaver.cams:
        mass = moved_mass(weaver, cam.name)
        if mass > weaver.tool_bodies.moved(cam.name):
            yield mass


def _made(row: tuple[float, ...], least: float) -> float:
    """The least of a row that is enough; its greatest where none is."""
    return next((size for size in row if size >= least), row[-1])


def _up(value: float, step: float) -> float:
    return math.ceil(value / step - 1e-9) * step
