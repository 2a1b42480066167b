"""A cloth for a test by the names of its own parameters and those of its yarns."""

from dataclasses import fields
from typing import Any

from ilmek.elements.carpet_yarns import CarpetYarnParams
from ilmek.weaving import Cloth

_OF_YARNS = {one.name for one in fields(CarpetYarnParams)}


def cloth(**values: Any) -> Cloth:
    """The cloth with values [SI]: `cloth(tension=15.0, warp_stiffness=1350.0)`."""
    of_yarns = {name: value for name, value in values.items() if name in _OF_YARNS}
    own = {name: value for name, value in values.items() if name not in _OF_YARNS}
    return Cloth(**own, yarns=CarpetYarnParams(**of_yarns))
