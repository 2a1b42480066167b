"""Force of the backing on needles over their depth in it.

    down:   F = F_p d / c                                   d <= c: the point opens the hole
            F = F_s + (F_p - F_s) exp(-(d - c) / c)         d > c: the hole is open, the needle slides in it
    up:     F = F_s min(d / c, 1)

d depth of the point under the face that it enters, c length of the needle's taper, F_p force when the taper is through,
F_s friction of backing and yarn. The form is that of measured forces of sewing needles, which rise to a peak at the end
of the taper and fall to a friction; the values are assumed by this project: 8 N for each of 126 needles, a drive's at
1/8 in, bear the 1000 N of the paper; sewing needles in fabrics bear 1 to 10 N.
"""

from dataclasses import dataclass

import numpy as np

from ilmek.arrays import BoolArray, FloatArray
from ilmek.params import Params, kind
from ilmek.units import mm


@dataclass(frozen=True, slots=True)
class PenetrationParams(Params):
    """Force of the backing on the needles of a drive."""

    needles: int = kind.count(126, at_least=1, at_most=10_000, doc="needles of a drive")
    puncture: float = kind.force(
        8.0, at_least=0.0, at_most=1e4, doc="force on a needle whose taper is through the backing", symbol="F_p"
    )
    sliding: float = kind.force(
        3.0, at_least=0.0, at_most=1e4, doc="friction of backing and yarn on a needle in its hole", symbol="F_s"
    )
    taper: float = kind.length(6 * mm, at_least=0.1 * mm, at_most=0.1, doc="length of a needle's taper", symbol="c")

    def force(self, depth: FloatArray, *, down: BoolArray) -> FloatArray:
        """Magnitude on all needles of a drive [N] at depths of their points [m]; 0 out of the backing.

        >>> one = PenetrationParams(needles=1)
        >>> one.force(np.array([0.003, 0.006, 1.0]), down=np.array([True, True, True])).tolist()
        [4.0, 8.0, 3.0]
        """
        within = np.maximum(depth, 0.0) / self.taper
        open_ = self.sliding + (self.puncture - self.sliding) * np.exp(-np.maximum(within - 1, 0.0))
        falling = np.where(within < 1, self.puncture * within, open_)
        return np.asarray(self.needles * np.where(down, falling, self.sliding * np.minimum(within, 1.0)))
