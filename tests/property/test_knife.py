"""The knife of a head: the work of its motor is that of the cut, its blade leaves the eye open and shuts it.

Judges: the trapezoid rule over the angle, Newton's law step by step, corners of the parts' meshes at poses of the tree.
"""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ilmek.machines.automated_loom import MACHINE as LOOM
from ilmek.machines.automated_loom.in_space.heads import head_alone
from ilmek.machines.weaver import MACHINE, WeaverParams
from ilmek.machines.weaver.cutter import CROSSED, LAP, cut, eccentricity, half_turn
from ilmek.machines.weaver.knife import BLADE_BODY, CUTTER_MOTOR, ECCENTRIC, EYE, KNIFE, eye_at, knife_checks
from ilmek.machines.weaver.motions import HANDLER
from ilmek.part.poses import chains, poses
from ilmek.part.tree import Occurrence
from ilmek.units import mm, turn

YARNS = st.floats(0.2 * mm, 4 * mm)

LOOMS: tuple[dict[str, str], ...] = ({}, {"warp_pitch": "1.6 mm"}, {"weaver.cutter_turn": "25 ms"})


@given(YARNS, st.floats(1.0, 500.0), st.floats(0.005, 0.2))
def test_the_motor_gives_the_work_of_the_cut_over_half_a_turn_and_ends_where_it_began(
    yarn: float, force: float, time: float
) -> None:
    load = cut(yarn, force, time, 1e-6)
    step = time / (len(load.torque) // 2)
    assert float(np.sum(load.torque * load.speed)) * step == pytest.approx(force * yarn, rel=0.02)
    assert float(np.sum(load.speed)) * step == pytest.approx(turn, rel=1e-3)
    assert float(np.sum(load.acceleration)) == pytest.approx(0.0, abs=1e-6 * float(np.abs(load.acceleration).sum()))
    assert float(np.sum(load.acceleration[: len(load.speed) // 4])) * step == pytest.approx(
        float(load.speed.max()), rel=0.01
    )


@given(YARNS)
def test_the_blade_crosses_the_yarn_in_the_stated_share_of_half_a_turn(yarn: float) -> None:
    share = np.linspace(0.0, 1.0, 20_001)
    travel = eccentricity(yarn) * (1 - np.cos(half_turn(share)))
    first = (LAP - 1) * yarn / 2
    crossing = (travel > first) & (travel < first + yarn)
    assert float(crossing.mean()) == pytest.approx(CROSSED, abs=2e-4)


@pytest.mark.parametrize("number", range(len(LOOMS)))
def test_the_blade_leaves_the_eye_open_and_shuts_it_while_the_yarn_is_drawn_and_not_yet_shown(number: int) -> None:
    loom = LOOM.design(LOOM.params.read({"aim": "price", **LOOMS[number]}))
    weaver, tree = loom.weaver, head_alone(loom)
    handler, eye = loom.knot_cyclogram.track(HANDLER), eye_at(weaver)
    chain = next(chain for chain in chains(tree) if chain[-1].name == BLADE_BODY)
    (blade,) = tree.body(BLADE_BODY).occurrences
    bore = _bore(next(one for body in tree.bodies for one in body.occurrences if one.part.id == EYE))
    assert blade.part.shape is not None
    corners = blade.part.shape.mesh().points
    angle = np.linspace(0.0, turn, 20_001)
    posed = poses(chain, "knot", angle)
    edge = posed.origin[:, 1] + float(corners[:, 1].max())
    wide = posed.origin[0, 0] + corners[:, 0]
    assert edge.min() == pytest.approx(eye.imag - bore / 2, abs=1e-9)
    assert edge.max() == pytest.approx(eye.imag + bore / 2, abs=1e-6)
    assert wide.min() < eye.real - bore / 2
    assert wide.max() > eye.real + bore / 2
    cutting = angle[(edge > eye.imag - weaver.params.yarn / 2) & (edge < eye.imag + weaver.params.yarn / 2)]
    first = cutting[cutting < float(angle[np.argmax(edge)])]
    assert handler.segment("draw").end < first[0]
    assert first[-1] < handler.segment("present").start
    took = (first[-1] - first[0]) / loom.knot_cyclogram.speed
    assert took == pytest.approx(weaver.params.cutting_time, abs=3e-4)


def _bore(eye: Occurrence) -> float:
    """Inner diameter of the eye [m], by the corners of its mesh."""
    assert eye.part.shape is not None
    points = eye.part.shape.mesh(1e-6).points
    return 2 * float(np.hypot(points[:, 0], points[:, 1]).min())


@pytest.mark.parametrize("time", [0.002, 0.015, 0.025, 0.04])
def test_a_cut_that_no_motor_makes_fails_a_check(time: float) -> None:
    weaver = MACHINE.design(WeaverParams(cutter_turn=time))
    torque = next(check for check in knife_checks(weaver) if check.parts == (CUTTER_MOTOR, KNIFE))
    # Greatest speed of half a turn in its time, evenly quicker and slower: 2 pi / T; the servos turn at 3000 rpm.
    assert torque.ok == (2 * math.pi / time <= 3000 * turn / 60)


def test_without_its_eccentric_nothing_holds_the_blade() -> None:
    weaver = MACHINE.design(WeaverParams())
    closed = [closure for closure in MACHINE.tree(weaver).closures if BLADE_BODY in closure.bodies]
    assert [closure.kept_by for closure in closed] == [(ECCENTRIC,)]
