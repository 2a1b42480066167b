"""The index of a head's magazine: errors of its tubes one by one, the flag between them and over its sensor."""

import numpy as np
import pytest

from ilmek.machines.weaver import MACHINE, WeaverParams
from ilmek.machines.weaver.magazine_parts import INDEX_SENSOR, TUBE_FLAG
from ilmek.machines.weaver.selector import selector_of
from ilmek.machines.weaver.tree import HEAD, MAGAZINE
from ilmek.part.tree import Occurrence, Tree
from ilmek.units import mm

HEADS = ({}, {"tubes": 13}, {"tubes": 5}, {"magazine": "slide", "tubes": 7})


@pytest.mark.parametrize("settings", HEADS)
def test_the_error_of_a_tube_is_the_worst_of_all_by_full_steps(settings: dict[str, int | str]) -> None:
    weaver = MACHINE.design(WeaverParams(**settings))
    magazine, params = weaver.magazine, weaver.params
    around = magazine.per_tier * magazine.pitch if magazine.kind == "drum" else 2 * np.pi * params.selector_pulley
    worst = 0.0
    for tube in range(magazine.per_tier):
        place = tube * magazine.pitch
        worst = max(worst, min(abs(place - step * around / 200) for step in range(2000)))
    found = selector_of(params, magazine)
    assert found.error == pytest.approx(worst + 0.05 * around / 200 + 0.15 * mm)
    (check,) = (check for check in MACHINE.report(weaver).checks if check.name == "position of a tube")
    assert check.value == pytest.approx(found.error)
    assert check.limit == pytest.approx((0.6 * magazine.pitch - params.yarn) / 2)


def test_a_drum_of_tubes_of_small_pitch_fails() -> None:
    weaver = MACHINE.design(WeaverParams(tube_pitch=2.8 * mm, tubes=16))
    assert "position of a tube" in {check.name for check in MACHINE.report(weaver).failed}


@pytest.mark.parametrize("settings", HEADS)
def test_the_flag_is_over_its_sensor_and_leaves_the_tubes_open(settings: dict[str, int | str]) -> None:
    weaver = MACHINE.design(WeaverParams(**settings))
    tree, magazine = MACHINE.tree(weaver), weaver.magazine
    flag, sensor = (_corners(tree, body, part) for body, part in ((MAGAZINE, TUBE_FLAG), (HEAD, INDEX_SENSOR)))
    lowered = (magazine.tiers - 1) * magazine.pitch / 2  # to its highest tier, which is then at the handler
    assert float(flag[:, 1].min() - sensor[:, 1].max()) == pytest.approx(1 * mm + lowered)
    middle = sensor.mean(axis=0)[[0, 2]]
    plan = flag[:, [0, 2]]
    axis = (weaver.shape.magazine + weaver.shape.magazine_size / 2).real
    assert _inside(middle, plan)
    for tube in magazine.tubes_at:
        rim = np.array([tube.real, axis + tube.imag]) + 0.3 * magazine.pitch * np.array(
            [[np.cos(angle), np.sin(angle)] for angle in np.linspace(0, 2 * np.pi, 72)]
        )
        assert not any(_inside(point, plan) for point in rim)


def _corners(tree: Tree, body: str, part: str) -> np.ndarray:
    """Corners of a part in the head's axes."""
    own = tree.body(body)
    occurrence: Occurrence = next(one for one in own.occurrences if one.part.id == part)
    assert occurrence.part.shape is not None
    points = own.positions[0].points(occurrence.positions[0].points(occurrence.part.shape.mesh().points))
    return np.asarray(points)


def _inside(point: np.ndarray, plan: np.ndarray) -> bool:
    """Whether a point is in the rectangle of a set of corners: by the longer side's direction."""
    middle = plan.mean(axis=0)
    along = np.linalg.svd(plan - middle)[2]
    local, half = along @ (point - middle), np.abs((plan - middle) @ along.T).max(axis=0)
    return bool(np.all(np.abs(local) <= half))
