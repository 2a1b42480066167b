"""Forces of block magnets against a sum over their charged faces, and the shuttle's coupling that they decide."""

import math

import numpy as np
import pytest

from ilmek.elements.magnets import PERMEABILITY, REMANENCE, block_forces
from ilmek.machines.weft import Shuttle, WeftParams, design
from ilmek.units import mm


def _by_charges(
    first: tuple[float, float, float], second: tuple[float, float, float], offset: np.ndarray, each: int = 24
) -> np.ndarray:
    """Coulomb's law between small squares of both magnets' end faces."""

    def faces(sides: tuple[float, float, float]) -> tuple[np.ndarray, np.ndarray]:
        x, y = ((np.arange(each) + 0.5) / each - 0.5 for _ in range(2))
        plane = np.stack(np.meshgrid(x * sides[0], y * sides[1], indexing="ij"), axis=-1).reshape(-1, 2)
        area = sides[0] * sides[1] / each**2
        points = [np.column_stack([plane, np.full(len(plane), end * sides[2] / 2)]) for end in (1, -1)]
        return np.concatenate(points), np.repeat([REMANENCE, -REMANENCE], len(plane)) * area

    (at, charge), (other, opposite) = faces(first), faces(second)
    apart = (other + offset)[None] - at[:, None]
    share = charge[:, None] * opposite[None] / (4 * math.pi * PERMEABILITY * np.linalg.norm(apart, axis=-1) ** 3)
    return np.asarray((share[..., None] * apart).sum(axis=(0, 1)))


@pytest.mark.parametrize(
    ("first", "second", "offset"),
    [
        ((20 * mm, 16 * mm, 8 * mm), (20 * mm, 16 * mm, 8 * mm), (9 * mm, 0.0, -15 * mm)),
        ((10 * mm, 12 * mm, 6 * mm), (14 * mm, 8 * mm, 5 * mm), (-4 * mm, 3 * mm, 12 * mm)),
        ((30 * mm, 25 * mm, 10 * mm), (12 * mm, 25 * mm, 10 * mm), (20 * mm, -6 * mm, 17 * mm)),
    ],
)
def test_forces_are_those_of_the_charges_on_the_faces(first, second, offset) -> None:
    shear, pull = block_forces(first, second, offset)
    expected = _by_charges(first, second, np.array(offset))
    most = float(np.linalg.norm(expected))
    assert float(shear) == pytest.approx(expected[0], abs=0.01 * most)
    assert float(pull) == pytest.approx(expected[2], abs=0.01 * most)


def test_the_coupling_holds_what_its_geometry_gives() -> None:
    """Two pairs of magnets, at the lag where they are about to slip; the old assumption was 60 N over 63 mm."""
    carried = design(WeftParams(carrier="shuttle")).carried
    assert isinstance(carried, Shuttle)
    sides, gap = carried.coupling.sides, carried.coupling.gap
    lags = np.linspace(0.0, sides[0], 9)[1:]
    found = [np.abs(2 * _by_charges(sides, sides, np.array([lag, 0.0, gap + sides[2]]))) for lag in lags]
    friction = WeftParams().cloth.yarns.friction
    assert carried.coupling.hold == pytest.approx(max(force[0] - friction * force[2] for force in found), rel=0.03)
    far = design(WeftParams(carrier="shuttle", play=30 * mm, lift=0.3)).carried
    assert isinstance(far, Shuttle)
    assert far.coupling.hold < 1.0


@pytest.mark.parametrize("settings", [{"nose": 0.0}, {"play": 25 * mm, "lift": 0.3}])
def test_a_shuttle_that_slips_gives_way_to_a_rapier(settings: dict[str, float]) -> None:
    made = design(WeftParams(**settings))
    assert made.carrier == "rapier"
    failed = {check.name for check in made.alternatives[0].checks if not check.ok}
    assert "force on the shuttle's magnets" in failed
