"""What is reported of an automated loom beside its machines: time, beat, parts, energy, checks of the whole."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from functools import lru_cache

import numpy as np

from ilmek.carpet.pile import pile_check
from ilmek.machines.automated_loom.brackets import bracket_checks, brackets_of
from ilmek.machines.automated_loom.carpet_cost import CarpetCost
from ilmek.machines.automated_loom.choice import deadline_check, row_check, weavers_deadline_check, weavers_needed
from ilmek.machines.automated_loom.cloth_clearances import HORIZON, cloth_checks, cloth_clearances, cloth_table
from ilmek.machines.automated_loom.cost import carpet_cost, costs_by_beats
from ilmek.machines.automated_loom.cyclogram import BEATER, CARRIAGE, HEADS, TAKE_UP, cam_tables_of, shortest_passage
from ilmek.machines.automated_loom.design import LoomDesign, of_mean_cell, ready_loom, with_beat
from ilmek.machines.automated_loom.energy import Energy, energy_of
from ilmek.machines.automated_loom.equipment.site import site_of
from ilmek.machines.automated_loom.equipment.station import station_of
from ilmek.machines.automated_loom.equipment.tree import equipment_checks, whole_list
from ilmek.machines.automated_loom.equipment.yarn_path import yarn_path, yarn_tables
from ilmek.machines.automated_loom.estimate import TimeShares, estimated_time, time_for_knots, time_shares
from ilmek.machines.automated_loom.frame_modes import frame_modes
from ilmek.machines.automated_loom.joints import joint_checks
from ilmek.machines.automated_loom.machine_cost import price_shares
from ilmek.machines.automated_loom.off_loom import off_loom
from ilmek.machines.automated_loom.params import COST
from ilmek.machines.automated_loom.parts import PartsList, needs_of
from ilmek.machines.automated_loom.price_tables import parts_table, price_table, prices_tables
from ilmek.machines.automated_loom.rail_supports import rail_supports
from ilmek.machines.automated_loom.rate_limits import RateLimits, rate_limits
from ilmek.machines.automated_loom.search import LoomOffer, LoomSearch
from ilmek.machines.automated_loom.steady_posts import steady_checks
from ilmek.machines.automated_loom.supports import supports
from ilmek.machines.beat import BeatDrive
from ilmek.machines.weaver.carriage_drive import tension_check
from ilmek.machines.weaver.parts import case_plates
from ilmek.machines.weaver.tree import drive_of
from ilmek.records import computed, record
from ilmek.report import CamTable, Check, Json, Report, Table, at_least, at_most, columns, reason_json
from ilmek.timing.cyclogram import check_all, check_apart
from ilmek.timing.track import peak_acceleration, peak_speed
from ilmek.units import format_quantity, turn

FEWER_HEADS = "set fewer heads, or narrower ones"
SLOWER_CAMS = "set a lower shed_speed, or a quicker weft and beat"
SLOWER_KNOT = "set a longer knot_cycle, or a quicker carriage"

HEAVY_SHARE = 0.25
"""Weight of a cylinder over the pull of its warps from which there is a warning; assumed by this project."""


@record
class LoomVerdict:
    """Whether a loom weaves its carpet, from its whole report."""

    report: Report

    weaves = computed("", "every check of the loom and of its machines holds", lambda it: not it.report.failed)

    @computed("", "checks that do not hold, the heaviest first, with what would cure them", shown=False)
    def reasons(self) -> list[Json]:
        return [reason_json(reason) for reason in self.report.reasons]


@record
class LoomAnalysis:
    """A loom with its weaving time, parts, energy and beat."""

    loom: LoomDesign
    time: float
    shares: TimeShares
    listed: PartsList
    energy: Energy
    beat: BeatDrive
    cost: CarpetCost

    @computed(
        "",
        "bound of all looms that were not designed, the chosen one, the runner-up and why it lost",
        optional=True,
        absent="nothing was left open",
    )
    def choice_bound(self) -> Json:
        search = self.loom.search
        return search.as_json() if search else None

    @computed("", "price of the loom as sold, by cause: made parts by process, bought parts, work, margin")
    def price_shares(self) -> dict[str, float]:
        return price_shares(self.listed.parts, self.listed.prices, self.cost.rates, self.cost.machine)

    weaving_time = computed("h", "the carpet, estimated; a programme gives it exactly", lambda it: it.time)
    row_time = computed("s", "a row with its knots, estimated", lambda it: it.time / it.loom.rows)
    knots_per_minute = computed("1", "of all heads, wefts included, estimated", lambda it: 60 * it.knots / it.time)
    cycle_time_knot = computed("s", "time of a knot of one head or weaver", lambda it: it.loom.times.knot)
    cycle_time_row = computed(
        "s", "wefts and beats of a row: a turn of the shedding cams, without knots", lambda it: it.loom.times.weft
    )
    colour_change_time = computed(
        "s", "mean time to bring another yarn in line", lambda it: it.loom.times.colour_change
    )
    knotting = computed("", "what ties the knots: hand, cams or arms", lambda it: it.loom.head.kind)
    heads = computed("1", "knotting heads; 0: weavers tie", lambda it: it.loom.heads)
    heads_max = computed(
        "1",
        "the most that can share a row without meeting; 0: weavers tie",
        lambda it: it.loom.heads_max,
    )
    weavers = computed("1", "weavers who tie beside each other; 0: heads tie", lambda it: it.loom.weavers)
    rows = computed("1", "rows of knots", lambda it: it.loom.rows)
    columns = computed("1", "knots of a row", lambda it: it.loom.columns)
    knots = computed("1", "knots of the carpet", lambda it: it.loom.params.knots)
    warps = computed("1", "warps: two for each knot of a row", lambda it: it.loom.warps)
    warp_pitch = computed("mm", "distance of two warps", lambda it: it.loom.task.cloth.warp_pitch)
    cloth_clearance = computed(
        "mm",
        "least distance of what moves in a row from warps and carpet; below 0 it is in them",
        lambda it: min((clearance.value for clearance in cloth_clearances(it.loom)), default=HORIZON),
    )
    tension = computed("N", "tension of a warp", lambda it: it.loom.warp_tension.params.cloth.warp_tension)

    @computed("mm", "stock tube of the warp cylinders")
    def tube(self) -> Json:
        diameter, wall = self.loom.tube
        return {"diameter": diameter, "wall": wall}


@lru_cache(maxsize=4)
def analyse(loom: LoomDesign) -> LoomAnalysis:
    """Time, parts and energy of a loom."""
    listed = whole_list(loom)
    energy, time = energy_of(loom, needs_of(loom, listed.parts).axes), estimated_time(loom)
    cost = carpet_cost(loom, listed, time, energy.total)
    return LoomAnalysis(loom, time, time_shares(loom), listed, energy, loom.beat, cost)


def results(found: LoomAnalysis) -> tuple[object, ...]:
    """The records whose results are reported, in order."""
    served = yarn_path(found.loom) if found.loom.heads else station_of(site_of(found.loom))
    return (
        found.cost,
        found,
        found.loom.side,
        found.shares,
        found.beat,
        found.energy,
        served,
        found.listed,
        off_loom(found.loom),
        found.loom.params.dressing,
        frame_modes(found.loom, found.listed.frame),
    )


def _heads_checks(loom: LoomDesign) -> tuple[Check, ...]:
    """Room of the heads on their row, and the tension of their belts."""
    if not loom.heads:
        return ()
    wide, plates = loom.head_width, case_plates(loom.weaver)
    number = at_most("heads that share a row", loom.heads, loom.heads_max, "1", "width and head_width")
    apart = at_least("distance of two heads", loom.head_distance, wide, "mm", "head_width")
    room = (number, apart) if loom.heads > 1 else (number,)
    tension = tension_check(drive_of(loom.weaver), loom.heads)
    return (*(replace(check, cure=FEWER_HEADS, parts=plates) for check in room), tension)


@lru_cache(maxsize=4)
def checks(found: LoomAnalysis) -> tuple[Check, ...]:
    """Room of the heads, limits of the weft's carrier, order of the motions, strength and stiffness of the frame."""
    loom, params = found.loom, found.loom.params
    knot, row = loom.cyclograms
    carrier, weft = loom.row_timing.carrier, loom.weft
    moving = row.track(carrier)
    speed, acceleration = peak_speed(moving, row.period), peak_acceleration(moving, row.period)
    return (
        *_heads_checks(loom),
        row_check(found.beat),
        *found.beat.checks,
        *_wishes(found),
        pile_check(loom.task.yarns.pile, params.quality),
        at_most(f"{carrier}: speed", speed, weft.params.speed, "m/s", "weft.speed").with_cure(SLOWER_CAMS),
        at_most(
            f"{carrier}: acceleration", acceleration, weft.params.acceleration, "m/s^2", "weft.acceleration"
        ).with_cure(SLOWER_CAMS),
        at_least(
            f"{carrier}: room in the shed",
            _least_room(loom),
            loom.shedding.params.shuttle_height,
            "mm",
            "open_share of the lift",
        ).with_cure("set a larger lift, or a smaller open_share"),
        *(replace(check, name=f"row: {check.name}", cure=SLOWER_CAMS) for check in check_all(row, row.relations)),
        *(
            replace(check_apart(knot, exclusion), name=f"knot: {exclusion.label(knot.units)}", cure=SLOWER_KNOT)
            for exclusion in knot.exclusions
        ),
        *cloth_checks(loom),
        *_retreat_checks(loom),
        *found.listed.frame.checks,
        *bracket_checks(loom, brackets_of(loom), found.listed.frame.column),
        *supports(loom, found.listed.frame).checks,
        *(check for rail_support in rail_supports(loom, found.listed.frame) for check in rail_support.checks),
        *steady_checks(loom, found.listed.frame, brackets_of(loom)),
        *joint_checks(loom, found.listed.frame),
        *frame_modes(loom, found.listed.frame).checks,
        *equipment_checks(loom),
    )


