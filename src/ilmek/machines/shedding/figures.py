"""The shedding cams' figures: motion of both parities, the cam to scale, pressure angle, curvature, torque, shaft."""

from dataclasses import replace

import numpy as np

from ilmek.cams import figures as cam_figures
from ilmek.cams.limits import convex_radius_min, pressure_angle_max
from ilmek.cams.programme import TURN, jumps
from ilmek.elements.beam import uniform
from ilmek.elements.figures import deflection_plot
from ilmek.machines.shedding.alternatives import SheddingAlternatives
from ilmek.machines.shedding.design import SheddingDesign
from ilmek.machines.shedding.draped import stack_torque
from ilmek.machines.shedding.warp import shed_warp
from ilmek.report import Axis, Drawing, Figure, Mark, Plot, Series
from ilmek.units import format_quantity


def figures(studied: SheddingAlternatives) -> tuple[Figure, ...]:
    """The cam to scale and the plots, in the order of the report."""
    design = studied.design
    cam, shaft = design.cam, design.shaft
    drawn: tuple[Drawing | Plot, ...] = (
        cam_figures.cam_drawing(cam, shaft.bar, design.stack.guide_radius),
        *cam_figures.motion_plots(
            {"even": design.even, "odd": design.odd}, design.params.speed, shuttle_marks(design), jump_note(design)
        ),
        cam_figures.pressure_plot(cam, design.params.pressure_angle_limit, pressure_angle_max(cam).at),
        cam_figures.curvature_plot(cam, convex_radius_min(cam).at),
        torque_plot(design),
        stagger_plot(studied),
        *tension_plots(studied),
        deflection_plot(
            shaft.load,
            shaft.span,
            design.params.modulus,
            float(uniform.square_inertia(shaft.bar)),
            design.params.deflection_limit,
        ),
    )
    return tuple(replace(figure, name=f"shedding-{figure.name}") for figure in drawn)


def torque_plot(design: SheddingDesign) -> Plot:
    """Torque of the warps on the shaft over the turn, and its rms."""
    angle = cam_figures.sample_angles(design.even, design.odd)
    rms = design.drive.torque_rms
    series = (
        Series("torque", angle, design.torque(angle)),
        Series("root mean square", np.array([0.0, TURN]), np.full(2, rms), dashed=True),
    )
    mark = Mark(design.drive.torque_max.at, format_quantity(design.drive.torque_max.value, "Nm"))
    note = "positive: the shaft lifts the warps; negative: the warps press the shaft on"
    title = "Torque of the warps on the shaft"
    return Plot("torque", title, Axis("cam angle", "deg"), Axis("torque", "Nm"), series, (mark,), note)


def stagger_plot(studied: SheddingAlternatives) -> Plot:
    """Torque of cams all at once beside that of the flattest phases, or of those taken."""
    design = studied.design
    other = design.shed if design.params.phase == "staggered" else studied.flattest
    angle = cam_figures.sample_angles(*other.even.programmes, *other.odd.programmes, design.even)
    spread = format_quantity(other.spread, "deg")
    name = f"{other.groups} groups over {spread}" if other.groups > 1 else "nothing is flatter"
    series = (
        Series("all at once", angle, studied.together.torque(angle)),
        Series(name, angle, other.torque(angle), dashed=True),
    )
    first, last = other.window()
    note = f"the shed is open enough for {format_quantity(last - first, 'deg')} with {name}"
    title = "Torque of cams all at once and one after another"
    return Plot("stagger", title, Axis("cam angle", "deg"), Axis("torque", "Nm"), series, note=note)


def tension_plots(studied: SheddingAlternatives) -> tuple[Plot, ...]:
    """Tension of a warp over the turn, and the torque of warps draped over the cams; nothing without a tension."""
    design, yarn = studied.design, studied.yarn
    warp = shed_warp(design.params)
    if warp is None:
        return ()
    angle = cam_figures.sample_angles(design.even, design.odd)
    knife = (
        Series("even", angle, warp.tension_at(design.even.at(angle).s)),
        Series("odd", angle, warp.tension_at(design.odd.at(angle).s), dashed=True),
    )
    tension = Plot("tension", "Tension of a warp", Axis("cam angle", "deg"), Axis("tension", "N"), knife)
    if yarn is None:
        return (tension,)
    torques = (
        Series("knife edge", angle, design.torque(angle)),
        Series("draped over the cam", yarn.angle, stack_torque(design.shed, yarn), dashed=True),
    )
    note = "a warp lies on the whole nose, and is lifted where it stands beside the follower's line too"
    title = "Torque by a knife edge on the cam and by the yarn draped over it"
    return tension, Plot("draped", title, Axis("cam angle", "deg"), Axis("torque", "Nm"), torques, note=note)


def shuttle_marks(design: SheddingDesign) -> tuple[Mark, ...]:
    """When the shuttle may enter and must have left the even shed; none where the shed is too low for it."""
    first, last = design.shuttle_window
    return (Mark(first, "shuttle in"), Mark(last, "shuttle out")) if last > first else ()


def jump_note(design: SheddingDesign) -> str:
    """Where the acceleration of the even warps jumps, in words."""
    found = jumps(design.even)
    said = ", ".join(f"{jump.place} at {format_quantity(jump.angle, 'deg')}" for jump in found)
    return f"even warps: the acceleration jumps {said}" if said else "the acceleration has no jump"
