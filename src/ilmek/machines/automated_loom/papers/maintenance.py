"""Maintenance of a loom: lives of what wears, lubrication, spare parts.

years = life / use in a year        pieces to keep = n (ceil(years of the loom / years) - 1)
f = sqrt(share of the tension)      of a belt's frequency when it is set [`commissioning`]
t = 10 (14e6 / (n sqrt(d)) - 4 d)   hours between two greasings of a ball bearing of the bore d [mm] at n [1/min],
at most 3 years: the grease ages                 [makers of bearings; SKF, 1989]
a guide or ball screw is greased each 100 km of travel                               [makers of guides]
"""

import math
from collections.abc import Iterator

from ilmek.machines.automated_loom.design import LoomDesign
from ilmek.machines.automated_loom.frame import part_id
from ilmek.machines.automated_loom.in_space.scene import loom_tree
from ilmek.machines.automated_loom.papers.commissioning import belts
from ilmek.machines.automated_loom.papers.values import YearOfWork, known, value_of, year_of_work
from ilmek.machines.hammer.tree import AXIS as HAMMER_AXIS
from ilmek.machines.shedding.stack import part_id as shedding_part
from ilmek.machines.warp_tension.cylinders import LOWER, SPACER, UPPER, cylinders
from ilmek.machines.warp_tension.cylinders import part_id as cylinder_part
from ilmek.machines.weaver.carriage_guide import GUIDE_CARRIAGE
from ilmek.machines.weaver.carriage_guide import life as guide_life
from ilmek.machines.weaver.knife import KNIFE
from ilmek.machines.weaver.parts import BEARING as HEAD_BEARING
from ilmek.machines.weaver.parts import bearing_life
from ilmek.machines.weaver.tree import carriage_guide, head_mass
from ilmek.machines.weft.carriers import AXIS as WEFT_AXIS
from ilmek.machines.weft.carriers import WEFT_CUTTER
from ilmek.part.blanks import size_of
from ilmek.part.part import Part
from ilmek.part.part_lists import BELTS
from ilmek.part.tree import Tree
from ilmek.records import record
from ilmek.report import Column, Paper, PaperSection, Report, Table
from ilmek.sentences import Sentence
from ilmek.units import day, format_quantity, hour, mm, rpm, turn

YEAR = 365.25 * day

CYLINDERS = UPPER, LOWER, SPACER
"""Names of the warps' cylinders."""

RAIL_GUIDE, RETREAT_AXIS = part_id("rail-guide"), part_id("retreat-axis")
"""Ids of parts."""

GREASE_AGES = 3 * YEAR
"""After which grease is changed however little a bearing turns; assumed by this project."""

TRAVEL = 100e3
"""Travel between two greasings of a guide or a ball screw [m]: makers say 100 km, or half a year."""

SLACK = 0.8
"""Share of its tension at which a belt is tightened again; assumed by this project."""

WEARING = BELTS | {"spring", "yarn brake"}
"""Processes of parts that wear, and of which no life is computed: a set is kept."""


@record
class Wear:
    """A part that wears, and its pieces in the loom.

    life   in `unit`: turns, strokes or metres                  use     of them in a year
    """

    part: Part
    number: int
    life: float
    use: float
    unit: str

    @property
    def years(self) -> float:
        """Years that it lasts."""
        return self.life / self.use if self.use > 0 else math.inf

    def spare(self, years: float) -> int:
        """Pieces that are replaced within the years of the loom."""
        return self.number * max(0, math.ceil(years / self.years - 1e-9) - 1)


def wearing_parts(loom: LoomDesign, report: Report, year: YearOfWork) -> Iterator[Wear]:
    """The parts of which a life is computed, each with its use in a year."""
    parts = {part.id: (part, number) for part, number in loom_tree(loom).occurrences()}
    lasting = ((name, *lasts) for name, lasts in _lasting(loom, report, year) if name in parts)
    return (Wear(*parts[name], life, use, unit) for name, life, use, unit in lasting)


def _lasting(loom: LoomDesign, report: Report, year: YearOfWork) -> Iterator[tuple[str, tuple[float, float, str]]]:
    """Id of a part, its life and its use in a year, and their unit."""
    cams = loom.shedding
    for index in range(len(cams.shafts)):
        yield shedding_part("bearing", index), (cams.shaft.seat.life * cams.params.speed / turn, year.rows, "turns")
    lives, radius = value_of(report, "warp_tension.bearing_life"), value_of(report, "warp_tension.outer_radius")
    for name in CYLINDERS:
        around = turn * (value_of(report, "warp_tension.spacer_radius") if name == SPACER else radius)
        yield (
            cylinder_part(f"{name}-bearing"),
            (lives[name], year.rows * loom.task.cloth.row_distance / around, "turns"),
        )
    nut = known(report, "hammer.screw_life")
    if nut is not None:
        strokes = nut / value_of(report, "cycle_time_row") * value_of(report, "beat_strokes") * 2
        yield HAMMER_AXIS, (strokes, 2 * year.rows * value_of(report, "beat_strokes"), "strokes")
    if loom.heads:
        head = loom.weaver
        row, turns = bearing_life(head)
        if row is not None:
            yield HEAD_BEARING, (turns, year.knots, "turns")
        lasts = guide_life(head, head_mass(head), carriage_guide(head))
        yield GUIDE_CARRIAGE, (lasts, 2 * loom.knot_pitch * year.knots, "m")


