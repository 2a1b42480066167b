"""The needle mechanism's figures: to scale where the needle is lowest, and its curves over a turn of the crank."""

from collections.abc import Mapping

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.linkage.quality import transmission_angle
from ilmek.machines.animation import animated, frames
from ilmek.machines.tufting.bars import all_breaks
from ilmek.machines.tufting.design import Tufting, course, shaft
from ilmek.machines.tufting.model import PINS, evaluate, move
from ilmek.report import Animation, Axis, Dot, Drawing, Figure, Mark, Plot, Reading, Series, Stroke
from ilmek.units import format_quantity, turn

BACKING = 0.5
"""Length of backing drawn on each side of the needle, over the needle's distance from the driven shaft."""


def figures(design: Tufting) -> tuple[Figure, ...]:
    """The drawing, the same in motion, and seven plots; an eighth where there are several bars."""
    plots = (angles, height, velocity, acceleration, torques, pins, transmission)
    several = (shaft_torque(design),) if design.params.bars > 1 else ()
    return (drawing(design), moving(design), *(plot(design) for plot in plots), *several)


def drawing(design: Tufting) -> Drawing:
    """The mechanism to scale where the needle is lowest, the highest place dashed."""
    params = design.params
    low, high = (_pose(design, angle) for angle in (design.lowest, design.highest))
    C = complex(params.shaft_distance, params.shaft_height)
    circle = params.crank * np.exp(1j * np.linspace(0, turn, 121))
    above = max(abs(params.needle_distance), params.arm) * 0.35
    strokes = (
        Stroke(np.array([0j, C]), "ground"),
        Stroke(circle, "path", closed=True),
        Stroke(np.array([low["E"], high["E"] + 1j * above]), "construction", "needle's line"),
        *(Stroke(np.array([high[start], high[end]]), "construction") for start, end in ("AB", "BC", "CD", "DE")),
        *_backing(design, low["F"]),
        Stroke(np.array([low["E"], low["F"]]), "outline", "needle bar"),
        Stroke(np.array([low["D"], low["E"]]), "link", _labelled(design, "rod")),
        Stroke(np.array([C, low["D"]]), "link", _labelled(design, "arm")),
        Stroke(np.array([C, low["B"]]), "link", _labelled(design, "rocker")),
        Stroke(np.array([low["A"], low["B"]]), "link", _labelled(design, "coupler")),
        Stroke(np.array([0j, low["A"]]), "link", _labelled(design, "crank")),
    )
    dots = (
        Dot(0j, "O", "pivot"),
        Dot(C, "C", "pivot"),
        *(Dot(low[name], name) for name in "ABDE"),
        Dot(low["F"], "F", "point"),
    )
    note = f"Side view, needle lowest at {format_quantity(design.lowest, 'deg')} of the crank; highest dashed."
    return Drawing("tufting", "Needle mechanism to scale", strokes, dots, note=note)


def moving(design: Tufting) -> Animation:
    """The mechanism over a turn of the crank, from the needle's highest place on."""
    at = frames()
    state = evaluate(design.params, design.plan, at)
    low = _pose(design, design.lowest)
    names = {name: _labelled(design, name) for name in ("crank", "coupler", "rocker", "arm", "rod")}
    readings = (
        Reading("needle above its lowest place", state.height - np.min(design.state.height), "mm"),
        Reading("main shaft", state.main_torque, "N*m"),
    )
    return animated(
        state.motion,
        at,
        Drawing("tufting-moving", "Needle mechanism in motion", _backing(design, low["F"])),
        traces=(("needle", "F"),),
        names=names,
        start=design.highest,
        period=turn / design.params.speed,
        readings=readings,
    )


def _pose(design: Tufting, angle: float) -> dict[str, complex]:
    motion = move(design.params, design.plan, np.array([angle]))
    places = (("crank", "A"), ("coupler", "B"), ("rocker", "C"), ("arm", "D"), ("rod", "E"), ("needle", "F"))
    return {point: complex(np.ravel(motion.point(body, point).position)[0]) for body, point in places}


