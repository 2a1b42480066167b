"""Mechanisms of many kinds for the tests of what is judged on any of them."""

from dataclasses import replace

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.linkage.fourbar import four_bar, slider_crank
from ilmek.linkage.model import GROUND, Body, Displacement, Mechanism, Pin, Rotation, Slide
from ilmek.linkage.solve import solve
from ilmek.linkage.structure import plan

BEAT_UP = (0.300, 0.0597, 0.2007, 0.2308)


CRANK_ROCKER = """\
inputs = { A = "crank" }
branches = { C = 1 }
[bodies]
ground.points = { A = [0, 0], D = ["300mm", 0] }
crank = { length = "60mm", mass = "0.2kg" }
coupler = { length = "250mm", mass = "0.6kg" }
rocker = { length = "200mm", mass = "0.5kg" }
[joints]
A.pin = ["ground", "crank"]
B.pin = ["crank", "coupler"]
C.pin = ["coupler", "rocker"]
D.pin = ["ground", "rocker"]
"""
"""Text of a file: a crank-rocker with masses; keys of the top stand before it, tables behind it."""


def six_bar_with_moving_guide() -> Mechanism:
    """A crank-rocker whose coupler drives a link and a block on a slanting line of the rocker, set at an angle."""
    ground, crank, coupler, rocker = 1.0, 0.3, 0.9, 0.8
    base = four_bar(ground, crank, coupler, rocker, branch=+1, points={"coupler": {"C": 0.36 + 0.54j}})
    return Mechanism(
        bodies=(
            *base.bodies[:3],
            Body("rocker", {**base.body("rocker").points, "s": 0.24 - 0.16j}),
            Body("link", {"C": 0.1j, "D": 9.0}),
            Body("block", {"D": 0.1 + 0.2j, "s": -0.3j}),
        ),
        joints=(
            *base.joints,
            Slide("s", "block", "rocker", along=0.7, turned=-0.4),
            Pin("C", "coupler", "link"),
            Pin("D", "link", "block"),
        ),
        inputs=base.inputs,
        branches={"B": +1, "D": -1},
        name="six-bar",
    )


def quick_return() -> Mechanism:
    """A crank's block slides in a lever; a slider on the lever is pinned to one on a slanting line of the ground."""
    return Mechanism(
        bodies=(
            Body(GROUND, {"A0": 0, "B": -3, "u": 0.4 + 0.3j}),
            Body("crank", {"A0": 0, "A": 1}),
            Body("block", {"A": 0, "slot": 0}),
            Body("lever", {"B": 0, "slot": 0, "t": 0.1 + 0.2j}),
            Body("on_lever", {"t": 0.2j, "C": 0.1}),
            Body("on_ground", {"u": 0.05j, "C": 0.3}),
        ),
        joints=(
            Pin("A0", GROUND, "crank"),
            Pin("A", "crank", "block"),
            Slide("slot", "block", "lever"),
            Pin("B", GROUND, "lever"),
            Slide("t", "on_lever", "lever", 0.0, 0.4),
            Pin("C", "on_lever", "on_ground"),
            Slide("u", "on_ground", GROUND, 1.2, 0.2),
        ),
        inputs=(Rotation("crank", "A0"),),
        branches={"slot": +1},
        name="quick return",
    )


def two_motors(left: float = 0.4, right: float = 0.3, one: float = 0.9, two: float = 0.8) -> Mechanism:
    """Two cranks, each with its motor, carry a dyad: a five-bar of the given lengths on a ground of 1."""
    return Mechanism(
        bodies=(
            Body(GROUND, {"A0": 0, "B0": 1.0}),
            Body("left", {"A0": 0, "A": left}),
            Body("right", {"B0": 0, "B": right}),
            Body("one", {"A": 0, "C": one}),
            Body("two", {"B": 0, "C": two}),
        ),
        joints=(
            Pin("A0", GROUND, "left"),
            Pin("B0", GROUND, "right"),
            Pin("A", "left", "one"),
            Pin("B", "right", "two"),
            Pin("C", "one", "two"),
        ),
        inputs=(Rotation("left", "A0"), Rotation("right", "B0")),
        branches={"C": +1},
        name="two motors",
    )


