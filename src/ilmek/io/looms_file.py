"""Looms of a factory as TOML: shifts, looms that exist, yarn in stock.

    currency = "EUR"
    holidays = [2026-12-25, 2027-01-01]

    [[shift]]
    name = "day"
    days = "Mon-Fri"
    hours = "06:00-14:00"
    breaks = ["10:00-10:20"]

    [[shift]]
    name = "night"
    days = "Mon-Thu"
    hours = "22:00-06:00"                       # ends on the next day
    attended = false                            # the loom weaves; nobody dresses or doffs it

    [[loom]]
    name = "A"
    file = "loom-a.json"                        # or design = { width = "1.2m", heads = 4 }
    shifts = ["day", "night"]                   # default: all
    cost = "12 EUR/h"
    stops = "4%"                                # share of the time lost by stops
    dressing = "16h"
    dressing_same = "5h"                        # after a carpet of the same width and yarns
    doffing = "90min"
    available = 2026-12-02
    downtime = ["2026-12-07T08:00/2026-12-08T12:00"]    # maintenance, or until when a fault is mended
    weaving = { order = "Kazak, first", run = "run-a" }  # what is on it, by its journal beside this file

    [[loom]]
    name = "bench"                              # a frame at which weavers tie; nothing of it is designed
    weavers = 3
    width = "2.4m"                              # widest carpet
    knots_a_day = 8000                          # that a weaver ties in 8 h
    cost = "1.5 EUR/h"                          # without wages, where the orders have a wage by knots
    dressing = "20h"
    doffing = "3h"
    weaving = { order = "Runner", rows = 210, since = 2026-11-20T06:00:00 }

    [[yarn]]
    name = "madder red"
    stock = "8kg"
    price = "24 EUR/kg"
    lead = "10d"
    lot = "K-114"                               # dye lot of what is in stock

Files are named relative to the folder of the looms and lie in it.
"""

import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from datetime import date, datetime
from pathlib import Path

from ilmek.carpet.price_rules import WageRules
from ilmek.carpet.yarn import MOST_YARNS
from ilmek.carpet.yarn_plan import EURO
from ilmek.errors import ParameterError, did_you_mean, restated
from ilmek.io.data_text import read_data
from ilmek.io.factory_entry import LARGEST, FactoryEntry, datetime_of, file_beside
from ilmek.io.journal_folder import JOURNAL
from ilmek.io.order_terms import read_wage
from ilmek.io.schema import SourceText, shown
from ilmek.machines.automated_loom.cost_rates import CostRates
from ilmek.params import Setting
from ilmek.units import day, minute

MOST_LOOMS = 1000
"""Largest number of looms of a file."""

MOST_SHIFTS = 50
"""Largest number of shifts of a file."""

MOST_BREAKS = 10
"""Largest number of breaks of a shift."""

MOST_DOWNTIMES = 100
"""Largest number of times in which a loom does not work."""

MOST_ROWS = 1_000_000
"""Largest number of rows that are woven of a carpet."""

MOST_HOLIDAYS = 500
"""Largest number of holidays of a file."""

MOST_STOPS = 0.9
"""Largest share of a loom's time lost by stops."""

LONGEST_WORK = 60 * day
"""Longest dressing and doffing [s]."""

LONGEST_LEAD = 1000 * day
"""Longest lead time of yarn [s]."""

WEEKDAYS = ("mon", "tue", "wed", "thu", "fri", "sat", "sun")


@dataclass(frozen=True, slots=True)
class ShiftEntry:
    """A shift: days of the week on which it begins, hours and breaks [min of that day], whether it is attended."""

    name: str
    days: frozenset[int]
    start: int
    end: int
    breaks: tuple[tuple[int, int], ...]
    attended: bool


@dataclass(frozen=True, slots=True)
class WeaversLoom:
    """A frame at which weavers tie: their number, the widest carpet [m], and knots of a weaver in a second of work."""

    weavers: int
    width: float
    knots: float


@dataclass(frozen=True, slots=True)
class WeavingEntry:
    """What is on a loom: the name of its order, and how far it is.

    run    folder of its run, whose journal counts rows and time; else
    rows   that are woven                     since  begin of their weaving; None: their pace is that of the design
    """

    order: str
    run: Path | None = None
    rows: int = 0
    since: datetime | None = None


@dataclass(frozen=True, slots=True)
class LoomEntry:
    """A loom: its file, or the parameters of its design; times [s], cost [currency/s], share of its time lost.

    hand       a frame at which weavers tie, in the place of both
    available  from when on; None: from the begin of the plan      where  file and line, for messages
    downtime   begin and end of each time in which it does not work      weaving  what is on it
    """

    name: str
    file: Path | None
    design: Mapping[str, Setting]
    shifts: tuple[str, ...]
    cost: float
    stops: float
    dressing: float
    dressing_same: float
    doffing: float
    available: datetime | None
    where: str
    hand: WeaversLoom | None = None
    downtime: tuple[tuple[datetime, datetime], ...] = ()
    weaving: WeavingEntry | None = None

    def __hash__(self) -> int:
        return hash((self.name, self.where))


