"""What is reported of a hand loom: times, hands, frame, cost, its parts in space, and what it does not have."""

from dataclasses import replace
from functools import lru_cache

from ilmek.carpet.pile import pile_check
from ilmek.elements.columns import STEEL, HollowSquare
from ilmek.elements.materials import GRAVITY
from ilmek.elements.prices import read_prices
from ilmek.machines.automated_loom.assembly import joint_check, mesh_check
from ilmek.machines.automated_loom.carpet_cost import CarpetCost
from ilmek.machines.automated_loom.choice import row_check, weavers_deadline_check, weavers_needed
from ilmek.machines.automated_loom.drives import drive_checks
from ilmek.machines.automated_loom.energy import Energy, energy_of_works
from ilmek.machines.automated_loom.equipment.station import station_of
from ilmek.machines.automated_loom.frame import column_checks, part_id
from ilmek.machines.automated_loom.knotting import ELBOW_ROOM
from ilmek.machines.automated_loom.machine_cost import machine_cost
from ilmek.machines.automated_loom.nearest_parts import NearParts, nearest_of, row_windows
from ilmek.machines.automated_loom.off_loom import OffLoom, carpet_off_loom
from ilmek.machines.automated_loom.price_tables import parts_table
from ilmek.machines.automated_loom.supports import beat_beam
from ilmek.machines.beat import BeatDrive
from ilmek.machines.hand_loom.design import WEFTS, HandLoom
from ilmek.machines.hand_loom.driven_beat import BEAT, room_checks, two_beats
from ilmek.machines.hand_loom.equipment import equipment_checks
from ilmek.machines.hand_loom.frame import bench_of, foot_load, foot_of, site_of, tree
from ilmek.machines.hand_loom.layout import CylinderBracket
from ilmek.machines.hand_shed.tree import BEAM, SHED, half_width
from ilmek.part.bill import bill
from ilmek.part.clearances import Approach, approaches
from ilmek.part.contacts import TOUCHING, Contacts, contacts
from ilmek.part.drive_balance import DriveBalance, drive_balance
from ilmek.part.extents import around, extents
from ilmek.records import computed, record
from ilmek.report import BillLine, Check, Json, Table, at_least, at_most, columns

TIPPING = 1.5
"""Weight's moment over that of the hands at least; assumed by this project."""

OVERHEAD = 1.9
"""What a weaver who stands reaches and pulls, over the floor [m]; assumed by this project."""

ABSENT = (
    ("programme", "the weaver is the order of the acts"),
    ("back rest, tension compensator", "strings pull half of the warps by so little that these bear it"),
    ("shuttle or rapier", "the weft's bobbin goes from hand to hand"),
)
"""What an automated loom has and a hand loom has not, and why."""

UNDRIVEN = (
    ("cyclogram", "nothing is driven"),
    ("cabinet, amplifiers, sensors, list of signals", "nothing is driven, nothing is measured"),
    ("guards, emergency stop", "nothing moves but by the hand that is at it"),
    ("energy", "of the weavers alone"),
)
"""What it has not beside where nothing is driven."""

BEAT_DRIVEN = (
    ("drives of shed, weft and cylinders", "the hands of the weavers"),
    ("sensors of shed and warps", "the weaver sees them; rod and levers have their room above all that beats"),
    ("comb of the weaver", "the beat is driven"),
)
"""What it has not where the beat is driven."""


