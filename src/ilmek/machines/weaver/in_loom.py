"""The knotting head in a loom: its parameters for the carpet, its lines in the parts list, the work of its acts."""

from dataclasses import replace

from ilmek.elements.drive_parts import belt_motor_part, motor_part, positive_work, reducer_part
from ilmek.machines.arrangement.spans import expected_spans, shed_room, warp_length
from ilmek.machines.loom_task import LoomTask
from ilmek.machines.weaver.design import Weaver, shaft_torque
from ilmek.machines.weaver.limits import head_mass
from ilmek.machines.weaver.params import WeaverParams
from ilmek.machines.weaver.tool_params import OpenerParams, ToolForces
from ilmek.report import NOT_WEIGHED, BillLine, Work
from ilmek.timing.s_curve import s_curve

LEAST_FRICTION = 0.01
"""Least friction with which jaws hold a yarn."""


def params_for(task: LoomTask) -> WeaverParams:
    """The parameters of the heads of a loom."""
    loom = task.params
    return WeaverParams(
        cycle=loom.knot_cycle,
        law=loom.knot_law,
        knot=loom.knot,
        knot_yarn=loom.billed,
        pile_height=loom.pile.pile_height,
        yarn_density=task.yarns.pile.linear_density,
        yarn_diameter=task.yarns.pile.diameter,
        yarn_pressed=task.yarns.pressed,
        yarn_strength=task.yarns.pile.breaking_force,
        warp_diameter=task.yarns.warp.diameter,
        acceleration_limit=loom.head_acceleration,
        head_width=loom.head_width,
        head_mass=loom.head_mass,
        knot_pitch=task.knot_pitch,
        row_pitch=task.row_pitch,
        carriage_speed=loom.carriage_speed,
        tubes=loom.head_tubes,
        tube_mass=loom.tube_mass,
        opener=opener_for(task),
        forces=ToolForces(friction=max(task.yarns.warp.friction, LEAST_FRICTION)),
    )


def opener_for(task: LoomTask) -> OpenerParams:
    """The opener's parameters for a loom: its warps, and its position between fell and comb at rest."""
    usual, warp, room = OpenerParams(), task.yarns.warp, shed_room(task)
    spans = expected_spans(room, task.params.lift)
    return OpenerParams(
        back_span=max(spans.comb - usual.front_span - usual.height, usual.front_span),
        warp_length=warp_length(room, spans),
        warp_tension=task.tension,
        warp_stiffness=warp.stiffness,
        warp_strength=warp.breaking_force,
    )


def parts(weaver: Weaver) -> tuple[BillLine, ...]:
    """The parts of one head and its carriage; those within the head are weighed with it, arms by themselves."""
    params, servo, mass = weaver.params, weaver.drive.servo, head_mass(weaver)
    own = max(mass - (params.arms.mass if params.with_arms else 0.0), 0.0)
    motor = servo.motor if servo else None
    tubes = params.tubes * params.tube_mass * params.selector_acceleration
    colours = belt_motor_part("motor of the colours", tubes, params.selector_speed)
    within = (
        motor_part("motor of a head", motor, weaver.drive.torque_max, weaver.cyclogram.speed),
        *((colours,) if weaver.magazine.tiers == 1 else (colours, replace(colours, name="motor of the tiers"))),
    )
    cam_motor, *colour_motors = (replace(part, mass=NOT_WEIGHED) for part in within)
    return (
        BillLine("knotting head", 1, "cams, tools, tubes, motors", "", "head mechanism", own),
        BillLine("yarn tube", params.tubes, "one for each colour, weighed with the head", "", "yarn tube"),
        cam_motor,
        *((reducer_part("reducer of a head", servo.reducer.ratio, motor),) if servo else ()),
        belt_motor_part("motor of a carriage", mass * params.carriage_acceleration, params.carriage_speed),
        *colour_motors,
    )


def work(weaver: Weaver) -> tuple[Work, ...]:
    """Work of a turn of the cam shaft, of the carriage's step, and of a move over a third of a tier's tubes, the mean.

    A move takes the kinetic energy at its greatest speed, m v² / 2.
    """
    params = weaver.params
    step = s_curve(params.knot_pitch, params.carriage)
    change = s_curve(weaver.magazine.per_tier * params.tube_pitch / 3, params.selector)
    return (
        Work("knotting", positive_work(lambda angle: shaft_torque(weaver, angle)), "knot"),
        Work("carriages", 0.5 * head_mass(weaver) * step.speed**2, "knot"),
        Work("colours", 0.5 * params.tubes * params.tube_mass * change.speed**2, "colour change"),
    )
