"""Maintenance of a loom: lives of what wears, lubrication, spare parts.

years = life / use in a year        pieces to keep = n (ceil(years of the loom / years) - 1)
f = sqrt(share of the tension)      of a belt's frequency when it is set [`commissioning`]
t = 10 (14e6 / (n sqrt(d)) - 4 d)   hours between two greasings of a ball bearing of the bore d [mm] at n [1/min],
at most 3 years: the grease ages                 [makers of bearings; SKF, 1989]
a guide or ball screw is greased each 100 km of travel                               [makers of guides]
"""

import math
from collections.abc import Iterator

from ilmek.elements.bearing_table import RollingBearing
from ilmek.machines.automated_loom.design import LoomDesign
from ilmek.machines.automated_loom.in_space.scene import loom_tree
from ilmek.machines.automated_loom.papers.commissioning import belts
from ilmek.machines.automated_loom.papers.values import YearOfWork, known, value_of, year_of_work
from ilmek.machines.warp_tension.cylinders import cylinders
from ilmek.machines.weaver.carriage_guide import life as guide_life
from ilmek.machines.weaver.knife import KNIFE
from ilmek.machines.weaver.parts import bearing_life
from ilmek.machines.weaver.tree import carriage_guide, head_mass
from ilmek.machines.weft.carriers import WEFT_CUTTER
from ilmek.part.blanks import size_of
from ilmek.part.tree import Tree
from ilmek.records import record
from ilmek.report import Column, Paper, PaperSection, Report, Table
from ilmek.sentences import Sentence
from ilmek.units import day, format_quantity, hour, mm, rpm, turn

YEAR = 365.25 * day

GREASE_AGES = 3 * YEAR
"""After which grease is changed however little a bearing turns; assumed by this project."""

TRAVEL = 100e3
"""Travel between two greasings of a guide or a ball screw [m]: makers say 100 km, or half a year."""

SLACK = 0.8
"""Share of its tension at which a belt is tightened again; assumed by this project."""

WEARING = frozenset(("belt", "belt and pulleys", "spring", "yarn brake"))
"""Processes of parts that wear, and of which no life is computed: a set is kept."""


@record
class Wear:
    """A part that wears.

    title  for people        designation  of its catalogue      number  of it in the loom
    life   in `unit`: turns, strokes or metres                  use     of them in a year
    """

    title: str
    designation: str
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
    cams = loom.shedding
    shafts, seat = len(cams.shafts), cams.shaft.seat
    title, row = Sentence("wear.shed-bearing"), cams.shafts[0].seat.bearing
    yield Wear(title, row.name, 2 * shafts, seat.life * cams.params.speed / turn, year.rows, "turns")
    lives, radius = value_of(report, "warp_tension.bearing_life"), value_of(report, "warp_tension.outer_radius")
    for name, (title, row) in _cylinder_bearings(loom).items():
        around = turn * (value_of(report, "warp_tension.spacer_radius") if name == "spacer" else radius)
        use = year.rows * loom.task.cloth.row_distance / around
        yield Wear(title, row.name, 2, lives[name], use, "turns")
    nut = known(report, "hammer.screw_life")
    if nut is not None:
        strokes = nut / value_of(report, "cycle_time_row") * value_of(report, "beat_strokes") * 2
        thick = format_quantity(value_of(report, "hammer.screw_diameter"), "mm")
        use = 2 * year.rows * value_of(report, "beat_strokes")
        yield Wear(Sentence("wear.screw-nut"), thick, value_of(report, "hammer.axes"), strokes, use, "strokes")
    if loom.heads:
        yield from _of_heads(loom, year)


def _of_heads(loom: LoomDesign, year: YearOfWork) -> Iterator[Wear]:
    head = loom.weaver
    row, turns = bearing_life(head)
    if row is not None:
        yield Wear(Sentence("wear.head-bearing"), row.name, 2 * loom.heads, turns, year.knots, "turns")
    guide = carriage_guide(head)
    travel = 2 * loom.knot_pitch * year.knots
    lasts = guide_life(head, head_mass(head), guide)
    yield Wear(Sentence("wear.head-guide"), guide.name, loom.heads, lasts, travel, "m")