@record
class HandLoomAnalysis:
    """A hand loom with its parts and its cost."""

    loom: HandLoom
    lines: tuple[BillLine, ...]
    cost: CarpetCost
    energy: Energy | None = None

    weaving_time = computed("h", "the carpet, estimated", lambda it: it.loom.rows * it.loom.row_time)
    row_time = computed("s", "a row with its knots, estimated", lambda it: it.loom.row_time)
    row_acts = computed("s", "where the time of a row goes", lambda it: it.loom.row_acts)
    winding_time = computed("s", "time to wind the carpet on once", lambda it: it.loom.winding_time)
    weavers = computed("1", "weavers who tie beside each other", lambda it: it.loom.weavers)
    rows = computed("1", "rows of knots", lambda it: it.loom.rows)
    columns = computed("1", "knots of a row", lambda it: it.loom.columns)
    knots = computed("1", "knots of the carpet", lambda it: it.loom.params.knots)
    warps = computed("1", "warps: two for each knot of a row", lambda it: it.loom.params.cloth.warps)
    knots_per_minute = computed(
        "1",
        "of all weavers, wefts included, estimated",
        lambda it: 60 * it.loom.columns * it.loom.params.knotted_share / it.loom.row_time,
    )
    driven_axes = computed("1", "axes that motors drive", lambda it: drive_balance(tree(it.loom)).axes)
    moved_by_hand = computed("", "bodies that hands move", lambda it: list(dict.fromkeys(it.balance.by_hand)))
    fell_height = computed("m", "fell above the floor", lambda it: -it.loom.layout.floor)
    loom_height = computed("m", "height of the frame's columns", lambda it: it.loom.layout.top - it.loom.layout.floor)
    frame_column = computed("", "square hollow section of the columns", lambda it: it.loom.layout.column.name)
    foot_load = computed("N", "load of a levelling foot, where two bear the loom", lambda it: foot_load(it.loom))
    mass = computed("kg", "mass of all parts but the reducers", lambda it: sum(line.mass_all for line in it.lines))
    price = computed("", "price of all parts by the table of prices", lambda it: it.cost.machine.parts)

    @property
    def balance(self) -> DriveBalance:
        """Degrees of freedom beside what moves them."""
        return drive_balance(tree(self.loom))


@record
class HandAssembly:
    """The parts of a hand loom against each other: what touches, and what comes near while the shed is changed."""

    loom: HandLoom
    contacts: Contacts
    nearest: tuple[NearParts, ...]

    buildable = computed(
        "",
        "no part through another, all in one group, each held by a joint",
        lambda it: all(c.ok for c in it.checks),
    )
    assembly_clashes = computed("1", "pairs of parts that are through each other", lambda it: len(it.through))
    assembly_groups = computed(
        "1", "groups of parts that touch: 1 where each is held", lambda it: len(it.contacts.groups)
    )
    degrees_of_freedom = computed(
        "1",
        "coordinates of all bodies, less the rank of joints and transmissions, and those that nothing has to drive",
        lambda it: drive_balance(tree(it.loom)).number,
    )

    @computed(
        "", "the pairs of parts that come nearest: those through each other, then those that do not touch", shown=False
    )
    def nearest_pairs(self) -> list[Json]:
        return [near.as_json() for near in self.apart]

    @property
    def apart(self) -> tuple[NearParts, ...]:
        """What is through each other, then what moves against each other and does not touch, the nearest first."""
        through = (NearParts(near) for near in self.through)
        return (*through, *(near for near in self.nearest if near.approach.distance > TOUCHING))[:_NEAREST]

    @property
    def through(self) -> tuple[Approach, ...]:
        """Parts through each other, standing or in the change of the shed."""
        return (*self.contacts.through, *(near.approach for near in self.nearest if near.approach.distance < 0))

    @property
    def checks(self) -> tuple[Check, ...]:
        """Parts through each other, in the air, without a joint or without a hand."""
        return (
            at_most("parts through each other", len(self.through), 0, "1", _worst(self.through)).with_cure(
                "set other heights of the shed", *dict.fromkeys(part for one in self.through for part in one.parts)
            ),
            at_most("groups of parts that touch", len(self.contacts.groups), 1, "1", "meshes of all parts").with_cure(
                "give the parts named supports",
                *dict.fromkeys(part for group in self.contacts.groups[1:] for part in group.parts),
            ),
            joint_check(tree(self.loom)),
            *drive_checks(tree(self.loom)),
            mesh_check(tree(self.loom)),
        )

    @property
    def tables(self) -> tuple[Table, ...]:
        """The pairs that come nearest while the shed is changed."""
        rows = tuple((*near.approach.parts, near.approach.distance) for near in self.apart)
        return (Table("hand-loom-nearest-parts", "Nearest parts", columns("part", "and", "least [mm]"), rows),)


