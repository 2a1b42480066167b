"""The control program of a loom for a programme: all structures and units, sized by the programme."""

import math
from itertools import pairwise

from ilmek.errors import LoomError
from ilmek.io.plc.cam_function import cam_tables, cam_units
from ilmek.io.plc.interlock_logic import interlock_unit
from ilmek.io.plc.motion_blocks import axis_structure
from ilmek.io.plc.row_drive import drive_units
from ilmek.io.plc.sequence_logic import sequence_units
from ilmek.io.plc.sequence_variables import PlcSize, ScanLimits, structures
from ilmek.io.plc.state_model import state_units
from ilmek.io.plc.units import PlcProject
from ilmek.loom.control.interlocks import usual_limits
from ilmek.loom.operations import LoomProgramme, LoomSetup
from ilmek.loom.twin.model import HOMING, WATCHDOG
from ilmek.units import BILLION

CYCLE = 0.010
"""Cycle of the controller's task [s]."""

EARLIEST = 0.5
"""Share of an operation's shortest time before which a report of its end is not believed."""

MOST_SCANS = 32_000
"""Longest time limit in scans: an INT counts them."""

MOST_COLUMNS = 32_000
"""Largest number of knots of a row: an INT is the index of a knot."""


def plc_project(programme: LoomProgramme, cycle: float = CYCLE) -> PlcProject:
    """The control program that weaves a programme's carpet, and others that are no larger.

    cycle  of the controller's task [s]
    Raises LoomError for a row of more than MOST_COLUMNS knots.
    """
    setup = programme.setup
    if setup.columns > MOST_COLUMNS:
        raise LoomError(f"a row of {setup.columns} knots", allowed=f"at most {MOST_COLUMNS} for a PLC")
    size = size_of(programme, cycle)
    drives = drive_units(setup, cycle)
    records = (*structures(size), *([axis_structure()] if drives else []))
    units = (
        *state_units(),
        *cam_units(cam_tables(setup.cyclograms)),
        *drives,
        interlock_unit(setup.heads, usual_limits(setup.warp_pitch)),
        *sequence_units(size),
    )
    return PlcProject("loom", records, units, cycle, _remarks(setup, programme.digest))


def size_of(programme: LoomProgramme, cycle: float = CYCLE) -> PlcSize:
    """The sizes of a programme, with the most phases of any row, and the limits of its operations in scans."""
    setup = programme.setup
    phases = max(programme.operations(number).phases for number in range(setup.rows))
    times = setup.times
    longest = times.knot + times.colour_change + setup.columns * times.travel
    ends = tuple(scan_limits(then - first, then - first, cycle) for first, then in pairwise((0.0, *times.row_ends)))
    knot, home = scan_limits(times.knot, longest, cycle), scan_limits(0.0, HOMING / BILLION, cycle)
    return PlcSize(setup.heads, phases, setup.columns, knot, ends, home)


def scan_limits(shortest: float, longest: float, cycle: float) -> ScanLimits:
    """Scans in which an operation ends: after half of its shortest time, before WATCHDOG times its longest [s].

    >>> scan_limits(2.0, 2.5, 0.01)
    ScanLimits(least=100, most=750)
    """
    most = math.ceil(WATCHDOG * longest / cycle)
    return ScanLimits(math.floor(EARLIEST * shortest / cycle), min(most, MOST_SCANS))


def _remarks(setup: LoomSetup, digest: str) -> tuple[str, ...]:
    return (
        f"loom for {setup.rows} rows of {setup.columns} knots, {setup.heads} heads",
        f"programme {digest}",
        "the host writes the carpet into Recipe, then one row at a time into RowData when RowRequest changes",
    )
