"""Machine elements: beams, shafts, bearings, springs, gears, belts, screws, motors and reducers, tubes, materials.

The names below are public; each is imported when it is first used. A function that has the name of its module is
imported from that module.
"""

from typing import TYPE_CHECKING

from ilmek.lazy import lazy_names

PUBLIC = {
    "RollingBearing": "ilmek.elements.bearing_table",
    "smallest_bearing": "ilmek.elements.bearings",
    "GearPair": "ilmek.elements.gear_pair",
    "smallest_pair": "ilmek.elements.gear_pair",
    "Material": "ilmek.elements.materials",
    "find_material": "ilmek.elements.materials",
    "Motor": "ilmek.elements.motors",
    "find_motor": "ilmek.elements.motors",
    "Reducer": "ilmek.elements.reducers",
    "Section": "ilmek.elements.sections",
    "round_section": "ilmek.elements.sections",
    "square_section": "ilmek.elements.sections",
    "CompressionSpring": "ilmek.elements.springs",
    "choose_spring": "ilmek.elements.springs",
    "Tube": "ilmek.elements.tubes",
    "find_tube": "ilmek.elements.tubes",
    "YarnMaterial": "ilmek.elements.yarns",
}

__all__ = list(PUBLIC)
__getattr__, __dir__ = lazy_names(__name__, PUBLIC)

if TYPE_CHECKING:
    from ilmek.elements.bearing_table import RollingBearing as RollingBearing
    from ilmek.elements.bearings import smallest_bearing as smallest_bearing
    from ilmek.elements.gear_pair import GearPair as GearPair
    from ilmek.elements.gear_pair import smallest_pair as smallest_pair
    from ilmek.elements.materials import Material as Material
    from ilmek.elements.materials import find_material as find_material
    from ilmek.elements.motors import Motor as Motor
    from ilmek.elements.motors import find_motor as find_motor
    from ilmek.elements.reducers import Reducer as Reducer
    from ilmek.elements.sections import Section as Section
    from ilmek.elements.sections import round_section as round_section
    from ilmek.elements.sections import square_section as square_section
    from ilmek.elements.springs import CompressionSpring as CompressionSpring
    from ilmek.elements.springs import choose_spring as choose_spring
    from ilmek.elements.tubes import Tube as Tube
    from ilmek.elements.tubes import find_tube as find_tube
    from ilmek.elements.yarns import YarnMaterial as YarnMaterial
