"""The beat-up's figures: the mechanism to scale at its beat, and its curves over a turn of the crank."""

from collections.abc import Mapping

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.dynamics.animation import animated, frames
from ilmek.dynamics.crank_figures import crank_plot, points_at
from ilmek.dynamics.motor_run import MotorRun
from ilmek.linkage.quality import transmission_angle
from ilmek.linkage.solve import solve
from ilmek.machines.beat_up.design import BeatUp
from ilmek.report import Animation, Axis, Dot, Drawing, Figure, Mark, Plot, Reading, Series, Stroke
from ilmek.units import format_quantity, turn

CARPET = 0.35
"""Length of carpet and of warp drawn, over the length of the beater."""

LINKS = ("crank", "coupler", "rocker")


def figures_of(design: BeatUp, running: MotorRun) -> tuple[Figure, ...]:
    """The drawing, the same in motion, seven plots, and the start under the motor."""
    return (drawing(design), moving(design), *curves_over_a_turn(design), *started(running))


def drawing(design: BeatUp) -> Drawing:
    """The mechanism to scale at its beat, the other dead centre dashed, with the paths of crank pin and beater."""
    beat, back = (_pose(design, angle) for angle in (design.beta, design.back_angle))
    D, A = 0j, complex(design.lengths["ground"])
    circle = design.lengths["crank"] * np.exp(1j * np.linspace(0, turn, 121))
    strokes = (
        Stroke(np.array([D, A]), "ground", _labelled(design, "ground")),
        Stroke(circle, "path", closed=True),
        Stroke(design.state.beater.position, "path", "path of the beater"),
        Stroke(np.array([back["C"], back["B"]]), "construction"),
        Stroke(np.array([A, back["E"]]), "construction", "farthest from the fell"),
        *_cloth(design, beat["E"]),
        Stroke(np.array([A, beat["E"]]), "link", _labelled(design, "rocker")),
        Stroke(np.array([beat["C"], beat["B"]]), "link", _labelled(design, "coupler")),
        Stroke(np.array([D, beat["C"]]), "link", _labelled(design, "crank")),
    )
    dots = (
        Dot(D, "D", "pivot"),
        Dot(A, "A", "pivot"),
        Dot(beat["C"], "C"),
        Dot(beat["B"], "B"),
        Dot(beat["E"], "E", "point"),
    )
    reach = format_quantity(design.lengths["beater"], "mm")
    note = f"Side view at the beat: the beater E, {reach} from A, drives weft and knots to the fell."
    return Drawing("beat-up", "Beat-up mechanism to scale", strokes, dots, note=note)


def moving(design: BeatUp) -> Animation:
    """The mechanism over a turn of the crank, from the beat on."""
    at = frames()
    motion = solve(design.plan, at)
    distance = motion.angle("rocker") - np.min(design.state.motion.angle("rocker"))
    readings = (
        Reading("beater from the fell", distance * design.lengths["beater"], "mm"),
        Reading("drive torque", np.interp(at, design.state.angle, design.state.torque), "N*m"),
    )
    return animated(
        motion,
        at,
        Drawing("beat-up-moving", "Beat-up mechanism in motion", _cloth(design, _pose(design, design.beta)["E"])),
        traces=(("rocker", "E"),),
        names={name: _labelled(design, name) for name in LINKS},
        start=design.beta,
        period=design.period,
        readings=readings,
    )


def _pose(design: BeatUp, angle: float) -> dict[str, complex]:
    return points_at(solve(design.plan, np.array([angle])), {"C": "crank", "B": "coupler", "E": "rocker"})


def _cloth(design: BeatUp, fell: complex) -> tuple[Stroke, Stroke, Stroke]:
    """Carpet beyond the fell, warp on the beater's side, and the fell: the warp is tangent to the beater's arc."""
    radius = fell - design.lengths["ground"]
    to_carpet = -1j * radius * CARPET
    edge = 0.06 * radius
    return (
        Stroke(np.array([fell, fell + to_carpet]), "yarn", "carpet"),
        Stroke(np.array([fell, fell - 2 * to_carpet]), "construction", "warp"),
        Stroke(np.array([fell - edge, fell + edge]), "outline", "fell"),
    )


def _labelled(design: BeatUp, name: str) -> str:
    return f"{name} {format_quantity(design.lengths[name], 'mm')}"


def curves_over_a_turn(design: BeatUp) -> tuple[Plot, ...]:
    """Beater along its arc, away from the fell positive; pins, torque, transmission angle and shaking force."""
    state, balance, arm = design.state, design.balance, design.lengths["beater"]
    marks = (Mark(design.beta, "beat"), Mark(design.back_angle, "farthest back"))
    rocker, mu = state.motion.angle("rocker"), transmission_angle(state.motion, "B")

    def plot(name: str, title: str, y: Axis, curves: Mapping[str, FloatArray]) -> Plot:
        return crank_plot(name, title, y, angle=state.angle, curves=curves, marks=marks)

    distance = {"beater": (rocker - np.min(rocker)) * arm}
    velocity = {"beater": state.motion.omega("rocker") * arm}
    acceleration = {"magnitude": np.abs(state.beater.acceleration), "along the arc": state.motion.alpha("rocker") * arm}
    transmission = {"acute angle between coupler and rocker": np.minimum(mu, np.pi - mu)}
    shaking = {"with the counterweight": np.abs(balance.after.force), "without": np.abs(balance.before.force)}
    return (
        plot("beater-travel", "Distance of the beater from the fell", Axis("distance", "mm"), distance),
        plot("beater-velocity", "Velocity of the beater", Axis("velocity", "m/s"), velocity),
        plot("beater-acceleration", "Acceleration of the beater", Axis("acceleration", "m/s^2"), acceleration),
        plot("pin-forces", "Forces in the pins", Axis("force", "N"), state.pins),
        plot("drive-torque", "Torque of the drive on the crank", Axis("torque", "N*m"), {"drive": state.torque}),
        plot("transmission-angle", "Transmission angle", Axis("angle", "deg"), transmission),
        plot("shaking-force", "Shaking force on the frame", Axis("force", "N"), shaking),
    )


def started(running: MotorRun) -> tuple[Plot, ...]:
    """Speed of the crank from rest, under the motor; nothing where the motor is not run."""
    if not running.runs:
        return ()
    begin = [0.0, float(running.runs[0].time[-1])]
    series = tuple(
        Series(label, start + run.time, run.speed)
        for label, start, run in zip(("from rest", "at speed"), begin, running.runs, strict=False)
    )
    axes = Axis("time", "s"), Axis("speed", "rad/s")
    return (Plot("run-speed", "Speed of the crank under its motor", *axes, series),)