_NEAREST, _HORIZON = 10, 20e-3


@lru_cache(maxsize=4)
def assembly(loom: HandLoom) -> HandAssembly:
    """The parts of a loom against each other."""
    whole, drive = tree(loom), loom.drive
    near = approaches(whole, SHED, _HORIZON)
    if drive is not None:
        near = (*near, *approaches(whole, BEAT, _HORIZON, row_windows(two_beats(drive.beat), drive.path)))
    return HandAssembly(loom, contacts(whole), nearest_of(NearParts(approach) for approach in near))


def _worst(through: tuple[Approach, ...]) -> str:
    return (
        "; ".join(" in ".join(approach.parts) for approach in through[:3])
        or "meshes of all parts over a change of the shed"
    )


@lru_cache(maxsize=4)
def analyse(loom: HandLoom) -> HandLoomAnalysis:
    """Parts and cost of a loom. Raises ParameterError for unreadable prices."""
    lines, params = bill(tree(loom)), loom.params
    rates = replace(params.cost, persons=float(loom.weavers))
    low, high = around(extents(tree(loom), (SHED,)))
    aisle = 2 * rates.aisle
    time, area, drive = loom.rows * loom.row_time, params.width * params.length, loom.drive
    machine, acts = machine_cost(lines, read_prices(params.prices)), {"beat": float(WEFTS * loom.rows)}
    energy = energy_of_works(params, drive.work, int(machine.axes), acts, time, area) if drive else None
    whole = CarpetCost(
        rates=rates if drive else replace(rates, commissioning=0.0),
        knots=params.knots,
        area=area,
        time=time,
        energy=float(energy.total) if energy else 0.0,
        dressing=float(params.dressing.dressing_time),
        floor=float((high[0] - low[0] + aisle) * (high[2] - low[2] + aisle)),
        machine=machine,
    )
    return HandLoomAnalysis(loom, lines, whole, energy)


def results(found: HandLoomAnalysis) -> tuple[object, ...]:
    """The records whose results are reported, in order."""
    loom = found.loom
    driven = (found.energy, loom.drive, station_of(site_of(loom))) if loom.drive else (bench_of(loom),)
    return found, *driven, found.cost, off_loom_of(loom), loom.params.dressing


def off_loom_of(loom: HandLoom) -> OffLoom:
    """The loom's carpet off the loom."""
    params = loom.params
    return carpet_off_loom(params, (loom.rows, loom.columns), params.billed)


def checks(found: HandLoomAnalysis) -> tuple[Check, ...]:
    """Deadline, pile, columns, brackets, and whether the loom stands while hands pull at it."""
    loom, params = found.loom, found.loom.params
    layout, limit = loom.layout, STEEL.strength / params.column_safety
    cure = "set a lower tension, or a narrower carpet"
    late = () if params.deadline is None else (_deadline(loom, params.deadline),)
    return (
        *late,
        pile_check(params.cloth.carpet_yarns.pile, params.quality),
        *column_checks(layout.task, layout.column, 1),
        *(check for bracket in layout.brackets for check in _bracket_checks(bracket, layout.column, limit)),
        at_most(
            "stress of a beam of the hand shed", beam_stress(loom), limit, "MPa", "yield of S235 over column_safety"
        ).with_cure(cure, "hand-shed/beam"),
        at_least(
            "loom stands: weight over the hands' pull", tipping(loom, found.lines), TIPPING, "1", "moments; assumed"
        ).with_cure("set a smaller hands.pull", part_id("front-foot")),
        at_most(
            "shed rod, pushed up, over the floor", loom.shed.params.rod_high - layout.floor, OVERHEAD, "m", "assumed"
        ).with_cure("set a smaller hand-shed.rod_high"),
        at_most("load of a levelling foot", foot_load(loom), foot_of(loom).rating, "N", "its pad and screw").with_cure(
            cure, part_id("levelling-foot")
        ),
        *(bench_of(loom).checks("set a shorter carpet") if loom.drive is None else _of_a_drive(loom, loom.drive)),
    )


