"""The keys of a head's hubs: of the cams and the pulley on the cam shaft, of the small pulley on the reducer's output.

All grooves and keyways open towards x of the shaft, so that the cams stand by their keys.
"""

from collections.abc import Iterator

import numpy as np

from ilmek.cams.loaded_plate_cam import STEEL
from ilmek.elements.keyways import keyway_for
from ilmek.elements.parallel_keys import KeyedEnd
from ilmek.elements.plates import round_bore
from ilmek.machines.weaver.cam_belt import SMALL
from ilmek.machines.weaver.design import Weaver
from ilmek.machines.weaver.tool_parts import part_id
from ilmek.part.profile import Profile
from ilmek.part.shapes import Placed, Prism, Shape, Sum, disc, tube
from ilmek.plane.contours import keyed_bore
from ilmek.report import Check
from ilmek.units import mm

OUTPUT = 14 * mm
"""Diameter of the reducer's output [m]; assumed by this project."""

HUB_WALL = 5 * mm
"""Wall of a hub about its bore [m]."""

CAM_KEY, PULLEY_KEY, SMALL_KEY = part_id("cam-key"), part_id("pulley-key"), part_id("small-pulley-key")
"""Ids of the parts."""


def grooved(diameter: float, length: float) -> Prism:
    """A shaft with a groove along it [m]."""
    row = keyway_for(diameter)
    return Prism(Profile(keyed_bore(diameter / 2, row.width, -row.in_shaft)), length)


def keyed_disc(radius: float, bore: float, length: float) -> Shape:
    """A disc with a bore and its keyway [m]: a hub, and a ring about it where the disc is larger."""
    hub = bore / 2 + HUB_WALL
    if radius <= hub:
        return Prism(disc(radius, *round_bore(bore).cutouts), length)
    ring = Placed(tube(2 * radius, radius - hub, length))
    return Sum((ring, Placed(Prism(disc(hub, *round_bore(bore).cutouts), length))))


def cam_key(weaver: Weaver) -> KeyedEnd:
    """The key of a cam, as long as that is thick, by the greatest torque of any."""
    torque = max(float(np.abs(cam.torque).max()) for cam in weaver.cams)
    return _key(weaver.params.shaft, weaver.params.cam_thickness, torque)


def pulley_key(weaver: Weaver) -> KeyedEnd:
    """The key of the pulley on the cam shaft."""
    return _key(weaver.params.shaft, weaver.belt.width, weaver.belt.torque)


def small_key(weaver: Weaver) -> KeyedEnd:
    """The key of the small pulley."""
    return _key(OUTPUT, weaver.belt.width, weaver.belt.torque * SMALL / weaver.belt.large)


def key_checks(weaver: Weaver) -> Iterator[Check]:
    """Surface pressures of the keys."""
    cure = "set a thicker weaver.shaft, lighter tools, or a longer knot_cycle"
    yield cam_key(weaver).check("head's cams", cure, (CAM_KEY,))
    yield pulley_key(weaver).check("pulley of the cam shaft", cure, (PULLEY_KEY,))
    yield small_key(weaver).check("small pulley of the cam belt", cure, (SMALL_KEY,))


def _key(diameter: float, length: float, torque: float) -> KeyedEnd:
    return KeyedEnd(diameter, length, torque, STEEL.strength)
