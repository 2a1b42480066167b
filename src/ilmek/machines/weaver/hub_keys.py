"""The keys of a head's hubs: one through cams, spacers and pulley on the cam shaft, one on the reducer's output.

All grooves and keyways open towards x of the shaft, so that the cams stand by their key.
"""

import math
from collections.abc import Iterator

import numpy as np

from ilmek.cams.loaded_plate_cam import STEEL
from ilmek.elements.keyways import keyway_for
from ilmek.elements.parallel_keys import KeyedEnd, keyed_end
from ilmek.elements.plates import round_bore
from ilmek.machines.weaver.cam_belt import SMALL
from ilmek.machines.weaver.design import Weaver
from ilmek.machines.weaver.tool_parts import part_id
from ilmek.machines.weaver.widths import stack_width
from ilmek.part.profile import Profile
from ilmek.part.shapes import Prism, disc
from ilmek.plane.contours import keyed_bore
from ilmek.report import Check
from ilmek.units import mm

OUTPUT = 14 * mm
"""Diameter of the reducer's output [m]; assumed by this project."""

OVER_KEY = 2.7 * mm
"""Wall of a hub over its keyway [m]; assumed by this project."""

STACK_KEY, SMALL_KEY = part_id("cam-shaft-key"), part_id("small-pulley-key")
"""Ids of the parts."""


def grooved(diameter: float, length: float) -> Prism:
    """A shaft with a groove along it [m]."""
    row = keyway_for(diameter)
    return Prism(Profile(keyed_bore(diameter / 2, row.width, -row.in_shaft)), length)


def hub_diameter(bore: float) -> float:
    """Diameter of a hub about a bore with its keyway [m]."""
    return bore + 2 * (keyway_for(bore).in_hub + OVER_KEY)


def keyed_ring(bore: float, length: float) -> Prism:
    """A hub with a keyway [m]."""
    return Prism(disc(hub_diameter(bore) / 2, *round_bore(bore).cutouts), length)


def groove_half(weaver: Weaver) -> float:
    """Half the length of the groove of the cam shaft, from the first to the last hub [m]."""
    return stack_width(weaver.params) / 2 - weaver.params.cam_gap


def stack_key(weaver: Weaver, torque: float, hub: float) -> KeyedEnd:
    """The key through all hubs of the cam shaft, in whole millimetres, in one of them: its length, the torque on it."""
    length = math.floor(2 * groove_half(weaver) / mm + 1e-9) * mm
    return KeyedEnd(weaver.params.shaft, length, torque, STEEL.strength, hub=hub)


def cam_key(weaver: Weaver) -> KeyedEnd:
    """That key in a cam, by the greatest torque of any."""
    torque = max(float(np.abs(cam.torque).max()) for cam in weaver.cams)
    return stack_key(weaver, torque, weaver.params.cam_thickness)


def small_key(weaver: Weaver) -> KeyedEnd:
    """The key of the small pulley."""
    return keyed_end(OUTPUT, weaver.belt.torque * SMALL / weaver.belt.large, STEEL.strength)


def key_checks(weaver: Weaver) -> Iterator[Check]:
    """Surface pressures of the keys."""
    cure = "set a thicker weaver.shaft, lighter tools, or a longer knot_cycle"
    pulley = stack_key(weaver, weaver.belt.torque, weaver.belt.width)
    yield cam_key(weaver).check("head's cams", cure, (STACK_KEY,))
    yield pulley.check("pulley of the cam shaft", cure, (STACK_KEY,))
    yield small_key(weaver).check("small pulley of the cam belt", cure, (SMALL_KEY,))
