"""A follower on an eccentric circle is a linkage: the cam's geometry against `ilmek.linkage`, two ways to one motion.

The motion is taken from the linkage, made a programme of two laws (out and back), and given to the cam; its pitch
curve must be the circle again, its pressure angle the linkage's.
"""

import math
from collections.abc import Callable

import numpy as np
import pytest

from ilmek.cams.laws import Law
from ilmek.cams.limits import area, convex_radius_min, pressure_angle_max
from ilmek.cams.oscillating import OscillatingCam, arm_angle
from ilmek.cams.oscillating_flat import OscillatingFlatCam, face_span
from ilmek.cams.plate import PlateCam
from ilmek.cams.programme import TURN, CamProgramme, CamSegment
from ilmek.linkage.fourbar import four_bar, slider_crank
from ilmek.linkage.model import GROUND, Body, Mechanism, Pin, Rotation, Slide
from ilmek.linkage.quality import transmission_angle
from ilmek.linkage.solve import solve
from ilmek.linkage.structure import plan
from ilmek.linkage.transmission import pressure_angle
from ilmek.units import mm

RADIUS, SHIFT, ROLLER = 50 * mm, 15 * mm, 12 * mm
ANGLE = np.linspace(0.0, TURN, 361)
SIDES = pytest.mark.parametrize("side", [1, -1])

Rows = Callable[[np.ndarray], tuple[np.ndarray, np.ndarray, np.ndarray]]


def programme_of(follower: Rows, lowest: float, highest: float) -> CamProgramme:
    """The follower's motion as a rise from its lowest pose and a fall from its highest, cam angles [rad]."""
    ends = follower(np.array([lowest, highest]))[0]
    lift, out = float(ends[1] - ends[0]), float((highest - lowest) % TURN)

    def segment(name: str, begin: float, span: float, change: float) -> CamSegment:
        start = ends[0] if change > 0 else ends[1]

        def row(order: int) -> Callable[[np.ndarray], np.ndarray]:
            def value(u: np.ndarray) -> np.ndarray:
                at = np.asarray(u, dtype=float)
                found = follower(begin + span * at.ravel())[order].reshape(at.shape)
                return (found - (start if order == 0 else 0.0)) * span**order / change

            return value

        still = [math.inf] * 5
        law = Law("linkage", row(0), row(1), row(2), lambda u: 0.0 * np.asarray(u), *still)
        return CamSegment(name, span, change, law)

    segments = segment("rise", lowest, out, lift), segment("fall", highest, TURN - out, -lift)
    return CamProgramme(segments, start=lowest)


def rocker(side: int) -> Mechanism:
    return four_bar(120 * mm, SHIFT, RADIUS + ROLLER, 90 * mm, branch=side)


def arm_on_a_circle(side: int) -> OscillatingCam:
    four = plan(rocker(side))

    def follower(angle):
        moved = solve(four, angle, 1.0).require()
        return math.pi - side * moved.angle("rocker"), -side * moved.omega("rocker"), -side * moved.alpha("rocker")

    def crank(reach: float) -> float:
        centre = 120 * mm - 90 * mm * np.exp(-1j * side * arm_angle(reach, 120 * mm, 90 * mm))
        return float(np.angle(centre))

    near, far = RADIUS + ROLLER - SHIFT, RADIUS + ROLLER + SHIFT
    programme = programme_of(follower, crank(near) + math.pi, crank(far))
    return OscillatingCam(programme, near, 120 * mm, 90 * mm, side, ROLLER)


@SIDES
def test_oscillating_roller_on_an_eccentric_circle_is_a_four_bar(side) -> None:
    cam = arm_on_a_circle(side)
    moved = solve(plan(rocker(side)), ANGLE, 1.0).require()
    trace = cam.trace(ANGLE)
    np.testing.assert_allclose(np.abs(trace.surface - SHIFT), RADIUS, rtol=1e-12)
    np.testing.assert_allclose(1 / trace.curvature, RADIUS + ROLLER, rtol=1e-10)
    np.testing.assert_allclose(1 / trace.surface_curvature, RADIUS, rtol=1e-10)
    leaning = np.abs(math.pi / 2 - transmission_angle(moved, "B"))
    np.testing.assert_allclose(np.abs(trace.pressure_angle), leaning, atol=1e-11)


