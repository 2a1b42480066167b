"""Tables of a loom's connections: inputs of the modules, terminals, channels of 24 V, cables."""

import math
from collections.abc import Iterator, Sequence

from ilmek.machines.automated_loom.design import LoomDesign
from ilmek.machines.automated_loom.equipment import signals
from ilmek.machines.automated_loom.equipment.power_plan import PROTECTED, PowerPlan
from ilmek.machines.automated_loom.equipment.terminals import TerminalLevel
from ilmek.machines.automated_loom.in_space.scene import loom_tree
from ilmek.machines.automated_loom.papers.cables import INSIDE, SPARE, cables
from ilmek.machines.automated_loom.papers.wiring import (
    SIGNS,
    Channel,
    channels,
    levels_of,
    numbers_of,
    run_of,
    safety_signs,
    signs_of,
)
from ilmek.report import Column, PaperSection, Table
from ilmek.sentences import Sentence
from ilmek.units import format_quantity


def channel_tables(loom: LoomDesign) -> Iterator[PaperSection]:
    """A row for each run of inputs of a module that read pieces of one sensor."""
    titles, numbers = {part.id: part.title for part, _ in loom_tree(loom).occurrences()}, numbers_of(loom)
    signs, runs = {**SIGNS, **signs_of(loom), **safety_signs(loom)}, dict[tuple[str, str, str], list[Channel]]()
    for own in channels(loom):
        runs.setdefault((own.module, own.signal.partition("[")[0], own.part), []).append(own)
    rows = tuple(
        (
            module,
            run_of([own.number for own in run]),
            signs.get(name, ""),
            titles[name],
            _pieces(run, numbers[name]),
            run_of([own.signal for own in run]),
        )
        for (module, _, name), run in runs.items()
    )
    heads = (
        Column(Sentence("electric.module")),
        Column(Sentence("electric.inputs")),
        Column(Sentence("electric.sign")),
        Column(Sentence("electric.device")),
        Column(Sentence("electric.piece")),
        Column(Sentence("electric.signal")),
    )
    title = Sentence("electric.channels")
    if rows:
        yield PaperSection(title, (Sentence("electric.channels-how"),), Table("channels", title, heads, rows))


def _pieces(run: Sequence[Channel | TerminalLevel], number: int) -> str:
    """The pieces of a device in a run of wires, in words; number  of all."""
    pieces = sorted({own.piece for own in run} - {0})
    return run_of(pieces) if pieces else "1" if number == 1 else Sentence("electric.in-series")


def strip_table(loom: LoomDesign) -> PaperSection:
    """A row for each run of terminals of a device."""
    titles, numbers = {part.id: part.title for part, _ in loom_tree(loom).occurrences()}, numbers_of(loom)
    runs = dict[tuple[str, str], list[TerminalLevel]]()
    for level in levels_of(loom):
        runs.setdefault((level.strip, level.part), []).append(level)
    rows = [
        (SIGNS[signals.MAINS_TERMINAL], "1 … 5", "L1, L2, L3, N, PE", titles[signals.SWITCH], SIGNS[signals.SWITCH])
    ]
    for (strip, part), run in runs.items():
        ends = dict.fromkeys(f"{own.number}{own.level}" for own in (run[0], run[-1]))
        whats = dict[str, list[str]]()
        for own in run:
            whats.setdefault(own.what.partition("[")[0], []).append(own.what)
        wires = ", ".join(run_of(list(dict.fromkeys(same))) for same in whats.values())
        pieces = _pieces(run, numbers[part])
        rows.append((strip, " … ".join(ends), wires, titles[part], pieces))
    heads = (
        Column(Sentence("electric.strip")),
        Column(Sentence("electric.terminals-of")),
        Column(Sentence("electric.wires")),
        Column(Sentence("electric.device")),
        Column(Sentence("electric.piece")),
    )
    title = Sentence("electric.strips")
    return PaperSection(title, (Sentence("electric.strips-how"),), Table("strips", title, heads, tuple(rows)))


_GROUPS = {
    "coils": Sentence("electric.coils"),
    "safety": Sentence("electric.safety-group"),
    "sensors": Sentence("electric.sensors-group"),
    "control": Sentence("electric.control"),
}


def protected_table(plan: PowerPlan) -> PaperSection:
    """The channels of the protector of 24 V, with what each feeds."""
    rows = tuple(
        (f"{SIGNS[signals.PROTECTOR]}.{number}", _GROUPS[group], current, PROTECTED)
        for number, (group, current) in enumerate(plan.protected, 1)
    )
    heads = (
        Column(Sentence("electric.channel")),
        Column(Sentence("electric.group")),
        Column(Sentence("electric.current"), "", 3),
        Column(Sentence("electric.rating"), "", 3),
    )
    title = Sentence("electric.protected")
    return PaperSection(title, (Sentence("electric.protected-how"),), Table("protected", title, heads, rows))


def cable_table(loom: LoomDesign) -> PaperSection:
    """Every cable that leaves the cabinet, with its length."""
    rows = tuple(
        (f"W{number}", own.start, own.end, len(own.lengths), own.words, max(own.lengths), math.fsum(own.lengths))
        for number, own in enumerate(cables(loom), 1)
    )
    heads = (
        Column(Sentence("electric.sign")),
        Column(Sentence("electric.from")),
        Column(Sentence("electric.to")),
        Column(Sentence("electric.pieces")),
        Column(Sentence("electric.cable")),
        Column(Sentence("electric.longest"), "m", 3),
        Column(Sentence("electric.whole-length"), "m", 3),
    )
    title = Sentence("electric.cables")
    how = Sentence("electric.cables-how", spare=f"{SPARE:.0%}", inside=format_quantity(INSIDE, "m"))
    return PaperSection(title, (how,), Table("cables", title, heads, rows))