@dataclass(frozen=True, slots=True)
class StockEntry:
    """A yarn: mass in stock [kg], price [currency/kg], None: as in the yarn list, lead time of a purchase [s], lot."""

    name: str
    stock: float
    price: float | None
    lead: float
    lot: str = ""


@dataclass(frozen=True, slots=True)
class FactoryLooms:
    """Looms, shifts, holidays and yarns of a file, and the wage of its weavers by knots."""

    path: Path
    currency: str
    shifts: tuple[ShiftEntry, ...]
    looms: tuple[LoomEntry, ...]
    holidays: tuple[date, ...] = ()
    yarns: tuple[StockEntry, ...] = field(default=())
    wage: WageRules | None = None


def read_looms(path: Path) -> FactoryLooms:
    """The looms of a .toml file; loom files are not opened.

    Raises ParameterError with the file, the line and the key for any error in the file.
    """
    text = read_data(path, "looms", ParameterError, largest=LARGEST)
    with restated(ParameterError):
        return _looms(FactoryEntry(text.data, (), SourceText(str(path), text.lines)), path)


def _looms(root: FactoryEntry, path: Path) -> FactoryLooms:
    root.keys("currency", "holidays", "shift", "loom", "yarn", "wage", needs=("shift", "loom"))
    currency = root.currency(EURO)
    shifts = tuple(_shift(row) for row in _rows(root, "shift", MOST_SHIFTS))
    known = tuple(shift.name for shift in shifts)
    looms = tuple(_loom(row, path, currency, shifts) for row in _rows(root, "loom", MOST_LOOMS))
    yarns = tuple(_yarn(row, currency) for row in _rows(root, "yarn", MOST_YARNS, least=0))
    for noun, names in (
        ("shift", known),
        ("loom", tuple(loom.name for loom in looms)),
        ("yarn", tuple(yarn.name for yarn in yarns)),
    ):
        for index, name in enumerate(names):
            if name in names[:index]:
                row = root.rows(noun)[index]
                row.refuse(ParameterError(f"two are named {name!r}", do="give each its own name"), "name")
    holidays = tuple(root.dates("holidays", MOST_HOLIDAYS))
    return FactoryLooms(path, currency, shifts, looms, holidays, yarns, read_wage(root, currency))


def _rows(root: FactoryEntry, key: str, most: int, least: int = 1) -> list[FactoryEntry]:
    rows = root.rows(key)
    if not least <= len(rows) <= most:
        root.refuse(ParameterError(f"has {len(rows)} tables", allowed=f"{least} to {most}"), key)
    return rows


def _shift(row: FactoryEntry) -> ShiftEntry:
    row.keys("name", "days", "hours", "breaks", "attended", needs=("name", "days", "hours"))
    start, end = row.hours("hours", row.text("hours"))
    given = row.data.get("breaks", [])
    if not isinstance(given, list) or len(given) > MOST_BREAKS or not all(isinstance(one, str) for one in given):
        row.refuse(ParameterError(f"{shown(given)} is no list of at most {MOST_BREAKS} breaks"), "breaks")
    breaks = []
    for one in given:
        low, high = row.hours("breaks", one)
        if low < start:
            low, high = low + 1440, high + 1440
        if not start <= low < high <= end:
            row.refuse(ParameterError(f"the break {one} is not in the shift", allowed=row.text("hours")), "breaks")
        breaks.append((low, high))
    attended = row.flag("attended") if row.has("attended") else True
    return ShiftEntry(row.label("name"), _days(row), start, end, tuple(breaks), attended)


def _days(row: FactoryEntry) -> frozenset[int]:
    """The days of a text like `Mon-Fri, Sun`."""
    text, days = row.text("days"), set()
    for part in text.lower().split(","):
        matched = re.fullmatch(r"\s*([a-z]{3})[a-z]*\s*(?:-\s*([a-z]{3})[a-z]*\s*)?", part)
        ends = [name for name in (matched.groups() if matched else ()) if name]
        if not ends or any(name not in WEEKDAYS for name in ends):
            row.refuse(ParameterError(f"{shown(text)} are no days of the week", allowed='like "Mon-Fri, Sun"'), "days")
        first, last = WEEKDAYS.index(ends[0]), WEEKDAYS.index(ends[-1])
        days |= {(first + step) % 7 for step in range((last - first) % 7 + 1)}
    return frozenset(days)


_LOOM_KEYS = (
    "name", "file", "design", "weavers", "width", "knots_a_day",
    "shifts", "cost", "stops", "dressing", "dressing_same", "doffing", "available",
    "downtime", "weaving",
)  # fmt: skip


