"""The cyclogram.

The names below are public; each is imported when it is first used. A function that has the name of its module is
imported from that module.
"""

from typing import TYPE_CHECKING

from ilmek.lazy import lazy_names

PUBLIC = {
    "Cyclogram": "ilmek.timing.cyclogram",
    "AxisLimits": "ilmek.timing.s_curve",
    "SCurve": "ilmek.timing.s_curve",
    "move_time": "ilmek.timing.s_curve",
    "least_acceleration": "ilmek.timing.solver",
    "least_period": "ilmek.timing.solver",
    "MotionLaw": "ilmek.timing.track",
    "Track": "ilmek.timing.track",
    "TrackEvent": "ilmek.timing.track",
    "TrackSegment": "ilmek.timing.track",
    "windows_of": "ilmek.timing.windows",
}

__all__ = list(PUBLIC)
__getattr__, __dir__ = lazy_names(__name__, PUBLIC)

if TYPE_CHECKING:
    from ilmek.timing.cyclogram import Cyclogram as Cyclogram
    from ilmek.timing.s_curve import AxisLimits as AxisLimits
    from ilmek.timing.s_curve import SCurve as SCurve
    from ilmek.timing.s_curve import move_time as move_time
    from ilmek.timing.solver import least_acceleration as least_acceleration
    from ilmek.timing.solver import least_period as least_period
    from ilmek.timing.track import MotionLaw as MotionLaw
    from ilmek.timing.track import Track as Track
    from ilmek.timing.track import TrackEvent as TrackEvent
    from ilmek.timing.track import TrackSegment as TrackSegment
    from ilmek.timing.windows import windows_of as windows_of
