"""The loom of an order: its parameters, its design for a chart, and its programme."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from functools import partial
from pathlib import Path
from types import MappingProxyType

from ilmek.carpet.chart import Chart
from ilmek.carpet.recipe.edits import located
from ilmek.errors import IlmekError, ParameterError
from ilmek.io.recipe_file import LoomKeys
from ilmek.jobs.chart import ChartResult
from ilmek.jobs.deadline import read_deadline
from ilmek.jobs.existing_loom import (
    ExistingLoom,
    carpet_checks,
    colours_check,
    for_rows,
    heads_used,
    lengthening,
    read_existing_loom,
    row_pitch_left,
    yarns_on,
)
from ilmek.jobs.loom_setup import CarpetPile, knots_saved, knotted_share, loom_setup
from ilmek.jobs.nearest import with_nearest
from ilmek.jobs.order import CarpetOrder
from ilmek.jobs.wishes import Wishes, heads_for_wishes, require_price
from ilmek.loom.bobbins import Bobbin
from ilmek.loom.operations import LoomSetup
from ilmek.loom.programme import Programme, make_programme
from ilmek.machines import hand_loom
from ilmek.machines.automated_loom import MACHINE, AutomatedLoomParams, LoomDesign, design, estimated_time
from ilmek.machines.automated_loom.carpet_cost import CarpetCost
from ilmek.machines.automated_loom.knotting import CAMS
from ilmek.machines.automated_loom.offers import branches
from ilmek.machines.automated_loom.report import analyse
from ilmek.machines.automated_loom.search import SearchJournal
from ilmek.machines.component import AnyComponent
from ilmek.machines.hand_loom import HandLoom
from ilmek.machines.weaver_hands import HAND
from ilmek.params import Params, Setting
from ilmek.progress import SILENT, Progress
from ilmek.report import BUILDABLE, Check, Report, Result, at_most, must
from ilmek.report.json import Json


@dataclass(frozen=True, slots=True)
class LoomOrder:
    """An order for a loom.

    params    parameters of the loom, as far as they are known without the picture
    wishes    number of heads, and time for the whole carpet
    settings  names of the parameters that the user set
    existing  the loom that exists; default: one is designed
    given     all that was set, by the options or the recipe
    """

    params: AutomatedLoomParams
    wishes: Wishes
    settings: tuple[str, ...] = ()
    existing: ExistingLoom | None = None
    given: LoomKeys = field(default_factory=LoomKeys)

    @property
    def deadline(self) -> float | None:
        """Time for the whole carpet [s]; None: any."""
        return self.wishes.deadline

    def as_dict(self) -> dict[str, Json]:
        """The order as plain data, SI."""
        wishes = self.wishes
        return {
            "heads": wishes.heads,
            "deadline": wishes.deadline,
            "warp_pitch": self.params.warp_pitch or self.params.quality.warp_pitch,
            "aim": self.params.aim,
            "loom_file": None if self.existing is None else str(self.existing.path),
        }


@dataclass(frozen=True, slots=True)
class LoomResult:
    """A loom for a chart, and the programme that weaves the chart on it; none where weavers tie.

    report   of the loom; without a design it has the reason as a failed check
    checks   of the loom for this chart: its deadline; of a loom that exists, what the carpet needs of it
    design, programme  None where the loom cannot be designed; no programme either where it exists and the carpet does
             not fit it
    setup    of the programme
    weaving_time       of the programme, or of the weavers [s]; None where there is neither
    row_pitch_left     distance of the rows that the beat leaves [m]; None without a design
    notes    on the use of a loom that exists
    hand     in the place of the design, where nothing of the loom is driven
    """

    report: Report
    checks: tuple[Check, ...]
    design: LoomDesign | None = None
    programme: Programme | None = None
    setup: LoomSetup | None = None
    row_pitch_left: float | None = None
    weaving_time: float | None = None
    notes: tuple[str, ...] = ()
    hand: HandLoom | None = None

    @property
    def made(self) -> LoomDesign | HandLoom | None:
        """The loom, with drives or without; None where it cannot be designed."""
        return self.hand or self.design

    @property
    def cost(self) -> CarpetCost | None:
        """The cost of the carpet; None without a loom."""
        if self.hand is not None:
            return hand_loom.analyse(self.hand).cost
        return None if self.design is None else analyse(self.design).cost


NO_PROGRAMME = "no programme: the weavers tie by the chart and its rows; the loom does the same after each row"
NO_DRIVES = "no programme: the weavers tie by the chart and its rows; nothing of the loom is driven"
BEATS_ALONE = "no programme: the weavers tie by the chart and its rows; the loom beats while all hold their buttons"

OF_THE_CARPET = {
    "width": "--size",
    "length": "--size",
    "knots_across": "--quality",
    "knots_along": "--quality",
    "knot": "--knot",
    "heads": "--heads",
    "deadline": "--deadline",
    "aim": "--aim",
    "warp_pitch": "--warp-pitch",
    "colours": "--colours",
    "knot_yarn": "--pile-height",
    "pile_height": "--pile-height",
    "yarns.pile_density": "--yarn-count",
    "changes_per_knot": "the picture",
    "knotted_share": "--shape",
}
"""Parameters of a loom that follow from the carpet, and the option that sets each."""


def read_loom_order(
    order: CarpetOrder,
    *,
    heads: int | None = None,
    deadline: str | None = None,
    aim: str | None = None,
    warp_pitch: Setting = None,
    loom: Mapping[str, Setting] = MappingProxyType({}),
    loom_file: Path | None = None,
) -> LoomOrder:
    """The order for a loom, from texts.

    loom       further parameters of the loom, by name
    loom_file  of a loom that exists; then only its `yarns.*` can be set, and fewer heads
    Raises ParameterError, UnitError, or LoomError if the quality does not fit the warp pitch or the file is no loom.
    """
    keys = _with_recipe(order, LoomKeys(deadline, heads, aim, warp_pitch, loom_file, loom))
    for name in keys.loom:
        if name in OF_THE_CARPET:
            raise ParameterError(f"{name} of the loom follows from the carpet", do=f"set it by {OF_THE_CARPET[name]}")
    limit = None if keys.deadline is None else read_deadline(keys.deadline)
    wishes = Wishes(keys.heads, limit)
    if keys.loom_file is not None:
        fixed = {"--aim": keys.aim, "--warp-pitch": keys.warp_pitch}
        existing = read_existing_loom(keys.loom_file, illustrated=True)
        return replace(_order_on(existing, wishes, keys.loom, fixed), given=keys)
    given = {"heads": keys.heads, "deadline": limit, "aim": keys.aim, "warp_pitch": keys.warp_pitch, **keys.loom}
    given = {name: value for name, value in given.items() if value is not None}
    params = AutomatedLoomParams.read({**_of_the_order(order), **given})
    return LoomOrder(params, replace(wishes, price=params.price_limit), tuple(given), given=keys)


def _with_recipe(order: CarpetOrder, given: LoomKeys) -> LoomKeys:
    """What is given, and beside it what the order's recipe sets of the loom; a loom that exists replaces its loom.

    Raises CarpetError, with file and line, for a setting of the recipe that no loom has.
    """
    of_recipe = order.loom
    if of_recipe.loom and of_recipe.loom_file is None:
        with located(of_recipe.where):
            AutomatedLoomParams.read(of_recipe.loom)
    exists = given.loom_file is not None
    return LoomKeys(
        of_recipe.deadline if given.deadline is None else given.deadline,
        of_recipe.heads if given.heads is None else given.heads,
        of_recipe.aim if given.aim is None and not exists else given.aim,
        of_recipe.warp_pitch if given.warp_pitch is None and not exists else given.warp_pitch,
        given.loom_file or of_recipe.loom_file,
        given.loom if exists else {**of_recipe.loom, **given.loom},
    )


def _of_the_order(order: CarpetOrder) -> dict[str, Setting]:
    """The loom's parameters that the order gives; the rest follow from the chart."""
    given: dict[str, Setting] = {}
    if order.size is not None:
        given |= {"width": order.size.width, "length": order.size.length}
    if order.quality is not None:
        given |= {"knots_across": order.quality.across, "knots_along": order.quality.along}
    if order.knot is not None:
        given["knot"] = order.knot
    return given


