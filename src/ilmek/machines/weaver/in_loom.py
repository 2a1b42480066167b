"""The knotting head in a loom: its parameters for the carpet, the work of its acts."""

from ilmek.cams.loaded_plate_cam import torque_at
from ilmek.elements.drive_parts import positive_work
from ilmek.machines.arrangement.spans import SPARE, expected_spans, shed_room, warp_length
from ilmek.machines.loom_task import LoomTask
from ilmek.machines.weaver.design import Weaver
from ilmek.machines.weaver.params import WeaverParams
from ilmek.machines.weaver.tool_params import OpenerParams
from ilmek.machines.weaver.tree import head_mass
from ilmek.report import Work
from ilmek.timing.s_curve import s_curve


def params_for(task: LoomTask) -> WeaverParams:
    """The parameters of the heads of a loom."""
    loom = task.params
    return WeaverParams(
        cloth=task.cloth,
        cycle=loom.knot_cycle or WeaverParams().cycle,
        law=loom.knot_law,
        knot=loom.knot,
        knot_yarn=loom.billed,
        pile_height=loom.pile.pile_height,
        standoff=SPARE * loom.clearance,
        acceleration_limit=loom.head_acceleration,
        head_width=loom.head_width,
        head_mass=loom.head_mass,
        carriage_speed=loom.carriage_speed,
        tubes=loom.head_tubes,
        tube_mass=loom.tube_mass,
        opener=opener_for(task),
    )


def opener_for(task: LoomTask) -> OpenerParams:
    """The opener's parameters for a loom: its warps, and its position between fell and comb at rest."""
    usual, room = OpenerParams(), shed_room(task)
    spans = expected_spans(room, task.params.lift)
    return OpenerParams(
        back_span=max(spans.comb - usual.front_span - usual.height, usual.front_span),
        warp_length=warp_length(room, spans),
    )


def work(weaver: Weaver) -> tuple[Work, ...]:
    """Work of a turn of the cam shaft, a cut, the carriage's step, and a move over a third of a tier's tubes, the mean.

    A move takes the kinetic energy at its greatest speed, m v² / 2.
    """
    params = weaver.params
    step = s_curve(params.cloth.knot_pitch, params.carriage)
    change = s_curve(weaver.magazine.per_tier * params.tube_pitch / 3, params.selector)
    return (
        Work("knotting", positive_work(lambda angle: torque_at(weaver.cams, angle)), "knot"),
        Work("cutting", params.strength * params.yarn, "knot"),
        Work("carriages", 0.5 * head_mass(weaver) * step.speed**2, "knot"),
        Work("colours", 0.5 * weaver.magazine.moved(params.tube_mass) * change.speed**2, "colour change"),
    )