def _backing(design: Tufting, lowest: complex) -> tuple[Stroke, ...]:
    """The backing where the needle's point enters it, if it does."""
    if design.params.friction != "window":
        return ()
    level = lowest + 1j * design.height(design.params.entry)
    reach = BACKING * max(abs(design.params.needle_distance), design.params.arm)
    return (Stroke(np.array([level - reach, level + reach]), "yarn", "backing"),)


def _labelled(design: Tufting, name: str) -> str:
    return f"{name} {format_quantity(getattr(design.params, name), 'mm')}"


def angles(design: Tufting) -> Plot:
    """Angles of coupler, rocker and rod, each from the middle of its range; the arm turns with the rocker."""
    curves = {}
    for name, body in (("theta2", "coupler"), ("theta3", "rocker"), ("theta5", "rod")):
        middle = sum(design.ranges[name]) / 2
        off = np.angle(design.state.motion.direction(body) * np.exp(-1j * middle))
        said = "rocker and arm, rocker" if body == "rocker" else body
        curves[f"{said} from {format_quantity(middle, 'deg')}"] = off
    return _plot(design, "tufting-angles", "Angles of the links", Axis("angle from mid-range", "deg"), curves)


def height(design: Tufting) -> Plot:
    """Height of the needle's point above its lowest place."""
    above = design.state.height - np.min(design.state.height)
    return _plot(design, "needle-height", "Needle above its lowest place", Axis("height", "mm"), {"needle": above})


def velocity(design: Tufting) -> Plot:
    """Velocity of the needle, downward positive as in the paper."""
    curves = {"needle, downward": design.state.velocity}
    return _plot(design, "needle-velocity", "Velocity of the needle", Axis("velocity", "m/s"), curves)


def acceleration(design: Tufting) -> Plot:
    """Acceleration of the needle, downward positive as in the paper."""
    curves = {"needle, downward": design.state.acceleration}
    return _plot(design, "needle-acceleration", "Acceleration of the needle", Axis("acceleration", "m/s^2"), curves)


def torques(design: Tufting) -> Plot:
    """Torques of main and driven shaft."""
    curves = {"driven shaft": design.state.driven_torque, "main shaft": design.state.main_torque}
    return _plot(design, "shaft-torques", "Torques of the shafts", Axis("torque", "N*m"), curves)


def pins(design: Tufting) -> Plot:
    """Sizes of the forces in pins and guide."""
    curves = {name: np.abs(design.state.joints[name]) for name in (*PINS, "guide")}
    return _plot(design, "tufting-pin-forces", "Forces in pins and guide", Axis("force", "N"), curves)


def transmission(design: Tufting) -> Plot:
    """Acute angle between coupler and rocker, and the rod's angle to the needle's line."""
    mu = transmission_angle(design.state.motion, "B")
    rod = design.state.motion.direction("rod")
    curves = {
        "between coupler and rocker, acute": np.minimum(mu, np.pi - mu),
        "rod to the needle's line": np.arctan2(np.abs(np.real(rod)), -np.imag(rod)),
    }
    return _plot(design, "tufting-transmission", "Transmission angles", Axis("angle", "deg"), curves)


def shaft_torque(design: Tufting) -> Plot:
    """Torque of all bars on the main shaft, against that of the first."""
    params = design.params
    angle, side = course(tuple(sorted(at % turn for at in all_breaks(design.breaks, params.bars, params.phase))))
    total, _ = shaft(params, design.plan, angle, side)
    series = (
        Series(f"all {params.bars} bars", angle, total),
        Series("the first bar", design.state.angle, design.state.main_torque, dashed=True),
    )
    x, y = Axis("crank angle", "deg"), Axis("torque", "N*m")
    return Plot("total-torque", "Torque of all bars on the main shaft", x, y, series)


def _plot(design: Tufting, name: str, title: str, y: Axis, curves: Mapping[str, FloatArray]) -> Plot:
    series = tuple(
        Series(said, design.state.angle, values, dashed=place > 0 and len(curves) == 2)
        for place, (said, values) in enumerate(curves.items())
    )
    marks = [Mark(design.lowest, "lowest"), Mark(design.highest, "highest")]
    if design.params.friction == "window":
        marks += [Mark(design.params.entry % turn, "entry"), Mark(design.params.exit % turn, "exit")]
    return Plot(name, title, Axis("crank angle", "deg"), y, series, tuple(marks))
