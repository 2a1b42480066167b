"""What is reported of the weft side: tables of bobbins, carriers and stops."""

from ilmek.loom.bobbins import change_stops
from ilmek.machines.weft.bobbin import stock_sizes, windings
from ilmek.machines.weft.design import Weft
from ilmek.machines.weft.params import SHUTTLE
from ilmek.machines.weft.shuttle import Shuttle
from ilmek.report import Table, columns

MOST_STOPS = 200
"""Largest number of stops in the table."""


def results(weft: Weft) -> tuple[object, ...]:
    """The records whose results are reported."""
    return (weft, weft.carried, weft.passage, weft.axis)


def warnings(weft: Weft) -> tuple[str, ...]:
    """An edge without a selvedge."""
    if weft.params.edge_warps:
        return ()
    return ("an edge has no selvedge warp: the wefts turn about warps with knots",)


def tables(weft: Weft) -> tuple[Table, ...]:
    """Carriers, and for shuttles bobbins and stops."""
    carriers = (_carriers(weft),) if weft.alternatives else ()
    return (*carriers, *((_bobbins(weft), _stops(weft)) if weft.params.carrier == SHUTTLE else ()))


def _carriers(weft: Weft) -> Table:
    heads = columns("carrier", "price", "wefts and stops [h]", "passage [s]", "room beside the cloth [m]", "fails")
    rows = tuple(
        (
            one.params.carrier,
            one.price,
            one.time,
            one.passage.time,
            one.side_room,
            ", ".join(check.name for check in one.checks if not check.ok) or "nothing",
        )
        for one in (weft, *weft.alternatives)
    )
    return Table("weft-carriers", "Carriers of the weft", heads, rows)


def _bobbins(weft: Weft) -> Table:
    """Rows that bobbins of all sizes last."""
    carried, params = weft.carried, weft.params
    own = {carried.bobbin.diameter: carried.bobbin} if isinstance(carried, Shuttle) else {}
    usual = {one.diameter: one for one in stock_sizes()}
    rows = []
    for size in dict(sorted({**usual, **own}.items())).values():
        straight, sinuous = windings(params, size, weft.lengths)
        rows.append((size.diameter, size.length, straight.capacity, straight.rows, sinuous.capacity, sinuous.rows))
    heads = columns(
        "bobbin [mm]", "length [mm]", "straight weft [m]", "lasts rows", "sinuous weft [m]", "sinuous lasts rows"
    )
    return Table("weft-bobbins", "Bobbins: length of weft, and rows that it lasts", heads, tuple(rows))


def _stops(weft: Weft) -> Table:
    heads = columns("before row", "new bobbins", "time [s]")
    first = MOST_STOPS * min(bobbin.rows for bobbin in weft.bobbins) + 1
    stops = change_stops(weft.bobbins, min(first, weft.params.rows))[:MOST_STOPS]
    rows = tuple((stop.row + 1, " and ".join(stop.yarns), stop.time) for stop in stops)
    return Table("weft-stops", "Stops for new bobbins, rows from the bottom", heads, rows)
