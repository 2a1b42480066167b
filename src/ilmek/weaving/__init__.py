"""Textile mechanics: warp, shed, fell, tension; the knots tied by a path of the yarn are in `ilmek.weaving.knots`.

The materials of yarns are in `ilmek.elements.yarns`, the kinds of knots in `ilmek.elements.knot_kinds`.
"""

from ilmek.weaving.comb_on_fell import FellPressure, fell_pressure
from ilmek.weaving.draping import Bridges, DrapedWarp, bridges, draped_warp
from ilmek.weaving.fell import Fabric, assumed_fabric
from ilmek.weaving.shed import ShedWarp, shed_lengthening
from ilmek.weaving.tension import TakeUpTension, capstan, take_up_tension, tension_history, usual_tension

__all__ = [
    "Bridges",
    "DrapedWarp",
    "Fabric",
    "FellPressure",
    "ShedWarp",
    "TakeUpTension",
    "assumed_fabric",
    "bridges",
    "capstan",
    "draped_warp",
    "fell_pressure",
    "shed_lengthening",
    "take_up_tension",
    "tension_history",
    "usual_tension",
]
