"""The shedding cams' figures: motion of both parities, the cam to scale, pressure angle, curvature, torque, shaft."""

from dataclasses import replace

from ilmek.cams import figures as cam_figures
from ilmek.cams.limits import convex_radius_min
from ilmek.elements.beam import uniform
from ilmek.elements.figures import deflection_plot
from ilmek.machines.shedding.analysis import SheddingAnalysis
from ilmek.machines.shedding.animation import moving
from ilmek.machines.shedding.design import SheddingDesign
from ilmek.machines.shedding.shed_figures import side_view, stack_section
from ilmek.report import Animation, Axis, Drawing, Figure, Mark, Plot, Series
from ilmek.units import format_quantity

ANGLE, TORQUE = Axis("cam angle", "deg"), Axis("torque", "Nm")


def figures(analysis: SheddingAnalysis) -> tuple[Figure, ...]:
    """The cam to scale and the plots, in the order of the report."""
    design = analysis.design
    cam, shaft, params = design.cam, design.shaft, design.params
    programmes = {"even": design.even, "odd": design.odd}
    inertia = float(uniform.square_inertia(shaft.bar))
    drawn: tuple[Animation | Drawing | Plot, ...] = (
        cam_figures.cam_drawing(cam, shaft.bar, design.stack.guide_radius),
        *side_view(design),
        moving(design),
        stack_section(design),
        *cam_figures.motion_plots(
            programmes, params.speed, _shuttle_marks(design), cam_figures.jump_note(design.even, "even warps: ")
        ),
        cam_figures.pressure_plot(cam, params.pressure_angle_limit, design.pressure_angle_at),
        cam_figures.curvature_plot(cam, convex_radius_min(cam).at),
        _torque_plot(design),
        _stagger_plot(analysis),
        *_tension_plots(analysis),
        deflection_plot(shaft.load, shaft.span, params.modulus, inertia, params.deflection_limit),
    )
    return tuple(
        figure if isinstance(figure, Animation) else replace(figure, name=f"shedding-{figure.name}") for figure in drawn
    )


def _torque_plot(design: SheddingDesign) -> Plot:
    """Torque of the warps on the shaft over the turn, and its rms."""
    most, curve, levels = design.drive.torque_max, design.shed.torque, {"root mean square": design.drive.torque_rms}
    mark = Mark(most.at, format_quantity(most.value, "Nm"))
    note = "positive: the shaft lifts the warps; negative: the warps drive the shaft"
    curves, both = {"torque": curve}, (design.even, design.odd)
    title = "Torque of the warps on the shaft"
    return cam_figures.turn_plot(title, TORQUE, curves, *both, name="torque", levels=levels, mark=mark, note=note)


def _stagger_plot(analysis: SheddingAnalysis) -> Plot:
    """Torque of cams all at once beside that of the flattest phases, or of those chosen."""
    design = analysis.design
    other = design.shed if design.params.phase == "staggered" else analysis.flattest
    spread = format_quantity(other.spread, "deg")
    name = f"{other.groups} groups over {spread}" if other.groups > 1 else "nothing is flatter"
    curves = {"all at once": analysis.together.torque, name: other.torque}
    programmes = (*other.even.programmes, *other.odd.programmes, design.even)
    first, last = other.window()
    note = f"the shed is open for the shuttle for {format_quantity(last - first, 'deg')} with {name}"
    title = "Torque of cams all at once and one after another"
    return cam_figures.turn_plot(title, TORQUE, curves, *programmes, name="stagger", dashed=(name,), note=note)


def _tension_plots(analysis: SheddingAnalysis) -> tuple[Plot, ...]:
    """Tension of a warp over the turn, and the torque of warps draped over the cams; nothing without a tension."""
    design, yarn, warp = analysis.design, analysis.yarn, analysis.warp
    if warp is None:
        return ()
    angle = cam_figures.sample_angles(design.even, design.odd)
    knife = (
        Series("even", angle, warp.tension_at(design.even.at(angle).s)),
        Series("odd", angle, warp.tension_at(design.odd.at(angle).s), dashed=True),
    )
    tension = Plot("tension", "Tension of a warp", ANGLE, Axis("tension", "N"), knife)
    if yarn is None:
        return (tension,)
    torques = (
        Series("knife edge", angle, design.shed.torque(angle)),
        Series("draped over the cam", yarn.angle, design.shed.draped_torque(yarn), dashed=True),
    )
    note = "a warp lies on the whole nose, which also lifts it in front of and behind the follower's line"
    title = "Torque by a knife edge on the cam and by the yarn draped over it"
    return tension, Plot("draped", title, ANGLE, TORQUE, torques, note=note)


def _shuttle_marks(design: SheddingDesign) -> tuple[Mark, ...]:
    """When the shuttle may enter and must have left the even shed; none where the shed is too low for it."""
    first, last = design.shuttle_window
    return (Mark(first, "shuttle in"), Mark(last, "shuttle out")) if last > first else ()
