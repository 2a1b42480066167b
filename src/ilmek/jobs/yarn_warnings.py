"""What to do where the yarn of a carpet does not fit, weighs too much or too little, or takes several dye lots."""

import math

from ilmek.carpet.bill import YarnBill
from ilmek.carpet.chart import Chart
from ilmek.carpet.pile import PileParams, coarsest_count, of_yarn
from ilmek.carpet.quality import Quality
from ilmek.carpet.usual_pile import BAND_SOURCE, USUAL_PLY, usual_count
from ilmek.carpet.yarn import Yarn
from ilmek.carpet.yarn_plan import EURO
from ilmek.errors import shortened
from ilmek.io.chart.lettering import missing_letters
from ilmek.report import Check
from ilmek.units import counted, format_number, format_quantity


def yarn_warnings(chart: Chart, bill: YarnBill, thickest: Yarn, fill: Check) -> tuple[str, ...]:
    """The warnings on the yarn of a chart: the thickest yarn that is used, the mass, the dye lots of the field."""
    found = (
        too_thick(chart, thickest, fill),
        mass_warning(bill, chart.quality),
        lot_warning(bill),
        letters_warning(chart),
    )
    return tuple(filter(None, found))


def too_thick(chart: Chart, thickest: Yarn, fill: Check) -> str:
    """The count that fits where the pile does not; "" where it does."""
    if fill.ok:
        return ""
    yarn, quality = thickest, chart.quality
    # Rounded up, because a finer count fits.
    fits = math.ceil(100 * coarsest_count(quality, yarn.ply, of_yarn(PileParams(), yarn))) / 100
    usual = f"{usual_count(quality, chart.knot):g}/{USUAL_PLY}"
    problem = f"{yarn.name!r} (Nm {yarn.metric_count:g}, ply {yarn.ply}) is too thick for {quality}"
    takes = f"its pile would take {format_quantity(fill.value, '%', 3)} of the ground"
    finer = f"with ply {yarn.ply}, Nm {fits:g} or finer fits; usual is {usual}: --yarn-count {usual}"
    return f"{problem}: {takes}; {finer}, or take a coarser quality"


def currency_warning(currency: str, loom_prices: str | None) -> str:
    """Where the yarn's prices are in another currency than the table of a loom's parts; "" where both are in euros."""
    if currency == EURO or loom_prices is not None:
        return ""
    return f"prices of yarn are in {currency}, the table of prices of the loom's parts is in {EURO}: give --loom prices"


def mass_warning(bill: YarnBill, quality: Quality) -> str:
    """What to do where a carpet's mass is outside the published band; "" where none is published, and of a swatch.

    A carpet is too heavy by its field alone: of ends and selvedges a small one has more than those of the band.
    """
    of_edges = ("end", "selvedge", "binding", "tape")
    band, edges = bill.band, sum(need.kept for need in bill.needs if need.use in of_edges) / bill.area
    if band is None or bill.area < SMALLEST_CARPET or band.least <= bill.mass_per_area <= band.most + edges:
        return ""
    light = bill.mass_per_area < band.least
    mass = format_quantity(bill.mass_per_area, "kg/m^2", 3)
    published = f"{format_number(band.least, 3)} to {format_quantity(band.most, 'kg/m^2', 3)}"
    cure = "a heavier yarn or a higher pile" if light else "a finer yarn or a lower pile"
    return (
        f"the carpet weighs {mass}, {'below' if light else 'above'} the {published} published for {quality} "
        f"({BAND_SOURCE}): calibrate, or take {cure} (--calibration, --yarn-count, --pile-height)"
    )


def letters_warning(chart: Chart) -> str:
    """The characters of names that no font of the PDF files has, which show boxes; "" where there are none."""
    found = {
        yarn.name: letters
        for yarn in map(chart.yarns.__getitem__, chart.used)
        if (letters := missing_letters(yarn.name))
    }
    if not found:
        return ""
    name, letters = next(iter(found.items()))
    others = f" (and in {counted(len(found) - 1, 'more name')})" if len(found) > 1 else ""
    return (
        f"no font of the PDF files has {letters!r} of the yarn {shortened(name)!r}{others}: boxes stand there; "
        "the symbols are whole, and report.html has the name"
    )


def lot_warning(bill: YarnBill) -> str:
    """The rows in which the field's dye lot changes; "" where it comes from one."""
    field = bill.field
    if field.lots == 1:
        return ""
    listed = ", ".join(str(row) for row in field.lot_rows[:_MOST_ROWS])
    more = "" if len(field.lot_rows) <= _MOST_ROWS else f" and {len(field.lot_rows) - _MOST_ROWS} more"
    return (
        f"{field.name!r}, the yarn of the most knots, needs {field.lots} dye lots: a new one begins in row {listed}"
        f"{more} from the lower edge; blend there, row by row, or find a larger lot (--lot)"
    )


SMALLEST_CARPET = 0.1
"""Area [m²] below which a piece is a swatch: selvedges, ends and fringe add more than 8 % to the mass of the field, and
the published masses are those of carpets. The smallest standard size, küçük yastık, has this area.
"""

_MOST_ROWS = 8
"""Largest number of rows that a warning lists."""