def greasings(loom: LoomDesign, report: Report, year: YearOfWork) -> Iterator[tuple[str, str, float]]:
    """What is greased, by which rule, and the time between two greasings [s], while the loom weaves all the year."""
    cams, rule, slow = loom.shedding, Sentence("grease.bearing-rule"), _slow(loom, report)
    greased = [(Sentence("wear.shed-bearing"), cams.shafts[0].seat.bearing, cams.params.speed)]
    greased += [(title, row, slow) for title, row in _cylinder_bearings(loom).values()]
    for title, row, speed in greased:
        yield title, rule, min(bearing_greasing(row.bore, speed), GREASE_AGES)
    by_travel, beats = Sentence("grease.travel-rule", travel=format_quantity(TRAVEL, "km")), 2 * year.rows
    travels = [(Sentence("grease.carrier"), 2 * (2 if loom.weft.passage.back else 1) * loom.weft.passage.stroke / 2)]
    if known(report, "hammer.screw_life") is not None:
        travels.append(
            (Sentence("wear.screw-nut"), 2 * value_of(report, "beat_stroke") * value_of(report, "beat_strokes"))
        )
    yield from ((title, by_travel, min(TRAVEL / (beats * each) * YEAR, GREASE_AGES)) for title, each in travels)
    if loom.heads:
        along = 2 * loom.knot_pitch * year.knots
        yield Sentence("wear.head-guide"), by_travel, min(TRAVEL / along * YEAR, GREASE_AGES)


def _cylinder_bearings(loom: LoomDesign) -> dict[str, tuple[Sentence, RollingBearing]]:
    """Title and row of the bearings of each cylinder, as they are on its brackets."""
    return {
        cylinder.name: (Sentence(f"wear.{cylinder.name}-bearing"), cylinder.seat.bearing)
        for cylinder in cylinders(loom.warp_tension)
    }


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
        (one.title, one.designation, one.number, one.life, units[one.unit], one.use, one.years) for one in wears
    )
    return Table("lives", Sentence("maintenance.lives"), heads, rows)


def _grease(loom: LoomDesign, report: Report, year: YearOfWork) -> Table:
    heads = (
        Column(Sentence("maintenance.part")),
        Column(Sentence("maintenance.rule")),
        Column(Sentence("maintenance.every"), "day", 3),
    )
    return Table("grease", Sentence("maintenance.grease"), heads, tuple(greasings(loom, report, year)))


def _belts(loom: LoomDesign) -> PaperSection:
    """The frequency of each belt's span as it is set, and that below which it is set again."""
    heads = (
        Column(Sentence("maintenance.part")),
        Column(Sentence("maintenance.designation")),
        Column(Sentence("maintenance.set"), "Hz", 3),
        Column(Sentence("maintenance.least"), "Hz", 3),
    )
    rows = tuple((title, row, hertz, math.sqrt(SLACK) * hertz) for title, hertz, row in belts(loom))
    title, how = Sentence("setting.belts"), Sentence("maintenance.belts-how", share=f"{SLACK:.0%}")
    return PaperSection(title, (how,), Table("belts", title, heads, rows), boxes=True)


def _spares(loom: LoomDesign, wears: tuple[Wear, ...], year: YearOfWork) -> Table:
    """What is replaced within the years of the loom, and a set of what wears without a computed life."""
    computed = (
        (one.title, one.designation, one.spare(year.years), Sentence("maintenance.by-life"))
        for one in wears
        if one.spare(year.years)
    )
    return _kept((*computed, *worn_sets(loom_tree(loom), max(loom.heads, 1))))


def worn_sets(tree: Tree, alike: int = 1) -> Iterator[tuple[str, str, int, str]]:
    """A set for one of some machines that are alike, of what wears and has no computed life."""
    for part, number in tree.occurrences():
        if part.process in WEARING or part.id in (KNIFE, WEFT_CUTTER):
            yield (
                part.title,
                part.purchase.row if part.purchase else size_of(part),
                max(1, number // alike),
                Sentence("maintenance.by-set"),
            )


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
