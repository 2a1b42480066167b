"""The warp tension in a loom: parameters from its task with the lightest tube, its work."""

from dataclasses import replace

from ilmek.machines.loom_task import LoomTask
from ilmek.machines.warp_loads import loads_in_loom
from ilmek.machines.warp_tension.design import USUAL, WarpTensionDesign
from ilmek.machines.warp_tension.params import WarpTensionParams
from ilmek.report import Work


def fit(task: LoomTask) -> WarpTensionParams:
    """The parameters for a loom, with the lightest of the usual tubes that keeps slope and deflection."""
    params, loads = task.params, loads_in_loom(task)
    assert task.side is not None
    derived = task.parameters(
        "warp-tension",
        WarpTensionParams(
            cloth=task.cloth,
            width=task.width,
            take_up_time=task.take_up_time,
            row_time=task.row_time,
            carpet_length=params.woven_size[1],
            free_length=task.side.warp_length,
            shed_lift=params.lift,
            shed_span=task.side.front_span,
            tension_shed=loads.lifted,
            tension_shed_low=loads.others,
            tension_beat=loads.beat,
            warps_beaten=loads.beaten,
        ),
    )
    if any(one is not None for one in (derived.tube, derived.outer_radius, derived.inner_radius)):
        return derived
    return replace(derived, tube=USUAL)


def work(design: WarpTensionDesign) -> tuple[Work, ...]:
    """The work of taking up the carpet against the pull of the warps, the reducer's losses included."""
    params = design.params
    return (Work("take-up", params.cloth.pull * params.carpet_length / design.reducer.efficiency, "carpet"),)
