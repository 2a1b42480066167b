"""Which carpet and row are in work: the record that outlives a power failure, the recipe, the check of a row.

At the end of each scan the position is written over the older of two records, then the flag that names the newer one:
wherever a power failure cuts the program off, one record is whole, and it is not behind any order. A new carpet begins
in state Resetting when the host has written its recipe; a carpet in work goes on only with its own programme, and only
at the row of the host's journal.
"""

from ilmek.io.plc.alarm_logic import raised
from ilmek.io.plc.sequence_variables import DIGEST_WORDS, LAST_BEAT, NOT_ASIDE, PlcSize
from ilmek.io.plc.units import PlcSection, PlcUnit, PlcVariable, indented, loop
from ilmek.loom.control.alarms import ControlFault, JournalFault
from ilmek.loom.control.packml import PackMode, PackState
from ilmek.loom.control.sequence import ROWS_BACK
from ilmek.loom.operations import EMPTY, ROW_ENDS

HOST_PATIENCE = 1000
"""Scans for which the program waits for the host, 10 s."""

ITEMS = 32
"""Values of a row that are checked in a scan: a row of 300 knots is checked in 100 ms."""

CRC_POLYNOMIAL, CRC_ONES = "16#EDB88320", "16#FFFFFFFF"
"""CRC-32 of ISO 3309 (IEEE 802.3), the least significant bit first."""


def crc_unit() -> PlcUnit:
    """The function that continues a CRC-32 by the lowest bits of a value."""
    body = f"""\
Sum := Crc;
Rest := Value;
FOR Bit := 1 TO Bits DO
    Odd := ((Sum XOR Rest) AND DWORD#16#1) <> DWORD#16#0;
    Sum := UDINT_TO_DWORD(DWORD_TO_UDINT(Sum) / 2);
    Rest := UDINT_TO_DWORD(DWORD_TO_UDINT(Rest) / 2);
    IF Odd THEN
        Sum := Sum XOR DWORD#{CRC_POLYNOMIAL};
    END_IF;
END_FOR;
CrcOf := Sum;
"""
    sections = (
        PlcSection(
            "VAR_INPUT",
            (
                PlcVariable("Crc", "DWORD"),
                PlcVariable("Value", "DWORD"),
                PlcVariable("Bits", "INT", "8, 16 or 32"),
            ),
        ),
        PlcSection(
            "VAR",
            (
                PlcVariable("Sum", "DWORD"),
                PlcVariable("Rest", "DWORD"),
                PlcVariable("Bit", "INT"),
                PlcVariable("Odd", "BOOL"),
            ),
        ),
    )
    return PlcUnit("FUNCTION", "CrcOf", "CRC-32 continued by the lowest bits of a value", sections, body, "DWORD")


def waking(size: PlcSize) -> str:
    """The first scan: the last whole record, if it can be one."""
    return f"""\
(* after power-up: the last whole record *)
IF NOT Awake THEN
    Awake := TRUE;
    IF OddIsLast THEN
        Now := SavedOdd;
    ELSE
        Now := SavedEven;
    END_IF;
{indented(loop("Station", size.stations, "Settling[Station] := TRUE;"))}
    Sum := Now.Before;
{indented(loop("Head", size.heads, "Sum := Sum + INT_TO_DINT(Now.Tied[Head]);"))}
    IF Now.Begun AND (Sum <> Now.Knots OR Now.Row < 0 OR Now.Row > Now.Carpet.Rows OR Now.Phase < 0
        OR Now.Phase > {size.phases} OR Now.EndsDone < 0 OR Now.EndsDone > {len(ROW_ENDS)}) THEN
        {raised(JournalFault.DAMAGED)}
    END_IF;
END_IF;
"""


def saving() -> str:
    """The end of a scan: the position over the older record, then which is the newer one."""
    return """\
(* what outlives a power failure *)
Alarm := Now.Alarm;
IF OddIsLast THEN
    SavedEven := Now;
    OddIsLast := FALSE;
ELSE
    SavedOdd := Now;
    OddIsLast := TRUE;
END_IF;
"""


def giving_up(size: PlcSize) -> str:
    """An operator gives the carpet in work up: nothing of it is remembered."""
    return f"""\
IF GiveUp AND NOT GiveUpSeen AND StateCurrent = {int(PackState.STOPPED)} THEN
    Now.Begun := FALSE;
{indented(loop("Station", size.stations, "Now.Busy[Station] := FALSE;"))}
END_IF;
GiveUpSeen := GiveUp;
"""


