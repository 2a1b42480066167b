"""Crank-rockers are as long as the heads that knot and the comb's bar require, and no longer.

Evidence: distances of points on the outlines, by brute force, of the rocker at rest and the plate that carries it from
the heads, their magazine and the rail as it is built, while they knot and all along their retreat; and of the coupler,
by circles about its pins, from the bar of the comb.
"""

import math
from collections.abc import Iterator
from functools import cache

import numpy as np
import pytest
from default_machines import SETTLED

from ilmek.arrays import ComplexArray
from ilmek.machines.arrangement.side_view import RETREAT
from ilmek.machines.automated_loom import AutomatedLoomParams, LoomDesign, design
from ilmek.machines.automated_loom.equipment.surroundings import surroundings
from ilmek.machines.automated_loom.parts import parts_of_loom
from ilmek.machines.beat import stroke_needed
from ilmek.machines.beat_up.carriage import shaft
from ilmek.machines.beat_up.design import BeatUp, ground_for
from ilmek.machines.hammer.tree import outline as comb_outline
from ilmek.units import mm

LOOMS = (
    {"beat": "linkage"},
    {"beat": "linkage", "heads": "4"},
    {"beat": "linkage", "heads": "8", "width": "1.5m"},
    {"beat": "travelling"},
    {"beat": "travelling", "heads": "4"},
    {"beat": "travelling", "heads": "6", "knots_across": "40/dm"},
)


@cache
def loom(settings: tuple[tuple[str, str], ...]) -> LoomDesign:
    return design(AutomatedLoomParams.read(SETTLED | dict(settings)))


def linkage_of(made: LoomDesign) -> BeatUp:
    own = made.beat.design
    return own if isinstance(own, BeatUp) else own.linkage.one


def outline(corners: ComplexArray) -> ComplexArray:
    """Points along the sides of a polygon, about 1 mm apart."""
    sides = zip(corners, np.roll(corners, -1), strict=True)
    return np.concatenate([np.linspace(a, b, int(abs(b - a) / mm) + 2) for a, b in sides])


def box(corner: complex, size: complex) -> ComplexArray:
    return outline(corner + np.array([0, size.real, size, 1j * size.imag]))


def heads_of(made: LoomDesign) -> Iterator[ComplexArray]:
    side, section = made.side, parts_of_loom(made).frame.guide[0].side
    yield box(side.of_heads.shape.body, side.of_heads.shape.size)
    yield box(side.of_heads.shape.magazine, side.of_heads.shape.magazine_size)
    # The rail stands in front of the axis on it, whose middle is the arrangement's.
    yield box(side.of_heads.rail.corner + side.of_heads.rail.size / 2 - 0.5j * section, section * (1 + 1j))


def least(one: ComplexArray, other: ComplexArray) -> float:
    return float(np.abs(one[:, None] - other[None, :]).min())


def gap_of_rocker(made: LoomDesign) -> float:
    """Of the rocker at rest, with round ends, from the heads that knot [m]."""
    linkage = linkage_of(made)
    arm, half, path = linkage.lengths["beater"], linkage.params.width / 2, made.beat.path
    middle = path.carried(np.array([linkage.params.before_beater, arm], complex), path.tip[:1])[0]
    spine = np.linspace(middle[0], middle[1], 500)
    return min(least(spine, head) for head in heads_of(made)) - half


def gap_of_plate(made: LoomDesign) -> float:
    """Of the plate's edge towards the heads from these, all along their retreat [m]."""
    linkage = linkage_of(made)
    arm, half = linkage.lengths["beater"], linkage.params.width / 2
    edge = np.linspace(complex(arm - half, -half), shaft(linkage) - (half + 10 * mm) * (1 + 1j), 250)
    lower = np.linspace(complex(arm - half, -half), complex(arm + half, -half), 50)
    plate, steps = np.concatenate([edge, lower]), np.linspace(0.0, made.side.of_heads.retreat, 60) * RETREAT
    return min(least(plate, (head[::4, None] + steps).ravel()) for head in heads_of(made))


def gap_of_coupler(made: LoomDesign) -> float:
    """Of the coupler from the bar that turns with the rocker, over a beat, forward and back [m]."""
    linkage, path = linkage_of(made), made.beat.path
    crank, coupler, rocker, arm = (linkage.lengths[name] for name in ("crank", "coupler", "rocker", "beater"))
    pins, centre = path.carried(np.array([arm - rocker], complex), path.tip)[:, 0], shaft(linkage)
    reach = np.abs(pins - centre)
    along = (crank**2 - coupler**2 + reach**2) / (2 * reach)
    aside = np.sqrt(np.maximum(crank**2 - along**2, 0.0))
    bars = path.carried(outline(comb_outline(made.beat.design.params)[1])[::4], path.tip)
    return (
        min(
            least(np.linspace(pin, crank_pin, 300), bar)
            for side in (1j, -1j)
            for pin, crank_pin, bar in zip(
                pins, centre + (pins - centre) / reach * (along + side * aside), bars, strict=True
            )
        )
        - linkage.params.width / 2
    )


@pytest.mark.matrix(light=3)
@pytest.mark.parametrize("settings", LOOMS, ids=str)
def test_rocker_and_plate_clear_the_heads(settings: dict[str, str]) -> None:
    made = loom(tuple(settings.items()))
    for gap in (gap_of_rocker(made), gap_of_plate(made)):
        assert gap >= made.params.clearance - 0.5 * mm


def test_a_longer_linkage_is_as_long_as_heads_and_bar_require() -> None:
    """Beside four heads the least gap is what the arrangement keeps: 1.5 times the clearance."""
    made = loom((("beat", "linkage"), ("heads", "4")))
    needed = ground_for(stroke_needed(made.task) + 1.5 * made.params.clearance)
    assert linkage_of(made).params.ground > 1.05 * needed
    gap = min(gap_of_rocker(made), gap_of_plate(made), gap_of_coupler(made))
    assert gap == pytest.approx(1.5 * made.params.clearance, abs=1 * mm)  # the length grows in steps


def test_a_comb_under_a_reed_swings_less_on_longer_links_and_stays_below_its_baulks() -> None:
    """Baulks by their parts' boxes; the comb at rest by its corners."""
    made = loom((("beat", "linkage"), ("knots_across", "46/dm"), ("heads", "1"), ("width", "2.6m"), ("length", "2.6m")))
    baulks = surroundings(made).of("shedding/reed-baulk")
    front, low = max(one.high[2] for one in baulks), min(one.low[1] for one in baulks)
    path = made.beat.path
    assert path is not None
    assert path.tip[0].imag >= stroke_needed(made.task)
    leaf, bar, *_ = path.at_rest
    assert leaf.imag.max() < low
    assert bar.real.min() > front or bar.imag.max() < low
    assert linkage_of(made).swing < math.radians(29)


def test_a_ground_that_is_set_is_kept_and_fails_beside_the_heads() -> None:
    made = loom((("beat", "linkage"), ("heads", "4"), ("hammer.ground", "0.46m")))
    assert linkage_of(made).params.ground == 0.46
    assert gap_of_rocker(made) < 0
    check = next(one for one in made.beat.checks if one.name == "clearance: rocker at rest and heads that knot")
    assert not check.ok
    assert check.value == pytest.approx(gap_of_rocker(made), abs=0.5 * mm)
