"""Figures of a tufting machine: needle and looper over a turn, the side view, the loop from the front, torsion."""

from dataclasses import replace

import numpy as np

from ilmek.arrays import ComplexArray, FloatArray
from ilmek.dynamics.animation import animated, frames
from ilmek.dynamics.crank_figures import CRANK, crank_plot
from ilmek.machines.tufting.model import evaluate
from ilmek.machines.tufting_machine.design import TuftingMachine
from ilmek.machines.tufting_machine.rocker_drive import TIP
from ilmek.machines.tufting_machine.rocker_forces import RockerForces
from ilmek.machines.tufting_machine.shafts import SAMPLES
from ilmek.report import Animation, Axis, Drawing, Figure, Mark, MovingStroke, Plot, Reading, Series, Stroke
from ilmek.units import mm, turn

BACKING_DRAWN = 120 * mm
"""Backing drawn on each side of the needles [m]."""


def figures(machine: TuftingMachine) -> tuple[Figure, ...]:
    """The side view in motion, timing of needle and hook, bulge of the yarn, the loop when the hook enters, torsion."""
    drawn = moving, timing, bulge, loop_drawing, backing_force, torques, twist
    return tuple(draw(machine) for draw in drawn)


def moving(machine: TuftingMachine) -> Animation:
    """Needle drive and looper drive from the side, over a turn."""
    angle = frames()
    needle = evaluate(machine.needle.params, machine.needle.plan, angle, bodies=machine.needle.bodies)
    moves = machine.looper_forces.moves
    motion = moves.moved(angle, machine.params.needle.speed)
    tip, shaft = (motion.point(moves.drive.bodies[2], name).position for name in (TIP, "P"))
    hook = np.stack([shaft, tip - machine.looper.sense * 25 * mm, tip], 1)
    height = needle.height + machine.params.needle.shaft_height - machine.lowest
    readings = (
        Reading("needle over its lowest position", height, "mm"),
        Reading("hook past the needle's line", machine.looper.ahead(angle), "mm"),
    )
    whole = animated(
        needle.motion,
        angle,
        Drawing("tufting-machine-moving", "Needle and looper in motion", (_backing(machine),), unit="mm"),
        traces=(("needle", "F"),),
        start=machine.needle.highest,
        period=turn / machine.params.needle.speed,
        readings=readings,
    )
    below = [_drive_below(forces, angle, machine.params.needle.speed) for forces in machine.below]
    still = replace(
        whole.still,
        strokes=(*whole.still.strokes, *(stroke for one in below for stroke in one.still.strokes)),
        dots=(*whole.still.dots, *(dot for one in below for dot in one.still.dots)),
    )
    strokes = (
        *whole.strokes,
        *(stroke for one in below for stroke in one.strokes),
        MovingStroke(hook, "outline", "looper"),
    )
    return replace(whole, still=still, strokes=strokes, dots=(*whole.dots, *(dot for one in below for dot in one.dots)))


def _drive_below(forces: RockerForces, angle: FloatArray, speed: float) -> Animation:
    """A drive of loopers or knives in motion."""
    drive = forces.moves.drive
    drawing = Drawing(f"tufting-{drive.name}", "", (), unit="mm")
    names = {drive.bodies[2]: f"{drive.name} shaft", "A": "A'", "B": "B'"}
    return animated(forces.moves.moved(angle, speed), angle, drawing, names=names)


def _backing(machine: TuftingMachine) -> Stroke:
    needle, geometry = machine.params.needle, machine.loop.geometry
    at = needle.shaft_distance + needle.needle_distance + 1j * (machine.lowest + geometry.level)
    return Stroke(np.array([at - BACKING_DRAWN, at + BACKING_DRAWN]), "yarn", "backing")


def timing(machine: TuftingMachine) -> Plot:
    """Needle's point and eye, and the hook, over a turn of the main shaft."""
    loop, geometry = machine.loop, machine.loop.geometry
    angle = np.linspace(0.0, turn, SAMPLES + 1)
    curves = {
        "needle's point": geometry.path.rise(angle),
        "eye of the needle": geometry.eye(angle),
        "backing": np.full(angle.size, geometry.level),
        "hook's upper edge": np.full(angle.size, geometry.hook),
        "hook past the needle's line": machine.looper.ahead(angle),
        **({"knife over the hook's under edge": machine.knife.over} if machine.knife else {}),
    }
    marks = (
        Mark(loop.window.opened, "loop open"),
        Mark(loop.catch, "hook enters"),
        Mark(loop.window.shut, "loop shut"),
        Mark(loop.window.out, "needle out"),
        Mark(loop.release % turn, "hook leaves"),
    )
    axis = Axis("over the lowest point, or past the line", "mm")
    return crank_plot("tufting-machine-timing-curve", "Needle and hook", axis, angle=angle, curves=curves, marks=marks)


