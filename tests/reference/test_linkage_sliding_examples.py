"""Textbook mechanisms with slides, against their formulas: yoke, coupling, quick return, cylinder, tangent."""

import numpy as np
import pytest

from ilmek.errors import MechanismError
from ilmek.linkage.model import GROUND, Body, Displacement, Mechanism, Pin, Rotation, Slide
from ilmek.linkage.motion import Status
from ilmek.linkage.solve import solve
from ilmek.linkage.structure import plan

TURN = np.arange(720) * (2 * np.pi / 720)
SPEED = 3.0


def on_crank(ground, crank, bodies, joints, **more) -> Mechanism:
    return Mechanism(
        (Body(GROUND, {"A0": 0, **ground}), Body("crank", {"A0": 0, **crank}), *bodies),
        (Pin("A0", GROUND, "crank"), *joints),
        (Rotation("crank", "A0"),),
        **more,
    )


def test_scotch_yoke_is_a_pure_cosine():
    """Norton, Design of Machinery, section 2.14: yoke's travel r cos(theta), whatever the block carries."""
    bodies = (Body("block", {"A": 0.1j, "slot": 0.2}), Body("yoke", {"slot": 0.05 + 0.2j, "way": 0}))
    joints = (Pin("A", "crank", "block"), Slide("slot", "block", "yoke", np.pi / 2), Slide("way", "yoke", GROUND))
    motion = solve(plan(on_crank({"way": 0}, {"A": 0.4}, bodies, joints)), TURN, SPEED).require()
    yoke = motion.point("yoke", "way")
    np.testing.assert_allclose(yoke.position, 0.4 * np.cos(TURN) + 0.15, atol=1e-15)
    np.testing.assert_allclose(yoke.velocity, -0.4 * SPEED * np.sin(TURN), atol=1e-14)
    np.testing.assert_allclose(yoke.acceleration, -0.4 * SPEED**2 * np.cos(TURN), atol=1e-14)
    np.testing.assert_array_equal(motion.omega("block"), 0)


def test_oldham_coupling_passes_the_speed_on_and_its_disc_goes_round_twice():
    """Norton, section 2.15: equal shaft speeds; the disc's centre runs round the circle over the shafts' distance."""
    offset = 0.03 + 0.04j
    bodies = (Body("disc", {"in": 0, "out": 0}), Body("shaft", {"out": 0, "B0": 0}))
    joints = (Slide("in", "disc", "crank"), Slide("out", "shaft", "disc", np.pi / 2), Pin("B0", "shaft", GROUND))
    motion = solve(plan(on_crank({"B0": offset}, {"in": 0}, bodies, joints)), TURN, SPEED, 0.5).require()
    np.testing.assert_array_equal(motion.omega("shaft"), SPEED)
    np.testing.assert_array_equal(motion.alpha("shaft"), 0.5)
    centre = motion.origin("disc")
    np.testing.assert_allclose(np.abs(centre - offset / 2), abs(offset) / 2, atol=1e-16)
    np.testing.assert_allclose(motion["disc"].velocity / (centre - offset / 2), 2j * SPEED, atol=1e-12)


def whitworth(radius, distance, branch=+1) -> Mechanism:
    """The crank's block slides in the slot of a lever about a pin `distance` below the crank's pivot."""
    bodies = (Body("block", {"A": 0, "slot": 0}), Body("lever", {"B": 0, "slot": 0}))
    joints = (Pin("A", "crank", "block"), Slide("slot", "block", "lever"), Pin("B", GROUND, "lever"))
    ground = {"B": -1j * distance}
    return on_crank(ground, {"A": radius}, bodies, joints, branches={"slot": branch}, name="quick return")