@record
class Greasing:
    """How a part is lubricated: the rule in words, time between two times [s]."""

    part: Part
    number: int
    rule: str
    every: float


def greasings(loom: LoomDesign, report: Report, year: YearOfWork) -> Iterator[Greasing]:
    """Every bearing, guide, axis, reducer and chain of the tree, while the loom weaves all the year."""
    speeds, travels = _speeds(loom, report), dict(_travels(loom, report, year))
    for part, number in loom_tree(loom).occurrences():
        if part.process not in GREASED:
            continue
        key, every = GREASED[part.process]
        if part.id in speeds:
            key, every = "grease.bearing-rule", min(bearing_greasing(*speeds[part.id]), GREASE_AGES)
        elif part.id in travels:
            key, every = "grease.travel-rule", min(TRAVEL / travels[part.id] * YEAR, GREASE_AGES)
        sizes = {"travel": format_quantity(TRAVEL, "km")}
        if part.id in speeds:
            sizes["turning"] = format_quantity(bearing_greasing(*speeds[part.id]), "h", 3)
        yield Greasing(part, number, Sentence(key, **sizes), every)


GREASED = {
    "bearing": ("grease.sealed", GREASE_AGES),
    "linear axis": ("grease.half-year", YEAR / 2),
    "linear guide": ("grease.half-year", YEAR / 2),
    "guide carriage": ("grease.half-year", YEAR / 2),
    "reducer": ("grease.reducer", YEAR),
    "energy chain": ("grease.dry", YEAR / 2),
}
"""Rule and time [s] of a part whose speed or travel is not computed, by its process; assumed by this project."""


def _speeds(loom: LoomDesign, report: Report) -> dict[str, tuple[float, float]]:
    """Bore [m] and speed of bearings by their ids [rad/s]."""
    cams, slow = loom.shedding, _slow(loom, report)
    turning = {shedding_part("bearing", index): cams.params.speed for index in range(len(cams.shafts))}
    bores = {name: cams.shafts[index].seat.bearing.bore for index, name in enumerate(turning)}
    return {name: (bores[name], speed) for name, speed in turning.items()} | {
        cylinder_part(f"{own.name}-bearing"): (own.seat.bearing.bore, slow) for own in cylinders(loom.warp_tension)
    }


def _travels(loom: LoomDesign, report: Report, year: YearOfWork) -> Iterator[tuple[str, float]]:
    """Travel in a year of guides and axes by their ids [m]."""
    passage = loom.weft.passage
    yield WEFT_AXIS, 2 * year.rows * 2 * (2 if passage.back else 1) * passage.stroke / 2
    if known(report, "hammer.screw_life") is not None:
        beats = 2 * year.rows * value_of(report, "beat_strokes")
        yield HAMMER_AXIS, 2 * beats * value_of(report, "beat_stroke")
    if loom.heads:
        along = 2 * loom.knot_pitch * year.knots
        yield from ((GUIDE_CARRIAGE, along), (RAIL_GUIDE, along))
        yield RETREAT_AXIS, 2 * year.rows * value_of(report, "head_retreat")


def bearing_greasing(bore: float, speed: float) -> float:
    """Time between two greasings of a ball bearing of a bore [m] at a speed [rad/s] [s]; 0 where it is too quick.

    >>> round(bearing_greasing(25e-3, 1000 * 2 * math.pi / 60) / 3600)
    27000
    """
    return max(0.0, 10 * (14e6 / (speed / rpm * math.sqrt(bore / mm)) - 4 * bore / mm)) * hour


def _slow(loom: LoomDesign, report: Report) -> float:
    """Mean speed of the warp cylinders [rad/s]."""
    speed: float = (
        loom.task.cloth.row_distance / value_of(report, "warp_tension.outer_radius") / value_of(report, "row_time")
    )
    return speed


def maintenance(loom: LoomDesign, report: Report) -> Paper:
    """Lives, lubrication, spare parts."""
    year = year_of_work(loom, report)
    wears = tuple(wearing_parts(loom, report, year))
    work = Sentence("maintenance.work", rows=f"{year.rows:.0f}", knots=f"{year.knots:.0f}", years=f"{year.years:g}")
    return Paper(
        "maintenance",
        Sentence("maintenance.title"),
        Sentence("maintenance.lead"),
        (
            PaperSection(Sentence("maintenance.lives"), (work, Sentence("maintenance.lives-how")), _lives(wears)),
            PaperSection(
                Sentence("maintenance.grease"), (Sentence("maintenance.grease-how"),), _grease(loom, report, year)
            ),
            *([_belts(loom)] if loom.heads else []),
            PaperSection(
                Sentence("maintenance.spares"), (Sentence("maintenance.spares-how"),), _spares(loom, wears, year)
            ),
        ),
    )