def _order_on(
    existing: ExistingLoom, wishes: Wishes, loom: Mapping[str, Setting], fixed: Mapping[str, Setting]
) -> LoomOrder:
    """The order for a loom that exists. Raises ParameterError for what cannot be set of it."""
    for option, value in fixed.items():
        if value is not None:
            raise ParameterError(f"{option} is given beside {existing.path}", do=f"the loom exists: leave {option} out")
    most = existing.design.heads
    if wishes.heads is not None and not 1 <= wishes.heads <= most:
        raise ParameterError(f"{wishes.heads} heads", allowed=f"{existing.path} has {most}", do="give fewer")
    params = replace(existing.design.params, yarns=yarns_on(existing, loom))
    return LoomOrder(params, wishes, tuple(loom), existing)


def make_loomed(
    loom_order: LoomOrder,
    charted: ChartResult,
    progress: Progress = SILENT,
    *,
    illustrated: bool = True,
    assembled: bool = True,
) -> LoomResult:
    """The loom for a chart, with the number of heads required, and its programme.

    illustrated  False: the report of a loom that is designed has no tables and figures
    assembled    False: nor its parts against each other in space, by which a beat that was left open may be exchanged
    A loom that cannot be designed is a result without design, with the reason as a failed check.
    Raises ParameterError for wishes that contradict each other, and the errors of a design that only settings prevent.
    """
    chart, params = charted.chart, params_for(loom_order, charted)
    reported = partial(MACHINE.report, illustrated=illustrated, assembled=assembled)
    if loom_order.existing is not None:
        return _on_existing(loom_order, loom_order.existing, charted, progress)
    try:
        carpet = CarpetPile(chart, charted.knot_yarns)
        if (by_hand := MACHINE.variant(params)) is not None:
            return _by_hand(*by_hand, chart, illustrated=illustrated, assembled=assembled)
        if params.knotting == HAND:
            return _for_weavers(params, chart, reported, progress, assembled=assembled)
        made, choices = heads_for_wishes(params, loom_order.wishes, carpet, progress.part(0.0, 0.7))
        if assembled:
            made = MACHINE.with_room(made, replace(params, heads=made.heads))
        colours = () if made.params.tubes is None else (colours_check(chart, made.heads, made.params),)
        if any(not check.ok for check in colours):
            report = with_nearest(reported(made), params, progress.part(0.7, 1.0))
            return LoomResult(report, colours, made, row_pitch_left=made.beat.row_pitch_left)
        programme = _programme(made, carpet, made.heads, made.bobbins, progress.part(0.7, 0.9, "programme"))
    except IlmekError as error:
        if loom_order.settings and _can_be_designed(_without_settings(params)):
            raise
        return LoomResult(with_nearest(_without_design(params, error), params, progress.part(0.7, 1.0)), ())
    report = reported(made)
    report = replace(report, choices=(*choices, *report.choices))
    report = with_nearest(report, params, progress.part(0.9, 1.0))
    require_price(loom_order.wishes, params, made, report, programme.duration)
    left = made.beat.row_pitch_left
    checks = (*colours, *deadline_checks(loom_order.deadline, programme.duration))
    setup = loom_setup(made, carpet, programme)
    return LoomResult(report, checks, made, programme, setup, left, programme.duration)


