"""The record of a carpet: design, yarns with their lots, fibre, mass, energy, greenhouse gases, rows with days."""

import hashlib
from collections import defaultdict
from collections.abc import Mapping
from pathlib import Path

from ilmek.carpet.bill import YarnNeed
from ilmek.carpet.footprint import FACTORS, emissions
from ilmek.io.call_state import chart_digest
from ilmek.jobs.ordering.offering import OrderLine
from ilmek.jobs.ordering.progress import WovenRows, rows_by_day
from ilmek.records import JsonObject


def identity_of(reference: str, line: OrderLine, number: int) -> str:
    """The name of a carpet by its order, its line and its number in it: the same for the same carpet."""
    text = "\n".join((reference, line.name, str(number), chart_digest(line.charted.chart)))
    return hashlib.sha256(text.encode("utf-8")).hexdigest()[:16]


def carpet_record(
    reference: str, line: OrderLine, number: int, woven: WovenRows, *, before: Path, lots: Mapping[str, str]
) -> JsonObject:
    """The record of a carpet, SI.

    number  of the carpet in its line, from 1      before  its record that is replaced, whose rows are kept
    lots    the dye lot in stock of each yarn
    """
    chart, bill = line.charted.chart, line.charted.bill
    fibres: dict[str, float] = defaultdict(float)
    for need in bill.needs:
        fibres[need.material] += need.kept
    gases = emissions(_spun(bill.needs), line.energy)
    return {
        "identity": identity_of(reference, line, number),
        "order": reference,
        "carpet": line.name,
        "number": number,
        "of": line.planned.entry.quantity,
        "design": {
            "name": line.planned.entry.design,
            "digest": chart_digest(chart),
            "rows": chart.rows,
            "columns": chart.columns,
            "knots": bill.knots,
            "knot": chart.knot,
            "width": chart.size.width,
            "length": chart.size.length,
            "across": chart.quality.across,
            "along": chart.quality.along,
            **line.offered.made.as_json(),
        },
        "yarn": [_yarn(need, lots.get(need.bought or need.name, "")) for need in bill.needs],
        "fibre": [
            {"material": name, "mass": mass, "share": mass / sum(fibres.values())} for name, mass in fibres.items()
        ],
        "mass": sum(fibres.values()),
        "energy": line.energy,
        "emissions": {
            "mass": sum(gases.values()),
            "parts": [
                {
                    "name": name,
                    "mass": mass,
                    "factor": FACTORS[name].factor,
                    "unit": f"kg CO2e/{FACTORS[name].unit}",
                    "source": FACTORS[name].source,
                }
                for name, mass in gases.items()
            ],
        },
        "rows": rows_by_day(woven, before, chart),
    }


def _spun(needs: tuple[YarnNeed, ...]) -> dict[str, float]:
    """The mass of each material that is spun for the carpet, waste included [kg]."""
    spun: dict[str, float] = defaultdict(float)
    for need in needs:
        spun[need.material] += need.mass
    return spun


def _yarn(need: YarnNeed, lot: str) -> JsonObject:
    """A yarn of the record; the first of its lots is that in stock, where it is known."""
    return {
        "name": need.bought or need.name,
        "use": need.use,
        "material": need.material,
        "count": need.count,
        "knots": need.knots,
        "mass": need.mass,
        "lots": [
            {"lot": lot if lot and number == 1 else number, "from_row": row}
            for number, row in enumerate((1, *need.lot_rows), 1)
        ],
    }
