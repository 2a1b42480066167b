"""A track of a cyclogram as the table of a controller's electronic cam."""

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.cams.laws import law_of
from ilmek.report import CamTable
from ilmek.timing.track import Track, joints, sample
from ilmek.units import turn


def cam_table(track: Track, name: str, title: str, period: float) -> CamTable:
    """The track's motion at a period of the master [s], with all angles at which its laws are not smooth."""

    def motion(angle: FloatArray) -> FloatArray:
        at = sample(track, np.asarray(angle))
        return np.stack([at.position, at.slope, at.bend])

    laws = ((part, law_of(part.law.name, part.law.parameters)) for part in track.segments)
    inner = [part.angle(u) % turn for part, law in laws for u in law.breaks]
    knots = np.unique(np.concatenate([joints(track), inner]))
    return CamTable(name, title, motion, knots, track.unit, period, track.revolves)
