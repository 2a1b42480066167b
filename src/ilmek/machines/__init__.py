"""The catalogue of machines. A new machine is a file here and a line below."""

import difflib

from ilmek.errors import ParameterError
from ilmek.machines.automated_loom import MACHINE as AUTOMATED_LOOM
from ilmek.machines.beat_up import MACHINE as BEAT_UP
from ilmek.machines.cam import MACHINE as CAM
from ilmek.machines.function_four_bar import MACHINE as FUNCTION_FOUR_BAR
from ilmek.machines.hammer import MACHINE as HAMMER
from ilmek.machines.knotting_dyad import MACHINE as KNOTTING_DYAD
from ilmek.machines.knotting_four_bar import MACHINE as KNOTTING_FOUR_BAR
from ilmek.machines.machine import Machine
from ilmek.machines.motion_four_bar import MACHINE as MOTION_FOUR_BAR
from ilmek.machines.path_four_bar import MACHINE as PATH_FOUR_BAR
from ilmek.machines.shedding import MACHINE as SHEDDING
from ilmek.machines.tufting import MACHINE as TUFTING
from ilmek.machines.warp_tension import MACHINE as WARP_TENSION
from ilmek.machines.weaver import MACHINE as WEAVER

MACHINES: dict[str, Machine] = {
    machine.name: machine
    for machine in (
        AUTOMATED_LOOM,
        WEAVER,
        BEAT_UP,
        CAM,
        SHEDDING,
        HAMMER,
        WARP_TENSION,
        TUFTING,
        KNOTTING_FOUR_BAR,
        KNOTTING_DYAD,
        PATH_FOUR_BAR,
        MOTION_FOUR_BAR,
        FUNCTION_FOUR_BAR,
    )
}
"""Every machine by its name, in the order of the catalogue."""


def find_machine(name: str) -> Machine:
    """The machine of a name. Raises ParameterError, naming the nearest."""
    if name in MACHINES:
        return MACHINES[name]
    near = difflib.get_close_matches(name.lower().replace("_", "-"), MACHINES, n=1)
    hint = f"did you mean {near[0]}?" if near else ""
    raise ParameterError(f"unknown machine {name!r}", allowed=f"machines: {', '.join(MACHINES)}", do=hint)
