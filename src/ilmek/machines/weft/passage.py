"""The passage of a carrier through the shed: jerk-limited, over for a shuttle, there and back for a rapier.

A move of the stroke S within limits of speed, acceleration and jerk takes T (`ilmek.timing.s_curve`). A shuttle passes
once; a rapier goes in, grips the weft for a time g, and comes back: 2 T + g. Within a longer window of the shed the
same motion is stretched, so that no limit is exceeded.
"""

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.cams.laws import Law, law_of
from ilmek.records import computed, record, result
from ilmek.timing.s_curve import SCurve

_LEAST_RAMP = 1e-6


@record
class WeftPassage:
    """A passage.

    move  of the stroke      back  whether the carrier returns in the same shed      pause  between the two moves [s]
    """

    move: SCurve
    back: bool
    pause: float
    run: float = result("mm", "from the cloth's edge to the carrier's rest", name="run_in")

    stroke = computed("mm", "stroke of the carrier, from rest to rest", lambda it: it.move.distance)
    speed = computed("m/s", "largest speed of the carrier", lambda it: it.move.speed, name="speed_max")
    acceleration = computed(
        "m/s^2", "largest acceleration of the carrier", lambda it: it.move.jerk * it.move.ramp, name="acceleration_max"
    )

    @computed("s", "shortest time of a passage; a longer window of the shed stretches it", name="passage_time")
    def time(self) -> float:
        return (2 * self.move.time + self.pause) if self.back else self.move.time

    @property
    def law(self) -> Law:
        """The motion's law, for a cyclogram."""
        move = self.move
        return law_of(
            "s-curve", {"ramp": min(0.25, max(_LEAST_RAMP, move.ramp / move.time)), "cruise": move.cruise / move.time}
        )

    @property
    def share(self) -> float:
        """Share of the passage's time of a move in one direction."""
        both: float = self.time
        return self.move.time / both

    def at(self, time: FloatArray) -> FloatArray:
        """Position, speed, acceleration and jerk at times from the begin of a passage [s], (4, times)."""
        out = self.move.at(time)
        if not self.back:
            return out
        home = self.move.at(self.time - np.asarray(time))
        home[1] *= -1
        home[3] *= -1
        return np.asarray(np.where(np.asarray(time) < self.time / 2, out, home))
