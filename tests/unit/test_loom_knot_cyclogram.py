"""The cyclogram of a knot in the loom: its carriage moves as the limits of its axis let it."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from cloths import cloth

from ilmek.machines.automated_loom.cyclogram import CARRIAGE, knot_cyclogram
from ilmek.machines.weaver import WeaverParams, design
from ilmek.timing.s_curve import s_curve
from ilmek.units import turn


@pytest.mark.parametrize(
    "limits",
    [
        {},
        {"cloth": cloth(warp_pitch=0.05), "carriage_jerk": 40.0},
        {"carriage_acceleration": 0.05, "carriage_jerk": 500.0},
    ],
)
def test_the_carriage_steps_by_the_jerk_limited_move(limits: dict[str, Any]) -> None:
    head = design(WeaverParams())
    moved = WeaverParams(**limits)
    period = 40.0
    cyclogram = knot_cyclogram(replace(head, params=moved), period)
    (step,) = cyclogram.track(CARRIAGE).segments
    move = s_curve(moved.cloth.knot_pitch, moved.carriage)
    assert (step.end - step.start) / turn * period == pytest.approx(move.time)
    u = np.linspace(0.0, 1.0, 101)
    np.testing.assert_allclose(
        step.stroke * step.law.s(u), move.at(u * move.time)[0], atol=1e-9 * moved.cloth.knot_pitch
    )
