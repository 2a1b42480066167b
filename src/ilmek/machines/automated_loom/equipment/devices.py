"""Parts of the field devices of a loom, each by its row of the catalogue."""

from ilmek.elements.field_devices import FieldDevice
from ilmek.part.part import Bought, Part, bought_part
from ilmek.part.placement import Placement, placement
from ilmek.part.shapes import box
from ilmek.units import turn


def device(name: str, title: str, row: FieldDevice, power: float = 0.0) -> Part:
    """A device with the room that it takes: width along x, height along y, along z from 0; power of a supply [W]."""
    shape, bought = box(*row.size), Bought(row.name, row.mass, power=power)
    return bought_part(name, title, row.kind, shape, bought, fixing=row.fixing)


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
