"""Parts of the field devices of a loom, each by its row of the catalogue."""

from ilmek.elements.columns import STEEL
from ilmek.elements.field_devices import FieldDevice
from ilmek.part.part import LASER_CUT, Bought, HolePattern, Part, bought_part
from ilmek.part.placement import Placement, placement
from ilmek.part.shapes import box
from ilmek.units import mm, turn


def device(name: str, title: str, row: FieldDevice, power: float = 0.0) -> Part:
    """A device with the room that it takes: width along x, height along y, along z from 0; power of a supply [W]."""
    holes = tuple(HolePattern(*own[:3], faces=(-1, 1) if own.end else (0,)) for own in row.holes)
    bought = Bought(row.name, row.mass, power=power, holes=holes, drilled=row.drilled)
    return bought_part(name, title, row.kind, box(*row.size), bought, fixing=row.fixing)


DEVICE_PLATE = 5 * mm
"""Thickness of the plate between a device and a post that is narrower [m]; assumed by this project."""


def device_plate(name: str, title: str, row: FieldDevice) -> Part:
    """The plate that is welded to a post and has the threads for a device, from z = 0."""
    wide, high, long = row.size
    if not any(own.end for own in row.holes):
        high = long
    return Part(name, title, LASER_CUT, box(wide, high, DEVICE_PLATE), STEEL)


TO_THE_BACK = placement(about=(0.0, 1.0, 0.0), angle=turn / 2)
"""Rotation of a part whose z is to point to the back."""

UPWARDS = placement(about=(1.0, 0.0, 0.0), angle=-turn / 4)
"""Rotation of a part whose z is to point up; its y to the back."""

TO_THE_RIGHT = placement(about=(0.0, 1.0, 0.0), angle=turn / 4)
"""Rotation of a part whose z is to point to the right; its x to the back."""

TO_THE_LEFT = placement(about=(0.0, 1.0, 0.0), angle=-turn / 4)
"""Rotation of a part whose z is to point to the left; its x to the front."""


def placed(x: float, y: float, z: float, rotation: Placement) -> Placement:
    """A rotation at a place [m]."""
    return placement(x, y, z).after(rotation)
