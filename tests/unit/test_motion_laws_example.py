"""The page on motion laws: its tables are the program's numbers, its figures show what the text says."""

import itertools
import math
from pathlib import Path

import numpy as np
import pytest
from examples.draw_laws import COMPARED, DRAWN, curves, sheet

from ilmek.cams.laws import LAWS
from ilmek.cams.vibration import least_ratio, residual

PAGE = Path(__file__).parents[2] / "docs" / "explanation" / "motion-laws.md"


def rows(columns: int) -> dict[str, list[str]]:
    cells = [line.strip("| ").split(" | ") for line in PAGE.read_text(encoding="utf-8").splitlines() if "|" in line]
    return {row[0]: row[1:] for row in cells if len(row) == columns and row[0] in LAWS}


def test_table_of_factors_is_that_of_the_laws() -> None:
    table = rows(7)
    assert set(LAWS) - set(table) == {"spline", "polynomial"}
    for name, (*printed, joins) in table.items():
        law = LAWS[name]
        values = (
            law.velocity_peak, law.acceleration_peak, law.jerk_peak, law.torque_peak, law.acceleration_rms
        )  # fmt: skip
        assert [math.inf if text == "∞" else float(text) for text in printed] == pytest.approx(values, abs=5.1e-5)
        steps = [abs(float(curve(0.0))) > 1e-9 for curve in (law.v, law.a, law.j)]
        assert joins == ("position", "velocity", "acceleration", "jerk")[[*steps, True].index(True)]


def test_table_of_time_ratios_is_computed() -> None:
    table = rows(4)
    assert len(table) == 7
    for name in ("harmonic", "cycloidal", "4-5-6-7"):
        found = [least_ratio(LAWS[name], share) for share in (0.1, 0.01, 0.001)]
        assert [float(text) for text in table[name]] == pytest.approx(found, abs=5.1e-3)


def test_forty_hertz_in_a_tenth_of_a_second() -> None:
    within = {name: least_ratio(LAWS[name], 0.01) <= 4.0 for name in ("4-5-6-7", "cycloidal", "harmonic")}
    assert within == {"4-5-6-7": True, "cycloidal": True, "harmonic": False}
    quick = [float(residual(LAWS[name], 1.2)) for name in COMPARED]
    assert quick == sorted(quick)


def test_sheet_holds_the_four_curves_of_eight_laws() -> None:
    plots = curves()
    assert [len(plot.series) for plot in plots] == [len(DRAWN)] * 4
    for above, below in itertools.pairwise(plots[:3]):
        for whole, slope in zip(above.series, below.series, strict=True):
            gained = np.sum(np.diff(whole.x) * 0.5 * (slope.y[1:] + slope.y[:-1]))
            assert gained == pytest.approx(whole.y[-1] - whole.y[0], abs=1e-4)
    assert sheet(plots).count("<svg ") == 5
