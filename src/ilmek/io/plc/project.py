"""The control program of a loom for a programme: all structures and units, sized by the programme."""

from ilmek.errors import LoomError
from ilmek.io.plc.cam_function import cam_tables, cam_units
from ilmek.io.plc.interlock_logic import interlock_unit
from ilmek.io.plc.sequence_logic import sequence_units
from ilmek.io.plc.sequence_variables import PlcSize, row_structure
from ilmek.io.plc.state_model import state_units
from ilmek.io.plc.units import PlcProject
from ilmek.loom.control.interlocks import usual_limits
from ilmek.loom.operations import LoomProgramme, LoomSetup

CYCLE = 0.010
"""Cycle of the controller's task [s]."""

MOST_COLUMNS = 32_000
"""Largest number of knots of a row: an INT is the index of a knot."""


def plc_project(programme: LoomProgramme) -> PlcProject:
    """The control program that weaves a programme's carpet.

    Raises LoomError for a row of more than MOST_COLUMNS knots.
    """
    setup = programme.setup
    if setup.columns > MOST_COLUMNS:
        raise LoomError(f"a row of {setup.columns} knots", allowed=f"at most {MOST_COLUMNS} for a PLC")
    size = size_of(programme)
    units = (
        *state_units(),
        *cam_units(cam_tables(setup.cyclograms)),
        interlock_unit(setup.heads, usual_limits(setup.warp_pitch)),
        *sequence_units(size),
    )
    return PlcProject("loom", (row_structure(size),), units, "Loom", CYCLE, _remarks(setup, programme.digest))


def size_of(programme: LoomProgramme) -> PlcSize:
    """The sizes of a programme, with the most phases of any row."""
    setup = programme.setup
    phases = max(programme.operations(number).phases for number in range(setup.rows))
    return PlcSize(setup.heads, phases, setup.columns, setup.rows)


def _remarks(setup: LoomSetup, digest: str) -> tuple[str, ...]:
    return (
        f"loom for {setup.rows} rows of {setup.columns} knots, {setup.heads} heads",
        f"programme {digest}",
        "the host writes one row at a time into RowData when RowRequest changes",
    )