def test_crank_and_slotted_lever_returns_quickly():
    """Norton, section 3.5 (crank-shaper): the lever swings by 2 asin(r/d); time ratio (pi + swing) / (pi - swing)."""
    motion = solve(plan(whitworth(0.1, 0.25)), TURN, SPEED).require()
    angle = motion.angle("lever")
    assert angle.max() - angle.min() == pytest.approx(2 * np.arcsin(0.4), rel=1e-4)
    dead = np.arcsin(0.4)  # the lever stands still where crank and slot are square
    still = solve(plan(whitworth(0.1, 0.25)), np.array([-dead, np.pi + dead]), SPEED)
    np.testing.assert_allclose(still.omega("lever"), 0, atol=1e-13)
    forward, back = np.count_nonzero(motion.omega("lever") > 0), np.count_nonzero(motion.omega("lever") < 0)
    assert forward / back == pytest.approx((np.pi + 2 * dead) / (np.pi - 2 * dead), rel=1e-2)


def test_whitworth_lever_turns_fully_and_its_speeds_are_r_over_r_plus_and_minus_d():
    """Whitworth's form, crank longer than the distance: lever speeds w r / (r + d) and w r / (r - d) in line."""
    motion = solve(plan(whitworth(0.25, 0.1)), np.array([np.pi / 2, -np.pi / 2]), SPEED).require()
    np.testing.assert_allclose(motion.omega("lever"), [SPEED * 0.25 / 0.35, SPEED * 0.25 / 0.15], rtol=1e-14)
    behind = solve(plan(whitworth(0.25, 0.1, branch=-1)), TURN, SPEED).require()
    ahead = solve(plan(whitworth(0.25, 0.1)), TURN, SPEED).require()
    np.testing.assert_allclose(behind.direction("lever"), -ahead.direction("lever"), atol=1e-15)
    np.testing.assert_allclose(behind.alpha("lever"), ahead.alpha("lever"), atol=1e-12)


def test_oscillating_cylinder_reads_its_length_and_piston_speed():
    """Trunnion at D, rod on the crank: length and rate by the cosine rule."""
    trunnion = 0.5 - 0.2j
    bodies = (Body("rod", {"A": 0, "bore": 0.3}), Body("cylinder", {"D": 0, "bore": 0.1}))
    joints = (Pin("A", "crank", "rod"), Slide("bore", "rod", "cylinder", 0.0, np.pi), Pin("D", GROUND, "cylinder"))
    motion = solve(
        plan(on_crank({"D": trunnion}, {"A": 0.12}, bodies, joints, branches={"bore": +1})), TURN, SPEED
    ).require()
    pin = 0.12 * np.exp(1j * TURN)
    length = np.abs(pin - trunnion)
    apart = motion.point("rod", "bore").position - motion.point("cylinder", "bore").position
    np.testing.assert_allclose((apart * np.conj(motion.direction("cylinder"))).real, length - 0.3 - 0.1, atol=1e-15)
    gap = motion.point("rod", "bore").velocity - motion.point("cylinder", "bore").velocity
    gap = gap - 1j * motion.omega("cylinder") * apart
    rate = ((1j * SPEED * pin) * np.conj(pin - trunnion)).real / length
    np.testing.assert_allclose((gap * np.conj(motion.direction("cylinder"))).real, rate, atol=1e-14)


def test_tangent_mechanism():
    """A pin led by a slot of the crank and a line at distance h: y = h tan(theta), y' = h w / cos^2."""
    bodies = (Body("block", {"slot": 0, "C": 0}), Body("rack", {"C": 0, "way": 0}))
    joints = (Slide("slot", "block", "crank"), Pin("C", "block", "rack"), Slide("way", "rack", GROUND, np.pi / 2))
    angle = np.linspace(-1.3, 1.3, 27)
    mechanism = on_crank({"way": 0.2}, {"slot": 0}, bodies, joints)
    motion = solve(plan(mechanism), angle, SPEED, 0.7).require()
    rack, cosine, sine = motion.point("rack", "C"), np.cos(angle), np.sin(angle)
    np.testing.assert_allclose(rack.position, 0.2 + 0.2j * np.tan(angle), rtol=1e-14)
    np.testing.assert_allclose(rack.velocity, 0.2j * SPEED / cosine**2, rtol=1e-13)
    second = 0.2j * (0.7 / cosine**2 + 2 * SPEED**2 * sine / cosine**3)
    np.testing.assert_allclose(rack.acceleration, second, rtol=1e-12, atol=1e-15)
    upright = solve(plan(mechanism), np.array([0.0, np.pi / 2]), SPEED)
    assert list(upright.status) == [Status.OK, Status.DEAD_CENTRE]


