"""Planar linkages: bodies, joints, closed-form motion.

The names below are public; each is imported when it is first used. A function that has the name of its module is
imported from that module.
"""

from typing import TYPE_CHECKING

from ilmek.lazy import lazy_names

PUBLIC = {
    "solve_batch": "ilmek.linkage.batch",
    "dwells": "ilmek.linkage.extremes",
    "four_bar": "ilmek.linkage.fourbar",
    "slider_crank": "ilmek.linkage.fourbar",
    "centrodes": "ilmek.linkage.instant_centres",
    "Body": "ilmek.linkage.model",
    "Coupling": "ilmek.linkage.model",
    "Displacement": "ilmek.linkage.model",
    "Mechanism": "ilmek.linkage.model",
    "Pin": "ilmek.linkage.model",
    "Rotation": "ilmek.linkage.model",
    "Slide": "ilmek.linkage.model",
    "degrees_of_freedom": "ilmek.linkage.model",
    "Motion": "ilmek.linkage.motion",
    "dead_centres": "ilmek.linkage.quality",
    "grashof": "ilmek.linkage.quality",
    "input_range": "ilmek.linkage.quality",
    "least_transmission_angle": "ilmek.linkage.quality",
    "transmission_extremes": "ilmek.linkage.quality",
    "derivatives": "ilmek.linkage.sensitivity",
    "Status": "ilmek.linkage.status",
    "Plan": "ilmek.linkage.structure",
    "plan": "ilmek.linkage.structure",
    "mechanical_advantage": "ilmek.linkage.transmission",
}

__all__ = list(PUBLIC)
__getattr__, __dir__ = lazy_names(__name__, PUBLIC)

if TYPE_CHECKING:
    from ilmek.linkage.batch import solve_batch as solve_batch
    from ilmek.linkage.extremes import dwells as dwells
    from ilmek.linkage.fourbar import four_bar as four_bar
    from ilmek.linkage.fourbar import slider_crank as slider_crank
    from ilmek.linkage.instant_centres import centrodes as centrodes
    from ilmek.linkage.model import Body as Body
    from ilmek.linkage.model import Coupling as Coupling
    from ilmek.linkage.model import Displacement as Displacement
    from ilmek.linkage.model import Mechanism as Mechanism
    from ilmek.linkage.model import Pin as Pin
    from ilmek.linkage.model import Rotation as Rotation
    from ilmek.linkage.model import Slide as Slide
    from ilmek.linkage.model import degrees_of_freedom as degrees_of_freedom
    from ilmek.linkage.motion import Motion as Motion
    from ilmek.linkage.quality import dead_centres as dead_centres
    from ilmek.linkage.quality import grashof as grashof
    from ilmek.linkage.quality import input_range as input_range
    from ilmek.linkage.quality import least_transmission_angle as least_transmission_angle
    from ilmek.linkage.quality import transmission_extremes as transmission_extremes
    from ilmek.linkage.sensitivity import derivatives as derivatives
    from ilmek.linkage.status import Status as Status
    from ilmek.linkage.structure import Plan as Plan
    from ilmek.linkage.structure import plan as plan
    from ilmek.linkage.transmission import mechanical_advantage as mechanical_advantage
