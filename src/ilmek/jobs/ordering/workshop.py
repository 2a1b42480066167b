"""The folder of a carpet for the workshop: chart, rows, yarn, mounting sheet, wages, strike-off, label and record."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from ilmek.carpet.bill import yarn_bill
from ilmek.carpet.mounting import mounting
from ilmek.carpet.price_rules import WageRules
from ilmek.carpet.statistics import chart_statistics
from ilmek.carpet.strike_off import part_of
from ilmek.io.carpet_record import code_of, signed_record
from ilmek.io.chart.formats import FORMATS
from ilmek.io.chart.printing import size_of
from ilmek.io.json_file import json_text
from ilmek.io.selling.label import write_label
from ilmek.io.selling.mounting_sheet import write_mounting
from ilmek.io.selling.wage_sheet import WageSheet, write_wages
from ilmek.jobs.chart import ChartResult, write_chart
from ilmek.jobs.ordering.offering import OrderLine
from ilmek.jobs.ordering.passport import carpet_record
from ilmek.jobs.ordering.progress import NOT_BEGUN, WovenRows
from ilmek.progress import SILENT, Progress
from ilmek.records import JsonObject, record
from ilmek.sentences import Sentence, in_language, translated

_FIBRES = {"wool": "order.fibre-wool", "cotton": "order.fibre-cotton", "silk": "order.fibre-silk"}
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
    charted = replace(line.charted, order=replace(line.charted.order, order=replace(order, files=files)))
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
            write_label(work / label, f"{line.name} · {number}", _label_facts(found, line), str(code_of(made)))
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
    in_rows = knots_in_rows(charted)
    payments = rules.payments(in_rows, chart.colours)
    return WageSheet(rules, currency, chart.rows, sum(in_rows), chart.colours, payments, woven.rows)


def knots_in_rows(charted: ChartResult) -> Sequence[int]:
    """The knots of each row, row 1 first; a cell without a knot has the code of no yarn."""
    chart = charted.chart
    counts: list[int] = np.count_nonzero(chart.knots < len(chart.yarns), axis=1)[::-1].tolist()
    return counts


def _strike_off(charted: ChartResult, line: OrderLine, work: Path, progress: Progress) -> list[str]:
    """The sample as a chart of its own: a chart to read back, and printed with its yarn."""
    chart = part_of(charted.chart, line.offered.shown.sample)
    order = charted.order
    bill = yarn_bill(chart, order.order.plan)
    sample = replace(charted, chart=chart, bill=bill, statistics=chart_statistics(chart))
    names = []
    for row in (FORMATS["png"], *(row for row in FORMATS.values() if row.printed)):
        names.append(f"{STRIKE_OFF}{Path(row.file).suffix}")
        given = (sample.printing,) if row.printed else ()
        row.save(work / names[-1], chart, progress, *given)
    return names


def _label_facts(found: JsonObject, line: OrderLine) -> list[tuple[str, str]]:
    shares = {part["material"]: f"{100 * part['share']:.0f} %" for part in found["fibre"]}
    fibre = ", ".join(f"{translated(Sentence(_FIBRES[name]))} {share}" for name, share in shares.items())
    return [
        (Sentence("order.size"), size_of(line.charted.chart.size)),
        (Sentence("order.knots"), f"{found['design']['knots']:,}".replace(",", "\u202f")),
        (Sentence("order.mass"), Sentence("order.mass-text", mass=f"{found['mass']:.2f}")),
        (Sentence("order.fibre"), fibre),
        (Sentence("order.gases"), f"{found['emissions']['mass']:.1f} kg CO\u2082e"),
        (Sentence("order.record"), found["identity"]),
    ]
