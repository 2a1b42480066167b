"""The beat-up's figures: the mechanism to scale at its beat, and its curves over a turn of the crank."""

from collections.abc import Mapping

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.linkage.quality import transmission_angle
from ilmek.linkage.solve import solve
from ilmek.machines.animation import animated, frames
from ilmek.machines.beat_up.design import BeatUp
from ilmek.machines.beat_up.running import MotorRun
from ilmek.machines.beat_up.shaking import size
from ilmek.report import Animation, Axis, Dot, Drawing, Figure, Mark, Plot, Reading, Series, Stroke
from ilmek.units import format_quantity, turn

CARPET = 0.35
"""Length of carpet and of warp drawn, over the length of the beater."""


def figures_of(design: BeatUp, running: MotorRun) -> tuple[Figure, ...]:
    """The drawing, the same in motion, seven plots, and the start under the motor."""
    return (
        drawing(design),
        moving(design),
        *(plot(design) for plot in (travel, velocity, acceleration, pins, torque, transmission, shaken)),
        *started(running),
    )


def drawing(design: BeatUp) -> Drawing:
    """The mechanism to scale at its beat, the other dead centre dashed, with the paths of crank pin and beater."""
    beat, back = (_pose(design, angle) for angle in (design.beta, design.back_angle))
    crank, coupler, rocker = (_labelled(design, name) for name in ("crank", "coupler", "rocker"))
    D, A = 0j, complex(design.lengths["ground"])
    circle = design.lengths["crank"] * np.exp(1j * np.linspace(0, turn, 121))
    strokes = (
        Stroke(np.array([D, A]), "ground", _labelled(design, "ground")),
        Stroke(circle, "path", closed=True),
        Stroke(design.state.beater.position, "path", "path of the beater"),
        Stroke(np.array([back["C"], back["B"]]), "construction"),
        Stroke(np.array([A, back["E"]]), "construction", "farthest from the fell"),
        *_cloth(design, beat["E"]),
        Stroke(np.array([A, beat["E"]]), "link", rocker),
        Stroke(np.array([beat["C"], beat["B"]]), "link", coupler),
        Stroke(np.array([D, beat["C"]]), "link", crank),
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
    names = {name: _labelled(design, name) for name in ("crank", "coupler", "rocker")}
    distance = motion.angle("rocker") - np.min(design.state.motion.angle("rocker"))
    readings = (
        Reading("beater from the fell", distance * design.lengths["beater"], "mm"),
        Reading("drive torque", np.interp(at, design.state.angle, design.state.torque), "N*m"),
    )
    drawing = Drawing("beat-up-moving", "Beat-up mechanism in motion", _cloth(design, _pose(design, design.beta)["E"]))
    return animated(
        motion,
        at,
        drawing,
        traces=(("rocker", "E"),),
        names=names,
        start=design.beta,
        period=turn / design.params.speed,
        readings=readings,
    )


def _pose(design: BeatUp, angle: float) -> dict[str, complex]:
    motion = solve(design.plan, np.array([angle]))
    places = (("crank", "C"), ("coupler", "B"), ("rocker", "E"))
    return {point: complex(np.ravel(motion.point(body, point).position)[0]) for body, point in places}


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


def travel(design: BeatUp) -> Plot:
    """Distance of the beater from the fell, along its arc."""
    turned = design.state.motion.angle("rocker")
    distance = (turned - np.min(turned)) * design.lengths["beater"]
    return _plot(
        design, "beater-travel", "Distance of the beater from the fell", Axis("distance", "mm"), {"beater": distance}
    )


def velocity(design: BeatUp) -> Plot:
    """Velocity of the beater along its arc, away from the fell positive."""
    speed = design.state.motion.omega("rocker") * design.lengths["beater"]
    return _plot(
        design,
        "beater-velocity",
        "Velocity of the beater",
        Axis("velocity", "m/s"),
        {"beater": speed},
    )


def acceleration(design: BeatUp) -> Plot:
    """Acceleration of the beater: its size, and the part along its arc."""
    along = design.state.motion.alpha("rocker") * design.lengths["beater"]
    curves = {"size": np.abs(design.state.beater.acceleration), "along the arc": along}
    return _plot(design, "beater-acceleration", "Acceleration of the beater", Axis("acceleration", "m/s^2"), curves)


def pins(design: BeatUp) -> Plot:
    """Sizes of the forces in the four pins."""
    return _plot(design, "pin-forces", "Forces in the pins", Axis("force", "N"), design.state.pins)


def torque(design: BeatUp) -> Plot:
    """Torque of the drive on the crank."""
    curves = {"drive": design.state.torque}
    return _plot(design, "drive-torque", "Torque of the drive on the crank", Axis("torque", "N*m"), curves)


def shaken(design: BeatUp) -> Plot:
    """Size of the shaking force without the counterweight on the crank and with it."""
    balance = design.balance
    curves = {"with the counterweight": size(balance.after), "without": size(balance.before)}
    return _plot(design, "shaking-force", "Shaking force on the frame", Axis("force", "N"), curves)


def started(running: MotorRun) -> tuple[Plot, ...]:
    """Speed of the crank from rest, under the motor; nothing where the motor is not run."""
    runs = [run for run in (running.start, running.steady) if run is not None]
    if not runs:
        return ()
    begin = [0.0, float(runs[0].time[-1])]
    series = tuple(
        Series(said, start + run.time, run.speed)
        for said, start, run in zip(("from rest", "at speed"), begin, runs, strict=False)
    )
    title = "Speed of the crank under its motor"
    return (Plot("run-speed", title, Axis("time", "s"), Axis("speed", "rad/s"), series),)


def transmission(design: BeatUp) -> Plot:
    """Acute angle between coupler and rocker."""
    angle = transmission_angle(design.state.motion, "B")
    curves = {"acute angle between coupler and rocker": np.minimum(angle, np.pi - angle)}
    return _plot(design, "transmission-angle", "Transmission angle", Axis("angle", "deg"), curves)


def _plot(design: BeatUp, name: str, title: str, y: Axis, curves: Mapping[str, FloatArray]) -> Plot:
    series = tuple(
        Series(said, design.state.angle, values, dashed=place > 0 and len(curves) == 2)
        for place, (said, values) in enumerate(curves.items())
    )
    marks = (Mark(design.beta, "beat"), Mark(design.back_angle, "farthest back"))
    return Plot(name, title, Axis("crank angle", "deg"), y, series, marks)
