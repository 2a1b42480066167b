"""What a mechanism refuses, and in which words."""

import pytest

from ilmek.errors import MechanismError
from ilmek.linkage.fourbar import four_bar, slider_crank
from ilmek.linkage.model import GROUND, Body, Displacement, Mechanism, Pin, Rotation, Slide, degrees_of_freedom
from ilmek.linkage.structure import plan

BODIES = (
    Body(GROUND, {"A0": 0, "B0": 0.3}),
    Body("crank", {"A0": 0, "A": 0.06}),
    Body("coupler", {"A": 0, "B": 0.2}),
    Body("rocker", {"B0": 0, "B": 0.23}),
)
PINS = (
    Pin("A0", GROUND, "crank"),
    Pin("A", "crank", "coupler"),
    Pin("B", "coupler", "rocker"),
    Pin("B0", GROUND, "rocker"),
)
DRIVE = (Rotation("crank", "A0"),)


def refused(bodies=BODIES, joints=PINS, inputs=DRIVE, branches=(("B", 1),)):
    with pytest.raises(MechanismError) as caught:
        plan(Mechanism(tuple(bodies), tuple(joints), tuple(inputs), dict(branches)))
    return str(caught.value)


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (dict(bodies=(*BODIES, Body("crank", {}))), "2 bodies named 'crank'"),
        (dict(joints=(*PINS, PINS[0])), "2 joints named 'A0'"),
        (dict(bodies=BODIES[1:]), "no body named 'ground'"),
        (dict(joints=(*PINS[:3], Pin("B0", GROUND, "rockr"))), "did you mean 'rocker'?"),
        (dict(joints=(*PINS[:3], Pin("B1", GROUND, "rocker"))), "has no point 'B1'"),
        (dict(joints=(*PINS[:3], Pin("B0", "rocker", "rocker"))), "to itself"),
        (dict(bodies=(*BODIES, Body("spare", {}))), "no joint of mechanism holds body 'spare'"),
        (
            dict(joints=PINS[:3]),
            (
                "under-constrained at coupler, rocker; "
                "2 bodies and the 2 joints A, B have 3·2 - 2·2 = 2 degrees of freedom"
            ),
        ),
        (
            dict(inputs=()),
            (
                "at crank, coupler, rocker; "
                "3 bodies and the 4 joints A0, A, B, B0 have 3·3 - 2·4 = 1 degree of freedom, and 0"
            ),
        ),
        (
            dict(inputs=(*DRIVE, Rotation("rocker", "B0"))),
            "once: the inputs crank, rocker drive 1 degree of freedom; remove 1 of the inputs",
        ),
        (dict(inputs=(*DRIVE, Rotation("ground", "A0"))), "two inputs of mechanism drive joint 'A0'"),
        (dict(inputs=(Rotation("rocker", "A0"),)), "that pin joins ground and crank"),
        (dict(inputs=(Displacement("A0"),)), "a displacement needs a slide"),
        (dict(branches=()), "no branch for the free pin 'B'"),
        (dict(branches=(("B", 0),)), "branch of 'B' in mechanism is 0; +1 or -1"),
        (dict(branches=(("C", 1),)), "has no joint 'C'"),
        (dict(bodies=(*BODIES[:2], Body("coupler", {"A": 1, "B": 1}), BODIES[3])), "link 'coupler' has zero length"),
    ],
)
def test_bad_model_is_refused_in_words(change, said):
    assert said in refused(**change)


def test_point_that_is_not_finite_is_refused():
    with pytest.raises(MechanismError, match="a finite number"):
        Body("crank", {"A": complex("nan")})


@pytest.mark.parametrize("length", [0.0, -0.1, float("nan"), float("inf")])
def test_lengths_must_be_finite_and_above_zero(length):
    with pytest.raises(MechanismError, match="coupler of four-bar"):
        four_bar(0.3, 0.06, length, 0.23, branch=1)
    with pytest.raises(MechanismError, match="rod of slider-crank"):
        slider_crank(0.06, length, branch=1)


def test_slide_with_angles_that_are_not_finite_is_refused():
    for angles in ({"along": float("nan")}, {"turned": float("inf")}, {"along": 90}):
        with pytest.raises(MechanismError, match="a finite number|angles are in radians"):
            Slide("line", "slider", GROUND, **angles)


def test_part_held_too_often_while_another_is_loose_is_named():
    triangle = Body("plate", {"P": 0, "Q": 0.1})
    loose = Body("arm", {"R": 0, "S": 0.1}), Body("hand", {"S": 0})
    bodies = (Body(GROUND, {"A0": 0, "P": 0, "Q": 0.1, "R": 0.2}), Body("crank", {"A0": 0}), triangle, *loose)
    joints = (
        Pin("A0", GROUND, "crank"),
        Pin("P", GROUND, "plate"),
        Pin("Q", GROUND, "plate"),
        Pin("R", GROUND, "arm"),
        Pin("S", "arm", "hand"),
    )
    inputs = (Rotation("crank", "A0"), Rotation("arm", "R"))
    assert "over-constrained at plate" in refused(bodies, joints, inputs, ())


def test_degrees_of_freedom_are_counted_before_inputs():
    assert degrees_of_freedom(four_bar(0.3, 0.06, 0.2, 0.23, branch=1)) == 1


def test_zero_link_of_a_dyad_is_refused_though_the_body_has_other_pins():
    coupler = Body("coupler", {"A": 0, "B": 0, "C": 0.1})
    flag = Body("flag", {"C": 0})
    bodies = (*BODIES[:2], coupler, BODIES[3], flag)
    joints = (*PINS, Pin("C", "coupler", "flag"))
    assert "link 'coupler' of mechanism has zero length: A and B coincide" in refused(
        bodies, joints, (*DRIVE, Rotation("flag", "C"))
    )
