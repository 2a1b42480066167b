"""IEC 61131-3 structured text: a function block that contains its table, for any controller of that language.

The steps are even and the interpolation is linear, so that no library is needed. The block counts the turns of the
master; a slave that advances by a stroke per turn does so.
"""

from ilmek.io.cam_tables.format import Format, Remarks, comment, identifier, number, rows, wrapped
from ilmek.io.cam_tables.sampling import SampledTable, SamplingRule
from ilmek.report import CamTable

_BLOCK = """\
FUNCTION_BLOCK {name}
VAR_INPUT
    master : LREAL; (* deg, any turn *)
END_VAR
VAR_OUTPUT
    position : LREAL; (* {unit} *)
END_VAR
VAR CONSTANT
    steps : DINT := {steps};
    advance : LREAL := {advance}; (* {unit} per turn *)
    table : ARRAY[0..{steps}] OF LREAL := [
    {values}];
END_VAR
VAR
    turns : DINT;
    x : LREAL;
    index : DINT;
END_VAR
turns := TRUNC(master / 360.0);
IF master < 360.0 * DINT_TO_LREAL(turns) THEN
    turns := turns - 1;
END_IF;
x := (master / 360.0 - DINT_TO_LREAL(turns)) * DINT_TO_LREAL(steps);
index := MIN(TRUNC(x), steps - 1);
position := table[index] + (x - DINT_TO_LREAL(index)) * (table[index + 1] - table[index])
    + advance * DINT_TO_LREAL(turns);
END_FUNCTION_BLOCK
"""


def write(table: CamTable, sampled: SampledTable, remarks: Remarks) -> str:
    """The function block."""
    points = rows(table, sampled)
    block = _BLOCK.format(
        name=identifier(table.name, "block"),
        unit=table.unit,
        steps=len(points.y) - 1,
        advance=number(float(points.y[-1])),
        values=wrapped([number(value) for value in points.y]),
    )
    return comment(remarks) + block


FORMAT = Format(
    "iec",
    "st",
    "IEC 61131-3 structured text: array of positions in even steps",
    SamplingRule("linear", even=True, least=37),
    write,
    "call the block in each cycle and give its position to the axis; the block itself interpolates linearly",
)