def bulge(machine: TuftingMachine) -> Plot:
    """Distance of the yarn from the needle at the hook, against what the hook needs."""
    geometry, window = machine.loop.geometry, machine.loop.window
    angle = np.linspace(geometry.path.lowest, window.shut + (window.shut - geometry.path.lowest) / 2, 181)
    series = (
        Series("yarn from the needle", angle, geometry.bulge(angle)),
        Series("needed by the hook", angle, np.full(angle.size, geometry.slot), dashed=True),
    )
    marks = (Mark(window.opened, "open"), Mark(machine.loop.catch, "hook enters"), Mark(window.shut, "shut"))
    return Plot("tufting-loop-bulge", "Bulge of the yarn at the hook", CRANK, Axis("distance", "mm"), series, marks)


def loop_drawing(machine: TuftingMachine) -> Drawing:
    """The loop along the cloth when the hook enters: needle, yarn on both sides, hook in section."""
    geometry, looper = machine.loop.geometry, machine.params.looper
    catch = np.array([machine.loop.catch])
    eye, point = float(geometry.eye(catch)[0]), float(geometry.path.rise(catch)[0])
    share = np.linspace(0.0, 1.0, 61)
    top = float(geometry.bulge(catch)[0]) / np.sin(np.pi * (geometry.under - geometry.middle) / (geometry.under - eye))
    leg = top * np.sin(np.pi * share) + 1j * (eye + share * (geometry.under - eye)) + geometry.yarn / 2
    far, wide = -looper.needle - geometry.yarn / 2, 3 * machine.params.gauge
    groove = far + 1j * np.array([eye, geometry.level + 5 * mm])
    needle = np.array([0.0, -looper.needle]) + 0j
    outline = np.array([needle[0] + 1j * (geometry.level + 5 * mm), 1j * eye, -looper.needle / 2 + 1j * point])
    other = np.array([needle[1] + 1j * (geometry.level + 5 * mm), needle[1] + 1j * eye, outline[2]])
    corner = looper.gap + 1j * (geometry.hook - looper.height)
    strokes = (
        Stroke(outline, "outline", "needle"),
        Stroke(other, "outline"),
        Stroke(leg, "yarn", "yarn of the loop"),
        Stroke(np.array([leg[-1], geometry.yarn / 2 + 1j * geometry.level]), "yarn"),
        Stroke(groove, "yarn", "yarn in the needle's groove"),
        Stroke(_box(corner, looper.thickness, looper.height), "outline", "hook", closed=True),
        Stroke(np.array([-wide, wide]) + 1j * geometry.level, "construction", "backing"),
        Stroke(np.array([-wide, wide]) + 1j * geometry.under, "construction"),
    )
    note = "Seen along the backing's travel; the hook passes between needle and yarn."
    return Drawing("tufting-loop", "The loop when the hook enters", strokes, unit="mm", note=note)


def _box(corner: complex, width: float, height: float) -> ComplexArray:
    return corner + np.array([0, width, width + 1j * height, 1j * height])


def backing_force(machine: TuftingMachine) -> Plot:
    """Force of the backing on a needle over its depth, down and up."""
    given, depth = machine.needle.params.penetration, np.linspace(0.0, machine.loop.depth, 121)
    force = {
        name: given.force(depth, down=np.full(depth.size, name == "down")) / given.needles for name in ("down", "up")
    }
    series = tuple(Series(name, depth, values) for name, values in force.items())
    return Plot(
        "tufting-backing-force", "Force of the backing on a needle", Axis("depth", "mm"), Axis("force", "N"), series
    )


def torques(machine: TuftingMachine) -> Plot:
    """Torque of all drives together, of a needle drive and of a looper drive over a turn."""
    angle, state = np.arange(SAMPLES + 1) * (turn / SAMPLES), machine.needle.state
    series = (
        Series("all drives", angle, np.append(machine.shafts.torque, machine.shafts.torque[0])),
        Series("a needle drive", state.angle, state.main_torque),
        *(Series(f"a {each.moves.drive.name} drive", each.moves.angle, each.torque) for each in machine.below),
    )
    return Plot("tufting-machine-torques", "Torques of the drives", CRANK, Axis("torque", "N*m"), series)


def twist(machine: TuftingMachine) -> Plot:
    """Twist of the main shaft at its first, middle and last drive over a turn."""
    late, angle = machine.shafts.main, np.arange(SAMPLES) * (turn / SAMPLES)
    chosen = dict.fromkeys((0, len(late) // 2, len(late) - 1))
    series = tuple(Series(f"drive {drive + 1}", angle, late[drive]) for drive in chosen)
    return Plot("tufting-shaft-twist", "Twist of the main shaft against its motor", CRANK, Axis("twist", "deg"), series)