def _retreat_checks(loom: LoomDesign) -> tuple[Check, ...]:
    """The limits of the axes on which the heads' rail retreats."""
    if not loom.heads:
        return ()
    params, row = loom.params, loom.row_cyclogram
    heads = row.track(HEADS)
    speed, acceleration = peak_speed(heads, row.period), peak_acceleration(heads, row.period)
    cure = "set a lower shed_speed, or a higher limit"
    return (
        at_most("heads: speed of the retreat", speed, params.retreat_speed, "m/s", "retreat_speed").with_cure(cure),
        at_most(
            "heads: acceleration of the retreat",
            acceleration,
            params.retreat_acceleration,
            "m/s^2",
            "retreat_acceleration",
        ).with_cure(cure),
    )


def all_checks(loom: LoomDesign) -> tuple[Check, ...]:
    """The checks of a loom and of the machines in it, without its figures and tables."""
    below = (child.component.checks(child.component.analysis(child.design)) for child in loom.children)
    return (*checks(analyse(loom)), *(check for one in below for check in one))


def _wishes(found: LoomAnalysis) -> tuple[Check, ...]:
    """The deadline, the price and the speed of the cams, where they are limited."""
    params, price = found.loom.params, found.listed.price
    cure = "set a higher price_limit, fewer heads, or a coarser quality"
    return (
        *(() if params.deadline is None else (_deadline_check(found, params.deadline),)),
        *(
            ()
            if params.price_limit is None
            else (
                at_most("price of the loom", price, params.price_limit, "1", "parameter price_limit").with_cure(cure),
            )
        ),
        *(() if params.shed_speed is None else (_cam_speed_check(found.loom, params.shed_speed),)),
    )