def _loom(row: FactoryEntry, path: Path, currency: str, shifts: tuple[ShiftEntry, ...]) -> LoomEntry:
    row.keys(*_LOOM_KEYS, needs=("name", "cost", "dressing", "doffing"))
    if sum(map(row.has, ("file", "design", "weavers"))) != 1:
        row.refuse(ParameterError("is of none or of several of file, design and weavers", allowed="one of them"))
    file = None
    if row.has("file"):
        try:
            file = file_beside(path.parent, row.text("file"), "looms")
        except ParameterError as error:
            row.refuse(error, "file")
    cost = row.money("cost", currency, "h")
    dressing = row.measured("dressing", "h", most=LONGEST_WORK)
    same = row.measured("dressing_same", "h", dressing, most=LONGEST_WORK)
    if same > dressing:
        allowed = 'at most "dressing"'
        row.refuse(ParameterError("takes longer than that of another carpet", allowed=allowed), "dressing_same")
    stops = row.measured("stops", "%", 0.0, most=MOST_STOPS)
    line = row.source.lines.get(row.path, 1)
    return LoomEntry(
        row.label("name"),
        file,
        dict(row.table("design").settings()),
        _chosen(row, shifts),
        cost or 0.0,
        stops,
        _minutes(dressing),
        _minutes(same),
        _minutes(row.measured("doffing", "h", most=LONGEST_WORK)),
        row.instant("available") if row.has("available") else None,
        f"{path}, line {line}",
        _hand(row),
        _downtime(row),
        _weaving(row, path.parent) if row.has("weaving") else None,
    )


def _downtime(row: FactoryEntry) -> tuple[tuple[datetime, datetime], ...]:
    given = row.data.get("downtime", [])
    if not isinstance(given, list) or len(given) > MOST_DOWNTIMES or not all(isinstance(text, str) for text in given):
        row.refuse(ParameterError(f"{shown(given)} is no list of at most {MOST_DOWNTIMES} times"), "downtime")
    times = []
    for text in given:
        ends = text.split("/")
        if len(ends) != 2:
            do = 'write it like "2026-12-07T08:00/2026-12-08T12:00"'
            row.refuse(ParameterError(f"{shown(text)} is no begin and end", do=do), "downtime")
        try:
            begin, end = datetime_of(ends[0].strip()), datetime_of(ends[1].strip(), late=True)
        except ParameterError as error:
            row.refuse(error, "downtime")
        if end <= begin:
            row.refuse(ParameterError(f"{shown(text)} ends before it begins", do="exchange both"), "downtime")
        times.append((begin, end))
    return tuple(times)


def _weaving(row: FactoryEntry, folder: Path) -> WeavingEntry:
    entry = row.table("weaving")
    entry.keys("order", "run", "rows", "since", needs=("order",))
    if entry.has("run") == entry.has("rows"):
        entry.refuse(ParameterError("is of none or of both of run and rows", allowed="one of them"))
    if not entry.has("run"):
        since = entry.instant("since") if entry.has("since") else None
        return WeavingEntry(entry.text("order"), None, entry.count("rows", 0, 0, MOST_ROWS), since)
    if entry.has("since"):
        entry.refuse(ParameterError("since of a run", do="leave it out: its journal has the time"), "since")
    try:
        journal = file_beside(folder, f"{entry.text('run')}/{JOURNAL}", "looms")
    except ParameterError as error:
        entry.refuse(error, "run")
    return WeavingEntry(entry.text("order"), journal.parent)


def _hand(row: FactoryEntry) -> WeaversLoom | None:
    rates = CostRates()
    for key in ("width", "knots_a_day"):
        if row.has(key) and not row.has("weavers"):
            row.refuse(ParameterError(f"{key} of a loom that is designed", do="it follows from its design"), key)
    if not row.has("weavers"):
        return None
    width = row.measured("width", "m", most=20.0)
    if width <= 0:
        row.refuse(ParameterError("no carpet is so narrow", allowed="above 0"), "width")
    knots = row.count("knots_a_day", round(rates.weaver_knots), 1, 1_000_000)
    return WeaversLoom(row.count("weavers", 1, 1, 100), width, knots / rates.weaver_day)


def _minutes(seconds: float) -> float:
    return minute * round(seconds / minute)


def _chosen(row: FactoryEntry, shifts: tuple[ShiftEntry, ...]) -> tuple[str, ...]:
    """The names of a loom's shifts: of the file, and at least one of them attended."""
    known = {shift.name: shift for shift in shifts}
    given = row.data.get("shifts", list(known))
    if not isinstance(given, list) or not given or not all(isinstance(name, str) for name in given):
        row.refuse(ParameterError(f"{shown(given)} is no list of shifts", allowed=", ".join(known)), "shifts")
    for name in given:
        if name not in known:
            error = ParameterError(
                f"unknown shift {shown(name)}", allowed=", ".join(known), do=did_you_mean(name, known)
            )
            row.refuse(error, "shifts")
    if not any(known[name].attended for name in given):
        row.refuse(ParameterError("no shift of the loom is attended", do="give one in which it is dressed"), "shifts")
    return tuple(given)


def _yarn(row: FactoryEntry, currency: str) -> StockEntry:
    row.keys("name", "stock", "price", "lead", "lot", needs=("name",))
    return StockEntry(
        row.label("name"),
        row.measured("stock", "kg", 0.0, most=1e6),
        row.money("price", currency, "kg"),
        row.measured("lead", "d", 0.0, most=LONGEST_LEAD),
        row.label("lot") if row.has("lot") else "",
    )