def _of_a_drive(loom: HandLoom, drive: BeatDrive) -> tuple[Check, ...]:
    """Rows that a driven beat leaves, its room below the shed, its posts, and what guards it."""
    assert loom.posts is not None
    return (
        row_check(drive),
        *drive.checks,
        *room_checks(drive, loom.shed),
        *loom.posts.checks,
        *equipment_checks(site_of(loom)),
    )


def _bracket_checks(own: CylinderBracket, column: HollowSquare, limit: float) -> tuple[Check, ...]:
    """Stress of a cylinder's bracket, its weld, and the screws of the bearing on it."""
    part, cure = part_id(f"{own.cylinder.name}-bracket"), "set a lower tension, or a narrower carpet"
    title, source = f"bracket of the {own.cylinder.name} cylinder", "yield of S235 over column_safety"
    stress = at_most(f"frame: stress of the {title}", own.stress, limit, "MPa", source).with_cure(cure, part)
    return stress, own.seam(column).check, own.seat.check(f"frame: bearing on the {title}", cure, part)


def beam_stress(loom: HandLoom) -> float:
    """Stress of a beam of the hand shed [Pa]: half of the forces of bar and rod on the side plate beside its column.

    One of the two beams counts as if it bore all; it bends about its column: M = F / 2 * distance.
    """
    shed, face = loom.shed, loom.layout.face
    force = (float(shed.heddle_force) + shed.rod_load) / 2
    return force * (face - half_width(shed)) * BEAM.side / 2 / BEAM.inertia


def tipping(loom: HandLoom, lines: tuple[BillLine, ...]) -> float:
    """Moment of the loom's weight about the rear ends of its feet, over that of all hands at the upper cylinder, or of
    a driven beat at its beam: hands are on their buttons then.
    """
    layout, hands = loom.layout, loom.params.hands
    weight = sum(line.mass_all for line in lines) * GRAVITY
    pull = 2 * loom.weavers * hands.pull * (layout.upper.at.imag - layout.floor)
    drive = loom.drive
    across = drive.frame_force * (beat_beam(drive)[1].imag - layout.floor) if drive and drive.crank_rockers else 0.0
    return weight * layout.reach / max(pull, across)


def _deadline(loom: HandLoom, deadline: float) -> Check:
    """The deadline [s]; what of a row is not knots takes as long with more weavers, but for blows of combs."""
    left = deadline / loom.rows - (loom.row_time - loom.row_acts["knots"])
    needed = weavers_needed(left, loom.params.knotted_share * loom.params.hand_knot, loom.columns)
    return weavers_deadline_check(deadline, loom.rows * loom.row_time, needed, ELBOW_ROOM)


def tables(found: HandLoomAnalysis) -> tuple[Table, ...]:
    """Acts of a row, parts, and what the loom does not have."""
    acts, absent = tuple(found.loom.row_acts.items()), BEAT_DRIVEN if found.loom.drive else UNDRIVEN
    return (
        Table("hand-loom-row", "Time of a row by its acts", columns("act", "time [s]"), acts),
        *found.loom.params.dressing.tables(found.loom.warp_guide),
        parts_table(found.lines, read_prices(found.loom.params.prices)),
        Table("hand-loom-absent", "What this loom does not have", columns("not there", "why"), (*absent, *ABSENT)),
    )