def _by_hand(machine: AnyComponent, params: Params, chart: Chart, *, illustrated: bool, assembled: bool) -> LoomResult:
    """The hand loom: its report has the check of the deadline."""
    loom: HandLoom = machine.designed(params)
    report = machine.report(loom, illustrated=illustrated, assembled=assembled)
    time, left = loom.rows * loom.row_time, float(loom.beat.row_pitch_left)
    time -= knots_saved(chart, loom.weavers, loom.params.knotted_share) * loom.params.hand_knot
    notes = (NO_DRIVES if loom.drive is None else BEATS_ALONE,)
    return LoomResult(report, (), hand=loom, row_pitch_left=left, weaving_time=time, notes=notes)


def _for_weavers(
    params: AutomatedLoomParams,
    chart: Chart,
    reported: Callable[[LoomDesign], Report],
    progress: Progress,
    *,
    assembled: bool,
) -> LoomResult:
    """The loom at which weavers tie; the check of its deadline says how many it needs."""
    made = design(params)
    if assembled:
        made = MACHINE.with_room(made, params)
    report = with_nearest(reported(made), params, progress)
    left, time = made.beat.row_pitch_left, estimated_time(made)
    time -= knots_saved(chart, made.weavers, made.params.knotted_share) * made.times.knot
    return LoomResult(report, (), made, row_pitch_left=left, weaving_time=time, notes=(NO_PROGRAMME,))