def rows_back(size: PlcSize) -> str:
    """An operator has taken out the row in work and whole rows before it: they are woven again.

    Not beyond the last change of packages: the rows before it need the packages that were taken off.
    """
    return f"""\
IF RowsBackRequest AND NOT RowsBackSeen AND StateCurrent = {int(PackState.STOPPED)} AND Now.Begun AND RowsBack >= 0
    AND RowsBack <= {ROWS_BACK} AND Now.Row - INT_TO_DINT(RowsBack) >= Now.StopRow
    AND RowsBackKnots >= 0 AND RowsBackKnots <= Now.Before THEN
    Now.Row := Now.Row - INT_TO_DINT(RowsBack);
    Now.Knots := RowsBackKnots;
{indented(loop("Station", size.stations, "Now.Busy[Station] := FALSE;"))}
{indented(_row_begins(size))}
END_IF;
RowsBackSeen := RowsBackRequest;
"""


def heartbeat() -> str:
    """The program counts its scans, and while it weaves those since the host has counted on."""
    return f"""\
(* heartbeat *)
PlcBeat := PlcBeat + 1;
IF PlcBeat > {LAST_BEAT} THEN
    PlcBeat := 0;
END_IF;
BeatScans := BeatScans + 1;
IF HostBeat <> HostBeatSeen OR StateCurrent <> {int(PackState.EXECUTE)}
    OR UnitModeCurrent = {int(PackMode.MANUAL)} THEN
    BeatScans := 0;
END_IF;
HostBeatSeen := HostBeat;
"""


def recipe_check(size: PlcSize) -> str:
    """In state Resetting: the next carpet begins, or the one in work is compared with the host's journal."""
    compare = "Plausible := Plausible AND Recipe.Programme[Index] = Now.Carpet.Programme[Index];"
    return f"""\
(* the carpet *)
IF StateCurrent = {int(PackState.RESETTING)} AND NOT Waiting THEN
    IF NOT Now.Begun THEN
        IF Recipe.Rows >= 1 AND Recipe.Columns >= 1 AND Recipe.Columns <= {size.columns} AND Recipe.Tubes >= 1
            AND Recipe.Tubes <= {EMPTY} AND Recipe.Row = -1 THEN
            Now.Begun := TRUE;
            Now.Carpet := Recipe;
            Now.Row := 0;
            Now.StopRow := 0;
            Now.Knots := 0;
{indented(indented(indented(_row_begins(size))))}
        ELSE
            Waiting := TRUE;
            HostScans := HostScans + 1;
            IF Recipe.Row >= 0 AND NOT CarpetDone THEN
                {raised(JournalFault.BEHIND)}
            END_IF;
        END_IF;
    ELSE
        Plausible := Recipe.Rows = Now.Carpet.Rows AND Recipe.Columns = Now.Carpet.Columns;
{indented(indented(loop("Index", DIGEST_WORDS, compare)))}
        IF NOT Plausible THEN
            Waiting := TRUE;
            {raised(JournalFault.OTHER_PROGRAMME)}
        ELSIF Recipe.Row <> Now.Row AND Recipe.Row + 1 <> Now.Row THEN
            Waiting := TRUE;
            {raised(JournalFault.BEHIND)}
        END_IF;
    END_IF;
END_IF;
"""


def next_row(size: PlcSize) -> str:
    """The row is woven: to the next one."""
    return f"""\
IF Now.EndsDone = {len(ROW_ENDS)} THEN
    StepDone := TRUE;
    Now.Row := Now.Row + 1;
{indented(_row_begins(size))}
END_IF;
CarpetDone := Now.Carpet.Rows > 0 AND Now.Row >= Now.Carpet.Rows;
KnotsDone := Now.Knots;
RowRequest := -1;
IF Now.Begun AND NOT CarpetDone THEN
    RowRequest := Now.Row;
END_IF;
"""


def _row_begins(size: PlcSize) -> str:
    return f"""\
Now.Phase := 0;
Now.StopsDone := 0;
Now.EndsDone := 0;
Now.Before := Now.Knots;
RowReady := FALSE;
Loading := FALSE;
{loop("Head", size.heads, "Now.Tied[Head] := 0;" + chr(10) + "Stood[Head] := FALSE;")}"""