def _deadline_check(found: LoomAnalysis, deadline: float) -> Check:
    """The deadline [s]; where weavers tie, with how many of them it needs."""
    if not found.loom.weavers:
        return deadline_check(deadline, found.time)
    loom = found.loom
    needed = weavers_needed(time_for_knots(loom, deadline), of_mean_cell(loom.times, loom.params).knot, loom.columns)
    return weavers_deadline_check(deadline, found.time, needed, loom.head.width)


def _cam_speed_check(loom: LoomDesign, required: float) -> Check:
    """Whether the shedding cams turn as quickly as required [rad/s]."""
    turned, passage = loom.shedding.params.speed, turn / shortest_passage(loom.row_timing)
    slowest = f"the {loom.row_timing.carrier}" if passage <= turned * (1 + 1e-9) else "the heads' retreat or the beat"
    source = f"parameter shed_speed; {slowest} needs the time" if turned < required else "parameter shed_speed"
    cure = "leave shed_speed out, or set a lower one"
    return at_least("speed of the shedding cams", turned, required * (1 - 1e-9), "rpm", source).with_cure(cure)


def _least_room(loom: LoomDesign) -> float:
    """The least opening of the shed while the carrier is in it [m]; it is least when it enters and when it leaves."""
    return float(loom.shedding.shed.opening(np.array(loom.row_timing.window)).min())


def tables(found: LoomAnalysis) -> tuple[Table, ...]:
    """Time by number of heads, parts, prices, motions of a row, clearances."""
    costs = _heads_table(found), _cost_table(found), price_table(found.price_shares), *_rates_table(found)
    listed = (
        *costs,
        parts_table(found.listed.parts, found.listed.prices),
        *prices_tables(found.listed.prices),
        _row_table(found.loom),
        *found.loom.params.dressing.tables(found.loom.warp_guide),
    )
    return (*listed, cloth_table(found.loom), *(yarn_tables(found.loom) if found.loom.heads else ()))


