"""Textile mechanics: warp, shed, fell, tension; the knots tied by a path of the yarn are in `ilmek.weaving.knots`.

The materials of yarns are in `ilmek.elements.yarns`, the kinds of knots in `ilmek.elements.knot_kinds`.

The names below are public; each is imported when it is first used.
"""

from typing import TYPE_CHECKING

from ilmek.lazy import lazy_names

PUBLIC = {
    "Cloth": "ilmek.weaving.cloth",
    "FellPressure": "ilmek.weaving.comb_on_fell",
    "fell_pressure": "ilmek.weaving.comb_on_fell",
    "Bridges": "ilmek.weaving.draping",
    "DrapedWarp": "ilmek.weaving.draping",
    "bridges": "ilmek.weaving.draping",
    "draped_warp": "ilmek.weaving.draping",
    "Fabric": "ilmek.weaving.fell",
    "assumed_fabric": "ilmek.weaving.fell",
    "ShedWarp": "ilmek.weaving.shed",
    "shed_lengthening": "ilmek.weaving.shed",
    "TakeUpTension": "ilmek.weaving.tension",
    "capstan": "ilmek.weaving.tension",
    "take_up_tension": "ilmek.weaving.tension",
    "tension_history": "ilmek.weaving.tension",
    "usual_tension": "ilmek.weaving.tension",
}

__all__ = list(PUBLIC)
__getattr__, __dir__ = lazy_names(__name__, PUBLIC)

if TYPE_CHECKING:
    from ilmek.weaving.cloth import Cloth as Cloth
    from ilmek.weaving.comb_on_fell import FellPressure as FellPressure
    from ilmek.weaving.comb_on_fell import fell_pressure as fell_pressure
    from ilmek.weaving.draping import Bridges as Bridges
    from ilmek.weaving.draping import DrapedWarp as DrapedWarp
    from ilmek.weaving.draping import bridges as bridges
    from ilmek.weaving.draping import draped_warp as draped_warp
    from ilmek.weaving.fell import Fabric as Fabric
    from ilmek.weaving.fell import assumed_fabric as assumed_fabric
    from ilmek.weaving.shed import ShedWarp as ShedWarp
    from ilmek.weaving.shed import shed_lengthening as shed_lengthening
    from ilmek.weaving.tension import TakeUpTension as TakeUpTension
    from ilmek.weaving.tension import capstan as capstan
    from ilmek.weaving.tension import take_up_tension as take_up_tension
    from ilmek.weaving.tension import tension_history as tension_history
    from ilmek.weaving.tension import usual_tension as usual_tension
