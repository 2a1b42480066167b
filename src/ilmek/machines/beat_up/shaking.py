"""What the beat-up shakes the loom with, and the counterweights against it."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.dynamics.balance import (
    Shaking,
    counterweighted,
    crank_counterweight,
    four_bar_counterweights,
    harmonics,
    shaking,
)
from ilmek.dynamics.inertia import Inertia
from ilmek.linkage.motion import Motion
from ilmek.machines.beat_up.params import BeatUpParams


@dataclass(frozen=True, slots=True)
class Balance:
    """The shaking force over a turn, the crank's pivot D its point of reference.

    before, after   without the counterweight and with it, over the angles of the motion
    first           parts of its first harmonic that turn with the crank and against it, before [N]
    counterweight   static moment on the crank [kg m], complex in its frame, and its mass at the radius [kg]
    whole           static moments on crank and rocker that would cancel the force altogether [kg m]
    """

    before: Shaking
    after: Shaking
    first: tuple[float, float]
    counterweight: complex
    mass: float
    whole: tuple[complex, complex]

    def greatest(self, name: str) -> tuple[float, float]:
        """Greatest size of `force` [N] or `moment` [N m] before and after."""
        before, after = (float(np.max(np.abs(getattr(one, name)))) for one in (self.before, self.after))
        return before, after


def balance(
    params: BeatUpParams, lengths: Mapping[str, float], inertias: Mapping[str, Inertia], motion: Motion
) -> Balance:
    """The balance of a motion at constant speed over one turn in even steps, both ends included."""
    radius = params.counterweight_radius or lengths["crank"]
    before = shaking(motion, inertias)
    weight = crank_counterweight(before.force[:-1], params.speed, share=params.balance_share)
    first = harmonics(before.force[:-1], 1)
    after = shaking(motion, {**inertias, "crank": counterweighted(inertias["crank"], weight, radius)})
    whole = four_bar_counterweights(lengths, inertias)
    return Balance(before, after, (abs(first[1]), abs(first[-1])), weight, abs(weight) / radius, whole)


def size(shaken: Shaking) -> FloatArray:
    """Size of the force [N]."""
    sizes: FloatArray = np.abs(shaken.force)
    return sizes
