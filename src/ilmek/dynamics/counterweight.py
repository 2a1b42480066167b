"""Shaking force and moment of a four-bar on its frame, and its counterweights [formulas and sources: `balance`]."""

import cmath
from collections.abc import Mapping

import numpy as np

from ilmek.arrays import NumberArray
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
from ilmek.records import computed, record, result
from ilmek.units import turn


@record
class Balance:
    """Shaking force over a turn and its balance; the reference point of moments is the crank's pivot D.

    before, after   without and with the counterweight, at the samples of the motion
    first           parts of the first harmonic that rotate with the crank and against it, before [N]
    counterweight   static moment on the crank [kg m], complex in its frame
    whole           static moments on crank and rocker that cancel the force completely [kg m]
    """

    before: Shaking
    after: Shaking
    first: tuple[float, float]
    counterweight: complex
    mass: float = result("kg", "mass of the counterweight at counterweight_radius", name="counterweight_mass")
    whole: tuple[complex, complex]

    shaking_force_max = computed("N", "greatest force of the moving masses", lambda it: _most(it.before.force))
    shaking_moment_max = computed("N*m", "its moment about the crank's pivot", lambda it: _most(it.before.moment))
    shaking_first_harmonic = computed(
        "N",
        "the parts of its first harmonic that turn with the crank and against it",
        lambda it: dict(zip(("with_crank", "against_crank"), it.first, strict=True)),
    )
    counterweight_moment = computed("", "on the crank: mass times radius (kg m)", lambda it: abs(it.counterweight))
    counterweight_angle = computed("deg", "its direction, from the crank", lambda it: _direction(it.counterweight))
    shaking_force_max_balanced = computed(
        "N", "greatest force with that counterweight", lambda it: _most(it.after.force)
    )
    shaking_moment_max_balanced = computed("N*m", "greatest shaking moment with it", lambda it: _most(it.after.moment))
    full_balance_moment = computed(
        "",
        "counterweights that would leave no shaking force at all: mass times radius (kg m)",
        lambda it: {link: abs(one) for link, one in zip(("crank", "rocker"), it.whole, strict=True)},
    )
    full_balance_angle = computed(
        "deg",
        "their directions, from crank and rocker",
        lambda it: {link: _direction(one) for link, one in zip(("crank", "rocker"), it.whole, strict=True)},
    )


def _most(values: NumberArray) -> float:
    return float(np.max(np.abs(values)))


def _direction(static_moment: complex) -> float:
    """Angle of a static moment in [0, 2 pi) [rad]; rounding below 0 counts as 0."""
    angle = cmath.phase(static_moment) % turn
    return 0.0 if turn - angle < ROUNDING else angle


ROUNDING = 1e-10
"""Distance from a full turn that counts as rounding [rad]."""


def balance(
    motion: Motion, lengths: Mapping[str, float], inertias: Mapping[str, Inertia], *, share: float, radius: float
) -> Balance:
    """The balance of a motion at constant speed over one turn in even steps, both ends included.

    lengths, inertias  of the links [m] and of the bodies, by name: crank, coupler, rocker
    share              of the first harmonic's part that turns with the crank, cancelled by the counterweight on it
    radius             distance of that counterweight's mass centre from the crank's pivot [m]
    """
    speed = float(motion.omega("crank")[0])
    before = shaking(motion, inertias)
    weight = crank_counterweight(before.force[:-1], speed, share=share)
    first = harmonics(before.force[:-1], 1)
    after = shaking(motion, {**inertias, "crank": counterweighted(inertias["crank"], weight, radius)})
    whole = four_bar_counterweights(lengths, inertias)
    return Balance(before, after, (abs(first[1]), abs(first[-1])), weight, abs(weight) / radius, whole)