@lru_cache(maxsize=4)
def beat_costs(found: LoomAnalysis) -> Mapping[str, tuple[CarpetCost, ...]]:
    """Costs over the heads with each kind of beat whose drive keeps its limits, estimated."""
    return costs_by_beats(found.loom, found.listed, found.energy.total)


def _heads_table(found: LoomAnalysis) -> Table:
    loom = found.loom
    rows = tuple(
        (
            number,
            cost.time,
            cost.time / loom.rows,
            60 * found.knots / cost.time,
            cost.machine.parts,
            cost.cost_per_carpet,
        )
        for number, cost in enumerate(beat_costs(found)[loom.params.beat], 1)
    )
    of = "heads" if loom.heads else "weavers"
    heads_of = columns(
        f"{of} | weaving time [h] | a row [s] | knots a minute | price of the parts | cost of a carpet without yarn"
    )
    return Table(f"loom-{of}", f"Time, price and cost by number of {of}, estimated: the frame as it is", heads_of, rows)


def _cost_table(found: LoomAnalysis) -> Table:
    costs = beat_costs(found)
    rows = tuple(
        (number, *(cost.cost_per_carpet for cost in row))
        for number, row in enumerate(zip(*costs.values(), strict=True), 1)
    )
    of = "heads" if found.loom.heads else "weavers"
    title = f"Cost of a carpet without yarn by beat and number of {of}, estimated: knot and frame as they are"
    return Table("loom-cost", title, columns(of, *costs), rows)


def _rates_table(found: LoomAnalysis) -> tuple[Table, ...]:
    """How far each rate can move, for a loom that was chosen by its cost."""
    search = found.loom.search
    if search is None or search.params.aim != COST:
        return ()
    rivals = tuple(_rivals(found, search))
    limits = rate_limits(found.cost, [cost for _, cost in rivals])
    names = [search.unlike(offer) for offer, _ in rivals]
    rows = tuple((limit.rate.name, limit.rate.doc, *_moved(limit, names)) for limit in limits)
    title = f"Rates: how far each can move before another of {len(rivals) + 1} designed looms is the cheapest"
    return (Table("loom-rates", title, columns("rate | what it is | now | down to | then | up to | then"), rows),)


def _rivals(found: LoomAnalysis, search: LoomSearch) -> Iterator[tuple[LoomOffer, CarpetCost]]:
    """The other looms that the search designed, and those with a head less and a head more, where these weave."""
    yield from search.others
    own, known = search.chosen, {offer.key for offer, _ in search.others}
    for offer in (replace(own, heads=own.heads + more) for more in (-1, 1)):
        if 0 < offer.heads <= found.loom.heads_max and offer.key not in known and search.params.heads is None:
            ready = ready_loom(offer.of(search.params))
            loom = with_beat(ready, ready.options[0])
            if all(check.ok for check in all_checks(loom)):
                yield offer, analyse(loom).cost


def _moved(limits: RateLimits, names: Sequence[str]) -> Iterator[str]:
    """A rate's value, and its limits with what is chosen then."""
    unit = limits.rate.unit
    yield format_quantity(limits.now, unit)
    for limit in (limits.below, limits.above):
        yield "any" if limit is None else format_quantity(limit[0], unit)
        yield "" if limit is None else names[limit[1]]


def _row_table(loom: LoomDesign) -> Table:
    period = loom.row_cyclogram.period
    rows = tuple(
        (track.name, part.name, part.start, part.end, (part.end - part.start) / turn * period)
        for track in loom.row_cyclogram.tracks
        for part in track.segments
    )
    heads = columns("track", "motion", "from [deg]", "to [deg]", "time [s]")
    return Table("loom-row", "Motions of a row over the angle of the shedding cams", heads, rows)


def cam_tables(loom: LoomDesign) -> tuple[CamTable, ...]:
    """Electronic cams of the weft's carrier, beater, take-up, and the heads' carriage."""
    knot, row = loom.cyclograms
    of_row = cam_tables_of(row, (loom.row_timing.carrier, BEATER, TAKE_UP))
    return (*of_row, *cam_tables_of(knot, (CARRIAGE,))) if loom.heads else of_row


def warnings(found: LoomAnalysis) -> tuple[str, ...]:
    """Heavy cylinders."""
    loom, texts = found.loom, []
    share = loom.warp_tension.self_weight / loom.warp_tension.load
    if share > HEAVY_SHARE:
        mass, part = format_quantity(loom.warp_tension.mass, "kg", 3), format_quantity(share, "%", 2)
        texts.append(f"a cylinder weighs {mass}, {part} of what the warps pull: weave narrower, or support it between")
    return tuple(texts)