def _lives(wears: tuple[Wear, ...]) -> Table:
    heads = (
        Column(Sentence("maintenance.part")),
        Column(Sentence("maintenance.designation")),
        Column(Sentence("maintenance.number")),
        Column(Sentence("maintenance.life")),
        Column(Sentence("maintenance.unit")),
        Column(Sentence("maintenance.use")),
        Column(Sentence("maintenance.years")),
    )
    units = {
        "turns": Sentence("maintenance.turns"),
        "strokes": Sentence("maintenance.strokes"),
        "m": Sentence("maintenance.metres"),
    }
    rows = tuple(
        (own.part.title, designation(own.part), own.number, own.life, units[own.unit], own.use, own.years)
        for own in wears
    )
    return Table("lives", Sentence("maintenance.lives"), heads, rows)


def designation(part: Part) -> str:
    """As a part is ordered, in the words of `purchase`; of one that is made its size."""
    return (part.designation or part.process) if part.purchase else size_of(part)


def _grease(loom: LoomDesign, report: Report, year: YearOfWork) -> Table:
    heads = (
        Column(Sentence("maintenance.part")),
        Column(Sentence("maintenance.designation")),
        Column(Sentence("maintenance.number")),
        Column(Sentence("maintenance.rule")),
        Column(Sentence("maintenance.every"), "day", 3),
    )
    rows = (
        (own.part.title, designation(own.part), own.number, own.rule, own.every)
        for own in greasings(loom, report, year)
    )
    return Table("grease", Sentence("maintenance.grease"), heads, tuple(rows))


def _belts(loom: LoomDesign) -> PaperSection:
    """Of each belt its tension and the frequency of a span as it is set, and that below which it is set again."""
    heads = (
        Column(Sentence("maintenance.part")),
        Column(Sentence("maintenance.designation")),
        Column(Sentence("maintenance.number")),
        Column(Sentence("maintenance.tension"), "N", 3),
        Column(Sentence("maintenance.set"), "Hz", 3),
        Column(Sentence("maintenance.least"), "Hz", 3),
    )
    spans, rows = {span.part: span for span in belts(loom)}, list[tuple[str | int | float, ...]]()
    for part, number in loom_tree(loom).occurrences():
        if part.process in BELTS and not (part.purchase and part.purchase.piece_of):
            span = spans.get(part.id)
            set_to = (math.nan, math.nan) if span is None else (span.tension, span.frequency)
            rows.append((part.title, designation(part), number, *set_to, math.sqrt(SLACK) * set_to[1]))
    title, how = Sentence("setting.belts"), Sentence("maintenance.belts-how", share=f"{SLACK:.0%}")
    return PaperSection(title, (how,), Table("belts", title, heads, tuple(rows)), boxes=True)


def _spares(loom: LoomDesign, wears: tuple[Wear, ...], year: YearOfWork) -> Table:
    """What is replaced within the years of the loom, and a set of what wears without a computed life."""
    computed = (
        (wear.part.title, designation(wear.part), wear.spare(year.years), Sentence("maintenance.by-life"))
        for wear in wears
        if wear.spare(year.years)
    )
    return _kept((*computed, *worn_sets(loom_tree(loom), max(loom.heads, 1))))


def worn_sets(tree: Tree, alike: int = 1) -> Iterator[tuple[str, str, int, str]]:
    """A set for one of some machines that are alike, of what wears and has no computed life."""
    for part, number in tree.occurrences():
        whole = part.purchase is None or not part.purchase.piece_of
        if whole and (part.process in WEARING or part.id in (KNIFE, WEFT_CUTTER)):
            yield part.title, designation(part), max(1, number // alike), Sentence("maintenance.by-set")


def spares_of(tree: Tree) -> Paper | None:
    """The maintenance of a machine of which no use in a year is known: what wears; None where nothing does."""
    rows = tuple(worn_sets(tree))
    title, lead = Sentence("maintenance.title"), Sentence("maintenance.spares")
    return Paper("maintenance", title, lead, (PaperSection(lead, (), _kept(rows)),)) if rows else None


def _kept(rows: tuple[tuple[float | int | str, ...], ...]) -> Table:
    heads = (
        Column(Sentence("maintenance.part")),
        Column(Sentence("maintenance.designation")),
        Column(Sentence("maintenance.keep")),
        Column(Sentence("maintenance.why")),
    )
    return Table("spares", Sentence("maintenance.spares"), heads, rows)