def pushed_slider_crank() -> Mechanism:
    """A slider-crank driven by its slider."""
    base = slider_crank(0.1, 0.3, branch=+1, offset=0.02)
    return Mechanism(base.bodies, base.joints, (Displacement("line"),), {"A": +1}, "pump")


def chebychev(branch: int = +1) -> Mechanism:
    """Chebychev's straight line: ground 2, equal crossed arms 2.5, coupler 1 with its tracing point in the middle."""
    points = {"coupler": {"M": 0.5}}
    return four_bar(2.0, 2.5, 1.0, 2.5, branch=branch, points=points, name="Chebychev")


def watt_six_bar() -> Mechanism:
    """A crank-rocker and a second four-bar from a ternary rocker, which the crank drives through it."""
    base = four_bar(1.0, 0.35, 0.9, 0.8, branch=+1, points={"rocker": {"C": 0.7 * np.exp(0.6j)}})
    ground = Body(GROUND, {"A0": 0, "B0": 1.0, "D0": 2.1 - 0.1j})
    return Mechanism(
        bodies=(ground, *base.bodies[1:], Body("link", {"C": 0, "D": 1.3}), Body("out", {"D0": 0, "D": 1.0})),
        joints=(*base.joints, Pin("C", "rocker", "link"), Pin("D", "link", "out"), Pin("D0", GROUND, "out")),
        inputs=base.inputs,
        branches={"B": +1, "D": +1},
        name="Watt",
    )


def triad(crank_pin: complex = 0.2 - 0.8j) -> Mechanism:
    """A plate on three links, two on the ground, one on the crank: class III, without a dyad. Drawn in place."""
    outer, corners = (1j, 3 + 0j, -1.2 - 1j), (0.6 + 1.2j, 2.2 + 0.8j, 1 + 0.1j)
    names = ("left", "right", "low")
    starts = (outer[0], outer[1], crank_pin)
    links = [Body(n, {f"{n}0": s, f"{n}1": c}) for n, s, c in zip(names, starts, corners, strict=True)]
    plate = Body("plate", {f"{n}1": c for n, c in zip(names, corners, strict=True)} | {"P": 1.3 + 1j})
    ground = Body(GROUND, {"left0": outer[0], "right0": outer[1], "A0": 0.1 - 1j})
    crank = Body("crank", {"A0": 0.1 - 1j, "low0": crank_pin})
    joints = [Pin("A0", GROUND, "crank"), Pin("low0", "crank", "low")]
    joints += [Pin(f"{n}0", GROUND, n) for n in ("left", "right")] + [Pin(f"{n}1", n, "plate") for n in names]
    return Mechanism((ground, crank, *links, plate), tuple(joints), (Rotation("crank", "A0"),), name="triad")


def slotted_lever() -> Mechanism:
    """A crank whose block slides along a swinging lever: a slide on a moving guide."""
    return Mechanism(
        bodies=(
            Body(GROUND, {"O": 0, "Q": -0.35j}),
            Body("crank", {"O": 0, "P": 0.1}),
            Body("block", {"P": 0, "slot": 0.02j}),
            Body("lever", {"Q": 0, "slot": 0.02j + 0.01}),
        ),
        joints=(
            Pin("O", GROUND, "crank"),
            Pin("P", "crank", "block"),
            Pin("Q", "lever", GROUND),
            Slide("slot", "block", "lever"),
        ),
        inputs=(Rotation("crank", "O"),),
        pose={"block": (0.1 + 0j, 1.3), "lever": (-0.35j, 1.3)},
    )


def check_newton(mechanism: Mechanism, angle: FloatArray) -> None:
    """Newton's method, started in the pose at the first angle, finds the same motion at a changing speed."""
    speed, acceleration = 2 + np.sin(angle), 3 * np.cos(angle)
    motion = solve(plan(mechanism), angle, speed, acceleration).require()
    pose = {body: (complex(motion.origin(body)[0]), float(motion.angle(body)[0])) for body in mechanism.moving}
    posed = plan(replace(mechanism, pose=pose), closed_forms=False)
    found = solve(posed, angle, speed, acceleration).require()
    for body in mechanism.moving:
        for field in ("position", "direction", "velocity", "acceleration", "omega", "alpha"):
            ours, theirs = (getattr(one[body], field) for one in (motion, found))
            assert np.abs(ours - theirs).max() <= 1e-10 * max(1.0, np.abs(theirs).max()), (body, field)
