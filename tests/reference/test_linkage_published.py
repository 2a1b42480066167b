"""The general engine against published motions; conventions and misprints as in the papers' re-computation."""

import numpy as np
import pytest

from ilmek.linkage.fourbar import four_bar
from ilmek.linkage.model import GROUND, Body, Mechanism, Pin, Rotation, Slide
from ilmek.linkage.quality import least_transmission_angle, transmission_extremes
from ilmek.linkage.solve import solve
from ilmek.linkage.structure import plan
from ilmek.units import deg, mm

TURN = np.radians(np.arange(0.0, 360.0, 0.025))


def test_norton_example_4_1():
    """Norton, Design of Machinery, example 4-1: a = 40, b = 120, c = 80, d = 100 mm, crank at 40 degrees, open."""
    motion = solve(plan(four_bar(100 * mm, 40 * mm, 120 * mm, 80 * mm, branch=+1)), 40 * deg)
    assert motion.angle("coupler")[0] / deg == pytest.approx(20.30, abs=5e-3)
    assert motion.angle("rocker")[0] / deg == pytest.approx(57.32, abs=1e-2)


def test_beat_up_beater_acceleration_and_velocity():
    """Topalbekiroglu & Celik, beat-up, text under figure 6: 25 m/s^2 at E, with the paper's rounded lengths."""
    mechanism = four_bar(0.3, 0.0597, 0.2007, 0.2308, branch=+1, points={"rocker": {"E": 0.3001}})
    beater = solve(plan(mechanism), TURN, 15.5).require().point("rocker", "E")
    acceleration, speed = np.abs(beater.acceleration), np.abs(beater.velocity)
    assert acceleration.max() == pytest.approx(25.4315, abs=1e-4)
    assert TURN[acceleration.argmax()] / deg == pytest.approx(40.875, abs=0.05)
    assert speed.max() == pytest.approx(1.28877, abs=1e-5)
    assert TURN[speed.argmax()] / deg == pytest.approx(339.2, abs=0.1)


def test_beat_up_transmission_angle_of_table_1():
    """Table 1, phi = 180 degrees, psi = 30 degrees, beta = 48 degrees: mu = 67.24 degrees."""
    sizes = (1.0, np.tan(15 * deg) * np.sin(48 * deg), np.cos(48 * deg), np.sin(48 * deg) / np.cos(15 * deg))
    assert transmission_extremes(*sizes)[0] / deg == pytest.approx(67.2445, abs=1e-4)
    motion = solve(plan(four_bar(*sizes, branch=+1)), TURN)
    assert least_transmission_angle(motion, "B") / deg == pytest.approx(67.2445, abs=1e-4)


def needle() -> Mechanism:
    """Xu et al., tufting needle mechanism, figure 2 and table 1: two dyads in a row, RRR and RRP."""
    at_c, beta1 = (70 + 155j) * mm, 168 * deg
    return Mechanism(
        bodies=(
            Body(GROUND, {"O": 0, "C": at_c, "guide": 170 * mm}),
            Body("l1", {"O": 0, "A": 15 * mm}),
            Body("l2", {"A": 0, "B": 138 * mm}),
            Body("l3", {"C": 0, "B": 115 * mm, "D": 125 * mm * np.exp(1j * beta1)}),
            Body("l5", {"D": 0, "E": 120 * mm}),
            Body("needle", {"E": 0, "guide": 0, "F": -440j * mm}),
        ),
        joints=(
            Pin("O", GROUND, "l1"),
            Pin("A", "l1", "l2"),
            Pin("B", "l2", "l3"),
            Pin("C", GROUND, "l3"),
            Pin("D", "l3", "l5"),
            Pin("E", "l5", "needle"),
            Slide("guide", "needle", GROUND, along=-90 * deg),
        ),
        inputs=(Rotation("l1", "O"),),
        branches={"B": +1, "E": +1},
        name="tufting needle",
    )


def test_tufting_needle_ranges():
    """Xu et al.: ranges of theta2, theta3, theta5 and stroke under figure 7 (theta4's -7.89 is a misprint of -7.68)."""
    steps = plan(needle()).steps
    assert [step.description.rsplit(": ", 1)[-1] for step in steps[1:]] == ["RRR", "RRP"]
    motion = solve(plan(needle()), TURN, 160 * 2 * np.pi / 60).require()
    for body, low, high in (("l2", 101.7089, 114.2518), ("l3", 184.3222, 199.3870), ("l5", 257.9753, 258.5218)):
        angle = np.degrees(motion.angle(body)) % 360
        assert (angle.min(), angle.max()) == pytest.approx((low, high), abs=1e-4)
    theta4 = (np.degrees(motion.angle("l3")) + 168) % 360
    theta4 = np.where(theta4 > 180, theta4 - 360, theta4)
    assert (theta4.min(), theta4.max()) == pytest.approx((-7.6778, 7.3870), abs=1e-4)
    height = motion.point("needle", "F").position.imag
    assert height.max() - height.min() == pytest.approx(32.78838 * mm, abs=1e-5 * mm)
    assert TURN[height.argmin()] / deg == pytest.approx(106.9765, abs=0.02)
    assert TURN[height.argmax()] / deg == pytest.approx(288.2304, abs=0.02)
    fall = -motion.point("needle", "F").velocity.imag
    assert (fall.max(), fall.min()) == pytest.approx((0.28081, -0.27379), abs=1e-5)
    gain = -motion.point("needle", "F").acceleration.imag
    assert (gain.max(), gain.min()) == pytest.approx((3.9399, -5.3057), abs=1e-4)
