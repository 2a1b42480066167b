"""The weft side in a loom: its parameters from the loom's task, its work."""

from ilmek.machines.arrangement.spans import SPARE
from ilmek.machines.beat import GUIDED
from ilmek.machines.loom_task import LoomTask
from ilmek.machines.weft.design import Weft
from ilmek.machines.weft.params import AUTO, RAPIER, WeftParams
from ilmek.machines.weft.rapier_tree import SIDE
from ilmek.machines.weft.shuttle import Shuttle
from ilmek.report import Work
from ilmek.units import mm, turn

BESIDE_HEADS = 70 * mm
"""From the cloth's edge to the devices that serve it, at least: half a head passes between; assumed by this project."""


def fit(task: LoomTask) -> WeftParams:
    """The parameters for a loom's cloth and shed; cams that sink for the beat leave no room for shuttles' carriages.

    Where the head is designed, and a rapier lays the wefts, the devices at the edges are beside it and its step.
    """
    params, laid = task.params, task.designs.get("weft")
    carrier = RAPIER if params.weft == AUTO and params.beat == GUIDED else params.weft
    edge = WeftParams().edge
    if RAPIER in (carrier, laid and laid.carrier):
        room = SPARE * params.clearance + SIDE / 2
        beside = (task.weaver.width + task.cloth.knot_pitch) / 2 + room if laid and task.weaver else 0.0
        edge = max(BESIDE_HEADS, beside)
    return WeftParams(
        carrier=carrier,
        edge=edge,
        aim="time" if params.aim == "time" else "price",
        cloth=task.cloth,
        rows=task.rows,
        selvedge_warps=params.selvedge_warps,
        lift=params.lift,
        open_share=params.open_share,
        play=SPARE * params.clearance,
        turn_time=turn / params.cam_speed,
        prices=params.prices,
    )


def work(weft: Weft) -> tuple[Work, ...]:
    """The work of a passage, and of the carriage's empty run to the other edge after every row of a shuttle."""
    name, carried = weft.params.carrier, weft.carried
    passage = Work(name, weft.passage_energy, "pass")
    if not isinstance(carried, Shuttle):
        return (passage,)
    return passage, Work(name, 0.5 * (weft.axis.mass - carried.full) * weft.passage.speed**2, "row")