def test_slide_offset_larger_than_the_pins_distance_cannot_close_and_says_so():
    bodies = (Body("block", {"A": 0, "slot": 0}), Body("lever", {"B": 0.2j, "slot": 0}))
    joints = (Pin("A", "crank", "block"), Slide("slot", "block", "lever"), Pin("B", GROUND, "lever"))
    broken = on_crank({"B": -0.25j}, {"A": 0.1}, bodies, joints, branches={"slot": 1}, name="quick return")
    motion = solve(plan(broken), np.array([np.pi / 2, -np.pi / 2]), SPEED)
    assert list(motion.status) == [Status.OK, Status.CANNOT_CLOSE]
    said = "cannot close for crank -90.0°: the known pins of lever and block come within 150 mm, slide slot requires"
    with pytest.raises(MechanismError, match=f"{said} a distance of 200 mm; reduce the offset of slide slot by 50 mm"):
        motion.require()


def test_crank_as_long_as_the_distance_is_dead_where_its_pin_passes_the_levers():
    motion = solve(plan(whitworth(0.1, 0.1)), np.array([0.0, -np.pi / 2]), SPEED)
    assert list(motion.status) == [Status.OK, Status.DEAD_CENTRE]
    assert motion.omega("lever")[0] == pytest.approx(SPEED / 2)


def test_parallel_slides_are_refused_by_name():
    bodies = (Body("block", {"A": 0, "slot": 0}), Body("yoke", {"slot": 0, "way": 0}))
    joints = (Pin("A", "crank", "block"), Slide("slot", "block", "yoke"), Slide("way", "yoke", GROUND))
    with pytest.raises(MechanismError, match="slides 'way' and 'slot' of mechanism are parallel"):
        plan(on_crank({"way": 0}, {"A": 0.4}, bodies, joints))
    bodies = (Body("a", {"u": 0, "C": 0}), Body("b", {"C": 0, "v": 0}))
    joints = (Slide("u", "a", "crank", 0.3), Pin("C", "a", "b"), Slide("v", "b", "crank", 0.3 + np.pi))
    with pytest.raises(MechanismError, match="slides 'u' and 'v' of mechanism are parallel"):
        plan(on_crank({}, {"u": 0, "v": 1}, bodies, joints))


def test_guides_that_stand_still_cross_at_a_point_of_the_shifted_one():
    """Two saddles shifted by inputs, a slider on each: the pin stands at (x, y), plain numbers allowed."""
    mechanism = Mechanism(
        bodies=(
            Body(GROUND, {"x": 0, "y": 0}),
            *(Body(name, {name: 0, f"on_{name}": 0}) for name in ("x", "y")),
            *(Body(f"slider_{name}", {f"on_{name}": 0, "C": 0}) for name in ("x", "y")),
        ),
        joints=(
            Slide("x", "x", GROUND),
            Slide("y", "y", GROUND, np.pi / 2),
            Slide("on_x", "slider_x", "x", np.pi / 2),
            Slide("on_y", "slider_y", "y"),
            Pin("C", "slider_x", "slider_y"),
        ),
        inputs=(Displacement("x"), Displacement("y")),
    )
    motion = solve(plan(mechanism), {"x": np.array([0.2, 0.3]), "y": 0.7}, {"x": 1.0, "y": -2.0}).require()
    pin = motion.point("slider_x", "C")
    np.testing.assert_allclose(pin.position, [0.2 + 0.7j, 0.3 + 0.7j], atol=1e-16)
    np.testing.assert_allclose(pin.velocity, 1 - 2j, atol=1e-15)