def row_check(size: PlcSize) -> str:
    """While weaving: the row in work is copied from the host's data, then checked, some values in each scan."""
    return f"""\
(* the row: copied, then checked *)
IF StateCurrent = {int(PackState.EXECUTE)} AND UnitModeCurrent <> {int(PackMode.MANUAL)} AND Now.Begun
    AND NOT CarpetDone AND NOT RowReady THEN
    IF Loading THEN
{indented(indented(loop("Pass", ITEMS, _item(size))))}
        IF NOT Plausible THEN
            Loading := FALSE;
            {raised(JournalFault.ROW_DAMAGED)}
        END_IF;
    ELSIF RowData.Number = Now.Row THEN
        HostScans := 0;
        Work := RowData;
        Loading := TRUE;
        Item := 0;
        Plausible := Work.Phases >= 1 AND Work.Phases <= {size.phases} AND Work.Before = Now.Before
            AND Work.Knots >= 0 AND Work.Knots <= Now.Carpet.Columns;
        Crc := DWORD#{CRC_ONES};
{indented(indented(loop("Index", DIGEST_WORDS, _crc("Now.Carpet.Programme[Index]", 32))))}
        {_crc("DINT_TO_DWORD(Work.Number)", 32)}
        {_crc("DINT_TO_DWORD(Work.Before)", 32)}
        {_crc("INT_TO_DWORD(Work.Knots)", 16)}
        {_crc("INT_TO_DWORD(Work.Phases)", 16)}
{indented(indented(loop("Index", size.columns, "Seen[Index] := FALSE;")))}
    ELSE
        HostScans := HostScans + 1;
    END_IF;
END_IF;
IF HostScans > {HOST_PATIENCE} OR BeatScans > {HOST_PATIENCE} THEN
    HostScans := 0;
    BeatScans := 0;
    {raised(ControlFault.NO_HOST)}
END_IF;
"""


def _crc(value: str, bits: int) -> str:
    return f"Crc := CrcOf(Crc := Crc, Value := {value}, Bits := {bits});"


def _item(size: PlcSize) -> str:
    """One value of the row: knots, then per head its first knot and its limits, then the stops, then the sum itself."""
    return f"""\
IF Loading AND Plausible THEN
    Rest := Item - INT_TO_DINT(Work.Knots);
    IF Rest < 0 THEN
{indented(indented(_knot_check()))}
    ELSIF Rest < {size.heads} THEN
        Head := DINT_TO_INT(Rest);
{indented(indented(_head_check(size)))}
    ELSIF Rest < {size.heads} + INT_TO_DINT(Work.Phases) THEN
        Index := DINT_TO_INT(Rest - {size.heads});
        Tube := 0;
        IF Work.StopBefore[Index] THEN
            Tube := 1;
        END_IF;
        {_crc("INT_TO_DWORD(Tube)", 8)}
    ELSE
        Plausible := (Crc XOR DWORD#{CRC_ONES}) = Work.Check AND Now.Phase <= Work.Phases;
        RowReady := Plausible;
        Loading := FALSE;
    END_IF;
    Item := Item + 1;
END_IF;
"""


def _knot_check() -> str:
    """A knot: its column and tube exist, and the row has no other knot on the column."""
    return f"""\
Index := Work.Columns[DINT_TO_INT(Item)];
Tube := USINT_TO_INT(Work.Tubes[DINT_TO_INT(Item)]);
{_crc("INT_TO_DWORD(Index)", 16)}
{_crc("INT_TO_DWORD(Tube)", 8)}
Plausible := Index >= 0 AND Index < Now.Carpet.Columns AND Tube < Now.Carpet.Tubes;
IF Plausible THEN
    Plausible := NOT Seen[Index];
    Seen[Index] := TRUE;
END_IF;
"""


def _head_check(size: PlcSize) -> str:
    """A head: its limits ascend, its knots end where the next one's begin, it stands aside where it ties none."""
    return f"""\
{_crc("INT_TO_DWORD(Work.First[Head])", 16)}
Before := 0;
Index := 0;
WHILE Plausible AND Index < Work.Phases DO
    PhaseEnd := Work.Limits[Head * {size.phases} + Index];
    Tube := Work.Aside[Head * {size.phases} + Index];
    {_crc("INT_TO_DWORD(PhaseEnd)", 16)}
    {_crc("INT_TO_DWORD(Tube)", 16)}
    Plausible := PhaseEnd >= Before AND PhaseEnd <= Work.Knots AND Tube < Now.Carpet.Columns
        AND (Tube = {NOT_ASIDE} OR (Tube >= 0 AND PhaseEnd = Before));
    Before := PhaseEnd;
    Index := Index + 1;
END_WHILE;
IF Head = 0 THEN
    Plausible := Plausible AND Work.First[0] = 0;
END_IF;
PhaseEnd := Work.Knots;
IF Head < {size.heads - 1} THEN
    PhaseEnd := Work.First[Head + 1];
END_IF;
Plausible := Plausible AND Work.First[Head] >= 0 AND Now.Tied[Head] <= Before
    AND INT_TO_DINT(PhaseEnd) - INT_TO_DINT(Before) = INT_TO_DINT(Work.First[Head]);
"""
