"""The knotting head in a loom: its parameters for the carpet, its lines in the parts list, the work of its acts."""

from dataclasses import replace

from ilmek.cams.loaded_plate_cam import torque_at
from ilmek.elements.drive_parts import belt_motor_part, motor_part, positive_work, reducer_part
from ilmek.machines.loom_task import LoomTask
from ilmek.machines.weaver.design import Weaver
from ilmek.machines.weaver.limits import head_mass
from ilmek.machines.weaver.params import WeaverParams
from ilmek.report import NOT_WEIGHED, Part, Work
from ilmek.timing.s_curve import s_curve


def params_for(task: LoomTask) -> WeaverParams:
    """The parameters of the heads of a loom."""
    loom = task.params
    return WeaverParams(
        cycle=loom.knot_cycle,
        law=loom.knot_law,
        knot=loom.knot,
        knot_yarn=loom.knot_yarn,
        yarn_density=task.yarns.pile.linear_density,
        warp_diameter=task.yarns.warp.diameter,
        acceleration_limit=loom.head_acceleration,
        head_width=loom.head_width,
        head_mass=loom.head_mass,
        knot_pitch=task.knot_pitch,
        row_pitch=task.row_pitch,
        carriage_speed=loom.carriage_speed,
        tubes=loom.colours,
        tube_mass=loom.tube_mass,
    )


def parts(weaver: Weaver) -> tuple[Part, ...]:
    """The parts of one head and its carriage; those within the head are weighed with it."""
    params, servo, mass = weaver.params, weaver.drive.servo, head_mass(weaver)
    motor = servo.motor if servo else None
    tubes = params.tubes * params.tube_mass * params.selector_acceleration
    within = (
        motor_part("motor of a head", motor, weaver.drive.torque_max, weaver.cyclogram.speed),
        belt_motor_part("motor of the colours", tubes, params.selector_speed),
    )
    cam_motor, colour_motor = (replace(part, mass=NOT_WEIGHED) for part in within)
    return (
        Part("knotting head", 1, "cams, tools, tubes, motors", "", "head mechanism", mass),
        Part("yarn tube", params.tubes, "one for each colour, weighed with the head", "", "yarn tube"),
        cam_motor,
        *((reducer_part("reducer of a head", servo.reducer.ratio, motor),) if servo else ()),
        belt_motor_part("motor of a carriage", mass * params.carriage_acceleration, params.carriage_speed),
        colour_motor,
    )


def work(weaver: Weaver) -> tuple[Work, ...]:
    """Work of a turn of the cam shaft, of the carriage's step, and of a move over a third of the tubes, the mean.

    A move takes the kinetic energy at its greatest speed, m v² / 2.
    """
    params = weaver.params
    step = s_curve(params.knot_pitch, params.carriage)
    change = s_curve(params.tubes * params.tube_pitch / 3, params.selector)
    return (
        Work("knotting", positive_work(lambda angle: torque_at(weaver.cams, angle)), "knot"),
        Work("carriages", 0.5 * head_mass(weaver) * step.speed**2, "knot"),
        Work("colours", 0.5 * params.tubes * params.tube_mass * change.speed**2, "colour change"),
    )
