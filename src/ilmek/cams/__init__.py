"""Cams: motion laws, programmes of rises, falls and dwells, profiles and their limits.

The names below are public; each is imported when it is first used. A function that has the name of its module is
imported from that module.
"""

from typing import TYPE_CHECKING

from ilmek.lazy import lazy_names

PUBLIC = {
    "BarrelCam": "ilmek.cams.barrel",
    "ConjugatePair": "ilmek.cams.conjugate",
    "FlatCam": "ilmek.cams.flat",
    "steady_response": "ilmek.cams.follower_dynamics",
    "FollowerModel": "ilmek.cams.follower_model",
    "Law": "ilmek.cams.laws",
    "law_of": "ilmek.cams.laws",
    "concave_radius_min": "ilmek.cams.limits",
    "convex_radius_min": "ilmek.cams.limits",
    "pressure_angle_max": "ilmek.cams.limits",
    "undercut": "ilmek.cams.limits",
    "OscillatingCam": "ilmek.cams.oscillating",
    "OscillatingFlatCam": "ilmek.cams.oscillating_flat",
    "PlateCam": "ilmek.cams.plate",
    "CamProgramme": "ilmek.cams.programme",
    "all_jumps": "ilmek.cams.programme",
    "joined": "ilmek.cams.programme",
    "CamSegment": "ilmek.cams.segments",
    "blend": "ilmek.cams.segments",
    "dwell": "ilmek.cams.segments",
    "even": "ilmek.cams.segments",
    "fall": "ilmek.cams.segments",
    "free": "ilmek.cams.segments",
    "rise": "ilmek.cams.segments",
    "CamLimits": "ilmek.cams.sizing",
    "best_offset": "ilmek.cams.sizing",
    "smallest_prime": "ilmek.cams.sizing",
}

__all__ = list(PUBLIC)
__getattr__, __dir__ = lazy_names(__name__, PUBLIC)

if TYPE_CHECKING:
    from ilmek.cams.barrel import BarrelCam as BarrelCam
    from ilmek.cams.conjugate import ConjugatePair as ConjugatePair
    from ilmek.cams.flat import FlatCam as FlatCam
    from ilmek.cams.follower_dynamics import steady_response as steady_response
    from ilmek.cams.follower_model import FollowerModel as FollowerModel
    from ilmek.cams.laws import Law as Law
    from ilmek.cams.laws import law_of as law_of
    from ilmek.cams.limits import concave_radius_min as concave_radius_min
    from ilmek.cams.limits import convex_radius_min as convex_radius_min
    from ilmek.cams.limits import pressure_angle_max as pressure_angle_max
    from ilmek.cams.limits import undercut as undercut
    from ilmek.cams.oscillating import OscillatingCam as OscillatingCam
    from ilmek.cams.oscillating_flat import OscillatingFlatCam as OscillatingFlatCam
    from ilmek.cams.plate import PlateCam as PlateCam
    from ilmek.cams.programme import CamProgramme as CamProgramme
    from ilmek.cams.programme import all_jumps as all_jumps
    from ilmek.cams.programme import joined as joined
    from ilmek.cams.segments import CamSegment as CamSegment
    from ilmek.cams.segments import blend as blend
    from ilmek.cams.segments import dwell as dwell
    from ilmek.cams.segments import even as even
    from ilmek.cams.segments import fall as fall
    from ilmek.cams.segments import free as free
    from ilmek.cams.segments import rise as rise
    from ilmek.cams.sizing import CamLimits as CamLimits
    from ilmek.cams.sizing import best_offset as best_offset
    from ilmek.cams.sizing import smallest_prime as smallest_prime
