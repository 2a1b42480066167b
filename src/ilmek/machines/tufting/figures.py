"""The needle mechanism's figures: to scale where the needle is lowest, and its curves over a turn of the crank."""

from collections.abc import Mapping

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.dynamics.animation import animated, frames
from ilmek.dynamics.crank_figures import CRANK, crank_plot, points_at
from ilmek.linkage.quality import transmission_angle
from ilmek.machines.tufting.design import JOINTS, Tufting, pressure_angle
from ilmek.machines.tufting.model import evaluate, move
from ilmek.report import Animation, Axis, Dot, Drawing, Figure, Mark, Plot, Reading, Series, Stroke
from ilmek.units import format_quantity, turn

BACKING = 0.5
"""Length of backing drawn on each side of the needle, over the needle's distance from the driven shaft."""

POINTS = {"A": "crank", "B": "coupler", "C": "rocker", "D": "arm", "E": "rod", "F": "needle"}


def figures(design: Tufting) -> tuple[Figure, ...]:
    """The drawing, the same in motion, and seven plots; an eighth where there are several bars."""
    several = (shaft_torque(design),) if design.params.bars > 1 else ()
    return (drawing(design), moving(design), *curves_over_a_turn(design), *several)


def drawing(design: Tufting) -> Drawing:
    """The mechanism to scale where the needle is lowest, the highest position dashed."""
    params = design.params
    low, high = (_pose(design, angle) for angle in (design.lowest, design.highest))
    C = complex(params.shaft_distance, params.shaft_height)
    circle = params.crank * np.exp(1j * np.linspace(0, turn, 121))
    above = max(abs(params.needle_distance), params.arm) * 0.35
    links = {"rod": "DE", "arm": "CD", "rocker": "CB", "coupler": "AB", "crank": "OA"}
    low = {**low, "O": 0j, "C": C}
    strokes = (
        Stroke(np.array([0j, C]), "ground"),
        Stroke(circle, "path", closed=True),
        Stroke(np.array([low["E"], high["E"] + 1j * above]), "construction", "needle's line"),
        *(Stroke(np.array([high[start], high[end]]), "construction") for start, end in ("AB", "BC", "CD", "DE")),
        *_backing(design, low["F"]),
        Stroke(np.array([low["E"], low["F"]]), "outline", "needle bar"),
        *(
            Stroke(np.array([low[end] for end in ends]), "link", _labelled(design, name))
            for name, ends in links.items()
        ),
    )
    dots = (
        *(Dot(low[name], name, "pivot") for name in "OC"),
        *(Dot(low[name], name) for name in "ABDE"),
        Dot(low["F"], "F", "point"),
    )
    note = f"Side view, needle lowest at {format_quantity(design.lowest, 'deg')} of the crank; highest dashed."
    return Drawing("tufting", "Needle mechanism to scale", strokes, dots, note=note)


def moving(design: Tufting) -> Animation:
    """The mechanism over a turn of the crank, from the needle's highest position on."""
    at = frames()
    state = evaluate(design.params, design.plan, at, bodies=design.bodies)
    backing = _backing(design, _pose(design, design.lowest)["F"])
    readings = (
        Reading("needle above its lowest position", state.height - np.min(design.state.height), "mm"),
        Reading("main shaft", state.main_torque, "N*m"),
    )
    return animated(
        state.motion,
        at,
        Drawing("tufting-moving", "Needle mechanism in motion", backing),
        traces=(("needle", "F"),),
        names={name: _labelled(design, name) for name in ("crank", "coupler", "rocker", "arm", "rod")},
        start=design.highest,
        period=turn / design.params.speed,
        readings=readings,
    )


def _pose(design: Tufting, angle: float) -> dict[str, complex]:
    return points_at(move(design.params, design.plan, np.array([angle])), POINTS)


def _backing(design: Tufting, lowest: complex) -> tuple[Stroke, ...]:
    """The backing where the needle's point enters it, if it does."""
    if design.params.friction == "always":
        return ()
    level = lowest + 1j * design.entry_height
    reach = BACKING * max(abs(design.params.needle_distance), design.params.arm)
    return (Stroke(np.array([level - reach, level + reach]), "yarn", "backing"),)


def _labelled(design: Tufting, name: str) -> str:
    return f"{name} {format_quantity(getattr(design.params, name), 'mm')}"


def curves_over_a_turn(design: Tufting) -> tuple[Plot, ...]:
    """Angles, needle, torques, forces and transmission over a turn of the crank."""
    state = design.state
    mu = transmission_angle(state.motion, "B")
    marks = [Mark(design.lowest, "lowest"), Mark(design.highest, "highest")]
    if design.params.friction != "always":
        marks += [Mark(design.params.entry % turn, "entry"), Mark(design.params.exit % turn, "exit")]

    def plot(name: str, title: str, y: Axis, curves: Mapping[str, FloatArray]) -> Plot:
        return crank_plot(name, title, y, angle=state.angle, curves=curves, marks=tuple(marks))

    height = {"needle": state.height - np.min(state.height)}
    velocity, acceleration = {"needle, downward": state.velocity}, {"needle, downward": state.acceleration}
    torques = {"driven shaft": state.driven_torque, "main shaft": state.main_torque}
    forces = {name: np.abs(state.joints[name]) for name in JOINTS}
    transmission = {
        "between coupler and rocker, acute": np.minimum(mu, np.pi - mu),
        "rod to the needle's line": pressure_angle(state.motion),
    }
    return (
        plot("tufting-angles", "Angles of the links", Axis("angle from mid-range", "deg"), _angles(design)),
        plot("needle-height", "Needle above its lowest position", Axis("height", "mm"), height),
        plot("needle-velocity", "Velocity of the needle", Axis("velocity", "m/s"), velocity),
        plot("needle-acceleration", "Acceleration of the needle", Axis("acceleration", "m/s^2"), acceleration),
        plot("shaft-torques", "Torques of the shafts", Axis("torque", "N*m"), torques),
        plot("tufting-pin-forces", "Forces in pins and guide", Axis("force", "N"), forces),
        plot("tufting-transmission", "Transmission angles", Axis("angle", "deg"), transmission),
    )


def _angles(design: Tufting) -> dict[str, FloatArray]:
    """Angles of coupler, rocker and rod, each from the middle of its range; the arm turns with the rocker."""
    curves = {}
    for name, body in (("theta2", "coupler"), ("theta3", "rocker"), ("theta5", "rod")):
        middle = sum(design.ranges[name]) / 2
        label = "rocker and arm, rocker" if body == "rocker" else body
        off = np.angle(design.state.motion.direction(body) * np.exp(-1j * middle))
        curves[f"{label} from {format_quantity(middle, 'deg')}"] = off
    return curves


def shaft_torque(design: Tufting) -> Plot:
    """Torque of all bars on the main shaft, against that of the first."""
    series = (
        Series(f"all {design.params.bars} bars", *design.shaft_torque()),
        Series("the first bar", design.state.angle, design.state.main_torque, dashed=True),
    )
    return Plot("total-torque", "Torque of all bars on the main shaft", CRANK, Axis("torque", "N*m"), series)
