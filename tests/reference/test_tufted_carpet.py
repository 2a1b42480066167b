"""Mass of tufted carpets: worked examples of the trade's calculators, recomputed from their printed formulas."""

import math

import pytest

from ilmek.machines.tufting_machine import TuftingMachineParams
from ilmek.machines.tufting_machine.product import TuftedCarpet
from ilmek.units import inch, mm, rpm, turn

EXAMPLE = {"gauge": inch / 8, "stitch_rate": 320.0, "pile_height": 10 * mm, "yarn_density": 3400 / 9000 * 1e-3}


def carpet(**changed: float) -> TuftedCarpet:
    return TuftedCarpet(TuftingMachineParams(**(EXAMPLE | changed)), 160 * rpm)


def test_the_trades_example_of_773_grams() -> None:
    """1/ga * 1000/25.4 * st * 10 * (2 pl + 10/st) / 1000 * den / 9000, lengths in mm, st in 10 cm; cut pile.

    Its 10/st is a tenth of the distance of the stitches, 100/st mm: the back stitch counts for a tenth, the backing for
    nothing.
    """
    printed = 8 * 1000 / 25.4 * 32 * 10 * (2 * 10 + 10 / 32) / 1000 * 3400 / 9000
    assert round(printed) == 773
    found = carpet(backing_thickness=0.0, back_stitch=0.1)
    assert found.mass_per_area * 1e3 == pytest.approx(printed, rel=1e-12)


def test_the_other_calculator_counts_the_whole_back_stitch() -> None:
    """Yarn in a cm²: 0.01 m for each line of stitches in a cm, and 2 h for each stitch."""
    lines, stitches = 1 / 0.3175, 3.2
    printed = 0.01 * lines + 2 * 0.010 * lines * stitches
    assert carpet(backing_thickness=0.0).yarn_per_area * 1e-4 == pytest.approx(printed, rel=1e-12)


def test_a_shift_of_the_needle_bar_draws_the_back_stitch_aslant() -> None:
    straight, aslant = carpet(), carpet(shift=2)
    step = complex(1 / 320, 2 * inch / 8)
    assert aslant.yarn_per_stitch - straight.yarn_per_stitch == pytest.approx(abs(step) - 1 / 320, rel=1e-12)


def test_tufts_yarn_and_production_counted_one_by_one() -> None:
    """A square metre stitch by stitch, an hour stroke by stroke."""
    found = carpet(low_height=6 * mm, low_share=0.25, running=1.0)
    length = sum(2 * ((6 if stitch % 4 == 0 else 10) * mm + 0.5 * mm) + 1 / 320 for stitch in range(320)) / (inch / 8)
    assert found.yarn_per_area == pytest.approx(length, rel=1e-12)
    assert found.back_robbing == pytest.approx(8 * mm)
    assert found.needles == math.floor(4.0 / (inch / 8))
    assert found.production == pytest.approx(found.needles * inch / 8 / 320 * 160 / 60, rel=1e-12)
    assert found.stitches_per_minute == pytest.approx(160)
    assert found.speed == pytest.approx(160 * turn / 60)
