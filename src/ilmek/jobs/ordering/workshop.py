"""The folder of a carpet for the workshop: chart, rows, yarn, mounting sheet, wages, strike-off, label and record."""

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

from ilmek.carpet.bill import yarn_bill
from ilmek.carpet.footprint import FACTORS
from ilmek.carpet.mounting import mounting
from ilmek.carpet.price_rules import WageRules, woven_in_rows
from ilmek.carpet.statistics import chart_statistics
from ilmek.carpet.strike_off import part_of
from ilmek.io.carpet_record import code_of, signed_record
from ilmek.io.chart.formats import FORMATS
from ilmek.io.chart.legend import thousands
from ilmek.io.chart.printing import size_of
from ilmek.io.json_file import json_text
from ilmek.io.selling.label import write_label
from ilmek.io.selling.mounting_sheet import write_mounting
from ilmek.io.selling.quotation import fibres_in_words, outline_facts
from ilmek.io.selling.wage_sheet import WageSheet, write_wages
from ilmek.jobs.chart import ChartResult, write_chart
from ilmek.jobs.ordering.offering import OrderLine
from ilmek.jobs.ordering.passport import carpet_record
from ilmek.jobs.ordering.progress import NOT_BEGUN, WovenRows
from ilmek.progress import SILENT, Progress
from ilmek.records import JsonObject, record
from ilmek.sentences import Name, Sentence, in_language, translated
from ilmek.units import format_number, mm

"""What the label names each material by."""

MOUNTING, WAGES, STRIKE_OFF = "mounting.pdf", "wages.pdf", "strike-off"


@record
class WorkshopTerms:
    """What the folders of all carpets have in common.

    language  of the weavers; customer_language: of the labels
    lots      the dye lot in stock of each yarn
    key       that signs the records; None: they are not signed
    """

    reference: str
    currency: str
    wage: WageRules | None
    language: str
    customer_language: str
    lots: Mapping[str, str]
    key: Any = None


def write_workshop(
    line: OrderLine,
    terms: WorkshopTerms,
    woven: WovenRows,
    work: Path,
    *,
    before: Path,
    left_out: list[str],
    progress: Progress = SILENT,
) -> tuple[list[str], list[JsonObject]]:
    """Write the folder of a line of the order; the names of its files, and the records of its carpets.

    before  the folder that is replaced, whose records have the rows until now
    """
    order = line.charted.order.order
    files = replace(order.files, lang=terms.language)
    charted = replace(
        line.charted, order=replace(line.charted.order, order=replace(order, files=files)), name=line.name
    )
    names = [*write_chart(charted, work, left_out, progress.part(0.0, 0.7))[0]]
    with in_language(terms.language):
        names += _sheets(line, terms, woven, work)
    names += _strike_off(charted, line, work, progress.part(0.7, 0.9))
    records = []
    for number in range(1, line.planned.entry.quantity + 1):
        file = f"record-{number}.json"
        rows = woven if number == 1 else NOT_BEGUN
        found = carpet_record(terms.reference, line, number, rows, before=before / file, lots=terms.lots)
        made = signed_record(found, terms.key)
        (work / file).write_text(json_text(made), encoding="utf-8")
        label = f"label-{number}.pdf"
        with in_language(terms.customer_language):
            write_label(work / label, Name(f"{line.name} · {number}"), _label_facts(found, line), str(code_of(made)))
        names += [file, label]
        records.append(made)
    return names, records


def _sheets(line: OrderLine, terms: WorkshopTerms, woven: WovenRows, work: Path) -> list[str]:
    chart, plan = line.charted.chart, line.charted.order.order.plan
    write_mounting(work / MOUNTING, line.name, chart, mounting(chart, plan.ground(line.charted.ground)))
    if terms.wage is None or line.wage is None:
        return [MOUNTING]
    write_wages(work / WAGES, line.name, wage_sheet(line.charted, terms.wage, terms.currency, woven))
    return [MOUNTING, WAGES]


def wage_sheet(charted: ChartResult, rules: WageRules, currency: str, woven: WovenRows) -> WageSheet:
    """The wage of a carpet, and what of it is due."""
    chart = charted.chart
    payments = rules.payments(woven_in_rows(chart), chart.colours)
    return WageSheet(rules, currency, chart.rows, chart.colours, payments, woven.rows)


def _strike_off(charted: ChartResult, line: OrderLine, work: Path, progress: Progress) -> list[str]:
    """The sample as a chart of its own: a chart to read back, and printed with its yarn."""
    chart = part_of(charted.chart, line.offered.shown.sample)
    order = charted.order
    bill = yarn_bill(chart, order.order.plan)
    with in_language(order.order.files.lang):
        name = f"{line.name}: {translated(Sentence('order.sample'))}"
    sample = replace(charted, chart=chart, bill=bill, statistics=chart_statistics(chart), name=name)
    names = []
    for row in (FORMATS["png"], *(row for row in FORMATS.values() if row.printed)):
        names.append(f"{STRIKE_OFF}{Path(row.file).suffix}")
        given = (sample.printing,) if row.printed else ()
        row.save(work / names[-1], chart, progress, *given)
    return names


def _label_facts(found: JsonObject, line: OrderLine) -> list[tuple[str, str]]:
    heights = " / ".join(format_number(round(pile.height / mm, 2)) for pile in line.offered.made.piles)
    fibre = fibres_in_words((part["material"], part["share"]) for part in found["fibre"])
    assumed = any(FACTORS[part["name"]].assumed and part["mass"] for part in found["emissions"]["parts"])
    gases = f"{found['emissions']['mass']:.1f} kg CO\u2082e"
    gases = Sentence("order.gases-assumed", gases=gases) if assumed else gases
    return [
        (Sentence("order.size"), size_of(line.charted.chart.size)),
        (Sentence("order.knots"), thousands(found["design"]["knots"])),
        *outline_facts(line.offered.made),
        (Sentence("order.pile"), Sentence("order.heights", heights=heights)),
        (Sentence("order.mass"), Sentence("order.mass-text", mass=f"{found['mass']:.2f}")),
        (Sentence("order.fibre"), fibre),
        (Sentence("order.gases"), gases),
        (Sentence("order.record"), found["identity"]),
    ]