@SIDES
def test_its_swing_and_largest_pressure_angle_are_the_four_bars(side) -> None:
    """Extremes of the transmission angle: crank in line with the ground, coupler and rocker span c - e and c + e."""
    cam = arm_on_a_circle(side)
    c, e, arm, b = 120 * mm, SHIFT, 90 * mm, RADIUS + ROLLER
    swing = [math.acos((c**2 + arm**2 - (b + z) ** 2) / (2 * c * arm)) for z in (-e, e)]
    assert cam.programme.segments[0].change == pytest.approx(swing[1] - swing[0], rel=1e-12)
    spans = [math.acos((arm**2 + b**2 - (c + z) ** 2) / (2 * arm * b)) for z in (-e, e)]
    worst = max(abs(math.pi / 2 - span) for span in spans)
    assert pressure_angle_max(cam).value == pytest.approx(worst, abs=1e-11)
    assert area(cam) == pytest.approx(math.pi * RADIUS**2, rel=1e-11)
    assert convex_radius_min(cam).value == pytest.approx(RADIUS + ROLLER, rel=1e-9)


@pytest.mark.parametrize("offset", [0.0, 8 * mm, -8 * mm])
def test_translating_roller_on_an_eccentric_circle_is_a_slider_crank(offset) -> None:
    """The largest pressure angle without offset: asin(e/(R + Rr))."""
    crank = plan(slider_crank(SHIFT, RADIUS + ROLLER, branch=+1, offset=-offset))

    def follower(angle):
        moved = solve(crank, angle, 1.0).require().point("slider", "B")
        return moved.position.real, moved.velocity.real, moved.acceleration.real

    near, far = (math.sqrt((RADIUS + ROLLER + z) ** 2 - offset**2) - 1j * offset for z in (-SHIFT, SHIFT))
    programme = programme_of(follower, float(np.angle(near)) + math.pi, float(np.angle(far)))
    cam = PlateCam(programme, abs(near), offset, ROLLER)
    trace, moved = cam.trace(ANGLE), solve(crank, ANGLE, 1.0).require()
    np.testing.assert_allclose(np.abs(trace.surface - SHIFT), RADIUS, rtol=1e-12)
    np.testing.assert_allclose(1 / cam.curvature(ANGLE), RADIUS + ROLLER, rtol=1e-10)
    np.testing.assert_allclose(np.abs(trace.pressure_angle), pressure_angle(moved, "line", "rod"), atol=1e-11)
    if offset == 0:
        assert pressure_angle_max(cam).value == pytest.approx(math.asin(SHIFT / (RADIUS + ROLLER)), abs=1e-12)


@pytest.mark.parametrize(("side", "face"), [(1, 0.0), (-1, 6 * mm), (1, -4 * mm)])
def test_oscillating_flat_face_on_an_eccentric_circle_is_an_inverted_slider_crank(side, face) -> None:
    pivot = 120 * mm
    bodies = (
        Body(GROUND, {"A0": 0, "B0": pivot}),
        Body("crank", {"A0": 0, "A": SHIFT}),
        Body("block", {"A": 0, "face": 0}),
        Body("follower", {"B0": 0, "face": -1j * side * (face - RADIUS)}),
    )
    joints = (
        Pin("A0", GROUND, "crank"),
        Pin("A", "crank", "block"),
        Slide("face", "block", "follower"),
        Pin("B0", GROUND, "follower"),
    )
    turned = plan(Mechanism(bodies, joints, (Rotation("crank", "A0"),), branches={"face": +1}))

    def follower(angle):
        moved = solve(turned, angle, 1.0).require()
        psi = np.angle(-np.exp(-1j * side * moved.angle("follower")))
        return psi, -side * moved.omega("follower"), -side * moved.alpha("follower")

    poses = [math.asin((RADIUS + z - face) / pivot) for z in (-SHIFT, SHIFT)]
    near, far = (side * (math.pi / 2 - psi) for psi in poses)
    cam = OscillatingFlatCam(programme_of(follower, near + math.pi, far), RADIUS - SHIFT, pivot, face, side)
    trace = cam.trace(ANGLE)
    np.testing.assert_allclose(np.abs(trace.surface - SHIFT), RADIUS, rtol=1e-12)
    np.testing.assert_allclose(1 / trace.curvature, RADIUS, rtol=1e-9)
    moved = solve(turned, ANGLE, 1.0).require()
    along = np.abs(moved.point("block", "A").position - moved.point("follower", "face").position)
    np.testing.assert_allclose(cam.contact_distance(ANGLE), along, rtol=1e-11)
    assert face_span(cam) == pytest.approx((np.min(along), np.max(along)), rel=1e-3)
    np.testing.assert_allclose(np.abs(trace.pressure_angle), np.arctan2(abs(face), along), atol=1e-11)
    assert area(cam) == pytest.approx(math.pi * RADIUS**2, rel=1e-10)