def _on_existing(loom_order: LoomOrder, existing: ExistingLoom, charted: ChartResult, progress: Progress) -> LoomResult:
    """The loom that exists, with what the chart needs of it as checks; a programme where it fits."""
    chart, yarns = charted.chart, params_for(loom_order, charted).yarns
    heads = min(heads_used(existing, chart), loom_order.wishes.heads or existing.design.heads)
    checks = carpet_checks(existing, chart, heads, yarns, max(charted.knot_yarns))
    row_pitch = lengthening(existing, yarns) / chart.quality.along
    made, left = for_rows(existing, row_pitch), row_pitch_left(existing, row_pitch)
    if not all(check.ok for check in checks):
        return LoomResult(existing.report, checks, made, row_pitch_left=left)
    if made.weavers:
        time = made.head.least_time(chart.rows, chart.columns, made.weavers, made.times, made.bobbins)
        time -= knots_saved(chart, made.weavers) * made.times.knot
        checks = (*checks, *deadline_checks(loom_order.deadline, time))
        return LoomResult(existing.report, checks, made, row_pitch_left=left, weaving_time=time, notes=(NO_PROGRAMME,))
    notes = (f"{heads} of the loom's {made.heads} heads are used; the others are parked",) if heads < made.heads else ()
    carpet = CarpetPile(chart, charted.knot_yarns)
    bobbins = made.weft.bobbins_for(2 * chart.columns + made.params.selvedge_warps, yarns)
    programme = _programme(made, carpet, heads, bobbins, progress.part(0.0, 1.0, "programme"))
    checks = (*checks, *deadline_checks(loom_order.deadline, programme.duration))
    setup = loom_setup(made, carpet, programme)
    return LoomResult(existing.report, checks, made, programme, setup, left, programme.duration, notes)


def _programme(
    made: LoomDesign, carpet: CarpetPile, heads: int, bobbins: tuple[Bobbin, ...], progress: Progress
) -> Programme:
    chart, params = carpet.chart, made.params
    return make_programme(
        chart.knots,
        len(chart.yarns),
        heads,
        made.times,
        bobbins=bobbins,
        supply=carpet.supply(params),
        tube_change=params.tube_change,
        progress=progress,
    )


def params_for(loom_order: LoomOrder, charted: ChartResult) -> AutomatedLoomParams:
    """The parameters of the loom with what follows from the chart: size, quality, knot, colours, changes, pile yarn."""
    chart = charted.chart
    heaviest = max(yarn.linear_density for yarn in chart.yarns)
    return replace(
        loom_order.params,
        width=chart.size.width,
        length=chart.size.length,
        knots_across=chart.quality.across,
        knots_along=chart.quality.along,
        knot=chart.knot,
        yarns=replace(loom_order.params.yarns, pile_density=heaviest),
        colours=chart.colours,
        knot_yarn=max(charted.knot_yarns),
        pile_height=charted.highest.pile_height,
        changes_per_knot=min(1.0, chart.changes_per_knot),
        knotted_share=knotted_share(chart),
    )


def deadline_checks(deadline: float | None, time: float) -> tuple[Check, ...]:
    """The check of a weaving time [s] against the deadline [s], if one is given."""
    if deadline is None:
        return ()
    cure = "give more time, more heads, or a coarser quality"
    return (at_most("weaving time", time, deadline, "h", "the deadline given").with_cure(cure),)


def _without_settings(params: AutomatedLoomParams) -> AutomatedLoomParams:
    """The parameters that follow from the carpet alone."""
    names = ("width", "length", "knots_across", "knots_along", "knot", "colours", "knot_yarn", "pile_height",
             "changes_per_knot", "knotted_share")  # fmt: skip
    yarns = replace(AutomatedLoomParams().yarns, pile_density=params.yarns.pile_density)
    return AutomatedLoomParams(yarns=yarns, **{name: getattr(params, name) for name in names})


def _can_be_designed(params: AutomatedLoomParams) -> bool:
    """Whether there is a loom to choose, good or not: the slowest one with some carrier of the weft and some beat."""
    try:
        return any(branch.looms for branch in branches(params, CAMS, SearchJournal()))
    except IlmekError:
        return False


def _without_design(params: AutomatedLoomParams, error: IlmekError) -> Report:
    """The report of a loom that cannot be designed: its parameters, and the reason as a failed check."""
    cure = "; ".join(part for part in (error.allowed, error.do) if part)
    check = must("the loom can be designed", False, error.given).with_cure(cure or "take another quality, size or knot")
    results = (
        Result("weaves", False, "", "every check of the loom and of its machines holds"),
        Result(BUILDABLE, False, "", "the parts of the loom make one machine"),
        Result("row_pitch_left", None, "mm", "distance of the rows that the beat leaves; null: no loom"),
    )
    headline = tuple(result.name for result in results)
    return Report(MACHINE.name, MACHINE.title, params.as_dict(), results, (check,), headline=headline)
