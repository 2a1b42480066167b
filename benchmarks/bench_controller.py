"""The controller without disc and loom: time of a reaction to a knot, of opening a journal, and the exhaustive model.

Limit: 30 microseconds of processor time a knot. Beside it, what a knot costs at least: a value made and a record with
its checksum packed.
"""

import struct
import sys
import time
from pathlib import Path
from zlib import crc32

from ilmek.loom.control.controller import Controller
from ilmek.loom.control.exchange import Commanded, ControlOutputs, Sensed
from ilmek.loom.control.opening import open_journal
from ilmek.loom.control.packml import PackCommand, PackState
from ilmek.loom.control.ports import Done, Order, SensorsChanged, Tie
from ilmek.loom.control.state import ControllerSettings
from ilmek.loom.operations import ROW_ENDS

sys.path.insert(0, str(Path(__file__).parents[1] / "tests" / "support"))
from control_model import Budget, Model, TinyProgramme  # type: ignore[import-not-found]
from fake_loom import READY  # type: ignore[import-not-found]
from small_programme import small_programme  # type: ignore[import-not-found]

ROWS, COLUMNS, HEADS = 300, 450, 10


def weave(group: int, batch: int) -> tuple[float, bytes]:
    """Processor time a knot [s] of the controller alone, and the journal; batch: ended operations in a reaction."""
    programme = small_programme(rows=ROWS, columns=COLUMNS, heads=HEADS, yarns=12)
    controller = Controller(programme, open_journal(b"", programme, group=group), ControllerSettings(watched=()))
    journal: list[bytes] = []
    moving: list[Order] = []

    def carry_out(outputs: ControlOutputs) -> None:
        journal.append(outputs.append)
        moving.extend(outputs.orders)

    asked = controller.react((SensorsChanged(READY, 0), Commanded(PackCommand.RESET)))
    while asked.orders:  # each axis is at home
        carry_out(asked)
        asked = controller.react(tuple(Done(order, 0) for order in asked.orders))
    carry_out(asked)
    moving.clear()
    carry_out(controller.react(tuple(Sensed(one, False) for one in asked.questions)))
    carry_out(controller.react((Commanded(PackCommand.START),)))
    spent, now = 0.0, 0
    while controller.state.state is PackState.EXECUTE:
        now += 1
        ended = tuple(Done(order, now) for order in moving[:batch])
        del moving[:batch]
        begin = time.process_time()
        outputs = controller.react(ended)
        spent += time.process_time() - begin
        carry_out(outputs)
    assert controller.state.sequence.finished
    return spent / programme.setup.knots, b"".join(journal)


def least(number: int = 200_000) -> float:
    """Time [s] of an order made, a report made and a record packed: the parts that no controller can leave out."""
    body = struct.Struct("<IHBBIHHIq")
    begin = time.process_time()
    crc = 0
    for index in range(number):
        Done(Tie(0, 0, index, index, 0), index)
        crc = crc32(body.pack(index, 0, 1, 0, 0, 0, 0, index, index), crc)
    return (time.process_time() - begin) / number


def run() -> None:
    print(f"{ROWS * COLUMNS:,} knots, {HEADS} heads; limit 30 us a knot")
    base = least()
    print(f"{'order, report and record alone':44s}{1e6 * base:8.1f} us")
    for group, batch in ((1, 1), (1, HEADS), (64, 1)):
        spent, journal = weave(group, batch)
        name = f"a knot, groups of {group}, {batch} reports at once"
        print(f"{name:44s}{1e6 * spent:8.1f} us{spent / base:8.1f} times")
    programme = small_programme(rows=ROWS, columns=COLUMNS, heads=HEADS, yarns=12)
    begin = time.process_time()
    opened = open_journal(journal, programme)
    spent = time.process_time() - begin
    print(f"opening its journal of {len(journal):,} bytes, {opened.records:,} records: {spent:.2f} s")
    print("every run over small carpets: worlds, steps, openings")
    for rows, budget, group in (
        (2, Budget(crashes=2, commands=1), 1),
        (2, Budget(crashes=2, faults=1), 3),
        (2, Budget(crashes=1, commands=1, faults=1), 2),
        (4, Budget(crashes=3), 2),
    ):
        begin = time.process_time()
        model = Model(TinyProgramme(rows, ROW_ENDS), budget, group)
        worlds = model.explore()
        spent = time.process_time() - begin
        given = f"{rows} rows, groups of {group}, {budget.crashes} crashes, {budget.commands} commands"
        given = f"{given}, {budget.faults} faults"
        print(f"{given:56s}{worlds:10,}{model.steps:12,}{model.crashes:10,}{spent:8.1f} s", flush=True)
